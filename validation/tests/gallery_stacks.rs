//! The gallery's `stack`, `bricks`, `wedge` and `billiard`: what stays, what momentum does, what friction takes.

use gyration_sim::Outcome;
use gyration_validation::{Case, Experiment, Run, largest};

const GRAVITY: f64 = 9.81;

fn last(run: &Run, column: &str) -> f64 {
    *run.column(column).last().unwrap()
}

#[test]
fn a_ball_knocks_a_brick_out_of_a_wall() {
    let experiment = Experiment::of_gallery("bricks", &["solver.rtol=1e-5", "solver.atol=1e-7"]);
    let run = experiment.run();
    for brick in 0..9 {
        let motion = run.end.motion(&experiment.model, brick);
        let start = experiment.start.motion(&experiment.model, brick);
        let moved = (motion.placement.position - start.placement.position).norm();
        // The one in the middle of the uppermost course is on the floor, the others are within half of their depth.
        assert_eq!(moved > 0.1, brick == 7, "brick-{brick} has moved by {moved} m");
        assert!(brick == 7 || moved < 0.025, "brick-{brick} has moved by {moved} m");
    }
    assert!(run.relative_residual() < 1e-7, "{}", run.relative_residual());
    // What is between ball and bricks keeps their momentum along a floor without friction.
    let smooth = Experiment::of_gallery("bricks", &["contact.0.friction.mu=0"]).until(0.03).run();
    let momentum = |run: &Run, sample: usize| {
        let bodies = experiment.model.bodies.iter().enumerate();
        let speed = |name: &str| run.column(&format!("{name}.vy"))[sample];
        let of = |index: usize| if index == 9 { speed("ball") } else { speed(&format!("brick-{index}")) };
        bodies.map(|(index, body)| body.solid.mass.mass * of(index)).sum::<f64>()
    };
    let case = Case { row: None, name: "gallery: bricks, no friction on the floor", source: "momentum" };
    let end = smooth.times.len() - 1;
    case.check("momentum along the floor [kg m/s]", momentum(&smooth, 0), momentum(&smooth, end), 1e-12);
    assert!(smooth.column("brick-7.vy")[end] > 0.5, "the ball has hit");
}

/// The scene `stack` with the uppermost `bricks`, each beyond the one below by `share` of L/2k.
fn stack(share: f64, bricks: usize) -> String {
    let text = gyration_scene::gallery_scene("stack").unwrap();
    let laws = text.split("\n[[body]]").next().unwrap();
    let bodies = (0..bricks).map(|below| {
        let place: f64 = (1..=below).map(|below| share * 0.05 / (bricks - below) as f64).sum();
        let height = 0.0151 + 0.030085 * below as f64;
        format!(
            "\n[[body]]\nname = \"brick-{below}\"\ngroup = \"brick\"\ndensity = 1250\n\
            shape = {{ box = {{ size = [0.1, 0.05, 0.03] }} }}\nposition = [{place}, 0, {height}]\n"
        )
    });
    format!("{laws}{}\n[solver]\nrtol = 1e-6\n", bodies.collect::<String>())
}

#[test]
fn a_stack_stands_within_the_harmonic_overhang_less_what_gaps_give() {
    let lean = |share: f64, bricks: usize| {
        let experiment = Experiment::of_scene(&stack(share, bricks));
        let run = experiment.attempt();
        assert!(!matches!(run.outcome, Outcome::Stopped(_)), "{}", run.outcome.in_words());
        let sine = run.end.motion(&experiment.model, bricks - 1).placement.gradient[(2, 0)].abs();
        println!("{bricks} bricks at {share} of the overhang: the uppermost leans by a sine of {sine:.5}");
        sine
    };
    assert!(lean(0.9, 5) < 0.03);
    assert!(lean(0.97, 5) > 0.1);
    // √(4 h d/(ν − 2)) is 0.018 of L/2 with h = 15 mm and d = 0.06 mm.
    assert!(lean(0.97, 2) < 0.03);
    assert!(lean(0.99, 2) > 0.1);
}

#[test]
fn a_wedge_gives_way_to_the_block_on_it() {
    let experiment = Experiment::of_gallery("wedge", &[]);
    let run = experiment.run();
    let [block, wedge] = ["block.vx", "wedge.vx"].map(|column| run.column(column));
    let mass = |name: &str| {
        let index = if name == "wedge" { 0 } else { 1 };
        experiment.model.bodies[index].solid.mass.mass
    };
    let (m, n) = (mass("block"), mass("wedge"));
    let (sin, cos) = 30_f64.to_radians().sin_cos();
    let case =
        Case { row: None, name: "gallery: wedge", source: "m g sinθ cosθ/(M + m sin²θ), momentum along the table" };
    let (from, to) = (10, 40);
    let found = (wedge[from] - wedge[to]) / (run.times[to] - run.times[from]);
    // The gap is 3e-3 of the block; the wedge stands on a table that gives by as little.
    case.check("acceleration of the wedge [m/s²]", m * GRAVITY * sin * cos / (n + m * sin * sin), found, 1e-3);
    let sum = largest(block.iter().zip(&wedge).map(|(block, wedge)| m * block + n * wedge));
    case.check("largest momentum along the table [kg m/s]", 0.0, sum, 1e-13);
}

#[test]
fn a_break_is_as_symmetric_as_the_rack() {
    let run = Experiment::of_gallery("billiard", &[]).run();
    let case = Case { row: None, name: "gallery: billiard", source: "u₀ − μ g t while it slides" };
    let sample = 10;
    let slid = 2.0 - 0.2 * GRAVITY * run.times[sample];
    case.check("speed of the cue ball after 0.05 s [m/s]", slid, run.column("cue.vx")[sample], 1e-5);
    // 2 and 3, 4 and 6 are mirror images; 1, 5 and the cue ball stay in the plane.
    let case = case.by("the mirror");
    let pairs = [("ball-2", "ball-3"), ("ball-4", "ball-6")];
    let off = pairs.map(|(one, other)| {
        let apart = last(&run, &format!("{one}.x")) - last(&run, &format!("{other}.x"));
        apart.abs().max((last(&run, &format!("{one}.y")) + last(&run, &format!("{other}.y"))).abs())
    });
    case.check("largest distance of a ball from the image of its partner [m]", 0.0, largest(off), 1e-9);
    let speeds = ["cue", "ball-1", "ball-2", "ball-4", "ball-5"].map(|ball| last(&run, &format!("{ball}.vx")));
    println!("speeds along the line [m/s]: {speeds:.3?}");
    assert!(speeds[3] > 0.3 && speeds[3] > 3.0 * speeds[0].abs(), "{speeds:?}");
    assert!(run.relative_residual() < 1e-7, "{}", run.relative_residual());
}
