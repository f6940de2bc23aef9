//! Times of one solve.
use aplomb_controllers::momentum::quadratic_program::{ActiveSet, Problem, Solution};
use divan::{Bencher, black_box};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

fn main() {
    divan::main();
}

/// A problem of `n` variables, 3 equalities, `rows` inequalities, and at least `active` steps
/// for them.
fn problem(n: usize, rows: usize, active: usize) -> Problem {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let mut solver = ActiveSet::new(n, 3, rows);
    loop {
        let mut p = Problem::new(n, 3, rows);
        for _ in 0..n {
            let a: Vec<f64> = (0..n).map(|_| rng.gen_range(-1.0..1.0)).collect();
            for i in 0..n {
                for j in 0..n {
                    p.h[i * n + j] += a[i] * a[j];
                }
            }
        }
        for i in 0..n {
            p.h[i * n + i] += 0.1;
            p.g[i] = rng.gen_range(-1.0..1.0);
        }
        let slack = rng.gen_range(0.0..2.0);
        for _ in 0..3 {
            let rhs = rng.gen_range(-0.3..0.3);
            p.equalities
                .push_row(rhs)
                .fill_with(|| rng.gen_range(-1.0..1.0));
        }
        for _ in 0..rows {
            p.inequalities
                .push_row(-slack)
                .fill_with(|| rng.gen_range(-1.0..1.0));
        }
        if solver.solve(&p) == Solution::Optimal && solver.iterations() == 3 + active {
            return p;
        }
    }
}

fn time(bencher: Bencher, n: usize, rows: usize, active: usize) {
    let p = problem(n, rows, active);
    let mut solver = ActiveSet::new(n, 3, rows);
    bencher.bench_local(|| black_box(solver.solve(black_box(&p))));
}

#[divan::bench(args = [0, 3, 6], sample_size = 200)]
fn n21_rows34(bencher: Bencher, active: usize) {
    time(bencher, 21, 34, active);
}

#[divan::bench(args = [0, 3, 6, 10], sample_size = 200)]
fn n31_rows50(bencher: Bencher, active: usize) {
    time(bencher, 31, 50, active);
}
