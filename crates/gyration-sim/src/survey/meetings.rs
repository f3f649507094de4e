//! What the survey says of bodies that meet: their gap at the start, and whether a law forbids them to touch.
//!
//! The verdict is that of the sharper of the two features. All cells of a lattice meet alike: what a body of a cell and
//! an image do to each other is told once, in the cells in which the two start nearest.

use super::laws::LawSurvey;
use super::reach_change::{ReachChange, solids};
use crate::format::significant;
use gyration::Party;
use gyration::dynamics::Workspace;
use gyration::lattice::{Cell, HERE};
use gyration::model::Model;
use gyration::neighbours::{Pair, PairKey};
use gyration::state::State;
use serde::Serialize;
use std::collections::{BTreeMap, HashMap};
use std::fmt::Write as _;

/// Meetings that are told one by one.
const MOST: usize = 12;
/// Meetings that are listed.
const MOST_LISTED: usize = 10_000;
/// Pairs without a reach at which a step costs little.
const FEW_ENDLESS: usize = 1000;
/// Evaluations of an explicit step.
pub(super) const EVALUATIONS: usize = 16;

/// What can be said of two bodies, or a body and a support with a shape, that meet.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeetingSurvey {
    /// Names of the two.
    pub between: [String; 2],
    /// In a lattice the cell of the second as seen from that of the first.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cell: Option<Cell>,
    /// The width of the slab between them at the start [m]; none where they do not feel each other.
    pub initial_gap: Option<f64>,
    /// The distance at which they begin to feel each other [m]; none if they always do.
    pub reach: Option<f64>,
    /// By what part of itself that makes the gap smaller at which they come to rest or turn back; infinite, null in
    /// JSON, where it is near that gap; none where nothing brings them together.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reach_change: Option<f64>,
    /// The laws between them.
    pub laws: Vec<LawSurvey>,
    /// Whether one of the laws forbids touching.
    pub forbids_touching: bool,
}

/// The meetings of a model.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Meetings {
    /// Those that are told.
    pub told: Vec<MeetingSurvey>,
    /// How many there are, and how many pairs feel each other however far they are.
    pub counts: [usize; 2],
}

impl Meetings {
    /// The meetings of a model of so many cells, in order; of very many the first of each contact and those within
    /// reach at the start.
    pub fn of(model: &Model, start: &State, cells: usize) -> Self {
        let mut workspace = Workspace::default();
        // A scene whose bodies reach each other at the start has been refused; of very many pairs the last ones may not
        // have been looked at in time.
        let _ = workspace.pair_gaps(model, start.time, start.numbers());
        if model.images().is_some() {
            return Self::of_lattice(model, start, cells, &workspace);
        }
        let near = || workspace.found_gaps().iter().filter(|(_, slab)| slab.gap < f64::INFINITY);
        let known: HashMap<_, f64> = near().map(|(pair, slab)| (pair.key(), slab.gap)).collect();
        let of = |pair: &Pair| MeetingSurvey::of(model, start, pair, known.get(&pair.key()).copied());
        let counts = model.count_pairs();
        if counts[0] <= MOST_LISTED {
            let pairs = model.pairs().map(|pair| of(&pair));
            return Self { told: pairs.chain(model.pairs_with_supports().iter().map(of)).collect(), counts };
        }
        let rules = model.rules().all().iter().enumerate();
        let first = rules.filter_map(|(rule, set)| model.pairs_between(rule, set.pairs().next()?).next());
        let mut pairs: Vec<Pair> = first.chain(near().take(MOST_LISTED).map(|(pair, _)| pair.clone())).collect();
        pairs.sort_by_key(Pair::key);
        pairs.dedup_by_key(|pair| pair.key());
        Self { told: pairs.iter().map(of).collect(), counts }
    }

