//! The flows about a vibrating sphere, put into the equations by differences, and their tractions summed over the
//! sphere.
//!
//! R = η = 1, ρω = |α|²; complex fields (u, q) at real points. With H = 1/r, G = e^(−α(r−1))/r and F_k = (d/dr /r)^k F:
//!
//!   strain        u = a ∇(E·∇∇H) + b [∇(E·∇∇G) − α² E∇G],     q = −α² a E·∇∇H
//!   translation   u = a ∇(U·∇H) + b [∇(U·∇G) − α² U G],       q = −α² a U·∇H
//!   rotation      u = Ω × x G₁/G₁(1),                          q = 0
//!
//! a and b are solved for here, from u on the sphere, not copied.

use super::vibration;
use nalgebra::{Complex, Matrix3, Vector3};
use std::f64::consts::PI;

type Scalar = Complex<f64>;
type Flow = (Vector3<Scalar>, Scalar);

/// F₀ … F₃ of H and of G at r.
fn radial(alpha: Scalar, r: f64) -> ([f64; 4], [Scalar; 4]) {
    let s = alpha * r;
    let decay = (-alpha * (r - 1.0)).exp();
    let smooth = [1.0 / r, -r.powi(-3), 3.0 * r.powi(-5), -15.0 * r.powi(-7)];
    let polynomials = [Scalar::from(1.0), s + 1.0, s * s + s * 3.0 + 3.0, s * s * s + s * s * 6.0 + s * 15.0 + 15.0];
    let powers = [1.0 / r, -r.powi(-3), r.powi(-5), -r.powi(-7)];
    (smooth, std::array::from_fn(|k| polynomials[k] * decay * powers[k]))
}

fn complex(vector: Vector3<f64>) -> Vector3<Scalar> {
    vector.map(Scalar::from)
}

fn strain(alpha: Scalar, rate: &Matrix3<f64>, x: &Vector3<f64>) -> Flow {
    let square = alpha * alpha;
    // The coefficient of x (x·Ex) vanishes on the sphere, that of Ex is one.
    let (h, g) = radial(alpha, 1.0);
    let ratio = -g[3] / h[3];
    let b = (ratio * (2.0 * h[2]) + g[2] * 2.0 - square * g[1]).inv();
    let a = ratio * b;
    let (h, g) = radial(alpha, x.norm());
    let along = rate * x;
    let across = x.dot(&along);
    let linear = a * (2.0 * h[2]) + b * (g[2] * 2.0 - square * g[1]);
    (complex(along) * linear + complex(*x) * ((a * h[3] + b * g[3]) * across), -square * a * (h[2] * across))
}

fn translation(alpha: Scalar, velocity: &Vector3<f64>, x: &Vector3<f64>) -> Flow {
    let square = alpha * alpha;
    let (h, g) = radial(alpha, 1.0);
    let ratio = -g[2] / h[2];
    let b = (ratio * h[1] + g[1] - square * g[0]).inv();
    let a = ratio * b;
    let (h, g) = radial(alpha, x.norm());
    let across = x.dot(velocity);
    let linear = a * h[1] + b * (g[1] - square * g[0]);
    (complex(*velocity) * linear + complex(*x) * ((a * h[2] + b * g[2]) * across), -square * a * (h[1] * across))
}

fn rotation(alpha: Scalar, spin: &Vector3<f64>, x: &Vector3<f64>) -> Flow {
    let part = radial(alpha, x.norm()).1[1] / radial(alpha, 1.0).1[1];
    (complex(spin.cross(x)) * part, Scalar::from(0.0))
}

fn axis(index: usize) -> Vector3<f64> {
    Vector3::ith(index, 1.0)
}

/// ∂_j (u, q), differences of fourth order.
fn slope(flow: &dyn Fn(&Vector3<f64>) -> Flow, x: &Vector3<f64>, j: usize) -> Flow {
    let step = 2e-3;
    let at = |factor: f64| flow(&(x + axis(j) * (factor * step)));
    let difference = |near: f64| {
        let (after, before) = (at(near), at(-near));
        (after.0 - before.0, after.1 - before.1)
    };
    let (near, far) = (difference(1.0), difference(2.0));
    ((near.0 * Scalar::from(8.0) - far.0) / Scalar::from(12.0 * step), (near.1 * 8.0 - far.1) / (12.0 * step))
}

/// ∇u and its divergence; traction −q n + (∇u + ∇uᵀ) n.
fn gradient(flow: &dyn Fn(&Vector3<f64>) -> Flow, x: &Vector3<f64>) -> Matrix3<Scalar> {
    Matrix3::from_columns(&[0, 1, 2].map(|j| slope(flow, x, j).0))
}

/// ∇²u, differences of fourth order.
fn laplacian(flow: &dyn Fn(&Vector3<f64>) -> Flow, x: &Vector3<f64>) -> Vector3<Scalar> {
    let step = 5e-3;
    let centre = flow(x).0 * Scalar::from(30.0);
    let along = |j: usize| {
        let pair = |factor: f64| flow(&(x + axis(j) * (factor * step))).0 + flow(&(x - axis(j) * (factor * step))).0;
        (pair(1.0) * Scalar::from(16.0) - pair(2.0) - centre) / Scalar::from(12.0 * step * step)
    };
    along(0) + along(1) + along(2)
}

