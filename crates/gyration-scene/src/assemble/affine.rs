//! What a deformable body is made of and what resists it: material, internal friction, linear friction, couple.

use super::material::material;
use super::start::matrix;
use crate::check::Reporter;
use crate::file::{self, Frame as WrittenFrame};
use crate::key::Key;
use crate::table::{ReadTable, read_tensors};
use gyration::affine::{AffineBody, AnisotropicFriction, Viscosity};
use gyration::body::Affine;
use gyration::load::{Couple, Frame, LinearResistance, ResistanceError};
use gyration::mass::MassProperties;
use gyration::material::Material;
use gyration::signal::Interpolation;
use gyration::tensor::{Mat3, Vec3};
use gyration_files::Files;
use nalgebra::SMatrix;

/// All of it that does not depend on the body's mass.
#[derive(Debug, Clone)]
pub(super) struct AffineParts {
    material: Option<Material>,
    viscosity: Viscosity,
    anisotropic: Option<AnisotropicFriction>,
    couple: Option<Couple>,
    resistances: Vec<LinearResistance>,
}

impl AffineParts {
    /// Reads them at a key; notes what is wrong with any. Tables are relative to `base`.
    pub(super) fn of(written: &file::Affine, key: &Key, files: &Files, reporter: &mut Reporter<'_>) -> Option<Self> {
        let material = written.material.as_ref().map(|it| material(it, &key.key("material"), reporter));
        let internal = internal_friction(written, &key.key("internal_friction"), reporter);
        // One that changes with place or time is a force of the body's own.
        let constant = written.linear_friction.as_ref().and_then(|it| Some((it.constant()?, it.frame)));
        let friction = constant.map(|(matrix, axes)| {
            let made = LinearResistance::friction(&square(&matrix), frame(axes));
            accepted(made, &key.key("linear_friction").key("matrix"), reporter)
        });
        let gyroscopic = written.gyroscopic.as_ref().map(|it| {
            let made = LinearResistance::gyroscopic(&square(&it.matrix), frame(it.frame));
            accepted(made, &key.key("gyroscopic").key("matrix"), reporter)
        });
        let couple = written.couple.as_ref().map(|it| couple(it, &key.key("couple"), files, reporter));
        let (viscosity, anisotropic) = internal?;
        Some(Self {
            material: all(material)?,
            viscosity,
            anisotropic,
            couple: all(couple)?,
            resistances: [all(friction)?, all(gyroscopic)?].into_iter().flatten().collect(),
        })
    }

    /// The body of this mass, about its centre or a pin at `arm`; notes a mass that does not allow it.
    pub(super) fn with_mass(
        self,
        mass: &MassProperties,
        arm: Option<&Vec3>,
        places: &Places,
        reporter: &mut Reporter<'_>,
    ) -> Option<Affine> {
        let fills = self.fills_a_volume(mass, places, reporter);
        let interior = match AffineBody::new(mass, arm, self.material, self.viscosity) {
            Ok(body) if inverts(&body.euler_tensor, &body.inverse) => Some(body),
            Ok(body) => {
                let message =
                    format!("the Euler tensor, {:e} kg m², leaves the range of numbers", body.euler_tensor.amax());
                reporter.note(&places.mass, message, "change the size or the mass");
                None
            }
            Err(error) => {
                let help = "add mass off the plane, or a `pin` off the plane, or make the body rigid";
                reporter.note(&places.mass, error.to_string(), help);
                None
            }
        };
        let interior = AffineBody { anisotropic: self.anisotropic, ..interior? };
        fills.then_some(Affine { interior, couple: self.couple, resistances: self.resistances })
    }

    /// Whether the elastic deformation keeps its volume.
    pub(super) fn is_incompressible(&self) -> bool {
        self.material.as_ref().is_some_and(Material::is_incompressible)
    }

    /// Whether there is a volume where stresses need one; notes what would be without effect.
    fn fills_a_volume(&self, mass: &MassProperties, places: &Places, reporter: &mut Reporter<'_>) -> bool {
        let stressed = [
            ("material", self.material.is_some()),
            ("viscosity", self.viscosity.kirchhoff > 0.0),
            ("internal_friction", self.is_internal_friction_given()),
        ];
        let without: Vec<&str> =
            stressed.iter().filter(|(_, given)| mass.volume == 0.0 && *given).map(|it| it.0).collect();
        for name in &without {
            let help = format!("give the body a `shape` with a volume, or leave `{name}` out");
            let message = "the body has no volume, so that a stress has nothing to act on";
            reporter.note(&places.interior.key(name), message, help);
        }
        without.is_empty()
    }

