//! The gallery's lattices: what the head of each scene says, and what `gyration bands` tells of it.

use gyration_scene::Scene;
use gyration_sim::modes::bands::ContinuumModel;
use gyration_sim::survey::{BandOptions, BandSurvey, ComplexBandOptions, ComplexBandSurvey, ContinuumSurvey};
use gyration_validation::{Case, Experiment, Run, largest};
use nalgebra::Complex;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::path::Path;

const OPTIONS: BandOptions =
    BandOptions { points: 2, mesh: None, shapes: false, strain: None, derivatives: Vec::new(), bound: false };

fn scene(name: &str) -> Scene {
    gyration_sim::open(name, &[]).unwrap_or_else(|errors| panic!("{errors}"))
}

/// Its bands along a path.
fn bands(scene: &Scene, path: &str, options: BandOptions) -> BandSurvey {
    BandSurvey::of(scene, Some(path), options).unwrap_or_else(|error| panic!("{error}"))
}

/// A run whose ledger closes.
fn run(name: &str, overrides: &[&str]) -> Run {
    let run = Experiment::of_gallery(name, overrides).run();
    assert!(run.relative_residual() < 1e-8, "{name}: {}", run.relative_residual());
    run
}

#[test]
fn two_masses_leave_a_gap_between_packets_that_move_against_each_other() {
    let case = Case { row: None, name: "gallery: diatomic", source: "√(2k/m₂), √(2k/m₁)" };
    let scene = scene("diatomic");
    let found = bands(&scene, "0,0,0 0.5,0,0", BandOptions { mesh: Some(8), ..OPTIONS });
    let gap = &found.zone.unwrap().gaps[0];
    case.check("lower edge of the gap [rad/s]", 50_f64.sqrt(), gap.from, 1e-10);
    case.check("upper edge of the gap [rad/s]", 100_f64.sqrt(), gap.to, 1e-10);
    let velocity = |kappa: &str, branch: usize| bands(&scene, kappa, OPTIONS).velocity[0][branch].unwrap()[0];
    let [together, against] = [velocity("0.15,0,0", 0), velocity("0.3,0,0", 1)];
    assert!(together > 0.0 && against < 0.0 && together > -2.0 * against, "{together} {against}");
    run("diatomic", &[]);
}

#[test]
fn branches_of_cubes_that_move_and_stretch_avoid_each_other() {
    let case =
        Case {
            row: None, name: "gallery: affine-chain, κ = ¼", source: "(4ks² − mω²)(κ + kl²c² − jω²) = 4k²l²s²c²"
        };
    let (mass, moment, own, between, length) = (1.0, 1.0 / 1200.0, 1.0, 600.0, 0.02_f64);
    let squares = |q: f64| {
        let (s, c) = (0.5 * q).sin_cos();
        let (moves, stretches) = (4.0 * between * s * s / mass, (own + between * (length * c).powi(2)) / moment);
        let coupling = 4.0 * (between * length * s * c).powi(2) / (mass * moment);
        let root = (0.25 * (moves - stretches).powi(2) + coupling).sqrt();
        let middle = 0.5 * (moves + stretches);
        ([moves, stretches], [middle - root, middle + root])
    };
    let found = bands(&scene("affine-chain"), "0,0,0 0.5,0,0", BandOptions { points: 41, ..OPTIONS });
    let [low, high] = squares(FRAC_PI_2).1.map(f64::sqrt);
    case.check("lower [rad/s]", low, found.omega[20][5], 1e-10);
    case.check("upper [rad/s]", high, found.omega[20][11], 1e-10);
    // Uncoupled they would cross; coupled they stay apart by a quarter of the frequency.
    let signs = [0.0, PI].map(|q| squares(q).0).map(|[moves, stretches]| moves > stretches);
    let apart = found.omega.iter().map(|row| row[11] - row[5]).fold(f64::INFINITY, f64::min);
    assert!(signs == [false, true] && apart > 10.0, "{signs:?} {apart}");
    let run = run("affine-chain", &[]);
    let moves = |k: usize| (0..8).map(|n| 0.5 * run.column(&format!("cube-{n}.vx"))[k].powi(2)).sum::<f64>();
    let kinetic = run.column("energy.kinetic");
    let shares: Vec<f64> = (0..run.times.len()).map(|k| moves(k) / kinetic[k]).collect();
    let (least, most) = shares.iter().fold((1.0, 0.0), |(least, most), share| (share.min(least), share.max(most)));
    println!("the motion has {least:.3} to {most:.3} of the kinetic energy");
    assert!(least < 0.15 && most > 0.85, "{least} {most}");
}

