//! Relations that moments of deformed surfaces obey whatever the surface: rotations, growth, traces, derivatives by P,
//! areas.

use crate::deformed::charts::charts;
use crate::deformed::{Numbers, SHAPES, cofactor, field_above, surface};
use gyration::surface::{GapField, Kernel, MomentPlan, MomentRequest, Moments, OrientedMoments, Surface};
use gyration::tensor::{Mat3, Vec3};

/// The pairs in the order of the results.
const PAIRS: [(usize, usize); 6] = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];

fn plan(kernel: Kernel, order: usize) -> MomentPlan {
    MomentPlan::new(vec![MomentRequest { kernel, order }])
}

fn deformed(surface: &Surface, field: &GapField, cofactor: &Mat3, kernel: Kernel, order: usize) -> Moments {
    let mut out = [Moments::default()];
    surface.deformed_moments(field, cofactor, &plan(kernel, order), &mut out).unwrap();
    out[0]
}

fn oriented(surface: &Surface, field: &GapField, cofactor: &Mat3, kernel: Kernel, order: usize) -> OrientedMoments {
    let mut out = [OrientedMoments::default()];
    surface.oriented_moments(field, cofactor, &plan(kernel, order), &mut out).unwrap();
    out[0]
}

fn reference(surface: &Surface, field: &GapField, kernel: Kernel) -> Moments {
    let mut out = [Moments::default()];
    surface.planned_moments(field, &plan(kernel, 3), &mut out).unwrap();
    out[0]
}

/// The largest difference of a component, X being of order 1, relative to A₀.
fn difference(a: &Moments, b: &Moments, scale: f64) -> f64 {
    let third = a.third.0.iter().zip(b.third.0).map(|(a, b)| a - scale * b);
    let rest = [a.zeroth - scale * b.zeroth, (a.first - scale * b.first).amax(), (a.second - scale * b.second).amax()];
    let largest = third.chain(rest).fold(0.0, |worst: f64, x| if x.is_nan() { f64::NAN } else { worst.max(x.abs()) });
    largest / (scale * b.zeroth).abs()
}

/// Shapes, gradients, fields and exponents.
fn samples(count: usize) -> Vec<(&'static str, Surface, Mat3, GapField, f64)> {
    let mut numbers = Numbers(0.456);
    let mut samples = Vec::new();
    for shape in SHAPES {
        for _ in 0..count {
            let surface = surface(shape);
            let gradient = numbers.gradient();
            let gap = 10f64.powf(-3.0 * numbers.draw());
            let field = field_above(&surface, gradient.tr_mul(&numbers.vector().normalize()), gap);
            samples.push((shape, surface, gradient, field, 0.5 + 12.0 * numbers.draw()));
        }
    }
    samples
}

#[test]
fn rotation_and_growth_change_no_more_than_the_area() {
    let mut worst: f64 = 0.0;
    let mut numbers = Numbers(0.789);
    for (shape, surface, _, field, nu) in samples(6) {
        let expected = reference(&surface, &field, Kernel::Power(nu));
        for growth in [1.0, 0.6, 1.4] {
            let cofactor = growth * growth * numbers.rotation();
            let found = deformed(&surface, &field, &cofactor, Kernel::Power(nu), 3);
            let error = difference(&found, &expected, growth * growth);
            worst = worst.max(error);
            // Facets round; curved rules promise 1e-10, and both sides use one.
            let tolerance = if shape == "cuboid" { 1e-14 * (1.0 + nu) } else { 2e-10 };
            assert!(error < tolerance, "{shape}, ν {nu}, growth {growth}: {error:e}");
        }
    }
    println!("rotation and growth: worst difference {worst:.1e}");
}

#[test]
fn traces_of_oriented_moments_are_those_of_lower_rank() {
    let mut worst: f64 = 0.0;
    for (shape, surface, gradient, field, nu) in samples(4) {
        let (cofactor, kernel) = (cofactor(&gradient), Kernel::Power(nu));
        let expected = deformed(&surface, &field, &cofactor, kernel, 2);
        let [xx, _, _, yy, _, zz] = oriented(&surface, &field, &cofactor, kernel, 2).pairs;
        let trace = Moments {
            zeroth: xx.zeroth + yy.zeroth + zz.zeroth,
            first: xx.first + yy.first + zz.first,
            second: xx.second + yy.second + zz.second,
            ..Moments::default()
        };
        let scalar = oriented(&surface, &field, &cofactor, kernel, 0);
        let f = &scalar.fourth;
        // abxx + abyy + abzz for each pair ab.
        let traces = [
            f[0] + f[3] + f[5],
            f[1] + f[6] + f[8],
            f[2] + f[7] + f[9],
            f[3] + f[10] + f[12],
            f[4] + f[11] + f[13],
            f[5] + f[12] + f[14],
        ];
        let pairs = scalar.pairs.iter().zip(traces).map(|(pair, trace)| (pair.zeroth - trace).abs() / expected.zeroth);
        let error = pairs.fold(difference(&trace, &expected, 1.0), f64::max);
        worst = worst.max(error);
        // Each side is good to 1e-10.
        assert!(error < 3e-10, "{shape}, ν {nu}: {error:e}");
    }
    println!("traces: worst difference {worst:.1e}");
}

