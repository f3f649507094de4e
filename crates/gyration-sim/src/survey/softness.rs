//! How soft the laws of a crowd are, and softer ones, with which a run costs less.
//!
//! A body of thickness D lies at the gap g on a repulsion α (d/d₀)^−ν. Bodies that lie on one another share steps that
//! go with the gap. Where the softest body of a contact lies nearer than 0.02 D these laws are proposed,
//!
//!   g′ = 0.03 D,   d₀′ = g′,   α′ = m g/F₁(g′),   β′ d₀′^ν′ = β d₀^ν′ ρ^(ν′−1−p),   ρ = s^(1/(ν−1−p))
//!
//! for all with d₀′, F₁ the force there of a repulsion of strength 1, s = α′ d₀′^ν/(α d₀^ν), and F ~ d^(p−ν): p is 0 of
//! faces and 1 of balls. ρ is the ratio of the gaps at which a body of some speed turns back, so that damping returns
//! the same part of any speed; at ν′ = ν its factor is s, whatever p. Friction has (g′/g)^(ν′−p), which leaves it as
//! strong at rest.

use crate::format::significant;
use gyration::body::Solid;
use gyration::contact::Repulsion as Law;
use gyration_scene::file::{Contact, Damping, Friction, OneOrMany, Reach, Repulsion};
use gyration_scene::quantity::{Length, NonNegative, Positive, Pressure, SurfaceDamping};
use gyration_scene::{Pressing, Scene};
use serde::Serialize;
use std::collections::{BTreeSet, HashSet};
use std::fmt::Write as _;
use std::sync::Arc;

/// Of so many bodies that meet softness is no matter.
const FEW: usize = 8;
/// Below such a gap of rest over the thickness laws are stiff.
const STIFF: f64 = 0.02;
/// The one that is proposed.
const PROPOSED: f64 = 0.03;
/// A reach in gaps of rest, as of `reach = "auto"`.
const REACH: f64 = 25.0;
/// Over the proposed gap: bodies that start nearer are thrown apart by a multiple of their weight, 2^ν of it.
const NEAR: f64 = 0.5;
/// Half a difference of ln d.
const DIFFERENCE: f64 = 1e-3;

/// How soft the laws of some contacts are, and softer ones.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SoftnessSurvey {
    /// The numbers of the contacts that have these laws, from 0.
    pub contacts: Vec<usize>,
    /// How many bodies they are of.
    pub bodies: usize,
    /// The one that lies farthest off for its thickness.
    pub softest: String,
    /// Its thickness D: twice the height of its centre over the side on which it lies [m].
    pub thickness: f64,
    /// g, its gap at rest on a level plane [m].
    pub rest_gap: f64,
    /// Laws with which it lies at 0.03 D.
    pub proposed: ProposedLaws,
    /// g′/g; steps of bodies that touch are about so many times fewer, an estimate.
    pub fewer_steps: f64,
    /// The least gap at the start [m], where the proposed laws would throw bodies apart.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub nearest: Option<f64>,
}

/// Laws that a contact may be given.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ProposedLaws {
    /// g′ [m].
    pub rest_gap: f64,
    /// α′, ν, d₀′.
    pub repulsion: Repulsion,
    /// The damping with which bodies bounce as before.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub damping: Option<Damping>,
    /// The friction that is as strong at rest as before.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub friction: Option<Friction>,
    /// 25 g′ [m], of contacts that have a reach in metres, or none, and may have one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reach: Option<f64>,
    /// The numbers of these contacts.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub reach_of: Vec<usize>,
}

/// A contact and the bodies that it is of.
struct Members<'a> {
    number: usize,
    contact: &'a Contact,
    /// Ascending.
    bodies: BTreeSet<usize>,
    /// Whether they meet one another.
    is_between: bool,
}

impl SoftnessSurvey {
    /// Those of the crowds of a scene that lie nearer than that, given the least gap at the start [m]; contacts with
    /// the same laws once.
    pub fn all(scene: &Scene, nearest: f64) -> Vec<Self> {
        let model = &scene.built().model;
        if scene.file().lattice.is_some() || model.gravity.norm() == 0.0 || model.bodies.len() <= FEW {
            return Vec::new();
        }
        let members = members(scene);
        let crowd: BTreeSet<usize> = members
            .iter()
            .filter(|it| it.is_between && it.bodies.len() > FEW)
            .flat_map(|it| &it.bodies)
            .copied()
            .collect();
        let concerned = |it: &&Members| it.bodies.intersection(&crowd).nth(FEW).is_some();
        let mut alike: Vec<Vec<&Members>> = Vec::new();
        for one in members.iter().filter(concerned) {
            match alike.iter_mut().find(|others| have_same_laws(others[0].contact, one.contact)) {
                Some(others) => others.push(one),
                None => alike.push(vec![one]),
            }
        }
        alike.iter().filter_map(|contacts| Self::of(scene, contacts, nearest)).collect()
    }

