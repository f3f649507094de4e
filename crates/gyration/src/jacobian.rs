//! The exact Jacobian of the rates, block by block.
//!
//! The loads depend on the state through (δp₀, δP, δṗ₀, δṖ) only; for each direction of a rigid body
//!
//!   δp₀;   δR = R[δθ]×, δṖ = R[δθ]×[Ω]×;   δṗ₀;   δΩ, δṖ = R[δΩ]×
//!
//! their change follows from the same moments with exponent ν + 1. Columns of the quaternion come from those of δθ by
//! δθ = 2 vec(q⁻¹ ∘ δq). A pinned body's centre follows its rotation: δp₀ = −δR r, δṗ₀ = −δṖ r.

use crate::body::{Body, BodyKind, RigidInertia};
use crate::contact::ContactSlopes;
use crate::inadmissible::Inadmissible;
use crate::kinematics::{Placement, Velocity};
use crate::load::{Loads, SpringLoads};
use crate::model::Model;
use crate::rates::{Meeting, Workspace, for_each_contact, spring_loads};
use crate::state::BodyMotion;
use crate::tensor::{Mat3, Vec3, cross_matrix};
use nalgebra::DMatrix;

/// An increment of a body's motion and of what a rigid body's balance needs besides.
struct Direction {
    placement: Placement,
    velocity: Velocity,
    turn: Vec3,
    spin: Vec3,
}

/// ∂(rates)/∂(state) of every body, one square matrix a block of `Model::blocks`.
///
/// # Errors
/// [`Inadmissible`] where the state is outside the model.
pub fn jacobian(
    model: &Model,
    workspace: &mut Workspace,
    time: f64,
    bodies: &[f64],
    blocks: &mut [DMatrix<f64>],
) -> Result<(), Inadmissible> {
    for (index, (body, matrix)) in model.bodies.iter().zip(blocks).enumerate() {
        let motion = BodyMotion::unpack(body, &bodies[model.blocks()[index].clone()]);
        match &body.kind {
            BodyKind::Rigid(inertia) => {
                let columns = rigid_columns(model, workspace, time, index, &motion)?;
                fill_rigid(matrix, model, body, inertia, &motion, &columns);
            }
        }
    }
    Ok(())
}

/// The directions of a rigid body (translation, turn, velocity, spin, 3 each), and the loads and their changes.
struct RigidColumns {
    directions: [Direction; 12],
    loads: Loads,
    along: [Loads; 12],
}

/// One of the twelve directions of a free rigid body; a pinned one uses the turns and the spins.
fn direction(body: &Body, motion: &BodyMotion, number: usize) -> Direction {
    let rotation = &motion.placement.gradient;
    let unit = Vec3::ith(number % 3, 1.0);
    let (mut turn, mut spin) = (Vec3::zeros(), Vec3::zeros());
    let mut placement = Placement { position: Vec3::zeros(), gradient: Mat3::zeros() };
    let mut velocity = Velocity { velocity: Vec3::zeros(), gradient_rate: Mat3::zeros() };
    match number / 3 {
        0 => placement.position = unit,
        1 => {
            turn = unit;
            placement.gradient = rotation * cross_matrix(&unit);
            velocity.gradient_rate = placement.gradient * cross_matrix(&motion.spin);
        }
        2 => velocity.velocity = unit,
        _ => {
            spin = unit;
            velocity.gradient_rate = rotation * cross_matrix(&unit);
        }
    }
    if let Some(pin) = &body.pin {
        placement.position = -(placement.gradient * pin.point);
        velocity.velocity = -(velocity.gradient_rate * pin.point);
    }
    Direction { placement, velocity, turn, spin }
}

fn rigid_columns(
    model: &Model,
    workspace: &mut Workspace,
    time: f64,
    index: usize,
    motion: &BodyMotion,
) -> Result<RigidColumns, Inadmissible> {
    let body = &model.bodies[index];
    let directions = std::array::from_fn(|number| direction(body, motion, number));
    let mut columns = RigidColumns { directions, loads: Loads::default(), along: [Loads::default(); 12] };
    for_each_contact(model, time, index, motion, |meeting| {
        let Meeting { contact, surface, field, motion } = meeting;
        let slopes = ContactSlopes::integrate(contact, surface, field, *motion, &mut workspace.contact)?;
        columns.loads += slopes.total;
        for (number, (direction, along)) in columns.directions.iter().zip(&mut columns.along).enumerate() {
            *along += contact_along(&slopes, &motion.normal, number, direction, body.pin.is_some());
        }
        Ok(())
    })?;
    spring_loads(index, body, motion, |spring: &SpringLoads| {
        columns.loads += spring.total();
        for (direction, along) in columns.directions.iter().zip(&mut columns.along) {
            *along += spring.along(&direction.placement, &direction.velocity);
        }
    })?;
    Ok(columns)
}

