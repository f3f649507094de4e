//! Symmetric quadrature rules on a triangle, as barycentric points with weights of sum one.
//!
//!   ∫ f dA = A Σ w_q f(x_q)
//!
//! Sources: Radon (1948) for degree 5; Dunavant, *Int. J. Numer. Meth. Engng* 21 (1985) 1129, for degrees 2 and 6.

/// A point of a rule.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct RulePoint {
    /// Barycentric coordinates.
    pub barycentric: [f64; 3],
    /// Weight; those of a rule have the sum one.
    pub weight: f64,
}

const fn point(weight: f64, first: f64, second: f64, third: f64) -> RulePoint {
    RulePoint { barycentric: [first, second, third], weight }
}

/// Degree 5, seven points.
pub(crate) const DEGREE_5: [RulePoint; 7] = {
    const OUTER: f64 = 0.125_939_180_544_827_15;
    const INNER: f64 = 0.132_394_152_788_506_2;
    const A: f64 = 0.101_286_507_323_456_34;
    const B: f64 = 0.470_142_064_105_115_1;
    const THIRD: f64 = 1.0 / 3.0;
    [
        point(0.225, THIRD, THIRD, THIRD),
        point(OUTER, 1.0 - 2.0 * A, A, A),
        point(OUTER, A, 1.0 - 2.0 * A, A),
        point(OUTER, A, A, 1.0 - 2.0 * A),
        point(INNER, 1.0 - 2.0 * B, B, B),
        point(INNER, B, 1.0 - 2.0 * B, B),
        point(INNER, B, B, 1.0 - 2.0 * B),
    ]
};

/// Degree 6, twelve points.
pub(crate) const DEGREE_6: [RulePoint; 12] = {
    const WIDE: f64 = 0.116_786_275_726_379_37;
    const CORNER: f64 = 0.050_844_906_370_206_82;
    const SIDE: f64 = 0.082_851_075_618_373_57;
    const A: f64 = 0.249_286_745_170_910_42;
    const B: f64 = 0.063_089_014_491_502_23;
    const C: f64 = 0.053_145_049_844_816_95;
    const D: f64 = 0.310_352_451_033_784_4;
    const E: f64 = 1.0 - C - D;
    [
        point(WIDE, 1.0 - 2.0 * A, A, A),
        point(WIDE, A, 1.0 - 2.0 * A, A),
        point(WIDE, A, A, 1.0 - 2.0 * A),
        point(CORNER, 1.0 - 2.0 * B, B, B),
        point(CORNER, B, 1.0 - 2.0 * B, B),
        point(CORNER, B, B, 1.0 - 2.0 * B),
        point(SIDE, C, D, E),
        point(SIDE, C, E, D),
        point(SIDE, D, C, E),
        point(SIDE, D, E, C),
        point(SIDE, E, C, D),
        point(SIDE, E, D, C),
    ]
};

#[cfg(test)]
mod tests {
    use super::*;

    fn factorial(n: u32) -> f64 {
        (1..=n).map(f64::from).product()
    }

    /// Mean of λ₁^i λ₂^j λ₃^k = 2 i! j! k!/(i+j+k+2)!.
    fn mean(powers: [u32; 3]) -> f64 {
        2.0 * powers.map(factorial).iter().product::<f64>() / factorial(powers.iter().sum::<u32>() + 2)
    }

    fn largest_error(rule: &[RulePoint], degree: u32) -> f64 {
        let mut worst = 0.0_f64;
        for i in 0..=degree {
            for j in 0..=degree - i {
                let powers = [i, j, degree - i - j];
                let term = |p: &RulePoint| {
                    let factors = p.barycentric.iter().zip(powers).map(|(l, n)| l.powi(n as i32));
                    p.weight * factors.product::<f64>()
                };
                worst = worst.max((rule.iter().map(term).sum::<f64>() - mean(powers)).abs());
            }
        }
        worst
    }

    #[test]
    fn rules_integrate_polynomials_up_to_their_degree_and_no_further() {
        // Rounding of tables of sixteen digits.
        assert!((0..=5).all(|degree| largest_error(&DEGREE_5, degree) < 1e-15));
        assert!((0..=6).all(|degree| largest_error(&DEGREE_6, degree) < 1e-15));
        assert!(largest_error(&DEGREE_5, 6) > 1e-6 && largest_error(&DEGREE_6, 7) > 1e-6);
    }
}
