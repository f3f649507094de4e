//! Contacts: each `[[contact]]` goes to the bodies that it names, or to all bodies with a surface.

use super::body::AssembledBody;
use super::partners::{Names, Partners, without_surface};
use super::support::AssembledSupports;
use super::{pair, reach};
use crate::check::{PartialScene, Placed, Reporter};
use crate::file::{Contact, Measure, Reach};
use crate::key::Key;
use crate::quantity::si;
use crate::units::shown;
use gyration::Party;
use gyration::contact::{Adhesion, AreaMeasure, Contact as Acting, ContactLaw, Damping, Friction, LawSet, Repulsion};
use gyration::neighbours::PairRule;
use std::collections::BTreeSet;
use std::sync::Arc;

/// w₀ of one-sided damping over α/β: what recedes is held back by a two-hundredth of the speed at which damping would
/// be as strong as repulsion.
const RELEASE: f64 = 0.01;

/// The most contacts of bodies with supports in a scene.
const MOST_CONTACTS: usize = 1_000_000;

/// The most pairs of parts of bodies that act on each other however far they are: each takes some 400 bytes.
const MOST_ENDLESS: usize = 10_000_000;

/// The contacts of bodies with supports, and the rules by which bodies meet with their keys; notes a contact with what
/// has no surface, and laws out of range.
pub(super) fn attach(
    partial: &PartialScene,
    supports: &AssembledSupports,
    assembled: &[Option<AssembledBody>],
    reporter: &mut Reporter<'_>,
) -> (Vec<Acting>, Vec<PairRule>, Vec<Key>) {
    let names = Names::of(partial);
    let (mut count, mut endless) = (0, 0);
    let (mut contacts, mut rules, mut keys) = (Vec::new(), Vec::new(), Vec::new());
    let gravity = si(&partial.world.gravity);
    for Placed { key, value, .. } in &partial.contacts {
        let (measure, laws) = (measure(value.measure), laws(value));
        laws.iter().for_each(|law| range(law, key, reporter));
        let partners = names.partners(value, assembled.len());
        match partners {
            // Without any law that pushes they have no plane, and are told so; adhesion alone pushes as well.
            Some(Partners::Bodies(_)) => check_released(value, &laws, key, reporter),
            _ => {
                check_released(value, &laws, key, reporter);
                check_pushed(&laws, key, reporter);
            }
        }
        let Some(partners) = partners else { continue };
        match partners {
            Partners::Support { support, bodies, named } => {
                count += bodies.len();
                let support = match supports.party(support) {
                    Party::Support(plane) => plane,
                    Party::SolidSupport(solid) => {
                        let with = pair::WithSupport { solid, bodies, named, supports };
                        let written = (value, key, &gravity);
                        if let Some(rule) = with.rule(written, (measure, laws), assembled, reporter) {
                            endless += rule.bodies[0].len();
                            rules.push(rule);
                            keys.push(key.clone());
                        }
                        continue;
                    }
                    Party::Body(_) | Party::Space => continue,
                };
                if let Some(reach) = &value.reach {
                    let beyond = match reach {
                        Reach::Length(reach) => format!(", and so beyond {} m", shown(reach.value())),
                        Reach::Auto(_) => String::new(),
                    };
                    let message = format!("a support is felt at any distance{beyond}");
                    reporter.note(&key.key("reach"), message, "leave it out: it is for pairs of bodies");
                }
                let law_set = Arc::new(LawSet::new(measure, laws));
                let between = key.key(if value.between.is_some() { "between" } else { "body" });
                for body in bodies {
                    let Some(assembled_body) = &assembled[body] else { continue };
                    match &assembled_body.body.solid.surface {
                        Some(_) => contacts.push(Acting::new(body, support, Arc::clone(&law_set))),
                        None if named => without_surface(assembled_body, &between, reporter),
                        None => {}
                    }
                }
            }
            Partners::Bodies(groups) => {
                let Some(laws) = pair::laws(measure, laws, key, reporter) else { continue };
                // Each body is looked at once, however many it meets.
                let named: BTreeSet<usize> = groups.iter().flatten().copied().collect();
                let named = named.into_iter().filter_map(|body| assembled[body].as_ref());
                let unable = named.filter(|body| !pair::can_meet(body, &key.key("between"), reporter)).count();
                if unable > 0 {
                    continue;
                }
                let reach = match value.reach {
                    None => None,
                    Some(written) => {
                        let found = reach::reach(written, &laws, &gravity, (&groups, None), (assembled, key, reporter));
                        let Some(found) = found else { continue };
                        Some(found)
                    }
                };
                let rule = PairRule { bodies: groups.map(Arc::from), supports: Arc::from([]), laws, reach };
                endless += pair::count_endless(&rule, assembled);
                if endless > MOST_ENDLESS {
                    let message = format!("with this contact more than {MOST_ENDLESS} pairs act however far they are");
                    let help = match reach {
                        None => "give the contact a `reach`: without one all pairs count",
                        Some(_) => "give it fewer bodies that deform: they feel all others, whatever the `reach`",
                    };
                    reporter.note(&key.key("between"), message, help);
                    break;
                }
                pair::check_range(&rule, assembled, key, reporter);
                pair::check_overlaps(&rule, assembled, key, reporter);
                // In a lattice a body has its own images.
                let is_alone = rule.pairs().next().is_none() && partial.lattice.is_none();
                if is_alone && names.are_known() {
                    let message = "it is between no two different bodies";
                    reporter.note(&key.key("between"), message, "name two bodies, or groups that have two");
                }
                rules.push(rule);
                keys.push(key.clone());
            }
            Partners::Supports => {
                let help = "name a body or a group of bodies: supports move as prescribed";
                reporter.note(&key.key("between"), "it is between two supports", help);
            }
        }
        if count > MOST_CONTACTS {
            let message = format!("with this contact there are more than {MOST_CONTACTS} contacts with supports");
            reporter.note(key, message, "give each contact the bodies that it is for");
            break;
        }
    }
    (contacts, rules, keys)
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

/// Whether a repulsion pushes.
fn repels(laws: &[ContactLaw]) -> bool {
    laws.iter().any(|law| matches!(law, ContactLaw::Repulsion(law) if law.alpha > 0.0))
}

/// Notes damping that has no speed to release at.
fn check_released(contact: &Contact, laws: &[ContactLaw], key: &Key, reporter: &mut Reporter<'_>) {
    if contact.damping.is_some_and(|damping| damping.one_sided) && !repels(laws) {
        let message = "what recedes is let go at a speed that a repulsion tells, and this contact has none";
        let help = "give the contact a `repulsion` with alpha > 0, or leave one_sided out";
        reporter.note(&key.key("damping").key("one_sided"), message, help);
    }
}

/// Notes a bound on friction that has no force to be a part of.
fn check_pushed(laws: &[ContactLaw], key: &Key, reporter: &mut Reporter<'_>) {
    if laws.iter().any(|law| law.mu().is_some()) && !repels(laws) {
        let message = "a bound on friction is a part of the force of a repulsion, and this contact has none";
        let help = "give the contact a `repulsion` with alpha > 0, or leave mu out: friction is then viscous";
        reporter.note(&key.key("friction").key("mu"), message, help);
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
        let release = contact.repulsion.filter(|_| law.one_sided && beta > 0.0).map(|repulsion| {
            // α and β of the gap d₀ of damping.
            let alpha = repulsion.alpha.value() * libm::pow(reference_gap / repulsion.d0.value(), -repulsion.nu.0);
            RELEASE * alpha / beta
        });
        ContactLaw::Damping(Damping { beta, exponent, reference_gap, release })
    });
    let friction = contact.friction.map(|law| {
        let (beta, exponent, reference_gap) = (law.beta.value(), law.nu.0, law.d0.value());
        ContactLaw::Friction(Friction { beta, exponent, reference_gap, mu: law.mu.map(|mu| mu.0) })
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
