//! The block of a rigid sphere with a history force: that of a rigid body with added mass, and the relaxation modes
//! behind.
//!
//!   δ(Rᵀ T) = ∂T/∂ω δΩ + [Rᵀ T₀]× δθ,   T₀ the part of the torque that does not depend on the spin
//!   δy_k′ = s_k (δṗ₀ − L∞ δp₀ − δy_k),   δY_k′ = S_k (R δΩ − R [Ω]× δθ − δY_k)

use super::super::history::RigidHistory;
use super::rigid::{RigidSlopes, gyroscopic, write};
use crate::body::{RigidInertia, Slots};
use crate::fluid::STRAIN_NUMBERS;
use crate::tensor::{Mat3, cross_matrix};
use nalgebra::DMatrix;
use std::ops::Range;

/// Fills the block, which holds zeros.
pub(super) fn fill(block: &mut DMatrix<f64>, inertia: &RigidInertia, sphere: &RigidHistory, slopes: &RigidSlopes) {
    let slots = Slots::with_inertia(sphere.at.body, 0);
    let (loads, turn) = (&sphere.loads, sphere.turn);
    let rotation = &sphere.at.motion.placement.gradient;
    let (mobility, inverse) = (1.0 / sphere.mass(), sphere.inverse(inertia));
    let turns = turn.quaternion.turn_by_component();
    let given = cross_matrix(&rotation.tr_mul(&loads.given));
    let [position, attitude, velocity, rate] = [slots.position(), slots.attitude(), slots.velocity(), slots.rate()];
    let place = |rows: &Range<usize>, columns: &Range<usize>| (rows.clone(), columns.clone());
    write(block, place(&position, &velocity), &Mat3::identity());
    write(block, place(&attitude, &attitude), &turn.quaternion.rate_by_component(&turn.spin));
    write(block, place(&attitude, &rate), &turn.quaternion.rate_by_spin());
    write(block, place(&velocity, &position), &((slopes.by_place.force + loads.by_place) * mobility));
    write(block, place(&velocity, &attitude), &(slopes.by_turn.force * mobility * turns));
    write(block, place(&velocity, &velocity), &((slopes.by_velocity.force + loads.by_velocity) * mobility));
    write(block, place(&velocity, &rate), &(slopes.by_spin.force * mobility));
    write(block, place(&rate, &position), &(inverse * slopes.by_place.torque));
    write(block, place(&rate, &attitude), &(inverse * (slopes.by_turn.torque + given) * turns));
    write(block, place(&rate, &velocity), &(inverse * slopes.by_velocity.torque));
    let by_spin =
        slopes.by_spin.torque + Mat3::from_diagonal_element(loads.by_spin) - gyroscopic(sphere.at.body, inertia, turn);
    write(block, place(&rate, &rate), &(inverse * by_spin));
    let trailing = sphere.history.translation.rates.len();
    for (mode, (drag, decay)) in sphere.history.modes().enumerate() {
        let at = slots.extra().start + 3 * mode;
        let own = at..at + 3;
        write(block, place(&own, &own), &Mat3::from_diagonal_element(-decay));
        if mode < trailing {
            write(block, place(&velocity, &own), &Mat3::from_diagonal_element(drag * mobility));
            write(block, place(&own, &position), &(-decay * sphere.flow));
            write(block, place(&own, &velocity), &Mat3::from_diagonal_element(decay));
        } else {
            write(block, place(&rate, &own), &(drag * inverse * rotation.transpose()));
            write(block, place(&own, &attitude), &(-decay * rotation * cross_matrix(&turn.spin) * turns));
            write(block, place(&own, &rate), &(decay * rotation));
        }
    }
    // Those of the strain trail the flow alone, and nothing of the body feels them.
    let strains = sphere.history.strain.iter().flat_map(|strain| strain.modes(&sphere.history.rotation));
    for (mode, (_, decay)) in strains.enumerate() {
        let at = slots.extra().start + sphere.history.strain_modes() + STRAIN_NUMBERS * mode;
        (at..at + STRAIN_NUMBERS).for_each(|own| block[(own, own)] = -decay);
    }
}
