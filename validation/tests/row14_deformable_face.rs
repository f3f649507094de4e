//! Row 14 with a body that deforms: a level face under damping alone is not stretched, and stops where the rigid one
//! does.
//!
//!   v = v₀ + (βA/m)(d^(1−ν) − d₀^(1−ν))/(ν−1)

use gyration::contact::{AreaMeasure, ContactLaw, Damping};
use gyration::material::{Material, MooneyRivlin};
use gyration_sim::Tolerance;
use gyration_validation::{Case, FacetBody};

#[test]
fn deformable_face_stops_where_its_momentum_is_spent() {
    const SOURCE: &str = "v = v₀ + (βA/m)(d^(1−ν) − d₀^(1−ν))/(ν−1)";
    let case =
        Case {
            row: Some(14), name: "deformable face, damping alone, β = 1e-7, d₀ = 0.05, v₀ = −1", source: SOURCE
        };
    let body = FacetBody {
        mass: 1.0,
        area: 0.01,
        laws: vec![ContactLaw::Damping(Damping { beta: 1e-7, exponent: 3.0, reference_gap: 1.0, release: None })],
        gravity: 0.0,
        gap: 0.05,
        tilt: 0.0,
        velocity: -1.0,
    };
    let rubber = Material::MooneyRivlin(MooneyRivlin { c1: 3000.0, c2: 1000.0, bulk: None });
    for (measure, quantity) in [
        (AreaMeasure::DeformedArea, "gap at the stop, deformed_area [m]"),
        (AreaMeasure::ReferenceArea, "gap at the stop, reference_area [m]"),
    ] {
        let experiment = body.deformable(rubber.clone(), measure, Tolerance { rtol: 1e-11, atol: 1e-14 });
        let gap = experiment.motion_at(0.06).placement.position.z;
        let reference = (0.05_f64.powi(-2) + 2.0 / (1e-7 * 0.01)).powf(-0.5);
        // Over three decades of the gap, at rtol = 1e-11 of it a step: as the rigid face.
        case.check(quantity, reference, gap, 1e-8);
    }
}
