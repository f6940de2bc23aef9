//! Tests of the dual active-set solver, against an interior-point solver and against KKT.
#![allow(clippy::unwrap_used)]

use allocation_counter::measure;
use aplomb_controllers::quadratic_program::{ActiveSet, Outcome, Problem};
use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, SolverStatus, SupportedConeT::*};
use rand::{Rng, SeedableRng};
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

fn clarabel(p: &Problem) -> (SolverStatus, Vec<f64>) {
    let n = p.n;
    let h: Vec<Vec<f64>> = (0..n)
        .map(|i| {
            (0..n)
                .map(|j| if j >= i { p.h[i * n + j] } else { 0.0 })
                .collect()
        })
        .collect();
    let (mut a, mut b) = (Vec::new(), Vec::new());
    for (rows, sign) in [(&p.equalities, 1.0), (&p.inequalities, -1.0)] {
        for i in 0..rows.len() {
            a.push(rows.row(i).iter().map(|v| sign * v).collect::<Vec<f64>>());
            b.push(sign * rows.rhs(i));
        }
    }
    let settings = DefaultSettings {
        verbose: false,
        tol_gap_abs: 1e-10,
        tol_gap_rel: 1e-10,
        tol_feas: 1e-10,
        max_iter: 200,
        ..Default::default()
    };
    let cones = [
        ZeroConeT(p.equalities.len()),
        NonnegativeConeT(p.inequalities.len()),
    ];
    let (h, a) = (CscMatrix::from(&h), CscMatrix::from(&a));
    let mut solver = DefaultSolver::new(&h, &p.g, &a, &b, &cones, settings).unwrap();
    solver.solve();
    (solver.solution.status, solver.solution.x.clone())
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

fn objective(p: &Problem, x: &[f64]) -> f64 {
    let hx: f64 = (0..p.n)
        .map(|i| x[i] * dot(&p.h[i * p.n..(i + 1) * p.n], x))
        .sum();
    0.5 * hx + dot(&p.g, x)
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

#[test]
fn agrees_with_clarabel() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let (mut optimal, mut infeasible, mut worst_kkt, mut most) = (0, 0, 0.0_f64, 0);
    let (mut worst_x, mut worst_f, mut solved) = (0.0_f64, 0.0_f64, 0);
    for trial in 0..800 {
        let n = rng.gen_range(1..32);
        let me = rng.gen_range(0..=n / 3);
        let mi = rng.gen_range(1..50);
        let mut p = Problem::new(n, me, mi);
        let floor = 10f64.powi(-rng.gen_range(0..4));
        random_cost(&mut rng, &mut p, n / 2 + 1, floor);
        let slack = if trial % 4 == 0 {
            (-0.5, 1.0)
        } else {
            (0.0, 0.5)
        };
        random_rows(&mut rng, &mut p, me, mi, slack);
        let mut s = ActiveSet::new(n, me, mi);
        let outcome = s.solve(&p);
        let (status, x) = clarabel(&p);
        match status {
            SolverStatus::PrimalInfeasible | SolverStatus::AlmostPrimalInfeasible => {
                assert_eq!(outcome, Outcome::Infeasible, "trial {trial}");
                infeasible += 1;
            }
            _ => {
                assert_eq!(outcome, Outcome::Optimal, "trial {trial} {status:?}");
                optimal += 1;
                let (ours, theirs) = (objective(&p, s.x()), objective(&p, &x));
                let df = (ours - theirs).abs() / theirs.abs().max(1.0);
                let dx = s
                    .x()
                    .iter()
                    .zip(&x)
                    .fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
                let dx = dx / norm(&x).max(1.0);
                if status == SolverStatus::Solved {
                    solved += 1;
                    assert!(df < 1e-7, "trial {trial} {status:?}: {ours} {theirs}");
                    assert!(dx < 1e-5, "trial {trial} {status:?}: {dx}");
                    (worst_x, worst_f) = (worst_x.max(dx), worst_f.max(df));
                } else {
                    println!("{trial} {status:?} f {df:e} x {dx:e}");
                }
                let residual = kkt(&p, &s);
                assert!(residual < 1e-8, "trial {trial}: {residual}");
                worst_kkt = worst_kkt.max(residual);
                most = most.max(s.iterations());
            }
        }
    }
    println!(
        "{optimal} optimal, {solved} compared, {infeasible} infeasible, kkt {worst_kkt:e}, x {worst_x:e}, f {worst_f:e}, steps {most}"
    );
    assert!(optimal > 300 && infeasible > 50);
}

/// H of condition up to 1e12 and more: the KKT conditions alone are checked.
#[test]
fn ill_conditioned_cost() {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    let mut worst = 0.0_f64;
    for trial in 0..3000 {
        let n = rng.gen_range(2..32);
        let (me, mi) = (rng.gen_range(0..=n / 3), rng.gen_range(0..50));
        let mut p = Problem::new(n, me, mi);
        let floor = 10f64.powi(-rng.gen_range(6..12));
        random_cost(&mut rng, &mut p, n / 2, floor);
        random_rows(&mut rng, &mut p, me, mi, (0.0, 0.5));
        let mut s = ActiveSet::new(n, me, mi);
        assert_eq!(s.solve(&p), Outcome::Optimal, "trial {trial}");
        let residual = kkt(&p, &s);
        worst = worst.max(residual);
        assert!(residual < 1e-8, "trial {trial} {n} {me} {mi}: {residual}");
    }
    println!("kkt {worst:e}");
}

/// A linear cost along directions without curvature: x starts far outside its box.
#[test]
fn distant_unconstrained_minimiser() {
    let mut rng = ChaCha8Rng::seed_from_u64(9);
    let mut worst = 0.0_f64;
    for trial in 0..2000 {
        let n = rng.gen_range(2..32);
        let mut p = Problem::new(n, 3, 2 * n + 10);
        let floor = 10f64.powi(-rng.gen_range(3..10));
        random_cost(&mut rng, &mut p, n / 2, floor);
        p.g.fill_with(|| rng.gen_range(-1.0..1.0));
        random_rows(&mut rng, &mut p, (n / 4).min(3), 10, (0.0, 0.5));
        for i in 0..n {
            p.inequalities.push_row(-1.0)[i] = 1.0;
            p.inequalities.push_row(-1.0)[i] = -1.0;
        }
        let mut s = ActiveSet::new(n, 3, 2 * n + 10);
        assert_eq!(s.solve(&p), Outcome::Optimal, "trial {trial}");
        let residual = kkt(&p, &s);
        worst = worst.max(residual);
        assert!(residual < 1e-8, "trial {trial} {n} {floor}: {residual}");
    }
    println!("kkt {worst:e}");
}

/// Cones with their apex at the origin, often the minimiser; the tolerance can not rest on x.
#[test]
fn apex_of_cones() {
    let mut rng = ChaCha8Rng::seed_from_u64(10);
    let (mut worst, mut apexes) = (0.0_f64, 0);
    for trial in 0..3000 {
        let n = rng.gen_range(2..12);
        let mut p = Problem::new(n, 3, 60);
        random_cost(&mut rng, &mut p, n / 2, 1e-3);
        let size = 10f64.powi(rng.gen_range(-8..8));
        p.g.fill_with(|| size * rng.gen_range(-0.3..1.0));
        for i in 0..n {
            for k in 0..5 {
                let row = p.inequalities.push_row(0.0);
                row[i] = 1.0;
                row[(i + k) % n] += 0.1 * k as f64;
                if k == 4 {
                    row[(i + 1) % n] -= 0.7;
                }
            }
        }
        let mut s = ActiveSet::new(n, 3, 60);
        assert_eq!(s.solve(&p), Outcome::Optimal, "trial {trial}");
        apexes += usize::from(norm(s.x()) < 1e-9 * size);
        let residual = kkt(&p, &s);
        worst = worst.max(residual);
        assert!(residual < 1e-8, "trial {trial}: {residual}");
    }
    println!("{apexes} apexes, kkt {worst:e}");
}

/// Integer rows through one vertex, repeated and opposed: many more active rows than variables.
#[test]
fn degenerate_vertices() {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let mut worst = 0.0_f64;
    for trial in 0..3000 {
        let n = rng.gen_range(1..22);
        let mi = 60;
        let mut p = Problem::new(n, 4, mi + 20);
        random_cost(&mut rng, &mut p, n, 1e-4);
        let point: Vec<f64> = (0..n).map(|_| rng.gen_range(-1.0..1.0)).collect();
        for k in 0..mi {
            let a: Vec<f64> = (0..n).map(|_| f64::from(rng.gen_range(-1..=1))).collect();
            let size = rng.gen_range(0.1..10.0);
            let row: Vec<f64> = a.iter().map(|a| a * size).collect();
            let at = dot(&row, &point);
            if k < 4 {
                p.equalities.push_row(at).copy_from_slice(&row);
            }
            p.inequalities.push_row(at).copy_from_slice(&row);
            if k % 3 == 0 {
                let opposed: Vec<f64> = row.iter().map(|a| -3.0 * a).collect();
                p.inequalities.push_row(-3.0 * at).copy_from_slice(&opposed);
            }
        }
        let mut s = ActiveSet::new(n, 4, mi + 20);
        assert_eq!(s.solve(&p), Outcome::Optimal, "trial {trial}");
        let residual = kkt(&p, &s);
        worst = worst.max(residual);
        assert!(residual < 1e-8, "trial {trial}: {residual}");
    }
    println!("kkt {worst:e}");
}

/// Rows through one point that differ from one another by 1e-14 to 1e-5.
#[test]
fn nearly_dependent_rows() {
    let mut rng = ChaCha8Rng::seed_from_u64(11);
    let (mut worst, mut most, mut others) = (0.0_f64, 0, 0);
    for _ in 0..5000 {
        let n = rng.gen_range(2..22);
        let mut p = Problem::new(n, 2, 40);
        random_cost(&mut rng, &mut p, n, 1e-3);
        let point: Vec<f64> = (0..n).map(|_| rng.gen_range(-1.0..1.0)).collect();
        let noise = 10f64.powi(-rng.gen_range(5..15));
        let base: Vec<Vec<f64>> = (0..5)
            .map(|_| (0..n).map(|_| rng.gen_range(-1.0..1.0)).collect())
            .collect();
        for k in 0..42 {
            let mut row = base[k % 5].clone();
            row.iter_mut()
                .for_each(|a| *a += noise * rng.gen_range(-1.0..1.0));
            let at = dot(&row, &point);
            let rows = if k < 2 {
                &mut p.equalities
            } else {
                &mut p.inequalities
            };
            rows.push_row(at).copy_from_slice(&row);
        }
        let mut s = ActiveSet::new(n, 2, 40);
        if s.solve(&p) == Outcome::Optimal {
            worst = worst.max(kkt(&p, &s));
        } else {
            others += 1;
        }
        most = most.max(s.iterations());
    }
    println!("kkt {worst:e}, {others} not solved, steps {most}");
    // Few of these, whose feasible sets are hardly more than a point, are called infeasible.
    assert!(worst < 1e-7 && others <= 25);
}

/// Rows of coefficients ±a x within a narrow or empty gap.
#[test]
fn infeasible_pairs() {
    let mut rng = ChaCha8Rng::seed_from_u64(4);
    for _ in 0..500 {
        let n = rng.gen_range(2..25);
        for (gap, expected) in [(1e-4, Outcome::Optimal), (-1e-4, Outcome::Infeasible)] {
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
        assert_eq!(s.solve(&p), Outcome::Optimal, "trial {trial}");
        assert!(kkt(&p, &s) < 1e-8);
        p.equalities
            .push_row(rhs + 1e-3 * norm(&mix))
            .copy_from_slice(&mix);
        assert_eq!(s.solve(&p), Outcome::Infeasible, "trial {trial}");
    }
}

#[test]
fn closed_form() {
    // The point of x + y = 2, x ≤ 1/2 nearest to (2, 1).
    let mut p = Problem::new(2, 1, 1);
    (p.h[0], p.h[3], p.g[0], p.g[1]) = (1.0, 1.0, -2.0, -1.0);
    p.equalities.push_row(2.0).fill(1.0);
    p.inequalities.push_row(-0.5)[0] = -1.0;
    let mut s = ActiveSet::new(2, 1, 1);
    assert_eq!(s.solve(&p), Outcome::Optimal);
    assert!((s.x()[0] - 0.5).abs() < 1e-14 && (s.x()[1] - 1.5).abs() < 1e-14);
    assert!((s.equality_multipliers()[0] - 0.5).abs() < 1e-14);
    assert!((s.inequality_multipliers()[0] - 2.0).abs() < 1e-14);
    assert_eq!(s.iterations(), 2);
}

#[test]
fn invalid_input_is_refused() {
    let mut rng = ChaCha8Rng::seed_from_u64(6);
    let n = 8;
    let mut p = Problem::new(n, 2, 10);
    random_cost(&mut rng, &mut p, n, 1e-2);
    random_rows(&mut rng, &mut p, 2, 10, (0.0, 0.5));
    let mut s = ActiveSet::new(n, 2, 10);
    assert_eq!(s.solve(&p), Outcome::Optimal);
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
                    Outcome::NotConvex
                } else {
                    Outcome::Infeasible
                };
                assert_eq!(outcome, expected, "{bad} at {place}");
            }
        }
    }
    p.h[3] = 100.0;
    assert_eq!(s.solve(&p), Outcome::NotConvex);
    p.clear();
    assert_eq!(s.solve(&p), Outcome::NotConvex);
    for i in 0..n - 1 {
        p.h[i * n + i] = 1.0;
    }
    assert_eq!(s.solve(&p), Outcome::NotConvex);
    p.h.pop();
    assert_eq!(s.solve(&p), Outcome::NotConvex);
    p.n = usize::MAX;
    assert_eq!(s.solve(&p), Outcome::NotConvex);
    let mut empty = Problem::new(0, 1, 1);
    assert_eq!(s.solve(&empty), Outcome::Optimal);
    empty.inequalities.push_row(1.0);
    assert_eq!(s.solve(&empty), Outcome::Infeasible);
    // Singular H of random rows.
    for _ in 0..200 {
        let mut p = Problem::new(12, 0, 0);
        random_cost(&mut rng, &mut p, 9, 0.0);
        assert_eq!(ActiveSet::new(12, 0, 0).solve(&p), Outcome::NotConvex);
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
        if s.solve(&p) == Outcome::Optimal {
            assert!(s.x().iter().all(|x| x.is_finite()));
        }
    }
}