/// Plans are cut into groups, requests of order 0 have a fourth power wherever they stand, and rules serve all kernels
/// of a call.
#[test]
fn requests_do_not_depend_on_their_company() {
    let kernels = [6.0, 3.0, 5.0, 2.5, 13.0, 0.5, 7.0, 1.0, 4.0].map(Kernel::Power);
    let orders = [1, 2, 0, 0, 2, 1, 0, 2, 0];
    let requests: Vec<_> =
        kernels.into_iter().zip(orders).map(|(kernel, order)| MomentRequest { kernel, order }).collect();
    let together = MomentPlan::new(requests.clone());
    for (shape, surface, gradient, field, _) in samples(2) {
        let cofactor = cofactor(&gradient);
        let (mut sums, mut dyads) = ([Moments::default(); 9], [OrientedMoments::default(); 9]);
        surface.deformed_moments(&field, &cofactor, &together, &mut sums).unwrap();
        surface.oriented_moments(&field, &cofactor, &together, &mut dyads).unwrap();
        for ((request, sum), dyad) in requests.iter().zip(&sums).zip(&dyads) {
            let alone = deformed(&surface, &field, &cofactor, request.kernel, request.order);
            let mut error = difference(sum, &alone, 1.0);
            let alone = oriented(&surface, &field, &cofactor, request.kernel, request.order);
            for (pair, alone) in dyad.pairs.iter().zip(&alone.pairs) {
                error = error.max(difference(pair, alone, 1.0) * (alone.zeroth / sum.zeroth).abs());
            }
            for (fourth, alone) in dyad.fourth.iter().zip(alone.fourth) {
                error = error.max((fourth - alone).abs() / sum.zeroth);
            }
            // Twice the rules' accuracy.
            assert!(error < 2e-10, "{shape}, {request:?}: {error:e}");
            assert_eq!(dyad.fourth == [0.0; 15], request.order > 0, "{shape}, {request:?}");
        }
    }
}

/// With H = δP P⁻¹: δk = k (tr H − m·H m), and v = k m changes by (tr H − Hᵀ) v.
#[test]
fn slopes_in_the_gradient_are_oriented_moments() {
    /// Step of the differences, of fourth order: 1e-12 of higher derivatives, and the rules' 1e-11 over the step.
    const STEP: f64 = 1e-3;
    let mut numbers = Numbers(0.321);
    let mut worst: f64 = 0.0;
    for (shape, surface, gradient, field, nu) in samples(3) {
        let kernel = Kernel::Power(nu);
        let rate = Mat3::from_fn(|_, _| 2.0 * numbers.draw() - 1.0);
        let h = rate * gradient.try_inverse().unwrap();
        let at = |steps: f64| cofactor(&(gradient + STEP * steps * rate));
        let slope = |value: &dyn Fn(f64) -> f64| {
            (8.0 * (value(1.0) - value(-1.0)) - (value(2.0) - value(-2.0))) / (12.0 * STEP)
        };
        let own = cofactor(&gradient);
        let (of, scalar) = (oriented(&surface, &field, &own, kernel, 1), oriented(&surface, &field, &own, kernel, 0));
        let sums = deformed(&surface, &field, &own, kernel, 1);
        let twice = |a: usize, b: usize| if a == b { h[(a, a)] } else { h[(a, b)] + h[(b, a)] };
        let along = |value: &dyn Fn(&Moments) -> f64| -> f64 {
            let products = PAIRS.iter().zip(&of.pairs).map(|(&(a, b), pair)| twice(a, b) * value(pair));
            h.trace() * value(&sums) - products.sum::<f64>()
        };
        let mut errors = Vec::new();
        let zeroth = slope(&|steps| deformed(&surface, &field, &at(steps), kernel, 0).zeroth);
        errors.push(zeroth - along(&|m| m.zeroth));
        for axis in 0..3 {
            let first = slope(&|steps| deformed(&surface, &field, &at(steps), kernel, 1).first[axis]);
            errors.push(first - along(&|m| m.first[axis]));
        }
        let pair =
            |a: usize, b: usize| scalar.pairs[PAIRS.iter().position(|&p| p == (a.min(b), a.max(b))).unwrap()].zeroth;
        for (place, (a, b)) in PAIRS.into_iter().enumerate() {
            let found = slope(&|steps| oriented(&surface, &field, &at(steps), kernel, 0).pairs[place].zeroth);
            let turned: f64 = (0..3).map(|c| h[(c, a)] * pair(c, b) + h[(c, b)] * pair(a, c)).sum();
            let fourth: f64 =
                PAIRS.iter().map(|&(c, d)| twice(c, d) * scalar.fourth[place_of_fourth([a, b, c, d])]).sum();
            errors.push(found - (h.trace() * pair(a, b) - turned + fourth));
        }
        let error = errors.into_iter().fold(0.0, |worst: f64, e| if e.is_nan() { e } else { worst.max(e.abs()) });
        let error = error / (sums.zeroth * h.norm());
        worst = worst.max(error);
        assert!(error < 2e-8, "{shape}, ν {nu}: {error:e}");
    }
    println!("slopes in the gradient: worst error {worst:.1e}");
}

