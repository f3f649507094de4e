//! `gyration plot` and the summary of `run` for bodies that drive themselves.

use crate::common::{BALL, Sandbox, soft_ball, words};
use serde_json::Value;

/// A box that stretches and shears itself out of phase: it gets somewhere.
const CRAWLER: &str = r#"
title = "A box that crawls"

[time]
end = 0.45
sample = 0.005

[solver]
rtol = 1e-6

[[support]]
name = "table"
plane = {}

[[contact]]
support = "table"
repulsion = { alpha = "1 kPa", nu = 6, d0 = "2 mm" }
damping = { beta = 1e3, nu = 6, d0 = "2 mm" }
friction = { beta = 2e3, nu = 6, d0 = "2 mm" }

[[body]]
name = "crawler"
shape = { box = { size = [0.2, 0.1, 0.1] } }
density = 1000
contractile = { material = { mooney_rivlin = { c1 = 3000, c2 = 1000 } }, viscosity = 20, contraction_viscosity = 50,
                drive = { sum = [
                    { sine = { amplitude = [[600, 0, 0], [0, 0, 0], [0, 0, -600]], frequency = 5 } },
                    { sine = { amplitude = [[0, 0, 600], [0, 0, 0], [0, 0, 0]], frequency = 5, phase = 1.5 } } ] } }
position = [0, 0, 0.052]
"#;

fn recorded(scene: &str) -> Sandbox {
    let sandbox = Sandbox::new();
    sandbox.write("crawler.toml", scene);
    sandbox.done(&["run", "crawler.toml", "--quiet"]);
    sandbox
}

#[test]
fn drives_of_contractile_bodies_are_drawn() {
    let sandbox = recorded(CRAWLER);
    let drawn = |arguments: &[&str]| {
        let arguments = [&["plot", "crawler.gyr"], arguments, &["-o", "-"]].concat();
        let svg = sandbox.done(&arguments).stdout;
        assert!(svg == sandbox.done(&arguments).stdout, "{arguments:?} should have the same bytes again");
        words(&svg)
    };
    let told = |words: &str, all: &[&str]| {
        for expected in all {
            assert!(words.contains(expected), "{expected} is missing in: {words}");
        }
    };
    told(&drawn(&["stroke"]), &["Stroke of crawler", "last cycle, 0.2 s", "1.25 cycles before", "40 samples a cycle"]);
    told(&drawn(&["stroke", "--measures", "G_xx,gap"]), &["gap [", "area"]);
    told(&drawn(&["distance"]), &["along x", "length of the path", "body lengths"]);
    told(&drawn(&["cost"]), &["work/(weight × distance)", "net work", "last cycle"]);
    told(&drawn(&["drive"]), &["work of the drive", "lost in contraction", "lost in viscosity", "power [", "mean: "]);
    let overview = drawn(&[]);
    told(&overview, &["work of the drive", "Level distance", "Stroke of crawler"]);
}

#[test]
fn prescribed_circle_has_its_area_and_its_mirror_image_the_opposite() {
    let scene = |side: f64| {
        let start = CRAWLER.find("contraction_viscosity").unwrap();
        let end = CRAWLER.find("position").unwrap();
        let circle = format!(
            "prescribed = {{ sum = [ {{ constant = {{ value = [[1, 0, 0], [0, 1, 0], [0, 0, 1]] }} }}, \
             {{ sine = {{ amplitude = [[0.1, 0, 0], [0, 0, 0], [0, 0, 0]], frequency = 4 }} }}, \
             {{ sine = {{ amplitude = [[0, 0, {}], [0, 0, 0], [0, 0, 0]], frequency = 4, phase = \"90 deg\" }} }} ] }} }}\n",
            0.1 * side
        );
        format!("{}{circle}{}", &CRAWLER[..start], &CRAWLER[end..])
    };
    let drawn = |side: f64| {
        let sandbox = recorded(&scene(side));
        words(&sandbox.done(&["plot", "crawler.gyr", "stroke", "distance", "-o", "-"]).stdout)
    };
    // 50 samples of a circle of radius 0.1 enclose π/100 sin(2π/50)/(2π/50) = 0.03133; x goes by the sine, y by the
    // cosine.
    let (clockwise, mirrored) = (drawn(1.0), drawn(-1.0));
    assert!(clockwise.contains("area −0.0313") && clockwise.contains("50 samples a cycle"), "{clockwise}");
    assert!(mirrored.contains("area 0.0313") && mirrored.contains("counterclockwise"), "{mirrored}");
    // Both get equally far, to three digits, to opposite sides.
    let gained = |words: &str| {
        let rest = words.split("last cycle: ").nth(1).unwrap().split(" along x").next().unwrap().to_owned();
        (rest.starts_with('−'), rest.trim_start_matches('−').to_owned())
    };
    let (there, back) = (gained(&clockwise), gained(&mirrored));
    assert!(there.1 == back.1 && there.0 != back.0, "{there:?}, {back:?}");
}

