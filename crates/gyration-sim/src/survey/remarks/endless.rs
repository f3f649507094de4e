//! Contacts across the cells of a lattice that repeats without end, and have no reach: images count as far as two of
//! the longest cell vector, and what is farther is left out.
//!
//! What it would push with, over the nearest: about (g/D)^(ν − 1), g the smallest gap at the start and D the distance
//! at which images end.

use crate::format::significant;
use gyration::contact::{Action, Term};
use gyration::dynamics::Workspace;
use gyration::model::Model;
use gyration::neighbours::ImagePairs;
use gyration::pair::PairLaws;
use gyration::state::State;
use gyration::tensor::Vec3;
use gyration_scene::ENDLESS_CELLS;

/// What must be told of contacts whose images matter farther than they count, to be run with this relative tolerance.
pub(crate) fn warning(model: &Model, start: &State, rtol: f64) -> Option<String> {
    model.images().filter(|images| repeats(model, images))?;
    let range = ENDLESS_CELLS * model.lattice.vectors().iter().map(Vec3::norm).fold(0.0, f64::max);
    let mut workspace = Workspace::default();
    let gaps = workspace.pair_gaps(model, start.time, start.numbers()).ok()?;
    let endless = gaps.iter().filter(|(pair, _)| pair.form.reach.is_none() && pair.bodies().is_some());
    let (pair, slab) = endless.min_by(|(_, one), (_, other)| one.gap.total_cmp(&other.gap))?;
    let most = libm::pow(slab.gap / range, slowest(&pair.form.laws) - 1.0);
    (most > rtol).then(|| {
        format!(
            "contacts between bodies have no `reach`, and images of the lattice farther than {} m are left out: they \
             may push with about {} of the nearest; give the contacts a `reach`, within which every image counts",
            significant(range, 3),
            significant(most, 1)
        )
    })
}

/// Whether an image leads round a ring, or out of the cell that stands for all: where cells end none does.
fn repeats(model: &Model, images: &ImagePairs) -> bool {
    let origin = |body: usize| model.in_space(body, &Vec3::zeros());
    let least = model.lattice.vectors().iter().map(Vec3::norm).fold(f64::INFINITY, f64::min);
    images.all().iter().any(|image| {
        let [one, other] = image.pair.bodies;
        (origin(other) - origin(one) - model.lattice.place(image.cell)).norm() > 0.5 * least
    })
}

/// The exponent of the force along the normal that falls off most slowly.
fn slowest(laws: &PairLaws) -> f64 {
    let acts = |term: &Term| term.action == Action::Central && term.coefficient != 0.0;
    let terms = laws.laws().iter().flat_map(|law| law.terms()).flatten().filter(acts);
    terms.map(|term| term.exponent).fold(f64::INFINITY, f64::min)
}
