//! Bodies of every kind kept to a plane, an axis, a line or strain without rotation, joined by springs, with inertia
//! and without: derivatives, power, and a reaction that closes the balance and does no work.

use crate::between::{assert_blocks_are_derivatives, bodies, joined, orientation, state};
use crate::moving::*;
use gyration::affine::StrainGuide;
use gyration::body::{Body, BodyKind, Guide, TurnGuide};
use gyration::dynamics::{Workspace, acting, reaction};
use gyration::homogeneous::observe_homogeneous;
use gyration::kinematics::Quaternion;
use gyration::load::SpringLaw;
use gyration::model::Model;
use gyration::state::State;
use gyration::tensor::{Mat3, Vec3};
use std::sync::Arc;

/// A body with a guide of some sort, about an oblique direction, from an orientation.
fn guided(body: &Body, sort: usize, (place, start): (Vec3, Quaternion)) -> Body {
    let mut body = body.clone();
    let along = Vec3::new(0.48, -0.6, 0.64);
    let center = match (sort, &body.pin) {
        (0, None) => Some(Mat3::identity() - along * along.transpose()),
        (1, None) => Some(along * along.transpose()),
        _ => None,
    };
    let mut turn = None;
    let interior = match &mut body.kind {
        BodyKind::Rigid(inertia) => {
            let axis = (sort != 3).then_some(&along);
            turn = (sort != 1).then(|| TurnGuide::new(axis, start, inertia));
            None
        }
        BodyKind::Affine(affine) => Some(&mut affine.interior),
        BodyKind::Contractile(contractile) => Some(&mut contractile.affine.interior),
    };
    if let Some(interior) = interior {
        let euler_tensor = &interior.euler_tensor;
        interior.guide = match sort {
            0 => Some(Box::new(StrainGuide::plane(&along, &start.rotation(), euler_tensor))),
            1 => None,
            _ => Some(Box::new(StrainGuide::stretch(&start.rotation(), euler_tensor))),
        };
    }
    body.guide = Some(Box::new(Guide { position: place, center, turn }));
    body
}

/// A ring of guided bodies of which one in `free` has none, and a state on the guides.
fn ring(free: usize, inertia: bool) -> (Model, State) {
    let bodies = bodies();
    let place = Vec3::new(0.2, 0.1, 1.6);
    let guided = |(k, body): (usize, &Body)| {
        let start = (place, orientation(0.1 * k as f64));
        if k % free == 2 { body.clone() } else { guided(body, k % 4, start) }
    };
    let model = Model::new(Vec3::new(0.3, -0.2, -9.81), supports(), bodies.iter().enumerate().map(guided));
    let plain = SpringLaw { stiffness: 1.9, rest_length: 0.0, damping: 0.0 };
    let model = joined(model, [SpringLaw { stiffness: 2.3, rest_length: 0.4, damping: 0.7 }, plain]);
    let model = if inertia { model } else { immersed(model, false) };
    let mut state = state(&model);
    for (index, body) in model.bodies.iter().enumerate().filter(|(_, body)| body.guide.is_some()) {
        let slots = model.slots(index);
        let own = &mut state.bodies[slots.block()];
        let (position, own) = own.split_at_mut(slots.position().len());
        let (attitude, own) = own.split_at_mut(slots.attitude().len());
        let (velocity, own) = own.split_at_mut(slots.velocity().len());
        let rate = &mut own[..slots.rate().len()];
        body.restore_guided([position, attitude, velocity, rate], &mut []);
        if let Some(affine) = body.affine() {
            let p = Mat3::from_column_slice(attitude);
            let still = Mat3::zeros();
            let moving = if rate.is_empty() { still } else { Mat3::from_column_slice(rate) };
            let corrected = affine.interior.project(&p, &moving);
            attitude.copy_from_slice(corrected.gradient.as_slice());
            if !rate.is_empty() {
                rate.copy_from_slice(corrected.rate.as_slice());
            }
            let again = body.strain_guide().map_or(corrected.gradient, |strain| strain.within(&corrected.gradient));
            assert!((again - corrected.gradient).norm() < 1e-14, "the volume is put back within the guide");
        }
    }
    (model, state)
}

