//! The cells of a lattice: what one cell holds becomes what all cells of a run hold, or those that bands are of.

use super::absorb::{Absorbers, AbsorbingEnds};
use super::body::AssembledBody;
use super::start::placement;
use super::unit::Unit;
use crate::check::Reporter;
use crate::file::{self, Relaxed};
use crate::key::Key;
use crate::quantity::si;
use gyration::contact::Contact;
use gyration::fluid::Fluid;
use gyration::lattice::{Cell, Lattice};
use gyration::load::{Attachment, Bond, Spring};
use gyration::neighbours::PairRule;
use gyration::support::Support;
use gyration::tensor::{Mat3, Vec3};

/// Components below this part of the largest are rounding.
const ROUNDING: f64 = 1e-12;

/// The most cells of a run.
const MOST_CELLS: u64 = 1_000_000;

/// A block of cells.
#[derive(Debug, Clone)]
pub(super) struct Cells {
    pub lattice: Lattice,
    /// How many there are along each vector.
    repeat: [u32; 3],
    /// Whether the last is beside the first.
    periodic: [bool; 3],
    /// What swallows waves at free ends.
    absorbing: Option<AbsorbingEnds>,
    /// Whether granules seek their rest.
    pub relaxes: bool,
    /// Under which load cell vectors seek theirs too.
    pub load: Option<CellLoad>,
}

/// What loads a cell whose vectors are at rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CellLoad {
    /// A nominal stress S̄ [Pa; of a sheet N/m, of a chain N].
    Stress(Mat3),
    /// A pressure, in the same unit.
    Pressure(f64),
}

/// The load under which cell vectors rest; notes one that has no meaning.
fn load(written: &file::Lattice, lattice: &Lattice, key: &Key, reporter: &mut Reporter<'_>) -> Option<CellLoad> {
    let rests = written.relax.contains(&Relaxed::Cell);
    let given = [("stress", written.stress.is_some()), ("pressure", written.pressure.is_some())];
    if let (Some((name, _)), false) = (given.into_iter().find(|(_, is_given)| *is_given), rests) {
        let message = "the cell vectors stay as they are written, under whatever stress that takes";
        reporter.note(&key.key(name), message, "leave it out, or write relax = [\"cell\"]");
        return None;
    }
    let (owner, unit) = match lattice.vectors().len() {
        1 => ("chain", Unit::FORCE),
        2 => ("sheet", Unit::FORCE_PER_LENGTH),
        _ => ("solid", Unit::PRESSURE),
    };
    if ["stress", "pressure"].iter().filter(|name| !unit.is_of_all(&key.key(name), owner, reporter)).count() > 0 {
        return None;
    }
    match (written.stress, written.pressure) {
        (Some(_), Some(_)) => {
            reporter.note(&key.key("pressure"), "the stress is given too", "leave one of them out");
            None
        }
        (_, Some(pressure)) => Some(CellLoad::Pressure(pressure.0)),
        (stress, None) => {
            let stress = Mat3::from_fn(|i, j| stress.map_or(0.0, |stress| stress[i][j].0));
            if (stress - stress.transpose()).amax() > ROUNDING * stress.amax() {
                let message = "the stress is not symmetric, and the cell does not turn under it";
                reporter.note(&key.key("stress"), message, "write the same across the diagonal");
                return None;
            }
            let stress = 0.5 * (stress + stress.transpose());
            let within = lattice.projector();
            if (within * stress * within - stress).amax() > ROUNDING * stress.amax() {
                let message = "the stress has components across the cell vectors, along which there is no cell";
                reporter.note(&key.key("stress"), message, "write one in the space that they span");
            }
            rests.then_some(CellLoad::Stress(stress))
        }
    }
}

