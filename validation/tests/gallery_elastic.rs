//! The gallery's `elastic-bounce`, `elastic-roll` and `elastic-oscillate` with their variants: rubber on a table.
//!
//!   in flight     a sphere rings with ω₀² = 20(c₁ + c₂)/(ρR²) and decays at μV/(2j) = 5μ/(2ρR²)
//!   rolling       a shape B = I + 2e that stays in space while the rubber turns through it: D = eW − We, W the spin, so that
//!                 viscosity takes V μ|D|² = 4.5 ε² Ω² V μ of ½(1 + ⅖)mv²:  v̇ = −(4.5/1.4) μ ε² v/(ρR²),  e_zz = −ε
//!   at rest       frequencies of the exact Jacobian at the rest state
//!
//! Source: `docs/theory-affine.md`; the rolling resistance is derived here.

use gyration_sim::modes::{modes, rest};
use gyration_validation::{Answer, Experiment, Run};
use std::f64::consts::PI;

const DENSITY: f64 = 1000.0;
const RADIUS: f64 = 0.1;
const SHEAR: f64 = 4000.0;

/// The times at which a column passes through a level, rising.
fn risings(run: &Run, values: &[f64], level: f64) -> Vec<f64> {
    let pairs = values.windows(2).zip(run.times.windows(2));
    pairs
        .filter(|(value, _)| value[0] < level && value[1] >= level)
        .map(|(value, time)| time[0] + (level - value[0]) / (value[1] - value[0]) * (time[1] - time[0]))
        .collect()
}

/// The parts of the ledger that a scene exchanges close to its tolerance, and none of friction's works is positive.
fn ledger_is_sound(run: &Run) {
    assert!(run.relative_residual() < 1e-7, "{:e}", run.relative_residual());
    for work in ["work.viscosity", "work.damping", "work.friction"] {
        let values = run.column(work);
        // Within the tolerance of a step.
        let allowed = 1e-9 * run.energy_in_play;
        assert!(values.windows(2).all(|pair| pair[1] <= pair[0] + allowed), "{work} grows");
    }
}

#[test]
fn ball_rings_in_flight_as_the_closed_form_says() {
    let answer = |quantity, reference, measured, tolerance, source| {
        Answer { row: None, case: "gallery: elastic-bounce", quantity, reference, measured, tolerance, source }.check();
    };
    // Thrown up once it has been squeezed a little, far from the table.
    let thrown = [
        "body.ball.position=[0, 0, 3]",
        "body.ball.gradient_rate=[[0.05, 0, 0], [0, 0.05, 0], [0, 0, -0.1]]",
        "time.end=0.6",
        "time.sample=5e-4",
    ];
    let run = Experiment::of_gallery("elastic-bounce", &thrown).run();
    let stretch: Vec<f64> = run.column("ball.P_zz").iter().map(|p| p - 1.0).collect();
    let crossings = risings(&run, &stretch, 0.0);
    let count = (crossings.len() - 1) as f64;
    let omega = 2.0 * PI * count / (crossings[crossings.len() - 1] - crossings[0]);
    let (own, decay) = (20.0 * SHEAR / (DENSITY * RADIUS * RADIUS), 2.5 * 20.0 / (DENSITY * RADIUS * RADIUS));
    // The amplitude is 1e-3: what it shifts is of its square; samples are joined by lines.
    answer(
        "frequency of the ringing in flight [rad/s]",
        (own - decay * decay).sqrt(),
        omega,
        1e-4,
        "√(20(c₁+c₂)/(ρR²) − δ²)",
    );
    let peak = |from: f64, to: f64| {
        let within = run.times.iter().zip(&stretch).filter(|(time, _)| (from..to).contains(*time));
        within.map(|(_, stretch)| *stretch).fold(0.0, f64::max)
    };
    let period = 2.0 * PI / omega;
    let measured = (peak(0.0, period) / peak(6.0 * period, 7.0 * period)).ln() / (6.0 * period);
    answer("decay of the ringing in flight [1/s]", decay, measured, 1e-2, "5μ/(2ρR²)");
}

#[test]
fn dropped_rubber_loses_height_to_its_own_ringing() {
    for (name, ball) in
        [("elastic-bounce", "ball"), ("elastic-bounce-tilted", "egg"), ("elastic-bounce-spinning", "ball")]
    {
        let run = Experiment::of_gallery(name, &[]).run();
        ledger_is_sound(&run);
        let apexes = run.times_of("apex");
        let height = run.column(&format!("{ball}.z"));
        // It has struck by 0.3 s.
        let after = run.times.partition_point(|time| *time < 0.35);
        let rise = height[after..].iter().copied().fold(0.0, f64::max);
        println!("{name}: back to {rise:.4} m, apexes at {apexes:.3?} s");
        assert!(rise < 0.8 * height[0] && rise > 0.2 * height[0], "{rise}");
        let volume = |row: usize| {
            let p = |entry: &str| run.column(&format!("{ball}.P_{entry}"))[row];
            p("xx") * (p("yy") * p("zz") - p("yz") * p("zy")) - p("xy") * (p("yx") * p("zz") - p("yz") * p("zx"))
                + p("xz") * (p("yx") * p("zy") - p("yy") * p("zx"))
        };
        let worst = (0..run.times.len()).step_by(20).map(|row| (volume(row) - 1.0).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-10, "{name}: det P is off by {worst:e}");
    }
}

