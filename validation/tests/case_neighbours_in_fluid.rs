//! Rigid spheres that feel one another through the fluid: two exactly, more by far field and lubrication.
//!
//!   in line    λ = (4/3) sinh α Σ n(n+1)/((2n−1)(2n+3)) [1 − (4 s² − m² sinh²α)/(2 sinh mα + m sinh 2α)]
//!   far        U = 1 + 3R/2r − (R/r)³ − (15/4) (R/r)⁴ in line,   1 + 3R/4r + ½ (R/r)³ beside each other, up to (R/r)⁶
//!
//! cosh α = r/2R, m = 2n + 1, s = sinh(mα/2). Sources: Stimson and Jeffery 1926; Batchelor 1976.

use gyration_validation::{Case, Experiment, Run, largest};
use std::f64::consts::PI;

const VISCOSITY: f64 = 2.0;
const RADIUS: f64 = 0.01;
const WEIGHT: f64 = 1500.0 * 4.0 / 3.0 * PI * RADIUS * RADIUS * RADIUS * 9.81;

/// Spheres of a radius, in parts of that of the first, and their centres, in the same.
fn spheres(end: f64, inertia: bool, spheres: &[(f64, [f64; 3])]) -> Experiment {
    let body = |(k, (radius, place)): (usize, &(f64, [f64; 3]))| {
        let place = place.map(|x| x * RADIUS);
        format!(
            "[[body]]\nname = \"s{k}\"\nshape = {{ sphere = {{ radius = {:?} }} }}\ndensity = 2500\n\
             position = {place:?}\ninclusion = {{ inertia = {inertia}, neighbours = true }}\n",
            radius * RADIUS
        )
    };
    let bodies: String = spheres.iter().enumerate().map(body).collect();
    Experiment::of_scene(&format!(
        "world = {{ gravity = [0, 0, -9.81] }}\ntime = {{ end = {end}, sample = {end} }}\n\
         fluid = {{ viscosity = {VISCOSITY}, density = 1000 }}\n{bodies}"
    ))
}

/// The speed of one alone.
fn alone() -> f64 {
    WEIGHT / (6.0 * PI * VISCOSITY * RADIUS)
}

/// How fast a sphere sinks at the start, over one alone.
fn sinking(run: &Run, sphere: usize) -> f64 {
    -run.column(&format!("s{sphere}.vz"))[0] / alone()
}

/// λ, by terms that fall as e^(−2nα).
fn stimson_jeffery(distance: f64) -> f64 {
    let alpha = (0.5 * distance).acosh();
    let sinh = alpha.sinh();
    let term = |k: usize| {
        let n = k as f64;
        let m = 2.0 * n + 1.0;
        // Both divided by e^(mα), which would leave the range of numbers.
        let small = (-m * alpha).exp();
        let numerator = 1.0 + small * small - (2.0 + m * m * sinh * sinh) * small;
        let denominator = 1.0 - small * small + m * (2.0 * alpha).sinh() * small;
        n * (n + 1.0) / ((2.0 * n - 1.0) * (2.0 * n + 3.0)) * (1.0 - numerator / denominator)
    };
    4.0 / 3.0 * sinh * (1..20_000).map(term).sum::<f64>()
}

#[test]
fn two_spheres_sink_in_line_as_stimson_and_jeffery_say() {
    let case = Case {
        row: None,
        name: "two equal spheres sink along their line of centres",
        source: "Stimson and Jeffery 1926: the bispherical series",
    };
    let names = [
        (2.001, "speed over that of one alone, a gap of 0.001 R", 3e-5),
        (2.01, "speed over that of one alone, a gap of 0.01 R", 1e-5),
        (2.1, "speed over that of one alone, a gap of 0.1 R", 1e-6),
        (3.0, "speed over that of one alone, a gap of R", 1e-12),
        (10.0, "speed over that of one alone, a gap of 8 R", 1e-12),
    ];
    let mut others = Vec::new();
    for (distance, name, tolerance) in names {
        let run = spheres(1e-6, false, &[(1.0, [0.0; 3]), (1.0, [0.0, 0.0, distance])]).run();
        let known = 1.0 / stimson_jeffery(distance);
        case.check(name, known, sinking(&run, 0), tolerance);
        others.push((sinking(&run, 1) / sinking(&run, 0) - 1.0).abs());
    }
    case.by("symmetry").check("speed of the other over the first less one, at most", 0.0, largest(others), 1e-12);
}

