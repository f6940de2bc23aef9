//! Our points in the engine's precision.

use rapier2d::prelude::Vector;

/// A world vector in the engine's type.
pub(crate) fn vector(p: [f64; 2]) -> Vector {
    Vector::new(p[0] as f32, p[1] as f32)
}
