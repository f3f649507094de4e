//! Spheres that feel one another and planes through the fluid: exact Jacobian, who belongs together, touch.

use crate::between::{assert_blocks_are_derivatives, state_at};
use crate::moving::*;
use gyration::Inadmissible;
use gyration::Quantity;
use gyration::body::{Body, BodyKind, RigidInertia};
use gyration::dynamics::{Workspace, loads_by_kind};
use gyration::fluid::{FixedForm, Form, Inclusion};
use gyration::load::{Frame, Spring, SpringLaw};
use gyration::model::Model;
use gyration::shape::{Shape, Sphere};
use gyration::state::State;
use gyration::support::{Support, SupportMotion};
use gyration::tensor::Vec3;
use std::f64::consts::PI;

const RADII: [f64; 3] = [0.5, 0.3, 0.4];

/// A rigid sphere in the fluid.
fn sphere(radius: f64, inertia: bool, walls: bool) -> Body {
    let soft =
        body(Shape::Sphere(Sphere { radius }), Variant { incompressible: false, pinned: false, frame: Frame::Space });
    let kind = BodyKind::Rigid(RigidInertia::new(&soft.solid.mass, None).unwrap());
    let matrix = FixedForm::of_ellipsoid(&Vec3::from_element(radius));
    let inclusion = Inclusion {
        inertia,
        volume: 4.0 / 3.0 * PI * radius.powi(3),
        center: Vec3::zeros(),
        form: Form::Fixed(Box::new(FixedForm { matrix, error: 0.0 })),
        history: None,
        neighbours: Some(radius),
        walls: walls.then_some(radius),
    };
    Body { kind, inclusion: Some(inclusion), ..soft }
}

fn floor() -> Support {
    let tilt = Vec3::new(0.1, -0.2, 1.0).normalize();
    Support { name: "floor".into(), origin: Vec3::zeros(), normal: tilt, motion: SupportMotion::default() }
}

/// Three of them, some without inertia, and one dashpot.
fn model(inertia: [bool; 3], walls: bool) -> Model {
    let bodies: Vec<Body> =
        RADII.into_iter().zip(inertia).map(|(radius, inertia)| sphere(radius, inertia, walls)).collect();
    let law = SpringLaw { stiffness: 2.0, rest_length: 0.3, damping: 0.6 };
    let spring = Spring::between([0, 2], [Vec3::new(0.1, 0.2, 0.0), Vec3::new(0.0, -0.2, 0.1)], law);
    Model::new(Vec3::new(0.1, 0.2, -9.81), vec![floor()], bodies).in_fluid(fluid()).with_springs(vec![spring])
}

/// Near one another and the floor.
fn near(model: &Model) -> State {
    let places = [Vec3::new(0.0, 0.0, 0.75), Vec3::new(0.9, 0.1, 0.6), Vec3::new(0.3, 0.2, 1.9)];
    state_at(model, |body| places[body])
}

#[test]
fn jacobian_of_spheres_in_a_fluid_is_exact() {
    for walls in [false, true] {
        for inertia in [[true; 3], [false; 3], [true, false, true], [false, true, false]] {
            let model = model(inertia, walls);
            assert_blocks_are_derivatives(&model, &near(&model));
        }
    }
}

#[test]
fn spheres_in_a_fluid_hang_together_and_part_with_it() {
    let model = model([true, false, true], false).with_springs(Vec::new());
    assert_eq!(model.endless_chain().collect::<Vec<_>>(), [[0, 1], [1, 2]]);
    assert!((0..3).all(|body| model.is_joined(body)));
    // Alone, one has nobody to feel.
    assert!(model.part(&[1]).spheres().is_none());
    assert_eq!(model.part(&[0, 2]).spheres().unwrap().bodies(), [0, 1]);
}

#[test]
fn touching_is_outside_the_model() {
    let model = model([true; 3], true);
    let at = |places: [Vec3; 3]| {
        let state = state_at(&model, |body| places[body]);
        let mut workspace = Workspace::default();
        let read = workspace.read(&model, &state);
        read.and_then(|(instant, scratch)| loads_by_kind(&instant.at(0), scratch).map(|_| ())).unwrap_err()
    };
    let far = Vec3::new(5.0, 5.0, 5.0);
    let Inadmissible { body, quantity, .. } = at([Vec3::new(0.0, 0.0, 2.0), Vec3::new(0.0, 0.0, 2.3), far]);
    assert_eq!((body, quantity), (0, Quantity::FluidGap { other: 1 }));
    let Inadmissible { body, quantity, .. } = at([Vec3::new(0.0, 0.0, 0.2), Vec3::new(5.0, 0.0, 2.3), far]);
    assert_eq!((body, quantity), (0, Quantity::Gap { support: 0 }));
}
