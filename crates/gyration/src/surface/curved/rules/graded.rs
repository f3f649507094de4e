//! Quadrature rules for curved surfaces.
//!
//! Gauss–Legendre rules on [−1, 1], exact for polynomials of degree 2n − 1, are computed once by Newton's iteration on
//! the three-term recurrence and kept for the life of the program: only the first call of each allocates. On an
//! interval next to a singularity they are graded by x = ± δ sinh y, δ the distance of the singularity: in y it stays
//! at iπ/2 however close it is, so that the number of points grows only like ln(length/δ).

use std::sync::OnceLock;

/// A node on [−1, 1] and its weight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct QuadratureNode {
    /// x.
    pub at: f64,
    /// Its weight.
    pub weight: f64,
}

/// The largest number of points that [`gauss_legendre`] offers.
pub(crate) const MAX_GAUSS: usize = 128;

/// The Gauss–Legendre rule of `points` nodes on [−1, 1], one to 128 of them, in increasing order.
pub fn gauss_legendre(points: usize) -> &'static [QuadratureNode] {
    static RULES: [OnceLock<Box<[QuadratureNode]>>; MAX_GAUSS] = [const { OnceLock::new() }; MAX_GAUSS];
    let n = points.clamp(1, MAX_GAUSS);
    RULES[n - 1].get_or_init(|| (0..n).map(|i| legendre_node(n, i)).collect())
}

/// The i-th zero of P_n and its weight 2/((1 − x²) P_n'(x)²), by Newton from Tricomi's estimate.
fn legendre_node(n: usize, i: usize) -> QuadratureNode {
    let count = n as f64;
    let mut x = -libm::cos((i as f64 + 0.75) / (count + 0.5) * std::f64::consts::PI);
    let mut slope = 0.0;
    for _ in 0..8 {
        let (value, derivative) = legendre(n, x);
        slope = derivative;
        let step = value / derivative;
        x -= step;
        if step.abs() < 1e-15 {
            slope = legendre(n, x).1;
            break;
        }
    }
    QuadratureNode { at: x, weight: 2.0 / ((1.0 - x * x) * slope * slope) }
}

/// P_n(x) and P_n'(x) by the recurrence k P_k = (2k − 1) x P_(k−1) − (k − 1) P_(k−2).
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut previous, mut value) = (1.0, x);
    for k in 2..=n {
        let k = k as f64;
        (previous, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * previous) / k);
    }
    (value, n as f64 * (x * value - previous) / (x * x - 1.0))
}

/// An interval that a graded Gauss rule covers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct GradedInterval {
    /// The end next to which points are dense.
    pub(crate) from: f64,
    /// The other end, on either side.
    pub(crate) to: f64,
    /// δ, the distance over which they are dense.
    pub(crate) width: f64,
}

/// A complex singularity of the integrand, x = at ± i distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Singularity {
    pub(crate) at: f64,
    pub(crate) distance: f64,
    /// The natural logarithm of the accuracy that it must be resolved to; poles of higher order need more.
    pub(crate) digits: f64,
}

impl GradedInterval {
    /// The length of the interval in y.
    fn span(&self) -> f64 {
        libm::asinh((self.to - self.from).abs() / self.width)
    }

    /// The nodes of the rule with `points` points.
    pub(crate) fn nodes(self, points: usize) -> impl Iterator<Item = QuadratureNode> {
        let half = 0.5 * self.span();
        let sign = self.width.copysign(self.to - self.from);
        gauss_legendre(points).iter().map(move |node| {
            let growth = libm::exp(half * (1.0 + node.at));
            let (sinh, cosh) = (0.5 * (growth - 1.0 / growth), 0.5 * (growth + 1.0 / growth));
            QuadratureNode { at: self.from + sign * sinh, weight: self.width * cosh * half * node.weight }
        })
    }

    /// The number of points that resolves the singularities.
    ///
    /// Gauss converges like r^−2n, r the sum of the semi-axes of the ellipse with foci ±1 through the singularity,
    /// which is at y = asinh((x − from)/δ), z = 2y/span − 1: r = s + √(s² − 1), s = (|z − 1| + |z + 1|)/2.
    pub(crate) fn points(&self, singularities: &[Singularity]) -> usize {
        /// For the smooth factors beside the singularities: powers of X up to the third.
        const SPARE: f64 = 3.0;
        let span = self.span();
        let sign = 1f64.copysign(self.to - self.from);
        let needed = singularities.iter().map(|singularity| {
            let x = sign * (singularity.at - self.from) / self.width;
            let y = singularity.distance / self.width;
            let t = 0.5 * (libm::hypot(x, y + 1.0) + libm::hypot(x, y - 1.0));
            let real = 2.0 * libm::acosh(t.max(1.0)).copysign(x) / span - 1.0;
            let imaginary = 2.0 * libm::asin((y / t).min(1.0)) / span;
            let s = 0.5 * (libm::hypot(real - 1.0, imaginary) + libm::hypot(real + 1.0, imaginary));
            singularity.digits / (2.0 * libm::log(s + (s * s - 1.0).max(0.0).sqrt()))
        });
        (needed.fold(0.0, f64::max) + SPARE).min(MAX_GAUSS as f64).ceil() as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gauss_legendre_is_exact_for_the_degree_it_promises() {
        // Round-off of n terms bounds the error.
        for n in [1, 2, 5, 16, 33, 64, 128] {
            let rule = gauss_legendre(n);
            for degree in [0, 2 * n - 2] {
                let sum: f64 = rule.iter().map(|node| node.weight * node.at.powi(degree as i32)).sum();
                let exact = 2.0 / (degree as f64 + 1.0);
                assert!((sum - exact).abs() < 2e-14, "n {n}, degree {degree}: {sum} against {exact}");
            }
        }
    }
}
