//! The smallest gap of a body: its distance to supports, and the slab to another body that it meets, however far. Pairs
//! within reach have theirs; of the others those are asked that may be nearer.

use super::Scratch;
use super::contacts::support_gap_at;
use crate::acting::PairEnd;
use crate::inadmissible::{Inadmissible, Quantity};
use crate::instant::{BodyAt, PartyAt, outside, with_sides};
use crate::model::PATIENCE;
use crate::neighbours::{Pair, PairKey};
use crate::pair::PairLoads;
use std::collections::HashMap;
use std::hash::{BuildHasherDefault, DefaultHasher};

/// What a slab is wider than, for bodies of which no more is known: the distance of the centres less so many radii of
/// both.
const WIDEST: f64 = 3.0;
/// So few bodies are asked one by one.
const FEW: usize = 64;

/// The slabs between bodies out of reach that were found at an instant, since each of the two asks for them.
pub(super) type FarSlabs = HashMap<PairKey, f64, BuildHasherDefault<DefaultHasher>>;

/// A search for the smallest slab of a body.
struct Search<'a, 'b> {
    at: &'a BodyAt<'a>,
    scratch: &'b mut Scratch,
    /// The smallest so far [m].
    smallest: f64,
    /// How many bodies were looked at.
    looked: usize,
    /// What a slab is wider than: the distance of the centres less so many radii of both.
    widest: f64,
}

/// The smallest gap of a body to anything that it has a contact with [m]: its distance to a support, the width of the
/// slab to another body; infinite without contact or surface.
///
/// # Errors
/// [`Inadmissible`] if no plane separates it from another body.
pub fn gap_at(at: &BodyAt, scratch: &mut Scratch) -> Result<f64, Inadmissible> {
    let supports = support_gap_at(at);
    Ok(smallest_gap(at, scratch)?.min(supports))
}

/// The smallest slab between a body and another that it meets [m]; infinite if it meets none.
///
/// # Errors
/// [`Inadmissible`] if no plane separates two bodies.
fn smallest_gap(at: &BodyAt, scratch: &mut Scratch) -> Result<f64, Inadmissible> {
    let (near, rules) = (at.near(), at.model.rules());
    let smallest = at.pairs().map(|pair| pair.loads.gap).fold(f64::INFINITY, f64::min);
    let widest = if near.are_balls() { 1.0 } else { WIDEST };
    let mut search = Search { at, scratch, smallest, looked: 0, widest };
    let is_known = |end: &PairEnd| at.pair(end).is_some();
    let far = || near.pairs().of(at.index).filter(|end| !is_known(end)).map(|end| end.interaction);
    // The nearest of them leaves few of the others.
    let nearest = far().min_by(|one, other| search.least(one).total_cmp(&search.least(other)));
    if let Some(pair) = nearest {
        search.look(pair)?;
    }
    for pair in far().filter(|pair| !nearest.is_some_and(|nearest| std::ptr::eq(*pair, nearest))) {
        search.look(pair)?;
    }
    if near.is_whole() || !at.model.meets_bodies(at.index) {
        return Ok(search.smallest);
    }
    let partners = rules.of(at.index).iter().map(|rule| &rules.all()[*rule]);
    if partners.clone().map(|rule| rule.most_partners(at.index)).sum::<usize>() <= FEW {
        for other in partners.flat_map(|rule| rule.partners(at.index)) {
            search.ask(other)?;
        }
        return Ok(search.smallest);
    }
    for other in near.outsize() {
        search.ask(*other)?;
    }
    let radii = near.largest_radius() + at.body.radius_at(&at.motion.placement);
    for (distance, other) in near.outward(&at.motion.placement.position) {
        if distance - search.widest * radii > search.smallest {
            break;
        }
        search.ask(other)?;
    }
    Ok(search.smallest)
}

impl Search<'_, '_> {
    /// What the slab of a pair is no narrower than [m].
    ///
    /// Points are g_i + s_i off the plane in the mean of either surface at the most, s_i their radius about the middle
    /// of it, and d^−p is convex: Φ ≤ (g + s_A + s_B) Σ w_i S_i^−p. A plane across the distance D ≥ |Δ| − r_A − r_B has
    /// D times that sum, so that g ≥ D − s_A − s_B. That of two balls is D.
    fn least(&self, pair: &Pair) -> f64 {
        let parties = self.at.parties_of(pair);
        let distance = PartyAt::apart(&parties, pair.cell).norm();
        let hidden = |end: usize| {
            let (party, part) = (&parties[end], pair.parts[end]);
            let radius = party.solid().part_radius(part);
            if party.is_rigid() {
                return radius + party.solid().part_girth(part);
            }
            WIDEST * party.motion().placement.stretch_bound() * radius
        };
        pair.form.gap_of_balls(distance).unwrap_or_else(|| distance - hidden(0) - hidden(1))
    }

    /// Looks at the pairs that are not listed of the body and another.
    fn ask(&mut self, other: usize) -> Result<(), Inadmissible> {
        let at = self.at;
        self.looked += 1;
        if self.looked.is_multiple_of(PATIENCE) && at.model.is_given_up() {
            return Err(at.outside(Quantity::Interruption, f64::NAN));
        }
        let beside = at.beside(other);
        let radii = [at, &beside].map(|one| one.body.radius_at(&one.motion.placement));
        if at.from(&beside).norm() - self.widest * (radii[0] + radii[1]) >= self.smallest {
            return Ok(());
        }
        let rules = at.model.rules();
        for rule in rules.of(at.index) {
            let Some(bodies) = rules.all()[*rule].between(at.index, other) else { continue };
            for pair in at.near().unlisted(*rule, bodies, &at.model.bodies) {
                self.look(&pair)?;
            }
        }
        Ok(())
    }

    /// Looks at a pair out of reach.
    fn look(&mut self, pair: &Pair) -> Result<(), Inadmissible> {
        if self.least(pair) < self.smallest {
            self.smallest = self.smallest.min(self.slab(pair)?);
        }
        Ok(())
    }

    /// The slab between two bodies that are out of reach [m].
    fn slab(&mut self, pair: &Pair) -> Result<f64, Inadmissible> {
        let parties = self.at.parties_of(pair);
        if let Some(gap) = pair.form.gap_of_balls(PartyAt::apart(&parties, pair.cell).norm()) {
            return Ok(gap);
        }
        if let Some(known) = self.scratch.far_slabs.get(&pair.key()) {
            return Ok(*known);
        }
        let found = with_sides(pair, &parties, |sides| {
            // A plane of least potential may be beyond the digits of a number.
            let found = PairLoads::integrate(&pair.form, sides, None, &mut self.scratch.pairs);
            found.or_else(|_| PairLoads::nothing(&pair.form, sides))
        });
        let gap = found.map(|loads| loads.gap).map_err(|fault| outside(pair, fault))?;
        self.scratch.far_slabs.insert(pair.key(), gap);
        Ok(gap)
    }
}
