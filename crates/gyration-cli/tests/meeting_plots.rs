//! `gyration plot` for bodies that meet, and for many.

use crate::common::{Sandbox, words};
use std::fmt::Write as _;

/// A ball flies at one that rests, head on, without support or gravity; others are far aside.
fn balls(more: &str) -> String {
    format!(
        r#"
title = "Two balls meet"
[world]
gravity = [0, 0, 0]
[time]
end = 0.4
sample = 0.01
[[contact]]
between = ["a", "b"]
repulsion = {{ alpha = 100.0, nu = 6, d0 = 0.001 }}
[[body]]
name = "a"
shape = {{ sphere = {{ radius = 0.05 }} }}
mass = 1.0
position = [0, 0.02, 0]
velocity = [0.3, 0, 0]
[[body]]
name = "b"
shape = {{ sphere = {{ radius = 0.05 }} }}
mass = 1.0
position = [0.15, 0, 0]
{more}"#
    )
}

fn recorded(scene: &str) -> Sandbox {
    let sandbox = Sandbox::new();
    sandbox.write("scene.toml", scene);
    sandbox.done(&["run", "scene.toml", "--quiet"]);
    sandbox
}

fn drawn(sandbox: &Sandbox, arguments: &[&str]) -> String {
    words(&sandbox.done(&[&["plot"], arguments, &["-o", "-"]].concat()).stdout)
}

#[test]
fn laws_between_bodies_are_drawn_and_named_by_their_bodies() {
    let sandbox = recorded(&balls(""));
    for source in ["scene.toml", "scene.gyr"] {
        let told = drawn(&sandbox, &[source, "laws"]);
        for expected in
            ["Tractions of the central laws", "repulsion (a – b): ν = 6", "Force of the central laws", "slab"]
        {
            assert!(told.contains(expected), "{source}: no {expected:?} in {told}");
        }
    }
}

#[test]
fn laws_between_many_bodies_are_named_by_their_groups() {
    let ball = |name: &str, x: f64, group: &str| {
        format!(
            "[[body]]\nname = \"{name}\"\ngroup = \"{group}\"\nshape = {{ sphere = {{ radius = 0.05 }} }}\nmass = 1.0\n\
             position = [{x}, 1, 0]\n"
        )
    };
    let mut more = String::new();
    for k in 0..3 {
        more += &ball(&format!("grain-{k}"), 0.3 * f64::from(k), "grains");
        more += &ball(&format!("steel-{k}"), 0.3 * f64::from(k) + 0.15, "steel");
    }
    more += "[[contact]]\nbetween = [\"grains\", \"steel\"]\nrepulsion = { alpha = 10.0, nu = 5, d0 = 0.001 }\n";
    let sandbox = Sandbox::new();
    sandbox.write("scene.toml", &balls(&more));
    let told = drawn(&sandbox, &["scene.toml", "laws"]);
    assert!(told.contains("(grains – steel): ν = 5") && told.contains("(a – b): ν = 6"), "{told}");
}

#[test]
fn a_push_without_friction_is_a_normal_force_whatever_its_direction() {
    let sandbox = recorded(&balls(""));
    let told = drawn(&sandbox, &["scene.gyr", "forces"]);
    assert!(told.contains("Force of contact") && !told.contains("tangential"), "{told}");
}

#[test]
fn recorded_peaks_and_impulses_take_the_place_of_sampled_forces() {
    for (asked, shown, hidden) in [
        ("\"peak_force\", \"impulse\"", ["Force of contact", "peaks from sample to sample"], "sampled every"),
        ("\"impulse\"", ["Force of contact", "means from sample to sample"], "peaks"),
    ] {
        let sandbox = recorded(&balls(&format!("[record]\nquantities = [{asked}]\n")));
        let told = drawn(&sandbox, &["scene.gyr", "forces"]);
        assert!(shown.iter().all(|shown| told.contains(shown)) && !told.contains(hidden), "{told}");
    }
}

#[test]
fn a_legend_names_the_classes_of_many_bodies_and_leaves_none_out() {
    let mut more = String::new();
    for k in 0..10 {
        let group = if k % 3 == 0 { "steel" } else { "grains" };
        let _ = writeln!(
            more,
            "[[body]]\nname = \"c{k}\"\ngroup = \"{group}\"\nshape = {{ sphere = {{ radius = 0.05 }} }}\nmass = 1.0\n\
             position = [{}, 1, 0]\nvelocity = [0, 0, 0.{k}]",
            0.2 * f64::from(k)
        );
    }
    let sandbox = recorded(&balls(&more));
    for what in ["height", "strip"] {
        let told = drawn(&sandbox, &["scene.gyr", what]);
        for expected in ["steel (4)", "grains (6)", "without a group (2)"] {
            assert!(told.contains(expected), "{what}: no {expected:?} in {told}");
        }
        assert!(!told.contains(" more"), "{told}");
    }
}

#[test]
fn a_body_that_flies_off_is_named_at_the_edge_and_makes_no_other_small() {
    let far = "[[body]]\nname = \"runaway\"\nshape = { sphere = { radius = 0.05 } }\nmass = 1.0\n\
               position = [0, 0.5, 0]\nvelocity = [500, 0, 0]\n";
    let near = far.replace("500", "0.5");
    let bar = |scene: &str| {
        let told = drawn(&recorded(&balls(scene)), &["scene.gyr", "strip"]);
        (told.contains("runaway"), told.contains("200 m") || told.contains("50 m"))
    };
    assert_eq!(bar(far), (true, false));
    assert_eq!(bar(&near), (false, false));
}

