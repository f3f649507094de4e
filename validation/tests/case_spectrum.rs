//! Spectra of rings: one wave is one branch, losses are widths, and what a weak nonlinearity feeds.
//!
//!   chain            ω² = 4(k/m) sin²(q/2);  with dashpots δ = 2(c/m) sin²(q/2), ω² − δ²
//!   affine granules  (4ks² − mω²)(κ + kl²c² − jω²) = 4k²l²s²c²
//!   square           X: 4(k₁ + k₂)/m, 4k₂/m
//!   V = ½kx² + ⅓αx³  of A cos(qn − ωt) the branch at 2q gets ½N m F² sin²(Δt/2)/Δ²,
//!                    F = 4(α/m)A² sin²(q/2) sin q, Δ = 2ω − ω₂: m ü₂ = k Δu₂ + α(r_n² − r_{n−1}²), r of the wave

use crate::lattices::{BETWEEN, GRANULE, LENGTH};
use gyration_record::Recording;
use gyration_scene::Scene;
use gyration_sim::{BranchSpectrum, Job, Provenance, RingSpectrum, Unwatched, complete};
use gyration_validation::{Case, largest};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::path::Path;

/// The head of a scene of a ring: cell vectors, cells, wave, end and step of samples.
fn head(cell: &str, repeat: [usize; 3], wave: &str, [end, sample]: [f64; 2]) -> String {
    format!(
        "world = {{ gravity = [0, 0, 0] }}\ntime = {{ end = {end:?}, sample = {sample:?} }}\nsolver = {{ rtol = 1e-12, \
         atol = 1e-15 }}\nlattice = {{ cell = {cell}, repeat = {repeat:?}, wave = {wave} }}\n"
    )
}

fn point(mass: f64) -> String {
    format!("[[body]]\nname = \"a\"\nshape = {{ points = [{{ mass = {mass:?}, at = [0, 0, 0] }}] }}\n")
}

fn link(kind: &str, cell: [i32; 3], law: &str) -> String {
    format!("[[{kind}]]\nbetween = [\"a\", \"a\"]\ncell = {cell:?}\n{law}\n")
}

fn single(kappa: [f64; 3], branch: usize, amplitude: f64) -> String {
    format!("{{ kappa = {kappa:?}, branch = {branch}, amplitude = {amplitude:?} }}")
}

