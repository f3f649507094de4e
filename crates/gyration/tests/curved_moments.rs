//! Moments over curved surfaces against high-precision values and against relations that they must obey.
//!
//! The reference values come from `validation/oracles/curved_moments.py`, which integrates in another order, with the
//! azimuth in closed form. Errors are relative to ∫ |κ| |X|ⁿ dA, of which lower bounds are used.

use std::collections::BTreeMap;

use gyration::surface::curved::{ConeWall, Disk, Hemisphere};
use gyration::surface::curved::{Patch, Primitive};
use gyration::surface::{GapField, Kernel, MomentPlan, MomentRequest, Moments, Surface};
use gyration::tensor::{Mat3, SymmetricThird, Vec3};
use proptest::prelude::*;

const REFERENCE: &str = include_str!("data/curved_moments.csv");

fn moments(surface: &Surface, field: &GapField, kernel: Kernel) -> Moments {
    let mut out = [Moments::default()];
    surface.moments(field, &[MomentRequest { kernel, order: 3 }], &mut out).unwrap();
    out[0]
}

/// The components in the order xx, xy, xz, yy, yz, zz.
fn upper(a: &Mat3) -> [f64; 6] {
    [a.m11, a.m12, a.m13, a.m22, a.m23, a.m33]
}

/// Lower bounds of ∫ |κ| |X|ⁿ dA, n = 0 … 3, where κ has one sign: from the even moments, by |X| ≤ `reach` and Hölder.
fn scales(even: &Moments, reach: f64) -> [f64; 4] {
    let (zeroth, second) = (even.zeroth.abs(), even.second.trace().abs());
    [zeroth, second / reach, second, second.powf(1.5) / zeroth.sqrt()]
}

/// The largest error of a component relative to the scale of its order; NaN if there is one.
fn error(found: &Moments, expected: &Moments, scales: &[f64; 4]) -> f64 {
    let third = found.third.0.iter().zip(expected.third.0).map(|(a, b)| (a - b).abs() / scales[3]);
    let second = upper(&found.second).into_iter().zip(upper(&expected.second)).map(|(a, b)| (a - b).abs() / scales[2]);
    let lower = (found.second - found.second.transpose()).amax() / scales[2];
    let first = (0..3).map(|i| (found.first[i] - expected.first[i]).abs() / scales[1]);
    let rest = [(found.zeroth - expected.zeroth).abs() / scales[0], lower];
    let all = third.chain(second).chain(first).chain(rest);
    all.fold(0.0, |worst: f64, next| if next.is_nan() || worst.is_nan() { f64::NAN } else { worst.max(next) })
}

/// The scales of one kernel on a surface.
fn kernel_scales(surface: &Surface, field: &GapField, kernel: Kernel, of: &Moments) -> [f64; 4] {
    let reach = surface.fastest_point(&Vec3::zeros(), &Mat3::identity());
    match kernel {
        Kernel::Power(_) => scales(of, reach),
        // ln d may change sign on the surface; |ln d| averages above 0.1 in all cases here.
        Kernel::Log => scales(&moments(surface, field, Kernel::Power(0.0)), reach).map(|scale| 0.1 * scale),
    }
}

fn surface(shape: &str, p: &[f64]) -> Surface {
    match shape {
        "sphere" => Surface::sphere(p[0]),
        "ellipsoid" => Surface::ellipsoid(&Vec3::new(p[0], p[1], p[2])),
        "spheroid" => Surface::ellipsoid(&Vec3::new(p[0], p[0], p[1])),
        "cylinder" => Surface::cylinder(p[0], p[1]),
        "cone" => Surface::cone(p[0], p[1]),
        "capsule" => Surface::capsule(p[0], p[1]),
        _ => Surface::torus(p[0], p[1]),
    }
}

fn kernel(name: &str) -> Kernel {
    if name == "log" { Kernel::Log } else { Kernel::Power(name.parse().unwrap()) }
}

fn expected(values: &[f64]) -> Moments {
    let s = &values[4..10];
    let mut moments = Moments {
        zeroth: values[0],
        first: Vec3::new(values[1], values[2], values[3]),
        second: Mat3::new(s[0], s[1], s[2], s[1], s[3], s[4], s[2], s[4], s[5]),
        ..Moments::default()
    };
    moments.third.0.copy_from_slice(&values[10..20]);
    moments
}

