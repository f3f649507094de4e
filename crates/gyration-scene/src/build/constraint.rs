//! The start of an incompressible body: |det P − 1| and |tr L| · 1 s within 1e-9 are projected, more is refused.
//!
//! What differs from the constraint by rounding only is left as it is, so that a projected start is its own projection
//! and a resolved scene resolves to itself.

use crate::check::Judge;
use crate::key::Key;
use gyration::affine::AffineBody;
use gyration::tensor::Mat3;

/// The distance from det P = 1, and from tr L = 0 \[1/s\], up to which a start is taken to be meant on the constraint.
const ALLOWED: f64 = 1e-9;
/// The rounding of a sum of products, in units of its terms: their number, and as much again for their factors.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// P and Ṗ on the constraint of the body, if it has one; notes those too far from it, with the nearest that are on it.
pub(super) fn hold(body: &AffineBody, given: (Mat3, Mat3), key: &Key, judge: &mut Judge<'_>) -> Option<(Mat3, Mat3)> {
    let (gradient, rate) = given;
    if !body.is_incompressible() {
        return in_range(&gradient, &rate, key, judge).then_some(given);
    }
    let held = gradient_held(body, &gradient, &key.key("gradient"), judge);
    // Beside a gradient that is refused the rate is judged with the one that is offered, so that both are mended at once.
    let judged = if held.is_some() { gradient } else { nearest(body, &gradient).unwrap_or(gradient) };
    let rate = in_range(&judged, &rate, key, judge).then_some(rate)?;
    let rate = rate_held(body, [&judged, &held.unwrap_or(judged)], &rate, key, judge);
    Some((held?, rate?))
}

fn gradient_held(body: &AffineBody, gradient: &Mat3, key: &Key, judge: &mut Judge<'_>) -> Option<Mat3> {
    let determinant = gradient.determinant();
    let excess = (determinant - 1.0).abs();
    if excess <= (ROUNDING * terms(gradient)).min(ALLOWED) {
        return Some(*gradient);
    }
    let nearest = nearest(body, gradient);
    if excess <= ALLOWED {
        return nearest;
    }
    let message = format!("its determinant is {determinant:?}, which an incompressible body keeps at 1");
    let help = match nearest {
        Some(nearest) => format!("write gradient = {}, or give the material a `bulk` modulus", rows(&nearest)),
        None => "write a matrix of determinant 1, or give the material a `bulk` modulus".to_owned(),
    };
    judge.note(key, message, help);
    None
}

/// Ṗ with tr L = 0 at the gradient `held`, if that was so, nearly, at the gradient `judged`.
fn rate_held(
    body: &AffineBody,
    [judged, held]: [&Mat3; 2],
    rate: &Mat3,
    key: &Key,
    judge: &mut Judge<'_>,
) -> Option<Mat3> {
    let (given, _) = growth(judged, rate)?;
    let (left, rounding) = growth(held, rate)?;
    if left.abs() <= rounding {
        return Some(*rate);
    }
    let nearest = body.project(held, rate).rate;
    if given.abs() <= ALLOWED {
        return Some(nearest);
    }
    let message = format!("its volume would change at tr L = {given:?} 1/s, L = Ṗ P⁻¹, and the body is incompressible");
    let help = match nearest.iter().all(|entry| entry.is_finite()) {
        true => format!("write gradient_rate = {}, or give the material a `bulk` modulus", rows(&nearest)),
        false => "write a rate with tr L = 0, or give the material a `bulk` modulus".to_owned(),
    };
    judge.note(&key.key("gradient_rate"), message, help);
    None
}

/// tr L \[1/s\] and its rounding: nine products of entries, whose cancellation a fast spin makes visible.
fn growth(gradient: &Mat3, rate: &Mat3) -> Option<(f64, f64)> {
    let inverse = gradient.try_inverse()?;
    Some(((rate * inverse).trace(), 9.0 * ROUNDING * rate.amax() * inverse.amax()))
}

/// Whether L = Ṗ P⁻¹ can be held in numbers; notes it otherwise.
fn in_range(gradient: &Mat3, rate: &Mat3, key: &Key, judge: &mut Judge<'_>) -> bool {
    let size = gradient.try_inverse().map(|inverse| rate.amax() * inverse.amax());
    // Squares of L have a place in the balance.
    let held = size.is_some_and(|size| (size * size).is_finite()) && rate.iter().all(|entry| entry.is_finite());
    if !held {
        let name = if key.key("gradient_rate").is_written(&judge.document.root) {
            "gradient_rate"
        } else {
            "angular_velocity"
        };
        judge.note(&key.key(name), "the velocity gradient leaves the range of numbers", "write smaller rates");
    }
    held
}

/// The nearest P of determinant one, the way that a pressure would push; else P with its volume scaled away.
fn nearest(body: &AffineBody, gradient: &Mat3) -> Option<Mat3> {
    let scaled = gradient / gradient.determinant().cbrt();
    let pushed = body.project(gradient, &Mat3::zeros()).gradient;
    [pushed, scaled].into_iter().find(|near| (near.determinant() - 1.0).abs() <= ALLOWED)
}

/// The sum of the sizes of the terms of det P.
fn terms(p: &Mat3) -> f64 {
    let p = p.abs();
    let minor = |a: f64, b: f64, c: f64, d: f64| a * b + c * d;
    p.m11 * minor(p.m22, p.m33, p.m23, p.m32)
        + p.m12 * minor(p.m21, p.m33, p.m23, p.m31)
        + p.m13 * minor(p.m21, p.m32, p.m22, p.m31)
}

/// A matrix as a scene has it, with all its digits.
fn rows(matrix: &Mat3) -> String {
    let row = |index: usize| {
        let [x, y, z] = [0, 1, 2].map(|column| matrix[(index, column)]);
        format!("[{x:?}, {y:?}, {z:?}]")
    };
    format!("[{}, {}, {}]", row(0), row(1), row(2))
}
