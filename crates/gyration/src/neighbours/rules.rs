//! Rules: what a scene says of who meets whom.

use crate::body::{Body, Solid};
use crate::pair::{Mass, PairLaws, Reach};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Any body of one set meets any body of another, or any of some supports with a shape, by the same laws.
#[derive(Debug, Clone, PartialEq)]
pub struct PairRule {
    /// The indices of the bodies of both sets, ascending.
    pub bodies: [Arc<[usize]>; 2],
    /// The indices of the supports with a shape that those of the first set meet; the second set is empty then.
    pub supports: Arc<[usize]>,
    /// What acts between two of them.
    pub laws: Arc<PairLaws>,
    /// Where it begins; none if it is everywhere.
    pub reach: Option<Reach>,
}

/// The rules of a model, which copies of it share.
#[derive(Debug, Clone)]
pub struct PairRules {
    all: Arc<[PairRule]>,
    /// Where the rules of each body begin, and where the last end; empty without rules.
    starts: Arc<[usize]>,
    /// The numbers of the rules by which a body has somebody to meet, body by body.
    of: Arc<[usize]>,
}

impl PairRule {
    /// A distance from which on the parts of two bodies do nothing to each other [m]; none if there is none.
    pub fn range_between(&self, solids: [&Solid; 2], parts: [usize; 2]) -> Option<f64> {
        Some(self.reach?.range(&self.laws, masses(solids, parts)))
    }

    /// Two bodies in the order in which the rule joins them; none if it does not.
    pub fn between(&self, one: usize, other: usize) -> Option<[usize; 2]> {
        let (first, second) = (one.min(other), one.max(other));
        let joins = |a: usize, b: usize| a != b && self.is_in(0, a) && self.is_in(1, b);
        let orders = [[first, second], [second, first]];
        orders.into_iter().find(|[a, b]| joins(*a, *b))
    }

    fn is_in(&self, set: usize, body: usize) -> bool {
        self.bodies[set].binary_search(&body).is_ok()
    }

    /// All pairs that it joins, each once, ascending.
    pub fn pairs(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        let [one, other] = &self.bodies;
        let alike = one == other;
        one.iter().flat_map(move |first| {
            // Of two equal sets the bodies behind are left.
            let from = if alike { other.partition_point(|second| second <= first) } else { 0 };
            let joined = move |second: &&usize| alike || self.between(*first, **second) == Some([*first, **second]);
            other[from..].iter().filter(joined).map(|second| [*first, *second])
        })
    }

    /// The bodies that a body meets, ascending within each set.
    pub fn partners(&self, body: usize) -> impl Iterator<Item = usize> + '_ {
        let of_set = move |own: usize| {
            let others = if self.is_in(own, body) { &self.bodies[1 - own][..] } else { &[] };
            others.iter().copied().filter(move |other| *other != body)
        };
        // Who is in both sets is met once.
        let twice = move |other: &usize| self.is_in(0, body) && self.is_in(1, *other);
        of_set(0).chain(of_set(1).filter(move |other| !twice(other)))
    }

    /// How many these are at most.
    pub fn most_partners(&self, body: usize) -> usize {
        let of_set = |own: usize| if self.is_in(own, body) { self.bodies[1 - own].len() } else { 0 };
        of_set(0) + of_set(1)
    }

    /// How many pairs of parts of bodies it joins, given how many parts each has.
    pub fn count_parts(&self, parts: impl Fn(usize) -> usize) -> usize {
        let sums = self.bodies.each_ref().map(|set| set.iter().map(|body| parts(*body)).sum::<usize>());
        let both = self.bodies[0].iter().filter(|body| self.is_in(1, **body)).map(|body| parts(*body));
        let (common, squares) = both.fold((0, 0), |(sum, squares), n| (sum + n, squares + n * n));
        sums[0] * sums[1] - squares - (common * common - squares) / 2
    }

    /// How many of these act on each other however far they are, given too which bodies deform: all without a reach.
    pub fn count_endless(&self, parts: impl Fn(usize) -> usize, deforms: impl Fn(usize) -> bool) -> usize {
        let rigid = |body: usize| if deforms(body) { 0 } else { parts(body) };
        let within_reach = if self.reach.is_some() { self.count_parts(rigid) } else { 0 };
        self.count_parts(&parts) - within_reach
    }

    /// How many pairs of bodies it joins.
    pub fn count(&self) -> usize {
        self.count_parts(|_| 1)
    }

    /// Whether a body has somebody to meet.
    fn concerns(&self, body: usize) -> bool {
        let meets = |own: usize| self.is_in(own, body) && self.bodies[1 - own].iter().any(|other| *other != body);
        meets(0) || meets(1)
    }

    /// The bodies that meet anything.
    pub fn members(&self) -> impl Iterator<Item = usize> + '_ {
        let alone = if self.supports.is_empty() { &[][..] } else { &self.bodies[0][..] };
        self.chain().flatten().chain(alone.iter().copied())
    }

    /// So few pairs that any two bodies that they join through any chain are joined through these.
    pub fn chain(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        let star = |own: usize| {
            let center = self.bodies[own].first();
            center.into_iter().flat_map(move |body| self.bodies[1 - own].iter().map(move |other| [*body, *other]))
        };
        star(0).chain(star(1)).filter(|[one, other]| one != other)
    }
}

