//! Coordinates of one body's small motions along which its mass is one.
//!
//!   T = ½ |ż|²,   δ(places) = S z,   δ(velocities) = V ż,   z̈ = V† v̇,   V = M^−½, V† = M^½
//!
//! with M the mass of the velocities' numbers: m and J ⊗ 1 of (ṗ₀ | Ṗ), m and I of (ṗ₀ | Ω). So accelerations are
//! forces, and −V† (∂v̇/∂q) S, −V† (∂v̇/∂v) V are stiffness and resistance. Of a rigid body S takes δθ to the
//! quaternion, δq = ½ q ∘ (0, δθ): what is left out is its length, a gauge. An incompressible body moves within tr(P⁻¹
//! δP) = 0: V is multiplied by a basis of that plane. A guide leaves the image of M^½ Π M^−½, which is multiplied in
//! the same way.

use super::shape::ModeShape;
use gyration::body::{Body, BodyKind, Slots};
use gyration::contractile::Contraction;
use gyration::kinematics::Quaternion;
use gyration::state::BodyMotion;
use gyration::tensor::{Mat3, Vec3, axial, cofactor, cross_matrix};
use nalgebra::{DMatrix, DVector};

/// Whether det G follows det P of an incompressible material: the law of contraction gives the pressure.
fn takes_up_volume(contraction: &Contraction) -> bool {
    contraction.is_driven() && contraction.kept_volume.is_none()
}

/// The maps between z and the numbers of the state.
#[derive(Debug, Clone)]
pub(super) struct Coordinates {
    /// S.
    places: DMatrix<f64>,
    /// V.
    rates: DMatrix<f64>,
    /// V†.
    weights: DMatrix<f64>,
    /// P.
    gradient: Mat3,
}

impl Coordinates {
    /// At a configuration of the body; an incompressible one whose contraction takes up what volume it has moves
    /// freely.
    pub fn at(body: &Body, block: &[f64]) -> Self {
        let mass = mass(body);
        let eigen = mass.symmetric_eigen();
        let power = |exponent: f64| {
            let values = DMatrix::from_diagonal(&eigen.eigenvalues.map(|value| libm::pow(value, exponent)));
            &eigen.eigenvectors * values * eigen.eigenvectors.transpose()
        };
        let root = libm::sqrt(body.solid.mass.mass);
        let (mut rates, mut weights) = match body.is_point() {
            false => (power(-0.5), power(0.5)),
            // A point has no turns.
            true => (DMatrix::identity(6, 3) / root, DMatrix::identity(3, 6) * root),
        };
        if let Some(within) = body.guided_velocities() {
            let space = image(&weights * within * &rates);
            (rates, weights) = (rates * &space, space.transpose() * weights);
        }
        let gradient = BodyMotion::read(body, &Slots::of(body, 0), block).placement.gradient;
        let keeps_volume = body.affine().is_some_and(|affine| affine.interior.is_incompressible());
        if keeps_volume && !body.contraction().is_some_and(takes_up_volume) {
            let plane = plane_across(&(rates.transpose() * volume_slope(&gradient, rates.nrows())));
            (rates, weights) = (rates * &plane, plane.transpose() * weights);
        }
        let places = match &body.kind {
            BodyKind::Affine(_) | BodyKind::Contractile(_) => rates.clone(),
            BodyKind::Rigid(_) => quaternion_by_turn(body, block) * &rates,
        };
        Self { places, rates, weights, gradient }
    }

    /// z̈ of accelerations.
    pub fn force(&self, accelerations: &[f64]) -> DVector<f64> {
        &self.weights * DVector::from_column_slice(accelerations)
    }

    /// K [1/s²] along z of another body, or of this one, from the block of the Jacobian with these rates and its
    /// numbers.
    pub fn stiffness(&self, by: &Self, slopes: &DMatrix<f64>) -> DMatrix<f64> {
        let (rows, above, columns) = (self.rates.nrows(), self.places.nrows(), by.places.nrows());
        -(&self.weights * slopes.view((above, 0), (rows, columns)) * &by.places)
    }

