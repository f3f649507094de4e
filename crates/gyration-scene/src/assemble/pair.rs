//! Bodies that meet: what acts between any two, and whether they are apart at the start.

use super::body::AssembledBody;
use super::convex::convex_help;
use super::partners::without_surface;
use super::reach;
use super::start::placement;
use super::support::AssembledSupports;
use crate::check::Reporter;
use crate::file::Contact;
use crate::key::Key;
use gyration::body::Solid;
use gyration::contact::{AreaMeasure, ContactLaw, LawKind};
use gyration::kinematics::Placement;
use gyration::neighbours::{BodyPair, PairRule, PairRules, Sphere, each_near};
use gyration::pair::{Mass, Overlap, PairLaws, PairLawsError, Reach};
use gyration::tensor::Vec3;
use std::ops::ControlFlow;
use std::sync::Arc;

/// The laws of a contact between bodies; notes what cannot act there.
pub(super) fn laws(
    measure: AreaMeasure,
    laws: Vec<ContactLaw>,
    key: &Key,
    reporter: &mut Reporter<'_>,
) -> Option<Arc<PairLaws>> {
    let error = match PairLaws::new(measure, laws) {
        Ok(laws) => return Some(Arc::new(laws)),
        Err(error) => error,
    };
    let (key, message, help) = match error {
        PairLawsError::NoRepulsion => (
            key.key("repulsion"),
            "between bodies nothing says where the plane between them stands".to_owned(),
            "give it a `repulsion` with alpha > 0, or an `adhesion` with beta > 0, which places the plane",
        ),
        PairLawsError::TooWeak { kind, exponent } => {
            let exponent_key = if kind == LawKind::Adhesion { "nu_attractive" } else { "nu" };
            (
                key.key(kind.name()).key(exponent_key),
                format!("{exponent:?} is less than 2, the least with which a plane stays off both bodies"),
                "write an exponent of 2 or more",
            )
        }
        PairLawsError::TautAdhesion => (
            key.key("measure"),
            "this version has no adhesion with such a measure between bodies".to_owned(),
            "write \"deformed_area\" or \"reference_area\", or leave `adhesion` out",
        ),
    };
    reporter.note(&key, message, help);
    None
}

/// How many pairs of parts of bodies act on each other however far they are.
pub(super) fn count_endless(rule: &PairRule, assembled: &[Option<AssembledBody>]) -> usize {
    let of = |body: usize| assembled[body].as_ref().map(|assembled| &assembled.body);
    let parts = |body: usize| of(body).map_or(0, |body| body.solid.count_parts());
    rule.count_endless(parts, |body| of(body).is_some_and(|body| body.affine().is_some()))
}

/// Notes a reach at which the energy of a pair is no number.
pub(super) fn check_range(
    rule: &PairRule,
    assembled: &[Option<AssembledBody>],
    key: &Key,
    reporter: &mut Reporter<'_>,
) {
    let known = |set: &Arc<[usize]>| {
        let known = set.iter().filter_map(|body| Some(&assembled[*body].as_ref()?.body.solid));
        known.collect::<Vec<&Arc<Solid>>>()
    };
    check_range_of(rule, rule.bodies.each_ref().map(known), key, reporter);
}

/// The same of the solids of both sides.
fn check_range_of(rule: &PairRule, solids: [Vec<&Arc<Solid>>; 2], key: &Key, reporter: &mut Reporter<'_>) {
    let solids = solids.map(|mut solids| {
        solids.dedup_by(|one, other| Arc::ptr_eq(one, other));
        let masses = solids.into_iter().flat_map(|solid| {
            let mass = solid.mass.mass;
            (0..solid.count_parts()).map(move |part| Mass { surface: solid.part(part), mass })
        });
        let masses: Vec<Mass> = masses.collect();
        // U_c is between those of two smallest and of two largest surfaces.
        let smaller = |one: &Mass, other: &Mass| one.surface.area().total_cmp(&other.surface.area());
        let extreme = [masses.iter().copied().min_by(smaller), masses.iter().copied().max_by(smaller)];
        extreme[0].zip(extreme[1])
    });
    let [Some((least, most)), Some((other_least, other_most))] = solids else { return };
    let Some(reach) = rule.reach else { return };
    let help = match reach {
        Reach::Length(_) => "write a distance nearer to the gaps at which bodies turn back",
        Reach::Gaps { .. } => "write a length, a larger exponent, or another alpha",
    };
    for bodies in [[least, other_least], [most, other_most]] {
        if !reach.threshold(&rule.laws, bodies).energy.is_normal() {
            reporter.note(&key.key("reach"), "the energy at this distance leaves the range of numbers", help);
            return;
        }
    }
}

