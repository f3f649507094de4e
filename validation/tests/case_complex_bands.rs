//! Waves that die out, long waves, and what grows first under strain, against closed forms.

use crate::lattices::{BETWEEN, GRANULE, LENGTH, LatticeScene, Link, VOLUME, between_faces};
use gyration_sim::modes::bands::{StrainPath, StrainedCell, ZoneMesh};
use gyration_validation::Case;
use nalgebra::{Complex, DMatrix};
use std::f64::consts::{SQRT_2, TAU};

const TOLERANCE: f64 = 1e-10;
const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];

/// cos q of granules that stretch, with their own stiffness κ.
fn cosine(internal: Complex<f64>, omega: f64) -> Complex<f64> {
    let (own, square) = (internal - GRANULE.moment * omega * omega, GRANULE.mass * omega * omega);
    let across = 0.5 * square * BETWEEN * LENGTH * LENGTH;
    (own * (2.0 * BETWEEN - square) - across) / (own * (2.0 * BETWEEN) + across)
}

/// cos(2πκ) of a complex κ.
fn of([re, im]: [f64; 2]) -> Complex<f64> {
    Complex::new(TAU * re, TAU * im).cos()
}

#[test]
fn waves_of_granules_run_or_die_out() {
    let case = Case {
        row: None,
        name: "complex bands of granules that stretch",
        source: "cos q = [(2k − mω²)(κ − jω²) − ½mω²kl²]/[2k(κ − jω²) + ½mω²kl²]",
    };
    let chain = LatticeScene::new(&[X]).body("a", [0.0; 3], &GRANULE.affine());
    let waves = chain.spring(between_faces(["a", "a"], [1, 0, 0])).waves();
    let at = |omega: f64| waves.evanescent(&[0.0; 3], 0, omega).unwrap();
    let internal = Complex::new(GRANULE.stiffness, 0.0);
    let running = at(3.0);
    assert_eq!((running.len(), running[0][1], running[1][1]), (2, 0.0, 0.0));
    let q = cosine(internal, 3.0).re.acos();
    assert!((q - 2.145434).abs() < 1e-6, "{q}");
    case.check("q at ω = 3", q, TAU * running[1][0], TOLERANCE);
    for (omega, decay, re, quantity) in [
        (5.0, 1.638731, 0.5, "decay a cell at ω = 5"),
        (8.0, 2.331164, 0.5, "decay a cell at ω = 8"),
        (12.0, 1.535082, 0.5, "decay a cell at ω = 12"),
        (14.0, 1.754561, 0.0, "decay a cell at ω = 14"),
    ] {
        let cosine = cosine(internal, omega).re;
        let expected = cosine.abs().acosh();
        assert!((expected - decay).abs() < 1e-6, "{expected}");
        let found = at(omega);
        assert!(found.len() == 2 && found.iter().all(|wave| wave[0] == re), "{found:?}");
        case.check(quantity, expected, TAU * found[1][1].abs(), TOLERANCE);
    }
}

#[test]
fn waves_of_granules_that_contract_have_complex_wave_vectors() {
    let case = Case {
        row: None,
        name: "complex bands of granules that feel their stretch, g 300, μ_γ 150",
        source: "as above with κ(λa + b)/(λa + κ), λ = −iω",
    };
    let (drag, gain) = (150.0, 300.0);
    let zero = "[[0, 0, 0], [0, 0, 0], [0, 0, 0]]";
    let kind = format!(
        "contractile = {{ {}, contraction_viscosity = {drag}, drive = {{ constant = {{ value = {zero} }} }}, \
         feedback = {{ measure = {{ stretch = [1, 0, 0] }}, gain = [[{}, 0, 0], [0, 0, 0], [0, 0, 0]], \
         bias = [[{gain}, 0, 0], [0, \
         0, 0], [0, 0, 0]] }} }}",
        GRANULE.material(),
        -gain,
    );
    let chain = LatticeScene::new(&[X]).body("a", [0.0; 3], &GRANULE.table(&kind));
    let waves = chain.spring(between_faces(["a", "a"], [1, 0, 0])).waves();
    let omega = 2.0;
    let root = Complex::new(0.0, -omega * VOLUME * drag);
    let internal = GRANULE.stiffness * (root + VOLUME * gain) / (root + GRANULE.stiffness);
    let found = waves.evanescent(&[0.0; 3], 0, omega).unwrap();
    assert_eq!(found.len(), 2);
    let error = (of(found[0]) - cosine(internal, omega)).norm();
    case.check("error of cos q at ω = 2", 0.0, error, TOLERANCE);
    case.check("sum of both κ, real part", 0.0, found[0][0] + found[1][0], TOLERANCE);
    case.check("sum of both κ, imaginary part", 0.0, found[0][1] + found[1][1], TOLERANCE);
}

