//! What a run keeps when islands merge and fall apart: works, the energy in play, every byte of a restart.

use crate::islands::parsed;
use crate::runs::StopAfter;
use gyration_scene::Scene;
use gyration_sim::{Job, MemorySink, Monitor, Outcome, Provenance, RunSummary, Simulation, Unwatched, Verdict};

/// Two balls that hit each other, a third that one of them then hits, a fourth far away on a damped spring to a fifth.
const HEAD: &str = r#"
    world = { gravity = [0, 0, 0] }
    time = { end = 1.2, sample = 0.01 }
    [[contact]]
    between = ["ball", "ball"]
    repulsion = { alpha = 1e3, nu = 6, d0 = 1e-3 }
    damping = { beta = 1e3, nu = 6, d0 = 1e-3 }
    friction = { beta = 1e3, nu = 6, d0 = 1e-3 }
    reach = 0.05
    [[spring]]
    between = ["d", "e"]
    stiffness = 40
    rest_length = 0.3
    damping = 2
"#;
const WALL: &str = r#"
    [[support]]
    name = "wall"
    plane = { origin = [0, 0, -9] }
    [[contact]]
    support = "wall"
    repulsion = { alpha = 1e3, nu = 6, d0 = 1e-3 }
    damping = { beta = 1e3, nu = 6, d0 = 1e-3 }
"#;
const BALLS: [(&str, [f64; 3], [f64; 3]); 5] = [
    ("a", [-0.12, 0.0, 0.0], [0.5, 0.0, 0.0]),
    ("b", [0.12, 0.01, 0.0], [-0.5, 0.0, 0.0]),
    ("c", [-0.5, 0.0, 0.0], [0.0, 0.0, 0.0]),
    ("d", [0.3, 0.5, 0.0], [-0.8, -0.9, 0.0]),
    ("e", [0.3, 0.9, 0.0], [0.0, 0.0, 0.0]),
];

/// The balls in an order, with a wall that one of them has a contact with, or none.
fn scene(order: [usize; 5], wall_of: Option<&str>) -> Scene {
    let mut text = HEAD.to_owned();
    if let Some(body) = wall_of {
        text += &WALL.replace("repulsion", &format!("body = \"{body}\"\n    repulsion"));
    }
    for (name, place, speed) in order.map(|k| BALLS[k]) {
        text += &format!(
            "[[body]]\nname = \"{name}\"\ngroup = \"ball\"\nshape = {{ sphere = {{ radius = 0.05 }} }}\nmass = 1\n\
             position = {place:?}\nvelocity = {speed:?}\n"
        );
    }
    parsed(&text, &[])
}

fn job(scene: &Scene) -> Job<'_> {
    Job::of(scene, &Provenance { version: String::new(), commit: None })
}

#[test]
fn works_go_on_through_partings_in_every_order_of_bodies() {
    for (order, wall) in [
        ([0, 1, 2, 3, 4], None),
        ([1, 0, 3, 4, 2], None),
        ([4, 2, 3, 1, 0], Some("a")),
        ([0, 1, 2, 3, 4], Some("b")),
        ([2, 1, 4, 0, 3], Some("e")),
    ] {
        let scene = scene(order, wall);
        let (job, mut kept) = (job(&scene), MemorySink::default());
        let mut simulation = Simulation::new(job.model, job.start, job.plan).unwrap();
        simulation.begin(&mut kept).unwrap();
        let outcome = simulation.run(&mut kept, &mut Unwatched).unwrap();
        let works = job.model.works().len();
        let of_row = |row: &[f64]| row[row.len() - 1 - works..row.len() - 1].to_vec();
        let rows: Vec<Vec<f64>> = kept.rows.iter().map(|(_, row)| of_row(row)).collect();
        let rises = rows.windows(2).flat_map(|rows| (0..works).map(move |k| rows[1][k] - rows[0][k]));
        let rise = rises.fold(f64::NEG_INFINITY, f64::max);
        let summary = RunSummary::of(job.model, &mut simulation, outcome, None);
        let ledger = &summary.ledger;
        println!("{order:?}, wall of {wall:?}: {:?}, rise {rise:.1e}, residual {:.1e}", ledger.works, ledger.residual);
        assert!(ledger.works.iter().filter(|(_, work)| *work < -1e-4).count() == 3, "damping, friction, dashpot take");
        // The errors of works that are at rest.
        assert!(rise < 1e-10, "{rise:e}");
        assert_eq!((ledger.verdict, summary.outcome == Outcome::Completed), (Verdict::Closed, true));
        assert!(ledger.largest_residual < 1e-7 * ledger.energy_in_play, "{:e}", ledger.largest_residual);
        // 1.1 J at the start, of which none comes back.
        let start = 0.5 * (0.25 + 0.25 + 0.64 + 0.81);
        assert!((1.0 - 1e-9..1.02).contains(&(ledger.energy_in_play / start)), "{}", ledger.energy_in_play);
    }
}

