//! The small motions of a lattice as matrices: those of one cell, and with them those at each wave vector.
//!
//!   ξ̈ + C(k) ξ̇ + K(k) ξ = B(k) γ,   γ̇ = D(k) ξ + E(k) ξ̇ + H(k) γ,   K(k) = Σ_R K_R e^{ik·R}
//!
//! in the coordinates of `system`, along which the mass is one. R runs over the cells that act on the one: the exact
//! Jacobian has the blocks of each apart.

use super::super::frozen::FrozenSystem;
use super::super::participation::{PARTS, energies};
use super::super::system::SystemCoordinates;
use super::super::weightless::{Inertial, MotionMatrices};
pub(super) use super::by_cell::C64;
use super::by_cell::{CellMatrices, MatricesByCell, phase};
use gyration::Inadmissible;
use gyration::lattice::{Cell, HERE, Lattice, opposite};
use gyration::tensor::Vec3;
use nalgebra::{ComplexField, DMatrix, DVector, Vector3};
use std::ops::Range;

/// Differences below this part of the largest entry are the rounding of a Jacobian.
const ROUNDING: f64 = 1e-11;

/// Shares of the kinetic energy below this are rounding.
const NO_SHARE: f64 = 1e-15;

/// The matrices of the cells that act on one.
#[derive(Debug)]
pub(super) struct BlochSystem {
    cells: MatricesByCell,
    /// The largest |K| that there may be [1/s²].
    pub stiffest: f64,
    /// The same of what has inertia.
    pub stiffest_moving: f64,
    /// Which ξ have inertia.
    pub inertial: Inertial,
    /// Whether K(k) is Hermitian at every k, and nothing else acts.
    pub is_conservative: bool,
    /// Whether what else acts does no work.
    pub is_lossless: bool,
    /// Whether K(k) is Hermitian at every k, whatever else acts.
    pub has_potential: bool,
    /// Whether C(k) is.
    pub resists_evenly: bool,
    /// Of each body: where its ξ stand, and twice the kinetic energy of each part of a motion as a form of them.
    parts: Vec<(Range<usize>, [DMatrix<f64>; PARTS])>,
}

impl BlochSystem {
    /// About a state of a cell, with its coordinates and rates there.
    ///
    /// # Errors
    /// [`Inadmissible`] if the state is outside the model.
    pub fn at(
        frozen: &mut FrozenSystem,
        coordinates: &SystemCoordinates,
        lattice: &Lattice,
        (numbers, rates): (&[f64], &[f64]),
    ) -> Result<Self, Inadmissible> {
        let cells = matrices(frozen, coordinates, lattice, (numbers, rates))?;
        let stiffest = cells.stiffest();
        let is_symmetric = is_mirrored(&cells.cells, stiffest, 1.0, |cell| &cell.stiffness);
        let is_conservative = cells.has_only_stiffness() && is_symmetric;
        let is_gyroscopic = is_mirrored(&cells.cells, cells.most_resisting(), -1.0, |cell| &cell.resistance);
        let resists_evenly = is_mirrored(&cells.cells, cells.most_resisting(), 1.0, |cell| &cell.resistance);
        let parts = parts(frozen, coordinates, numbers);
        let inertial = coordinates.inertial(frozen);
        let stiffest_moving = match inertial.weightless.is_empty() {
            true => stiffest,
            false => cells.cells.iter().map(|cell| cell.stiffness.select_rows(&inertial.moving).norm()).sum(),
        };
        let is_lossless = is_symmetric && is_gyroscopic && cells.counts[1] == 0 && inertial.weightless.is_empty();
        let has_potential = is_symmetric;
        Ok(Self {
            cells,
            stiffest,
            stiffest_moving,
            inertial,
            is_conservative,
            is_lossless,
            has_potential,
            resists_evenly,
            parts,
        })
    }

    /// How many ξ and γ there are.
    pub fn counts(&self) -> [usize; 2] {
        self.cells.counts
    }

    /// The matrices of all cells.
    pub fn by_cell(&self) -> &MatricesByCell {
        &self.cells
    }

    /// The matrices at κ.
    pub fn wave(&self, kappa: &[f64; 3]) -> MotionMatrices {
        self.cells.at(kappa)
    }

    /// Their derivatives by k along a direction [m × each].
    pub fn slope(&self, kappa: &[f64; 3], along: &Vec3) -> MotionMatrices {
        self.cells.weighted(|cell| phase(kappa, cell.cell) * C64::new(0.0, cell.place.dot(along)))
    }

    /// Their second derivatives at k = 0 along a direction [m² × each].
    pub fn curvature(&self, along: &Vec3) -> MotionMatrices {
        self.cells.weighted(|cell| C64::new(-cell.place.dot(along) * cell.place.dot(along), 0.0))
    }

    /// The cells that act on the one: which, R [m] and K_R [1/s²].
    pub fn stiffnesses(&self) -> impl Iterator<Item = (Cell, Vec3, &DMatrix<f64>)> {
        self.cells.cells.iter().map(|cell| (cell.cell, cell.place, &cell.stiffness))
    }

