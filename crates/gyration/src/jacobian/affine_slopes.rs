//! The block of an affine body: q̇ from its rate, q̈ from the balance, in the coordinates q = (p₀ | P), P column by column.
//!
//!   δp̈₀ = δf/m,   δP̈ from δP, δṖ and δM (`affine::AffineSlopes`)
//!
//! A pinned body has P alone: p₀ = a − P r takes its columns of p₀ into those of P, and M is about the pin.

use crate::affine::AffineSlopes;
use crate::columns::Columns;
use crate::contact::ContactSlopes;
use crate::inadmissible::Inadmissible;
use crate::load::LoadSlopes;
use crate::model::Model;
use crate::rates::{AffineMotion, Workspace, for_each_contact, spring_loads};
use crate::tensor::Vec3;
use nalgebra::DMatrix;

/// Fills the block; what is zero in it is taken to be zero already.
pub(super) fn fill(
    block: &mut DMatrix<f64>,
    model: &Model,
    workspace: &mut Workspace,
    time: f64,
    moving: &AffineMotion,
) -> Result<(), Inadmissible> {
    let body = &model.bodies[moving.index];
    let loads = load_slopes(model, workspace, time, moving)?;
    let moment = moving.moment(model, &loads.as_ref().map(|slopes| slopes.loads).unwrap_or_default());
    let half = block.nrows() / 2;
    for coordinate in 0..half {
        block[(coordinate, half + coordinate)] = 1.0;
    }
    let seen =
        loads.as_ref().map(|slopes| Seen { slopes, arm: body.pin.as_ref().map(|pin| pin.point), mass: body.mass.mass });
    let mut columns = [Columns::default(); 24];
    let balance = moving.affine.interior.slopes(&moving.gyration, &moment);
    accelerate(&mut columns, half, &balance, seen.as_ref());
    let at = half - 9;
    for (coordinate, (column, acceleration)) in
        block.as_mut_slice().chunks_exact_mut(2 * half).zip(&columns).enumerate()
    {
        if let Some(seen) = &seen {
            seen.linear(coordinate >= half, coordinate % half, &mut column[half..half + at]);
        }
        if coordinate % half >= at || seen.is_some() {
            acceleration.write(&mut column[half + at..]);
        }
    }
    Ok(())
}

/// δP̈ along each coordinate and each of its rates.
#[inline(always)]
fn accelerate(columns: &mut [Columns; 24], half: usize, balance: &AffineSlopes, loads: Option<&Seen>) {
    // P begins behind p₀, if there is one.
    let at = half - 9;
    if let Some(loads) = loads {
        for coordinate in 0..half {
            columns[coordinate] = loads.along(false, coordinate);
            columns[half + coordinate] = loads.along(true, coordinate);
        }
        for place in 0..at {
            columns[place] = balance.along_moment(&columns[place]);
            columns[half + place] = balance.along_moment(&columns[half + place]);
        }
    }
    for b in 0..3 {
        for j in 0..3 {
            let place = at + 3 * b + j;
            columns[place] = balance.along_gradient(j, b, &columns[place]);
            columns[half + place] = balance.along_rate(j, b, &columns[half + place]);
        }
    }
}

/// The loads on an affine body and their derivatives; none if nothing but gravity acts on it.
pub(super) fn load_slopes(
    model: &Model,
    workspace: &mut Workspace,
    time: f64,
    moving: &AffineMotion,
) -> Result<Option<LoadSlopes>, Inadmissible> {
    let (body, affine) = (&model.bodies[moving.index], moving.affine);
    if !moving.is_loaded(model) {
        return Ok(None);
    }
    let mut slopes = LoadSlopes::default();
    for_each_contact(model, time, moving.index, moving.motion, |contact, meeting| {
        ContactSlopes::integrate(contact, meeting, &mut workspace.contact)?.add_to(&mut slopes);
        Ok(())
    })?;
    spring_loads(moving.index, body, moving.motion, |spring| slopes.add_spring(spring))?;
    let inverse = &moving.gyration.inverse;
    if let Some(couple) = &affine.couple {
        slopes.add_couple(&couple.moment(time, inverse), inverse);
    }
    for resistance in &affine.resistances {
        slopes.add_resistance(resistance, (&moving.motion.placement, inverse, &moving.motion.velocity));
    }
    Ok(Some(slopes))
}

/// The derivatives of the loads as a body sees them.
pub(super) struct Seen<'a> {
    pub slopes: &'a LoadSlopes,
    /// r, of a pinned body.
    pub arm: Option<Vec3>,
    pub mass: f64,
}

impl Seen<'_> {
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
    pub fn along(&self, by_rate: bool, coordinate: usize) -> Columns {
        let Some(arm) = &self.arm else { return Columns::read(&self.column(by_rate, coordinate)[3..]) };
        // δP = e_i ⊗ e_A moves p₀ by −r_A e_i.
        let (own, center) = (self.column(by_rate, 3 + coordinate), self.column(by_rate, coordinate % 3));
        let mut change = [0.0; 12];
        for place in 0..12 {
            change[place] = own[place] - arm[coordinate / 3] * center[place];
        }
        for place in 3..12 {
            change[place] -= change[place % 3] * arm[place / 3 - 1];
        }
        Columns::read(&change[3..])
    }
}
