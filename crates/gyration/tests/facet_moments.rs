//! Moments over flat facets against values of 400-digit arithmetic (`validation/oracles/facet_moments.py`), against
//! closed forms, and as relations.

use gyration::surface::Facets;
use gyration::surface::LineKernel;
use gyration::surface::{GapField, Kernel, MomentRequest, Moments};
use gyration::tensor::{Mat3, Vec3};
use proptest::prelude::*;

fn numbers(words: &str) -> Vec<f64> {
    words.split_whitespace().map(|word| word.parse().unwrap()).collect()
}

fn kernel(word: &str) -> Kernel {
    if word == "log" { Kernel::Log } else { Kernel::Power(word.parse().unwrap()) }
}

fn rows(table: &'static str) -> impl Iterator<Item = Vec<&'static str>> {
    table.lines().skip(1).map(|line| line.split(',').collect())
}

fn moments(facets: &Facets, field: &GapField, kernel: Kernel, order: usize) -> Moments {
    let mut out = [Moments::default()];
    facets.moments(field, &[MomentRequest { kernel, order }], &mut out).unwrap();
    out[0]
}

fn triangle(points: [Vec3; 3]) -> Facets {
    Facets::new(&points, &[[0, 1, 2]]).unwrap()
}

fn matrix_components(a: &Mat3) -> [f64; 6] {
    [a[(0, 0)], a[(0, 1)], a[(0, 2)], a[(1, 1)], a[(1, 2)], a[(2, 2)]]
}

fn components(m: &Moments) -> Vec<f64> {
    let second = matrix_components(&m.second);
    [&[m.zeroth][..], m.first.as_slice(), &second, &m.third.0].concat()
}

/// Lower bounds of ∫ |κ| |X|^n dA, n = 0 … 3, from the even moments: Hölder for n = 3, |X| ≤ `reach` for n = 1.
fn scales(reference: &[f64], reach: f64) -> [f64; 4] {
    let zeroth = reference[0].abs();
    let second = (reference[4] + reference[7] + reference[9]).abs();
    [zeroth, second / reach, second, second.powf(1.5) / zeroth.sqrt()]
}

/// The largest error in each order relative to its scale.
fn errors(found: &[f64], reference: &[f64], reach: f64) -> [f64; 4] {
    let scales = scales(reference, reach);
    let mut worst = [0.0_f64; 4];
    for (i, (a, b)) in found.iter().zip(reference).enumerate() {
        let order = [0, 1, 4, 10].iter().filter(|&&start| start <= i).count() - 1;
        let error = (a - b).abs() / scales[order];
        assert!(!error.is_nan());
        worst[order] = worst[order].max(error);
    }
    worst
}

#[test]
fn moments_along_a_segment_agree_with_long_arithmetic() {
    let mut worst = (0.0, String::new());
    for row in rows(include_str!("data/facet_kernel.csv")) {
        let highest = if row[0] == "log" { 4 } else { 5 };
        for degree in 0..=highest {
            let line = LineKernel::up_to(kernel(row[0]), degree);
            let (near, far) = (line.sample(row[1].parse().unwrap()), line.sample(row[2].parse().unwrap()));
            let found = line.moments(&near, &far, degree);
            for k in 0..=degree {
                let reference: f64 = row[3 + k].parse().unwrap();
                // The fifth moment, which the logarithm alone needs, may err four times as much.
                let error = (found[k] - reference).abs() / reference.abs() / if k == 5 { 4.0 } else { 1.0 };
                assert!(!error.is_nan());
                if error > worst.0 {
                    let [exponent, near, far] = [row[0], row[1], row[2]];
                    worst = (error, format!("exponent {exponent}, gaps {near} and {far}, degree {k} of {degree}"));
                }
            }
        }
    }
    println!("segment: worst relative error {:.1e} at {}", worst.0, worst.1);
    // The requirement of the contact integrals, with two digits to spare against their 1e-10.
    assert!(worst.0 < 1e-12, "{worst:?}");
}

/// The facets and the field of a row of the table.
fn scene(row: &[&str]) -> (Facets, GapField) {
    let direction = Vec3::from_column_slice(&numbers(row[3]));
    let field = GapField::new(row[2].parse().unwrap(), direction);
    let facets = match numbers(row[1]).as_slice() {
        [a, b, c] => Facets::cuboid(&Vec3::new(*a, *b, *c)),
        nine => triangle(std::array::from_fn(|i| Vec3::from_column_slice(&nine[3 * i..3 * i + 3]))),
    };
    (facets, field)
}

#[test]
fn moments_over_triangles_and_boxes_agree_with_long_arithmetic() {
    let mut worst: [(f64, String); 4] = Default::default();
    for row in rows(include_str!("data/facet_moments.csv")) {
        let (facets, field) = scene(&row);
        let reach = facets.triangles().flatten().map(|point| point.norm()).fold(0.0, f64::max);
        let reference = numbers(row[4]);
        let kernel = kernel(row[0]);
        // Each order alone, and lowered from the next exponent and order: the ways of evaluation differ.
        let mut found: Vec<_> = (0..=3).map(|order| (order, moments(&facets, &field, kernel, order))).collect();
        if let Kernel::Power(exponent) = kernel {
            for order in 0..=2 {
                let next = MomentRequest { kernel: Kernel::Power(exponent + 1.0), order: order + 1 };
                let mut out = [Moments::default(); 2];
                facets.moments(&field, &[MomentRequest { kernel, order }, next], &mut out).unwrap();
                found.push((order, out[0]));
            }
        }
        for (order, moments) in &found {
            let errors = errors(&components(moments), &reference, reach);
            for (worst, error) in worst.iter_mut().zip(errors).take(order + 1) {
                if error > worst.0 {
                    *worst = (error, format!("exponent {}, shape {}, height {}", row[0], row[1], row[2]));
                }
            }
        }
    }
    for (order, (error, place)) in worst.iter().enumerate() {
        println!("facets, order {order}: worst error {error:.1e} of ∫ κ |X|^{order} dA at {place}");
        // The requirement; what remains is rounding, amplified where the recurrences subtract.
        assert!(*error < 1e-10, "order {order}: {error:e} at {place}");
    }
}

#[test]
fn tilted_flat_face_has_the_force_and_moment_of_its_closed_form() {
    // Row 12 of the known answers: b = L = 0.1, φ = 0.1, d₁ = 0.02, α = 1e-6, ν = 6.
    let (length, angle, nearest, strength) = (0.1, 0.1_f64, 0.02, 1e-6);
    let half = 0.5 * length;
    let corners = [(-half, -half), (half, -half), (half, half), (-half, half)].map(|(x, y)| Vec3::new(x, y, 0.0));
    let face = Facets::new(&corners, &[[0, 2, 1], [0, 3, 2]]).unwrap();
    let direction = Vec3::new(angle.sin(), 0.0, angle.cos());
    let field = GapField::new(nearest + half * angle.sin(), direction);
    let found = moments(&face, &field, Kernel::Power(6.0), 1);
    let force = strength * found.zeroth;
    let moment = strength * found.first.x;
    println!("tilted face: force {force:.10} N, moment {moment:.11} N m");
    // The reference has 12 digits.
    assert!((force / 54.3371749579 - 1.0).abs() < 1e-11, "{force}");
    assert!((moment / -1.02885578434 - 1.0).abs() < 1e-11, "{moment}");
}

#[test]
fn closed_gap_is_refused_and_leaves_the_sums_alone() {
    let facets = Facets::cuboid(&Vec3::new(0.2, 0.2, 0.2));
    let requests = [MomentRequest { kernel: Kernel::Power(6.0), order: 1 }];
    for height in [0.1, 0.05, -1.0, f64::NAN, f64::INFINITY] {
        let mut out = [Moments::default()];
        let field = GapField::new(height, Vec3::z());
        assert!(facets.moments(&field, &requests, &mut out).is_err(), "height {height}");
        assert_eq!(out, [Moments::default()]);
    }
}

#[test]
fn faulty_meshes_are_refused() {
    let points = [Vec3::zeros(), Vec3::x(), Vec3::y()];
    assert!(Facets::new(&points, &[[0, 1, 3]]).is_err());
    assert!(Facets::new(&[Vec3::zeros(), Vec3::x(), Vec3::new(0.0, f64::NAN, 0.0)], &[[0, 1, 2]]).is_err());
    assert!(Facets::new(&points, &[[0, 1, 1]]).unwrap().is_empty());
}

#[test]
fn box_knows_its_area_lowest_vertex_and_fastest_point() {
    let facets = Facets::cuboid(&Vec3::new(0.1, 0.2, 0.4));
    assert!((facets.area() - 0.28).abs() < 1e-15, "sum of twelve rounded areas");
    let field = GapField::new(1.0, Vec3::new(0.48, 0.6, 0.64));
    let (gap, point) = facets.smallest_gap(&field);
    assert_eq!(point, Vec3::new(-0.05, -0.1, -0.2));
    assert_eq!(gap, field.gap(&point));
    let spin = Mat3::new(0.0, -2.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    let fastest = facets.fastest_point(&Vec3::new(1.0, 0.0, 0.0), &spin);
    assert!((fastest - 1.2_f64.hypot(0.1)).abs() < 1e-15, "rounding of one norm: {fastest}");
}

#[test]
fn mesh_of_many_clusters_has_the_moments_of_its_triangles() {
    // A grid of 30 × 30 × 2 triangles against the two triangles of the whole square.
    let cells = 30_usize;
    let at = |i: usize, j: usize| Vec3::new(i as f64, j as f64, 0.0) / cells as f64;
    let points: Vec<Vec3> = (0..=cells).flat_map(|i| (0..=cells).map(move |j| at(i, j))).collect();
    let place = |i: usize, j: usize| i * (cells + 1) + j;
    let cell = |i: usize, j: usize| {
        [[place(i, j), place(i + 1, j), place(i + 1, j + 1)], [place(i, j), place(i + 1, j + 1), place(i, j + 1)]]
    };
    let triangles: Vec<[usize; 3]> = (0..cells).flat_map(|i| (0..cells).flat_map(move |j| cell(i, j))).collect();
    let mesh = Facets::new(&points, &triangles).unwrap();
    let square =
        Facets::new(&[at(0, 0), at(cells, 0), at(cells, cells), at(0, cells)], &[[0, 1, 2], [0, 2, 3]]).unwrap();
    let field = GapField::new(0.01, Vec3::new(0.3, 0.1, 0.9));
    for exponent in [1.0, 3.0, 6.5] {
        let [fine, coarse] =
            [&mesh, &square].map(|facets| components(&moments(facets, &field, Kernel::Power(exponent), 3)));
        // Gaps differ by rounding of 1e-16 in 0.01, times the exponent.
        for error in errors(&fine, &coarse, 2.0_f64.sqrt()) {
            assert!(error < 1e-12, "exponent {exponent}: {error:e}");
        }
    }
}

fn point() -> impl Strategy<Value = Vec3> {
    prop::array::uniform3(-0.5..0.5).prop_map(|x: [f64; 3]| Vec3::from(x))
}

/// A triangle, an exponent and a field whose smallest gap is 10^−3 … 1.
fn contact() -> impl Strategy<Value = ([Vec3; 3], f64, GapField)> {
    let exponent = prop_oneof![0.5..12.0, (1..12).prop_map(f64::from)];
    (prop::array::uniform3(point()), exponent, point(), -3.0..0.0)
        .prop_filter("a direction and an area", |(p, _, m, _)| {
            m.norm() > 0.1 && (p[1] - p[0]).cross(&(p[2] - p[0])).norm() > 1e-3
        })
        .prop_map(|(points, exponent, m, gap): (_, f64, Vec3, f64)| {
            let direction = m.normalize();
            let lowest = points.iter().map(|x| direction.dot(x)).fold(f64::INFINITY, f64::min);
            (points, exponent, GapField::new(10.0_f64.powf(gap) - lowest, direction))
        })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn moments_change_with_the_gap_as_the_next_power_says((points, exponent, field) in contact()) {
        let facets = triangle(points);
        let (gap, _) = facets.smallest_gap(&field);
        let next = moments(&facets, &field, Kernel::Power(exponent + 1.0), 3);
        let step = 1e-4 * gap;
        let at = |change: f64| moments(&facets, &GapField { height: field.height + change, ..field }, Kernel::Power(exponent), 2);
        let [before, after] = [at(-step), at(step)];
        // Central differences: (ν h/d)²/6 · (ν+2)²-like truncation below 4e-6 at ν = 12.
        let tolerance = 1e-5 * exponent * next.zeroth;
        prop_assert!(((after.zeroth - before.zeroth) / (2.0 * step) + exponent * next.zeroth).abs() < tolerance);
        prop_assert!(((after.first - before.first) / (2.0 * step) + exponent * next.first).norm() < tolerance);
        prop_assert!(((after.second - before.second) / (2.0 * step) + exponent * next.second).norm() < tolerance);
    }

    #[test]
    fn moments_change_with_the_direction_as_the_next_order_says((points, exponent, field) in contact(), turn in point()) {
        let facets = triangle(points);
        let (gap, _) = facets.smallest_gap(&field);
        let next = moments(&facets, &field, Kernel::Power(exponent + 1.0), 3);
        let step = 1e-4 * gap;
        let at = |change: f64| {
            let tilted = GapField { direction: field.direction + change * turn, ..field };
            moments(&facets, &tilted, Kernel::Power(exponent), 2)
        };
        let [before, after] = [at(-step), at(step)];
        let tolerance = 1e-5 * exponent * next.zeroth;
        let zeroth = (after.zeroth - before.zeroth) / (2.0 * step);
        let first = (after.first - before.first) / (2.0 * step);
        let second = (after.second - before.second) / (2.0 * step);
        prop_assert!((zeroth + exponent * next.first.dot(&turn)).abs() < tolerance);
        prop_assert!((first + exponent * next.second * turn).norm() < tolerance);
        prop_assert!((second + exponent * next.third.contract(&turn)).norm() < tolerance);
    }

    #[test]
    fn moments_turn_with_the_body((points, exponent, field) in contact(), axis in point()) {
        let turn = nalgebra::Rotation3::new(6.0 * axis).into_inner();
        let facets = triangle(points);
        let turned = facets.transformed(&turn, &Vec3::zeros());
        let turned_field = GapField { direction: turn * field.direction, ..field };
        let a = moments(&facets, &field, Kernel::Power(exponent), 3);
        let b = moments(&turned, &turned_field, Kernel::Power(exponent), 3);
        // The gaps differ by a few 1e-16 in 1e-3, times an exponent up to 12.
        let tolerance = 1e-10 * a.zeroth;
        prop_assert!((a.zeroth - b.zeroth).abs() < tolerance);
        prop_assert!((turn * a.first - b.first).norm() < tolerance);
        prop_assert!((turn * a.second * turn.transpose() - b.second).norm() < tolerance);
        let probe = Vec3::new(0.3, -0.5, 0.8);
        prop_assert!((turn * a.third.contract(&probe) * turn.transpose() - b.third.contract(&(turn * probe))).norm() < tolerance);
    }

    #[test]
    fn subdividing_a_triangle_leaves_its_moments((points, exponent, field) in contact(), weights in prop::array::uniform3(0.05..1.0)) {
        let [p, q, r] = points;
        let sum: f64 = weights.iter().sum();
        let inner = (p * weights[0] + q * weights[1] + r * weights[2]) / sum;
        let whole = moments(&triangle(points), &field, Kernel::Power(exponent), 3);
        let parts = Facets::new(&[p, q, r, inner], &[[0, 1, 3], [1, 2, 3], [2, 0, 3]]).unwrap();
        let split = moments(&parts, &field, Kernel::Power(exponent), 3);
        let (a, b) = (components(&whole), components(&split));
        // As above, the gap of the inner point is rounded.
        for (x, y) in a.iter().zip(&b) {
            prop_assert!((x - y).abs() < 1e-10 * whole.zeroth);
        }
    }

    #[test]
    fn several_requests_give_what_each_gives_alone((points, exponent, field) in contact()) {
        let facets = triangle(points);
        let kernels = [Kernel::Power(exponent), Kernel::Log, Kernel::Power(exponent + 1.0), Kernel::Power(3.0), Kernel::Power(2.0)];
        let orders = [1, 0, 2, 3, 2];
        let requests: Vec<_> = kernels.iter().zip(orders).map(|(&kernel, order)| MomentRequest { kernel, order }).collect();
        let mut together = [Moments::default(); 5];
        facets.moments(&field, &requests, &mut together).unwrap();
        for (request, together) in requests.iter().zip(&together) {
            let alone = moments(&facets, &field, request.kernel, request.order);
            // Shared powers may round differently.
            for (x, y) in components(&alone).iter().zip(components(together)) {
                prop_assert!((x - y).abs() <= 1e-12 * alone.zeroth.abs() + 1e-300);
            }
        }
    }
}
