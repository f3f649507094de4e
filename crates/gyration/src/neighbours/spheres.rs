//! Spheres about bodies, and which of them come near one another.
//!
//!   |c_i − c_j| ≤ r_i + r_j + margin
//!
//! Found by a tree of boxes where there are many: a crowd costs N log N.

use super::boxes::{Bounds, BoxTree};
use super::rules::{PairRule, PairRules};
use crate::tensor::Vec3;
use std::ops::ControlFlow;

/// So few products of the counts of two sets are compared one by one.
const FEW: usize = 256;
/// What rounding leaves of a comparison of distances.
const ROUNDING: f64 = 1e-12;

/// A sphere that holds a body, or all places that it may come to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    center: Vec3,
    radius: f64,
}

/// Two bodies that a rule joins, ordered as the rule orders them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct BodyPair {
    /// The number of the rule.
    pub rule: usize,
    /// The two bodies.
    pub bodies: [usize; 2],
}

impl Sphere {
    /// All of space.
    pub const EVERYWHERE: Self = Self { center: Vec3::new(0.0, 0.0, 0.0), radius: f64::INFINITY };
    /// No place.
    pub const NOWHERE: Self = Self { center: Vec3::new(0.0, 0.0, 0.0), radius: f64::NEG_INFINITY };

    /// About a place [m], of a radius [m]; all of space where either is no number.
    pub fn new(center: Vec3, radius: f64) -> Self {
        let is_bounded = center.iter().all(|x| x.is_finite()) && radius < f64::INFINITY;
        if is_bounded { Self { center, radius } } else { Self::EVERYWHERE }
    }

    fn is_bounded(&self) -> bool {
        self.radius.is_finite()
    }

    fn is_somewhere(&self) -> bool {
        self.radius > f64::NEG_INFINITY
    }

    /// Whether another comes as near as a margin [m].
    pub fn meets(&self, other: &Self, margin: f64) -> bool {
        (self.center - other.center).norm() <= (self.radius + other.radius + margin) * (1.0 + ROUNDING)
    }

    fn bounds(&self, margin: f64) -> Bounds {
        Bounds::about(&self.center, (self.radius + margin) * (1.0 + ROUNDING))
    }
}

/// The bodies that rules join and whose spheres come as near to one another as the margin of the rule [m], ascending;
/// none of rules without a margin.
pub fn near(rules: &PairRules, spheres: &[Sphere], margin: impl Fn(&PairRule) -> Option<f64>) -> Vec<BodyPair> {
    let mut found = Vec::new();
    let all = each_near(rules, spheres, margin, |pair| {
        found.push(pair);
        ControlFlow::<()>::Continue(())
    });
    debug_assert!(all.is_continue(), "nobody has stopped it");
    found
}

/// Hands them to `each` until it breaks off.
pub fn each_near<B>(
    rules: &PairRules,
    spheres: &[Sphere],
    margin: impl Fn(&PairRule) -> Option<f64>,
    mut each: impl FnMut(BodyPair) -> ControlFlow<B>,
) -> ControlFlow<B> {
    for (number, rule) in rules.all().iter().enumerate() {
        let Some(margin) = margin(rule) else { continue };
        let meets = |[one, other]: [usize; 2]| spheres[one].meets(&spheres[other], margin);
        let mut take = |bodies: [usize; 2]| each(BodyPair { rule: number, bodies });
        let [first, second] = &rule.bodies;
        if margin == f64::INFINITY || first.len() * second.len() <= FEW {
            rule.pairs().filter(|pair| meets(*pair)).try_for_each(&mut take)?;
            continue;
        }
        let somewhere = second.iter().filter(|body| spheres[**body].is_somewhere());
        let (bounded, unbounded): (Vec<usize>, Vec<usize>) = somewhere.partition(|body| spheres[**body].is_bounded());
        let tree = BoxTree::new(bounded.iter().map(|body| (spheres[*body].bounds(0.0), *body)));
        let mut partners: Vec<usize> = Vec::new();
        for first in first.iter().filter(|body| spheres[**body].is_somewhere()) {
            partners.clear();
            partners.extend(&unbounded);
            if spheres[*first].is_bounded() {
                partners.extend(tree.touching(&spheres[*first].bounds(margin)));
            } else {
                partners.extend(&bounded);
            }
            partners.sort_unstable();
            let joined = partners.iter().filter(|second| rule.between(*first, **second) == Some([*first, **second]));
            joined.map(|second| [*first, *second]).filter(|pair| meets(*pair)).try_for_each(&mut take)?;
        }
    }
    ControlFlow::Continue(())
}

