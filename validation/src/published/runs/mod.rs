//! The runs of the rows, a module a source, and what all of them must have.

mod chung_ooi;
mod impacts;
mod laws;
mod more;
mod rolling;

use super::{Row, Runs, Verdict, rows};
use crate::{Experiment, Run};

/// α of the repulsion where nothing else is said [Pa].
const ALPHA: f64 = 1e6;
/// Of the ball on a plane [kg/m³].
const DENSITY: f64 = 2500.0;
/// Of the ball on a plane, and of those that meet [m].
const RADIUS: f64 = 0.01;
const GRAVITY: f64 = 9.81;

/// Restitution e and the c v of the damping that makes it, v the relative speed: c v(1 + e) = ln((1 + c v)/(1 − c v
/// e)).
const RESTITUTION: [(f64, f64); 5] =
    [(0.9, 0.166481950685), (0.8, 0.373146203365), (0.6, 0.974871710813), (0.4, 2.08249816415), (0.2, 4.91916671579)];

/// The row of this name.
fn row(key: &str) -> &'static Row {
    rows().find(|row| row.key == key).unwrap_or_else(|| panic!("no row {key}"))
}

/// c v of a restitution; 0 of one without loss.
fn damping(restitution: f64) -> f64 {
    let found = RESTITUTION.iter().find(|(e, _)| *e == restitution);
    if restitution == 1.0 { 0.0 } else { found.unwrap_or_else(|| panic!("no damping for {restitution}")).1 }
}

/// A number at d₀, d₀/2 and d₀/4.
fn halved(d0: f64, at: impl Fn(f64) -> f64) -> Runs {
    Runs::Halved([d0, 0.5 * d0, 0.25 * d0].map(at))
}

/// Several numbers of the same runs at d₀, d₀/2 and d₀/4.
fn halved_each<const N: usize>(d0: f64, at: impl Fn(f64) -> [f64; N]) -> [Runs; N] {
    let [whole, half, quarter] = [d0, 0.5 * d0, 0.25 * d0].map(at);
    std::array::from_fn(|k| Runs::Halved([whole[k], half[k], quarter[k]]))
}

/// Laws of exponent 6 with this d₀: repulsion, damping and friction of so many times its strength [s/m], and the bound
/// of the friction.
fn laws(alpha: f64, d0: f64, damping: f64, friction: f64, mu: Option<f64>) -> String {
    let law = |name: &str, key: &str, strength: f64, more: &str| {
        format!("{name} = {{ {key} = {strength:?}, nu = 6, d0 = {d0:?}{more} }}\n")
    };
    let bound = mu.map_or_else(String::new, |mu| format!(", mu = {mu:?}"));
    let damping = if damping > 0.0 { law("damping", "beta", damping * alpha, "") } else { String::new() };
    let friction = if friction > 0.0 { law("friction", "beta", friction * alpha, &bound) } else { String::new() };
    law("repulsion", "alpha", alpha, "") + &damping + &friction
}

/// A scene with these lines at its head, samples and tolerances of these runs.
fn scene(gravity: [f64; 3], end: f64, sample: f64, rest: &str) -> Experiment {
    Experiment::of_scene(&format!(
        "world = {{ gravity = {gravity:?} }}\ntime = {{ end = {end:?}, sample = {sample:?} }}\n\
         solver = {{ rtol = 1e-11, atol = 1e-13 }}\n{rest}"
    ))
}

/// A sphere with a name.
fn sphere(name: &str, radius: f64, density: f64, place: [f64; 3], velocity: [f64; 3], more: &str) -> String {
    format!(
        "[[body]]\nname = \"{name}\"\ngroup = \"ball\"\nshape = {{ sphere = {{ radius = {radius:?} }} }}\n\
         density = {density:?}\nposition = {place:?}\nvelocity = {velocity:?}\n{more}\n"
    )
}

/// A plane through the origin, level, with these laws.
fn floor(laws: &str) -> String {
    format!("[[support]]\nname = \"floor\"\nplane = {{}}\n[[contact]]\nsupport = \"floor\"\n{laws}")
}

/// The last sample of a column.
fn last(run: &Run, column: &str) -> f64 {
    run.column(column).last().copied().unwrap_or(f64::NAN)
}

#[test]
fn what_is_outside_the_model_or_not_run_is_told() {
    rows().filter(|row| matches!(row.expected, Verdict::Outside | Verdict::NotRun)).for_each(Row::tell);
}

#[test]
fn every_row_has_its_run() {
    let sources = [
        include_str!("chung_ooi.rs"),
        include_str!("impacts.rs"),
        include_str!("laws.rs"),
        include_str!("more.rs"),
        include_str!("rolling.rs"),
    ];
    for row in rows().filter(|row| matches!(row.expected, Verdict::Agrees | Verdict::Disagrees)) {
        let named = format!("\"{}\"", row.key);
        assert!(sources.iter().any(|source| source.contains(&named)), "nothing runs {}", row.key);
    }
}
