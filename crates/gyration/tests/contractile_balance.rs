//! The balance of a contractile body against its equations as they are written, whatever the way in which they are
//! solved.

use gyration::affine::{AffineBody, Gyration, Viscosity};
use gyration::contractile::{Contraction, ContractionCommand, ContractionSource, Decomposition, Pull, Spin};
use gyration::material::{Hencky, Material, MooneyRivlin, NeoHookeanLog, Ogden, OgdenTerm};
use gyration::shape::{Cuboid, Shape};
use gyration::signal::Signal;
use gyration::tensor::{Mat3, Vec3};
use proptest::prelude::*;

fn materials() -> Vec<Option<Material>> {
    let term = |mu, alpha| OgdenTerm { mu, alpha };
    vec![
        None,
        Some(Material::MooneyRivlin(MooneyRivlin { c1: 2.0, c2: 1.0, bulk: None })),
        Some(Material::MooneyRivlin(MooneyRivlin { c1: 2.0, c2: 1.0, bulk: Some(7.0) })),
        Some(Material::NeoHookeanLog(NeoHookeanLog { mu: 3.0, lambda: 2.0 })),
        Some(Material::Hencky(Hencky { shear: 2.0, bulk: 3.0 })),
        Some(Material::Ogden(Ogden { terms: vec![term(1.2, 3.0), term(0.7, -1.5)], bulk: None })),
    ]
}

fn body(material: Option<Material>, viscosity: f64) -> AffineBody {
    let mass = Shape::Box(Cuboid { size: Vec3::new(0.8, 1.0, 0.6) }).mass_properties(0.8);
    let viscosity = Viscosity { kirchhoff: viscosity, ..Viscosity::default() };
    AffineBody::new(&mass, None, material, viscosity).unwrap()
}

fn contraction(kept_volume: Option<f64>, spin: Spin) -> Contraction {
    let source = ContractionSource::Driven { drive: Signal::Constant(Mat3::zeros()), feedback: Vec::new() };
    Contraction { viscosity: 0.8, kept_volume, spin, source }
}

