//! One suite that every material passes: stress and tangent are derivatives, the energy is objective and isotropic, the
//! rest state is at rest, extreme stretch costs.

use gyration::kinematics::Quaternion;
use gyration::material::{
    Fung, Hencky, Material, MooneyRivlin, NeoHookeanLog, Ogden, OgdenTerm, StVenantKirchhoff, Tangent,
};
use gyration::tensor::{Mat3, Vec3};
use proptest::prelude::*;

/// A material, its shear modulus at rest, and its bulk modulus if it is compressible.
struct Case {
    name: &'static str,
    material: Material,
    shear: f64,
    bulk: Option<f64>,
}

fn ogden(bulk: Option<f64>) -> Material {
    // Ogden's three terms for rubber, in units of 1e5 Pa.
    let term = |mu, alpha| OgdenTerm { mu, alpha };
    Material::Ogden(Ogden { terms: vec![term(6.3, 1.3), term(0.012, 5.0), term(-0.1, -2.0)], bulk })
}

fn cases() -> Vec<Case> {
    let case = |name, material, shear, bulk| Case { name, material, shear, bulk };
    let ogden_shear = 0.5 * (6.3 * 1.3 + 0.012 * 5.0 + 0.1 * 2.0);
    vec![
        case("Mooney-Rivlin", Material::MooneyRivlin(MooneyRivlin { c1: 3.0, c2: 1.0, bulk: None }), 8.0, None),
        case(
            "Mooney-Rivlin with bulk",
            Material::MooneyRivlin(MooneyRivlin { c1: 3.0, c2: 1.0, bulk: Some(20.0) }),
            8.0,
            Some(20.0),
        ),
        case("neo-Hookean", Material::MooneyRivlin(MooneyRivlin::neo_hookean(2.0, None)), 2.0, None),
        case("Fung", Material::Fung(Fung { shear: 2.0, exponent: 0.3, bulk: None }), 2.0, None),
        case("Fung with bulk", Material::Fung(Fung { shear: 2.0, exponent: 0.3, bulk: Some(9.0) }), 2.0, Some(9.0)),
        case("Ogden", ogden(None), ogden_shear, None),
        case("Ogden with bulk", ogden(Some(30.0)), ogden_shear, Some(30.0)),
        case(
            "neo-Hookean with log",
            Material::NeoHookeanLog(NeoHookeanLog { mu: 2.0, lambda: 5.0 }),
            2.0,
            Some(5.0 + 4.0 / 3.0),
        ),
        case(
            "St Venant-Kirchhoff",
            Material::StVenantKirchhoff(StVenantKirchhoff { lambda: 5.0, mu: 2.0 }),
            2.0,
            Some(5.0 + 4.0 / 3.0),
        ),
        case(
            "orthogonality",
            Material::StVenantKirchhoff(StVenantKirchhoff::orthogonality(0.7)),
            2.8,
            Some(2.0 / 3.0 * 2.8),
        ),
        case("Hencky", Material::Hencky(Hencky { shear: 2.0, bulk: 7.0 }), 2.0, Some(7.0)),
    ]
}

/// Gradients with stretches between 0.4 and 2.5, some of them equal or nearly equal.
fn gradient() -> impl Strategy<Value = Mat3> {
    let stretch =
        || prop_oneof![3 => 0.4..2.5_f64, 1 => Just(1.0), 1 => (-15.0..-3.0_f64).prop_map(|e| 1.0 + 10_f64.powf(e))];
    (rotation(), [stretch(), stretch(), stretch()], rotation())
        .prop_map(|(q, stretches, r)| q * Mat3::from_diagonal(&Vec3::from(stretches)) * r)
}

fn rotation() -> impl Strategy<Value = Mat3> {
    prop::array::uniform4(-1.0..1.0_f64)
        .prop_filter("a direction", |q| q.iter().map(|c| c * c).sum::<f64>() > 0.01)
        .prop_map(|q| Quaternion(q).rotation())
}

fn direction() -> impl Strategy<Value = Mat3> {
    prop::array::uniform9(-1.0..1.0_f64).prop_map(|entries| Mat3::from_row_slice(&entries))
}