#[test]
fn moments_agree_with_high_precision_values() {
    let mut worst: BTreeMap<String, (f64, String)> = BTreeMap::new();
    for line in REFERENCE.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let p: Vec<f64> = cells[1..4].iter().map(|cell| cell.parse().unwrap()).collect();
        let values: Vec<f64> = cells[5..].iter().map(|cell| cell.parse().unwrap()).collect();
        let field = GapField::new(values[0], Vec3::new(values[1], values[2], values[3]));
        let surface = surface(cells[0], &p);
        let found = moments(&surface, &field, kernel(cells[4]));
        let expected = expected(&values[4..]);
        let (gap, _) = surface.smallest_gap(&field);
        // g₀ and the size are of order 1: their rounding moves the gap by 2e-16 and d^−ν by ν times that share.
        let rounding = if let Kernel::Power(nu) = kernel(cells[4]) { 4e-16 * nu.abs() / gap } else { 0.0 };
        let scales = kernel_scales(&surface, &field, kernel(cells[4]), &expected);
        let error = error(&found, &expected, &scales) - rounding;
        let entry = worst.entry(format!("{} {p:?}", cells[0])).or_default();
        if error.is_nan() || error > entry.0 {
            let case = format!("kernel {}, gap {gap:.1e}, m {:?}", cells[4], field.direction.as_slice());
            *entry = (error, case);
        }
    }
    for (shape, (error, case)) in &worst {
        println!("{shape}: worst error {error:.1e} ({case})");
    }
    for (shape, (error, case)) in &worst {
        let tolerance = if shape.starts_with("sphere") { 1e-12 } else { 1e-9 };
        assert!(*error < tolerance, "{shape}: {error:e} ({case})");
    }
}

/// One of each kind of surface, all of size 1.
fn samples() -> Vec<Surface> {
    vec![
        Surface::sphere(0.5),
        Surface::ellipsoid(&Vec3::new(0.5, 0.35, 0.2)),
        Surface::ellipsoid(&Vec3::new(0.05, 0.5, 0.5)),
        Surface::cylinder(0.5, 1.0),
        Surface::cone(0.4, 1.0),
        Surface::capsule(0.25, 0.5),
        Surface::torus(0.35, 0.15),
        Surface::cuboid(&Vec3::new(1.0, 0.5, 0.3)),
    ]
}

fn rotation(axis: &Vec3, angle: f64) -> Mat3 {
    let k = gyration::tensor::cross_matrix(&axis.normalize());
    Mat3::identity() + k * angle.sin() + k * k * (1.0 - angle.cos())
}

/// The field with the given direction and smallest gap.
fn field_above(surface: &Surface, direction: Vec3, gap: f64) -> GapField {
    let (lowest, _) = surface.smallest_gap(&GapField::new(0.0, direction));
    GapField::new(gap - lowest, direction)
}

fn assert_same(found: &Moments, expected: &Moments, scales: &[f64; 4], tolerance: f64, what: &str) {
    let error = error(found, expected, scales);
    assert!(error < tolerance, "{what}: {error:e}");
}

fn sum(a: &Moments, b: &Moments, weight: f64) -> Moments {
    Moments {
        zeroth: a.zeroth + weight * b.zeroth,
        first: a.first + weight * b.first,
        second: a.second + weight * b.second,
        third: SymmetricThird(std::array::from_fn(|i| a.third.0[i] + weight * b.third.0[i])),
    }
}

fn scaled(a: &Moments, weight: f64) -> Moments {
    sum(&Moments::default(), a, weight)
}

fn directions() -> impl Strategy<Value = Vec3> {
    (-1.0..1.0f64, -1.0..1.0f64, -1.0..1.0f64)
        .prop_map(|(x, y, z)| Vec3::new(x, y, z))
        .prop_filter("a direction", |v| v.norm() > 0.1)
}

