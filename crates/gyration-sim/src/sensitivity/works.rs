//! The works of the ledger beside S, and what both do at an instant at which the rates jump and that moves with the
//! number.
//!
//!   W′ = ∂g/∂y S + ∂g/∂p,      S⁺ = S⁻ + (f⁻ − f⁺) dt/dp,   W⁺ = W⁻ + (g⁻ − g⁺) dt/dp
//!
//! Powers g have no exact derivative at hand: they are differentiated along S by differences, between states that have
//! the same formulas. Where an impact comes earlier or later S is mostly a shift of the motion in time, σ f, and what
//! that does to W cancels over the impact but for a millionth. It is taken out of S, a σ for each step:
//!
//!   ∫ ∂g/∂y S dt = σ [g] + ∫ (∂g/∂y (S − σ f) − σ ∂g/∂t) dt

use super::collocation::CollocationStep;
use super::kinks::ends_at_kink;
use super::last_powers::WorkSlopes;
use super::probe::{along, gone, in_time, reason};
use super::tangent::{Followed, Nodes, Tangent};
use gyration::Inadmissible;
use gyration::state::State;
use gyration_ode::{Extended, Integrator, System as _};
use nalgebra::DMatrix;

/// How far from a kink the rates on its sides are taken, as a part of its time: some roundings of it.
const BESIDE: f64 = 16.0 * f64::EPSILON;
/// A column is mostly a shift in time if so much of its square is.
const MOSTLY: f64 = 0.9;
/// How far from the ends of a step, which may miss a kink by roundings, as a part of their time.
const ASIDE: f64 = 128.0 * f64::EPSILON;

/// The rates of a state and its powers.
struct Flow {
    rates: Vec<f64>,
    powers: Vec<f64>,
}

