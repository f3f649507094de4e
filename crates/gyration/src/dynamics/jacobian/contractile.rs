//! The block of a contractile body: that of an affine one in the coordinates q = (p₀ | P), and G behind it.
//!
//!   δp̈₀ = δf/m,   δP̈ and δĠ from δP, δṖ, δG, δM and δQ (`contractile::ContractileSlopes`)
//!
//! A part of the drive that answers to the body adds what a change of Q does, times the derivative of what the body
//! feels.

use super::super::Scratch;
use super::super::affine::moment;
use super::super::contractile::ContractileMotion;
use super::affine::{Seen, load_slopes};
use crate::body::Slots;
use crate::contractile::{ContractileSlopes, Felt};
use crate::inadmissible::Inadmissible;
use crate::instant::BodyAt;
use crate::simd::{F64x4, SimdMat3, WithF64x4, dispatch_f64x4};
use crate::tensor::Mat3;
use nalgebra::DMatrix;

/// Fills the block; what is zero in it is taken to be zero already.
pub(super) fn fill(
    block: &mut DMatrix<f64>,
    at: &BodyAt,
    moving: &ContractileMotion,
    scratch: &mut Scratch,
) -> Result<(), Inadmissible> {
    let loads = load_slopes(at, scratch)?;
    let moment = moment(at, &loads.as_ref().map(|slopes| slopes.loads).unwrap_or_default());
    let half = Slots::with_inertia(at.body, 0).places().len();
    for coordinate in 0..half {
        block[(coordinate, half + coordinate)] = 1.0;
    }
    if !moving.contractile.contraction.feedback().is_empty() {
        // What the body feels of p₀ adds to columns that may hold that of another state.
        block.view_mut((half, 0), (block.nrows() - half, half - 9)).fill(0.0);
    }
    let seen = loads.as_ref().map(|slopes| Seen::of(at, slopes));
    dispatch_f64x4(&mut Contracting { moving, moment: &moment, seen: seen.as_ref(), half, block });
    Ok(())
}

/// δP̈ and δĠ along each coordinate, each of its rates and each number of G, to be written into the block.
struct Contracting<'a> {
    moving: &'a ContractileMotion<'a>,
    moment: &'a Mat3,
    /// The derivatives of the loads, if there are any.
    seen: Option<&'a Seen<'a>>,
    /// How many coordinates there are; those of P are the last nine.
    half: usize,
    block: &'a mut DMatrix<f64>,
}

impl WithF64x4 for &mut Contracting<'_> {
    type Output = ();

    #[inline(always)]
    fn run<F: F64x4>(self, zeros: F) {
        let Contracting { moving, moment, seen, half, block } = self;
        let (half, size, driven) = (*half, block.nrows(), moving.contractile.contraction.is_driven());
        let balance = moving.slopes_in(zeros, &moving.command(), moment);
        let medium = moving.contractile.medium.as_ref();
        let medium = medium.map(|medium| medium.slopes(moving.gyration, &Mat3::zeros()));
        let at = half - 9;
        let columns = block.as_mut_slice();
        let start = size * at + 2 * half - 9;
        for b in 0..3 {
            let from = start + size * 3 * b;
            balance.along_gradient(b).write(&mut columns[from..], size, driven);
            balance.along_rate(b).write(&mut columns[from + size * half..], size, driven);
            if driven {
                balance.along_contraction(b).write(&mut columns[from + size * (2 * half - at)..], size, driven);
            }
        }
        if seen.is_some() || medium.is_some() || balance.is_held() {
            for coordinate in 0..size {
                let (by_rate, place) = (coordinate >= half, coordinate % half);
                let column = &mut columns[size * coordinate..size * (coordinate + 1)];
                let (mut own, mut moment, mut asked) = (SimdMat3::default(), SimdMat3::default(), 0.0);
                if coordinate < 2 * half {
                    if let Some(seen) = seen {
                        seen.linear(by_rate, place, &mut column[half..half + at]);
                        moment = seen.along(by_rate, place);
                    }
                    if place >= at {
                        let (j, b) = ((place - at) % 3, (place - at) / 3);
                        asked = balance.asked(by_rate, (j, b));
                        if let Some(medium) = &medium {
                            moment += if by_rate { medium.by_rate(j, b) } else { medium.by_gradient(j, b) };
                        }
                    }
                }
                let out = &mut column[half + at..2 * half];
                if place >= at || coordinate >= 2 * half {
                    own = SimdMat3::read(out);
                }
                balance.held(&own, &moment, asked).write(out);
            }
        }
        if driven {
            add_feedback(block, moving, &balance);
        }
    }
}

/// Adds what the parts of the drive do that answer to the body.
#[inline(always)]
fn add_feedback<F: F64x4>(block: &mut DMatrix<f64>, moving: &ContractileMotion, balance: &ContractileSlopes<F>) {
    let pin = moving.at.body.pin.as_ref();
    let half = Slots::with_inertia(moving.at.body, 0).places().len();
    for (felt, feedback) in moving.felt().filter(|(felt, feedback)| feedback.answer(felt.value).1) {
        let mut change = [0.0; 3 * 18];
        balance.along_drive(&feedback.gain).write(&mut change, 18, true);
        balance.held(&SimdMat3::read(&change), &SimdMat3::default(), 0.0).write(&mut change);
        let Felt { by_position, mut by_gradient, by_rate, .. } = felt;
        if let Some(pin) = pin {
            // p₀ = a − P r.
            by_gradient -= by_position * pin.point.transpose();
        }
        let places = by_position.iter().take(half - 9).chain(by_gradient.iter());
        let rates = [0.0; 3].iter().take(half - 9).chain(by_rate.iter());
        for (coordinate, slope) in places.chain(rates).enumerate().filter(|(_, slope)| **slope != 0.0) {
            for (row, change) in change[..18].iter().enumerate() {
                block[(2 * half - 9 + row, coordinate)] += slope * change;
            }
        }
    }
}
