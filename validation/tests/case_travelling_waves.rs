//! Waves that run around a ring without a change: fixed points of the flow over a time, less a shift by a cell.
//!
//!   chain   T = q/ω, μ = e^(±i(q′ − ω′T)) of all other waves
//!   Toda    V = (b/α)(e^(−αx) + αx − 1): e^(−αρ_n) = 1 + g (dn²(2K(n/λ − νt)) − E/K), 1/g = 1/sn²(2K/λ) − 1 + E/K,
//!           (2Kν)² = (αB/m) g, T = 1/λν; ρ and x differ by a constant c, Σx = 0, B = b e^(−αc)
//!
//! Source: M. Toda, *Theory of Nonlinear Lattices* (1989), sec. 2.3.

use gyration_scene::Scene;
use gyration_sim::complete;
use gyration_sim::orbit::{OrbitChoice, OrbitSurvey};
use gyration_validation::{Case, largest};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::path::Path;

const MASS: f64 = 0.5;
const STIFFNESS: f64 = 40.0;

/// A ring of masses kept to a line, 0.1 m apart, with bonds, that starts with one wave around it.
fn ring(cells: usize, amplitude: f64, law: &str) -> String {
    format!(
        "world = {{ gravity = [0, 0, 0] }}\ntime = {{ end = 2, sample = 1 }}\nlattice = {{ cell = [[0.1, 0, 0]], \
         repeat = [{cells}, 1, 1], wave = {{ kappa = [{:?}, 0, 0], branch = 0, amplitude = {amplitude:?} }} }}\n[[body]]\n\
         name = \"a\"\nshape = {{ points = [{{ mass = {MASS:?}, at = [0, 0, 0] }}] }}\nkeep = {{ line = [1, 0, 0] }}\n\
         [[bond]]\nbetween = [\"a\", \"a\"]\ncell = [1, 0, 0]\nlaw = \"{law}\"\n",
        1.0 / cells as f64
    )
}

