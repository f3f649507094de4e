//! Gragg's modified midpoint rule with Richardson's extrapolation in h².
//!
//! A step of h is made with n = 2, 4, 6, … midpoint steps; the results, polynomials in (h/n)², are extrapolated to 0.
//! The step ends when two neighbours in the table agree; it shrinks where none do, or where it leaves the model.

use super::Equations;

const STAGES: usize = 10;

fn combine<const N: usize>(a: &[f64; N], b: &[f64; N], factor: f64) -> [f64; N] {
    std::array::from_fn(|k| a[k] + factor * b[k])
}

fn difference<const N: usize>(system: &impl Equations<N>, a: &[f64; N], b: &[f64; N]) -> f64 {
    (0..N).map(|k| (a[k] - b[k]).abs() / system.scale(k)).fold(0.0, f64::max)
}

/// The value after n midpoint steps of h/n, smoothed at the end.
fn midpoint<const N: usize>(
    system: &impl Equations<N>,
    y: &[f64; N],
    first: &[f64; N],
    h: f64,
    n: u32,
) -> Option<[f64; N]> {
    let small = h / f64::from(n);
    let (mut before, mut now) = (*y, combine(y, first, small));
    for _ in 1..n {
        let next = combine(&before, &system.rates(&now)?, 2.0 * small);
        (before, now) = (now, next);
    }
    let after = combine(&before, &system.rates(&now)?, small);
    Some(std::array::from_fn(|k| 0.5 * (now[k] + after[k])))
}

/// One step, and how many stages it took.
fn step<const N: usize>(system: &impl Equations<N>, y: &[f64; N], h: f64, tolerance: f64) -> Option<([f64; N], usize)> {
    let first = system.rates(y)?;
    let mut table: Vec<[f64; N]> = Vec::new();
    for stage in 0..STAGES {
        let count = |stage: usize| 2.0 * (stage as f64 + 1.0);
        let mut row = vec![midpoint(system, y, &first, h, 2 * (stage as u32 + 1))?];
        for k in 0..stage {
            let ratio = (count(stage) / count(stage - 1 - k)).powi(2);
            let change = combine(&row[k], &table[k], -1.0);
            row.push(combine(&row[k], &change, 1.0 / (ratio - 1.0)));
        }
        if stage > 2 && difference(system, &row[stage], &row[stage - 1]) < tolerance {
            return Some((row[stage], stage));
        }
        table = row;
    }
    None
}

/// The numbers at the times, the first of which is that of the start.
pub fn integrate<const N: usize>(
    system: &impl Equations<N>,
    start: &[f64; N],
    times: &[f64],
    tolerance: f64,
) -> Vec<[f64; N]> {
    let (mut y, mut time, mut h) = (*start, times[0], 1e-3);
    let mut found = vec![y];
    for target in &times[1..] {
        while time < *target {
            let taken = f64::min(h, target - time);
            let Some((next, stage)) = step(system, &y, taken, tolerance) else {
                h = 0.5 * taken;
                assert!(h > 1e-9, "no step at {time} s");
                continue;
            };
            time = if taken < h { *target } else { time + taken };
            y = next;
            match stage {
                0..=6 => h *= 1.3,
                8.. => h = 0.75 * taken,
                _ => {}
            }
        }
        found.push(y);
    }
    found
}
