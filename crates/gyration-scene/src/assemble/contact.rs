//! Contacts: each `[[contact]]` goes to the body that it names, or to all bodies with a surface.

use super::body::AssembledBody;
use crate::check::{PartialScene, Placed, Reporter};
use crate::file::{Contact, Measure};
use crate::key::Key;
use gyration::contact::{Adhesion, AreaMeasure, Contact as Acting, ContactLaw, Damping, Friction, LawSet, Repulsion};
use std::collections::HashMap;
use std::sync::Arc;

/// The most pairs of a body and a contact in a scene.
const MOST_PAIRS: usize = 1_000_000;

/// Gives the bodies their contacts; notes a contact that names a body without a surface, and a law out of range.
pub(super) fn attach(partial: &PartialScene, assembled: &mut [Option<AssembledBody>], reporter: &mut Reporter<'_>) {
    let supports: HashMap<&str, usize> =
        partial.supports.iter().enumerate().map(|(index, support)| (support.value.name.as_str(), index)).collect();
    let bodies = named(assembled);
    let mut pairs = 0;
    for Placed { key, value } in &partial.contacts {
        let law_set = Arc::new(LawSet::new(measure(value.measure), laws(value)));
        law_set.laws().iter().for_each(|law| range(law, key, reporter));
        let met = match &value.body {
            Some(name) => bodies.get(name).map_or(0..0, |&index| index..index + 1),
            None => 0..assembled.len(),
        };
        pairs += met.len();
        if pairs > MOST_PAIRS {
            let message = format!("with this contact there are more than {MOST_PAIRS} of a body and a support");
            reporter.note(key, message, "give each contact the `body` that it is for");
            return;
        }
        let support = supports.get(value.support.as_str()).copied();
        for assembled_body in assembled[met].iter_mut().flatten() {
            match (&assembled_body.body.solid.surface, support) {
                (Some(_), Some(support)) => {
                    assembled_body.body.contacts.push(Acting::with_support(support, Arc::clone(&law_set)));
                }
                (None, _) if value.body.is_some() => {
                    let message = format!("\"{}\" has no surface", assembled_body.body.name);
                    reporter.note(&key.key("body"), message, "name a body whose shape has a surface");
                }
                _ => {}
            }
        }
    }
}

/// Where the body of each name stands.
fn named(assembled: &[Option<AssembledBody>]) -> HashMap<String, usize> {
    let name = |(index, assembled_body): (usize, &Option<AssembledBody>)| {
        Some((assembled_body.as_ref()?.body.name.clone(), index))
    };
    assembled.iter().enumerate().filter_map(name).collect()
}

/// Notes a law whose factor c = strength · d0^ν of d^−ν cannot be held in a number.
fn range(law: &ContactLaw, key: &Key, reporter: &mut Reporter<'_>) {
    let name = law.kind().name();
    let strength = law.terms().iter().flatten().map(|term| term.coefficient.abs()).fold(f64::NAN, f64::max);
    let silent = match law {
        ContactLaw::Repulsion(law) => law.alpha == 0.0,
        ContactLaw::Damping(law) => law.beta == 0.0,
        ContactLaw::Friction(law) => law.beta == 0.0,
        ContactLaw::Adhesion(law) => law.beta == 0.0,
    };
    let held = law.terms().iter().flatten().all(|term| term.coefficient.is_normal());
    if !silent && !held {
        let message = format!("its strength times d0^nu is {strength:e}, which leaves the range of numbers");
        reporter.note(&key.key(name), message, "choose a d0 nearer to the gaps in the scene, or a smaller exponent");
    }
}

fn measure(measure: Measure) -> AreaMeasure {
    match measure {
        Measure::DeformedArea => AreaMeasure::DeformedArea,
        Measure::ReferenceArea => AreaMeasure::ReferenceArea,
        Measure::DeformedAreaPotential => AreaMeasure::DeformedAreaPotential,
    }
}

fn laws(contact: &Contact) -> Vec<ContactLaw> {
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
    [repulsion, damping, friction, adhesion].into_iter().flatten().collect()
}
