//! Spheres that feel one another, against what is known of two, and as relations of many.

use super::{ImmersedSpheres, SphereLoads};
use crate::fluid::Flow;
use crate::kinematics::{Placement, Velocity};
use crate::tensor::{Mat3, Vec3, cross_matrix};
use nalgebra::DMatrix;
use std::f64::consts::PI;

/// R̃ + R_0 of spheres at these places, for viscosity 1.
fn resistance(radii: &[f64], places: &[Vec3]) -> DMatrix<f64> {
    let spheres = ImmersedSpheres::of(radii.iter().copied().enumerate()).unwrap();
    let mut loads = SphereLoads::default();
    loads.place(&spheres, |[one, other]| places[other] - places[one]).unwrap();
    let rows = loads.whole_resistance(&spheres);
    DMatrix::from_fn(rows.len(), rows.len(), |i, j| rows[i][j])
}

/// Of two on the axis z.
fn pair(radii: [f64; 2], distance: f64) -> DMatrix<f64> {
    resistance(&radii, &[Vec3::zeros(), Vec3::z() * distance])
}

/// (F₁, T₁, F₂, T₂) of velocities and spins of the two.
fn drag(matrix: &DMatrix<f64>, motion: [Vec3; 4]) -> [Vec3; 4] {
    let given: Vec<f64> = motion.iter().flat_map(|part| part.iter().copied()).collect();
    let found = matrix * nalgebra::DVector::from_vec(given);
    [0, 1, 2, 3].map(|k| found.fixed_rows::<3>(3 * k).into())
}

/// The drag of two equal spheres that follow each other along their line, over that of one alone.
fn stimson_jeffery(alpha: f64) -> f64 {
    let term = |n: f64| {
        let (m, s) = (2.0 * n + 1.0, libm::sinh((n + 0.5) * alpha));
        let sh = libm::sinh(alpha);
        let bracket =
            1.0 - (4.0 * s * s - m * m * sh * sh) / (2.0 * libm::sinh(m * alpha) + m * libm::sinh(2.0 * alpha));
        n * (n + 1.0) / ((2.0 * n - 1.0) * (2.0 * n + 3.0)) * bracket
    };
    let last = (700.0 / alpha).min(4000.0) as usize;
    4.0 / 3.0 * libm::sinh(alpha) * (1..last / 2).map(|n| term(n as f64)).sum::<f64>()
}

/// Stimson and Jeffery, *Proc. R. Soc. Lond.* A 111 (1926) 110, at gaps from a thousandth of the radius to four.
#[test]
fn spheres_that_follow_each_other_have_the_drag_of_stimson_and_jeffery() {
    for (gap, bound) in [(4.0, 1e-12), (1.0, 1e-12), (0.2, 1e-8), (0.05, 2e-6), (0.01, 1e-5), (0.001, 3e-5)] {
        let distance = 2.0 + gap;
        let known = stimson_jeffery(libm::acosh(0.5 * distance));
        let [force, torque, ..] =
            drag(&pair([1.0, 1.0], distance), [Vec3::z(), Vec3::zeros(), Vec3::z(), Vec3::zeros()]);
        let found = force.z / (6.0 * PI);
        println!("gap {gap}: {found:.8} {known:.8} {:.1e}", found / known - 1.0);
        assert!((found / known - 1.0).abs() < bound && torque.norm() < 1e-12);
    }
}