    /// S.
    pub fn places(&self) -> &DMatrix<f64> {
        &self.places
    }

    /// V.
    pub fn rates(&self) -> &DMatrix<f64> {
        &self.rates
    }

    /// V†.
    pub fn weights(&self) -> &DMatrix<f64> {
        &self.weights
    }

    /// C [1/s] in the same way.
    pub fn resistance(&self, by: &Self, slopes: &DMatrix<f64>) -> DMatrix<f64> {
        let [own, other] = [self, by].map(|at| (at.places.nrows(), at.rates.nrows()));
        -(&self.weights * slopes.view((own.0, other.0), (own.1, other.1)) * &by.rates)
    }

    /// How many z there are.
    pub fn count(&self) -> usize {
        self.rates.ncols()
    }

    /// The sizes of the numbers of places along z: those of P, and of a centre with a length beyond its cell.
    pub fn sizes(&self, body: &Body, block: &[f64], beyond: f64) -> DVector<f64> {
        let center = Slots::of(body, 0).position();
        let sizes = DVector::from_fn(self.rates.nrows(), |row, _| match &body.kind {
            _ if row < center.len() => block[center.start + row].abs() + beyond,
            BodyKind::Rigid(_) => 1.0,
            BodyKind::Affine(_) | BodyKind::Contractile(_) => self.gradient.amax(),
        });
        self.weights.abs() * sizes
    }

    /// By how much the mass along z is not one.
    pub fn mass_error(&self, body: &Body) -> f64 {
        let mass = self.rates.tr_mul(&(mass(body) * &self.rates));
        let one = DMatrix::identity(mass.nrows(), mass.ncols());
        (mass - one).norm()
    }

    /// Moves the places of a block along z.
    pub fn advance(&self, block: &mut [f64], z: &DVector<f64>) {
        let change = &self.places * z;
        block.iter_mut().zip(change.iter()).for_each(|(number, change)| *number += change);
    }

    /// δp₀ and δP along z.
    pub fn shape(&self, body: &Body, z: &DVector<f64>) -> ModeShape {
        let numbers = &self.rates * z;
        let numbers = numbers.as_slice();
        let (center, own) = numbers.split_at(Slots::of(body, 0).position().len());
        let gradient = match &body.kind {
            BodyKind::Affine(_) | BodyKind::Contractile(_) => Mat3::from_column_slice(own),
            BodyKind::Rigid(_) => self.gradient * cross_matrix(&Vec3::from_column_slice(own)),
        };
        let translation = match &body.pin {
            None => Vec3::from_column_slice(center),
            Some(pin) => -(gradient * pin.point),
        };
        ModeShape { translation, gradient }
    }

    /// Motions that have a name, as unit vectors of z: translations along the axes, turns about them, shears in the
    /// planes between them, stretches along them, a breath. Those that the body cannot make are zero.
    pub fn patterns(&self, body: &Body, gradient: &Mat3) -> Vec<DVector<f64>> {
        let unit = |k: usize| Vec3::ith(k, 1.0);
        let still = Vec3::zeros();
        let translations = (0..3).map(|k| (unit(k), Mat3::zeros()));
        let turns = (0..3).map(|k| (still, cross_matrix(&unit(k))));
        let shear = |(i, j): (usize, usize)| unit(i) * unit(j).transpose() + unit(j) * unit(i).transpose();
        let shears = [(0, 1), (0, 2), (1, 2)].into_iter().map(|pair| (still, shear(pair)));
        let stretch = |k: usize| 3.0 * unit(k) * unit(k).transpose() - Mat3::identity();
        let stretches = [2, 0, 1].into_iter().map(|k| (still, stretch(k)));
        let breath = [(still, Mat3::identity())];
        let motions = translations.chain(turns).chain(shears).chain(stretches).chain(breath);
        motions.map(|(translation, spread)| self.pattern(body, &translation, &(spread * gradient))).collect()
    }