/// Gaps down to a share 10^lowest of the size.
fn gaps(lowest: f64) -> impl Strategy<Value = f64> {
    (lowest..1.0).prop_map(|exponent: f64| 10f64.powf(exponent))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, failure_persistence: None, ..ProptestConfig::default() })]

    /// ∂A_k/∂g₀ = −ν A_k(ν+1), against differences of fourth order with a step of 1e-3 gaps: (ν 1e-3)⁴ plus the rules'
    /// 1e-10 over that step.
    #[test]
    fn slope_in_height_is_the_next_exponent(direction in directions(), gap in gaps(-4.0), nu in 0.5..12.0f64) {
        for surface in samples() {
            let field = field_above(&surface, direction.normalize(), gap);
            let at = |steps: f64| {
                let moved = GapField { height: field.height + 1e-3 * gap * steps, ..field };
                moments(&surface, &moved, Kernel::Power(nu))
            };
            let near = sum(&at(1.0), &at(-1.0), -1.0);
            let slope = scaled(&sum(&scaled(&near, 8.0), &sum(&at(2.0), &at(-2.0), -1.0), -1.0), 1.0 / (12e-3 * gap));
            let next = scaled(&moments(&surface, &field, Kernel::Power(nu + 1.0)), -nu);
            // The bound on rounding: the difference is relative to κ itself, which is d/ν times larger than its slope.
            let kernel = moments(&surface, &field, Kernel::Power(nu));
            let size = kernel_scales(&surface, &field, Kernel::Power(nu), &kernel);
            let own = kernel_scales(&surface, &field, Kernel::Power(nu), &next);
            let scales: [f64; 4] = std::array::from_fn(|n| own[n] + 1e-3 * size[n] / gap);
            assert_same(&slope, &next, &scales, 1e-6, "slope in g₀");
        }
    }

    /// ∂A_k/∂m = −ν A_(k+1)(ν+1), along a random direction.
    #[test]
    fn slope_in_direction_is_the_next_order(
        direction in directions(), turn in directions(), gap in gaps(-4.0), nu in 0.5..12.0f64,
    ) {
        for surface in samples() {
            let field = field_above(&surface, direction.normalize(), gap);
            let at = |steps: f64| {
                let moved = GapField { direction: field.direction + 1e-3 * gap * steps * turn, ..field };
                moments(&surface, &moved, Kernel::Power(nu))
            };
            let near = sum(&at(1.0), &at(-1.0), -1.0);
            let slope = scaled(&sum(&scaled(&near, 8.0), &sum(&at(2.0), &at(-2.0), -1.0), -1.0), 1.0 / (12e-3 * gap));
            let next = moments(&surface, &field, Kernel::Power(nu + 1.0));
            let kernel = moments(&surface, &field, Kernel::Power(nu));
            let reach = surface.fastest_point(&Vec3::zeros(), &Mat3::identity());
            // Rounding and the rules' error over the step, and the slope itself.
            let scale = |n: i32| nu * next.zeroth * reach.powi(n + 1) + 1e-3 * kernel.zeroth / gap * reach.powi(n);
            let zeroth = (slope.zeroth + nu * next.first.dot(&turn)).abs() / scale(0);
            let first = (slope.first + nu * next.second * turn).amax() / scale(1);
            let second = (slope.second + nu * next.third.contract(&turn)).amax() / scale(2);
            prop_assert!(zeroth.max(first).max(second) < 1e-6, "{zeroth:e} {first:e} {second:e}");
        }
    }

    /// Turning and moving the body and the plane together turns and moves the moments.
    #[test]
    fn moments_turn_with_the_body(
        direction in directions(), axis in directions(), angle in 0.0..6.0f64, gap in gaps(-6.0), nu in 0.5..12.0f64,
    ) {
        let (turn, offset) = (rotation(&axis, angle), Vec3::new(0.3, -0.2, 0.1));
        for surface in samples() {
            let field = field_above(&surface, direction.normalize(), gap);
            let turned = turn * field.direction;
            let moved_field = GapField::new(field.height - turned.dot(&offset), turned);
            let found = moments(&surface.transformed(&turn, &offset), &moved_field, Kernel::Power(nu));
            let back = moments(&surface, &field, Kernel::Power(nu));
            let reach = surface.fastest_point(&Vec3::zeros(), &Mat3::identity()) + offset.norm();
            let first = turn * back.first + back.zeroth * offset;
            let cross = turn * back.first * offset.transpose();
            let second = turn * back.second * turn.transpose() + cross + cross.transpose()
                + back.zeroth * offset * offset.transpose();
            // Twice the rules' accuracy, and the rounding of the gap.
            let tolerance = 2e-9 + 1e-15 * nu / gap;
            prop_assert!((found.zeroth / back.zeroth - 1.0).abs() < tolerance);
            prop_assert!((found.first - first).amax() < tolerance * reach * back.zeroth);
            prop_assert!((found.second - second).amax() < tolerance * reach * reach * back.zeroth);
        }
    }

    /// Rules serve all kernels of a call, so that company changes the nodes: what changes with them is the rules'
    /// error.
    #[test]
    fn moments_do_not_depend_on_what_else_is_asked(
        direction in directions(), gap in gaps(-6.0), nu in -1.0..12.0f64, axes in prop::array::uniform3(-1.3..0.0f64),
    ) {
        let ellipsoid = Surface::ellipsoid(&Vec3::from(axes.map(|exponent| 0.5 * 10f64.powf(exponent))));
        for surface in samples().into_iter().chain([ellipsoid]) {
            let field = field_above(&surface, direction.normalize(), gap);
            let alone = moments(&surface, &field, Kernel::Power(nu));
            let kernels = [Kernel::Power(nu), Kernel::Power(-1.0), Kernel::Power(15.0), Kernel::Log];
            let mut out = [Moments::default(); 4];
            surface.moments(&field, &kernels.map(|kernel| MomentRequest { kernel, order: 3 }), &mut out).unwrap();
            let tolerance = 1e-9 + 1e-15 * nu.abs() / gap;
            let scales = kernel_scales(&surface, &field, Kernel::Power(nu), &alone);
            assert_same(&out[0], &alone, &scales, tolerance, &format!("{surface:?}"));
        }
    }

    /// Surfaces that coincide by construction but not in the code.
    #[test]
    fn equal_surfaces_have_equal_moments(direction in directions(), gap in gaps(-6.0), nu in -1.0..12.0f64) {
        let patch = |primitive| Patch::new(primitive);
        let upper = patch(Primitive::Hemisphere(Hemisphere { radius: 0.5 }));
        let flip = rotation(&Vec3::new(1.0, 0.4, 0.0), std::f64::consts::PI);
        let flat = Surface::from_patches(vec![patch(Primitive::ConeWall(ConeWall { radius: 0.5, height: 0.0 }))]);
        let pairs = [
            ("equal axes", Surface::ellipsoid(&Vec3::new(0.5, 0.5, 0.5)), Surface::sphere(0.5)),
            ("two halves", Surface::from_patches(vec![upper, upper.transformed(&flip, &Vec3::zeros())]), Surface::sphere(0.5)),
            ("no cylinder", Surface::capsule(0.5, 0.0), Surface::sphere(0.5)),
            ("flat cone", flat, Surface::from_patches(vec![patch(Primitive::Disk(Disk { radius: 0.5 }))])),
        ];
        for (name, found, expected) in pairs {
            let field = field_above(&expected, direction.normalize(), gap);
            let kernel = Kernel::Power(nu);
            let (a, b) = (moments(&found, &field, kernel), moments(&expected, &field, kernel));
            let tolerance = 1e-9 + 1e-15 * nu.abs() / gap;
            assert_same(&a, &b, &kernel_scales(&expected, &field, kernel, &b), tolerance, name);
        }
    }
}

