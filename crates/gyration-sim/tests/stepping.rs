//! Runs that their caller steps: what is applied acts as what a scene gives, the ledger closes, a loop can be closed.

use gyration::kinematics::{Placement, Velocity};
use gyration::load::Applied;
use gyration::tensor::{Mat3, Vec3};
use gyration_scene::Scene;
use gyration_sim::{BodyStart, MemorySink, Monitor, Progress, Reason, Refusal, Simulation, SteppedRun, Unwatched};
use proptest::prelude::*;
use std::path::Path;

fn stepper(text: &str) -> SteppedRun {
    let scene = Scene::parse("hand.toml", text, Path::new(""), &[]).unwrap();
    SteppedRun::new(scene.built()).unwrap()
}

fn force(force: Vec3) -> Applied {
    Applied { force, ..Applied::default() }
}

/// Kinds of a body that tumbles, without gravity.
fn tumbling(kind: &str) -> String {
    format!(
        r#"
        world.gravity = [0, 0, 0]
        time = {{ end = 1, sample = 0.1 }}
        solver.rtol = 1e-9
        [[body]]
        name = "b"
        {kind}
        shape = {{ box = {{ size = [0.1, 0.2, 0.3] }} }}
        mass = 2.0
        velocity = [0.3, -0.2, 1.5]
        "#
    )
}

const RIGID: &str = "angular_velocity = [1, 2, 3]";
const AFFINE: &str = "angular_velocity = [1, 2, 3]\n\
                      affine = { material = { mooney_rivlin = { c1 = 3e3, c2 = 1e3 } } }";

#[test]
fn a_constant_force_is_the_free_fall_of_the_closed_form() {
    let weight = Vec3::new(0.0, 0.0, -2.0 * 9.81);
    for kind in [RIGID, AFFINE] {
        let mut run = stepper(&tumbling(kind));
        run.apply(0, force(weight)).unwrap();
        run.advance(1.0, &mut Unwatched).unwrap();
        let motion = *run.motion(0);
        let exact = Vec3::new(0.3, -0.2, 1.5 - 0.5 * 9.81);
        let error = (motion.placement.position - exact).norm();
        println!("free fall by an applied force, {}: error {error:.1e} m", &kind[..10]);
        // The motion of the centre is a parabola, on which every stepper is exact: roundings of some hundred steps.
        assert!(error < 1e-13, "{error}");
        assert!((motion.velocity.velocity - Vec3::new(0.3, -0.2, 1.5 - 9.81)).norm() < 1e-13);
        let ledger = run.ledger().unwrap();
        let work = weight.dot(&motion.placement.position);
        assert!((ledger.works.iter().sum::<f64>() - work).abs() < 1e-11, "{:?} {work}", ledger.works);
    }
}

#[test]
fn a_torque_turns_a_ball_as_the_closed_form_says() {
    let text = "world.gravity = [0, 0, 0]\ntime = { end = 1, sample = 0.1 }\n[[body]]\nname = \"b\"\nshape = { sphere = { radius = 0.1 } }\nmass = 2.0";
    let mut run = stepper(text);
    let torque = Vec3::new(0.01, -0.02, 0.03);
    run.apply(0, Applied { torque, ..Applied::default() }).unwrap();
    run.advance(0.7, &mut Unwatched).unwrap();
    let inertia = 0.4 * 2.0 * 0.01;
    let spin = run.motion(0).angular_velocity();
    assert!((spin - torque * 0.7 / inertia).norm() < 1e-12 * spin.norm(), "{spin}");
}

#[test]
fn a_force_at_a_point_is_a_force_and_its_moment() {
    let point = Vec3::new(0.05, 0.1, -0.15);
    let pull = Vec3::new(1.0, 2.0, -1.0);
    for kind in [RIGID, AFFINE] {
        let mut run = stepper(&tumbling(kind));
        let start = run.motion(0).placement.position + run.motion(0).placement.gradient * point;
        run.apply(0, Applied::at_point(pull, &point)).unwrap();
        run.advance(0.5, &mut Unwatched).unwrap();
        let end = run.motion(0).placement.position + run.motion(0).placement.gradient * point;
        // The work of a constant force is the force times the way of its point.
        let work: f64 = run.ledger().unwrap().works.iter().sum();
        let error = (work - pull.dot(&(end - start))).abs();
        println!("work of a force at a point, {}: {work:.9} J, error {error:.1e} J", &kind[..10]);
        // rtol of a tenth of 1e-9 a step on energies of the order of 2 J.
        assert!(error < 1e-8, "{error}");
    }
}

