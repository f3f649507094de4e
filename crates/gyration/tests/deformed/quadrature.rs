//! Adaptive quadrature of everything that the moments of deformed surfaces promise.

use gyration::surface::{Kernel, Moments, OrientedMoments};
use gyration::tensor::{Mat3, Vec3};
use nalgebra::SVector;

use super::charts::charts;
use super::{Case, cofactor};

/// What is compared.
#[derive(Default)]
pub struct OrientedSum {
    pub deformed: Moments,
    pub oriented: OrientedMoments,
}

/// Components: twenty of the moments, ten of each pair, fifteen of the fourth power, four scales.
const COUNT: usize = 20 + 60 + 15 + 4;

pub type Reference = SVector<f64, COUNT>;

fn components(m: &Moments, count: usize) -> Vec<f64> {
    let s = &m.second;
    let head = [m.zeroth, m.first.x, m.first.y, m.first.z, s.m11, s.m12, s.m13, s.m22, s.m23, s.m33];
    head.into_iter().chain(m.third.0).take(count).collect()
}

fn order(place: usize) -> usize {
    [0, 1, 4, 10].iter().filter(|&&start| start <= place).count() - 1
}

pub fn errors(found: &OrientedSum, reference: &Reference) -> [f64; 8] {
    let scales = &reference.as_slice()[95..];
    let mut worst = [0.0_f64; 8];
    let mut note = |place: usize, error: f64| {
        worst[place] = if error.is_nan() { f64::NAN } else { worst[place].max(error) };
    };
    for (place, value) in components(&found.deformed, 20).into_iter().enumerate() {
        note(order(place), (value - reference[place]).abs() / scales[order(place)]);
    }
    for (pair, moments) in found.oriented.pairs.iter().enumerate() {
        for (place, value) in components(moments, 10).into_iter().enumerate() {
            note(4 + order(place), (value - reference[20 + 10 * pair + place]).abs() / scales[order(place)]);
        }
    }
    for (place, value) in found.oriented.fourth.iter().enumerate() {
        note(7, (value - reference[80 + place]).abs() / scales[0]);
    }
    worst
}

/// All components by adaptive quadrature.
pub fn integrate(case: &Case) -> Reference {
    let cofactor = cofactor(&case.gradient);
    let charts = charts(case.shape);
    let functions: Vec<_> = charts
        .iter()
        .map(|(chart, rectangle)| {
            let add = move |u: f64, v: f64, weight: f64, sum: &mut Reference| {
                add_point(case, &cofactor, &chart(u, v), weight, sum);
            };
            (add, *rectangle)
        })
        .collect();
    let mut total = Reference::zeros();
    // Panels fine enough to see every layer tell the scale that refinement is measured by.
    let times = if case.gap < 0.01 { 4 } else { 2 };
    let panels = functions.iter().map(|(function, rectangle)| {
        let panels = halves(rectangle, times).into_iter().map(|panel| (panel, gauss(function, &panel)));
        panels.collect::<Vec<_>>()
    });
    let panels: Vec<_> = panels.collect();
    let scale: f64 = panels.iter().flatten().map(|(_, part)| part[95]).sum();
    for ((function, _), panels) in functions.iter().zip(&panels) {
        for (panel, part) in panels {
            // Quarters are better than the whole that they are compared with by several digits.
            refine(function, panel, part, 1e-11 * scale, 40, &mut total);
        }
    }
    total
}

