//! Mass points: the way to their rest, and small motions about a place that they share.

use gyration_scene::Scene;
use gyration_sim::modes::{Mode, ModeBehaviour, rest, system_modes, system_rest};
use std::path::Path;

/// A scene of mass points that nothing pulls at but what it says.
fn points(text: &str) -> Scene {
    let text = format!("world = {{ gravity = [0, 0, 0] }}\ntime = {{ end = 1, sample = 1 }}\n{text}");
    Scene::parse("scene.toml", &text, Path::new(""), &[]).unwrap()
}

/// V = −cos 3x + x²/20 has valleys at 0 and 2.0714 and a hill at 3.1 beyond. Symptom: from 2.9 the search went over the
/// hill to 4.1426, from 3.05 to 0, and to −4.14 where valleys were a hundredth of the body.
#[test]
fn the_way_to_rest_leads_over_no_hill() {
    let starts = [(2.9, 2.0714), (3.05, 2.0714), (0.6, 0.0), (1.1, 2.0714), (-2.9, -2.0714)];
    // Valleys as wide as the body is large, and parts of it.
    for (unit, (from, to)) in [1.0_f64, 0.1, 0.01, 0.001].into_iter().flat_map(|unit| starts.map(|start| (unit, start)))
    {
        let scene = points(&format!(
            "[[body]]\nname = \"p\"\nshape = {{ points = [{{ mass = 1, at = [0, 0, 0] }}] }}\n\
             position = [{:?}, 0, 0]\npotential = \"-cos({}*x) + {}*x^2 + {}*(y^2 + z^2)\"\n",
            from * unit,
            3.0 / unit,
            0.05 / unit.powi(2),
            unit.powi(-2)
        ));
        let found = rest(&scene.built().model, &scene.built().state, 0).unwrap_or_else(|error| panic!("{error}"));
        let place = found.placement.position.x / unit;
        assert!((place - to).abs() < 1e-3, "{unit}: from {from} to {place} in the place of {to}");
    }
}

/// A well that is wide, with a narrow valley or hill on the way down it. Symptom: the way to rest led through both.
#[test]
fn narrow_valleys_and_hills_within_a_wide_well_are_seen() {
    for (start, potential, to) in
        [(1.0, "0.5*x^2 - 2*exp(-((x-0.5)/0.01)^2)", 0.499_987_5), (1.2, "0.1*x^2 + 0.5*exp(-((x-0.6)/0.01)^2)", 0.628)]
    {
        let scene = points(&format!(
            "[[body]]\nname = \"b\"\nshape = {{ sphere = {{ radius = 0.05 }} }}\nmass = 1\n\
             position = [{start:?}, 0, 0]\npotential = \"{potential} + 5*(y^2+z^2)\"\n"
        ));
        let found = rest(&scene.built().model, &scene.built().state, 0).unwrap_or_else(|error| panic!("{error}"));
        let place = found.placement.position.x;
        println!("{potential}: rests at {place}");
        assert!((place - to).abs() < 1e-3, "{potential}: {place} in the place of {to}");
    }
}

/// Four atoms of Lennard-Jones: the tetrahedron of side 2^(1/6). Symptom: one of them came to rest 70 m away.
#[test]
fn atoms_that_begin_too_near_come_to_their_cluster() {
    let places = [[-0.3, 1.2, -0.7], [0.8, -0.9, -0.1], [-1.4, -1.3, -0.2], [-0.4, 0.4, -0.9]];
    let body = |(k, place): (usize, &[f64; 3])| {
        format!(
            "[[body]]\nname = \"b{k}\"\nshape = {{ points = [{{ mass = 1, at = [0, 0, 0] }}] }}\n\
             position = {place:?}\n"
        )
    };
    let bodies: String = places.iter().enumerate().map(body).collect();
    let pairs = (0..4).flat_map(|one| (one + 1..4).map(move |other| (one, other)));
    let bonds: String = pairs
        .clone()
        .map(|(one, other)| format!("[[bond]]\nbetween = [\"b{one}\", \"b{other}\"]\nlaw = \"4*(l^-12 - l^-6)\"\n"))
        .collect();
    let scene = points(&(bodies + &bonds));
    let found = system_rest(&scene.built().model, &scene.built().state, &[0, 1, 2, 3]).unwrap();
    for (one, other) in pairs {
        let side = (found[one].placement.position - found[other].placement.position).norm();
        assert!((side - 2.0_f64.powf(1.0 / 6.0)).abs() < 1e-9, "{one}, {other}: {side}");
    }
}

/// Masses at one place on a spring with a dashpot: δ = c/m, ω² = 2k/m − δ². Symptom: a dashpot without a direction was
/// none.
#[test]
fn a_dashpot_between_points_at_one_place_damps() {
    let body =
        |name: &str| format!("[[body]]\nname = \"{name}\"\nshape = {{ points = [{{ mass = 1, at = [0, 0, 0] }}] }}\n");
    let between = "between = [\"a\", \"b\"]\n";
    let scene = points(&format!(
        "{}{}[[spring]]\n{between}stiffness = 50\n[[bond]]\n{between}damping = 0.9\n",
        body("a"),
        body("b")
    ));
    let (model, start) = (&scene.built().model, &scene.built().state);
    let rests = system_rest(model, start, &[0, 1]).unwrap();
    let found = system_modes(model, start, &[0, 1], &rests).unwrap();
    let swinging: Vec<&Mode> = found.iter().filter(|mode| mode.motion == ModeBehaviour::Oscillates).collect();
    assert_eq!(swinging.len(), 3);
    for mode in swinging {
        let (decay, frequency) = (mode.decay_rates()[0], mode.frequency());
        println!("decay {decay}, frequency {frequency}");
        assert!((decay - 0.9).abs() < 1e-12 && (frequency - (100.0_f64 - 0.81).sqrt()).abs() < 1e-11);
    }
}
