//! The block of an affine body: q̇ from its rate, q̈ from the balance, in the coordinates q = (p₀ | P), P column by column.
//!
//!   δp̈₀ = δf/m,   δP̈ from δP, δṖ and δM (`affine::AffineSlopes`)
//!
//! A pinned body has P alone: p₀ = a − P r takes its columns of p₀ into those of P, and M is about the pin.

use crate::contact::ContactSlopes;
use crate::inadmissible::Inadmissible;
use crate::load::{LoadSlopes, Loads, loads, unit};
use crate::model::Model;
use crate::rates::{AffineMotion, Workspace, for_each_contact, spring_loads};
use crate::tensor::{Mat3, Vec3};
use nalgebra::DMatrix;

/// The loads on an affine body and their derivatives.
pub(super) fn load_slopes(
    model: &Model,
    workspace: &mut Workspace,
    time: f64,
    moving: &AffineMotion,
) -> Result<LoadSlopes, Inadmissible> {
    let mut slopes = LoadSlopes::default();
    for_each_contact(model, time, moving.index, &moving.motion, |contact, meeting| {
        ContactSlopes::integrate(contact, meeting, &mut workspace.contact)?.add_to(&mut slopes);
        Ok(())
    })?;
    spring_loads(moving.index, &model.bodies[moving.index], &moving.motion, |spring| slopes.add_spring(spring))?;
    if let Some(couple) = &moving.affine.couple {
        slopes.add_couple(&couple.moment(time, &moving.inverse), &moving.inverse);
    }
    let motion = &moving.motion;
    for resistance in &moving.affine.resistances {
        slopes.add_resistance(resistance, (&motion.placement, &moving.inverse, &motion.velocity));
    }
    Ok(slopes)
}

/// Fills the block.
pub(super) fn fill(block: &mut DMatrix<f64>, model: &Model, moving: &AffineMotion, slopes: &LoadSlopes) {
    let body = &model.bodies[moving.index];
    let motion = &moving.motion;
    let moment = moving.moment(model, &slopes.loads);
    let interior = &moving.affine.interior;
    block.fill(0.0);
    // P can be inverted, or there would be no `moving`.
    let Some(balance) = interior.slopes(&motion.placement.gradient, &motion.velocity.gradient_rate, &moment) else {
        return block.fill(f64::NAN);
    };
    let half = block.nrows() / 2;
    for coordinate in 0..half {
        block[(coordinate, half + coordinate)] = 1.0;
    }
    let arm = body.pin.as_ref().map(|pin| pin.point);
    for column in 0..2 * half {
        let (coordinate, by_rate) = (column % half, column >= half);
        let change = loads_along(slopes, coordinate, by_rate, arm.as_ref());
        let own = if half == 12 { coordinate.checked_sub(3) } else { Some(coordinate) };
        let along = own.map_or(Mat3::zeros(), unit);
        let still = Mat3::zeros();
        let (dp, drate) = if by_rate { (&still, &along) } else { (&along, &still) };
        let (acceleration, _) = balance.apply(dp, drate, &change.moment);
        let at = block.nrows() - 9;
        block.view_mut((at, column), (9, 1)).copy_from_slice(acceleration.as_slice());
        if half == 12 {
            let linear = change.force / body.mass.mass;
            block.view_mut((half, column), (3, 1)).copy_from_slice(linear.as_slice());
        }
    }
}

/// The change of the loads along one coordinate or its rate; of a pinned body, M about the pin and both with p₀ = a − P r.
fn loads_along(slopes: &LoadSlopes, coordinate: usize, by_rate: bool, arm: Option<&Vec3>) -> Loads {
    let matrix = if by_rate { &slopes.by_rate } else { &slopes.by_place };
    let column = |place: usize| loads(&matrix.column(place).into());
    let Some(arm) = arm else { return column(coordinate) };
    let mut change = column(3 + coordinate);
    // δP = e_i ⊗ e_A moves p₀ by −r_A e_i.
    change += column(coordinate % 3).scaled(-arm[coordinate / 3]);
    change.moment -= change.force * arm.transpose();
    change
}