    fn of(scene: &Scene, contacts: &[&Members], nearest: f64) -> Option<Self> {
        let model = &scene.built().model;
        let contact = contacts[0].contact;
        let repulsion = contact.repulsion.filter(|law| law.alpha.value() > 0.0 && contact.adhesion.is_none())?;
        let law = law(&repulsion);
        let bodies: BTreeSet<usize> = contacts.iter().flat_map(|it| &it.bodies).copied().collect();
        let mut seen: HashSet<*const Solid> = HashSet::new();
        let lying = bodies.iter().filter_map(|body| {
            let solid = &model.bodies[*body].solid;
            let pressing = seen.insert(Arc::as_ptr(solid)).then(|| Pressing::new(solid, model.gravity.norm()))??;
            Some((*body, pressing, pressing.rest_gap(&law)?))
        });
        let softness = |(_, body, gap): &(usize, Pressing, f64)| gap / body.thickness();
        let (body, pressing, gap) = lying.max_by(|one, other| softness(one).total_cmp(&softness(other)))?;
        let thickness = pressing.thickness();
        if gap >= STIFF * thickness {
            return None;
        }
        let rest_gap = PROPOSED * thickness;
        let softer = Softer::new(&pressing, law, [gap, rest_gap]).filter(|it| it.alpha.is_normal())?;
        let reach_of: Vec<usize> =
            contacts.iter().filter(|it| may_have_length(scene, it)).map(|it| it.number).collect();
        Some(Self {
            contacts: contacts.iter().map(|it| it.number).collect(),
            bodies: bodies.len(),
            softest: model.name(body).to_owned(),
            thickness,
            rest_gap: gap,
            proposed: ProposedLaws {
                rest_gap,
                repulsion: Repulsion {
                    alpha: NonNegative(Pressure(softer.alpha)),
                    d0: Positive(Length(rest_gap)),
                    ..repulsion
                },
                damping: contact.damping.and_then(|law| softer.damping(law)),
                friction: contact.friction.and_then(|law| softer.friction(law)),
                reach: (!reach_of.is_empty()).then_some(REACH * rest_gap),
                reach_of,
            },
            fewer_steps: rest_gap / gap,
            nearest: Some(nearest).filter(|nearest| *nearest < NEAR * rest_gap),
        })
    }
}

/// A repulsion and a softer one.
struct Softer {
    law: Law,
    /// g, g′ [m].
    gaps: [f64; 2],
    /// α′ \[Pa\].
    alpha: f64,
    /// ln s.
    strength: f64,
    /// p at g′.
    widening: f64,
}

impl Softer {
    fn new(body: &Pressing<'_>, law: Law, gaps: [f64; 2]) -> Option<Self> {
        let strength_at = |gap: f64| body.strength(gap, law.exponent);
        let alpha = strength_at(gaps[1]);
        let strength = libm::log(alpha / law.alpha) + law.exponent * libm::log(gaps[1] / law.reference_gap);
        let [farther, nearer] = [DIFFERENCE, -DIFFERENCE].map(|by| strength_at(gaps[1] * libm::exp(by)));
        let widening = libm::log(nearer / farther) / (2.0 * DIFFERENCE);
        widening.is_finite().then_some(Self { law, gaps, alpha, strength, widening })
    }

    /// β of a law that has this one at d₀, and whose β d₀^ν′ has a factor of this logarithm.
    fn beta(&self, beta: f64, exponent: f64, reference_gap: f64, factor: f64) -> f64 {
        beta * libm::exp(factor + exponent * libm::log(reference_gap / self.gaps[1]))
    }

    /// None where no speed turns back.
    fn damping(&self, law: Damping) -> Option<Damping> {
        let exponent = law.nu.0;
        let rise = self.law.exponent - 1.0 - self.widening;
        let factor = match exponent == self.law.exponent {
            true => self.strength,
            false if rise > 0.0 => self.strength * (exponent - 1.0 - self.widening) / rise,
            false => return None,
        };
        let beta = self.beta(law.beta.value(), exponent, law.d0.value(), factor);
        Some(Damping { beta: NonNegative(SurfaceDamping(beta)), d0: Positive(Length(self.gaps[1])), ..law })
    }

    fn friction(&self, law: Friction) -> Option<Friction> {
        let exponent = law.nu.0;
        let factor = match exponent == self.law.exponent {
            true => self.strength,
            false => (exponent - self.widening) * libm::log(self.gaps[1] / self.gaps[0]),
        };
        let beta = self.beta(law.beta.value(), exponent, law.d0.value(), factor);
        Some(Friction { beta: NonNegative(SurfaceDamping(beta)), d0: Positive(Length(self.gaps[1])), ..law })
    }
}

