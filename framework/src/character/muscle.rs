//! What the muscles of a joint can do: a greatest torque each way, falling with the speed of shortening.
//!
//! joint rate → least and greatest torque.
//!
//! Shortening at ω ≥ 0, after Anderson, Madigan and Nussbaum (2007), equation 3, whatever the joint's angle:
//!
//! τ(ω) = τ₀ (2 ω₇₅ ω₅₀ + ω (ω₅₀ − 3 ω₇₅)) / (2 ω₇₅ ω₅₀ + ω (2 ω₅₀ − 4 ω₇₅)), not below 0,
//!
//! with three quarters of τ₀ left at ω₇₅ and a half at ω₅₀. Lengthening muscles hold more: the torque
//! rises evenly to 1.3 τ₀ at 1 rad/s.

use serde::Deserialize;

/// What lengthening muscles hold at most, relative to τ₀.
const LENGTHENING: f64 = 1.3;
/// rad/s of lengthening at which they hold that.
const FULL: f64 = 1.0;

/// The muscles that turn a joint one way.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Muscle {
    /// τ₀: the greatest torque at rest, N·m.
    pub torque: f64,
    /// ω₇₅ and ω₅₀: speeds of shortening at which three quarters and a half of it are left, rad/s;
    /// the same torque at every speed if there are none.
    #[serde(default)]
    pub speeds: Option<[f64; 2]>,
}

impl Muscle {
    /// The greatest torque while they shorten at a speed, rad/s; below 0 they are lengthened.
    #[must_use]
    pub fn greatest(&self, speed: f64) -> f64 {
        let Some([slow, half]) = self.speeds else {
            return self.torque;
        };
        if speed < 0.0 {
            return self.torque * (1.0 + (LENGTHENING - 1.0) * (-speed / FULL).min(1.0));
        }
        let left = 2.0 * slow * half + speed * (half - 3.0 * slow);
        if left <= 0.0 {
            return 0.0;
        }
        self.torque * left / (2.0 * slow * half + speed * (2.0 * half - 4.0 * slow))
    }
}

/// The muscles of a joint.
///
/// ```
/// # use aplomb_framework::character::{Muscle, Muscles};
/// let hip = Muscles {
///     positive: Muscle { torque: 189.0, speeds: Some([2.095, 4.267]) }, // flexion
///     negative: Muscle { torque: 288.0, speeds: Some([1.578, 3.19]) },
/// };
/// assert_eq!(hip.range(0.0), [-288.0, 189.0]);
/// let [least, greatest] = hip.range(4.267); // flexing fast: the flexors halve, the extensors brake
/// assert!((greatest - 0.5 * 189.0).abs() < 1e-9 && (least + 1.3 * 288.0).abs() < 1e-9);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Muscles {
    /// Those that make the joint's angle greater.
    pub positive: Muscle,
    /// Those that make it less.
    pub negative: Muscle,
}

impl Muscles {
    /// The same torque both ways and at every speed, N·m.
    #[must_use]
    pub fn even(torque: f64) -> Self {
        let muscle = Muscle {
            torque,
            speeds: None,
        };
        Self {
            positive: muscle,
            negative: muscle,
        }
    }

    /// Least and greatest torque at a joint's rate, N·m: at most 0, and at least 0.
    #[must_use]
    pub fn range(&self, rate: f64) -> [f64; 2] {
        [-self.negative.greatest(-rate), self.positive.greatest(rate)]
    }

    /// Whether what they can do depends on the speed.
    #[must_use]
    pub fn have_curves(&self) -> bool {
        self.positive.speeds.is_some() || self.negative.speeds.is_some()
    }

    /// The greatest torque at rest either way, N·m.
    #[must_use]
    pub fn strongest(&self) -> f64 {
        self.positive.torque.max(self.negative.torque)
    }

    /// Least and greatest torque at any rate, N·m.
    #[must_use]
    pub fn limits(&self) -> [f64; 2] {
        [
            -self.negative.greatest(-FULL),
            self.positive.greatest(-FULL),
        ]
    }

    /// As strong as this, times a factor.
    #[must_use]
    pub fn scaled(mut self, factor: f64) -> Self {
        self.positive.torque *= factor;
        self.negative.torque *= factor;
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn torque_falls_with_shortening_and_rises_with_lengthening() {
        let knee = Muscle {
            torque: 279.0,
            speeds: Some([1.517, 3.952]),
        };
        for (speed, part) in [
            (0.0, 1.0),
            (1.517, 0.75),
            (3.952, 0.5),
            (-0.5, 1.15),
            (-9.0, 1.3),
        ] {
            let torque = knee.greatest(speed);
            assert!((torque - part * 279.0).abs() < 1e-9, "{speed}: {torque}");
        }
        let speeds = (-200..4000).map(|i| f64::from(i) * 0.01);
        let torques: Vec<f64> = speeds.map(|s| knee.greatest(s)).collect();
        assert!(torques.windows(2).all(|w| w[1] <= w[0] && w[1] >= 0.0));
    }

    #[test]
    fn who_shortens_too_fast_exerts_nothing() {
        let hip = Muscle {
            torque: 288.0,
            speeds: Some([1.578, 3.19]),
        };
        assert!(hip.greatest(6.4) > 0.0);
        assert_eq!(hip.greatest(6.6), 0.0);
        assert_eq!(hip.greatest(1e6), 0.0);
    }

    #[test]
    fn even_muscles_are_the_same_at_every_speed() {
        let even = Muscles::even(100.0);
        for rate in [-50.0, 0.0, 3.0] {
            assert_eq!(even.range(rate), [-100.0, 100.0]);
        }
        assert_eq!(even.scaled(1.5).strongest(), 150.0);
    }
}