    /// ζᴴ (∂K/∂k) ξ, a component each axis of space [m/s²].
    pub fn stiffness_slope(&self, kappa: &[f64; 3], left: &DVector<C64>, right: &DVector<C64>) -> Vector3<C64> {
        let mut slope = Vector3::zeros();
        for cell in self.cells.cells.iter().filter(|cell| cell.cell != HERE) {
            let terms = cell.entries.iter().map(|(i, j, entry)| left[*i].conjugate() * right[*j] * *entry);
            let factor = phase(kappa, cell.cell) * C64::new(0.0, 1.0) * terms.sum::<C64>();
            slope += cell.place.map(|component| factor * component);
        }
        slope
    }

    /// How many cells away along a direction something still acts.
    pub fn reach(&self, direction: usize) -> i32 {
        self.cells.cells.iter().map(|cell| cell.cell[direction].abs()).max().unwrap_or(0)
    }

    /// The part of the cells that are so many away along a direction, with the phases of the others.
    pub fn wave_of_layer(&self, kappa: &[f64; 3], direction: usize, layer: i32) -> MotionMatrices {
        let mut across = *kappa;
        across[direction] = 0.0;
        let is_in = |cell: Cell| cell[direction] == layer;
        self.cells.weighted(|cell| if is_in(cell.cell) { phase(&across, cell.cell) } else { C64::new(0.0, 0.0) })
    }

    /// The shares of a motion: translation, rotation, shear, stretch, breathing.
    pub fn participation(&self, shape: &DVector<C64>) -> [f64; PARTS] {
        let mut shares = [0.0; PARTS];
        for energies in self.energies(shape) {
            shares.iter_mut().zip(energies).for_each(|(share, energy)| *share += energy);
        }
        let total: f64 = shares.iter().sum();
        // Terms of two parts, halved for each, may leave a share below zero; rounding is none.
        shares.map(|share| if total > 0.0 && share.abs() > NO_SHARE * total { share / total } else { 0.0 })
    }

    /// Twice the kinetic energy of each part of a motion, body by body.
    pub fn energies(&self, shape: &DVector<C64>) -> impl Iterator<Item = [f64; PARTS]> {
        self.parts.iter().map(|(range, forms)| {
            let own = shape.rows(range.start, range.len());
            let (real, imaginary) = (own.map(|value| value.re), own.map(|value| value.im));
            let form = |matrix: &DMatrix<f64>| (matrix * &real).dot(&real) + (matrix * &imaginary).dot(&imaginary);
            forms.each_ref().map(form)
        })
    }
}

/// The matrices of all cells about a state, with its coordinates and rates there.
///
/// # Errors
/// [`Inadmissible`] if the state is outside the model.
pub(super) fn matrices(
    frozen: &mut FrozenSystem,
    coordinates: &SystemCoordinates,
    lattice: &Lattice,
    (numbers, rates): (&[f64], &[f64]),
) -> Result<MatricesByCell, Inadmissible> {
    let slopes = frozen.slopes(numbers)?;
    let velocities = coordinates.contraction_velocities(frozen, numbers, rates);
    let cells = slopes.cells().into_iter().map(|cell| {
        let own = slopes.of_cell(cell);
        let (stiffness, first) = coordinates.first_order(&velocities, &own);
        CellMatrices::new((cell, lattice.place(cell)), stiffness, coordinates.resistance(&own), first)
    });
    Ok(MatricesByCell::new(cells.collect(), coordinates.counts()))
}

/// Whether A_{−R} = ±A_Rᵀ for all R, given the largest entry that there may be.
fn is_mirrored(cells: &[CellMatrices], most: f64, sign: f64, of: fn(&CellMatrices) -> &DMatrix<f64>) -> bool {
    cells.iter().all(|cell| {
        let back = cells.iter().find(|other| other.cell == opposite(cell.cell));
        let asymmetry = match back {
            Some(back) => (of(cell) - sign * of(back).transpose()).amax(),
            None => of(cell).amax(),
        };
        asymmetry <= ROUNDING * most
    })
}

/// The energies of the parts of a motion as forms of ξ, from those of unit motions and of their sums.
fn parts(
    frozen: &FrozenSystem,
    coordinates: &SystemCoordinates,
    numbers: &[f64],
) -> Vec<(Range<usize>, [DMatrix<f64>; PARTS])> {
    let of_body = |body: usize| {
        let (own, placement) = (&frozen.bodies()[body], frozen.motion(numbers, body).placement);
        let size = coordinates.range(body).len();
        let of = |z: &DVector<f64>| energies(own, &placement, &coordinates.of(body).shape(own, z));
        let unit = |i: usize| DVector::from_fn(size, |k, _| f64::from(u8::from(k == i)));
        let alone: Vec<[f64; PARTS]> = (0..size).map(|i| of(&unit(i))).collect();
        let mut forms =
            std::array::from_fn(|part| DMatrix::from_fn(size, size, |i, j| if i == j { alone[i][part] } else { 0.0 }));
        for (i, j) in (0..size).flat_map(|i| (0..i).map(move |j| (i, j))) {
            let both = of(&(unit(i) + unit(j)));
            for (part, form) in forms.iter_mut().enumerate() {
                let shared = 0.5 * (both[part] - alone[i][part] - alone[j][part]);
                (form[(i, j)], form[(j, i)]) = (shared, shared);
            }
        }
        (coordinates.range(body), forms)
    };
    (0..frozen.count()).map(of_body).collect()
}
