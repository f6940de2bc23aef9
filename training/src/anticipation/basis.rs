//! Principal components of the trajectories of one kind of task (2017 paper, section 5).
//!
//! trajectories → rows of knots, control points and length (n × 9) → centred, singular value
//! decomposition → [`Basis`] → trajectories by few coordinates.

use std::path::Path;

use aplomb_controllers::kinds::cmrt::{Cmrt, MOST_KNOTS};
use aplomb_framework::input::{Error, FieldPath, Result, Source, check, options, write_atomically};
use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

use crate::anticipation::knots::ordered;

/// Standard deviations of a component from the middle of the unit cube to its faces.
const SPREAD: f64 = 3.0;
/// The largest number in a file.
const LARGEST: f64 = 1e6;

/// The mean of a family and its principal axes.
///
/// ```
/// # use aplomb_controllers::kinds::cmrt::Cmrt;
/// # use aplomb_training::anticipation::basis::Basis;
/// // Trajectories that were learned for masses of 1 to 5 kg: here they differ in one displacement.
/// let learned = |mass: f64| Cmrt {
///     value: mass, length: 2.0, times: vec![0.5, 1.0, 1.5], displacements: vec![0.0, 0.01 * mass, 0.0],
/// };
/// let family = (1..=5).map(|mass| learned(f64::from(mass))).collect();
/// let basis = Basis::new("lift", "mass", 1, family, 1)?;
/// assert!(basis.explained[0] > 0.99); // one component is enough
/// let middle = basis.trajectory(&[0.5], 2.0);
/// assert!((middle.displacements[1] - 0.03).abs() < 1e-4);
/// # Ok::<(), aplomb_framework::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Basis {
    /// The clip that it is of.
    pub clip: String,
    /// The parameter that the family is over.
    pub parameter: String,
    /// Fixes everything random in the trajectories' search.
    pub seed: u64,
    /// The trajectories that it was made from.
    pub family: Vec<Cmrt>,
    /// Mean row: knots (s), control points (m), length (s).
    pub mean: Vec<f64>,
    /// Principal axes, unit vectors, the most important first.
    pub components: Vec<Vec<f64>>,
    /// Standard deviation of the family along each axis.
    pub deviations: Vec<f64>,
    /// Part of the variance that each of all axes explains, also of those left out.
    pub explained: Vec<f64>,
}

fn row(cmrt: &Cmrt) -> Vec<f64> {
    let all = cmrt.times.iter().chain(&cmrt.displacements);
    all.copied().chain([cmrt.length]).collect()
}

impl Basis {
    /// The basis of at least two trajectories with equally many knots, reduced to `components`.
    ///
    /// # Errors
    /// Too few trajectories, of unequal kind, or all the same.
    pub fn new(
        clip: &str,
        parameter: &str,
        seed: u64,
        family: Vec<Cmrt>,
        components: usize,
    ) -> Result<Self> {
        let invalid = |problem: String, accepted: &str| {
            Err(Error::invalid(clip, "trajectories", problem, accepted))
        };
        let width = family.first().map_or(0, |c| row(c).len());
        if family.len() < 2 || family.iter().any(|c| row(c).len() != width) {
            let accepted = "at least two with equally many knots";
            return invalid(family.len().to_string(), accepted);
        }
        let n = family.len();
        let rows: Vec<f64> = family.iter().flat_map(row).collect();
        let a = DMatrix::from_row_slice(n, width, &rows);
        let mean = a.row_mean();
        let centred = DMatrix::from_fn(n, width, |i, j| a[(i, j)] - mean[j]);
        let decomposition = centred.svd(false, true);
        let Some(axes) = decomposition.v_t else {
            return invalid("without axes".to_owned(), "finite numbers");
        };
        let s = decomposition.singular_values;
        let total: f64 = s.iter().map(|s| s * s).sum();
        let size: f64 = rows.iter().map(|x| x * x).sum();
        if total.is_nan() || total <= 1e-18 * size {
            return invalid("all the same".to_owned(), "some that differ");
        }
        let mut order: Vec<usize> = (0..s.len()).collect();
        order.sort_by(|i, j| s[*j].total_cmp(&s[*i]));
        let kept = || order.iter().take(components.clamp(1, s.len()));
        Ok(Self {
            clip: clip.to_owned(),
            parameter: parameter.to_owned(),
            seed,
            mean: mean.iter().copied().collect(),
            components: kept()
                .map(|i| axes.row(*i).iter().copied().collect())
                .collect(),
            deviations: kept().map(|i| s[*i] / ((n - 1) as f64).sqrt()).collect(),
            explained: order.iter().map(|i| s[*i] * s[*i] / total).collect(),
            family,
        })
    }

