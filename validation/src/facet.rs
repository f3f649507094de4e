//! A body whose whole surface is one square facet that faces the plane z = 0.
//!
//! Some answers are of a single face; a scene's body radiates from all of its faces, so that this one is made by hand.
//! The centre of mass is the centre of the square: where that is level, the body moves without turning.

use crate::Experiment;
use gyration::affine::{AffineBody, Viscosity};
use gyration::body::{Affine, Body, BodyKind, RigidInertia, Solid};
use gyration::contact::{AreaMeasure, Contact, ContactLaw, LawSet};
use gyration::kinematics::Quaternion;
use gyration::mass::MassProperties;
use gyration::material::Material;
use gyration::model::Model;
use gyration::shape::{Cuboid, Shape};
use gyration::state::{RigidStart, Start, State};
use gyration::support::{Support, SupportMotion};
use gyration::surface::Surface;
use gyration::tensor::{Mat3, Vec3};
use gyration_sim::Tolerance;
use std::sync::Arc;

/// One square facet above the plane z = 0.
#[derive(Debug, Clone)]
pub struct FacetBody {
    /// Mass [kg].
    pub mass: f64,
    /// Area of the facet [m²].
    pub area: f64,
    /// The laws between facet and plane.
    pub laws: Vec<ContactLaw>,
    /// The acceleration of gravity, downward [m/s²].
    pub gravity: f64,
    /// Gap of the centre at the start [m].
    pub gap: f64,
    /// Tilt about the y axis at the start [rad], the edge x = −side/2 lowest for a negative one.
    pub tilt: f64,
    /// Upward velocity at the start [m/s].
    pub velocity: f64,
}

impl FacetBody {
    /// The experiment with this body, named `facet`.
    ///
    /// # Panics
    /// If mass or area is not positive.
    pub fn experiment(&self, tolerance: Tolerance) -> Experiment {
        let side = self.area.sqrt();
        let half = 0.5 * side;
        let corners = [(-half, -half), (-half, half), (half, half), (half, -half)].map(|(x, y)| Vec3::new(x, y, 0.0));
        // Outward is downward.
        let surface = Surface::from_triangles(&corners, &[[0, 1, 2], [0, 2, 3]]);
        let euler_tensor = Mat3::from_diagonal_element(self.mass * self.area / 12.0);
        let mass = MassProperties { mass: self.mass, center: Vec3::zeros(), euler_tensor, volume: side.powi(3) };
        let inertia = RigidInertia::new(&mass, None).unwrap_or_else(|error| panic!("{error}"));
        let body = Body {
            kind: BodyKind::Rigid(inertia),
            solid: Arc::new(Solid::with_surface(
                Shape::Box(Cuboid { size: Vec3::repeat(side) }),
                mass,
                surface.unwrap_or_else(|error| panic!("{error}")),
            )),
            inclusion: None,
            own: Default::default(),
            pin: None,
            guide: None,
            size: side,
        };
        let plane = Support {
            name: "plane".into(),
            origin: Vec3::zeros(),
            normal: Vec3::z(),
            motion: SupportMotion::default(),
        };
        let model = Model::new(Vec3::new(0.0, 0.0, -self.gravity), vec![plane], vec![body]).named(["facet"]);
        let model =
            model.with_contacts(vec![Contact::new(0, 0, LawSet::new(AreaMeasure::default(), self.laws.clone()))]);
        let start = RigidStart {
            position: Vec3::new(0.0, 0.0, self.gap),
            orientation: Quaternion::from_axis_angle(&Vec3::y(), self.tilt),
            velocity: Vec3::new(0.0, 0.0, self.velocity),
            angular_velocity: Vec3::zeros(),
        };
        let start = State::start(&model, &[start.into()]);
        Experiment::of_model(model, start, tolerance)
    }

    /// The same with a body that deforms, of this material, under tractions in a measure of area.
    ///
    /// # Panics
    /// As [`FacetBody::experiment`].
    pub fn deformable(&self, material: Material, measure: AreaMeasure, tolerance: Tolerance) -> Experiment {
        let Experiment { model, start, .. } = self.experiment(tolerance);
        let motion = start.motion(&model, 0);
        let bodies = model.bodies.into_iter().map(|body| {
            let interior = AffineBody::new(&body.solid.mass, None, Some(material.clone()), Viscosity::default());
            let affine = Affine::from(interior.unwrap_or_else(|error| panic!("{error}")));
            Body { kind: BodyKind::Affine(Box::new(affine)), ..(*body).clone() }
        });
        let model = Model::new(model.gravity, model.supports, bodies).named(["facet"]);
        let model = model.with_contacts(vec![Contact::new(0, 0, LawSet::new(measure, self.laws.clone()))]);
        let start = State::start(&model, &[Start::Affine(motion.placement, motion.velocity)]);
        Experiment::of_model(model, start, tolerance)
    }
}
