//! The block of a rigid sphere that the fluid remembers: p₀, q, ṗ₀, Ω from 0, 3, 7, 10, and the modes behind.
//!
//!   δ(Rᵀ T) = ∂T/∂ω δΩ + [Rᵀ T₀]× δθ,   T₀ the part of the torque that does not depend on the spin
//!   δy_k′ = s_k (δṗ₀ − L∞ δp₀ − δy_k),   δY_k′ = S_k (R δΩ − R [Ω]× δθ − δY_k)

use super::rigid_slopes::RigidSlopes;
use super::{gyroscopic, write};
use crate::body::RigidInertia;
use crate::rates::RigidMemory;
use crate::tensor::{Mat3, cross_matrix};
use nalgebra::DMatrix;

/// Fills the block, which holds zeros.
pub(super) fn fill(block: &mut DMatrix<f64>, inertia: &RigidInertia, sphere: &RigidMemory, slopes: &RigidSlopes) {
    let (loads, turn) = (&sphere.loads, sphere.turn);
    let rotation = &sphere.motion.placement.gradient;
    let (mobility, inverse) = (1.0 / sphere.mass(), sphere.inverse(inertia));
    let turns = turn.quaternion.turn_by_component();
    let given = cross_matrix(&rotation.tr_mul(&loads.given));
    write(block, (0, 7), &Mat3::identity());
    write(block, (3, 3), &turn.quaternion.rate_by_component(&turn.spin));
    write(block, (3, 10), &turn.quaternion.rate_by_spin());
    write(block, (7, 0), &((slopes.by_place.force + loads.by_place) * mobility));
    write(block, (7, 3), &(slopes.by_turn.force * mobility * turns));
    write(block, (7, 7), &((slopes.by_velocity.force + loads.by_velocity) * mobility));
    write(block, (7, 10), &(slopes.by_spin.force * mobility));
    write(block, (10, 0), &(inverse * slopes.by_place.torque));
    write(block, (10, 3), &(inverse * (slopes.by_turn.torque + given) * turns));
    write(block, (10, 7), &(inverse * slopes.by_velocity.torque));
    let by_spin =
        slopes.by_spin.torque + Mat3::from_diagonal_element(loads.by_spin) - gyroscopic(sphere.body, inertia, turn);
    write(block, (10, 10), &(inverse * by_spin));
    let trailing = sphere.memory.translation.rates.len();
    for (mode, (drag, rate)) in sphere.memory.modes().enumerate() {
        let at = 13 + 3 * mode;
        write(block, (at, at), &Mat3::from_diagonal_element(-rate));
        if mode < trailing {
            write(block, (7, at), &Mat3::from_diagonal_element(drag * mobility));
            write(block, (at, 0), &(-rate * sphere.flow));
            write(block, (at, 7), &Mat3::from_diagonal_element(rate));
        } else {
            write(block, (10, at), &(drag * inverse * rotation.transpose()));
            write(block, (at, 3), &(-rate * rotation * cross_matrix(&turn.spin) * turns));
            write(block, (at, 10), &(rate * rotation));
        }
    }
}
