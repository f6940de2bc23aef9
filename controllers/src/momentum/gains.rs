//! Gains and weights of momentum control, with their bounds.

use aplomb_framework::input::{Result, check};
use serde::{Deserialize, Serialize};

/// Gains and weights; the symbols are the paper's.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Gains {
    /// k_l, 1/s²: pull of the centre of mass towards its reference.
    pub kl: f64,
    /// d_l, 1/s.
    pub dl: f64,
    /// The same for its height, 1/s².
    pub kl_height: f64,
    /// 1/s
    pub dl_height: f64,
    /// Damping of angular momentum, 1/s.
    pub dh: f64,
    /// k_t, 1/s²: pull of the joints towards the reference pose.
    pub kt: f64,
    /// d_t, 1/s.
    pub dt: f64,
    /// β_l: weight of linear momentum.
    pub linear: f64,
    /// β_h: weight of angular momentum.
    pub angular: f64,
    /// β_t: weight of pose tracking.
    pub tracking: f64,
    /// Weight of the root's pitch within the tracking.
    pub root: f64,
    /// Weight of the feet's accelerations (inequality formulation).
    pub feet: f64,
    /// Weight of bringing a tilted foot back flat (inequality formulation).
    pub tilted: f64,
    /// Weight of bringing a foot in the air back beside the others (inequality formulation).
    pub lifted: f64,
    /// Damping of the feet's motion, 1/s.
    pub feet_damping: f64,
    /// m by which the centre of pressure keeps inside the sole's ends.
    pub margin: f64,
    /// Friction coefficient that is relied on.
    pub friction: f64,
    /// Fraction of the muscles' torque that is used.
    pub strength: f64,
    /// s between two solutions.
    pub period: f64,
}

impl Default for Gains {
    fn default() -> Self {
        Self {
            kl: 60.0,
            dl: 20.0,
            kl_height: 60.0,
            dl_height: 15.0,
            dh: 4.0,
            kt: 20.0,
            dt: 9.0,
            linear: 10.0,
            angular: 1.0,
            tracking: 0.005,
            root: 1.0,
            feet: 1000.0,
            tilted: 10.0,
            lifted: 0.01,
            feet_damping: 30.0,
            margin: 0.003,
            friction: 0.8,
            strength: 1.0,
            period: 0.004,
        }
    }
}

impl Gains {
    /// Checks every number.
    ///
    /// # Errors
    /// The field that is out of bounds, and its bounds.
    pub fn validate(&self) -> Result<()> {
        for (field, value, low, high) in [
            ("kl", self.kl, 0.0, 1e4),
            ("dl", self.dl, 0.0, 1e4),
            ("kl_height", self.kl_height, 0.0, 1e4),
            ("dl_height", self.dl_height, 0.0, 1e4),
            ("dh", self.dh, 0.0, 1e3),
            ("kt", self.kt, 0.0, 1e4),
            ("dt", self.dt, 0.0, 1e3),
            ("linear", self.linear, 1e-6, 1e6),
            ("angular", self.angular, 0.0, 1e6),
            ("tracking", self.tracking, 1e-6, 1e6),
            ("root", self.root, 1e-3, 1e3),
            ("feet", self.feet, 1e-3, 1e9),
            ("tilted", self.tilted, 0.0, 1e9),
            ("lifted", self.lifted, 0.0, 1e9),
            ("feet_damping", self.feet_damping, 0.0, 200.0),
            ("margin", self.margin, 0.0, 0.1),
            ("friction", self.friction, 0.01, 10.0),
            ("strength", self.strength, 0.01, 1.0),
            ("period", self.period, 0.0, 0.1),
        ] {
            check::within(field, value, low..=high)?;
        }
        Ok(())
    }
}
