//! The start of an incompressible body: |det P − 1| and |tr L| · 1 s within 1e-9 are projected, more is refused.
//!
//! A contractile body keeps det F, F = P G⁻¹, so that det P is to be det G. Its tr L is free while it is driven; it is
//! 0 if its contraction is isochoric, and tr Ġ G⁻¹ if that is prescribed. With g = det G and r = tr L asked for, P g^−⅓
//! and (Ṗ − r/3 P) g^−⅓ are those of a body of determinant one.
//!
//! What differs from the constraint by rounding only is left as it is, so that a projected start is its own projection
//! and a resolved scene resolves to itself.

use crate::check::Reporter;
use crate::key::Key;
use gyration::affine::AffineBody;
use gyration::contractile::{Contraction, ContractionSource};
use gyration::signal::Jet;
use gyration::tensor::Mat3;

/// The distance from det P = 1, and from tr L = 0 \[1/s\], up to which a start is taken to be meant on the constraint.
const ALLOWED: f64 = 1e-9;
/// The rounding of a sum of products, in units of its terms: their number, and as much again for their factors.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// What an incompressible material asks of the start of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct VolumeConstraint {
    /// det P, by the contraction.
    volume: f64,
    /// tr L \[1/s\] and its rounding; none if it is free.
    growth: Option<(f64, f64)>,
    /// What messages call what is kept at one.
    kept: &'static str,
}

impl VolumeConstraint {
    /// Of a body that does not contract: det P = 1, tr L = 0.
    pub(super) const VOLUME: Self = Self { volume: 1.0, growth: Some((0.0, 0.0)), kept: "its determinant" };

    /// Of a body that starts with this contraction.
    pub(super) fn beside(contraction: &Contraction, start: &Jet) -> Self {
        let growth = match (&contraction.source, contraction.kept_volume) {
            (ContractionSource::Prescribed(_), _) => growth(&start.value, &start.rate),
            (ContractionSource::Driven { .. }, Some(_)) => Some((0.0, 0.0)),
            (ContractionSource::Driven { .. }, None) => None,
        };
        Self { volume: start.value.determinant(), growth, kept: "det P/det G" }
    }

    /// What is to be one: det P/g, with the sum of the sizes of its terms.
    fn determinant(&self, gradient: &Mat3) -> (f64, f64) {
        (gradient.determinant() / self.volume, terms(gradient) / self.volume)
    }

    /// Ṗ with the tr L asked for, the way that a pressure would push.
    fn nearest_rate(&self, body: &AffineBody, gradient: &Mat3, rate: &Mat3) -> Mat3 {
        let (size, (asked, _)) = (libm::cbrt(self.volume), self.growth.unwrap_or_default());
        let swelling = gradient * (asked / 3.0);
        body.project(&(gradient / size), &((rate - swelling) / size)).rate * size + swelling
    }

    /// The nearest P of the volume asked for, the way that a pressure would push; else P with its volume scaled.
    fn nearest(&self, body: &AffineBody, gradient: &Mat3) -> Option<Mat3> {
        let size = libm::cbrt(self.volume);
        let scaled = gradient / libm::cbrt(self.determinant(gradient).0);
        let pushed = body.project(&(gradient / size), &Mat3::zeros()).gradient * size;
        [pushed, scaled].into_iter().find(|near| (self.determinant(near).0 - 1.0).abs() <= ALLOWED)
    }
}

/// P and Ṗ of a body as it starts.
#[derive(Debug, Clone, Copy)]
pub(super) struct GradientStart {
    pub gradient: Mat3,
    pub rate: Mat3,
}

/// P and Ṗ on the constraint of the body, if it has one; notes those too far from it, with the nearest that are on it.
pub(super) fn hold(
    body: &AffineBody,
    kept: &VolumeConstraint,
    given: GradientStart,
    key: &Key,
    reporter: &mut Reporter<'_>,
) -> Option<GradientStart> {
    let GradientStart { gradient, rate } = given;
    if !body.is_incompressible() {
        return in_range(&gradient, &rate, key, reporter).then_some(given);
    }
    let held = gradient_held(body, kept, &gradient, &key.key("gradient"), reporter);
    // Beside a gradient that is refused the rate is checked with the one that is offered, so that both are mended at
    // once.
    let checked = if held.is_some() { gradient } else { kept.nearest(body, &gradient).unwrap_or(gradient) };
    let rate = in_range(&checked, &rate, key, reporter).then_some(rate)?;
    let (rate, fault) = rate_held(body, kept, [&checked, &held.unwrap_or(checked)], &rate)?;
    if let Some(Refused { message, help }) = &fault {
        reporter.note(&key.key("gradient_rate"), message, help);
    }
    fault.is_none().then_some(GradientStart { gradient: held?, rate })
}