#[test]
fn without_any_loss_the_height_still_goes_to_the_ringing_and_no_energy_is_lost() {
    let lossless = [
        "body.ball.affine.viscosity=0",
        "contact.0.damping.beta=0",
        "contact.0.friction.beta=0",
        "contact.0.measure=deformed_area_potential",
        "time.end=0.6",
    ];
    let run = Experiment::of_gallery("elastic-bounce", &lossless).run();
    assert!(run.relative_residual() < 1e-7, "{:e}", run.relative_residual());
    let height = run.column("ball.z");
    let apex = run.times_of("apex")[0];
    let rise = height[run.times.partition_point(|sample| *sample < apex)];
    println!("a lossless ball dropped from 0.5 m comes back to {rise:.4} m");
    assert!(rise < 0.9 * height[0], "{rise}");
}

#[test]
fn friction_turns_spin_into_speed() {
    let run = Experiment::of_gallery("elastic-bounce-spinning", &["time.end=0.45"]).run();
    let (momentum, speed, height) =
        (4.0 / 3.0 * PI * RADIUS.powi(3) * DENSITY, run.column("ball.vx"), run.column("ball.z"));
    // L_y = ε K of the pair: K = P J Ṗᵀ, J = ⅕mR² I.
    let spin = |row: usize| {
        let p = |name: &str| run.column(&format!("ball.{name}"))[row];
        let j = 0.2 * momentum * RADIUS * RADIUS;
        let k = |i: &str, k: &str| {
            ["x", "y", "z"].iter().map(|a| p(&format!("P_{i}{a}")) * p(&format!("Pdot_{k}{a}"))).sum::<f64>()
        };
        j * (k("z", "x") - k("x", "z"))
    };
    let last = run.times.len() - 1;
    let lever = (spin(0) - spin(last)) / (momentum * speed[last]);
    let lowest = height.iter().copied().fold(f64::INFINITY, f64::min);
    println!("spin lost over momentum won: {lever:.4} m; the centre comes down to {lowest:.4} m");
    // Friction acts below the centre by its height at least; the front of the ball, which comes down, is held up more
    // by the damping than the back, and that takes spin as well.
    assert!(lever > lowest, "{lever}");
    assert!(speed[last] > 0.1, "{}", speed[last]);
}

/// The rate v̇/v at which a rolling ball slows down, and that of the closed form for the flattening it has.
fn slowing(viscosity: f64) -> (f64, f64) {
    let experiment =
        Experiment::of_gallery("elastic-roll", &[&format!("body.ball.affine.viscosity={viscosity}"), "time.end=3"]);
    let run = experiment.run();
    ledger_is_sound(&run);
    let (speed, last) = (run.column("ball.vx"), run.times.len() - 1);
    let from = last / 2;
    let measured = (speed[from] / speed[last]).ln() / (run.times[last] - run.times[from]);
    let flattening = (from..=last).map(|row| {
        let p = |a: &str| run.column(&format!("ball.P_z{a}"))[row];
        0.5 * (1.0 - p("x").powi(2) - p("y").powi(2) - p("z").powi(2))
    });
    let square = flattening.map(|strain| strain * strain).sum::<f64>() / (last - from + 1) as f64;
    (measured, 4.5 / 1.4 * viscosity * square / (DENSITY * RADIUS * RADIUS))
}

#[test]
fn viscosity_slows_a_rolling_ball_as_its_flattening_says() {
    let answer = |quantity, reference, measured, tolerance, source| {
        Answer { row: None, case: "gallery: elastic-roll", quantity, reference, measured, tolerance, source }.check();
    };
    let ((nothing, _), (once, predicted), (twice, _)) = (slowing(1e-6), slowing(40.0), slowing(80.0));
    // The theory is linear in a flattening of 4 %, and knows neither the sides of the field nor inertia.
    answer("rate v̇/v by viscosity 40 Pa s [1/s]", predicted, once - nothing, 0.15, "4.5 μ ε²/(1.4 ρR²)");
    answer("twice the viscosity over once", 2.0, (twice - nothing) / (once - nothing), 0.1, "linear in μ");
}

#[test]
fn cube_shakes_on_the_table_with_the_modes_of_its_rest_state() {
    let answer = |quantity, reference, measured, tolerance, source| {
        Answer { row: None, case: "gallery: elastic-oscillate", quantity, reference, measured, tolerance, source }
            .check();
    };
    let experiment = Experiment::of_gallery("elastic-oscillate", &[]);
    let state = rest(&experiment.model, &experiment.start, 0).unwrap_or_else(|error| panic!("{error}"));
    let found = modes(&experiment.model, &experiment.start, 0, &state).unwrap_or_else(|error| panic!("{error}"));
    let run = experiment.run();
    ledger_is_sound(&run);
    let (height, last) = (run.column("cube.z"), run.times.len() - 1);
    answer(
        "height at which it stands [m]",
        state.placement.position.z,
        height[last],
        1e-3,
        "rest state of the Jacobian",
    );
    let settled: Vec<f64> = height.iter().map(|z| z - height[last]).collect();
    let late: Vec<f64> = risings(&run, &settled, 0.0).into_iter().filter(|time| (0.4..1.6).contains(time)).collect();
    let omega = 2.0 * PI * (late.len() - 1) as f64 / (late[late.len() - 1] - late[0]);
    let nearest =
        found.iter().map(|mode| mode.frequency()).min_by(|a, b| (a - omega).abs().total_cmp(&(b - omega).abs()));
    let nearest = nearest.unwrap_or(f64::NAN);
    answer("frequency of its shaking [rad/s]", nearest, omega, 2e-2, "modes about rest");
}
