//! Stiff problems with known answers, for the implicit stepper and for the choice between the two.

use crate::common::{self, Problem, for_stiff, rejections, run, short, with};
use gyration_ode::{Method, Options, Stepper};
use nalgebra::DMatrix;

/// Van der Pol's equation in the scaling of the stiff test sets: x'' = ((1 − x²) x' − x)/ε.
fn van_der_pol(epsilon: f64) -> Problem {
    Problem::new(
        2,
        move |_, y, dy| (dy[0], dy[1]) = (y[1], ((1.0 - y[0] * y[0]) * y[1] - y[0]) / epsilon),
        move |_, y, j: &mut DMatrix<f64>| {
            j[(0, 1)] = 1.0;
            j[(1, 0)] = (-2.0 * y[0] * y[1] - 1.0) / epsilon;
            j[(1, 1)] = (1.0 - y[0] * y[0]) / epsilon;
        },
    )
}

/// Robertson's reactions.
fn robertson() -> Problem {
    Problem::new(
        3,
        |_, y, dy| {
            let (first, second, third) = (0.04 * y[0], 1e4 * y[1] * y[2], 3e7 * y[1] * y[1]);
            (dy[0], dy[1], dy[2]) = (second - first, first - second - third, third);
        },
        |_, y, j| {
            let (b, c, bb) = (1e4 * y[2], 1e4 * y[1], 6e7 * y[1]);
            for (i, row) in [[-0.04, b, c], [0.04, -b - bb, -c], [0.0, bb, 0.0]].iter().enumerate() {
                for (k, value) in row.iter().enumerate() {
                    j[(i, k)] = *value;
                }
            }
        },
    )
}

/// y' = λ (y − cos t) − sin t, whose solution from y(0) = 1 is cos t for every λ.
fn prothero_robinson(lambda: f64) -> Problem {
    Problem::new(1, move |t, y, dy| dy[0] = lambda * (y[0] - t.cos()) - t.sin(), move |_, _, j| j[(0, 0)] = lambda)
}

#[test]
fn van_der_pol_with_mu_of_a_thousand_reaches_its_reference() {
    // Reference: the test set of Hairer and Wanner (vdpol, ε = 1e-6, t = 2).
    let wanted = [0.170_616_773_217_048e1, -0.892_809_701_024_797_5];
    for options in for_stiff() {
        for tolerance in [1e-4, 1e-7, 1e-10] {
            let mut problem = van_der_pol(1e-6).tolerances(tolerance, tolerance);
            let end = run(&mut problem, &[2.0, 0.0], &[], (0.0, 2.0), options);
            let errors = [0, 1].map(|i| (end.state()[i] - wanted[i]).abs());
            let s = end.statistics();
            println!(
                "van der Pol {:?} {:?} {tolerance:e}: errors {}, {s:?}",
                options.method,
                options.order,
                short(&errors)
            );
            assert!(errors[0] < 10.0 * tolerance && errors[1] < 50.0 * tolerance);
            // Stability would ask for a million.
            assert!(s.accepted() < 20_000);
        }
    }
}

#[test]
fn robertson_reaches_its_reference() {
    // Reference: the test set for initial value problem solvers (rober) at t = 1e11.
    let wanted = [0.208_334_014_970_122e-7, 0.833_336_077_033_471e-13, 0.999_999_979_166_505];
    for options in for_stiff() {
        let mut problem = robertson().tolerances(1e-8, 1e-18);
        let end = run(&mut problem, &[1.0, 0.0, 0.0], &[], (0.0, 1e11), options);
        let errors: Vec<f64> = end.state().iter().zip(wanted).map(|(y, w)| (y / w - 1.0).abs()).collect();
        println!("Robertson {options:?}: relative errors {}, {:?}", short(&errors), end.statistics());
        // Relative tolerance 1e-8 over a hundred steps or so, on a solution that contracts.
        assert!(errors.iter().all(|e| *e < 1e-6));
    }
}

