//! Bodies between which no contact stands: they pass through each other.

use super::Remarks;
use gyration::body::{Body, BodyKind, Solid};
use gyration::joint::Joint;
use gyration::model::Model;
use gyration::neighbours::{Sphere, each_overlap};
use gyration::state::{BodyMotion, State};
use gyration::tensor::{Mat3, Vec3};
use std::collections::{HashMap, HashSet};
use std::ops::ControlFlow;

/// Pairs of spheres that are looked at; a second for the most unlucky scene.
const MOST_COMPARED: usize = 1_000_000;
/// Pairs whose overlap is computed.
const MOST_COMPUTED: usize = 2_000;
/// Pinned bodies whose pairs are looked at one by one.
const MOST_PINNED: usize = 300;

/// Says which bodies do not meet; warns of those that overlap.
pub(super) fn remark(model: &Model, start: &State, remarks: &mut Remarks) {
    let solid: Vec<usize> =
        (0..model.bodies.len()).filter(|body| model.bodies[*body].solid.surface.is_some()).collect();
    let sorted = |[one, other]: [usize; 2]| if one < other { [one, other] } else { [other, one] };
    let all = solid.len() * solid.len().saturating_sub(1) / 2;
    let sorts = alike(model, &solid);
    let meeting = count_meeting(model, &sorts);
    if meeting >= all {
        return;
    }
    // Links of a linkage are not expected to meet.
    let is_solid = |pair: &[usize; 2]| pair.iter().all(|body| solid.binary_search(body).is_ok());
    let linked = model.joints().iter().filter_map(Joint::bodies).map(sorted).filter(is_solid);
    let apart = apart_for_ever(model, &solid).into_iter().chain(linked).filter(|pair| !meet(model, *pair));
    let mut known: HashSet<[usize; 2]> = apart.collect();
    let who = |known: &HashSet<[usize; 2]>| {
        let strangers = all.saturating_sub(meeting + known.len());
        let [one, other] = first_stranger(model, &sorts, known)?.map(|body| model.name(body));
        let who = match (strangers, meeting) {
            (1, _) => format!("\"{one}\" and \"{other}\" do not meet"),
            (_, 0) if strangers == all => format!("the {} bodies do not meet one another", solid.len()),
            _ => format!("{strangers} of {all} pairs of bodies do not meet, \"{one}\" and \"{other}\" among them"),
        };
        Some((format!("{who}: no contact says so"), strangers == 1))
    };
    let Some((told, is_one)) = who(&known) else { return };
    let mut expected = known.clone();
    let held_off = of_linkages(model, &solid).into_iter().chain(in_fluid(model, &solid));
    expected.extend(held_off.filter(|pair| !meet(model, *pair)));
    // What a spring joins may overlap: links of a chain.
    known.extend(model.joined().map(sorted));
    match Overlapping::among(model, start, &solid, &known) {
        Some(found) => remarks.warnings.push(format!("{told}, and {}", found.in_words(model, is_one))),
        None => remarks.notes.extend(who(&expected).map(|(told, _)| told)),
    }
}

/// The pairs of spheres that feel each other through the fluid, which holds them apart; of very many none.
fn in_fluid(model: &Model, solid: &[usize]) -> Vec<[usize; 2]> {
    let spheres = model.spheres().map_or(&[][..], |spheres| spheres.bodies());
    let spheres: Vec<usize> = spheres.iter().copied().filter(|body| solid.binary_search(body).is_ok()).collect();
    if spheres.len() > MOST_PINNED {
        return Vec::new();
    }
    let others = |place: usize| spheres[place + 1..].iter().copied();
    spheres.iter().enumerate().flat_map(|(place, one)| others(place).map(|other| [*one, other])).collect()
}