/// P, Ṗ and G from 27 numbers, with det F = 1 where it has to be, det G = 1 and tr L = 0 where det G is kept.
fn start(body: &AffineBody, how: &Contraction, numbers: &[f64]) -> (Gyration, Decomposition) {
    let matrix = |at: usize| Mat3::from_column_slice(&numbers[at..at + 9]);
    let restored = how.restore(
        body,
        0.0,
        (&(Mat3::identity() + 0.2 * matrix(0)), &matrix(9), &(Mat3::identity() + 0.2 * matrix(18))),
    );
    let at = Gyration::of(&restored.gradient, &restored.rate).unwrap();
    (at, Decomposition::of(&restored.gradient, &restored.contraction).unwrap())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_equations_of_the_book_hold(numbers in prop::collection::vec(-1.0..1.0_f64, 45)) {
        let (drive, moment) = (Mat3::from_column_slice(&numbers[27..36]), Mat3::from_column_slice(&numbers[36..45]));
        let kinds = [(None, Spin::Full), (None, Spin::Symmetric), (Some(1.0), Spin::Full), (Some(1.0), Spin::Symmetric)];
        for ((material, viscosity), (kept, spin)) in materials()
            .into_iter()
            .flat_map(|material| [0.0, 0.6, 40.0].map(|viscosity| (material.clone(), viscosity)))
            .flat_map(|it| kinds.map(|kind| (it.clone(), kind)))
        {
            let (body, how) = (body(material, viscosity), contraction(kept, spin));
            let (at, split) = start(&body, &how, &numbers);
            let pull = Pull { body: &body, contraction: &how, at: &at, decomposition: &split };
            let solved = pull.balance(&ContractionCommand::Drive(drive), &moment);
            let (v, f) = (solved.contraction_velocity, split.elastic);
            let back = f.try_inverse().unwrap();
            // S = det G ∂φ/∂F G⁻ᵀ + μ sym(Ḟ F⁻¹) P⁻ᵀ − π P⁻ᵀ
            let straining = at.velocity_gradient - f * v * back;
            let strain_rate = 0.5 * (straining + straining.transpose());
            let response = body.material.as_ref().map(|material| material.response(&f));
            let (energy, stress) = response.map_or((0.0, Mat3::zeros()), |it| (it.energy, it.stress));
            let across = at.inverse.transpose();
            let piola = split.volume_ratio * stress * split.inverse.transpose() + viscosity * strain_rate * across
                - solved.pressure.unwrap_or(0.0) * across;
            let scale = 1.0 + solved.stress.norm();
            // Roundings of some hundred operations on numbers of this size.
            prop_assert!((piola - solved.stress).norm() < 1e-11 * scale, "{}", (piola - solved.stress).norm());
            // μ_γ V_G = Fᵀ S Gᵀ − det G φ I + Q, its symmetric part alone, or but for a multiple of I.
            let mut law = f.transpose() * piola * split.contraction.transpose() + drive
                - Mat3::from_diagonal_element(split.volume_ratio * energy) - how.viscosity * v;
            if spin == Spin::Symmetric {
                law = 0.5 * (law + law.transpose());
                prop_assert!((v - v.transpose()).norm() < 1e-12 * (1.0 + v.norm()));
            }
            if kept.is_some() {
                law -= Mat3::from_diagonal_element(law.trace() / 3.0);
                prop_assert!(v.trace().abs() < 1e-12 * (1.0 + v.norm()));
            }
            prop_assert!(law.norm() < 1e-10 * scale, "{kept:?} {spin:?} {viscosity}: {}", law.norm());
            // Incompressible: tr(Ḟ F⁻¹) = 0, and where det P is kept, its second derivative vanishes.
            if body.is_incompressible() {
                prop_assert!(straining.trace().abs() < 1e-12 * (1.0 + v.norm() + at.velocity_gradient.norm()));
                let growth = (solved.acceleration * at.inverse).trace() - (at.velocity_gradient * at.velocity_gradient).trace();
                prop_assert!(kept.is_none() || growth.abs() < 1e-10 * (1.0 + solved.acceleration.norm()));
            }
            let left = solved.acceleration * body.euler_tensor - moment + body.volume * solved.stress;
            prop_assert!(left.norm() < 1e-11 * (scale + moment.norm()));
        }
    }

    #[test]
    fn prescribing_what_a_drive_does_takes_that_drive(numbers in prop::collection::vec(-1.0..1.0_f64, 45)) {
        let (drive, moment) = (Mat3::from_column_slice(&numbers[27..36]), Mat3::from_column_slice(&numbers[36..45]));
        for material in materials() {
            let (body, how) = (body(material, 0.6), contraction(None, Spin::Full));
            let (at, split) = start(&body, &how, &numbers);
            let driven = Pull { body: &body, contraction: &how, at: &at, decomposition: &split };
            let driven = driven.balance(&ContractionCommand::Drive(drive), &moment);
            let how = Contraction { source: ContractionSource::Prescribed(Signal::Constant(split.contraction)), ..how };
            let pull = Pull { body: &body, contraction: &how, at: &at, decomposition: &split };
            // The second derivative of det G that goes with the acceleration of the driven body.
            let l = at.velocity_gradient;
            let growing = (driven.acceleration * at.inverse).trace() - (l * l).trace();
            let prescribed = pull.balance(&ContractionCommand::Velocity(driven.contraction_velocity, growing), &moment);
            let scale = 1.0 + driven.stress.norm();
            prop_assert!((prescribed.drive - drive).norm() < 1e-11 * scale, "{}", (prescribed.drive - drive).norm());
            prop_assert!((prescribed.stress - driven.stress).norm() < 1e-11 * scale);
            prop_assert!((prescribed.acceleration - driven.acceleration).norm() < 1e-10 * (1.0 + driven.acceleration.norm()));
        }
    }
}
