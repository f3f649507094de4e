//! The model in which rigid bodies do not feel supports that are too far to change the digits of their motion.
//!
//! The work W that a force does changes the speed v of the fastest point of a body by less than its rounding if
//!
//!   W (1/m + r² |I⁻¹|) ≤ ½ ε v²
//!
//! This is asked of all that a support may do from where it is left out to infinity, at the speed scale v of the body:
//! the energy that rows book of it is below rounding too. Along a support, for a way L, a body loses ½ ε L/D of its
//! speed for each power of the gap by which W falls; one at a quarter of its scale sixteen times as much; slower ones,
//! and those that are much faster, feel all supports.

use super::Model;
use crate::body::{Body, BodyKind};
use crate::contact::{Contact, Negligible};

/// A body that is slower or faster than so many times its scale feels all supports.
const SPEEDS: [f64; 2] = [0.25, 64.0];

impl Model {
    /// The model whose rates leave such supports out, given the speed scale of each body [m/s]. Rows, energies and gaps
    /// have them all.
    ///
    /// # Panics
    /// If there are not as many scales as bodies.
    #[must_use]
    pub fn neglecting_far_supports(mut self, speeds: &[f64]) -> Self {
        assert_eq!(speeds.len(), self.bodies.len(), "each body has a speed scale");
        let bodies = &self.bodies;
        self.contacts = self.contacts.changed(|contact| {
            let (body, speed) = (&bodies[contact.body], speeds[contact.body]);
            Contact { negligible: negligible(body, contact, speed), ..contact.clone() }
        });
        self
    }
}

/// From where on a contact does nothing that digits tell; nowhere if a body deforms, or has no inertia or surface.
fn negligible(body: &Body, contact: &Contact, speed: f64) -> Negligible {
    let (BodyKind::Rigid(inertia), Some(surface), true) = (&body.kind, &body.solid.surface, body.has_inertia()) else {
        return Negligible::NOWHERE;
    };
    let arm = surface.radius() + body.pin.as_ref().map_or(0.0, |pin| pin.point.norm());
    let mobility = 1.0 / body.solid.mass.mass + arm * arm * inertia.inverse.norm();
    let energy = 0.5 * f64::EPSILON * speed * speed / mobility;
    Negligible::of(&contact.law_set, surface, energy, SPEEDS.map(|part| part * speed))
}
