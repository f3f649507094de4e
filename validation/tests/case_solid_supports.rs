//! Bodies at supports with a shape, which move as prescribed.
//!
//! A support is what a body of infinite mass is. One that moves with velocity u turns v into 2u − v without loss, and
//! has then given 2mu(u − v). A ball that slides down a fixed ball from rest at θ₀ presses with mg (3 cosθ − 2 cosθ₀),
//! and leaves it where that ends. One that rests on a support that moves by A sin Ωt follows it with A/(1 − Ω²/ω²), ω²
//! = (ν − 1) g/gap. A ball that rolls on a turntable goes round at 2/7 of its rate, whatever its circle.

use gyration_validation::{Case, Experiment, Run, largest};
use std::f64::consts::PI;

const HEAD: &str = "solver = { rtol = 1e-11, atol = 1e-13 }\n";

/// A scene with these laws between the support `s` and all bodies.
fn at_support(head: &str, laws: &str, rest: &str) -> Experiment {
    Experiment::of_scene(&format!("{head}[[contact]]\nsupport = \"s\"\n{laws}\n{rest}"))
}

fn times(end: f64, sample: f64) -> String {
    format!("time = {{ end = {end:?}, sample = {sample:?} }}\n")
}

fn last(run: &Run, column: &str) -> f64 {
    *run.column(column).last().unwrap()
}

#[test]
fn a_support_is_what_a_body_of_infinite_mass_is() {
    let head = format!("world = {{ gravity = [0, 0, 0] }}\n{HEAD}{}", times(0.8, 0.8));
    let laws = "repulsion = { alpha = 100, nu = 6, d0 = 0.01 }\ndamping = { beta = 20, nu = 6, d0 = 0.01 }\n\
                friction = { beta = 50, nu = 4, d0 = 0.01 }";
    let block = "[[body]]\nname = \"a\"\nshape = { box = { size = [0.2, 0.1, 0.3] } }\nmass = 2\n\
                 position = [0.05, 0.02, 0.5]\nvelocity = [0.2, 0.1, -1]\nangular_velocity = [3, -1, 0.5]\n";
    let (shape, place) = ("shape = { box = { size = [0.5, 0.4, 0.3] } }", "position = [0, 0, 0]");
    let turned = "orientation = { axis_angle = { axis = [1, 2, 0.5], angle = 0.3 } }";
    let support =
        format!("[[support]]\nname = \"s\"\n{shape}\n{place}\n{turned}\nmotion = {{ velocity = [0.1, 0, 0.2] }}\n");
    let heavy = format!("[[body]]\nname = \"s\"\n{shape}\n{place}\n{turned}\nmass = 1e14\nvelocity = [0.1, 0, 0.2]\n");
    let at = at_support(&head, laws, &format!("{support}{block}")).run();
    let between = format!("{head}[[contact]]\nbetween = [\"s\", \"a\"]\n{laws}\n{block}{heavy}");
    let between = Experiment::of_scene(&between).run();
    let case =
        Case { row: None, name: "a tumbling box at a support that moves", source: "the same at a body of 1e14 kg" };
    for (quantity, column) in [
        ("v_x after the impact [m/s]", "a.vx"),
        ("v_y after the impact [m/s]", "a.vy"),
        ("v_z after the impact [m/s]", "a.vz"),
        ("Ṗ_xy after the impact [1/s]", "a.Pdot_xy"),
        ("Ṗ_yz after the impact [1/s]", "a.Pdot_yz"),
        ("Ṗ_zx after the impact [1/s]", "a.Pdot_zx"),
    ] {
        case.check(quantity, last(&between, column), last(&at, column), 1e-8);
    }
    assert!(at.relative_residual() < 1e-9, "{}", at.relative_residual());
}

#[test]
fn a_support_that_moves_throws_a_ball_back() {
    let (own, carried, mass) = (-1.5, 0.4, 2.0);
    let head = format!("world = {{ gravity = [0, 0, 0] }}\n{HEAD}{}", times(1.5, 1.5));
    let support = format!(
        "[[support]]\nname = \"s\"\nshape = {{ sphere = {{ radius = 0.3 }} }}\n\
         motion = {{ velocity = [0, 0, {carried:?}] }}\n"
    );
    let ball = format!(
        "[[body]]\nname = \"a\"\nshape = {{ sphere = {{ radius = 0.1 }} }}\nmass = {mass:?}\nposition = [0, 0, 1]\n\
         velocity = [0, 0, {own:?}]\n"
    );
    let laws = "repulsion = { alpha = 1e4, nu = 12, d0 = 1e-3 }";
    let run = at_support(&head, laws, &(support + &ball)).run();
    let case = Case { row: None, name: "a ball thrown back by a ball that moves", source: "2u − v" };
    case.check("velocity [m/s]", 2.0 * carried - own, last(&run, "a.vz"), 1e-9);
    let work = 2.0 * mass * carried * (carried - own);
    case.by("2mu(u − v)").check("work of the support [J]", work, last(&run, "work.support"), 1e-9);
}

