//! A start that is tried: its run over a period, the derivative of that, and Newton's step from it.

use super::chart::{Chart, align, change};
use super::choice::value;
use super::{Choice, NoOrbit, OrbitSearch};
use crate::adapter::Tolerance;
use crate::plan::RunPlan;
use crate::sensitivity::{Flow, NoFlow, each_state};
use crate::singular_values::SingularValues;
use gyration::model::Model;
use gyration::state::State;
use gyration_ode::{ImplicitOrder, Options};
use nalgebra::{DMatrix, DVector};

/// The tolerance of its runs, if that of the scene is not smaller; of a motion that goes less far than its bodies are
/// long that part of it.
const RTOL: f64 = 1e-12;
/// It is no less than that.
const LEAST_RTOL: f64 = 1e-15;
/// A motion that goes less far is rest, in scales.
const REST: f64 = 1e-14;
/// Singular values below this part of the largest determine nothing.
const UNDETERMINED: f64 = 1e-8;
/// A quantity is varied by this part of the scales.
const PROBE: f64 = 1e-5;

/// A start that is tried, with what comes of it.
pub(super) struct Trial {
    pub(super) start: State,
    pub(super) period: f64,
    /// S⁻¹ ∂φ_T/∂y₀ in coordinates.
    pub(super) derivative: DMatrix<f64>,
    /// S⁻¹ y(T) − y₀ in coordinates, and ẏ at both.
    gap: DVector<f64>,
    rates: [DVector<f64>; 2],
    /// What is left, and how far the motion goes, in scales.
    pub(super) misfit: f64,
    pub(super) extent: f64,
    pub(super) chart: Chart,
}

impl Trial {
    pub(super) fn of(search: &OrbitSearch<'_>, start: State, period: f64) -> Result<Self, NoOrbit> {
        let OrbitSearch { model, plan, .. } = *search;
        let mut start = State { time: 0.0, ..start };
        let mut chart = Chart::about(model, &start, period)?;
        if chart.directions().is_empty() {
            return Err(NoOrbit::NothingMoves);
        }
        chart.project(&mut start);
        let mut extent = 0.0_f64;
        let lost = |error: NoFlow| NoOrbit::Flow { period, reason: error.to_string() };
        each_state(model, &start, &RunPlan { end: period, ..*plan }, |state| {
            extent = extent.max(chart.size(&change(model, &start, state)));
        })
        .map_err(lost)?;
        if extent < REST {
            return Err(NoOrbit::AtRest);
        }
        let rtol = plan.tolerance.rtol.min((RTOL * extent.min(1.0)).max(LEAST_RTOL));
        let tolerance = Tolerance { rtol, atol: plan.tolerance.atol.min(rtol) };
        let options = Options { order: ImplicitOrder::at_tolerance(tolerance.rtol), ..plan.options };
        let plan = RunPlan { end: period, tolerance, options, ..*plan };
        let flow = Flow::of(model, &start, &plan, &chart.directions());
        let flow = flow.map_err(lost)?;
        let end = search.back(&flow.end);
        let mut derivative = match &search.shift {
            None => flow.derivative,
            Some(shift) => shift.rows_back(&flow.derivative),
        };
        align(model, &start, &end, &mut derivative);
        let left = change(model, &start, &end);
        let column = |change: &DVector<f64>, chart: &Chart| {
            chart.coordinates(&DMatrix::from_column_slice(change.len(), 1, change.as_slice())).column(0).into_owned()
        };
        let first = chart.rates(0.0, &start)?;
        let mut last = DMatrix::from_column_slice(first.len(), 1, chart.rates(period, &end)?.as_slice());
        align(model, &start, &end, &mut last);
        let rates = [column(&first, &chart), column(&last.column(0).into_owned(), &chart)];
        Ok(Self {
            misfit: chart.size(&left),
            gap: column(&left, &chart),
            derivative: chart.coordinates(&derivative),
            rates,
            extent,
            start,
            period,
            chart,
        })
    }

    /// By what it is no orbit: the misfit as a part of how far it goes, and what it is chosen by.
    pub(super) fn missed(&self, off: f64) -> f64 {
        self.misfit / self.extent + off.abs()
    }

    /// Newton's step of coordinates, in scales, and period, as a part of it.
    pub(super) fn step(
        &mut self,
        model: &Model,
        choice: &Choice<'_>,
        driven: bool,
        off: f64,
    ) -> Result<DVector<f64>, NoOrbit> {
        let d = self.gap.len();
        let mut equations = DMatrix::zeros(d + 2, d + 1);
        let mut right = DVector::zeros(d + 2);
        equations.view_mut((0, 0), (d, d)).copy_from(&(&self.derivative - DMatrix::identity(d, d)));
        right.rows_mut(0, d).copy_from(&-&self.gap);
        let size = self.rates[0].norm();
        if !driven && size > 0.0 {
            equations.view_mut((d, 0), (1, d)).copy_from(&(self.rates[0].transpose() / size));
        }
        // The last unknown counts as how far the end moves with the period, and what an orbit is chosen by as how far a
        // start must move: all equations then are of one size, however short the path.
        let moves = self.period * self.rates[1].norm();
        if !matches!(choice, Choice::Period) && moves > 0.0 {
            equations.view_mut((0, d), (d, 1)).copy_from(&self.rates[1].normalize());
        }
        match choice {
            Choice::Period | Choice::Alone => {}
            Choice::Energy(_) | Choice::Quantity(..) => {
                let slope = self.slope(model, choice)?;
                let steepness = slope.norm();
                if steepness > 0.0 {
                    equations.view_mut((d + 1, 0), (1, d)).copy_from(&(slope.transpose() / steepness));
                    right[d + 1] = -off / steepness;
                }
            }
        }
        let found = SingularValues::of(&equations).ok_or(NoOrbit::NotComputed("step"))?;
        let mut step = found.solve(&right, UNDETERMINED * found.largest());
        // A part of the period.
        step[d] = if moves > 0.0 { step[d] / moves } else { 0.0 };
        Ok(step)
    }

    /// The derivative of what an orbit is chosen by, by differences.
    fn slope(&mut self, model: &Model, choice: &Choice<'_>) -> Result<DVector<f64>, NoOrbit> {
        let d = self.gap.len();
        let mut slope = DVector::zeros(d);
        for k in 0..d {
            let mut beside = |side: f64| {
                let mut coordinates = DVector::zeros(d);
                coordinates[k] = side * PROBE;
                let state = self.chart.moved(&self.start, &coordinates);
                Ok::<f64, NoOrbit>(value(model, choice, &state)?)
            };
            slope[k] = (beside(1.0)? - beside(-1.0)?) / (2.0 * PROBE);
        }
        Ok(slope)
    }

    /// What comes of a step.
    pub(super) fn moved(&mut self, search: &OrbitSearch<'_>, step: &DVector<f64>) -> Result<Self, NoOrbit> {
        let d = self.gap.len();
        let start = self.chart.moved(&self.start, &step.rows(0, d).into_owned());
        let period = self.period * (1.0 + step[d].clamp(-0.5, 0.5));
        Self::of(search, start, period)
    }
}