/// The parts of two bodies with the masses of the bodies.
pub(super) fn masses<'a>(solids: [&'a Solid; 2], parts: [usize; 2]) -> [Mass<'a>; 2] {
    [0, 1].map(|end| Mass { surface: solids[end].part(parts[end]), mass: solids[end].mass.mass })
}

impl Default for PairRules {
    fn default() -> Self {
        Self { all: Arc::from([]), starts: Arc::from([]), of: Arc::from([]) }
    }
}

impl PairRules {
    /// Those with supports that have a shape, and their numbers.
    pub fn with_supports(&self) -> impl Iterator<Item = (usize, &PairRule)> {
        self.all.iter().enumerate().filter(|(_, rule)| !rule.supports.is_empty())
    }

    /// The rules by which a body meets supports with a shape.
    pub fn with_supports_of(&self, body: usize) -> impl Iterator<Item = &PairRule> {
        self.with_supports().map(|(_, rule)| rule).filter(move |rule| rule.is_in(0, body))
    }

    /// The rules between so many bodies.
    ///
    /// # Panics
    /// If the bodies of a set do not ascend, or one does not exist, or a rule joins both bodies and supports.
    pub fn new(bodies: usize, all: Vec<PairRule>) -> Self {
        if all.is_empty() {
            return Self::default();
        }
        let ascends = |set: &Arc<[usize]>| {
            set.windows(2).all(|two| two[0] < two[1]) && set.last().is_none_or(|last| *last < bodies)
        };
        assert!(all.iter().flat_map(|rule| &rule.bodies).all(ascends), "the sets of a rule are of the {bodies} bodies");
        let is_of_one_sort = |rule: &PairRule| rule.supports.is_empty() || rule.bodies[1].is_empty();
        assert!(all.iter().all(is_of_one_sort), "a rule joins bodies, or bodies and supports");
        let mut of: Vec<(usize, usize)> = Vec::new();
        for (number, rule) in all.iter().enumerate() {
            let concerned = rule.bodies.iter().flat_map(|set| set.iter()).filter(|body| rule.concerns(**body));
            of.extend(concerned.map(|body| (*body, number)));
        }
        of.sort_unstable();
        of.dedup();
        let starts = (0..=bodies).map(|index| of.partition_point(|(body, _)| *body < index)).collect();
        Self { all: all.into(), starts, of: of.into_iter().map(|(_, rule)| rule).collect() }
    }

