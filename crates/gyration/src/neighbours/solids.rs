//! Bodies and supports with a shape: few of these, so that each body is looked at with all that it meets.

use super::rules::PairRules;
use super::{Pair, form};
use crate::body::{Body, Solid};
use crate::lattice::HERE;
use crate::load::Party;
use crate::pair::PairForm;
use crate::solid_support::SolidSupport;
use std::collections::HashMap;
use std::sync::Arc;

/// The pairs of the parts of bodies and of supports with a shape that rules join, in order; those of equal solids share
/// their forms.
pub(crate) fn solid_pairs(rules: &PairRules, bodies: &[Arc<Body>], supports: &[SolidSupport]) -> Vec<Pair> {
    let mut forms: HashMap<(usize, usize, usize, [usize; 2]), Arc<PairForm>> = HashMap::new();
    let mut pairs = Vec::new();
    for (number, rule) in rules.with_supports() {
        for (body, support) in rule.bodies[0].iter().flat_map(|body| rule.supports.iter().map(move |it| (*body, *it))) {
            let solids = [&bodies[body].solid, &supports[support].solid];
            for parts in Solid::parts_of(solids.map(|solid| &**solid)) {
                let key = (number, Arc::as_ptr(solids[0]) as usize, support, parts);
                let form = forms.entry(key).or_insert_with(|| Arc::new(form(rule, solids, parts)));
                let parties = [Party::Body(body), Party::SolidSupport(support)];
                pairs.push(Pair { rule: number, parties, cell: HERE, parts, form: Arc::clone(form) });
            }
        }
    }
    pairs
}
