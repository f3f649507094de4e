//! Principal stretches and axes of a gradient: C = PᵀP = N diag(c) Nᵀ.
//!
//! With m = tr C/3, B = C − m I and 6p² = |B|², the principal values of B/p are 2 cos φ, cos 3φ = ½ det(B/p) = r. The
//! one that lies farthest from the others is ±2x, 4x³ − 3x = |r|, √¾ ≤ x ≤ 1, which is well conditioned; so is its
//! axis, the largest column of the adjugate of B/p ∓ 2x I. In the plane across it one rotation of Jacobi's is exact. No
//! value is found as a difference of others, so that equal and nearly equal ones are no special case: N is orthogonal
//! to rounding, and c_i = |P N_i|². Source of the division into an axis and a plane: Scherzinger and Dohrmann 2008.

use crate::simd::{SimdMat3, SimdVec3, UNIT};

/// Principal values and axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Spectrum {
    /// c_i, in no order.
    pub values: [f64; 3],
    /// N, an axis a column.
    pub axes: SimdMat3,
    /// P N.
    pub carried: SimdMat3,
}

impl Spectrum {
    /// Of PᵀP; not finite where P is not.
    #[inline(never)]
    pub fn of(p: &SimdMat3) -> Self {
        let axes = principal_axes(&p.transpose().times(p));
        let carried = p.times(&axes);
        let SimdMat3([x, y, z]) = &carried;
        Self { values: [x.dot(x), y.dot(y), z.dot(z)], axes, carried }
    }
}

/// Values that differ by less than this part of them are equal: some roundings of their sum and of its third.
const EQUAL: f64 = 8.0 * f64::EPSILON;

/// N of a positive matrix.
#[inline(always)]
fn principal_axes(c: &SimdMat3) -> SimdMat3 {
    let mean = c.trace() * (1.0 / 3.0);
    let deviator = *c - SimdMat3(UNIT) * mean;
    let size = (deviator.dot(&deviator) * (1.0 / 6.0)).sqrt();
    // Values that are equal to rounding, which leaves the deviator a trace, or no numbers: all axes are principal.
    if !(size > EQUAL * mean && size.is_finite()) {
        return SimdMat3(UNIT);
    }
    let unit = deviator * (1.0 / size);
    let r = 0.5 * unit.0[0].dot(&unit.0[1].cross(&unit.0[2]));
    let outer = 2.0 * outer_root(r.abs().min(1.0)).copysign(r);
    let lone = null_axis(&(unit - SimdMat3(UNIT) * outer));
    let [one, other] = across(&lone);
    // Jacobi's rotation in the plane.
    let (image, next) = (unit.image(&one), unit.image(&other));
    let (difference, coupling) = (next.dot(&other) - image.dot(&one), 2.0 * image.dot(&other));
    let [cosine, sine] = half_turn(difference, coupling);
    SimdMat3([lone, one * cosine - other * sine, one * sine + other * cosine])
}

/// Cosine and sine of θ, |θ| ≤ π/4, tan 2θ = k/d.
///
/// (cos θ, sin θ) is along (h + |d|, ±k), h² = d² + k².
#[inline(always)]
fn half_turn(d: f64, k: f64) -> [f64; 2] {
    /// Far below the rounding of entries of order one, with a square that is far from the smallest number.
    const NOTHING: f64 = 1e-100;
    let along = (d * d + k * k).sqrt() + d.abs();
    if along < NOTHING {
        return [1.0, 0.0];
    }
    let scale = 1.0 / (along * along + k * k).sqrt();
    [along * scale, k * scale.copysign(d)]
}

/// The root x of 4x³ − 3x = r in [√¾, 1], 0 ≤ r ≤ 1: cos(⅓ arccos r).
///
/// Around r = ½ it is a series in t = 2r − 1 that converges as 3⁻ⁿ, the next singular point being r = −1. This one is
/// that of the eighteen Chebyshev polynomials of [0, 1], within 7e-17 of the root; it is summed in pairs, so that no
/// division and no long chain of products has to be waited for.
#[inline(always)]
fn outer_root(r: f64) -> f64 {
    const C: [f64; 18] = [
        0.939_692_620_785_908_3,
        0.065_821_807_272_449_92,
        -0.006_431_413_987_654_575,
        0.001_106_654_955_827_336_2,
        -0.000_233_645_279_665_834_94,
        5.491_441_880_408_604_6e-5,
        -1.379_127_572_810_173_7e-5,
        3.623_288_192_959_276_7e-6,
        -9.835_504_935_349_355e-7,
        2.736_826_734_516_379e-7,
        -7.760_977_052_478_498e-8,
        2.236_164_973_247_703e-8,
        -6.593_775_319_539_05e-9,
        1.951_127_472_947_249_2e-9,
        -5.160_232_982_070_494e-10,
        1.518_372_539_692_528_4e-10,
        -8.057_775_073_018_45e-11,
        2.521_845_450_983_593e-11,
    ];
    let t = 2.0 * r - 1.0;
    let square = t * t;
    let fourth = square * square;
    let eighth = fourth * fourth;
    let four = |n: usize| (C[n] + C[n + 1] * t) + (C[n + 2] + C[n + 3] * t) * square;
    let (low, high) = (four(0) + four(4) * fourth, four(8) + four(12) * fourth);
    (low + high * eighth) + (C[16] + C[17] * t) * (eighth * eighth)
}

