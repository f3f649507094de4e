//! The pairs of bodies that may act on one another, kept while bodies move little.
//!
//! A list of Verlet: all pairs whose spheres come as near as their reach and a skin stand in it; it is made anew when a
//! body has moved by half the skin. Few pairs are all listed, once. So are those without a cutoff: of rules without a
//! reach, and of bodies that deform.

use super::images::{ImagePair, ImagePairs};
use super::rules::{PairRule, PairRules};
use super::spheres::{BodyPair, Sphere, near};
use super::{Pair, form};
use crate::body::{Body, Solid};
use crate::lattice::HERE;
use crate::load::{Interactions, Party};
use crate::pair::PairForm;
use crate::tensor::Vec3;
use rstar::RTree;
use rstar::primitives::GeomWithData;
use std::collections::HashMap;
use std::sync::{Arc, OnceLock};

/// So few pairs are all listed.
const FEW: usize = 128;
/// The skin, as a part of the mean radius of the bodies that meet.
const SKIN: f64 = 0.5;
/// What rounding leaves of a distance, as a part of it.
const ROUNDING: f64 = 1e-12;
/// A body so many times as large as the median is asked for its gap one by one, and so many of them at most.
const OUTSIZE: f64 = 4.0;
const MOST_OUTSIZE: usize = 32;

/// The pairs that may act at a configuration of the bodies.
#[derive(Debug, Clone, Default)]
pub struct NeighbourList {
    /// Those from which it is made.
    rules: PairRules,
    pairs: Interactions<Pair>,
    /// How many of these are of two bodies: they come first.
    of_bodies: usize,
    /// Whether it has all pairs of the rules.
    is_whole: bool,
    /// What bodies may move by in sum before it is made anew [m].
    skin: f64,
    sizes: Sizes,
    /// The centres of the bodies when it was made [m].
    places: Vec<Vec3>,
    forms: Forms,
    tree: OnceLock<RTree<Place>>,
}

/// The sizes of the bodies that meet others.
#[derive(Debug, Clone, Default)]
struct Sizes {
    /// Whether all of them are balls about their centres of mass.
    are_balls: bool,
    /// Those that are far larger than most, if they are few.
    outsize: Vec<usize>,
    /// The largest radius of all others [m].
    largest_radius: f64,
}

impl Sizes {
    /// Of bodies with their radii [m].
    fn of(bodies: &[(usize, f64)], are_balls: bool) -> Self {
        let mut radii: Vec<f64> = bodies.iter().map(|(_, radius)| *radius).collect();
        radii.sort_unstable_by(f64::total_cmp);
        let most = OUTSIZE * radii.get(radii.len() / 2).copied().unwrap_or(0.0);
        let mut outsize: Vec<usize> =
            bodies.iter().filter(|(_, radius)| *radius > most).map(|(body, _)| *body).collect();
        if outsize.len() > MOST_OUTSIZE {
            outsize.clear();
        }
        let others = bodies.iter().filter(|(body, _)| !outsize.contains(body));
        let largest_radius = others.map(|(_, radius)| *radius).fold(0.0, f64::max);
        Self { are_balls, outsize, largest_radius }
    }
}

/// A place, and the body there.
type Place = GeomWithData<[f64; 3], usize>;

/// The forms of pairs, one for all pairs of equal parts of equal bodies: by rule, solids and parts.
#[derive(Debug, Clone, Default)]
struct Forms(HashMap<(usize, [(usize, usize); 2]), Form>);

/// A form, and the solids by whose addresses it is found.
#[derive(Debug, Clone)]
struct Form {
    form: Arc<PairForm>,
    _solids: [Arc<Solid>; 2],
}

impl Forms {
    /// That of two parts; one that was known before is taken over.
    fn of(
        &mut self,
        before: &mut Self,
        number: usize,
        rule: &PairRule,
        solids: [&Arc<Solid>; 2],
        parts: [usize; 2],
    ) -> Arc<PairForm> {
        let part = |end: usize| (Arc::as_ptr(solids[end]) as usize, parts[end]);
        let key = (number, [part(0), part(1)]);
        let made = || Form { form: Arc::new(form(rule, solids, parts)), _solids: solids.map(Arc::clone) };
        let known = self.0.entry(key).or_insert_with(|| before.0.remove(&key).unwrap_or_else(made));
        Arc::clone(&known.form)
    }
}

impl NeighbourList {
    /// The pairs.
    pub fn pairs(&self) -> &Interactions<Pair> {
        &self.pairs
    }

    /// Whether these are all pairs that there are, wherever the bodies are.
    pub fn is_whole(&self) -> bool {
        self.is_whole
    }

