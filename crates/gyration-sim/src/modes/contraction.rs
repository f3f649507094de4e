//! The contraction of a body as a state of first order beside its small motions.
//!
//!   z̈ = −K z − C ż + B γ,   γ̇ = D z + E ż + H γ,   δG = (Σ γ_k A_k + ⅓ tr(P⁻¹ δP) 1) G
//!
//! A_k are orthonormal strains and turns of the relaxed shape: six and three, less the breath where det G is kept or
//! follows det P (then the second term stands), less the turns where V_G is symmetric.

use super::coordinates::Coordinates;
use super::frozen::FrozenSystem;
use super::system::SystemCoordinates;
use gyration::Inadmissible;
use gyration::body::{Body, Slots, matrix};
use gyration::contractile::Spin;
use gyration::tensor::{Mat3, Vec3};
use gyration_threads::Interruption;
use nalgebra::{DMatrix, DVector};

/// Newton's steps to a state in which the contraction stands still, at most.
const MOST: usize = 60;
/// The most that a step may strain body or relaxed shape.
const LARGEST_STRAIN: f64 = 0.2;
/// Halvings of a step that leaves the model, at most.
const HALVINGS: usize = 40;
/// Singular values below this part of the largest are those of directions that nothing feels.
const NEUTRAL: f64 = 1e-10;
/// Singular values below this part of the largest are those of weak directions.
const WEAK: f64 = 1e-4;
/// Along weak directions, forces below this part of the largest of the search are rounding, which chooses no way.
const NO_FORCE: f64 = 1e-9;
/// Steps smaller than this are the last, once they no longer halve.
const SMALL: f64 = 1e-8;
/// A contraction stands still if it would take this strain to stop it.
const STILL: f64 = 1e-8;

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

/// The state next to some numbers in which bodies and contractions stand still.
///
///   K z − B γ = r,   −D z − H γ = V_G
///
/// by Newton's method; directions that nothing feels are left alone. None where a contraction goes on, or nobody waits
/// any longer.
pub(super) fn settled(frozen: &mut FrozenSystem, start: Vec<f64>) -> Result<Option<Vec<f64>>, Inadmissible> {
    let (mut numbers, mut last, mut largest) = (start, f64::INFINITY, 0.0);
    for _ in (0..MOST).take_while(|_| Interruption::due().is_none()) {
        let coordinates = SystemCoordinates::at(frozen, &numbers);
        let rates = frozen.rates(&numbers)?;
        let force = coordinates.force(&rates);
        let speeds = coordinates.contraction_velocities(frozen, &numbers, &rates);
        let velocity = coordinates.along(&speeds);
        let (stiffness, first) = coordinates.first_order(&speeds, &frozen.slopes(&numbers)?);
        let (size, own) = (force.len(), velocity.len());
        let mut system = DMatrix::zeros(size + own, size + own);
        system.view_mut((0, 0), (size, size)).copy_from(&stiffness);
        system.view_mut((0, size), (size, own)).copy_from(&-first.forces);
        system.view_mut((size, 0), (own, size)).copy_from(&-first.by_place);
        system.view_mut((size, size), (own, own)).copy_from(&-&first.own);
        let right = DVector::from_iterator(size + own, force.iter().chain(velocity.iter()).copied());
        let Some(step) = least_squares(system, right, size, &mut largest) else { return Ok(None) };
        let (mut z, mut strains) = (step.rows(0, size).into_owned(), step.rows(size, own).into_owned());
        let gaps = frozen.gaps(&numbers);
        let shapes = coordinates.shapes(frozen, &z);
        let strain = shapes.iter().enumerate().map(|(body, shape)| {
            let length = gaps[body].iter().copied().fold(frozen.bodies()[body].size, f64::min);
            (shape.translation.norm() / length).max((shape.gradient * frozen.inverse(&numbers, body)).norm())
        });
        let strain = strain.fold(0.0, f64::max).max(strains.norm());
        if strain == 0.0 || (strain <= SMALL && strain > 0.5 * last) {
            let stands = velocity.norm() <= STILL * first.own.norm().max(first.by_rate.norm());
            return Ok(stands.then_some(numbers));
        }
        if !strain.is_finite() {
            return Ok(None);
        }
        last = strain;
        let cut = (LARGEST_STRAIN / strain).min(1.0);
        (z, strains) = (z * cut, strains * cut);
        let mut part = 1.0;
        let ahead = (0..HALVINGS).find_map(|_| {
            let mut ahead = numbers.clone();
            coordinates.advance(&mut ahead, &(part * &z), &(part * &strains));
            frozen.project(&mut ahead);
            part *= 0.5;
            frozen.rates(&ahead).is_ok().then_some(ahead)
        });
        let Some(ahead) = ahead else { return Ok(None) };
        numbers = ahead;
    }
    Ok(None)
}

/// The shortest solution of A x = b, the first `size` equations and unknowns those of the body, in units in which body
/// and contraction act on each other as strongly; `most` is the largest |b| of the search.
fn least_squares(
    mut matrix: DMatrix<f64>,
    mut right: DVector<f64>,
    size: usize,
    most: &mut f64,
) -> Option<DVector<f64>> {
    let own = right.len() - size;
    let ratio = |one: f64, other: f64| if one > 0.0 && other > 0.0 { one / other } else { 1.0 };
    let stiffness = matrix.view((0, 0), (size, size)).norm();
    let unit = ratio(stiffness, matrix.view((0, size), (size, own)).norm());
    matrix.columns_mut(size, own).scale_mut(unit);
    let weight = ratio(stiffness, matrix.rows(size, own).norm());
    matrix.rows_mut(size, own).scale_mut(weight);
    right.rows_mut(size, own).scale_mut(weight);
    let svd = matrix.try_svd(true, true, f64::EPSILON, 10_000)?;
    *most = right.norm().max(*most);
    let stiffest = svd.singular_values.max();
    let along = svd.u.as_ref()?.tr_mul(&right);
    let parts = along.zip_map(&svd.singular_values, |along, value| {
        let is_felt = value > WEAK * stiffest || (value > NEUTRAL * stiffest && along.abs() > NO_FORCE * *most);
        if is_felt { along / value } else { 0.0 }
    });
    let mut solved = svd.v_t.as_ref()?.tr_mul(&parts);
    solved.rows_mut(size, own).scale_mut(unit);
    Some(solved)
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
