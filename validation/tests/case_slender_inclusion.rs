//! A thread in an extensional flow whose two short axes are nearly equal: what tells them apart is linear in δ.
//!
//!   P = diag(λ, λ^−½ (1 + δ), λ^−½/(1 + δ)),   ln(P_yy/P_zz)˙ = c(λ) δ   for δ → 0
//!
//! The stress along the thread is up to 10⁸ of that across, and must not be mixed with it.

use gyration_sim::{Outcome, Reason};
use gyration_validation::{Case, Experiment};

fn thread(stretch: f64, delta: f64, end: f64) -> Experiment {
    let (across, wider) = (stretch.powf(-0.5), 1.0 + delta);
    Experiment::of_scene(&format!(
        r#"
        time = {{ end = {end}, sample = {end} }}
        fluid = {{ viscosity = 1, density = 1000, velocity_gradient = [[1, 0, 0], [0, -0.5, 0], [0, 0, -0.5]] }}
        world = {{ gravity = [0, 0, 0] }}
        [[body]]
        name = "thread"
        shape = {{ sphere = {{ radius = 0.001 }} }}
        density = 1000
        affine = {{ material = {{ neo_hookean = {{ shear = 0.1 }} }} }}
        gradient = [[{stretch:e}, 0, 0], [0, {:e}, 0], [0, 0, {:e}]]
        inclusion = {{ inertia = false }}
        "#,
        across * wider,
        across / wider,
    ))
}

/// ln(P_yy/P_zz)˙ at the start [1/s].
fn parting(stretch: f64, delta: f64) -> f64 {
    let run = thread(stretch, delta, 1e-6).run();
    let (p, rate) = (run.matrices("placement_gradient")[0], run.matrices("gradient_rate")[0]);
    rate[(1, 1)] / p[(1, 1)] - rate[(2, 2)] / p[(2, 2)]
}

#[test]
fn nearly_equal_short_axes_part_at_a_rate_linear_in_their_difference() {
    let cases = [
        ("ellipsoid drawn out tenfold", 10.0),
        ("needle, λ = 1e2", 1e2),
        ("thread, λ = 1e3", 1e3),
        ("thread, λ = 9e3, as slender as is allowed", 9e3),
    ];
    for (name, stretch) in cases {
        // δ² is 1e-6 of it.
        let reference = parting(stretch, 1e-3) / 1e-3;
        let case = Case { row: None, name, source: "linear in δ" };
        let deltas = [
            (1e-5, "ln(P_yy/P_zz)˙ at δ = 1e-5 [1/s]"),
            (1e-6, "ln(P_yy/P_zz)˙ at δ = 1e-6 [1/s]"),
            (1e-8, "ln(P_yy/P_zz)˙ at δ = 1e-8 [1/s]"),
            (1e-10, "ln(P_yy/P_zz)˙ at δ = 1e-10 [1/s]"),
        ];
        for (delta, quantity) in deltas {
            // The rates of the axes, of which it is the difference, are 0.5 1/s and rounded each for itself.
            let tolerance = 1e-3 + 1e-15 / (reference * delta).abs();
            case.check(quantity, reference * delta, parting(stretch, delta), tolerance);
        }
    }
}

#[test]
fn a_body_drawn_out_without_end_stops_and_says_so() {
    let run = thread(1.5, 1e-3, 1e3).attempt();
    let Outcome::Stopped(stop) = &run.outcome else { panic!("{:?}", run.outcome) };
    println!("{}", run.outcome.in_words());
    assert_eq!(stop.reason, Reason::TooSlender, "{stop:?}");
    // With next to no stress of its own it follows the flow, or is drawn out a little faster: 1e6 = λ^1.5 is reached
    // after ln (1e4/1.5) s or somewhat less.
    assert!((7.0..8.8).contains(&stop.time), "{stop:?}");
}
