//! Bodies that meet: what acts between each two, and whether they are apart at the start.

use super::body::AssembledBody;
use super::partners::{MOST_PAIRS, without_surface};
use super::start::placement;
use crate::check::Reporter;
use crate::key::Key;
use gyration::contact::{AreaMeasure, ContactLaw};
use gyration::kinematics::Placement;
use gyration::pair::{Overlap, Pair, PairLaws, PairLawsError};
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
            "give it a `repulsion` with alpha > 0, which places the plane",
        ),
        PairLawsError::TooWeak { exponent } => (
            key.key("repulsion").key("nu"),
            format!("{exponent:?} is less than 2, the least with which a plane stays off both bodies"),
            "write an exponent of 2 or more",
        ),
        PairLawsError::Missing { kind } => (
            key.key(kind.name()),
            format!("this version has no {} between bodies", kind.name()),
            "leave it out, or give it to contacts with supports",
        ),
        PairLawsError::Measure => (
            key.key("measure"),
            "this version has no such measure between bodies".to_owned(),
            "write \"deformed_area\" or \"reference_area\"",
        ),
    };
    reporter.note(&key, message, help);
    None
}

/// Adds a pair of each part of one body and of the other, which can meet; notes those that reach each other at the
/// start.
pub(super) fn meet<'a>(
    bodies: impl Iterator<Item = ([usize; 2], [Option<&'a AssembledBody>; 2])>,
    (laws, reach): (&Arc<PairLaws>, Option<f64>),
    key: &Key,
    pairs: &mut Vec<Pair>,
    reporter: &mut Reporter<'_>,
) {
    let between = key.key("between");
    for (indices, both) in bodies {
        let [Some(one), Some(other)] = both else { continue };
        if reporter.diagnostics.is_full() {
            return;
        }
        let counts = [one, other].map(|assembled| assembled.body.solid.count_parts());
        for parts in (0..counts[0]).flat_map(|first| (0..counts[1]).map(move |second| [first, second])) {
            let solids = [&one.body.solid, &other.body.solid];
            let surfaces = [0, 1].map(|i| solids[i].part(parts[i]));
            let radii = [0, 1].map(|i| solids[i].part_radius(parts[i]));
            let pair = Pair::of_radii(indices, parts, Arc::clone(laws), reach, surfaces, radii);
            let placements = [one, other].map(|assembled| placement(&assembled.start));
            let apart = are_far(&placements, radii);
            if !apart && let Err(overlap) = Overlap::check(surfaces, placements.each_ref()) {
                overlapping([one, other], &overlap, &between, reporter);
                break;
            }
            if !pair.has_range() {
                let help = "write a distance nearer to the gaps at which bodies turn back";
                reporter.note(&key.key("reach"), "the energy at this distance leaves the range of numbers", help);
                return;
            }
            pairs.push(pair);
            if pairs.len() > MOST_PAIRS {
                let message = format!("with this contact there are more than {MOST_PAIRS} pairs of parts of unions");
                reporter.note(&between, message, "give each contact the bodies that it is for, or unions fewer parts");
                return;
            }
        }
    }
}

/// Whether two bodies are farther apart than balls about them that hold them reach: |P X| ≤ √‖PᵀP‖_∞ |X|.
fn are_far(placements: &[Placement; 2], radii: [f64; 2]) -> bool {
    let reach = |i: usize| {
        let square = placements[i].gradient.tr_mul(&placements[i].gradient);
        let sums = square.row_iter().map(|row| row.iter().map(|entry| entry.abs()).sum::<f64>());
        sums.fold(0.0, f64::max).sqrt() * radii[i]
    };
    let apart = placements[0].position - placements[1].position;
    apart.norm() > FARTHER * (reach(0) + reach(1))
}

/// What rounding leaves of a comparison of distances.
const FARTHER: f64 = 1.0 + 1e-12;

/// Whether a body can meet others; notes why not.
pub(super) fn can_meet(assembled: &AssembledBody, key: &Key, reporter: &mut Reporter<'_>) -> bool {
    let name = &assembled.body.name;
    if assembled.body.solid.surface.is_none() {
        without_surface(assembled, key, reporter);
        return false;
    }
    if let Err(why) = assembled.body.solid.shape.check_convex() {
        let message = format!("\"{name}\" cannot meet other bodies: {why}");
        reporter.note(key, message, "make its shape a union of convex ones: a plane stands between convex bodies");
        return false;
    }
    if !assembled.body.has_inertia() {
        let message = format!("\"{name}\" has no inertia: this version has no meeting of such bodies");
        reporter.note(key, message, "give the body `inclusion = { inertia = true }`");
        return false;
    }
    true
}

fn overlapping(both: [&AssembledBody; 2], overlap: &Overlap, key: &Key, reporter: &mut Reporter<'_>) {
    let [one, other] = both.map(|assembled| &assembled.body.name);
    let [x, y, z] = overlap.normal.into();
    let way = format!("along [{x:.6}, {y:.6}, {z:.6}]");
    let (message, by) = match overlap.touches() {
        true => ("touch at the start, and no force holds at a gap of 0".to_owned(), "a little".to_owned()),
        false => {
            let depth = format!("{:.6e} m", overlap.depth);
            (format!("reach each other at the start, by {depth}"), format!("by more than {depth}"))
        }
    };
    reporter.note(key, format!("\"{one}\" and \"{other}\" {message}"), format!("move \"{one}\" {by} {way}"));
}
