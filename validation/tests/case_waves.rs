//! Runs of lattices that start with waves of their bands: one wave, a packet, all waves at random phases.
//!
//! A ring of N cells that starts with one wave, κ = j/N, oscillates with ω + O(amplitude²). A packet ξ e^{ik·R − |n −
//! n₀|²/2w²} moves at ∂ω/∂k, and its width becomes √(w² + (ω″t/w)²). Of random waves each has the same energy.

use gyration::balance::energies;
use gyration::dynamics::Workspace;
use gyration::model::Model;
use gyration::state::State;
use gyration_scene::Scene;
use gyration_sim::modes::bands::LatticeWaves;
use gyration_validation::{Case, Experiment};
use std::f64::consts::TAU;
use std::path::Path;

/// A chain of masses of half a kilogram 0.1 m apart, with bonds V(l).
fn masses(cells: usize, wave: &str, bond: &str) -> String {
    format!(
        r#"
        world = {{ gravity = [0, 0, 0] }}
        time = {{ end = 1, sample = 1 }}
        solver = {{ rtol = 1e-11, atol = 1e-13 }}
        lattice = {{ cell = [[0.1, 0, 0]], repeat = [{cells}, 1, 1], wave = {wave} }}
        [[body]]
        name = "a"
        shape = {{ points = [{{ mass = 0.5, at = [0, 0, 0] }}] }}
        [[bond]]
        between = ["a", "a"]
        cell = [1, 0, 0]
        law = "{bond}"
        "#
    )
}

/// A chain of affine boxes, with springs between faces.
fn boxes(wave: &str) -> String {
    format!(
        r#"
        world = {{ gravity = [0, 0, 0] }}
        time = {{ end = 1, sample = 1 }}
        solver = {{ rtol = 1e-11, atol = 1e-13 }}
        lattice = {{ cell = [[0.5, 0, 0]], repeat = [6, 1, 1], wave = {wave} }}
        [[body]]
        name = "a"
        density = 50
        shape = {{ box = {{ size = [0.4, 0.3, 0.25] }} }}
        affine = {{ material = {{ mooney_rivlin = {{ c1 = "30 Pa", c2 = "10 Pa" }} }} }}
        [[spring]]
        between = ["a", "a"]
        cell = [1, 0, 0]
        points = [[0.2, 0, 0], [-0.2, 0, 0]]
        stiffness = 6
        rest_length = 0.1
        "#
    )
}

/// ω of a branch, and ∂ω/∂k.
fn branch(text: &str, kappa: f64, branch: usize) -> [f64; 2] {
    let scene = Scene::parse("scene.toml", text, Path::new(""), &[]).unwrap();
    let cell = scene.built().cell.as_ref().unwrap();
    let waves = LatticeWaves::new(&cell.model, &cell.state, cell.relaxes).unwrap();
    let found = &waves.branches([kappa, 0.0, 0.0]).unwrap()[branch];
    [found.omega, found.velocity.unwrap().x]
}

/// The component Σ z e^{−2πi κn} of the wave that runs forwards, z = u + iv/ω, u along x.
fn component(model: &Model, state: &State, rest: &[f64], (kappa, omega): (f64, f64)) -> [f64; 2] {
    (0..rest.len()).fold([0.0, 0.0], |[re, im], n| {
        let motion = state.motion(model, n);
        let (u, v) = (motion.placement.position.x - rest[n], motion.velocity.velocity.x / omega);
        let (sine, cosine) = (-TAU * kappa * n as f64).sin_cos();
        [re + u * cosine - v * sine, im + u * sine + v * cosine]
    })
}

/// The phase beyond ωt after so many periods, for an amplitude.
fn phase_error(text: &dyn Fn(f64) -> String, (kappa, number): (f64, usize), periods: f64, amplitude: f64) -> f64 {
    let text = text(amplitude);
    let [omega, _] = branch(&text, kappa, number);
    let scene = Scene::parse("scene.toml", &text, Path::new(""), &[]).unwrap();
    let built = scene.built();
    let rest: Vec<f64> =
        (0..built.model.bodies.len()).map(|n| built.state.motion(&built.model, n).placement.position.x).collect();
    let experiment = Experiment::of_scene(&text).until(periods * TAU / omega);
    let phase = |state: &State| {
        let [re, im] = component(&experiment.model, state, &rest, (kappa, omega));
        im.atan2(re)
    };
    let turned = phase(&experiment.run().end) - phase(&experiment.start);
    turned - TAU * (turned / TAU).round()
}

