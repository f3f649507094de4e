//! Bodies that springs join: an island of several, whose momenta nothing else changes.

use crate::islands::{HEAD, body, motion_in, parsed, run};
use crate::runs::{StopAfter, bytes, provenance};
use gyration::tensor::Vec3;
use gyration::{Inadmissible, Quantity};
use gyration_scene::Scene;
use gyration_sim::{Job, MemorySink, Outcome, Reason, RunPlan, Simulation, Stop, Unwatched};
use std::num::NonZeroUsize;

/// Joins two bodies of `islands::body` by points off their centres.
fn spring(one: usize, other: usize) -> String {
    format!(
        "[[spring]]\nbetween = [\"b{one}\", \"b{other}\"]\npoints = [[0.005, 0, 0.004], [0, 0.006, -0.003]]\n\
         stiffness = 0.4\nrest_length = 0.05\ndamping = 2e-4\n"
    )
}

/// Bodies on the table, some of them joined.
fn scene_of(indices: &[usize], joined: &[(usize, usize)], overrides: &[&str]) -> Scene {
    let springs = joined.iter().map(|(one, other)| spring(*one, *other));
    let text: String =
        std::iter::once(HEAD.to_owned()).chain(indices.iter().map(|k| body(*k))).chain(springs).collect();
    parsed(&text, overrides)
}

#[test]
fn joined_bodies_move_to_the_last_bit_as_if_there_were_no_others() {
    const COUNT: usize = 10;
    let all: Vec<usize> = (0..COUNT).collect();
    // One chain through bodies that are not neighbours, and a pair; the others are alone.
    let (chain, pair) = ([(0, 7), (7, 3), (0, 3)], [(4, 5)]);
    let joined = [&chain[..], &pair].concat();
    for threads in [1, 3] {
        let (whole, outcome, _) = run(&scene_of(&all, &joined, &[]), threads, false);
        assert_eq!(outcome, Outcome::Completed);
        for (members, own) in [(&[0, 3, 7][..], &chain[..]), (&[4, 5], &pair), (&[6], &[])] {
            let (alone, ..) = run(&scene_of(members, own, &[]), 1, false);
            assert_eq!(whole.kept.rows.len(), alone.kept.rows.len());
            for ((time, row), (_, own)) in whole.kept.rows.iter().zip(&alone.kept.rows) {
                for (place, body) in members.iter().enumerate() {
                    let of_own = motion_in(own, members.len(), place);
                    assert_eq!(motion_in(row, COUNT, *body), of_own, "b{body} at {time} s");
                }
            }
        }
    }
}

#[test]
fn joined_bodies_are_resumed_at_any_moment_to_the_same_bytes() {
    let scene = scene_of(&[0, 1, 2, 3, 4], &[(0, 3), (3, 1)], &["time.end=0.2"]);
    let folder = tempfile::tempdir().unwrap();
    let job = Job::of(&scene, &provenance());
    let whole = folder.path().join("whole.gyr");
    job.record(&whole, &mut Unwatched).unwrap();
    for windows in [1, 4, 9] {
        let path = folder.path().join(format!("{windows}.gyr"));
        job.record(&path, &mut StopAfter(windows)).unwrap();
        job.resume(&path, &mut StopAfter(3)).unwrap();
        job.resume(&path, &mut Unwatched).unwrap();
        assert!(bytes(&whole) == bytes(&path), "after {windows} windows");
    }
}

/// A box, a soft box and points, free of everything but springs, one of them without length at rest.
pub const FREE: &str = r#"
    time = { end = 6, sample = 0.1 }
    world = { gravity = [0, 0, 0] }
    solver = { rtol = 1e-10, atol = 1e-12 }
    [[body]]
    name = "a"
    shape = { box = { size = [0.4, 0.2, 0.3] } }
    mass = 2
    position = [10, 0, 0]
    velocity = [0.3, 0.1, -0.2]
    angular_velocity = [2, -1, 3]
    [[body]]
    name = "b"
    shape = { sphere = { radius = 0.2 } }
    mass = 0.7
    affine = { material = { neo_hookean = { shear = 40 } }, viscosity = 0.5 }
    position = [10.5, 0.3, 0]
    velocity = [-0.4, 0.5, 0.3]
    gradient = [[1.1, 0.1, 0], [0, 0.9, 0], [0, 0.05, 1.0101010101010102]]
    [[body]]
    name = "c"
    shape = { points = [{ mass = 1, at = [0.1, 0, 0] }, { mass = 2, at = [0, 0.1, 0] }, { mass = 1, at = [0, 0, 0.1] }]}
    position = [10, 0.6, 0.2]
    [[spring]]
    between = ["a", "b"]
    points = [[0.2, 0.1, 0], [0, 0, 0.2]]
    stiffness = 30
    rest_length = 0.3
    damping = 0.4
    [[spring]]
    between = ["c", "b"]
    points = [[0.1, 0, 0], [0.1, -0.1, 0]]
    stiffness = 12
    [[spring]]
    between = ["a", "c"]
    stiffness = 20
    rest_length = 0.5
