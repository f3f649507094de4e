//! Cells that are deformed: what is fixed in space goes along.

use super::Model;
use crate::body::Body;
use crate::lattice::Lattice;
use crate::load::{Anchor, Attachment, Spring};
use crate::tensor::{Mat3, Vec3};
use std::sync::Arc;

impl Model {
    /// The model with cells that have gone to F x, of these vectors: so have anchors, pins and the places to which
    /// guides keep centres. Bodies have the shapes of before.
    #[must_use]
    pub fn with_cells_deformed(self, strain: &Mat3, lattice: Lattice) -> Self {
        let origins: Vec<Vec3> =
            (0..self.bodies.len()).map(|body| strain * self.in_space(body, &Vec3::zeros())).collect();
        let bodies: Vec<Arc<Body>> = self.bodies.iter().map(|body| moved(body, strain)).collect();
        let springs = self.springs().iter().map(|spring| led(spring, strain)).collect();
        self.with_bodies(bodies).with_springs(springs).in_lattice(lattice).beginning_at(origins)
    }

    /// The first body whose centre is kept to a line or a plane that the strain takes out of itself.
    pub fn leaves_guide(&self, strain: &Mat3) -> Option<usize> {
        let leaves = |body: &Arc<Body>| {
            let within = body.guide.as_ref().and_then(|guide| guide.center)?;
            let taken = strain * within;
            Some((within * taken - taken).amax() > ROUNDING * taken.amax())
        };
        self.bodies.iter().position(|body| leaves(body) == Some(true))
    }
}

/// Components below this part of the largest are rounding.
const ROUNDING: f64 = 1e-12;

/// A body that is held where the strain takes what holds it.
fn moved(body: &Arc<Body>, strain: &Mat3) -> Arc<Body> {
    if body.pin.is_none() && body.guide.is_none() {
        return body.clone();
    }
    let mut body = Body::clone(body);
    if let Some(pin) = &mut body.pin {
        pin.anchor = strain * pin.anchor;
    }
    if let Some(guide) = &mut body.guide {
        guide.position = strain * guide.position;
    }
    Arc::new(body)
}

/// A spring whose anchor has gone along.
fn led(spring: &Spring, strain: &Mat3) -> Spring {
    let ends = spring.ends.each_ref().map(|end| match end {
        Attachment::Anchor(anchor) => {
            Attachment::Anchor(Anchor { start: strain * anchor.start, motion: anchor.motion.clone() })
        }
        Attachment::Body { .. } => end.clone(),
    });
    Spring { ends, ..spring.clone() }
}