/// What lies between the resistance of tractions of one form and the true one can only add to dissipation; all is
/// reciprocal, and an exchange of the spheres exchanges the blocks.
#[test]
fn exact_resistance_exceeds_that_of_the_far_field() {
    for ratio in [1.0, 0.5, 2.5, 0.1, 8.0] {
        for gap in [1e-4, 1e-2, 0.1, 0.5, 2.0, 10.0] {
            let radii = [1.0, ratio];
            let distance = 1.0 + ratio + gap * (1.0 + ratio) / 2.0;
            let (exact, far) = (pair(radii, distance), far_pair(radii, distance));
            assert!((&exact - exact.transpose()).amax() <= 1e-13 * exact.amax());
            // Scaled by the resistance of each alone.
            let scale = |k: usize| {
                let radius: f64 = radii[k / 6];
                if k % 6 < 3 { (6.0 * PI * radius).sqrt() } else { (8.0 * PI * radius.powi(3)).sqrt() }
            };
            let rest = DMatrix::from_fn(12, 12, |i, j| (exact[(i, j)] - far[(i, j)]) / (scale(i) * scale(j)));
            let least = rest.clone().symmetric_eigenvalues().min();
            println!("ratio {ratio} gap {gap}: {least:.2e} of {:.2e}", rest.amax());
            assert!(least > -2e-4 && (gap < 0.2 || least > -1e-7), "ratio {ratio} gap {gap}: {least:e}");
        }
    }
}

/// M₂⁻¹ in another way: written out as a matrix of numbers.
fn far_pair([a, b]: [f64; 2], r: f64) -> DMatrix<f64> {
    let mut mobility = DMatrix::zeros(12, 12);
    for (sphere, radius) in [a, b].into_iter().enumerate() {
        for k in 0..6 {
            let alone = if k < 3 { 1.0 / (6.0 * PI * radius) } else { 1.0 / (8.0 * PI * radius.powi(3)) };
            mobility[(6 * sphere + k, 6 * sphere + k)] = alone;
        }
    }
    let (d, squares) = (Vec3::z(), (a * a + b * b) / (r * r));
    let linear = (Mat3::identity() * (1.0 + squares / 3.0) + d * d.transpose() * (1.0 - squares)) / (8.0 * PI * r);
    let angular = (3.0 * d * d.transpose() - Mat3::identity()) / (16.0 * PI * r * r * r);
    let turning = cross_matrix(&d) / (8.0 * PI * r * r);
    for (place, part) in [((0, 6), linear), ((0, 9), turning), ((3, 6), turning), ((3, 9), angular)] {
        mobility.view_mut(place, (3, 3)).copy_from(&part);
        mobility.view_mut((place.1, place.0), (3, 3)).copy_from(&part.transpose());
    }
    mobility.try_inverse().unwrap()
}

/// Two spheres that move alike press nothing out of the gap: the resistance to that stays finite in touch, 0.6451 of
/// that of each alone in line (Stimson and Jeffery), 0.9983 − 0.2737 across (Jeffrey and Onishi, table 3).
#[test]
fn spheres_in_touch_move_as_one() {
    let touching = pair([1.0, 1.0], 2.0 + 1e-7);
    let along = drag(&touching, [Vec3::z(), Vec3::zeros(), Vec3::z(), Vec3::zeros()]);
    let across = drag(&touching, [Vec3::x(), Vec3::zeros(), Vec3::x(), Vec3::zeros()]);
    println!("{} {}", along[0].z / (6.0 * PI), across[0].x / (6.0 * PI));
    assert!((along[0].z / (6.0 * PI) - 0.645_141).abs() < 1e-4);
    assert!((across[0].x / (6.0 * PI) - 0.724_6).abs() < 1e-4);
}

/// Any number of spheres dissipates: positive definite at every arrangement, however near.
#[test]
fn resistance_of_many_is_positive_definite() {
    let radii = [1.0, 0.6, 1.4, 1.0, 0.3];
    for gap in [1e-5, 0.03, 0.6] {
        let mut places = vec![Vec3::zeros()];
        for k in 1..radii.len() {
            let turn = Vec3::new((1.3 * k as f64).cos(), (1.3 * k as f64).sin() * 0.8, 0.9).normalize();
            places.push(places[k - 1] + turn * (radii[k - 1] + radii[k] + gap));
        }
        let matrix = resistance(&radii, &places);
        assert!(matrix.clone().cholesky().is_some(), "gap {gap}");
        assert!((&matrix - matrix.transpose()).amax() <= 1e-12 * matrix.amax());
    }
}

