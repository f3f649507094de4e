//! The order of every method and of its interpolant, measured with steps of fixed size.

use crate::common::{self, Problem, distance, fixed, kepler, perihelion, short, slopes, with};
use gyration_ode::{Integrator, Method, Options};

/// Kepler's equation by Newton's method: the state at time t.
fn on_ellipse(e: f64, t: f64) -> [f64; 4] {
    let mut anomaly = t;
    for _ in 0..50 {
        anomaly -= (anomaly - e * anomaly.sin() - t) / (1.0 - e * anomaly.cos());
    }
    let (sin, cos) = anomaly.sin_cos();
    let rate = 1.0 / (1.0 - e * cos);
    let minor = (1.0 - e * e).sqrt();
    [cos - e, minor * sin, -sin * rate, minor * cos * rate]
}

/// Errors at the end and of the interpolant, for steps of 1/n, with the tolerance that lets them pass.
fn errors(options: Options, n: usize, atol: f64) -> (f64, f64) {
    let (e, end) = (0.3, 4.0);
    let mut problem = kepler().tolerances(0.0, atol);
    let mut integrator = Integrator::new(0.0, &perihelion(e), &[], fixed(options, 1.0 / n as f64));
    let (mut between, mut y) = (0.0_f64, [0.0; 4]);
    while integrator.time() < end {
        let report = integrator.step(&mut problem, end).unwrap();
        assert_eq!(report.rejections, 0, "the step must be as fixed");
        for k in 1..8 {
            let t = report.start + (report.end - report.start) * f64::from(k) / 8.0;
            integrator.interpolate(t, &mut y, &mut []);
            between = between.max(distance(&y, &on_ellipse(e, t)));
        }
    }
    assert_eq!(integrator.statistics().accepted(), (end as usize * n) as u64);
    (distance(integrator.state(), &on_ellipse(e, end)), between)
}

#[test]
fn explicit_pair_has_order_nine_and_dense_output_eight() {
    // Any tolerance that is never reached: explicit steps do not depend on it.
    let both: Vec<_> = [3, 6, 12, 24].iter().map(|n| errors(with(Method::Explicit), *n, 1e9)).collect();
    let ends: Vec<f64> = both.iter().map(|b| b.0).collect();
    let between: Vec<f64> = both.iter().map(|b| b.1).collect();
    println!("Prince 9(7): errors {}, slopes {:.2?}", short(&ends), slopes(&ends));
    println!("Prince 9(7) dense: errors {}, slopes {:.2?}", short(&between), slopes(&between));
    // A slope between two sizes differs from the order by O(h): half an order is allowed on the last but one, beyond
    // which the error of the ends meets rounding.
    assert!((8.5..10.5).contains(&slopes(&ends)[1]));
    // The interpolant is of local order 9, which only a step's own error shows; it is never worse than global order 8.
    assert!((7.8..10.0).contains(&slopes(&between)[1]));
}

#[test]
fn radau_has_its_orders_and_dense_output_that_of_its_stages() {
    // Sizes whose errors are those of the method: below 1e-11 they are roundings and what Newton's method leaves.
    let sizes: [&[usize]; 3] = [&[32, 64, 128], &[4, 8, 16], &[2, 4]];
    for (options, (stages, sizes)) in common::implicit().into_iter().zip([3.0, 5.0, 7.0].into_iter().zip(sizes)) {
        // Just above the estimated errors, which are O(h^(s+1)): the tolerance of Newton's method follows it.
        let tolerance = |n: usize| 0.3 * (1.0 / n as f64).powf(stages + 1.0);
        let both: Vec<_> = sizes.iter().map(|n| errors(options, *n, tolerance(*n))).collect();
        let ends: Vec<f64> = both.iter().map(|b| b.0).collect();
        let between: Vec<f64> = both.iter().map(|b| b.1).collect();
        println!("Radau {:?}: errors {}, slopes {:.2?}", options.order, short(&ends), slopes(&ends));
        println!("Radau {:?} dense: errors {}, slopes {:.2?}", options.order, short(&between), slopes(&between));
        let (order, local) = (2.0 * stages - 1.0, stages + 1.0);
        assert!((order - 0.5..order + 0.6).contains(slopes(&ends).last().unwrap()));
        // A polynomial of degree s through the stages is of local order s + 1. With seven, and steps this long, the
        // error of the ends is larger.
        assert!(stages > 6.0 || (local - 0.4..local + 0.6).contains(slopes(&between).last().unwrap()));
    }
}

