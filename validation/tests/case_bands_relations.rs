//! Relations that waves through any lattice obey: a sheet of two kinds of granules, taut, askew, at rest, with and
//! without dashpots.

use crate::lattices::{GRANULE, LatticeScene, Link, between_faces, frequencies, row, row_towards};
use gyration_sim::modes::bands::LatticeWaves;
use gyration_validation::{Case, largest};
use nalgebra::Complex;

const TOLERANCE: f64 = 1e-10;
const KAPPA: [f64; 3] = [0.17, 0.29, 0.0];

/// A sheet of a soft box and a stiff one, whose springs hold them at points off their centres and are taut.
fn sheet(damping: f64) -> LatticeWaves {
    let soft = "shape = { box = { size = [0.3, 0.2, 0.25] } }\nmass_properties = { mass = 1.3, euler_tensor = [[0.012, \
                0.001, 0], [0.001, 0.009, 0], [0, 0, 0.008]] }\naffine = { material = { st_venant_kirchhoff = { lambda = \
                300, mu = 400 } } }";
    let stiff = "shape = { box = { size = [0.3, 0.3, 0.2] } }\nmass = 0.8";
    let mut lattice = LatticeScene::relaxed(&[[1.0, 0.1, 0.0], [-0.2, 0.9, 0.0]]);
    lattice = lattice.body("a", [0.0; 3], soft).body("b", [0.5, 0.4, 0.0], stiff);
    let (near, far) = (0.15, 0.4);
    for (between, cell, points, stiffness) in [
        (["a", "b"], [0, 0, 0], [[near, 0.05, 0.1], [-near, 0.0, 0.1]], 40.0),
        (["a", "b"], [0, 0, 0], [[near, 0.1, -0.1], [-near, -0.1, -0.1]], 30.0),
        (["b", "a"], [1, 0, 0], [[near, 0.0, 0.05], [-near, 0.1, 0.0]], 50.0),
        (["b", "a"], [0, 1, 0], [[0.0, near, 0.0], [0.05, -0.1, 0.05]], 35.0),
        (["b", "a"], [1, 1, 0], [[0.1, near, -0.05], [-near, -0.1, 0.0]], 45.0),
        (["a", "a"], [1, 0, 0], [[near, -0.1, 0.0], [-near, -0.1, 0.05]], 25.0),
        (["b", "b"], [0, 1, 0], [[-0.1, near, 0.1], [-0.1, -near, 0.0]], 20.0),
    ] {
        let rest_length = if cell == [0; 3] { 0.2 } else { far };
        lattice = lattice.spring(Link { between, cell, points, law: [stiffness, rest_length, damping] });
    }
    lattice.waves()
}

/// The largest difference of two rows of roots, over the largest.
fn apart(one: &[Complex<f64>], other: &[Complex<f64>]) -> f64 {
    assert_eq!(one.len(), other.len());
    let most = largest(one.iter().map(|root| root.norm()));
    let nearest = |root: &Complex<f64>| other.iter().map(|other| (root - other).norm()).fold(f64::INFINITY, f64::min);
    largest(one.iter().map(nearest)) / most
}

#[test]
fn waves_of_a_sheet_obey_what_all_do() {
    let case = Case { row: None, name: "bands of a taut sheet of two granules, askew", source: "relation" };
    for (damping, names) in [
        (0.0, ["K(−k) = conj K(k)", "κ and κ + (1, −2)", "a seventh and a fifth of the zone", "participations"]),
        (
            0.7,
            [
                "with dashpots: λ(−k) = conj λ(k)",
                "with dashpots: κ and κ + (1, −2)",
                "with dashpots: a seventh and a fifth of the zone",
                "with dashpots: participations",
            ],
        ),
    ] {
        let waves = sheet(damping);
        assert_eq!(waves.rest().unrest, None);
        let found = row(&waves, KAPPA);
        let conjugate: Vec<_> = row(&waves, KAPPA.map(|kappa| -kappa)).roots.iter().map(|root| root.conj()).collect();
        case.check(names[0], 0.0, apart(&found.roots, &conjugate), TOLERANCE);
        let beside = row(&waves, [KAPPA[0] + 1.0, KAPPA[1] - 2.0, 0.0]);
        case.check(names[1], 0.0, apart(&found.roots, &beside.roots), TOLERANCE);
        // Σλ² = tr(C² − 2K), of which a mesh that is finer than the reach of springs has the mean.
        let mean = |count: i32| {
            let kappa = |i: i32, j: i32| [f64::from(i) / f64::from(count), f64::from(j) / f64::from(count), 0.0];
            let sum =
                |i: i32, j: i32| row(&waves, kappa(i, j)).roots.iter().map(|root| root * root).sum::<Complex<f64>>();
            let each = (0..count).flat_map(|i| (0..count).map(move |j| (i, j)));
            each.map(|(i, j)| sum(i, j).re).sum::<f64>() / f64::from(count * count)
        };
        let (seventh, fifth) = (mean(7), mean(5));
        case.by("mean of tr M⁻¹K over the zone").check(names[2], 0.0, (seventh - fifth) / fifth, TOLERANCE);
        let sums = found.branches.iter().map(|branch| branch.participation.iter().sum::<f64>() - 1.0);
        case.by("they sum to one").check(names[3], 0.0, largest(sums), 1e-12);
    }
}