#[test]
fn springs_to_second_neighbours_have_two_pairs_of_waves() {
    let case = Case {
        row: None,
        name: "complex bands of a chain with springs to second neighbours",
        source: "mω² = 2k₁(1 − cos q) + 2k₂(1 − cos 2q)",
    };
    let (first, second, mass) = (3.0, 2.0, 1.0);
    let chain = LatticeScene::new(&[X]).point("a", [0.0; 3], mass);
    let chain = chain.spring(Link { law: [first, 1.0, 0.0], ..Link::default() });
    let waves = chain.spring(Link { cell: [2, 0, 0], law: [second, 2.0, 0.0], ..Link::default() }).waves();
    for (omega, quantity) in [(2.0, "error of ω² at ω = 2"), (4.5, "error of ω² at ω = 4.5")] {
        let found = waves.evanescent(&[0.0; 3], 0, omega).unwrap();
        assert_eq!(found.len(), 4, "{found:?}");
        let error = found.iter().map(|wave| {
            let cosine = of(*wave);
            let twice = cosine * cosine * 2.0 - 1.0;
            ((1.0 - cosine) * 2.0 * first + (1.0 - twice) * 2.0 * second - mass * omega * omega).norm()
        });
        case.check(quantity, 0.0, error.fold(0.0, f64::max) / (omega * omega), 1e-9);
    }
}

#[test]
fn waves_of_a_square_lattice_die_out_across_a_given_wave() {
    let case = Case {
        row: None,
        name: "complex bands of taut square springs, κ₂ = .2",
        source: "mω² = 4(k s₁² + T s₂²), 4T(s₁² + s₂²) across, s = sin(q/2)",
    };
    let mut lattice = LatticeScene::new(&[X, Y]).point("a", [0.0; 3], 1.0);
    for cell in [[1, 0, 0], [0, 1, 0]] {
        lattice = lattice.spring(Link { cell, law: [5.0, 0.6, 0.0], ..Link::default() });
    }
    let (waves, omega) = (lattice.waves(), 1.5);
    let found = waves.evanescent(&[0.3, 0.2, 0.0], 0, omega).unwrap();
    let (stiff, taut, across) = (5.0, 2.0, (0.2 * TAU / 2.0).sin().powi(2));
    // Along x, along y, along z.
    let mut expected: Vec<f64> = [(stiff, taut), (taut, stiff), (taut, taut)]
        .into_iter()
        .map(|(own, other)| 1.0 - 2.0 * (omega * omega / 4.0 - other * across) / own)
        .collect();
    expected.sort_by(f64::total_cmp);
    assert_eq!(found.len(), 6);
    let mut cosines: Vec<f64> = found.iter().map(|wave| of(*wave).re).collect();
    cosines.sort_by(f64::total_cmp);
    let error = expected.iter().zip(cosines.chunks(2)).map(|(one, two)| (two[0] - one).abs() + (two[1] - one).abs());
    case.check("error of cos q₁", 0.0, error.fold(0.0, f64::max), TOLERANCE);
}

