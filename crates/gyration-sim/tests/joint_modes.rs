//! Rest states and small motions of joined bodies, against closed forms, bodies in one piece, and a run.

use crate::islands::parsed;
use gyration_sim::survey::{ModeSurvey, SceneModes, modes};
use gyration_sim::{Job, MemorySink, Provenance, Simulation, Unwatched};
use std::f64::consts::TAU;

const GRAVITY: f64 = 9.81;
const TIME: &str = "time = { end = 1, sample = 0.1 }\n";

/// A rod of length 1 m along z with these masses and inertia about its centre, at a place, turned about y by an angle.
fn rod(name: &str, mass: f64, [x, z]: [f64; 2], angle: f64) -> String {
    format!(
        "[[body]]\nname = \"{name}\"\nposition = [{x:?}, 0, {z:?}]\n\
         orientation = {{ axis_angle = {{ axis = [0, -1, 0], angle = {angle:?} }} }}\n\
         shape = {{ box = {{ size = [0.1, 0.2, 1] }} }}\nmass = {mass}\n"
    )
}

/// The moment of inertia of a rod about its centre, across x and z, over its mass.
const INERTIA: f64 = (0.01 + 1.0) / 12.0;

/// A hinge about y.
fn hinge(name: &str, between: [&str; 2], points: [[f64; 3]; 2]) -> String {
    format!(
        "[[joint]]\nname = \"{name}\"\nbetween = {between:?}\nkind = \"hinge\"\naxis = [0, 1, 0]\npoints = {points:?}\n"
    )
}

/// Frequencies and motions of the only system.
fn of_system(scene: &str) -> Vec<(f64, &'static str)> {
    let SceneModes { systems, .. } = modes(&parsed(scene, &[]));
    assert_eq!(systems.len(), 1, "{systems:?}");
    let rest = systems[0].rest_state.as_ref().unwrap_or_else(|| panic!("{:?}", systems[0].no_rest_state_because));
    rest.modes.iter().map(|mode| (mode.frequency, mode.motion)).collect()
}

/// The modes of the only body, which hangs on space alone.
fn of_body(scene: &str) -> Vec<ModeSurvey> {
    let SceneModes { bodies, .. } = modes(&parsed(scene, &[]));
    let rest = bodies[0].rest_state.as_ref().unwrap_or_else(|| panic!("{:?}", bodies[0].no_rest_state_because));
    rest.modes.clone()
}

fn assert_close(name: &str, value: f64, expected: f64, tolerance: f64) {
    let error = (value / expected - 1.0).abs();
    println!("{name}: {value:.12} for {expected:.12}, off by {error:.1e}");
    assert!(error <= tolerance, "{name}: {value} instead of {expected}, off by {error:e}");
}

#[test]
fn rod_on_a_hinge_comes_down_and_swings_as_a_compound_pendulum() {
    // Starts 2 rad from where it hangs.
    let (sin, cos) = 2.0_f64.sin_cos();
    let scene = format!(
        "{TIME}{}{}",
        rod("rod", 3.0, [0.5 * sin, -0.5 * cos], 2.0),
        hinge("h", ["space", "rod"], [[0.0; 3], [0.0, 0.0, 0.5]])
    );
    let found = of_body(&scene);
    assert_eq!(found.len(), 1);
    let exact = (GRAVITY * 0.5 / (INERTIA + 0.25)).sqrt();
    assert_close("ω", found[0].frequency, exact, 1e-12);
    let SceneModes { bodies, .. } = modes(&parsed(&scene, &[]));
    let place = bodies[0].rest_state.as_ref().unwrap().place.position;
    assert!(place[0].abs() < 1e-12 && (place[2] + 0.5).abs() < 1e-15, "{place:?}");
}

#[test]
fn double_pendulum_has_the_two_frequencies_of_its_matrices() {
    let (m, n) = (2.0, 3.0);
    let (sin, cos) = 0.4_f64.sin_cos();
    let [upper, lower] = ["upper", "lower"];
    let scene = [
        TIME,
        &rod(upper, m, [0.5 * sin, -0.5 * cos], 0.4),
        &rod(lower, n, [sin, -cos - 0.5], 0.0),
        &hinge("a", ["space", upper], [[0.0; 3], [0.0, 0.0, 0.5]]),
        &hinge("b", [upper, lower], [[0.0, 0.0, -0.5], [0.0, 0.0, 0.5]]),
    ]
    .concat();
    let found = of_system(&scene);
    // M = (a, b; b, d), K = diag(k, l) of the two angles.
    let (a, b, d) = (m * (INERTIA + 0.25) + n, n * 0.5, n * (INERTIA + 0.25));
    let (k, l) = (GRAVITY * (0.5 * m + n), GRAVITY * 0.5 * n);
    let (two, one, zero) = (a * d - b * b, -(a * l + d * k), k * l);
    let root = (one * one - 4.0 * two * zero).sqrt();
    let exact = [(-one - root) / (2.0 * two), (-one + root) / (2.0 * two)].map(f64::sqrt);
    assert_eq!(found.len(), 2, "{found:?}");
    for ((frequency, motion), exact) in found.into_iter().zip(exact) {
        assert_eq!(motion, "oscillates");
        assert_close("ω", frequency, exact, 1e-11);
    }
}