#[test]
fn a_short_packet_falls_behind_a_long_one() {
    let case =
        Case { row: None, name: "gallery: micromorphic", source: "Σ E ∂ω/∂k/Σ E over the waves of a packet" };
    let text = scene("micromorphic");
    let speed_of_all = ContinuumSurvey::of(&text, ContinuumModel::Cauchy, Some("0.01,0,0"), 2).unwrap();
    let cauchy = speed_of_all.map.continuum[0][5] / (TAU * 0.01 / 0.2);
    for (kappa, quantity, off) in
        [(0.125, "speed of the long packet [m/s]", 0.0..0.1), (0.3125, "speed of the short packet [m/s]", 0.5..0.8)]
    {
        // Waves of a packet, each with its kinetic energy.
        let spread = 1.0 / (TAU * 4.0);
        let path = format!("{},0,0 {},0,0", kappa - 2.5 * spread, kappa + 2.5 * spread);
        let of_packet = bands(&text, &path, BandOptions { points: 101, ..OPTIONS });
        let weight = |row: usize| {
            let off: f64 = (of_packet.kappa[row][0] - kappa) / spread;
            of_packet.omega[row][5].powi(2) * (-off * off).exp()
        };
        let speed = |row: usize| of_packet.velocity[row][5].unwrap()[0];
        let total: f64 = (0..101).map(weight).sum();
        let expected = (0..101).map(|row| weight(row) * speed(row)).sum::<f64>() / total;
        let wave = format!(
            "lattice.wave={{ kappa = [{kappa}, 0, 0], branch = 5, amplitude = 0.03, at = [6, 0, 0], width = 4 }}"
        );
        let run = run("micromorphic", &[&wave]);
        let speeds: Vec<Vec<f64>> = (0..36).map(|n| run.column(&format!("cube-{n}.vx"))).collect();
        // Round the ring of 7.2 m.
        let turned = |k: usize| {
            let term =
                |(n, of_cube): (usize, &Vec<f64>)| Complex::from_polar(of_cube[k].powi(2), TAU * n as f64 / 36.0);
            speeds.iter().enumerate().map(term).sum::<Complex<f64>>().arg()
        };
        let place = |k: usize| 7.2 * turned(k).rem_euclid(TAU) / TAU;
        // The slope of the straight line nearest to the places.
        let middle = 0.5 * run.times[run.times.len() - 1];
        let moment =
            |of: &dyn Fn(usize) -> f64| (0..run.times.len()).map(|k| (run.times[k] - middle) * of(k)).sum::<f64>();
        let measured = moment(&place) / moment(&|k| run.times[k]);
        case.check(quantity, expected, measured, 0.01);
        assert!(off.contains(&(cauchy / expected - 1.0)), "{cauchy} {expected}");
    }
}

#[test]
fn a_kagome_lattice_twists_without_stiffness() {
    let found = bands(&scene("kagome"), "0.3,0,0 0.3,0.1,0", OPTIONS);
    // Three of them across the plane.
    let still = |row: usize| found.omega[row].iter().filter(|omega| **omega == 0.0).count();
    assert_eq!([still(0), still(1)], [4, 3]);
    run("kagome", &[]);
    let period = |part: f64| {
        let velocity = |body: &str, [x, z]: [f64; 2]| format!("body.{body}.velocity=[{}, 0, {}]", part * x, part * z);
        let [along, up] = [0.173_205_080_756_887_73, 0.3];
        let starts = [velocity("a", [along, -up]), velocity("b", [along, up]), velocity("c", [-2.0 * along, 0.0])];
        let mut overrides: Vec<&str> = starts.iter().map(String::as_str).collect();
        let end = format!("time.end={:?}", 0.6 / part.sqrt());
        overrides.push(&end);
        let run = run("kagome", &overrides);
        let twist: Vec<f64> = run.column("c-0.x").iter().map(|x| x - 0.05).collect();
        let back = (1..twist.len()).find(|k| twist[k - 1] < 0.0 && twist[*k] >= 0.0).unwrap();
        run.times[back] - 0.005 * twist[back] / (twist[back] - twist[back - 1])
    };
    // Half a swing goes as 1/√(velocity): V grows with the fourth power of the twist.
    let case = Case { row: None, name: "gallery: kagome", source: "V ∝ θ⁴" };
    case.check("swings at a 16th and a 64th of the velocity", 0.5, period(1.0 / 16.0) / period(1.0 / 64.0), 1e-2);
}