#[test]
fn a_ball_slides_down_a_fixed_ball_until_it_leaves() {
    let (large, small, start, gravity) = (1.0, 0.1, 0.3_f64, 9.81);
    // A power law lets go slowly: the place where it does tends to the limit with the gap.
    for (name, gap, [tolerance, slow]) in [
        ("a ball that slides down a fixed ball, gap/R = 1e-4", 1e-4, [1e-3, 5e-2]),
        ("a ball that slides down a fixed ball, gap/R = 1e-5", 1e-5, [1e-4, 2e-2]),
    ] {
        // F = 2πα Rr/(R+r) d₀^ν g^(1−ν)/(ν−1): at d₀ the weight along the normal.
        let alpha = 5.0 * gravity * start.cos() / (2.0 * PI * large * small / (large + small) * gap);
        let distance = large + small + gap;
        let head = format!("world = {{ gravity = [0, 0, -{gravity}] }}\n{HEAD}{}", times(1.2, 0.01));
        let laws = format!("repulsion = {{ alpha = {alpha:?}, nu = 6, d0 = {gap:?} }}");
        let bodies = format!(
            "[[support]]\nname = \"s\"\nshape = {{ sphere = {{ radius = {large:?} }} }}\n[[body]]\nname = \"a\"\n\
             shape = {{ sphere = {{ radius = {small:?} }} }}\nmass = 1\nposition = [{:?}, 0, {:?}]\n",
            distance * start.sin(),
            distance * start.cos()
        );
        let experiment = at_support(&head, &laws, &bodies);
        let run = experiment.run();
        let (x, z) = (run.column("a.x"), run.column("a.z"));
        let forces = (run.column("a.fx"), run.column("a.fz"));
        let cosines = x.iter().zip(&z).map(|(x, z)| z / x.hypot(*z));
        let off = cosines.enumerate().filter(|(_, cosine)| *cosine > 0.75).map(|(k, cosine)| {
            let pressed = gravity * (3.0 * cosine - 2.0 * start.cos());
            (forces.0[k].hypot(forces.1[k]) - pressed).abs() / gravity
        });
        let case = Case { row: None, name, source: "mg (3 cosθ − 2 cosθ₀)" };
        case.check("largest error of its force over its weight", 0.0, largest(off), tolerance);
        let left = run.times_of("lift_off")[0];
        let place = experiment.motion_at(left).placement.position;
        // The force is a hundredth of the weight there.
        let expected = (2.0 * start.cos() + 0.01) / 3.0;
        case.check("cosθ where it leaves", expected, place.z / place.norm(), slow);
    }
}

#[test]
fn a_ball_follows_a_support_that_oscillates() {
    let (radius, other, gap, gravity, amplitude) = (0.1, 0.3, 1e-3, 9.81, 1e-7);
    let alpha = 5.0 * gravity / (2.0 * PI * radius * other / (radius + other) * gap);
    let own: f64 = (5.0 * gravity / gap).sqrt();
    let drive = 0.5 * own;
    let factor = amplitude / (1.0 - 0.25);
    let end = 2.0 * PI / drive;
    let head = format!("world = {{ gravity = [0, 0, -{gravity}] }}\n{HEAD}{}", times(end, end / 16.0));
    let laws = format!("repulsion = {{ alpha = {alpha:?}, nu = 6, d0 = {gap:?} }}");
    let bodies = format!(
        "[[support]]\nname = \"s\"\nshape = {{ sphere = {{ radius = {other:?} }} }}\n\
         motion = {{ oscillate = {{ direction = [0, 0, 1], amplitude = {amplitude:?}, frequency = {:?} }} }}\n\
         [[body]]\nname = \"a\"\nshape = {{ sphere = {{ radius = {radius:?} }} }}\nmass = 1\n\
         position = [0, 0, {:?}]\nvelocity = [0, 0, {:?}]\n",
        drive / (2.0 * PI),
        radius + other + gap,
        factor * drive
    );
    let run = at_support(&head, &laws, &bodies).run();
    let rest = radius + other + gap;
    let off = run.times.iter().zip(run.column("a.z")).map(|(t, z)| (z - rest) / factor - (drive * t).sin());
    let case = Case { row: None, name: "a ball on a ball that oscillates", source: "A/(1 − Ω²/ω²) sin Ωt" };
    // A/gap, and gap/R of Derjaguin's stiffness.
    case.check("largest error of its displacement, relative", 0.0, largest(off.map(f64::abs)), 1e-2);
}

#[test]
fn a_ball_rolls_on_a_turntable_at_two_sevenths_of_its_rate() {
    let (radius, place, rate, gap, gravity) = (0.05, 0.3, 3.5, 1e-5, 9.81);
    let round = 2.0 / 7.0 * rate;
    let end = 0.5 * PI / round;
    let head = format!(
        "world = {{ gravity = [0, 0, -{gravity}] }}\nsolver = {{ rtol = 1e-9, atol = 1e-11 }}\n{}",
        times(end, end)
    );
    let alpha = 5.0 * gravity / (2.0 * PI * radius * gap);
    let laws = format!(
        "repulsion = {{ alpha = {alpha:?}, nu = 6, d0 = {gap:?} }}\n\
         damping = {{ beta = {:?}, nu = 6, d0 = {gap:?} }}\nfriction = {{ beta = {:?}, nu = 6, d0 = {gap:?} }}",
        0.5 * alpha,
        1e3 * alpha
    );
    let bodies = format!(
        "[[support]]\nname = \"s\"\nshape = {{ cylinder = {{ radius = 1, height = 0.1 }} }}\nposition = [0, 0, -0.05]\n\
         motion = {{ rotate = {{ axis = [0, 0, 1], rate = {rate:?} }} }}\n[[body]]\nname = \"a\"\n\
         shape = {{ sphere = {{ radius = {radius:?} }} }}\nmass = 1\nposition = [{place:?}, 0, {:?}]\n\
         velocity = [0, {:?}, 0]\nangular_velocity = [{:?}, 0, {rate:?}]\n",
        radius + gap,
        round * place,
        (rate - round) * place / radius
    );
    let run = at_support(&head, &laws, &bodies).run();
    let (x, y) = (last(&run, "a.x"), last(&run, "a.y"));
    let case = Case { row: None, name: "a ball on a turntable", source: "2/7 Ω, up to creep" };
    case.check("angle after a quarter [rad]", 0.5 * PI, y.atan2(x), 2e-3);
    case.check("radius of its circle [m]", place, x.hypot(y), 1e-3);
}
