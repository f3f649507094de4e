//! A run that goes on from the checkpoint at the end of any of its windows steps as the one that left it: to the byte.
//!
//! Whatever a step depends on must stand in the checkpoint, or follow from what stands there. Recordings of whole runs
//! find a fault of this kind where a stop happens to fall; here every window is such a stop.

use crate::islands::parsed;
use crate::random::meetings;
use crate::random::scene::scene;
use gyration_scene::Scene;
use gyration_sim::{FirstSteps, Job, MomentumChange, Provenance};

/// Windows of random scenes that are looked at.
const WINDOWS: usize = 40;

/// What the first windows of a scene show.
fn first_steps(scene: &Scene, most: usize) -> FirstSteps {
    FirstSteps::of(&Job::of(scene, &Provenance { version: "test".into(), commit: None }), most).unwrap()
}

/// The first window after which a run that is resumed there steps otherwise, and what is other; none if it never does.
pub fn first_difference(scene: &Scene, most: usize) -> Option<String> {
    first_steps(scene, most).difference
}

/// Asks that a run steps the same from the checkpoint at the end of each of its first windows.
pub fn resumes_after_every_window(scene: &Scene, most: usize) {
    assert_eq!(first_difference(scene, most), None, "{}", scene.name());
}

#[test]
fn bodies_alone_resume_after_every_window() {
    let folder = tempfile::tempdir().unwrap();
    let mut differing = Vec::new();
    for case in 0..30 {
        let text = scene(case, folder.path());
        let scene = Scene::parse("scene.json", &text, folder.path(), &[]).unwrap_or_else(|e| panic!("{case}: {e}"));
        differing.extend(first_difference(&scene, WINDOWS).map(|told| format!("case {case}, {told}")));
    }
    assert!(differing.is_empty(), "{} scenes:\n{}", differing.len(), differing.join("\n"));
}

/// The planes of the next step are searched from nothing, those of its stages from there: both are the same planes.
#[test]
fn bodies_that_meet_resume_after_every_window_and_keep_their_momenta() {
    let mut differing = Vec::new();
    for case in 0..24 {
        let scene = parsed(&meetings::scene(case), &[]);
        let FirstSteps { difference, planes, momenta, .. } = first_steps(&scene, WINDOWS);
        let MomentumChange { momentum: linear, angular_momentum } = momenta.unwrap();
        let angular = angular_momentum.unwrap();
        println!("case {case}: forces by planes found anew {planes:.1e}, momentum {linear:.1e}, angular {angular:.1e}");
        // A corner that strikes comes as near as 1e-11 of a size: to 2e-5 of that its gap is rounded, and its force.
        assert!(planes < 1e-4 && linear < 1e-14 && angular < 1e-8, "case {case}");
        differing.extend(difference.map(|told| format!("case {case}, {told}")));
    }
    assert!(differing.is_empty(), "{} scenes:\n{}", differing.len(), differing.join("\n"));
}

/// Two bricks that rattle on a table, one on the other: long enough for implicit steps and changes of the stepper.
#[test]
fn a_stack_resumes_after_every_window() {
    resumes_after_every_window(&Scene::open("overhang", &["time.end=0.05".into()]).unwrap(), 400);
}

/// Two boxes with a spin of their own in a ring with its image: what is symmetric has planes that are not unique to the
/// digits of a number.
#[test]
fn symmetric_bodies_resume_after_every_window() {
    let mut text = "world = { gravity = [0, 0, 0] }\ntime = { end = 0.4, sample = 0.1 }\n\
                    [[contact]]\nbetween = [\"box\", \"box\"]\nrepulsion = { alpha = 100, nu = 6, d0 = 0.001 }\n"
        .to_owned();
    for (k, (x, y)) in [(0.15, 0.0), (0.0, 0.15), (-0.15, 0.0), (0.0, -0.15)].into_iter().enumerate() {
        text += &format!(
            "[[body]]\nname = \"b{k}\"\ngroup = \"box\"\nshape = {{ box = {{ size = [0.1, 0.1, 0.1] }} }}\nmass = 1\n\
             position = [{x}, {y}, 0]\nvelocity = [{}, {}, 0]\nangular_velocity = [0, 0, 1]\n",
            -2.0 * x,
            -2.0 * y
        );
    }
    resumes_after_every_window(&parsed(&text, &[]), 200);
}

/// Spheres that feel one another and a wall through the fluid, with inertia and without, one of them not.
#[test]
fn spheres_in_a_fluid_resume_after_every_window() {
    for inertia in [true, false] {
        let mut text = "world = { gravity = [0.3, 0, -9.81] }\ntime = { end = 1.0, sample = 0.05 }\n\
                        fluid = { viscosity = 2, density = 1000 }\n[[support]]\nname = \"floor\"\nplane = {}\n"
            .to_owned();
        for (k, (radius, x, z)) in [(0.01, 0.0, 0.05), (0.016, 0.011, 0.019), (0.006, -0.012, 0.02)].iter().enumerate()
        {
            let inertia = inertia || k == 2;
            text += &format!(
                "[[body]]\nname = \"s{k}\"\nshape = {{ sphere = {{ radius = {radius} }} }}\ndensity = 2500\n\
                 position = [{x}, 0.002, {z}]\n\
                 inclusion = {{ inertia = {inertia}, neighbours = true, walls = true }}\n"
            );
        }
        resumes_after_every_window(&parsed(&text, &[]), 40);
    }
}