#[test]
fn stops_and_drives_of_a_hinge_are_its_stiffness_and_resistance() {
    // The axis is vertical: gravity does nothing about it. Both stops push alike at the middle.
    let disk = "[[body]]\nname = \"disk\"\nshape = { cylinder = { radius = 0.2, height = 0.1 } }\nmass = 5\n";
    let joint = |lines: &str| {
        format!(
            "{TIME}{disk}[[joint]]\nname = \"h\"\nbetween = [\"space\", \"disk\"]\nkind = \"hinge\"\naxis = [0, 0, 1]\n\
             {lines}"
        )
    };
    let inertia = 0.5 * 5.0 * 0.04;
    let stop = "limits = [-0.5, 0.5]\nstop = { repulsion = { alpha = 0.3, nu = 3, d0 = 0.2 } }\n";
    let stiffness = 2.0 * 0.3 * 3.0 / 0.2 * (0.5_f64 / 0.2).powi(-4);
    let found = of_body(&joint(stop));
    assert_eq!(found.len(), 1);
    assert_close("ω of stops", found[0].frequency, (stiffness / inertia).sqrt(), 1e-11);
    let found = of_body(&joint("drive = { torque = \"1 - 0.9*angle - 0.04*rate\" }\n"));
    let decay = 0.04 / (2.0 * inertia);
    assert_close("decay of a drive", found[0].decay_rates[0], decay, 1e-11);
    assert_close("ω of a drive", found[0].frequency, (0.9 / inertia - decay * decay).sqrt(), 1e-11);
}

#[test]
fn parallelogram_swings_as_a_pendulum_and_its_coupler_spins_freely() {
    let (m, n) = (2.0, 3.0);
    let coupler = format!(
        "[[body]]\nname = \"c\"\nposition = [0.4, 0, -1]\nshape = {{ box = {{ size = [0.8, 0.1, 0.1] }} }}\nmass = \
            {n}\n"
    );
    let ball = |name: &str, crank: &str, x: f64| {
        format!(
            "[[joint]]\nname = \"{name}\"\nbetween = [\"{crank}\", \"c\"]\nkind = \"ball\"\n\
             points = [[0, 0, -0.5], [{x:?}, 0, 0]]\n"
        )
    };
    let scene = [
        TIME,
        &rod("l", m, [0.0, -0.5], 0.0),
        &rod("r", m, [0.8, -0.5], 0.0),
        &coupler,
        &hinge("a", ["space", "l"], [[0.0; 3], [0.0, 0.0, 0.5]]),
        &hinge("b", ["r", "space"], [[0.0, 0.0, 0.5], [0.8, 0.0, 0.0]]),
        &ball("d", "l", -0.4),
        &ball("e", "r", 0.4),
    ]
    .concat();
    let found = of_system(&scene);
    assert_eq!(found.len(), 2, "{found:?}");
    assert_eq!(found[0].1, "free");
    let exact = GRAVITY * (2.0 * m * 0.5 + n) / (2.0 * m * (INERTIA + 0.25) + n);
    assert_close("ω", found[1].0, exact.sqrt(), 1e-11);
}