/// Three spheres far apart: the mobility of the middle one is that of three Stokeslets.
#[test]
fn far_spheres_carry_one_another_along() {
    let r = 200.0;
    let places = [Vec3::zeros(), Vec3::x() * r, Vec3::x() * 2.0 * r];
    let mobility = resistance(&[1.0; 3], &places).try_inverse().unwrap();
    let weight = nalgebra::DVector::from_fn(18, |k, _| if k % 6 == 2 { 6.0 * PI } else { 0.0 });
    let moved = mobility * weight;
    let known = |sum: f64| 1.0 + 0.75 * sum / r;
    assert!((moved[2] - known(1.5)).abs() < 2e-7 && (moved[8] - known(2.0)).abs() < 2e-7, "{moved}");
}

/// Derivatives by places and velocities, in a flow, against differences.
#[test]
fn derivatives_agree_with_differences() {
    let radii = [1.0, 0.6, 1.4];
    let spheres = ImmersedSpheres::of(radii.into_iter().enumerate()).unwrap();
    let flow = Flow {
        velocity: Vec3::new(0.3, -0.2, 0.1),
        gradient: Mat3::new(0.2, 1.0, 0.0, -0.4, 0.1, 0.3, 0.2, 0.5, -0.3),
    };
    let start = [0.1, 0.2, -0.3, 1.9, 0.4, 0.6, 1.2, 2.6, -0.4];
    let velocities: Vec<Velocity> = (0..3)
        .map(|k| Velocity {
            velocity: Vec3::new(0.4 * k as f64 - 0.3, 0.2, 0.7 - 0.5 * k as f64),
            gradient_rate: cross_matrix(&Vec3::new(0.3, -0.8 + k as f64, 0.5)),
        })
        .collect();
    let at = |numbers: &[f64]| {
        let placements: Vec<Placement> = numbers
            .chunks(3)
            .map(|place| Placement { position: Vec3::from_column_slice(place), gradient: Mat3::identity() })
            .collect();
        let mut loads = SphereLoads::default();
        loads.place(&spheres, |[one, other]| placements[other].position - placements[one].position).unwrap();
        let moving = placements.iter().zip(&velocities).map(|(place, velocity)| (place, velocity, Mat3::identity()));
        loads.set_moving((0.7, &flow), moving, true);
        loads
    };
    let here = at(&start);
    for column in 0..9 {
        let step = 1e-5;
        let [up, down] = [step, -step].map(|step| {
            let mut moved = start;
            moved[column] += step;
            at(&moved)
        });
        for sphere in 0..3 {
            let [by_place, _] = here.coupling(
                [sphere, column / 3],
                &Mat3::identity(),
                (&Mat3::identity(), &velocities[column / 3].gradient_rate),
            );
            let found: Vec3 = by_place.fixed_view::<3, 1>(0, column % 3).into();
            let known = (up.wrench(sphere).0 - down.wrench(sphere).0) / (2.0 * step);
            assert!((found - known).norm() < 1e-7 * (1.0 + known.norm()), "{sphere} {column}: {found} {known}");
            let moments = [0, 1].map(|k| [&up, &down][k].loads(sphere, &Mat3::identity()).moment);
            let known = (moments[0] - moments[1]) / (2.0 * step);
            for k in 0..9 {
                let found = by_place[(3 + k, column % 3)];
                let entry = crate::load::unit(k).dot(&known);
                assert!((found - entry).abs() < 1e-7 * (1.0 + known.norm()), "{sphere} {column} {k}: {found} {entry}");
            }
        }
    }
}

#[test]
fn spheres_that_touch_are_told() {
    let spheres = ImmersedSpheres::of([(3, 1.0), (5, 2.0)]).unwrap();
    let fault = SphereLoads::default().place(&spheres, |_| Vec3::new(2.9, 0.0, 0.0)).unwrap_err();
    assert!(fault.bodies == [3, 5] && (fault.gap + 0.1).abs() < 1e-12);
    assert!(ImmersedSpheres::of([(3, 1.0)]).is_none());
}
