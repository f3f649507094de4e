//! Long waves: how fast those run whose frequency vanishes with k.
//!
//!   K(k n) = K₀ + k K₁ + k² K₂ + …,   ω²/k² the eigenvalues of Zᴴ(K₂ − K₁K₀⁺K₁)Z
//!
//! with the motions Z that K₀ does not oppose: translations of everything, and others that nothing holds. Where these
//! are more than translations, those with the greatest share of translation are meant.

use super::bloch::{BlochSystem, C64};
use super::eigenspaces::{hermitian, hermitian_eigen};
use super::wave::NoRoots;
use super::waves::NEUTRAL;
use super::{LatticeWaves, NoBands};
use gyration::tensor::Vec3;
use nalgebra::{DMatrix, DVector};
use serde::Serialize;

/// The speeds of long waves.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Sound {
    /// The unit vector along which they run.
    pub direction: [f64; 3],
    /// ω/k as k → 0, ascending [m/s]; none of a wave that grows.
    pub speed: Vec<Option<f64>>,
}

impl BlochSystem {
    /// ω²/k² of long waves along a unit vector [m²/s²], ascending; given the translations of everything.
    pub fn long_waves(&self, along: &Vec3, translations: &DMatrix<f64>) -> Result<Vec<f64>, NoRoots> {
        let origin = [0.0; 3];
        let eigen = hermitian_eigen(hermitian(self.wave(&origin).stiffness)).ok_or(NoRoots)?;
        let least = NEUTRAL * self.stiffest;
        let (free, held): (Vec<usize>, Vec<usize>) =
            (0..eigen.eigenvalues.len()).partition(|k| eigen.eigenvalues[*k].abs() <= least);
        if free.is_empty() {
            return Ok(Vec::new());
        }
        let columns = |chosen: &[usize]| -> DMatrix<C64> {
            let columns: Vec<DVector<C64>> =
                chosen.iter().map(|k| eigen.eigenvectors.column(*k).into_owned()).collect();
            DMatrix::from_fn(eigen.eigenvectors.nrows(), columns.len(), |i, j| columns[j][i])
        };
        let (space, across) = (columns(&free), columns(&held));
        let pushed = across.adjoint() * self.slope(&origin, along).stiffness * &space;
        let mut eased = pushed.clone();
        for (row, k) in held.iter().enumerate() {
            eased.row_mut(row).iter_mut().for_each(|entry| *entry /= eigen.eigenvalues[*k]);
        }
        let second = space.adjoint() * self.curvature(along).stiffness * C64::new(0.5, 0.0) * &space;
        let within = hermitian(second - pushed.adjoint() * eased);
        let waves = hermitian_eigen(within).ok_or(NoRoots)?;
        let shapes = space * &waves.eigenvectors;
        let moved = translations.map(|entry| C64::new(entry, 0.0)).adjoint() * shapes;
        let mut order: Vec<usize> = (0..waves.eigenvalues.len()).collect();
        order.sort_by(|a, b| moved.column(*b).norm_squared().total_cmp(&moved.column(*a).norm_squared()));
        let kept = translations.column_iter().filter(|column| column.norm() > 0.0).count();
        let mut squares: Vec<f64> = order.into_iter().take(kept).map(|k| waves.eigenvalues[k]).collect();
        squares.sort_by(f64::total_cmp);
        Ok(squares)
    }
}

impl LatticeWaves {
    /// The speeds of long waves along each reciprocal vector of what is periodic; none where something resists or
    /// drives.
    ///
    /// # Errors
    /// [`NoBands`].
    pub fn sound(&self, periodic: &[bool]) -> Result<Vec<Sound>, NoBands> {
        if !self.system.is_conservative {
            return Ok(Vec::new());
        }
        let reciprocal = self.lattice.reciprocal();
        let directions = reciprocal.iter().zip(periodic).filter(|(_, periodic)| **periodic);
        let sound = |direction: Vec3| {
            let squares = self.long_waves(&direction)?;
            let size = self.lattice.vectors().iter().map(Vec3::norm).fold(0.0, f64::max);
            let least = NEUTRAL * self.system.stiffest * size * size;
            let speed = |square: f64| match square {
                square if square.abs() <= least => Some(0.0),
                square => (square > 0.0).then(|| libm::sqrt(square)),
            };
            Ok(Sound { direction: direction.into(), speed: squares.into_iter().map(speed).collect() })
        };
        directions.map(|(vector, _)| sound(vector.normalize())).collect()
    }

    /// ω²/k² of long waves along a unit vector [m²/s²], ascending.
    pub(super) fn long_waves(&self, along: &Vec3) -> Result<Vec<f64>, NoBands> {
        let translations = DMatrix::from_columns(&self.coordinates.translations(&self.frozen));
        self.system.long_waves(along, &translations).map_err(|NoRoots| NoBands::Roots([0.0; 3]))
    }
}