#[test]
fn long_waves_have_the_speed_of_their_elasticity() {
    let case = Case { row: None, name: "sound in lattices", source: "closed form" };
    let chain = LatticeScene::new(&[X]).body("a", [0.0; 3], &GRANULE.affine());
    let waves = chain.spring(between_faces(["a", "a"], [1, 0, 0])).waves();
    let whole = 1.0 / BETWEEN + LENGTH * LENGTH / GRANULE.stiffness;
    let speed = |found: &[Option<f64>]| found.iter().map(|speed| speed.unwrap()).fold(0.0, f64::max);
    let found = speed(&waves.sound(&[true]).unwrap()[0].speed);
    case.check("granules that stretch [m/s]", (1.0 / (whole * GRANULE.mass)).sqrt(), found, 1e-13);
    let (side, diagonal, mass) = (30.0, 20.0, 2.0);
    let mut square = LatticeScene::new(&[X, Y]).point("a", [0.0; 3], mass);
    for (cell, stiffness, length) in
        [([1, 0, 0], side, 1.0), ([0, 1, 0], side, 1.0), ([1, 1, 0], diagonal, SQRT_2), ([1, -1, 0], diagonal, SQRT_2)]
    {
        square = square.spring(Link { cell, law: [stiffness, length, 0.0], ..Link::default() });
    }
    let found = &square.waves().sound(&[true, true]).unwrap()[0].speed;
    case.check("square lattice, across [m/s]", (diagonal / mass).sqrt(), found[1].unwrap(), 1e-13);
    case.check("square lattice, along [m/s]", ((side + diagonal) / mass).sqrt(), found[2].unwrap(), 1e-13);
}

#[test]
fn a_string_and_a_lattice_lose_their_stability_where_they_must() {
    let case = Case { row: None, name: "lattices under strain", source: "closed form" };
    let unstable = |lattice: &LatticeScene, strain: &str, periodic: &[bool]| {
        let scene = lattice.scene();
        let cell = scene.built().cell.as_ref().unwrap();
        let path = StrainPath::parse(strain).unwrap();
        let cell = StrainedCell::new(&cell.model, &cell.state);
        cell.along(&path, 6, ZoneMesh::usual(periodic)).unwrap().1.unwrap()
    };
    // Below zero by 1e-10 of the stiffest ω² counts.
    let near = 1e-9;
    let string = LatticeScene::new(&[X]).point("a", [0.0; 3], 0.5);
    let string = string.spring(Link { law: [40.0, 0.8, 0.0], ..Link::default() });
    let found = unstable(&string, "xx=0..-0.4", &[true]);
    case.check("string of l₀ = 0.8 a: F_xx at which it buckles", 0.8, found.gradient[(0, 0)], near);
    assert!(found.wave.macroscopic);
    // A taut chain held by springs to space across it: ω² = (4T s² + b a)/(ma) across, least at the edge of the zone.
    let (held, stiffness) = (2.0, 40.0);
    let anchor = format!(
        "shape = {{ points = [{{ mass = 1, at = [0, 0, 0] }}] }}\n\
         spring = [{{ anchor = [0, 0, 0], stiffness = {held:?} \
         }}]"
    );
    let chain = LatticeScene::new(&[X]).body("a", [0.0; 3], &anchor);
    let chain = chain.spring(Link { law: [stiffness, 1.0, 0.0], ..Link::default() });
    let found = unstable(&chain, "xx=0..-0.1", &[true]);
    // −4k(a − l₀)/a = b.
    let expected = 4.0 * stiffness / (4.0 * stiffness + held);
    case.check("chain on springs to space: F_xx at which it zigzags", expected, found.gradient[(0, 0)], near);
    case.check("its wave, κ", 0.5, found.wave.kappa[0].abs(), 1e-6);
    assert!(!found.wave.macroscopic);
}

/// Symptom: of a chain whose second mass was written some cells farther on there were up to six times as many waves.
#[test]
fn waves_do_not_hang_on_the_cells_in_which_bodies_are_written() {
    let case = Case {
        row: None,
        name: "complex bands of a diatomic chain, its masses up to five cells apart",
        source: "(2k − m₁ω²)(2k − m₂ω²) = 2k²(1 + cos q), k = 40 along and 8 across",
    };
    let omega = 3.0;
    let mut error: f64 = 0.0;
    for apart in 0..=5 {
        let chain = LatticeScene::new(&[X]).point("a", [0.0; 3], 1.0);
        let chain = chain.point("b", [0.5 + f64::from(apart), 0.0, 0.0], 2.0);
        let law = [40.0, 0.4, 0.0];
        let chain = chain.spring(Link { between: ["a", "b"], cell: [-apart, 0, 0], law, ..Link::default() });
        let chain = chain.spring(Link { between: ["b", "a"], cell: [1 + apart, 0, 0], law, ..Link::default() });
        let found = chain.waves().evanescent(&[0.0; 3], 0, omega).unwrap();
        assert_eq!(found.len(), 6, "{apart}: {found:?}");
        for wave in found {
            let off = |k: f64| {
                let product = (2.0 * k - omega * omega) * (2.0 * k - 2.0 * omega * omega) / (2.0 * k * k);
                (of(wave) - (product - 1.0)).norm() / (1.0 + product.abs())
            };
            error = error.max(off(40.0).min(off(8.0)));
        }
    }
    case.check("error of cos q", 0.0, error, 1e-9);
}

