//! The works of the ledger beside S, and what both do at an instant at which the rates jump and that moves with the
//! number.
//!
//!   W′ = ∂g/∂y S + ∂g/∂p,      S⁺ = S⁻ + (f⁻ − f⁺) dt/dp,   W⁺ = W⁻ + (g⁻ − g⁺) dt/dp
//!
//! Powers g have no exact derivative at hand: they are differentiated along S by differences, between states that have
//! the same formulas.

use super::collocation::CollocationStep;
use super::kinks::ends_at_kink;
use super::probe::{along, reason};
use super::tangent::{Followed, Nodes, Tangent};
use gyration::Inadmissible;
use gyration::state::State;
use gyration_ode::{Integrator, System as _};
use nalgebra::DMatrix;

/// How far from a kink the rates on its sides are taken, as a part of its time: some roundings of it.
const BESIDE: f64 = 16.0 * f64::EPSILON;

impl Tangent<'_> {
    /// W′ at the nodes of a step, a column for each number; none where a formula goes over to another so near to a node
    /// that no difference can be taken.
    pub(super) fn powers(
        &mut self,
        step: &CollocationStep,
        nodes: &Nodes,
    ) -> Result<Option<Vec<DMatrix<f64>>>, Inadmissible> {
        let mut all = nodes.powers.clone();
        for (node, (powers, state)) in all.iter_mut().zip(&nodes.states).enumerate() {
            let sides = self.sides(state)?;
            for column in 0..self.columns.len() {
                if self.columns[column].is_err() {
                    continue;
                }
                let direction: Vec<f64> = step.values[node].column(column).iter().copied().collect();
                let Some(through) = self.powers_along(state, &sides, &direction)? else { return Ok(None) };
                through.iter().enumerate().for_each(|(row, value)| powers[(row, column)] += value);
            }
        }
        Ok(Some(all))
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
            let (mut rates, mut powers) = (vec![0.0; state.bodies.len()], vec![0.0; state.works.len()]);
            let bodies: Vec<f64> = state.bodies.iter().zip(direction).map(|(y, s)| y + part * s).collect();
            if self.are_beyond(sides, state.time, &bodies).map_err(Some)? {
                return Err(None);
            }
            self.system.rates(state.time, &bodies, &mut rates, &mut powers).map_err(Some)?;
            Ok(powers)
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
