//! Who pushes whom: sums, each once, what does not count.

use crate::runs::provenance;
use gyration::tensor::Vec3;
use gyration_record::Recording;
use gyration_sim::replay::Replay;
use gyration_sim::{Job, Push, Unwatched, network, open};
use std::collections::BTreeSet;

#[test]
fn pushes_carry_each_ball_of_a_pile_at_rest_and_stand_once() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("pile");
    let scene = open("pile", &[]).unwrap();
    Job::of(&scene, &provenance()).record(&path, &mut Unwatched).unwrap();
    let recording = Recording::open(&path).unwrap();
    let last = recording.rows() - 1;
    let mut replay = Replay::open(&recording).unwrap();
    let pushes = replay.network(last).unwrap();
    let state = replay.state(last).unwrap();
    let model = &scene.built().model;
    let centre = |body: usize| state.motion(model, body).placement.position;
    let mut on = vec![Vec3::zeros(); model.bodies.len()];
    for push in &pushes {
        // Of balls and planes the force passes through centre and foot.
        let from = push.other.map_or(push.point, centre);
        let force = push.force * (centre(push.body) - from).normalize();
        on[push.body] += force;
        push.other.into_iter().for_each(|other| on[other] -= force);
    }
    for (body, force) in on.iter().enumerate() {
        let weight = model.bodies[body].solid.mass.mass * model.gravity;
        // Balls that creep at 1 mm/s are slowed down by some per cent of what presses, 60 s/m times the force.
        assert!((force + weight).norm() < 0.1 * weight.norm(), "{body}: {force} carries {weight}");
    }
    let between: Vec<[usize; 2]> = pushes.iter().filter_map(|push| Some([push.body, push.other?])).collect();
    let distinct: BTreeSet<[usize; 2]> =
        between.iter().map(|[one, other]| [*one.min(other), *one.max(other)]).collect();
    assert!(between.len() > 3 && distinct.len() == between.len(), "{between:?}");
    let mean = pushes.iter().map(|push| push.force).sum::<f64>() / pushes.len() as f64;
    assert!(pushes.iter().all(|push| push.force > 0.01 * mean), "{pushes:?}");
}

/// Three beads of a periodic chain under pressure, far apart but for their contacts: two stand beside one another in
/// space, and one contact goes around.
#[test]
fn a_contact_around_a_lattice_is_told_of_both_bodies() {
    let text = r#"
        world = { gravity = [0, 0, 0] }
        time = { end = 1, sample = 1 }
        lattice = { cell = [[0.21, 0, 0]], repeat = [3, 1, 1] }
        [[body]]
        name = "bead"
        shape = { sphere = { radius = 0.1 } }
        mass = 2
        [[contact]]
        between = ["bead", "bead"]
        repulsion = { alpha = 1e4, nu = 6, d0 = "10 mm" }
    "#;
    let scene = crate::islands::parsed(text, &[]);
    let built = scene.built();
    let mut workspace = gyration::dynamics::Workspace::default();
    let (instant, scratch) = workspace.read(&built.model, &built.state).unwrap();
    let mut exchanges = Vec::new();
    gyration::dynamics::exchanges(&instant, scratch, &mut exchanges).unwrap();
    let mut pushes = network(&built.model, exchanges);
    pushes.sort_by_key(|push| (push.body, push.other));
    let told: Vec<_> = pushes.iter().map(|push| (push.body, push.other)).collect();
    assert_eq!(told, [(0, None), (0, Some(1)), (1, Some(2)), (2, None)], "{pushes:?}");
    let Push { force, .. } = pushes[0];
    assert!(pushes.iter().all(|push| (push.force - force).abs() < 1e-9 * force), "{pushes:?}");
    // Half a gap outside of the first and of the last.
    let ends = [pushes[0].point, pushes[3].point];
    let first = built.state.motion_in_space(&built.model, 0).placement.position;
    assert!((ends[0].x - first.x + 0.105).abs() < 1e-9, "{ends:?}");
    assert!((ends[1].x - first.x - 0.525).abs() < 1e-9, "{ends:?}");
}
