//! What can be wrong with a lattice, each at its exact place (`§`), with the fix.

use crate::common::{TIME, assert_error};
use gyration_scene::Scene;
use std::path::Path;

const POINT: &str = "[[body]]\nname = \"a\"\nshape = { points = [{ mass = 1, at = [0, 0, 0] }] }\n";
const WEIGHTLESS: &str = "[world]\ngravity = [0, 0, 0]\n";
const CHAIN: &str = "[lattice]\ncell = [[1, 0, 0]]\n";

#[test]
fn errors_of_a_lattice_stand_at_their_place() {
    let spring = |ends: &str| format!("[[spring]]\nbetween = [\"a\", \"a\"]\nstiffness = 1\n{ends}\n");
    let rows = [
        ("[lattice]\ncell = §[[1, 0, 0], [2, 0, 0]]".to_owned(), "lattice.cell", "depend on one another", "span"),
        ("[lattice]\ncell = §[[0, 0, 0]]".to_owned(), "lattice.cell", "cell vector 1 is zero", "span"),
        (
            format!("{CHAIN}relax = [\"cell\"]\nstress = §[[0, 0, 0], [0, 1, 0], [0, 0, 0]]"),
            "lattice.stress",
            "across the cell vectors",
            "in the space that they span",
        ),
        (
            format!(
                "{CHAIN}repeat = [8, 1, 1]\n\
                 wave = {{ kappa = [0.1, 0, 0], amplitude = 1e-3, at = [4, §1, 0], width = 1 }}"
            ),
            "lattice.wave.at.1",
            "has 1 cell vectors",
            "write 0",
        ),
        (
            format!(
                "{CHAIN}[[bond]]\nbetween = [\"a\", \"a\"]\ncell = [1, 0, 0]\nlaw = \"l^2\"\n\
                 axes = §[[1, 0, 0], [0, 1, 0]]"
            ),
            "bond.0.axes",
            "this bond has neither",
            "leave them out",
        ),
        (format!("{CHAIN}periodic = §[true, false]"), "lattice.periodic", "2 entries for 1 cell vectors", "write true"),
        (format!("{CHAIN}repeat = [4, §2, 1]"), "lattice.repeat.1", "no cell vector 2", "write 1"),
        (format!("{CHAIN}§period = true"), "lattice.period", "unknown key", "`periodic`"),
        (format!("{CHAIN}{}", spring("cell = [1, §1, 0]")), "spring.0.cell.1", "has 1 cell vectors", "write 0"),
        (
            format!("{CHAIN}relax = [\"cell\"]\npressure = §\"1 kPa\""),
            "lattice.pressure",
            "of a chain this is a force",
            "\"3 N\"",
        ),
        (
            format!(
                "{CHAIN}[[bond]]\nbetween = [\"a\", \"a\"]\ncell = [1, 0, 0]\n\
                 stiffness = [\"1 N/m\", \"1 N/mm\", 1, \"1 N m\", §\"1 N/m\", 1]"
            ),
            "bond.0.stiffness.4",
            "this is a torque",
            "\"0.1 N m\"",
        ),
        (format!("{CHAIN}pressure = §1"), "lattice.pressure", "stay as they are written", "relax"),
        (
            format!("{CHAIN}relax = [\"cell\"]\nstress = §[[0, 1, 0], [0, 0, 0], [0, 0, 0]]"),
            "lattice.stress",
            "not symmetric",
            "across the diagonal",
        ),
        (format!("{CHAIN}repeat = [§4.5, 1, 1]"), "lattice.repeat.0", "must be whole", "whole number from 1"),
        (format!("{CHAIN}repeat = [§0, 1, 1]"), "lattice.repeat.0", "at least 1", "whole number from 1"),
        (spring("cell = [§1.5, 0, 0]"), "spring.0.cell.0", "must be whole", "write a whole number"),
        (
            format!("{CHAIN}repeat = [8, 1, 1]\nabsorb = §{{ cells = 2, rate = 5 }}"),
            "lattice.absorb",
            "nothing is free",
            "periodic = false",
        ),
        (
            format!("{CHAIN}repeat = [8, 1, 1]\nperiodic = false\nabsorb = {{ cells = §5, rate = 5 }}"),
            "lattice.absorb.cells",
            "have 10 cells together",
            "write 4 or fewer",
        ),
        (spring("cell = §[1, 0, 0]"), "spring.0.cell", "no `[lattice]`", "add a lattice"),
    ];
    for (lines, key, message, help) in rows {
        assert_error(&format!("{TIME}{WEIGHTLESS}{POINT}{lines}\n"), key, message, help);
    }
}

