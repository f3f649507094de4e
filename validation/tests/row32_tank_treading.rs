//! Row 32: a neo-Hookean sphere in simple shear and in extension, G = ηγ̇/μ_s; scenes `tank-tread` and `extension`.
//!
//!   small G:  (a − b)/(a + b) = 5G/4,  inclination 45° − ¾G rad;   G = 0.1 from the list
//!   extension: a form at rest has L = 0, T N − 𝓜:T = ηL∞ with T = μ_s P Pᵀ:   ηε̇/μ_s = g(λ), which has a largest value
//!
//! Sources: Gao, Hu, Ponte Castañeda, *J. Fluid Mech.* 687 (2011) 209; the equations once more, integrated apart from
//! the program (`independent`).

use crate::independent::inclusion::{Averages, Particle, directions};
use crate::independent::integrate;
use gyration::tensor::Vec3;
use gyration_validation::{Case, Experiment, largest};

/// The scene `tank-tread` at another G, until it is steady.
fn treading(capillary: f64, end: f64) -> Experiment {
    // ηγ̇ is 50 Pa.
    let shear = format!("body.ball.affine.material.neo_hookean.shear={:e}", 50.0 / capillary);
    Experiment::of_gallery("tank-tread", &[&shear]).until(end)
}

/// Semi-axes over the radius, and the inclination [rad], at the end.
fn steady(capillary: f64) -> (Vec3, f64) {
    let run = treading(capillary, 6.0).run();
    (run.vectors_of(0, "semi_axes")[1] / 5e-3, run.scalars_of(0, "inclination")[1])
}

#[test]
fn ball_treads_in_the_form_of_the_list() {
    let (axes, inclination) = steady(0.1);
    let case = Case { row: Some(32), name: "neo-Hookean sphere in shear, G = 0.1", source: "list of known answers" };
    // The list has seven digits.
    case.check("longest semi-axis over R", 1.131808, axes[0], 1e-6);
    case.check("semi-axis along the vorticity over R", 1.001480, axes[1], 1e-6);
    case.check("shortest semi-axis over R", 0.882236, axes[2], 1e-6);
    case.check("inclination [°]", 40.732552, inclination.to_degrees(), 1e-6);
}

#[test]
fn form_tends_to_that_of_small_strains() {
    let case = Case { row: Some(32), name: "neo-Hookean sphere in shear, G → 0", source: "small strains" };
    // (a − b)/(a + b) is odd in γ̇, the inclination 45° plus an odd function: what is left is of the order G².
    let at = |capillary: f64| {
        let (axes, inclination) = steady(capillary);
        let quarter = std::f64::consts::FRAC_PI_4;
        [(axes[0] - axes[2]) / (axes[0] + axes[2]) / capillary, (quarter - inclination) / capillary]
    };
    let (coarse, fine) = (at(0.02), at(0.01));
    case.check("(a − b)/(a + b) over G", 1.25, (4.0 * fine[0] - coarse[0]) / 3.0, 1e-5);
    case.check("45° less the inclination, over G [rad]", 0.75, (4.0 * fine[1] - coarse[1]) / 3.0, 1e-5);
}

#[test]
fn material_goes_round_in_a_form_that_stands_still() {
    let experiment = treading(0.3, 8.0);
    let run = experiment.sampled(0.01).run();
    let case =
        Case { row: Some(32), name: "scene tank-tread, G = 0.3", source: "the equations once more, by extrapolation" };
    let particle = Particle {
        axes: [1.0; 3],
        shear: 1.0 / 0.3,
        viscosity: 1.0,
        flow: [[0.0, 0.0, 1.0], [0.0; 3], [0.0; 3]],
        sphere: directions(24, 24),
    };
    let start = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    let known = integrate(&particle, &start, &[0.0, 5.0, 10.0, 40.0], 1e-11);
    // The scene's shear is 5 /s.
    let placements = run.matrices("placement_gradient");
    let errors = [100, 200, 800].into_iter().zip(&known[1..]).flat_map(|(sample, known)| {
        let place = placements[sample];
        (0..9).map(move |k| place[(k / 3, k % 3)] - known[k])
    });
    case.check("largest error of P over forty shear units", 0.0, largest(errors.collect::<Vec<_>>()), 1e-6);
    let late = run.vectors_of(0, "semi_axes").split_off(500);
    let change = largest(late.iter().map(|axes| (axes - late[0]).norm() / 5e-3));
    case.by("a form that stands still").check(
        "largest change of the semi-axes over R, from 25 shear units on",
        0.0,
        change,
        1e-7,
    );
}