#[test]
fn welded_bodies_move_as_one_piece() {
    let boxes = "[[body]]\nname = \"a\"\nshape = { box = { size = [0.2, 0.3, 0.4] } }\ndensity = 500\n\
                 [[body]]\nname = \"b\"\nshape = { box = { size = [0.5, 0.1, 0.2] } }\ndensity = 500\n\
                 position = [0.35, 0.05, 0.1]\n\
                 [[joint]]\nname = \"w\"\nbetween = [\"a\", \"b\"]\nkind = \"weld\"\n\
                 points = [[0.1, 0, 0], [-0.25, -0.05, -0.1]]\n";
    let (volume, other) = (0.2 * 0.3 * 0.4, 0.5 * 0.1 * 0.2);
    // From the centre of the first to that of both.
    let center = [0.35, 0.05, 0.1].map(|c| c * other / (volume + other));
    let springs = |bodies: [&str; 2], from: [[f64; 3]; 2]| {
        let spring = |body: &str, at: [f64; 3], from: [f64; 3], anchor: [f64; 3]| {
            let point = [0, 1, 2].map(|k| at[k] - from[k]);
            format!(
                "[[body.spring]]\npoint = {point:?}\nanchor = {anchor:?}\nstiffness = 4000\nrest_length = 0.2\n# \
                    {body}\n"
            )
        };
        [
            spring(bodies[0], [-0.1, 0.15, 0.2], from[0], [-0.1, 0.15, 0.6]),
            spring(bodies[0], [-0.1, -0.15, 0.2], from[0], [-0.3, -0.15, 0.6]),
            spring(bodies[1], [0.6, 0.1, 0.2], from[1], [0.6, 0.3, 0.7]),
        ]
    };
    let [one, two, three] = springs(["a", "b"], [[0.0; 3], [0.35, 0.05, 0.1]]);
    let apart = boxes.replacen("[[body]]\nname = \"b\"", &format!("{one}{two}[[body]]\nname = \"b\""), 1);
    let apart = apart.replacen("[[joint]]", &format!("{three}[[joint]]"), 1);
    let welded = of_system(&format!("{TIME}{apart}"));
    let whole = springs(["u", "u"], [center, center]).concat();
    let less = |place: [f64; 3]| [0, 1, 2].map(|k| place[k] - center[k]);
    let union = format!(
        "{TIME}[[body]]\nname = \"u\"\nshape = {{ union = {{ parts = [\
         {{ shape = {{ box = {{ size = [0.2, 0.3, 0.4] }} }}, offset = {:?} }}, \
         {{ shape = {{ box = {{ size = [0.5, 0.1, 0.2] }} }}, offset = {:?} }}] }} }}\n\
         density = 500\nposition = {center:?}\n{whole}",
        less([0.0; 3]),
        less([0.35, 0.05, 0.1]),
    );
    let one_piece = of_body(&union);
    assert_eq!((welded.len(), one_piece.len()), (6, 6));
    let mut exact: Vec<f64> = one_piece.iter().map(|mode| mode.frequency).collect();
    exact.sort_by(f64::total_cmp);
    for ((frequency, _), exact) in welded.into_iter().zip(exact) {
        assert_close("ω", frequency, exact, 1e-9);
    }
}

#[test]
fn soft_body_on_a_ball_has_the_modes_of_a_pinned_one() {
    let block = |lines: &str| {
        format!(
            "{TIME}[[body]]\nname = \"soft\"\nshape = {{ box = {{ size = [0.1, 0.1, 0.3] }} }}\ndensity = 1000\n\
             position = [0, 0, -0.15]\n\
             affine = {{ material = {{ mooney_rivlin = {{ c1 = 6000, c2 = 2000 }} }}, viscosity = 5 }}\n{lines}"
        )
    };
    let pinned = of_body(&block("pin = [0, 0, 0.15]\n"));
    let joined = of_body(&block(
        "[[joint]]\nname = \"b\"\nbetween = [\"soft\", \"space\"]\nkind = \"ball\"\npoints = [[0, 0, 0.15], [0, 0, \
            0]]\n",
    ));
    assert_eq!((pinned.len(), joined.len()), (8, 8));
    for (pinned, joined) in pinned.iter().zip(&joined) {
        assert_eq!(pinned.motion, joined.motion);
        if pinned.frequency > 0.0 {
            assert_close("ω", joined.frequency, pinned.frequency, 1e-8);
            assert_close("δ", joined.decay_rates[0], pinned.decay_rates[0], 1e-7);
        }
    }
}

#[test]
fn body_welded_to_space_has_no_modes() {
    let scene = format!(
        "{TIME}{}[[joint]]\nname = \"w\"\nbetween = [\"rod\", \"space\"]\nkind = \"weld\"\n",
        rod("rod", 1.0, [0.0, 0.0], 0.0)
    );
    assert!(of_body(&scene).is_empty());
}

