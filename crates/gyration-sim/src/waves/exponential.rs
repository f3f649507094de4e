//! exp(A) and its derivative along a matrix: the series of a small part of A, squared until it is A.

use gyration::tensor::Mat3;

/// Terms of the series of a matrix whose norm is below a half: the last is below 2⁻⁵³.
const TERMS: u32 = 16;

/// exp(A) and d/ds exp(A + sB) at s = 0.
///
/// The pair (E, D) squares to (E², ED + DE).
pub(super) fn exponential(a: &Mat3, b: &Mat3) -> [Mat3; 2] {
    let mut halvings = 0;
    let mut norm = a.norm();
    while norm > 0.5 {
        norm *= 0.5;
        halvings += 1;
    }
    let part = (0..halvings).fold(1.0, |part: f64, _| 0.5 * part);
    let (a, b) = (part * a, part * b);
    let (mut term, mut slope) = (Mat3::identity(), Mat3::zeros());
    let (mut sum, mut change) = (term, slope);
    for k in 1..=TERMS {
        slope = (slope * a + term * b) / f64::from(k);
        term = term * a / f64::from(k);
        sum += term;
        change += slope;
    }
    for _ in 0..halvings {
        change = sum * change + change * sum;
        sum *= sum;
    }
    [sum, change]
}

#[cfg(test)]
mod tests {
    use super::*;
    use gyration::tensor::{Vec3, cross_matrix};

    #[test]
    fn exponential_of_a_turn_is_a_rotation_and_its_slope_agrees_with_differences() {
        let (a, b) =
            (cross_matrix(&Vec3::new(0.4, -1.3, 2.2)), Mat3::new(0.3, 0.1, -0.2, 0.5, 0.7, 0.2, -0.4, 0.6, 1.0));
        let [turn, slope] = exponential(&a, &b);
        let axis = nalgebra::Rotation3::new(Vec3::new(0.4, -1.3, 2.2));
        // Three squarings of rounded matrices.
        assert!((turn - axis.matrix()).norm() < 1e-14);
        let h = 1e-5;
        let difference = (exponential(&(a + h * b), &b)[0] - exponential(&(a - h * b), &b)[0]) / (2.0 * h);
        // Central differences: h² and rounding over h.
        assert!((slope - difference).norm() < 1e-9, "{:e}", (slope - difference).norm());
    }
}
