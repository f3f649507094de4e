//! Which pairs are listed leaves no trace: a list that is kept while bodies move little, one made at this place, and
//! the law without a reach, to which all pairs belong.
//!
//! Crowds of more bodies than are listed whole: balls and boxes of several sizes, one soft, in two contacts.

use crate::islands::parsed;
use gyration::balance::gaps;
use gyration::dynamics::Workspace;
use gyration::model::Model;
use gyration::state::State;
use gyration_ode::{BlockMatrix, System};
use gyration_scene::Scene;
use gyration_sim::adapter::{ModelSystem, Tolerance};
use gyration_sim::{FirstSteps, Job, Provenance};

const LAWS: &str = "repulsion = { alpha = 50, nu = 6, d0 = 0.01 }\ndamping = { beta = 20, nu = 6, d0 = 0.01 }\n";

/// A crowd on a skewed grid, so many bodies each way, with some places empty.
fn crowd(size: usize, spacing: f64, reach: &str, is_soft: bool) -> Scene {
    let between = |one: &str, other: &str| format!("[[contact]]\nbetween = [\"{one}\", \"{other}\"]\n{reach}\n{LAWS}");
    let mut text = format!(
        "time = {{ end = 1, sample = 0.5 }}\nworld = {{ gravity = [0, 0, -1] }}\nsolver = {{ rtol = 1e-6 }}\n{}{}",
        between("all", "all"),
        between("box", "ball")
    );
    let part = |k: usize, step: f64| (k as f64 * step).fract() - 0.5;
    for k in (0..size * size * size).filter(|k| k % 11 != 3) {
        let place = [k % size, k / size % size, k / size / size].map(|n| n as f64 * spacing);
        let place = [0, 1, 2].map(|axis| place[axis] + 0.15 * spacing * part(k + 1, [0.8191, 0.6710, 0.5497][axis]));
        let speed = [0.3181, 0.1711, 0.7497].map(|step| 2.0 * spacing * part(k + 1, step));
        let (word, shape) = match k % 3 {
            0 => ("box", "box = { size = [0.5, 0.4, 0.3] }"),
            1 => ("ball", "sphere = { radius = 0.3 }"),
            _ => ("ball", "sphere = { radius = 0.15 }"),
        };
        let soft = if is_soft && k == 4 {
            "affine = { material = { mooney_rivlin = { c1 = \"3 kPa\", c2 = \"1 kPa\" } } }"
        } else {
            ""
        };
        text += &format!(
            "[[body]]\nname = \"b{k}\"\ngroup = [\"all\", \"{word}\"]\nshape = {{ {shape} }}\ndensity = 10\n{soft}\n\
             position = {place:?}\nvelocity = {speed:?}\n\
             orientation = {{ axis_angle = {{ axis = [1, 2, {k}], angle = 0.1 }} }}\n"
        );
    }
    parsed(&text, &[])
}

/// Rates, powers, all numbers of the Jacobian and the slabs within reach.
fn computed(system: &mut ModelSystem, time: f64, state: &[f64]) -> [Vec<u64>; 4] {
    let (mut slopes, mut powers) = (vec![0.0; system.dimension()], vec![0.0; system.quadratures()]);
    system.rates(time, state, &mut slopes, &mut powers).unwrap();
    let mut blocks = BlockMatrix::new(system.blocks());
    system.jacobian(time, state, &mut blocks).unwrap();
    let count = system.model().bodies.len();
    let of_row = |row: usize| blocks.row(row).flat_map(|(_, block)| block.iter().copied()).collect::<Vec<_>>();
    let blocks = blocks.diagonal().iter().flat_map(|block| block.iter().copied()).chain((0..count).flat_map(of_row));
    let blocks = blocks.map(f64::to_bits).collect();
    let (model, workspace) = system.observed();
    let gaps = workspace.pair_gaps(model, time, state.into()).unwrap();
    let near = gaps.iter().map(|(_, slab)| slab.gap).filter(|gap| gap.is_finite()).map(f64::to_bits).collect();
    let bits = |numbers: Vec<f64>| numbers.into_iter().map(f64::to_bits).collect();
    [bits(slopes), bits(powers), blocks, near]
}