impl Cells {
    /// Those of a run; notes what is wrong with them.
    pub fn of(written: &file::Lattice, reporter: &mut Reporter<'_>) -> Option<Self> {
        let key = Key::root().key("lattice");
        let vectors: Vec<Vec3> = written.cell.iter().map(si).collect();
        let count = vectors.len();
        let lattice = match Lattice::new(vectors) {
            Ok(lattice) => lattice,
            Err(error) => {
                let help = "write vectors that span as many dimensions as there are of them";
                reporter.note(&key.key("cell"), error.to_string(), help);
                return None;
            }
        };
        let listed = written.periodic.as_slice();
        let periodic = match written.periodic {
            file::OneOrMany::One(all) => [all; 3],
            file::OneOrMany::Many(_) if listed.len() == count => {
                std::array::from_fn(|a| listed.get(a).copied().unwrap_or(true))
            }
            file::OneOrMany::Many(_) => {
                let message = format!("there are {} entries for {count} cell vectors", listed.len());
                reporter.note(&key.key("periodic"), message, "write true, false, or one of them for each vector");
                return None;
            }
        };
        let repeat = written.repeat.map(|count| count.0 as u32);
        for (a, cells) in repeat.iter().enumerate().skip(count) {
            if *cells != 1 {
                let message = format!("there is no cell vector {}, along which cells could be repeated", a + 1);
                reporter.note(&key.key("repeat").index(a), message, "write 1");
                return None;
            }
        }
        if repeat.iter().map(|count| u64::from(*count)).product::<u64>() > MOST_CELLS {
            reporter.note(&key.key("repeat"), format!("there are more than {MOST_CELLS} cells"), "repeat fewer");
            return None;
        }
        let relaxes = !written.relax.is_empty();
        let load = load(written, &lattice, &key, reporter);
        let directions: [Option<u32>; 3] =
            std::array::from_fn(|a| (a < count && !periodic[a] && repeat[a] > 1).then_some(repeat[a]));
        let absorb = written.absorb.as_ref();
        let absorbing = absorb.and_then(|written| AbsorbingEnds::of(written, directions, &key, reporter));
        Some(Self { lattice, repeat, periodic, absorbing, relaxes, load })
    }

    /// Those of which bands are: one along what is periodic.
    pub fn unit(&self) -> Self {
        let repeat = std::array::from_fn(|a| if self.periodic[a] { 1 } else { self.repeat[a] });
        Self { repeat, ..self.clone() }
    }

    /// Those of which the waves of a start are: one along directions in which the lattice has no ends, and none that
    /// absorbs them.
    pub fn endless(&self, endless: [bool; 3]) -> Self {
        let repeat = std::array::from_fn(|a| if endless[a] { 1 } else { self.repeat[a] });
        Self { repeat, periodic: endless, absorbing: None, ..self.clone() }
    }

    /// How many there are along each vector.
    pub fn repeat(&self) -> [u32; 3] {
        self.repeat
    }

    /// Whether the last is beside the first.
    pub fn ring(&self) -> [bool; 3] {
        self.periodic
    }

    /// The directions that are periodic.
    pub fn periodic(&self) -> Vec<bool> {
        self.periodic[..self.lattice.vectors().len()].to_vec()
    }

    /// How many cells there are.
    pub fn count(&self) -> usize {
        self.repeat.iter().map(|count| *count as usize).product()
    }

    /// All of them, the first direction fastest.
    pub fn all(&self) -> impl Iterator<Item = Cell> + use<> {
        let [x, y, z] = self.repeat.map(|count| count as i32);
        (0..z).flat_map(move |c| (0..y).flat_map(move |b| (0..x).map(move |a| [a, b, c])))
    }

    /// The number of the cell that another sees in a direction; none beyond a free end.
    pub fn beside(&self, cell: Cell, offset: Cell) -> Option<usize> {
        let mut number = 0;
        for a in (0..3).rev() {
            let (count, at) = (self.repeat[a] as i32, cell[a].checked_add(offset[a])?);
            let within = if self.periodic[a] { at.rem_euclid(count) } else { at };
            if !(0..count).contains(&within) {
                return None;
            }
            number = number * count as usize + within as usize;
        }
        Some(number)
    }

    /// The index of a body in a cell of this number: the copies of each body follow one another.
    pub fn index(&self, body: usize, cell: usize) -> usize {
        body * self.count() + cell
    }

    /// Whether it ends in all its directions.
    pub fn end_everywhere(&self) -> bool {
        self.periodic[..self.lattice.vectors().len()].iter().all(|periodic| !periodic)
    }

