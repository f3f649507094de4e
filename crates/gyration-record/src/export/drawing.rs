//! What a picture in space needs of a recording: the bodies with their surfaces, the supports, which way is up.
//!
//! A surface's points are relative to the centre of mass in the reference placement: a body shows them at p = p₀ + P X.

use crate::Attributes;
use crate::error::RecordError;
use crate::recording::Recording;
use nalgebra::{Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};
use serde::Deserialize;
use serde_json::Value;
use std::collections::HashMap;
use std::f64::consts::TAU;
use std::sync::Arc;

pub(super) type Vec3 = Vector3<f64>;
pub(super) type Mat3 = Matrix3<f64>;

/// All that is drawn.
#[derive(Debug, Clone)]
pub(super) struct Drawing {
    pub bodies: Vec<DrawnBody>,
    pub supports: Vec<DrawnSupport>,
    pub solid_supports: Vec<DrawnSolidSupport>,
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
    /// Its wireframe, which those of a surface share.
    #[serde(skip)]
    outline: Arc<DrawnOutline>,
}

#[derive(Debug, Clone, Default, Deserialize)]
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
    pub motion: DrawnMotion,
}

/// A support with a shape.
#[derive(Debug, Clone, Deserialize)]
pub(super) struct DrawnSolidSupport {
    pub name: String,
    /// Index of its surface.
    pub surface: Option<usize>,
    /// Where its centre of mass is before any motion \[m\].
    pub position: [f64; 3],
    /// The rows of its rotation before any motion.
    gradient: [f64; 9],
    pub motion: DrawnMotion,
}

/// Nothing, a motion, or several that add up.
#[derive(Debug, Clone, Deserialize)]
#[serde(untagged)]
pub(super) enum DrawnMotion {
    None,
    One(DrawnMotionPart),
    Several(Vec<DrawnMotionPart>),
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum DrawnMotionPart {
    Velocity([f64; 3]),
    Oscillate { direction: [f64; 3], amplitude: f64, frequency: f64, phase: f64 },
    Rotate { axis: [f64; 3], point: [f64; 3], rate: f64 },
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
        let mut outlines = Outlines::of(attributes);
        let body = |described: &Value| {
            let outline = outlines.shared(described, |part| DrawnOutline::deserialize(part("outline")))?;
            Ok(DrawnBody { outline, ..DrawnBody::deserialize(described)? })
        };
        let bodies = bodies.into_iter().flatten().map(body).collect::<Result<Vec<_>, _>>();
        let bodies = bodies.map_err(strange(recording, "bodies"))?;
        let solid_supports: Vec<DrawnSolidSupport> = match attributes.get("solid_supports") {
            Some(_) => attribute(recording, "solid_supports")?,
            None => Vec::new(),
        };
        let of_supports = solid_supports.iter().filter_map(|support| support.surface);
        let count = bodies.iter().filter_map(|body| body.surface).chain(of_supports).max().map_or(0, |last| last + 1);
        let gravity = Vec3::from(attribute::<[f64; 3]>(recording, "gravity")?);
        Ok(Self {
            bodies,
            supports: attribute(recording, "supports")?,
            solid_supports,
            surfaces: (0..count).map(|k| SurfaceMesh::read(recording, k)).collect::<Result<_, _>>()?,
            up: (-gravity).try_normalize(0.0).unwrap_or_else(Vec3::z),
        })
    }
}

/// What bodies of a recording look like, `outline` and `silhouette`: those of a surface share them.
pub struct Outlines<'a, T> {
    described: Option<&'a Value>,
    known: HashMap<u64, Arc<T>>,
}

impl<'a, T> Outlines<'a, T> {
    /// Those of the attributes of a recording.
    pub fn of(attributes: &'a Attributes) -> Self {
        Self { described: attributes.get("outlines"), known: HashMap::new() }
    }

    /// That of a body as it is described: `read` is given its parts by their names, once for all of a surface.
    ///
    /// # Errors
    /// Those of `read`.
    pub fn shared<'v, E>(
        &mut self,
        body: &'v Value,
        read: impl FnOnce(&dyn Fn(&str) -> &'v Value) -> Result<T, E>,
    ) -> Result<Arc<T>, E>
    where
        'a: 'v,
    {
        let surface = body.get("surface").and_then(Value::as_u64).filter(|_| body.get("outline").is_none());
        if let Some(known) = surface.and_then(|surface| self.known.get(&surface)) {
            return Ok(Arc::clone(known));
        }
        let place = surface.and_then(|surface| usize::try_from(surface).ok());
        let described = place.and_then(|place| self.described?.get(place)).unwrap_or(body);
        let found = Arc::new(read(&|part| described.get(part).unwrap_or(&Value::Null))?);
        if let Some(surface) = surface {
            self.known.insert(surface, Arc::clone(&found));
        }
        Ok(found)
    }
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

impl DrawnSolidSupport {
    /// Its rotation before any motion.
    pub fn turn(&self) -> UnitQuaternion<f64> {
        UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(Mat3::from_row_slice(&self.gradient)))
    }
}

impl DrawnMotion {
    fn parts(&self) -> &[DrawnMotionPart] {
        match self {
            Self::None => &[],
            Self::One(part) => std::slice::from_ref(part),
            Self::Several(parts) => parts,
        }
    }

    /// Whether it is one.
    pub fn moves(&self) -> bool {
        !self.parts().is_empty()
    }

    /// Whether it turns.
    pub fn turns(&self) -> bool {
        self.parts().iter().any(|part| matches!(part, DrawnMotionPart::Rotate { .. }))
    }

    /// The shortest period of an oscillation or a turn \[s\]; infinite of what does neither.
    pub fn shortest_period(&self) -> f64 {
        let period = |part: &DrawnMotionPart| match part {
            DrawnMotionPart::Velocity(_) => f64::INFINITY,
            DrawnMotionPart::Oscillate { frequency, .. } => frequency.abs().recip(),
            DrawnMotionPart::Rotate { rate, .. } => TAU / rate.abs(),
        };
        self.parts().iter().map(period).fold(f64::INFINITY, f64::min)
    }

    /// How a support is carried until a time: x = R x₀ + b, R and b \[m\].
    pub fn carried(&self, time: f64) -> (UnitQuaternion<f64>, Vec3) {
        let (mut turn, mut shift, mut displacement) = (UnitQuaternion::identity(), Vec3::zeros(), Vec3::zeros());
        for part in self.parts() {
            match *part {
                DrawnMotionPart::Velocity(velocity) => displacement += Vec3::from(velocity) * time,
                DrawnMotionPart::Oscillate { direction, amplitude, frequency, phase } => {
                    displacement += Vec3::from(direction) * (amplitude * libm::sin(TAU * frequency * time + phase));
                }
                DrawnMotionPart::Rotate { axis, point, rate } => {
                    let (sin, cos) = libm::sincos(0.5 * rate * time);
                    let half = Vec3::from(axis) * sin;
                    let by = UnitQuaternion::from_quaternion(Quaternion::new(cos, half.x, half.y, half.z));
                    shift = Vec3::from(point) + by * (shift - Vec3::from(point));
                    turn = by * turn;
                }
            }
        }
        (turn, shift + displacement)
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
