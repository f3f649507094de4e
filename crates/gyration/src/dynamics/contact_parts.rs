//! The contact force on a body by what it is: along the normals of its contacts, and across them.
//!
//!   N = Σ f_c·n_c,   T = Σ |f_c − (f_c·n_c) n_c|
//!
//! over its contacts c, each with a normal n_c of its own towards the body: that of a support, or that of the plane
//! between it and another body. Where a body has several contacts, N and T are no parts of the sum of the forces.

use super::Scratch;
use super::contacts::meet;
use crate::acting::Load;
use crate::contact::ContactLoads;
use crate::inadmissible::Inadmissible;
use crate::instant::BodyAt;
use crate::tensor::Vec3;

/// The contact force on a body by what it is.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ContactParts {
    /// N [N], positive where contacts push.
    pub normal: f64,
    /// T [N].
    pub tangential: f64,
    /// The force of all other bodies together [N].
    pub of_bodies: Vec3,
}

impl ContactParts {
    fn add(&mut self, force: &Vec3, normal: &Vec3) {
        let along = force.dot(normal);
        self.normal += along;
        self.tangential += (force - along * normal).norm();
    }
}

/// The contact force on a body, contact by contact.
///
/// # Errors
/// [`Inadmissible`] where the state is outside the model.
pub fn contact_parts(at: &BodyAt, scratch: &mut Scratch) -> Result<ContactParts, Inadmissible> {
    let mut parts = ContactParts::default();
    at.try_each_load(|load| {
        match load {
            Load::Contact(contact) => {
                let met = meet(at, contact, |it| {
                    let loads = ContactLoads::integrate(&contact.law_set, it, &mut scratch.contact)?;
                    Ok((loads.total().force, it.motion.normal))
                })?;
                if let Some((force, normal)) = met {
                    parts.add(&force, &normal);
                }
            }
            Load::Pair(pair) => {
                let force = pair.on_body().force;
                parts.add(&force, &pair.normal());
                if pair.other().body().is_some() {
                    parts.of_bodies += force;
                }
            }
            Load::Spring(_)
            | Load::Bond(_)
            | Load::Joint(_)
            | Load::Couple(_)
            | Load::Applied(_)
            | Load::Resistance(_)
            | Load::Potential(_)
            | Load::BodyForce(_)
            | Load::PointForce(_)
            | Load::OwnFriction(_)
            | Load::MassFriction(_)
            | Load::SelfGravity(_)
            | Load::Fluid(..)
            | Load::Walls(_)
            | Load::Neighbours(_) => {}
        }
        Ok(())
    })?;
    Ok(parts)
}
