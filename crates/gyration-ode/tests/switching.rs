//! The choice between the steppers: which of them works, and how often it changes.

use crate::common::{Problem, barrier, kepler, oscillator, perihelion, run, with};
use gyration_ode::{Integrator, Limit, Method, Options, Stepper};

#[test]
fn smooth_motion_stays_explicit() {
    for tolerance in [1e-4, 1e-7, 1e-10] {
        let orbit =
            run(&mut kepler().tolerances(tolerance, tolerance), &perihelion(0.9), &[], (0.0, 60.0), with(Method::Auto));
        let swing = run(
            &mut oscillator(50.0).tolerances(tolerance, tolerance),
            &[1.0, 0.0],
            &[0.0],
            (0.0, 10.0),
            with(Method::Auto),
        );
        for end in [orbit, swing] {
            // Now and then a trial of six steps, and ever more seldom.
            let s = end.statistics();
            println!("{tolerance:e}: {s:?}");
            assert!(s.implicit_steps <= 18 && s.implicit_steps < s.explicit_steps / 20, "{tolerance:e}");
        }
    }
}

/// Bounces are violent but short: their steps are short for accuracy, and the explicit method stays.
#[test]
fn bounces_without_losses_stay_explicit() {
    for tolerance in [1e-5, 1e-8] {
        let end = run(
            &mut barrier(0.0).tolerances(tolerance, tolerance),
            &[100.0, 0.0],
            &[0.0, 0.0],
            (0.0, 200.0),
            with(Method::Auto),
        );
        println!("{tolerance:e}: {:?}", end.statistics());
        assert_eq!(end.statistics().switches, 0);
    }
}

/// A drop with strong damping near the barrier ends at rest: implicit steps as long as allowed.
#[test]
fn rest_is_implicit_and_steps_as_long_as_allowed() {
    let mut problem = barrier(1e5).tolerances(1e-6, 1e-8);
    let options = Options { max_step: 10.0, ..with(Method::Auto) };
    let mut integrator = Integrator::new(0.0, &[5.0, 0.0], &[0.0, 0.0], options);
    let mut steppers = Vec::new();
    while integrator.time() < 1e7 {
        let report = integrator.step(&mut problem, 1e7).unwrap();
        steppers.push((report.stepper, report.end - report.start));
        if steppers.len() > 2000 {
            break;
        }
    }
    let s = integrator.statistics();
    println!("{s:?} at {}", integrator.time());
    assert_eq!(steppers.last().unwrap().0, Stepper::Implicit);
    assert!(steppers.last().unwrap().1 > 9.9);
    assert!(s.switches <= 3);
}

/// Damping that comes and goes with time: λ(t) from −1 to −1e6 and back; the choice follows, and does not flutter.
#[test]
fn the_choice_follows_a_stiffness_that_comes_and_goes() {
    let lambda = |t: f64| if (t % 20.0) < 10.0 { -1.0 } else { -1e6 };
    let mut problem = Problem::new(
        3,
        move |t, y, dy| dy.copy_from_slice(&[lambda(t) * (y[0] - t.cos()), y[2], -100.0 * y[1] * y[1] * y[1]]),
        move |t, y, j| {
            j[(0, 0)] = lambda(t);
            (j[(1, 2)], j[(2, 1)]) = (1.0, -300.0 * y[1] * y[1]);
        },
    )
    .tolerances(1e-6, 1e-6);
    let mut integrator = Integrator::new(0.0, &[1.0, 0.3, 0.0], &[], with(Method::Auto));
    let mut counts = Vec::new();
    for k in 1..=8 {
        let end = 10.0 * f64::from(k);
        let before = *integrator.statistics();
        while integrator.time() < end {
            integrator.step(&mut problem, end).unwrap();
        }
        let now = integrator.statistics();
        counts.push((now.explicit_steps - before.explicit_steps, now.implicit_steps - before.implicit_steps));
    }
    let s = integrator.statistics();
    println!("explicit and implicit steps by half period: {counts:?}; {s:?}");
    for (k, (explicit, implicit)) in counts.iter().enumerate() {
        assert_eq!(k % 2 == 0, explicit > implicit, "half period {k}");
    }
    assert!(s.switches <= 10);
}

/// The choice costs little more than the better of the two on either side, counted in evaluations.
#[test]
fn auto_is_never_much_worse_than_the_better_method() {
    let problems = [
        ("bouncing", 0.0, [20.0, 0.0], 30.0),
        ("settling", 20.0, [3.0, 0.0], 30.0),
        ("creeping", 1000.0, [3.0, 0.0], 30.0),
        ("resting", 1e4, [1.2, 0.0], 100.0),
    ];
    for (name, damping, start, end) in problems {
        let cost = [Method::Auto, Method::Explicit, Method::Implicit].map(|method| {
            let reached =
                run(&mut barrier(damping).tolerances(1e-6, 1e-8), &start, &[0.0, 0.0], (0.0, end), with(method));
            let s = reached.statistics();
            // Jacobians and factorizations in evaluations, as the choice itself counts them.
            s.rate_evaluations + 5 * s.jacobians / 2 + 5 * s.factorizations
        });
        println!("{name}: auto, explicit, implicit cost {cost:?}");
        let better = cost[1].min(cost[2]);
        // Beside a factor of two, the price of finding out: a score of steps of the wrong kind.
        assert!(cost[0] < 2 * better + 500, "{name}");
    }
}

/// Held to the explicit method, a stiff problem says what limits it.
#[test]
fn a_stiff_problem_names_stability_as_its_limit() {
    let mut problem = Problem::new(1, |t, y, dy| dy[0] = -1e4 * (y[0] - t.cos()), |_, _, j| j[(0, 0)] = -1e4);
    let mut integrator = Integrator::new(0.0, &[1.0], &[], with(Method::Explicit));
    let mut limited = 0;
    for _ in 0..100 {
        let report = integrator.step(&mut problem, 10.0).unwrap();
        limited += u32::from(report.limit == Limit::Stability);
    }
    println!("{limited} of 100 steps limited by stability");
    assert!(limited > 50);
}

/// Where explicit steps would vanish in the rounding of time, the implicit stepper is tried before giving up.
#[test]
fn a_stepper_that_cannot_go_on_gives_way_to_the_other() {
    let mut problem = Problem::new(1, |t, y, dy| dy[0] = -1e17 * (y[0] - (t - 1.0).cos()), |_, _, j| j[(0, 0)] = -1e17);
    let options = Options { initial_step: Some(1e-3), ..with(Method::Auto) };
    let reached = run(&mut problem, &[0.5], &[], (1.0, 2.0), options);
    println!("{:?}", reached.statistics());
    assert!((reached.state()[0] - 1.0_f64.cos()).abs() < 1e-6);
    assert_eq!(reached.statistics().switches, 1);
}
