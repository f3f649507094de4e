//! A body without inertia: the velocities at which everything that acts on it is in balance.
//!
//!   A(q, v, G) = λ Y,   tr(Ṗ P⁻¹) = θ,      q̇ = B(q) v,   Ġ = V_G G
//!
//! A are the accelerations that a body with inertia would have, which vanish when the loads do. They are linear in the velocities
//! v, and their matrix is that of the exact Jacobian. Where the pressure of an incompressible body keeps det P, A is
//! known but for a multiple λ of Y = P⁻ᵀJ⁻¹, and the growth θ of its volume takes the place of that equation (zero, or
//! that of a contraction that is prescribed). Differentiated as it stands, with the same matrix on the left, the balance gives
//!
//!   A_v δv − Y δλ = −A_q δq − A_G δG + λ δY,   P⁻ᵀ·δṖ = tr(Ṗ P⁻¹ δP P⁻¹)
//!
//! Masses only weigh the equations: nothing depends on them but the weight of the body. Source: `physics.md` §7.

use super::{ContractileMotion, Powers, Workspace, body_rates};
use crate::body::{Body, BodyKind};
use crate::contractile::Command;
use crate::inadmissible::{Inadmissible, Quantity};
use crate::jacobian::body_jacobian;
use crate::model::Model;
use crate::state::{BodyMotion, State};
use crate::tensor::Mat3;
use nalgebra::{DMatrix, SMatrix, SVector};

/// The most numbers that a body has, and the most velocities, with λ.
const NUMBERS: usize = 33;
const UNKNOWNS: usize = 13;

type Matrix = SMatrix<f64, UNKNOWNS, UNKNOWNS>;
type Vector = SVector<f64, UNKNOWNS>;

/// Scratch: the Jacobians of bodies with inertia, by their number of rows.
#[derive(Debug, Clone, Default)]
pub(crate) struct Settling {
    matrices: Vec<DMatrix<f64>>,
}