#[test]
fn a_strong_wave_in_balls_has_the_speed_that_its_forces_give_it() {
    let case = Case {
        row: None,
        name: "gallery: contact-chain",
        source: "c² = ∫(F − F₀)dt / m∫(g₀ − g)dt of a wave that keeps its shape",
    };
    let (radius, alpha, d0, nu, mass) = (0.02_f64, 2000.0, 0.01_f64, 6.0_f64, 1000.0 * 4.0 / 3.0 * PI * 8e-6);
    let force = |gap: f64| {
        let [near, far] = [0.5 * gap, 0.5 * gap + 2.0 * radius].map(|d| d.powf(1.0 - nu));
        TAU * radius * alpha * (0.5 * d0).powf(nu) * (near - far) / (nu - 1.0)
    };
    let run = run("contact-chain", &[]);
    let gaps = |n: usize| -> Vec<f64> {
        let [here, next] = [n, n + 1].map(|n| run.column(&format!("ball-{n}.x")));
        here.iter().zip(&next).map(|(here, next)| next - here - 2.0 * radius).collect()
    };
    let narrowest = |gaps: &[f64]| (1..gaps.len() - 1).min_by(|a, b| gaps[*a].total_cmp(&gaps[*b])).unwrap();
    let crest = |n: usize| {
        let gaps = gaps(n);
        let k = narrowest(&gaps);
        let [before, least, after] = [gaps[k - 1], gaps[k], gaps[k + 1]];
        run.times[k] + 0.5 * 0.001 * (before - after) / (before - 2.0 * least + after)
    };
    let speed = 4.0 / (crest(12) - crest(8));
    // Until the gap is at its widest behind the crest.
    let mut passing = gaps(10);
    let widest = (narrowest(&passing)..passing.len() - 1).find(|k| passing[k + 1] <= passing[*k]).unwrap();
    passing.truncate(widest + 1);
    let push: f64 = passing.iter().map(|gap| force(*gap) - force(0.01)).sum();
    let squeeze: f64 = passing.iter().map(|gap| 0.01 - gap).sum();
    // What the wave leaves behind, 1 % of its height, moves still.
    case.check("speed of the crest [cells/s]", (push / (mass * squeeze)).sqrt(), speed, 1e-2);
    let sound = 0.5 * bands(&scene("contact-chain"), "0.5,0,0", OPTIONS).omega[0][5];
    println!("{:.3} times as fast as sound", speed / sound);
    assert!((speed / sound - 1.74).abs() < 0.02);
}

#[test]
fn a_forced_wave_in_a_gap_decays_as_complex_bands_tell() {
    let complex = ComplexBandOptions { direction: 0, omega: Some([8.5, 9.0]) };
    let found = ComplexBandSurvey::of(&scene("wave-gap"), None, OPTIONS, complex).unwrap();
    let case =
        Case {
            row: None, name: "gallery: wave-gap, ω = 8.5", source: "(2k − m₁ω²)(2k − m₂ω²) = 2k²(1 + cos q)"
        };
    let square = 8.5_f64.powi(2);
    let decay = (1.0_f64 - (100.0 - 2.0 * square) * (100.0 - square) / 5000.0).acosh();
    case.check("decay a cell", decay, TAU * found.kappa[0][0][1].abs() / 8.0, 1e-10);
    let run = run("wave-gap", &[]);
    // Along sin ωt over the last eight periods.
    let from = run.times.iter().position(|time| *time > 16.0 - 8.0 * TAU / 8.5).unwrap();
    let amplitude = |bead: usize| {
        let height = run.column(&format!("bead-{bead}.z"));
        let wave: Vec<f64> = run.times.iter().map(|time| (8.5 * time).sin()).collect();
        let sum = |of: &[f64]| of[from..].iter().zip(&wave[from..]).map(|(a, b)| a * b).sum::<f64>();
        sum(&height) / sum(&wave)
    };
    // The wave comes round the ring from the other side, too. What the beginning left behind still swings.
    let ratio = (2.0 * decay).cosh() / (3.0 * decay).cosh();
    case.by("cosh 2δ/cosh 3δ").check("second over first heavy bead", -ratio, amplitude(4) / amplitude(6), 3e-2);
}

