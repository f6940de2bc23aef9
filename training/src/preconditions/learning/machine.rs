//! A support vector machine with balanced classes (Cortes & Vapnik 1995), whatever solves it.
//!
//! [`Hyperparameters`] → `training` → [`Machine`]; standardised row → score, a success if it is at least 0.

use std::fmt;
use std::str::FromStr;

use aplomb_framework::control::boundary::DecisionFunction;
use aplomb_framework::input::{Error, Result};
use aplomb_framework::math::exp;

use super::polynomial;

/// Steps of a support vector within a standard deviation: a ten-thousandth of one decides nothing, and boundary files
/// have less than half the size.
pub const SUPPORT_STEPS: f64 = 10_000.0;

/// What stands for the scalar product of two standardised rows x, y.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kernel {
    /// x·y.
    Linear,
    /// (γ x·y + 1)².
    Poly2,
    /// (γ x·y + 1)³.
    Poly3,
    /// exp(−γ |x − y|²).
    Rbf,
}

impl Kernel {
    /// All of them, simplest first.
    pub const ALL: [Self; 4] = [Self::Linear, Self::Poly2, Self::Poly3, Self::Rbf];

    /// The kernels that a name allows: those of [`Kernel::ALL`] for `auto`, or the one.
    ///
    /// # Errors
    /// [`Error::Unknown`].
    pub fn allowed(name: &str) -> Result<Vec<Self>> {
        if name == "auto" {
            return Ok(Self::ALL.to_vec());
        }
        let known = || ["auto"].into_iter().chain(Self::ALL.map(Self::name));
        let kernel = Self::named(name);
        let kernel = kernel.ok_or_else(|| Error::unknown("kernel", name, known()))?;
        Ok(vec![kernel])
    }

    fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|k| k.name() == name)
    }

    /// `linear`, `poly2`, `poly3` or `rbf`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::Poly2 => "poly2",
            Self::Poly3 => "poly3",
            Self::Rbf => "rbf",
        }
    }

    /// Degree of the polynomial, if it is one.
    #[must_use]
    pub fn degree(self) -> Option<u8> {
        match self {
            Self::Linear => Some(1),
            Self::Poly2 => Some(2),
            Self::Poly3 => Some(3),
            Self::Rbf => None,
        }
    }

    /// K(x, y).
    #[must_use]
    pub fn value(self, gamma: f64, x: &[f64], y: &[f64]) -> f64 {
        let pairs = x.iter().zip(y);
        if self == Self::Rbf {
            let square: f64 = pairs.map(|(a, b)| (a - b) * (a - b)).sum();
            return exp(-gamma * square);
        }
        let product: f64 = pairs.map(|(a, b)| a * b).sum();
        let base = gamma * product + 1.0;
        match self {
            Self::Linear => product,
            Self::Poly2 => base * base,
            _ => base * base * base,
        }
    }
}

impl fmt::Display for Kernel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Kernel {
    type Err = Error;

    fn from_str(name: &str) -> Result<Self> {
        Self::named(name).ok_or_else(|| Error::unknown("kernel", name, Self::ALL.map(Self::name)))
    }
}

/// What a machine is trained with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hyperparameters {
    /// The kernel.
    pub kernel: Kernel,
    /// Price of a violated margin; that of a class with `k` of `n` samples is `c n / (2 k)`.
    pub c: f64,
    /// Coefficient γ of the kernel on standardised rows; the linear kernel has none.
    pub gamma: f64,
}

/// A trained machine: score = Σ weight · K(support vector, z) + offset.
#[derive(Debug, Clone, PartialEq)]
pub struct Machine {
    /// The kernel.
    pub kernel: Kernel,
    /// Its coefficient γ.
    pub gamma: f64,
    /// Support vectors: standardised rows of the training set.
    pub support: Vec<Vec<f64>>,
    /// Weight of each: positive for a success.
    pub weights: Vec<f64>,
    /// Added to the sum.
    pub offset: f64,
    /// `linfa-svm` or `libsvm-rs`.
    pub solver: &'static str,
}

impl Machine {
    /// Score of a standardised row; a success if it is at least 0.
    #[must_use]
    pub fn score(&self, z: &[f64]) -> f64 {
        let terms = self.support.iter().zip(&self.weights);
        let sum: f64 = terms
            .map(|(x, weight)| weight * self.kernel.value(self.gamma, x, z))
            .sum();
        sum + self.offset
    }

