//! Closed integrals of the Stokeslet over a flat triangle, with weights one and linear.
//!
//! x a point, p its foot in the plane of the triangle, w its height along the normal n; y on the triangle, ρ = y − p, r
//! = y − x = ρ − w n. With unit outward normals m and tangents τ of the sides in the plane, t = m·ρ on a side, s = τ·ρ:
//!
//!   A₀ = ∫1/r = Σ t f − wΩ      Ω = w∫1/r³ (solid angle)     B₁ = ∫ρ/r³ = −Σ m f
//!   A₁ = ∫ρ/r = Σ m ∫r ds       B₂ = ∫ρρ/r³ = A₀ I − Σ m (t m f + τ [r])
//!   B₃ = ∫ρ_αρ_βρ_γ/r³ = δ_αγ A₁_β + δ_βγ A₁_α − Σ m_γ ∫ρ_αρ_β/r ds
//!   f = ∫ds/r,  [r] = r₊ − r₋,  ∫r ds = ½([s r] + R² f),  ∫s²/r ds = ½([s r] − R² f),  R² = t² + w²
//!
//! All of it follows from ∇(1/r) = −ρ/r³, ∇r = ρ/r and Gauss's theorem in the plane. The solid angle: van Oosterom and
//! Strackee, *IEEE Trans. Biomed. Eng.* 30 (1983) 125. Tensors are given as (11, 12, 22, 13, 23, 33) in the axes of the
//! triangle, the third along n.

/// A symmetric tensor: 11, 12, 22, 13, 23, 33.
pub(crate) type Symmetric = [f64; 6];

/// ∫ G dA and ∫ G ρ_γ dA, G = I/r + rr/r³, in the axes of the triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct StokesletMoments {
    /// ∫ G dA.
    pub mean: Symmetric,
    /// ∫ G ρ_γ dA, γ = 1, 2.
    pub slope: [Symmetric; 2],
}

/// Length below which a distance from a side counts as that length, relative to the side: f stays finite, t f vanishes.
const TOUCHING_SQUARED: f64 = 1e-28;

/// A triangle in its plane, with what its sides need from everywhere.
#[derive(Debug, Clone)]
pub(crate) struct PlaneTriangle {
    /// Counter-clockwise.
    pub corners: [[f64; 2]; 3],
    /// Tangents and lengths of the sides from each corner.
    sides: [([f64; 2], f64); 3],
    /// Twice the area.
    pub doubled: f64,
}

impl PlaneTriangle {
    pub fn new(corners: [[f64; 2]; 3]) -> Self {
        let side = |from: [f64; 2], to: [f64; 2]| {
            let along = [to[0] - from[0], to[1] - from[1]];
            let length = (along[0] * along[0] + along[1] * along[1]).sqrt();
            ([along[0] / length, along[1] / length], length)
        };
        let [a, b, c] = corners;
        let doubled = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        Self { corners, sides: [side(a, b), side(b, c), side(c, a)], doubled }
    }
}

/// One side as seen from the foot of x.
struct TriangleSide {
    m: [f64; 2],
    tau: [f64; 2],
    t: f64,
    /// r₊ − r₋.
    rise: f64,
    /// ∫ds/r.
    f: f64,
    /// ½ (s₊r₊ − s₋r₋).
    half: f64,
    /// ½ R² f.
    rest: f64,
}

