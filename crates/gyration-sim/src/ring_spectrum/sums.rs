//! What is gathered sample by sample: the energies of all branches, and how each swings.

use super::fourier::Fourier;
use super::oscillator::{Oscillator, Sample};
use super::ring::{CellMotions, Ring};
use super::times::SampleTimes;
use super::{BranchSpectrum, C64, RingSpectrum};
use crate::format::significant;
use crate::modes::bands::{LatticeWaves, NoBands, NormalModes};
use gyration_threads::Interruption;
use nalgebra::DVector;
use std::f64::consts::PI;

/// The sums over the samples so far.
pub(super) struct Sums {
    fourier: Fourier,
    waves: Vec<RingWave>,
    /// N.
    cells: f64,
    weights: Vec<f64>,
    change_weights: Vec<f64>,
    total: Vec<f64>,
    energies: Option<Vec<Vec<Vec<f64>>>>,
}

/// A wave vector, and what its branches do.
struct RingWave {
    kappa: [f64; 3],
    /// Where the sums over the cells have it.
    place: usize,
    modes: NormalModes,
    branches: Vec<BranchSums>,
}

/// The sums of a branch.
#[derive(Debug, Clone, Default)]
struct BranchSums {
    energy: f64,
    change: f64,
    oscillator: Oscillator,
    last: Option<Sample>,
}

/// What is no motion, but an error of the run or of what is recorded of it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Noise {
    /// |u| of rounding, along coordinates of mass one.
    pub rounding: f64,
    /// The part of amplitudes by which a run is off.
    pub error: f64,
}

impl Sums {
    /// Of nothing yet.
    ///
    /// # Errors
    /// `Roots`, `Interrupted`.
    pub fn new(ring: &Ring, waves: &LatticeWaves, times: &SampleTimes, keeps: bool) -> Result<Self, NoBands> {
        let mut found = Vec::new();
        for (kappa, place) in ring.wave_vectors() {
            if Interruption::due().is_some() {
                return Err(NoBands::Interrupted);
            }
            let modes = waves.normal_modes(kappa)?;
            let branches = vec![BranchSums::default(); modes.squares.len()];
            found.push(RingWave { kappa, place, modes, branches });
        }
        Ok(Self {
            fourier: Fourier::new(ring.counts),
            waves: found,
            cells: ring.count() as f64,
            weights: times.weights.clone(),
            change_weights: times.change_weights(),
            total: Vec::new(),
            energies: keeps.then(Vec::new),
        })
    }

    /// Takes in a sample; `follows` tells whether it is as far from the one before as most are.
    pub fn add(&mut self, row: usize, follows: bool, mut motions: CellMotions) {
        let Self { fourier, waves, cells, weights, change_weights, .. } = self;
        motions.places.iter_mut().chain(&mut motions.rates).for_each(|cells| fourier.transform(cells));
        let mut energies = Vec::with_capacity(waves.len());
        for wave in waves {
            let at = |parts: &[Vec<C64>]| DVector::from_iterator(parts.len(), parts.iter().map(|it| it[wave.place]));
            let [places, rates] = [&motions.places, &motions.rates].map(|it| wave.modes.shapes.ad_mul(&at(it)));
            let mut energies_here = Vec::with_capacity(wave.branches.len());
            for (branch, sums) in wave.branches.iter_mut().enumerate() {
                let (square, q, rate) = (wave.modes.squares[branch], places[branch], rates[branch]);
                let energy = energy(*cells, square, q, rate);
                sums.energy += weights[row] * energy;
                sums.change += change_weights[row] * energy;
                // 2ωa and 2ωp.
                let (turned, own) = (C64::new(0.0, 1.0) * rate, q * libm::sqrt(square.abs()));
                let sample = Sample::new(own + turned, own - turned);
                if let Some(before) = sums.last.replace(sample).filter(|_| follows) {
                    sums.oscillator.add(&before, &sample);
                }
                energies_here.push(energy);
            }
            energies.push(energies_here);
        }
        self.total.push(energies.iter().flatten().sum());
        if let Some(all) = &mut self.energies {
            all.push(energies);
        }
    }

    /// The spectrum.
    pub fn spectrum(self, times: &SampleTimes, noise: Noise) -> RingSpectrum {
        let total = times.mean(&self.total);
        let table = |of: &dyn Fn(&RingWave, usize) -> f64| -> Vec<Vec<f64>> {
            self.waves.iter().map(|wave| (0..wave.branches.len()).map(|branch| of(wave, branch)).collect()).collect()
        };
        let omega = |wave: &RingWave, branch: usize| libm::sqrt(wave.modes.squares[branch].max(0.0));
        let mut sparse = Vec::new();
        let mut branches = Vec::new();
        for wave in &self.waves {
            for (branch, sums) in wave.branches.iter().enumerate() {
                let (square, omega) = (wave.modes.squares[branch], omega(wave, branch));
                let least = noise.energy(square, total);
                let is_sparse = omega * times.apart >= PI;
                let moves = sums.energy.abs() > least;
                if moves && is_sparse {
                    sparse.push(omega);
                }
                let is_told = moves && !is_sparse && square != 0.0;
                let swing = is_told.then(|| sums.oscillator.swing(times.apart, least / sums.energy.abs())).flatten();
                let still = (square == 0.0).then_some(0.0);
                branches.push(BranchSpectrum {
                    kappa: wave.kappa,
                    branch,
                    omega: swing.map(|it| it.omega).or(still),
                    width: swing.map(|it| it.width),
                    energy: sums.energy,
                });
            }
        }
        RingSpectrum {
            kappa: self.waves.iter().map(|wave| wave.kappa).collect(),
            omega: table(&omega),
            decay: table(&|wave, branch| wave.modes.decays[branch]),
            energy: table(&|wave, branch| wave.branches[branch].energy),
            change: table(&|wave, branch| wave.branches[branch].change),
            branches,
            t: times.times.clone(),
            run: Vec::new(),
            warnings: too_sparse(&sparse, times.apart).into_iter().collect(),
            total: self.total,
            energies: self.energies,
        }
    }
}

impl Noise {
    /// The energy of a branch that is none \[J\], given that of all.
    fn energy(&self, square: f64, total: f64) -> f64 {
        0.5 * square.abs() * self.rounding * self.rounding + self.error * self.error * total.abs()
    }
}

/// E of a branch \[J\] by ω², q and q̇, N cells being.
fn energy(cells: f64, square: f64, q: C64, rate: C64) -> f64 {
    match square > 0.0 {
        // 2N ω² |a|², a = ½ (q + i q̇/ω).
        true => 0.5 * cells * (q * libm::sqrt(square) + C64::new(0.0, 1.0) * rate).norm_sqr(),
        false => 0.5 * cells * (rate.norm_sqr() + square * q.norm_sqr()),
    }
}

/// Of branches that turn by half a turn or more from sample to sample.
fn too_sparse(frequencies: &[f64], apart: f64) -> Option<String> {
    let most = frequencies.iter().copied().fold(0.0, f64::max);
    (most > 0.0).then(|| {
        format!(
            "samples {} s apart are too sparse for {} of the branches that move, up to ω = {} rad/s: nothing is \
             measured of them; write time.sample below {} s in the scene",
            significant(apart, 4),
            frequencies.len(),
            significant(most, 6),
            significant(PI / most, 4)
        )
    })
}
