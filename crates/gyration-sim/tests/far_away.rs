//! Planes far from the origin: the places of bodies are known to twice the digits, so that gaps do not tell where they
//! are.

use crate::islands::parsed;
use crate::runs::provenance;
use gyration::tensor::Vec3;
use gyration_sim::{Job, MemorySink, Outcome, RunSummary, Simulation, Unwatched};

/// Velocity, P and steps of a body at the end that starts so far above a plane at a height [m].
fn ended(body: &str, above: f64, height: f64) -> (Vec3, [f64; 9], u64) {
    let scene = parsed(
        &format!(
            "time = {{ end = 0.4, sample = 0.2 }}\n[[support]]\nname = \"floor\"\n\
             plane = {{ origin = [0, 0, {height:?}] }}\n[[contact]]\nsupport = \"floor\"\n\
             repulsion = {{ alpha = 100, nu = 6, d0 = 1e-3 }}\n[[body]]\nname = \"a\"\ndensity = 1000\n\
             position = [0, 0, {:?}]\nangular_velocity = [0, 7, {}]\n{body}\n",
            height + above,
            // What is kept to a plane turns about its normal alone.
            if body.contains("keep") { 0 } else { 1 }
        ),
        &[],
    );
    let job = Job::of(&scene, &provenance());
    let mut sink = MemorySink::default();
    let mut simulation = Simulation::new(job.model, job.start, job.plan).unwrap();
    simulation.begin(&mut sink).unwrap();
    let outcome = simulation.run(&mut sink, &mut Unwatched).unwrap();
    let summary = RunSummary::of(job.model, &mut simulation, outcome, None);
    assert_eq!(summary.outcome, Outcome::Completed, "{}", summary.in_words);
    let motion = simulation.state().motion(job.model, 0);
    let gradient = motion.placement.gradient;
    let count = |kind: &str| summary.statistics[kind].as_u64().unwrap();
    let steps = count("explicit_steps") + count("implicit_steps");
    (motion.velocity.velocity, std::array::from_fn(|k| gradient[k]), steps)
}

/// Symptom: a soft cube that keeps its volume took 147,000 steps for 760 over a plane 1,000 km away, and was off by
/// 2e-5; ellipsoids and cylinders lost their energy.
#[test]
fn bodies_over_a_far_plane_move_as_over_a_near_one() {
    for (body, above) in [
        (
            "shape = { box = { size = [0.2, 0.2, 0.1] } }\n\
             affine = { material = { neo_hookean = { shear = 2e5 } }, viscosity = 50 }",
            0.25,
        ),
        ("shape = { ellipsoid = { semi_axes = [0.1, 0.08, 0.05] } }", 0.25),
        ("shape = { cylinder = { radius = 0.1, height = 0.1 } }", 0.25),
        ("shape = { cylinder = { radius = 0.1, height = 0.1 } }\npin = [0.125, 0, 0.0625]", 0.125),
        (
            "shape = { box = { size = [0.2, 0.2, 0.1] } }\npin = [0.125, 0.125, 0.0625]\n\
             affine = { material = { neo_hookean = { shear = 2e5 } } }",
            0.125,
        ),
        ("shape = { box = { size = [0.2, 0.2, 0.1] } }\nvelocity = [1, 0, 0]\nkeep = { plane = [0, 1, 0] }", 0.25),
        (
            "shape = { box = { size = [0.2, 0.2, 0.1] } }\nvelocity = [1, 0, 0]\nkeep = { plane = [0, 1, 0] }\n\
             affine = { material = { neo_hookean = { shear = 2e5 } }, viscosity = 50 }",
            0.25,
        ),
    ] {
        let (velocity, gradient, steps) = ended(body, above, 0.0);
        for height in [1048576.0, 67108864.0] {
            let (far, far_gradient, far_steps) = ended(body, above, height);
            let turned = gradient.iter().zip(far_gradient).map(|(near, far)| (near - far).abs()).fold(0.0, f64::max);
            println!("{body} at {height}: {:.1e} {turned:.1e}, {far_steps} steps for {steps}", (velocity - far).norm());
            assert!((velocity - far).norm() < 1e-6 && turned < 1e-6, "{body} at {height}");
            assert!((far_steps as f64 / steps as f64 - 1.0).abs() < 0.2, "{body} at {height}: {far_steps} for {steps}");
        }
    }
}
