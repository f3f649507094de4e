//! Waves with which a run starts: what the scene asks for, and the cell whose waves they are.
//!
//! The waves themselves are found when a scene is completed. Along what is periodic a wave fits into the cells, κ n
//! whole; a packet need not, and runs along free directions too, as a wave of a lattice without ends.

use super::UnitCell;
use super::lattice::Cells;
use crate::check::Reporter;
use crate::file::{self, LatticeWave};
use crate::key::Key;
use gyration::model::Model;
use gyration::state::State;
use gyration::tensor::Mat3;

/// κ times the number of cells may be this far from a whole number: the rounding of a fraction.
const WHOLE: f64 = 1e-6;

/// The waves with which a run starts.
#[derive(Debug, Clone)]
pub struct WaveStart {
    /// The cell whose waves they are.
    pub cell: UnitCell,
    /// How many cells that has along each vector.
    pub unit: [u32; 3],
    /// How many cells the run has.
    pub repeat: [u32; 3],
    /// Whether the last of these is beside the first.
    pub ring: [bool; 3],
    /// All of them, which add.
    pub waves: Vec<StartingWave>,
}

/// A run that begins with waves.
#[derive(Debug, Clone)]
pub struct WaveRun {
    /// Its model, which knows where bodies rest.
    pub model: Model,
    /// Its first state.
    pub state: State,
    /// F̄ at which the vectors of its cells have come to rest; none where they are as written.
    pub strain: Option<Mat3>,
}

/// A wave, or all of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StartingWave {
    /// One wave.
    Single {
        /// κ.
        kappa: [f64; 3],
        /// The branch, from 0.
        branch: usize,
        /// How far its fastest coordinate goes [m].
        amplitude: f64,
        /// Where it is, if not everywhere.
        packet: Option<Packet>,
    },
    /// Every wave of the cells.
    Random {
        /// The energy of each [J].
        energy: f64,
        /// The seed of their phases.
        seed: u64,
    },
}

/// Where a packet of waves is: e^{−|n − n₀|²/2w²}, n the cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Packet {
    /// n₀.
    pub at: [f64; 3],
    /// w.
    pub width: f64,
}

/// Waves as a scene asks for them, and in which directions the lattice has no ends for them.
#[derive(Debug, Clone)]
pub(super) struct WrittenWaves {
    pub waves: Vec<StartingWave>,
    pub endless: [bool; 3],
}

/// Reads the waves of a lattice; notes what is wrong with them.
pub(super) fn waves(written: &file::Lattice, cells: &Cells, reporter: &mut Reporter<'_>) -> Option<WrittenWaves> {
    let key = Key::root().key("lattice").key("wave");
    let written = written.wave.as_ref()?;
    let is_list = matches!(written, file::OneOrMany::Many(_));
    let mut endless = cells.ring();
    let mut waves = Vec::new();
    for (index, wave) in written.as_slice().iter().enumerate() {
        let key = if is_list { key.index(index) } else { key.clone() };
        let wave = single_or_random(wave, &key, reporter)?;
        if let StartingWave::Single { kappa, packet, .. } = &wave {
            fits(kappa, packet.is_some(), cells, &key.key("kappa"), reporter)?;
            let count = cells.lattice.vectors().len();
            let beyond = packet.and_then(|packet| (count..3).find(|a| packet.at[*a] != 0.0));
            if let Some(a) = beyond {
                reporter.note(&key.key("at").index(a), format!("the lattice has {count} cell vectors"), "write 0");
                return None;
            }
            (0..3).filter(|a| kappa[*a] != 0.0).for_each(|a| endless[a] = true);
        }
        waves.push(wave);
    }
    let is_random = waves.iter().any(|wave| matches!(wave, StartingWave::Random { .. }));
    if is_random && endless != cells.ring() {
        let message = "a packet runs towards free ends, where random waves are those of all cells side by side";
        reporter.note(&key, message, "leave out one of the two");
        return None;
    }
    Some(WrittenWaves { waves, endless })
}

fn single_or_random(wave: &LatticeWave, key: &Key, reporter: &mut Reporter<'_>) -> Option<StartingWave> {
    let LatticeWave { kappa, branch, amplitude, at, width, random } = wave;
    if let Some(random) = random {
        let is_alone = kappa.is_none() && branch.is_none() && amplitude.is_none() && at.is_none() && width.is_none();
        if !is_alone {
            let message = "`random` stands for every wave: nothing else can be said of it";
            reporter.note(&key.key("random"), message, "keep `random` alone, or write a list of waves");
            return None;
        }
        return Some(StartingWave::Random { energy: random.energy.value(), seed: random.seed.0 as u64 });
    }
    let (Some(kappa), Some(amplitude)) = (kappa, amplitude) else {
        let missing = if kappa.is_none() { "kappa" } else { "amplitude" };
        let help = "write { kappa = [0.25, 0, 0], branch = 0, amplitude = \"1 um\" }, or { random = { energy, seed } }";
        reporter.note(&key.key(missing), format!("the key \"{missing}\" is missing"), help);
        return None;
    };
    let packet = match (at, width) {
        (None, None) => None,
        (Some(at), Some(width)) => Some(Packet { at: *at, width: width.value() }),
        (at, _) => {
            let (given, missing) = if at.is_some() { ("at", "width") } else { ("width", "at") };
            let message = format!("a packet has `at` and `width`: `{missing}` is missing");
            reporter.note(&key.key(given), message, format!("add `{missing}`, in cells"));
            return None;
        }
    };
    let branch = branch.map_or(0, |branch| branch.0 as usize);
    Some(StartingWave::Single { kappa: *kappa, branch, amplitude: amplitude.value(), packet })
}

/// Whether a wave vector is one of the cells; notes why not.
fn fits(kappa: &[f64; 3], is_packet: bool, cells: &Cells, key: &Key, reporter: &mut Reporter<'_>) -> Option<()> {
    let (count, repeat, ring) = (cells.lattice.vectors().len(), cells.repeat(), cells.ring());
    for a in 0..3 {
        let turns = kappa[a] * f64::from(repeat[a]);
        let (message, help) = if a >= count && kappa[a] != 0.0 {
            (format!("the lattice has {count} cell vectors"), "write 0".to_owned())
        } else if is_packet || kappa[a] == 0.0 {
            continue;
        } else if !ring[a] {
            let message = format!("along cell vector {} the lattice has free ends, where no wave fits", a + 1);
            (message, "write 0, or make it a packet with `at` and `width`".to_owned())
        } else if (turns - turns.round()).abs() > WHOLE {
            let nearest = turns.round();
            let message =
                format!("the wave does not close over {} cells: κ times that is {turns}, not whole", repeat[a]);
            (
                message,
                format!("write {nearest}/{} = {}, or make it a packet", repeat[a], nearest / f64::from(repeat[a])),
            )
        } else {
            continue;
        };
        reporter.note(&key.index(a), message, help);
        return None;
    }
    Some(())
}
