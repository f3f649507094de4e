//! The largest contact force of each body within a step.
//!
//! The force is computed at nine points of a part of a step, those of Chebyshev, from the interpolant; the largest |f|
//! of the polynomial through them is the peak, or the largest of the nine if that is more. A step resolves the force
//! that makes it short, so that two peaks hardly fall between two of the points. After each step the part behind the
//! last sample in it is looked at; samples within the step look at theirs when they are recorded.

use crate::island::Island;
use crate::peaks::Peaks;
use crate::plan::RunPlan;
use gyration::dynamics::acting;
use gyration::tensor::Vec3;
use std::f64::consts::PI;

/// How many points of a part of a step are looked at.
const POINTS: usize = 9;
/// Into how many pieces the polynomial is cut to find the piece with its peak.
const PIECES: usize = 64;
/// How often the place of the peak is bracketed more closely, by the golden section: to 1e-8 of the piece.
const SECTIONS: usize = 40;

/// Of each body, the contact force at each of the points [N].
type Looks = Vec<[Vec3; POINTS]>;

impl Island {
    /// Notes the largest contact forces of the last step [s], since the last sample in it.
    pub fn note_peaks(&mut self, start: f64, end: f64, plan: &RunPlan) {
        self.peaks_before.copy_from(&self.state.peaks);
        self.last_step = Some((start, end));
        if self.state.peaks.forces.is_empty() {
            return;
        }
        let sample = plan.next_sample(end);
        let found = self.largest_forces(start.max(plan.sample_time(sample - 1)), end);
        self.state.peaks.take(sample, &found);
    }

    /// The largest contact forces of its bodies up to a time within the last step [s], since the sample before the one
    /// of a number.
    pub fn peaks_at(&mut self, time: f64, sample: u64, plan: &RunPlan) -> Vec<f64> {
        let is_known = time >= self.time() && self.state.peaks.sample == sample;
        if is_known {
            return self.state.peaks.forces.clone();
        }
        let mut peaks = Peaks { sample: 0, forces: vec![0.0; self.members().len()] };
        let mut from = time;
        if let Some((start, _)) = self.last_step {
            from = start.max(plan.sample_time(sample.saturating_sub(1))).min(time);
            if self.peaks_before.sample == sample {
                peaks.take(sample, &self.peaks_before.forces);
            }
        }
        let found = self.largest_forces(from, time);
        peaks.take(peaks.sample, &found);
        peaks.forces
    }

    /// The largest contact forces of its bodies between two times within the last step [N].
    fn largest_forces(&mut self, from: f64, to: f64) -> Vec<f64> {
        let mut looks: Looks = vec![[Vec3::zeros(); POINTS]; self.members().len()];
        let mut is_whole = to > from;
        for point in 0..if is_whole { POINTS } else { 1 } {
            let time = if point == POINTS - 1 { to } else { from + 0.5 * (to - from) * (1.0 - node(point)) };
            is_whole &= self.look(time, point, &mut looks);
        }
        let largest = |look: &[Vec3; POINTS]| {
            let seen = look.iter().map(Vec3::norm).fold(0.0, f64::max);
            if is_whole && seen > 0.0 { seen.max(peak(look)) } else { seen }
        };
        looks.iter().map(largest).collect()
    }

    /// Computes the contact forces at a time within the last step; whether the state there is within the model.
    fn look(&mut self, time: f64, point: usize, looks: &mut Looks) -> bool {
        self.sample(time);
        let (model, workspace) = self.system.observed();
        let Ok((instant, scratch)) = workspace.read(model, &self.sampled) else { return false };
        let with_contact = looks.iter_mut().enumerate().filter(|(body, _)| model.has_contact(*body));
        with_contact.fold(true, |is_whole, (body, look)| match acting(&instant.at(body), scratch) {
            Ok(acting) => {
                look[point] = acting.contact.force;
                is_whole
            }
            Err(_) => false,
        })
    }
}

/// The place of a point, from 1 at the beginning to −1 at the end.
fn node(point: usize) -> f64 {
    libm::cos(PI * point as f64 / (POINTS - 1) as f64)
}

/// The largest |f| of the polynomial through forces at the points [N].
fn peak(look: &[Vec3; POINTS]) -> f64 {
    let nodes: [f64; POINTS] = std::array::from_fn(node);
    let size = |x: f64| at(&nodes, look, x).norm();
    let width = 2.0 / PIECES as f64;
    let grid = |piece: usize| 1.0 - width * piece as f64;
    let highest = (0..=PIECES).max_by(|a, b| size(grid(*a)).total_cmp(&size(grid(*b)))).unwrap_or(0);
    let (mut left, mut right) = ((grid(highest) - width).max(-1.0), (grid(highest) + width).min(1.0));
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    for _ in 0..SECTIONS {
        let [lower, upper] = [right - golden * (right - left), left + golden * (right - left)];
        if size(lower) < size(upper) { left = lower } else { right = upper }
    }
    size(0.5 * (left + right))
}

/// The polynomial through values at Chebyshev's points, by the barycentric formula: weights ±1, half at the ends.
fn at(nodes: &[f64; POINTS], values: &[Vec3; POINTS], x: f64) -> Vec3 {
    let (mut sum, mut total) = (Vec3::zeros(), 0.0);
    for (k, (node, value)) in nodes.iter().zip(values).enumerate() {
        if x == *node {
            return *value;
        }
        let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
        let weight = sign * if k == 0 || k == POINTS - 1 { 0.5 } else { 1.0 } / (x - node);
        sum += weight * value;
        total += weight;
    }
    sum / total
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_peak_of_a_smooth_force_between_two_points_is_found() {
        for place in [-0.97, -0.3, 0.0, 0.113, 0.8] {
            let force = |x: f64| Vec3::new(0.0, 3.0, -4.0) * (-(x - place) * (x - place)).exp();
            let look = std::array::from_fn(|k| force(node(k)));
            // A polynomial of degree 8 is off a Gaussian of this width by some 1e-4.
            assert!((peak(&look) - 5.0).abs() < 1e-3, "{place}: {}", peak(&look));
        }
        // One of degree 8 is met to rounding.
        let quartic = |x: f64| Vec3::new(1.0 - 0.25 * (x - 0.25_f64).powi(4), 0.0, 0.0);
        assert!((peak(&std::array::from_fn(|k| quartic(node(k)))) - 1.0).abs() < 1e-12);
    }
}