/// ∫ t ⊗ (1, x) dA over the unit sphere: Gauss's rule of five points in height, trapezoid in azimuth, exact to
/// degree 9.
fn load(flow: &dyn Fn(&Vector3<f64>) -> Flow) -> (Vector3<Scalar>, Matrix3<Scalar>) {
    let heights = [0.0_f64, 0.538_469_310_105_683_1, 0.906_179_845_938_664];
    let weights = [0.568_888_888_888_888_9, 0.478_628_670_499_366_47, 0.236_926_885_056_189_08];
    let nodes = (0..5).map(|k| if k < 3 { (heights[k], weights[k]) } else { (-heights[k - 2], weights[k - 2]) });
    let mut sums = (Vector3::zeros(), Matrix3::zeros());
    for (height, weight) in nodes {
        for turn in 0..12 {
            let (sine, cosine) = (PI * f64::from(turn) / 6.0).sin_cos();
            let radius = (1.0 - height * height).sqrt();
            let normal = Vector3::new(radius * cosine, radius * sine, height);
            let slopes = gradient(flow, &normal);
            let unit = complex(normal);
            let traction =
                ((slopes + slopes.transpose()) * unit - unit * flow(&normal).1) * Scalar::from(weight * PI / 6.0);
            sums.0 += traction;
            sums.1 += traction * unit.transpose();
        }
    }
    sums
}

const STRAIN: [[f64; 3]; 3] = [[0.7, -0.4, 0.3], [-0.4, 0.2, 0.9], [0.3, 0.9, -0.9]];
const VECTOR: [f64; 3] = [0.3, -0.8, 0.5];
/// ω at R = ρ = η = 1, from nearly steady to a thin layer.
const FREQUENCIES: [f64; 4] = [1e-2, 1.0, 8.0, 60.0];

/// Runs a check on the three flows at four frequencies: (name, ω, α, velocity on the sphere, flow).
fn on_every_flow(
    check: impl Fn(&str, f64, Scalar, &dyn Fn(&Vector3<f64>) -> Vector3<f64>, &dyn Fn(&Vector3<f64>) -> Flow),
) {
    let rate = Matrix3::from_fn(|i, j| STRAIN[i][j]);
    let vector = Vector3::from(VECTOR);
    for omega in FREQUENCIES {
        let alpha = Scalar::new(0.0, omega).sqrt();
        check("strain", omega, alpha, &|x| rate * x, &|x| strain(alpha, &rate, x));
        check("translation", omega, alpha, &|_| vector, &|x| translation(alpha, &vector, x));
        check("rotation", omega, alpha, &|x| vector.cross(x), &|x| rotation(alpha, &vector, x));
    }
}

#[test]
fn flows_satisfy_the_equations_and_move_with_the_sphere() {
    let points = [[1.1, 0.2, -0.3], [-0.4, 0.9, 0.8], [0.1, -1.5, 0.6], [1.3, 1.1, -1.7]].map(Vector3::from);
    on_every_flow(|name, omega, alpha, velocity, flow| {
        for x in points {
            let (u, _) = flow(&x);
            let laplacian = laplacian(flow, &x);
            let pressure = Vector3::from([0, 1, 2].map(|j| slope(flow, &x, j).1));
            let momentum = laplacian - u * (alpha * alpha) - pressure;
            let size = laplacian.norm() + pressure.norm();
            let divergence = gradient(flow, &x).trace().norm();
            // Fourth order: (α step)⁴/90 ~ 2e-8 at the highest frequency, and rounding 1e-16/step² of u.
            assert!(momentum.norm() < 2e-6 * size + 1e-9, "{name} ω = {omega}: {:e} of {size:e}", momentum.norm());
            assert!(divergence < 1e-7, "{name} ω = {omega}: {divergence:e}");
            let on = x.normalize();
            assert!((flow(&on).0 - complex(velocity(&on))).norm() < 1e-10, "{name} ω = {omega} on the sphere");
        }
    });
}

#[test]
fn tractions_of_the_flows_sum_to_the_resistances() {
    on_every_flow(|name, omega, _, _, flow| {
        let (force, moment) = load(flow);
        let at = vibration(1.0, 1.0, 1.0, omega);
        let vector = complex(Vector3::from(VECTOR));
        let rate = Matrix3::from_fn(|i, j| Scalar::from(STRAIN[i][j]));
        let (expected_force, expected_moment) = match name {
            "strain" => (Vector3::zeros(), rate * -at.strain),
            "translation" => (vector * -at.translation, Matrix3::zeros()),
            _ => (Vector3::zeros(), vector.cross_matrix() * (at.rotation * -0.5)),
        };
        let error = (force - expected_force).norm() + (moment - expected_moment).norm();
        let size = expected_force.norm() + expected_moment.norm();
        println!("{name} ω = {omega}: {:.1e}", error / size);
        // Differences of fourth order: (α step)⁴/30 ~ 1e-9; the rule is exact.
        assert!(error < 1e-7 * size, "{name} ω = {omega}: {:e}", error / size);
    });
}
