//! What momentum control aims at.

use aplomb_framework::character::{Foot, Point};

/// What is aimed at.
#[derive(Debug, Clone, PartialEq)]
pub struct Reference {
    /// c_r, m, world.
    pub com: [f64; 2],
    /// ċ_r, m/s.
    pub com_velocity: [f64; 2],
    /// θ_r: joint angles, rad.
    pub pose: Vec<f64>,
    /// θ̇_r, rad/s.
    pub rates: Vec<f64>,
    /// θ̈ of (2), rad/s².
    pub accelerations: Vec<f64>,
    /// Pitch of the root, rad.
    pub pitch: f64,
    /// A foot that is not to carry but to move, if any.
    pub swing: Option<Swing>,
}

/// Where the sole of a foot is to move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Swing {
    /// Place of the foot in the model's feet.
    pub foot: usize,
    /// The middle of the sole, m, world.
    pub position: [f64; 2],
    /// m/s
    pub velocity: [f64; 2],
    /// Pitch of the sole, rad.
    pub angle: f64,
    /// Stiffness of the tracking, 1/s²; it is critically damped.
    pub stiffness: f64,
    /// Weight of the tracking in the program.
    pub weight: f64,
}

/// The middle of the sole, in the foot's frame.
pub(crate) fn sole_centre(foot: &Foot) -> Point {
    [
        0.5 * (foot.heel[0] + foot.toe[0]),
        0.5 * (foot.heel[1] + foot.toe[1]),
    ]
}