#[test]
fn the_ledger_closes_under_a_force_that_switches() {
    for scene in ["bounce", "elastic-bounce", "hop"] {
        let scene = Scene::open(scene, &["solver.rtol=1e-7".into()]).unwrap();
        let mut run = SteppedRun::new(scene.built()).unwrap();
        let weight = run.model().bodies[0].solid.mass.mass * 9.81;
        let size = run.model().bodies[0].size;
        let mut exchanged = 0.0_f64;
        for k in 0..20 {
            let sign = if k % 2 == 0 { 0.3 } else { -0.2 };
            let load = Applied {
                force: Vec3::new(0.1 * sign, 0.0, sign) * weight,
                moment: Mat3::new(0.1, 0.02, 0.0, 0.0, -0.1, 0.03, 0.0, 0.0, 0.1) * (0.1 * sign * weight * size),
                torque: Vec3::new(0.0, 0.01, 0.02) * (sign * weight * size),
            };
            run.apply(0, load).unwrap();
            run.advance(f64::from(k + 1) * 0.02, &mut Unwatched).unwrap();
            let ledger = run.ledger().unwrap();
            let all = ledger.energies.iter().chain(&ledger.works);
            exchanged = all.map(|entry| entry.abs()).sum::<f64>().max(exchanged);
        }
        let residual = run.ledger().unwrap().residual.abs();
        println!("{}: residual {residual:.1e} J of {exchanged:.1e} J after 20 switches", scene.name());
        // The ledger of a long run stays within a hundred times rtol of the energy in play.
        assert!(residual < 1e-5 * exchanged, "{residual} of {exchanged}");
    }
}

/// A pendulum upside down, held by a moment about its pin: θ̈ = (m g l sin θ + τ)/I with τ = −a θ − b θ̇ held over each
/// interval.
#[test]
fn a_controlled_pin_holds_a_body_up() {
    let text = r#"
        world.gravity = [0, 0, -9.81]
        time = { end = 10, sample = 0.1 }
        solver.rtol = 1e-10
        [[body]]
        name = "rod"
        shape = { box = { size = [0.02, 0.02, 1.0] } }
        mass = 1.0
        pin = [0, 0, -0.5]
        orientation = { axis_angle = { axis = [0, 1, 0], angle = 0.001 } }
    "#;
    let mut run = stepper(text);
    let (inertia, stiffness) = ((1.0 + 0.0004) / 12.0 + 0.25, 9.81 * 0.5);
    let (proportional, derivative, interval) = (12.0, 1.5, 0.01);
    // The same loop by its closed form: over an interval θ̈ = k² θ + τ/I is solved by cosh and sinh.
    let rate = f64::sqrt(stiffness / inertia);
    let (mut angle, mut spin) = (0.001_f64, 0.0_f64);
    for k in 0..300 {
        let rotation = run.motion(0).placement.gradient;
        let (seen, seen_spin) = (rotation[(0, 2)].atan2(rotation[(2, 2)]), run.motion(0).angular_velocity().y);
        let torque = -proportional * seen - derivative * seen_spin;
        run.apply(0, Applied { torque: Vec3::new(0.0, torque, 0.0), ..Applied::default() }).unwrap();
        run.advance(f64::from(k + 1) * interval, &mut Unwatched).unwrap();
        let held = -proportional * angle - derivative * spin;
        let (c, s) = ((rate * interval).cosh(), (rate * interval).sinh());
        let offset = held / (inertia * rate * rate);
        (angle, spin) = ((angle + offset) * c + spin / rate * s - offset, (angle + offset) * rate * s + spin * c);
        if k == 20 {
            let reached = run.motion(0).placement.gradient[(0, 2)].asin();
            let error = (reached - angle).abs();
            println!(
                "inverted pendulum after {} intervals: {reached:.9e} rad, closed form {angle:.9e}, error {error:.1e}",
                k + 1
            );
            // sin θ − θ = θ³/6 of 1e-3 rad: 2e-10 rad, grown by less than the time constants of the loop.
            assert!(error < 1e-9, "{error}");
        }
    }
    let end = run.motion(0).placement.gradient[(0, 2)].abs();
    println!("inverted pendulum after 300 intervals: {end:.2e} rad, closed form {:.2e}", angle.abs());
    assert!((end - angle.abs()).abs() < 1e-9 && end < 1e-5, "it stands: {end}");
    let without = {
        let mut run = stepper(text);
        run.advance(2.2, &mut Unwatched).unwrap();
        run.motion(0).placement.gradient[(2, 2)]
    };
    assert!(without < 0.9, "without the loop it falls: {without}");
}

