//! Bodies that pass one another without touching: what they do to each other is seen, however long the steps before.

use crate::islands::parsed;
use crate::runs::provenance;
use gyration::tensor::Vec3;
use gyration_sim::{Job, MemorySink, Simulation, Unwatched};

/// A ball that flies past another, or past one that is a support, from a distance and beside it by so much; how fast it
/// goes across afterwards \[m/s\].
fn across(start: f64, beside: f64, words: &str, is_support: bool) -> f64 {
    let shape = "shape = { sphere = { radius = 0.05 } }";
    let other = match is_support {
        true => format!("[[support]]\nname = \"b\"\n{shape}\n"),
        false => format!("[[body]]\nname = \"b\"\n{shape}\ndensity = 1000\n"),
    };
    let text = format!(
        "world = {{ gravity = [0, 0, 0] }}\ntime = {{ end = {}, sample = 1 }}\n{words}\n\
         repulsion = {{ alpha = 300, nu = 6, d0 = 1e-4 }}\n[[body]]\nname = \"a\"\n{shape}\ndensity = 1000\n\
         position = [{}, {beside}, 0]\nvelocity = [1, 0, 0]\n{other}",
        2.0 * start + 0.3,
        -start
    );
    let scene = parsed(&text, &[]);
    let job = Job::of(&scene, &provenance());
    let mut simulation = Simulation::new(job.model, job.start, job.plan).unwrap();
    let mut sink = MemorySink::default();
    simulation.begin(&mut sink).unwrap();
    simulation.run(&mut sink, &mut Unwatched).unwrap();
    let velocity: Vec3 = simulation.state().motion(job.model, 0).velocity.velocity;
    velocity.y
}

/// Symptom: of twenty balls that flew straight past another, sixteen felt nothing, and the ledger was closed.
#[test]
fn balls_that_fly_straight_past_one_another_are_deflected() {
    let contact = |words: &str| format!("[[contact]]\nbetween = [\"a\", \"b\"]\n{words}");
    for is_support in [false, true] {
        for beside in [0.10002, 0.10005, 0.1002] {
            let finest = across(0.3, beside, &format!("solver = {{ max_step = 1e-3 }}\n{}", contact("")), is_support);
            let mut off = 0.0_f64;
            for start in [0.2, 0.31, 0.5, 0.77, 1.0, 1.3, 2.1, 5.3, 17.0] {
                for words in ["", "reach = 0.06", "reach = 0.3"] {
                    let found = across(start, beside, &contact(words), is_support);
                    off = off.max((found / finest - 1.0).abs());
                }
            }
            println!("support {is_support}, beside {beside}: {finest:.6e} m/s, off by {off:.1e}");
            // Of a deflection of 1e-5 of the speed and more, and a tolerance of 1e-8.
            assert!(finest > 1e-7 && off < 2e-3, "{beside}: {off:e}");
        }
    }
}

/// A ball that flies past the image of another, some cells to either side of it: as it flies past the other itself.
#[test]
fn balls_that_fly_past_images_are_deflected() {
    let beside = 0.10005;
    let contact = "[[contact]]\nbetween = [\"a\", \"b\"]\n";
    let finest = across(0.3, beside, &format!("solver = {{ max_step = 1e-3 }}\n{contact}"), false);
    for (start, cell) in [(0.31, -3.0), (0.77, 3.0), (1.3, 2.0)] {
        // One that flies out of reach of all images but one, since cells are five metres long.
        let found = across(
            start,
            beside + 5.0 * cell,
            &format!("lattice = {{ cell = [[0, 5, 0]], repeat = [3, 1, 1] }}\n{contact}reach = 0.3"),
            false,
        );
        assert!((found / finest - 1.0).abs() < 2e-3, "{start} {cell}: {found:e} {finest:e}");
    }
}
