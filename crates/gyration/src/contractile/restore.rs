//! Puts P, Ṗ and G back to where a step should have left them.
//!
//! An incompressible material has det P = det G. Where the law of contraction gives the pressure, det G follows det P,
//! since the pressure acts on V_G at once; where det G is kept or prescribed, P and Ṗ follow, as those of an
//! incompressible affine body.

use super::{Contraction, ContractionSource};
use crate::affine::{AffineBody, Correction};
use crate::tensor::Mat3;

/// A configuration, a velocity and a contraction that belong together, and how far they were from it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Restored {
    /// P.
    pub gradient: Mat3,
    /// Ṗ [1/s].
    pub rate: Mat3,
    /// G.
    pub contraction: Mat3,
    /// The relative error of det G or det P before.
    pub size: f64,
}

impl Contraction {
    /// P, Ṗ and G at a time [s], with det F = 1 if the material is incompressible and det G as it has to be; G is that
    /// which is prescribed, if it is.
    pub fn restore(&self, body: &AffineBody, time: f64, (p, rate, g): (&Mat3, &Mat3, &Mat3)) -> Restored {
        let incompressible = body.is_incompressible();
        let (contraction, growth) = match &self.source {
            ContractionSource::Prescribed(signal) => {
                let jet = signal.jet(time);
                let growth = jet.value.try_inverse().map_or(f64::NAN, |inverse| (jet.rate * inverse).trace());
                (jet.value, growth)
            }
            ContractionSource::Driven { .. } => match self.kept_volume {
                Some(volume) => (with_volume(g, volume), 0.0),
                None if incompressible => (with_volume(g, p.determinant()), 0.0),
                None => (*g, 0.0),
            },
        };
        let mut size = (contraction.determinant() / g.determinant() - 1.0).abs();
        let (mut gradient, mut gradient_rate) = (*p, *rate);
        if incompressible && !self.gives_pressure() {
            let correction = body.project_to(p, rate, contraction.determinant(), growth);
            size = size.max(correction.size);
            Correction { gradient, rate: gradient_rate, .. } = correction;
        }
        Restored { gradient, rate: gradient_rate, contraction, size }
    }
}

/// A matrix with another determinant, of the same form.
fn with_volume(matrix: &Mat3, volume: f64) -> Mat3 {
    matrix * libm::cbrt(volume / matrix.determinant())
}
