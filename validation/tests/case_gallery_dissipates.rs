//! The reduced dissipation inequality in every scene of the gallery that has bodies that deform.
//!
//!   V (S − ∂φ/∂P)·Ṗ ≥ 0,   V (S·Ṗ + Q·V_G − d(det G φ(F))/dt) ≥ 0 of a body that drives itself,   at every sample, of every body
//!
//! and their integrals: the works of viscosity and contraction never rise. S is the recorded stress, with the pressure,
//! which does no work where det F = 1; d(det G φ)/dt = det G (φ tr V_G + ∂φ/∂F·Ḟ), Ḟ = Ṗ G⁻¹ − F V_G.

use gyration::body::Body;
use gyration::tensor::Mat3;
use gyration_scene::Recorded;
use gyration_validation::{Case, Experiment, Run, largest};

/// The scenes with bodies that deform, over their first second.
fn scenes() -> Vec<(&'static str, Experiment)> {
    let all = gyration_scene::gallery().iter().map(|(name, _)| (*name, Experiment::of_gallery(name, &[])));
    let mut scenes: Vec<_> = all.filter(|(_, it)| it.model.bodies.iter().any(|body| body.affine().is_some())).collect();
    for (_, experiment) in &mut scenes {
        experiment.plan.end = experiment.plan.end.min(1.0);
    }
    scenes
}

/// The least dissipation of a body at a sample, and the largest power of its stress [W].
fn dissipation(run: &Run, index: usize, body: &Body) -> (f64, f64) {
    let Some(affine) = body.affine() else { return (f64::INFINITY, 0.0) };
    let matrices = |name| run.matrices_of(index, name);
    let arrays = ["stress", "placement_gradient", "gradient_rate"].map(matrices);
    let own = body.contraction().map(|_| ["contraction", "contraction_velocity", "drive"].map(matrices));
    let (mut least, mut scale) = (f64::INFINITY, 0.0_f64);
    for (k, ((stress, p), rate)) in arrays[0].iter().zip(&arrays[1]).zip(&arrays[2]).enumerate() {
        let material = affine.interior.material.as_ref();
        let response = |gradient: &Mat3| {
            material.map_or((0.0, Mat3::zeros()), |it| {
                let response = it.response(gradient);
                (response.energy, response.stress)
            })
        };
        let (stored, driven) = match &own {
            None => (response(p).1.dot(rate), [0.0; 2]),
            Some([g, v, q]) => {
                let back = g[k].try_inverse().unwrap_or_else(Mat3::zeros);
                let (f, ratio) = (p * back, g[k].determinant());
                let (energy, slope) = response(&f);
                let stored = ratio * (energy * v[k].trace() + slope.dot(&(rate * back - f * v[k])));
                (stored, [q[k].dot(&v[k]), q[k].norm() * v[k].norm()])
            }
        };
        let dissipated = affine.interior.volume * (stress.dot(rate) + driven[0] - stored);
        assert!(dissipated.is_finite(), "{dissipated}");
        least = least.min(dissipated);
        scale = scale.max(affine.interior.volume * (stress.norm() * rate.norm() + driven[1]));
    }
    (least, scale)
}

#[test]
fn bodies_of_the_gallery_dissipate_at_every_sample() {
    let scenes = scenes();
    assert!(scenes.len() >= 10, "{} scenes", scenes.len());
    for (name, experiment) in scenes {
        let run = experiment.recording([Recorded::Stress]).run();
        let bodies = experiment.model.bodies.iter().enumerate();
        let negative = bodies.map(|(index, body)| {
            let (least, scale) = dissipation(&run, index, body);
            if scale > 0.0 { (-least).max(0.0) / scale } else { 0.0 }
        });
        let case = Case { row: None, name, source: "reduced dissipation inequality" };
        // Differences of products of the size of the scale.
        case.check("largest negative dissipation over the power of the stress", 0.0, largest(negative), 1e-12);
        let works = ["work.viscosity", "work.contraction"].into_iter().filter(|work| run.has(work));
        let rises =
            works.flat_map(|work| run.column(work).windows(2).map(|pair| pair[1] - pair[0]).collect::<Vec<_>>());
        let rise = rises.fold(0.0, f64::max);
        // A sample errs by a hundredth of the tolerance of a step, 1e-10 of the energy in play.
        let rise = rise / run.energy_in_play;
        case.check("largest rise of the works of viscosity and contraction over the energy in play", 0.0, rise, 1e-10);
    }
}
