//! Whether a soft spheroid tumbles in a shear or trembles.
//!
//!   q = (Q_xx − Q_zz, 2 Q_xz),   Q = P A² Pᵀ:   its angle is twice that of the form's long axis in the plane of the shear u_x = γ̇ z
//!
//! After half a turn of the material the body is as it was, and q has gone round 0 once (it tumbles) or not at all (it
//! trembles). Between the two q passes through 0: the section of the form in that plane is a circle for an instant. The
//! signed distance of this passage is smooth in G = ηγ̇/μ_s, so that its root is found by secants.

use crate::Experiment;
use gyration::tensor::{Mat3, Vec3};
use nalgebra::Vector2;
use std::f64::consts::{PI, TAU};

/// A motion of a particle, sample by sample.
#[derive(Debug, Clone)]
pub struct Turning {
    /// Times [s].
    pub times: Vec<f64>,
    /// P.
    pub placements: Vec<Mat3>,
    /// Ṗ [1/s].
    pub rates: Vec<Mat3>,
}

impl Turning {
    /// How q passes 0 where it is nearest to it, in the second half turn of the material: its distance over |q| of the
    /// body at rest, positive if it goes round 0 as the material does. The first half turn is passed over, with what
    /// the start has left. `squares` is A².
    ///
    /// None if the material has not gone round by then.
    pub fn passage(&self, squares: &Mat3) -> Option<f64> {
        let turned = angles(self.placements.iter().map(|p| Vector2::new(p[(0, 0)] + p[(2, 2)], p[(0, 2)] - p[(2, 0)])));
        let after = |half_turns: f64| turned.iter().position(|angle| angle.abs() >= PI * half_turns);
        let (first, last) = (after(1.0)?, after(2.1)?);
        let size = |k: &usize| section(&self.placements[*k], squares).norm();
        let nearest = (first..last).min_by(|a, b| size(a).total_cmp(&size(b)))?;
        let sections: Vec<Vector2<f64>> = (-PARTS..=PARTS)
            .map(|k| f64::from(k) / f64::from(PARTS))
            .map(|way| if way < 0.0 { self.between(nearest - 1, way + 1.0) } else { self.between(nearest, way) })
            .map(|p| section(&p, squares))
            .collect();
        let steps = sections.windows(2).map(|pair| {
            let step = pair[1] - pair[0];
            (pair[0].norm() + pair[1].norm(), pair[1].perp(&pair[0]) / step.norm())
        });
        let (_, distance) = steps.min_by(|a, b| a.0.total_cmp(&b.0))?;
        Some(distance * turned[last].signum() / section(&Mat3::identity(), squares).norm())
    }

    /// P between two samples, by Hermite's cubic.
    fn between(&self, k: usize, part: f64) -> Mat3 {
        let (span, rest) = (self.times[k + 1] - self.times[k], 1.0 - part);
        let ends = self.placements[k] * (rest * rest * (1.0 + 2.0 * part))
            + self.placements[k + 1] * (part * part * (1.0 + 2.0 * rest));
        ends + (self.rates[k] * rest - self.rates[k + 1] * part) * (span * part * rest)
    }
}

/// Into how many parts the intervals beside the nearest sample are divided.
const PARTS: i32 = 200;

fn section(p: &Mat3, squares: &Mat3) -> Vector2<f64> {
    let q = p * squares * p.transpose();
    Vector2::new(q[(0, 0)] - q[(2, 2)], 2.0 * q[(0, 2)])
}

/// How far a vector has turned since the start, sample by sample [rad].
fn angles(vectors: impl Iterator<Item = Vector2<f64>>) -> Vec<f64> {
    let (mut before, mut sum) = (None, 0.0);
    let turn = |a: Vector2<f64>, b: Vector2<f64>| a.perp(&b).atan2(a.dot(&b));
    let add = |vector| {
        sum += before.map_or(0.0, |before| turn(before, vector));
        before = Some(vector);
        sum
    };
    vectors.map(add).collect()
}

/// The passage in a run of the program: a neo-Hookean spheroid (r, 1, 1) mm without inertia, at G, in a shear of 1 /s.
///
/// # Panics
/// If the run stops early, or the material does not go round.
pub fn passage(ratio: f64, capillary: f64) -> f64 {
    let scene = format!(
        r#"
        time = {{ end = 1, sample = 1 }}
        fluid = {{ viscosity = 1, density = 1000, velocity_gradient = [[0, 0, 1], [0, 0, 0], [0, 0, 0]] }}
        [[body]]
        name = "particle"
        shape = {{ ellipsoid = {{ semi_axes = [{:e}, 1e-3, 1e-3] }} }}
        density = 1000
        affine = {{ material = {{ neo_hookean = {{ shear = {:e} }} }} }}
        inclusion = {{ inertia = false }}
        "#,
        ratio * 1e-3,
        1.0 / capillary
    );
    let experiment = Experiment::of_scene(&scene);
    let squares = Mat3::from_diagonal(&Vec3::new(ratio * ratio, 1.0, 1.0));
    // The material takes longer for a turn than a grain, the longer the softer it is.
    let mut end = 1.3 * TAU * (ratio + 1.0 / ratio);
    while end < 1e4 {
        let run = experiment.until(end).sampled(0.02).run();
        let [placements, rates] = ["placement_gradient", "gradient_rate"].map(|name| run.matrices(name));
        if let Some(passage) = (Turning { times: run.times, placements, rates }).passage(&squares) {
            return passage;
        }
        end *= 2.0;
    }
    panic!("r = {ratio}, G = {capillary}: the material does not go round within {end} s")
}

/// The G between tumbling (at `low`) and trembling (at `high`), where the passage is through 0, by secants kept between
/// the two.
///
/// # Panics
/// If `low` does not tumble or `high` does not tremble.
pub fn threshold(passage: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let (mut one, mut other) = (passage(low), passage(high));
    assert!(one > 0.0 && other < 0.0, "it does not tumble at {low} and tremble at {high}: {one} {other}");
    let (mut found, mut tumbled) = (low, None);
    for _ in 0..40 {
        let next = low - one * (high - low) / (other - one);
        let change = (next - found).abs();
        found = next;
        if change < 1e-6 * found {
            break;
        }
        let at = passage(found);
        // The weight of an end that stays a second time is halved, so that both come near (the Illinois rule).
        let weight = if tumbled == Some(at > 0.0) { 0.5 } else { 1.0 };
        tumbled = Some(at > 0.0);
        if at > 0.0 {
            (low, one, other) = (found, at, weight * other);
        } else {
            (high, other, one) = (found, at, weight * one);
        }
    }
    found
}
