//! The cell that is at rest too: its vectors F̄ a_a under a nominal stress S̄ or a pressure p, F̄ symmetric.
//!
//!   least E − Ω₀ S̄·F̄:   Σ t_a ⊗ a_a = Ω₀ S̄,      least E + pΩ:   Σ t_a ⊗ F̄a_a = −pΩ in the span of the cell
//!
//! t_a the force that a vector carries when its bodies rest. Newton's method in the components of F̄ that the cell
//! feels, with a derivative by differences, each rest sought from the last. Where a component has no stiffness nothing
//! holds it; where that is because contractions flow until no force is left, the cell is that which rests while they
//! are held, from where on they flow: until neither moves.

use super::doubt::MatrixDoubt;
use super::strained::StrainedCell;
use super::{NoBands, NoRest};
use gyration::lattice::Lattice;
use gyration::tensor::{Mat3, Vec3};
use gyration_scene::CellLoad;
use nalgebra::{DMatrix, DVector};
use std::f64::consts::TAU;

/// Steps at most.
const MOST: usize = 60;
/// The longest step in F̄.
const LONGEST: f64 = 0.05;
/// The step of differences in F̄.
const DIFFERENCE: f64 = 1e-6;
/// The step in F̄ by which the matrices are differentiated: their second derivatives then add a little to a bound.
const PROBE: f64 = 1e-5;
/// A step is halved so often, where it leads to a cell without a rest.
const MOST_HALVINGS: usize = 8;
/// Steps below this are the last.
const SMALL: f64 = 1e-13;
/// Stiffness below this part of the largest is none: above what differences leave.
const NO_STIFFNESS: f64 = 1e-8;
/// Relaxed shapes that change by less have not flowed.
const STILL: f64 = 1e-9;

/// What contractions do while a cell seeks its rest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Contractions {
    Held,
    /// They stand still wherever it is.
    Settle,
}

/// A cell at rest: itself, F̄ and by how much that may be off.
type Found = (StrainedCell, Mat3, f64);

impl StrainedCell {
    /// The cell whose vectors rest too; from there on it counts as written.
    ///
    /// # Errors
    /// [`NoBands`].
    pub fn at_rest(&self, load: CellLoad) -> Result<Self, NoBands> {
        let found = match self.seek(load, Contractions::Settle) {
            Err(NoBands::CellNotHeld(component)) if self.contracts() => self.in_turns(load, component),
            found => found,
        };
        let (cell, gradient, left) = found?;
        cell.as_written(&gradient, left)
    }

    /// The rest of a cell while contractions are held, then theirs, until neither moves any more; `component` of F̄ has
    /// no stiffness where they follow.
    fn in_turns(&self, load: CellLoad, component: String) -> Result<Found, NoBands> {
        let mut cell = self.clone();
        for _ in 0..MOST {
            let (held, gradient, left) = cell.seek(load, Contractions::Held)?;
            cell = held.at(&gradient)?.0;
            if cell.relaxed_apart(&held) <= STILL {
                return Ok((cell, gradient, left));
            }
        }
        Err(NoBands::CellNotHeld(component))
    }

    /// The largest stiffness of F̄ while contractions are held [J]; zero without any.
    fn held_stiffness(&self, load: CellLoad, basis: &[Mat3]) -> Result<f64, NoBands> {
        if !self.contracts() {
            return Ok(0.0);
        }
        let mut most = 0.0_f64;
        for along in basis {
            let side = |side: f64| {
                let beside = self.gradient() + side * DIFFERENCE * along;
                Ok::<_, NoBands>(self.left(&beside, load, basis, Contractions::Held)?.1)
            };
            most = most.max((side(1.0)? - side(-1.0)?).amax() / (2.0 * DIFFERENCE));
        }
        Ok(most)
    }

    /// The F̄ at which nothing is left.
    fn seek(&self, load: CellLoad, contractions: Contractions) -> Result<Found, NoBands> {
        let basis = components(self.written());
        let least = match contractions {
            Contractions::Held => 0.0,
            Contractions::Settle => NO_STIFFNESS * self.held_stiffness(load, &basis)?,
        };
        let gradient = |x: &DVector<f64>| {
            let strain: Mat3 = basis.iter().zip(x.iter()).map(|(basis, x)| *x * basis).sum();
            Mat3::identity() + strain
        };
        let strain = self.gradient() - Mat3::identity();
        let mut x = DVector::from_iterator(basis.len(), basis.iter().map(|basis| basis.dot(&strain)));
        let mut last = f64::INFINITY;
        let (mut cell, mut force) = self.left(&gradient(&x), load, &basis, contractions)?;
        for _ in 0..MOST {
            let mut stiffness = DMatrix::zeros(basis.len(), basis.len());
            for k in 0..basis.len() {
                let beside = |side: f64| {
                    let mut beside = x.clone();
                    beside[k] += side * DIFFERENCE;
                    Ok::<_, NoBands>(cell.left(&gradient(&beside), load, &basis, contractions)?.1)
                };
                stiffness.set_column(k, &((beside(1.0)? - beside(-1.0)?) / (2.0 * DIFFERENCE)));
            }
            let eigen = (0.5 * (&stiffness + stiffness.transpose())).symmetric_eigen();
            let most = eigen.eigenvalues.amax();
            let floppy = eigen.eigenvalues.iter().position(|value| value.abs() <= least.max(NO_STIFFNESS * most));
            if let Some(k) = floppy {
                return Err(NoBands::CellNotHeld(named(&basis, &eigen.eigenvectors.column(k).into_owned())));
            }
            // Downhill where the energy is no valley.
            let along = eigen.eigenvectors.tr_mul(&force).component_div(&eigen.eigenvalues.abs());
            let mut step = -(&eigen.eigenvectors * along);
            let size = step.norm();
            if size > LONGEST {
                step *= LONGEST / size;
            }
            if size <= SMALL || (size < 1e-9 && size >= 0.5 * last) {
                return match eigen.eigenvalues.iter().position(|value| *value < 0.0) {
                    // A step of differences is off by a small part of itself.
                    None => Ok((cell, gradient(&x), 2.0 * size + SMALL)),
                    Some(k) => Err(NoBands::CellNotHeld(named(&basis, &eigen.eigenvectors.column(k).into_owned()))),
                };
            }
            last = size;
            // A cell in which bodies overlap, or do not come to rest, is too far away.
            let mut halvings = 0;
            (cell, force) = loop {
                let next = &x + &step;
                match cell.left(&gradient(&next), load, &basis, contractions) {
                    Ok(found) => {
                        x = next;
                        break found;
                    }
                    Err(NoBands::Rest(reason)) if reason != NoRest::Interrupted && halvings < MOST_HALVINGS => {
                        step *= 0.5
                    }
                    Err(error) => return Err(error),
                }
                halvings += 1;
            };
        }
        Err(NoBands::CellNotFound(last))
    }