#[test]
fn a_drive_set_by_hand_is_the_drive_of_a_scene() {
    let open = |overrides: &[&str]| {
        let overrides: Vec<String> = overrides.iter().map(|text| (*text).to_owned()).collect();
        Scene::open("contract-1", &overrides).unwrap()
    };
    let scene = open(&[]);
    let mut run = SteppedRun::new(scene.built()).unwrap();
    let before = run.time();
    run.set_drive(0, Mat3::from_diagonal(&Vec3::new(2e3, -1e3, -1e3))).unwrap();
    run.advance(0.05, &mut Unwatched).unwrap();
    assert!(run.time() > before);
    let ledger = run.ledger().unwrap();
    let scale: f64 = ledger.energies.iter().chain(&ledger.works).map(|entry| entry.abs()).sum();
    println!("contract-1 driven by hand: residual {:.1e} J of {scale:.1e} J", ledger.residual);
    assert!(ledger.residual.abs() < 1e-3 * scale, "{ledger:?}");
}

#[test]
fn what_makes_no_sense_is_refused() {
    let mut run = stepper(&tumbling(RIGID));
    assert_eq!(run.apply(3, Applied::default()), Err(Refusal::Body { index: 3, count: 1 }));
    let refused = run.apply(0, force(Vec3::new(f64::NAN, 0.0, 0.0)));
    assert_eq!(refused, Err(Refusal::NotFinite { body: "b".into() }));
    assert_eq!(run.set_drive(0, Mat3::zeros()), Err(Refusal::NoDrive { body: "b".into() }));
    // Symptom: a step began and ended at the same time.
    let late = run.begun_anew(1e17, &[]).unwrap().err();
    assert!(matches!(late, Some(Refusal::Time { time: 1e17, .. })), "{late:?}");
    assert!(run.begun_anew(1e9, &[]).unwrap().is_ok());
}

/// Symptom: G was projected to what the body can have, and not a word was said.
#[test]
fn a_contraction_that_a_body_cannot_have_is_refused() {
    let free = "contractile = { material = { mooney_rivlin = { c1 = 3e3, c2 = 1e3 } }, contraction_viscosity = 50 }";
    let run = stepper(&tumbling(free));
    let begun = |gradient: Mat3, contraction: Option<Mat3>| {
        let placement = Placement { gradient, ..run.motion(0).placement };
        let velocity = Velocity { velocity: Vec3::zeros(), gradient_rate: Mat3::zeros() };
        run.begun_anew(0.0, &[BodyStart { body: 0, placement, velocity, contraction }]).unwrap()
    };
    let one = Mat3::identity();
    for (gradient, contraction) in [
        (one, Some(2.0 * one)),
        (one, Some(-one)),
        (one, Some(Mat3::from_diagonal(&Vec3::new(2.0, 1.0, 1.0)))),
        (2.0 * one, None),
    ] {
        let refused = begun(gradient, contraction).err();
        assert!(matches!(&refused, Some(Refusal::Impossible { quantity: "G", .. })), "{refused:?}");
    }
    let stretched = Mat3::from_diagonal(&Vec3::new(2.0, 1.0, 0.5));
    let anew = begun(2.0 * one, Some(2.0 * stretched)).unwrap();
    assert!((anew.state().contraction(anew.model(), 0).unwrap() - 2.0 * stretched).norm() < 1e-14);
}

#[test]
fn stepping_by_hand_without_a_change_makes_the_steps_of_a_run() {
    let scene = Scene::open("bounce", &["time.end=0.4".into(), "time.sample=0.4".into()]).unwrap();
    let mut run = SteppedRun::new(scene.built()).unwrap();
    run.advance(0.4, &mut Unwatched).unwrap();
    let built = scene.built();
    let mut whole = Simulation::new(&built.model, &built.state, built.into()).unwrap();
    whole.run(&mut MemorySink::default(), &mut Unwatched).unwrap();
    let (state, ending) = (run.state(), whole.state());
    let difference = state.bodies.iter().zip(&ending.bodies).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    println!("by hand and in a run: the states differ by {difference:.1e}");
    // The ledger has an entry more, which has a part in the choice of the first step: the steps differ, and the states
    // by a trace of the tolerance 1e-6.
    assert!(difference < 1e-9, "{difference}");
    let columns = run.columns();
    let row = run.row().unwrap();
    let height = columns.iter().find(|(name, _)| name == "ball.z").unwrap().1;
    assert_eq!(row[height], run.motion(0).placement.position.z);
    assert!(run.events().iter().all(|event| event.body == 0) && !run.events().is_empty());
}

