//! Micromorphic fields: a straight chain under tension, and balances that close.
//!
//!   σ_xx = T e^(−r²/2b²)/(2πb²)          at a distance r from a chain under tension T, everywhere along it
//!   Σ N_ij W … = ∂k/∂t, σ … = ∂j/∂t      of granules that move anyhow

use crate::lattices::{GRANULE, LatticeScene, Link};
use gyration::tensor::Vec3;
use gyration_record::Recording;
use gyration_scene::Scene;
use gyration_sim::{FieldPoints, FieldSurvey, Job, Provenance, Unwatched};
use gyration_validation::{Case, largest};
use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::path::Path;

fn fields(text: &str, width: f64, points: Vec<Vec3>) -> FieldSurvey {
    let scene = Scene::parse("scene.toml", text, Path::new(""), &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.gyr");
    Job::of(&scene, &Provenance { version: "test".into(), commit: None }).record(&path, &mut Unwatched).unwrap();
    FieldSurvey::of(&Recording::open(&path).unwrap(), width, &FieldPoints::At(points), 1).unwrap()
}

#[test]
fn a_chain_under_tension_bears_it_wherever_one_looks() {
    let case = Case { row: None, name: "fields of a chain under tension", source: "closed form" };
    // Springs of 40 N/m, stretched by 0.02 m.
    let (tension, width, away): (f64, f64, f64) = (0.8, 0.25, 0.1);
    let text = "world = { gravity = [0, 0, 0] }\ntime = { end = 1, sample = 1 }\nlattice = { cell = [[0.12, 0, 0]], \
                repeat = [5, 1, 1] }\n[[body]]\nname = \"a\"\nshape = { points = [{ mass = 0.5, at = [0, 0, 0] }] }\n\
                [[spring]]\nbetween = [\"a\", \"a\"]\ncell = [1, 0, 0]\nstiffness = 40\nrest_length = 0.1\n";
    let along = [-7.0, 0.0, 0.013, 0.3, 1e3];
    let found = fields(text, width, along.map(|x| Vec3::new(x, 0.6 * away, 0.8 * away)).into());
    let exact = (-0.5 * (away / width).powi(2)).exp() / (TAU * width * width);
    case.check("σ_xx/T at r = 0.1, b = 0.25 [1/m²]", 2.350696473, exact, 1e-9);
    let off = found.fields.iter().flatten().map(|it| (it.stress.m11 / tension - exact).abs());
    case.check("σ_xx/T − exact [1/m²]", 0.0, largest(off), 1e-12 * exact);
    let across = found.fields.iter().flatten().map(|it| it.stress.m12.abs().max(it.stress.m22.abs()));
    case.check("σ_xy, σ_yy [Pa]", 0.0, largest(across), 1e-14);
    let mean = 0.5 / 0.12 * exact;
    let off = found.fields.iter().flatten().map(|it| (it.density - mean).abs());
    // A lattice of spacing a under a bell of width b is even to 2 e^(−2π²b²/a²).
    case.check("density − mean [kg/m³]", 0.0, largest(off), 1e-12 * mean);
}

/// Twelve affine granules on springs between points off their axes, each with a motion of its own.
fn granules() -> String {
    let mut scene = LatticeScene::alone();
    let place = |n: usize| [(n % 2) as f64, (n / 2 % 2) as f64, (n / 4) as f64];
    let wave = |n: usize, k: usize| (1.3 * n as f64 + 0.7 * k as f64).sin();
    for n in 0..12 {
        let mut motion = format!("velocity = {:?}\n", [0, 1, 2].map(|k| 0.3 * wave(n, k)));
        let rate = [0, 1, 2].map(|i| [0, 1, 2].map(|j| wave(n, 3 + 3 * i + j)));
        let _ = writeln!(motion, "gradient_rate = {rate:?}");
        scene = scene.body(&format!("g{n}"), place(n), &(motion + &GRANULE.affine()));
    }
    for i in 0..12 {
        for j in i + 1..12 {
            let [a, b] = [place(i), place(j)].map(Vec3::from);
            if (a - b).norm() > 1.1 {
                continue;
            }
            let points = [[0.12, 0.03, -0.02], [-0.1, 0.02, 0.04]];
            let names = [format!("g{i}"), format!("g{j}")];
            let between = [names[0].as_str(), names[1].as_str()];
            scene = scene.spring(Link { between, cell: [0; 3], points, law: [6.0, 0.7, 0.4] });
        }
    }
    scene.text().to_owned()
}

#[test]
fn balances_of_twelve_affine_granules_close() {
    let case = Case { row: None, name: "fields of twelve affine granules", source: "exact local balance" };
    let points = (0..8).map(|n| Vec3::new(0.2 * f64::from(n), 0.5 - 0.1 * f64::from(n), 0.25 * f64::from(n)));
    for (width, quantity) in [(0.3, "left of both, b = 0.3"), (2.5, "left of both, b = 2.5")] {
        let found = fields(&granules(), width, points.clone().collect());
        let left = found.fields.iter().flatten().map(|it| {
            let [affine, linear] = it.scales;
            (it.residual / affine).max(it.momentum_residual / linear)
        });
        case.check(quantity, 0.0, largest(left), 1.7e-11);
    }
}
