//! Derivatives at all samples, and what becomes of them as the tolerance goes down.

use crate::sensitivities::bodies::tumbling;
use crate::sensitivities::support::{TIGHT, at_end, scene, strings};
use gyration_sim::sensitivity::{At, Sensitivities};

const QUANTITIES: [&str; 5] = ["box.x", "box.z", "box.P_xy", "energy.kinetic", "work.damping"];

#[test]
fn derivatives_at_samples_agree_with_differences_of_runs() {
    let key = "contact.0.damping.beta";
    let along = |overrides: &[String]| {
        let keys = strings(&[key]);
        Sensitivities::along(&scene(&tumbling(), overrides), &keys, &strings(&QUANTITIES), At::Samples).unwrap()
    };
    let finer = |more: &[String]| [&strings(&TIGHT), more, &strings(&["time.sample=0.025"])].concat();
    let found = along(&finer(&[]));
    assert_eq!((found.times.len(), found.derivatives[0].rows.len()), (21, 21));
    let step = 1e-4 * found.numbers[0];
    let runs = [-2.0, -1.0, 1.0, 2.0].map(|k| along(&finer(&[format!("{key}={:?}", found.numbers[0] + k * step)])));
    let mut worst: f64 = 0.0;
    for column in 0..QUANTITIES.len() {
        let value = |run: &Sensitivities, row: usize| run.values[row][column];
        let expected = |row: usize| {
            let [a, b, c, d] = [0, 1, 2, 3].map(|k: usize| value(&runs[k], row));
            (8.0 * (c - b) - (d - a)) / (12.0 * step)
        };
        let largest = (0..21).map(|row| expected(row).abs()).fold(0.0, f64::max);
        for row in 0..21 {
            let off = (found.derivatives[0].rows[row][column] - expected(row)).abs() / largest;
            worst = worst.max(off);
        }
    }
    println!("worst of 21 samples and {} quantities: {worst:.1e}", QUANTITIES.len());
    // Growth of 1e5 of runs at 1e-11, over steps of 1e-4.
    assert!(worst < 1e-6, "{worst:e}");
}

#[test]
fn values_are_those_of_their_columns_whatever_else_is_recorded() {
    let along = |more: &str| {
        let overrides = [strings(&TIGHT), strings(&["time.end=0.1", more])].concat();
        let keys = strings(&["contact.0.damping.beta"]);
        let found = Sensitivities::along(&scene(&tumbling(), &overrides), &keys, &strings(&QUANTITIES), At::End);
        found.unwrap().values
    };
    assert_eq!(along("time.sample=0.1"), along("record={ quantities = [\"rotation\", \"affine_moment\"] }"));
}

#[test]
fn derivatives_converge_as_the_tolerance_goes_down() {
    let keys = ["contact.0.damping.beta", "body.box.angular_velocity.1"];
    let derivatives = |rtol: f64| -> Vec<f64> {
        let overrides = [format!("solver.rtol={rtol:e}"), "solver.atol=1e-13".into(), "time.end=0.3".into()];
        let found = at_end(&scene(&tumbling(), &overrides), &keys, &QUANTITIES);
        found.derivatives.iter().flat_map(|derivatives| derivatives.at_end().unwrap().to_vec()).collect()
    };
    let exact = derivatives(1e-11);
    let error = |rtol: f64| {
        let apart = derivatives(rtol).into_iter().zip(&exact).map(|(value, exact)| (value / exact - 1.0).abs());
        apart.fold(0.0, f64::max)
    };
    let errors = [1e-5, 1e-6, 1e-7, 1e-8].map(error);
    println!("errors at 1e-5 … 1e-8: {errors:?}");
    // A thousandth of the tolerance leaves a hundredth of the error at most.
    assert!(errors[3] < 1e-2 * errors[0] && errors[3] < 1e-4, "{errors:?}");
}
