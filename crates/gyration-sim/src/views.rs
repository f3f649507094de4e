//! What the run loop needs to know of every body at the end of a step: its motion, and the acceleration of its centre.
//!
//! The stepper has the rates there, so that nothing is integrated anew. Of a pinned body p₀ = a − R r, with the angular
//! acceleration Ω̇,
//!
//!   p̈₀ = −R ([Ω̇]× + [Ω]×²) r,   of an affine one p̈₀ = −P̈ r
//!
//! The force of the contacts follows from the balance, f = m (p̈₀ − g), where nothing else pulls at the body. A body without
//! inertia has its velocities among the rates, and no accelerations.

use gyration::body::{Body, BodyKind};
use gyration::model::Model;
use gyration::state::{BodyMotion, Turn};
use gyration::tensor::{Mat3, Vec3};

/// A body at the end of a step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct View {
    /// Placement, velocity, spin.
    pub motion: BodyMotion,
    /// p̈₀, the acceleration of the centre of mass [m/s²].
    pub acceleration: Vec3,
    /// P̈ [1/s²] of a body that deforms.
    pub stretching: Option<Mat3>,
}

impl View {
    /// Reads a body's blocks of the state and of its rates.
    pub fn of(body: &Body, block: &[f64], rates: &[f64]) -> Self {
        if !body.has_inertia() {
            let stretching = body.affine().map(|_| Mat3::zeros());
            return Self { motion: BodyMotion::of_rates(body, block, rates), acceleration: Vec3::zeros(), stretching };
        }
        let motion = BodyMotion::unpack(body, block);
        let vector = |at: usize| Vec3::new(rates[at], rates[at + 1], rates[at + 2]);
        let matrix = |at: usize| Mat3::from_column_slice(&rates[at..at + 9]);
        let (acceleration, stretching) = match (&body.kind, &body.pin) {
            (BodyKind::Rigid(_), None) => (vector(7), None),
            (BodyKind::Rigid(_), Some(pin)) => {
                let (spin, arm) = (Turn::unpack(body, block).spin, &pin.point);
                (-(motion.placement.gradient * (vector(4).cross(arm) + spin.cross(&spin.cross(arm)))), None)
            }
            (BodyKind::Affine(_) | BodyKind::Contractile(_), None) => (vector(12), Some(matrix(15))),
            (BodyKind::Affine(_) | BodyKind::Contractile(_), Some(pin)) => (-(matrix(9) * pin.point), Some(matrix(9))),
        };
        Self { motion, acceleration, stretching }
    }

    /// |f| of the contacts [N]; none where pins, springs, friction or a controller take a part of the load.
    pub fn contact_force(&self, model: &Model, body: &Body) -> Option<f64> {
        let resisted = body.affine().is_some_and(|affine| !affine.resistances.is_empty()) || model.is_controlled();
        let alone = body.pin.is_none() && body.springs.is_empty() && !resisted && body.inclusion.is_none();
        alone.then(|| body.mass.mass * (self.acceleration - model.gravity).norm())
    }
}

/// Renews the views of all bodies.
pub(crate) fn renew(views: &mut Vec<View>, model: &Model, bodies: &[f64], rates: &[f64]) {
    views.clear();
    let blocks = model.bodies.iter().zip(model.blocks());
    views.extend(blocks.map(|(body, block)| View::of(body, &bodies[block.clone()], &rates[block.clone()])));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Job, MemorySink, Provenance, Simulation, Unwatched};
    use gyration::balance::observe;
    use gyration::rates::{Workspace, rates};
    use gyration_scene::Scene;

    fn views(scene: &Scene, state: &gyration::state::State) -> Vec<View> {
        let model = &scene.built().model;
        let mut slopes = vec![0.0; model.dimension()];
        let mut powers = vec![0.0; model.works().len()];
        rates(model, &mut Workspace::default(), state.time, &state.bodies, &mut slopes, &mut powers).unwrap();
        let mut views = Vec::new();
        renew(&mut views, model, &state.bodies, &slopes);
        views
    }

    #[test]
    fn the_contact_force_of_the_balance_is_that_of_the_integrals() {
        let scene = Scene::open("slide", &[]).unwrap();
        let (model, state) = (&scene.built().model, &scene.built().state);
        let found = views(&scene, state)[0].contact_force(model, &model.bodies[0]).unwrap();
        let integrated = observe(model, &mut Workspace::default(), state, 0).unwrap().contact_force.norm();
        // Differences of accelerations of the size of g: a few roundings of the weight.
        let weight = model.bodies[0].mass.mass * 9.81;
        assert!((found - integrated).abs() < 1e-14 * (weight + integrated), "{found} {integrated}");
    }

    /// The centre of a pinned body runs on a circle; differences of its velocity along the run give its acceleration.
    #[test]
    fn the_acceleration_of_a_pinned_centre_is_the_rate_of_its_velocity() {
        let text = r#"
            time = { end = 0.3, sample = 1e-4 }
            [[body]]
            name = "pendulum"
            shape = { box = { size = [0.1, 0.2, 0.3] } }
            density = 1000
            angular_velocity = [1, 2, 3]
            pin = [0.02, 0.03, 0.15]
        "#;
        let scene = Scene::parse("pinned.toml", text, std::path::Path::new(""), &[]).unwrap();
        let job = Job::of(&scene, &Provenance { version: String::new(), commit: None });
        let mut sink = MemorySink::default();
        let mut simulation = Simulation::new(job.model, job.start, job.plan).unwrap();
        simulation.begin(&mut sink).unwrap();
        simulation.run(&mut sink, &mut Unwatched).unwrap();
        let velocity = |k: usize| Vec3::from_column_slice(&sink.rows[k].1[12..15]);
        let last = sink.rows.len() - 1;
        let difference = (3.0 * velocity(last) - 4.0 * velocity(last - 1) + velocity(last - 2)) / 2e-4;
        let acceleration = views(&scene, &simulation.state())[0].acceleration;
        // One-sided differences of second order: h²/3 of the third derivative, some 1e3 m/s⁴ here; 1e-5 m/s² in all.
        assert!(
            (acceleration - difference).norm() < 3e-5 * acceleration.norm().max(1.0),
            "{acceleration} {difference}"
        );
    }
}