/// The pairs of bodies that hang together by joints; of large linkages none.
fn of_linkages(model: &Model, solid: &[usize]) -> Vec<[usize; 2]> {
    let mut linkage: Vec<usize> = (0..model.bodies.len()).collect();
    for [one, other] in model.joints().iter().filter_map(Joint::bodies) {
        let (from, to) = (linkage[one], linkage[other]);
        linkage.iter_mut().filter(|of| **of == from).for_each(|of| *of = to);
    }
    let mut members: HashMap<usize, Vec<usize>> = HashMap::new();
    solid.iter().for_each(|body| members.entry(linkage[*body]).or_default().push(*body));
    let small = members.values().filter(|members| members.len() <= MOST_PINNED);
    let pairs = |members: &Vec<usize>| {
        let others = |place: usize| members[place + 1..].iter().copied();
        members.iter().enumerate().flat_map(|(place, one)| others(place).map(|other| [*one, other])).collect::<Vec<_>>()
    };
    small.flat_map(pairs).collect()
}

/// Strangers that overlap at the start.
struct Overlapping {
    first: [usize; 2],
    depth: f64,
    count: usize,
    /// Whether there may be more.
    has_more: bool,
}

impl Overlapping {
    /// Those of some bodies, but for pairs that are known.
    fn among(model: &Model, start: &State, solid: &[usize], known: &HashSet<[usize; 2]>) -> Option<Self> {
        // Of what is not convex the hull tells nothing.
        let convex = solid.iter().filter(|body| model.bodies[**body].solid.shape.check_convex().is_ok());
        let convex: Vec<usize> = convex.copied().collect();
        let spheres: Vec<Sphere> = convex.iter().map(|body| sphere(model, start, *body)).collect();
        let mut found: Option<Self> = None;
        let (mut compared, mut computed) = (0, 0);
        let is_whole = each_overlap(&spheres, |places| {
            let bodies = places.map(|place| convex[place]);
            compared += 1;
            if compared > MOST_COMPARED {
                return ControlFlow::Break(());
            }
            if known.contains(&bodies) || meet(model, bodies) {
                return ControlFlow::Continue(());
            }
            computed += 1;
            if let Some(depth) = depth(model, start, bodies) {
                found.get_or_insert(Self { first: bodies, depth, count: 0, has_more: false }).count += 1;
            }
            if computed < MOST_COMPUTED { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        });
        found.map(|found| Self { has_more: is_whole.is_break(), ..found })
    }

    /// In words, after the two have been named if they are the only strangers.
    fn in_words(&self, model: &Model, is_only: bool) -> String {
        let depth = crate::format::significant(self.depth, 3);
        if self.count == 1 && !self.has_more {
            let [one, other] = self.first.map(|body| model.name(body));
            let who = if is_only { "they".to_owned() } else { format!("\"{one}\" and \"{other}\"") };
            return format!("{who} overlap at the start, by {depth} m");
        }
        let [one, other] = self.first.map(|body| model.name(body));
        let least = if self.has_more { "at least " } else { "" };
        format!("{least}{} pairs overlap at the start, \"{one}\" and \"{other}\" by {depth} m", self.count)
    }
}

/// A sphere around a body about its centre of mass.
fn sphere(model: &Model, start: &State, body: usize) -> Sphere {
    let placement = start.motion_in_space(model, body).placement;
    let radius = model.bodies[body].solid.surface.as_ref();
    // |P X| is the speed of X under the gradient rate P.
    let radius = radius.map_or(0.0, |surface| surface.fastest_point(&Vec3::zeros(), &placement.gradient));
    Sphere::new(placement.position, radius)
}

/// How far two bodies reach into each other, if they do [m].
fn depth(model: &Model, start: &State, bodies: [usize; 2]) -> Option<f64> {
    let motions: [BodyMotion; 2] = bodies.map(|body| start.motion_in_space(model, body));
    let placements = motions.each_ref().map(|motion| &motion.placement);
    let overlap = Solid::overlap(bodies.map(|body| &*model.bodies[body].solid), placements);
    overlap.filter(|overlap| !overlap.touches()).map(|overlap| overlap.depth)
}

/// Pairs of rigid bodies that pins keep apart.
fn apart_for_ever(model: &Model, solid: &[usize]) -> Vec<[usize; 2]> {
    let reach = |body: &Body| {
        let pin = body.pin.filter(|_| matches!(body.kind, BodyKind::Rigid(_)))?;
        // The farthest point from the pin is the fastest of a unit gradient rate that leaves the pin at rest.
        let farthest = body.solid.surface.as_ref()?.fastest_point(&-pin.point, &Mat3::identity());
        Some((pin.anchor, farthest))
    };
    let pinned = solid.iter().filter_map(|body| Some((*body, reach(&model.bodies[*body])?)));
    let pinned: Vec<(usize, (Vec3, f64))> = pinned.take(MOST_PINNED).collect();
    let mut apart = Vec::new();
    for (place, (one, (anchor, reach))) in pinned.iter().enumerate() {
        for (other, (other_anchor, other_reach)) in &pinned[place + 1..] {
            if (anchor - other_anchor).norm() > reach + other_reach {
                apart.push([*one, *other]);
            }
        }
    }
    apart
}

/// Whether a contact says of two bodies that they meet.
fn meet(model: &Model, [one, other]: [usize; 2]) -> bool {
    let rules = model.rules();
    rules.of(one).iter().any(|rule| rules.all()[*rule].between(one, other).is_some())
}

/// Bodies that are in the same sets of the same rules, ascending: who meets one of them meets all.
fn alike(model: &Model, solid: &[usize]) -> Vec<Vec<usize>> {
    let rules = model.rules();
    let mut sorts: HashMap<Vec<(usize, [bool; 2])>, Vec<usize>> = HashMap::new();
    for body in solid {
        let is_in = |rule: &usize| rules.all()[*rule].bodies.each_ref().map(|set| set.binary_search(body).is_ok());
        let sets = rules.of(*body).iter().map(|rule| (*rule, is_in(rule))).collect();
        sorts.entry(sets).or_default().push(*body);
    }
    let mut sorts: Vec<Vec<usize>> = sorts.into_values().collect();
    sorts.sort_unstable();
    sorts
}

/// Two sorts of bodies, or one of several bodies twice.
type TwoSorts<'a> = [&'a [usize]; 2];

