//! The run behind the present: y(t) over its last steps, which are often shorter than those of S.
//!
//! The interpolant of a step of the run is a polynomial of degree eight at most, and is known after that step only. It
//! is kept by its values at ten Chebyshev points, from which it comes back to rounding:
//!
//!   y(θ) = Σ w_k y_k/(θ − θ_k) / Σ w_k/(θ − θ_k),   θ_k = ½ − ½ cos (k + ½)π/10,   w_k = (−1)^k sin (k + ½)π/10
//!
//! Source: Berrut, Trefethen, *Barycentric Lagrange interpolation*, SIAM Review 46 (2004).

use gyration_ode::Integrator;
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
    /// y at the points, one after the other.
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
        let mut piece = self.spare.pop().unwrap_or_default();
        (piece.from, piece.to) = (from, to);
        piece.values.resize(POINTS * n, 0.0);
        for (point, values) in piece.values.chunks_exact_mut(n.max(1)).enumerate() {
            let part = 0.5 - 0.5 * libm::cos(angle(point));
            run.interpolate(from + part * (to - from), values, &mut works);
        }
        self.steps.push_back(piece);
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

    /// y at a time.
    pub fn at(&self, time: f64, y: &mut [f64]) {
        let Some(piece) = self.piece(time) else { return };
        let part = (time - piece.from) / (piece.to - piece.from);
        let (mut weights, mut sum) = ([0.0; POINTS], 0.0);
        for (point, weight) in weights.iter_mut().enumerate() {
            let away = part - (0.5 - 0.5 * libm::cos(angle(point)));
            if away == 0.0 {
                y.copy_from_slice(&piece.values[point * y.len()..(point + 1) * y.len()]);
                return;
            }
            let sign = if point % 2 == 0 { 1.0 } else { -1.0 };
            *weight = sign * libm::sin(angle(point)) / away;
            sum += *weight;
        }
        let n = y.len();
        for (i, value) in y.iter_mut().enumerate() {
            *value = 0.0;
            for (point, weight) in weights.iter().enumerate() {
                *value += weight / sum * piece.values[point * n + i];
            }
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
        let piece = |from: f64, to: f64| Piece { from, to, values: Vec::new() };
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
        let value = |t: f64| 1.0 + t - 3.0 * t.powi(4) + 2.0 * t.powi(8);
        let times = (0..POINTS).map(|point| 2.0 + 0.5 - 0.5 * angle(point).cos());
        let values = times.flat_map(|time| [value(time), 7.0]).collect();
        let history = StepHistory { steps: [Piece { from: 2.0, to: 3.0, values }].into(), spare: Vec::new() };
        for time in [2.0, 2.1, 2.0 + 0.5 - 0.5 * angle(3).cos(), 2.7, 3.0] {
            let mut found = [0.0; 2];
            history.at(time, &mut found);
            // Rounding of values up to 1e4.
            assert!((found[0] - value(time)).abs() < 1e-10 && (found[1] - 7.0).abs() < 1e-13, "{time}: {found:?}");
        }
    }
}
