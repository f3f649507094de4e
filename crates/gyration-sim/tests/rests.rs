//! The way to rest: past the reach of others, not through them, and never to an end where forces are left.

use crate::islands::parsed;
use gyration_sim::survey::modes;

const LAWS: &str = "repulsion = { alpha = 100, nu = 6, d0 = 0.001 }, damping = { beta = 3000, nu = 6, d0 = 0.001 }";

/// Where the bodies rest, each [x, y, z], or why they do not.
fn rests(text: &str) -> Result<Vec<[f64; 3]>, String> {
    let found = modes(&parsed(text, &[]));
    let Some(system) = found.systems.first() else {
        let [body] = &found.bodies[..] else { panic!("{} bodies alone", found.bodies.len()) };
        let reason = || body.no_rest_state_because.clone().unwrap_or_default();
        return body.rest_state.as_ref().map(|rest| vec![rest.place.position]).ok_or_else(reason);
    };
    let reason = || system.no_rest_state_because.clone().unwrap_or_default();
    let rest = system.rest_state.as_ref().ok_or_else(reason)?;
    Ok(rest.bodies.0.iter().map(|(_, place)| place.position).collect())
}

fn cube(name: &str, z: f64) -> String {
    format!(
        "[[body]]\nname = \"{name}\"\ngroup = \"cubes\"\ndensity = 1000\nposition = [0, 0, {z}]\n\
         shape = {{ box = {{ size = [0.1, 0.1, 0.1] }} }}\n"
    )
}

#[test]
fn a_cube_comes_down_on_one_that_it_does_not_yet_feel() {
    let scene = |reach: &str| {
        format!(
            "time = {{ end = 1, sample = 1 }}\nsupport = [{{ name = \"floor\", plane = {{}} }}]\n\
             contact = [{{ support = \"floor\", {LAWS} }}, {{ between = [\"cubes\", \"cubes\"], {LAWS}{reach} }}]\n{}{}",
            cube("a", 0.1),
            cube("b", 0.35)
        )
    };
    let endless = rests(&scene("")).unwrap();
    for reach in [0.01, 0.02, 0.1] {
        let found = rests(&scene(&format!(", reach = {reach}"))).unwrap();
        let off = (found[1][2] - endless[1][2]).abs();
        println!("reach {reach}: off by {off:e} m");
        // Of the energy at a gap of 0.6 mm a reach of 10 mm takes what goes with (0.6/10)⁵.
        assert!(off < 1e-7 && (found[1][2] - 0.15129).abs() < 1e-5, "{found:?}");
    }
}

#[test]
fn no_body_falls_through_a_shelf() {
    for z in [1.2, 1.5, 3.0, 10.0] {
        let scene = format!(
            "time = {{ end = 1, sample = 1 }}\n[[support]]\nname = \"floor\"\nplane = {{}}\n[[support]]\nname = \
             \"shelf\"\nshape = {{ box = {{ size = [0.4, 0.4, 0.01] }} }}\nposition = [0, 0, 1]\n[[contact]]\nsupport \
             = \"floor\"\n{}\n[[contact]]\nbetween = [\"cubes\", \"shelf\"]\n{}\n{}",
            LAWS.replace("}, ", "}\n"),
            LAWS.replace("}, ", "}\n"),
            cube("a", z)
        );
        let found = rests(&scene).unwrap();
        // On the shelf, half a cube and a gap above its face.
        assert!((found[0][2] - 1.05576).abs() < 1e-4, "from {z} m: {found:?}");
    }
}

#[test]
fn a_plate_on_a_spring_lifts_what_lies_on_it() {
    for anchor in [0.1, 0.3, 1.0] {
        let scene = format!(
            "time = {{ end = 1, sample = 1 }}\nworld = {{ gravity = [0, 0, -10] }}\n[[contact]]\nbetween = [\"plate\", \
             \"cube\"]\nrepulsion = {{ alpha = 100, nu = 6, d0 = 0.001 }}\n[[body]]\nname = \"plate\"\ndensity = 1000\n\
             shape = {{ box = {{ size = [0.5, 0.5, 0.1] }} }}\nspring = [{{ anchor = [0, 0, {anchor}], stiffness = 1e4 \
             }}]\n{}",
            cube("cube", 0.15)
        );
        let found = rests(&scene).unwrap();
        let expected = anchor - 26.0 * 10.0 / 1e4;
        println!("anchor {anchor}: plate at {} for {expected}", found[0][2]);
        assert!((found[0][2] - expected).abs() < 1e-9, "{found:?}");
        assert!(found[1][2] > found[0][2] + 0.1 && found[1][2] < found[0][2] + 0.102, "{found:?}");
    }
}

#[test]
fn an_edge_of_the_model_is_no_rest() {
    // A force of −1 N everywhere, as far as the energy has a value.
    let reason = rests(
        "world = { gravity = [0, 0, 0] }\ntime = { end = 1, sample = 0.1 }\n[[body]]\nname = \"a\"\ndensity = 1000\n\
         shape = { sphere = { radius = 0.1 } }\npotential = \"x + 0.001*sqrt(1 + x)^3\"\n",
    );
    assert!(reason.as_ref().is_err_and(|reason| reason.contains("ends where the model does")), "{reason:?}");
    // Two balls of a cell that a spring draws towards each other, farther than the images that are listed.
    let reason = rests(
        "world = { gravity = [0, 0, 0] }\ntime = { end = 1, sample = 1 }\nlattice = { cell = [[0.4, 0, 0]] }\n\
         [[body]]\nname = \"a\"\ndensity = 1000\nshape = { sphere = { radius = 0.03 } }\n[[body]]\nname = \"b\"\n\
         density = 1000\nposition = [0.1, 0, 0]\nshape = { sphere = { radius = 0.03 } }\n[[contact]]\n\
         between = [\"a\", \"b\"]\nrepulsion = { alpha = 20, nu = 6, d0 = 0.01 }\nreach = 0.1\n[[spring]]\n\
         between = [\"b\", \"a\"]\ncell = [1, 0, 0]\nstiffness = 40\n",
    );
    assert!(reason.as_ref().is_err_and(|reason| reason.contains("ends where the model does")), "{reason:?}");
}