/// The place of a component of the fourth power.
fn place_of_fourth(mut indices: [usize; 4]) -> usize {
    indices.sort_unstable();
    let all =
        (0..3).flat_map(|a| (a..3).flat_map(move |b| (b..3).flat_map(move |c| (c..3).map(move |d| [a, b, c, d]))));
    all.into_iter().position(|entry| entry == indices).unwrap()
}

/// X = P⁻¹ Y maps the ellipsoid back to the sphere: the same surface above the same plane.
#[test]
fn stretched_sphere_is_the_ellipsoid() {
    let mut worst: f64 = 0.0;
    let mut numbers = Numbers(0.654);
    for _ in 0..40 {
        let stretches = Vec3::from_fn(|_, _| 4f64.powf(numbers.draw() - 0.5));
        let normal = numbers.vector().normalize();
        let gap = 10f64.powf(-4.0 * numbers.draw());
        let nu = 13.0 * numbers.draw();
        let gradient = Mat3::from_diagonal(&stretches);
        let (sphere, ellipsoid) = (Surface::sphere(0.5), Surface::ellipsoid(&(0.5 * stretches)));
        let field = field_above(&ellipsoid, normal, gap);
        let expected = reference(&ellipsoid, &field, Kernel::Power(nu));
        let own = GapField::new(field.height, gradient.tr_mul(&normal));
        let found = deformed(&sphere, &own, &cofactor(&gradient), Kernel::Power(nu), 2);
        let carried = Moments {
            zeroth: found.zeroth,
            first: gradient * found.first,
            second: gradient * found.second * gradient.transpose(),
            ..Moments::default()
        };
        let error = difference(&carried, &Moments { third: Default::default(), ..expected }, 1.0);
        worst = worst.max(error);
        // Two rules of 1e-10, and the rounding of the gap.
        assert!(error < 2e-10 + 1e-15 * nu / gap, "{stretches}, ν {nu}, gap {gap:e}: {error:e}");
    }
    println!("sphere against ellipsoid: worst difference {worst:.1e}");
}

#[test]
fn areas_of_deformed_bodies_are_the_closed_forms() {
    let flat = GapField::new(1.0, Vec3::zeros());
    let area = |surface: &Surface, p: &Mat3| deformed(surface, &flat, &cofactor(p), Kernel::Power(0.0), 0).zeroth;
    let shear = Mat3::new(1.0, 2.0, 0.5, 0.0, 1.0, -1.5, 0.0, 0.0, 1.0);
    let (x, y, z): (Vec3, Vec3, Vec3) = (shear.column(0).into(), shear.column(1).into(), shear.column(2).into());
    let faces = 2.0 * (x.cross(&y).norm() * 0.5 + y.cross(&z).norm() * 0.15 + z.cross(&x).norm() * 0.3);
    let cuboid = area(&surface("cuboid"), &shear);
    assert!((cuboid / faces - 1.0).abs() < 1e-14, "parallelograms: {cuboid} against {faces}");
    // A cone pulled along its axis, a tube pulled to another radius and height: again a cone, again a tube.
    let pulled = Mat3::from_diagonal(&Vec3::new(1.5, 1.5, 0.4));
    for (from, to) in [
        (Surface::cone(0.4, 1.0), Surface::cone(0.6, 0.4)),
        (Surface::cylinder(0.5, 1.0), Surface::cylinder(0.75, 0.4)),
        (Surface::ellipsoid(&Vec3::new(0.5, 0.3, 0.2)), Surface::ellipsoid(&Vec3::new(0.75, 0.45, 0.08))),
    ] {
        let (found, expected) = (area(&from, &pulled), to.area());
        assert!((found / expected - 1.0).abs() < 1e-11, "{found} against {expected}");
    }
}

