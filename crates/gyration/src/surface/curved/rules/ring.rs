//! Quadrature around a circle over which the gap is a − b cos θ.
//!
//! The integrand is singular where the gap vanishes, at θ = ±iη with tan(iη/2) = ip, p² = (a−b)/(a+b), and at ±i∞. The
//! substitution
//!
//!   tan(θ/2) = p sc(w | k),   k'² = 1 − k² = p²,   dθ = 2p/dn(w) dw
//!
//! maps the strip |Im w| < K'(k) onto the θ-cylinder slit from ±iη to ±i∞, so that the trapezoidal rule in w, which is
//! periodic with period 2K, converges like exp(−2πK'/step) whatever the singularity: the number of points grows only
//! like K ≈ ln(4/p). It does so too with any smaller p, whose slit is longer, so that rules are kept for p² = P₀ 2^−i.
//! The integrand must be even in θ; nodes cover 0 ≤ θ ≤ π and weights count both halves. Source of the idea: N. Hale
//! and T. W. Tee, SIAM J. Sci. Comput. 31 (2009) 3195, conformal maps to slit domains.

use std::f64::consts::{FRAC_PI_2, TAU};
use std::sync::OnceLock;

use super::integrand::{LANES, Lane};

/// A point of the circle, with the weight of both θ and −θ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct RingNode {
    pub(crate) weight: f64,
    pub(crate) cos: f64,
    /// 1 − cos θ without cancellation: the gap is (a − b) + b · versine.
    pub(crate) versine: f64,
    /// sin² θ.
    pub(crate) sin_squared: f64,
}

/// [`LANES`] consecutive points; those that fill the last chunk have no weight.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct RingChunk {
    pub(crate) weight: Lane,
    pub(crate) cos: Lane,
    pub(crate) versine: Lane,
    pub(crate) sin_squared: Lane,
}

/// The points of these chunks, one by one.
#[inline(always)]
pub(crate) fn nodes(chunks: &[RingChunk]) -> impl Iterator<Item = RingNode> + '_ {
    chunks.iter().flat_map(|chunk| {
        let node = |lane: usize| RingNode {
            weight: chunk.weight[lane],
            cos: chunk.cos[lane],
            versine: chunk.versine[lane],
            sin_squared: chunk.sin_squared[lane],
        };
        (0..LANES).map(node).filter(|node| node.weight != 0.0)
    })
}

/// The rules that meet one demand, for every ratio of the gaps.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rings {
    rows: &'static [Vec<RingChunk>],
}

/// What is asked of a ring: integrands d^−ν cosⁱθ with `mildest` ≤ ν ≤ `sharpest` and i ≤ `degree`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Demand {
    pub(crate) sharpest: f64,
    pub(crate) mildest: f64,
    pub(crate) degree: usize,
}

/// p² of the first rule.
const FIRST: f64 = 0.9;

/// The rules go down to p² = 1e-15, below which a gap is lost in the rounding of a and b.
const LEVELS: usize = 50;

/// Frequencies 2π/step grow by this factor from one class of rules to the next.
const CLASS_RATIO: f64 = 1.12;
const LN_CLASS_RATIO: f64 = 0.11332868530700327;
const LOWEST_FREQUENCY: f64 = 16.0;
const CLASSES: usize = 16;

/// Degrees from 0 to this are told apart.
const MOST_DEGREES: usize = 5;

impl Rings {
    /// The rules for a demand; they are computed at its first use.
    pub(crate) fn new(demand: &Demand) -> Self {
        static TABLES: [[OnceLock<Vec<Vec<RingChunk>>>; CLASSES]; MOST_DEGREES + 1] =
            [const { [const { OnceLock::new() }; CLASSES] }; MOST_DEGREES + 1];
        let degree = demand.degree.min(MOST_DEGREES);
        let above = libm::log(frequency(demand) / LOWEST_FREQUENCY) / LN_CLASS_RATIO;
        let class = (above.ceil().max(0.0) as usize).min(CLASSES - 1);
        let rows = TABLES[degree][class].get_or_init(|| {
            let frequency = LOWEST_FREQUENCY * CLASS_RATIO.powi(class as i32);
            let levels = (0..LEVELS).map(|level| FIRST * 0.5f64.powi(level as i32));
            levels.map(|squared| row(squared, frequency, degree as f64)).collect()
        });
        Self { rows }
    }

    /// The rule for gaps between `near` and `far` ≥ `near` > 0, from θ = 0, where the gap is smallest, to θ = π.
    #[inline]
    pub(crate) fn chunks(&self, near: f64, far: f64) -> &'static [RingChunk] {
        let level = libm::log2(FIRST * far / near).ceil().max(0.0) as usize;
        &self.rows[level.min(LEVELS - 1)]
    }
}