/// The contacts of a scene, in order.
fn members(scene: &Scene) -> Vec<Members<'_>> {
    let (file, built) = (scene.file(), scene.built());
    let named = |word: &str| -> BTreeSet<usize> {
        let is_named = |body: &usize| {
            let written = &file.body[built.written[*body]];
            let groups = written.group.as_ref().map_or(&[][..], OneOrMany::as_slice);
            written.name == word || groups.iter().any(|group| group == word) || built.model.name(*body) == word
        };
        (0..built.written.len()).filter(is_named).collect()
    };
    let of = |(number, contact)| {
        let contact: &Contact = contact;
        let [one, other] = match (&contact.between, &contact.body) {
            (Some(two), _) => two.each_ref().map(|word| named(word)),
            (None, Some(body)) => [named(body), BTreeSet::new()],
            (None, None) => [(0..built.written.len()).collect(), BTreeSet::new()],
        };
        let is_between = !one.is_empty() && !other.is_empty();
        Members { number, contact, bodies: &one | &other, is_between }
    };
    file.contact.iter().enumerate().map(of).collect()
}

fn have_same_laws(one: &Contact, other: &Contact) -> bool {
    let laws = |it: &Contact| (it.measure, it.repulsion, it.damping, it.friction, it.adhesion);
    laws(one) == laws(other)
}

/// Whether a contact is between bodies, or with a support that has a shape, and has no reach that is found.
fn may_have_length(scene: &Scene, members: &Members) -> bool {
    let Contact { support, between, reach, .. } = members.contact;
    let mut words = support.iter().chain(between.iter().flatten());
    let is_plane = |word: &String| scene.built().model.supports.iter().any(|plane| plane.name == *word);
    (members.is_between || !words.any(is_plane)) && !matches!(reach, Some(Reach::Auto(_)))
}

fn law(repulsion: &Repulsion) -> Law {
    let Repulsion { alpha, nu, d0 } = repulsion;
    Law { alpha: alpha.value(), exponent: nu.0, reference_gap: d0.value() }
}

// Writing to a string does not fail: the results of writeln! are dropped in this file.

/// The proposals as text, each with laws that can be written into the scene.
pub(super) fn write_softness(text: &mut String, all: &[SoftnessSurvey]) {
    for told in all {
        let SoftnessSurvey { contacts, bodies, softest, thickness, rest_gap, proposed, fewer_steps, nearest } = told;
        let part = |gap: f64| short(100.0 * gap / thickness);
        let _ = writeln!(
            text,
            "softness   of {bodies} bodies (contact {}) {softest} lies at a gap of {} m, {} % of its thickness of {} m",
            ranges(contacts),
            short(*rest_gap),
            part(*rest_gap),
            short(*thickness)
        );
        let gap = proposed.rest_gap;
        let _ = writeln!(
            text,
            "           softer laws cost less; for {} m, {} % of it, write there",
            short(gap),
            part(gap)
        );
        let Repulsion { alpha, nu, d0 } = proposed.repulsion;
        let d0 = short(d0.value());
        let _ =
            writeln!(text, "             repulsion = {{ alpha = {}, nu = {}, d0 = {d0} }}", short(alpha.value()), nu.0);
        if let Some(Damping { beta, nu, one_sided, .. }) = proposed.damping {
            let one_sided = if one_sided { ", one_sided = true" } else { "" };
            let beta = short(beta.value());
            let _ = writeln!(text, "             damping = {{ beta = {beta}, nu = {}, d0 = {d0}{one_sided} }}", nu.0);
        }
        if let Some(Friction { beta, nu, mu, .. }) = proposed.friction {
            let mu = mu.map(|mu| format!(", mu = {}", mu.0)).unwrap_or_default();
            let beta = short(beta.value());
            let _ = writeln!(text, "             friction = {{ beta = {beta}, nu = {}, d0 = {d0}{mu} }}", nu.0);
        }
        if let Some(reach) = proposed.reach {
            let of = if proposed.reach_of.len() < contacts.len() {
                format!(" in contact {}", ranges(&proposed.reach_of))
            } else {
                String::new()
            };
            let reach = short(reach);
            let _ = writeln!(text, "             reach = {reach}{of}: {REACH} such gaps; a shorter one costs less");
        }
        let bounces = match proposed.damping {
            None => None,
            Some(law) if law.nu == proposed.repulsion.nu => Some("a flat impact".to_owned()),
            Some(_) => Some(format!("an impact of {softest}, as it lies, and of bodies of its shape")),
        };
        if let Some(impact) = bounces {
            let _ = writeln!(text, "           {impact} then returns the same part of any speed as now");
        }
        let fewer = short((10.0 * fewer_steps).round() / 10.0);
        let _ = writeln!(
            text,
            "           steps of bodies that touch go with the gap: about {fewer} times fewer, an estimate"
        );
        if let Some(nearest) = nearest {
            let _ = writeln!(
                text,
                "           at the start bodies are {} m apart: the softer laws would throw them away; start them \
                 farther off",
                short(*nearest)
            );
        }
    }
}

/// Ascending numbers, neighbours as ranges.
fn ranges(numbers: &[usize]) -> String {
    let runs = numbers.chunk_by(|one, next| next - one == 1);
    let words = runs.map(|run| match run {
        [one] => one.to_string(),
        [first, .., last] => format!("{first} to {last}"),
        [] => String::new(),
    });
    words.collect::<Vec<_>>().join(", ")
}

/// Five digits.
fn short(value: f64) -> String {
    significant(value, 5)
}
