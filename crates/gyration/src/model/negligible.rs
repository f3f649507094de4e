//! The model in which rigid bodies do not feel supports that are too far to change the digits of their motion.
//!
//! A force f that acts over the way r, the radius of the body, at its speed v changes v by less than its rounding if
//!
//!   |f| (1/m + r² |I⁻¹|) r ≤ ½ ε v²
//!
//! A body that flies L loses ½ ε L/r of its speed by what is left out: 1e-13 after a thousand radii.

use super::Model;
use crate::body::{Body, BodyKind};
use crate::contact::{Contact, Negligible};

/// A body so many times as fast as its scale feels all supports.
const FASTEST: f64 = 64.0;

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
    let force = 0.5 * f64::EPSILON * speed * speed / (mobility * arm);
    Negligible::of(&contact.law_set, surface, force, FASTEST * speed)
}
