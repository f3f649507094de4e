//! Periodic orbits: periods, multipliers, a breather.
//!
//!   ẍ + x + x³ = 0 from 1            T = 4 K(m = ¼)/√2
//!   a box about its middle axis      T = 2π/Ω, μ = e^(±σT), σ² = Ω² (I₂ − I₁)(I₃ − I₂)/(I₁ I₃)
//!   ẍ + ω₀² x = F cos ωt             x₀ = F/(ω₀² − ω²), T = 2π/ω, μ = e^(±iω₀T)

use gyration_scene::Scene;
use gyration_sim::orbit::{OrbitChoice, OrbitSurvey};
use gyration_validation::{Case, largest};
use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;
use std::path::Path;

const HEAD: &str = "world = { gravity = [0, 0, 0] }\ntime = { end = 10, sample = 1 }\n";
const POINT: &str = "shape = { points = [{ mass = 1, at = [0, 0, 0] }] }";

fn orbit(text: &str, choice: &OrbitChoice) -> OrbitSurvey {
    let scene = Scene::parse("scene.toml", text, Path::new(""), &[]).unwrap_or_else(|errors| panic!("{errors}"));
    OrbitSurvey::of(&scene, choice, None).unwrap_or_else(|error| panic!("{error}"))
}

fn amplitude(column: &str, value: f64) -> OrbitChoice {
    OrbitChoice::Amplitude(column.to_owned(), value, None)
}

#[test]
fn a_point_in_a_well_has_the_period_of_its_amplitude() {
    let case = Case { row: None, name: "orbit in a well, x + x³", source: "4 K(¼)/√2" };
    let text =
        format!("{HEAD}[[body]]\nname = \"a\"\n{POINT}\nposition = [0.8, 0, 0]\npotential = \"0.5*x^2 + 0.25*x^4\"\n");
    let found = orbit(&text, &amplitude("body.a.x", 1.0));
    case.check("period [s]", 4.768022029, found.period, 1e-9);
    case.check("misfit", 0.0, found.misfit, 1e-9);
    let found = orbit(&text, &OrbitChoice::Energy(0.75, None));
    case.check("period by the energy [s]", 4.768022029, found.period, 1e-9);
}

#[test]
fn a_box_about_its_middle_axis_leaves_it_as_the_linear_theory_says() {
    let case = Case { row: None, name: "orbit of a box about its middle axis", source: "Euler's equations, linear" };
    let (sides, spin): ([f64; 3], f64) = ([0.1, 0.2, 0.3], 3.0);
    let text = format!(
        "{HEAD}[[body]]\nname = \"a\"\nshape = {{ box = {{ size = {sides:?} }} }}\ndensity = 500\nposition = \
         [0, 0, 0]\nangular_velocity = [0, {spin}, 0]\n"
    );
    let found = orbit(&text, &OrbitChoice::Period(TAU / spin));
    let square = sides.map(|side| side * side);
    let [least, middle, most] = [square[0] + square[1], square[0] + square[2], square[1] + square[2]];
    let rate = spin * ((middle - least) * (most - middle) / (least * most)).sqrt();
    let [first, last] = [found.multipliers.first(), found.multipliers.last()].map(|mu| mu.unwrap()[0]);
    case.check("largest multiplier", (rate * TAU / spin).exp(), first, 1e-7);
    case.check("product with the smallest", 1.0, first * last, 1e-7);
    assert!(!found.stable);
}

#[test]
fn a_driven_point_swings_with_its_drive() {
    let case = Case { row: None, name: "orbit of a driven point", source: "closed form" };
    let text = format!(
        "{HEAD}[[body]]\nname = \"a\"\n{POINT}\nposition = [0.1, 0, 0]\npotential = \"0.605*x^2 - 0.3*x*cos(2*t)\"\n"
    );
    let found = orbit(&text, &OrbitChoice::Period(PI));
    case.check("x₀ [m]", 0.3 / (1.21 - 4.0), found.start["a"].position[0], 1e-9);
    let own = found.multipliers.iter().filter(|mu| mu[1].abs() > 0.1);
    let off = own.map(|[re, im]| (re - (1.1 * PI).cos()).abs().max(im.abs() - (1.1 * PI).sin().abs()));
    case.check("multipliers − e^(±iω₀T)", 0.0, largest(off), 1e-9);
    assert!(found.stable);
}

#[test]
fn a_breather_comes_back_to_itself() {
    let case = Case { row: None, name: "breather of seven points", source: "shooting, tolerance 1e-12" };
    let mut text = HEAD.to_owned();
    for n in 0..7 {
        let x = if n == 3 { 1.2 } else { 0.0 };
        let _ = writeln!(
            text,
            "[[body]]\nname = \"b{n}\"\n{POINT}\nposition = [{x:?}, {n}, 0]\npotential = \"0.5*x^2 + 0.25*x^4 + \
             7*(y - {n})^2 + 3*z^2\""
        );
        if n > 0 {
            let _ = writeln!(text, "[[spring]]\nbetween = [\"b{}\", \"b{n}\"]\nstiffness = 0.05", n - 1);
        }
    }
    let found = orbit(&text, &amplitude("body.b3.x", 1.2));
    case.check("misfit", 0.0, found.misfit, 1e-9);
    let at = |n: usize| found.start[&format!("b{n}")].position[0].abs();
    case.check("x of the ends, of the middle one [m]", 0.0, at(0).max(at(6)), 1e-3);
    assert!(at(3) == 1.2 || (at(3) - 1.2).abs() < 1e-9, "{}", at(3));
    // Above the band of small waves, whose frequencies end at √(1 + 4 · 0.05).
    assert!(TAU / found.period > 1.2_f64.sqrt(), "{}", found.period);
    assert!(found.stable, "{:?}", found.multipliers);
}
