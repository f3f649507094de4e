//! Participation: what moves in a small motion, as shares of its kinetic energy.
//!
//!   2T = Σ m |u|² + tr(A P J Pᵀ A*ᵀ),   A = δP P⁻¹ = W + D′ + D″ + ⅓ tr A 1
//!
//! u is the translation, W skew, D′ the entries off the diagonal of sym A, D″ those on it without their mean. A term of
//! two parts counts half for each, so that the shares of all parts of all bodies sum to one. The centre of a pinned
//! body goes where the pin lets it: J is about the pin, and u no part.

use super::shape::{ModeShape, spread};
use gyration::body::{Body, BodyKind};
use gyration::kinematics::Placement;
use gyration::tensor::{Mat3, Vec3};
use std::sync::Arc;

/// The shares of each body.
#[derive(Debug, Clone, PartialEq)]
pub struct Participation {
    /// Of each body: translation, rotation, shear, stretch, breathing.
    pub bodies: Vec<[f64; PARTS]>,
}

/// How many parts a motion has.
pub const PARTS: usize = 5;

impl Participation {
    /// Of shapes, and of those in quadrature, which may be none.
    pub(super) fn of(bodies: &[Arc<Body>], placements: &[Placement], shapes: [&[ModeShape]; 2]) -> Self {
        let mut shares = vec![[0.0; PARTS]; bodies.len()];
        for shapes in shapes {
            for (index, shape) in shapes.iter().enumerate() {
                let of_body = energies(&bodies[index], &placements[index], shape);
                shares[index].iter_mut().zip(of_body).for_each(|(share, energy)| *share += energy);
            }
        }
        let total: f64 = shares.iter().flatten().sum();
        if total > 0.0 {
            shares.iter_mut().flatten().for_each(|share| *share /= total);
        }
        Self { bodies: shares }
    }

    /// Those of all bodies together.
    pub fn total(&self) -> [f64; PARTS] {
        let mut total = [0.0; PARTS];
        for shares in &self.bodies {
            total.iter_mut().zip(shares).for_each(|(sum, share)| *sum += share);
        }
        total
    }
}

/// J of a body about its centre of mass, or about its pin [kg m²].
pub(super) fn euler_tensor(body: &Body) -> Mat3 {
    match &body.kind {
        BodyKind::Affine(affine) => affine.interior.euler_tensor,
        BodyKind::Contractile(contractile) => contractile.affine.interior.euler_tensor,
        BodyKind::Rigid(_) => {
            body.solid.mass.about(&(body.solid.mass.center + body.pin.map_or(Vec3::zeros(), |pin| pin.point)))
        }
    }
}

/// Twice the kinetic energy of each part of a motion.
pub(super) fn energies(body: &Body, placement: &Placement, shape: &ModeShape) -> [f64; PARTS] {
    let translation = match body.pin {
        None => body.solid.mass.mass * shape.translation.norm_squared(),
        Some(_) => 0.0,
    };
    let spread = spread(shape, placement);
    let symmetric = 0.5 * (spread + spread.transpose());
    let diagonal = Mat3::from_diagonal(&symmetric.diagonal());
    let round = Mat3::from_diagonal_element(spread.trace() / 3.0);
    let current = placement.gradient * euler_tensor(body) * placement.gradient.transpose();
    let momentum = spread * current;
    let parts = [spread - symmetric, symmetric - diagonal, diagonal - round, round];
    let [rotation, shear, stretch, breathing] = parts.map(|part| part.dot(&momentum));
    [translation, rotation, shear, stretch, breathing]
}
