//! The block of an affine body: q̇ from its rate, q̈ from the balance, in the coordinates q = (p₀ | P), P column by
//! column.
//!
//!   δp̈₀ = δf/m,   δP̈ from δP, δṖ and δM (`affine::AffineSlopes`)
//!
//! A pinned body has P alone: p₀ = a − P r takes its columns of p₀ into those of P, and M is about the pin.

use super::super::Scratch;
use super::super::affine::moment;
use super::super::loads::add_slopes;
use crate::affine::{AffineSlopes, Entry, Gyration};
use crate::body::Affine;
use crate::inadmissible::Inadmissible;
use crate::instant::{BodyAt, MotionAt};
use crate::load::LoadSlopes;
use crate::simd::{F64x4, SimdMat3, WithF64x4, dispatch_f64x4};
use crate::tensor::{Mat3, Vec3};
use nalgebra::DMatrix;

/// Fills the block; what is zero in it is taken to be zero already.
pub(super) fn fill(
    block: &mut DMatrix<f64>,
    at: &BodyAt,
    affine: &Affine,
    gyration: &Gyration,
    scratch: &mut Scratch,
) -> Result<(), Inadmissible> {
    let loads = load_slopes(at, scratch)?;
    fill_with(block, at, affine, gyration, loads.as_ref());
    Ok(())
}

/// The same under loads whose derivatives are known, if there are any.
pub(super) fn fill_with(
    block: &mut DMatrix<f64>,
    at: &BodyAt,
    affine: &Affine,
    gyration: &Gyration,
    loads: Option<&LoadSlopes>,
) {
    let moment = moment(at, &loads.map(|slopes| slopes.loads).unwrap_or_default());
    let half = block.nrows() / 2;
    for (coordinate, column) in block.as_mut_slice().chunks_exact_mut(2 * half).skip(half).enumerate() {
        column[coordinate] = 1.0;
    }
    let loads = loads.map(|slopes| Seen::of(at, slopes));
    if let Some(seen) = &loads {
        for (coordinate, column) in block.as_mut_slice().chunks_exact_mut(2 * half).enumerate() {
            seen.linear(coordinate >= half, coordinate % half, &mut column[half..2 * half - 9]);
        }
    }
    let block = block.as_mut_slice();
    dispatch_f64x4(Acceleration { affine, gyration, moment: &moment, loads: loads.as_ref(), half, block });
}

/// δP̈ along each coordinate and each of its rates, to be written into the block.
struct Acceleration<'a> {
    affine: &'a Affine,
    gyration: &'a Gyration,
    moment: &'a Mat3,
    /// The derivatives of the loads, if there are any.
    loads: Option<&'a Seen<'a>>,
    /// How many coordinates there are; those of P are the last nine.
    half: usize,
    block: &'a mut [f64],
}

impl WithF64x4 for Acceleration<'_> {
    type Output = ();

    #[inline(always)]
    fn run<F: F64x4>(self, zeros: F) {
        let Self { affine, gyration, moment, loads, half, block } = self;
        let balance = affine.interior.slopes_in(zeros, gyration, moment);
        let Some(loads) = loads else { return by_gradient(zeros, &balance, |_, _| None, (block, half)) };
        for (coordinate, column) in block.chunks_exact_mut(2 * half).enumerate() {
            let (by_rate, coordinate) = (coordinate >= half, coordinate % half);
            if coordinate < half - 9 {
                balance.along_moment(&loads.along(by_rate, coordinate), zeros).write(&mut column[2 * half - 9..]);
            }
        }
        by_gradient(zeros, &balance, |by_rate, coordinate| Some(loads.along(by_rate, coordinate)), (block, half));
    }
}

/// Writes δP̈ along P and Ṗ into the block, given δM along each coordinate or its rate, if there is any.
#[inline(always)]
fn by_gradient<F: F64x4>(
    zeros: F,
    balance: &AffineSlopes,
    moment: impl Fn(bool, usize) -> Option<SimdMat3>,
    (block, half): (&mut [f64], usize),
) {
    let (places, rates) = block.split_at_mut(2 * half * half);
    let column = |coordinate: usize| 2 * half * (coordinate + 1) - 9..2 * half * (coordinate + 1);
    for b in 0..3 {
        for j in 0..3 {
            let (entry, coordinate) = (Entry { j, b }, half - 9 + 3 * b + j);
            let (by_place, by_rate) = (moment(false, coordinate), moment(true, coordinate));
            balance.along_gradient(entry, by_place.as_ref(), zeros).write(&mut places[column(coordinate)]);
            balance.along_rate(entry, by_rate.as_ref(), zeros).write(&mut rates[column(coordinate)]);
        }
    }
}

/// The loads on a body that deforms and their derivatives; none if nothing but gravity acts on it.
pub(super) fn load_slopes(at: &BodyAt, scratch: &mut Scratch) -> Result<Option<LoadSlopes>, Inadmissible> {
    let mut slopes: Option<LoadSlopes> = None;
    at.try_each_load(|load| add_slopes(&load, at, scratch, slopes.get_or_insert_default()))?;
    Ok(slopes)
}

/// The derivatives of the loads as a body sees them.
pub(super) struct Seen<'a> {
    slopes: &'a LoadSlopes,
    /// r, of a pinned body.
    arm: Option<Vec3>,
    mass: f64,
}

impl<'a> Seen<'a> {
    /// By a body at an instant.
    pub fn of(at: &MotionAt, slopes: &'a LoadSlopes) -> Self {
        Self { slopes, arm: at.body.pin.as_ref().map(|pin| pin.point), mass: at.body.solid.mass.mass }
    }

    /// δf/m along one coordinate of a free body.
    pub fn linear(&self, by_rate: bool, coordinate: usize, linear: &mut [f64]) {
        for (out, force) in linear.iter_mut().zip(self.column(by_rate, coordinate)) {
            *out = force / self.mass;
        }
    }

    /// The derivatives of (f | M) by one of the twelve coordinates.
    #[inline(always)]
    fn column(&self, by_rate: bool, place: usize) -> &[f64] {
        let matrix = if by_rate { &self.slopes.by_rate } else { &self.slopes.by_place };
        &matrix.as_slice()[12 * place..][..12]
    }

    /// δM along one coordinate; of a pinned body, M is about the pin and p₀ = a − P r.
    #[inline(always)]
    pub fn along(&self, by_rate: bool, coordinate: usize) -> SimdMat3 {
        let Some(arm) = &self.arm else { return SimdMat3::read(&self.column(by_rate, coordinate)[3..]) };
        // δP = e_i ⊗ e_A moves p₀ by −r_A e_i.
        let (own, center) = (self.column(by_rate, 3 + coordinate), self.column(by_rate, coordinate % 3));
        let mut change = [0.0; 12];
        for place in 0..12 {
            change[place] = own[place] - arm[coordinate / 3] * center[place];
        }
        for place in 3..12 {
            change[place] -= change[place % 3] * arm[place / 3 - 1];
        }
        SimdMat3::read(&change[3..])
    }
}
