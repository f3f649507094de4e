//! Bounds of what frequencies may be off: by the eigenvalues, by the rest, by the rounding of the matrices.
//!
//!   |ω² − ω̃²| ≤ min(|r|, |r|²/gap) + |δK|,   r = K x − ω̃² x,   |x| = 1   (along coordinates of mass one)
//!   |δK| ≤ Σ_j |∂K/∂q_j| |δq_j| + rounding,   |δq| ≤ |K₀⁺| (|g| + ε |K||q|) + ε |q|
//!
//! The first is Kato's and Temple's bound, the second Weyl's. g are the forces that are left at rest, K₀ is K at κ = 0;
//! q are places with the length of a cell vector, from which distances are taken. Where something resists, λ is off by
//! |z| |r|/|zᴴ (∂Q/∂λ) ξ| at most to first order, z the left null vector, with δC λ beside δK.
//!
//! Sources: T. Kato, *J. Phys. Soc. Jpn* 4 (1949) 334; F. Tisseur and K. Meerbergen, *SIAM Rev.* 43 (2001) 235, (5.5).

use super::super::at_rest;
use super::super::canonical::{self, Basis};
use super::super::frozen::FrozenSystem;
use super::super::system::SystemCoordinates;
use super::bloch::matrices;
use super::by_cell::MatricesByCell;
use super::doubt::MatrixDoubt;
use super::{LatticeWaves, NoBands, NoRest};
use gyration::Inadmissible;
use gyration::lattice::Lattice;
use gyration::tensor::Vec3;
use nalgebra::{DMatrix, DVector};

/// Motions by which the matrices are differentiated, as a part of the size of a body: their second derivatives then add
/// a little to a bound.
const PROBE: f64 = 1e-6;
/// A number of the Jacobian is a sum of some terms, of which each is rounded a few times.
const ROUNDINGS: f64 = 16.0;
/// The same of a place.
const ROUNDINGS_OF_PLACES: f64 = 4.0;

impl LatticeWaves {
    /// How far the matrices may be off.
    ///
    /// # Errors
    /// [`NoBands`].
    pub fn doubt(&mut self) -> Result<MatrixDoubt, NoBands> {
        let numbers = at_rest(&self.frozen, &self.rest.bodies);
        let by_cell = self.system.by_cell();
        let longest = self.lattice.vectors().iter().map(Vec3::norm).fold(0.0, f64::max);
        let sizes = self.coordinates.sizes(&self.frozen, &numbers, longest);
        let off = match self.is_relaxed {
            true => {
                let force = self.coordinates.force(&self.frozen.rates(&numbers).map_err(NoRest::from)?);
                rest_error(by_cell, &force, &sizes)
            }
            false => DVector::zeros(sizes.len()),
        };
        let off = off.zip_map(&sizes, |off, size| off + ROUNDINGS_OF_PLACES * f64::EPSILON * size);
        let (mut stiffness, mut resistance) = (0.0, 0.0);
        for (coordinate, off) in off.iter().enumerate() {
            let slope = slope(&mut self.frozen, (&self.coordinates, by_cell), (&numbers, coordinate), &self.lattice);
            let [by_stiffness, by_resistance] = slope.map_err(NoRest::from)?;
            stiffness += off * by_stiffness;
            resistance += off * by_resistance;
        }
        let rounding =
            (ROUNDINGS + by_cell.counts[0] as f64) * f64::EPSILON + self.coordinates.mass_error(&self.frozen);
        let is_open = self.contracts() || !self.system.inertial.weightless.is_empty();
        Ok(MatrixDoubt {
            stiffness: stiffness + rounding * by_cell.stiffest(),
            resistance: resistance + rounding * by_cell.most_resisting(),
            is_open,
        })
    }
}

/// |δq| along coordinates of mass one: what the forces that are left at rest, and their rounding, let places be off.
fn rest_error(by_cell: &MatricesByCell, force: &DVector<f64>, sizes: &DVector<f64>) -> DVector<f64> {
    let count = force.len();
    let sum = |part: fn(f64) -> f64| {
        by_cell.cells.iter().fold(DMatrix::zeros(count, count), |sum, cell| sum + cell.stiffness.map(part))
    };
    let rounding = ROUNDINGS_OF_PLACES * f64::EPSILON * sum(f64::abs) * sizes;
    let left = force.abs() + rounding;
    let Basis { vectors, values, zero } = canonical::eigen(&sum(|entry| entry));
    let mut off = DVector::zeros(count);
    for (vector, value) in vectors.column_iter().zip(values).filter(|(_, value)| value.abs() > zero) {
        let along = vector.abs();
        off += &along * (along.dot(&left) / value.abs());
    }
    off
}

/// Σ_R |∂K_R/∂q| and Σ_R |∂C_R/∂q| by a coordinate.
fn slope(
    frozen: &mut FrozenSystem,
    (coordinates, by_cell): (&SystemCoordinates, &MatricesByCell),
    (numbers, coordinate): (&[f64], usize),
    lattice: &Lattice,
) -> Result<[f64; 2], Inadmissible> {
    let along = DVector::from_fn(by_cell.counts[0], |k, _| f64::from(u8::from(k == coordinate)));
    let shapes = coordinates.shapes(frozen, &along);
    let moved = shapes.iter().zip(frozen.bodies()).map(|(shape, body)| {
        shape.largest_displacement(0.5 * body.size) / if body.size > 0.0 { body.size } else { 1.0 }
    });
    let most = moved.fold(0.0, f64::max);
    if most == 0.0 {
        return Ok([0.0; 2]);
    }
    let mut at = |step: f64| {
        let mut ahead = numbers.to_vec();
        coordinates.advance_places(&mut ahead, &(step * &along));
        frozen.project(&mut ahead);
        let rates = frozen.rates(&ahead)?;
        let own = SystemCoordinates::at(frozen, &ahead)?;
        let there = matrices(frozen, &own, lattice, (&ahead, &rates))?;
        let turn = SystemCoordinates::turn(&own, coordinates);
        let apart = turn.and_then(|turn| there.distances(by_cell, &turn));
        // Where something else acts there, nothing is known.
        Ok(apart.map_or([f64::INFINITY; 2], |apart| apart.map(|apart| apart / step.abs())))
    };
    let step = PROBE / most;
    let mut found = at(step);
    for nearer in [-1.0, 1e-3, -1e-3] {
        if found.is_ok() {
            break;
        }
        found = at(nearer * step);
    }
    found
}