    /// Those of one cell, by contact and gap.
    fn of_lattice(model: &Model, start: &State, cells: usize, workspace: &Workspace) -> Self {
        let deforms = |party: &Party| party.body().is_some_and(|body| model.bodies[body].affine().is_some());
        let is_endless = |pair: &Pair| pair.form.reach.is_none() || pair.parties.iter().any(deforms);
        // The images of a body in all cells stand behind one another.
        let in_cell = |party: Party| party.body().map_or(party, |body| Party::Body(body / cells));
        let mut endless = 0;
        let mut nearest: BTreeMap<PairKey, (&Pair, f64)> = BTreeMap::new();
        for (pair, slab) in workspace.found_gaps().iter() {
            endless += usize::from(is_endless(pair));
            let (is_with_support, rule, parties, cell, parts) = pair.key();
            let key = (is_with_support, rule, parties.map(in_cell), cell, parts);
            let known = nearest.entry(key).or_insert((pair, slab.gap));
            if slab.gap < known.1 {
                *known = (pair, slab.gap);
            }
        }
        let mut pairs: Vec<(&Pair, f64)> = nearest.into_values().collect();
        let contact = |pair: &Pair| (pair.bodies().is_none(), pair.rule);
        pairs
            .sort_by(|(one, gap), (other, wider)| contact(one).cmp(&contact(other)).then_with(|| gap.total_cmp(wider)));
        let of = |(pair, gap): &(&Pair, f64)| MeetingSurvey {
            cell: Some(pair.cell),
            ..MeetingSurvey::of(model, start, pair, Some(*gap).filter(|gap| *gap < f64::INFINITY))
        };
        Self { told: pairs.iter().take(MOST_LISTED).map(of).collect(), counts: [pairs.len(), endless] }
    }
}

impl MeetingSurvey {
    fn of(model: &Model, start: &State, pair: &Pair, initial_gap: Option<f64>) -> Self {
        let shapes = solids(model, pair).map(|solid| &solid.shape);
        let [first, second] = shapes.map(|shape| shape.sharpest_feature());
        let sharper = if first >= second { shapes[0] } else { shapes[1] };
        let laws = LawSurvey::all(pair.form.laws.laws(), sharper);
        Self {
            between: pair.parties.map(|party| model.party_name(party).to_owned()),
            cell: None,
            initial_gap,
            reach: pair.form.reach,
            reach_change: ReachChange::of(model, start, pair).map(|change| change.part),
            forbids_touching: laws.iter().any(|law| law.forbids_touching == Some(true)),
            laws,
        }
    }

    /// The second of the two in words.
    fn other(&self) -> String {
        let [one, other] = &self.between;
        match self.cell {
            None | Some(HERE) => other.clone(),
            Some(cell) if one == other => format!("its image in the cell {cell:?}"),
            Some(cell) => format!("{other} in the cell {cell:?}"),
        }
    }
}

/// The meetings as text, those with the same laws under one verdict; there are `pairs` of them, and so many pairs feel
/// each other however far they are.
pub(super) fn write_meetings(text: &mut String, meetings: &[MeetingSurvey], pairs: usize, endless: usize) {
    let short = |value: f64| significant(value, 5);
    let mut told: Option<&MeetingSurvey> = None;
    for meeting in meetings.iter().take(MOST) {
        let (one, other) = (&meeting.between[0], meeting.other());
        let unknown = if meeting.reach.is_some() { "not felt at the start" } else { "gap not known at the start" };
        let gap =
            meeting.initial_gap.map_or_else(|| unknown.to_owned(), |gap| format!("gap {} m at the start", short(gap)));
        let reach = meeting.reach.map(|reach| format!(", felt within {} m", short(reach))).unwrap_or_default();
        let change = meeting.reach_change.map(|change| match change.is_finite() {
            true => {
                format!(", which makes the gap at which they turn back smaller by {} of it", significant(change, 2))
            }
            false => ", too near the gap at which they turn back".to_owned(),
        });
        let _ = writeln!(text, "meeting    {one} with {other}: {gap}{reach}{}", change.unwrap_or_default());
        if told.is_some_and(|told| told.laws == meeting.laws) {
            continue;
        }
        told = Some(meeting);
        for law in &meeting.laws {
            let _ = writeln!(text, "             {}", law.verdict());
        }
        if !meeting.forbids_touching {
            let _ = writeln!(
                text,
                "             no law forbids touching: bodies that are fast enough do, and the run stops"
            );
        }
    }
    let more = pairs - meetings.len().min(MOST);
    let listed = if meetings.len() < pairs { "some of those within reach at the start" } else { "all" };
    if more > 0 {
        let _ = writeln!(text, "           and {more} meetings more: {listed} with --json");
    }
    if endless > FEW_ENDLESS {
        let _ = writeln!(
            text,
            "           warning: {endless} pairs have no reach, or deform: an evaluation looks at all, a step makes \
             {EVALUATIONS} or more;\n             give the contact a `reach`, beyond which bodies do not feel each other"
        );
    }
}
