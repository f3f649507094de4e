//! `gyration resistance`: the matrix from velocity and velocity gradient to force and affine moment of the fluid.
//!
//!   (f; N row by row) = −H (v − u∞; L − L∞ row by row),   N = ∫ t ⊗ (x − p₀) dA
//!
//! of each body as it starts, in the axes of space, about its centre of mass. Ellipsoids have it in closed form, other shapes by
//! boundary elements over the image of their surface. At a frequency, the complex resistances of spheres are told instead.

use crate::arguments::{Resistance, SceneArguments};
use crate::error::{CliError, code};
use crate::library::ResistanceOptions;
use crate::output;
use crate::summary::plain;
use gyration::body::Body;
use gyration::fluid::FixedForm;
use gyration::fluid::memory::vibration::{Vibration, vibration};
use gyration::load::Mat12;
use gyration::shape::{Shape, Sphere};
use gyration::tensor::Mat3;
use gyration_scene::{Scene, TRIANGLES};
use gyration_sim::resistance::{BoundaryElements, Wall, boundary_resistance};
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::path::Path;

/// What rows and columns of the matrix are.
const AXES: [&str; 3] = ["x", "y", "z"];
/// Entries below this part of the largest of their block are printed as zero: rounding.
const ROUNDING: f64 = 1e-13;

/// Prints the resistance of the bodies.
pub fn execute(arguments: &Resistance) -> Result<u8, CliError> {
    let (scene, only) = open(arguments)?;
    let options = ResistanceOptions {
        wall: arguments.wall.clone(),
        triangles: arguments.triangles,
        elements: arguments.elements,
        frequency: arguments.frequency,
    };
    let told = of_bodies(&scene, only.as_deref(), &options)?;
    output::print(&if arguments.json { format!("{:#}\n", told.json) } else { told.text })?;
    Ok(code::DONE)
}

/// The resistances of bodies, in words and in data.
pub(crate) struct Told {
    pub text: String,
    pub json: Value,
}

/// The resistance of one body of a scene, or of all.
pub(crate) fn of_bodies(scene: &Scene, only: Option<&str>, options: &ResistanceOptions) -> Result<Told, CliError> {
    let model = &scene.built().model;
    let named = |body: &&Body| only.is_none_or(|name| body.name == name);
    let bodies: Vec<(usize, &Body)> = model.bodies.iter().enumerate().filter(|(_, body)| named(body)).collect();
    if bodies.is_empty() {
        let names: Vec<&str> = model.bodies.iter().map(|body| body.name.as_str()).collect();
        let fix = format!("write one of {}, or the scene alone", names.join(", "));
        return Err(CliError::arguments(format!("the scene has no body {:?}", only.unwrap_or_default()), fix));
    }
    let wanted = Wanted::of(scene, options)?;
    let mut text = String::new();
    let mut values = Vec::new();
    for (index, body) in bodies {
        match options.frequency {
            Some(frequency) => wanted.vibration(body, frequency).map(|found| {
                values.push(vibration_in_json(body, frequency, &found));
                write_vibration(&mut text, body, frequency, &found);
            })?,
            None => wanted.matrix(scene, index).map(|found| {
                values.push(found.in_json(body));
                found.write(&mut text, body, &wanted);
            })?,
        }
    }
    let json = json!({ "scene": scene.name(), "viscosity": wanted.viscosity, "bodies": values });
    Ok(Told { text, json })
}

/// The scene, and the body named behind a colon.
fn open(arguments: &Resistance) -> Result<(Scene, Option<String>), CliError> {
    let Resistance { scene, overrides, .. } = arguments;
    let open = |scene: &str| super::open(&SceneArguments { scene: scene.to_owned(), overrides: overrides.clone() });
    match scene.rsplit_once(':').filter(|_| !Path::new(scene).is_file()) {
        Some((before, body)) => Ok((open(before)?, Some(body.to_owned()))),
        None => Ok((open(scene)?, None)),
    }
}

