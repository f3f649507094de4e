//! Nothing is allocated in a step, by any method, nor in a run between the things that its sink asks for.
//!
//! Allocations are counted by the global allocator of this program, thread by thread.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use allocation_counter::measure;
use gyration::state::State;
use gyration_ode::{BlockMatrix, CrossingDirection, Integrator, Method, Options, Statistics, System, find_crossing};
use gyration_record::RecordError;
use gyration_scene::Scene;
use gyration_sim::adapter::ModelSystem;
use gyration_sim::events::Event;
use gyration_sim::{Job, Monitor, Outcome, Progress, Provenance, Reason, Simulation, Sink, Tolerance, Unwatched};
use std::path::Path;

/// A small box that falls on a corner, tumbles and comes to rest; a ball beside it.
const SCENE: &str = r#"
    [time]
    end = 2.0
    sample = 0.01
    [[support]]
    name = "table"
    plane = {}
    [[contact]]
    support = "table"
    repulsion = { alpha = "245 Pa", nu = 6, d0 = "0.6 mm" }
    damping = { beta = 1e4, nu = 3, d0 = "0.6 mm" }
    friction = { beta = 1e4, nu = 3, d0 = "0.6 mm" }
    [[body]]
    name = "box"
    shape = { box = { size = ["2 cm", "2 cm", "2 cm"] } }
    density = "1.25 g/cm^3"
    position = [0, 0, 0.05]
    orientation = { axis_angle = { axis = [1, 1, 0], angle = "30 deg" } }
    angular_velocity = [0, 20, 3]
    [[body]]
    name = "ball"
    shape = { sphere = { radius = "1 cm" } }
    density = "1.25 g/cm^3"
    position = [0.1, 0, 0.05]
"#;

fn scene() -> Scene {
    parsed(SCENE)
}

fn parsed(text: &str) -> Scene {
    Scene::parse("scene.toml", text, Path::new(""), &[]).unwrap()
}

/// Bodies in a fluid: soft and rigid without inertia, and a ball that the fluid remembers.
const IMMERSED: &str = r#"
    [time]
    end = 2.0
    sample = 0.01
    [fluid]
    viscosity = 1
    density = 1000
    velocity_gradient = { sine = { amplitude = [[0, 5, 0], [0, 0, 0], [0, 0, 0]], frequency = 2 } }
    [[body]]
    name = "soft"
    shape = { ellipsoid = { semi_axes = ["1 cm", "2 cm", "1 cm"] } }
    density = 1100
    affine = { material = { neo_hookean = { shear = 10 } } }
    inclusion = { inertia = false }
    [[body]]
    name = "grain"
    shape = { ellipsoid = { semi_axes = ["1 cm", "2 cm", "1 cm"] } }
    density = 1100
    inclusion = { inertia = false }
    [[body]]
    name = "ball"
    shape = { sphere = { radius = "1 cm" } }
    density = 3000
    inclusion = { history = true, history_error = 1e-2 }
    [[body]]
    name = "pudding"
    shape = { sphere = { radius = "1 cm" } }
    density = 3000
    affine = { material = { neo_hookean = { shear = 100 } } }
    inclusion = { history = true, history_error = 1e-1 }
"#;

/// One call of everything that has scratch of its own: what is sized then is not counted.
fn warm_up(system: &mut ModelSystem, start: &State) {
    let (n, works) = (start.bodies.len(), start.works.len());
    system.rates(0.0, &start.bodies, &mut vec![0.0; n], &mut vec![0.0; works]).unwrap();
    let mut jacobian = BlockMatrix::new(system.blocks());
    system.jacobian(0.0, &start.bodies, &mut jacobian).unwrap();
}

/// Steps from the first to the end, each with an interpolation and a search for a crossing.
fn steps_after_the_first(scene: &Scene, method: Method, end: f64) -> (u64, Statistics) {
    let (model, start) = (&scene.built().model, &scene.built().state);
    let mut system = ModelSystem::new(model.clone(), start, Tolerance { rtol: 1e-6, atol: 1e-9 }).unwrap();
    warm_up(&mut system, start);
    let options = Options { method, max_step: 0.1, ..Options::default() };
    let mut integrator = Integrator::new(0.0, &start.bodies, &start.works, options);
    let mut sample = start.clone();
    integrator.step(&mut system, end).unwrap();
    let counted = measure(|| {
        while integrator.time() < end {
            let report = integrator.step(&mut system, end).unwrap();
            integrator.interpolate(0.5 * (report.start + report.end), &mut sample.bodies, &mut sample.works);
            let step = integrator.last_step().unwrap();
            find_crossing(&mut integrator, step, |_, y, _| y[9], CrossingDirection::Rising, 4);
        }
    });
    (counted.count_total, *integrator.statistics())
}