/// Notes bodies that meet and reach each other at the start.
pub(super) fn check_overlaps(
    rule: &PairRule,
    assembled: &[Option<AssembledBody>],
    key: &Key,
    reporter: &mut Reporter<'_>,
) {
    let placements: Vec<Option<Placement>> =
        assembled.iter().map(|body| body.as_ref().map(|body| placement(&body.start))).collect();
    let sphere = |(body, placement): (&Option<AssembledBody>, &Option<Placement>)| match (body, placement) {
        (Some(body), Some(placement)) => sphere(body, placement),
        _ => Sphere::NOWHERE,
    };
    let spheres: Vec<Sphere> = assembled.iter().zip(&placements).map(sphere).collect();
    let rules = PairRules::new(assembled.len(), vec![rule.clone()]);
    let _ = each_near(
        &rules,
        &spheres,
        |_| Some(0.0),
        |BodyPair { bodies, .. }| {
            let both = bodies.map(|body| assembled[body].as_ref().zip(placements[body].as_ref()));
            let [Some((one, first)), Some((other, second))] = both else { return ControlFlow::Continue(()) };
            if reporter.diagnostics.is_full() {
                return ControlFlow::Break(());
            }
            if let Some(overlap) = Solid::overlap([&one.body.solid, &other.body.solid], [first, second]) {
                overlapping([one, other], &overlap, &key.key("between"), reporter);
            }
            ControlFlow::Continue(())
        },
    );
}

/// A contact of bodies with a support that has a shape.
pub(super) struct WithSupport<'a> {
    /// Its place among the supports with a shape.
    pub(super) solid: usize,
    pub(super) bodies: Vec<usize>,
    /// Whether the bodies were named one by one.
    pub(super) named: bool,
    pub(super) supports: &'a AssembledSupports,
}

impl WithSupport<'_> {
    /// The rule by which they meet; none if something about it is wrong, which is noted.
    pub(super) fn rule(
        self,
        (written, key, gravity): (&Contact, &Key, &Vec3),
        (measure, acting): (AreaMeasure, Vec<ContactLaw>),
        assembled: &[Option<AssembledBody>],
        reporter: &mut Reporter<'_>,
    ) -> Option<PairRule> {
        let laws = laws(measure, acting, key, reporter)?;
        let between = key.key(if written.between.is_some() { "between" } else { "support" });
        let has_surface = |body: &usize| assembled[*body].as_ref().is_none_or(|it| it.body.solid.surface.is_some());
        let mut bodies = self.bodies;
        if !self.named {
            bodies.retain(has_surface);
        }
        let known = bodies.iter().filter_map(|body| assembled[*body].as_ref());
        if known.filter(|body| !can_meet(body, &between, reporter)).count() > 0 {
            return None;
        }
        let support = self.supports.solids[self.solid].as_ref()?;
        let sets = [bodies, Vec::new()];
        let reach = match written.reach {
            None => None,
            Some(reach) => {
                Some(reach::reach(reach, &laws, gravity, (&sets, Some(support)), (assembled, key, reporter))?)
            }
        };
        let rule = PairRule { bodies: sets.map(Arc::from), supports: Arc::from([self.solid]), laws, reach };
        let solids = rule.bodies[0].iter().filter_map(|body| Some(&assembled[*body].as_ref()?.body.solid));
        check_range_of(&rule, [solids.collect(), vec![&support.solid]], key, reporter);
        for body in rule.bodies[0].iter().filter_map(|body| assembled[*body].as_ref()) {
            if reporter.diagnostics.is_full() {
                break;
            }
            let placements = [&placement(&body.start), &support.at(0.0).placement];
            if let Some(overlap) = Solid::overlap([&body.body.solid, &support.solid], placements) {
                overlapping_by_name([&body.name, &support.name], &overlap, &between, reporter);
            }
        }
        Some(rule)
    }
}

/// A sphere that holds a body.
fn sphere(assembled: &AssembledBody, placement: &Placement) -> Sphere {
    let Some(radius) = assembled.body.solid.radius() else { return Sphere::NOWHERE };
    Sphere::new(placement.position, placement.stretch_bound() * radius)
}

/// Whether a body can meet others; notes why not.
pub(super) fn can_meet(assembled: &AssembledBody, key: &Key, reporter: &mut Reporter<'_>) -> bool {
    let name = &assembled.name;
    if assembled.body.solid.surface.is_none() {
        without_surface(assembled, key, reporter);
        return false;
    }
    if let Err(why) = assembled.body.solid.shape.check_convex() {
        let message = format!("\"{name}\" cannot meet other bodies: {why}");
        reporter.note(key, message, convex_help(why));
        return false;
    }
    true
}

/// Notes two bodies that overlap.
fn overlapping(both: [&AssembledBody; 2], overlap: &Overlap, key: &Key, reporter: &mut Reporter<'_>) {
    overlapping_by_name(both.map(|assembled| assembled.name.as_str()), overlap, key, reporter);
}

/// Notes two that overlap, of which the first can be moved.
fn overlapping_by_name([one, other]: [&str; 2], overlap: &Overlap, key: &Key, reporter: &mut Reporter<'_>) {
    let (message, [by, way]) = overlap_in_words(overlap);
    reporter.note(key, format!("\"{one}\" and \"{other}\" {message}"), format!("move \"{one}\" {by} {way}"));
}

/// That two bodies overlap, then by how much and along which direction the first has to move.
pub(super) fn overlap_in_words(overlap: &Overlap) -> (String, [String; 2]) {
    let [x, y, z] = overlap.normal.into();
    let way = format!("along [{x:.6}, {y:.6}, {z:.6}]");
    match overlap.touches() {
        true => ("touch at the start, and no force holds at a gap of 0".to_owned(), ["a little".to_owned(), way]),
        false => {
            let depth = format!("{:.6e} m", overlap.depth);
            (format!("reach each other at the start, by {depth}"), [format!("by more than {depth}"), way])
        }
    }
}