/// Bodies without symmetry, whose planes are found by searches: what a search ends at depends on where it began, in the
/// last digit.
const TUMBLING: &str = r#"
    world = { gravity = [0, 0, -3] }
    time = { end = 0.6, sample = 0.05 }
    solver = { rtol = 1e-7 }
    [[support]]
    name = "floor"
    plane = {}
    [[contact]]
    support = "floor"
    repulsion = { alpha = 1e3, nu = 6, d0 = 1e-3 }
    damping = { beta = 300, nu = 6, d0 = 1e-3 }
    [[contact]]
    between = ["any", "any"]
    repulsion = { alpha = 1e3, nu = 6, d0 = 1e-3 }
    damping = { beta = 1e3, nu = 6, d0 = 1e-3 }
    friction = { beta = 1e3, nu = 6, d0 = 1e-3 }
    [[body]]
    name = "box"
    group = "any"
    shape = { box = { size = [0.1, 0.14, 0.08] } }
    mass = 1
    position = [-0.11, 0.01, 0.2]
    velocity = [0.6, 0.1, 0]
    orientation = { quaternion = [0.5, 0.1, 0.8, 0.3] }
    angular_velocity = [3, -2, 5]
    [[body]]
    name = "egg"
    group = "any"
    shape = { ellipsoid = { semi_axes = [0.04, 0.06, 0.05] } }
    mass = 0.4
    position = [0.12, 0.02, 0.17]
    velocity = [-0.8, 0, 0.1]
    angular_velocity = [-4, 1, 2]
    [[body]]
    name = "soft"
    group = "any"
    shape = { box = { size = [0.06, 0.06, 0.06] } }
    density = 1000
    affine = { material = { mooney_rivlin = { c1 = 3000, c2 = 1000 } }, viscosity = 20 }
    position = [0.02, 0.13, 0.21]
    velocity = [0, -0.6, 0]
"#;

/// The rows of windows or of a run, the checkpoint behind them, and whether that is the end.
fn go_on(run: &mut Simulation, monitor: &mut dyn Monitor) -> (Vec<Vec<u64>>, Vec<u8>, bool) {
    let mut kept = MemorySink::default();
    let outcome = run.run(&mut kept, monitor).unwrap();
    // Bits, since some columns are not numbers.
    let rows = kept.rows.iter().map(|(_, row)| row.iter().map(|number| number.to_bits()).collect());
    (rows.collect(), run.checkpoint(), outcome == Outcome::Completed)
}

/// After every window a checkpoint is read into a second run, and both go on by a window; how many there were. Of one
/// island a window is a step.
fn assert_resumes_after_every_window(scene: &Scene) -> usize {
    let job = job(scene);
    let mut run = Simulation::new(job.model, job.start, job.plan).unwrap();
    run.begin(&mut MemorySink::default()).unwrap();
    for windows in 0.. {
        let mut resumed = Simulation::resume(job.model, job.start, job.plan, &run.checkpoint()).unwrap();
        let [one, other] = [&mut run, &mut resumed].map(|run| go_on(run, &mut StopAfter(1)));
        assert!(one == other, "the run that goes on after {windows} windows is another, before t = {}", run.time());
        if one.2 {
            return windows;
        }
    }
    unreachable!("a run ends");
}

#[test]
fn a_run_resumed_after_any_step_is_the_same_run() {
    for (method, end) in [("auto", 0.3), ("implicit", 0.12)] {
        let overrides = [format!("solver.method={method}"), format!("time.end={end}")];
        let steps = assert_resumes_after_every_window(&parsed(TUMBLING, &overrides.each_ref().map(String::as_str)));
        println!("{method}: {steps} steps");
        assert!(steps > 100);
    }
}

/// Windows are not the same in a run that goes on, where there are several islands; its end is.
#[test]
fn islands_resumed_after_any_window_come_to_the_same_end() {
    let scene = scene([0, 1, 2, 3, 4], Some("b"));
    let job = job(&scene);
    let new = || {
        let mut run = Simulation::new(job.model, job.start, job.plan).unwrap();
        run.begin(&mut MemorySink::default()).unwrap();
        run
    };
    let (mut whole, mut run) = (new(), new());
    let expected = go_on(&mut whole, &mut Unwatched);
    let mut rows = 0;
    for windows in 1.. {
        let (before, checkpoint, is_end) = go_on(&mut run, &mut StopAfter(1));
        rows += before.len();
        if is_end {
            println!("{windows} windows");
            assert!(windows > 50);
            break;
        }
        let mut resumed = Simulation::resume(job.model, job.start, job.plan, &checkpoint).unwrap();
        let (after, end, _) = go_on(&mut resumed, &mut Unwatched);
        assert!(end == expected.1 && after == expected.0[rows..], "after {windows} windows, t = {}", run.time());
    }
}
