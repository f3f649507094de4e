//! Pairs of bodies across the cells of a lattice.
//!
//! Of a lattice with free ends no pair is left out unless its rule has a reach. In a direction that repeats without end
//! images count as far as two of the longest cell vector, if there is no reach.

use super::body::AssembledBody;
use super::lattice::Cells;
use super::pair::overlap_in_words;
use super::start::placement;
use crate::check::Reporter;
use crate::key::Key;
use gyration::body::Solid;
use gyration::kinematics::Placement;
use gyration::lattice::{Cell, HERE};
use gyration::neighbours::{BodyPair, Extent, ImagePair, ImagePairs, PairRule};
use gyration::tensor::Vec3;

/// Without a reach, and with a direction that repeats, images count that are no farther away than so many times the
/// longest cell vector.
pub const ENDLESS_CELLS: f64 = 2.0;

/// The bodies of a cell that meet, and the cell of the second.
#[derive(Debug, Clone, Copy)]
struct Met {
    bodies: [usize; 2],
    cell: Cell,
}

/// Where the bodies of a cell are, and how far they extend.
struct Extents<'a> {
    bodies: &'a [AssembledBody],
    placements: Vec<Placement>,
    /// [m].
    radii: Vec<f64>,
}

/// The pairs of all cells by the rules of one, each of which is written at a key; notes bodies that overlap an image.
///
/// Listed are those that come within reach while no body strays from its start, beside the first one, and grows by more
/// than half the shortest cell vector.
pub(super) fn images(
    cells: &Cells,
    (rules, keys): (&[PairRule], &[Key]),
    bodies: &[AssembledBody],
    reporter: &mut Reporter<'_>,
) -> Option<ImagePairs> {
    if rules.is_empty() {
        return None;
    }
    let lengths = || cells.lattice.vectors().iter().map(Vec3::norm);
    let stray = 0.5 * lengths().fold(f64::INFINITY, f64::min);
    let extents = Extents::of(bodies);
    let places: Vec<Cell> = cells.all().collect();
    let mut all = Vec::new();
    for (number, rule) in rules.iter().enumerate() {
        let range = match rule.reach {
            Some(reach) => reach.longest() + 2.0 * stray,
            None if cells.end_everywhere() => f64::INFINITY,
            None => ENDLESS_CELLS * lengths().fold(0.0, f64::max),
        };
        for Met { bodies, cell } in extents.met(cells, rule, range) {
            extents.check(Met { bodies, cell }, &cells.lattice.place(cell), &keys[number], reporter);
            all.extend(places.iter().enumerate().filter_map(|(place, at)| {
                let beside = cells.beside(*at, cell)?;
                let bodies = [cells.index(bodies[0], place), cells.index(bodies[1], beside)];
                Some(ImagePair { pair: BodyPair { rule: number, bodies }, cell })
            }));
        }
    }
    let starts = extents.placements.iter().zip(&extents.radii);
    let starts = starts.flat_map(|(at, radius)| vec![Extent { place: at.position, radius: *radius }; cells.count()]);
    Some(ImagePairs::new(all, starts.collect(), stray))
}

impl<'a> Extents<'a> {
    fn of(bodies: &'a [AssembledBody]) -> Self {
        let placements: Vec<Placement> = bodies.iter().map(|body| placement(&body.start)).collect();
        let radii = bodies.iter().zip(&placements).map(|(body, place)| body.body.radius_at(place)).collect();
        Self { bodies, placements, radii }
    }

    /// The pairs of a cell and its images whose spheres are within a range [m], each once.
    fn met(&self, cells: &Cells, rule: &PairRule, range: f64) -> Vec<Met> {
        let [first, second] = &rule.bodies;
        let mut met = Vec::new();
        for (one, other) in first.iter().flat_map(|one| second.iter().map(move |other| (*one, *other))) {
            let between = self.placements[other].position - self.placements[one].position;
            let reached = range + self.radii[one] + self.radii[other];
            for cell in cells.offsets(reached + between.norm()) {
                let is_near = (between + cells.lattice.place(cell)).norm() <= reached;
                // Of (i, j, n) and (j, i, −n) one counts; where both are in both sets, the first.
                let is_twice = first.binary_search(&other).is_ok() && second.binary_search(&one).is_ok();
                let counts = if one == other { cell > HERE } else { !is_twice || one < other };
                if is_near && counts {
                    met.push(Met { bodies: [one, other], cell });
                }
            }
        }
        met
    }

    /// Notes bodies that reach each other at the start.
    fn check(&self, Met { bodies, cell }: Met, shift: &Vec3, key: &Key, reporter: &mut Reporter<'_>) {
        let [one, other] = bodies.map(|body| &self.bodies[body]);
        let [first, mut second] = bodies.map(|body| self.placements[body]);
        second.position += shift;
        // Bodies of one cell are looked at without a lattice too.
        if cell == HERE {
            return;
        }
        if let Some(overlap) = Solid::overlap([&one.body.solid, &other.body.solid], [&first, &second]) {
            let (message, [by, way]) = overlap_in_words(&overlap);
            let [one, other] = [one, other].map(|assembled| &assembled.name);
            let message = format!("\"{one}\" and the image of \"{other}\" in the cell {cell:?} {message}");
            let fix = match one == other {
                true => format!("lengthen the cell vectors, or make \"{one}\" smaller"),
                false => format!("move \"{one}\" {by} {way}, or lengthen the cell vectors"),
            };
            reporter.note(&key.key("between"), message, fix);
        }
    }
}
