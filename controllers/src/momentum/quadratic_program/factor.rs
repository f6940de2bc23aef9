//! The factors J and R of the active normals and the directions that they give, kept as normals
//! enter and leave.
//!
//! H → J; a normal n → d = Jᵀ n → directions z of x and r of the multipliers.
use aplomb_framework::math::hypot;

/// Relative length below which a normal's free part is taken to be zero.
const DEPENDENT: f64 = 1e-9;
/// Relative rounding level of Jᵀ n and of r = R⁻¹ Jᵀ n.
pub(super) const ROUNDING: f64 = 1e-13;

/// J = L⁻ᵀ Q and the upper triangle R such that Jᵀ N = [R; 0], with H = L Lᵀ and N the active
/// normals. J₂ are the columns of J beyond those of R, d₁ and d₂ the parts of d in that order.
#[derive(Debug)]
pub(super) struct Factor {
    n: usize,
    /// Upper Cholesky factor of H; scratch while J is formed.
    cholesky: Vec<f64>,
    /// Jᵀ row-major: row i is column i of J.
    j: Vec<f64>,
    /// Frobenius norm of J.
    j_norm: f64,
    /// R by columns of stride n.
    r_factor: Vec<f64>,
    /// Number of columns of R: of active normals.
    columns: usize,
    /// d = Jᵀ n for the entering normal n.
    d: Vec<f64>,
    /// Primal direction z = J₂ d₂.
    pub(super) z: Vec<f64>,
    /// Negative dual direction r = R⁻¹ d₁.
    pub(super) r: Vec<f64>,
}

impl Factor {
    /// Room for `n` variables.
    pub(super) fn new(n: usize) -> Self {
        Self {
            n,
            cholesky: vec![0.0; n * n],
            j: vec![0.0; n * n],
            j_norm: 0.0,
            r_factor: vec![0.0; n * n],
            columns: 0,
            d: vec![0.0; n],
            z: vec![0.0; n],
            r: vec![0.0; n],
        }
    }

    /// Forms J = L⁻ᵀ by eliminating H and the identity together; false unless H is positive
    /// definite.
    pub(super) fn factorise(&mut self, h: &[f64]) -> bool {
        let n = self.n;
        self.columns = 0;
        self.cholesky.copy_from_slice(h);
        self.j.fill(0.0);
        for k in 0..n {
            let (above, below) = self.cholesky.split_at_mut((k + 1) * n);
            let row = &mut above[k * n + k..];
            let pivot = row[0];
            if !(pivot > 2.0 * n as f64 * f64::EPSILON * h[k * n + k] && pivot.is_finite()) {
                return false;
            }
            let inverse = 1.0 / pivot.sqrt();
            scale(row, inverse);
            let (j_above, j_below) = self.j.split_at_mut((k + 1) * n);
            let j_row = &mut j_above[k * n..k * n + k + 1];
            j_row[k] = 1.0;
            scale(j_row, inverse);
            let rows = below.chunks_exact_mut(n).zip(j_below.chunks_exact_mut(n));
            for (i, (other, j_other)) in rows.enumerate() {
                let l = -row[i + 1];
                add_scaled(&mut other[k + 1 + i..], l, &row[i + 1..]);
                add_scaled(&mut j_other[..=k], l, j_row);
            }
        }
        self.j_norm = norm(&self.j);
        self.j_norm.is_finite()
    }

    /// Moves x from 0 to the unconstrained minimiser −J Jᵀ g.
    pub(super) fn minimise(&self, g: &[f64], x: &mut [f64]) {
        for (i, row) in self.j.chunks_exact(self.n.max(1)).enumerate() {
            let t = dot(&row[..=i], &g[..=i]);
            add_scaled(&mut x[..=i], -t, &row[..=i]);
        }
    }

    /// d = Jᵀ n.
    pub(super) fn transform(&mut self, row: &[f64], weight: f64) {
        for (d, j) in self.d.iter_mut().zip(self.j.chunks_exact(self.n.max(1))) {
            *d = weight * dot(j, row);
        }
    }

    /// r = R⁻¹ d₁ and, unless the normal depends on the active ones, z = J₂ d₂ and |d₂|.
    pub(super) fn direct(&mut self) -> Option<f64> {
        let (n, q) = (self.n, self.columns);
        let (d1, d2) = self.d.split_at(q);
        self.r[..q].copy_from_slice(d1);
        solve_upper(&self.r_factor, n, &mut self.r[..q]);
        let length = norm(d2);
        let independent = length > DEPENDENT * norm(d1) && length > ROUNDING * self.j_norm;
        if !independent {
            return None;
        }
        self.z.fill(0.0);
        for (d, j) in d2.iter().zip(self.j[q * n..].chunks_exact(n)) {
            add_scaled(&mut self.z, *d, j);
        }
        Some(length)
    }