    /// Makes the list anew where it does not hold for these places [m] any longer; of a lattice it is that of its
    /// images. The pairs with supports are all listed, behind those of bodies.
    pub fn update(
        &mut self,
        (rules, with_supports): (&PairRules, &[Pair]),
        images: Option<&ImagePairs>,
        bodies: &[Arc<Body>],
        place: impl Fn(usize) -> Vec3,
    ) {
        if rules.is_empty() && self.rules.is_empty() {
            return;
        }
        let is_of_these = self.rules.are(rules);
        if let Some(images) = images {
            if !is_of_these {
                *self = Self { rules: rules.clone(), is_whole: true, ..Self::default() };
                self.list((bodies, with_supports), images.all().iter().copied(), &mut Forms::default());
            }
            return;
        }
        if is_of_these && self.is_whole {
            return;
        }
        let stays = |(index, before): (usize, &Vec3)| 2.0 * (place(index) - before).norm() <= self.skin;
        if is_of_these && self.places.iter().enumerate().all(stays) {
            return;
        }
        if !is_of_these {
            let is_endless = |rule: &PairRule| rule.reach.is_none();
            let is_whole =
                rules.all().iter().map(PairRule::count).sum::<usize>() <= FEW || rules.all().iter().all(is_endless);
            let meeting = (0..bodies.len()).filter(|body| !rules.of(*body).is_empty());
            let meeting: Vec<(usize, f64)> =
                meeting.filter_map(|body| Some((body, bodies[body].solid.radius()?))).collect();
            let skin = SKIN * meeting.iter().map(|(_, radius)| radius).sum::<f64>() / meeting.len() as f64;
            let sizes = Sizes::of(&meeting, meeting.iter().all(|(body, _)| bodies[*body].is_rigid_ball()));
            *self = Self { rules: rules.clone(), is_whole, skin, sizes, ..Self::default() };
        }
        self.make((bodies, with_supports), place);
    }

    fn make(&mut self, (bodies, with_supports): (&[Arc<Body>], &[Pair]), place: impl Fn(usize) -> Vec3) {
        let Self { rules, is_whole, skin, forms, .. } = self;
        // Those of pairs that are no longer near go.
        let mut before = std::mem::take(forms);
        let spheres: Vec<Sphere> = match is_whole {
            true => vec![Sphere::EVERYWHERE; bodies.len()],
            false => bodies.iter().enumerate().map(|(index, body)| sphere(body, place(index))).collect(),
        };
        let reach = |rule: &PairRule| Some(rule.reach.map_or(f64::INFINITY, |reach| reach.longest() + *skin));
        let near = near(rules, &spheres, reach).into_iter().map(|pair| ImagePair { pair, cell: HERE });
        let near: Vec<ImagePair> = near.collect();
        self.list((bodies, with_supports), near, &mut before);
        self.places = if self.is_whole { Vec::new() } else { (0..bodies.len()).map(place).collect() };
        self.tree = OnceLock::new();
    }

    /// Lists the pairs of the parts of bodies; forms that were known before are taken over.
    fn list(
        &mut self,
        (bodies, with_supports): (&[Arc<Body>], &[Pair]),
        near: impl IntoIterator<Item = ImagePair>,
        before: &mut Forms,
    ) {
        let Self { rules, forms, .. } = self;
        let mut pairs = Vec::new();
        for ImagePair { pair: BodyPair { rule, bodies: both }, cell } in near {
            let solids = both.map(|body| &bodies[body].solid);
            let (forms, before) = (&mut *forms, &mut *before);
            let rules = &*rules;
            pairs.extend(Solid::parts_of(solids.map(|solid| &**solid)).map(|parts| Pair {
                rule,
                parties: both.map(Party::Body),
                cell,
                parts,
                form: forms.of(before, rule, &rules.all()[rule], solids, parts),
            }));
        }
        self.of_bodies = pairs.len();
        pairs.extend_from_slice(with_supports);
        self.pairs = Interactions::new(bodies.len(), pairs);
    }

    /// The pairs of the parts of two bodies that a rule joins, unless they are listed.
    pub fn unlisted<'a>(
        &'a self,
        rule: usize,
        both: [usize; 2],
        bodies: &'a [Arc<Body>],
    ) -> impl Iterator<Item = Pair> {
        let solids = both.map(|body| &bodies[body].solid);
        let pairs = (rule, both.map(Party::Body));
        let listed = &self.pairs.all()[..self.of_bodies];
        let is_listed = listed.binary_search_by(|pair| (pair.rule, pair.parties).cmp(&pairs)).is_ok();
        (!is_listed).then(|| Pair::all_of(&self.rules, rule, both, solids)).into_iter().flatten()
    }

    /// Whether all bodies that meet somebody are rigid balls about their centres of mass.
    pub fn are_balls(&self) -> bool {
        self.sizes.are_balls
    }

    /// The few bodies that are far larger than the others.
    pub fn outsize(&self) -> &[usize] {
        &self.sizes.outsize
    }

    /// The largest radius of all others that meet somebody [m].
    pub fn largest_radius(&self) -> f64 {
        self.sizes.largest_radius
    }

    /// These others, whose centres are at least so far from a place [m], with this bound, as it ascends.
    pub fn outward(&self, from: &Vec3) -> impl Iterator<Item = (f64, usize)> {
        let is_finite = |place: &Vec3| place.iter().all(|x| x.is_finite());
        let tree = self.tree.get_or_init(|| {
            let is_among = |body: usize| !self.rules.of(body).is_empty() && !self.sizes.outsize.contains(&body);
            let places = self.places.iter().enumerate().filter(|(body, place)| is_among(*body) && is_finite(place));
            RTree::bulk_load(places.map(|(index, place)| Place::new((*place).into(), index)).collect())
        });
        let from: [f64; 3] = if is_finite(from) { (*from).into() } else { [0.0; 3] };
        let skin = self.skin;
        let nearest = tree.nearest_neighbor_iter_with_distance_2(from);
        nearest.map(move |(place, square)| ((1.0 - ROUNDING) * square.sqrt() - 0.5 * skin, place.data))
    }
}

/// A sphere about a rigid body; no place for one without a surface.
fn sphere(body: &Body, place: Vec3) -> Sphere {
    match (body.affine(), body.solid.radius()) {
        (_, None) => Sphere::NOWHERE,
        (Some(_), _) => Sphere::EVERYWHERE,
        (None, Some(radius)) => Sphere::new(place, radius),
    }
}