#[test]
fn a_wave_of_a_ring_keeps_its_frequency_to_the_square_of_its_amplitude() {
    let bond = "0.5*40*(l - 0.1)^2 + 2000*(l - 0.1)^3 + 1e5*(l - 0.1)^4";
    let chain = |amplitude: f64| {
        masses(8, &format!("{{ kappa = [0.125, 0, 0], branch = 2, amplitude = {amplitude:?} }}"), bond)
    };
    let granules =
        |amplitude: f64| boxes(&format!("{{ kappa = [{}, 0, 0], branch = 5, amplitude = {amplitude:?} }}", 1.0 / 6.0));
    /// The scene of an amplitude, κ and branch of the wave, the largest amplitude.
    type Ring<'a> = (&'a dyn Fn(f64) -> String, (f64, usize), f64);
    let cases: [Ring; 2] = [(&chain, (0.125, 2), 2e-4), (&granules, (1.0 / 6.0, 5), 1e-3)];
    for (text, wave, amplitude) in cases {
        let errors = [1.0, 0.5, 0.25].map(|part| phase_error(text, wave, 5.0, part * amplitude));
        let ratios = [errors[0] / errors[1], errors[1] / errors[2]];
        println!("phases beyond ωt after five periods {errors:?}, ratios {ratios:?}");
        // The fourth power of the amplitude is left.
        assert!(errors[0].abs() < 0.2 && (ratios[1] - 4.0).abs() < 0.1, "{errors:?} {ratios:?}");
    }
}

/// Where the energy of a chain of masses is: its middle and √2 times its standard deviation, in cells.
fn packet(model: &Model, state: &State) -> [f64; 2] {
    let cells = model.bodies.len();
    let motions: Vec<_> = (0..cells).map(|n| state.motion(model, n)).collect();
    let stretched = |n: usize| motions[(n + 1) % cells].placement.position.x - motions[n].placement.position.x;
    let energy = |n: usize| {
        let springs = stretched(n).powi(2) + stretched((n + cells - 1) % cells).powi(2);
        0.25 * motions[n].velocity.velocity.x.powi(2) + 0.25 * 40.0 * springs
    };
    let energies: Vec<f64> = (0..cells).map(energy).collect();
    let moment =
        |of: &dyn Fn(f64) -> f64| energies.iter().enumerate().map(|(n, energy)| energy * of(n as f64)).sum::<f64>();
    let total = moment(&|_| 1.0);
    let middle = moment(&|n| n) / total;
    [middle, (2.0 * moment(&|n| (n - middle).powi(2)) / total).sqrt()]
}

#[test]
fn a_packet_runs_at_the_group_velocity_and_grows_wider() {
    let case = Case {
        row: None, name: "packet in a chain of masses, κ 0.1, w 25", source: "∂ω/∂k, √(w² + (ω″t/w)²)"
    };
    let wave = "{ kappa = [0.1, 0, 0], branch = 2, amplitude = 1e-6, at = [150, 0, 0], width = 25 }";
    let text = masses(650, wave, "0.5*40*(l - 0.1)^2");
    let [_, velocity] = branch(&text, 0.1, 2);
    let experiment = Experiment::of_scene(&text).until(40.0);
    let experiment = Experiment {
        plan: gyration_sim::RunPlan {
            tolerance: gyration_sim::Tolerance { rtol: 1e-9, atol: 1e-11 },
            ..experiment.plan
        },
        ..experiment
    };
    let [before, _] = packet(&experiment.model, &experiment.start);
    let [after, width] = packet(&experiment.model, &experiment.run().end);
    let exact = case.by("the sum over all waves of the ring, validation/oracles/wave_packet.py");
    exact.check("cells that the energy goes in 40 s", 340.143917236843, after - before, 1e-8);
    exact.check("√2 of its standard deviation then [cells]", 25.146250964645, width, 1e-7);
    // The energy is that of all κ about 0.1, a thousandth of it of waves that run backwards.
    case.check("cells that the energy goes in 40 s, by ∂ω/∂k", velocity * 40.0 / 0.1, after - before, 1e-3);
    case.check("its width then, by ω″ [cells]", 25.098, width, 3e-3);
}