fn orbit(text: &str, choice: &OrbitChoice, by: i32) -> OrbitSurvey {
    let scene = Scene::parse("scene.toml", text, Path::new(""), &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let scene = complete(scene).unwrap_or_else(|error| panic!("{error}"));
    OrbitSurvey::of(&scene, choice, Some([by, 0, 0])).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn a_wave_of_a_chain_moves_on_by_a_cell_in_the_time_of_its_phase() {
    let case =
        Case {
            row: None, name: "travelling wave of a chain, κ ⅛ of 8", source: "T = q/ω, μ = e^(±i(q′ − ω′T))"
        };
    let found = orbit(&ring(8, 1e-3, "20*(l - 0.1)^2"), &OrbitChoice::Nearest, 1);
    let omega = |q: f64| 2.0 * (STIFFNESS / MASS).sqrt() * (0.5 * q).sin().abs();
    let q = TAU / 8.0;
    let period = q / omega(q);
    case.check("period [s]", period, found.period, 1e-9);
    case.check("misfit", 0.0, found.misfit, 1e-9);
    assert_eq!((found.multipliers.len(), found.shift), (16, Some([1, 0, 0])));
    let waves = (1..8).flat_map(|j| {
        let other = TAU * f64::from(j) / 8.0;
        let angle = other - omega(other) * period;
        [[angle.cos(), angle.sin()], [angle.cos(), -angle.sin()]]
    });
    let nearest = |wave: [f64; 2]| {
        let away = |mu: &[f64; 2]| (mu[0] - wave[0]).hypot(mu[1] - wave[1]);
        found.multipliers.iter().map(away).fold(f64::INFINITY, f64::min)
    };
    case.check("multipliers", 0.0, largest(waves.map(nearest)), 1e-9);
    assert!(found.stable, "{:?}", found.multipliers);
}

/// K and E of m, and the scales of the arithmetic-geometric mean.
fn complete_integrals(m: f64) -> ([f64; 2], Vec<[f64; 2]>) {
    let (mut a, mut b, mut c) = (1.0, (1.0 - m).sqrt(), m.sqrt());
    let (mut sum, mut power, mut scales) = (0.5 * c * c, 0.5, vec![[a, c]]);
    while c.abs() > 1e-16 {
        (a, b, c) = (0.5 * (a + b), (a * b).sqrt(), 0.5 * (a - b));
        power *= 2.0;
        sum += power * c * c;
        scales.push([a, c]);
    }
    let k = FRAC_PI_2 / a;
    ([k, k * (1.0 - sum)], scales)
}

/// sn, cn and dn of u and m.
fn elliptic(u: f64, m: f64) -> [f64; 3] {
    let (_, scales) = complete_integrals(m);
    let last = scales.len() - 1;
    let mut angle = 2_f64.powi(last as i32) * scales[last][0] * u;
    for [a, c] in scales[1..].iter().rev() {
        angle = 0.5 * (angle + (c / a * angle.sin()).asin());
    }
    let sn = angle.sin();
    [sn, angle.cos(), (1.0 - m * sn * sn).sqrt()]
}

/// A cnoidal wave of one wavelength around a ring of so many masses: T over a cell, and the energy.
fn cnoidal(cells: usize, m: f64, alpha: f64) -> [f64; 2] {
    let ([k, e], _) = complete_integrals(m);
    let length = cells as f64;
    let [sn, ..] = elliptic(2.0 * k / length, m);
    let g = 1.0 / (1.0 / (sn * sn) - 1.0 + e / k);
    let at = |n: usize| elliptic(2.0 * k * n as f64 / length, m);
    let pressed = |n: usize| 1.0 + g * (at(n)[2].powi(2) - e / k);
    let shifted: Vec<f64> = (0..cells).map(|n| -pressed(n).ln() / alpha).collect();
    let c = -shifted.iter().sum::<f64>() / length;
    // 2Kν, V″ at rest being STIFFNESS = αb.
    let rate = (STIFFNESS * (-alpha * c).exp() / MASS * g).sqrt();
    let stretch: Vec<f64> = shifted.iter().map(|rho| rho + c).collect();
    let mut speeds = vec![0.0; cells];
    for n in 0..cells - 1 {
        let [sn, cn, dn] = at(n);
        speeds[n + 1] = speeds[n] - 2.0 * rate * g * m * sn * cn * dn / (alpha * pressed(n));
    }
    let mean = speeds.iter().sum::<f64>() / length;
    let kinetic: f64 = speeds.iter().map(|speed| 0.5 * MASS * (speed - mean).powi(2)).sum();
    let stored = |x: &f64| STIFFNESS / (alpha * alpha) * ((-alpha * x).exp() + alpha * x - 1.0);
    [2.0 * k / (length * rate), kinetic + stretch.iter().map(stored).sum::<f64>()]
}

#[test]
fn a_cnoidal_wave_runs_around_a_ring_of_toda() {
    let case = Case { row: None, name: "cnoidal wave of a Toda ring of 4", source: "Toda, elliptic functions" };
    let alpha = 30.0;
    let law = format!("{STIFFNESS:?}/{alpha:?}^2*(exp(-{alpha:?}*(l - 0.1)) + {alpha:?}*(l - 0.1) - 1)");
    for (m, by, quantity) in [
        (0.5, 1, "period of a cell, m = 0.5 [s]"),
        (0.9, 1, "period of a cell, m = 0.9 [s]"),
        (0.9, -1, "period of a cell back, m = 0.9 [s]"),
    ] {
        let [period, energy] = cnoidal(4, m, alpha);
        // A wave of the bands with as much energy: N · ½ m ω² A².
        let omega = 2.0 * (STIFFNESS / MASS).sqrt() * (PI / 4.0).sin();
        let amplitude = (energy / (2.0 * MASS)).sqrt() / omega;
        let found = orbit(&ring(4, amplitude, &law), &OrbitChoice::Energy(energy, None), by);
        // A cell back around a ring of four is three on.
        let cells = if by < 0 { 3.0 } else { 1.0 };
        case.check(quantity, cells * period, found.period, 1e-9);
        assert!(found.misfit < 1e-9 && found.stable, "{found:?}");
        if (m, by) == (0.5, 1) {
            let found = orbit(&ring(4, amplitude, &law), &OrbitChoice::Period(period), by);
            case.check("energy by the period, m = 0.5 [J]", energy, found.energy, 1e-7);
        }
    }
}

#[test]
fn a_wave_of_a_weakly_cubic_chain_is_found_however_small_and_bends_as_its_amplitude_squared() {
    let case =
        Case {
            row: None, name: "travelling wave of a cubic chain, κ ⅛ of 8", source: "Lindstedt, V = ½kx² + ⅓αx³"
        };
    // u = A cos θ + A² b sin 2θ, θ = qn − ωt, b the bound below: what the square of the first harmonic drives.
    let (q, alpha) = (TAU / 8.0, 2000.0);
    let s = (0.5 * q).sin();
    let omega = 2.0 * (STIFFNESS / MASS).sqrt() * s;
    let second = 2.0 * (STIFFNESS / MASS).sqrt() * q.sin();
    let bound = 4.0 * alpha / MASS * s * s * q.sin() / (second * second - 4.0 * omega * omega);
    // Of r² the product of both harmonics, 2 r₁ r₂, has a part that swings as the wave does.
    let shift = -4.0 * alpha / MASS * s * s * q.sin() * bound / omega;
    for (amplitude, quantity) in
        [(1e-3, "period, A = 1 mm [s]"), (1e-4, "period, A = 0.1 mm [s]"), (2e-5, "period, A = 20 µm [s]")]
    {
        let found = orbit(&ring(8, amplitude, "20*(l - 0.1)^2 + 2000/3*(l - 0.1)^3"), &OrbitChoice::Nearest, 1);
        let exact = q / (omega + shift * amplitude * amplitude);
        // The square of what the second order adds, some times: the start has the energy of the first harmonic alone.
        let next = 20.0 * (shift * amplitude * amplitude / omega).powi(2);
        case.check(quantity, exact, found.period, next + 1e-10);
        assert!(found.misfit < 1e-9, "{found:?}");
    }
}
