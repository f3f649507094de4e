//! Scenes that start with waves: what cannot be one is refused at its key, and what starts is the same once more.

use crate::islands::parsed;
use gyration::dynamics::Workspace;
use gyration::tensor::{Mat3, Vec3};
use gyration_scene::Scene;
use gyration_sim::rows::{Fields, RowScratch};
use gyration_sim::{RunPlan, complete};
use std::path::Path;

/// Two cells along y of a rigid and an affine box, joined along x.
fn ring(lattice: &str) -> String {
    format!(
        r#"
        world = {{ gravity = [0, 0, 0] }}
        time = {{ end = 1, sample = 1 }}
        [lattice]
        cell = [[1, 0, 0]]
        repeat = [8, 1, 1]
        {lattice}
        [[body]]
        name = "stiff"
        density = 50
        shape = {{ box = {{ size = [0.4, 0.3, 0.25] }} }}
        [[body]]
        name = "soft"
        density = 50
        position = [0.5, 0, 0]
        shape = {{ box = {{ size = [0.4, 0.3, 0.25] }} }}
        affine = {{ material = {{ mooney_rivlin = {{ c1 = "30 Pa", c2 = "10 Pa" }} }} }}
        [[spring]]
        between = ["stiff", "soft"]
        points = [[0.2, 0.1, 0], [-0.2, 0.1, 0.1]]
        stiffness = 6
        rest_length = 0.14142135623730953
        [[spring]]
        between = ["soft", "stiff"]
        cell = [1, 0, 0]
        points = [[0.2, 0.1, 0.05], [-0.2, 0.1, 0]]
        stiffness = 6
        rest_length = 0.11180339887498948
        "#
    )
}

/// The messages about a scene, with their keys.
fn told(lattice: &str) -> String {
    let found = Scene::parse("scene.toml", &ring(lattice), Path::new(""), &[]).and_then(complete);
    found.err().map(|errors| errors.to_string()).unwrap_or_default()
}

#[test]
fn a_wave_that_is_none_is_refused_with_its_key() {
    for (lattice, key, words) in [
        ("wave = { kappa = [0.3, 0, 0], amplitude = 1e-6 }", "lattice.wave.kappa", "write 2/8 = 0.25"),
        ("wave = { kappa = [0, 0.5, 0], amplitude = 1e-6 }", "lattice.wave.kappa", "write 0"),
        ("wave = { kappa = [0.25, 0, 0] }", "lattice.wave.amplitude", "is missing"),
        ("wave = { kappa = [0.25, 0, 0], amplitude = 1e-6, at = [4, 0, 0] }", "lattice.wave.at", "add `width`"),
        (
            "wave = { kappa = [0.25, 0, 0], branch = 17, amplitude = 1e-6 }",
            "lattice.wave.branch",
            "there are 17 branches",
        ),
        ("wave = { kappa = [0.25, 0, 0], branch = 16, amplitude = 5 }", "lattice.wave", "no small motion"),
        ("wave = [{ kappa = [0, 0, 0], amplitude = 1e-6 }]", "lattice.wave.0.kappa", "frequency zero"),
        (
            "wave = { random = { energy = 1e-9, seed = 1 }, amplitude = 1 }",
            "lattice.wave.random",
            "stands for every wave",
        ),
        ("periodic = false\nwave = { kappa = [0.25, 0, 0], amplitude = 1e-6 }", "lattice.wave.kappa", "free ends"),
    ] {
        let told = told(lattice);
        assert!(told.contains(key) && told.contains(words), "{lattice}\n{told}");
    }
}

#[test]
fn waves_are_small_motions_whose_velocities_are_their_rates() {
    // Differences of the start by the phase of a wave, which a shift by one cell turns by κ, tell nothing of time; the
    // wave a quarter of a period on is the one of two cells before, at κ = ⅛.
    let wave = "wave = { kappa = [0.125, 0, 0], branch = 10, amplitude = 1e-4 }";
    let scene = complete(parsed(&ring(wave), &[])).unwrap();
    let rest = parsed(&ring(wave), &[]);
    let (model, state) = (&scene.built().model, &scene.built().state);
    let cell = rest.built().cell.as_ref().unwrap();
    let waves = gyration_sim::modes::bands::LatticeWaves::new(&cell.model, &cell.state, false).unwrap();
    let omega = waves.branches([0.125, 0.0, 0.0]).unwrap()[10].omega;
    let away = |n: usize| {
        let (now, before) = (state.motion(model, n), rest.built().state.motion(model, n));
        let (now_p, before_p) = (now.placement, before.placement);
        (now_p.position - before_p.position, now_p.gradient - before_p.gradient, now.velocity)
    };
    let mut most: f64 = 0.0;
    for kind in [0, 8] {
        for n in 0..8 {
            let (_, _, velocity) = away(kind + n);
            let (u, p, _) = away(kind + (n + 6) % 8);
            let wrong: (Vec3, Mat3) = (velocity.velocity / omega - u, velocity.gradient_rate / omega - p);
            assert!(wrong.0.norm() < 1e-12 && wrong.1.norm() < 1e-6, "{wrong:?}");
            most = most.max(u.amax());
        }
    }
    // Turns and strains have second orders; the fastest coordinate goes as far as it says.
    assert!(most <= 1e-4 * (1.0 + 1e-9), "{most}");
}