#[test]
fn solves_without_allocation_and_without_memory() {
    let mut rng = ChaCha8Rng::seed_from_u64(8);
    let (n, me, mi) = (21, 3, 34);
    let mut p = Problem::new(n, me, mi);
    let mut s = ActiveSet::new(n, me, mi);
    for _ in 0..300 {
        (p, s) = (p.clone(), s.clone());
        p.clear();
        random_cost(&mut rng, &mut p, n, 1e-3);
        random_rows(&mut rng, &mut p, me, mi, (-0.02, 0.3));
        // A clone keeps the room: filling it and solving with it allocates nothing.
        let mut again = None;
        let cloning = measure(|| again = Some((p.clone(), s.clone())));
        assert!(cloning.count_total > 0);
        let (mut q, mut t) = again.unwrap();
        let filling = measure(|| {
            q.clear();
            q.equalities.push_row(0.0);
            q.inequalities.push_row(0.0);
        });
        assert_eq!(filling.count_total, 0);
        let mut outcomes = [Outcome::IterationLimit; 2];
        let solving = measure(|| outcomes = [s.solve(&p), t.solve(&p)]);
        assert_eq!(solving.count_total, 0);
        let [outcome, cloned] = outcomes;
        assert_eq!(outcome, cloned);
        let mut fresh = ActiveSet::new(n, me, mi);
        assert_eq!(fresh.solve(&p), outcome);
        let bits = |s: &ActiveSet| s.x().iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&fresh), bits(&s));
        assert_eq!(bits(&t), bits(&s));
    }
}