/// Integrals around the rim against those over the parallels, point by point: the rim at any distance from the lowest
/// and the highest point of the sphere, and on them.
#[test]
fn tilted_hemispheres_agree_with_sums_over_points() {
    let surface = Surface::from_patches(vec![Patch::new(Primitive::Hemisphere(Hemisphere { radius: 0.5 }))]);
    let mut worst: f64 = 0.0;
    for size in [0.0, 1e-12, 1e-9, 1e-6, 1e-3, 0.05, 0.4, 0.9, 1.0 - 1e-9, 1.0] {
        for cosine in [size, -size] as [f64; 2] {
            let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
            for gap in [1e-3, 0.03, 0.7] {
                // The gap of the whole sphere, as of one end of a capsule.
                let field = GapField::new(gap + 0.5, Vec3::new(0.6 * sine, -0.8 * sine, cosine));
                for kernel in
                    [Kernel::Power(-0.5), Kernel::Log, Kernel::Power(2.5), Kernel::Power(6.0), Kernel::Power(12.0)]
                {
                    let plan = MomentPlan::new(vec![MomentRequest { kernel, order: 3 }]);
                    let mut points = [Moments::default()];
                    surface.deformed_moments(&field, &Mat3::identity(), &plan, &mut points).unwrap();
                    let found = moments(&surface, &field, kernel);
                    let found = error(&found, &points[0], &kernel_scales(&surface, &field, kernel, &points[0]));
                    // The accuracy that the rules of points promise.
                    assert!(found < 1e-9, "c_z {cosine}, gap {gap}, {kernel:?}: {found:e}");
                    worst = worst.max(found);
                }
            }
        }
    }
    println!("tilted hemispheres: worst error {worst:.1e}");
}

