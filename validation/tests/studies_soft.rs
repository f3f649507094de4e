//! The ready studies of bodies that deform, some of their runs: `crawl-map`, `shear-map`.
//!
//!   half a period later in length and height is the mirror image: the distance changes its sign
//!   the form goes round below the boundary of tumbling and trembling (theory-fluid: roots of the passage), and not above

use gyration_validation::{Answer, Studied, largest};

#[test]
fn crawler_goes_back_as_far_half_a_period_later() {
    let study = Studied::ready("crawl-map");
    let heights = study.axes()[1];
    // Phases of 0, 90, 180 and 270 degrees.
    let runs: Vec<u64> = (0..16).map(|k| 9 * (k / 4) * heights + 9 * (k % 4)).collect();
    let ends = Studied::new(&study, &runs).lists("distance");
    let distance: Vec<f64> = ends.iter().map(|ends| ends[1] - ends[0]).collect();
    println!("distance a period [mm]: {:.3?}", distance.iter().map(|x| 1e3 * x).collect::<Vec<_>>());
    let most = largest(distance.iter().copied());
    let mirror = |k: usize| 4 * ((k / 4 + 2) % 4) + (k % 4 + 2) % 4;
    Answer {
        row: None,
        case: "study crawl-map, 16 pairs of phases, the third period",
        quantity: "distance and that of half a period later, sum over the largest",
        reference: 0.0,
        measured: largest((0..16).map(|k| (distance[k] + distance[mirror(k)]) / most)),
        // What is left of the drop at the start after two periods; G is not its own mirror image at any instant.
        tolerance: 1e-3,
        source: "symmetry of the block",
    }
    .check();
    // Length a quarter of a period before the shear, height as far after it: the stroke of `crawl`.
    assert!((distance[7] - 0.01595).abs() < 1e-5, "{}", distance[7]);
}

#[test]
fn form_goes_round_below_the_boundary_only() {
    let study = Studied::ready("shear-map");
    let reference = &study.plot()["reference"][0]["points"];
    let points: Vec<[f64; 2]> = serde_json::from_value(reference.clone()).unwrap_or_else(|error| panic!("{error}"));
    let boundary = |axis: f64| {
        let right = points.iter().position(|point| point[0] >= axis).unwrap_or(points.len() - 1).max(1);
        let ([a, low], [b, high]) = (points[right - 1], points[right]);
        low + (axis - a) / (b - a) * (high - low)
    };
    // Aspect ratios 1.5, 2, 3, 4 and every third G.
    let count = study.axes()[1];
    let runs: Vec<u64> =
        [3, 6, 12, 18].iter().flat_map(|a| (1..count).step_by(3).map(move |g| a * count + g)).collect();
    let studied = Studied::new(&study, &runs);
    let [axis, capillary, form, matter] = ["axis", "G", "form", "matter"].map(|name| studied.numbers(name));
    let (mut checked, mut nearest) = (0, f64::MAX);
    for k in 0..runs.len() {
        let ratio = capillary[k] / boundary(axis[k]);
        // The boundary is interpolated between points, and a start beside the long motion counts as its first turn.
        if (0.95..1.05).contains(&ratio) {
            continue;
        }
        let tumbles = (form[k] / matter[k]).abs() > 0.6;
        let turns = (form[k], matter[k]);
        assert_eq!(tumbles, ratio < 1.0, "{} mm, G = {}: turns {turns:?}", 1e3 * axis[k], capillary[k]);
        checked += 1;
        nearest = nearest.min((ratio - 1.0).abs());
    }
    println!("{checked} particles on their side of the boundary, the nearest {:.1} % beside it", 1e2 * nearest);
    assert!(checked > 20);
}