/// Nodes and weights of Gauss and Legendre on [0, 1], exact for polynomials of degree 7.
const GAUSS: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
];
/// Asks to stop after so many steps.
struct StopAfter(u32);

impl Monitor for StopAfter {
    fn after_step(&mut self, _: &Progress) -> Option<Reason> {
        self.0 = self.0.saturating_sub(1);
        (self.0 == 0).then_some(Reason::Interrupted)
    }

    fn counts_steps(&self) -> bool {
        true
    }
}

/// A box that spins high above a floor, whose horizon is shorter than its steps, and a ball with steps of its own; both
/// within reach of each other at first, or never.
#[test]
fn whenever_a_run_by_hand_is_stopped_all_bodies_are_at_its_time() {
    let bodies = |apart: f64| {
        format!(
            r#"
            time = {{ end = 4, sample = 1 }}
            [[support]]
            name = "floor"
            plane = {{}}
            [[contact]]
            support = "floor"
            repulsion = {{ alpha = 1, nu = 6, d0 = 1e-3 }}
            [[contact]]
            between = ["box", "ball"]
            repulsion = {{ alpha = 1e-3, nu = 6, d0 = 1e-4 }}
            reach = 0.02
            [[body]]
            name = "box"
            shape = {{ box = {{ size = [0.1, 0.2, 0.3] }} }}
            mass = 2.0
            position = [0, 0, 300]
            angular_velocity = [0.5, 25, 1]
            [[body]]
            name = "ball"
            shape = {{ sphere = {{ radius = 0.1 }} }}
            mass = 1.0
            position = [{apart}, 0, 300]
            velocity = [0.5, 0, 1]
            "#
        )
    };
    let fallen = |place: Vec3, speed: Vec3, time: f64| place + time * speed - Vec3::z() * (0.5 * 9.81 * time * time);
    for apart in [0.3, 5.0] {
        for steps in 1..40 {
            let mut run = stepper(&bodies(apart));
            let stopped = run.advance(3.0, &mut StopAfter(steps));
            let time = run.time();
            let exact = [
                fallen(Vec3::new(0.0, 0.0, 300.0), Vec3::zeros(), time),
                fallen(Vec3::new(apart, 0.0, 300.0), Vec3::new(0.5, 0.0, 1.0), time),
            ];
            for (body, exact) in exact.iter().enumerate() {
                let off = (run.motion(body).placement.position - exact).norm();
                assert!(
                    off < 1e-6,
                    "{apart} m apart, stopped after {steps} steps at {time} s: body {body} is {off:e} m off"
                );
            }
            assert!(stopped.is_err() || time == 3.0);
        }
    }
}

/// A block that drives itself, free in space; `kind` says what of its volume is given.
fn contracting(kind: &str) -> String {
    format!(
        r#"
        world.gravity = [0, 0, 0]
        time = {{ end = 1, sample = 0.1 }}
        solver.rtol = 1e-9
        [[body]]
        name = "b"
        shape = {{ box = {{ size = [0.1, 0.12, 0.15] }} }}
        density = 1000
        velocity = [0.3, -0.2, 0.5]
        angular_velocity = [2, -1, 3]
        [body.contractile]
        {kind}
        viscosity = 20
        contraction_viscosity = 500
        drive = {{ sine = {{ amplitude = [[200, 0, 0], [0, -300, 100], [0, 100, 400]], frequency = "5 Hz" }} }}
        "#
    )
}