#[test]
fn reversing_the_measures_reverses_the_sense() {
    let sandbox = recorded(CRAWLER);
    let drawn = |measures: &str| {
        let svg = sandbox.done(&["plot", "crawler.gyr", "stroke", "--measures", measures, "-o", "-"]).stdout;
        words(&svg)
    };
    let (forth, back, alone) = (drawn("G_xx,G_xz"), drawn("G_xz,G_xx"), drawn("G_xx,G_xx"));
    let counter = |words: &str| (words.contains("counterclockwise"), words.contains("clockwise"));
    assert!(counter(&forth).1 && counter(&back).1 && counter(&forth).0 != counter(&back).0, "{forth}\n{back}");
    assert!(alone.contains("to and fro"), "{alone}");
}

#[test]
fn what_bodies_without_a_drive_do_not_have_is_refused() {
    let sandbox = Sandbox::with_ball();
    sandbox.done(&["run", "ball.toml", "--quiet"]);
    for what in ["stroke", "cost", "drive"] {
        let said = sandbox.refused(2, &["plot", "ball.gyr", what]);
        assert!(said.stderr.contains("no body of the recording contracts"), "{what}: {}", said.stderr);
    }
    sandbox.done(&["plot", "ball.gyr", "distance"]);
    let overview = sandbox.done(&["plot", "ball.gyr", "-o", "-"]).stdout;
    assert!(!words(&overview).contains("Level distance"));
}

#[test]
fn cost_of_transport_without_weight_or_way_is_refused() {
    let short = CRAWLER.replace("0.45", "0.1");
    let weightless = recorded(&short.replace("[time]", "[world]\ngravity = [0, 0, 0]\n\n[time]"));
    let said = weightless.refused(2, &["plot", "crawler.gyr", "cost"]);
    assert!(said.stderr.contains("without gravity"), "{}", said.stderr);
    weightless.done(&["plot", "crawler.gyr", "stroke", "distance", "drive"]);
    // A drive along the axes of symmetry leads nowhere.
    let straight =
        recorded(&short.replace("[[0, 0, 600], [0, 0, 0], [0, 0, 0]]", "[[0, 0, 0], [0, 600, 0], [0, 0, 0]]"));
    let said = straight.refused(2, &["plot", "crawler.gyr", "cost"]);
    assert!(said.stderr.contains("gets anywhere"), "{}", said.stderr);
    // Nor does a shear to and fro, though the body sways by more than the tolerance.
    let scallop = Sandbox::new();
    scallop.done(&["run", "scallop", "--quiet", "-o", "crawler.gyr"]);
    let said = scallop.refused(2, &["plot", "crawler.gyr", "cost"]);
    assert!(said.stderr.contains("in its last cycle"), "{}", said.stderr);
}

#[test]
fn measures_that_are_not_there_are_refused() {
    let sandbox = recorded(&CRAWLER.replace("0.45", "0.05"));
    for measures in ["G_xx", "G_xx,G_xz,G_zz", "G_xx,H_xx", "G_xx,", "crawler.G_xx,G_xz"] {
        let said = sandbox.refused(2, &["plot", "crawler.gyr", "stroke", "--measures", measures]);
        assert!(said.stderr.contains("--measures G_xz,G_zz"), "{measures}: {}", said.stderr);
    }
    let said = sandbox.refused(2, &["plot", "crawler.gyr", "energy", "--measures", "G_xx,G_xz"]);
    assert!(said.stderr.contains("`stroke`"), "{}", said.stderr);
    sandbox.done(&["plot", "crawler.gyr", "stroke", "energy", "--measures", "Q_xx,V_xx"]);
}

#[test]
fn summary_tells_what_the_drive_did_and_that_losses_are_losses() {
    let sandbox = Sandbox::new();
    sandbox.write("crawler.toml", &CRAWLER.replace("0.45", "0.1"));
    let said = sandbox.done(&["run", "crawler.toml"]).stderr;
    let line = said.lines().find(|line| line.starts_with("drive ")).unwrap_or_else(|| panic!("{said}"));
    for expected in ["did ", "contraction lost ", "viscosity lost ", "both dissipate"] {
        assert!(line.contains(expected), "{line}");
    }
    let json = sandbox.done(&["run", "crawler.toml", "--force", "--json"]).stdout;
    let summary: Value = serde_json::from_str(&json).unwrap();
    assert!(summary["ledger"]["least_dissipation"]["contraction"].is_f64(), "{json}");
    // Without a drive the losses are told alone, and without losses nothing is.
    sandbox.write("soft.toml", &soft_ball().replace("end = 0.6", "end = 0.25"));
    let said = sandbox.done(&["run", "soft.toml"]).stderr;
    assert!(said.contains("\nviscosity  lost ") && said.contains("; it dissipates "), "{said}");
    sandbox.write("ball.toml", &BALL.replace("end = 0.6", "end = 0.05"));
    let said = sandbox.done(&["run", "ball.toml"]).stderr;
    assert!(!said.contains("dissipate"), "{said}");
}
