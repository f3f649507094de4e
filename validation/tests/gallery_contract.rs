//! The gallery of bodies that drive themselves: `contract-1` to `-3`, `hop`, `crawl`, `scallop`, `roll-over`,
//! `climber`, `breathe`.
//!
//!   crawling   friction and repulsion of one exponent: ẋ = (h/2)(Ṗ_xz − P_xz Ṗ_xx/P_xx), Δx = −(h/2) ∮ P_xz d(ln P_xx)
//!   rolling    a shape that stays in space while the ball turns through it at Ω/2: v = (Ω/2) R λ, λ its horizontal stretch
//!   breathing  (j/V) g g̈ + μ_γ ġ/g = Q(t), without elastic energy
//!
//! Source: derived in `docs/theory-contractile.md`.

use crate::independent::{Equations, integrate};
use gyration_validation::{Case, Experiment, Run, largest};
use std::f64::consts::{FRAC_PI_2, TAU};

fn case(name: &'static str, source: &'static str) -> Case {
    Case { row: None, name, source }
}

/// The ledger closes, and viscosity and contraction only take.
fn ledger_is_sound(run: &Run) {
    assert!(run.relative_residual() < 1e-7, "{:e}", run.relative_residual());
    let prescribed = !run.has("work.contraction");
    for work in ["work.viscosity", "work.contraction"].into_iter().take(if prescribed { 1 } else { 2 }) {
        let allowed = 1e-9 * run.energy_in_play;
        assert!(run.column(work).windows(2).all(|pair| pair[1] <= pair[0] + allowed), "{work} grows");
    }
}

fn extremes(values: &[f64]) -> (f64, f64) {
    (values.iter().copied().fold(f64::INFINITY, f64::min), values.iter().copied().fold(f64::NEG_INFINITY, f64::max))
}

#[test]
fn three_amplitudes_stay_nearly_leave_and_leave() {
    let least = |name| {
        let run = Experiment::of_gallery(name, &[]).run();
        ledger_is_sound(&run);
        // The block weighs 25.1 N; its first stroke starts from rest.
        let (load, _) = extremes(&run.column("block.fz")[20..]);
        let (_, gap) = extremes(&run.column("block.gap"));
        (load / 25.1136, gap, run.times_of("lift_off").len())
    };
    let (gentle, threshold, strong) = (least("contract-1"), least("contract-2"), least("contract-3"));
    println!("least load of the weight, largest gap [m], lift-offs: {gentle:?} {threshold:?} {strong:?}");
    // A tenth of the weight parts what presses on the table all the time from what nearly leaves it. The field carries
    // the weight at 5.6 mm; a quarter of the height is off the table by any standard, and the block strokes 7.5 times.
    const TENTH: f64 = 0.1;
    assert!(gentle.0 > TENTH && gentle.1 < 1.5 * 0.0056 && gentle.2 == 0, "{gentle:?}");
    assert!(threshold.0 < TENTH && threshold.1 < 0.025, "{threshold:?}");
    assert!(strong.0 < 1e-2 * TENTH && strong.1 > 0.025 && strong.2 >= 5, "{strong:?}");
}

#[test]
fn block_that_feels_the_ground_hops_on() {
    let run = Experiment::of_gallery("hop", &[]).run();
    ledger_is_sound(&run);
    let hops = run.times_of("lift_off");
    let gaps = run.column("block.gap");
    let highest = |from: f64, to: f64| {
        let within = run.times.iter().zip(&gaps).filter(|(time, _)| (from..to).contains(*time));
        within.map(|(_, gap)| *gap).fold(0.0, f64::max)
    };
    let heights: Vec<f64> = hops.windows(2).map(|pair| highest(pair[0], pair[1])).collect();
    println!("hops at {hops:?}, as high as {heights:?}");
    assert!(heights.len() >= 5 && heights.iter().all(|height| *height > 0.015), "{heights:?}");
    // Each hop of 4 cm of 2.56 kg takes 1 J.
    let drive = run.column("work.drive");
    assert!(drive[drive.len() - 1] > 1.0, "{}", drive[drive.len() - 1]);
    // Without the ground it rests in its shape.
    let apart = ["support.table.plane.origin=[0, 0, -1000]", "world.gravity=[0, 0, 0]"];
    let (least, most) = extremes(&Experiment::of_gallery("hop", &apart).run().column("block.P_zz"));
    assert!((0.95..1.05).contains(&least) && (0.95..1.05).contains(&most), "{least} {most}");
}

/// −(h/2) ∮ P_xz d(ln P_xx) of the last cycle, by the trapezoid rule, which is exact to rounding for smooth periodic
/// strokes.
fn enclosed(run: &Run, samples: usize) -> f64 {
    const HEIGHT: f64 = 0.1;
    let (shear, stretch) = (run.column("block.P_xz"), run.column("block.P_xx"));
    let last = shear.len() - 1;
    let term = |k: usize| 0.5 * (shear[k] + shear[k + 1]) * (stretch[k + 1] / stretch[k]).ln();
    -0.5 * HEIGHT * (last - samples..last).map(term).sum::<f64>()
}

fn last_cycle(run: &Run, samples: usize) -> f64 {
    let x = run.column("block.x");
    x[x.len() - 1] - x[x.len() - 1 - samples]
}

