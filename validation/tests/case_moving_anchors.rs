//! Springs whose anchors move as prescribed.
//!
//!   m ü = k(a − u) + c(ȧ − u̇),   H = (k + icΩ)/(k − mΩ² + icΩ)
//!
//! Under a = A sin Ωt the body goes, steady, as A H exp(iΩt), shifted by a quarter; of a = vt, from rest, as vt − (v/ω)
//! sin ωt; of an anchor that goes round at w on a radius ρ on a circle of kρ/(k − mw²). Who moves the anchor does ∫F·ȧ
//! dt.

use gyration_validation::{Case, Experiment, Run, largest};
use std::f64::consts::TAU;

const HEAD: &str = "world = { gravity = [0, 0, 0] }\nsolver = { rtol = 1e-11, atol = 1e-13 }\n";

fn last(run: &Run, column: &str) -> f64 {
    *run.column(column).last().unwrap()
}

/// A ball of mass m on a spring whose anchor moves so, at this place and velocity.
fn led(end: f64, mass: f64, spring: &str, motion: &str, start: [[f64; 3]; 2], kind: &str) -> Run {
    Experiment::of_scene(&format!(
        "{HEAD}time = {{ end = {end:?}, sample = {:?} }}\n[[body]]\nname = \"a\"\n\
         shape = {{ sphere = {{ radius = 0.1 }} }}\nmass = {mass:?}\nposition = {:?}\nvelocity = {:?}\n{kind}\n\
         spring = [{{ {spring}, anchor_motion = {motion} }}]\n",
        end / 32.0,
        start[0],
        start[1]
    ))
    .run()
}

#[test]
fn a_body_on_a_spring_is_shaken_by_its_anchor() {
    let (mass, k, c, amplitude, omega) = (2.0, 50.0_f64, 3.0_f64, 0.02_f64, 4.0_f64);
    // H = (k + icΩ)/(k − mΩ² + icΩ) as modulus and phase.
    let (above, below) = ([k, c * omega], [k - mass * omega * omega, c * omega]);
    let modulus = above[0].hypot(above[1]) / below[0].hypot(below[1]);
    let phase = above[1].atan2(above[0]) - below[1].atan2(below[0]);
    let end = TAU / omega;
    let spring = format!("anchor = [0, 0, 1], stiffness = {k:?}, damping = {c:?}, rest_length = 1");
    let motion = format!(
        "{{ oscillate = {{ direction = [0, 0, 1], amplitude = {amplitude:?}, frequency = {:?} }} }}",
        omega / TAU
    );
    let place = amplitude * modulus;
    let start = [[0.0, 0.0, place * phase.sin()], [0.0, 0.0, place * omega * phase.cos()]];
    let soft = "affine = { material = { neo_hookean_log = { mu = 1e4, lambda = 2e4 } } }";
    for (name, kind) in [("a rigid ball shaken by an anchor", ""), ("a soft ball shaken by an anchor", soft)] {
        let run = led(end, mass, &spring, &motion, start, kind);
        let off = run.times.iter().zip(run.column("a.z")).map(|(t, z)| z / place - (omega * t + phase).sin());
        let case = Case { row: None, name, source: "the real part of A H exp(iΩt), shifted by a quarter" };
        case.check("largest error of its displacement, relative", 0.0, largest(off.map(f64::abs)), 1e-9);
        // u̇ − ȧ swings with Ω A |H − 1|, over one period.
        let apart = amplitude * (modulus * phase.cos() - 1.0).hypot(modulus * phase.sin());
        let taken = 0.5 * c * (omega * apart).powi(2) * end;
        let case = case.by("½c (ΩA)² (H − 1)(H* − 1) T");
        case.check("work of the anchor over a period [J]", taken, last(&run, "work.support"), 1e-9);
        case.check("work of the dashpot over a period [J]", -taken, last(&run, "work.load"), 1e-9);
        assert!(run.relative_residual() < 1e-9, "{}", run.relative_residual());
    }
}

#[test]
fn a_body_is_towed_by_its_anchor() {
    let (mass, k, speed, end) = (0.5, 20.0, 0.7, 3.0);
    let omega = f64::sqrt(k / mass);
    let motion = format!("[{{ velocity = [{speed:?}, 0, 0] }}]");
    let spring = format!("anchor = [0, 0, 0], stiffness = {k:?}");
    let run = led(end, mass, &spring, &motion, [[0.0; 3]; 2], "");
    let towed = |t: f64| speed * t - speed / omega * (omega * t).sin();
    let off = run.times.iter().zip(run.column("a.x")).map(|(t, x)| (x - towed(*t)).abs());
    let case = Case { row: None, name: "a ball towed by an anchor", source: "u = vt − (v/ω) sin ωt" };
    case.check("largest error of its place [m]", 0.0, largest(off), 1e-9);
    // F = m ü = m v ω sin ωt.
    let work = mass * speed * speed * (1.0 - (omega * end).cos());
    case.by("mv² (1 − cos ωt)").check("work of the anchor [J]", work, last(&run, "work.support"), 1e-9);
}

#[test]
fn a_body_goes_round_with_its_anchor() {
    let (mass, k, radius, rate, end) = (1.5, 30.0, 0.4, 2.0, 5.0);
    let circle = radius * k / (k - mass * rate * rate);
    let motion = format!("{{ rotate = {{ axis = [0, 0, 1], point = [1, 0, 0], rate = {rate:?} }} }}");
    let spring = format!("anchor = [{:?}, 0, 0], stiffness = {k:?}", 1.0 + radius);
    let run = led(end, mass, &spring, &motion, [[1.0 + circle, 0.0, 0.0], [0.0, circle * rate, 0.0]], "");
    let (x, y) = (run.column("a.x"), run.column("a.y"));
    let off = run.times.iter().zip(x.iter().zip(&y)).map(|(t, (x, y))| {
        let (sine, cosine) = (rate * t).sin_cos();
        (x - 1.0 - circle * cosine).hypot(y - circle * sine)
    });
    let case =
        Case { row: None, name: "a ball that goes round with an anchor", source: "a circle of kρ/(k − mw²)" };
    case.check("largest error of its place [m]", 0.0, largest(off), 1e-9);
    case.check("work of the anchor [J]", 0.0, last(&run, "work.support"), 1e-9);
}
