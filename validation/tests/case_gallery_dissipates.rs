//! The reduced dissipation inequality in every scene of the gallery that has bodies that deform.
//!
//!   V (S − ∂φ/∂P)·Ṗ ≥ 0 at every sample, of every body;   ∫ of its sum: the work of viscosity never rises
//!
//! S is the recorded stress, with the pressure, which does no work where det P = 1.

use gyration::body::Body;
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
    let arrays = ["stress", "placement_gradient", "gradient_rate"].map(|name| run.matrices_of(index, name));
    let (mut least, mut scale) = (f64::INFINITY, 0.0_f64);
    for ((stress, p), rate) in arrays[0].iter().zip(&arrays[1]).zip(&arrays[2]) {
        let elastic = affine.interior.material.as_ref().map_or(0.0, |material| material.stress(p).dot(rate));
        let dissipated = affine.interior.volume * (stress.dot(rate) - elastic);
        assert!(dissipated.is_finite(), "{}: {dissipated}", body.name);
        least = least.min(dissipated);
        scale = scale.max(affine.interior.volume * stress.norm() * rate.norm());
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
        let case = Case { row: None, name, source: "V (S − ∂φ/∂P)·Ṗ ≥ 0" };
        // Differences of products of the size of the scale.
        case.check("largest negative dissipation over the power of the stress", 0.0, largest(negative), 1e-12);
        let viscous = experiment.model.works().contains(&gyration::ledger::Work::Viscosity);
        let works = if viscous { run.column("work.viscosity") } else { vec![0.0; 2] };
        let rise = works.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
        // A sample errs by a hundredth of the tolerance of a step, 1e-10 of the energy in play.
        let rise = rise / run.energy_in_play;
        case.check("largest rise of the work of viscosity over the energy in play", 0.0, rise, 1e-10);
    }
}