/// The rule with k'² = `squared`.
fn row(squared: f64, frequency: f64, degree: f64) -> Vec<RingChunk> {
    let (p, modulus) = (squared.sqrt(), 1.0 - squared);
    let (quarter, height) = (FRAC_PI_2 / mean(p), FRAC_PI_2 / mean(modulus.sqrt()));
    // The singularities lie at the height K' ≥ π/2; powers of cos θ shift harmonics by their degree where the gap
    // hardly varies.
    let wanted = frequency * FRAC_PI_2 / height + 2.0 * degree * p;
    let intervals = (quarter * wanted / TAU).ceil().max(1.0) as usize + 1;
    let step = quarter / intervals as f64;
    let (s1, c1) = sine_and_cosine(step, p);
    let d1 = (c1 * c1 + squared * s1 * s1).sqrt();
    let (mut s, mut c) = (0.0, 1.0);
    let mut chunks = vec![RingChunk::default(); (intervals + 1).div_ceil(LANES)];
    for j in 0..chunks.len() * LANES {
        let (chunk, lane) = (&mut chunks[j / LANES], j % LANES);
        let dn_squared = c * c + squared * s * s;
        let d = f64::sqrt(dn_squared);
        let half_sine = squared * s * s / dn_squared;
        let half_cosine = c * c / dn_squared;
        let share = if j > intervals {
            0.0
        } else if j == 0 || j == intervals {
            1.0
        } else {
            2.0
        };
        chunk.weight[lane] = share * step * 2.0 * p / d;
        chunk.cos[lane] = half_cosine - half_sine;
        chunk.versine[lane] = 2.0 * half_sine;
        chunk.sin_squared[lane] = 4.0 * half_sine * half_cosine;
        if j < intervals {
            // Addition theorem for one more step.
            let inverse = 1.0 / (1.0 - modulus * s * s * s1 * s1);
            (s, c) = ((s * c1 * d1 + s1 * c * d) * inverse, (c * c1 - s * d * s1 * d1) * inverse);
        }
    }
    chunks
}

/// The frequency 2π/step that brings the rule's relative error down to some 1e-11, for K' = π/2.
///
/// A trapezoidal rule errs by the Fourier coefficient at that frequency. For p → 0 the integrand tends to sechⁿ w, n =
/// 2ν − 1, whose coefficient is |Γ((n+iω)/2)|²/Γ(n/2)²; the fit solves it for the error.
pub(crate) fn frequency(demand: &Demand) -> f64 {
    let degree = demand.degree as f64;
    let order = (2.0 * demand.sharpest - 1.0).max(2.0 * degree + 1.0 - 2.0 * demand.mildest).max(1.0);
    7.2 * (order + 6.5).sqrt()
}

/// The arithmetic–geometric mean of 1 and x in (0, 1]; K(k) = π/(2 mean(k')).
pub(crate) fn mean(x: f64) -> f64 {
    let (mut a, mut g) = (1.0, x);
    while a - g > 1e-8 * a {
        (a, g) = (0.5 * (a + g), (a * g).sqrt());
    }
    // One more step squares the relative difference.
    0.5 * (a + g)
}

/// sn and cn of w, from the series at w/2⁷ doubled seven times.
pub(crate) fn sine_and_cosine(w: f64, complement: f64) -> (f64, f64) {
    const DOUBLINGS: i32 = 7;
    let squared = complement * complement;
    let m = 1.0 - squared;
    let u = w / f64::from(1 << DOUBLINGS);
    let mut s = u * (1.0 - u * u / 6.0 * (1.0 + m - u * u / 20.0 * (1.0 + m * (14.0 + m))));
    let mut c = (1.0 - s * s).sqrt();
    for _ in 0..DOUBLINGS {
        let d = (c * c + squared * s * s).sqrt();
        let inverse = 1.0 / (1.0 - m * s * s * s * s);
        (s, c) = (2.0 * s * c * d * inverse, (c * c - s * s * d * d) * inverse);
    }
    (s, c)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    /// ∫ (a − b cos θ)^−ν dθ for ν = 1, 2, 3, with q² = a² − b² = near · far.
    fn exact(near: f64, far: f64, nu: i32) -> f64 {
        let (a, b, q) = (0.5 * (near + far), 0.5 * (far - near), (near * far).sqrt());
        match nu {
            1 => TAU / q,
            2 => TAU * a / q.powi(3),
            _ => PI * (2.0 * a * a + b * b) / q.powi(5),
        }
    }

    #[test]
    fn inverse_powers_around_the_circle_are_the_closed_forms() {
        let mut worst: f64 = 0.0;
        for near in [1e-8, 1e-4, 0.01, 0.3, 0.9, 1.0] {
            for nu in 1..=3 {
                let demand = Demand { sharpest: f64::from(nu), mildest: f64::from(nu), degree: 0 };
                let nodes = nodes(Rings::new(&demand).chunks(near, 1.0));
                let sum: f64 = nodes.map(|n| n.weight * (near + 0.5 * (1.0 - near) * n.versine).powi(-nu)).sum();
                worst = worst.max((sum / exact(near, 1.0, nu) - 1.0).abs());
            }
        }
        println!("ring, inverse powers: worst relative error {worst:.1e}");
        assert!(worst < 1e-10, "the rule promises 1e-11: {worst:e}");
    }

    #[test]
    fn high_powers_and_harmonics_agree_with_a_much_finer_rule() {
        let mut worst: f64 = 0.0;
        for near in [1e-8, 1e-4, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.97, 0.999] {
            for nu in [-1.0, 0.0, 0.5, 1.0, 2.5, 4.0, 6.0, 9.3, 13.0] {
                for degree in 0..=5 {
                    let sum = |demand: &Demand| -> f64 {
                        let term = |n: RingNode| {
                            let kernel: f64 = (near + 0.5 * (1.0 - near) * n.versine).powf(-nu);
                            n.weight * kernel * n.cos.powi(degree)
                        };
                        nodes(Rings::new(demand).chunks(near, 1.0)).map(term).sum()
                    };
                    let demand = Demand { sharpest: nu, mildest: nu, degree: degree as usize };
                    let fine = Demand { sharpest: 60.0, mildest: nu, degree: 20 };
                    let scale = nodes(Rings::new(&fine).chunks(near, 1.0));
                    let scale: f64 = scale.map(|n| n.weight * (near + 0.5 * (1.0 - near) * n.versine).powf(-nu)).sum();
                    let error = (sum(&demand) - sum(&fine)).abs() / scale;
                    worst = worst.max(error);
                    assert!(error < 2e-10, "near {near}, ν {nu}, degree {degree}: {error:e}");
                }
            }
        }
        println!("ring, harmonics: worst relative error {worst:.1e}");
    }
}
