//! A tumbling box under three laws with non-integer exponents, against an independent integration.
//!
//! `oracles/tumbling_box.py` sums the tractions point by point over graded quadratures of the faces and integrates
//! rotation matrix and angular momentum by extrapolation; its numbers are good to 1e-12 m. The box comes down on a
//! corner at 0.130 s (gap 0.65 mm), 0.146 s and 0.176 s, and sweeps an edge past the table at 0.345 s.

use gyration_validation::{Case, Experiment, largest};

const CASE: &str = "tumbling box, three laws, ν = 4.6, 3.3, 2.7, rtol = 1e-10";
const SOURCE: &str = "validation/oracles/tumbling_box.py";
const RTOL: f64 = 1e-10;

const SCENE: &str = r#"
    [time]
    end = 0.35
    sample = 0.025
    [solver]
    rtol = 1e-10
    atol = 1e-12
    [[support]]
    name = "table"
    plane = { origin = [0, 0, 0], normal = [0, 0, 1] }
    [[contact]]
    support = "table"
    repulsion = { alpha = 600.0, nu = 4.6, d0 = 0.01 }
    damping = { beta = 150.0, nu = 3.3, d0 = 0.01 }
    friction = { beta = 100.0, nu = 2.7, d0 = 0.01 }
    [[body]]
    name = "box"
    shape = { box = { size = [0.10, 0.06, 0.03] } }
    density = 1200.0
    position = [0, 0, 0.12]
    orientation = { axis_angle = { axis = [1.0, 2.0, 0.5], angle = 0.7 } }
    velocity = [0.4, -0.2, 0.0]
    angular_velocity = [5.0, -3.0, 8.0]
"#;

/// The oracle's columns and ours.
const COLUMNS: [(&str, &str); 6] =
    [("x", "box.x"), ("y", "box.y"), ("z", "box.z"), ("R_xx", "box.P_xx"), ("R_yz", "box.P_yz"), ("R_zy", "box.P_zy")];

/// The oracle's table: names, and a row for every sample.
fn oracle() -> (Vec<&'static str>, Vec<Vec<f64>>) {
    let mut lines = include_str!("../oracles/tumbling_box.csv").lines();
    let names = lines.next().unwrap_or_default().split(',').collect();
    let numbers = |line: &str| line.split(',').map(|number| number.parse().unwrap_or(f64::NAN)).collect();
    (names, lines.map(numbers).collect())
}

#[test]
fn tumbling_box_agrees_with_an_independent_integration() {
    let run = Experiment::of_scene(SCENE).run();
    let (names, rows) = oracle();
    let reference = |name: &str| {
        let column = names.iter().position(|found| *found == name).unwrap();
        rows.iter().map(move |row| row[column])
    };
    assert_eq!(run.times.len(), rows.len());
    let largest_error = |columns: &[(&str, &str)]| {
        let errors = |(theirs, ours): &(&str, &str)| {
            let pairs = run.column(ours).into_iter().zip(reference(theirs));
            largest(pairs.map(|(measured, expected)| measured - expected))
        };
        largest(columns.iter().map(errors))
    };
    let case = Case { row: None, name: CASE, source: SOURCE };
    // A step errs by rtol × gap; the impacts magnify what has been wrong before by some hundreds.
    let (places, turns) = (largest_error(&COLUMNS[..3]), largest_error(&COLUMNS[3..]));
    case.check("largest error of a coordinate of the centre over 0.35 s [m]", 0.0, places, 1e-7);
    case.check("largest error of an entry of P over 0.35 s", 0.0, turns, 1e-6);
    let residual = run.relative_residual();
    let case = case.by("energies and works integrated apart");
    case.check("largest residual of the ledger over the energy in play", 0.0, residual, 100.0 * RTOL);
}
