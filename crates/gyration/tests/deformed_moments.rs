//! Moments per deformed area against adaptive quadrature of the deformed surface, and against relations that they must
//! obey.
//!
//! The quadrature knows nothing of the rules under test: it maps a parameter rectangle onto each patch and halves
//! panels of Gauss points until nothing changes. Errors are relative to ∫ |κ| k |X|ⁿ dA.

use crate::deformed::quadrature::{OrientedSum, errors, integrate};
use crate::deformed::{self, Case, cases, cofactor};
use gyration::surface::{MomentPlan, MomentRequest, Moments, OrientedMoments};

/// The largest errors of one case: of the moments per deformed area by order, of the pairs by order, of the fourth
/// power.
fn measure(case: &Case) -> [f64; 8] {
    let reference = integrate(case);
    let kernel = case.kernel;
    let cofactor = cofactor(&case.gradient);
    let mut found = OrientedSum::default();
    let plan = MomentPlan::new(vec![MomentRequest { kernel, order: 3 }]);
    let mut out = [Moments::default()];
    case.surface.deformed_moments(&case.field, &cofactor, &plan, &mut out).unwrap();
    found.deformed = out[0];
    let plan = MomentPlan::new(vec![MomentRequest { kernel, order: 2 }, MomentRequest { kernel, order: 0 }]);
    let mut out = [OrientedMoments::default(); 2];
    case.surface.oriented_moments(&case.field, &cofactor, &plan, &mut out).unwrap();
    found.oriented = OrientedMoments { fourth: out[1].fourth, ..out[0] };
    errors(&found, &reference)
}

fn print(errors: &[f64]) -> String {
    errors.iter().map(|error| format!("{error:.1e}")).collect::<Vec<_>>().join(" ")
}

#[test]
fn moments_agree_with_adaptive_quadrature() {
    let mut failed = Vec::new();
    for name in deformed::SHAPES {
        let mut worst = [0.0_f64; 8];
        for case in cases(name) {
            let errors = measure(&case);
            for (worst, error) in worst.iter_mut().zip(errors) {
                *worst = if error.is_nan() { f64::NAN } else { worst.max(error) };
            }
            if !errors.iter().all(|error| *error < 1e-10) {
                failed.push(format!("{name}: {} at {case}", print(&errors)));
            }
        }
        println!("{name}: per deformed area {}, oriented {}", print(&worst[..4]), print(&worst[4..]));
    }
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}
