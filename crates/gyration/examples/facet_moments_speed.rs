//! Time for all contact moments of a box, one thread: `cargo run --release -p gyration --example facet_moments_speed`.
//!
//! With a repeat count as argument it makes that many calls of the first set of laws and prints nothing else, for use under an
//! instruction counter.

use std::hint::black_box;
use std::time::Instant;

use gyration::surface::facets::Facets;
use gyration::surface::{GapField, Kernel, MomentRequest, Moments};
use gyration::tensor::Vec3;

/// Named sets of (exponent, order).
const LAWS: [(&str, &[(f64, usize)]); 6] = [
    ("forces (6, 1) (3, 2)", &[(6.0, 1), (3.0, 2)]),
    ("with derivatives (6, 1) (7, 2) (3, 2) (4, 3)", &[(6.0, 1), (7.0, 2), (3.0, 2), (4.0, 3)]),
    ("forces (6.3, 1) (3.2, 2)", &[(6.3, 1), (3.2, 2)]),
    ("with derivatives (6.3, 1) (7.3, 2) (3.2, 2) (4.2, 3)", &[(6.3, 1), (7.3, 2), (3.2, 2), (4.2, 3)]),
    ("steep forces (14, 1) (8, 2)", &[(14.0, 1), (8.0, 2)]),
    ("potentials (5, 0) (2, 0) (log, 0)", &[(5.0, 0), (2.0, 0), (f64::NAN, 0)]),
];

fn requests(law: &[(f64, usize)]) -> Vec<MomentRequest> {
    let kernel = |exponent: f64| if exponent.is_nan() { Kernel::Log } else { Kernel::Power(exponent) };
    law.iter().map(|&(exponent, order)| MomentRequest { kernel: kernel(exponent), order }).collect()
}

/// A square of n × n cells, two triangles each.
fn grid(n: usize) -> Option<Facets> {
    let at = |i: usize, j: usize| Vec3::new(i as f64, j as f64, 0.0) / n as f64;
    let points: Vec<Vec3> = (0..=n).flat_map(|i| (0..=n).map(move |j| at(i, j))).collect();
    let place = |i: usize, j: usize| i * (n + 1) + j;
    let cell =
        |k: usize| (place(k / n, k % n), place(k / n + 1, k % n), place(k / n + 1, k % n + 1), place(k / n, k % n + 1));
    let halves = |(a, b, c, d)| [[a, b, c], [a, c, d]];
    let triangles: Vec<[usize; 3]> = (0..n * n).flat_map(|k| halves(cell(k))).collect();
    Facets::new(&points, &triangles).ok()
}

/// A field that puts the smallest gap at `gap`.
fn field(facets: &Facets, direction: Vec3, gap: f64) -> GapField {
    let direction = direction.normalize();
    let (lowest, _) = facets.smallest_gap(&GapField { height: 0.0, direction });
    GapField { height: gap - lowest, direction }
}

fn calls(facets: &Facets, field: &GapField, requests: &[MomentRequest], count: usize) -> f64 {
    let mut out = vec![Moments::default(); requests.len()];
    let start = Instant::now();
    for _ in 0..count {
        if black_box(facets).moments(black_box(field), requests, &mut out).is_err() {
            return f64::NAN;
        }
    }
    black_box(&out);
    start.elapsed().as_secs_f64() * 1e9 / count as f64
}

fn main() {
    let facets = Facets::cuboid(&Vec3::new(0.1, 0.14, 0.2));
    let poses = [
        ("tilted, gap 0.02", field(&facets, Vec3::new(0.2, 0.1, 1.0), 0.02)),
        ("tilted, gap 0.001", field(&facets, Vec3::new(0.2, 0.1, 1.0), 0.001)),
        ("almost flat, gap 0.02", field(&facets, Vec3::new(0.001, 0.002, 1.0), 0.02)),
        ("vertex down, gap 0.01", field(&facets, Vec3::new(1.0, 0.8, 0.9), 0.01)),
        ("far, gap 1", field(&facets, Vec3::new(0.3, 0.8, 0.9), 1.0)),
    ];
    if let Some(count) = std::env::args().nth(1).and_then(|word| word.parse().ok()) {
        let set = std::env::args().nth(2).and_then(|word| word.parse().ok()).unwrap_or(0);
        let law = LAWS.get(set).unwrap_or(&LAWS[0]);
        calls(&facets, &poses[0].1, &requests(law.1), count);
        return;
    }
    for (law, set) in LAWS {
        println!("{law}");
        for (pose, field) in &poses {
            let best = (0..20).map(|_| calls(&facets, field, &requests(set), 2000)).fold(f64::INFINITY, f64::min);
            println!("    {best:7.0} ns  {pose}");
        }
    }
    let Some(mesh) = grid(224) else { return };
    let count = mesh.triangles().count() as f64;
    println!("mesh of {count} triangles, time for each triangle");
    for (law, set) in LAWS {
        let field = field(&mesh, Vec3::new(0.2, 0.1, 1.0), 0.01);
        let best = (0..10).map(|_| calls(&mesh, &field, &requests(set), 1)).fold(f64::INFINITY, f64::min);
        println!("    {:7.0} ns  {law}", best / count);
    }
}
