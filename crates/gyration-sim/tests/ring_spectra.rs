//! Spectra of small rings: one wave, energies that add up, ribbons, what is refused and told.

use crate::runs::provenance;
use gyration_record::Recording;
use gyration_scene::Scene;
use gyration_sim::{Job, NoRingSpectrum, RingSpectrum, Unwatched, complete};
use std::path::Path;

/// A ring of masses of half a kilogram on springs of 40 N/m; what else the lattice and the scene have.
fn chain(lattice: &str, more: &str) -> String {
    format!(
        r#"
world = {{ gravity = [0, 0, 0] }}
time = {{ end = 2, sample = 0.02 }}
solver = {{ rtol = 1e-11, atol = 1e-14 }}
lattice = {{ cell = [[0.1, 0, 0]], repeat = [6, 1, 1]{lattice} }}
[[body]]
name = "a"
shape = {{ points = [{{ mass = 0.5, at = [0, 0, 0] }}] }}
[[spring]]
between = ["a", "a"]
cell = [1, 0, 0]
stiffness = 40
rest_length = 0.1
{more}
"#
    )
}

fn spectrum(text: &str) -> Result<RingSpectrum, NoRingSpectrum> {
    let scene =
        Scene::parse("scene.toml", text, Path::new(""), &[]).unwrap_or_else(|errors| panic!("{errors}\n{text}"));
    let scene = complete(scene).unwrap_or_else(|errors| panic!("{errors}"));
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.gyr");
    Job::of(&scene, &provenance()).record(&path, &mut Unwatched).unwrap();
    RingSpectrum::of(&Recording::open(&path).unwrap(), true)
}

#[test]
fn a_wave_is_one_branch_at_one_wave_vector() {
    let wave = ", wave = { kappa = [0.3333333333333333, 0, 0], branch = 2, amplitude = 1e-5 }";
    let found = spectrum(&chain(wave, "")).unwrap();
    assert_eq!(found.kappa.iter().map(|kappa| kappa[0]).fold(0.0, f64::max), 0.5);
    assert_eq!((found.kappa.len(), found.energy[0].len(), found.branches.len()), (6, 3, 18));
    let exact = 2.0 * 80_f64.sqrt() * (std::f64::consts::PI / 3.0).sin();
    let most = found.branches.iter().max_by(|a, b| a.energy.total_cmp(&b.energy)).unwrap();
    // N · ½ m ω² · amplitude².
    let energy = 0.5 * 6.0 * 0.5 * exact * exact * 1e-10;
    assert!((most.kappa[0] - 1.0 / 3.0).abs() < 1e-15 && most.branch == 2, "{most:?}");
    assert!((most.energy / energy - 1.0).abs() < 1e-8, "{} {energy}", most.energy);
    let (omega, width) = (most.omega.unwrap(), most.width.unwrap());
    assert!((omega - exact).abs() < 1e-7 * exact && width.abs() < 1e-7, "{omega} {exact} {width}");
    let rest: f64 = found.branches.iter().filter(|it| it.energy < most.energy).map(|it| it.energy).sum();
    assert!(rest < 1e-14 * most.energy, "{rest:e}");
    assert!(found.warnings.is_empty(), "{:?}", found.warnings);
    // What is left of other branches is no motion to measure.
    assert!(found.branches.iter().filter(|it| it.omega.is_some_and(|omega| omega > 0.0)).count() == 1);
}

#[test]
fn energies_of_branches_add_up_to_that_of_the_run_with_losses_too() {
    let wave = ", wave = { random = { energy = \"1e-12 J\", seed = 3 } }";
    let text = chain(wave, "").replace("stiffness = 40", "damping = 0.3\nstiffness = 40");
    let found = spectrum(&text).unwrap();
    for ((total, run), all) in found.total.iter().zip(&found.run).zip(found.energies.as_ref().unwrap()) {
        // Third orders of displacements of 1e-6 over 0.1.
        assert!((total / run - 1.0).abs() < 1e-3, "{total} {run}");
        assert!((all.iter().flatten().sum::<f64>() / total - 1.0).abs() < 1e-12);
    }
    let ends = [found.total[0], found.total[found.total.len() - 1]];
    assert!(ends[1] < 0.9 * ends[0] && (found.mean_energy() < ends[0]), "{ends:?}");
    // Half a spring of damping c at κ = ½: δ = 2c/m.
    assert!((found.decay[5][2] - 2.0 * 0.3 / 0.5).abs() < 1e-12, "{:?}", found.decay[5]);
    let edge = &found.branches[17];
    let exact = 1.2_f64;
    assert!((edge.width.unwrap() - exact).abs() < 1e-4, "{edge:?}");
    assert!((edge.omega.unwrap() - (320.0 - exact * exact).sqrt()).abs() < 1e-3, "{edge:?}");
}

