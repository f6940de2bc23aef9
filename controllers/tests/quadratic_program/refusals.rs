//! Problems without a solution, with rows too many, or that are none.

use aplomb_controllers::momentum::quadratic_program::{ActiveSet, Problem, Solution};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::{dot, kkt, norm, random_cost, random_rows};

/// Rows of coefficients ±a x within a narrow or empty gap.
#[test]
fn infeasible_pairs() {
    let mut rng = ChaCha8Rng::seed_from_u64(4);
    for _ in 0..500 {
        let n = rng.gen_range(2..25);
        for (gap, expected) in [(1e-4, Solution::Optimal), (-1e-4, Solution::Infeasible)] {
            let mut p = Problem::new(n, 2, 30);
            random_cost(&mut rng, &mut p, n, 1e-2);
            random_rows(&mut rng, &mut p, 0, 10, (0.0, 0.5));
            let row: Vec<f64> = (0..n).map(|_| rng.gen_range(-1.0..1.0)).collect();
            let low = 0.5 * (dot(&row, &row) - 1.0);
            p.inequalities.clear();
            p.inequalities.push_row(low).copy_from_slice(&row);
            let opposed: Vec<f64> = row.iter().map(|a| -a).collect();
            p.inequalities
                .push_row(-low - gap)
                .copy_from_slice(&opposed);
            assert_eq!(ActiveSet::new(n, 2, 30).solve(&p), expected);
        }
    }
}

#[test]
fn redundant_equalities() {
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    for trial in 0..500 {
        let n = rng.gen_range(4..25);
        let mut p = Problem::new(n, 6, 20);
        random_cost(&mut rng, &mut p, n, 1e-3);
        random_rows(&mut rng, &mut p, 3, 20, (0.0, 0.5));
        let (a, b) = (p.equalities.row(0).to_vec(), p.equalities.row(2).to_vec());
        let rhs = 0.3 * p.equalities.rhs(0) - 7.0 * p.equalities.rhs(2);
        let mix: Vec<f64> = a.iter().zip(&b).map(|(a, b)| 0.3 * a - 7.0 * b).collect();
        p.equalities.push_row(rhs).copy_from_slice(&mix);
        p.equalities.push_row(0.0);
        let mut s = ActiveSet::new(n, 6, 20);
        assert_eq!(s.solve(&p), Solution::Optimal, "trial {trial}");
        assert!(kkt(&p, &s) < 1e-8);
        p.equalities
            .push_row(rhs + 1e-3 * norm(&mix))
            .copy_from_slice(&mix);
        assert_eq!(s.solve(&p), Solution::Infeasible, "trial {trial}");
    }
}

#[test]
fn invalid_input_is_refused() {
    let mut rng = ChaCha8Rng::seed_from_u64(6);
    let n = 8;
    let mut p = Problem::new(n, 2, 10);
    random_cost(&mut rng, &mut p, n, 1e-2);
    random_rows(&mut rng, &mut p, 2, 10, (0.0, 0.5));
    let mut s = ActiveSet::new(n, 2, 10);
    assert_eq!(s.solve(&p), Solution::Optimal);
    for bad in [
        f64::NAN,
        f64::INFINITY,
        -f64::INFINITY,
        1e300,
        -1e300,
        1e-300,
    ] {
        for place in 0..n * n + n + 4 {
            let mut q = p.clone();
            if place < n * n {
                q.h[place] = bad;
            } else if place < n * n + n {
                q.g[place - n * n] = bad;
            } else if place < n * n + n + 2 {
                q.equalities.push_row(0.1)[3] = bad;
            } else if place == n * n + n + 2 {
                q.inequalities.push_row(bad)[0] = 1.0;
            } else {
                q.equalities.push_row(bad)[0] = 1.0;
            }
            let outcome = s.solve(&q);
            let (i, j) = (place / n, place % n);
            let read = place >= n * n || j >= i;
            let unbounded = place == n * n + n + 2 && bad == -f64::INFINITY;
            if !bad.is_finite() && read && !unbounded {
                let expected = if place < n * n + n {
                    Solution::NotConvex
                } else {
                    Solution::Infeasible
                };
                assert_eq!(outcome, expected, "{bad} at {place}");
            }
        }
    }
    p.h[3] = 100.0;
    assert_eq!(s.solve(&p), Solution::NotConvex);
    p.clear();
    assert_eq!(s.solve(&p), Solution::NotConvex);
    for i in 0..n - 1 {
        p.h[i * n + i] = 1.0;
    }
    assert_eq!(s.solve(&p), Solution::NotConvex);
    p.h.pop();
    assert_eq!(s.solve(&p), Solution::NotConvex);
    p.n = usize::MAX;
    assert_eq!(s.solve(&p), Solution::NotConvex);
    let mut empty = Problem::new(0, 1, 1);
    assert_eq!(s.solve(&empty), Solution::Optimal);
    empty.inequalities.push_row(1.0);
    assert_eq!(s.solve(&empty), Solution::Infeasible);
    // Singular H of random rows.
    for _ in 0..200 {
        let mut p = Problem::new(12, 0, 0);
        random_cost(&mut rng, &mut p, 9, 0.0);
        assert_eq!(ActiveSet::new(12, 0, 0).solve(&p), Solution::NotConvex);
    }
}

#[test]
fn random_bytes_end() {
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    let mut s = ActiveSet::new(4, 2, 6);
    let mut p = Problem::new(4, 2, 6);
    for _ in 0..20000 {
        p.clear();
        let v = |rng: &mut ChaCha8Rng| match rng.gen_range(0..12) {
            0 => f64::from_bits(rng.r#gen()),
            1 => 0.0,
            2 => 10f64.powi(rng.gen_range(-160..160)),
            _ => f64::from(rng.gen_range(-2..3)),
        };
        for i in 0..4 {
            p.h[5 * i] = 8.0 + v(&mut rng);
            p.g[i] = v(&mut rng);
        }
        for _ in 0..2 {
            let rhs = v(&mut rng);
            p.equalities.push_row(rhs).fill_with(|| v(&mut rng));
        }
        for _ in 0..6 {
            let rhs = v(&mut rng);
            p.inequalities.push_row(rhs).fill_with(|| v(&mut rng));
        }
        if s.solve(&p) == Solution::Optimal {
            assert!(s.x().iter().all(|x| x.is_finite()));
        }
    }
}
