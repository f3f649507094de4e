//! The block of an affine body: q̇ from its rate, q̈ from the balance, in the coordinates q = (p₀ | P), P column by column.
//!
//!   δp̈₀ = δf/m,   δP̈ from δP, δṖ and δM (`affine::AffineSlopes`)
//!
//! A pinned body has P alone: p₀ = a − P r takes its columns of p₀ into those of P, and M is about the pin.

use crate::affine::Vec9;
use crate::contact::ContactSlopes;
use crate::inadmissible::Inadmissible;
use crate::load::LoadSlopes;
use crate::model::Model;
use crate::rates::{AffineMotion, Workspace, for_each_contact, spring_loads};
use crate::tensor::Vec3;
use nalgebra::{DMatrix, SMatrix};

type Mat12 = SMatrix<f64, 12, 12>;

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
    let balance = moving.affine.interior.slopes(&moving.gyration, &moment);
    let half = block.nrows() / 2;
    // P begins behind p₀, if there is one.
    let at = half - 9;
    for coordinate in 0..half {
        block[(coordinate, half + coordinate)] = 1.0;
    }
    let arm = body.pin.as_ref().map(|pin| pin.point);
    for (by_rate, first) in [(false, 0), (true, half)] {
        let matrix = loads.as_ref().map(|slopes| if by_rate { &slopes.by_rate } else { &slopes.by_place });
        let mut columns = [[0.0; 9]; 12];
        if let Some(matrix) = matrix {
            for (coordinate, column) in columns[..half].iter_mut().enumerate() {
                let (df, dm) = along(matrix, coordinate, arm.as_ref());
                column.copy_from_slice(dm.as_slice());
                if at == 3 {
                    let linear = df / body.mass.mass;
                    block.view_mut((half, first + coordinate), (3, 1)).copy_from_slice(linear.as_slice());
                }
            }
            balance.along_moment(columns[..at].as_flattened_mut());
        }
        let own = columns[at..half].as_flattened_mut();
        if by_rate {
            balance.along_rate(own)
        } else {
            balance.along_gradient(own)
        }
        for (coordinate, column) in columns[..half].iter().enumerate() {
            block.view_mut((half + at, first + coordinate), (9, 1)).copy_from_slice(column);
        }
    }
    Ok(())
}

/// The loads on an affine body and their derivatives; none if nothing but gravity acts on it.
fn load_slopes(
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

/// δf and δM along one coordinate; of a pinned body, M about the pin and both with p₀ = a − P r.
fn along(matrix: &Mat12, coordinate: usize, arm: Option<&Vec3>) -> (Vec3, Vec9) {
    let column = |place: usize| {
        let numbers = matrix.column(place);
        (Vec3::from(numbers.fixed_rows::<3>(0)), Vec9::from(numbers.fixed_rows::<9>(3)))
    };
    let Some(arm) = arm else { return column(coordinate) };
    let (mut df, mut dm) = column(3 + coordinate);
    // δP = e_i ⊗ e_A moves p₀ by −r_A e_i.
    let (by_center, moment_by_center) = column(coordinate % 3);
    df -= arm[coordinate / 3] * by_center;
    dm -= arm[coordinate / 3] * moment_by_center;
    for (place, entry) in dm.iter_mut().enumerate() {
        *entry -= df[place % 3] * arm[place / 3];
    }
    (df, dm)
}
