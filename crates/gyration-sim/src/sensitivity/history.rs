//! The run behind the present: y(t) over its last steps, which are often shorter than those of S.
//!
//! The interpolant of a step of the run is a polynomial of degree eight at most, and is known after that step only. It
//! is kept by what its values at ten Chebyshev points are beside the first one, from which it comes back to rounding:
//!
//!   y(θ) − y_0 = Σ w_k (y_k − y_0)/(θ − θ_k) / Σ w_k/(θ − θ_k)
//!   θ_k = ½ − ½ cos (k + ½)π/10,   w_k = (−1)^k sin (k + ½)π/10
//!
//! Like the run it has twice the digits: within a short impact forces know a gap that is 1e-7 of the places, and so
//! does what grows there.
//!
//! Source: Berrut, Trefethen, *Barycentric Lagrange interpolation*, SIAM Review 46 (2004).

use gyration_ode::{Integrator, extended_sum};
use std::collections::VecDeque;
use std::f64::consts::PI;

/// How many values a step is kept by.
const POINTS: usize = 10;

/// Steps of the run, one after the other.
#[derive(Debug, Clone, Default)]
pub(super) struct StepHistory {
    steps: VecDeque<Piece>,
    /// Pieces to be used again.
    spare: Vec<Piece>,
}

#[derive(Debug, Clone, Default)]
struct Piece {
    from: f64,
    to: f64,
    /// y_0, and what it lacks.
    first: [Vec<f64>; 2],
    /// y_k − y_0 at the points, one after the other.
    values: Vec<f64>,
}

fn angle(point: usize) -> f64 {
    (point as f64 + 0.5) * PI / POINTS as f64
}

impl StepHistory {
    /// Takes down the last step of a run.
    pub fn record(&mut self, run: &Integrator) {
        let Some((from, to)) = run.last_step() else { return };
        let (n, mut works) = (run.state().len(), vec![0.0; run.quadratures().len()]);
        let Piece { mut first, mut values, .. } = self.spare.pop().unwrap_or_default();
        first.iter_mut().for_each(|numbers| numbers.resize(n, 0.0));
        values.resize(POINTS * n, 0.0);
        let mut lack = vec![0.0; n];
        for (point, changes) in values.chunks_exact_mut(n.max(1)).enumerate() {
            let part = 0.5 - 0.5 * libm::cos(angle(point));
            run.interpolate_part(part, changes, &mut works, Some(&mut lack));
            let [high, low] = &mut first;
            if point == 0 {
                high.copy_from_slice(changes);
                low.copy_from_slice(&lack);
            }
            for (i, change) in changes.iter_mut().enumerate() {
                *change = (*change - high[i]) + (lack[i] - low[i]);
            }
        }
        self.steps.push_back(Piece { from, to, first, values });
    }

    /// Forgets what lies before a time.
    pub fn forget(&mut self, before: f64) {
        while self.steps.front().is_some_and(|piece| piece.to <= before) {
            self.spare.extend(self.steps.pop_front());
        }
    }

    /// How many steps there are.
    pub fn len(&self) -> usize {
        self.steps.len()
    }

    /// Up to when the run is known.
    pub fn end(&self) -> Option<f64> {
        self.steps.back().map(|piece| piece.to)
    }

    /// How long the step of the run is that begins at or before a time and ends behind it.
    pub fn step_at(&self, time: f64) -> f64 {
        let piece = self.piece(time);
        piece.map_or(0.0, |piece| piece.to - piece.from)
    }

    /// How far a step from one time towards another may go, if none of the steps of the run that it passes is shorter
    /// than it by more than a factor: where the run looks closely, an impact may stand between the nodes of a long
    /// step, and none of them sees it.
    pub fn limit(&self, from: f64, to: f64, factor: f64) -> f64 {
        let first = self.steps.partition_point(|piece| piece.to <= from);
        let mut limit = to;
        for piece in self.steps.range(first..).take_while(|piece| piece.from < to) {
            if piece.from >= limit {
                break;
            }
            // To its beginning at least: what it has to say concerns no one before.
            limit = limit.min((from + factor * (piece.to - piece.from)).max(piece.from));
        }
        if limit > from { limit } else { to }
    }

    /// y so long after a time, and what it lacks. The two are not added: within a short impact the time is known to a
    /// billionth of a step.
    pub fn at(&self, time: f64, later: f64, y: &mut [f64], lack: &mut [f64]) {
        let Some(piece) = self.piece(time + later) else { return };
        let (n, part) = (y.len(), ((time - piece.from) + later) / (piece.to - piece.from));
        let (mut weights, mut sum) = ([0.0; POINTS], 0.0);
        for (point, weight) in weights.iter_mut().enumerate() {
            let away = part - (0.5 - 0.5 * libm::cos(angle(point)));
            if away == 0.0 {
                (weights, sum) = ([0.0; POINTS], 1.0);
                weights[point] = 1.0;
                break;
            }
            let sign = if point % 2 == 0 { 1.0 } else { -1.0 };
            *weight = sign * libm::sin(angle(point)) / away;
            sum += *weight;
        }
        let [high, low] = &piece.first;
        for i in 0..n {
            let changes = weights.iter().enumerate().map(|(point, weight)| weight / sum * piece.values[point * n + i]);
            (y[i], lack[i]) = extended_sum(high[i], low[i], changes.sum());
        }
    }

    /// The step in which a time lies; the last behind all.
    fn piece(&self, time: f64) -> Option<&Piece> {
        let place = self.steps.partition_point(|piece| piece.to < time);
        self.steps.get(place).or_else(|| self.steps.back())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_does_not_pass_over_short_ones() {
        let piece = |from: f64, to: f64| Piece { from, to, ..Piece::default() };
        let steps = [piece(0.0, 1.0), piece(1.0, 1.01), piece(1.01, 1.02), piece(1.02, 2.0)];
        let history = StepHistory { steps: steps.into(), spare: Vec::new() };
        // Up to the first short one, then no more than five of them; behind them as far as wanted.
        for (from, to, expected) in
            [(0.0, 2.0, 1.0), (0.0, 0.5, 0.5), (1.0, 2.0, 1.05), (1.019, 2.0, 1.069), (1.02, 2.0, 2.0)]
        {
            let limit = history.limit(from, to, 5.0);
            assert!((limit - expected).abs() < 1e-12, "{from} to {to}: {limit}");
        }
    }

    #[test]
    fn polynomials_come_back_from_their_values() {
        // A place of 1e4 whose change of 1e-10 has digits of its own.
        let value = |t: f64| 1.0 + t - 3.0 * t.powi(4) + 2.0 * t.powi(8);
        let times: Vec<f64> = (0..POINTS).map(|point| 2.0 + 0.5 - 0.5 * angle(point).cos()).collect();
        let first = value(times[0]);
        let values = times.iter().flat_map(|time| [value(*time) - first, 1e-10 * (time - times[0])]).collect();
        let piece = Piece { from: 2.0, to: 3.0, first: [vec![first, 1e4], vec![0.0; 2]], values };
        let history = StepHistory { steps: [piece].into(), spare: Vec::new() };
        for time in [2.0, 2.1, times[3], 2.7, 3.0] {
            let (mut found, mut lack) = ([0.0; 2], [0.0; 2]);
            history.at(time - 0.03, 0.03, &mut found, &mut lack);
            // Rounding of values up to 1e4.
            assert!((found[0] - value(time)).abs() < 1e-10, "{time}: {found:?}");
            let change = (found[1] - 1e4) + lack[1];
            assert!((change - 1e-10 * (time - times[0])).abs() < 1e-24, "{time}: {change}");
        }
    }
}