#[test]
fn run_from_the_shape_of_a_mode_comes_back_after_its_period() {
    let scene = |angles: [f64; 2]| {
        let [(s, c), (t, d)] = angles.map(f64::sin_cos);
        [
            "time = { end = 100, sample = 100 }\nsolver = { rtol = 1e-12, atol = 1e-14 }\n",
            &rod("upper", 2.0, [0.5 * s, -0.5 * c], angles[0]),
            &rod("lower", 3.0, [s + 0.5 * t, -c - 0.5 * d], angles[1]),
            &hinge("a", ["space", "upper"], [[0.0; 3], [0.0, 0.0, 0.5]]),
            &hinge("b", ["upper", "lower"], [[0.0, 0.0, -0.5], [0.0, 0.0, 0.5]]),
        ]
        .concat()
    };
    let SceneModes { systems, .. } = modes(&parsed(&scene([0.0; 2]), &[]));
    for mode in &systems[0].rest_state.as_ref().unwrap().modes {
        let period = TAU / mode.frequency;
        let departure = |amplitude: f64| {
            // δP of a turn by δθ about −y: the entry xz is −δθ.
            let turns = [0, 1].map(|body| -amplitude * mode.shape.0[body].1.gradient[0][2]);
            let scene = parsed(&scene(turns), &[&format!("time.end={period:?}")]);
            let job = Job::of(&scene, &Provenance { version: "test".into(), commit: None });
            let start = job.start.bodies.clone();
            let mut simulation = Simulation::new(job.model, job.start, job.plan).unwrap();
            let mut sink = MemorySink::default();
            simulation.begin(&mut sink).unwrap();
            simulation.run(&mut sink, &mut Unwatched).unwrap();
            let end = simulation.state();
            end.bodies.iter().zip(&start).map(|(one, other)| (one - other).abs()).fold(0.0, f64::max)
        };
        // A pendulum is odd in its angles: what the linear motion leaves goes with the cube of the amplitude.
        let ratio = departure(8e-3) / departure(4e-3);
        println!("period {period} s: half the amplitude leaves a part 1/{ratio}");
        assert!((ratio - 8.0).abs() < 0.1, "{ratio}");
    }
}

/// Supports and anchors that move are held where they are at t = 0, joints and springs to them, too: a rod hangs on a
/// shaker that turns back just then, and a ball on a spring whose anchor leaves with 1 m/s.
#[test]
fn what_hangs_on_a_moving_support_or_anchor_rests_as_if_that_were_held() {
    let shaker = "[[support]]\nname = \"shaker\"\nplane = {}\nmotion = { oscillate = { direction = [0, 0, 1], \
                  amplitude = 0.02, frequency = 9, phase = \"90 deg\" } }\n";
    let scene = format!(
        "{TIME}{shaker}{}{}",
        rod("rod", 1.0, [0.0, -0.48], 0.0),
        hinge("h", ["shaker", "rod"], [[0.0; 3], [0.0, 0.0, 0.5]])
    );
    let swing = of_body(&scene);
    assert_close("on a shaker", swing[0].frequency, (GRAVITY * 0.5 / (INERTIA + 0.25)).sqrt(), 1e-9);
    let scene = format!(
        "world = {{ gravity = [0, 0, 0] }}\n{TIME}[[body]]\nname = \"a\"\n\
         shape = {{ sphere = {{ radius = 0.1 }} }}\nmass = 2\n\
         keep = {{ line = [1, 0, 0] }}\nspring = [{{ anchor = [1, 0, 0], stiffness = 50, rest_length = 1, damping = 3, \
         anchor_motion = {{ velocity = [1, 0, 0] }} }}]\n"
    );
    let SceneModes { bodies, .. } = modes(&parsed(&scene, &[]));
    let rest = bodies[0].rest_state.as_ref().unwrap_or_else(|| panic!("{:?}", bodies[0].no_rest_state_because));
    assert!(rest.place.position[0].abs() < 1e-12, "{:?}", rest.place.position);
}

/// Nothing resists that a body turns: what rounding leaves of that is no growth, whatever attitude it begins in.
#[test]
fn a_viscous_body_that_begins_turned_is_free_to_turn() {
    for material in ["neo_hookean = { shear = 3000, bulk = 8000 }", "mooney_rivlin = { c1 = 900, c2 = 300 }"] {
        let scene = format!(
            "world = {{ gravity = [0, 0, 0] }}\n{TIME}[[body]]\nname = \"a\"\n\
             shape = {{ sphere = {{ radius = 0.1 }} }}\n\
             density = 1000\naffine = {{ material = {{ {material} }}, viscosity = 20 }}\n\
             orientation = {{ axis_angle = {{ axis = [1, 2, 3], angle = 0.7 }} }}\n"
        );
        let free = of_body(&scene).iter().filter(|mode| mode.motion == "free").count();
        assert_eq!(free, 6, "{material}: {:?}", of_body(&scene).iter().map(|mode| mode.motion).collect::<Vec<_>>());
    }
}
