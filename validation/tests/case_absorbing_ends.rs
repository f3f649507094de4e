//! Free ends that swallow waves: what comes back, cell by cell at a frequency, and of a packet in time.

use gyration::balance::energies;
use gyration::dynamics::{Workspace, rates};
use gyration::state::State;
use gyration_validation::{Case, Experiment};
use nalgebra::Complex;
use std::f64::consts::TAU;

const MASS: f64 = 0.5;
const STIFFNESS: f64 = 40.0;
/// How many cells of an end absorb.
const CELLS: usize = 40;

/// A chain of masses 0.1 m apart, its ends free.
fn chain(cells: usize, power: f64, more: &str, start: &str) -> Experiment {
    let text = format!(
        r#"
        world = {{ gravity = [0, 0, 0] }}
        time = {{ end = 1, sample = 1 }}
        solver = {{ rtol = 1e-8, atol = 1e-10 }}
        [lattice]
        cell = [[0.1, 0, 0]]
        repeat = [{cells}, 1, 1]
        periodic = false
        absorb = {{ cells = {CELLS}, rate = "10 1/s", power = {power:?} }}
        {more}
        [[body]]
        name = "a"
        shape = {{ points = [{{ mass = {MASS:?}, at = [0, 0, 0] }}] }}
        {start}
        [[spring]]
        between = ["a", "a"]
        cell = [1, 0, 0]
        stiffness = {STIFFNESS:?}
        rest_length = 0.1
        "#
    );
    Experiment::of_scene(&text)
}

/// γ of the cells of a chain [1/s]: how fast they are slowed where all move alike at 1 m/s.
fn damping(power: f64) -> Vec<f64> {
    let Experiment { model, start, .. } = chain(2 * CELLS, power, "", "velocity = [1, 0, 0]");
    let (mut slopes, mut powers) = (vec![0.0; model.dimension()], vec![0.0; model.works().len()]);
    rates(&model, &mut Workspace::default(), 0.0, (&start.bodies).into(), &mut slopes, &mut powers).unwrap();
    (0..model.bodies.len()).map(|body| -slopes[model.slots(body).velocity().start]).collect()
}

/// |r| of a wave e^{i(qn − ωt)} that comes to the right end: the field at its frequency, from the end inwards.
fn reflection(damping: &[f64], q: f64) -> f64 {
    let omega = 2.0 * (STIFFNESS / MASS).sqrt() * (0.5 * q).sin();
    let (mut outside, mut here) = (Complex::new(0.0, 0.0), Complex::new(1.0, 0.0));
    for (cell, rate) in damping[CELLS..].iter().rev().enumerate() {
        // −m(ω² + iωγ)u_n = k(u_{n+1} + u_{n−1} − 2u_n), and nothing beyond the end.
        let springs = if cell == 0 { 1.0 } else { 2.0 };
        let own = springs - Complex::new(omega * omega, omega * rate) * MASS / STIFFNESS;
        (outside, here) = (here, own * here - outside);
    }
    // Inwards of these u_n = A e^{iqn} + B e^{−iqn}.
    let turn = Complex::new(q.cos(), q.sin());
    (outside - here * turn).norm() / (outside - here * turn.conj()).norm()
}

#[test]
fn absorbing_ends_reflect_little() {
    let case = Case {
        row: None,
        name: "absorbing ends of a chain of masses, 40 cells",
        source: "waves of one frequency, three digits",
    };
    let cubic = damping(3.0);
    for (quantity, kappa, expected) in [
        ("amplitude that comes back at κ = 0.05, p 3", 0.05, 1.28e-3),
        ("amplitude that comes back at κ = 0.1, p 3", 0.1, 3.55e-5),
        ("amplitude that comes back at κ = 0.25, p 3", 0.25, 1.55e-6),
        ("amplitude that comes back at κ = 0.4, p 3", 0.4, 6.13e-5),
    ] {
        case.check(quantity, expected, reflection(&cubic, TAU * kappa), 5e-3);
    }
    case.check("amplitude that comes back at κ = 0.25, p 1", 4.99e-3, reflection(&damping(1.0), TAU * 0.25), 5e-3);
}

#[test]
fn a_packet_that_comes_back_has_the_energy_that_ends_reflect() {
    let case = Case {
        row: None,
        name: "packet that runs into an absorbing end and back, κ .25, w 12, p 1",
        source: "∫ r(q)² e^{−w²(q − q₀)²} dq over that without r",
    };
    let width = 12.0;
    let wave =
        format!("wave = {{ kappa = [0.25, 0, 0], branch = 2, amplitude = 1e-6, at = [90, 0, 0], width = {width:?} }}");
    let experiment = chain(220, 1.0, &wave, "");
    let speed = (STIFFNESS / MASS).sqrt() * (0.5 * TAU * 0.25).cos();
    let energy = |state: &State| {
        let mut values = vec![0.0; experiment.model.energies().len()];
        energies(&experiment.model, &mut Workspace::default(), state, &mut values).unwrap();
        values.iter().sum::<f64>()
    };
    let before = energy(&experiment.start);
    // What comes back turns where the friction begins, after 90 cells; the rest is gone 70 cells further.
    let run = experiment.clone().until(160.0 / speed).run();
    let damping = damping(1.0);
    let steps = 400;
    let mean = |of: &dyn Fn(f64) -> f64| {
        let places = (-steps..=steps).map(|step| 5.0 * f64::from(step) / f64::from(steps));
        places.map(|s| of(TAU * 0.25 + s / width) * (-s * s).exp()).sum::<f64>()
    };
    let expected = mean(&|q| reflection(&damping, q).powi(2)) / mean(&|_| 1.0);
    case.check("energy that is left", expected, energy(&run.end) / before, 1e-2);
    case.check("residual of the ledger, of the energy in play", 0.0, run.relative_residual(), 1e-7);
}
