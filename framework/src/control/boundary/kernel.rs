//! The decision functions of learned boundaries: polynomial and Gaussian.
//!
//! normalised features → score.

use crate::math::exp;
use serde::{Deserialize, Serialize};

use crate::control::boundary::packed;

/// The decision function of the normalised features z. 0 or more: success is expected.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum DecisionFunction {
    /// A polynomial, which is what a polynomial kernel amounts to once its support vectors are
    /// summed up.
    Polynomial {
        /// 1 to 3.
        degree: u8,
        /// Of all monomials up to the degree: the constant; then z_i; then z_i z_j for i ≤ j; then
        /// z_i z_j z_k for i ≤ j ≤ k; each in lexicographic order.
        coefficients: Vec<f64>,
    },
    /// Σ_s weights\[s\] exp(−gamma |z − support\[s\]|²) + offset.
    Gaussian {
        /// Above 0.
        gamma: f64,
        /// The score far away from all support vectors.
        offset: f64,
        /// Support vectors, normalised like z; at most [`MOST_SUPPORT_VECTORS`](crate::control::boundary::MOST_SUPPORT_VECTORS).
        #[serde(with = "packed::vectors")]
        support: Vec<Vec<f64>>,
        /// One a support vector.
        #[serde(with = "packed::weights")]
        weights: Vec<f64>,
    },
}

impl DecisionFunction {
    /// The score of normalised features.
    #[must_use]
    pub fn value(&self, z: &[f64]) -> f64 {
        match self {
            Self::Polynomial {
                degree,
                coefficients,
            } => {
                let mut next = coefficients.iter();
                (0..=*degree).map(|d| form(d, z, &mut next)).sum()
            }
            Self::Gaussian {
                gamma,
                support,
                weights,
                offset,
            } => {
                let term = |(weight, s): (&f64, &Vec<f64>)| {
                    let squares = z.iter().zip(s).map(|(z, s)| (z - s) * (z - s));
                    weight * exp(-gamma * squares.sum::<f64>())
                };
                weights.iter().zip(support).map(term).sum::<f64>() + offset
            }
        }
    }
}

/// The homogeneous polynomial of this degree in z whose coefficients come next.
fn form(degree: u8, z: &[f64], next: &mut std::slice::Iter<'_, f64>) -> f64 {
    match degree {
        0 => next.next().copied().unwrap_or(f64::NAN),
        1 => z.iter().zip(next).map(|(z, c)| c * z).sum(),
        _ => (0..z.len())
            .map(|i| z[i] * form(degree - 1, &z[i..], next))
            .sum(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::boundary::bounds::monomials;
    use proptest::prelude::*;

    /// Σ over all products of at most `degree` factors, in the order of [`DecisionFunction::Polynomial`].
    fn naive(degree: u8, coefficients: &[f64], z: &[f64]) -> f64 {
        let n = z.len();
        let mut products = vec![1.0];
        products.extend(z);
        for i in (0..n).filter(|_| degree >= 2) {
            products.extend((i..n).map(|j| z[i] * z[j]));
        }
        for i in (0..n).filter(|_| degree >= 3) {
            for j in i..n {
                products.extend((j..n).map(|k| z[i] * z[j] * z[k]));
            }
        }
        assert_eq!(products.len(), coefficients.len());
        products.iter().zip(coefficients).map(|(p, c)| p * c).sum()
    }

    fn any_polynomial() -> impl Strategy<Value = (u8, Vec<f64>, Vec<f64>)> {
        (1..=3_u8, 1..=8_usize).prop_flat_map(|(degree, n)| {
            let c = prop::collection::vec(-3.0..3.0_f64, monomials(n, degree));
            (Just(degree), c, prop::collection::vec(-2.0..2.0_f64, n))
        })
    }

    proptest! {
        #[test]
        fn polynomials_agree_with_their_definition((degree, c, z) in any_polynomial()) {
            let decision = DecisionFunction::Polynomial { degree, coefficients: c.clone() };
            let (fast, slow) = (decision.value(&z), naive(degree, &c, &z));
            prop_assert!((fast - slow).abs() < 1e-10, "{fast} for {slow}");
        }
    }
}