/// The change of a contact's loads along one direction: δg₀ = n·δp₀, δm = δPᵀn, δw₀ = δṗ₀, δW = δṖ.
///
/// Translations and turns move the gaps; turns, velocities and spins the velocities (of a pinned body, the same).
fn contact_along(slopes: &ContactSlopes, normal: &Vec3, number: usize, direction: &Direction, pinned: bool) -> Loads {
    let Direction { placement, velocity, .. } = direction;
    let mut change = Loads::default();
    if number < 6 {
        change += slopes.along_gap(normal.dot(&placement.position), &placement.gradient.tr_mul(normal));
    }
    if number >= 3 || pinned {
        change += slopes.along_velocity(&velocity.velocity, &velocity.gradient_rate);
    }
    change
}

/// Writes the block of a rigid body.
fn fill_rigid(
    matrix: &mut DMatrix<f64>,
    model: &Model,
    body: &Body,
    inertia: &RigidInertia,
    motion: &BodyMotion,
    columns: &RigidColumns,
) {
    matrix.fill(0.0);
    let free = body.pin.is_none();
    let (quaternion_at, spin_at) = if free { (3, 10) } else { (0, 4) };
    let mut accelerations = [(Vec3::zeros(), Vec3::zeros()); 12];
    for (number, acceleration) in accelerations.iter_mut().enumerate() {
        let loads = (&columns.loads, &columns.along[number]);
        *acceleration = rigid_acceleration(model, body, inertia, motion, &columns.directions[number], loads);
    }
    let mut write = |column: usize, (linear, angular): &(Vec3, Vec3)| {
        if free {
            matrix.fixed_view_mut::<3, 1>(7, column).copy_from(linear);
        }
        matrix.fixed_view_mut::<3, 1>(spin_at, column).copy_from(angular);
    };
    for axis in 0..3 {
        if free {
            write(axis, &accelerations[axis]);
            write(7 + axis, &accelerations[6 + axis]);
        }
        write(spin_at + axis, &accelerations[9 + axis]);
    }
    for component in 0..4 {
        let turn = motion.quaternion.turn_of_component(component);
        let (mut linear, mut angular) = (Vec3::zeros(), Vec3::zeros());
        for axis in 0..3 {
            linear += turn[axis] * accelerations[3 + axis].0;
            angular += turn[axis] * accelerations[3 + axis].1;
        }
        write(quaternion_at + component, &(linear, angular));
    }
    fill_kinematics(matrix, motion, free, quaternion_at, spin_at);
}

/// ∂ṗ₀/∂ṗ₀ = 1, and q̇ = ½ q ∘ (0, Ω), linear in q and in Ω.
fn fill_kinematics(matrix: &mut DMatrix<f64>, motion: &BodyMotion, free: bool, quaternion_at: usize, spin_at: usize) {
    if free {
        for axis in 0..3 {
            matrix[(axis, 7 + axis)] = 1.0;
        }
    }
    for component in 0..4 {
        let mut unit = crate::kinematics::Quaternion([0.0; 4]);
        unit.0[component] = 1.0;
        for (row, value) in unit.rate(&motion.spin).into_iter().enumerate() {
            matrix[(quaternion_at + row, quaternion_at + component)] = value;
        }
    }
    for axis in 0..3 {
        let mut unit = Vec3::zeros();
        unit[axis] = 1.0;
        for (row, value) in motion.quaternion.rate(&unit).into_iter().enumerate() {
            matrix[(quaternion_at + row, spin_at + axis)] = value;
        }
    }
}

/// The change of (p̈₀, Ω̇) along one direction.
fn rigid_acceleration(
    model: &Model,
    body: &Body,
    inertia: &RigidInertia,
    motion: &BodyMotion,
    direction: &Direction,
    (loads, change): (&Loads, &Loads),
) -> (Vec3, Vec3) {
    let rotation = &motion.placement.gradient;
    // τ = axial(RᵀM): δτ = axial(−[δθ]× RᵀM + Rᵀ δM).
    let turned = -cross_matrix(&direction.turn) * rotation.tr_mul(&loads.moment);
    let mut torque = crate::tensor::axial(&(turned + rotation.tr_mul(&change.moment)));
    if let Some(pin) = &body.pin {
        let force = rotation.tr_mul(&(loads.force + body.mass.mass * model.gravity));
        let arm_force = rotation.tr_mul(&change.force) - direction.turn.cross(&force);
        torque -= pin.point.cross(&arm_force);
    }
    let spin = &motion.spin;
    let gyroscopic = direction.spin.cross(&(inertia.tensor * spin)) + spin.cross(&(inertia.tensor * direction.spin));
    (change.force / body.mass.mass, inertia.inverse * (torque - gyroscopic))
}
