//! Time of one call of `Surface::moments` for each primitive, with and without derivatives.
//!
//! `cargo run --release -p gyration --example curved_moments_speed`. The shortest of many short batches is printed, which
//! a busy machine disturbs least.

use std::hint::black_box;
use std::time::Instant;

use gyration::surface::{GapField, Kernel, MomentRequest, Moments, Surface};
use gyration::tensor::Vec3;

fn requests(list: &[(f64, usize)]) -> Vec<MomentRequest> {
    list.iter().map(|&(nu, order)| MomentRequest { kernel: Kernel::Power(nu), order }).collect()
}

/// The shortest time of a call [µs], averaged over a few attitudes.
fn time(surface: &Surface, gap: f64, requests: &[MomentRequest]) -> f64 {
    let directions = [(0.48, 0.36, 0.8), (0.0, 0.6, -0.8), (0.99, 0.1, 0.1), (0.05, 0.1, 0.99)];
    let mut out = vec![Moments::default(); requests.len()];
    let mut total = 0.0;
    for (x, y, z) in directions {
        let direction = Vec3::new(x, y, z).normalize();
        let (lowest, _) = surface.smallest_gap(&GapField { height: 0.0, direction });
        let field = GapField { height: gap - lowest, direction };
        let mut best = f64::MAX;
        for _ in 0..400 {
            let start = Instant::now();
            for _ in 0..4 {
                black_box(surface.moments(black_box(&field), requests, &mut out).is_ok());
                black_box(&out);
            }
            best = best.min(start.elapsed().as_secs_f64() / 4.0);
        }
        total += best;
    }
    total / directions.len() as f64 * 1e6
}

fn main() {
    let shapes = [
        ("sphere", Surface::sphere(0.5)),
        ("ellipsoid 5:3.5:2", Surface::ellipsoid(&Vec3::new(0.5, 0.35, 0.2))),
        ("ellipsoid 10:10:1", Surface::ellipsoid(&Vec3::new(0.5, 0.5, 0.05))),
        ("ellipsoid 10:1:1", Surface::ellipsoid(&Vec3::new(0.05, 0.05, 0.5))),
        ("ellipsoid 20:3:2", Surface::ellipsoid(&Vec3::new(0.5, 0.075, 0.05))),
        ("cylinder", Surface::cylinder(0.5, 1.0)),
        ("cone", Surface::cone(0.4, 1.0)),
        ("capsule", Surface::capsule(0.25, 0.5)),
        ("torus", Surface::torus(0.35, 0.15)),
        ("box", Surface::cuboid(&Vec3::new(1.0, 0.5, 0.3))),
    ];
    let lists = [
        requests(&[(6.0, 1), (3.0, 2)]),
        requests(&[(6.0, 1), (7.0, 2), (3.0, 2), (4.0, 3)]),
        requests(&[(6.3, 1), (7.3, 2), (3.2, 2), (4.2, 3)]),
    ];
    println!("µs a call: two laws, with derivatives, the same with real exponents; size 1");
    for gap in [1e-3, 0.03, 3.0] {
        println!("gap {gap}");
        for (name, surface) in &shapes {
            let times: Vec<String> = lists.iter().map(|list| format!("{:8.2}", time(surface, gap, list))).collect();
            println!("  {name:20}{}", times.join(""));
        }
    }
}