/// Symptom: where bonds lead on of which the determinant feels only some there were waves with |Im κ| near 5, from
/// roots ζ = 0 and ∞ that rounding parts; two in three frequencies had some.
#[test]
fn waves_are_no_more_than_the_determinant_has() {
    let case = Case {
        row: None,
        name: "complex bands of a chain of three masses, the second bound to the next second one",
        source: "det Q(cos q) = 0, linear in cos q",
    };
    let place = |x: f64| [x, 0.0, 0.0];
    let mut chain = LatticeScene::new(&[[3.0, 0.0, 0.0]]);
    for (name, x, mass) in [("a", 0.0, 1.0), ("b", 1.0, 2.0), ("c", 2.0, 3.0)] {
        chain = chain.point(name, place(x), mass);
    }
    let bonds = [
        (["a", "b"], 0, 36.2, 1.0),
        (["b", "c"], 0, 32.5, 1.0),
        (["c", "a"], 1, 26.9, 1.0),
        (["b", "b"], 1, 25.7, 3.0),
    ];
    for (between, cell, stiffness, length) in bonds {
        chain = chain.spring(Link { between, cell: [cell, 0, 0], law: [stiffness, length, 0.0], ..Link::default() });
    }
    let waves = chain.waves();
    // det Q at cos q = ±1, of a real matrix.
    let determinant = |square: f64, cosine: f64| {
        let [ab, bc, ca, bb] = bonds.map(|bond| bond.2);
        let [a, b, c] = [ab + ca - square, ab + bc + 2.0 * bb * (1.0 - cosine) - 2.0 * square, bc + ca - 3.0 * square];
        a * (b * c - bc * bc) - ab * ab * c - 2.0 * ab * bc * ca * cosine - ca * ca * b
    };
    let mut error: f64 = 0.0;
    for look in 0..86 {
        let omega = 0.5 + 0.1 * f64::from(look);
        let [ahead, behind] = [1.0, -1.0].map(|cosine| determinant(omega * omega, cosine));
        let expected = -(ahead + behind) / (ahead - behind);
        let found = waves.evanescent(&[0.0; 3], 0, omega).unwrap();
        assert_eq!(found.len(), 2, "ω = {omega}: {found:?}");
        error = found.iter().map(|wave| (of(*wave) - expected).norm() / (1.0 + expected.abs())).fold(error, f64::max);
    }
    case.check("error of cos q at 86 frequencies", 0.0, error, 1e-9);
}

/// Symptom: three waves with |Im κ| near 5, from roots ζ = 0 and ∞.
#[test]
fn a_resonator_at_its_own_frequency_lets_no_wave_through() {
    let case = Case {
        row: None,
        name: "complex bands of a chain with resonators, written one cell on, at their own frequency",
        source: "(2k(1 − cos q) + k′ − mω²)(k′ − m′ω²) = k′², ω² = k′/m′: no κ",
    };
    let chain = LatticeScene::new(&[X]).point("a", [0.0; 3], 1.0).point("b", [0.5, 0.0, 0.0], 2.0);
    let chain = chain.spring(Link { law: [10.0, 1.0, 0.0], ..Link::default() });
    let hung = Link { between: ["b", "a"], cell: [1, 0, 0], law: [40.0, 0.5, 0.0], ..Link::default() };
    let found = chain.spring(hung).waves().evanescent(&[0.0; 3], 0, 20.0_f64.sqrt()).unwrap();
    case.check("waves", 0.0, found.len() as f64, 0.5);
    // Nor do masses that nothing joins.
    let free = LatticeScene::new(&[X]).point("a", [0.0; 3], 1.0).waves();
    assert!([0.0, 1.0].iter().all(|omega| free.evanescent(&[0.0; 3], 0, *omega).unwrap().is_empty()));
}