/// The derivative of a function by differences of sixth order with the step h.
fn difference<T>(h: f64, f: impl Fn(f64) -> T) -> T
where
    T: std::ops::Sub<Output = T> + std::ops::Add<Output = T> + std::ops::Mul<f64, Output = T>,
{
    let pair = |k: f64| f(k * h) - f(-k * h);
    pair(1.0) * (45.0 / (60.0 * h)) - pair(2.0) * (9.0 / (60.0 * h)) + pair(3.0) * (1.0 / (60.0 * h))
}

/// Sixth order with h = 1e-3: about h⁶ ~ 1e-18 of the seventh derivative, and rounding 1e-16/h ~ 1e-13; stretches of
/// 0.4 and powers of −7 leave 1e-9 of the largest term.
const BY_DIFFERENCES: f64 = 1e-9;
const STEP: f64 = 1e-3;

/// dS = (∂S/∂P) : dP.
fn apply(tangent: &Tangent, dp: &Mat3) -> Mat3 {
    Mat3::from_column_slice((tangent * nalgebra::SVector::<f64, 9>::from_column_slice(dp.as_slice())).as_slice())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn stress_is_the_derivative_of_the_energy(p in gradient(), dp in direction()) {
        for Case { name, material, .. } in cases() {
            let work = material.response(&p).stress.dot(&dp);
            let slope = difference(STEP, |s| material.response(&(p + s * dp)).energy);
            let scale = material.response(&p).stress.norm() + material.response(&p).energy.abs() + 1.0;
            prop_assert!((work - slope).abs() < BY_DIFFERENCES * scale * 10.0, "{name}: {work} and {slope}");
        }
    }

    #[test]
    fn tangent_is_the_derivative_of_the_stress(p in gradient(), dp in direction()) {
        for Case { name, material, .. } in cases() {
            let change = apply(&material.tangent(&p), &dp);
            let slope = difference(STEP, |s| material.response(&(p + s * dp)).stress);
            let error = (change - slope).norm() / (change.norm() + 1.0);
            prop_assert!(error < 10.0 * BY_DIFFERENCES, "{name}: {error:e}\n{change}{slope}");
        }
    }

    #[test]
    fn tangent_is_symmetric(p in gradient(), dp in direction(), dq in direction()) {
        for Case { name, material, .. } in cases() {
            let tangent = material.tangent(&p);
            let (there, back) = (apply(&tangent, &dp).dot(&dq), apply(&tangent, &dq).dot(&dp));
            let scale = apply(&tangent, &dp).norm() + apply(&tangent, &dq).norm() + 1.0;
            prop_assert!((there - back).abs() < 1e-12 * scale, "{name}: {there} and {back}");
        }
    }

    #[test]
    fn turning_space_turns_the_stress_and_turning_the_body_changes_no_energy(p in gradient(), q in rotation()) {
        for Case { name, material, .. } in cases() {
            let (here, turned, inside) = (material.response(&p), material.response(&(q * p)), material.response(&(p * q)));
            let scale = here.stress.norm() + here.energy.abs() + 1.0;
            prop_assert!((turned.energy - here.energy).abs() < 1e-13 * scale, "{name}");
            prop_assert!((inside.energy - here.energy).abs() < 1e-13 * scale, "{name}");
            prop_assert!((turned.stress - q * here.stress).norm() < 1e-12 * scale, "{name}");
            prop_assert!((inside.stress - here.stress * q).norm() < 1e-12 * scale, "{name}");
            let kirchhoff = here.stress * p.transpose();
            prop_assert!((kirchhoff - kirchhoff.transpose()).norm() < 1e-12 * scale, "{name}: S Pᵀ is not symmetric");
        }
    }
}

#[test]
fn rest_state_has_no_energy_and_no_stress_that_a_pressure_does_not_carry() {
    for Case { name, material, bulk, .. } in cases() {
        let rest = material.response(&Mat3::identity());
        let pressure = Mat3::from_diagonal_element(rest.stress.trace() / 3.0);
        let stress = if bulk.is_none() { rest.stress - pressure } else { rest.stress };
        assert!(rest.energy.abs() < 1e-15 && stress.norm() < 1e-14, "{name}: {rest:?}");
        assert_eq!(material.is_incompressible(), bulk.is_none(), "{name}");
        assert_eq!(material.validate(), Ok(()), "{name}");
    }
}

