//! The block of a contractile body: that of an affine one in the coordinates q = (p₀ | P), and G behind it.
//!
//!   δp̈₀ = δf/m,   δP̈ and δĠ from δP, δṖ, δG, δM and δQ (`contractile::ContractileSlopes`)
//!
//! A part of the drive that answers to the body adds what a change of Q does, times the derivative of what the body feels.

use super::affine_slopes::{Seen, load_slopes};
use crate::columns::Columns;
use crate::contractile::{ContractileSlopes, Felt};
use crate::inadmissible::Inadmissible;
use crate::model::Model;
use crate::rates::{ContractileMotion, Workspace};
use crate::tensor::Mat3;
use nalgebra::DMatrix;

/// Fills the block; what is zero in it is taken to be zero already.
pub(super) fn fill(
    block: &mut DMatrix<f64>,
    model: &Model,
    workspace: &mut Workspace,
    moving: &ContractileMotion,
) -> Result<(), Inadmissible> {
    let body = &model.bodies[moving.pulled.index];
    let loads = load_slopes(model, workspace, moving.time, &moving.pulled)?;
    let moment = moving.pulled.moment(model, &loads.as_ref().map(|slopes| slopes.loads).unwrap_or_default());
    let half = if body.pin.is_some() { 9 } else { 12 };
    for coordinate in 0..half {
        block[(coordinate, half + coordinate)] = 1.0;
    }
    let arm = body.pin.as_ref().map(|pin| pin.point);
    let seen = loads.as_ref().map(|slopes| Seen { slopes, arm, mass: body.mass.mass });
    let balance = moving.slopes(model, &moment);
    let medium =
        moving.contractile.medium.as_ref().map(|medium| medium.slopes(&moving.pulled.gyration, &Mat3::zeros()));
    let at = half - 9;
    let mut write = |coordinate: usize, (rate, acceleration): (Option<Columns>, Columns)| {
        let mut column = block.column_mut(coordinate);
        let column = column.as_mut_slice();
        if let Some(seen) = seen.as_ref().filter(|_| coordinate < 2 * half) {
            seen.linear(coordinate >= half, coordinate % half, &mut column[half..half + at]);
        }
        acceleration.write(&mut column[half + at..]);
        if let Some(rate) = rate.filter(|_| moving.contractile.contraction.is_driven()) {
            rate.write(&mut column[2 * half..]);
        }
    };
    let along = |by_rate: bool, coordinate: usize| {
        seen.as_ref().map_or_else(Columns::default, |seen| seen.along(by_rate, coordinate))
    };
    for place in 0..at {
        write(place, (None, balance.along_moment(&along(false, place))));
        write(half + place, (None, balance.along_moment(&along(true, place))));
    }
    for place in 0..9 {
        let (j, b, coordinate) = (place % 3, place / 3, at + place);
        let (mut gradient, mut rate) = (along(false, coordinate), along(true, coordinate));
        if let Some(medium) = &medium {
            gradient += medium.by_gradient(j, b);
            rate += medium.by_rate(j, b);
        }
        let (contraction, acceleration) = balance.along_gradient(j, b, &gradient);
        write(coordinate, (Some(contraction), acceleration));
        let (contraction, acceleration) = balance.along_rate(j, b, &rate);
        write(half + coordinate, (Some(contraction), acceleration));
    }
    if moving.contractile.contraction.is_driven() {
        for place in 0..9 {
            let (contraction, acceleration) = balance.along_contraction(place % 3, place / 3);
            write(2 * half + place, (Some(contraction), acceleration));
        }
        add_feedback(block, model, moving, &balance);
    }
    Ok(())
}

/// Adds what the parts of the drive do that answer to the body.
fn add_feedback(block: &mut DMatrix<f64>, model: &Model, moving: &ContractileMotion, balance: &ContractileSlopes) {
    let pin = model.bodies[moving.pulled.index].pin.as_ref();
    let half = if pin.is_some() { 9 } else { 12 };
    for (felt, feedback) in moving.felt(model).filter(|(felt, feedback)| feedback.answer(felt.value).1) {
        let (rate, acceleration) = balance.along_drive(&feedback.gain);
        let mut change = [0.0; 18];
        acceleration.write(&mut change[..9]);
        rate.write(&mut change[9..]);
        let Felt { by_position, mut by_gradient, by_rate, .. } = felt;
        if let Some(pin) = pin {
            // p₀ = a − P r.
            by_gradient -= by_position * pin.point.transpose();
        }
        let places = by_position.iter().take(half - 9).chain(by_gradient.iter());
        let rates = [0.0; 3].iter().take(half - 9).chain(by_rate.iter());
        for (coordinate, slope) in places.chain(rates).enumerate().filter(|(_, slope)| **slope != 0.0) {
            for (row, change) in change.iter().enumerate() {
                block[(2 * half - 9 + row, coordinate)] += slope * change;
            }
        }
    }
}