    /// The offsets to cells of which there may be bodies within a distance of one another [m], and that lead somewhere.
    pub fn offsets(&self, range: f64) -> Vec<Cell> {
        let reciprocal = self.lattice.reciprocal();
        // Cells lie in planes 2π/|b_a| apart.
        let most: [i32; 3] = std::array::from_fn(|a| {
            let planes = reciprocal.get(a).map_or(0.0, |vector| range * vector.norm() / std::f64::consts::TAU);
            let far = planes.ceil().min(f64::from(i32::MAX / 2)) as i32 + 1;
            let within = if self.periodic[a] { far } else { far.min(self.repeat[a] as i32 - 1) };
            if a < reciprocal.len() { within } else { 0 }
        });
        let [x, y, z] = most;
        let along = |most: i32| -most..=most;
        along(z).flat_map(|c| along(y).flat_map(move |b| along(x).map(move |a| [a, b, c]))).collect()
    }

    /// The bodies of all cells; those of one cell keep their names.
    pub fn bodies(&self, of_cell: &[AssembledBody]) -> Vec<AssembledBody> {
        let count = self.count();
        let absorption: Vec<f64> = match &self.absorbing {
            None => vec![0.0; count],
            Some(ends) => self.all().map(|cell| ends.rate(cell)).collect(),
        };
        let mut copies = Vec::with_capacity(of_cell.len() * count);
        for body in of_cell {
            let mut absorbing = Absorbers::default();
            copies.extend(absorption.iter().enumerate().map(|(cell, rate)| {
                let mut copy = body.clone();
                copy.body = absorbing.of(&body.body, *rate);
                if count > 1 {
                    copy.name = format!("{}-{cell}", body.name);
                }
                copy
            }));
        }
        copies
    }

    /// Where the cells of all bodies are [m].
    pub fn origins(&self, bodies: usize) -> Vec<Vec3> {
        let places: Vec<Vec3> = self.all().map(|cell| self.lattice.place(cell)).collect();
        (0..bodies).flat_map(|_| places.clone()).collect()
    }

    /// The contacts of all cells with supports.
    pub fn contacts(&self, of_cell: &[Contact]) -> Vec<Contact> {
        let copies = of_cell.iter().flat_map(|contact| {
            (0..self.count()).map(|cell| Contact { body: self.index(contact.body, cell), ..contact.clone() })
        });
        copies.collect()
    }

    /// The rules of all cells.
    pub fn rules(&self, of_cell: &[PairRule]) -> Vec<PairRule> {
        let set = |bodies: &std::sync::Arc<[usize]>| {
            bodies.iter().flat_map(|body| (0..self.count()).map(|cell| self.index(*body, cell))).collect()
        };
        let of_all = |rule: &PairRule| PairRule { bodies: rule.bodies.each_ref().map(set), ..rule.clone() };
        of_cell.iter().map(of_all).collect()
    }

    /// The springs of all cells; those that lead beyond a free end are left out.
    pub fn springs(&self, of_cell: &[Spring]) -> Vec<Spring> {
        let cells: Vec<Cell> = self.all().collect();
        let copies = of_cell.iter().flat_map(|spring| {
            cells.iter().enumerate().filter_map(|(number, cell)| {
                let places = [Some(number), self.beside(*cell, spring.cell)];
                let mut ends = spring.ends.clone();
                for (end, place) in ends.iter_mut().zip(places) {
                    if let Attachment::Body { index, .. } = end {
                        *index = self.index(*index, place?);
                    }
                }
                Some(Spring { ends, ..spring.clone() })
            })
        });
        copies.collect()
    }

    /// The bonds of all cells; those that lead beyond a free end are left out.
    pub fn bonds(&self, of_cell: &[Bond]) -> Vec<Bond> {
        let cells: Vec<Cell> = self.all().collect();
        let copies = of_cell.iter().flat_map(|bond| {
            cells.iter().enumerate().filter_map(|(number, cell)| {
                let places = [number, self.beside(*cell, bond.cell)?];
                let bodies = [0, 1].map(|end| self.index(bond.bodies[end], places[end]));
                Some(Bond { bodies, ..bond.clone() })
            })
        });
        copies.collect()
    }