    /// z of a translation along an axis [√kg]; zero of a body that is pinned.
    pub fn translation(&self, body: &Body, axis: usize) -> DVector<f64> {
        self.moved(body, &Vec3::ith(axis, 1.0), &Mat3::zeros())
    }

    fn pattern(&self, body: &Body, translation: &Vec3, change: &Mat3) -> DVector<f64> {
        let z = self.moved(body, translation, change);
        let norm = z.norm();
        if norm > 0.0 { z / norm } else { z }
    }

    /// z of δp₀ and δP, as far as the body can take it.
    pub fn moved(&self, body: &Body, translation: &Vec3, change: &Mat3) -> DVector<f64> {
        let mut numbers = Vec::with_capacity(self.rates.nrows());
        if body.pin.is_none() {
            numbers.extend_from_slice(translation.as_slice());
        }
        match &body.kind {
            BodyKind::Affine(_) | BodyKind::Contractile(_) => numbers.extend_from_slice(change.as_slice()),
            BodyKind::Rigid(_) => {
                // What a rigid body can take of it: δP = R [δθ]×.
                let turn = 0.5 * axial(&self.gradient.tr_mul(change));
                numbers.extend_from_slice(turn.as_slice());
            }
        }
        &self.weights * DVector::from_vec(numbers)
    }
}

/// M: m of the centre, J ⊗ 1 of P column by column, or I of Ω; about the pin if there is one.
fn mass(body: &Body) -> DMatrix<f64> {
    let (own, repeat) = match &body.kind {
        BodyKind::Rigid(inertia) => (inertia.tensor, 1),
        BodyKind::Affine(affine) => (affine.interior.euler_tensor, 3),
        BodyKind::Contractile(contractile) => (contractile.affine.interior.euler_tensor, 3),
    };
    let own = DMatrix::from_column_slice(3, 3, own.as_slice()).kronecker(&DMatrix::identity(repeat, repeat));
    let center = Slots::of(body, 0).position().len();
    let size = center + own.nrows();
    let mut mass = DMatrix::from_diagonal_element(size, size, body.solid.mass.mass);
    mass.view_mut((center, center), own.shape()).copy_from(&own);
    mass
}

/// ∂(det P)/∂(numbers): cof P in the places of P.
fn volume_slope(gradient: &Mat3, size: usize) -> DVector<f64> {
    let mut slope = DVector::zeros(size);
    slope.rows_mut(size - 9, 9).copy_from_slice(cofactor(gradient).as_slice());
    slope
}

/// An orthonormal basis of the image of an orthogonal projector.
fn image(projector: DMatrix<f64>) -> DMatrix<f64> {
    let eigen = projector.symmetric_eigen();
    let kept: Vec<_> = (0..eigen.eigenvalues.len()).filter(|k| eigen.eigenvalues[*k] > 0.5).collect();
    eigen.eigenvectors.select_columns(&kept)
}

/// An orthonormal basis of the plane across a vector: all columns but the last of the reflection that takes it to the
/// last axis.
fn plane_across(normal: &DVector<f64>) -> DMatrix<f64> {
    let last = normal.len() - 1;
    let mut mirror = normal / normal.norm();
    mirror[last] += if mirror[last] < 0.0 { -1.0 } else { 1.0 };
    let scale = 2.0 / mirror.norm_squared();
    let reflection = DMatrix::identity(last + 1, last + 1) - scale * &mirror * mirror.transpose();
    reflection.columns(0, last).into_owned()
}

/// δ(p₀, q) by (δp₀, δθ).
fn quaternion_by_turn(body: &Body, block: &[f64]) -> DMatrix<f64> {
    let slots = Slots::of(body, 0);
    let at = slots.attitude().start;
    let quaternion = Quaternion::read(&block[slots.attitude()]);
    let mut map = DMatrix::identity(slots.places().len(), at + 3);
    map.view_mut((at, at), (4, 3)).copy_from(&quaternion.rate_by_spin());
    map
}