"#;

/// Σ m ṗ₀ and Σ (p₀ × m ṗ₀ + axial of Ṗ J Pᵀ), about a point near by.
fn momenta(simulation: &Simulation, about: Vec3) -> (Vec3, Vec3) {
    let (model, state) = (simulation.model(), simulation.state());
    let mut sum = (Vec3::zeros(), Vec3::zeros());
    for (index, body) in model.bodies.iter().enumerate() {
        let motion = state.motion(model, index);
        let (mass, euler) = (body.solid.mass.mass, body.solid.mass.euler_tensor);
        let momentum = mass * motion.velocity.velocity;
        let own = motion.velocity.gradient_rate * euler * motion.placement.gradient.transpose();
        sum.0 += momentum;
        sum.1 += (motion.placement.position - about).cross(&momentum);
        sum.1 += Vec3::new(own[(2, 1)] - own[(1, 2)], own[(0, 2)] - own[(2, 0)], own[(1, 0)] - own[(0, 1)]);
    }
    sum
}

#[test]
fn springs_between_bodies_change_no_momentum_and_close_the_ledger() {
    for method in ["explicit", "implicit"] {
        let scene = parsed(FREE, &[&format!("solver.method={method}")]);
        let job = Job::of(&scene, &provenance());
        let mut simulation = Simulation::new(job.model, job.start, job.plan).unwrap();
        let about = Vec3::new(10.0, 0.0, 0.0);
        let before = momenta(&simulation, about);
        let mut sink = MemorySink::default();
        simulation.begin(&mut sink).unwrap();
        assert_eq!(simulation.run(&mut sink, &mut Unwatched).unwrap(), Outcome::Completed);
        let after = momenta(&simulation, about);
        let residual = simulation.run_state().largest_residual.abs();
        let (linear, angular) = ((after.0 - before.0).norm(), (after.1 - before.1).norm());
        println!(
            "{method}: momentum changed by {linear:.1e} of 3.4 kg m/s, {angular:.1e} kg m²/s; residual {residual:.1e} J"
        );
        // Rounding of the momenta, of a step a hundredfold where T⁻¹ is; the angular one and the ledger within the
        // tolerance of some hundred steps.
        assert!(linear < 3e-14 && angular < 1e-12 && residual < 1e-10);
    }
}

#[test]
fn explicit_and_implicit_steps_follow_the_same_bodies() {
    let end = |method: &str| {
        let scene = parsed(FREE, &[&format!("solver.method={method}")]);
        let job = Job::of(&scene, &provenance());
        let mut simulation = Simulation::new(job.model, job.start, job.plan).unwrap();
        let mut sink = MemorySink::default();
        simulation.begin(&mut sink).unwrap();
        simulation.run(&mut sink, &mut Unwatched).unwrap();
        simulation.state().bodies
    };
    let (explicit, implicit) = (end("explicit"), end("implicit"));
    let apart = explicit.iter().zip(&implicit).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    println!("apart by {apart:.1e}");
    assert!(apart < 1e-7, "{apart:e}");
}

/// Two balls on a line, and one that nothing pulls.
fn drawn_together() -> String {
    let ball = |name: &str, place: f64| {
        format!(
            "[[body]]\nname = \"{name}\"\nshape = {{ sphere = {{ radius = 0.1 }} }}\nmass = 1\n\
             position = [{place}, 0, 0]\n"
        )
    };
    [
        "time = { end = 1, sample = 0.1 }\nworld = { gravity = [0, 0, 0] }\n".to_owned(),
        ball("left", -1.0) + &ball("right", 1.0) + &ball("other", 5.0),
        "[[spring]]\nbetween = [\"right\", \"left\"]\nstiffness = 1\nrest_length = 0.2\n".into(),
    ]
    .concat()
}

/// The force jumps where the ends pass each other, from k l₀ to −k l₀, and the energy has a cusp: with r the distance
/// on the line, r = l₀ + (2 − l₀) cos ωt up to r = 0, ω² = 2k/m, then the same backwards and on the other side.
#[test]
fn ends_of_a_spring_pass_through_one_another() {
    let (rest, frequency) = (0.2, 2_f64.sqrt());
    let period = 4.0 * f64::acos(-rest / (2.0 - rest)) / frequency;
    let scene = parsed(&drawn_together(), &[&format!("time.end={period:?}"), "solver.rtol=1e-9"]);
    let job = Job::of(&scene, &provenance());
    let mut simulation = Simulation::new(job.model, job.start, job.plan).unwrap();
    let mut sink = MemorySink::default();
    simulation.begin(&mut sink).unwrap();
    assert_eq!(simulation.run(&mut sink, &mut Unwatched).unwrap(), Outcome::Completed);
    let place = |body: usize| simulation.state().motion(job.model, body).placement.position;
    let apart = [place(0) - Vec3::new(-1.0, 0.0, 0.0), place(1) - Vec3::x(), place(2) - 5.0 * Vec3::x()];
    println!("off by {:?}, residual {:.1e} J", apart.map(|it| it.norm()), simulation.run_state().largest_residual);
    // Steps may err by 1e-9 of 2 J and 1 m; the jump is found by small ones.
    assert!(apart[0].norm() < 1e-7 && apart[1].norm() < 1e-7 && apart[2].norm() == 0.0);
}

