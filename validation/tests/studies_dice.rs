//! The ready studies of dice, some of their runs: `dice-fairness`, `cuboid-dice`, `dice-basin`.
//!
//!   a cube, any attitude and spin: each face 1/6 by symmetry, whatever the damping
//!   two counts of n and m runs differ by z standard deviations, z = (p − q)/√(p(1 − p)/n + q(1 − q)/m)

use gyration_study::Study;
use gyration_validation::{Answer, Studied};
use std::path::Path;

/// χ² of five degrees of freedom is above this with the probability 0.001.
const CHI_SQUARE_LIMIT: f64 = 20.515;
/// A deviation of as many standard deviations has the probability 0.001.
const DEVIATIONS: f64 = 3.29;
/// Hand throws of square cuboids, N = 275 to 1011 each: height over side, share of the square faces.
const HAND_THROWS: [(f64, f64); 5] = [(0.63, 0.738), (0.81, 0.496), (0.97, 0.385), (1.23, 0.154), (1.55, 0.040)];

/// The first `count` repetitions of a point of the grid.
fn first(study: &Study, point: u64, count: u64) -> Vec<u64> {
    (0..count).map(|k| point * study.repetitions() + k).collect()
}

/// The study with errors ten times smaller.
fn finer(name: &str, text: &str) -> Study {
    let text = text.replace("\"solver.rtol\" = 1e-4", "\"solver.rtol\" = 1e-5");
    let text = text.replace("\"solver.atol\" = 1e-6", "\"solver.atol\" = 1e-7");
    assert!(text.contains("1e-5"), "{name} has another rtol");
    Study::parse(name, &text, Path::new(""), &[]).unwrap_or_else(|errors| panic!("{errors}"))
}

fn deviations((p, n): (f64, usize), (q, m): (f64, usize)) -> f64 {
    (q - p) / (p * (1.0 - p) / n as f64 + q * (1.0 - q) / m as f64).sqrt()
}

#[test]
fn cube_is_fair_and_favours_its_lowest_face_the_more_the_stronger_the_damping() {
    const THROWS: usize = 400;
    let study = Studied::ready("dice-fairness");
    let of_point = |point: u64| Studied::new(&study, &first(&study, point, THROWS as u64));
    let (weak, strong) = (of_point(0), of_point(study.points() - 1));
    let mut counts = [0_usize; 6];
    for face in [weak.words("face"), strong.words("face")].concat() {
        let index = ["+x", "-x", "+y", "-y", "+z", "-z"].iter().position(|known| *known == face);
        counts[index.unwrap_or_else(|| panic!("{face}"))] += 1;
    }
    let expected = 2.0 * THROWS as f64 / 6.0;
    let chi_square = counts.iter().map(|count| (*count as f64 - expected).powi(2) / expected).sum();
    println!("800 throws of dice-fairness: {counts:?}");
    Answer {
        row: Some(23),
        case: "study dice-fairness, 400 throws each of the weakest and of the strongest damping",
        quantity: "χ² of the faces, five degrees of freedom",
        reference: 5.0,
        measured: chi_square,
        tolerance: CHI_SQUARE_LIMIT / 5.0 - 1.0,
        source: "symmetry of the cube: the expectation of χ² is 5",
    }
    .check();
    let kept = |runs: &Studied| {
        let (face, first) = (runs.words("face"), runs.words("first"));
        runs.share(|run| face[run] == first[run])
    };
    let (weak, strong) = (kept(&weak), kept(&strong));
    let z = deviations((weak, THROWS), (strong, THROWS));
    println!("the face that was lowest comes down with b = 0.005: {weak:.3}, with b = 0.04: {strong:.3}, z = {z:.1}");
    assert!(z > DEVIATIONS && strong > 1.0 / 6.0);
}

#[test]
fn throws_of_dice_fairness_have_converged() {
    let study = Studied::ready("dice-fairness");
    let finer = finer("dice-fairness.toml", include_str!("../../studies/dice-fairness.toml"));
    let runs: Vec<u64> = (0..study.points()).flat_map(|point| first(&study, point, 50)).collect();
    let faces = [&study, &finer].map(|study| Studied::new(study, &runs).words("face"));
    let changed = faces[0].iter().zip(&faces[1]).filter(|(a, b)| a != b).count();
    Answer {
        row: None,
        case: "study dice-fairness, 200 throws, rtol a tenth as large",
        quantity: "share of the faces that change",
        reference: 0.0,
        measured: changed as f64 / runs.len() as f64,
        tolerance: 0.0101,
        source: "at most 1 of 100 may change",
    }
    .check();
}

#[test]
fn square_faces_are_the_rarer_the_higher_the_cuboid() {
    const THROWS: usize = 250;
    let study = Studied::ready("cuboid-dice");
    // The heights 0.63, 1 and 1.55 of the side, with the strongest damping.
    let [heights, dampings] = [study.axes()[0], study.axes()[1]];
    let share = |height: u64| {
        let runs = Studied::new(&study, &first(&study, height * dampings + dampings - 1, THROWS as u64));
        let faces = runs.words("face");
        (runs.numbers("height")[0] / 0.02, runs.share(|run| faces[run].ends_with('z')))
    };
    let shares = [0, 3, heights - 1].map(share);
    for (ratio, share) in shares {
        let known = HAND_THROWS.iter().find(|(known, _)| (known - ratio).abs() < 1e-9);
        println!("height over side {ratio:.2}: square faces {share:.3}, by hand {:?}", known.map(|(_, share)| share));
    }
    for pair in shares.windows(2) {
        assert!(deviations((pair[1].1, THROWS), (pair[0].1, THROWS)) > DEVIATIONS, "{pair:?}");
    }
    let third = 1.0 / 3.0;
    Answer {
        row: None,
        case: "study cuboid-dice, 250 throws of the cube, strongest damping",
        quantity: "share of two opposite faces",
        reference: third,
        measured: shares[1].1,
        tolerance: DEVIATIONS * (third * (1.0 - third) / THROWS as f64).sqrt() / third,
        source: "symmetry of the cube",
    }
    .check();
}

#[test]
fn basin_has_patches_that_do_not_depend_on_the_tolerance() {
    let study = Studied::ready("dice-basin");
    let finer = finer("dice-basin.toml", include_str!("../../studies/dice-basin.toml"));
    // Twelve spins from 25.2 to 28.7 rad/s, eight heights from 16.7 to 18.2 cm.
    let heights = study.axes()[1];
    let runs: Vec<u64> = (80..92).flat_map(|spin| (32..40).map(move |height| spin * heights + height)).collect();
    let [faces, others] = [&study, &finer].map(|study| Studied::new(study, &runs).words("face"));
    let same = (8..runs.len()).filter(|run| faces[*run] == faces[run - 8]).count() as f64 / (runs.len() - 8) as f64;
    println!("neighbours in spin with the same face: {same:.3} (1/6 by chance)");
    assert!(same > 0.8);
    let changed = faces.iter().zip(&others).filter(|(a, b)| a != b).count();
    Answer {
        row: None,
        case: "study dice-basin, 96 neighbouring throws, rtol a tenth as large",
        quantity: "share of the faces that change",
        reference: 0.0,
        measured: changed as f64 / runs.len() as f64,
        tolerance: 0.011,
        source: "one of 96",
    }
    .check();
}