#[test]
fn a_wave_in_muscles_that_lag_behind_grows_by_itself() {
    let case = Case {
        row: None,
        name: "gallery: active-chain, q = π/2",
        source: "(4ks² + mλ²)(K(λa + b)/(λa + K) + kl²c² + jλ²) = 4k²l²s²c², K = κ + λVμ",
    };
    let (own, moment, lag, gain, viscosity, between, length) = (1.0, 1.0 / 1200.0, 0.025, 1.3, 1e-3, 50.0, 0.1);
    let equation_at = |root: Complex<f64>, q: f64| {
        let (s, c) = ((0.5 * q).sin(), (0.5 * q).cos());
        let elastic = root * viscosity + own;
        let active = elastic * (root * lag + gain) / (root * lag + elastic);
        let stretch = active + between * (length * c).powi(2) + root * root * moment;
        (root * root + 4.0 * between * s * s) * stretch - (2.0 * between * length * s * c).powi(2)
    };
    let equation = |root: Complex<f64>| equation_at(root, FRAC_PI_2);
    let mut root = Complex::new(1.7, 41.0);
    for _ in 0..50 {
        let slope = (equation(root + 1e-6) - equation(root - 1e-6)) / 2e-6;
        root -= equation(root) / slope;
    }
    // Four cubes to a cell: the fourth of the zone lies at its middle.
    let found = bands(&scene("active-chain"), "0,0,0", OPTIONS);
    let apart = |it: &&[f64; 2]| (Complex::new(it[0], it[1]) - root).norm();
    let nearest = found.lambda[0].iter().min_by(|a, b| apart(a).total_cmp(&apart(b))).unwrap();
    case.check("growth [1/s]", root.re, nearest[0], 1e-8);
    case.check("frequency [rad/s]", root.im, nearest[1], 1e-8);
    // Twenty roots are one there, on which iterations for eigenvalues may stall.
    let found = bands(&scene("active-chain"), "0.1353,0,0 0.15,0,0", OPTIONS);
    let along = |k: usize| FRAC_PI_2 * (1.0 + found.kappa[k][0]);
    let error = |k: usize| {
        let roots = found.lambda[k].iter().map(|root| Complex::new(root[0], root[1])).filter(|root| root.im > 30.0);
        roots.map(|root| equation_at(root, along(k)).norm()).fold(f64::INFINITY, f64::min) / (between * length).powi(2)
    };
    let error = (0..found.lambda.len()).map(error).fold(0.0, f64::max);
    case.check("error of its equation, κ from .1353 to .15", 0.0, error, 1e-9);
    let run = run("active-chain", &[]);
    let strain = |time: f64| {
        let k = run.times.iter().position(|sample| *sample >= time).unwrap();
        let stretch = |n: usize| run.column(&format!("cube-{n}-0.P_xx"))[k];
        (stretch(1) - stretch(3)).hypot(stretch(2) - stretch(4))
    };
    let growth = (strain(1.2) / strain(0.4)).ln() / 0.8;
    // Strains are of a tenth at the end.
    case.by("its eigenvalue").check("growth of the run [1/s]", root.re, growth, 5e-2);
    assert!(run.column("work.drive").last().unwrap() > &0.1);
}

#[test]
fn a_wave_of_gyroscopes_goes_round_the_corner_one_way() {
    let run = run("gyroscopes", &[]);
    let k = run.times.iter().position(|time| *time >= 24.0).unwrap();
    let energy = |name: &str, k: usize| {
        let value = |quantity: &str| run.column(&format!("{name}.{quantity}"))[k];
        value("vx").powi(2) + value("vz").powi(2)
    };
    let share = |k: usize, chosen: &dyn Fn(usize, usize) -> bool| {
        let all = (0..25).flat_map(|n| ["a", "b"].map(|body| (n, energy(&format!("{body}-{n}"), k))));
        let all: Vec<_> = all.collect();
        let of = |it: &dyn Fn(usize) -> bool| all.iter().filter(|(n, _)| it(*n)).map(|(_, e)| e).sum::<f64>();
        of(&|n| chosen(n % 5, n / 5)) / of(&|_| true)
    };
    let lower = share(0, &|_, row| row == 0);
    let [right, left] = [share(k, &|column, _| column == 4), share(k, &|column, _| column == 0)];
    println!("lower edge at first {lower:.3}; after 24 s right edge {right:.3}, left edge {left:.3}");
    assert!(lower > 0.85 && right > 0.5 && left < 0.1);
    // Without ends all balls in step, and both of a cell against each other, go round circles, ω² ∓ 0.3 ω = 0.2, 3.2.
    let case = Case { row: None, name: "gallery: gyroscopes", source: "ω² ∓ 0.3 ω = 0.2 and 3.2" };
    let whole = gyration_sim::open("gyroscopes", &["lattice.periodic=true".to_owned()]).unwrap();
    let found = bands(&whole, "0,0,0 1/3,1/24,0", OPTIONS);
    assert!(found.omega[1].iter().all(|omega| *omega > 0.0));
    for (name, square, turn) in [
        ("upper edge of the first gap [rad/s]", 0.2_f64, 0.15_f64),
        ("lower edge of the third gap [rad/s]", 3.2, -0.15),
    ] {
        let expected = (square + turn * turn).sqrt() + turn;
        let near = |omega: &&f64| (**omega - expected).abs();
        let nearest = found.omega[0].iter().min_by(|a, b| near(a).total_cmp(&near(b))).unwrap();
        case.check(name, expected, *nearest, 1e-10);
    }
}

