//! Springs between bodies.

use super::body::{AssembledBody, lever};
use super::lattice::{Cells, check_cell};
use super::partners::Names;
use super::start::placement;
use crate::check::{PartialScene, Placed, Reporter};
use crate::file;
use crate::quantity::si;
use gyration::lattice::{Cell, HERE};
use gyration::load::{Spring, SpringLaw};
use gyration::tensor::Vec3;

/// The most springs that one of the file stands for.
const MOST: usize = 1_000_000;

/// The springs between bodies, or between any two different ones of groups; notes those that start without a direction.
pub(super) fn springs(
    partial: &PartialScene,
    assembled: &[Option<AssembledBody>],
    cells: Option<&Cells>,
    reporter: &mut Reporter<'_>,
) -> Vec<Spring> {
    let names = Names::of(partial);
    let spring = |placed: &Placed<file::SpringBetween>| {
        let Placed { key, value, .. } = placed;
        let cell = value.cell.map_or(HERE, |cell| cell.map(|n| n.0 as i32));
        if cell != HERE && !check_cell(cell, cells, &key.key("cell"), reporter) {
            return Vec::new();
        }
        let away = cells.map_or_else(Vec3::zeros, |cells| cells.lattice.place(cell));
        let law = SpringLaw {
            stiffness: value.stiffness.value(),
            rest_length: value.rest_length.value(),
            damping: value.damping.value(),
        };
        let points: [Vec3; 2] = value.points.each_ref().map(si);
        let pairs = pairs(placed, &names, cell, reporter);
        for end in 0..2 {
            let is_point = |pair: &[usize; 2]| assembled[pair[end]].as_ref().is_some_and(|it| it.body.is_point());
            if pairs.iter().any(is_point) {
                lever(&points[end], &key.key("points").index(end), reporter);
            }
        }
        let mut is_told = !law.is_directed();
        let between = |bodies: [usize; 2]| {
            let [Some(one), Some(other)] = bodies.map(|body| assembled[body].as_ref()) else { return None };
            let [here, there] =
                [(one, points[0]), (other, points[1])].map(|(end, point)| placement(&end.start).place(&point));
            if !is_told && here == there + away {
                is_told = true;
                let [x, y, z] = here.into();
                let (first, second) = (&one.name, &other.name);
                let message = format!(
                    "the spring starts with no length and has no direction: both points, of \"{first}\" and of \
                     \"{second}\", are at [{x}, {y}, {z}]"
                );
                let help = "move a body or a point, or leave out `rest_length` and `damping`";
                reporter.note(&key.key("points"), message, help);
            }
            Some(Spring::between(bodies, points, law).across(cell))
        };
        pairs.into_iter().filter_map(between).collect()
    };
    partial.springs.iter().flat_map(spring).collect()
}

/// The bodies between which a spring of the file stands: any two different ones that its words name, each pair once; in
/// another cell of a lattice any two. Notes if there are none, or too many.
fn pairs(
    Placed { key, value, .. }: &Placed<file::SpringBetween>,
    names: &Names<'_>,
    cell: Cell,
    reporter: &mut Reporter<'_>,
) -> Vec<[usize; 2]> {
    let words = value.between.each_ref().map(String::as_str);
    let [Some(one), Some(other)] = words.map(|word| names.group(word)) else { return Vec::new() };
    let key = key.key("between");
    let is_in = |set: &[usize], body: usize| set.binary_search(&body).is_ok();
    // Of two that both words name the first comes first.
    let stands = |[a, b]: &[usize; 2]| a < b || (a != b && !(is_in(&one, *b) && is_in(&other, *a)));
    let all = one.iter().flat_map(|first| other.iter().map(|second| [*first, *second]));
    let pairs: Vec<[usize; 2]> = all.filter(|pair| cell != HERE || stands(pair)).take(MOST + 1).collect();
    if pairs.len() > MOST {
        let message = format!("{} bodies and {} have more than {MOST} springs", one.len(), other.len());
        reporter.note(&key, message, "name fewer, or let a `contact` with adhesion hold them together");
        return Vec::new();
    }
    // One body that is named twice by its own name has been noted.
    if pairs.is_empty() && (words[0] != words[1] || names.is_group(words[0])) {
        reporter.note(&key, "both name one body, and no pair", "name another body or group besides");
    }
    pairs
}
