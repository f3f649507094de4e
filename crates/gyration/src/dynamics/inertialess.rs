//! A body without inertia: the velocities at which everything that acts on it is in balance.
//!
//!   A(q, v, G) = λ Y,   tr(Ṗ P⁻¹) = θ,      q̇ = B(q) v,   Ġ = V_G G
//!
//! A are the accelerations that a body with inertia would have, which vanish when the loads do. They are linear in the
//! velocities v, and their matrix is that of the exact Jacobian. Where the pressure of an incompressible body keeps det
//! P, A is known but for a multiple λ of Y = P⁻ᵀJ⁻¹, and the growth θ of its volume takes the place of that equation
//! (zero, or that of a contraction that is prescribed). Differentiated as it stands, with the same matrix on the left,
//! the balance gives
//!
//!   A_v δv − Y δλ = −A_q δq − A_G δG + λ δY,   P⁻ᵀ·δṖ = tr(Ṗ P⁻¹ δP P⁻¹)
//!
//! Masses only weigh the equations: nothing depends on them but the weight of the body. Source: `docs/theory-fluid.md`.

use super::Scratch;
use super::body_rates::body_rates;
use super::contractile::ContractileMotion;
use super::jacobian::{Blocks, add_interactions, body_jacobian};
use super::powers::Powers;
use crate::body::{Slots, matrix};
use crate::contractile::ContractionCommand;
use crate::inadmissible::{Inadmissible, Quantity};
use crate::instant::{BodyAt, Instant, KindAt, MotionAt};
use crate::tensor::Mat3;
use nalgebra::{DMatrix, SMatrix, SVector};

/// The most numbers that a body has, and the most velocities, with λ.
const NUMBERS: usize = 33;
const UNKNOWNS: usize = 13;

type Matrix = SMatrix<f64, UNKNOWNS, UNKNOWNS>;
type Vector = SVector<f64, UNKNOWNS>;

impl Scratch {
    /// A matrix of zeros of so many rows.
    fn take(&mut self, size: usize) -> DMatrix<f64> {
        match self.matrices.iter().position(|matrix| matrix.nrows() == size) {
            Some(place) => {
                let mut matrix = self.matrices.swap_remove(place);
                matrix.fill(0.0);
                matrix
            }
            None => DMatrix::zeros(size, size),
        }
    }
}

/// A body without inertia at the velocities of its balance.
pub(super) struct Settled {
    /// Where its numbers stand, as of a body with inertia.
    slots: Slots,
    /// Places, velocities and contraction.
    numbers: [f64; NUMBERS],
    /// Their rates: those of the velocities are λ Y.
    rates: [f64; NUMBERS],
    done: Powers,
}

/// What keeps the volume of an incompressible body, in the place of an equation of motion.
struct Kept {
    /// P⁻¹.
    inverse: Mat3,
    /// J⁻¹.
    mobility: Mat3,
    /// Y.
    way: Mat3,
    /// θ [1/s].
    growth: f64,
}

impl Kept {
    /// None where the volume is free, or where the law of contraction gives the pressure.
    fn of(at: &MotionAt) -> Option<Self> {
        let (affine, gyration, growth) = match at.kind() {
            KindAt::Rigid(..) => return None,
            KindAt::Affine(affine, gyration) => (affine, gyration, 0.0),
            KindAt::Contractile(contractile, gyration, decomposition) => {
                if contractile.contraction.gives_pressure() {
                    return None;
                }
                let moving = ContractileMotion { at, contractile, gyration, decomposition };
                let growth = if let ContractionCommand::Velocity(velocity, _) = moving.command() {
                    velocity.trace()
                } else {
                    0.0
                };
                (&contractile.affine, gyration, growth)
            }
        };
        if !affine.interior.is_incompressible() {
            return None;
        }
        let (inverse, mobility) = (gyration.inverse, affine.interior.inverse);
        Some(Self { inverse, mobility, way: inverse.transpose() * mobility, growth })
    }

    /// λ of the accelerations P̈ at balance.
    fn multiplier(&self, acceleration: &Mat3) -> f64 {
        acceleration.dot(&self.inverse.transpose()) / self.way.dot(&self.inverse.transpose())
    }
}

/// The matrix of the balance, factorised, with the constraint in the last row and column.
struct Solver {
    factors: nalgebra::LU<f64, nalgebra::Const<UNKNOWNS>, nalgebra::Const<UNKNOWNS>>,
    /// By what the constraint is weighed, so that pivots compare like with like.
    weight: f64,
}