    /// Reads and checks a basis file.
    ///
    /// # Errors
    /// An unreadable or malformed file; vectors of unequal length, numbers that are not finite.
    pub fn read(path: &Path) -> Result<Self> {
        let source = Source::read(path)?;
        let basis: Self = source.parse()?;
        basis.check().map_err(|e| source.locate(e))?;
        Ok(basis)
    }

    fn check(&self) -> Result<()> {
        let width = self.mean.len();
        let knots = width.saturating_sub(1) / 2;
        if width.is_multiple_of(2) || !(1..=MOST_KNOTS).contains(&knots) {
            let accepted = format!("an odd number of them from 3 to {}", 2 * MOST_KNOTS + 1);
            let found = format!("a list of {width}");
            return Err(Error::refused("mean", found, accepted));
        }
        let count = self.components.len();
        check::count("components", count, 1..=width, "components")?;
        let deviations = self.deviations.len();
        check::count(
            "deviations",
            deviations,
            count..=count,
            "numbers, one a component",
        )?;
        let numbers = |field: FieldPath, list: &[f64]| {
            let mut all = list.iter().enumerate();
            let finite = |(i, x): (usize, &f64)| check::within(i, *x, -LARGEST..=LARGEST);
            all.try_for_each(finite).map_err(|e| e.inside(field))
        };
        for (i, component) in self.components.iter().enumerate() {
            let what = "numbers, as the mean";
            check::count(("components", i), component.len(), width..=width, what)?;
            numbers(("components", i).into(), component)?;
        }
        numbers("mean".into(), &self.mean)?;
        numbers("deviations".into(), &self.deviations)
    }

    /// Writes the basis.
    ///
    /// # Errors
    /// [`Error::Write`].
    pub fn write(&self, path: &Path) -> Result<()> {
        let pretty = ron::ser::PrettyConfig::new()
            .struct_names(false)
            .depth_limit(2);
        let text = options().to_string_pretty(self, pretty).unwrap_or_default();
        write_atomically(path, (text + "\n").as_bytes())
    }

    /// The trajectory at a point of the unit cube, for a motion of `length` s.
    #[must_use]
    pub fn trajectory(&self, point: &[f64], length: f64) -> Cmrt {
        let mut row = self.mean.clone();
        let axes = self.components.iter().zip(&self.deviations).zip(point);
        for ((axis, deviation), u) in axes {
            let along = 2.0 * SPREAD * deviation * (u - 0.5);
            for (x, a) in row.iter_mut().zip(axis) {
                *x += along * a;
            }
        }
        let knots = self.mean.len() / 2;
        let pairs = row[..knots]
            .iter()
            .copied()
            .zip(row[knots..2 * knots].iter().copied());
        ordered(pairs.collect(), length)
    }

    /// The mean trajectory, moved along one component by so many of its standard deviations.
    #[must_use]
    pub fn along(&self, component: usize, deviations: f64) -> Cmrt {
        let mut point = vec![0.5; self.components.len()];
        if let Some(u) = point.get_mut(component) {
            *u += deviations / (2.0 * SPREAD);
        }
        let length = |axis: &Vec<f64>, deviation: &f64| axis.last().map(|a| a * deviation);
        let axis = self.components.get(component);
        let moved = axis.zip(self.deviations.get(component));
        let longer = moved.and_then(|(a, d)| length(a, d)).unwrap_or(0.0);
        let mean = self.mean.last().copied().unwrap_or(0.0);
        self.trajectory(&point, mean + deviations * longer)
    }

