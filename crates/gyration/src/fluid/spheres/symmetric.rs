//! Symmetric positive definite matrices of any size, row by row: their inverse by Cholesky's factors.
//!
//! Plain loops in a fixed order, so that the same digits come out on every machine.

/// A square matrix.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Square {
    size: usize,
    entries: Vec<f64>,
}

impl Square {
    /// Becomes zeros of so many rows.
    pub fn clear(&mut self, size: usize) {
        self.size = size;
        self.entries.clear();
        self.entries.resize(size * size, 0.0);
    }

    pub fn row(&self, row: usize) -> &[f64] {
        &self.entries[row * self.size..(row + 1) * self.size]
    }

    pub fn at(&self, row: usize, column: usize) -> f64 {
        self.entries[row * self.size + column]
    }

    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        self.entries[row * self.size + column] += value;
    }

    /// A x.
    pub fn image(&self, x: &[f64]) -> Vec<f64> {
        (0..self.size).map(|row| dot(self.row(row), x)).collect()
    }

    /// Becomes its inverse; false if it is not positive definite.
    #[must_use]
    pub fn invert(&mut self) -> bool {
        let n = self.size;
        // A = L Lᵀ in the lower half.
        for i in 0..n {
            for j in 0..=i {
                let known = dot(&self.row(i)[..j], &self.row(j)[..j]);
                let left = self.at(i, j) - known;
                self.entries[i * n + j] = match i == j {
                    true if left > 0.0 => left.sqrt(),
                    true => return false,
                    false => left / self.at(j, j),
                };
            }
        }
        // K = L⁻¹, column by column, in the upper half: (j, i) holds K_ij.
        for j in 0..n {
            let first = 1.0 / self.at(j, j);
            let mut column = vec![first];
            for i in j + 1..n {
                let sum = dot(&self.row(i)[j..i], &column);
                column.push(-sum / self.at(i, i));
            }
            self.entries[j * n + j..(j + 1) * n].copy_from_slice(&column);
            // The diagonal of L is asked for no more: row j of it is behind.
        }
        // A⁻¹ = KᵀK, of which row j of the upper half has the column j of K.
        for i in 0..n {
            for j in 0..=i {
                self.entries[i * n + j] = dot(&self.row(i)[i..], &self.row(j)[i..]);
            }
        }
        for i in 0..n {
            for j in 0..i {
                self.entries[j * n + i] = self.at(i, j);
            }
        }
        true
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