/// Symptom: the iteration did not end where each wave is threefold, and all other frequencies were lost with one.
#[test]
fn threefold_waves_of_a_taut_chain_are_found() {
    let case = Case {
        row: None,
        name: "complex bands of a taut chain with springs to second neighbours, each threefold",
        source: "mω² = 2k₁(1 − cos q) + 2k₂(1 − cos 2q)",
    };
    let mut error: f64 = 0.0;
    for second in [55.0, 20.0, 1.0] {
        let chain = LatticeScene::new(&[X]).point("a", [0.0; 3], 1.0);
        let chain = chain.spring(Link { law: [10.0, 0.0, 0.0], ..Link::default() });
        let waves = chain.spring(Link { cell: [2, 0, 0], law: [second, 0.0, 0.0], ..Link::default() }).waves();
        for omega in [2.295813581282244, 0.5, 7.0, 25.0] {
            let found = waves.evanescent(&[0.0; 3], 0, omega).unwrap();
            assert_eq!(found.len(), 12, "{second}, {omega}: {found:?}");
            for wave in found {
                let cosine = of(wave);
                let twice = cosine * cosine * 2.0 - 1.0;
                let left = (1.0 - cosine) * 20.0 + (1.0 - twice) * 2.0 * second - omega * omega;
                error = error.max(left.norm() / (omega * omega));
            }
        }
    }
    case.check("error of ω²", 0.0, error, 1e-7);
}

/// Symptom: of waves that die out by e^−14 a cell, as far above the frequencies of the chain, half were lost and the
/// others wrong, since roots that are small were taken for zero.
#[test]
fn waves_that_die_out_at_once_are_told_from_none() {
    let case = Case {
        row: None,
        name: "complex bands of a chain of four masses, far above its frequencies",
        source: "det Q = 0, quadratic in cos q",
    };
    let places = [0.0, 0.25, 0.5, 0.75];
    let mut chain = LatticeScene::new(&[X]);
    let names = ["a", "b", "c", "d"];
    for (body, name) in names.into_iter().enumerate() {
        chain = chain.point(name, [places[body], 0.0, 0.0], 1.0 + body as f64);
    }
    let bonds = [(0, 1, 0), (1, 2, 0), (2, 3, 0), (3, 0, 1), (3, 0, 2)];
    for (one, other, cell) in bonds {
        let length = f64::from(cell) + places[other] - places[one];
        let between = [names[one], names[other]];
        chain = chain.spring(Link { between, cell: [cell, 0, 0], law: [1.0, length, 0.0], ..Link::default() });
    }
    let waves = chain.waves();
    let determinant = |square: f64, q: f64| {
        let mut matrix =
            DMatrix::from_fn(4, 4, |i, j| Complex::from(if i == j { -(1.0 + i as f64) * square } else { 0.0 }));
        for (one, other, cell) in bonds {
            let phase = Complex::new(0.0, f64::from(cell) * q).exp();
            matrix[(one, one)] += 1.0;
            matrix[(other, other)] += 1.0;
            matrix[(one, other)] -= phase;
            matrix[(other, one)] -= phase.conj();
        }
        matrix.determinant().re
    };
    let mut error: f64 = 0.0;
    for omega in [3.0, 10.0, 15.0, 20.0, 25.0] {
        let [ahead, across, behind] = [0.0, 0.25, 0.5].map(|kappa| determinant(omega * omega, TAU * kappa));
        // a cos²q + b cos q + c.
        let (a, b) = (0.5 * (ahead + behind) - across, 0.5 * (ahead - behind));
        let root = Complex::from(b * b - 4.0 * a * across).sqrt();
        let expected = [(-b + root) / (2.0 * a), (-b - root) / (2.0 * a)];
        let found = waves.evanescent(&[0.0; 3], 0, omega).unwrap();
        assert_eq!(found.len(), 4, "ω = {omega}: {found:?}");
        for wave in found {
            let off = expected.map(|expected| (of(wave) - expected).norm() / (1.0 + expected.norm()));
            error = error.max(off[0].min(off[1]));
        }
    }
    // Of roots ζ of 5e-7 rounding leaves three digits.
    case.check("error of cos q at five frequencies", 0.0, error, 2e-3);
}