#[test]
fn a_packet_whose_waves_all_run_forwards_keeps_its_middle_on_time() {
    let case = Case {
        row: None,
        name: "packet in a chain of masses, κ 0.1, w 25, its waves with frequencies of their own",
        source: "Σ_κ of C e^{i(kn − ω(κ)t)}, C e^{−n²/2w²} transformed, middle and width of C C*",
    };
    // Waves of a ring of 200 about κ = 20/200 whose amplitudes are those of the packet, to 6.5 widths of 200/2πw.
    let (cells, width) = (200_usize, 25.0);
    let spread = cells as f64 / (TAU * width);
    let amplitude = |j: usize| 1e-6 * (-0.5 * ((j as f64 - 20.0) / spread).powi(2)).exp() / (spread * TAU.sqrt());
    let kappa = |j: usize| j as f64 / cells as f64;
    let waves = 12..29;
    let list = waves
        .clone()
        .map(|j| format!("{{ kappa = [{:?}, 0, 0], branch = 2, amplitude = {:?} }}", kappa(j), amplitude(j)));
    let text = masses(cells, &format!("[{}]", list.collect::<Vec<_>>().join(", ")), "0.5*40*(l - 0.1)^2");
    let experiment = Experiment::of_scene(&text).until(40.0);
    let end = experiment.run().end;
    let omega = |j: usize| 2.0 * 80_f64.sqrt() * (0.5 * TAU * kappa(j)).sin();
    let rest = vec![0.0; cells];
    let found: Vec<_> = waves.map(|j| (j, component(&experiment.model, &end, &rest, (kappa(j), omega(j))))).collect();
    // |C_n|² about where the packet is expected, half of the ring to each side.
    let weights: Vec<(f64, f64)> = (0..cells)
        .map(|n| {
            let place = 240.0 + n as f64;
            let sum = found.iter().fold([0.0, 0.0], |[re, im], (j, [a, b])| {
                let (sine, cosine) = (TAU * kappa(*j) * place).sin_cos();
                [re + a * cosine - b * sine, im + a * sine + b * cosine]
            });
            (place, sum[0] * sum[0] + sum[1] * sum[1])
        })
        .collect();
    let total: f64 = weights.iter().map(|(_, weight)| weight).sum();
    let middle = weights.iter().map(|(place, weight)| place * weight).sum::<f64>() / total;
    let square = weights.iter().map(|(place, weight)| (place - middle).powi(2) * weight).sum::<f64>() / total;
    // The list has five digits.
    case.check("cells in 40 s", 340.23, middle, 2e-5);
    case.check("its width then [cells]", 25.098, (2.0 * square).sqrt(), 2e-5);
}

/// The energy of a state beyond that of the scene as it is written [J], and how many waves of its ring run.
fn energy_of_waves(text: &str, cells: usize) -> (f64, usize) {
    let scene = Scene::parse("scene.toml", text, Path::new(""), &[]).unwrap();
    let built = scene.built();
    let experiment = Experiment::of_scene(text);
    let energy = |state: &State| {
        let mut values = vec![0.0; built.model.energies().len()];
        energies(&built.model, &mut Workspace::default(), state, &mut values).unwrap();
        values.iter().sum::<f64>()
    };
    let cell = built.cell.as_ref().unwrap();
    let waves = LatticeWaves::new(&cell.model, &cell.state, cell.relaxes).unwrap();
    let running = |j: usize| {
        let branches = waves.branches([j as f64 / cells as f64, 0.0, 0.0]).unwrap();
        branches.iter().filter(|branch| branch.omega > 0.0).count()
    };
    (energy(&experiment.start) - energy(&built.state), (0..cells).map(running).sum())
}

#[test]
fn random_waves_have_the_same_energy_each() {
    let wave = "{ random = { energy = \"1e-12 J\", seed = 7 } }";
    let case = Case { row: None, name: "random waves of 1e-12 J each", source: "energies of waves add" };
    let (energy, count) = energy_of_waves(&masses(16, wave, "0.5*40*(l - 0.1)^2"), 16);
    case.check("waves that run in a ring of 16 masses", 15.0, count as f64, 0.0);
    // Places of 0.1 m have displacements of 1e-7 m to 1e-10 of them.
    case.check("energy of a ring of 16 masses [J]", 15.0 * 1e-12, energy, 1e-8);
    let (energy, count) = energy_of_waves(&boxes(wave), 6);
    // Third orders of the strains, 2e-6, and the rounding of elastic energies.
    case.check("energy of a ring of 6 affine granules, over waves [J]", 1e-12, energy / count as f64, 1e-4);
}
