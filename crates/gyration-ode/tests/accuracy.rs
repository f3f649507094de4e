//! Smooth problems against their closed forms, in every method: what a tolerance buys.

use crate::common::{
    self, Problem, barrier, barrier_energy, distance, kepler, oscillator, perihelion, run, short, with,
};
use gyration_ode::{Cause, Failure, Integrator, Limit, Method, Options};

const METHODS: [Method; 3] = [Method::Auto, Method::Explicit, Method::Implicit];

#[test]
fn oscillator_and_its_quadrature_agree_with_their_closed_forms() {
    let (omega, end) = (3.0_f64, 20.0_f64);
    let exact = [(omega * end).cos(), -omega * (omega * end).sin()];
    let integral = 0.5 * end + (2.0 * omega * end).sin() / (4.0 * omega);
    for method in METHODS {
        for tolerance in [1e-6, 1e-9, 1e-12] {
            let mut problem = oscillator(omega).tolerances(tolerance, tolerance);
            let reached = run(&mut problem, &[1.0, 0.0], &[0.0], (0.0, end), with(method));
            let errors = [distance(reached.state(), &exact), (reached.quadratures()[0] - integral).abs()];
            println!("{method:?} {tolerance:e}: {} {:?}", short(&errors), reached.statistics());
            // Ten periods of some tens of steps each add up to at most a few hundred tolerances.
            assert!(errors.iter().all(|error| *error < 300.0 * tolerance));
        }
    }
}

#[test]
fn kepler_orbit_closes() {
    for method in METHODS {
        let mut problem = kepler().tolerances(1e-10, 1e-10);
        let start = perihelion(0.6);
        let period = 2.0 * std::f64::consts::PI;
        let reached = run(&mut problem, &start, &[], (0.0, 3.0 * period), with(method));
        let error = distance(reached.state(), &start);
        println!("{method:?}: {error:.1e} after three orbits, {:?}", reached.statistics());
        // The error in the period grows linearly, multiplied at perihelion by speed and curvature.
        assert!(error < 1e-6);
    }
}

/// At tolerances near the resolution of f64 Newton's method cannot stagnate, nor the controller stall.
#[test]
fn tolerances_near_rounding_still_work() {
    for method in METHODS {
        let mut problem = kepler().tolerances(1e-13, 1e-13);
        let reached = run(&mut problem, &perihelion(0.3), &[], (0.0, 1.0), with(method));
        println!("{method:?}: {:?}", reached.statistics());
        assert!(common::rejections(reached.statistics()) < reached.statistics().accepted() / 4 + 10);
    }
}

#[test]
fn rates_may_depend_on_time_alone() {
    for method in METHODS {
        let mut problem = Problem::new(1, |t, _, dy| dy[0] = (5.0 * t).cos(), |_, _, _| {}).tolerances(1e-10, 1e-10);
        let reached = run(&mut problem, &[0.0], &[], (0.0, 7.0), with(method));
        assert!((reached.state()[0] - 0.2 * 35.0_f64.sin()).abs() < 1e-8, "{method:?}");
    }
}

/// A drop onto y⁻⁶: the domain y > 0 is never left, the energy stays, the quadrature repeats the change of momentum.
#[test]
fn barrier_returns_what_falls_on_it() {
    for method in METHODS {
        for tolerance in [1e-6, 1e-9] {
            let mut problem = barrier(0.0).tolerances(tolerance, tolerance);
            let reached = run(&mut problem, &[50.0, 0.0], &[0.0, 0.0], (0.0, 40.0), with(method));
            let energy = (barrier_energy(reached.state()) / barrier_energy(&[50.0, 0.0]) - 1.0).abs();
            let momentum = (reached.quadratures()[0] - 40.0 - reached.state()[1]).abs();
            println!("{method:?} {tolerance:e}: {energy:.1e} {momentum:.1e} {:?}", reached.statistics());
            // Relative to an energy of 50 the bounces each cost a few tolerances; momentum reaches 10.
            assert!(energy < 1e2 * tolerance && momentum < 1e3 * tolerance);
        }
    }
}

/// A first step far beyond the barrier is rejected, not clamped, and shows in counters and report.
#[test]
fn a_step_out_of_the_domain_is_rejected() {
    for method in METHODS {
        let mut problem = barrier(0.0);
        let options = Options { method, initial_step: Some(100.0), ..Options::default() };
        let mut integrator = Integrator::new(0.0, &[2.0, -5.0], &[0.0, 0.0], options);
        let report = integrator.step(&mut problem, 1e3).unwrap();
        assert!(report.rejections > 0);
        assert!(integrator.statistics().rejected_domain > 0, "{method:?}");
        assert!(integrator.state()[0] > 0.0);
        assert!(matches!(report.limit, Limit::Domain | Limit::Error { .. } | Limit::Newton));
    }
}

