//! The first gaps: a body must not touch a support that it is in contact with.

use super::body::AssembledBody;
use super::start::placement;
use crate::check::{Placed, Reporter};
use crate::file::Body;
use gyration::support::Support;
use gyration::surface::GapField;
use std::collections::BTreeSet;

/// Whether a body is clear at t = 0 of the supports with which it has contacts; notes each that it reaches, with the
/// lift that it needs.
pub(super) fn check(
    placed: &Placed<Body>,
    assembled: &AssembledBody,
    met: &BTreeSet<usize>,
    supports: &[Option<Support>],
    reporter: &mut Reporter<'_>,
) -> bool {
    let Some(surface) = &assembled.body.solid.surface else { return true };
    let mut is_clear = true;
    let start = placement(&assembled.start);
    for support in met.iter().filter_map(|index| supports.get(*index)?.as_ref()) {
        let field = GapField::new(support.gap(&start.position, 0.0), start.gradient.tr_mul(&support.normal));
        let (gap, _) = surface.smallest_gap(&field);
        if assembled.body.is_apart(gap, &field) {
            continue;
        }
        let (body, name) = (&assembled.name, &support.name);
        let [x, y, z] = support.normal.into();
        let (message, lift) = if gap < -TOUCH * assembled.body.size {
            let reaches = format!("reaches the support \"{name}\" at the start: its smallest gap is {gap:.6e} m");
            (reaches, format!("by more than {:.6e} m ", -gap))
        } else {
            (format!("touches the support \"{name}\" at the start"), "a little ".to_owned())
        };
        let help = format!("move it {lift}along the normal [{x}, {y}, {z}]: forces of short range keep bodies apart");
        reporter.note(&placed.key.key("position"), format!("\"{body}\" {message}"), help);
        is_clear = false;
    }
    is_clear
}

/// A depth that cannot be told from none, in sizes of the body.
const TOUCH: f64 = 64.0 * f64::EPSILON;
