//! The randomness of a run depends on the seed, its number and the name of the parameter alone, and has the
//! distribution that is asked for.

use crate::common::sandbox;
use gyration_study::{Row, Study, Value};
use std::f64::consts::TAU;

/// Runs of no length: only their parameters are looked at.
fn rows(parameters: &str, head: &str) -> (Study, Vec<Row>) {
    let sandbox = sandbox();
    let text = format!("scene = \"ball.toml\"\n{head}\n[set]\n\"time.end\" = 1e-9\n\"time.sample\" = 1\n{parameters}");
    let study = Study::parse("s.toml", &text, sandbox.path(), &[]).unwrap_or_else(|error| panic!("{error}"));
    let rows = (0..study.runs()).map(|run| study.row(run)).collect();
    (study, rows)
}

fn column(study: &Study, rows: &[Row], name: &str) -> Vec<f64> {
    let index = study.columns().iter().position(|column| column.name == name).unwrap();
    rows.iter().map(|row| row.values[index].number().unwrap()).collect()
}

/// Mean and variance, which must be those expected within four standard errors: √(σ²/N), and √((κ − 1) σ⁴/N) with the
/// kurtosis κ.
fn moments(values: &[f64], mean: f64, variance: f64, kurtosis: f64) {
    let n = values.len() as f64;
    let found = values.iter().sum::<f64>() / n;
    let spread = values.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>() / n;
    println!("mean {found:.5} ({mean:.5}), variance {spread:.5} ({variance:.5}), N = {n}");
    assert!((found - mean).abs() < 4.0 * (variance / n).sqrt(), "mean {found}, expected {mean}");
    assert!(
        (spread - variance).abs() < 4.0 * variance * ((kurtosis - 1.0) / n).sqrt(),
        "{spread}, expected {variance}"
    );
}

const UNIFORM: &str = "[parameter.a]\nkey = \"body.ball.position.0\"\nuniform = { from = -1, to = 3 }\n";
const NORMAL: &str = "[parameter.b]\nkey = \"body.ball.position.1\"\nnormal = { mean = 2, deviation = 0.5 }\n";
const LOG: &str = "[parameter.c]\nkey = \"body.ball.density\"\nlog_uniform = { from = 1, to = 1000 }\n";
const ROTATION: &str = "[parameter.r]\nkey = \"body.ball.orientation\"\nrotation = \"uniform\"\n";
const DIRECTION: &str =
    "[parameter.d]\nkey = \"body.ball.velocity\"\ndirection = { magnitude = { from = 1, to = 2 } }\n";

#[test]
fn distributions_have_their_moments() {
    for sampling in ["random", "latin_hypercube", "sobol"] {
        let head = format!("repetitions = 2000\nsampling = \"{sampling}\"");
        let (study, rows) = rows(&[UNIFORM, NORMAL, LOG, ROTATION, DIRECTION].concat(), &head);
        moments(&column(&study, &rows, "a"), 1.0, 16.0 / 12.0, 1.8);
        moments(&column(&study, &rows, "b"), 2.0, 0.25, 3.0);
        let logarithms: Vec<f64> = column(&study, &rows, "c").iter().map(|value| value.log10() / 3.0).collect();
        moments(&logarithms, 0.5, 1.0 / 12.0, 1.8);
        // Each component of R e_z is uniform over −1 to 1 (Archimedes), and so is each of a direction.
        let [w, x, y, z] = ["r.w", "r.x", "r.y", "r.z"].map(|name| column(&study, &rows, name));
        let norm = |k: usize| w[k] * w[k] + x[k] * x[k] + y[k] * y[k] + z[k] * z[k];
        assert!((0..w.len()).all(|k| (norm(k) - 1.0).abs() < 1e-14));
        let along = |f: &dyn Fn(usize) -> f64| (0..w.len()).map(f).collect::<Vec<f64>>();
        moments(&along(&|k| 2.0 * (x[k] * z[k] + w[k] * y[k])), 0.0, 1.0 / 3.0, 1.8);
        moments(&along(&|k| 2.0 * (y[k] * z[k] - w[k] * x[k])), 0.0, 1.0 / 3.0, 1.8);
        moments(&along(&|k| 1.0 - 2.0 * (x[k] * x[k] + y[k] * y[k])), 0.0, 1.0 / 3.0, 1.8);
        // tr R = 1 + 2 cos θ, of mean 0 and variance 1 over the rotations; its fourth moment is 3.
        moments(&along(&|k| 4.0 * w[k] * w[k] - 1.0), 0.0, 1.0, 3.0);
        let [x, y, z] = ["d.x", "d.y", "d.z"].map(|name| column(&study, &rows, name));
        let length = |k: usize| f64::hypot(f64::hypot(x[k], y[k]), z[k]);
        moments(&along(&length), 1.5, 1.0 / 12.0, 1.8);
        moments(&along(&|k| z[k] / length(k)), 0.0, 1.0 / 3.0, 1.8);
        moments(&along(&|k| y[k].atan2(x[k]) / TAU), 0.0, 1.0 / 12.0, 1.8);
    }
}