    /// Notes what does not look alike from every cell.
    pub fn check_alike(
        &self,
        supports: &[Support],
        contacts: &[Contact],
        fluid: Option<&Fluid>,
        bodies: &[Option<AssembledBody>],
        reporter: &mut Reporter<'_>,
    ) {
        for (a, vector) in self.lattice.vectors().iter().enumerate() {
            if self.repeat[a] == 1 && !self.periodic[a] {
                continue;
            }
            let number = a + 1;
            for (index, support) in supports.iter().enumerate() {
                let is_met = contacts.iter().any(|contact| contact.support == index);
                if is_met && support.normal.dot(vector).abs() > ALIKE * vector.norm() {
                    let message = format!("cell vector {number} leads off this support: cells do not see it alike");
                    let key = Key::root().key("support").index(index).key("plane");
                    reporter.note(&key, message, "turn its normal across all cell vectors");
                }
                if is_met && support.motion.turns() {
                    let message = format!("what turns moves otherwise along cell vector {number}");
                    let key = Key::root().key("support").index(index).key("motion");
                    reporter.note(&key, message, "leave out `rotate`, or the lattice");
                }
            }
            for (index, body) in bodies.iter().enumerate() {
                let Some(body) = body else { continue };
                let center = placement(&body.start).position;
                let beside = [[0.0, 0.0, 0.0], [0.31, 0.17, -0.23], [-0.19, 0.37, 0.29], [0.11, -0.41, 0.13]];
                let points = beside.map(|[x, y, z]| center + body.body.size * Vec3::new(x, y, z));
                let own = Key::root().key("body").index(index);
                let of_volume = body.body.own.body_force.iter().map(|force| (force.field(), own.key("body_force")));
                let at_points = body.body.own.point_forces.iter().enumerate();
                let at_points = at_points.map(|(k, force)| (&force.field, own.key("force").index(k).key("value")));
                for (_, key) in of_volume.chain(at_points).filter(|(field, _)| !field.is_alike(&points, vector)) {
                    let message = format!("the force changes along cell vector {number}: cells do not see it alike");
                    let help = "let it repeat with the cell, or write a `potential`: its x, y, z are those of the \
                                body's own cell";
                    reporter.note(&key, message, help);
                }
            }
            if let Some(fluid) = fluid {
                let [_, gradient] = fluid.signals();
                let differs = |time: f64| (gradient.at(time) * vector).norm() > 0.0;
                if [0.0, 0.37, 1.7].into_iter().any(differs) {
                    let message = format!("the flow changes along cell vector {number}: cells do not see it alike");
                    let key = Key::root().key("fluid").key("velocity_gradient");
                    reporter.note(&key, message, "leave it out, or let it be zero along the cell vectors");
                }
            }
        }
    }
}

/// The cosine between a cell vector and a plane's normal that is rounding.
const ALIKE: f64 = 1e-12;

/// Notes a gravity that nothing holds up.
pub(super) fn check_held(gravity: &Vec3, contacts: &[Contact], bodies: &[AssembledBody], reporter: &mut Reporter<'_>) {
    let is_held = |body: &AssembledBody| {
        body.body.pin.is_some() || body.body.own.hold() || !body.springs.is_empty() || body.body.inclusion.is_some()
    };
    if gravity.norm() > 0.0 && contacts.is_empty() && !bodies.iter().any(is_held) {
        let message = "gravity pulls at every cell, and nothing holds them: no support, pin or spring to space";
        reporter.note(&Key::root().key("world").key("gravity"), message, "write gravity = [0, 0, 0]");
    }
}

/// Whether a cell is one of a lattice; notes why not.
pub(super) fn check_cell(cell: Cell, lattice: Option<&Cells>, key: &Key, reporter: &mut Reporter<'_>) -> bool {
    let Some(cells) = lattice else {
        // One with an error still counts.
        if reporter.document.root.get("lattice").is_some() {
            return false;
        }
        reporter.note(key, "there are no other cells: the scene has no `[lattice]`", "leave it out, or add a lattice");
        return false;
    };
    let count = cells.lattice.vectors().len();
    match (count..3).find(|a| cell[*a] != 0) {
        Some(beyond) => {
            let message = format!("the lattice has {count} cell vectors");
            reporter.note(&key.index(beyond), message, "write 0");
            false
        }
        None => true,
    }
}