impl TriangleSide {
    /// From its first corner as seen from the foot, its tangent and its length.
    #[inline(always)]
    fn new(from: [f64; 2], (tau, length): ([f64; 2], f64), w: f64) -> Self {
        let m = [tau[1], -tau[0]];
        let t = from[0] * m[0] + from[1] * m[1];
        let start = from[0] * tau[0] + from[1] * tau[1];
        let end = start + length;
        let squared = (t * t + w * w).max(TOUCHING_SQUARED * length * length);
        let (r_start, r_end) = ((start * start + squared).sqrt(), (end * end + squared).sqrt());
        // r + s loses its digits where s < 0; (r + s)(r − s) = R².
        let f = if start >= 0.0 {
            libm::log((r_end + end) / (r_start + start))
        } else if end <= 0.0 {
            libm::log((r_start - start) / (r_end - end))
        } else {
            libm::log((r_end + end) * (r_start - start) / squared)
        };
        let half = 0.5 * (end * r_end - start * r_start);
        Self { m, tau, t, rise: r_end - r_start, f, half, rest: 0.5 * squared * f }
    }
}

/// Ω = w ∫ dA/r³ of a triangle with counter-clockwise corners ρ_k.
fn solid_angle([a, b, c]: &[[f64; 2]; 3], doubled: f64, w: f64) -> f64 {
    let dot = |u: &[f64; 2], v: &[f64; 2]| u[0] * v[0] + u[1] * v[1] + w * w;
    let [ra, rb, rc] = [a, b, c].map(|u| dot(u, u).sqrt());
    2.0 * libm::atan2(w * doubled, ra * rb * rc + dot(a, b) * rc + dot(b, c) * ra + dot(c, a) * rb)
}

