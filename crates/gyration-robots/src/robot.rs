//! A robot as its file has it, whatever the format: links, how each is joined to the one before it, planes.
//!
//! Places are those of the joints at zero: of URDF all coordinates zero, of MJCF all at their `ref`.

use crate::pose::Pose;
use gyration::mass::MassProperties;
use gyration::shape::{Capsule, Cuboid, Cylinder, Ellipsoid, Polyhedron, Shape, Sphere};
use gyration::tensor::Vec3;
use std::path::PathBuf;

/// A robot.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Robot {
    pub name: String,
    /// Acceleration of gravity \[m/s²\], where the file tells one.
    pub gravity: Option<Vec3>,
    /// Each behind the one to which it is joined.
    pub links: Vec<Link>,
    /// What stands still in space: planes, and other geometry of the world.
    pub planes: Vec<FixedPlane>,
    pub fixtures: Vec<Fixture>,
}

/// A plane of the world.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FixedPlane {
    pub name: String,
    pub line: usize,
    pub origin: Vec3,
    pub normal: Vec3,
}

/// Geometry of the world.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Fixture {
    pub name: String,
    pub part: Part,
}

/// What moves as one, with its frame.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Link {
    pub name: String,
    pub line: usize,
    /// Its frame in space.
    pub pose: Pose,
    /// In its frame; none of a link without mass.
    pub mass: Option<MassProperties>,
    /// Its geometry.
    pub parts: Vec<Part>,
    pub connection: Connection,
}

/// A piece of geometry in the frame of its link.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Part {
    pub line: usize,
    pub shape: PartShape,
    pub pose: Pose,
}

/// The shape of a part; lengths in \[m\], axes along z.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum PartShape {
    Box(Cuboid),
    Sphere(Sphere),
    Ellipsoid(Ellipsoid),
    Cylinder(Cylinder),
    Capsule(Capsule),
    /// A closed surface from a file, metres per unit of the file, and the surface.
    Mesh(PathBuf, f64, Polyhedron),
}

impl PartShape {
    /// The shape of the mechanics.
    pub fn solid(&self) -> Shape {
        match self {
            Self::Box(it) => Shape::Box(*it),
            Self::Sphere(it) => Shape::Sphere(*it),
            Self::Ellipsoid(it) => Shape::Ellipsoid(*it),
            Self::Cylinder(it) => Shape::Cylinder(*it),
            Self::Capsule(it) => Shape::Capsule(*it),
            Self::Mesh(_, _, surface) => Shape::Polyhedron(surface.clone()),
        }
    }
}

/// How a link is joined to the one before it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Connection {
    /// Index of the other; none of space.
    pub parent: Option<usize>,
    pub kind: ConnectionKind,
    pub name: String,
    pub line: usize,
    /// A point of it in space \[m\].
    pub point: Vec3,
    /// Its axis in space, of length one.
    pub axis: Vec3,
    /// Least and largest coordinate \[rad\], \[m\].
    pub limits: Option<[f64; 2]>,
    pub drive: Drive,
}

impl Connection {
    /// Nothing that would hold a link.
    pub fn free(name: &str, line: usize) -> Self {
        Self {
            parent: None,
            kind: ConnectionKind::Free,
            name: name.to_owned(),
            line,
            point: Vec3::zeros(),
            axis: Vec3::z(),
            limits: None,
            drive: Drive::default(),
        }
    }
}

/// What a connection lets a link do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ConnectionKind {
    /// Everything, as the first link of a robot.
    Root,
    /// Everything: the file says so.
    Free,
    /// Nothing.
    Fixed,
    /// To turn about the axis.
    Hinge,
    /// To move along the axis.
    Slider,
    /// To turn about the point.
    Ball,
    /// To move across the axis, and to turn about it.
    Planar,
}

impl ConnectionKind {
    /// What expressions call its coordinate; none where there is not one.
    pub fn coordinate(self) -> Option<&'static str> {
        match self {
            Self::Hinge => Some("angle"),
            Self::Slider => Some("distance"),
            Self::Root | Self::Free | Self::Fixed | Self::Ball | Self::Planar => None,
        }
    }
}

/// The torque or force along the coordinate of a connection: a sum of terms.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Drive {
    /// Each an expression of the coordinate, `rate` and the inputs.
    pub terms: Vec<String>,
    /// How many inputs u, u_2, … they name.
    pub inputs: usize,
}

impl Drive {
    /// −factor · what, as a term; none where the factor is zero.
    pub fn resist(&mut self, factor: f64, what: &str) {
        if factor != 0.0 {
            self.terms.push(format!("{:?}*{what}", -factor));
        }
    }

    /// The name of one more input.
    pub fn input(&mut self) -> String {
        self.inputs += 1;
        input_name(self.inputs)
    }
}

/// The name of an input, from one.
pub(crate) fn input_name(number: usize) -> String {
    if number == 1 { "u".to_owned() } else { format!("u_{number}") }
}

/// What a coordinate is measured from, in an expression.
pub(crate) fn shifted(coordinate: &str, from: f64) -> String {
    match from {
        0.0 => coordinate.to_owned(),
        from if from < 0.0 => format!("({coordinate} + {:?})", -from),
        from => format!("({coordinate} - {from:?})"),
    }
}
