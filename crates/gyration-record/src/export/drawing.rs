//! What a picture in space needs of a recording: the bodies with their surfaces, the supports, which way is up.
//!
//! A surface's points are relative to the centre of mass in the reference placement: a body shows them at p = p₀ + P X.

use crate::Attributes;
use crate::error::RecordError;
use crate::recording::Recording;
use nalgebra::{Matrix3, Vector3};
use serde::Deserialize;
use serde_json::Value;
use std::f64::consts::TAU;

pub(super) type Vec3 = Vector3<f64>;
pub(super) type Mat3 = Matrix3<f64>;

/// All that is drawn.
#[derive(Debug, Clone)]
pub(super) struct Drawing {
    pub bodies: Vec<DrawnBody>,
    pub supports: Vec<DrawnSupport>,
    /// The distinct surfaces.
    pub surfaces: Vec<SurfaceMesh>,
    /// Against gravity; z without any.
    pub up: Vec3,
}

/// A body.
#[derive(Debug, Clone, Deserialize)]
pub(super) struct DrawnBody {
    pub name: String,
    kind: String,
    pub size: f64,
    /// Index of its surface; none for points.
    pub surface: Option<usize>,
    outline: DrawnOutline,
}

#[derive(Debug, Clone, Deserialize)]
struct DrawnOutline {
    points: Vec<[f64; 3]>,
    /// Lines through points, by index.
    polylines: Vec<Vec<usize>>,
}

/// A support: a plane that may move.
#[derive(Debug, Clone, Deserialize)]
pub(super) struct DrawnSupport {
    pub name: String,
    pub origin: [f64; 3],
    pub normal: [f64; 3],
    motion: Option<DrawnMotion>,
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename_all = "snake_case")]
enum DrawnMotion {
    Velocity([f64; 3]),
    Oscillate { direction: [f64; 3], amplitude: f64, frequency: f64, phase: f64 },
}

/// A surface of triangles.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SurfaceMesh {
    pub points: Vec<Vec3>,
    /// Indices of points, counter-clockwise seen from outside.
    pub triangles: Vec<[usize; 3]>,
}

impl Drawing {
    /// Reads it.
    ///
    /// # Errors
    /// `NoSurfaces` if the recording is older than they are; `Corrupt`; those of reading.
    pub fn of(recording: &Recording) -> Result<Self, RecordError> {
        let attributes = recording.attributes();
        let bodies = attributes.get("bodies").and_then(Value::as_array);
        if bodies.is_some_and(|bodies| bodies.iter().any(|body| body.get("surface").is_none())) {
            return Err(RecordError::NoSurfaces { path: recording.path().to_path_buf() });
        }
        let bodies: Vec<DrawnBody> =
            serde_json::from_value(bodies_with_outlines(attributes)).map_err(strange(recording, "bodies"))?;
        let count = bodies.iter().filter_map(|body| body.surface).max().map_or(0, |last| last + 1);
        let gravity = Vec3::from(attribute::<[f64; 3]>(recording, "gravity")?);
        Ok(Self {
            bodies,
            supports: attribute(recording, "supports")?,
            surfaces: (0..count).map(|k| SurfaceMesh::read(recording, k)).collect::<Result<_, _>>()?,
            up: (-gravity).try_normalize(0.0).unwrap_or_else(Vec3::z),
        })
    }
}

/// The bodies of a recording as its attributes describe them, each with wireframe and silhouette: those that have a
/// surface share them with it, as `outlines`.
pub fn bodies_with_outlines(attributes: &Attributes) -> Value {
    let mut bodies = attributes.get("bodies").cloned().unwrap_or_default();
    let outlines = attributes.get("outlines").and_then(Value::as_array);
    for body in bodies.as_array_mut().into_iter().flatten().filter_map(Value::as_object_mut) {
        let surface = body.get("surface").and_then(Value::as_u64).and_then(|k| usize::try_from(k).ok());
        let shared = surface.and_then(|k| outlines?.get(k)).and_then(Value::as_object);
        for (name, value) in shared.into_iter().flatten() {
            body.entry(name.as_str()).or_insert_with(|| value.clone());
        }
    }
    bodies
}

fn attribute<T: serde::de::DeserializeOwned>(recording: &Recording, name: &str) -> Result<T, RecordError> {
    let value = recording.attributes().get(name).cloned().unwrap_or_default();
    serde_json::from_value(value).map_err(strange(recording, name))
}

/// The refusal of an attribute that is not as recordings have it.
fn strange(recording: &Recording, name: &str) -> impl FnOnce(serde_json::Error) -> RecordError {
    move |_| RecordError::corrupt(recording.path(), format!("the attribute `{name}` lacks what is drawn of it"))
}

impl DrawnBody {
    /// Whether P is a rotation.
    pub fn is_rigid(&self) -> bool {
        self.kind == "rigid"
    }

    /// The ends of the lines of its wireframe, two by two, from the centre of mass \[m\].
    pub fn lines(&self) -> impl Iterator<Item = Vec3> {
        let steps = self.outline.polylines.iter().flat_map(|line| line.windows(2)).flatten();
        steps.filter_map(|index| self.outline.points.get(*index)).map(|point| Vec3::from(*point))
    }

    /// The points that stand for a body without a surface.
    pub fn points(&self) -> impl Iterator<Item = Vec3> {
        self.outline.points.iter().map(|point| Vec3::from(*point))
    }
}

impl DrawnSupport {
    /// Whether it moves.
    pub fn moves(&self) -> bool {
        self.motion.is_some()
    }

    /// Its displacement at a time \[m\].
    pub fn displacement(&self, time: f64) -> Vec3 {
        match self.motion {
            None => Vec3::zeros(),
            Some(DrawnMotion::Velocity(velocity)) => Vec3::from(velocity) * time,
            Some(DrawnMotion::Oscillate { direction, amplitude, frequency, phase }) => {
                Vec3::from(direction) * (amplitude * libm::sin(TAU * frequency * time + phase))
            }
        }
    }
}

impl SurfaceMesh {
    fn read(recording: &Recording, k: usize) -> Result<Self, RecordError> {
        let points = recording.read(&format!("surface_{k}_points"))?.data;
        let points: Vec<Vec3> = points.as_chunks().0.iter().map(|point: &[f64; 3]| Vec3::from(*point)).collect();
        let corners = recording.read(&format!("surface_{k}_triangles"))?.data;
        let index = |corner: f64| {
            let known = corner >= 0.0 && corner < points.len() as f64 && corner.fract() == 0.0;
            known.then_some(corner as usize)
        };
        let triangles =
            corners.as_chunks().0.iter().map(|&[a, b, c]: &[f64; 3]| Some([index(a)?, index(b)?, index(c)?]));
        match triangles.collect() {
            Some(triangles) if points.iter().flatten().all(|x| x.is_finite()) => Ok(Self { points, triangles }),
            _ => {
                let reason = format!("surface {k} names points that are not there, or are not finite");
                Err(RecordError::corrupt(recording.path(), reason))
            }
        }
    }
}