#[test]
fn what_drifts_has_the_energy_of_its_mean_motion_and_no_frequency() {
    let text = chain("", "").replace("name = \"a\"", "name = \"a\"\nvelocity = [0, 0.3, 0]");
    let found = spectrum(&text).unwrap();
    // Six times ½ · ½ kg · (0.3 m/s)².
    assert!((found.mean_energy() - 6.0 * 0.25 * 0.09).abs() < 1e-12, "{}", found.mean_energy());
    let middle: f64 = found.energy[2].iter().sum();
    assert!(found.kappa[2] == [0.0; 3] && (middle - found.mean_energy()).abs() < 1e-12);
    let still = found.branches.iter().filter(|it| it.energy > 1e-3);
    assert!(still.clone().count() > 0);
    assert!(still.into_iter().all(|it| it.omega == Some(0.0) && it.width.is_none()));
}

#[test]
fn a_ribbon_has_the_waves_of_all_that_lies_side_by_side() {
    let text = chain("", "").replace(
        "cell = [[0.1, 0, 0]], repeat = [6, 1, 1]",
        "cell = [[0.1, 0, 0], [0, 0.1, 0]], repeat = [4, 2, 1], \
                  periodic = [true, false], wave = { kappa = [0.25, 0, 0], branch = 5, amplitude = 1e-6 }",
    ) + "[[spring]]\nbetween = [\"a\", \"a\"]\ncell = [0, 1, 0]\nstiffness = 20\nrest_length = 0.1\n";
    let found = spectrum(&text).unwrap();
    assert_eq!((found.kappa.len(), found.omega[0].len()), (4, 6));
    let share = found.energy[2][5] / found.mean_energy();
    assert!(found.kappa[2] == [0.25, 0.0, 0.0] && share > 1.0 - 1e-9, "{:?}", found.energy);
}

#[test]
fn what_is_no_ring_is_refused_and_what_is_too_sparse_or_too_large_is_told() {
    let said = |text: &str| spectrum(text).unwrap_err().to_string();
    let free = chain(", periodic = false", "");
    assert!(said(&free).contains("free ends"), "{}", said(&free));
    let alone = chain("", "")
        .replace("lattice = {", "#")
        .replace("cell = [1, 0, 0]", "rest_length = 0")
        .replace("between = [\"a\", \"a\"]", "between = [\"a\", \"b\"]")
        .replace("stiffness = 40\nrest_length = 0.1", "stiffness = 40")
        + "[[body]]\nname = \"b\"\nshape = { points = [{ mass = 0.5, at = [0, 0, 0] }] }\nposition = [1, 0, 0]\n";
    assert!(said(&alone).contains("no `[lattice]`"), "{}", said(&alone));
    let wave = |amplitude: &str| format!(", wave = {{ kappa = [0.5, 0, 0], branch = 2, amplitude = {amplitude} }}");
    let sparse = spectrum(&chain(&wave("1e-6"), "").replace("sample = 0.02", "sample = 0.2")).unwrap();
    assert!(sparse.warnings[0].contains("too sparse for 1 of the branches"), "{:?}", sparse.warnings);
    assert!(sparse.branches.iter().all(|it| it.omega.is_none_or(|omega| omega == 0.0)));
    let stiffening = "[[bond]]\nbetween = [\"a\", \"a\"]\ncell = [1, 0, 0]\nlaw = \"1e7*(l - 0.1)^4\"\n";
    let large = spectrum(&chain(&wave("5e-3"), stiffening)).unwrap();
    assert!(large.warnings.iter().any(|it| it.contains("not small")), "{:?}", large.warnings);
    let spinning = format!(
        "{}{}",
        chain("", ""),
        "[[body]]\nname = \"b\"\nposition = [0.05, 0.1, 0]\nshape = { sphere = { radius = 0.01 } }\ndensity = 100\n\
         angular_velocity = [0, 0, 1]\n"
    );
    let spinning = spectrum(&spinning).unwrap();
    assert!(
        spinning.warnings.iter().any(|it| it.contains("turned or strained by up to 2.828")),
        "{:?}",
        spinning.warnings
    );
}