    /// The point of the unit cube whose trajectory is nearest; none for another number of knots.
    #[must_use]
    pub fn point(&self, cmrt: &Cmrt) -> Option<Vec<f64>> {
        let row = row(cmrt);
        if row.len() != self.mean.len() {
            return None;
        }
        let axes = self.components.iter().zip(&self.deviations);
        let coordinate = |(axis, deviation): (&Vec<f64>, &f64)| {
            let pairs = row.iter().zip(&self.mean).zip(axis);
            let along: f64 = pairs.map(|((x, m), a)| (x - m) * a).sum();
            (along / (2.0 * SPREAD * deviation.max(1e-12)) + 0.5).clamp(0.0, 1.0)
        };
        Some(axes.map(coordinate).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Along one line in the space of trajectories, with a little across it.
    fn family() -> Vec<Cmrt> {
        let member = |i: u32| {
            let x = f64::from(i);
            Cmrt {
                value: x,
                length: 2.0,
                times: vec![0.4 + 0.02 * x, 0.8, 1.2, 1.6],
                displacements: vec![0.01 * x, -0.02 * x, 0.05, 0.001 * f64::from(i % 2)],
            }
        };
        (0..8).map(member).collect()
    }

    #[test]
    fn one_axis_explains_a_line_and_gives_its_members_back() {
        let basis = Basis::new("x", "mass", 0, family(), 3).unwrap();
        assert!(basis.explained[0] > 0.99, "{:?}", basis.explained);
        assert!((basis.explained.iter().sum::<f64>() - 1.0).abs() < 1e-9);
        assert_eq!(basis.components.len(), 3);
        for member in family() {
            let back = basis.trajectory(&basis.point(&member).unwrap(), 2.0);
            for (a, b) in row(&back).iter().zip(row(&member)) {
                assert!((a - b).abs() < 1e-3, "{back:?} {member:?}");
            }
        }
        let ends = [-1.0, 1.0].map(|d| row(&basis.along(0, d)));
        for (j, (low, high)) in ends[0].iter().zip(&ends[1]).enumerate() {
            let between = 2.0 * basis.deviations[0] * basis.components[0][j];
            // The digits after the point of a trajectory.
            assert!((high - low - between).abs() < 2e-4, "{ends:?}");
        }
        let middle = basis.trajectory(&[0.5; 3], 2.0);
        for (a, b) in row(&middle).iter().zip(&basis.mean) {
            assert!((a - b).abs() < 1e-4);
        }
    }

    #[test]
    fn a_basis_survives_its_file_and_a_bad_one_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("b.ron");
        let basis = Basis::new("x", "mass", 0, family(), 3).unwrap();
        basis.write(&path).unwrap();
        assert_eq!(Basis::read(&path).unwrap(), basis);
        for (field, spoil) in [
            ("components", |b: &mut Basis| b.components.clear()),
            ("components", |b: &mut Basis| b.components[1].truncate(1)),
            ("deviations", |b: &mut Basis| b.deviations.truncate(1)),
            ("mean", |b: &mut Basis| b.mean.clear()),
            ("mean[2]", |b: &mut Basis| b.mean[2] = f64::NAN),
        ] as [(&str, fn(&mut Basis)); 5]
        {
            let mut bad = basis.clone();
            spoil(&mut bad);
            bad.write(&path).unwrap();
            let told = Basis::read(&path).unwrap_err().to_string();
            assert!(told.contains(field), "{field}: {told}");
        }
        assert!(Basis::new("x", "mass", 0, vec![family()[0].clone(); 3], 3).is_err());
        assert!(Basis::new("x", "mass", 0, family()[..1].to_vec(), 3).is_err());
    }
}
