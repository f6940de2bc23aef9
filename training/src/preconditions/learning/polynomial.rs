//! The polynomial that a sum of polynomial kernels is, so that a query costs the same whatever the
//! number of support vectors.
//!
//! Coefficients come in the order 1; zᵢ; zᵢ zⱼ for i ≤ j; zᵢ zⱼ zₖ for i ≤ j ≤ k, each lexicographic.

use aplomb_framework::control::boundary::monomials;

/// x to a power, by multiplication.
fn power(x: f64, exponent: usize) -> f64 {
    std::iter::repeat_n(x, exponent).product()
}

/// Coefficients of Σ weight · (gamma x·z + constant)^degree, for a degree of 1 to 3; `None` without
/// a term.
pub(super) fn of_powers<'a>(
    terms: impl Iterator<Item = (&'a Vec<f64>, &'a f64)>,
    degree: u8,
    gamma: f64,
    constant: f64,
) -> Option<Vec<f64>> {
    // Of constant^(degree − k) (gamma x·z)^k, for k = 0 to 3.
    let binomial: [f64; 4] = match degree {
        1 => [1.0, 1.0, 0.0, 0.0],
        2 => [1.0, 2.0, 1.0, 0.0],
        _ => [1.0, 3.0, 3.0, 1.0],
    };
    let factor = |k: usize| {
        let rest = power(constant, usize::from(degree).saturating_sub(k));
        binomial[k] * rest * power(gamma, k)
    };
    let mut coefficients = Vec::new();
    for (x, weight) in terms {
        let width = x.len();
        coefficients.resize(monomials(width, degree), 0.0);
        let mut next = coefficients.iter_mut();
        let mut add = |value: f64| {
            if let Some(coefficient) = next.next() {
                *coefficient += weight * value;
            }
        };
        add(factor(0));
        x.iter().for_each(|a| add(factor(1) * a));
        if degree >= 2 {
            let factors = [1.0, 2.0].map(|times| factor(2) * times);
            for i in 0..width {
                for j in i..width {
                    add(factors[usize::from(i != j)] * x[i] * x[j]);
                }
            }
        }
        if degree >= 3 {
            // So many orders have three indices of which none, one or both neighbours differ.
            let factors = [1.0, 3.0, 6.0].map(|times| factor(3) * times);
            for i in 0..width {
                for j in i..width {
                    let pair = x[i] * x[j];
                    for (k, third) in x.iter().enumerate().skip(j) {
                        let differing = usize::from(i != j) + usize::from(j != k);
                        add(factors[differing] * pair * third);
                    }
                }
            }
        }
    }
    (!coefficients.is_empty()).then_some(coefficients)
}

#[cfg(test)]
mod tests {
    use aplomb_framework::control::boundary::DecisionFunction;

    use super::*;

    #[test]
    fn the_order_is_lexicographic_and_factors_are_folded_in() {
        // (2 (z0 + 3 z1) + 1)^2 and ^3 by hand.
        let x = vec![1.0, 3.0];
        let of = |degree| of_powers([(&x, &1.0)].into_iter(), degree, 2.0, 1.0).unwrap();
        assert_eq!(of(1), [1.0, 2.0, 6.0]);
        assert_eq!(of(2), [1.0, 4.0, 12.0, 4.0, 24.0, 36.0]);
        let cubic = [1.0, 6.0, 18.0, 12.0, 72.0, 108.0, 8.0, 72.0, 216.0, 216.0];
        assert_eq!(of(3), cubic);
        let z = [0.5, -0.25];
        let base = 2.0 * (0.5 - 0.75) + 1.0_f64;
        for degree in 1..=3 {
            let coefficients = of(degree);
            let found = DecisionFunction::Polynomial {
                degree,
                coefficients,
            }
            .value(&z);
            assert!(
                (found - power(base, usize::from(degree))).abs() < 1e-12,
                "{found}"
            );
        }
    }

    #[test]
    fn counts_of_coefficients() {
        assert_eq!(monomials(30, 1), 31);
        assert_eq!(monomials(30, 2), 496);
        assert_eq!(monomials(30, 3), 5456);
    }
}