/// ηε̇/μ_s of the planar extension in which a sphere rests stretched by λ, and the other stretch of its plane.
fn planar(stretch: f64, sphere: &[([f64; 3], f64)]) -> (f64, f64) {
    let pull = |other: f64| {
        let [a, b, c] = [stretch, other, 1.0 / (stretch * other)];
        let stress = [[a * a, 0.0, 0.0], [0.0, b * b, 0.0], [0.0, 0.0, c * c]];
        let acted = Averages::of(&[[a, 0.0, 0.0], [0.0, b, 0.0], [0.0, 0.0, c]], sphere).act(&stress);
        [acted[0][0], acted[2][2]]
    };
    // The pull along the third axis vanishes: by secants.
    let (mut before, mut now) = (stretch.powf(-1.2), stretch.powf(-1.1));
    let mut one = pull(before)[1];
    for _ in 0..30 {
        let other = pull(now)[1];
        let next = now - other * (now - before) / (other - one);
        (before, one, now) = (now, other, next);
        if (now - before).abs() < 1e-12 {
            break;
        }
    }
    (pull(now)[0], now)
}

/// The largest of g: the top of the parabola through three stretches, which errs by the fourth order of their distance.
fn critical() -> f64 {
    let sphere = directions(160, 160);
    let (mut middle, mut step) = (3.0, 0.1);
    let mut top = f64::NAN;
    for _ in 0..4 {
        let [low, at, high] = [middle - step, middle, middle + step].map(|stretch| planar(stretch, &sphere).0);
        let (slope, bend) = ((high - low) / (2.0 * step), (high - 2.0 * at + low) / (step * step));
        top = at - slope * slope / (2.0 * bend);
        middle -= slope / bend;
        step *= 0.5;
    }
    println!("largest at a stretch of {middle}");
    top
}

/// The scene `extension` with its lower body at this ηε̇/μ_s.
fn extending(rate: f64, end: f64) -> Experiment {
    let shear = format!("body.soft.affine.material.neo_hookean.shear={:e}", 10.0 / rate);
    Experiment::of_gallery("extension", &[&shear]).until(end)
}

#[test]
fn extension_below_the_critical_rate_has_the_steady_form_of_the_balance() {
    let case = Case {
        row: Some(32),
        name: "neo-Hookean sphere in planar extension, λ = 2",
        source: "T N − 𝓜:T = ηL∞, solved apart",
    };
    let (rate, other) = planar(2.0, &directions(64, 64));
    let axes = extending(rate, 60.0).run().vectors_of(1, "semi_axes")[1] / 5e-3;
    case.check("longest semi-axis over R", 2.0, axes[0], 1e-6);
    case.check("shortest semi-axis over R", other, axes[2], 1e-6);
}

/// The least rate d(ln a)/dt of the longest axis on the way out.
fn slowest(rate: f64) -> f64 {
    let run = extending(rate, 30.0).sampled(0.02).run();
    let both = run.matrices_of(1, "placement_gradient").into_iter().zip(run.matrices_of(1, "gradient_rate"));
    both.map(|(p, rate)| rate[(0, 0)] / p[(0, 0)]).fold(f64::INFINITY, f64::min)
}

#[test]
fn balls_are_drawn_out_above_the_largest_rate_of_a_steady_form() {
    let source = "largest ηε̇/μ_s of a steady form";
    let case = Case { row: Some(32), name: "neo-Hookean sphere in planar extension", source };
    let known = critical();
    let longest = |rate: f64| extending(rate, 40.0).run().vectors_of(1, "semi_axes")[1][0] / 5e-3;
    let (below, above) = (longest(known * 0.99), longest(known * 1.01));
    assert!(below < 3.0 && above > 1e2, "{below} {above}");
    // Near λ = 3 a body above the critical rate lingers: the slower the nearer. The rate at which it does not move at
    // all, by a parabola through three of them.
    let rates = [1.02, 1.01, 1.005].map(|part| part * known);
    let slow = rates.map(slowest);
    let weight = |k: usize| (0..3).filter(|j| *j != k).map(|j| slow[j] / (slow[j] - slow[k])).product::<f64>();
    let found = (0..3).map(|k| rates[k] * weight(k)).sum::<f64>();
    case.check("critical ηε̇/μ_s, from how slowly balls pass it", known, found, 1e-5);
}