fn system(model: &Model, start: &State) -> ModelSystem {
    ModelSystem::new(model.clone(), start, Tolerance { rtol: 1e-6, atol: 1e-9 }).unwrap()
}

/// The bodies of a scene some way on: out from where they start and back, each at its own pace.
fn drifted(model: &Model, start: &State, pace: f64) -> Vec<f64> {
    let mut state = start.bodies.clone();
    for index in 0..model.bodies.len() {
        let way = (pace + index as f64).sin() - (index as f64).sin();
        let place = model.slots(index).position();
        let speed = start.motion(model, index).velocity.velocity;
        (0..3).for_each(|axis| state[place.start + axis] += 0.12 * way * speed[axis]);
    }
    state
}

/// Three times as far apart: nobody is within reach of another, and no list holds.
fn scattered(model: &Model, state: &[f64]) -> Vec<f64> {
    let mut state = state.to_vec();
    (0..model.bodies.len()).for_each(|index| state[model.slots(index).position()].iter_mut().for_each(|x| *x *= 3.0));
    state
}

fn assert_same(found: &[Vec<u64>; 4], other: &[Vec<u64>; 4], what: &str) {
    for (name, (one, other)) in ["rates", "powers", "Jacobian", "gaps"].iter().zip(found.iter().zip(other)) {
        let differ = one.iter().zip(other).filter(|(one, other)| one != other).count();
        assert!(one == other, "{what}: {differ} of {} {name} differ", one.len());
    }
}

/// The bodies drift for a while; the list is made anew some times, and kept in between.
#[test]
fn a_list_that_is_kept_gives_what_one_made_here_gives() {
    for is_soft in [false, true] {
        let scene = crowd(3, 0.95, "reach = 0.35", is_soft);
        let (model, start) = (&scene.built().model, &scene.built().state);
        assert!(model.count_pairs()[0] > 300);
        let mut kept = system(model, start);
        let mut near = Vec::new();
        for k in 0..24 {
            let state = drifted(model, start, 0.4 * f64::from(k));
            let found = computed(&mut kept, 0.0, &state);
            near.push(found[3].len());
            assert_same(
                &found,
                &computed(&mut system(model, start), 0.0, &state),
                &format!("soft {is_soft}, state {k}"),
            );
        }
        println!("soft {is_soft}: {near:?} pairs within reach");
        assert!(near.iter().any(|count| *count != near[0]));
    }
}

/// Planes are looked for from where they were remembered, though pairs have left the list and come back meanwhile, as
/// in a step that was too long.
#[test]
fn what_is_remembered_of_a_pair_outlasts_the_list() {
    let scene = crowd(3, 0.95, "reach = 0.35", false);
    let (model, start) = (&scene.built().model, &scene.built().state);
    let mut kept = system(model, start);
    for k in 0..12 {
        let state = drifted(model, start, 0.4 * f64::from(k));
        let later = drifted(model, start, 0.4 * f64::from(k) + 0.05);
        let mut fresh = system(model, start);
        for system in [&mut kept, &mut fresh] {
            let (model, workspace) = system.observed();
            workspace.remember_pairs(model, 0.0, state.as_slice().into()).unwrap();
        }
        computed(&mut kept, 1e-3, &scattered(model, &state));
        assert_same(&computed(&mut kept, 1e-3, &later), &computed(&mut fresh, 1e-3, &later), &format!("state {k}"));
    }
}

