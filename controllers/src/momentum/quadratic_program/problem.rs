//! A dense quadratic program as data: cost and linear constraint rows.
//!
//! momentum control → [`Problem`] → [`quadratic_program`](super). Room for the
//! rows is made once; filling them again allocates nothing.

/// Linear constraint rows: coefficients, row-major, and right-hand sides.
#[derive(Debug)]
pub struct Rows {
    n: usize,
    coefficients: Vec<f64>,
    rhs: Vec<f64>,
}

impl Rows {
    /// No rows of `n` coefficients, with room for `most` of them.
    pub fn new(n: usize, most: usize) -> Self {
        Self {
            n,
            coefficients: Vec::with_capacity(n * most),
            rhs: Vec::with_capacity(most),
        }
    }

    /// Removes all rows and keeps the room.
    pub fn clear(&mut self) {
        self.coefficients.clear();
        self.rhs.clear();
    }

    /// Appends a row of zeros with right-hand side `rhs` and returns its coefficients.
    /// Allocates only beyond the room given to [`Rows::new`].
    pub fn push_row(&mut self, rhs: f64) -> &mut [f64] {
        let start = self.coefficients.len();
        self.coefficients.resize(start + self.n, 0.0);
        self.rhs.push(rhs);
        &mut self.coefficients[start..]
    }

    /// Removes all rows from place `len` on.
    pub fn truncate(&mut self, len: usize) {
        self.coefficients.truncate(len * self.n);
        self.rhs.truncate(len);
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.rhs.len()
    }

    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.rhs.is_empty()
    }

    /// Coefficients of row `i`; panics unless `i < len()`.
    pub fn row(&self, i: usize) -> &[f64] {
        &self.coefficients[i * self.n..(i + 1) * self.n]
    }

    /// Right-hand side of row `i`; panics unless `i < len()`.
    pub fn rhs(&self, i: usize) -> f64 {
        self.rhs[i]
    }
}

/// A clone keeps the room.
impl Clone for Rows {
    fn clone(&self) -> Self {
        let mut rows = Self::new(self.n, self.rhs.capacity());
        rows.coefficients.extend_from_slice(&self.coefficients);
        rows.rhs.extend_from_slice(&self.rhs);
        rows
    }
}

/// Minimise ½ xᵀ H x + gᵀ x subject to E x = e and C x ≥ d.
#[derive(Debug, Clone)]
pub struct Problem {
    /// Number of variables.
    pub n: usize,
    /// H, `n`×`n` row-major, symmetric positive definite; only the upper triangle is read.
    pub h: Vec<f64>,
    /// g, the linear cost.
    pub g: Vec<f64>,
    /// E and e.
    pub equalities: Rows,
    /// C and d; a right-hand side of −∞ never binds.
    pub inequalities: Rows,
}

impl Problem {
    /// Zero H and g, and no rows, with room for the given numbers of rows.
    pub fn new(n: usize, most_equalities: usize, most_inequalities: usize) -> Self {
        Self {
            n,
            h: vec![0.0; n * n],
            g: vec![0.0; n],
            equalities: Rows::new(n, most_equalities),
            inequalities: Rows::new(n, most_inequalities),
        }
    }

    /// Sets H and g to zero and removes all rows.
    pub fn clear(&mut self) {
        self.h.fill(0.0);
        self.g.fill(0.0);
        self.equalities.clear();
        self.inequalities.clear();
    }

    /// Adds weight × (row·x − target)² / 2 to the cost; what the row is shorter by counts as 0.
    pub fn add_square(&mut self, row: &[f64], target: f64, weight: f64) {
        for (i, a) in row.iter().enumerate().filter(|(_, a)| **a != 0.0) {
            let wa = weight * a;
            for (h, b) in self.h[i * self.n..].iter_mut().zip(row) {
                *h += wa * b;
            }
            self.g[i] -= wa * target;
        }
    }

    /// Whether all sizes fit `n`.
    pub(crate) fn well_formed(&self) -> bool {
        self.n.checked_mul(self.n) == Some(self.h.len())
            && self.g.len() == self.n
            && self.equalities.n == self.n
            && self.inequalities.n == self.n
    }
}
