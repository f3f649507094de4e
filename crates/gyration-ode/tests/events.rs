//! Crossings within steps, against the closed form of the motion.

use std::f64::consts::PI;

use crate::common::{oscillator, with};
use gyration_ode::{CrossingDirection, Integrator, Method, find_crossing};

/// The first crossing in the whole of the last step.
fn in_last_step(
    integrator: &mut Integrator,
    function: impl FnMut(f64, &[f64], &[f64]) -> f64,
    direction: CrossingDirection,
    samples: usize,
) -> Option<f64> {
    let step = integrator.last_step()?;
    find_crossing(integrator, step, function, direction, samples)
}

/// All crossings of x = cos t up to an end.
fn crossings(method: Method, direction: CrossingDirection, end: f64) -> Vec<f64> {
    let mut problem = oscillator(1.0).tolerances(1e-12, 1e-12);
    let mut integrator = Integrator::new(0.0, &[1.0, 0.0], &[0.0], with(method));
    let mut found = Vec::new();
    while integrator.time() < end {
        integrator.step(&mut problem, end).unwrap();
        found.extend(in_last_step(&mut integrator, |_, y, _| y[0], direction, 4));
    }
    found
}

#[test]
fn crossings_are_found_at_their_times() {
    for (method, tolerance) in [(Method::Explicit, 1e-11), (Method::Implicit, 1e-11)] {
        let every = [
            (CrossingDirection::Either, 0.5, 1.0, 6),
            (CrossingDirection::Falling, 0.5, 2.0, 3),
            (CrossingDirection::Rising, 1.5, 2.0, 3),
        ];
        for (direction, first, spacing, count) in every {
            let found = crossings(method, direction, 18.0);
            assert_eq!(found.len(), count, "{method:?} {direction:?}: {found:?}");
            for (k, t) in found.iter().enumerate() {
                let error = (t - PI * (first + spacing * k as f64)).abs();
                println!("{method:?} {direction:?}: {error:.1e}");
                assert!(error < tolerance, "{method:?} {direction:?}: {error:e}");
            }
        }
    }
}

/// The root is that of the interpolant to a few ulp: the function changes sign between the time found and just before.
#[test]
fn roots_are_closed_in_to_rounding() {
    let mut problem = oscillator(1.0).tolerances(1e-6, 1e-6);
    let mut integrator = Integrator::new(0.0, &[1.0, 0.0], &[0.0], with(Method::Explicit));
    while integrator.time() < 1.7 {
        integrator.step(&mut problem, 3.0).unwrap();
        if integrator.time() < 1.6 {
            continue;
        }
        let mut evaluations = 0;
        let function = |_: f64, y: &[f64], w: &[f64]| {
            evaluations += 1;
            y[0].powi(3) + 1e-3 * (w[0] - w[0])
        };
        let t = in_last_step(&mut integrator, function, CrossingDirection::Falling, 1).unwrap();
        let (mut y, mut w) = ([0.0; 2], [0.0]);
        integrator.interpolate(t, &mut y, &mut w);
        assert!(y[0] <= 0.0 && y[0] > -1e-14, "{}", y[0]);
        integrator.interpolate(t - 8.0 * f64::EPSILON * t, &mut y, &mut w);
        assert!(y[0] >= 0.0, "{}", y[0]);
        println!("a triple root in {evaluations} evaluations");
        // Bisection of a step of order one to 1e-15 needs 52.
        assert!(evaluations <= 60);
        return;
    }
    panic!("no step across π/2");
}

/// A function that is exactly zero at a step's end crosses there once, and not again in the next step.
#[test]
fn a_crossing_at_the_end_of_a_step_is_counted_once() {
    let mut problem = oscillator(1.0);
    let mut integrator = Integrator::new(0.0, &[1.0, 0.0], &[0.0], with(Method::Explicit));
    let mut found = Vec::new();
    for end in [0.5, 1.0] {
        while integrator.time() < end {
            integrator.step(&mut problem, end).unwrap();
            found.extend(in_last_step(&mut integrator, |t, _, _| t - 0.5, CrossingDirection::Rising, 3));
        }
    }
    assert_eq!(found, [0.5]);
}