/// The smallest gap, and the fastest point, of strongly sheared bodies: against a search over the patches.
#[test]
fn extreme_points_of_sheared_bodies_are_found() {
    let mut numbers = Numbers(0.987);
    for shape in SHAPES {
        for shear in [0.0, 3.0, 30.0] {
            let gradient = numbers.gradient() + shear * numbers.vector() * numbers.vector().transpose();
            let direction = gradient.tr_mul(&numbers.vector().normalize());
            let field = GapField::new(0.3, direction);
            let (rate, velocity) = (Mat3::from_fn(|_, _| numbers.draw() - 0.5) * gradient, numbers.vector());
            let (mut lowest, mut fastest) = (f64::INFINITY, 0.0_f64);
            for (chart, [a, b, c, d]) in charts(shape) {
                for i in 0..=300 {
                    for j in 0..=300 {
                        let (u, v) = (a + (b - a) * f64::from(i) / 300.0, c + (d - c) * f64::from(j) / 300.0);
                        let (at, _) = chart(u, v);
                        lowest = lowest.min(field.gap(&at));
                        fastest = fastest.max((velocity + rate * at).norm());
                    }
                }
            }
            let surface = surface(shape);
            let (gap, point) = surface.smallest_gap(&field);
            assert_eq!(gap, field.gap(&point));
            let speed = surface.fastest_point(&velocity, &rate);
            // The grid of 300 misses an extreme by half a step squared, 1e-4 of the variation.
            let size = direction.norm();
            assert!(gap <= lowest + 1e-14 * size && gap > lowest - 2e-4 * size, "{shape}: {gap} against {lowest}");
            assert!(speed >= fastest * (1.0 - 1e-12) && speed < fastest * 1.001, "{shape}: {speed} against {fastest}");
        }
    }
}

/// Beyond the promise accuracy fades, but nothing panics, hangs or goes bad where the exact answer is finite.
#[test]
fn extreme_gradients_degrade_gracefully() {
    let diagonal = |x: f64, y: f64, z: f64| Mat3::from_diagonal(&Vec3::new(x, y, z));
    let gradients = [
        diagonal(1e-3, 1.0, 1.0),
        diagonal(1.0, 1e3, 1.0),
        diagonal(1e-4, 1e-4, 1.0),
        Mat3::new(1.0, 50.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0),
        diagonal(1e-8, 1.0, 1e8),
    ];
    for shape in SHAPES {
        for gradient in &gradients {
            for gap in [1e-6, 0.1] {
                let surface = surface(shape);
                let field = field_above(&surface, gradient.tr_mul(&Vec3::new(0.48, 0.6, 0.64)), gap);
                let moments = deformed(&surface, &field, &cofactor(gradient), Kernel::Power(4.0), 3);
                let pairs = oriented(&surface, &field, &cofactor(gradient), Kernel::Power(4.0), 2).pairs;
                let trace = pairs[0].zeroth + pairs[3].zeroth + pairs[5].zeroth;
                assert!(moments.zeroth > 0.0 && moments.zeroth.is_finite(), "{shape} {gradient}: {}", moments.zeroth);
                assert!(moments.first.iter().chain(&moments.second).chain(&moments.third.0).all(|x| x.is_finite()));
                assert!(trace.is_finite() && trace > 0.0, "{shape} {gradient}: {trace}");
            }
        }
        // No area at all, and no numbers at all.
        let field = field_above(&surface(shape), Vec3::z(), 0.1);
        assert_eq!(deformed(&surface(shape), &field, &Mat3::zeros(), Kernel::Power(4.0), 3).zeroth, 0.0);
        let mut out = [Moments::default()];
        let nothing = Mat3::repeat(f64::NAN);
        let found = surface(shape).deformed_moments(&field, &nothing, &plan(Kernel::Power(4.0), 3), &mut out);
        assert!(found.is_err() || !out[0].zeroth.is_finite(), "{shape}: {}", out[0].zeroth);
    }
}

#[test]
fn closed_gaps_are_refused() {
    for shape in SHAPES {
        let field = field_above(&surface(shape), Vec3::new(0.3, -0.4, 1.2), -1e-3);
        let (cofactor, plan) = (Mat3::identity(), plan(Kernel::Power(2.0), 0));
        let moments = surface(shape).deformed_moments(&field, &cofactor, &plan, &mut [Moments::default()]);
        let oriented = surface(shape).oriented_moments(&field, &cofactor, &plan, &mut [OrientedMoments::default()]);
        for refusal in [moments, oriented] {
            // The height of the field is rounded once.
            assert!((refusal.unwrap_err().gap + 1e-3).abs() < 1e-15, "{shape}");
        }
    }
}
