//! Transcendental functions that give the same bits on every processor.
//!
//! numbers → numbers, all f64. Those of the standard library call the C library of the system,
//! which has several variants of each and takes the fastest one for the processor: their last bits
//! differ, and so would the digests of runs. These are of the `libm` crate, which is pinned because
//! digests depend on its version. Roots, rounding and remainders are exact everywhere: for them the
//! standard library will do. Clippy refuses the others (`clippy.toml`).

pub use libm::{atan2, cos, exp, hypot, log as ln, log10, pow as powf, sin, sincos as sin_cos};

/// x². (`powi` may be rounded differently from build to build.)
#[must_use]
pub fn square(x: f64) -> f64 {
    x * x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn they_are_the_functions_of_their_names() {
        let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-15, "{a} for {b}");
        near(sin(0.5), 0.479_425_538_604_203);
        near(cos(0.5), 0.877_582_561_890_372_8);
        near(atan2(-1.0, 1.0), -std::f64::consts::FRAC_PI_4);
        near(exp(-0.5), 0.606_530_659_712_633_4);
        near(ln(2.0), std::f64::consts::LN_2);
        near(log10(0.001), -3.0);
        near(powf(2.0, 0.5), std::f64::consts::SQRT_2);
        near(hypot(3.0, -4.0), 5.0);
        near(square(-1.5), 2.25);
    }
}
