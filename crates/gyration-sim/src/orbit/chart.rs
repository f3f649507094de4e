//! Coordinates of the states near one, as far as the model allows them: c, δy = D Q c.
//!
//! D has scales: the size L of a body, L/T for velocities, 1/T for rates, one for what has no unit. The columns of Q
//! are an orthonormal basis of the range of ∂(projection)/∂y, in these scales: what guides, joints and kept volumes
//! leave, without the length of a quaternion and the turns of a point.

use crate::adapter::ModelSystem;
use crate::sensitivity::SCALES;
use crate::singular_values::SingularValues;
use gyration::Inadmissible;
use gyration::body::Slots;
use gyration::model::Model;
use gyration::state::State;
use gyration_ode::System as _;
use nalgebra::{DMatrix, DVector};

/// A state is varied by this part of its scales to see what a projection leaves of it.
const PROBE: f64 = 1e-6;
/// What a projection leaves has singular values of one and more, what it takes away of zero.
const LEFT: f64 = 1e-2;

/// The states near one.
pub(super) struct Chart {
    system: ModelSystem,
    /// D.
    scales: DVector<f64>,
    /// Q.
    basis: DMatrix<f64>,
}

impl Chart {
    /// About a state of an orbit of a period \[s\].
    pub fn about(model: &Model, state: &State, period: f64) -> Result<Self, Inadmissible> {
        let system = ModelSystem::new(model.clone(), state, SCALES)?;
        let n = model.dimension();
        let scales = scales(model, period);
        let frozen = frozen(model);
        let mut chart = Self { system, scales, basis: DMatrix::zeros(n, 0) };
        let mut left = DMatrix::zeros(n, n);
        for column in (0..n).filter(|column| !frozen[*column]) {
            let beside = |chart: &mut Self, side: f64| {
                let mut moved = state.clone();
                moved.bodies[column] += side * PROBE * chart.scales[column];
                chart.project(&mut moved);
                DVector::from_column_slice(&moved.bodies)
            };
            let difference = beside(&mut chart, 1.0) - beside(&mut chart, -1.0);
            left.set_column(column, &(difference.component_div(&chart.scales) / (2.0 * PROBE)));
        }
        // Of iterations that do not end nothing is left, as of what cannot move.
        if let Some(found) = SingularValues::of(&left) {
            let kept: Vec<DVector<f64>> = found.above(LEFT).map(|k| found.left(k)).collect();
            if !kept.is_empty() {
                chart.basis = DMatrix::from_columns(&kept);
            }
        }
        Ok(chart)
    }

    /// D Q: the directions of the coordinates.
    pub fn directions(&self) -> DMatrix<f64> {
        let mut directions = self.basis.clone();
        directions.column_iter_mut().for_each(|mut column| column.component_mul_assign(&self.scales));
        directions
    }

    /// The coordinates of changes of the state.
    pub fn coordinates(&self, changes: &DMatrix<f64>) -> DMatrix<f64> {
        let mut scaled = changes.clone();
        scaled.column_iter_mut().for_each(|mut column| column.component_div_assign(&self.scales));
        self.basis.tr_mul(&scaled)
    }

    /// The largest part of a change, in scales.
    pub fn size(&self, change: &DVector<f64>) -> f64 {
        change.component_div(&self.scales).amax()
    }

    /// The state that a change of coordinates leads to.
    pub fn moved(&mut self, state: &State, coordinates: &DVector<f64>) -> State {
        let mut moved = state.clone();
        let change = self.directions() * coordinates;
        moved.bodies.iter_mut().zip(change.iter()).for_each(|(number, change)| *number += change);
        moved.low.clear();
        self.project(&mut moved);
        moved
    }

    /// Puts a state on its manifold.
    pub fn project(&mut self, state: &mut State) {
        let State { time, bodies, works, .. } = state;
        self.system.project(*time, bodies, works);
    }

    /// ẏ at a time.
    pub fn rates(&mut self, time: f64, state: &State) -> Result<DVector<f64>, Inadmissible> {
        let (mut rates, mut powers) = (vec![0.0; state.bodies.len()], vec![0.0; state.works.len()]);
        self.system.rates(time, &state.bodies, &mut rates, &mut powers)?;
        Ok(DVector::from_vec(rates))
    }
}

/// D, of an orbit of a period \[s\].
pub(super) fn scales(model: &Model, period: f64) -> DVector<f64> {
    let mut scales = DVector::from_element(model.dimension(), 1.0);
    for (index, body) in model.bodies.iter().enumerate() {
        let slots = model.slots(index);
        for (places, scale) in
            [(slots.position(), body.size), (slots.velocity(), body.size / period), (slots.rate(), 1.0 / period)]
        {
            scales.rows_range_mut(places).fill(scale);
        }
    }
    scales
}

/// For each number the largest among those of its kind: places, attitudes, velocities, rates, what else a body keeps.
pub(super) fn largest_of_kind(model: &Model, numbers: &DVector<f64>) -> DVector<f64> {
    let mut largest = numbers.clone();
    for kind in [Slots::position, Slots::attitude, Slots::velocity, Slots::rate, Slots::extra] {
        let places = || (0..model.bodies.len()).flat_map(|index| kind(model.slots(index)));
        let most = places().map(|place| numbers[place]).fold(0.0, f64::max);
        places().for_each(|place| largest[place] = most);
    }
    largest
}

/// The numbers that never change: the turns of a mass point.
fn frozen(model: &Model) -> Vec<bool> {
    let mut frozen = vec![false; model.dimension()];
    for (index, _) in model.bodies.iter().enumerate().filter(|(_, body)| body.is_point()) {
        let slots = model.slots(index);
        [slots.attitude(), slots.rate()].into_iter().flatten().for_each(|place| frozen[place] = true);
    }
    frozen
}

/// The change from one state to another; of a quaternion the shorter way round.
pub(super) fn change(model: &Model, from: &State, to: &State) -> DVector<f64> {
    let mut change = DVector::from_column_slice(&to.bodies) - DVector::from_column_slice(&from.bodies);
    for index in turned(model, from, to) {
        model.slots(index).attitude().for_each(|place| change[place] = -to.bodies[place] - from.bodies[place]);
    }
    change
}

/// Turns the rows of what belongs to a state about, where its quaternions are opposite to those of another.
pub(super) fn align(model: &Model, from: &State, to: &State, rows: &mut DMatrix<f64>) {
    for index in turned(model, from, to) {
        model.slots(index).attitude().for_each(|place| rows.row_mut(place).neg_mut());
    }
}

/// The rigid bodies whose quaternions point to opposite sides.
fn turned<'a>(model: &'a Model, from: &'a State, to: &'a State) -> impl Iterator<Item = usize> + 'a {
    (0..model.bodies.len()).filter(|index| {
        let slots = model.slots(*index).attitude();
        let product: f64 = slots.clone().map(|place| from.bodies[place] * to.bodies[place]).sum();
        model.bodies[*index].affine().is_none() && product < 0.0
    })
}
