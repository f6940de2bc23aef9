//! Tests of the dual active-set solver, against an interior-point solver and against KKT.
#![allow(clippy::unwrap_used)]
#![allow(
    clippy::disallowed_methods,
    reason = "tests compare with the standard library's functions"
)]

mod hard;
mod known;
mod refusals;

use aplomb_controllers::momentum::quadratic_program::{ActiveSet, Problem};
use rand::Rng;
use rand_chacha::ChaCha8Rng;

/// Adds `rank` random least-squares terms and `floor` times the identity.
fn random_cost(rng: &mut ChaCha8Rng, p: &mut Problem, rank: usize, floor: f64) {
    let n = p.n;
    for _ in 0..rank {
        let a: Vec<f64> = (0..n).map(|_| rng.gen_range(-1.0..1.0)).collect();
        let target = rng.gen_range(-3.0..3.0);
        for i in 0..n {
            for j in 0..n {
                p.h[i * n + j] += a[i] * a[j];
            }
            p.g[i] -= a[i] * target;
        }
    }
    for i in 0..n {
        p.h[i * n + i] += floor;
        p.g[i] += floor * rng.gen_range(-1.0..1.0);
    }
}

/// Rows around a random point, so that `slack` ≥ 0 makes the problem feasible.
fn random_rows(rng: &mut ChaCha8Rng, p: &mut Problem, me: usize, mi: usize, slack: (f64, f64)) {
    let point: Vec<f64> = (0..p.n).map(|_| rng.gen_range(-1.0..1.0)).collect();
    for k in 0..me + mi {
        let size = 10f64.powf(rng.gen_range(-2.0..2.0));
        let a: Vec<f64> = (0..p.n).map(|_| size * rng.gen_range(-1.0..1.0)).collect();
        let at: f64 = a.iter().zip(&point).map(|(a, b)| a * b).sum();
        if k < me {
            p.equalities.push_row(at).copy_from_slice(&a);
        } else {
            let d = at - size * rng.gen_range(slack.0..slack.1);
            p.inequalities.push_row(d).copy_from_slice(&a);
        }
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

/// Largest KKT residual; rows by their length, stationarity relative to the sum of its terms.
fn kkt(p: &Problem, s: &ActiveSet) -> f64 {
    let (n, x) = (p.n, s.x());
    let mut gradient: Vec<f64> = (0..n)
        .map(|i| dot(&p.h[i * n..(i + 1) * n], x) + p.g[i])
        .collect();
    let mut worst = 0.0_f64;
    let mut terms = norm(&p.g).max(1.0);
    for i in 0..p.equalities.len() {
        let (row, y) = (p.equalities.row(i), s.equality_multipliers()[i]);
        gradient.iter_mut().zip(row).for_each(|(g, a)| *g -= y * a);
        terms += y.abs() * norm(row);
        let scale = norm(row).max(f64::MIN_POSITIVE) * norm(x).max(1.0);
        worst = worst.max((dot(row, x) - p.equalities.rhs(i)).abs() / scale);
    }
    for i in 0..p.inequalities.len() {
        let (row, u) = (p.inequalities.row(i), s.inequality_multipliers()[i]);
        assert!(u >= 0.0);
        gradient.iter_mut().zip(row).for_each(|(g, a)| *g -= u * a);
        terms += u * norm(row);
        let scale = norm(row).max(f64::MIN_POSITIVE) * norm(x).max(1.0);
        let slack = (dot(row, x) - p.inequalities.rhs(i)) / scale;
        worst = worst.max(-slack);
        if u > 0.0 {
            worst = worst.max(slack.abs() * (u * norm(row)).min(1.0));
        }
    }
    worst.max(norm(&gradient) / terms)
}