/// Closed forms around the tube against sums over its points: the plane across the axis, along it and between, thick
/// and thin tubes, requests of every order.
#[test]
fn tori_in_closed_form_agree_with_sums_over_points() {
    let mut worst: f64 = 0.0;
    for minor in [0.02, 0.2, 0.499] {
        let surface = Surface::torus(0.5, minor);
        for direction in [[0.0, 0.0, 1.0], [1e-7, 0.0, -1.0], [0.6, 0.8, 0.0], [0.6, -0.8, 1e-6], [0.3, -0.5, 0.8]] {
            for gap in [1e-4, 0.03, 0.7, 20.0] {
                let field = field_above(&surface, Vec3::from(direction).normalize(), gap);
                for kernel in [1.0, 2.0, 3.0, 4.0, 7.0, 12.0].map(Kernel::Power) {
                    let plan = MomentPlan::new(vec![MomentRequest { kernel, order: 3 }]);
                    let mut points = [Moments::default()];
                    surface.deformed_moments(&field, &Mat3::identity(), &plan, &mut points).unwrap();
                    let scales = kernel_scales(&surface, &field, kernel, &points[0]);
                    for order in 0..=3 {
                        let mut found = [Moments::default()];
                        surface.moments(&field, &[MomentRequest { kernel, order }], &mut found).unwrap();
                        let mut expected = points[0];
                        expected.first *= f64::from(u8::from(order >= 1));
                        expected.second *= f64::from(u8::from(order >= 2));
                        expected.third.0.iter_mut().for_each(|entry| *entry *= f64::from(u8::from(order >= 3)));
                        worst = worst.max(error(&found[0], &expected, &scales));
                    }
                }
            }
        }
    }
    println!("tori in closed form: worst error {worst:.1e}");
    // The rounding of the gap, 1e-15 ν/d = 1.2e-10 at worst, and the accuracy of the rule around the axis.
    assert!(worst < 2e-10, "{worst:e}");
}

/// The far side counts as much as the near one: the rule must see the zero of the gap from there too.
#[test]
fn mild_kernels_close_to_the_plane_are_resolved() {
    let (sphere, ellipsoid) = (Surface::sphere(0.5), Surface::ellipsoid(&Vec3::new(0.5, 0.5, 0.5)));
    let mut worst: f64 = 0.0;
    for gap in [1e-6, 1e-5, 1e-4, 1e-2, 1.0] {
        for nu in [-1.0, -0.3, 0.0, 0.4, 0.77, 0.99, 1.0, 1.2, 1.7, 2.3] {
            let field = field_above(&sphere, Vec3::new(0.3, -0.5, 0.8).normalize(), gap);
            let kernel = Kernel::Power(nu);
            let (found, expected) = (moments(&ellipsoid, &field, kernel), moments(&sphere, &field, kernel));
            let scales = kernel_scales(&sphere, &field, kernel, &expected);
            // The rounding of the gap.
            worst = worst.max(error(&found, &expected, &scales) - 1e-15 * nu.abs() / gap);
        }
    }
    println!("mild kernels: worst error {worst:.1e}");
    // The rule promises some 1e-11.
    assert!(worst < 1e-10, "{worst:e}");
}