/// y' = y² from 1 ends at t = 1: no step crosses it, the failure says where.
#[test]
fn a_blow_up_ends_with_a_failure_at_its_time() {
    for method in METHODS {
        let mut problem =
            Problem::new(1, |_, y, dy| dy[0] = y[0] * y[0], |_, y, j| j[(0, 0)] = 2.0 * y[0]).tolerances(1e-8, 1e-8);
        let mut integrator = Integrator::new(0.0, &[1.0], &[], with(method));
        let failure = loop {
            match integrator.step(&mut problem, 2.0) {
                Ok(_) => assert!(integrator.statistics().accepted() < 100_000),
                Err(failure) => break failure,
            }
        };
        println!("{method:?}: {failure}");
        let Failure::StepTooSmall { time, step, .. } = failure else { panic!("{failure}") };
        assert!((time - 1.0).abs() < 1e-6, "{method:?}");
        assert!(step < 1e-14);
        assert_eq!(integrator.time(), time);
    }
}

/// A wall that the motion must cross: the cause is the system's own words.
#[test]
fn a_wall_ends_with_the_systems_own_words() {
    for method in METHODS {
        let mut problem = Problem::general(
            1,
            0,
            |_, y, dy, _| {
                dy[0] = 1.0;
                if y[0] >= 0.5 { Err("wall") } else { Ok(()) }
            },
            |_, _, _| {},
        );
        let mut integrator = Integrator::new(0.0, &[0.0], &[], Options { max_step: 0.1, ..with(method) });
        let failure = loop {
            if let Err(failure) = integrator.step(&mut problem, 2.0) {
                break failure;
            }
        };
        let Failure::StepTooSmall { cause, time, .. } = failure else { panic!("{failure}") };
        assert_eq!(cause, Cause::Inadmissible("wall"));
        assert!((time - 0.5).abs() < 1e-12 && integrator.state()[0] < 0.5);
    }
}

#[test]
fn a_state_without_rates_is_refused_at_once() {
    let mut problem = barrier(0.0);
    let mut integrator = Integrator::new(3.0, &[-1.0, 0.0], &[0.0, 0.0], Options::default());
    let failure = integrator.step(&mut problem, 4.0).unwrap_err();
    assert_eq!(failure, Failure::NoRates { time: 3.0, cause: Cause::Inadmissible("gap closed") });

    let mut problem = Problem::new(2, |_, y, dy| (dy[0], dy[1]) = (0.0, y[0].ln()), |_, _, _| {});
    let mut integrator = Integrator::new(0.0, &[-1.0, 0.0], &[], Options::default());
    let failure = integrator.step(&mut problem, 4.0).unwrap_err();
    assert_eq!(failure, Failure::NoRates { time: 0.0, cause: Cause::NotFinite { index: 1 } });
}

#[test]
fn steps_keep_to_the_longest_and_land_on_the_end() {
    for method in METHODS {
        let mut problem = Problem::new(1, |_, y, dy| dy[0] = -y[0], |_, _, j| j[(0, 0)] = -1.0).tolerances(1e-2, 1e-2);
        let mut integrator = Integrator::new(0.1, &[1.0], &[], Options { max_step: 0.01, ..with(method) });
        // Ends that are no multiples of anything, one of them a rounding away from the one before.
        for end in [0.3, 0.3000000001, 0.300_000_000_100_001, 0.77, 1.0 / 3.0 + 0.5] {
            while integrator.time() < end {
                let report = integrator.step(&mut problem, end).unwrap();
                assert!(report.end <= end && report.end - report.start <= 0.01 * (1.0 + 1e-8));
                assert_eq!(report.end == end, report.limit == Limit::End);
            }
            assert_eq!(integrator.time(), end);
        }
    }
}

/// A step cut short by the end asked for does not make the following ones short.
#[test]
fn ends_do_not_slow_the_steps_after_them() {
    for method in METHODS {
        let mut problem = oscillator(1.0).tolerances(1e-8, 1e-8);
        let plain = run(&mut problem, &[1.0, 0.0], &[0.0], (0.0, 100.0), with(method));
        let mut cut = Integrator::new(0.0, &[1.0, 0.0], &[0.0], with(method));
        for k in 1..=20 {
            let end = 5.0 * f64::from(k);
            while cut.time() < end {
                cut.step(&mut problem, end).unwrap();
            }
        }
        let (plain, cut) = (plain.statistics().accepted(), cut.statistics().accepted());
        println!("{method:?}: {plain} steps, {cut} with 20 ends");
        // At most two steps an end: the one cut short, and one that the new sequence needs more.
        assert!(cut <= plain + 40);
    }
}

/// The projection is applied to every accepted state, and the rates belong to the projected one.
#[test]
fn accepted_states_lie_on_the_manifold() {
    for method in METHODS {
        let mut problem =
            Problem::new(2, |_, y, dy| (dy[0], dy[1]) = (-y[1], y[0]), |_, _, j| (j[(0, 1)], j[(1, 0)]) = (-1.0, 1.0))
                .tolerances(1e-5, 1e-5);
        problem.project = |y| {
            let size = y[0].hypot(y[1]);
            y.iter_mut().for_each(|value| *value /= size);
            (size - 1.0).abs()
        };
        let mut integrator = Integrator::new(0.0, &[1.0, 0.0], &[], with(method));
        while integrator.time() < 10.0 {
            let report = integrator.step(&mut problem, 10.0).unwrap();
            let y = integrator.state();
            assert!((y[0].hypot(y[1]) - 1.0).abs() < 4e-16);
            assert!(report.projection < 1e-4);
            assert_eq!(integrator.rates().0, [-y[1], y[0]]);
        }
        assert!((integrator.state()[0] - 10.0_f64.cos()).abs() < 1e-3);
    }
}