impl Solver {
    fn new(slots: &Slots, jacobian: &DMatrix<f64>, kept: Option<&Kept>) -> Self {
        let (at, count) = (slots.velocities().start, slots.velocities().len());
        let mut matrix = Matrix::identity();
        matrix.view_mut((0, 0), (count, count)).copy_from(&jacobian.view((at, at), (count, count)));
        let mut weight = 1.0;
        if let Some(kept) = kept {
            let first = count - 9;
            let size = matrix.view((0, 0), (count, count)).amax();
            weight = size / kept.inverse.amax();
            let push = size / kept.way.amax();
            matrix[(UNKNOWNS - 1, UNKNOWNS - 1)] = 0.0;
            let across = kept.inverse.transpose();
            for k in 0..9 {
                matrix[(first + k, UNKNOWNS - 1)] = -push * kept.way[k];
                matrix[(UNKNOWNS - 1, first + k)] = weight * across[k];
            }
        }
        Self { factors: matrix.lu(), weight }
    }

    /// The velocities, or their change, at which the accelerations cancel `loads` and the volume grows by `growth`.
    fn velocities(&self, loads: &[f64], growth: f64) -> Option<Vector> {
        let mut side = Vector::zeros();
        for (out, load) in side.iter_mut().zip(loads) {
            *out = -load;
        }
        side[UNKNOWNS - 1] = self.weight * growth;
        self.factors.solve(&side)
    }
}

/// The body would move for nothing: its resistance cannot be inverted.
fn without_resistance(index: usize) -> Inadmissible {
    Inadmissible { body: index, quantity: Quantity::Resistance, value: 0.0 }
}

/// Gives a body of an instant the velocities of its balance.
///
/// # Errors
/// [`Inadmissible`] where the state is outside the model, or where nothing resists the motion.
pub(super) fn solve_balance(
    instant: &mut Instant,
    scratch: &mut Scratch,
    index: usize,
) -> Result<Settled, Inadmissible> {
    let at = instant.at(index);
    let model = at.model;
    let slots = Slots::with_inertia(at.body, 0);
    let mut numbers = [0.0; NUMBERS];
    numbers[slots.places()].copy_from_slice(&instant.state()[model.slots(index).places()]);
    numbers[slots.extra()].copy_from_slice(&instant.state()[model.slots(index).extra()]);
    let mut rates = [0.0; NUMBERS];
    body_rates(&at, &slots, scratch, &mut rates)?;
    let kept = Kept::of(&at);
    let mut jacobian = scratch.take(slots.block().len());
    let filled = body_jacobian(&at, scratch, &mut jacobian);
    let solver = Solver::new(&slots, &jacobian, kept.as_ref());
    scratch.matrices.push(jacobian);
    filled?;
    let growth = kept.as_ref().map_or(0.0, |kept| kept.growth);
    let velocities = solver.velocities(&rates[slots.velocities()], growth).ok_or_else(|| without_resistance(index))?;
    numbers[slots.velocities()].copy_from_slice(&velocities.as_slice()[..slots.velocities().len()]);
    instant.set_motion(index, &slots, &numbers)?;
    let done = body_rates(&instant.at(index), &slots, scratch, &mut rates)?;
    Ok(Settled { slots, numbers, rates, done })
}

/// Fills the rates of a body without inertia.
pub(super) fn fill(
    instant: &mut Instant,
    scratch: &mut Scratch,
    index: usize,
    rates: &mut [f64],
) -> Result<Powers, Inadmissible> {
    let Settled { slots: from, rates: found, done, .. } = solve_balance(instant, scratch, index)?;
    let slots = instant.model().slots(index);
    rates[slots.places()].copy_from_slice(&found[from.places()]);
    rates[slots.extra()].copy_from_slice(&found[from.extra()]);
    Ok(done)
}

