//! The contraction of a body as a state of first order beside its small motions.
//!
//!   z̈ = −K z − C ż + B γ,   γ̇ = D z + E ż + H γ,   δG = (Σ γ_k A_k + ⅓ tr(P⁻¹ δP) 1) G
//!
//! A_k are orthonormal strains and turns of the relaxed shape: six and three, less the breath where det G is kept or
//! follows det P (then the second term stands), less the turns where V_G is symmetric.

use super::coordinates::Coordinates;
use gyration::body::{Body, Slots, matrix};
use gyration::contractile::Spin;
use gyration::tensor::{Mat3, Vec3};
use nalgebra::{DMatrix, DVector};

/// The coordinates γ at a configuration.
#[derive(Debug, Clone)]
pub(super) struct ContractionCoordinates {
    /// A_k.
    strains: Vec<Mat3>,
    turns: Vec<bool>,
    /// ∂(numbers of G) by the numbers of the places: what follows det P.
    follows: DMatrix<f64>,
    contraction: Mat3,
    inverse: Mat3,
}

impl ContractionCoordinates {
    /// Of a body whose contraction moves, at its own numbers.
    pub fn at(body: &Body, block: &[f64]) -> Option<Self> {
        let law = body.contraction().filter(|law| law.is_driven())?;
        let slots = Slots::of(body, 0);
        let attitude = slots.attitude();
        let contraction = matrix(&block[slots.extra()]);
        let inverse = contraction.try_inverse()?;
        let keeps_volume = law.kept_volume.is_some();
        let incompressible = body.affine().is_some_and(|affine| affine.interior.is_incompressible());
        let breath = (!keeps_volume && !incompressible).then(|| Mat3::identity() / 3.0_f64.sqrt());
        let turns = if law.spin == Spin::Full { turns().to_vec() } else { Vec::new() };
        let mut follows = DMatrix::zeros(9, attitude.end);
        if incompressible && !keeps_volume {
            let slope = matrix(&block[attitude.clone()]).try_inverse()?.transpose() / 3.0;
            let change = DVector::from_column_slice(contraction.as_slice())
                * DVector::from_column_slice(slope.as_slice()).transpose();
            follows.columns_mut(attitude.start, 9).copy_from(&change);
        }
        let kinds = [false; 5].into_iter().chain(breath.map(|_| false)).chain(turns.iter().map(|_| true)).collect();
        let strains = shears_and_stretches().into_iter().chain(breath).chain(turns).collect();
        Some(Self { strains, turns: kinds, follows, contraction, inverse })
    }

    /// How many γ there are.
    pub fn count(&self) -> usize {
        self.strains.len()
    }

    /// Which of them only turn the relaxed shape.
    pub fn turns(&self) -> &[bool] {
        &self.turns
    }

    /// ∂(numbers of G)/∂γ.
    pub fn columns(&self) -> DMatrix<f64> {
        let columns = self.strains.iter().map(|strain| (strain * self.contraction).as_slice().to_vec());
        DMatrix::from_vec(9, self.strains.len(), columns.flatten().collect())
    }

    /// γ̇ by the numbers of Ġ: A_k·(Ġ G⁻¹).
    pub fn rows(&self) -> DMatrix<f64> {
        let rows = self.strains.iter().map(|strain| strain * self.inverse.transpose());
        DMatrix::from_vec(9, self.strains.len(), rows.flat_map(|row| row.as_slice().to_vec()).collect()).transpose()
    }

    /// γ̇ of a V_G [1/s].
    pub fn along(&self, velocity: &Mat3) -> DVector<f64> {
        DVector::from_iterator(self.strains.len(), self.strains.iter().map(|strain| strain.dot(velocity)))
    }

    /// Σ γ_k A_k.
    pub fn strain(&self, along: &DVector<f64>) -> Mat3 {
        self.strains.iter().zip(along.iter()).map(|(strain, along)| strain * *along).sum()
    }

    /// The change of the numbers of G with z: what follows det P.
    pub fn follows(&self, places: &Coordinates) -> DMatrix<f64> {
        &self.follows * places.places()
    }

    /// What δV_G = (δĠ − V_G δG) G⁻¹ takes off the derivative of Ġ by G.
    pub fn carried(velocity: &Mat3) -> DMatrix<f64> {
        DMatrix::<f64>::identity(3, 3).kronecker(&DMatrix::from_column_slice(3, 3, velocity.as_slice()))
    }

    /// Moves G of a block along z and γ.
    pub fn advance(&self, block: &mut [f64], (places, z): (&Coordinates, &DVector<f64>), strains: &DVector<f64>) {
        let change = self.columns() * strains + &self.follows * (places.places() * z);
        let at = block.len() - 9;
        block[at..].iter_mut().zip(change.iter()).for_each(|(number, change)| *number += change);
    }
}

/// Orthonormal symmetric matrices without trace, in the order of the patterns of the body.
fn shears_and_stretches() -> [Mat3; 5] {
    let unit = |k: usize| Vec3::ith(k, 1.0);
    let shear = |i: usize, j: usize| (unit(i) * unit(j).transpose() + unit(j) * unit(i).transpose()) / 2.0_f64.sqrt();
    let along = |k: usize| unit(k) * unit(k).transpose();
    let stretch = (3.0 * along(2) - Mat3::identity()) / 6.0_f64.sqrt();
    let across = (along(0) - along(1)) / 2.0_f64.sqrt();
    [shear(0, 1), shear(0, 2), shear(1, 2), stretch, across]
}

/// Orthonormal antisymmetric matrices.
fn turns() -> [Mat3; 3] {
    [0, 1, 2].map(|k| gyration::tensor::cross_matrix(&Vec3::ith(k, 1.0)) / 2.0_f64.sqrt())
}