    /// All of them.
    pub fn all(&self) -> &[PairRule] {
        &self.all
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// Whether these are the same as others, or a copy of them.
    pub fn are(&self, others: &Self) -> bool {
        Arc::ptr_eq(&self.all, &others.all)
    }

    /// How many pairs of parts of bodies they join, and how many of these however far they are: by rules without a
    /// reach, and of bodies that deform.
    pub fn count(&self, bodies: &[Arc<Body>]) -> [usize; 2] {
        let parts = |body: usize| bodies[body].solid.count_parts();
        let deforms = |body: usize| bodies[body].affine().is_some();
        let of_rule = |rule: &PairRule| [rule.count_parts(parts), rule.count_endless(parts, deforms)];
        self.all.iter().map(of_rule).fold([0; 2], |sum, more| [sum[0] + more[0], sum[1] + more[1]])
    }

    /// The numbers of the rules by which a body has somebody to meet.
    pub fn of(&self, body: usize) -> &[usize] {
        if body + 1 < self.starts.len() { &self.of[self.starts[body]..self.starts[body + 1]] } else { &[] }
    }

    /// All of them, each with those of its bodies that are among some, which ascend, by their places among these: in a
    /// lattice a body alone has its images to meet.
    #[must_use]
    pub fn of_images(&self, members: &[usize]) -> Self {
        let set = |bodies: &Arc<[usize]>| bodies.iter().filter_map(|body| members.binary_search(body).ok()).collect();
        let of = |rule: &PairRule| PairRule { bodies: rule.bodies.each_ref().map(set), ..rule.clone() };
        Self::new(members.len(), self.all.iter().map(of).collect())
    }

    /// Those between some bodies, which ascend, with the places of their bodies among these.
    #[must_use]
    pub fn among(&self, members: &[usize]) -> Self {
        let mut sets: BTreeMap<usize, [Vec<usize>; 2]> = BTreeMap::new();
        for (number, rule) in self.with_supports() {
            let place = |(place, body): (usize, &usize)| rule.is_in(0, *body).then_some(place);
            let own: Vec<usize> = members.iter().enumerate().filter_map(place).collect();
            if !own.is_empty() {
                sets.insert(number, [own, Vec::new()]);
            }
        }
        if members.len() < 2 && sets.is_empty() {
            return Self::default();
        }
        for (place, body) in members.iter().enumerate() {
            for number in self.of(*body) {
                let own = sets.entry(*number).or_default();
                (0..2).filter(|set| self.all[*number].is_in(*set, *body)).for_each(|set| own[set].push(place));
            }
        }
        let rules =
            sets.into_iter().map(|(number, sets)| PairRule { bodies: sets.map(Arc::from), ..self.all[number].clone() });
        Self::new(members.len(), rules.filter(|rule| rule.members().next().is_some()).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::{AreaMeasure, ContactLaw, Repulsion};

    fn rule(one: &[usize], other: &[usize]) -> PairRule {
        let repulsion = ContactLaw::Repulsion(Repulsion { alpha: 1.0, exponent: 6.0, reference_gap: 1.0 });
        let laws = PairLaws::new(AreaMeasure::ReferenceArea, vec![repulsion]).unwrap();
        PairRule { bodies: [one.into(), other.into()], supports: Arc::from([]), laws: Arc::new(laws), reach: None }
    }

    /// Two sets, and the pairs that they join.
    type Sets = (&'static [usize], &'static [usize], &'static [[usize; 2]]);

    const SETS: [Sets; 6] = [
        (&[0, 1, 2], &[0, 1, 2], &[[0, 1], [0, 2], [1, 2]]),
        (&[0], &[1], &[[0, 1]]),
        (&[2], &[0, 1, 2], &[[2, 0], [2, 1]]),
        (&[0, 1], &[1, 2], &[[0, 1], [0, 2], [1, 2]]),
        (&[0, 1, 3], &[1, 2, 3], &[[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [3, 2]]),
        (&[1], &[1], &[]),
    ];

    #[test]
    fn pairs_are_of_two_different_bodies_and_come_once() {
        for (one, other, pairs) in SETS {
            let rule = rule(one, other);
            assert_eq!(rule.pairs().collect::<Vec<_>>(), pairs);
            assert_eq!(rule.count(), pairs.len());
            for (a, b) in (0..4).flat_map(|a| (0..4).map(move |b| (a, b))) {
                let joined = pairs.iter().find(|pair| **pair == [a, b] || **pair == [b, a]);
                assert_eq!(rule.between(a, b), joined.copied(), "{a} {b}");
            }
        }
    }

    #[test]
    fn a_chain_joins_whatever_the_pairs_join() {
        for (one, other, pairs) in SETS {
            let rule = rule(one, other);
            let reached = |pairs: &[[usize; 2]], from: usize| {
                let mut known = vec![from];
                while let Some([a, b]) = pairs.iter().find(|[a, b]| known.contains(a) != known.contains(b)) {
                    known.push(if known.contains(a) { *b } else { *a });
                }
                known.sort_unstable();
                known
            };
            let chain: Vec<[usize; 2]> = rule.chain().collect();
            assert!((0..4).all(|body| reached(&chain, body) == reached(pairs, body)), "{chain:?}");
        }
    }

    #[test]
    fn rules_among_some_bodies_join_the_same_ones() {
        let rules = PairRules::new(5, vec![rule(&[0, 2, 4], &[0, 2, 4]), rule(&[1], &[2]), rule(&[1], &[3])]);
        assert_eq!([0, 1, 2, 3].map(|body| rules.of(body).to_vec()), [vec![0], vec![1, 2], vec![0, 1], vec![2]]);
        let among = rules.among(&[1, 2, 4]);
        let pairs: Vec<_> = among.all().iter().map(|rule| rule.pairs().collect::<Vec<_>>()).collect();
        assert_eq!(pairs, [[[1, 2]], [[0, 1]]]);
        assert!(rules.among(&[3, 4]).is_empty() && !rules.are(&among) && rules.are(&rules.clone()));
    }
}