#[test]
fn latin_hypercubes_and_sobol_points_are_stratified() {
    // One in each of as many parts as there are repetitions, of each coordinate; Sobol's where they are a power of two.
    for (sampling, repetitions) in
        [("latin_hypercube", 37), ("latin_hypercube", 64), ("latin_hypercube", 1), ("sobol", 64)]
    {
        let head = format!("repetitions = {repetitions}\nsampling = \"{sampling}\"");
        let axis = "[parameter.g]\nkey = \"body.ball.position.1\"\nvalues = [1, 2, 3]\n";
        let (study, rows) = rows(&[axis, UNIFORM, LOG].concat(), &head);
        let parts = |values: &[f64], from: f64, to: f64| {
            let mut parts: Vec<i64> = values
                .iter()
                .map(|value| ((value - from) / (to - from) * f64::from(repetitions)).floor() as i64)
                .collect();
            let order = parts.clone();
            parts.sort_unstable();
            assert!(parts.into_iter().eq(0..i64::from(repetitions)), "{sampling}, {repetitions}");
            order
        };
        let uniform = column(&study, &rows, "a");
        let logarithms: Vec<f64> = column(&study, &rows, "c").iter().map(|value| value.log10()).collect();
        let count = repetitions as usize;
        let orders: Vec<Vec<i64>> = (0..3)
            .flat_map(|point| {
                let range = point * count..(point + 1) * count;
                [parts(&uniform[range.clone()], -1.0, 3.0), parts(&logarithms[range], 0.0, 3.0)]
            })
            .collect();
        // Points and parameters have orders of their own.
        assert!(repetitions == 1 || (0..6).all(|a| (0..a).all(|b| orders[a] != orders[b])));
    }
}

#[test]
fn runs_are_the_same_in_any_order_and_company() {
    for sampling in ["random", "latin_hypercube", "sobol"] {
        let head = format!("repetitions = 20\nseed = 3\nsampling = \"{sampling}\"");
        let (study, together) = rows(&[UNIFORM, NORMAL].concat(), &head);
        let backwards: Vec<Row> = (0..study.runs()).rev().map(|run| study.row(run)).collect();
        assert!(together.iter().eq(backwards.iter().rev()));
        let (reordered, swapped) = rows(&[NORMAL, UNIFORM].concat(), &head);
        if sampling != "sobol" {
            assert_eq!(column(&study, &together, "a"), column(&reordered, &swapped, "a"));
        }
        let (_, other) = rows(&[UNIFORM, NORMAL].concat(), &head.replace("seed = 3", "seed = 4"));
        let other = column(&study, &other, "a");
        assert!(column(&study, &together, "a").iter().zip(&other).all(|(a, b)| a != b));
    }
}

#[test]
fn grids_are_crossed_with_the_first_axis_slowest() {
    let axes = "[parameter.x]\nkey = \"body.ball.position.0\"\nvalues = [\"1 cm\", 2]\n\
                [parameter.y]\nkeys = [\"body.ball.position.1\", \"body.ball.velocity.1\"]\ngrid = { from = 1, to = 100, count = 3, spacing = \"log\" }\n\
                [parameter.z]\nkey = \"body.ball.velocity\"\nvalues = [[1, 2, 3], [4, 5, \"6 cm/s\"]]\nwith = \"x\"\n";
    let axes = axes.replace(", \"body.ball.velocity.1\"", "");
    let (study, rows) = rows(&axes, "repetitions = 2");
    assert_eq!((study.axes(), study.points(), study.runs()), (&[2, 3][..], 6, 12));
    let numbers = |name: &str| column(&study, &rows, name);
    assert_eq!(numbers("point"), [0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5].map(f64::from));
    assert_eq!(numbers("repetition")[..4], [0.0, 1.0, 0.0, 1.0]);
    assert_eq!(numbers("x"), [[0.01; 6], [2.0; 6]].concat());
    assert_eq!(numbers("z.z"), [[3.0; 6], [0.06; 6]].concat());
    let y = numbers("y");
    assert_eq!((y[0], y[4]), (1.0, 100.0));
    assert!((y[2] - 10.0).abs() < 1e-14);
    let unit = |name: &str| study.columns().iter().find(|column| column.name == name).unwrap().unit.clone();
    assert_eq!([unit("x"), unit("z.z"), unit("point")], [Some("m".into()), Some("m/s".into()), None]);
    assert!(rows.iter().all(|row| row.values.contains(&Value::Text("completed".into()))));
}