#[test]
fn zeroth_power_gives_the_area() {
    for surface in samples() {
        let field = field_above(&surface, Vec3::new(0.3, -0.5, 0.8), 0.1);
        let found = moments(&surface, &field, Kernel::Power(0.0)).zeroth;
        // The accuracy of the rules.
        assert!((found / surface.area() - 1.0).abs() < 1e-9, "{surface:?}: {found} against {}", surface.area());
    }
}

#[test]
fn area_of_a_spheroid_is_the_closed_form_in_any_attitude() {
    for ratio in [1.5, 5.0, 20.0, 100.0] {
        // Prolate with a = 1/ratio, c = 1, e² = 1 − a²/c²: 2πa²(1 + c/(a e) arcsin e); oblate with the roles exchanged:
        // 2πc²(1 + a²/(c² e) artanh e).
        let a: f64 = 1.0 / ratio;
        let e = (1.0 - a * a).sqrt();
        let prolate = 2.0 * std::f64::consts::PI * a * a * (1.0 + e.asin() / (a * e));
        let oblate = 2.0 * std::f64::consts::PI * (1.0 + a * a / e * e.atanh());
        let pairs = [(Vec3::new(a, a, 1.0), prolate), (Vec3::new(1.0, 1.0, a), oblate)];
        for ((axes, exact), direction) in pairs.into_iter().flat_map(|pair| {
            [(0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.3, -0.5, 0.8), (0.01, 0.02, 1.0), (1.0, 0.2, 0.005)]
                .map(|d| (pair, d))
        }) {
            let surface = Surface::ellipsoid(&axes);
            let field = field_above(&surface, Vec3::from(<[f64; 3]>::from(direction)).normalize(), 0.03);
            let found = moments(&surface, &field, Kernel::Power(0.0)).zeroth;
            // The accuracy of the rules.
            assert!((found / exact - 1.0).abs() < 1e-9, "{axes:?}, {direction:?}: {found} against {exact}");
        }
    }
}

#[test]
fn fastest_point_of_a_spin_and_a_stretch_is_known() {
    let spin = gyration::tensor::cross_matrix(&Vec3::new(0.0, 0.0, 2.0));
    let stretch = Mat3::from_diagonal(&Vec3::new(1.0, 2.0, 3.0));
    let v = Vec3::new(0.0, 0.0, 5.0);
    let zero = Vec3::zeros();
    // The ascent stops when a step gains less than 1e-14 of the squared speed.
    let near = |found: f64, exact: f64| assert!((found / exact - 1.0).abs() < 1e-9, "{found} against {exact}");
    near(Surface::sphere(0.5).fastest_point(&v, &spin), 26f64.sqrt());
    near(Surface::torus(0.35, 0.15).fastest_point(&zero, &spin), 1.0);
    near(Surface::capsule(0.25, 0.5).fastest_point(&v, &stretch), 6.5);
    near(Surface::cylinder(0.5, 1.0).fastest_point(&zero, &stretch), (1.0f64 + 2.25).sqrt());
    near(Surface::cone(0.4, 1.0).fastest_point(&v, &stretch), 6.5);
    near(Surface::ellipsoid(&Vec3::new(0.5, 0.35, 0.2)).fastest_point(&zero, &stretch), 0.7);
}

#[test]
fn touching_and_broken_fields_are_refused() {
    for surface in samples() {
        let direction = Vec3::new(0.3, -0.5, 0.8);
        for gap in [0.0, -1e-17, -1e-12, -0.1, f64::NAN, f64::INFINITY] {
            // A box that stands exactly on the plane may have a gap of 1e-17 by rounding.
            let gap = if surface.patches.is_empty() { gap - 1e-12 } else { gap };
            let mut field = field_above(&surface, direction, gap);
            if !gap.is_finite() {
                field.height = gap;
            }
            let mut out = [Moments::default()];
            let request = MomentRequest { kernel: Kernel::Power(6.0), order: 1 };
            assert!(surface.moments(&field, &[request], &mut out).is_err(), "{surface:?} at {gap}");
        }
    }
}