    fn is_internal_friction_given(&self) -> bool {
        self.anisotropic.is_some() || self.viscosity.shear > 0.0 || self.viscosity.bulk > 0.0
    }
}

/// Where complaints go.
pub(super) struct Places {
    /// The table `affine` or `contractile`.
    pub(super) interior: Key,
    /// What gives the body its mass.
    pub(super) mass: Key,
}

/// Whether the inverse is one: far from one kilogram and metre its entries leave the range of numbers.
pub(super) fn inverts(tensor: &Mat3, inverse: &Mat3) -> bool {
    // Of all entries: the largest of a matrix passes over what is not a number.
    let residual = tensor * inverse - Mat3::identity();
    inverse.iter().all(|entry| entry.is_finite()) && residual.iter().all(|entry| entry.abs() < 0.5)
}

/// None if there is something and it failed; none inside if there is nothing.
fn all<T>(part: Option<Option<T>>) -> Option<Option<T>> {
    match part {
        None => Some(None),
        Some(made) => made.map(Some),
    }
}

fn internal_friction(
    written: &file::Affine,
    key: &Key,
    reporter: &mut Reporter<'_>,
) -> Option<(Viscosity, Option<AnisotropicFriction>)> {
    let kirchhoff = written.viscosity.value();
    let Some(given) = &written.internal_friction else {
        return Some((Viscosity { kirchhoff, ..Viscosity::default() }, None));
    };
    let value =
        |part: Option<crate::quantity::NonNegative<crate::quantity::Viscosity>>| part.map_or(0.0, |it| it.value());
    let viscosity = Viscosity { kirchhoff, shear: value(given.shear), bulk: value(given.bulk) };
    let Some(rows) = &given.matrix else { return Some((viscosity, None)) };
    if given.shear.is_some() || given.bulk.is_some() {
        let help = "keep one: the matrix of isotropic friction has bulk + 4/3 shear, bulk − 2/3 shear and shear";
        reporter.note(&key.key("matrix"), "`shear` and `bulk` stand beside it", help);
        return None;
    }
    let made = accepted(AnisotropicFriction::new(&square(rows)), &key.key("matrix"), reporter);
    made.map(|friction| (viscosity, Some(friction)))
}

fn couple(written: &file::Couple, key: &Key, files: &Files, reporter: &mut Reporter<'_>) -> Option<Couple> {
    match written {
        file::Couple::Value(rows) => Some(Couple::Constant(matrix(rows))),
        file::Couple::Table(path) => match read_tensors((files, path), 'N', Interpolation::Linear) {
            Ok(ReadTable { table, sum }) => {
                reporter.read(&key.key("table"), path, sum);
                Some(Couple::Table(table))
            }
            Err(error) => {
                reporter.note(&key.key("table"), error.to_string(), error.help(files));
                None
            }
        },
    }
}

/// What a matrix gives, if it is one of its kind.
pub(super) fn accepted<T>(made: Result<T, ResistanceError>, key: &Key, reporter: &mut Reporter<'_>) -> Option<T> {
    made.map_err(|error| {
        let help = match error {
            ResistanceError::NotSemiDefinite { .. } => "write a matrix whose eigenvalues are all at least 0",
            ResistanceError::NotSkew { .. } => "write Hᵀ = −H; what is symmetric belongs to `linear_friction`",
            ResistanceError::NotSymmetric { .. } => "write Hᵀ = H; what is skew belongs to `gyroscopic`",
            ResistanceError::NotFinite { .. } => "write finite numbers",
        };
        reporter.note(key, error.to_string(), help);
    })
    .ok()
}

pub(super) fn frame(written: WrittenFrame) -> Frame {
    match written {
        WrittenFrame::Space => Frame::Space,
        WrittenFrame::Body => Frame::Body,
    }
}

pub(super) fn square<const N: usize>(rows: &[[f64; N]; N]) -> SMatrix<f64, N, N> {
    SMatrix::from_fn(|row, column| rows[row][column])
}
