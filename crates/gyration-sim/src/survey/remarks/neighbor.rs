//! What a neighbour in the fluid changes: two equal spheres that move along their line, and a sphere that moves towards
//! a plane, both slowly.
//!
//!   cosh α = r/2R:  λ = (4/3) sinh α Σ n(n+1)/((2n−1)(2n+3)) [1 − (4 s² − m² sinh²α)/(2 sinh mα + m sinh 2α)]
//!   cosh α = h/R:   λ = (4/3) sinh α Σ n(n+1)/((2n−1)(2n+3)) [(2 sinh mα + m sinh 2α)/(4 s² − m² sinh²α) − 1]
//!
//! with m = 2n + 1 and s = sinh(mα/2); r between the centres, h from the centre to the plane. λ is the drag in parts of
//! that of a sphere alone. No inclusion feels any of it: this tells how much is left out. Source: Stimson and Jeffery
//! 1926; Brenner 1961.

/// A term beside which all further ones are nothing.
const LAST: f64 = 1e-14;
/// Terms of a sum; enough for gaps of a millionth of the radius.
const MOST_TERMS: usize = 100_000;
/// The least gap, in radii, for which the sums are taken.
const LEAST_GAP: f64 = 1e-6;

/// How many times as fast two equal spheres move along their line under the same force as one alone; the distance of
/// their centres in radii, more than 2.
pub(super) fn pair_speed_ratio(distance: f64) -> f64 {
    // Spheres in touch differ by 1e-5 of it.
    1.0 / sum((0.5 * distance).max(1.0 + LEAST_GAP), |numerator, denominator| 1.0 - numerator / denominator)
}

/// How many times the drag of a sphere alone that of one is which moves towards a plane; the distance of its centre
/// from the plane in radii, more than 1.
pub(super) fn plane_drag_ratio(height: f64) -> f64 {
    if height < 1.0 + LEAST_GAP {
        return 1.0 / (height - 1.0);
    }
    sum(height, |numerator, denominator| denominator / numerator - 1.0)
}

/// (4/3) sinh α Σ n(n+1)/((2n−1)(2n+3)) bracket(4 s² − m² sinh²α, 2 sinh mα + m sinh 2α).
fn sum(cosh: f64, bracket: impl Fn(f64, f64) -> f64) -> f64 {
    let alpha = libm::acosh(cosh);
    let sinh = libm::sinh(alpha);
    let mut total = 0.0;
    for k in 1..MOST_TERMS {
        let n = k as f64;
        let m = 2.0 * n + 1.0;
        let half = libm::sinh(0.5 * m * alpha);
        let numerator = 4.0 * half * half - m * m * sinh * sinh;
        let denominator = 2.0 * libm::sinh(m * alpha) + m * libm::sinh(2.0 * alpha);
        if !denominator.is_finite() {
            break;
        }
        let term = n * (n + 1.0) / ((2.0 * n - 1.0) * (2.0 * n + 3.0)) * bracket(numerator, denominator);
        total += term;
        if term.abs() < LAST * total {
            break;
        }
    }
    4.0 / 3.0 * sinh * total
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Happel and Brenner, tables 6-3.1 and 7-4: exact values, and the first terms far away.
    #[test]
    fn neighbours_change_the_drag_as_published() {
        for (distance, ratio) in [(2.1, 1.54), (3.0, 1.43), (5.0, 1.29), (10.0, 1.15)] {
            assert!((pair_speed_ratio(distance) - ratio).abs() < 0.01, "{distance}: {}", pair_speed_ratio(distance));
        }
        // In touch the drag of each is 0.6451 of its own.
        assert!((1.0 / pair_speed_ratio(2.0 + 1e-5) - 0.6451).abs() < 1e-4);
        let far = 1000.0;
        assert!((pair_speed_ratio(far) - 1.0 - 1.5 / far).abs() < 10.0 / (far * far));
        let near: [(f64, f64); 3] = [(1.5430806, 3.0360), (1.1276260, 9.2518), (1.0050042, 201.86)];
        for (height, ratio) in near {
            assert!((plane_drag_ratio(height) / ratio - 1.0).abs() < 2e-3, "{height}: {}", plane_drag_ratio(height));
        }
        assert!((plane_drag_ratio(1.0076) - 134.0).abs() < 1.0, "{}", plane_drag_ratio(1.0076));
        assert!((plane_drag_ratio(far) - 1.0 / (1.0 - 9.0 / (8.0 * far))).abs() < 1e-6);
    }
}
