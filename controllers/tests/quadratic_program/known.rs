//! Problems with a known answer, and that solving them allocates and remembers nothing.

use allocation_counter::measure;
use aplomb_controllers::momentum::quadratic_program::{ActiveSet, Problem, Solution};
use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, SolverStatus, SupportedConeT::*};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::{dot, kkt, norm, random_cost, random_rows};

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

fn objective(p: &Problem, x: &[f64]) -> f64 {
    let hx: f64 = (0..p.n)
        .map(|i| x[i] * dot(&p.h[i * p.n..(i + 1) * p.n], x))
        .sum();
    0.5 * hx + dot(&p.g, x)
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
                assert_eq!(outcome, Solution::Infeasible, "trial {trial}");
                infeasible += 1;
            }
            _ => {
                assert_eq!(outcome, Solution::Optimal, "trial {trial} {status:?}");
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

#[test]
fn closed_form() {
    // The point of x + y = 2, x ≤ 1/2 nearest to (2, 1).
    let mut p = Problem::new(2, 1, 1);
    (p.h[0], p.h[3], p.g[0], p.g[1]) = (1.0, 1.0, -2.0, -1.0);
    p.equalities.push_row(2.0).fill(1.0);
    p.inequalities.push_row(-0.5)[0] = -1.0;
    let mut s = ActiveSet::new(2, 1, 1);
    assert_eq!(s.solve(&p), Solution::Optimal);
    assert!((s.x()[0] - 0.5).abs() < 1e-14 && (s.x()[1] - 1.5).abs() < 1e-14);
    assert!((s.equality_multipliers()[0] - 0.5).abs() < 1e-14);
    assert!((s.inequality_multipliers()[0] - 2.0).abs() < 1e-14);
    assert_eq!(s.iterations(), 2);
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
        let mut outcomes = [Solution::IterationLimit; 2];
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
