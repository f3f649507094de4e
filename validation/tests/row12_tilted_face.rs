//! Row 12: a tilted flat face of width L and depth b, end gaps d₁ < d₂, sin φ = (d₂−d₁)/L.
//!
//!   f = (bα/sin φ)(d₁^(1−ν) − d₂^(1−ν))/(ν−1),   moment ∫ q s dA about the face's centre, s along the face upward.

use gyration::contact::{ContactLaw, Repulsion};
use gyration_sim::Tolerance;
use gyration_validation::{Answer, FacetBody};

const CASE: &str = "tilted face, b = L = 0.1 m, φ = 0.1, d₁ = 0.02 m, α = 1e-6, ν = 6";

#[test]
fn tilted_face_gets_the_force_and_moment_of_the_closed_form() {
    let (width, tilt, low): (f64, f64, f64) = (0.1, 0.1, 0.02);
    let repulsion = Repulsion { alpha: 1e-6, exponent: 6.0, reference_gap: 1.0 };
    let body = FacetBody {
        mass: 1.0,
        area: width * width,
        laws: vec![ContactLaw::Repulsion(repulsion)],
        gravity: 0.0,
        gap: low + 0.5 * width * tilt.sin(),
        // The face's own x rises.
        tilt: -tilt,
        velocity: 0.0,
    };
    let experiment = body.experiment(Tolerance { rtol: 1e-8, atol: 1e-10 });
    Answer {
        row: Some(12),
        case: CASE,
        quantity: "force [N]",
        reference: 54.3371749579,
        measured: experiment.contact_force().z,
        // The reference has 12 digits.
        tolerance: 1e-11,
        source: "(bα/sin φ)(d₁^(1−ν) − d₂^(1−ν))/(ν−1)",
    }
    .check();
    Answer {
        row: Some(12),
        case: CASE,
        quantity: "moment ∫ q s dA about the face's centre [N m]",
        reference: -1.02885578434,
        // The torque about y is −∫ (q cos φ) s dA.
        measured: -experiment.torque().y / tilt.cos(),
        tolerance: 1e-11,
        source: "quadrature of q s over the face",
    }
    .check();
}