    /// What the framework evaluates: the exact polynomial, or the radial sum over support vectors that are
    /// rounded to steps of 1 / [`SUPPORT_STEPS`].
    #[must_use]
    pub fn decision(&self) -> DecisionFunction {
        match (self.collapse(), self.kernel.degree()) {
            (Some(coefficients), Some(degree)) => DecisionFunction::Polynomial {
                degree,
                coefficients,
            },
            _ => DecisionFunction::Gaussian {
                gamma: self.gamma,
                support: self.support.iter().map(|x| rounded(x)).collect(),
                weights: self.weights.clone(),
                offset: self.offset,
            },
        }
    }

    /// The exact polynomial in z that the sum is, unless the kernel is radial: coefficients of 1, of
    /// zᵢ, of zᵢ zⱼ for i ≤ j and of zᵢ zⱼ zₖ for i ≤ j ≤ k as far as the degree goes, each in
    /// lexicographic order of the indices.
    #[must_use]
    pub fn collapse(&self) -> Option<Vec<f64>> {
        let degree = self.kernel.degree()?;
        // The linear kernel is no (γ x·y + 1)¹: it lacks γ and the 1.
        let (gamma, constant) = match self.kernel {
            Kernel::Linear => (1.0, 0.0),
            _ => (self.gamma, 1.0),
        };
        let terms = self.support.iter().zip(&self.weights);
        let mut coefficients = polynomial::of_powers(terms, degree, gamma, constant)?;
        coefficients[0] += self.offset;
        Some(coefficients)
    }
}

