//! Whatever contracts an incompressible body, its start is projected once and then stays: resolved scenes are fixed
//! points.

use crate::common::{assert_resolves_to_itself, start};
use gyration::tensor::Mat3;
use gyration_scene::Scene;
use proptest::prelude::*;
use std::path::Path;

fn rows(matrix: &Mat3) -> String {
    format!("{:?}", [0, 1, 2].map(|i| [0, 1, 2].map(|j| matrix[(i, j)])))
}

fn matrix(size: f64) -> impl Strategy<Value = Mat3> {
    prop::array::uniform9(-size..size).prop_map(|entries| Mat3::from_row_slice(&entries))
}

/// An excess within the tolerance, or none.
fn excess() -> impl Strategy<Value = f64> {
    prop_oneof![Just(0.0), -9e-10..9e-10_f64]
}

/// A matrix near the identity, or far from it, of positive determinant.
fn contraction() -> impl Strategy<Value = Mat3> {
    let matrix = matrix(2.0).prop_filter("a determinant near zero", |g| g.determinant().abs() > 1e-2);
    matrix.prop_map(|g| g * g.determinant().signum())
}

proptest! {
    // Each case takes some milliseconds.
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn contractile_starts_within_the_tolerance_are_taken_and_stay(
        g in contraction(),
        f in contraction(),
        rate in matrix(30.0),
        swing in matrix(0.01),
        swollen in excess(),
        growth in excess(),
        prescribed in any::<bool>(),
    ) {
        // G = C + A sin(2πt), so that V_G(0) = 2π A C⁻¹; or G = C, isochoric.
        let flow = if prescribed { swing * std::f64::consts::TAU } else { Mat3::zeros() };
        let inverse = g.try_inverse().ok_or_else(|| TestCaseError::fail("G cannot be inverted"))?;
        let asked = (flow * inverse).trace();
        let p = f * ((1.0 + swollen) / f.determinant()).cbrt() * g;
        let rate = (rate - Mat3::from_diagonal_element((rate.trace() - asked - growth) / 3.0)) * p;
        let keys = match prescribed {
            true => format!(
                "prescribed = {{ sum = [{{ constant = {{ value = {} }} }}, \
                 {{ sine = {{ amplitude = {}, frequency = 1 }} }}] }}",
                rows(&g), rows(&swing)
            ),
            false => format!("contraction_viscosity = 1, isochoric = true, contraction = {}", rows(&g)),
        };
        // So short a run that det G stays positive.
        let text = format!(
            "[time]\nend = 1e-6\nsample = 1e-6\n[[body]]\nname = \"b\"\nshape = {{ box = {{ size = [1, 2, 3] }} }}\n\
             density = 1\ncontractile = {{ material = {{ neo_hookean = {{ shear = 1 }} }}, {keys} }}\n\
             gradient = {}\ngradient_rate = {}\n",
            rows(&p), rows(&rate)
        );
        let scene = Scene::parse("scene.toml", &text, Path::new(""), &[]);
        let scene = scene.map_err(|errors| TestCaseError::fail(errors.to_string()))?;
        let (held, held_rate) = (start(&scene).placement.gradient, start(&scene).velocity.gradient_rate);
        let across = held.try_inverse().ok_or_else(|| TestCaseError::fail("P cannot be inverted"))?;
        // Sixteen roundings of the terms of the determinants, and nine times as many of the traces, at most.
        let terms = |a: &Mat3| 6.0 * 16.0 * f64::EPSILON * a.amax().powi(3) / a.determinant();
        prop_assert!((held.determinant() / g.determinant() - 1.0).abs() <= terms(&held) + terms(&g));
        let products = |a: &Mat3, b: &Mat3| 9.0 * 16.0 * f64::EPSILON * a.amax() * b.amax();
        let left = (held_rate * across).trace() - asked;
        prop_assert!(left.abs() <= products(&held_rate, &across) + products(&flow, &inverse), "{left:e}");
        assert_resolves_to_itself(&scene);
    }
}
