//! The block of an affine sphere with a history force: that of an affine body whose balance has added mass, and the
//! relaxation modes behind.
//!
//!   δp̈₀ = δf/(m + m_a),   K δP̈ = δM̂ + …     (`affine::AddedBalance`),   δM̂ = δP̈₀ J
//!   δy_k′ = s_k (δṗ₀ − L∞ δp₀ − δy_k),   δY_k′ = S_k (½ axial δL − δY_k),   δZ_k′ = S_k (dev sym δL − δZ_k)
//!
//! δP̈₀ is that of the block without added mass, whose loads have those of the history. δL = δṖ P⁻¹ − L δP P⁻¹.

use super::super::Scratch;
use super::super::affine_history::AffineHistory;
use super::affine::{fill_with, load_slopes};
use crate::affine::Gyration;
use crate::body::{Affine, Slots};
use crate::fluid::{STRAIN_NUMBERS, deviator, strain_numbers, strain_of};
use crate::inadmissible::Inadmissible;
use crate::instant::BodyAt;
use crate::load::unit;
use crate::tensor::{Mat3, Vec3, axial, cross_matrix};
use nalgebra::DMatrix;

/// Fills the block; what is zero in it is taken to be zero already.
pub(super) fn fill(
    block: &mut DMatrix<f64>,
    at: &BodyAt,
    (affine, gyration): (&Affine, &Gyration),
    sphere: &AffineHistory,
    scratch: &mut Scratch,
) -> Result<(), Inadmissible> {
    let mut loads = load_slopes(at, scratch)?.unwrap_or_default();
    sphere.add_to(&mut loads);
    let slots = Slots::with_inertia(at.body, 0);
    let mut plain = scratch.take(slots.velocities().end);
    fill_with(&mut plain, at, affine, gyration, Some(&loads));
    let accelerated = sphere.accelerated_by(&loads.loads.moment);
    let lighter = at.body.solid.mass.mass / sphere.mass();
    let (velocity, rate) = (slots.velocity(), slots.rate());
    for (number, (column, mut out)) in plain.column_iter().zip(block.column_iter_mut()).enumerate() {
        out.rows_mut(0, velocity.start).copy_from(&column.rows(0, velocity.start));
        velocity.clone().for_each(|row| out[row] = column[row] * lighter);
        let free = Mat3::from_column_slice(&column.as_slice()[rate.clone()]);
        let moment = free * affine.interior.euler_tensor;
        let own = |from: usize| unit(number - from);
        let change = if slots.attitude().contains(&number) {
            sphere.inertia.along_gradient(&accelerated, &own(slots.attitude().start), &moment)
        } else if rate.contains(&number) {
            sphere.inertia.along_rate(&own(rate.start), &moment)
        } else {
            sphere.inertia.along_moment(&moment)
        };
        out.rows_mut(rate.start, 9).copy_from_slice(change.as_slice());
    }
    scratch.matrices.push(plain);
    add_modes(block, gyration, sphere, &slots);
    Ok(())
}

/// What the modes do, and what becomes of them.
fn add_modes(block: &mut DMatrix<f64>, gyration: &Gyration, sphere: &AffineHistory, slots: &Slots) {
    let history = sphere.history;
    let trailing = history.translation.rates.len();
    let mobility = 1.0 / sphere.mass();
    let start = slots.extra().start;
    // Joints may have added to what they do to the velocities at another state.
    block.view_mut((slots.velocities().start, start), (12, slots.extra().len())).fill(0.0);
    for (mode, (drag, decay)) in history.modes().enumerate().take(trailing) {
        let own = start + 3 * mode;
        for axis in 0..3 {
            block[(slots.velocity().start + axis, own + axis)] = drag * mobility;
            block[(own + axis, slots.velocity().start + axis)] = decay;
            block[(own + axis, own + axis)] = -decay;
            for place in 0..3 {
                block[(own + axis, slots.position().start + place)] = -decay * sphere.flow[(axis, place)];
            }
        }
    }
    let map = GradientModes::of(gyration, sphere);
    for (mode, (drag, decay)) in history.modes().skip(trailing).enumerate() {
        map.write(block, slots, (start + 3 * (trailing + mode), 0..3), [drag, decay]);
    }
    let strains = history.strain.iter().flat_map(|strain| strain.modes(&history.rotation));
    for (mode, (drag, decay)) in strains.enumerate() {
        map.write(block, slots, (start + history.strain_modes() + STRAIN_NUMBERS * mode, 3..9), [drag, decay]);
    }
}

/// The nine numbers of L that modes trail, ½ axial L and those of dev sym L: what moves them, and what each of their
/// modes does to P̈.
struct GradientModes {
    /// Of each coordinate of P, and of each of Ṗ.
    by_place: [[f64; 9]; 9],
    by_rate: [[f64; 9]; 9],
    /// δP̈ by a unit of each.
    response: [Mat3; 9],
}

impl GradientModes {
    fn of(gyration: &Gyration, sphere: &AffineHistory) -> Self {
        let Gyration { inverse, velocity_gradient: l, .. } = gyration;
        let spread = |entry: usize| unit(entry) * inverse;
        let across = inverse.transpose();
        Self {
            by_place: std::array::from_fn(|entry| nine(&-(l * spread(entry)))),
            by_rate: std::array::from_fn(|entry| nine(&spread(entry))),
            response: std::array::from_fn(|number| sphere.inertia.along_moment(&(of_nine(number) * across))),
        }
    }

    /// Writes the rows and columns of modes that begin at a place and trail some of the numbers.
    fn write(
        &self,
        block: &mut DMatrix<f64>,
        slots: &Slots,
        (own, numbers): (usize, std::ops::Range<usize>),
        [drag, decay]: [f64; 2],
    ) {
        for (place, number) in numbers.enumerate() {
            let row = own + place;
            block[(row, row)] = -decay;
            for entry in 0..9 {
                block[(row, slots.attitude().start + entry)] = decay * self.by_place[entry][number];
                block[(row, slots.rate().start + entry)] = decay * self.by_rate[entry][number];
                block[(slots.rate().start + entry, row)] = drag * self.response[number].as_slice()[entry];
            }
        }
    }
}

/// ½ axial X and the six numbers of dev sym X.
fn nine(x: &Mat3) -> [f64; 9] {
    let spin = 0.5 * axial(x);
    let [diagonal, across] = strain_numbers(&deviator(x));
    [spin.x, spin.y, spin.z, diagonal.x, diagonal.y, diagonal.z, across.x, across.y, across.z]
}

/// The moment of one of them, as it stands in the loads of the history: ½ [T]× of a torque, or a symmetric tensor.
fn of_nine(number: usize) -> Mat3 {
    let axis = |from: usize| Vec3::ith(number - from, 1.0);
    match number {
        0..3 => 0.5 * cross_matrix(&axis(0)),
        3..6 => strain_of(&[axis(3), Vec3::zeros()]),
        _ => strain_of(&[Vec3::zeros(), axis(6)]),
    }
}
