//! The spectrum of a run of a ring: how much of its energy is in each wave of its cell, and how these swing.
//!
//!   u(κ, t) = N⁻¹ Σ_R ξ_R e^{−ik·R},   q_b = ξ_bᴴ u,   a_b = ½ (q_b + i q̇_b/ω_b),   E_b = 2N ω_b² |a_b|²
//!
//! ξ_R are displacements from rest and ξ_b normal modes, both along the coordinates in which bands are, of mass one, so
//! that the energies of small motions add up to that of the run: κ and −κ are waves that run against one another. A
//! branch without frequency has the kinetic energy ½N|q̇|²; one that grows also ½Nω²|q|², which is below zero. `ring`
//! has the cells and their coordinates, `fourier` the sums over them, `sums` what is gathered sample by sample,
//! `oscillator` frequency and width of a branch.

mod fourier;
mod oscillator;
mod ring;
mod sums;
mod times;

use crate::format::significant;
use crate::modes::bands::{LatticeWaves, NoBands, NoNormalModes};
use crate::orbit::energy;
use crate::plan::RunPlan;
use crate::replay::{self, Replay, ReplayError};
use crate::waves::LARGEST;
use gyration::model::Model;
use gyration::state::State;
use gyration_record::Recording;
use gyration_threads::Interruption;
use nalgebra::Complex;
use ring::Ring;
use serde::Serialize;
use sums::{Noise, Sums};
use times::SampleTimes;

type C64 = Complex<f64>;

/// The most bodies of a cell whose waves are found: the matrices have the square of them.
const MOST_BODIES: usize = 300;
/// The errors of a whole run, in tolerances of a step.
const RUN_ERRORS: f64 = 100.0;
/// Roundings of a place between the run and its displacement: as recorded, less its cell, less its rest.
const ROUNDINGS: f64 = 4.0;
/// The part of the energy that branches may miss before a motion is called large.
const SMALL: f64 = 0.05;
/// Energies that cancel to this part of their sizes are not known.
const CANCELLED: f64 = 1e-11;

/// How the energy of a ring is shared out among the waves of its cell.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RingSpectrum {
    /// The wave vectors that the ring allows, −½ < κ ≤ ½, the first direction fastest.
    pub kappa: Vec<[f64; 3]>,
    /// ω of each branch \[rad/s\], what resists left out, a row a wave vector.
    pub omega: Vec<Vec<f64>>,
    /// δ of each branch to first order \[1/s\].
    pub decay: Vec<Vec<f64>>,
    /// The energy of each branch \[J\], its mean over time.
    pub energy: Vec<Vec<f64>>,
    /// Its mean over the last quarter of the time less that over the first \[J\].
    pub change: Vec<Vec<f64>>,
    /// Each branch with what is measured of it, in the same order.
    pub branches: Vec<BranchSpectrum>,
    /// The times of the samples \[s\].
    pub t: Vec<f64>,
    /// The energy of all branches at each \[J\].
    pub total: Vec<f64>,
    /// The energy of the run above that of its rest at each \[J\].
    pub run: Vec<f64>,
    /// The energy of each branch at each \[J\]: sample, wave vector, branch; none where that was not asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub energies: Option<Vec<Vec<Vec<f64>>>>,
    /// What must be known of these numbers.
    pub warnings: Vec<String>,
}

/// A branch at a wave vector.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BranchSpectrum {
    /// κ.
    pub kappa: [f64; 3],
    /// Its number, from 0.
    pub branch: usize,
    /// ω as measured \[rad/s\]; zero of one that has none, nothing where it cannot be told.
    pub omega: Option<f64>,
    /// δ as measured \[1/s\], half the width of its line; negative where it grows.
    pub width: Option<f64>,
    /// Its energy \[J\], the mean over time.
    pub energy: f64,
}