#[test]
fn reactions_close_the_balance_and_do_no_work() {
    for inertia in [true, false] {
        let (model, state) = ring(99, inertia);
        let mut workspace = Workspace::default();
        let (instant, scratch) = workspace.read(&model, &state).unwrap();
        for index in 0..model.bodies.len() {
            let at = instant.at(index);
            let acting = acting(&at, scratch).unwrap();
            let Some(held) = reaction(&at, &acting, scratch).unwrap() else { continue };
            let velocity = &at.motion.velocity;
            let arm = at.body.pin.as_ref().map_or(Vec3::zeros(), |pin| pin.point);
            let about_pin = velocity.velocity + velocity.gradient_rate * arm;
            let terms =
                held.force.norm() * velocity.velocity.norm() + held.moment.norm() * velocity.gradient_rate.norm();
            // Rounding of sums of products, and of a solution without inertia.
            assert!(held.power(&about_pin, &velocity.gradient_rate).abs() <= 1e-12 * (terms + 1.0), "body {index}");
            let observed = observe_homogeneous(&at, &acting, scratch, &Vec3::zeros()).unwrap();
            let (left, size) = (observed.momentum_residual.norm(), observed.affine_moment.norm());
            assert!(left < 1e-11 * (size + 1.0), "body {index}, inertia {inertia}: {left} of {size} is left");
            if let Some(center) = at.body.guide.as_ref().and_then(|guide| guide.center) {
                let load = acting.total.force + at.body.solid.mass.mass * model.gravity;
                assert!((center * (load + held.force) - (load + held.force)).norm() < 1e-13 * load.norm());
            }
        }
    }
}

#[test]
fn blocks_of_guided_bodies_are_derivatives_and_powers_are_rates_of_energy() {
    for (free, inertia) in [(5, true), (5, false)] {
        let (model, state) = ring(free, inertia);
        assert_blocks_are_derivatives(&model, &state);
        assert_power_is_the_rate_of_energy(&model, &state);
    }
}

#[test]
fn the_space_of_a_thin_oblique_plate_is_kept_to_rounding() {
    let turn = orientation(0.6).rotation();
    let euler_tensor = turn * Mat3::from_diagonal(&Vec3::new(1.0, 0.7, 1e-8)) * turn.transpose();
    let start = orientation(1.7).rotation() * Mat3::new(1.3, 0.2, 0.0, -0.1, 0.8, 0.3, 0.4, 0.0, 1.1);
    let normal = Vec3::new(0.48, -0.6, 0.64);
    let plane = StrainGuide::plane(&normal, &start, &euler_tensor);
    let stretch = StrainGuide::stretch(&start, &euler_tensor);
    for (guide, dimension) in [(plane, 5.0), (stretch, 6.0)] {
        assert!((guide.within(&start) - start).norm() < 1e-14);
        assert!((guide.map() * guide.map() - guide.map()).norm() < 1e-11, "{}", guide.map());
        assert!((guide.map().trace() - dimension).abs() < 1e-12);
    }
}

#[test]
fn accelerations_are_the_least_changed_that_the_guide_allows() {
    // Gauss: of all accelerations that are allowed, the one nearest to the free one in the metric of the mass.
    let (model, state) = ring(99, true);
    let free = model.clone().with_bodies(model.bodies.iter().map(|body| {
        let mut free = Body { guide: None, ..(**body).clone() };
        match &mut free.kind {
            BodyKind::Affine(affine) => affine.interior.guide = None,
            BodyKind::Contractile(contractile) => contractile.affine.interior.guide = None,
            BodyKind::Rigid(_) => {}
        }
        Arc::new(free)
    }));
    let (held, unheld) = (evaluate(&model, 0.0, &state.bodies).0, evaluate(&free, 0.0, &state.bodies).0);
    let mut compared = 0;
    for (index, body) in model.bodies.iter().enumerate() {
        let Some(strain) = body.strain_guide() else { continue };
        let rate = model.slots(index).rate();
        let [held, unheld] = [&held, &unheld].map(|rates| Mat3::from_column_slice(&rates[rate.clone()]));
        let euler_tensor = body.affine().unwrap().interior.euler_tensor;
        let p = Mat3::from_column_slice(&state.bodies[model.slots(index).attitude()]);
        let across = p.try_inverse().unwrap().transpose();
        // All directions of the guide, along which an incompressible body keeps tr(P̈ P⁻¹).
        let keeps = (held - unheld).dot(&across).abs() < 1e-9 * unheld.norm();
        for k in 0..9 {
            let mut way =
                strain.within(&Mat3::from_fn(|i, j| if 3 * i + j == k { 1.0 } else { 0.3 / (i + j + 1) as f64 }));
            if keeps {
                let push = strain.within(&(across * body.affine().unwrap().interior.inverse));
                way -= push * (way.dot(&across) / push.dot(&across));
            }
            let slope = ((held - unheld) * euler_tensor).dot(&way);
            let size = (held.norm() + unheld.norm()) * euler_tensor.norm() * way.norm();
            assert!(slope.abs() < 1e-12 * size, "body {index}: {slope} of {size}");
            compared += 1;
        }
    }
    assert!(compared > 50);
}
