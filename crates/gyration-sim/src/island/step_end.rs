//! The end of a step: the motion of every body, and the acceleration of its centre.
//!
//! The stepper has the rates there, so that nothing is integrated anew. Of a pinned body p₀ = a − R r, with the angular
//! acceleration Ω̇,
//!
//!   p̈₀ = −R ([Ω̇]× + [Ω]×²) r,   of an affine one p̈₀ = −P̈ r
//!
//! The force of the contacts follows from the balance, f = m (p̈₀ − g), where nothing else pulls at the body. A body
//! without inertia has its velocities among the rates, and no accelerations.

use gyration::acting::Load;
use gyration::body::{BodyKind, matrix, vector};
use gyration::model::Model;
use gyration::state::{BodyMotion, Turn};
use gyration::tensor::{Mat3, Vec3};

/// A body at the end of a step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StepEnd {
    /// Placement, velocity, spin.
    pub motion: BodyMotion,
    /// p̈₀, the acceleration of the centre of mass [m/s²].
    pub acceleration: Vec3,
    /// P̈ [1/s²] of a body that deforms.
    pub stretching: Option<Mat3>,
}

impl StepEnd {
    /// Reads a body's slots of the state and of its rates.
    fn of(model: &Model, index: usize, state: &[f64], rates: &[f64]) -> Self {
        let (body, slots) = (&model.bodies[index], model.slots(index));
        let deforms = body.affine().is_some();
        if !body.has_inertia() {
            let stretching = deforms.then(Mat3::zeros);
            let motion = BodyMotion::of_rates(body, slots, state, rates);
            return Self { motion, acceleration: Vec3::zeros(), stretching };
        }
        let motion = BodyMotion::read(body, slots, state);
        let stretching = deforms.then(|| matrix(&rates[slots.rate()]));
        let acceleration = match (&body.pin, &body.kind, &stretching) {
            (None, ..) => vector(&rates[slots.velocity()]),
            (Some(pin), BodyKind::Rigid(_), _) => {
                let (spin, arm) = (Turn::read(slots, state).spin, &pin.point);
                -(motion.placement.gradient * (vector(&rates[slots.rate()]).cross(arm) + spin.cross(&spin.cross(arm))))
            }
            (Some(pin), ..) => stretching.map_or_else(Vec3::zeros, |stretching| -(stretching * pin.point)),
        };
        Self { motion, acceleration, stretching }
    }

    /// The same of its image in another cell, so much farther on [m].
    pub fn shifted_by(mut self, way: &Vec3) -> Self {
        self.motion.placement.position += way;
        self
    }

    /// |f| of the contacts [N]; none where a pin, a guide or another load takes a part of the weight.
    pub fn contact_force(&self, model: &Model, index: usize) -> Option<f64> {
        let body = &model.bodies[index];
        let alone = |load: Load| if load.pulls() { Err(()) } else { Ok(()) };
        let alone = model.try_each_load(index, alone).is_ok() && body.pin.is_none() && body.guide.is_none();
        alone.then(|| body.solid.mass.mass * (self.acceleration - model.gravity).norm())
    }
}

/// Reads all bodies at the end of a step, or at the start.
pub(crate) fn read(ends: &mut Vec<StepEnd>, model: &Model, state: &[f64], rates: &[f64]) {
    ends.clear();
    // One of a single body has room for no more.
    ends.reserve_exact(model.bodies.len());
    ends.extend((0..model.bodies.len()).map(|index| StepEnd::of(model, index, state, rates)));
}

#[cfg(test)]
mod tests {
    use super::*;
    use gyration::balance::observe;
    use gyration::dynamics::{Workspace, rates};
    use gyration::tensor::Mat3;
    use gyration_scene::Scene;

    fn ends(scene: &Scene, state: &gyration::state::State) -> Vec<StepEnd> {
        let model = &scene.built().model;
        let mut slopes = vec![0.0; model.dimension()];
        let mut powers = vec![0.0; model.works().len()];
        rates(model, &mut Workspace::default(), state.time, state.numbers(), &mut slopes, &mut powers).unwrap();
        let mut ends = Vec::new();
        read(&mut ends, model, &state.bodies, &slopes);
        ends
    }

    #[test]
    fn the_contact_force_of_the_balance_is_that_of_the_integrals() {
        let scene = Scene::open("slide", &[]).unwrap();
        let (model, state) = (&scene.built().model, &scene.built().state);
        let found = ends(&scene, state)[0].contact_force(model, 0).unwrap();
        let integrated = observe(model, &mut Workspace::default(), state, 0).unwrap().contact_force.norm();
        // Differences of accelerations of the size of g: a few roundings of the weight.
        let weight = model.bodies[0].solid.mass.mass * 9.81;
        assert!((found - integrated).abs() < 1e-14 * (weight + integrated), "{found} {integrated}");
    }

    /// a = ω̇ × r + ω × (ω × r), I ω̇ = r × m g − ω × I ω about the pin, r from there to the centre.
    #[test]
    fn the_acceleration_of_a_pinned_centre_is_that_of_its_turn() {
        let text = r#"
            time = { end = 0.3, sample = 0.1 }
            [[body]]
            name = "pendulum"
            shape = { box = { size = [0.1, 0.2, 0.3] } }
            density = 1000
            angular_velocity = [1, 2, 3]
            pin = [0.02, 0.03, 0.15]
        "#;
        let scene = Scene::parse("pinned.toml", text, std::path::Path::new(""), &[]).unwrap();
        let (mass, arm, spin) = (6.0, Vec3::new(-0.02, -0.03, -0.15), Vec3::new(1.0, 2.0, 3.0));
        let own = Mat3::from_diagonal(&Vec3::new(0.04 + 0.09, 0.01 + 0.09, 0.01 + 0.04)) * (mass / 12.0);
        let inertia = own + mass * (arm.norm_squared() * Mat3::identity() - arm * arm.transpose());
        let torque = arm.cross(&Vec3::new(0.0, 0.0, -9.81 * mass)) - spin.cross(&(inertia * spin));
        let exact = inertia.try_inverse().unwrap() * torque;
        let exact = exact.cross(&arm) + spin.cross(&spin.cross(&arm));
        let found = ends(&scene, &scene.built().state)[0].acceleration;
        assert!((found - exact).norm() < 1e-13 * exact.norm(), "{found} {exact}");
    }
}