/// All two sorts, and whether their bodies meet.
fn two_by_two<'a>(model: &'a Model, sorts: &'a [Vec<usize>]) -> impl Iterator<Item = (TwoSorts<'a>, bool)> {
    sorts.iter().enumerate().flat_map(move |(place, one)| {
        let own = one.get(1).map(|second| ([&one[..], &one[..]], meet(model, [one[0], *second])));
        let with = move |other: &'a Vec<usize>| ([&one[..], &other[..]], meet(model, [one[0], other[0]]));
        own.into_iter().chain(sorts[place + 1..].iter().map(with))
    })
}

/// How many pairs of bodies meet.
fn count_meeting(model: &Model, sorts: &[Vec<usize>]) -> usize {
    let meeting = two_by_two(model, sorts).filter(|(_, meet)| *meet);
    let count = |([one, other], _): (TwoSorts, bool)| match std::ptr::eq(one, other) {
        true => one.len() * (one.len() - 1) / 2,
        false => one.len() * other.len(),
    };
    meeting.map(count).sum()
}

/// The first two bodies that do not meet and may.
fn first_stranger(model: &Model, sorts: &[Vec<usize>], known: &HashSet<[usize; 2]>) -> Option<[usize; 2]> {
    let apart = two_by_two(model, sorts).filter(|(_, meet)| !meet);
    let first = apart.filter_map(|([one, other], _)| {
        let sorted = |a: usize, b: usize| [a.min(b), a.max(b)];
        let pairs = one.iter().flat_map(|a| other.iter().map(move |b| (*a, *b))).filter(|(a, b)| a != b);
        // No more known ones are to be passed, each twice at most.
        let some = pairs.map(|(a, b)| sorted(a, b)).take(2 * known.len() + other.len() + 1);
        some.filter(|pair| !known.contains(pair)).min()
    });
    first.min()
}
