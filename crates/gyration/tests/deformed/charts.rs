//! Patches as images of rectangles, written down anew: they share nothing with the code under test.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use gyration::tensor::Vec3;

/// A patch as the image of a rectangle: point and reference area vector per parameter area.
pub type Chart = Box<dyn Fn(f64, f64) -> (Vec3, Vec3)>;

fn round(axes: Vec3, from: f64, to: f64, lift: f64) -> (Chart, [f64; 4]) {
    let cofactor = Vec3::new(axes.y * axes.z, axes.z * axes.x, axes.x * axes.y);
    let chart = move |theta: f64, phi: f64| {
        let s = Vec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos());
        (axes.component_mul(&s) + lift * Vec3::z(), cofactor.component_mul(&s) * theta.sin())
    };
    (Box::new(chart), [from, to, 0.0, TAU])
}

fn wall(radius: f64, height: f64) -> (Chart, [f64; 4]) {
    let chart = move |z: f64, phi: f64| {
        let e = Vec3::new(phi.cos(), phi.sin(), 0.0);
        (radius * e + z * Vec3::z(), radius * e)
    };
    (Box::new(chart), [-0.5 * height, 0.5 * height, 0.0, TAU])
}

fn end(radius: f64, z: f64) -> (Chart, [f64; 4]) {
    let chart =
        move |rho: f64, phi: f64| (Vec3::new(rho * phi.cos(), rho * phi.sin(), z), rho * Vec3::z().scale(z.signum()));
    (Box::new(chart), [0.0, radius, 0.0, TAU])
}

/// The patches of a shape of [`super::surface`], with the bounds of their parameters.
pub fn charts(shape: &str) -> Vec<(Chart, [f64; 4])> {
    match shape {
        "sphere" => vec![round(Vec3::repeat(0.5), 0.0, PI, 0.0)],
        "ellipsoid" => vec![round(Vec3::new(0.5, 0.35, 0.2), 0.0, PI, 0.0)],
        "disc" => vec![round(Vec3::new(0.1, 0.5, 0.5), 0.0, PI, 0.0)],
        "needle" => vec![round(Vec3::new(0.5, 0.1, 0.1), 0.0, PI, 0.0)],
        "cylinder" => vec![wall(0.5, 1.0), end(0.5, 0.5), end(0.5, -0.5)],
        "cone" => {
            let chart = |t: f64, phi: f64| {
                let at = Vec3::new(0.4 * t * phi.cos(), 0.4 * t * phi.sin(), 0.5 - t);
                (at, 0.4 * t * Vec3::new(phi.cos(), phi.sin(), 0.4))
            };
            vec![(Box::new(chart), [0.0, 1.0, 0.0, TAU]), end(0.4, -0.5)]
        }
        "capsule" => vec![
            wall(0.25, 0.5),
            round(Vec3::repeat(0.25), 0.0, FRAC_PI_2, 0.25),
            round(Vec3::repeat(0.25), FRAC_PI_2, PI, -0.25),
        ],
        "torus" => {
            let chart = |theta: f64, phi: f64| {
                let rho = 0.35 + 0.15 * theta.cos();
                let normal = Vec3::new(theta.cos() * phi.cos(), theta.cos() * phi.sin(), theta.sin());
                (Vec3::new(rho * phi.cos(), rho * phi.sin(), 0.15 * theta.sin()), 0.15 * rho * normal)
            };
            vec![(Box::new(chart), [0.0, TAU, 0.0, TAU])]
        }
        _ => {
            let face = |axis: usize, side: f64| -> (Chart, [f64; 4]) {
                let half = [0.5, 0.25, 0.15];
                let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
                let chart = move |u: f64, v: f64| {
                    let (mut at, mut area) = (Vec3::zeros(), Vec3::zeros());
                    (at[axis], at[i], at[j], area[axis]) = (side * half[axis], u, v, side);
                    (at, area)
                };
                (Box::new(chart), [-half[i], half[i], -half[j], half[j]])
            };
            (0..3).flat_map(|axis| [face(axis, -1.0), face(axis, 1.0)]).collect()
        }
    }
}