#[test]
fn small_strains_have_the_moduli_of_linear_elasticity() {
    let shear_strain = Mat3::new(0.3, 0.5, 0.2, 0.5, -0.7, 0.1, 0.2, 0.1, 0.4);
    for Case { name, material, shear, bulk } in cases() {
        let tangent = material.tangent(&Mat3::identity());
        // An incompressible material at rest is under the pressure π that leaves no stress; −π P⁻ᵀ adds π dPᵀ.
        let pressure = material.response(&Mat3::identity()).stress.trace() / 3.0;
        let reaction = if bulk.is_none() { pressure } else { 0.0 };
        let stress = apply(&tangent, &shear_strain) + reaction * shear_strain.transpose();
        let error = (stress - 2.0 * shear * shear_strain).norm() / (2.0 * shear);
        assert!(error < 1e-13, "{name}: shear modulus off by {error:e}");
        if let Some(bulk) = bulk {
            let stress = apply(&tangent, &Mat3::identity());
            let error = (stress - Mat3::from_diagonal_element(3.0 * bulk)).norm() / bulk;
            assert!(error < 1e-13, "{name}: bulk modulus off by {error:e}");
        }
    }
}

#[test]
fn extreme_stretch_costs_more_and_more() {
    for Case { name, material, .. } in cases() {
        // St Venant–Kirchhoff gives way when it is flattened; that is known of it, and its page says so.
        let flattened = !matches!(material, Material::StVenantKirchhoff(_));
        let energy = |l: f64| material.response(&Mat3::from_diagonal(&Vec3::new(l, l.powf(-0.5), l.powf(-0.5)))).energy;
        let longer: Vec<f64> = [2.0, 4.0, 8.0, 16.0].map(energy).to_vec();
        assert!(longer.windows(2).all(|pair| pair[1] > 1.2 * pair[0]), "{name}: {longer:?}");
        let flatter: Vec<f64> = [0.5, 0.25, 0.1].map(energy).to_vec();
        assert!(!flattened || flatter.windows(2).all(|pair| pair[1] > 1.2 * pair[0]), "{name}: {flatter:?}");
    }
}

#[test]
fn nearly_equal_stretches_have_the_tangent_of_equal_ones() {
    let dp = Mat3::new(0.1, 0.5, -0.2, 0.3, -0.4, 0.6, 0.2, -0.7, 0.9);
    for Case { name, material, .. } in cases() {
        let tangent =
            |by: f64| apply(&material.tangent(&Mat3::from_diagonal(&Vec3::new(1.3, 1.3 * (1.0 + by), 0.8))), &dp);
        let equal = tangent(0.0);
        for by in [1e-15, 1e-12, 1e-10, 1e-8, 1e-6] {
            let error = (tangent(by) - equal).norm() / equal.norm();
            // The tangent itself changes by a few times the difference of the stretches.
            assert!(error < 10.0 * by + 1e-14, "{name}: {error:e} at {by:e}");
        }
    }
}

#[test]
fn moduli_without_a_stable_rest_state_are_refused() {
    let refused = |material: Material, name: &str| {
        let error = material.validate().unwrap_err();
        assert_eq!(error.name, name, "{error}");
    };
    refused(Material::MooneyRivlin(MooneyRivlin { c1: -1.0, c2: 0.0, bulk: None }), "c1");
    refused(Material::MooneyRivlin(MooneyRivlin { c1: 1.0, c2: f64::NAN, bulk: None }), "c2");
    refused(Material::MooneyRivlin(MooneyRivlin { c1: 1.0, c2: 0.0, bulk: Some(0.0) }), "bulk");
    refused(Material::Fung(Fung { shear: 1.0, exponent: 0.0, bulk: None }), "exponent");
    refused(Material::Ogden(Ogden { terms: vec![OgdenTerm { mu: 1.0, alpha: -2.0 }], bulk: None }), "mu");
    refused(Material::Hencky(Hencky { shear: 1.0, bulk: -1.0 }), "bulk");
    refused(Material::StVenantKirchhoff(StVenantKirchhoff { lambda: -1.0, mu: 1.0 }), "lambda");
    refused(Material::NeoHookeanLog(NeoHookeanLog { mu: 1.0, lambda: -0.1 }), "lambda");
    assert_eq!(Material::MooneyRivlin(MooneyRivlin { c1: 0.0, c2: 0.0, bulk: None }).validate(), Ok(()));
}