/// What is asked, and of which fluid.
struct Wanted {
    /// η; 1 where the scene has no fluid.
    viscosity: f64,
    density: f64,
    has_fluid: bool,
    triangles: usize,
    /// By boundary elements, whatever the shape.
    by_elements: bool,
    /// A wall, in axes of space.
    wall: Option<Wall>,
}

impl Wanted {
    fn of(scene: &Scene, options: &ResistanceOptions) -> Result<Self, CliError> {
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
            wall.ok_or_else(|| CliError::arguments(format!("the scene has no support {name:?} for a wall"), fix))
        });
        Ok(Self {
            viscosity: model.fluid.as_ref().map_or(1.0, |fluid| fluid.viscosity),
            density: model.fluid.as_ref().map_or(0.0, |fluid| fluid.density),
            has_fluid: model.fluid.is_some(),
            triangles: options.triangles.map_or(TRIANGLES, |count| count as usize),
            by_elements: options.elements || options.triangles.is_some() || wall.is_some(),
            wall: wall.transpose()?,
        })
    }

    /// The matrix of a body as it starts.
    fn matrix(&self, scene: &Scene, index: usize) -> Result<Found, CliError> {
        let built = scene.built();
        let body = &built.model.bodies[index];
        let placement = built.state.motion(&built.model, index).placement;
        let center = body.mass.center;
        if let (Some(semi_axes), false) = (body.shape.semi_axes(), self.by_elements) {
            let matrix = FixedForm::of_image(&(placement.gradient * Mat3::from_diagonal(&semi_axes)));
            let matrix = FixedForm::shifted(&matrix, &-(placement.gradient * center)).matrix * self.viscosity;
            return Ok(Found { matrix, error: None, triangles: None });
        }
        let elements = BoundaryElements {
            triangles: self.triangles,
            center,
            gradient: placement.gradient,
            // In axes of space about the centre of mass.
            wall: self.wall.map(|wall| Wall { point: wall.point - placement.position, ..wall }),
        };
        let found = boundary_resistance(&body.shape, &elements).map_err(|error| {
            let fix = "take another shape, another number of triangles, or another place beside the wall";
            CliError::arguments(format!("body {:?}: {error}", body.name), fix)
        })?;
        let matrix = found.matrix * self.viscosity;
        Ok(Found { matrix, error: Some(found.error), triangles: Some(found.triangles) })
    }

    fn vibration(&self, body: &Body, frequency: f64) -> Result<Vibration, CliError> {
        let Shape::Sphere(Sphere { radius }) = body.shape else {
            let problem = format!("body {:?} is no sphere: only a sphere vibrates in closed form", body.name);
            return Err(CliError::arguments(problem, "name a sphere: SCENE:BODY, or leave out --frequency"));
        };
        if !self.has_fluid || self.density == 0.0 {
            let fix = "give the scene a [fluid] with a `density` in kg/m³: it is the inertia of the fluid that counts";
            return Err(CliError::arguments("the fluid has no density, and answers alike at all frequencies", fix));
        }
        Ok(vibration(radius, self.viscosity, self.density, std::f64::consts::TAU * frequency))
    }
}

/// A matrix, and how it was come by.
struct Found {
    matrix: Mat12,
    error: Option<f64>,
    triangles: Option<usize>,
}

impl Found {
    fn method(&self) -> String {
        match (self.triangles, self.error) {
            (Some(triangles), Some(error)) => {
                format!(
                    "by boundary elements, {triangles} triangles, estimated error {:.1} % of the power",
                    100.0 * error
                )
            }
            _ => "in closed form".to_owned(),
        }
    }

    fn in_json(&self, body: &Body) -> Value {
        let rows: Vec<Vec<f64>> = (0..12).map(|row| self.matrix.row(row).iter().copied().collect()).collect();
        let pairs =
            |letter: &str| AXES.iter().flat_map(|a| AXES.map(|b| format!("{letter}_{a}{b}"))).collect::<Vec<_>>();
        let names = |vector: &str, tensor: &str| {
            AXES.iter().map(|axis| format!("{vector}_{axis}")).chain(pairs(tensor)).collect::<Vec<_>>()
        };
        json!({
            "name": body.name,
            "method": if self.triangles.is_some() { "boundary elements" } else { "closed form" },
            "triangles": self.triangles,
            "estimated_relative_error": self.error,
            "columns": names("v", "L"),
            "rows": names("f", "N"),
            "matrix": rows,
        })
    }