/// Adds the integrand at a point of a patch, times a weight.
fn add_point(case: &Case, cofactor: &Mat3, (at, area): &(Vec3, Vec3), weight: f64, sum: &mut Reference) {
    let vector = cofactor * area;
    let element = vector.norm();
    let m = if element > 0.0 { vector / element } else { Vec3::zeros() };
    let gap = case.field.gap(at);
    let kernel = match case.kernel {
        Kernel::Power(nu) => gap.powf(-nu),
        Kernel::Log => gap.ln(),
    };
    let w = weight * kernel * element;
    let (powers, normals) = (monomials(at), monomials(&m));
    let (moments, rest) = sum.as_mut_slice().split_at_mut(20);
    for (sum, power) in moments.iter_mut().zip(&powers) {
        *sum += w * power;
    }
    for (sums, normal) in rest.chunks_mut(10).zip(&normals[4..10]) {
        let w = w * normal;
        for (sum, power) in sums.iter_mut().zip(&powers) {
            *sum += w * power;
        }
    }
    // xxxx xxxy … zzzz: x times the ten of third degree, y times the four without x, z⁴.
    let third = &normals[10..];
    let fourth = third.iter().map(|t| m.x * t).chain(third[6..].iter().map(|t| m.y * t)).chain([m.z * third[9]]);
    for (sum, product) in rest[60..75].iter_mut().zip(fourth) {
        *sum += w * product;
    }
    let reach = at.norm();
    for (n, sum) in rest[75..].iter_mut().enumerate() {
        *sum += w.abs() * reach.powi(n as i32);
    }
}

/// 1, x … z, xx … zz, xxx … zzz.
fn monomials(at: &Vec3) -> [f64; 20] {
    let [x, y, z] = [at.x, at.y, at.z];
    let [xx, xy, xz, yy, yz, zz] = [x * x, x * y, x * z, y * y, y * z, z * z];
    let third = [xx * x, xx * y, xx * z, xy * y, xy * z, xz * z, yy * y, yy * z, yz * z, zz * z];
    let mut all = [1.0, x, y, z, xx, xy, xz, yy, yz, zz, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    all[10..].copy_from_slice(&third);
    all
}

fn halves(rectangle: &[f64; 4], times: usize) -> Vec<[f64; 4]> {
    let mut panels = vec![*rectangle];
    for _ in 0..times {
        panels = panels.iter().flat_map(quarters).collect();
    }
    panels
}

fn quarters([a, b, c, d]: &[f64; 4]) -> [[f64; 4]; 4] {
    let (m, n) = (0.5 * (a + b), 0.5 * (c + d));
    [[*a, m, *c, n], [m, *b, *c, n], [*a, m, n, *d], [m, *b, n, *d]]
}

/// Positive nodes and weights of Gauss's rule with ten points.
const GAUSS: [(f64, f64); 5] = [
    (0.148_874_338_981_631_2, 0.295_524_224_714_752_87),
    (0.433_395_394_129_247_2, 0.269_266_719_309_996_35),
    (0.679_409_568_299_024_4, 0.219_086_362_515_982_04),
    (0.865_063_366_688_984_5, 0.149_451_349_150_580_6),
    (0.973_906_528_517_171_7, 0.066_671_344_308_688_14),
];

fn gauss(function: &impl Fn(f64, f64, f64, &mut Reference), [a, b, c, d]: &[f64; 4]) -> Reference {
    let nodes = || GAUSS.into_iter().flat_map(|(x, w)| [(x, w), (-x, w)]);
    let (u, v, half_u, half_v) = (0.5 * (a + b), 0.5 * (c + d), 0.5 * (b - a), 0.5 * (d - c));
    let mut sum = Reference::zeros();
    for (x, p) in nodes() {
        for (y, q) in nodes() {
            function(u + half_u * x, v + half_v * y, p * q * half_u * half_v, &mut sum);
        }
    }
    sum
}

/// Adds the integral over a rectangle, halving it until nothing changes by more than the tolerance.
fn refine(
    function: &impl Fn(f64, f64, f64, &mut Reference),
    rectangle: &[f64; 4],
    whole: &Reference,
    tolerance: f64,
    depth: usize,
    total: &mut Reference,
) {
    // A part this small may be as wrong as it likes.
    if whole[95] < 1e-3 * tolerance {
        *total += whole;
        return;
    }
    let panels = quarters(rectangle);
    let parts = panels.map(|panel| gauss(function, &panel));
    let sum = parts.iter().fold(Reference::zeros(), |sum, part| sum + part);
    if depth == 0 || (sum - whole).amax() < tolerance {
        *total += sum;
        return;
    }
    for (panel, part) in panels.iter().zip(&parts) {
        refine(function, panel, part, tolerance, depth - 1, total);
    }
}