impl StokesletMoments {
    /// Over a triangle, from the height w over a foot in its plane; x must not lie on a side.
    pub fn new(outline: &PlaneTriangle, foot: [f64; 2], w: f64) -> Self {
        let around = outline.corners.map(|[u, v]| [u - foot[0], v - foot[1]]);
        let angle = solid_angle(&around, outline.doubled, w);
        let mut a0 = -w * angle;
        let (mut a1, mut b1, mut b2, mut b3) = ([0.0; 2], [0.0; 2], [0.0; 3], [[0.0; 3]; 2]);
        for (from, side) in around.into_iter().zip(outline.sides) {
            let TriangleSide { m, tau, t, rise, f, half, rest } = TriangleSide::new(from, side, w);
            a0 += t * f;
            // m (t m f + τ [r]) and ∫ρρ/r ds.
            let across = t * f;
            let squares = (t * across, t * rise, half - rest);
            let q = [
                squares.0 * m[0] * m[0] + 2.0 * squares.1 * m[0] * tau[0] + squares.2 * tau[0] * tau[0],
                squares.0 * m[0] * m[1] + squares.1 * (m[0] * tau[1] + m[1] * tau[0]) + squares.2 * tau[0] * tau[1],
                squares.0 * m[1] * m[1] + 2.0 * squares.1 * m[1] * tau[1] + squares.2 * tau[1] * tau[1],
            ];
            b2[0] -= m[0] * (across * m[0] + rise * tau[0]);
            b2[1] -= m[0] * (across * m[1] + rise * tau[1]);
            b2[2] -= m[1] * (across * m[1] + rise * tau[1]);
            for g in 0..2 {
                a1[g] += m[g] * (half + rest);
                b1[g] -= m[g] * f;
                (0..3).for_each(|k| b3[g][k] -= m[g] * q[k]);
            }
        }
        b2[0] += a0;
        b2[2] += a0;
        b3[0] = [b3[0][0] + 2.0 * a1[0], b3[0][1] + a1[1], b3[0][2]];
        b3[1] = [b3[1][0], b3[1][1] + a1[0], b3[1][2] + 2.0 * a1[1]];
        let slope = |g: usize, b2_g: [f64; 2]| {
            let b = b3[g];
            [b[0] + a1[g], b[1], b[2] + a1[g], -w * b2_g[0], -w * b2_g[1], a1[g] + w * w * b1[g]]
        };
        Self {
            mean: [a0 + b2[0], b2[1], a0 + b2[2], -w * b1[0], -w * b1[1], a0 + w * angle],
            slope: [slope(0, [b2[0], b2[1]]), slope(1, [b2[1], b2[2]])],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rule::DEGREE_6;

    const CORNERS: [[f64; 2]; 3] = [[-0.3, -0.4], [0.9, -0.1], [0.2, 0.7]];

    /// The same moments by cutting the triangle into 4^depth parts.
    fn by_parts(corners: &[[f64; 2]; 3], w: f64, depth: u32) -> StokesletMoments {
        let [a, b, c] = *corners;
        let mut sum = StokesletMoments { mean: [0.0; 6], slope: [[0.0; 6]; 2] };
        if depth > 0 {
            let middle = |p: [f64; 2], q: [f64; 2]| [0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])];
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            for part in [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]] {
                let part = by_parts(&part, w, depth - 1);
                for k in 0..6 {
                    sum.mean[k] += part.mean[k];
                    (0..2).for_each(|g| sum.slope[g][k] += part.slope[g][k]);
                }
            }
            return sum;
        }
        let area = 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
        for point in DEGREE_6 {
            let [x, y] = [0, 1].map(|g| (0..3).map(|k| point.barycentric[k] * corners[k][g]).sum::<f64>());
            let r = (x * x + y * y + w * w).sqrt();
            let products = [x * x, x * y, y * y, -w * x, -w * y, w * w];
            for (k, product) in products.iter().enumerate() {
                let unit = if [0, 2, 5].contains(&k) { 1.0 / r } else { 0.0 };
                let value = point.weight * area * (unit + product / r.powi(3));
                sum.mean[k] += value;
                sum.slope[0][k] += value * x;
                sum.slope[1][k] += value * y;
            }
        }
        sum
    }

    fn difference(one: &StokesletMoments, other: &StokesletMoments) -> f64 {
        let parts = |m: &StokesletMoments| [m.mean, m.slope[0], m.slope[1]].concat();
        parts(one).iter().zip(parts(other)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn closed_forms_agree_with_quadrature_above_beside_and_below() {
        for (dx, dy, w) in [(0.0, 0.0, 0.3), (0.1, 0.2, -0.2), (1.5, 0.4, 0.0), (-0.8, 0.9, 0.5), (0.4, -1.1, -0.1)] {
            let around = CORNERS.map(|[x, y]| [x - dx, y - dy]);
            let (closed, summed) =
                (StokesletMoments::new(&PlaneTriangle::new(around), [0.0; 2], w), by_parts(&around, w, 5));
            // The rule of degree 6 on parts of a thirtieth, no nearer than 0.1.
            assert!(difference(&closed, &summed) < 1e-9, "{dx} {dy} {w}: {:e}", difference(&closed, &summed));
        }
    }

    #[test]
    fn closed_forms_are_finite_and_continuous_in_the_plane_of_the_triangle() {
        let (on, above) = [0.0, 1e-9].map(|w| StokesletMoments::new(&PlaneTriangle::new(CORNERS), [0.0; 2], w)).into();
        // The off-diagonal −w∫ρ/r³ changes by w ln w, the rest by w.
        assert!(difference(&on, &above) < 1e-7);
        // From beyond the end of a side, on its line.
        let along = [[0.5, 0.0], [1.5, 0.0], [0.8, 0.6]];
        let (closed, summed) =
            (StokesletMoments::new(&PlaneTriangle::new(along), [0.0; 2], 0.0), by_parts(&along, 0.0, 7));
        assert!(difference(&closed, &summed) < 1e-9);
    }

    #[test]
    fn closed_forms_hold_for_needles() {
        let needle = [[-0.1, 1e-3], [0.9, 2e-3], [0.2, 3e-3]];
        let (closed, summed) =
            (StokesletMoments::new(&PlaneTriangle::new(needle), [0.0; 2], 0.0), by_parts(&needle, 0.0, 8));
        // The quadrature is what errs: the foot lies a third of the needle's width off it.
        assert!(difference(&closed, &summed) < 1e-5 * 1e-3_f64.sqrt());
    }
}