    fn write(&self, text: &mut String, body: &Body, wanted: &Wanted) {
        let fluid = match wanted.has_fluid {
            true => format!("viscosity {} Pa s", plain(wanted.viscosity, 6)),
            false => "the scene has no fluid: for a viscosity of 1 Pa s".to_owned(),
        };
        // Writing to a string does not fail.
        let _ = writeln!(text, "body {}, {}, {fluid}", body.name, self.method());
        let _ = writeln!(text, "(f; N) = −H (v − u∞; L − L∞), about the centre of mass, axes of space\n");
        let velocities = AXES.map(|axis| format!("v_{axis}"));
        let gradients: Vec<String> = AXES.iter().flat_map(|a| AXES.map(|b| format!("L_{a}{b}"))).collect();
        let _ = writeln!(text, "force [N s/m]");
        self.block(text, (0, 3), (0, &velocities), "f");
        let _ = writeln!(text, "force by velocity gradient [N s]");
        self.block(text, (0, 3), (3, &gradients), "f");
        let _ = writeln!(text, "affine moment [N m s]");
        self.block(text, (3, 9), (3, &gradients), "N");
    }

    fn block(&self, text: &mut String, (first, rows): (usize, usize), (from, names): (usize, &[String]), letter: &str) {
        let block = self.matrix.view((first, from), (rows, names.len()));
        // A mixed block is compared with the blocks that it couples.
        let own = |at: usize, count: usize| self.matrix.view((at, at), (count, count)).amax();
        let scale = (own(first, rows) * own(from, names.len())).sqrt();
        let heads: String = names.iter().map(|name| format!("{name:>12}")).collect();
        let _ = writeln!(text, "      {heads}");
        for row in 0..rows {
            let name = match letter {
                "f" => format!("f_{}", AXES[row]),
                _ => format!("N_{}{}", AXES[row / 3], AXES[row % 3]),
            };
            let entries: String = (0..names.len())
                .map(|column| {
                    let entry = block[(row, column)];
                    let entry = if entry.abs() < ROUNDING * scale { 0.0 } else { entry };
                    format!("{:>12}", plain(entry, 5))
                })
                .collect();
            let _ = writeln!(text, "{name:<6}{entries}");
        }
        let _ = writeln!(text);
    }
}

fn vibration_in_json(body: &Body, frequency: f64, found: &Vibration) -> Value {
    let Vibration { translation, rotation, strain, expansion } = found;
    json!({
        "name": body.name,
        "frequency": frequency,
        "translation": [translation.re, translation.im],
        "rotation": [rotation.re, rotation.im],
        "strain": [strain.re, strain.im],
        "expansion": [expansion.re, expansion.im],
    })
}

fn write_vibration(text: &mut String, body: &Body, frequency: f64, found: &Vibration) {
    let _ = writeln!(
        text,
        "body {}, a sphere, small vibrations of {} Hz: load = −Z × velocity",
        body.name,
        plain(frequency, 6)
    );
    let _ = writeln!(text, "\n{:<32}{:>14}{:>14}{:>16}", "", "Re Z", "Im Z", "Im Z/ω");
    let omega = std::f64::consts::TAU * frequency;
    let lines = [
        ("force by velocity [N s/m]", found.translation),
        ("torque by spin [N m s]", found.rotation),
        ("moment by strain rate [N m s]", found.strain),
        ("moment by expansion rate [N m s]", found.expansion),
    ];
    for (name, value) in lines {
        let inertia = if omega > 0.0 { value.im / omega } else { 0.0 };
        let _ =
            writeln!(text, "{name:<32}{:>14}{:>14}{:>16}", plain(value.re, 6), plain(value.im, 6), plain(inertia, 6));
    }
    let _ = writeln!(text);
}
