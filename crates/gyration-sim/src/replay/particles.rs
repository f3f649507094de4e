//! A recording as particles, for OVITO: extended XYZ, a frame a sample, a line a body.
//!
//! | column | unit | what |
//! |---|---|---|
//! | `type` | – | the shape, as the scene calls it |
//! | `id` | – | index of the body |
//! | `pos`, `velo` | m, m/s | p₀, ṗ₀ |
//! | `force` | N | of all contacts |
//! | `mass`, `radius` | kg, m | of the body; of the sphere about its shape |
//! | `aspherical_shape`, `orientation` | m, – | half-extents along axes of its own, and how these are turned, x y z w |
//! | | | of cylinders and capsules radius, radius and the height of the cylinder, as OVITO takes them |
//! | `angular_velocity` | rad/s | half the vorticity of Ṗ P⁻¹, in space |
//! | `placement` | – | P, row by row |
//!
//! The axes are those of the shape, P = R U with half-extents U_ii times those of the shape. A ball or an ellipsoid
//! that deforms is an ellipsoid, told exactly, by axes of its own. Numbers have as many digits as bring them back.
//! Where bodies follow one another without end, a frame has the parallelepiped that all of them fill (`cell`).
//!
//! Source of the format: the manual of OVITO, "XYZ file reader".

mod cell;

use super::{Replay, ReplayError};
use cell::FrameCell;
use gyration::model::Model;
use gyration::shape::{Capsule, Cylinder, Shape};
use gyration::state::BodyMotion;
use gyration::tensor::{Mat3, Polar, Vec3};
use gyration_record::{Recording, cannot_write};
use nalgebra::{Rotation3, UnitQuaternion};
use std::io::Write;

/// What the columns are called, of which type, and how many numbers each has.
const PROPERTIES: &str = "type:S:1:id:I:1:pos:R:3:velo:R:3:force:R:3:mass:R:1:radius:R:1:aspherical_shape:R:3:\
                          orientation:R:4:angular_velocity:R:3:placement:R:9";

/// Writes each `every`-th sample, and the last; how many there are.
///
/// # Errors
/// Those of [`Replay::open`] and [`Replay::state`]; `Record` with `Io` if `out` fails, under the recording's path.
pub fn particles_xyz(recording: &Recording, every: usize, out: &mut impl Write) -> Result<usize, ReplayError> {
    let mut replay = Replay::open(recording)?;
    let forms: Vec<Form> = (0..replay.model().bodies.len()).map(|body| Form::of(replay.model(), body)).collect();
    let last = recording.rows().saturating_sub(1);
    let rows: Vec<usize> = (0..recording.rows()).filter(|row| row % every.max(1) == 0 || *row == last).collect();
    for row in &rows {
        let state = replay.state(*row)?;
        let forces = recording.read_rows("contact_force", *row..row + 1)?.data;
        let model = replay.model();
        let motions: Vec<BodyMotion> = (0..forms.len()).map(|body| state.motion_in_space(model, body)).collect();
        let balls = motions.iter().zip(&forms).map(|(motion, form)| (motion.placement.position, form.radius));
        let cell = replay.cells().and_then(|cells| FrameCell::about(&model.lattice, cells, balls));
        let cell = cell.map_or_else(|| "pbc=\"F F F\"".to_owned(), |cell| cell.to_string());
        let mut text = format!("{}\nProperties={PROPERTIES} Time={:e} {cell}\n", forms.len(), state.time);
        for (body, (form, motion)) in forms.iter().zip(&motions).enumerate() {
            form.push(body, motion, &forces[3 * body..][..3], &mut text);
        }
        out.write_all(text.as_bytes()).map_err(cannot_write(recording.path()))?;
    }
    Ok(rows.len())
}

/// What of a body stays.
#[derive(Clone, Copy)]
struct Form {
    species: &'static str,
    mass: f64,
    radius: f64,
    /// Along the axes of the shape; of those with an axis of symmetry as OVITO takes them.
    half_extents: Vec3,
    is_ellipsoid: bool,
    deforms: bool,
}

impl Form {
    fn of(model: &Model, body: usize) -> Self {
        let solid = &model.bodies[body].solid;
        let bounds = solid.shape.bounds();
        let half_extents = match &solid.shape {
            Shape::Cylinder(Cylinder { radius, height }) | Shape::Capsule(Capsule { radius, height }) => {
                Vec3::new(*radius, *radius, *height)
            }
            _ => 0.5 * (bounds.max - bounds.min),
        };
        let is_ball = matches!(solid.shape, Shape::Sphere(_));
        let is_ellipsoid = is_ball || matches!(solid.shape, Shape::Ellipsoid(_));
        let deforms = model.bodies[body].affine().is_some();
        Self {
            species: species(&solid.shape),
            mass: solid.mass.mass,
            radius: if is_ball { half_extents.x } else { solid.radius().unwrap_or(half_extents.norm()) },
            half_extents,
            is_ellipsoid,
            deforms,
        }
    }

