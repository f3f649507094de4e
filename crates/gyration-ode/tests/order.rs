//! The order of every method and of its interpolant, measured with steps of fixed size.

use crate::common::{self, Problem, distance, fixed, kepler, perihelion, short, slopes};
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
fn errors(method: Method, n: usize, atol: f64) -> (f64, f64) {
    let (e, end) = (0.3, 4.0);
    let mut problem = kepler().tolerances(0.0, atol);
    let mut integrator = Integrator::new(0.0, &perihelion(e), &[], fixed(method, 1.0 / n as f64));
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
    let both: Vec<_> = [3, 6, 12, 24].iter().map(|n| errors(Method::Explicit, *n, 1e9)).collect();
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
fn radau_has_order_five_and_dense_output_three() {
    let sizes = [16, 32, 64, 128];
    // Just above the estimated errors, which are O(h⁴): the tolerance of Newton's method follows it.
    let both: Vec<_> = sizes.iter().map(|n| errors(Method::Implicit, *n, 0.3 * (1.0 / *n as f64).powi(4))).collect();
    let ends: Vec<f64> = both.iter().map(|b| b.0).collect();
    let between: Vec<f64> = both.iter().map(|b| b.1).collect();
    println!("Radau: errors {}, slopes {:.2?}", short(&ends), slopes(&ends));
    println!("Radau dense: errors {}, slopes {:.2?}", short(&between), slopes(&between));
    assert!((4.6..5.6).contains(slopes(&ends).last().unwrap()));
    // Local order 4 of a cubic through collocation points.
    assert!((3.6..4.6).contains(slopes(&between).last().unwrap()));
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
    for (method, counts, order) in [(Method::Explicit, [3, 6, 12], 9.0), (Method::Implicit, [20, 40, 80], 5.0)] {
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
            let reached = common::run(&mut problem, &[1.0], &[0.0], (0.0, end), fixed(method, end / f64::from(steps)));
            assert_eq!(reached.statistics().accepted(), u64::from(steps as u32));
            states.push((reached.state()[0] - state).abs());
            quadratures.push((reached.quadratures()[0] - quadrature).abs());
        }
        println!("{method:?}: y {} {:.2?}", short(&states), slopes(&states));
        println!("{method:?}: w {} {:.2?}", short(&quadratures), slopes(&quadratures));
        for slope in [slopes(&states)[1], slopes(&quadratures)[1]] {
            // From below: with steps as long as these the explicit pair converges faster than its order.
            assert!(slope > order - 0.6, "{slope}");
        }
    }
}

/// Error against work: halving the step at tolerances that control it, the slope of error over steps is the order.
#[test]
fn tolerance_controls_the_error() {
    for (method, expected) in [(Method::Explicit, 8.0), (Method::Implicit, 5.0)] {
        let runs: Vec<(f64, f64)> = [1e-7, 1e-8, 1e-9, 1e-11]
            .iter()
            .map(|tolerance| {
                let mut problem = kepler().tolerances(*tolerance, *tolerance);
                let options = Options { method, ..Options::default() };
                let end = common::run(&mut problem, &perihelion(0.6), &[], (0.0, 10.0), options);
                let error = distance(end.state(), &on_ellipse(0.6, 10.0));
                // The error of ten time units on an ellipse grows from local errors by a factor of some hundreds.
                assert!(error < 1e3 * tolerance, "{method:?} at {tolerance:e}: {error:e}");
                (end.statistics().accepted() as f64, error)
            })
            .collect();
        let (first, last) = (runs[0], runs[3]);
        let slope = (first.1 / last.1).ln() / (last.0 / first.0).ln();
        println!("{method:?}: steps and errors {runs:?}, slope {slope:.2}");
        assert!((expected - 1.0..expected + 2.5).contains(&slope), "{slope}");
    }
}