/// A plane between two bodies is where it is without a reach; so is the slab along it, however far they are.
#[test]
fn the_smallest_gap_is_that_of_the_law_without_a_reach() {
    for spacing in [0.7, 2.3] {
        let found = |reach: &str| {
            let scene = crowd(4, spacing, reach, false);
            gaps(&scene.built().model, &mut Workspace::default(), &scene.built().state).unwrap()
        };
        let (near, all) = (found("reach = 0.08"), found(""));
        let off = near.iter().zip(&all).map(|(one, other)| (one / other - 1.0).abs()).fold(0.0, f64::max);
        println!("{} bodies at {spacing} m: gaps off by {off:.1e}", near.len());
        assert!(off < 1e-12 && all.iter().all(|gap| *gap < 2.0 * spacing));
    }
}

/// Shapes whose middle is not that of their area, long ones, unions, and a soft body drawn out to three times its
/// length: the bound by which others are left out holds for each of them.
#[test]
fn the_smallest_gap_is_found_whatever_the_shapes() {
    let shapes = [
        "cone = { radius = 0.2, height = 0.6 }",
        "box = { size = [0.9, 0.1, 0.05] }",
        "cylinder = { radius = 0.3, height = 0.05 }",
        "union = { parts = [{ shape = { box = { size = [0.2, 0.2, 0.2] } } }, \
         { shape = { sphere = { radius = 0.1 } }, offset = [0.4, 0, 0] }] }",
        "capsule = { radius = 0.05, height = 0.8 }",
    ];
    let found = |reach: &str, spacing: f64| {
        let mut text = format!(
            "time = {{ end = 1, sample = 1 }}\nworld = {{ gravity = [0, 0, 0] }}\n[[contact]]\n\
                                between = [\"all\", \"all\"]\n{reach}\n{LAWS}"
        );
        for k in 0..125_usize {
            let shape = shapes[k * 7 % 11 % shapes.len()];
            let place = [k % 5, k / 5 % 5, k / 25].map(|n| n as f64 * spacing);
            let soft = "affine = { material = { mooney_rivlin = { c1 = 1000, c2 = 0 } } }\n\
                        gradient = [[3, 0, 0], [0, 0.5773502691896258, 0], [0, 0, 0.5773502691896258]]";
            let attitude =
                format!("orientation = {{ axis_angle = {{ axis = [1, {}, {k}], angle = {k} }} }}", 3 * k % 7);
            let (shape, motion) =
                if k == 62 { ("ellipsoid = { semi_axes = [0.2, 0.1, 0.1] }", soft) } else { (shape, &*attitude) };
            text += &format!(
                "[[body]]\nname = \"b{k}\"\ngroup = \"all\"\nshape = {{ {shape} }}\ndensity = 10\n{motion}\n\
                 position = {place:?}\n"
            );
        }
        let scene = parsed(&text, &[]);
        gaps(&scene.built().model, &mut Workspace::default(), &scene.built().state).unwrap()
    };
    for spacing in [1.3, 2.0] {
        let (near, all) = (found("reach = 0.05", spacing), found("", spacing));
        let off = near.iter().zip(&all).map(|(one, other)| (one / other - 1.0).abs()).fold(0.0, f64::max);
        println!(
            "at {spacing} m gaps off by {off:.1e}, the least {:.3}",
            all.iter().fold(f64::INFINITY, |a, b| a.min(*b))
        );
        assert!(off < 1e-12, "{spacing}: {off:e}");
    }
}

/// Bodies that hang together, more than are listed whole, and what is made of the list again at every window.
#[test]
fn a_crowd_in_one_island_resumes_after_every_window() {
    let scene = crowd(3, 0.62, "reach = 0.2", false);
    let job = Job::of(&scene, &Provenance { version: "test".into(), commit: None });
    let FirstSteps { windows, difference, planes, .. } = FirstSteps::of(&job, 30).unwrap();
    println!("{windows} windows, forces by planes found anew {planes:.1e}");
    assert_eq!((windows, difference), (30, None));
    // A decrement of rounding leaves a plane to some 1e-10 of its slab, and a force to ν times that.
    assert!(planes < 1e-9);
}
