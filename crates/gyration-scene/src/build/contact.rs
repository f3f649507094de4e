//! Contacts: each `[[contact]]` goes to the body that it names, or to all bodies with a surface.

use super::body::Solid;
use crate::check::{Draft, Judge};
use crate::file::{Contact, Measure};
use gyration::contact::{Adhesion, AreaMeasure, Contact as Acting, ContactLaw, Damping, Friction, Repulsion};

/// Gives the bodies their contacts; notes a contact that names a body without a surface.
pub(super) fn attach(draft: &Draft, solids: &mut [Option<Solid>], judge: &mut Judge<'_>) {
    for contact in &draft.contacts {
        let support = draft.supports.iter().position(|support| support.value.name == contact.value.support);
        for solid in solids.iter_mut().flatten() {
            let named = contact.value.body.as_ref();
            if named.is_some_and(|name| *name != solid.body.name) {
                continue;
            }
            match (&solid.body.surface, support) {
                (Some(_), Some(support)) => solid.body.contacts.push(acting(&contact.value, support)),
                (None, _) if named.is_some() => {
                    let message = format!("\"{}\" has no surface", solid.body.name);
                    judge.note(&contact.key.key("body"), message, "name a body whose shape has a surface");
                }
                _ => {}
            }
        }
    }
}

fn acting(contact: &Contact, support: usize) -> Acting {
    let measure = match contact.measure {
        Measure::DeformedArea => AreaMeasure::DeformedArea,
        Measure::ReferenceArea => AreaMeasure::ReferenceArea,
        Measure::DeformedAreaPotential => AreaMeasure::DeformedAreaPotential,
    };
    let repulsion = contact.repulsion.map(|law| {
        let (alpha, exponent, reference_gap) = (law.alpha.value(), law.nu.0, law.d0.value());
        ContactLaw::Repulsion(Repulsion { alpha, exponent, reference_gap })
    });
    let damping = contact.damping.map(|law| {
        let (beta, exponent, reference_gap) = (law.beta.value(), law.nu.0, law.d0.value());
        ContactLaw::Damping(Damping { beta, exponent, reference_gap })
    });
    let friction = contact.friction.map(|law| {
        let (beta, exponent, reference_gap) = (law.beta.value(), law.nu.0, law.d0.value());
        ContactLaw::Friction(Friction { beta, exponent, reference_gap })
    });
    let adhesion = contact.adhesion.map(|law| {
        ContactLaw::Adhesion(Adhesion {
            beta: law.beta.value(),
            attractive_exponent: law.nu_attractive.0,
            repulsive_exponent: law.nu_repulsive.0,
            reference_gap: law.d0.value(),
        })
    });
    let laws = [repulsion, damping, friction, adhesion];
    Acting::new(support, measure, laws.into_iter().flatten().collect())
}
