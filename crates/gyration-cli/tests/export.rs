//! `gyration export` and `gyration plot`: columns, formats, stdout, the same bytes for the same recording.

#![allow(clippy::unwrap_used)]

mod common;

use common::{BALL, Sandbox};
use std::fs;
use std::io::Read;
use std::process::Stdio;

fn recorded() -> Sandbox {
    let sandbox = Sandbox::with_ball();
    sandbox.done(&["run", "ball.toml", "--quiet"]);
    sandbox
}

#[test]
fn csv_has_the_columns_of_the_contract() {
    let sandbox = recorded();
    let csv = sandbox.done(&["export", "ball.gyr", "--format", "csv", "-o", "-"]);
    assert_eq!(csv.stderr, "");
    let mut lines = csv.stdout.lines();
    let matrix = |name: &str| {
        ["xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"].map(|at| format!("ball.{name}_{at}")).join(",")
    };
    let header = format!(
        "t,ball.x,ball.y,ball.z,{},ball.vx,ball.vy,ball.vz,{},ball.gap,ball.fx,ball.fy,ball.fz,energy.kinetic,\
         energy.gravity,energy.contact,work.damping,work.friction,energy.residual",
        matrix("P"),
        matrix("Pdot")
    );
    assert_eq!(lines.next(), Some(header.as_str()));
    let rows: Vec<Vec<f64>> =
        lines.map(|line| line.split(',').map(|number| number.parse().unwrap()).collect()).collect();
    assert!(rows.iter().all(|row| row.len() == header.split(',').count()));
    // Samples at k·sample, multiplied; the last is the end.
    let times: Vec<f64> = rows.iter().map(|row| row[0]).collect();
    let expected: Vec<f64> = (0..60).map(|k| f64::from(k) * 0.01).chain([0.6]).collect();
    assert_eq!(times, expected);
    assert_eq!(rows[0][1..4], [0.0, 0.0, 0.2]);
}

#[test]
fn exports_have_default_names() {
    let sandbox = recorded();
    assert_eq!(sandbox.done(&["export", "ball.gyr/", "--format", "csv"]).stdout, "");
    sandbox.done(&["export", "ball.gyr", "--format", "npz"]);
    assert_eq!(sandbox.names(), ["ball.csv", "ball.gyr", "ball.npz", "ball.toml"]);
    assert!(fs::read(sandbox.path("ball.npz")).unwrap().starts_with(b"PK\x03\x04"));
}

#[test]
fn what_cannot_be_exported_is_refused() {
    let sandbox = recorded();
    sandbox.refused(2, &["export", "ball.gyr", "--format", "gltf"]);
    sandbox.refused(2, &["export", "ball.gyr", "--format", "npz", "-o", "-"]);
    sandbox.refused(3, &["export", "nothing.gyr", "--format", "csv"]);
    sandbox.refused(3, &["export", "ball.toml", "--format", "csv"]);
    sandbox.refused(3, &["export", "ball.gyr", "--format", "csv", "-o", "no/such/folder.csv"]);
}

#[test]
fn closed_pipes_are_quiet() {
    let sandbox = Sandbox::with_ball();
    // More rows than a pipe holds.
    sandbox.done(&["run", "ball.toml", "--quiet", "--set", "time.sample=1e-4"]);
    for arguments in [&["export", "ball.gyr", "--format", "csv", "-o", "-"][..], &["schema"]] {
        let mut child = sandbox.command(arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let mut start = [0; 16];
        child.stdout.take().unwrap().read_exact(&mut start).unwrap();
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{arguments:?}");
        assert_eq!(output.stderr, b"", "{arguments:?}");
    }
}

#[test]
fn pictures_come_in_the_format_of_their_ending() {
    let sandbox = recorded();
    for (name, start) in [("a.svg", &b"<svg"[..]), ("a.png", b"\x89PNG\r\n\x1a\n"), ("a.pdf", b"%PDF-1.")] {
        let arguments = ["plot", "ball.gyr", "strip", "height", "gap", "energy", "forces", "laws", "-o", name];
        sandbox.done(&arguments);
        let first = fs::read(sandbox.path(name)).unwrap();
        assert!(first.starts_with(start), "{name}");
        sandbox.done(&arguments);
        assert!(first == fs::read(sandbox.path(name)).unwrap(), "{name} should have the same bytes again");
    }
    let svg = sandbox.done(&["plot", "ball.gyr", "height", "-o", "-"]).stdout;
    assert!(svg.starts_with("<svg") && svg.ends_with("</svg>\n"));
    sandbox.done(&["plot", "ball.gyr"]);
    sandbox.done(&["plot", "ball.toml"]);
    assert!(sandbox.path("ball-overview.svg").exists() && sandbox.path("ball-laws.svg").exists());
    let overview = fs::read(sandbox.path("ball.gyr/overview.svg")).unwrap();
    assert!(overview == fs::read(sandbox.path("ball-overview.svg")).unwrap());
}

#[test]
fn what_cannot_be_drawn_is_refused() {
    let sandbox = recorded();
    let said = sandbox.refused(2, &["plot", "ball.toml", "height"]);
    assert!(said.stderr.contains("gyration run"), "{}", said.stderr);
    sandbox.refused(2, &["plot", "ball.gyr", "-o", "ball.jpeg"]);
    sandbox.refused(3, &["plot", "nothing"]);
    fs::create_dir(sandbox.path("empty.gyr")).unwrap();
    sandbox.refused(3, &["plot", "empty.gyr"]);
    let without = BALL.split("[[contact]]").next().unwrap().to_owned()
        + "[[body]]\nname = \"p\"\nshape = { sphere = { radius = 1 } }\ndensity = 1\nposition = [0, 0, 2]\n";
    sandbox.write("free.toml", &without);
    sandbox.refused(2, &["plot", "free.toml", "laws"]);
}