/// Why there is no spectrum.
#[derive(Debug, thiserror::Error)]
pub enum NoRingSpectrum {
    /// No samples, or none that can be brought back.
    #[error(transparent)]
    Replay(#[from] ReplayError),
    /// The scene has no lattice.
    #[error("the recording is not of a ring: its scene has no `[lattice]`")]
    NoLattice,
    /// The lattice has free ends.
    #[error("the recording is not of a ring: its lattice has free ends along every direction")]
    NoRing,
    /// Too much lies side by side.
    #[error("{0} bodies lie side by side between free ends, and waves are found of {MOST_BODIES}")]
    TooMany(usize),
    /// The cell has no waves.
    #[error(transparent)]
    Bands(#[from] NoBands),
    /// Its waves are no normal modes.
    #[error(transparent)]
    NoNormalModes(#[from] NoNormalModes),
    /// A body is no more near its rest.
    #[error("at t = {time} s \"{body}\" is turned by half a turn or turned inside out: that is no small motion")]
    TooFar {
        /// Which body.
        body: String,
        /// When \[s\].
        time: f64,
    },
    /// It was given up.
    #[error("it was given up: it takes longer than it may")]
    Interrupted,
}

impl RingSpectrum {
    /// Of a recording; with the energies of all samples if they are asked for.
    ///
    /// # Errors
    /// [`NoRingSpectrum`].
    pub fn of(recording: &Recording, with_energies: bool) -> Result<Self, NoRingSpectrum> {
        let scene = replay::scene(recording)?;
        let built = scene.built();
        let (ring, cell) = Ring::of(built)?;
        if cell.model.bodies.len() > MOST_BODIES {
            return Err(NoRingSpectrum::TooMany(cell.model.bodies.len()));
        }
        let waves = LatticeWaves::new(&cell.model, &cell.state, cell.relaxes)?;
        waves.have_normal_modes()?;
        let times = SampleTimes::of(recording).map_err(ReplayError::Record)?;
        let mut sums = Sums::new(&ring, &waves, &times, with_energies)?;
        let mut replay = Replay::of(recording, &scene);
        let rest = ring.at_rest(replay.model(), &waves);
        let mut run = RunEnergy::above(replay.model(), &rest);
        let mut spread: f64 = 0.0;
        for row in 0..times.times.len() {
            if Interruption::due().is_some() {
                return Err(NoRingSpectrum::Interrupted);
            }
            let state = replay.state(row)?;
            let model = replay.model();
            let motions = ring.motions(model, &state, &waves)?;
            spread = spread.max(motions.spread);
            sums.add(row, times.follows(row), motions);
            run.add(model, &state);
        }
        let places = (0..replay.model().bodies.len()).map(|body| rest.motion_in_space(replay.model(), body));
        let farthest = places.map(|motion| motion.placement.position.norm()).fold(0.0, f64::max);
        let noise = Noise {
            rounding: ROUNDINGS * waves.rounding(farthest),
            error: RUN_ERRORS * RunPlan::from(built).tolerance.rtol,
        };
        let mut found = sums.spectrum(&times, noise);
        if cell.load.is_some() {
            found
                .warnings
                .push("the cell vectors are those as written, which a run keeps, not those at rest".to_owned());
        }
        if let Some(unrest) = waves.rest().unrest {
            let told = "the cell does not rest where displacements begin";
            found.warnings.push(format!("{told}: accelerations of up to {unrest:.1e} are left"));
        }
        if spread > LARGEST {
            let told = "bodies are turned or strained";
            found.warnings.push(format!("{told} by up to {}: that is no small motion", significant(spread, 4)));
        }
        found.warnings.extend(run.missed(times.mean(&found.total), &times));
        found.run = run.values;
        Ok(found)
    }

    /// The mean energy of all branches \[J\].
    pub fn mean_energy(&self) -> f64 {
        self.energy.iter().flatten().sum()
    }
}

/// The energy of a run beyond that of its rest.
struct RunEnergy {
    rest: f64,
    /// At each sample \[J\].
    values: Vec<f64>,
}

impl RunEnergy {
    fn above(model: &Model, rest: &State) -> Self {
        Self { rest: energy(model, rest).unwrap_or(f64::NAN), values: Vec::new() }
    }

    fn add(&mut self, model: &Model, state: &State) {
        self.values.push(energy(model, state).unwrap_or(f64::NAN) - self.rest);
    }

    /// In words, if branches miss much of it.
    fn missed(&self, branches: f64, times: &SampleTimes) -> Option<String> {
        let own = times.mean(&self.values);
        let is_known = own.abs() > CANCELLED * self.rest.abs();
        (is_known && (own - branches).abs() > SMALL * own.abs()).then(|| {
            format!(
                "the motion is not small: its energy above rest is {} J on average, and that of all branches {} J",
                significant(own, 5),
                significant(branches, 5)
            )
        })
    }
}
