//! Arrays that the page shows and few recordings hold: computed from the model and the states of a recording, as if
//! they had been recorded.

use crate::error::ViewError;
use gyration::dynamics::ContactParts;
use gyration_page::besides::{deforms, has_network, has_parts};
use gyration_page::blob;
use gyration_page::header::{ArrayEntry, Header};
use gyration_record::Recording;
use gyration_sim::replay::Replay;
use serde_json::Value;
use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Bodies times samples for which forces are computed at most: some seconds.
pub(crate) const MOST_PARTS: usize = 100_000;

/// An array that is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Shown {
    Stress,
    Normal,
    Tangential,
    OfBodies,
}

/// The parts of the contact force.
const PARTS: [Shown; 3] = [Shown::Normal, Shown::Tangential, Shown::OfBodies];

impl Shown {
    fn name(self) -> &'static str {
        match self {
            Self::Stress => "cauchy_stress",
            Self::Normal => "normal_force",
            Self::Tangential => "tangential_force",
            Self::OfBodies => "pair_force",
        }
    }

    /// The array of so many bodies.
    fn entry(self, bodies: usize) -> ArrayEntry {
        let (units, description, inner): (_, _, &[&str]) = match self {
            Self::Stress => ("Pa", "Cauchy stress S P^T/det P; NaN for a rigid body", &["row", "col"]),
            Self::Normal => ("N", "contact forces along the normals of their contacts, summed", &[]),
            Self::Tangential => ("N", "magnitudes of the contact forces across the normals, summed", &[]),
            Self::OfBodies => ("N", "force of all other bodies that it meets", &["row"]),
        };
        let dims = std::iter::once(("body".to_owned(), bodies)).chain(inner.iter().map(|dim| ((*dim).to_owned(), 3)));
        ArrayEntry {
            name: self.name().to_owned(),
            units: units.to_owned(),
            description: format!("{description}, computed from the recording"),
            dims: dims.collect(),
        }
    }
}

/// What a header tells of each of some things.
pub(crate) fn described<'a>(header: &'a Header, name: &str) -> &'a [Value] {
    header.attributes.get(name).and_then(Value::as_array).map_or(&[], Vec::as_slice)
}

/// Arrays of a recording that are computed.
#[derive(Debug, Clone)]
pub(crate) struct Computed {
    shown: Vec<Shown>,
    has_network: bool,
    memory: Arc<Mutex<Memory>>,
}

#[derive(Debug)]
struct Memory {
    replay: Replay,
    /// Forces that were computed already, by row: they are asked for array by array.
    parts: HashMap<usize, Vec<ContactParts>>,
}

impl Computed {
    /// Adds to the header what can be computed of a recording, or a note why it cannot be had; none if there is nothing
    /// to compute.
    pub fn offer(recording: &Recording, header: &mut Header) -> Option<Self> {
        let lacks = |header: &Header, shown: Shown| header.arrays.iter().all(|array| array.name != shown.name());
        // A model is built again only where something may be wanted of it.
        let is_alone = described(header, "bodies").len() < 2;
        if is_alone && ![Shown::Stress, Shown::Normal].into_iter().any(|shown| lacks(header, shown)) {
            return None;
        }
        let replay = match Replay::open(recording) {
            Ok(replay) => replay,
            Err(problem) => {
                header.notes.push(format!("Stresses and the parts of contact forces are not shown: {problem}"));
                return None;
            }
        };
        let model = replay.model();
        let mut shown = Vec::new();
        if deforms(model) && lacks(header, Shown::Stress) {
            shown.push(Shown::Stress);
        }
        if has_parts(model) && PARTS.into_iter().all(|part| lacks(header, part)) {
            if model.bodies.len() * header.rows <= MOST_PARTS {
                shown.extend(PARTS);
            } else {
                let words = "The recording is long: what of contact forces is normal and what tangential is shown \
                             where it is recorded, by record = { quantities = [\"normal_force\", \"tangential_force\", \
                             \"pair_force\"] } in the scene.";
                header.notes.push(words.to_owned());
            }
        }
        header.arrays.extend(shown.iter().map(|shown| shown.entry(model.bodies.len())));
        header.network = has_network(model);
        let memory = Arc::new(Mutex::new(Memory { replay, parts: HashMap::new() }));
        let has_network = header.network;
        (!shown.is_empty() || has_network).then_some(Self { shown, has_network, memory })
    }

    /// The bytes of rows of an array; none if it is not one of these.
    pub fn blob(&self, name: &str, rows: impl Iterator<Item = usize>) -> Option<Result<Vec<u8>, ViewError>> {
        if name == "network" {
            return self.has_network.then(|| self.network(rows));
        }
        let shown = *self.shown.iter().find(|shown| shown.name() == name)?;
        let mut memory = self.memory();
        let mut bytes = Vec::new();
        for row in rows {
            match memory.numbers(shown, row) {
                Ok(numbers) => bytes.extend(blob::singles(&numbers)),
                Err(problem) => return Some(Err(problem)),
            }
        }
        Some(Ok(bytes))
    }

    fn network(&self, mut rows: impl Iterator<Item = usize>) -> Result<Vec<u8>, ViewError> {
        let mut memory = self.memory();
        rows.try_fold(Vec::new(), |mut bytes, row| {
            bytes.extend(blob::floats(&blob::network(&memory.replay.network(row)?)));
            Ok(bytes)
        })
    }

    /// The replay; a thread that died with it locked left it whole.
    fn memory(&self) -> MutexGuard<'_, Memory> {
        self.memory.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Memory {
    /// The numbers of all bodies at a row.
    fn numbers(&mut self, shown: Shown, row: usize) -> Result<Vec<f64>, ViewError> {
        Ok(match shown {
            Shown::Stress => self.stress(row)?,
            Shown::Normal => self.parts(row)?.iter().map(|parts| parts.normal).collect(),
            Shown::Tangential => self.parts(row)?.iter().map(|parts| parts.tangential).collect(),
            Shown::OfBodies => self.parts(row)?.iter().flat_map(|parts| parts.of_bodies.iter().copied()).collect(),
        })
    }

    /// The stress of all bodies at a row, matrix by matrix, row by row.
    fn stress(&mut self, row: usize) -> Result<Vec<f64>, ViewError> {
        let bodies = self.replay.cauchy_stress(row)?;
        let numbers = |stress: &Option<gyration::tensor::Mat3>| match stress {
            // nalgebra stores columns; rows are recorded.
            Some(stress) => stress.transpose().as_slice().to_vec(),
            None => vec![f64::NAN; 9],
        };
        Ok(bodies.iter().flat_map(numbers).collect())
    }

    fn parts(&mut self, row: usize) -> Result<&[ContactParts], ViewError> {
        let Self { replay, parts } = self;
        Ok(match parts.entry(row) {
            std::collections::hash_map::Entry::Occupied(known) => known.into_mut(),
            std::collections::hash_map::Entry::Vacant(room) => room.insert(replay.contact_parts(row)?),
        })
    }
}
