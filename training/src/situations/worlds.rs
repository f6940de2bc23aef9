//! Randomised worlds: friction, strength and mass that the controllers do not know.
//!
//! random numbers → settings.

use aplomb_framework::world::Settings;
use rand::Rng;

/// Ranges from which a world is drawn evenly.
///
/// ```
/// # use aplomb_training::situations::Worlds;
/// use rand::SeedableRng;
/// let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(1);
/// let world = Worlds::VARIED.draw(&mut rng);
/// assert!((0.6..=1.2).contains(&world.friction));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Worlds {
    /// Friction coefficient of the ground.
    pub friction: [f64; 2],
    /// Torque limits, relative to the character's.
    pub torque: [f64; 2],
    /// Masses, relative to the character's.
    pub mass: [f64; 2],
}

impl Worlds {
    /// What skills are trained for.
    pub const VARIED: Self = Self {
        friction: [0.6, 1.2],
        torque: [0.85, 1.15],
        mass: [0.95, 1.05],
    };

    /// One friction and one torque, for the character's own masses.
    #[must_use]
    pub fn single(friction: f64, torque: f64) -> Self {
        Self {
            friction: [friction; 2],
            torque: [torque; 2],
            mass: [1.0; 2],
        }
    }

    /// One world.
    pub fn draw(&self, rng: &mut impl Rng) -> Settings {
        let mut pick = |[low, high]: [f64; 2]| low + (high - low) * rng.gen_range(0.0..=1.0);
        Settings {
            friction: pick(self.friction),
            torque: pick(self.torque),
            mass: pick(self.mass),
            ..Settings::default()
        }
    }
}
