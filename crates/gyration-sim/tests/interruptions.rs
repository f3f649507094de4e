//! What takes long is given up soon, within an evaluation of very many pairs too.

use crate::islands::parsed;
use crate::runs::provenance;
use gyration::dynamics::{Workspace, rates};
use gyration::{Inadmissible, Quantity};
use gyration_scene::Scene;
use gyration_sim::survey::Survey;
use gyration_sim::{Job, Reason, RunError, Unwatched};
use gyration_threads::Interruption;
use std::time::Duration;

/// Balls in a row that all feel each other.
fn endless(count: usize) -> Scene {
    let mut text = String::from(
        "time = { end = 1e-3, sample = 1e-3 }\n[[contact]]\nbetween = [\"ball\", \"ball\"]\n\
         repulsion = { alpha = 1e3, nu = 6, d0 = 1e-3 }\n",
    );
    for k in 0..count {
        text += &format!(
            "[[body]]\nname = \"b{k}\"\ngroup = \"ball\"\nshape = {{ sphere = {{ radius = 0.01 }} }}\nmass = 0.1\n\
             position = [{}, 0, 0]\n",
            0.05 * k as f64
        );
    }
    parsed(&text, &[])
}

/// The rates at the start, while one waits no longer.
fn rates_given_up(scene: &Scene) -> Result<(), Inadmissible> {
    let (model, state) = (&scene.built().model, &scene.built().state);
    let (mut slopes, mut powers) = (vec![0.0; model.dimension()], vec![0.0; model.works().len()]);
    let over = Interruption::default().after(Some(Duration::ZERO));
    let numbers = state.numbers();
    over.within(|| rates(model, &mut Workspace::default(), state.time, numbers, &mut slopes, &mut powers))
}

#[test]
fn rates_of_very_many_pairs_are_given_up_and_those_of_few_are_not() {
    // 1,035 pairs and 990.
    let given_up = rates_given_up(&endless(46)).unwrap_err();
    assert_eq!(given_up.quantity, Quantity::Interruption);
    rates_given_up(&endless(45)).unwrap();
}

#[test]
fn a_run_of_very_many_pairs_is_given_up_before_its_first_step_has_ended() {
    let scene = endless(46);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.gyr");
    let over = Interruption::default().after(Some(Duration::ZERO));
    let ended = over.within(|| Job::of(&scene, &provenance()).record(&path, &mut Unwatched));
    match ended {
        Err(RunError::Interrupted(stop)) => assert_eq!(stop.reason, Reason::WallTime),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_survey_says_what_a_step_of_very_many_pairs_costs() {
    let words = |count| {
        let scene = endless(count);
        Survey::of(&scene).unwrap().text(&scene).unwrap()
    };
    let told = words(46);
    assert!(told.contains("warning: 1035 pairs have no reach") && told.contains("`reach`"), "{told}");
    assert!(!words(45).contains("have no reach"));
}