impl Settling {
    /// A matrix of so many rows, zero where no body of this size ever writes.
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

/// A body without inertia that has settled.
struct Settled {
    /// Places, velocities and contraction, as of a body with inertia.
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
    fn of(model: &Model, time: f64, (index, numbers): (usize, &[f64])) -> Result<Option<Self>, Inadmissible> {
        let body = &model.bodies[index];
        let Some(affine) = body.affine().filter(|affine| affine.interior.is_incompressible()) else { return Ok(None) };
        let motion = BodyMotion::unpack(body, numbers);
        let growth = match &body.kind {
            BodyKind::Contractile(contractile) => {
                if contractile.contraction.gives_pressure() {
                    return Ok(None);
                }
                let moving = ContractileMotion::new(index, contractile, (&motion, time, numbers))?;
                if let Command::Velocity(velocity, _) = moving.command(model) { velocity.trace() } else { 0.0 }
            }
            BodyKind::Affine(_) | BodyKind::Rigid(_) => 0.0,
        };
        let gradient = &motion.placement.gradient;
        let inverse = gradient.try_inverse().ok_or(Inadmissible {
            body: index,
            quantity: Quantity::Volume,
            value: gradient.determinant(),
        })?;
        Ok(Some(Self {
            inverse,
            mobility: affine.interior.inverse,
            way: inverse.transpose() * affine.interior.inverse,
            growth,
        }))
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
    fn new(body: &Body, jacobian: &DMatrix<f64>, kept: Option<&Kept>) -> Self {
        let parts = body.parts();
        let (at, count) = (parts.places, parts.velocities);
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

fn settle(
    model: &Model,
    workspace: &mut Workspace,
    time: f64,
    (index, block): (usize, &[f64]),
) -> Result<Settled, Inadmissible> {
    let body = &model.bodies[index];
    let parts = body.parts();
    let all = parts.all();
    let mut numbers = [0.0; NUMBERS];
    numbers[..parts.places].copy_from_slice(&block[..parts.places]);
    numbers[parts.places + parts.velocities..all].copy_from_slice(&block[parts.places..]);
    let moving = parts.places..parts.places + parts.velocities;
    let mut rates = [0.0; NUMBERS];
    body_rates(model, workspace, time, (index, &numbers[..all]), &mut rates[..all])?;
    let mut jacobian = workspace.settling.take(all);
    let filled = body_jacobian(model, workspace, time, (index, &numbers[..all]), &mut jacobian);
    let kept = Kept::of(model, time, (index, &numbers[..all]))?;
    let solver = Solver::new(body, &jacobian, kept.as_ref());
    workspace.settling.matrices.push(jacobian);
    filled?;
    let velocities = solver.velocities(&rates[moving.clone()], kept.as_ref().map_or(0.0, |kept| kept.growth));
    let velocities = velocities.ok_or_else(|| without_resistance(index))?;
    numbers[moving].copy_from_slice(&velocities.as_slice()[..parts.velocities]);
    let done = body_rates(model, workspace, time, (index, &numbers[..all]), &mut rates[..all])?;
    Ok(Settled { numbers, rates, done })
}

/// Fills the rates of the block of a body without inertia.
pub(super) fn fill(
    model: &Model,
    workspace: &mut Workspace,
    time: f64,
    (index, block): (usize, &[f64]),
    rates: &mut [f64],
) -> Result<Powers, Inadmissible> {
    let parts = model.bodies[index].parts();
    let settled = settle(model, workspace, time, (index, block))?;
    rates[..parts.places].copy_from_slice(&settled.rates[..parts.places]);
    rates[parts.places..].copy_from_slice(&settled.rates[parts.places + parts.velocities..parts.all()]);
    Ok(settled.done)
}

/// The motion of a body in a state; of one without inertia with the velocities that its balance gives.
///
/// # Errors
/// [`Inadmissible`] where the state is outside the model.
pub fn settled_motion(
    model: &Model,
    workspace: &mut Workspace,
    state: &State,
    index: usize,
) -> Result<BodyMotion, Inadmissible> {
    let body = &model.bodies[index];
    if body.has_inertia() {
        return Ok(state.motion(model, index));
    }
    let block = &state.bodies[model.blocks()[index].clone()];
    let settled = settle(model, workspace, state.time, (index, block))?;
    Ok(BodyMotion::unpack(body, &settled.numbers[..body.parts().all()]))
}

/// Fills the derivatives of the rates of the block of a body without inertia.
pub(crate) fn settled_slopes(
    model: &Model,
    workspace: &mut Workspace,
    time: f64,
    (index, block): (usize, &[f64]),
    matrix: &mut DMatrix<f64>,
) -> Result<(), Inadmissible> {
    let body = &model.bodies[index];
    let parts = body.parts();
    let settled = settle(model, workspace, time, (index, block))?;
    let numbers = &settled.numbers[..parts.all()];
    let mut jacobian = workspace.settling.take(parts.all());
    let filled = body_jacobian(model, workspace, time, (index, numbers), &mut jacobian);
    let kept = Kept::of(model, time, (index, numbers))?;
    let solver = Solver::new(body, &jacobian, kept.as_ref());
    let solved = filled.and_then(|()| {
        let columns = Columns { body, settled: &settled, jacobian: &jacobian, kept: kept.as_ref() };
        columns.fill(&solver, matrix).ok_or_else(|| without_resistance(index))
    });
    workspace.settling.matrices.push(jacobian);
    solved
}

/// What the columns of the derivative are made of.
struct Columns<'a> {
    body: &'a Body,
    settled: &'a Settled,
    jacobian: &'a DMatrix<f64>,
    kept: Option<&'a Kept>,
}

impl Columns<'_> {
    /// Writes them; none if the balance cannot be solved.
    fn fill(&self, solver: &Solver, matrix: &mut DMatrix<f64>) -> Option<()> {
        let parts = self.body.parts();
        let places = parts.places;
        for column in 0..places + parts.further {
            // The column of the same number of a body with inertia.
            let from = if column < places { column } else { column + parts.velocities };
            let mut loads = [0.0; UNKNOWNS];
            for (k, load) in loads.iter_mut().enumerate().take(parts.velocities) {
                *load = self.jacobian[(places + k, from)];
            }
            let growth = self.turn_constraint(column, &mut loads);
            let change = solver.velocities(&loads[..parts.velocities], growth)?;
            for row in 0..places + parts.further {
                let into = if row < places { row } else { row + parts.velocities };
                let through: f64 = (0..parts.velocities).map(|k| self.jacobian[(into, places + k)] * change[k]).sum();
                matrix[(row, column)] = self.jacobian[(into, from)] + through;
            }
        }
        Some(())
    }

    /// Takes −λ δY to the loads, and gives the change of θ − tr(Ṗ P⁻¹) at a Ṗ that is kept.
    fn turn_constraint(&self, column: usize, loads: &mut [f64; UNKNOWNS]) -> f64 {
        let parts = self.body.parts();
        let first = parts.places - 9.min(parts.places);
        let Some(kept) = self.kept.filter(|_| (first..parts.places).contains(&column)) else { return 0.0 };
        let Settled { numbers, rates, .. } = self.settled;
        let at = parts.places + parts.velocities - 9;
        let (rate, acceleration) = (matrix_at(numbers, at), matrix_at(rates, at));
        let (row, place) = ((column - first) % 3, (column - first) / 3);
        // δP = e_j ⊗ e_B: δ(P⁻ᵀ) = −P⁻ᵀ δPᵀ P⁻ᵀ.
        let inverse = &kept.inverse;
        let turned = -(inverse.row(place).transpose() * inverse.column(row).transpose());
        let lambda = kept.multiplier(&acceleration);
        let change = turned * kept.mobility;
        for k in 0..9 {
            loads[parts.velocities - 9 + k] -= lambda * change[k];
        }
        -rate.dot(&turned)
    }
}

fn matrix_at(numbers: &[f64], at: usize) -> Mat3 {
    Mat3::from_column_slice(&numbers[at..at + 9])
}