/// Hands each two spheres that overlap to `each`, by their places among all, the smaller one first, until it breaks
/// off.
pub fn each_overlap<B>(spheres: &[Sphere], mut each: impl FnMut([usize; 2]) -> ControlFlow<B>) -> ControlFlow<B> {
    let bounded = || (0..spheres.len()).filter(|place| spheres[*place].is_bounded());
    let tree = BoxTree::new(bounded().map(|place| (spheres[place].bounds(0.0), place)));
    let mut beside: Vec<usize> = Vec::new();
    for one in bounded() {
        beside.clear();
        beside.extend(tree.touching(&spheres[one].bounds(0.0)).filter(|other| *other > one));
        beside.sort_unstable();
        let overlapping = beside.iter().filter(|other| spheres[one].meets(&spheres[**other], 0.0));
        overlapping.map(|other| [one, *other]).try_for_each(&mut each)?;
    }
    ControlFlow::Continue(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{AreaMeasure, ContactLaw, Repulsion};
    use crate::pair::{PairLaws, Reach};
    use std::sync::Arc;

    /// Two hundred bodies of sizes 1 : 100 at places from a sequence of low discrepancy, some of them everywhere or
    /// nowhere, in two sets that overlap.
    #[test]
    fn a_tree_finds_what_comparisons_one_by_one_find() {
        let repulsion = ContactLaw::Repulsion(Repulsion { alpha: 1.0, exponent: 6.0, reference_gap: 1.0 });
        let laws = Arc::new(PairLaws::new(AreaMeasure::ReferenceArea, vec![repulsion]).unwrap());
        let sets = [(0..150).collect(), (50..200).collect()];
        let rule = PairRule { bodies: sets, supports: Arc::from([]), laws, reach: Some(Reach::Length(0.02)) };
        let rules = PairRules::new(200, vec![rule.clone()]);
        let part = |k: usize, step: f64| (k as f64 * step).fract();
        let sphere = |k: usize| match k {
            60 | 170 => Sphere::EVERYWHERE,
            61 | 171 => Sphere::new(Vec3::new(f64::NAN, 0.0, 0.0), 1.0),
            62 | 172 => Sphere::NOWHERE,
            _ => {
                let center = Vec3::new(part(k, 0.8191725134), part(k, 0.6710436067), part(k, 0.5497004779));
                Sphere::new(center, 0.1 * 100f64.powf(-part(k, 0.618033988)))
            }
        };
        let spheres: Vec<Sphere> = (0..200).map(sphere).collect();
        let found = near(&rules, &spheres, |rule| Some(rule.reach?.longest()));
        let one_by_one = rule.pairs().filter(|[one, other]| spheres[*one].meets(&spheres[*other], 0.02));
        let one_by_one: Vec<BodyPair> = one_by_one.map(|bodies| BodyPair { rule: 0, bodies }).collect();
        println!("{} of {} pairs are near", found.len(), rule.count());
        // Neither few nor most.
        assert!(found.len() > 600 && found.len() < rule.count() / 4);
        assert_eq!(found, one_by_one);
        assert!(near(&rules, &spheres, |_| None).is_empty());
        assert!(found.iter().all(|meeting| !meeting.bodies.contains(&62)));
        let mut overlaps = Vec::new();
        let all = each_overlap(&spheres, |bodies| {
            overlaps.push(bodies);
            if overlaps.len() < 10_000 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        });
        let bounded: Vec<usize> = (0..200).filter(|k| spheres[*k].is_bounded()).collect();
        let pairs = bounded.iter().flat_map(|one| bounded.iter().map(move |other| [*one, *other]));
        let one_by_one = pairs.filter(|[one, other]| one < other && spheres[*one].meets(&spheres[*other], 0.0));
        println!("{} spheres overlap", overlaps.len());
        assert!(all.is_continue() && !overlaps.is_empty());
        assert_eq!(overlaps, one_by_one.collect::<Vec<_>>());
        assert!(each_overlap(&spheres, |_| ControlFlow::Break(())).is_break());
        assert!([60, 61].iter().all(|body| found.iter().filter(|it| it.bodies.contains(body)).count() > 190));
    }
}
