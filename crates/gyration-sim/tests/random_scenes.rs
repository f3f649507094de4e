//! Random admissible scenes: each ends with an outcome that physics explains, a closed ledger, and no overlap.
//!
//! Sizes from 1e-4 to 1e3 m, masses from 1e-6 to 1e6 kg, exponents from 1 to 12, all shapes, several supports, laws
//! present or absent, in proportions that make sense (`random/laws.rs`). A case is a number: `GYRATION_CASES=1000..5000
//! cargo test --release -p gyration-sim --test tests random_scenes` runs others than those of the ordinary tests, and
//! `GYRATION_DUMP=FOLDER` writes the scenes there.

use crate::random;
use crate::random::verdict::{RunFigures, run};
use gyration_scene::Scene;
use gyration_sim::{Outcome, Reason};
use std::collections::BTreeMap;
use std::ops::Range;

/// The ledger closes to this many times rtol, of the energy in play.
///
/// A step may spend a tenth of rtol on the works, and as much on the state, on whose gaps the contact energy depends
/// with the exponent (at most 12) as factor: some 1.5 rtol a step if all errors had one sign. Hundreds of steps have
/// mostly different senses: a hundred is what the documentation promises for long runs.
const LEDGER: f64 = 100.0;

/// The part of the energy in play that rounding may hide: of energies that are large against what is exchanged of them,
/// and of contact energy, which depends on the gap with an exponent up to 12 while places are known to 1e-16 of the
/// size.
fn rounding(gap: f64) -> f64 {
    1e-11 + 1e-14 / gap
}

/// A stop at a support is explained where bodies are nearer than this part of their size: far below, numbers end.
const NEAR: f64 = 1e-7;

/// The cases that are asked for, or so many.
pub fn cases(count: u64) -> Range<u64> {
    let Ok(asked) = std::env::var("GYRATION_CASES") else { return 0..count };
    let (first, last) = asked.split_once("..").unwrap();
    first.parse().unwrap()..last.parse().unwrap()
}

/// The outcome in a word, or what is wrong with the run.
fn verdict(figures: &RunFigures, rtol: f64) -> Result<&'static str, String> {
    if figures.gap <= 0.0 {
        return Err(format!("overlap: a gap of {:e} sizes", figures.gap));
    }
    if figures.residual > LEDGER * rtol + rounding(figures.gap) {
        return Err(format!("the ledger is open by {:e} of the energy in play at rtol {rtol:e}", figures.residual));
    }
    match &figures.outcome {
        Outcome::Completed => Ok("completed"),
        Outcome::AtRest { .. } => Ok("at rest"),
        Outcome::Stopped(stop) if stop.reason == Reason::Interrupted => Ok("unfinished"),
        Outcome::Stopped(stop) if stop.reason == Reason::SpringCollapsed => Ok("spring collapsed"),
        // Either the field is too weak to keep the body from coming nearer than numbers can tell, or something is
        // wrong.
        Outcome::Stopped(_) if figures.barrier < 1.0 && figures.gap < NEAR => Ok("touched"),
        Outcome::Stopped(stop) => {
            let RunFigures { gap, barrier, .. } = figures;
            Err(format!("unexplained stop, {:?}: {} (gap {gap:e} sizes, barrier {barrier:e})", stop.reason, stop.what))
        }
    }
}

