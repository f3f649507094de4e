//! What a reach changes of a pair: the gap at which the two come to rest or turn back.

use gyration::Party;
use gyration::body::Solid;
use gyration::model::Model;
use gyration::neighbours::Pair;
use gyration::pair::{Falling, Mass, Reach};
use gyration::state::State;
use gyration::tensor::Vec3;

/// A larger part than that is no small change, which the formula is for.
const SMALL: f64 = 0.1;

/// What a reach changes of a pair.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ReachChange {
    /// The gap at which the two come to rest or turn back without it [m].
    pub gap: f64,
    /// By what part of itself that is smaller with it; infinite where that is no small part.
    pub part: f64,
}

impl ReachChange {
    /// Of two bodies that gravity and their relative speed at the start bring together; of two that do not move apart
    /// or together, the speed by which a reach was found. None without a reach, and where nothing brings them together.
    pub fn of(model: &Model, start: &State, pair: &Pair) -> Option<Self> {
        let velocity = |party: Party| match party {
            Party::Body(body) => start.motion(model, body).velocity.velocity,
            Party::SolidSupport(support) => model.solid_supports[support].at(start.time).velocity.velocity,
            Party::Support(_) | Party::Space => Vec3::zeros(),
        };
        let own = (velocity(pair.parties[0]) - velocity(pair.parties[1])).norm();
        let speed = match model.rules().all()[pair.rule].reach? {
            Reach::Gaps { falling, .. } if own == 0.0 => falling.speed,
            Reach::Gaps { .. } | Reach::Length(_) => own,
        };
        let falling = Falling { gravity: model.gravity.norm(), speed };
        let solids = solids(model, pair);
        let surfaces = [0, 1].map(|end| solids[end].part(pair.parts[end]));
        let masses = [0, 1].map(|end| Mass { surface: surfaces[end], mass: solids[end].mass.mass });
        let gap = falling.acts().then(|| falling.contact_gap(&pair.form.laws, masses))?;
        let part = pair.form.change_of_gap(gap, surfaces)?;
        Some(Self { gap, part: if part < SMALL { part } else { f64::INFINITY } })
    }
}

/// The solids of the two of a pair.
pub(super) fn solids<'a>(model: &'a Model, pair: &Pair) -> [&'a Solid; 2] {
    pair.parties.map(|party| model.solid_of(party).unwrap_or_else(|| unreachable!("a pair is between solids")))
}