#[test]
fn crawler_travels_by_the_area_of_its_stroke() {
    let run = Experiment::of_gallery("crawl", &[]).run();
    ledger_is_sound(&run);
    let travelled = last_cycle(&run, 100);
    assert!(travelled > 0.01, "{travelled}");
    let shear = "body.block.contractile.prescribed.sum.2.sine.amplitude=[[0, 0, -0.3], [0, 0, 0], [0, 0, 0]]";
    let mirrored = Experiment::of_gallery("crawl", &[shear]).run();
    let mirror = case("gallery: crawl", "the mirror");
    mirror.check("travel of the mirrored stroke in a cycle [m]", -travelled, last_cycle(&mirrored, 100), 1e-9);
    // The area tells the travel as far as inertia is small: an eighth of the frequency has a sixty-fourth of it.
    let slow = ["1", "2"].map(|part| format!("body.block.contractile.prescribed.sum.{part}.sine.frequency=0.125"));
    let times = ["time.end=24", "time.sample=0.08"];
    let run = Experiment::of_gallery("crawl", &[&slow[0], &slow[1], times[0], times[1]]).run();
    let closed = enclosed(&run, 100);
    let area = case("gallery: crawl", "−(h/2) ∮ P_xz d(ln P_xx)");
    area.check("travel in a slow cycle [m]", closed, last_cycle(&run, 100), 0.03);
}

#[test]
fn reciprocal_stroke_gets_nowhere() {
    let run = Experiment::of_gallery("scallop", &["time.end=20"]).run();
    ledger_is_sound(&run);
    let (least, most) = extremes(&run.column("block.x"));
    assert!(most - least > 0.005, "it is to move to and fro: {least} {most}");
    let net = last_cycle(&run, 100) / 0.2;
    case("gallery: scallop", "scallop theorem").check(
        "net travel of a cycle, of the length of the body",
        0.0,
        net,
        1e-6,
    );
}

#[test]
fn ball_rolls_under_its_own_wave() {
    let run = Experiment::of_gallery("roll-over", &["time.end=6"]).run();
    ledger_is_sound(&run);
    let x = run.column("ball.x");
    let last = x.len() - 1;
    let speed = x[last] - x[last - 100];
    // P P^T stays in space; its horizontal extent is R √(P Pᵀ)_xx.
    let (p_xx, p_xz) = (run.column("ball.P_xx")[last], run.column("ball.P_xz")[last]);
    let stretch = p_xx.hypot(p_xz);
    // A contact of finite width slips a little, and the axis is not quite level.
    case("gallery: roll-over", "v = (Ω/2) R λ").check("speed [m/s]", 0.5 * TAU * 0.1 * stretch, speed, 0.02);
}

#[test]
fn ball_climbs_a_step_and_comes_down_again() {
    let experiment = Experiment::of_gallery("climber", &[]);
    let run = experiment.run();
    ledger_is_sound(&run);
    let flat = Experiment::of_gallery("roll-over", &["time.end=5"]).run();
    // Half a second is one turn of the wave.
    let height = |run: &Run, end: usize| run.column("ball.z")[end - 50..end].iter().sum::<f64>() / 50.0;
    let gained = |end: usize| height(&run, end) - height(&flat, end);
    let climbing = case("gallery: climber", "the height of the step; its speed there is not quite that on the table");
    climbing.check("height gained on the step [m]", 0.01, gained(400), 0.1);
    assert!(gained(500).abs() < 5e-4 && run.column("ball.x")[500] > 1.4, "it has come down behind the step");
    let work = |run: &Run| run.column("work.drive")[500];
    assert!(work(&run) > 4.0 * work(&flat), "{} and {} J", work(&run), work(&flat));
    let [height, centre] = ["support.step.shape.box.size.2=0.02", "support.step.position.2=0.01"];
    let higher = Experiment::of_gallery("climber", &[height, centre, "time.end=3"]).run();
    assert!(higher.column("ball.x").iter().all(|x| *x < 0.35), "a step of 2 cm is too high");
}

/// (g, ġ, t) of the gallery's ball: j/V = ρR²/5.
struct Breath;

impl Equations<3> for Breath {
    fn rates(&self, y: &[f64; 3]) -> Option<[f64; 3]> {
        let [g, rate, time] = *y;
        let drive = 300.0 * (TAU * 1.5 * time + FRAC_PI_2).sin();
        (g > 0.0).then(|| [rate, (drive - 50.0 * rate / g) / (2.0 * g), 1.0])
    }

    fn scale(&self, _: usize) -> f64 {
        1.0
    }
}

#[test]
fn ball_breathes_as_its_scalar_equation_says() {
    let run = Experiment::of_gallery("breathe", &[]).run();
    ledger_is_sound(&run);
    let known = integrate(&Breath, &[1.0, 0.0, 0.0], &run.times, 1e-12);
    let apart = largest(run.column("ball.P_zz").iter().zip(&known).map(|(p, known)| p - known[0]));
    let (least, most) = extremes(&run.column("ball.P_zz"));
    println!("breathes from {least:.3} to {most:.3}");
    assert!(most / least > 1.3, "{least} {most}");
    let breathing = case("gallery: breathe", "(j/V) g g̈ + μ_γ ġ/g = Q(t)");
    breathing.check("largest error of the stretch", 0.0, apart, 1e-6);
    let stored = largest(run.column("energy.elastic")) / run.energy_in_play;
    breathing.by("F = I").check("largest elastic energy, of that in play", 0.0, stored, 1e-9);
}