#[test]
fn far_spheres_carry_each_other_along_as_reflections_say() {
    let case = Case { row: None, name: "two equal spheres 40 radii apart", source: "Batchelor 1976: powers of R/r" };
    let r = 40.0_f64;
    let run = |place: [f64; 3]| spheres(1e-6, false, &[(1.0, [0.0; 3]), (1.0, place)]).run();
    // What the powers leave out are some ten (R/r)⁶.
    let left_out = 40.0 * r.powi(-6);
    let in_line = 1.0 + 1.5 / r - r.powi(-3) - 3.75 * r.powi(-4);
    case.check("speed in line, over one alone", in_line, sinking(&run([0.0, 0.0, r]), 0), left_out);
    let beside = run([r, 0.0, 0.0]);
    case.check("speed beside, over one alone", 1.0 + 0.75 / r + 0.5 * r.powi(-3), sinking(&beside, 0), left_out);
    // Each turns as the other's Stokeslet does, and rolls on it: F/(8πηr²), but for (R/r)³ of it.
    let spin = WEIGHT / (8.0 * PI * VISCOSITY * (r * RADIUS).powi(2));
    let spins = [0, 1].map(|sphere| beside.column(&format!("s{sphere}.Pdot_xz"))[0]);
    case.by("ω = F/(8πηr²)").check("spin beside [rad/s]", spin, spins[0].abs(), 5.0 * r.powi(-3));
    case.by("symmetry").check("sum of the spins over one", 0.0, (spins[0] + spins[1]) / spin, 1e-12);
}

#[test]
fn oblique_pair_keeps_its_line_and_drifts() {
    let case = Case {
        row: None,
        name: "two equal spheres sink, their line at 45°",
        source: "reversal of time and symmetry: they keep their distance",
    };
    let s = 0.5_f64.sqrt() * 3.0;
    let experiment = spheres(20.0, false, &[(1.0, [0.0; 3]), (1.0, [s, 0.0, s])]);
    let run = experiment.run();
    let place = |body: usize| run.end.motion(&experiment.model, body).placement.position / RADIUS;
    let apart = place(1) - place(0);
    case.check("change of the distance over 20 s, over it", 0.0, (apart.norm() - 3.0) / 3.0, 1e-9);
    case.check("turn of the line over 20 s [rad]", 0.0, (apart.x / apart.z).atan() - PI / 4.0, 1e-9);
    // In line and across at the same distance give the drift: (U_∥ − U_⊥)/2 sideways, (U_∥ + U_⊥)/2 down.
    let speed = |place: [f64; 3]| sinking(&spheres(1e-6, false, &[(1.0, [0.0; 3]), (1.0, place)]).run(), 0);
    let (along, across) = (speed([0.0, 0.0, 3.0]), speed([3.0, 0.0, 0.0]));
    let sideways = run.column("s0.vx")[0].abs() / alone();
    case.by("U = M F").check("drift, over the speed of one alone", 0.5 * (along - across), sideways, 1e-10);
}

#[test]
fn three_spheres_sink_by_the_sum_of_what_each_does() {
    let case = Case {
        row: None,
        name: "three equal spheres in a level triangle of side 20 R",
        source: "sum of reflections up to (R/r)³",
    };
    let r = 20.0_f64;
    let triangle = [[0.0; 3], [r, 0.0, 0.0], [0.5 * r, 0.75_f64.sqrt() * r, 0.0]];
    let run = spheres(1e-6, false, &triangle.map(|place| (1.0, place))).run();
    let known = 1.0 + 2.0 * (0.75 / r + 0.5 * r.powi(-3));
    // (R/r)⁴ is left out of the sum.
    case.check("speed over that of one alone", known, sinking(&run, 0), 2.0 * 3.75 / r.powi(4));
    let others = largest([1, 2].map(|sphere| (sinking(&run, sphere) / sinking(&run, 0) - 1.0).abs()));
    case.by("symmetry").check("speeds of the others over the first less one, at most", 0.0, others, 1e-12);
}

#[test]
fn unequal_spheres_close_the_ledger_with_inertia_and_without() {
    let three = [(1.0, [0.0, 0.0, 4.0]), (1.6, [1.1, 0.3, 0.5]), (0.6, [-0.7, 0.9, -1.9])];
    let names = [
        (true, "three unequal spheres sink past one another, with inertia"),
        (false, "three unequal spheres sink past one another, without inertia"),
    ];
    for (inertia, name) in names {
        let case = Case { row: None, name, source: "the ledger" };
        let experiment = spheres(2.0, inertia, &three).sampled(0.1);
        let run = experiment.run();
        case.check("residual over the energy in play", 0.0, run.relative_residual(), 1e-7);
        let work = run.column("work.fluid");
        // The fluid is at rest: whatever it does takes energy.
        let gained = largest(work.windows(2).map(|pair| pair[1] - pair[0]).map(|gain| gain.max(0.0)));
        case.by("dissipation").check("energy that the fluid gives [J]", 0.0, gained, 1e-15);
    }
}