#[test]
fn molecules_rest_where_nothing_pulls() {
    let (depth, far, alpha, bond) = (5e-22, 4e-10, 13.5, 1.1e-10);
    // −V′/l, as every bond pulls along its line.
    let pull = |[x, z]: [f64; 2]| {
        let l = x.hypot(z) / far;
        let slope = 6.0 * depth / (1.0 - 6.0 / alpha) * (l.powi(-7) - (alpha * (1.0 - l)).exp()) / far;
        [slope * x / (l * far), slope * z / (l * far)]
    };
    // Forces along x and z of the neighbours to the right and above.
    let force = |[a, h]: [f64; 2]| {
        let sum = |x: f64, z: f64| {
            [0.0, 0.0, bond, -bond]
                .map(|more| pull([x, z + more]))
                .iter()
                .fold([0.0; 2], |s, f| [s[0] + f[0], s[1] + f[1]])
        };
        let (beside, above) = (sum(a, 0.0), sum(0.5 * a, h));
        [beside[0] + above[0], 2.0 * above[1]]
    };
    let mut rest = [4e-10, 4.4e-10];
    for _ in 0..30 {
        let at = force(rest);
        let step = 1e-16;
        let columns = [0, 1].map(|axis| {
            let mut beside = rest;
            beside[axis] += step;
            let there = force(beside);
            [(there[0] - at[0]) / step, (there[1] - at[1]) / step]
        });
        let determinant = columns[0][0] * columns[1][1] - columns[1][0] * columns[0][1];
        rest[0] -= (at[0] * columns[1][1] - at[1] * columns[1][0]) / determinant;
        rest[1] -= (columns[0][0] * at[1] - columns[0][1] * at[0]) / determinant;
    }
    let scene_text = include_str!("lattices/molecule-crystal.toml");
    let text: Vec<&str> = scene_text.lines().collect();
    let told = |line: &str| match line {
        line if line.starts_with("cell = [[") => "cell = [[4.1e-10, 0, 0], [2.05e-10, 0, 4.2e-10]]".to_owned(),
        line if line.starts_with("relax") => "relax = [\"granules\", \"cell\"]".to_owned(),
        line if line.starts_with("wave") => String::new(),
        line => line.to_owned(),
    };
    let text = text.into_iter().map(told).collect::<Vec<_>>().join("\n");
    let free = Scene::parse("scene.toml", &text, Path::new(""), &[]).unwrap();
    let cell = bands(&free, "0,0,0", OPTIONS).rest.cell;
    let case =
        Case { row: None, name: "gallery: molecule-crystal", source: "Σ of the forces of twelve bonds, Newton" };
    case.check("distance of molecules side by side [m]", rest[0], cell[0][0], 1e-8);
    case.check("distance of rows [m]", rest[1], cell[1][2], 1e-8);
    let written = Scene::parse("scene.toml", scene_text, Path::new(""), &[]).unwrap();
    let written = bands(&written, "0,0,0", OPTIONS).rest;
    let unrest = largest(written.cell.iter().flatten().zip(cell.iter().flatten()).map(|(a, b)| a - b));
    assert!(unrest < 1e-18, "{unrest}");
    assert!(Experiment::of_scene(scene_text).run().relative_residual() < 1e-8);
}
