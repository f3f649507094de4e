//! Blocks of the Jacobian: a shorthand for structure, not another problem.

use crate::common::{Problem, distance, run, with};
use gyration_ode::Method;
use nalgebra::DMatrix;
use proptest::prelude::*;

/// Three damped oscillators of different frequencies, uncoupled: as three blocks or as one.
fn oscillators(split: bool, frequencies: [f64; 3], damping: f64) -> Problem {
    let mut problem = Problem::general(
        6,
        0,
        move |t, y, dy, _| {
            for (k, omega) in frequencies.iter().enumerate() {
                dy[2 * k] = y[2 * k + 1];
                dy[2 * k + 1] = t.sin() - omega * omega * y[2 * k].powi(3) - damping * y[2 * k + 1];
            }
            Ok(())
        },
        move |_, y, blocks: &mut [DMatrix<f64>]| {
            for (k, omega) in frequencies.iter().enumerate() {
                let (matrix, i) = if split { (&mut blocks[k], 0) } else { (&mut blocks[0], 2 * k) };
                matrix[(i, i + 1)] = 1.0;
                matrix[(i + 1, i)] = -3.0 * omega * omega * y[2 * k].powi(2);
                matrix[(i + 1, i + 1)] = -damping;
            }
        },
    );
    if split {
        problem.blocks = vec![0..2, 2..4, 4..6];
    }
    problem
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    /// The norms differ (a maximum against one mean), so the steps do: agreement is to the tolerance.
    #[test]
    fn blocks_agree_with_the_whole(
        frequencies in [0.5_f64..4.0, 0.5_f64..4.0, 0.5_f64..4.0],
        damping in 0.0_f64..50.0,
    ) {
        for method in [Method::Auto, Method::Explicit, Method::Implicit] {
            let start = [1.0, 0.0, 0.5, 0.1, -1.0, 0.3];
            let [split, whole] = [true, false].map(|split| {
                let mut problem = oscillators(split, frequencies, damping).tolerances(1e-9, 1e-9);
                run(&mut problem, &start, &[], (0.0, 5.0), with(method)).state().to_vec()
            });
            prop_assert!(distance(&split, &whole) < 1e-6, "{:?}: {:e}", method, distance(&split, &whole));
        }
    }
}

/// A body's steps do not become longer because others at rest share the run.
#[test]
fn bodies_at_rest_do_not_dilute_the_error() {
    for method in [Method::Explicit, Method::Implicit] {
        let count = |copies: usize| {
            let rates = move |_: f64, y: &[f64], dy: &mut [f64], _: &mut [f64]| {
                dy.fill(0.0);
                (dy[0], dy[1]) = (y[1], -y[0]);
                Ok(())
            };
            let mut problem = Problem::general(2 * copies, 0, rates, |_, _, blocks| {
                (blocks[0][(0, 1)], blocks[0][(1, 0)]) = (1.0, -1.0);
            });
            problem.blocks = (0..copies).map(|k| 2 * k..2 * k + 2).collect();
            let mut start = vec![0.0; 2 * copies];
            start[0] = 1.0;
            let options = gyration_ode::Options { initial_step: Some(0.01), ..with(method) };
            run(&mut problem, &start, &[], (0.0, 20.0), options).statistics().accepted()
        };
        assert_eq!(count(1), count(50), "{method:?}");
    }
}

/// Bodies that come to touch: the blocks change between two steps, the solution does not notice.
#[test]
fn blocks_may_change_between_steps() {
    for method in [Method::Auto, Method::Implicit] {
        let start = [1.0, 0.0, 0.5, 0.1, -1.0, 0.3];
        let [mut split, mut whole] =
            [true, false].map(|split| oscillators(split, [1.0, 2.0, 3.0], 40.0).tolerances(1e-9, 1e-9));
        let reference = run(&mut whole, &start, &[], (0.0, 5.0), with(method)).state().to_vec();
        let mut integrator = gyration_ode::Integrator::new(0.0, &start, &[], with(method));
        while integrator.time() < 5.0 {
            let problem = if integrator.statistics().accepted() % 7 < 4 { &mut split } else { &mut whole };
            integrator.step(problem, 5.0).unwrap();
        }
        assert!(distance(integrator.state(), &reference) < 1e-6, "{method:?}");
    }
}