#[test]
fn a_motion_shows_one_time_after_the_other_and_one_of_them_where_nothing_moves() {
    let sandbox = recorded(&balls(""));
    let told = sandbox.done(&["plot", "scene.gyr", "motion", "-o", "-"]).stdout;
    let groups = told.matches("<animate attributeName=\"visibility\"").count();
    assert!(groups > 10 && told.matches("<g visibility=\"visible\">").count() == 1, "{groups}");
    assert!(told.contains("real time") || told.contains("slowed") || told.contains("times as fast"), "{told:.300}");
    // Each is seen from when the one before is not.
    let times: Vec<(f64, f64)> = told
        .split("keyTimes=\"")
        .skip(1)
        .map(|rest| {
            let times: Vec<f64> =
                rest.split('"').next().unwrap().split(';').map(|time| time.parse().unwrap()).collect();
            if times.len() == 3 { (times[1], times[2]) } else { (times[0], times[1]) }
        })
        .collect();
    assert!(times[1..groups - 1].windows(2).all(|pair| pair[0].1 == pair[1].0), "{times:?}");
    for file in ["motion.png", "motion.pdf"] {
        sandbox.done(&["plot", "scene.gyr", "motion", "-o", file]);
        assert!(std::fs::metadata(sandbox.path(file)).unwrap().len() > 1000, "{file}");
    }
}

#[test]
fn laws_on_a_support_with_a_shape_are_drawn() {
    let sandbox = Sandbox::new();
    sandbox.write(
        "scene.toml",
        "[time]\nend = 0.1\nsample = 0.1\n[[support]]\nname = \"slab\"\nshape = { box = { size = [1, 1, 0.1] } }\n\
         position = [0, 0, -0.05]\n[[body]]\nname = \"ball\"\nshape = { sphere = { radius = 0.05 } }\nmass = 1\n\
         position = [0, 0, 0.1]\n[[contact]]\nbody = \"ball\"\nsupport = \"slab\"\n\
         repulsion = { alpha = 1000, nu = 6, d0 = \"1 mm\" }\n",
    );
    let told = drawn(&sandbox, &["scene.toml", "laws"]);
    assert!(told.contains("ball on slab") && told.contains("(slab): ν = 6"), "{told}");
}

#[test]
fn what_a_crowd_does_is_drawn_and_one_body_is_none() {
    let sandbox = recorded(&balls(""));
    let told = drawn(&sandbox, &["scene.gyr", "crowd"]);
    for expected in ["Kinetic energy", "about the mean", "Granular temperature", "[m²/s²]", "Contacts of a body"] {
        assert!(told.contains(expected), "no {expected:?} in {told}");
    }
    let one = Sandbox::with_ball();
    one.done(&["run", "ball.toml", "--quiet"]);
    let said = one.refused(2, &["plot", "ball.gyr", "crowd"]);
    assert!(said.stderr.contains("there is one body"), "{}", said.stderr);
}

#[test]
fn columns_are_drawn_by_their_names_and_a_span_is_all_that_is_seen() {
    let sandbox = recorded(&balls(""));
    let told = drawn(&sandbox, &["scene.gyr", "--columns", "a.vx,b.v*,*.gap"]);
    for expected in ["a.vx", "b.vx", "b.vy", "b.vz", "[m/s]", "4 columns", "a.gap", "[mm]", "2 columns"] {
        assert!(told.contains(expected), "no {expected:?} in {told}");
    }
    // Ticks are those of the span.
    let part = drawn(&sandbox, &["scene.gyr", "--columns", "a.x", "--from", "0.10", "--to", "0.14"]);
    assert!(part.contains("0.12") && !part.contains("0.3"), "{part}");
    let strips = [["0", "0.2"], ["0.2", "0.4"]]
        .map(|[from, to]| drawn(&sandbox, &["scene.gyr", "strip", "--from", from, "--to", to]));
    for (strip, shown, hidden) in [(0, ["0.000 s", "0.200 s"], "0.220 s"), (1, ["0.200 s", "0.400 s"], "0.180 s")] {
        let told = &strips[strip];
        assert!(shown.iter().all(|time| told.contains(time)) && !told.contains(hidden), "{told}");
    }
    for (arguments, expected) in [
        (["--columns", "c.x"], "no column `c.x`\n  fix: there are a.x, b.x; `*`"),
        (["--from", "5"], "no sample is within that span\n  fix: the recording has 41 of them, from 0 to 0.4 s"),
    ] {
        let said = sandbox.refused(2, &[&["plot", "scene.gyr"], &arguments[..]].concat());
        assert!(said.stderr.contains(expected), "{}", said.stderr);
    }
    let said = sandbox.refused(2, &["plot", "scene.toml", "--columns", "a.x"]);
    assert!(said.stderr.contains("`gyration run scene.toml` first"), "{}", said.stderr);
    sandbox.done(&["export", "scene.gyr", "-o", "part.gif", "--from", "0.1", "--to", "0.2"]);
    let said = sandbox.refused(2, &["export", "scene.gyr", "-o", "part.csv", "--from", "0.1"]);
    assert!(said.stderr.contains("gif and mp4"), "{}", said.stderr);
}
