//! The resistance of the bodies of a scene in a viscous fluid: the matrix from velocity and velocity gradient to force
//! and affine moment.
//!
//!   (f; Nᵀ row by row) = −H (v − u∞; L − L∞ row by row),   N = ∫ (x − p₀) ⊗ t dA
//!
//! The labels of the rows are older than the one convention for N: the row `N_xy` is ∫ t_x (y − p₀y) dA, the entry yx
//! of N; files of users have them. The matrix is that of each body as it starts, in the axes of space, about its centre
//! of mass. Ellipsoids have it in closed form, other shapes by boundary elements over the image of their surface. At a
//! frequency, the complex resistances of spheres are given instead.

use super::elements::{BoundaryElements, Wall, boundary_resistance};
use gyration::body::Body;
use gyration::fluid::FixedForm;
use gyration::fluid::unsteady::vibration::vibration;
use gyration::load::Mat12;
use gyration::shape::{Shape, Sphere};
use gyration::tensor::Mat3;
use gyration_scene::{Scene, TRIANGLES, suggestion};
use serde_json::{Value, json};
use std::f64::consts::TAU;
use std::ops::RangeInclusive;
use std::sync::Arc;

pub use gyration::fluid::unsteady::vibration::Vibration;

/// How many triangles may be asked for.
pub const TRIANGLES_ALLOWED: RangeInclusive<u32> = 80..=10_000;
/// What rows and columns of the matrix are.
const AXES: [&str; 3] = ["x", "y", "z"];

/// What of a resistance is asked: the options of `gyration resistance`.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ResistanceOptions {
    /// The support that stands beside the body as a wall, by name.
    pub wall: Option<String>,
    /// How many triangles the surface of the body has at least.
    pub triangles: Option<u32>,
    /// Boundary elements, also where there is a closed form.
    pub elements: bool,
    /// Small vibrations at a frequency [Hz].
    pub frequency: Option<f64>,
}

impl ResistanceOptions {
    /// Refuses a number of triangles out of range, and options that exclude each other.
    fn check(&self) -> Result<(), NoSuchResistance> {
        if let Some(triangles) = self.triangles.filter(|count| !TRIANGLES_ALLOWED.contains(count)) {
            let fix = format!("give from {} to {}", TRIANGLES_ALLOWED.start(), TRIANGLES_ALLOWED.end());
            return Err(NoSuchResistance::new(format!("{triangles} triangles are too few or too many"), fix));
        }
        if self.frequency.is_some() && (self.elements || self.triangles.is_some() || self.wall.is_some()) {
            let fix = "leave out the frequency, or what asks for boundary elements";
            return Err(NoSuchResistance::new("a frequency is for spheres in closed form, far from walls", fix));
        }
        Ok(())
    }
}

/// Why there is no resistance.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{problem}\n  fix: {fix}")]
pub struct NoSuchResistance {
    /// What is wrong.
    pub problem: String,
    /// What to do.
    pub fix: String,
}

impl NoSuchResistance {
    fn new(problem: impl Into<String>, fix: impl Into<String>) -> Self {
        Self { problem: problem.into(), fix: fix.into() }
    }
}

/// The resistances of bodies of a scene.
#[derive(Debug, Clone)]
pub struct Resistances {
    /// η [Pa s]; 1 where the scene has no fluid.
    pub viscosity: f64,
    /// Whether the scene has a fluid.
    pub has_fluid: bool,
    /// The bodies asked for.
    pub bodies: Vec<BodyResistance>,
}

/// The resistance of a body.
#[derive(Debug, Clone)]
pub struct BodyResistance {
    /// Its name.
    pub name: String,
    /// What the fluid answers with.
    pub response: FluidResponse,
}

/// What a fluid answers with to a motion.
#[derive(Debug, Clone)]
pub enum FluidResponse {
    /// A steady one: the matrix H.
    Steady(Box<ResistanceMatrix>),
    /// Small vibrations at a frequency [Hz]: complex resistances.
    Vibrating(f64, Vibration),
}

/// A matrix, and how it was come by.
#[derive(Debug, Clone)]
pub struct ResistanceMatrix {
    /// H.
    pub matrix: Mat12,
    /// By boundary elements: how many triangles, and the estimated relative error of the power; none in closed form.
    pub elements: Option<(usize, f64)>,
}

impl Resistances {
    /// The resistance of one body of a scene by its name, or of all.
    ///
    /// # Errors
    /// [`NoSuchResistance`] where there is no such body or wall, or no such resistance of it.
    pub fn of(scene: &Scene, only: Option<&str>, options: &ResistanceOptions) -> Result<Self, NoSuchResistance> {
        options.check()?;
        let model = &scene.built().model;
        let named = |(index, _): &(usize, &Arc<Body>)| only.is_none_or(|name| model.name(*index) == name);
        let bodies: Vec<(usize, &Arc<Body>)> = model.bodies.iter().enumerate().filter(named).collect();
        if bodies.is_empty() {
            let only = only.unwrap_or_default();
            let fix = format!("{}; or write the scene alone", suggestion(only, model.names(), "bodies"));
            return Err(NoSuchResistance::new(format!("the scene has no body {only:?}"), fix));
        }
        let request = ResistanceRequest::of(scene, options)?;
        let of = |(index, body): (usize, &Arc<Body>)| {
            let response = match options.frequency {
                Some(frequency) => {
                    FluidResponse::Vibrating(frequency, request.vibration((model.name(index), body), frequency)?)
                }
                None => FluidResponse::Steady(Box::new(request.matrix(scene, index)?)),
            };
            Ok(BodyResistance { name: model.name(index).to_owned(), response })
        };
        let bodies = bodies.into_iter().map(of).collect::<Result<_, _>>()?;
        Ok(Self { viscosity: request.viscosity, has_fluid: model.fluid.is_some(), bodies })
    }

