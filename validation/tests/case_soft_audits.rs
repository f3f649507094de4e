//! Two laws that no algebra in the program makes hold, checked by differences in time along the motion of soft boxes.
//!
//!   reduced dissipation inequality   V S·Ṗ − d(Vφ)/dt = V τ_v·L ≥ 0
//!   Sławianowski's balance           dK/dt = Ṗ J Ṗᵀ + N − V (S Pᵀ)ᵀ
//!
//! S, N, K, P and Ṗ are those of the recording, φ that of its ledger; derivatives are central differences of eighth
//! order.

use crate::soft::{derivatives, size, thrown_box};
use gyration::tensor::{Mat3, Vec3};
use gyration_scene::Recorded;
use gyration_validation::{Case, Run, largest};

const VOLUME: f64 = 0.10 * 0.08 * 0.06;
const SPACING: f64 = 5e-5;
/// Samples without a derivative at either end.
const MARGIN: usize = 4;

/// Internal friction as a function of P and Ṗ: τ_v·L [W/m³].
type Friction = fn(&Mat3, &Mat3) -> f64;

struct Soft {
    name: &'static str,
    measure: &'static str,
    affine: &'static str,
    friction: Friction,
}

fn strain_rate(l: &Mat3) -> Mat3 {
    0.5 * (l + l.transpose())
}

const BODIES: [Soft; 3] = [
    Soft {
        name: "thrown box of rubber, μ = 10 Pa s",
        measure: "deformed_area",
        affine: "material = { mooney_rivlin = { c1 = 1500, c2 = 500 } }, viscosity = 10",
        friction: |_, l| 10.0 * strain_rate(l).norm_squared(),
    },
    Soft {
        name: "thrown box of foam, η = 5 Pa s, ζ = 8 Pa s",
        measure: "deformed_area_potential",
        affine: "material = { neo_hookean_log = { mu = 4000, lambda = 6000 } }, internal_friction = { shear = 5, bulk = 8 }",
        friction: |p, l| {
            let (rate, growth) = (strain_rate(l), l.trace());
            p.determinant() * (10.0 * (rate.norm_squared() - growth * growth / 3.0) + 8.0 * growth * growth)
        },
    },
    Soft {
        name: "thrown box of Ogden's material, friction along one axis",
        measure: "reference_area",
        affine: "material = { ogden = { mu = [3000, -500], alpha = [1.6, -2], bulk = 9000 } }, internal_friction = { matrix = \
                 [[30, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0], \
                 [0, 0, 0, 0, 0, 0]] }",
        // Of the strain rate along the axis R e_x that turns with the body, P = R U.
        friction: |p, l| {
            let square = (p.transpose() * p).symmetric_eigen();
            let compress = Mat3::from_diagonal(&square.eigenvalues.map(|value| 1.0 / value.sqrt()));
            let axis = p * square.eigenvectors * compress * square.eigenvectors.tr_mul(&Vec3::x());
            30.0 * p.determinant() * axis.dot(&(strain_rate(l) * axis)).powi(2)
        },
    },
];

fn run(body: &Soft) -> Run {
    let quantities = [Recorded::Stress, Recorded::AffineMoment, Recorded::VelocityGradient];
    thrown_box(body.measure, body.affine).sampled(SPACING).recording(quantities).run()
}

/// The samples that have a derivative.
fn inner<T>(values: &[T]) -> &[T] {
    &values[MARGIN..values.len() - MARGIN]
}

fn dissipation_is_not_negative(case: &Case, body: &Soft, run: &Run) {
    let energy = derivatives(&run.column("energy.elastic"), SPACING);
    let (stress, rate) = (run.matrices("stress"), run.matrices("gradient_rate"));
    let power: Vec<f64> = inner(&stress).iter().zip(inner(&rate)).map(|(s, rate)| VOLUME * s.dot(rate)).collect();
    let dissipated: Vec<f64> = power.iter().zip(&energy).map(|(power, energy)| power - energy).collect();
    let scale = largest(power.iter().copied());
    let least = dissipated.iter().copied().fold(f64::INFINITY, f64::min);
    let case = case.by("V S·Ṗ − d(Vφ)/dt = V τ·L ≥ 0");
    println!(
        "{}: power of stress to {scale:.2e} W, dissipated {least:.2e} to {:.2e} W",
        body.name,
        largest(dissipated.clone())
    );
    case.check("largest negative dissipation over the power of the stress", 0.0, (-least).max(0.0) / scale, 1e-7);
    let (gradients, velocity_gradients) = (run.matrices("placement_gradient"), run.matrices("velocity_gradient"));
    let expected =
        inner(&gradients).iter().zip(inner(&velocity_gradients)).map(|(p, l)| VOLUME * (body.friction)(p, l));
    let error = largest(dissipated.iter().zip(expected).map(|(found, expected)| found - expected));
    case.check("largest error of the dissipation over the power of the stress", 0.0, error / scale, 1e-7);
    let work = derivatives(&run.column("work.viscosity"), SPACING);
    let error = largest(dissipated.iter().zip(&work).map(|(found, work)| found + work));
    case.by("the ledger").check(
        "error of the work of viscosity over the power of the stress",
        0.0,
        error / scale,
        1e-7,
    );
}

fn affine_momentum_balances(case: &Case, run: &Run) {
    let euler = Mat3::from_diagonal(&(Vec3::new(0.01, 0.0064, 0.0036) * (1000.0 * VOLUME / 12.0)));
    let momentum = derivatives(&run.matrices("affine_momentum"), SPACING);
    let arrays = ["placement_gradient", "gradient_rate", "affine_moment", "stress"].map(|name| run.matrices(name));
    let [p, rate, moment, stress] = arrays.each_ref().map(|array| inner(array));
    let supplied = |k: usize| {
        rate[k] * euler * rate[k].transpose() + moment[k] - VOLUME * (stress[k] * p[k].transpose()).transpose()
    };
    let error = largest(momentum.iter().enumerate().map(|(k, found)| size(&(found - supplied(k)))));
    let scale = largest(stress.iter().zip(p).map(|(s, p)| VOLUME * size(&(s * p.transpose()))));
    let case = case.by("dK/dt = Ṗ J Ṗᵀ + N − V(SPᵀ)ᵀ");
    // A corner that strikes changes N within a millisecond: the eighth power of that over the spacing is left.
    case.check("largest error of the balance of K over the largest stress", 0.0, error / scale, 5e-7);
    let skew = largest(stress.iter().zip(p).map(|(s, p)| VOLUME * size(&(s * p.transpose() - p * s.transpose()))));
    case.by("S Pᵀ symmetric").check("largest skew part of S Pᵀ over its size", 0.0, skew / scale, 1e-12);
}

#[test]
fn soft_boxes_dissipate_and_balance_their_affine_momentum() {
    for body in &BODIES {
        let case = Case { row: None, name: body.name, source: "" };
        let run = run(body);
        dissipation_is_not_negative(&case, body, &run);
        affine_momentum_balances(&case, &run);
    }
}