/// Fills the derivatives of the rates of a body without inertia, by its own numbers and by those of bodies to which
/// springs join it.
pub(super) fn fill_jacobian(
    instant: &mut Instant,
    scratch: &mut Scratch,
    index: usize,
    blocks: &mut (impl Blocks + ?Sized),
) -> Result<(), Inadmissible> {
    let settled = solve_balance(instant, scratch, index)?;
    let at = instant.at(index);
    let mut jacobian = scratch.take(settled.slots.block().len());
    let filled = body_jacobian(&at, scratch, &mut jacobian);
    let kept = Kept::of(&at);
    let solver = Solver::new(&settled.slots, &jacobian, kept.as_ref());
    let columns = Columns { settled: &settled, jacobian: &jacobian, kept: kept.as_ref() };
    let solved = filled.and_then(|()| {
        let own = blocks.block(index, index).map_or(Some(()), |matrix| columns.fill(&solver, matrix));
        own.ok_or_else(|| without_resistance(index))?;
        columns.add_interactions(&at, &solver, blocks)
    });
    scratch.matrices.push(jacobian);
    solved
}

/// What the columns of the derivative are made of.
struct Columns<'a> {
    settled: &'a Settled,
    jacobian: &'a DMatrix<f64>,
    kept: Option<&'a Kept>,
}

impl Columns<'_> {
    /// Adds those by the numbers of bodies to which springs join this one: their forces change its accelerations, and
    /// so the velocities of its balance.
    fn add_interactions(
        &self,
        at: &BodyAt,
        solver: &Solver,
        blocks: &mut (impl Blocks + ?Sized),
    ) -> Result<(), Inadmissible> {
        let slots = &self.settled.slots;
        let velocities = slots.velocities();
        let mut solved = Some(());
        add_interactions(at, |other, coupling, lower, lift| {
            let Some(matrix) = blocks.block(at.index, other) else { return };
            // A dashpot would make velocities follow velocities; there is none, and places alone enter.
            for column in 0..at.model.slots(other).places().len() {
                let loads = coupling.by_place(lower, lift, column);
                let change = solver.velocities(&loads.as_slice()[..velocities.len()], 0.0);
                let Some(change) = change else { return solved = None };
                for (row, into) in slots.places().chain(slots.extra()).enumerate() {
                    let along = velocities.clone().zip(change.iter());
                    let through: f64 = along.map(|(velocity, change)| self.jacobian[(into, velocity)] * change).sum();
                    matrix[(row, column)] += through;
                }
            }
        })?;
        solved.ok_or_else(|| without_resistance(at.index))
    }

    /// Writes them; none if the balance cannot be solved.
    fn fill(&self, solver: &Solver, matrix: &mut DMatrix<f64>) -> Option<()> {
        let slots = &self.settled.slots;
        let velocities = slots.velocities();
        // The numbers that are state, where they stand in the block of a body with inertia.
        let kept = || slots.places().chain(slots.extra()).enumerate();
        for (column, from) in kept() {
            let mut loads = [0.0; UNKNOWNS];
            for (load, row) in loads.iter_mut().zip(velocities.clone()) {
                *load = self.jacobian[(row, from)];
            }
            let growth = self.turn_constraint(column, &mut loads);
            let change = solver.velocities(&loads[..velocities.len()], growth)?;
            for (row, into) in kept() {
                let along = velocities.clone().zip(change.iter());
                let through: f64 = along.map(|(velocity, change)| self.jacobian[(into, velocity)] * change).sum();
                matrix[(row, column)] = self.jacobian[(into, from)] + through;
            }
        }
        Some(())
    }

    /// Takes −λ δY to the loads, and gives the change of θ − tr(Ṗ P⁻¹) at a Ṗ that is kept.
    fn turn_constraint(&self, column: usize, loads: &mut [f64; UNKNOWNS]) -> f64 {
        let Settled { slots, numbers, rates, .. } = self.settled;
        let Some(kept) = self.kept.filter(|_| slots.attitude().contains(&column)) else { return 0.0 };
        let (rate, acceleration) = (matrix(&numbers[slots.rate()]), matrix(&rates[slots.rate()]));
        let entry = column - slots.attitude().start;
        let (row, place) = (entry % 3, entry / 3);
        // δP = e_j ⊗ e_B: δ(P⁻ᵀ) = −P⁻ᵀ δPᵀ P⁻ᵀ.
        let inverse = &kept.inverse;
        let turned = -(inverse.row(place).transpose() * inverse.column(row).transpose());
        let lambda = kept.multiplier(&acceleration);
        let change = turned * kept.mobility;
        let first = slots.velocity().len();
        for (load, change) in loads[first..].iter_mut().zip(change.iter()) {
            *load -= lambda * change;
        }
        -rate.dot(&turned)
    }
}