fn gradient_held(
    body: &AffineBody,
    kept: &VolumeConstraint,
    gradient: &Mat3,
    key: &Key,
    reporter: &mut Reporter<'_>,
) -> Option<Mat3> {
    let (determinant, terms) = kept.determinant(gradient);
    let excess = (determinant - 1.0).abs();
    if excess <= (ROUNDING * terms).min(ALLOWED) {
        return Some(*gradient);
    }
    let nearest = kept.nearest(body, gradient);
    if excess <= ALLOWED {
        return nearest;
    }
    let message = format!("{} is {determinant:?}, which an incompressible body keeps at 1", kept.kept);
    let help = match nearest {
        Some(nearest) => format!("write gradient = {}, or give the material a `bulk` modulus", rows(&nearest)),
        None if kept.volume == 1.0 => {
            "write a matrix of determinant 1, or give the material a `bulk` modulus".to_owned()
        }
        None => format!("write a matrix of determinant {:?}, or give the material a `bulk` modulus", kept.volume),
    };
    reporter.note(key, message, help);
    None
}

/// Message and fix.
struct Refused {
    message: String,
    help: String,
}

/// Ṗ with the tr L asked for at the gradient `held`, if it had that, nearly, at the gradient `checked`; else also the
/// fault.
fn rate_held(
    body: &AffineBody,
    kept: &VolumeConstraint,
    [checked, held]: [&Mat3; 2],
    rate: &Mat3,
) -> Option<(Mat3, Option<Refused>)> {
    let Some((asked, allowance)) = kept.growth else { return Some((*rate, None)) };
    let (given, _) = growth(checked, rate)?;
    let (left, rounding) = growth(held, rate)?;
    if (left - asked).abs() <= rounding + allowance {
        return Some((*rate, None));
    }
    let nearest = kept.nearest_rate(body, held, rate);
    if (given - asked).abs() <= ALLOWED {
        return Some((nearest, None));
    }
    let wanted = match asked {
        0.0 => "tr L = 0".to_owned(),
        _ => format!("tr L = {asked:?} 1/s"),
    };
    let why = match asked {
        0.0 => "the body is incompressible".to_owned(),
        _ => format!("the contraction of the incompressible body at {asked:?} 1/s"),
    };
    let message = format!("its volume would change at tr L = {given:?} 1/s, L = Ṗ P⁻¹, and {why}");
    let help = match nearest.iter().all(|entry| entry.is_finite()) {
        true => format!("write gradient_rate = {}, or give the material a `bulk` modulus", rows(&nearest)),
        false => format!("write a rate with {wanted}, or give the material a `bulk` modulus"),
    };
    Some((nearest, Some(Refused { message, help })))
}

/// tr Ṗ P⁻¹ \[1/s\] and its rounding: nine products of entries, whose cancellation a fast spin makes visible.
fn growth(gradient: &Mat3, rate: &Mat3) -> Option<(f64, f64)> {
    let inverse = gradient.try_inverse()?;
    Some(((rate * inverse).trace(), 9.0 * ROUNDING * rate.amax() * inverse.amax()))
}

/// Whether L = Ṗ P⁻¹ can be held in numbers; notes it otherwise.
fn in_range(gradient: &Mat3, rate: &Mat3, key: &Key, reporter: &mut Reporter<'_>) -> bool {
    let size = gradient.try_inverse().map(|inverse| rate.amax() * inverse.amax());
    // Squares of L have a place in the balance.
    let held = size.is_some_and(|size| (size * size).is_finite()) && rate.iter().all(|entry| entry.is_finite());
    if !held {
        let name = if key.key("gradient_rate").is_written(&reporter.document.root) {
            "gradient_rate"
        } else {
            "angular_velocity"
        };
        reporter.note(&key.key(name), "the velocity gradient leaves the range of numbers", "write smaller rates");
    }
    held
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
pub(super) fn rows(matrix: &Mat3) -> String {
    let row = |index: usize| {
        let [x, y, z] = [0, 1, 2].map(|column| matrix[(index, column)]);
        format!("[{x:?}, {y:?}, {z:?}]")
    };
    format!("[{}, {}, {}]", row(0), row(1), row(2))
}