#[test]
fn a_stiff_forced_equation_follows_its_forcing() {
    for lambda in [-1e2, -1e4, -1e6, -1e9] {
        for options in for_stiff() {
            let mut problem = prothero_robinson(lambda).tolerances(1e-8, 1e-8);
            let end = run(&mut problem, &[1.0], &[], (0.0, 10.0), options);
            let error = (end.state()[0] - 10.0_f64.cos()).abs();
            println!("Prothero-Robinson {lambda:e} {options:?}: {error:.1e}, {:?}", end.statistics());
            assert!(error < 1e-7);
            assert!(end.statistics().accepted() < 2000);
        }
    }
}

/// |R(z)| of an L-stable method vanishes at infinity: one step kills a transient of any rate.
#[test]
fn implicit_step_is_l_stable() {
    // |R(z)| → s/|z|: with s stages the numerator is of degree s − 1, the denominator of degree s.
    for (options, stages) in common::implicit().into_iter().zip([3.0, 5.0, 7.0]) {
        for lambda in [-1e3, -1e6, -1e12] {
            let mut problem = Problem::new(1, move |_, y, dy| dy[0] = lambda * y[0], move |_, _, j| j[(0, 0)] = lambda)
                .tolerances(0.0, 1e3);
            let end = run(&mut problem, &[1.0], &[], (0.0, 1.0), common::fixed(options, 1.0));
            assert_eq!(end.statistics().accepted(), 1);
            println!("{:?}: R({lambda:e}) = {:.2e}", options.order, end.state()[0]);
            assert!(end.state()[0].abs() < 1.1 * stages / lambda.abs());
        }
    }
}

/// At λ = −1e12 an explicit step is 1e-12; the choice must find the implicit stepper and then step freely.
#[test]
fn a_very_stiff_decay_is_given_to_the_implicit_stepper() {
    let mut problem = Problem::new(
        2,
        |t, y, dy| (dy[0], dy[1]) = (-1e12 * (y[0] - 1.0), t.sin() - y[1]),
        |_, _, j| (j[(0, 0)], j[(1, 1)]) = (-1e12, -1.0),
    );
    let options = Options { max_step: 0.5, ..with(Method::Auto) };
    let mut integrator = gyration_ode::Integrator::new(0.0, &[0.0, 0.0], &[], options);
    let mut last = Stepper::Explicit;
    while integrator.time() < 10.0 {
        last = integrator.step(&mut problem, 10.0).unwrap().stepper;
    }
    let exact = 0.5 * (10.0_f64.sin() - 10.0_f64.cos() + (-10.0_f64).exp());
    println!("{:?}", integrator.statistics());
    assert_eq!(last, Stepper::Implicit);
    assert!((integrator.state()[0] - 1.0).abs() < 1e-6);
    assert!((integrator.state()[1] - exact).abs() < 1e-5);
    assert!(integrator.statistics().accepted() < 400);
    assert!(rejections(integrator.statistics()) < 100);
}

/// A body is pushed out of a field of repulsion ν = 6 and damping ν = 3 against its weight, d'' = k (d⁻⁶ − 1 − d⁻³ d'),
/// k large: the stiffness changes severalfold within a step.
#[test]
fn a_body_that_settles_takes_few_newton_iterations() {
    let k = 1e5;
    // With the Jacobian of the start of each step it takes 923, 1038 and 1471.
    for (tolerance, most) in [(1e-3, 600), (1e-4, 800), (1e-5, 1250)] {
        let mut problem = Problem::new(
            2,
            move |_, y, dy| (dy[0], dy[1]) = (y[1], k * (y[0].powi(-6) - 1.0 - y[0].powi(-3) * y[1])),
            move |_, y, j: &mut DMatrix<f64>| {
                j[(0, 1)] = 1.0;
                j[(1, 0)] = k * (-6.0 * y[0].powi(-7) + 3.0 * y[0].powi(-4) * y[1]);
                j[(1, 1)] = -k * y[0].powi(-3);
            },
        )
        .tolerances(tolerance, tolerance);
        let end = run(&mut problem, &[0.1, 0.0], &[], (0.0, 10.0), with(Method::Implicit));
        let (error, evaluations) = ((end.state()[0] - 1.0).abs(), end.statistics().rate_evaluations);
        println!("settling at {tolerance:e}: error {error:e}, {evaluations} evaluations");
        assert!(error < tolerance && evaluations < most);
    }
}