#[test]
fn forces_of_a_lattice_look_alike_from_every_cell_and_its_errors_come_alone() {
    let body = |force: &str| format!("{TIME}{WEIGHTLESS}{CHAIN}{POINT}body_force = §[\"{force}\", \"0\", \"0\"]\n");
    assert_error(&body("-0.1*x"), "body.a.body_force", "changes along cell vector 1", "those of the body's own cell");
    for alike in ["sin(2*pi*x)*cos(t)", "-0.1*y"] {
        let text = body(alike).replace('§', "");
        assert!(Scene::parse("scene.toml", &text, Path::new(""), &[]).is_ok(), "{alike}");
    }
    let ball = "[[body]]\nname = \"b\"\nshape = { sphere = { radius = 0.1 } }\nmass = 1\nposition = [0, 0, 1]\n";
    let at_point = "force = [{ point = [0, 0, 0.1], value = §[\"x\", \"0\", \"0\"] }]\n";
    let text = format!("{TIME}{WEIGHTLESS}{CHAIN}{ball}{at_point}");
    assert_error(&text, "body.b.force.0.value", "changes along cell vector 1", "let it repeat");
    let turning = "[[support]]\nname = \"table\"\nplane = {}\nmotion = §{ rotate = { axis = [0, 0, 1], rate = 1 } }\n\
                   [[contact]]\nsupport = \"table\"\nrepulsion = { alpha = 1, nu = 6, d0 = 0.01 }\n";
    let text = format!("{TIME}{WEIGHTLESS}{CHAIN}{turning}{ball}");
    assert_error(&text, "support.table.motion", "moves otherwise along cell vector 1", "rotate");
    let spring = "[[spring]]\nbetween = [\"a\", \"a\"]\ncell = [1, 0, 0]\nstiffness = 1\n";
    let text = format!("{TIME}{WEIGHTLESS}{POINT}[lattice]\ncell = §[[0, 0, 0]]\n{spring}");
    assert_error(&text, "lattice.cell", "cell vector 1 is zero", "span");
}

#[test]
fn overlap_with_an_image_is_told_as_that() {
    let ball = "[[body]]\nname = \"a\"\nshape = { sphere = { radius = 0.6 } }\ndensity = 1\n";
    let law = "repulsion = { alpha = 1, nu = 6, d0 = 0.01 }\nreach = 0.1\n";
    let text = format!("{TIME}{WEIGHTLESS}{CHAIN}{ball}[[contact]]\nbetween = §[\"a\", \"a\"]\n{law}");
    assert_error(&text, "contact.0.between", "the image of \"a\" in the cell [1, 0, 0]", "lengthen the cell vectors");
}

#[test]
fn a_spring_of_a_body_with_itself_needs_another_cell() {
    let spring = "[[spring]]\nbetween = [\"a\", §\"a\"]\nstiffness = 1\n";
    let key = "spring.0.between.1";
    assert_error(&format!("{TIME}{WEIGHTLESS}{POINT}{CHAIN}{spring}"), key, "both ends are at the body", "");
    let here = format!("{spring}cell = [0, 0, 0]\n");
    assert_error(&format!("{TIME}{WEIGHTLESS}{POINT}{CHAIN}{here}"), key, "both ends are at the body", "");
}

#[test]
fn gravity_needs_something_that_holds_a_lattice() {
    let text = format!("{TIME}[world]\ngravity = §[0, 0, -9.81]\n{POINT}{CHAIN}");
    assert_error(&text, "world.gravity", "nothing holds them", "gravity = [0, 0, 0]");
}

/// What is written with units is what is written in SI.
#[test]
fn stresses_and_stiffnesses_have_units() {
    let scene = |stress: &str, stiffness: &str, damping: &str| {
        let text = format!(
            "{TIME}{WEIGHTLESS}[lattice]\ncell = [[1, 0, 0], [0, 1, 0]]\nrelax = [\"cell\"]\n{stress}\n{POINT}\
             [[bond]]\nbetween = [\"a\", \"a\"]\ncell = [1, 0, 0]\nstiffness = {stiffness}\ndamping = {damping}\n"
        );
        Scene::parse("scene.toml", &text, Path::new(""), &[]).unwrap_or_else(|errors| panic!("{errors}"))
    };
    let rows = |zero: &str, entries: [&str; 6]| {
        let row = |i: usize| (0..6).map(|j| if i == j { entries[i] } else { zero }).collect::<Vec<_>>().join(", ");
        format!("[{}]", (0..6).map(|i| format!("[{}]", row(i))).collect::<Vec<_>>().join(", "))
    };
    let plain = scene(
        "stress = [[3, 0, 0], [0, 2e3, 0], [0, 0, 0]]",
        "[50e3, 20, 20, 0, 0, 0]",
        &rows("0", ["1", "2e-3", "0", "0", "0", "0"]),
    );
    let written = scene(
        "stress = [[\"3 N/m\", 0, 0], [0, \"2 N/mm\", 0], [0, 0, 0]]",
        "[\"50 N/mm\", \"20 N/m\", 20, \"0 N m/rad\", 0, 0]",
        &rows("0", ["\"1 N s/m\"", "\"2 N s/km\"", "0", "\"0 mN m s\"", "0", "0"]),
    );
    assert_eq!(plain.resolved(), written.resolved());
    assert_eq!(plain.built().model.bonds(), written.built().model.bonds());
}