#[test]
fn no_step_allocates_by_any_method() {
    // The implicit method is dear where bodies bounce: it need not see more than the first impacts.
    for (method, end) in [(Method::Explicit, 0.5), (Method::Implicit, 0.15), (Method::Auto, 2.0)] {
        let (allocations, s) = steps_after_the_first(&scene(), method, end);
        println!("{method:?}: {allocations} allocations, {s:?}");
        assert_eq!(allocations, 0, "{method:?}");
        // What is to be free of allocations has happened.
        assert!(s.rejected_error > 0 && s.accepted() > 50, "{method:?}");
        match method {
            Method::Explicit => assert!(s.explicit_steps > 0),
            Method::Implicit => assert!(s.factorizations > s.jacobians),
            Method::Auto => assert!(s.explicit_steps > 0 && s.implicit_steps > 0 && s.switches > 0),
        }
    }
}

#[test]
fn no_step_allocates_in_a_fluid() {
    for (method, end) in [(Method::Implicit, 0.3), (Method::Auto, 0.5)] {
        let (allocations, s) = steps_after_the_first(&parsed(IMMERSED), method, end);
        println!("{method:?}: {allocations} allocations, {s:?}");
        assert_eq!(allocations, 0, "{method:?}");
        assert!(s.accepted() > 20 && s.factorizations > 5, "{method:?}");
    }
}

/// A box and a rubber ball that meet, again and again between two springs.
const MEETING: &str = r#"
    [time]
    end = 2.0
    sample = 0.01
    [world]
    gravity = [0, 0, 0]
    [[contact]]
    between = ["box", "ball"]
    measure = "reference_area"
    repulsion = { alpha = "245 Pa", nu = 6, d0 = "0.6 mm" }
    damping = { beta = 1e3, nu = 3, d0 = "0.6 mm" }
    friction = { beta = 1e3, nu = 3, d0 = "0.6 mm" }
    [[body]]
    name = "box"
    shape = { box = { size = ["2 cm", "2 cm", "2 cm"] } }
    density = "1.25 g/cm^3"
    angular_velocity = [0, 20, 3]
    spring = [{ anchor = [0, 0, 0], stiffness = 10 }]
    [[body]]
    name = "ball"
    shape = { sphere = { radius = "1 cm" } }
    density = "1.25 g/cm^3"
    affine = { material = { neo_hookean_log = { lambda = "60 kPa", mu = "30 kPa" } }, viscosity = 20 }
    position = [0.05, 0, 0.002]
    velocity = [-0.3, 0, 0]
    spring = [{ anchor = [0.02, 0, 0], stiffness = 10 }]
"#;

#[test]
fn no_step_allocates_where_bodies_meet() {
    for (method, end) in [(Method::Explicit, 0.5), (Method::Implicit, 0.15)] {
        let (allocations, s) = steps_after_the_first(&parsed(MEETING), method, end);
        println!("{method:?}: {allocations} allocations, {s:?}");
        assert_eq!(allocations, 0, "{method:?}");
        assert!(s.accepted() > 50, "{method:?}");
    }
}

/// A stick and a rubber ball under forces of their own.
const OWN: &str = r#"
    [time]
    end = 2.0
    sample = 0.01
    [world]
    gravity = [0, 0, 0]
    [constants]
    k = "3 N/m"
    [[body]]
    name = "stick"
    shape = { capsule = { radius = "1 cm", height = "3 cm" } }
    density = "1.25 g/cm^3"
    angular_velocity = [0, 20, 3]
    position = [0.1, 0, 0]
    potential = "0.5*k*(x^2 + y^2 + z^2) + 1e-4*(P_xx^2 - 1)^2"
    body_force = ["100*sin(20*y)", "-50*x", "cos(t)"]
    [[body]]
    name = "ball"
    shape = { sphere = { radius = "1 cm" } }
    density = "1.25 g/cm^3"
    affine = { material = { neo_hookean_log = { lambda = "600 Pa", mu = "300 Pa" } }, viscosity = 2 }
    velocity = [-0.3, 0, 0]
    potential = "0.5*k*x^2*(2 + sin(30*t))"
    linear_friction = { scale = "1 + 100*x^2", matrix = [
        [0.01, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0],
        [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0],
        [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0],
        [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0],
    ] }
