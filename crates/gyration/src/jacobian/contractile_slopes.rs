//! The block of a contractile body: that of an affine one in the coordinates q = (p₀ | P), and G behind it.
//!
//!   δp̈₀ = δf/m,   δP̈ and δĠ from δP, δṖ, δG, δM and δQ (`contractile::ContractileSlopes`)
//!
//! A part of the drive that answers to the body adds what a change of Q does, times the derivative of what the body feels.

use super::affine_slopes::{Seen, load_slopes};
use crate::columns::{Columns, Four, Work, dispatch};
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
    let mut written = Contracting { model, moving, moment: &moment, seen: seen.as_ref(), half, block };
    dispatch(&mut written);
    Ok(())
}

/// δP̈ and δĠ along each coordinate, each of its rates and each number of G, to be written into the block.
struct Contracting<'a> {
    model: &'a Model,
    moving: &'a ContractileMotion<'a>,
    moment: &'a Mat3,
    /// The derivatives of the loads, if there are any.
    seen: Option<&'a Seen<'a>>,
    /// How many coordinates there are; those of P are the last nine.
    half: usize,
    block: &'a mut DMatrix<f64>,
}

impl Work for &mut Contracting<'_> {
    type Output = ();

    #[inline(always)]
    fn run<F: Four>(self, zeros: F) {
        let Contracting { model, moving, moment, seen, half, block } = self;
        let (half, size, driven) = (*half, block.nrows(), moving.contractile.contraction.is_driven());
        let balance = moving.slopes_in(zeros, &moving.command(model), moment);
        let medium = moving.contractile.medium.as_ref();
        let medium = medium.map(|medium| medium.slopes(&moving.pulled.gyration, &Mat3::zeros()));
        let at = half - 9;
        let columns = block.as_mut_slice();
        let loads = |by_rate: bool, coordinate: usize| seen.map(|seen| seen.along(by_rate, coordinate));
        for place in 0..9 {
            let (entry, coordinate) = ((place % 3, place / 3), at + place);
            let (mut gradient, mut rate) = (loads(false, coordinate), loads(true, coordinate));
            if let Some(medium) = &medium {
                let (j, b) = entry;
                gradient = Some(gradient.unwrap_or_default() + medium.by_gradient(j, b));
                rate = Some(rate.unwrap_or_default() + medium.by_rate(j, b));
            }
            let along = balance.along_gradient(entry, gradient.as_ref(), zeros);
            write(&mut columns[size * coordinate..][..size], half, &along);
            let along = balance.along_rate(entry, rate.as_ref(), zeros);
            write(&mut columns[size * (half + coordinate)..][..size], half, &along);
            if driven {
                let along = balance.along_contraction(entry, zeros);
                write(&mut columns[size * (2 * half + place)..][..size], half, &along);
            }
        }
        if let Some(seen) = seen {
            for coordinate in 0..2 * half {
                let (by_rate, place) = (coordinate >= half, coordinate % half);
                let column = &mut columns[size * coordinate..size * (coordinate + 1)];
                seen.linear(by_rate, place, &mut column[half..half + at]);
                if place < at {
                    balance.along_moment(&seen.along(by_rate, place), zeros).write(&mut column[half + at..2 * half]);
                }
            }
        }
        if driven {
            add_feedback(block, model, moving, &balance);
        }
    }
}

/// Writes δP̈ and, if G is part of the state, δĠ into a column of the block.
#[inline(always)]
fn write<F: Four>(column: &mut [f64], half: usize, (rate, acceleration): &(Columns<F>, Columns<F>)) {
    acceleration.write(&mut column[2 * half - 9..2 * half]);
    if column.len() > 2 * half {
        rate.write(&mut column[2 * half..]);
    }
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
