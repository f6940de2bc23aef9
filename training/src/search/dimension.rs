//! What is optimised: named numbers with ranges, mapped to the unit cube.
use aplomb_framework::math::{exp, ln};

/// One number.
#[derive(Debug, Clone, PartialEq)]
pub struct Dimension {
    /// Where it goes.
    pub name: String,
    /// At 0.
    pub low: f64,
    /// At 1.
    pub high: f64,
    /// Whether equal steps are equal factors.
    pub logarithmic: bool,
}

/// A number whose steps are differences.
#[must_use]
pub fn linear(name: impl Into<String>, low: f64, high: f64) -> Dimension {
    Dimension {
        name: name.into(),
        low,
        high,
        logarithmic: false,
    }
}

/// A positive number whose steps are factors.
#[must_use]
pub fn logarithmic(name: impl Into<String>, low: f64, high: f64) -> Dimension {
    Dimension {
        name: name.into(),
        low,
        high,
        logarithmic: true,
    }
}

impl Dimension {
    /// The number at a coordinate in 0..1.
    #[must_use]
    pub fn value(&self, unit: f64) -> f64 {
        if self.logarithmic {
            exp(ln(self.low) + unit * ln(self.high / self.low))
        } else {
            self.low + unit * (self.high - self.low)
        }
    }

    /// The same dimension, reaching at least to a number.
    #[must_use]
    pub fn including(mut self, value: f64) -> Self {
        if value > 0.0 || !self.logarithmic {
            self.low = self.low.min(value);
            self.high = self.high.max(value);
        }
        self
    }

    /// The coordinate of a number, moved into 0..1.
    #[must_use]
    pub fn unit(&self, value: f64) -> f64 {
        let u = if self.logarithmic {
            ln(value.max(f64::MIN_POSITIVE) / self.low) / ln(self.high / self.low)
        } else {
            (value - self.low) / (self.high - self.low)
        };
        u.clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_and_coordinates_are_inverse() {
        for d in [linear("a", -1.0, 3.0), logarithmic("b", 0.01, 100.0)] {
            for u in [0.0, 0.25, 1.0] {
                assert!((d.unit(d.value(u)) - u).abs() < 1e-12);
            }
            assert_eq!(d.unit(d.low - 1.0), 0.0);
            let wide = d.clone().including(120.0).including(0.001);
            assert_eq!([wide.low, wide.high], [d.low.min(0.001), 120.0]);
            assert_eq!(d.clone().including(0.5), d);
        }
        let log = logarithmic("b", 0.01, 100.0);
        assert_eq!(log.clone().including(-1.0), log);
    }
}