/// P of the load on a body in motion: F·ṗ₀ + (M_a + ½ [τ]× P⁻ᵀ)·Ṗ [W].
fn power(load: &Applied, run: &SteppedRun) -> f64 {
    let motion = run.motion(0);
    let turning = 0.5 * load.torque.cross_matrix() * motion.placement.gradient.try_inverse().unwrap().transpose();
    load.force.dot(&motion.velocity.velocity) + (load.moment + turning).dot(&motion.velocity.gradient_rate)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, failure_persistence: None, ..ProptestConfig::default() })]

    /// Whatever is applied to a body that drives itself: `work.load` is the integral of the power of the load, and the
    /// ledger closes.
    #[test]
    fn the_work_of_a_load_is_the_integral_of_its_power_on_a_contractile_body(
        incompressible in any::<bool>(),
        force in prop::array::uniform3(-5.0..5.0),
        moment in prop::array::uniform9(-0.2..0.2),
        torque in prop::array::uniform3(-0.2..0.2),
    ) {
        let material = "material = { mooney_rivlin = { c1 = 3e3, c2 = 1e3";
        let kind = if incompressible { format!("{material} }} }}\nisochoric = \
            true") } else { format!("{material}, bulk = 2e4 }} }}") };
        let mut run = stepper(&contracting(&kind));
        let load = Applied { force: force.into(), moment: Mat3::from_row_slice(&moment), torque: torque.into() };
        run.apply(0, load).unwrap();
        let (intervals, length) = (20, 0.01);
        let (mut integral, mut exchanged) = (0.0, 0.0);
        for k in 0..intervals {
            for (node, weight) in GAUSS {
                run.advance((f64::from(k) + node) * length, &mut Unwatched).unwrap();
                let power = power(&load, &run);
                integral += weight * length * power;
                exchanged += weight * length * power.abs();
            }
        }
        run.advance(f64::from(intervals) * length, &mut Unwatched).unwrap();
        let names: Vec<&str> = run.model().works().iter().map(|work| work.name()).collect();
        let ledger = run.ledger().unwrap();
        let work = ledger.works[names.iter().position(|name| *name == "load").unwrap()];
        let in_play: f64 = ledger.energies.iter().chain(&ledger.works).map(|entry| entry.abs()).sum();
        let (error, residual) = ((work - integral).abs(), ledger.residual.abs());
        println!("work.load {work:+.6e} J, error {error:.1e} J; residual {residual:.1e} J of {in_play:.1e} J");
        // Gauss on motions of some tens of hertz over a hundredth of a second leaves nothing; the run a hundred times
        // rtol.
        prop_assert!(error < 1e-7 * (exchanged + in_play), "{} against {}", work, integral);
        prop_assert!(residual < 1e-7 * in_play, "{} of {}", residual, in_play);
    }
}

/// Bodies that are pushed and meet a table, with what is applied changed on the way: unlike in all directions.
const PUSHED: &str = r#"
    time = { end = 1, sample = 0.1 }
    [[support]]
    name = "table"
    plane = { origin = [0, 0, 0], normal = [0.1, 0.2, 1] }
    [[contact]]
    support = "table"
    repulsion = { alpha = 4e4, nu = 6, d0 = 0.002 }
    [[body]]
    name = "a"
    shape = { box = { size = [0.1, 0.2, 0.3] } }
    mass = 2.0
    position = [0, 0, 0.25]
    angular_velocity = [1, 2, 3]
    [[body]]
    name = "b"
    shape = { sphere = { radius = 0.1 } }
    mass = 1.0
    position = [1, 0, 0.4]
"#;

#[test]
fn a_stepped_run_goes_on_from_its_checkpoint_after_any_step() {
    let mut run = stepper(PUSHED);
    let mut kept = Vec::new();
    for step in 0..40 {
        if step % 7 == 0 {
            run.apply(step / 7 % 2, force(Vec3::new(0.3, -0.1 * step as f64, 0.2))).unwrap();
        }
        kept.push(run.checkpoint());
        run.step().unwrap();
    }
    for (step, pair) in kept.windows(2).enumerate() {
        let mut other = run.restored(&pair[0]).unwrap();
        assert_eq!(other.checkpoint(), pair[0], "step {step}");
        other.step().unwrap();
        if (step + 1) % 7 == 0 {
            let step = step + 1;
            other.apply(step / 7 % 2, force(Vec3::new(0.3, -0.1 * step as f64, 0.2))).unwrap();
        }
        assert_eq!(other.checkpoint(), pair[1], "step {step}");
    }
}

#[test]
fn what_is_no_checkpoint_of_a_stepped_run_is_refused() {
    let mut run = stepper(PUSHED);
    run.apply(1, force(Vec3::x())).unwrap();
    run.advance(0.2, &mut Unwatched).unwrap();
    let checkpoint = run.checkpoint();
    for length in (0..checkpoint.len()).step_by(8) {
        // An end between two islands leaves fewer bodies than there are.
        assert!(run.restored(&checkpoint[..length]).is_err(), "{length}");
    }
    assert!(stepper(&tumbling(RIGID)).restored(&checkpoint).is_err());
}