/// A standardised row in steps of one over [`SUPPORT_STEPS`].
fn rounded(row: &[f64]) -> Vec<f64> {
    // 0 is added so that there is no −0, which has no whole number of steps.
    let rounded = |z: &f64| (z * SUPPORT_STEPS).round() / SUPPORT_STEPS + 0.0;
    row.iter().map(rounded).collect()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::preconditions::learning::dataset::Dataset;
    use crate::preconditions::learning::metrics::{metrics, metrics_of_scores, roc};
    use crate::preconditions::learning::synthetic::{halves, is_inside, rings};
    use crate::preconditions::learning::training::{prices, train};
    use crate::preconditions::learning::{libsvm_solver, linfa_solver};

    fn settings(kernel: Kernel) -> Hyperparameters {
        Hyperparameters {
            kernel,
            c: 3.0,
            gamma: 0.4,
        }
    }

    /// Balanced accuracy on a test set of a machine by each solver.
    fn balanced(kernel: Kernel, train: &Dataset, test: &Dataset) -> [f64; 2] {
        let settings = settings(kernel);
        let prices = prices(settings.c, train.counts());
        let (rows, success) = (&train.rows, &train.success);
        let tolerance = libsvm_solver::TOLERANCE;
        let machines = [
            linfa_solver::solve(rows, success, &settings, prices).unwrap(),
            libsvm_solver::solve(rows, success, &settings, prices, tolerance),
        ];
        assert_ne!(machines[0].solver, machines[1].solver);
        machines.map(|machine| {
            let scores: Vec<f64> = test.rows.iter().map(|row| machine.score(row)).collect();
            metrics_of_scores(&scores, &test.success).balanced_accuracy
        })
    }

    /// The ball that the labels are drawn from is the best answer. A kernel that can be a ball comes
    /// near to it from 500 samples, whichever solver trains it.
    #[test]
    fn both_solvers_find_the_ball() {
        let (train, test) = (rings(500, 4, 1), rings(2000, 4, 2));
        let ball: Vec<bool> = test.rows.iter().map(|row| is_inside(row)).collect();
        let best = metrics(&ball, &test.success).balanced_accuracy;
        for kernel in [Kernel::Poly2, Kernel::Poly3, Kernel::Rbf] {
            let found = balanced(kernel, &train, &test);
            assert!((found[0] - found[1]).abs() < 0.01, "{kernel}: {found:?}");
            for found in found {
                assert!(found <= best + 0.01, "{kernel}: {found}, at best {best}");
                assert!(found >= best - 0.05, "{kernel}: {found}, at best {best}");
            }
        }
    }

    /// A half-space and the other half have as many samples of each class, as both classes are
    /// symmetric about 0: what one gets right the other gets wrong. The most that a half-space can win
    /// is what the classes differ in their spread, and a half-space loses as much where its offset has the
    /// other sign. What the linear kernel reaches on the ball is therefore chance give or take that much.
    #[test]
    fn a_linear_kernel_cannot_be_a_ball() {
        let (train, test) = (rings(500, 4, 1), rings(2000, 4, 2));
        let along = |direction: &[f64; 4]| {
            let place = |row: &Vec<f64>| row.iter().zip(direction).map(|(x, d)| x * d).sum();
            let places: Vec<f64> = test.rows.iter().map(place).collect();
            let gain = |p: &[f64; 2]| 0.5 * (p[1] - p[0]).abs();
            roc(&places, &test.success)
                .iter()
                .map(gain)
                .fold(0.0, f64::max)
        };
        let directions = [[1.0, 0.0, 0.0, 0.0], [1.0, 1.0, 0.0, 0.0], [1.0; 4]];
        let most = directions.iter().map(along).fold(0.0, f64::max);
        assert!(most < 0.15, "{most}");
        for found in balanced(Kernel::Linear, &train, &test) {
            let off = (found - 0.5).abs();
            assert!(off <= most + 0.02, "{found}, at most {most} off chance");
        }
        for found in balanced(Kernel::Rbf, &train, &test) {
            assert!(found > 0.5 + most + 0.2, "{found}");
        }
    }

    /// A plane through the middle is what the linear kernel is for: of `n` samples of `d` features
    /// about d / n are left on the wrong side.
    #[test]
    fn both_solvers_find_a_plane() {
        let (train, test) = (halves(500, 4, 1), halves(2000, 4, 2));
        let wrong = 4.0 / 500.0;
        let linear = balanced(Kernel::Linear, &train, &test);
        assert!((linear[0] - linear[1]).abs() < wrong, "{linear:?}");
        for found in linear {
            assert!(found >= 1.0 - 3.0 * wrong, "{found}");
        }
    }

    #[test]
    fn names_are_read_and_unknown_ones_are_refused() {
        for kernel in Kernel::ALL {
            assert_eq!(kernel.to_string().parse::<Kernel>().unwrap(), kernel);
            assert_eq!(Kernel::allowed(kernel.name()).unwrap(), [kernel]);
        }
        assert_eq!(Kernel::allowed("auto").unwrap(), Kernel::ALL);
        let told = Kernel::allowed("poly4").unwrap_err().to_string();
        assert!(told.contains("auto, linear, poly2, poly3, rbf"), "{told}");
    }

    #[test]
    fn unlearnable_sets_are_refused() {
        let good = rings(40, 2, 1);
        let told = |rows: &[Vec<f64>], labels: &[bool], settings: &Hyperparameters| {
            train(rows, labels, settings).unwrap_err().to_string()
        };
        let usual = settings(Kernel::Poly2);
        let found = told(&good.rows, &[true; 40], &usual);
        assert!(found.contains("40 times 1 and 0 times 0"), "{found}");
        let mut rows = good.rows.clone();
        rows[7][1] = f64::NAN;
        assert!(told(&rows, &good.success, &usual).contains("not a finite number"));
        let bad = Hyperparameters { c: 0.0, ..usual };
        assert!(told(&good.rows, &good.success, &bad).contains("C is 0"));
        assert!(train(&good.rows, &good.success, &usual).is_ok());
    }

    proptest! {
        #[test]
        fn the_polynomial_equals_the_kernel_sum(
            width in 1_usize..6,
            numbers in proptest::collection::vec(-3.0..3.0_f64, 60),
            gamma in 0.01..2.0_f64,
            kernel in 0_usize..3,
        ) {
            let rows: Vec<Vec<f64>> = numbers.chunks_exact(width).map(<[f64]>::to_vec).collect();
            let (z, support) = rows.split_last().unwrap();
            let machine = Machine {
                kernel: Kernel::ALL[kernel],
                gamma,
                support: support.to_vec(),
                weights: support.iter().map(|x| x[0] - 0.3).collect(),
                offset: numbers[1],
                solver: "none",
            };
            prop_assert!(machine.collapse().is_some());
            let found = machine.decision().value(z);
            let size: f64 = support.iter().zip(&machine.weights)
                .map(|(x, w)| (w * machine.kernel.value(gamma, x, z)).abs()).sum();
            prop_assert!((found - machine.score(z)).abs() <= 1e-9 * (1.0 + size));
        }
    }

    #[test]
    fn a_radial_kernel_does_not_collapse() {
        let set = rings(60, 2, 1);
        let machine = train(&set.rows, &set.success, &settings(Kernel::Rbf)).unwrap();
        assert_eq!(machine.collapse(), None);
        let decision = machine.decision();
        for z in &set.rows {
            assert!((decision.value(z) - machine.score(z)).abs() < 1e-3);
        }
    }
}