    /// Adds the normal that d and z come from: reflects d₂ onto its first element, which joins R.
    pub(super) fn enter(&mut self, length: f64) {
        let (n, q) = (self.n, self.columns);
        let corner = -length.copysign(self.d[q]);
        let column = &mut self.r_factor[q * n..=q * n + q];
        column[..q].copy_from_slice(&self.d[..q]);
        column[q] = corner;
        // The reflection is I − v vᵀ / (length (length + |d|)), v = d₂ − corner e₁, J₂ v = w.
        let divisor = length * (length + self.d[q].abs());
        self.d[q] -= corner;
        let free = &mut self.j[q * n..];
        add_scaled(&mut self.z, -corner, &free[..n]);
        for (v, j) in self.d[q..].iter().zip(free.chunks_exact_mut(n)) {
            add_scaled(j, -v / divisor, &self.z);
        }
        self.columns += 1;
    }

    /// Drops the normal at position `k`; rotations restore R and carry d along.
    pub(super) fn leave(&mut self, k: usize) {
        let (n, q) = (self.n, self.columns);
        for i in k + 1..q {
            self.r_factor.copy_within(i * n..=i * n + i, (i - 1) * n);
        }
        for i in k..q - 1 {
            let (a, b) = (self.r_factor[i * n + i], self.r_factor[i * n + i + 1]);
            let length = hypot(a, b);
            let (c, s) = (a / length, b / length);
            for column in self.r_factor[i * n..(q - 1) * n].chunks_exact_mut(n) {
                (column[i], column[i + 1]) = rotate(c, s, column[i], column[i + 1]);
            }
            (self.d[i], self.d[i + 1]) = rotate(c, s, self.d[i], self.d[i + 1]);
            let (upper, lower) = self.j[i * n..(i + 2) * n].split_at_mut(n);
            for (a, b) in upper.iter_mut().zip(lower) {
                (*a, *b) = rotate(c, s, *a, *b);
            }
        }
        self.columns -= 1;
    }

    /// Corrects x and u by what the equations of the active set leave over: z = N u − g − H x and,
    /// in r, the residuals of the active constraints. Uses up d, z and r.
    pub(super) fn correct(&mut self, x: &mut [f64], u: &mut [f64]) {
        let (n, q) = (self.n, self.columns);
        // d = Jᵀ z; x gains J [y; d₂] and u gains R⁻¹ (y − d₁), where Rᵀ y = −residuals.
        for (d, j) in self.d.iter_mut().zip(self.j.chunks_exact(n.max(1))) {
            *d = dot(j, &self.z);
        }
        for k in 0..q {
            let column = &self.r_factor[k * n..=k * n + k];
            let y = (-self.r[k] - dot(&column[..k], &self.z[..k])) / column[k];
            self.z[k] = y;
            self.r[k] = y - self.d[k];
        }
        self.d[..q].copy_from_slice(&self.z[..q]);
        solve_upper(&self.r_factor, n, &mut self.r[..q]);
        add_scaled(u, 1.0, &self.r);
        for (d, j) in self.d.iter().zip(self.j.chunks_exact(n.max(1))) {
            add_scaled(x, *d, j);
        }
    }
}

/// Solves R r = b in place, R upper triangular by columns of stride `n`.
fn solve_upper(r_factor: &[f64], n: usize, b: &mut [f64]) {
    for k in (0..b.len()).rev() {
        let column = &r_factor[k * n..=k * n + k];
        let (rest, last) = b.split_at_mut(k);
        last[0] /= column[k];
        add_scaled(rest, -last[0], column);
    }
}

fn rotate(c: f64, s: f64, a: f64, b: f64) -> (f64, f64) {
    (c * a + s * b, c * b - s * a)
}

fn scale(a: &mut [f64], s: f64) {
    for a in a {
        *a *= s;
    }
}

/// a += s b over their common length.
#[inline]
pub(super) fn add_scaled(a: &mut [f64], s: f64, b: &[f64]) {
    for (a, b) in a.iter_mut().zip(b) {
        *a += s * b;
    }
}

/// Length.
#[inline]
pub(super) fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

/// Inner product in four partial sums.
#[inline]
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let ((a, a_rest), (b, b_rest)) = (a.as_chunks::<4>(), b.as_chunks::<4>());
    let mut sums = [0.0; 4];
    for (a, b) in a.iter().zip(b) {
        for ((sum, a), b) in sums.iter_mut().zip(a).zip(b) {
            *sum += a * b;
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum();
    (sums[0] + sums[2]) + (sums[1] + sums[3]) + rest
}