#[test]
fn random_scenes_end_with_an_outcome_a_closed_ledger_and_no_overlap() {
    let folder = tempfile::tempdir().unwrap();
    let (mut outcomes, mut failures) = (BTreeMap::new(), Vec::new());
    let (mut worst, mut evaluations) = (0.0_f64, 0);
    for case in cases(40) {
        let text = random::scene::scene(case, folder.path());
        if let Ok(to) = std::env::var("GYRATION_DUMP") {
            std::fs::write(format!("{to}/{case}.json"), &text).unwrap();
        }
        let scene = Scene::parse("scene.json", &text, folder.path(), &[]).unwrap_or_else(|e| panic!("{case}: {e}"));
        let rtol = scene.built().plan.rtol;
        let verdict = run(&scene).map_err(|error| error.to_string()).and_then(|figures| {
            worst = worst.max(figures.residual / (rtol + rounding(figures.gap)));
            evaluations += figures.evaluations;
            println!(
                "case {case}: {} steps, {} evaluations, gap {:.1e} sizes, residual {:.1e} rtol, barrier {:.1e}: {}",
                figures.steps,
                figures.evaluations,
                figures.gap,
                figures.residual / rtol,
                figures.barrier,
                figures.outcome.in_words()
            );
            verdict(&figures, rtol)
        });
        match verdict {
            Ok(outcome) => *outcomes.entry(outcome).or_insert(0) += 1,
            Err(wrong) => failures.push(format!("case {case}: {wrong}")),
        }
    }
    println!("{outcomes:?}; {evaluations} evaluations; residual up to {worst:.2} rtol of the energy in play");
    assert!(failures.is_empty(), "{} failures:\n{}", failures.len(), failures.join("\n"));
    // Most scenes end by themselves within the evaluations that they are given.
    let count = |name| outcomes.get(name).copied().unwrap_or(0);
    assert!(count("completed") + count("at rest") > outcomes.values().sum::<u64>() / 2, "{outcomes:?}");
}

/// Runs a scene within the evaluations that a random one gets, and asks that it ends by itself.
fn assert_ends_by_itself(text: &str) {
    let scene = Scene::parse("scene.toml", text, std::path::Path::new(""), &[]).unwrap();
    let figures = run(&scene).unwrap();
    let words = figures.outcome.in_words();
    let unfinished = matches!(&figures.outcome, Outcome::Stopped(stop) if stop.reason == Reason::Interrupted);
    assert!(!unfinished, "{} steps, {} evaluations, then {words}", figures.steps, figures.evaluations);
}

/// The ball rattles ever faster, its frequency grows like gap^−7/2, and t = 1 is never reached: 31 000 steps to 0.93 s.
#[test]
#[ignore = "a body crushed between closing supports: no outcome says so, only max_wall_time ends the run"]
fn body_crushed_between_two_supports_ends_with_a_word() {
    assert_ends_by_itself(
        r#"
        [world]
        gravity = [0, 0, 0]
        [time]
        end = 2
        sample = 0.05
        [[support]]
        name = "floor"
        plane = {}
        [[support]]
        name = "press"
        plane = { origin = [0, 0, 0.3], normal = [0, 0, -1] }
        motion = { velocity = [0, 0, -0.1] }
        [[contact]]
        support = "floor"
        repulsion = { alpha = 1e-3, nu = 6 }
        [[contact]]
        support = "press"
        repulsion = { alpha = 1e-3, nu = 6 }
        [[body]]
        name = "ball"
        shape = { sphere = { radius = 0.1 } }
        density = 1000
        position = [0, 0, 0.15]
        "#,
    );
}

/// Case 10: friction with ν = 11.3 under a repulsion with ν = 5, deep in the field. Newton's method fails every other
/// step, which then stay at some 1e-10 s with errors of a hundredth of what is allowed: 16 000 steps for 0.3 µs.
#[test]
#[ignore = "an implicit contact whose friction is steeper than its repulsion crawls for Newton's method"]
fn contact_with_steep_friction_is_passed() {
    assert_ends_by_itself(
        r#"
        [time]
        end = 0.1
        sample = 0.01
        [[support]]
        name = "plate"
        plane = { normal = [0.49795081861453244, 0.6389383613299036, 0.5863469558735463] }
        motion = { velocity = [0.060896011020834945, -0.08030744326129283, -0.11067017025331391] }
        [[contact]]
        support = "plate"
        repulsion = { alpha = 9.24708665674225e-10, nu = 5 }
        damping = { beta = 1.2447493999780297e-8, nu = 4.781447103112312 }
        friction = { beta = 2.3699012367894972e-33, nu = 11.336028885551366 }
        [[body]]
        name = "cone"
        shape = { cone = { height = 0.010494381032527632, radius = 0.001822793389050453 } }
        mass = 33488.663803876414
        position = [0, 0, 0.10380792941150815]
        orientation = { quaternion = [0.9612454595721263, -0.07155598028430846, 0.1538106102201878, -0.2173228113227348] }
        velocity = [-0.8284988237019029, -1.1456436286450737, -0.37617000848686877]
        angular_velocity = [2.609584024957079, -5.688164697206454, -2.5323826672989185]
        "#,
    );
}