    /// What `gyration resistance --json` prints of a scene of this name.
    pub fn to_json(&self, scene: &str) -> Value {
        let bodies: Vec<Value> = self.bodies.iter().map(BodyResistance::to_json).collect();
        json!({ "scene": scene, "viscosity": self.viscosity, "bodies": bodies })
    }
}

impl BodyResistance {
    fn to_json(&self) -> Value {
        match &self.response {
            FluidResponse::Steady(found) => found.to_json(&self.name),
            FluidResponse::Vibrating(frequency, found) => {
                let Vibration { translation, rotation, strain, expansion } = found;
                json!({
                    "name": self.name,
                    "frequency": frequency,
                    "translation": [translation.re, translation.im],
                    "rotation": [rotation.re, rotation.im],
                    "strain": [strain.re, strain.im],
                    "expansion": [expansion.re, expansion.im],
                })
            }
        }
    }
}

impl ResistanceMatrix {
    fn to_json(&self, name: &str) -> Value {
        let rows: Vec<Vec<f64>> = (0..12).map(|row| self.matrix.row(row).iter().copied().collect()).collect();
        let names = |vector: &str, tensor: &str| -> Vec<String> {
            let pairs = AXES.iter().flat_map(|a| AXES.map(|b| format!("{tensor}_{a}{b}")));
            AXES.iter().map(|axis| format!("{vector}_{axis}")).chain(pairs).collect()
        };
        json!({
            "name": name,
            "method": if self.elements.is_some() { "boundary elements" } else { "closed form" },
            "triangles": self.elements.map(|(triangles, _)| triangles),
            "estimated_relative_error": self.elements.map(|(_, error)| error),
            "columns": names("v", "L"),
            "rows": names("f", "N"),
            "matrix": rows,
        })
    }
}

/// What is asked, and of which fluid.
struct ResistanceRequest {
    /// η; 1 where the scene has no fluid.
    viscosity: f64,
    /// 0 where the scene has no fluid, or one without inertia.
    density: f64,
    triangles: usize,
    /// By boundary elements, whatever the shape.
    by_elements: bool,
    /// A wall, in axes of space.
    wall: Option<Wall>,
}

impl ResistanceRequest {
    fn of(scene: &Scene, options: &ResistanceOptions) -> Result<Self, NoSuchResistance> {
        let model = &scene.built().model;
        let wall = options.wall.as_ref().map(|name| {
            let found = model.supports.iter().find(|support| support.name == *name);
            let names: Vec<&str> = model.supports.iter().map(|support| support.name.as_str()).collect();
            let fix = match names.is_empty() {
                true => "add a [[support]] with that name: its plane is the wall".to_owned(),
                false => format!("write one of {}", names.join(", ")),
            };
            let wall = found.map(|support| Wall {
                point: support.origin + support.motion.displacement(0.0),
                normal: support.normal,
            });
            wall.ok_or_else(|| NoSuchResistance::new(format!("the scene has no support {name:?} for a wall"), fix))
        });
        Ok(Self {
            viscosity: model.fluid.as_deref().map_or(1.0, |fluid| fluid.viscosity),
            density: model.fluid.as_deref().map_or(0.0, |fluid| fluid.density),
            triangles: options.triangles.map_or(TRIANGLES, |count| count as usize),
            by_elements: options.elements || options.triangles.is_some() || wall.is_some(),
            wall: wall.transpose()?,
        })
    }

    /// The matrix of a body as it starts.
    fn matrix(&self, scene: &Scene, index: usize) -> Result<ResistanceMatrix, NoSuchResistance> {
        let built = scene.built();
        let body = &built.model.bodies[index];
        let placement = built.state.motion(&built.model, index).placement;
        let center = body.solid.mass.center;
        if let (Some(semi_axes), false) = (body.solid.shape.semi_axes(), self.by_elements) {
            let matrix = FixedForm::of_image(&(placement.gradient * Mat3::from_diagonal(&semi_axes)));
            let matrix = FixedForm::shifted(&matrix, &-(placement.gradient * center)).matrix * self.viscosity;
            return Ok(ResistanceMatrix { matrix, elements: None });
        }
        let elements = BoundaryElements {
            triangles: self.triangles,
            center,
            gradient: placement.gradient,
            // In axes of space about the centre of mass.
            wall: self.wall.map(|wall| Wall { point: wall.point - placement.position, ..wall }),
        };
        let found = boundary_resistance(&body.solid.shape, &elements).map_err(|error| {
            let fix = "take another shape, another number of triangles, or another place beside the wall";
            NoSuchResistance::new(format!("body {:?}: {error}", scene.built().model.name(index)), fix)
        })?;
        let matrix = found.matrix * self.viscosity;
        Ok(ResistanceMatrix { matrix, elements: Some((found.triangles, found.error)) })
    }

    fn vibration(&self, (name, body): (&str, &Body), frequency: f64) -> Result<Vibration, NoSuchResistance> {
        let Shape::Sphere(Sphere { radius }) = body.solid.shape else {
            let problem = format!("body {name:?} is no sphere: only a sphere vibrates in closed form");
            return Err(NoSuchResistance::new(problem, "name a sphere: SCENE:BODY, or leave out --frequency"));
        };
        if self.density == 0.0 {
            let fix = "give the scene a [fluid] with a `density` in kg/m³: it is the inertia of the fluid that counts";
            return Err(NoSuchResistance::new("the fluid has no density, and answers alike at all frequencies", fix));
        }
        Ok(vibration(radius, self.viscosity, self.density, TAU * frequency))
    }
}
