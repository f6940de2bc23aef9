//! Problems that are hard on the numbers: by the KKT conditions alone.

use aplomb_controllers::momentum::quadratic_program::{ActiveSet, Problem, Solution};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::{dot, kkt, norm, random_cost, random_rows};

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
        assert_eq!(s.solve(&p), Solution::Optimal, "trial {trial}");
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
        assert_eq!(s.solve(&p), Solution::Optimal, "trial {trial}");
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
        assert_eq!(s.solve(&p), Solution::Optimal, "trial {trial}");
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
        assert_eq!(s.solve(&p), Solution::Optimal, "trial {trial}");
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
        if s.solve(&p) == Solution::Optimal {
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
