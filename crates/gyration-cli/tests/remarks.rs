//! What the program says of scenes that run all the same: `check` in its text, `run` on stderr, both in JSON.

use crate::common::{Sandbox, assert_same_bytes};
use serde_json::Value;

/// Two balls in a fluid; or, without it, two balls that no contact joins.
fn balls(distance: f64, inclusion: &str, head: &str) -> String {
    let ball = |name: &str, x: f64| {
        format!(
            "[[body]]\nname = \"{name}\"\nshape = {{ sphere = {{ radius = 0.005 }} }}\ndensity = 2500\n\
             position = [{x:?}, 0, 1]\n{inclusion}\n"
        )
    };
    format!("[time]\nend = 0.01\nsample = 0.005\n{head}{}{}", ball("a", 0.0), ball("b", distance))
}

#[test]
fn a_note_is_told_and_a_warning_stands_in_the_recording() {
    let sandbox = Sandbox::new();
    sandbox.write("apart.toml", &balls(0.1, "", ""));
    let note = "\"a\" and \"b\" do not meet: no contact says so";
    assert!(sandbox.done(&["check", "apart.toml"]).stdout.contains(&format!("\nnote       {note}\n")));
    let said = sandbox.done(&["run", "apart.toml"]);
    assert!(said.stderr.contains(&format!("gyration: note: {note}\n")) && !said.stderr.contains("warning"));
    assert_eq!(sandbox.done(&["run", "apart.toml", "--quiet", "-o", "quiet.gyr"]).stderr, "");
    let fluid = "[fluid]\nviscosity = 1.0\ndensity = 1000\n";
    sandbox.write("fluid.toml", &balls(0.0105, "inclusion = { inertia = false }", fluid));
    let told = sandbox.done(&["check", "fluid.toml", "--json"]).stdout;
    let told: Value = serde_json::from_str(&told).unwrap();
    let warning = told["warnings"][0].as_str().unwrap();
    assert!(warning.contains("the fluid between") && warning.contains("1.54"), "{warning}");
    let said = sandbox.done(&["run", "fluid.toml", "--quiet"]);
    assert!(said.stderr.contains(&format!("gyration: warning: {warning}\n")), "{}", said.stderr);
    let summary = sandbox.done(&["run", "fluid.toml", "--json", "-o", "again.gyr"]).stdout;
    let summary: Value = serde_json::from_str(&summary).unwrap();
    assert!(summary["warnings"][0].as_str().unwrap().contains("the fluid between"), "{summary}");
    assert_same_bytes(&sandbox.path("fluid.gyr"), &sandbox.path("again.gyr"));
}

/// A box and a small cube aslant above it, with a law that hardly forbids touching: the plane between them is nearer to
/// a corner of the box than digits tell.
#[test]
fn a_start_that_a_run_refuses_is_refused_by_check_unless_it_is_out_of_reach() {
    let sandbox = Sandbox::new();
    let scene = |place: [f64; 3]| {
        format!(
            "world = {{ gravity = [0, 0, 0] }}\ntime = {{ end = 1, sample = 1 }}
            [[contact]]\nbetween = [\"a\", \"b\"]\nreach = 0.2\nrepulsion = {{ alpha = 1, nu = 2, d0 = 0.1 }}
            [[body]]\nname = \"a\"\nmass = 1\nshape = {{ box = {{ size = [0.2, 0.2, 0.5] }} }}
            [[body]]\nname = \"b\"\nmass = 1\nshape = {{ box = {{ size = [0.0005, 0.0005, 0.0005] }} }}
            position = {place:?}\nvelocity = [0, 0, -0.1]\n"
        )
    };
    sandbox.write("near.toml", &scene([0.15, 0.14, 0.3]));
    sandbox.write("far.toml", &scene([11.0, 9.0, 20.0]));
    for command in ["check", "run"] {
        let said = sandbox.refused(2, &[command, "near.toml"]);
        assert!(said.stderr.contains("the plane between"), "{command}: {}", said.stderr);
        sandbox.done(&[command, "far.toml"]);
    }
    let rows = sandbox.done(&["export", "far.gyr", "--format", "csv", "-o", "-"]).stdout;
    let cells: Vec<Vec<&str>> = rows.lines().take(2).map(|line| line.split(',').collect()).collect();
    let column = cells[0].iter().position(|name| *name == "a.gap").unwrap();
    let (gap, distance) = (cells[1][column].parse::<f64>().unwrap(), 10.9_f64.hypot(8.9).hypot(19.75));
    // Some slab between them: half their distance at least, and never more than it.
    assert!(gap > 0.5 * (distance - 0.01) && gap < distance, "{gap} of {distance}");
}