impl Tangent<'_> {
    /// How the works change over a step; none where a formula goes over to another so near to a node that no difference
    /// can be taken.
    pub(super) fn powers(
        &mut self,
        step: &CollocationStep,
        nodes: &Nodes,
        size: f64,
    ) -> Result<Option<WorkSlopes>, Inadmissible> {
        let start = self.powers_at_start()?;
        let mut found = WorkSlopes { nodes: nodes.powers.clone(), shifted: DMatrix::zeros(0, 0), end: Vec::new() };
        let mut shifts = vec![0.0; self.columns.len()];
        for (node, (powers, state)) in found.nodes.iter_mut().zip(&nodes.states).enumerate() {
            let sides = self.sides(state)?;
            let flow = self.flow(state)?;
            // A step has one σ; powers on the two sides of a switch do not join.
            if node == 0 && sides.is_empty() {
                let columns = self.columns.iter().zip(step.values[node].column_iter());
                for (shift, (followed, values)) in shifts.iter_mut().zip(columns) {
                    // Where kinks move, ∂g/∂p is itself a shift in time, and the two cancel already.
                    if !matches!(followed, Ok(Followed::Number(number)) if number.1.move_any()) {
                        *shift = self.shift(values.as_slice(), &flow.rates);
                    }
                }
            }
            let is_shifted = shifts.iter().any(|shift| *shift != 0.0);
            let in_time = if is_shifted { self.powers_in_time(state, size)? } else { Vec::new() };
            for column in 0..self.columns.len() {
                if self.columns[column].is_err() {
                    continue;
                }
                let shift = shifts[column];
                let values = step.values[node].column(column);
                let direction: Vec<f64> = values.iter().zip(&flow.rates).map(|(s, rate)| s - shift * rate).collect();
                let Some(through) = self.powers_along(state, &sides, &direction)? else { return Ok(None) };
                through.iter().enumerate().for_each(|(row, value)| powers[(row, column)] += value);
                in_time.iter().enumerate().for_each(|(row, value)| powers[(row, column)] -= shift * value);
            }
        }
        if let Some(end) = nodes.states.last() {
            found.end = self.powers_beside(end, -1.0)?;
        }
        let gained = |row: usize| found.end[row] - start[row];
        found.shifted = DMatrix::from_fn(self.works.nrows(), self.works.ncols(), |row, column| {
            shifts.get(column).map_or(0.0, |shift| shift * gained(row))
        });
        Ok(Some(found))
    }

    /// σ: by how much a column is a shift of the motion in time; nothing where it is mostly none.
    fn shift(&self, direction: &[f64], rates: &[f64]) -> f64 {
        let product = |a: &[f64], b: &[f64]| {
            a.iter().zip(b).zip(&self.scales).map(|((a, b), scale)| (a / scale) * (b / scale)).sum::<f64>()
        };
        let (along, whole, square) = (product(direction, rates), product(direction, direction), product(rates, rates));
        if along * along > MOSTLY * whole * square { along / square } else { 0.0 }
    }

    /// g at the beginning of a step, behind what is not smooth there: that at the end of the step before if that is
    /// known, so that what is taken off here and put on there is the same to the last digit.
    fn powers_at_start(&mut self) -> Result<Vec<f64>, Inadmissible> {
        if let Some(powers) = self.last_powers.at(self.time) {
            return Ok(powers.to_vec());
        }
        self.look_at(self.time, 0.0);
        let state = self.at.clone();
        self.powers_beside(&state, 1.0)
    }

    /// g at a state a little later or earlier, so that a kink lies on the other side.
    fn powers_beside(&mut self, state: &State, side: f64) -> Result<Vec<f64>, Inadmissible> {
        let time = state.time + side * ASIDE * state.time.abs();
        Ok(self.flow(&State { time, ..state.clone() })?.powers)
    }

    fn flow(&mut self, state: &State) -> Result<Flow, Inadmissible> {
        let mut flow = Flow { rates: vec![0.0; state.bodies.len()], powers: vec![0.0; state.works.len()] };
        let y = Extended { high: &state.bodies, low: &state.low };
        self.system.extended_rates(state.time, y, &mut flow.rates, &mut flow.powers)?;
        Ok(flow)
    }

    /// ∂g/∂t at a state within a step of this size, by neighbours that are no later: it may end at a kink.
    fn powers_in_time(&mut self, state: &State, size: f64) -> Result<Vec<f64>, Inadmissible> {
        let found = in_time(size, |part| match part > 0.0 {
            true => Err(None),
            false => Ok(self.flow(&State { time: state.time + part, ..state.clone() }).map_err(Some)?.powers),
        });
        found.or_else(|left| left.map_or(Ok(vec![0.0; self.works.nrows()]), Err))
    }

    /// ∂g/∂y along a direction of a state, by neighbours on its sides of all switching functions; none if none is found
    /// there.
    fn powers_along(
        &mut self,
        state: &State,
        sides: &[f64],
        direction: &[f64],
    ) -> Result<Option<Vec<f64>>, Inadmissible> {
        let scales = self.scales.clone();
        let found = along(direction, &scales, |part| {
            let [bodies, low] = gone(state, direction, part);
            let there = State { bodies, low, ..state.clone() };
            if self.are_beyond(sides, there.time, &there.bodies).map_err(Some)? {
                return Err(None);
            }
            Ok(self.flow(&there).map_err(Some)?.powers)
        });
        match found {
            Ok(powers) => Ok(Some(powers)),
            Err(None) => Ok(None),
            Err(Some(left)) => Err(left),
        }
    }

    /// Comes to the end of a step of the run that ends at a kink, and over it.
    pub fn cross(&mut self, run: &Integrator, from: f64) {
        if !ends_at_kink(self.model, from, run.time()) {
            return;
        }
        self.reach(run.time());
        self.last_powers.forget();
        let moves = self.columns.iter().any(|followed| match followed {
            Ok(Followed::Number(number)) => number.1.has_come(self.time),
            Ok(Followed::Direction) | Err(_) => false,
        });
        if moves {
            self.look(run);
            if let Err(left) = self.jump() {
                self.lose_all(reason(self.model, self.time, &left));
            }
        }
    }

    fn jump(&mut self) -> Result<(), Inadmissible> {
        for (column, followed) in self.columns.iter_mut().enumerate() {
            let Ok(Followed::Number(number)) = followed else { continue };
            let Some(kink) = number.1.come_to(self.time) else { continue };
            let n = self.at.bodies.len();
            let mut sides =
                [-1.0, 1.0].map(|side| (kink.time + side * BESIDE * kink.time, vec![0.0; n + self.works.nrows()]));
            for (time, values) in &mut sides {
                let (slopes, powers) = values.split_at_mut(n);
                self.system.rates(*time, &self.at.bodies, slopes, powers)?;
            }
            let [before, after] = sides.map(|(_, values)| values);
            let jump = |i: usize| (before[i] - after[i]) * kink.moves;
            (0..n).for_each(|row| self.state[(row, column)] += jump(row));
            (0..self.works.nrows()).for_each(|row| self.works[(row, column)] += jump(n + row));
        }
        Ok(())
    }
}
