//! The bodies of the model: those of the file that stand alone, and the copies of the others.
//!
//! First come those whose places are written, then those at random places, which keep clear of all before them that
//! they have contacts with.

use super::body::{AssembledBody, PreparedBody};
use super::context::SceneContext;
use super::partners::{Names, Partners};
use super::random::{Around, RandomPlaces};
use super::solids::Solids;
use super::start::placement;
use super::support::AssembledSupports;
use crate::check::{Copies, PartialScene, Reporter};
use crate::file::RandomCopies;
use crate::places::CopyPlace;
use crate::quantity::si;
use crate::units::shown;
use gyration::load::Party;
use gyration::state::Start;
use std::collections::BTreeSet;
use std::ops::Range;

/// The bodies of the model; none in the place of one with an error.
#[derive(Debug)]
pub(super) struct AssembledBodies {
    pub(super) all: Vec<Option<AssembledBody>>,
    /// How each body of the file starts as it is written.
    pub(super) starts: Vec<Option<Start>>,
}

impl AssembledBodies {
    /// Builds them; notes what is wrong with them. Those with an error still count for names and groups.
    pub(super) fn of(
        partial: &PartialScene,
        supports: &AssembledSupports,
        context: &SceneContext,
        reporter: &mut Reporter<'_>,
    ) -> Self {
        let solids = &mut Solids::default();
        let mut this = Self { all: vec![None; partial.numbers.count()], starts: vec![None; partial.roll.len()] };
        let mut waiting = Vec::new();
        for body in &partial.bodies {
            let Some(prepared) = PreparedBody::new(body, context, solids, reporter) else { continue };
            let first = partial.numbers.range(body.number).start;
            match &partial.copies[body.number] {
                Copies::Alone => {
                    this.all[first] = prepared.alone(first, solids, reporter);
                    this.starts[body.number] = this.all[first].as_ref().map(|assembled| assembled.start);
                }
                Copies::Placed(places) => {
                    this.starts[body.number] = prepared.start(reporter);
                    this.copy(&prepared, first, places, solids, reporter);
                }
                Copies::Random(written) => {
                    this.starts[body.number] = prepared.start(reporter);
                    waiting.push((prepared, written));
                }
                Copies::Unknown => _ = prepared.start(reporter),
            }
        }
        let names = Names::of(partial);
        for (prepared, written) in &waiting {
            this.scatter((prepared, written), (partial, &names, supports), solids, reporter);
        }
        this
    }

    /// The copies of a body, from an index on; what is wrong with them is noted of the first that it is wrong with.
    fn copy(
        &mut self,
        prepared: &PreparedBody<'_>,
        first: usize,
        places: &[CopyPlace],
        solids: &mut Solids,
        reporter: &mut Reporter<'_>,
    ) {
        if !prepared.may_move(places, reporter) {
            return;
        }
        let name = &prepared.placed.value.name;
        for (number, place) in places.iter().enumerate() {
            let Some(copy) = prepared.copy(number, place, solids, &mut reporter.of_copy(name, number)) else { return };
            self.all[first + number] = Some(copy);
        }
    }

    /// The copies of a body at random places; notes that they do not fit.
    fn scatter(
        &mut self,
        (prepared, written): (&PreparedBody<'_>, &RandomCopies),
        (partial, names, supports): (&PartialScene, &Names<'_>, &AssembledSupports),
        solids: &mut Solids,
        reporter: &mut Reporter<'_>,
    ) {
        let placed = prepared.placed;
        let Some(start) = self.starts[placed.number].as_ref() else { return };
        let radius = placement(start).stretch_bound() * prepared.solid.radius().unwrap_or(0.0);
        let numbers = partial.numbers.range(placed.number);
        let around = self.around((partial, names, supports), &numbers);
        let drawn = RandomPlaces { written, radius, position: si(&placed.value.position), around: &around }.draw();
        match drawn {
            Ok(places) => self.copy(prepared, numbers.start, &places, solids, reporter),
            Err(found) => {
                let (message, help) = crowded(&placed.value.name, written, radius, found);
                reporter.note(&placed.key.key("copies").key("random"), message, help);
            }
        }
    }

    /// What bodies of these indices have contacts with, but for one another, as far as it has a place.
    fn around<'a>(
        &'a self,
        (partial, names, supports): (&PartialScene, &Names<'_>, &'a AssembledSupports),
        own: &Range<usize>,
    ) -> Around<'a> {
        let (mut planes, mut solids, mut bodies) = (BTreeSet::new(), BTreeSet::new(), BTreeSet::new());
        let is_own = |set: &[usize]| set.iter().any(|body| own.contains(body));
        for contact in &partial.contacts {
            match names.partners(&contact.value, self.all.len()) {
                Some(Partners::Support { support, bodies, .. }) if is_own(&bodies) => match supports.party(support) {
                    Party::Support(plane) => _ = planes.insert(plane),
                    Party::SolidSupport(solid) => _ = solids.insert(solid),
                    Party::Body(_) | Party::Space => {}
                },
                Some(Partners::Bodies([one, other])) => {
                    let met = [(&one, &other), (&other, &one)].into_iter().filter(|(set, _)| is_own(set));
                    bodies.extend(met.flat_map(|(_, met)| met.iter().copied()).filter(|body| !own.contains(body)));
                }
                _ => {}
            }
        }
        let planes = planes.iter().flat_map(|plane| &supports.planes[*plane]);
        let solids = solids.iter().flat_map(|solid| &supports.solids[*solid]);
        let solids = solids.map(|support| (&*support.solid, support.at(0.0).placement));
        let bodies = bodies.iter().flat_map(|body| &self.all[*body]);
        let bodies = bodies.map(|body| (&*body.body.solid, placement(&body.start)));
        Around::new(planes.collect(), solids.chain(bodies))
    }
}

/// Where spheres fill so much of a volume, in per cent, these alone may leave no place for another.
const DENSE: f64 = 20.0;

/// What is wrong where only so many copies have found a place, and the fix.
fn crowded(name: &str, written: &RandomCopies, radius: f64, found: usize) -> (String, String) {
    let count = written.count.0;
    let half_gap = radius + 0.5 * written.gap.value();
    let [low, high] = written.bounds.each_ref().map(si);
    let volume = (high - low).add_scalar(2.0 * half_gap).product();
    let part = 100.0 * count * 4.0 / 3.0 * std::f64::consts::PI * half_gap.powi(3) / volume;
    let message = format!(
        "of {count} copies of \"{name}\" {found} find a place: all bounding spheres, of a radius of {} m, would fill \
         {part:.1} % of the volume with half the gap around them",
        shown(radius)
    );
    let help = if part > DENSE {
        "write fewer, a larger box or a smaller gap: at random spheres fill some 30 % of a volume; a `grid` holds more"
    } else {
        "clear the box, which is told from `position`, of supports and bodies that they have contacts with, or write fewer"
    };
    (message, help.to_owned())
}