fn spectrum(text: &str) -> RingSpectrum {
    let scene = Scene::parse("scene.toml", text, Path::new(""), &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let scene = complete(scene).unwrap_or_else(|error| panic!("{error}"));
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.gyr");
    Job::of(&scene, &Provenance { version: "test".into(), commit: None }).record(&path, &mut Unwatched).unwrap();
    RingSpectrum::of(&Recording::open(&path).unwrap(), true).unwrap()
}

/// The branch with most energy, and the part of all that the others have.
fn strongest(found: &RingSpectrum) -> (&BranchSpectrum, f64) {
    let most = found.branches.iter().max_by(|a, b| a.energy.total_cmp(&b.energy)).unwrap();
    let same = |branch: &BranchSpectrum| branch.kappa == most.kappa && branch.branch == most.branch;
    let others: f64 = found.branches.iter().filter(|it| !same(it)).map(|it| it.energy).sum();
    (most, others / found.mean_energy())
}

/// A chain of masses of ½ kg on springs of 40 N/m, 0.1 m apart.
fn chain(cells: usize, wave: &str, times: [f64; 2], damping: f64) -> String {
    let spring = format!("stiffness = 40\nrest_length = 0.1\ndamping = {damping:?}");
    head("[[0.1, 0, 0]]", [cells, 1, 1], wave, times) + &point(0.5) + &link("spring", [1, 0, 0], &spring)
}

#[test]
fn a_wave_of_a_chain_is_one_branch_with_its_frequency() {
    let case =
        Case { row: None, name: "spectrum of a chain of masses, κ ¼ of 8", source: "ω² = 4(k/m) sin²(q/2)" };
    let found = spectrum(&chain(8, &single([0.25, 0.0, 0.0], 2, 1e-7), [4.0, 0.05], 0.0));
    let (most, others) = strongest(&found);
    case.check("ω measured [rad/s]", 12.649110640673518, most.omega.unwrap(), 1e-9);
    case.check("half width [1/s]", 0.0, most.width.unwrap(), 1e-8);
    case.check("part of the energy in all other branches", 0.0, others, 1e-14);
    // N · ½ m ω² A².
    case.check("energy of the branch [J]", 8.0 * 0.25 * 160.0 * 1e-14, most.energy, 1e-8);
}

#[test]
fn waves_of_affine_granules_are_one_branch_each() {
    let case = Case { row: None, name: "spectrum of affine granules, κ ⅙ of 6", source: "closed form, case 8" };
    let spring = format!(
        "points = [[{:?}, 0, 0], [{:?}, 0, 0]]\nstiffness = {BETWEEN:?}\nrest_length = {:?}",
        0.5 * LENGTH,
        -0.5 * LENGTH,
        1.0 - LENGTH
    );
    let body = format!("[[body]]\nname = \"a\"\n{}", GRANULE.affine());
    let free = spectrum_of_granules(&body, &spring, None);
    let places = [1.657808, 13.215584].map(|omega| {
        free.omega[3].iter().position(|own| (own - omega).abs() < 1e-4).unwrap_or_else(|| panic!("{:?}", free.omega[3]))
    });
    let told = [
        ("ω of the acoustic one [rad/s]", "part of the energy that is not in the acoustic one", 1.657808),
        ("ω of the optic one [rad/s]", "part of the energy that is not in the optic one", 13.215584),
    ];
    for (branch, (quantity, part, omega)) in places.into_iter().zip(told) {
        let found = spectrum_of_granules(&body, &spring, Some(branch));
        let (most, others) = strongest(&found);
        assert!(most.branch == branch && (most.kappa[0] - 1.0 / 6.0).abs() < 1e-15, "{most:?}");
        // The list has six digits.
        case.check(quantity, omega, most.omega.unwrap(), 1e-6);
        case.check(part, 0.0, others, 1e-11);
    }
}

fn spectrum_of_granules(body: &str, spring: &str, branch: Option<usize>) -> RingSpectrum {
    let wave = single([1.0 / 6.0, 0.0, 0.0], branch.unwrap_or(11), 1e-7);
    let end = if branch.is_some() { 4.0 } else { 0.2 };
    spectrum(&(head("[[1, 0, 0]]", [6, 1, 1], &wave, [end, 0.1]) + body + &link("spring", [1, 0, 0], spring)))
}

#[test]
fn dashpots_make_a_line_as_wide_as_the_wave_decays() {
    let case =
        Case { row: None, name: "spectrum of a damped chain, κ ½ of 4", source: "δ = 2c/m, √(4k/m − δ²)" };
    let found = spectrum(&chain(4, &single([0.5, 0.0, 0.0], 2, 1e-6), [0.5, 0.02], 1.5));
    let (most, others) = strongest(&found);
    case.check("half width [1/s]", 6.0, most.width.unwrap(), 1e-9);
    case.check("ω measured [rad/s]", 16.852300, most.omega.unwrap(), 1e-7);
    case.check("part of the energy in all other branches", 0.0, others, 1e-11);
    let row = found.kappa.iter().position(|kappa| *kappa == most.kappa).unwrap();
    case.check("half width to first order [1/s]", 6.0, found.decay[row][most.branch], 1e-10);
}

#[test]
fn energies_of_random_waves_are_those_of_the_run() {
    let case = Case { row: None, name: "spectrum of random waves in a ring of 16", source: "energies of waves add" };
    let found = spectrum(&chain(16, "{ random = { energy = \"1e-12 J\", seed = 7 } }", [2.0, 0.05], 0.0));
    // 1e-7 m, third orders over the length of a spring.
    let off = found.total.iter().zip(&found.run).map(|(branches, run)| branches / run - 1.0);
    case.check("branches over kinetic and potential energy, less one", 0.0, largest(off), 1e-8);
    let along = found.branches.iter().filter(|it| it.energy > 1e-20).map(|it| it.energy * 1e12 - 1.0);
    case.check("energy of a branch over the one it was given, less one", 0.0, largest(along), 1e-8);
    let measured = found.branches.iter().filter(|it| it.energy > 1e-20 && it.omega != Some(0.0));
    let off = measured.map(|it| it.omega.unwrap() / (320_f64.sqrt() * (PI * it.kappa[0]).sin().abs()) - 1.0);
    case.check("ω measured over that of the bands, less one", 0.0, largest(off), 1e-8);
}

#[test]
fn a_square_ring_has_waves_along_two_directions() {
    let case = Case { row: None, name: "spectrum of a square ring of 4 × 4, X", source: "closed form, case 6" };
    let [k1, k2, m]: [f64; 3] = [30.0, 11.0, 0.5];
    for (branch, exact, quantity, part) in [
        (2, (4.0 * (k1 + k2) / m).sqrt(), "ω along, 4(k₁ + k₂)/m [rad/s]", "part of the energy not in the one along"),
        (1, (4.0 * k2 / m).sqrt(), "ω across, 4k₂/m [rad/s]", "part of the energy not in the one across"),
    ] {
        let wave = single([0.5, 0.0, 0.0], branch, 1e-7);
        let mut text = head("[[0.1, 0, 0], [0, 0.1, 0]]", [4, 4, 1], &wave, [2.0, 0.05]) + &point(m);
        for (cell, stiffness, length) in [
            ([1, 0, 0], k1, 0.1),
            ([0, 1, 0], k1, 0.1),
            ([1, 1, 0], k2, 0.1 * 2_f64.sqrt()),
            ([1, -1, 0], k2, 0.1 * 2_f64.sqrt()),
        ] {
            text += &link("spring", cell, &format!("stiffness = {stiffness:?}\nrest_length = {length:?}"));
        }
        let found = spectrum(&text);
        let (most, others) = strongest(&found);
        assert!(most.kappa == [0.5, 0.0, 0.0] && most.branch == branch && found.kappa.len() == 16, "{most:?}");
        case.check(quantity, exact, most.omega.unwrap(), 1e-9);
        case.check(part, 0.0, others, 1e-12);
    }
}

#[test]
fn a_cubic_chain_feeds_the_second_harmonic() {
    let case = Case {
        row: None,
        name: "spectrum of a cubic chain, κ ⅛ of 8, its second harmonic",
        source: "second order of the amplitude, closed form",
    };
    let (k, alpha, m, amplitude, cells): (f64, f64, f64, f64, f64) = (40.0, 2000.0, 0.5, 2e-5, 8.0);
    let wave = single([0.125, 0.0, 0.0], 2, amplitude);
    let law = "law = \"20*(l - 0.1)^2 + 2000/3*(l - 0.1)^3\"";
    let text = head("[[0.1, 0, 0]]", [8, 1, 1], &wave, [3.0, 0.05]) + &point(m) + &link("bond", [1, 0, 0], law);
    let found = spectrum(&text);
    let q = TAU / cells;
    let omega = 2.0 * (k / m).sqrt() * (0.5 * q).sin();
    let off = 2.0 * omega - 2.0 * (k / m).sqrt() * q.sin();
    let force = 4.0 * alpha / m * (amplitude * (0.5 * q).sin()).powi(2) * q.sin();
    let energies = found.energies.as_ref().unwrap();
    let most = 0.5 * cells * m * (force / off).powi(2);
    let row = found.kappa.iter().position(|kappa| kappa[0] == 0.25).unwrap();
    let left = found.t.iter().zip(energies).map(|(t, own)| own[row][2] / most - (0.5 * off * t).sin().powi(2));
    // Third order of A α/k = 1e-3 in the amplitude of the second.
    case.check("energy at 2q over its largest, less sin²(Δt/2)", 0.0, largest(left), 1e-4);
    assert!(off * 3.0 > FRAC_PI_2, "{off}");
}
