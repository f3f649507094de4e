//! Supports: planes with unit normals, solids, and their motions.

use super::convex::convex_help;
use super::orientation::orientation;
use super::shape::ShapeBuilder;
use crate::check::{PartialScene, Placed, Reporter, direction};
use crate::file::{Motion, OneOrMany, Support};
use crate::key::Key;
use crate::quantity::si;
use gyration::Party;
use gyration::body::Solid;
use gyration::kinematics::{Placement, Quaternion};
use gyration::mass::MassProperties;
use gyration::shape::Shape;
use gyration::solid_support::SolidSupport;
use gyration::support::{MotionPart, Support as Plane, SupportMotion};
use gyration::tensor::Vec3;
use gyration_files::Files;
use std::collections::HashMap;
use std::sync::Arc;

/// The supports of a scene, by sort; none in the place of one with an error.
#[derive(Debug, Default)]
pub(super) struct AssembledSupports {
    /// Those that are planes.
    pub(super) planes: Vec<Option<Plane>>,
    /// Those with a shape.
    pub(super) solids: Vec<Option<SolidSupport>>,
    /// Which of these each well-formed support of the file is.
    parties: Vec<Party>,
    /// Where each of these begins, by name: a plane in space.
    begins: HashMap<String, Begins>,
}

/// Where the axes of a support are before any motion, and how it moves.
#[derive(Debug, Clone)]
pub(super) struct Begins {
    pub party: Party,
    pub position: Vec3,
    pub orientation: Quaternion,
    pub motion: Arc<SupportMotion>,
}

impl AssembledSupports {
    /// Builds them; notes what is wrong with a shape.
    pub(super) fn of(partial: &PartialScene, files: &Files, reporter: &mut Reporter<'_>) -> Self {
        let mut this = Self::default();
        for placed in &partial.supports {
            if placed.value.shape.is_some() {
                let turned = match &placed.value.orientation {
                    None => Some(Quaternion::IDENTITY),
                    Some(written) => orientation(written, &placed.key.key("orientation"), reporter),
                };
                let solid = solid(placed, turned, files, reporter);
                let party = Party::SolidSupport(this.solids.len());
                if let Some((solid, orientation)) = solid.as_ref().zip(turned) {
                    this.begin(party, &placed.value, (solid.start.position, orientation), &solid.motion);
                }
                this.parties.push(party);
                this.solids.push(solid);
            } else {
                let plane = plane(&placed.value);
                let party = Party::Support(this.planes.len());
                if let Some(plane) = &plane {
                    this.begin(party, &placed.value, (Vec3::zeros(), Quaternion::IDENTITY), &plane.motion);
                }
                this.parties.push(party);
                this.planes.push(plane);
            }
        }
        this
    }

    fn begin(
        &mut self,
        party: Party,
        written: &Support,
        (position, orientation): (Vec3, Quaternion),
        motion: &SupportMotion,
    ) {
        let begins = Begins { party, position, orientation, motion: Arc::new(motion.clone()) };
        self.begins.insert(written.name.clone(), begins);
    }

    /// Where the axes of a support of this name are before any motion; none of one with an error.
    pub(super) fn begins(&self, name: &str) -> Option<&Begins> {
        self.begins.get(name)
    }

    /// Which one a well-formed support of the file is.
    pub(super) fn party(&self, number: usize) -> Party {
        self.parties[number]
    }
}

/// A plane, if its directions are not zero (which the checks have noted otherwise).
fn plane(support: &Support) -> Option<Plane> {
    let plane = support.plane.as_ref()?;
    let (motion, normal) = (motion(support.motion.as_ref())?, direction(&plane.normal)?);
    Some(Plane { name: support.name.clone(), origin: si(&plane.origin), normal, motion })
}

/// A support with a shape.
fn solid(
    placed: &Placed<Support>,
    turned: Option<Quaternion>,
    files: &Files,
    reporter: &mut Reporter<'_>,
) -> Option<SolidSupport> {
    let Placed { key, value, .. } = placed;
    let written = value.shape.as_ref()?;
    // Parts of one density, or each with its own: they tell where the centre of mass is, which stands at `position`.
    let density = (!written.weighs()).then_some(1.0);
    let shape = ShapeBuilder { files, reporter }.shape(written, &key.key("shape"), density)?;
    if !is_solid(&shape, &key.key("shape"), reporter) {
        return None;
    }
    // No force moves it.
    let mass = MassProperties { mass: f64::INFINITY, ..shape.mass_properties(1.0) };
    let position = value.position.as_ref().map(si).unwrap_or_default();
    Some(SolidSupport {
        name: value.name.clone(),
        size: shape.size(),
        solid: Arc::new(Solid::new(shape, mass)),
        start: Placement { position, gradient: turned?.rotation() },
        motion: motion(value.motion.as_ref())?,
    })
}

/// Whether bodies can meet a shape; notes why not.
fn is_solid(shape: &Shape, key: &Key, reporter: &mut Reporter<'_>) -> bool {
    if shape.surface().is_none() {
        reporter.note(key, "points have no surface that a body could meet", "write a shape with a surface");
        return false;
    }
    if let Err(why) = shape.check_convex() {
        let message = format!("bodies cannot meet this shape: {why}");
        reporter.note(key, message, convex_help(why));
        return false;
    }
    true
}

/// A motion as prescribed, if its directions are not zero.
pub(super) fn motion(written: Option<&OneOrMany<Motion>>) -> Option<SupportMotion> {
    let written = written.into_iter().flat_map(|motion| motion.as_slice());
    let parts = written.map(|motion| match motion {
        Motion::Velocity(velocity) => Some(MotionPart::Velocity(si(velocity))),
        Motion::Oscillate(oscillation) => Some(MotionPart::Oscillation {
            direction: direction(&oscillation.direction)?,
            amplitude: oscillation.amplitude.0,
            frequency: oscillation.frequency.value(),
            phase: oscillation.phase.0,
        }),
        Motion::Rotate(rotation) => Some(MotionPart::Rotation {
            axis: direction(&rotation.axis)?,
            point: si(&rotation.point),
            rate: rotation.rate.0,
        }),
    });
    Some(SupportMotion::new(parts.collect::<Option<_>>()?))
}

/// Notes supports with a shape in a lattice.
pub(super) fn refuse_solids(partial: &PartialScene, reporter: &mut Reporter<'_>) {
    for placed in partial.supports.iter().filter(|placed| placed.value.shape.is_some()) {
        let message = "cells do not see a support with a shape alike";
        reporter.note(&placed.key.key("shape"), message, "write a plane that holds all cell vectors");
    }
}