#[test]
fn group_velocities_are_the_slopes_of_frequencies() {
    let case = Case { row: None, name: "bands of a taut sheet of two granules, askew", source: "differences of ω" };
    for (damping, name) in
        [(0.0, "error of the group velocity, over the largest"), (0.7, "the same with dashpots, over the largest")]
    {
        let waves = sheet(damping);
        let found = row(&waves, KAPPA);
        let most = largest(found.branches.iter().filter_map(|branch| Some(branch.velocity?.norm())));
        let step = 1e-4;
        let mut worst: f64 = 0.0;
        for direction in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]] {
            let k = waves.wave_vector(&direction);
            let at = |part: f64| {
                let kappa = std::array::from_fn(|a| KAPPA[a] + part * step * direction[a]);
                frequencies(&waves, kappa)
            };
            let [far_below, below, above, far_above] = [-2.0, -1.0, 1.0, 2.0].map(at);
            for (branch, wave) in found.branches.iter().enumerate() {
                let Some(velocity) = wave.velocity else { continue };
                // Fourth order.
                let near = 8.0 * (above[branch] - below[branch]);
                let slope = (near - far_above[branch] + far_below[branch]) / (12.0 * step);
                worst = worst.max((velocity.dot(&k) - slope).abs() / (most * k.norm()));
            }
        }
        // The rounding of differences: 1e-16 over the step, times frequencies over slopes.
        case.check(name, 0.0, worst, 1e-8);
    }
}

#[test]
fn a_cell_of_three_granules_folds_the_bands_of_one() {
    let case =
        Case { row: None, name: "bands of a cell of three granules, κ = .37", source: "those of one, (κ + j)/3" };
    let chain = LatticeScene::new(&[[1.0, 0.0, 0.0]]).body("a", [0.0; 3], &GRANULE.affine());
    let one = chain.spring(between_faces(["a", "a"], [1, 0, 0])).waves();
    let mut chain = LatticeScene::new(&[[3.0, 0.0, 0.0]]);
    for (n, name) in ["a", "b", "c"].into_iter().enumerate() {
        chain = chain.body(name, [n as f64, 0.0, 0.0], &GRANULE.affine());
    }
    let chain = chain.spring(between_faces(["a", "b"], [0; 3])).spring(between_faces(["b", "c"], [0; 3]));
    let three = chain.spring(between_faces(["c", "a"], [1, 0, 0])).waves();
    let mut folded: Vec<f64> =
        (0..3).flat_map(|j| frequencies(&one, [(0.37 + f64::from(j)) / 3.0, 0.0, 0.0])).collect();
    folded.sort_by(f64::total_cmp);
    let found = frequencies(&three, [0.37, 0.0, 0.0]);
    assert_eq!(found.len(), 36);
    let most = largest(folded.iter().copied());
    let worst = largest(folded.iter().zip(&found).map(|(one, three)| (one - three) / most));
    case.check("largest error, over the largest frequency", 0.0, worst, TOLERANCE);
    // Towards the other side the wave runs the other way.
    let fastest = |kappa: f64| {
        let found = row_towards(&one, [kappa, 0.0, 0.0], [0.3, 0.0, 0.0]).branches;
        let velocities = found.iter().filter_map(|branch| Some(branch.velocity?.x));
        velocities.fold(0.0, |most: f64, velocity| if velocity.abs() > most.abs() { velocity } else { most })
    };
    let (there, back) = (fastest(0.2), fastest(-0.2));
    case.by("v(−k) = −v(k)").check(
        "sum of opposite group velocities, over one",
        0.0,
        (there + back) / there,
        TOLERANCE,
    );
}