/// y' = cos t − y and w' = y²: rates that depend on time, at the right nodes; quadratures of the same order.
///
/// Linear in y, so that one Newton iteration is exact and any tolerance lets the fixed step pass.
#[test]
fn quadratures_have_the_order_of_the_method() {
    let end = 5.0_f64;
    let state = 0.5 * (end.cos() + end.sin() + (-end).exp());
    let decays = 0.5 * (1.0 - (-2.0 * end).exp()) + 2.0 * (1.0 - (-end).exp() * end.cos());
    let quadrature = 0.25 * (end + end.sin().powi(2) + decays);
    let [five, nine, thirteen] = common::implicit();
    let all = [
        (with(Method::Explicit), [3, 6, 12], 9.0),
        (five, [20, 40, 80], 5.0),
        (nine, [5, 10, 20], 9.0),
        (thirteen, [1, 2, 4], 13.0),
    ];
    for (options, counts, order) in all {
        let (mut states, mut quadratures) = (Vec::new(), Vec::new());
        for steps in counts {
            let mut problem = Problem::general(
                1,
                1,
                |t, y, dy, dw| {
                    (dy[0], dw[0]) = (t.cos() - y[0], y[0] * y[0]);
                    Ok(())
                },
                |_, _, blocks| blocks[0][(0, 0)] = -1.0,
            )
            .tolerances(0.0, 1e9);
            let reached = common::run(&mut problem, &[1.0], &[0.0], (0.0, end), fixed(options, end / f64::from(steps)));
            assert_eq!(reached.statistics().accepted(), u64::from(steps as u32));
            states.push((reached.state()[0] - state).abs());
            quadratures.push((reached.quadratures()[0] - quadrature).abs());
        }
        println!("order {order}: y {} {:.2?}", short(&states), slopes(&states));
        println!("order {order}: w {} {:.2?}", short(&quadratures), slopes(&quadratures));
        for slope in [slopes(&states)[1], slopes(&quadratures)[1]] {
            // From below: with steps as long as these the explicit pair converges faster than its order.
            assert!(slope > order - 0.6, "{slope}");
        }
    }
}

/// Error against work: halving the step at tolerances that control it, the slope of error over steps is the order.
#[test]
fn tolerance_controls_the_error() {
    let [five, nine, thirteen] = common::implicit();
    for (options, expected, tolerances) in [
        (with(Method::Explicit), 8.0, [1e-7, 1e-8, 1e-9, 1e-11]),
        (five, 5.0, [1e-7, 1e-8, 1e-9, 1e-11]),
        (nine, 9.0, [1e-5, 1e-6, 1e-7, 1e-8]),
        // So few steps are less than the asymptotic order.
        (thirteen, 11.0, [1e-4, 1e-5, 1e-6, 1e-7]),
    ] {
        let runs: Vec<(f64, f64)> = tolerances
            .iter()
            .map(|tolerance| {
                let mut problem = kepler().tolerances(*tolerance, *tolerance);
                let end = common::run(&mut problem, &perihelion(0.6), &[], (0.0, 10.0), options);
                let error = distance(end.state(), &on_ellipse(0.6, 10.0));
                // The error of ten time units on an ellipse grows from local errors by a factor of some hundreds.
                assert!(error < 1e3 * tolerance, "{options:?} at {tolerance:e}: {error:e}");
                (end.statistics().accepted() as f64, error)
            })
            .collect();
        let (first, last) = (runs[0], runs[3]);
        let slope = (first.1 / last.1).ln() / (last.0 / first.0).ln();
        println!("{options:?}: steps and errors {runs:?}, slope {slope:.2}");
        assert!((expected - 1.0..expected + 2.5).contains(&slope), "{slope}");
    }
}