    /// What the vectors' search of their rest leaves open of the matrices at a deformation.
    ///
    /// # Errors
    /// [`NoBands`].
    pub fn doubt(&self, gradient: &Mat3) -> Result<MatrixDoubt, NoBands> {
        let mut doubt = MatrixDoubt::default();
        if self.unsettled() == 0.0 {
            return Ok(doubt);
        }
        let (here, waves) = self.at(gradient)?;
        for basis in components(self.written()) {
            let (_, beside) = here.at(&(gradient + PROBE * basis))?;
            let apart = beside.distances(&waves).map(|apart| apart * self.unsettled() / PROBE);
            doubt = doubt.with(MatrixDoubt::of(apart));
        }
        Ok(doubt)
    }

    /// ∂(E − Ω₀ S̄·F̄)/∂F̄ or ∂(E + pΩ)/∂F̄ along each component [J].
    fn left(
        &self,
        gradient: &Mat3,
        load: CellLoad,
        basis: &[Mat3],
        contractions: Contractions,
    ) -> Result<(Self, DVector<f64>), NoBands> {
        let (cell, forces) = match contractions {
            Contractions::Held => self.held_at(gradient)?,
            Contractions::Settle => {
                let (cell, waves) = self.at(gradient)?;
                (cell, waves.rest().force.clone())
            }
        };
        let written = self.written();
        let vectors = written.vectors();
        let deformed = written.deformed(gradient);
        let dual = deformed.reciprocal();
        let along = |basis: &Mat3| {
            let own: f64 = forces.iter().zip(vectors).map(|(force, vector)| force.dot(&(basis * vector))).sum();
            match load {
                CellLoad::Stress(stress) => own - written.volume() * stress.dot(basis),
                CellLoad::Pressure(pressure) => {
                    let grows: f64 = dual.iter().zip(vectors).map(|(dual, vector)| dual.dot(&(basis * vector))).sum();
                    own + pressure * deformed.volume() * grows / TAU
                }
            }
        };
        Ok((cell, DVector::from_iterator(basis.len(), basis.iter().map(along))))
    }
}

/// An orthonormal basis of the symmetric F̄ that cell vectors feel and their span keeps.
fn components(lattice: &Lattice) -> Vec<Mat3> {
    let mut axes: Vec<Vec3> = Vec::new();
    // Axes of space where they lie in the span: components then have their names.
    for axis in [Vec3::x(), Vec3::y(), Vec3::z()].iter().chain(lattice.vectors()) {
        let span: Vec<Vec3> = lattice.reciprocal();
        let within = |vector: &Vec3| -> Vec3 {
            lattice.vectors().iter().zip(&span).map(|(a, b)| a * (b.dot(vector) / TAU)).sum()
        };
        let inside = within(axis);
        let left = axes.iter().fold(inside, |left, unit: &Vec3| left - unit * unit.dot(&left));
        let is_new = (inside - axis).norm() < 1e-12 * axis.norm() && left.norm() > 1e-9 * axis.norm();
        if is_new && axes.len() < lattice.vectors().len() {
            axes.push(left.normalize());
        }
    }
    let mut basis = Vec::new();
    for i in 0..axes.len() {
        for j in i..axes.len() {
            let product = axes[i] * axes[j].transpose();
            basis.push(if i == j { product } else { (product + product.transpose()) / std::f64::consts::SQRT_2 });
        }
    }
    basis
}

/// The component of F̄ that has most of a direction.
fn named(basis: &[Mat3], direction: &DVector<f64>) -> String {
    let strain: Mat3 = basis.iter().zip(direction.iter()).map(|(basis, x)| *x * basis).sum();
    let pairs = [(0, 0, "xx"), (1, 1, "yy"), (2, 2, "zz"), (0, 1, "xy"), (0, 2, "xz"), (1, 2, "yz")];
    let most = pairs.iter().fold(pairs[0], |most, next| {
        if strain[(next.0, next.1)].abs() > strain[(most.0, most.1)].abs() + 1e-9 { *next } else { most }
    });
    most.2.to_owned()
}