#[test]
fn a_scene_is_complete_once_its_waves_are_there() {
    let scene = parsed(&ring("wave = { random = { energy = \"1e-14 J\", seed = 3 } }"), &[]);
    assert!(!scene.is_complete());
    let one = complete(scene.clone()).unwrap();
    assert!(one.is_complete() && one.built().waves.is_none());
    assert_eq!(one.built().state, complete(scene).unwrap().built().state);
    let again = complete(Scene::parse("scene.json", &one.resolved().to_string(), Path::new(""), &[]).unwrap()).unwrap();
    assert_eq!(again.built().state, one.built().state);
}

#[test]
fn displacements_are_recorded_from_the_rest() {
    let lattice = "wave = { kappa = [0.125, 0, 0], branch = 10, amplitude = 1e-4 }";
    let scene = parsed(&(ring(lattice) + "[record]\nquantities = [\"displacement\"]\n"), &[]);
    let scene = complete(scene).unwrap();
    let built = scene.built();
    let plan = RunPlan::from(built);
    let fields = Fields::new(&built.model, &plan.extras);
    let before = fields.arrays(&built.model).0.iter().position(|array| array.name == "displacement").unwrap();
    let mut scratch = RowScratch::default();
    fields.fill(&built.model, &mut Workspace::default(), &built.state, None, &mut scratch).unwrap();
    let rest = |body| built.model.rest_place(body).unwrap();
    let expected = (0..16).flat_map(|body| {
        let place = built.state.motion(&built.model, body).placement.position - rest(body);
        [place.x, place.y, place.z]
    });
    let expected: Vec<f64> = expected.collect();
    assert!(before > 0 && scratch.row.windows(48).any(|window| window == expected), "{expected:?}");
    // All cells have the same rest, each in its own place.
    assert!((0..8).all(|cell| rest(cell) == rest(0) && rest(8 + cell).x == 0.5), "{:?}", rest(0));
}

/// A chain whose bonds are too long for its cell, which opens to a = l₀ + q/k: it swings there with ω = 2√(k/m)
/// sin(πκ).
#[test]
fn a_wave_starts_in_cells_whose_vectors_rest() {
    let pulled = 0.5;
    let text = |relax: &str| {
        format!(
            "world = {{ gravity = [0, 0, 0] }}\ntime = {{ end = 20, sample = 20 }}\n[lattice]\ncell = [[0.1, 0, 0]]\n\
             repeat = [8, 1, 1]\n{relax}\nwave = {{ kappa = [0.25, 0, 0], branch = 2, amplitude = 1e-7 }}\n[[body]]\n\
             name = \"a\"\nshape = {{ points = [{{ mass = 2, at = [0, 0, 0] }}] }}\n[[bond]]\n\
             between = [\"a\", \"a\"]\ncell = [1, 0, 0]\nlaw = \"0.5*10*(l - 0.12)^2\"\n"
        )
    };
    let relax = format!("relax = [\"granules\", \"cell\"]\nstress = [[{pulled}, 0, 0], [0, 0, 0], [0, 0, 0]]");
    let scene = complete(parsed(&text(&relax), &[])).unwrap();
    let built = scene.built();
    let vector = built.model.lattice.vectors()[0].x;
    assert!((vector - 0.17).abs() < 1e-12, "{vector}");
    let job = gyration_sim::Job::of(&scene, &crate::runs::provenance());
    let mut simulation = gyration_sim::Simulation::new(job.model, job.start, job.plan).unwrap();
    let mut sink = gyration_sim::MemorySink::default();
    simulation.begin(&mut sink).unwrap();
    simulation.run(&mut sink, &mut gyration_sim::Unwatched).unwrap();
    let omega = 2.0 * 5.0_f64.sqrt() * (0.25 * std::f64::consts::PI).sin();
    let end = simulation.state();
    for body in 0..8 {
        let moved = |state: &gyration::state::State| {
            state.motion(job.model, body).placement.position - job.model.rest_place(body).unwrap()
        };
        let [start, end] = [moved(job.start), moved(&end)].map(|way| way.x);
        // The wave runs on by ωt.
        let phase = std::f64::consts::FRAC_PI_2 * body as f64;
        let ahead = [0.0, omega * 20.0].map(|late| 1e-7 * (phase - late).cos());
        println!("body {body}: {start:e} {end:e} for {ahead:?}");
        assert!((start.abs() - ahead[0].abs()).abs() < 1e-14);
        assert!((end.abs() - ahead[1].abs()).abs() < 1e-12, "{body}: {end:e} {:e}", ahead[1]);
    }
}