#[test]
fn a_spring_without_length_is_told_with_its_bodies() {
    let scene = parsed(&drawn_together(), &[]);
    let left = Inadmissible { body: 1, quantity: Quantity::SpringLength { spring: 0 }, value: 0.0 };
    let stop = Stop::by_inadmissible(&scene.built().model, 0.5, &left);
    assert_eq!((stop.reason, stop.body.as_deref()), (Reason::SpringCollapsed, Some("right")));
    assert!(stop.what.contains("\"right\" and \"left\""), "{}", stop.what);
}

#[test]
fn islands_of_several_bodies_share_threads() {
    let (indices, joined): (Vec<usize>, Vec<_>) = ((0..12).collect(), (0..6).map(|k| (k, 11 - k)).collect());
    let scene = scene_of(&indices, &joined, &["time.end=0.1"]);
    let job = Job::of(&scene, &provenance());
    let state = |threads: usize| {
        let plan = RunPlan { threads: NonZeroUsize::new(threads), ..job.plan };
        let mut simulation = Simulation::new(job.model, job.start, plan).unwrap();
        let mut sink = MemorySink::default();
        simulation.begin(&mut sink).unwrap();
        simulation.run(&mut sink, &mut Unwatched).unwrap();
        (format!("{:?}", sink.rows), simulation.checkpoint())
    };
    assert!(state(1) == state(2));
}

/// Balls on a stretched line of springs between two anchors, in balance but for rounding; the first moves, or none.
fn stretched(stiffness: f64, speed: f64, method: &str) -> Scene {
    let direction = Vec3::new(0.6, 0.0, 0.8);
    let at = |part: f64| format!("{:?}", (part * direction).as_slice());
    let mut text = format!(
        "world = {{ gravity = [0, 0, 0] }}\ntime = {{ end = 1, sample = 0.1 }}\nsolver = {{ method = \"{method}\" }}\n"
    );
    for k in 0..6 {
        let place = 0.1 * (k + 1) as f64;
        let end = match k {
            0 => Some(0.0),
            5 => Some(0.7),
            _ => None,
        };
        let anchor = end.map(|end| {
            format!("spring = [{{ anchor = {}, stiffness = {stiffness:e}, rest_length = 0.05 }}]\n", at(end))
        });
        text += &format!(
            "[[body]]\nname = \"b{k}\"\nshape = {{ sphere = {{ radius = 0.02 }} }}\nmass = 0.1\nposition = {}\n\
             velocity = [0, {}, 0]\n{}",
            at(place),
            if k == 0 { speed } else { 0.0 },
            anchor.unwrap_or_default()
        );
    }
    for k in 0..5 {
        text += &format!(
            "[[spring]]\nbetween = [\"b{k}\", \"b{}\"]\nstiffness = {stiffness:e}\nrest_length = 0.05\n",
            k + 1
        );
    }
    parsed(&text, &[])
}

#[test]
fn springs_in_balance_hold_no_run_up_by_their_rounding() {
    for (stiffness, speed, methods) in [
        (1e4, 0.0, &["auto", "implicit"][..]),
        (1e9, 0.0, &["auto", "implicit"]),
        (1e4, 1e-3, &["auto"]),
        (1e6, 1e-3, &["auto"]),
    ] {
        for method in methods {
            let scene = stretched(stiffness, speed, method);
            let job = Job::of(&scene, &provenance());
            let mut simulation = Simulation::new(job.model, job.start, job.plan).unwrap();
            let mut sink = MemorySink::default();
            simulation.begin(&mut sink).unwrap();
            // Twenty steps a period of the fastest wave; some for those that do not move.
            let periods = if speed > 0.0 { (4.0 * stiffness / 0.1).sqrt() / std::f64::consts::TAU } else { 0.0 };
            let most = 200 + (20.0 * periods) as usize;
            let outcome = simulation.run(&mut sink, &mut StopAfter(most)).unwrap();
            println!("k = {stiffness:e}, {speed} m/s, {method}: {:?}", simulation.statistics());
            assert_eq!(outcome, Outcome::Completed, "k = {stiffness:e}, {speed} m/s, {method}");
        }
    }
}