    /// Half-extents [m] and the rotation of their axes.
    ///
    /// An ellipsoid with the semi-axes A = diag(a) becomes that of P A Aᵀ Pᵀ: its semi-axes are the singular values of
    /// P A, along the left vectors.
    fn turned(&self, p: &Mat3) -> (Vec3, Mat3) {
        if !self.deforms {
            return (self.half_extents, *p);
        }
        if self.is_ellipsoid {
            let image = p * Mat3::from_diagonal(&self.half_extents);
            let axes = (image * image.transpose()).symmetric_eigen();
            let mut frame = axes.eigenvectors;
            if frame.determinant() < 0.0 {
                frame.column_mut(2).neg_mut();
            }
            let lengths = Vec3::from_fn(|k, _| (image.tr_mul(&frame.column(k))).norm());
            return (lengths, frame);
        }
        let Polar { rotation, stretch } = Polar::of(p);
        (stretch.diagonal().component_mul(&self.half_extents), rotation)
    }

    /// Appends the line of a body.
    fn push(&self, body: usize, motion: &BodyMotion, force: &[f64], text: &mut String) {
        let p = &motion.placement.gradient;
        let (half_extents, axes) = self.turned(p);
        let turn = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes));
        let spin = motion.angular_velocity();
        text.push_str(&format!("{} {body}", self.species));
        let numbers = motion.placement.position.iter().chain(&motion.velocity.velocity).chain(force);
        let numbers = numbers.chain([&self.mass, &self.radius]).chain(&half_extents);
        let numbers = numbers.chain(turn.coords.iter()).chain(&spin).copied();
        // nalgebra stores columns; rows are written.
        for number in numbers.chain(p.transpose().iter().copied()) {
            text.push_str(&format!(" {number:e}"));
        }
        text.push('\n');
    }
}

/// The word of the scene for a shape.
fn species(shape: &Shape) -> &'static str {
    match shape {
        Shape::Box(_) => "box",
        Shape::Sphere(_) => "sphere",
        Shape::Ellipsoid(_) => "ellipsoid",
        Shape::Cylinder(_) => "cylinder",
        Shape::Cone(_) => "cone",
        Shape::Capsule(_) => "capsule",
        Shape::Torus(_) => "torus",
        Shape::Polyhedron(_) => "polyhedron",
        Shape::Union(_) => "union",
        Shape::Points(_) => "points",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Symptom: an ellipsoid had the extents of a box that is stretched along its edges, off by a fifth.
    #[test]
    fn a_ball_and_an_ellipsoid_that_deform_are_the_ellipsoids_that_they_are() {
        let form = Form {
            species: "sphere",
            mass: 1.0,
            radius: 0.3,
            half_extents: Vec3::repeat(0.3),
            is_ellipsoid: true,
            deforms: true,
        };
        let p = Mat3::new(1.2, 0.3, -0.1, 0.0, 0.8, 0.4, 0.2, -0.5, 1.1);
        for extents in [Vec3::repeat(0.3), Vec3::new(0.5, 0.2, 0.01)] {
            let form = Form { half_extents: extents, ..form };
            let (half, axes) = form.turned(&p);
            let squares = Mat3::from_diagonal(&half.component_mul(&half));
            let image = p * Mat3::from_diagonal(&extents);
            let error = (axes * squares * axes.transpose() - image * image.transpose()).norm();
            println!("ellipsoid off by {error:.1e}");
            assert!(error < 1e-15 && (axes.determinant() - 1.0).abs() < 1e-14, "{error:e}");
        }
        // A box that is stretched along its edges and turned.
        let turn = Rotation3::from_euler_angles(0.3, -0.2, 0.9).into_inner();
        let form = Form { half_extents: Vec3::new(0.1, 0.2, 0.3), is_ellipsoid: false, ..form };
        let (half, axes) = form.turned(&(turn * Mat3::from_diagonal(&Vec3::new(2.0, 0.5, 1.5))));
        assert!((half - Vec3::new(0.2, 0.1, 0.45)).norm() < 1e-15 && (axes - turn).norm() < 1e-14);
    }
}