/// The unit vector that a symmetric matrix of rank two takes to zero.
#[inline(always)]
fn null_axis(matrix: &SimdMat3) -> SimdVec3 {
    // The columns of the adjugate are multiples of it; the diagonal tells the longest.
    let SimdMat3([x, y, z]) = matrix.cofactor();
    let mut longest = if x.0[0] > y.0[1] { (x.0[0], x) } else { (y.0[1], y) };
    if z.0[2] > longest.0 {
        longest = (z.0[2], z);
    }
    let axis = longest.1;
    axis * (1.0 / axis.dot(&axis).sqrt())
}

/// Two unit vectors across a unit vector and each other. Source: Duff et al. 2017, *Building an orthonormal basis,
/// revisited*.
#[inline(always)]
fn across(n: &SimdVec3) -> [SimdVec3; 2] {
    let [x, y, z, _] = n.0;
    let sign = 1.0_f64.copysign(z);
    let a = -1.0 / (sign + z);
    let b = x * y * a;
    [SimdVec3([1.0 + sign * x * x * a, sign * b, -sign * x, 0.0]), SimdVec3([b, sign + y * y * a, -y, 0.0])]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kinematics::Quaternion;
    use crate::tensor::{Mat3, Vec3};

    /// A gradient with these stretches, turned on both sides.
    fn gradient(stretches: [f64; 3], turn: f64) -> Mat3 {
        let q = |axis: Vec3, angle| Quaternion::from_axis_angle(&axis, angle).rotation();
        let (left, right) = (q(Vec3::new(1.0, -0.4, 0.3), 1.0 + turn), q(Vec3::new(0.2, 0.9, -0.7), 2.3 * turn));
        left * Mat3::from_diagonal(&stretches.into()) * right
    }

    #[test]
    fn axes_are_orthogonal_and_diagonalise_whatever_the_stretches() {
        let near = [0.0, 1e-16, 1e-15, 1e-12, 1e-8, 1e-4, 0.1];
        let mut worst = [0.0_f64; 3];
        for (a, b) in near.into_iter().flat_map(|a| near.map(|b| (a, b))) {
            for scale in [1.0, 1.7, -0.6] {
                for turn in [0.0, 0.3, 1.1, 2.7] {
                    let stretches = [1.3, 1.3 * (1.0 + scale * a), 1.3 * (1.0 - scale * b)];
                    let p = gradient(stretches, turn);
                    let Spectrum { values, axes, carried } = Spectrum::of(&SimdMat3::of(&p));
                    let n = axes.matrix();
                    let mut sorted = values;
                    sorted.sort_by(f64::total_cmp);
                    let mut known = stretches.map(|stretch| stretch * stretch);
                    known.sort_by(f64::total_cmp);
                    let off = sorted.iter().zip(known).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                    let diagonal = n * Mat3::from_diagonal(&values.into()) * n.transpose();
                    let errors = [(n.tr_mul(&n) - Mat3::identity()).norm(), (diagonal - p.tr_mul(&p)).norm(), off];
                    worst = std::array::from_fn(|i| worst[i].max(errors[i]));
                    assert!((carried.matrix() - p * n).norm() < 1e-14);
                }
            }
        }
        println!("orthogonality {:e}, C = N diag(c) Nᵀ {:e}, values {:e}", worst[0], worst[1], worst[2]);
        // Some ten roundings of numbers of order one.
        assert!(worst.iter().all(|error| *error < 1e-14), "{worst:?}");
    }

    /// Symptom: where rounding left (c + δ, c + δ, c) with a mean of c, two principal values of a deviator without
    /// trace would have to be √3, and no axis was found.
    #[test]
    fn values_that_are_equal_to_rounding_have_axes() {
        for step in 0..20_000 {
            let turn = 1e-3 * f64::from(step);
            let p = gradient([0.5; 3], turn);
            let Spectrum { values, axes, .. } = Spectrum::of(&SimdMat3::of(&p));
            let n = axes.matrix();
            assert!(values.iter().all(|value| (value - 0.25).abs() < 1e-15), "{turn}: {values:?}");
            assert!((n.tr_mul(&n) - Mat3::identity()).norm() < 1e-14, "{turn}");
        }
    }

    #[test]
    fn outer_root_is_the_root() {
        for r in (0..=1000).map(|step| f64::from(step) / 1000.0) {
            let x = outer_root(r);
            // The slope of the cubic, up to 9, times some roundings of x.
            assert!(
                ((4.0 * x * x - 3.0) * x - r).abs() < 9.0 * 4.0 * f64::EPSILON && x > 0.866 && x < 1.0 + 1e-15,
                "{r}: {x}"
            );
        }
    }

    #[test]
    fn small_values_beside_large_ones_keep_their_digits() {
        let stretches = [1e-3, 1.0, 1e3];
        let mut values = Spectrum::of(&SimdMat3::of(&gradient(stretches, 0.7))).values;
        values.sort_by(f64::total_cmp);
        for (value, stretch) in values.iter().zip(stretches) {
            // P itself, with entries of 1e3, knows a stretch of 1e-3 to 1e-16 × 1e6.
            assert!((value / (stretch * stretch) - 1.0).abs() < 1e-8, "{value:e}");
        }
    }

    #[test]
    fn what_is_not_a_number_stays_so() {
        let values = Spectrum::of(&SimdMat3::of(&Mat3::from_element(f64::NAN))).values;
        assert!(values.iter().all(|value| value.is_nan()));
    }
}
