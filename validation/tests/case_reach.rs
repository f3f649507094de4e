//! Two equal balls that hit each other head-on, with the reach that the program finds: they turn where U(1 − U_c/U)⁵ is
//! their energy, U_c = U(25 g₀), g₀ the gap at which U is.

use gyration_validation::{Case, Experiment};
use std::f64::consts::PI;

const RADIUS: f64 = 0.05;
const ALPHA: f64 = 1e3;
const UNIT: f64 = 1e-3;
const NU: f64 = 6.0;

/// U of equal balls at a gap [J]: F = πRα d₀^ν [g^(1−ν) − (g+4R)^(1−ν)]/(ν−1).
fn energy(gap: f64) -> f64 {
    let power = |gap: f64| UNIT * (gap / UNIT).powf(2.0 - NU) / (NU - 2.0);
    PI * RADIUS * ALPHA * UNIT * (power(gap) - power(gap + 4.0 * RADIUS)) / (NU - 1.0)
}

/// The gap at which a falling function is zero, by halving [m].
fn root(function: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (1e-7, 1e-1);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if function(middle) > 0.0 { low = middle } else { high = middle }
    }
    low
}

#[test]
fn balls_turn_where_the_reach_that_is_found_says() {
    let turning = |reach: &str| {
        let ball = |name: &str, x: f64, speed: f64| {
            format!(
                "[[body]]\nname = \"{name}\"\nshape = {{ sphere = {{ radius = {RADIUS} }} }}\nmass = 1\n\
                 position = [{x}, 0, 0]\nvelocity = [{speed}, 0, 0]\n"
            )
        };
        let experiment = Experiment::of_scene(&format!(
            "world = {{ gravity = [0, 0, 0] }}\ntime = {{ end = 0.2, sample = 0.2 }}\nsolver = {{ rtol = 1e-12 }}\n\
             [[contact]]\nbetween = [\"a\", \"b\"]\n{reach}\n\
             repulsion = {{ alpha = {ALPHA}, nu = {NU}, d0 = {UNIT} }}\n{}{}",
            ball("a", -0.1, 0.5),
            ball("b", 0.1, -0.5)
        ));
        let closest = experiment.run().times_of("closest_approach")[0];
        -2.0 * (experiment.motion_at(closest).placement.position.x + RADIUS)
    };
    let kinetic = 0.25;
    let gap = root(|gap| energy(gap) - kinetic);
    let begins = energy(25.0 * gap);
    let switched = |gap: f64| energy(gap) * (1.0 - begins / energy(gap)).powi(5);
    let nearer = root(|gap| switched(gap) - kinetic);
    let case = Case { row: None, name: "two balls with a reach that is found", source: "U(1 − U_c/U)⁵ = ½μv²" };
    // They come from 100 mm, where U is 1e-15 of the energy; a gap has the digits of a place, 1e-17 m.
    case.check("closest gap [m]", nearer, turning("reach = \"auto\""), 1e-10);
    case.check("closest gap without a reach [m]", gap, turning(""), 1e-10);
    let change = turning("reach = \"auto\"") / turning("") - 1.0;
    case.check("change of the closest gap", nearer / gap - 1.0, change, 1e-4);
}