"#;

#[test]
fn no_step_allocates_under_forces_of_their_own() {
    for (method, end) in [(Method::Explicit, 0.5), (Method::Implicit, 0.2)] {
        let (allocations, s) = steps_after_the_first(&parsed(OWN), method, end);
        println!("{method:?}: {allocations} allocations, {s:?}");
        assert_eq!(allocations, 0, "{method:?}");
        assert!(s.accepted() > 20, "{method:?}");
    }
}

/// Two links and a rubber block on a hinge and balls.
const JOINED: &str = r#"
    [time]
    end = 2.0
    sample = 0.01
    [[body]]
    name = "upper"
    shape = { box = { size = [0.2, 0.04, 0.06] } }
    density = 1000
    position = [0.1, 0, 0]
    [[body]]
    name = "block"
    shape = { box = { size = [0.1, 0.1, 0.08] } }
    density = 1000
    affine = { material = { neo_hookean_log = { lambda = "60 kPa", mu = "30 kPa" } }, viscosity = 20 }
    position = [0.25, 0, 0]
    [[joint]]
    name = "shoulder"
    between = ["space", "upper"]
    kind = "hinge"
    points = [[0, 0, 0], [-0.1, 0, 0]]
    axis = [0, 1, 0.2]
    [[joint]]
    name = "wrist"
    between = ["upper", "block"]
    kind = "ball"
    points = [[0.1, 0, 0], [-0.05, 0, 0]]
"#;

#[test]
fn no_step_allocates_where_bodies_are_joined() {
    for (method, end) in [(Method::Explicit, 0.5), (Method::Implicit, 0.2)] {
        let (allocations, s) = steps_after_the_first(&parsed(JOINED), method, end);
        println!("{method:?}: {allocations} allocations, {s:?}");
        assert_eq!(allocations, 0, "{method:?}");
        assert!(s.accepted() > 20, "{method:?}");
    }
}

/// Looks at everything and keeps nothing.
#[derive(Default)]
struct Nowhere {
    rows: u64,
    events: u64,
}

impl Sink for Nowhere {
    fn row(&mut self, _: f64, _: &[f64]) -> Result<(), RecordError> {
        self.rows += 1;
        Ok(())
    }

    fn event(&mut self, _: &Event) -> Result<(), RecordError> {
        self.events += 1;
        Ok(())
    }
}

/// Stops after the first events, when all scratch has been used.
struct Briefly;

impl Monitor for Briefly {
    fn after_step(&mut self, progress: &Progress) -> Option<Reason> {
        (progress.time > 0.2).then_some(Reason::Interrupted)
    }
}

#[test]
fn a_run_allocates_nothing_in_its_loop() {
    let scene = scene();
    let job = Job::of(&scene, &Provenance { version: "test".into(), commit: None });
    let mut simulation = Simulation::new(job.model, job.start, job.plan).unwrap();
    let mut sink = Nowhere::default();
    simulation.begin(&mut sink).unwrap();
    simulation.run(&mut sink, &mut Briefly).unwrap();
    assert!(sink.events > 0, "scratch for events has been used");
    let before = (sink.rows, sink.events, simulation.statistics());
    let mut outcome = None;
    let counted = measure(|| outcome = Some(simulation.run(&mut sink, &mut Unwatched)));
    assert_eq!(outcome.unwrap().unwrap(), Outcome::Completed);
    let after = simulation.statistics();
    let (rows, events, steps) = (sink.rows - before.0, sink.events - before.1, after.accepted() - before.2.accepted());
    println!("{} allocations in {steps} steps, {rows} rows, {events} events", counted.count_total);
    assert!(steps > 50 && rows > 150 && events > 3 && after.implicit_steps > 0);
    assert_eq!(counted.count_total, 0);
}
