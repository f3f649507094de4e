//! The measure with a tension: what both feel, their stretching too, is the derivative of the potential.

use super::{Half, assert_balanced, assert_turned_alike, bounded_too, fall, laws, loads, noise, numbers, off};
use super::{off_differences, pairs, rotation, slopes, vector, within};
use gyration::contact::{AreaMeasure, ContactLaw, ContactLoads, ContactScratch, Deformation, LawKind, LawSet, Meeting};
use gyration::contact::{RelativeMotion, Repulsion, contact_potential};
use gyration::kinematics::{Placement, Velocity};
use gyration::pair::PairLaws;
use gyration::surface::{GapField, Surface};
use gyration::tensor::{Mat3, Vec3};

/// The same laws with a tension.
fn taut(laws: &PairLaws) -> PairLaws {
    PairLaws::new(AreaMeasure::DeformedAreaPotential, laws.laws().to_vec()).unwrap()
}

/// Every pair of shapes; of every third one only one body deforms.
fn swelling() -> impl Iterator<Item = (usize, String, [Half; 2])> {
    pairs().enumerate().map(|(k, (name, mut one, mut other))| {
        (one.swells, other.swells) = (k % 3 != 0, k % 3 != 1);
        (k, name, [one, other])
    })
}

#[test]
fn forces_are_the_derivative_of_the_potential() {
    let mut worst: f64 = 0.0;
    for (_, name, halves) in swelling() {
        let halves = halves.each_ref();
        for exponent in [2.0, 2.5, 6.0, 12.0] {
            let laws = taut(&laws([exponent; 3], false));
            let reach = (exponent == 6.0).then(|| 30.0 * loads(&laws, halves).gap);
            let found = within(&laws, reach, halves);
            let step = 2e-3 / exponent * found.gap;
            for body in 0..2 {
                if !halves[body].swells {
                    continue;
                }
                let error = off(&numbers(&found.on[body]), &fall(&laws, reach, halves, body, step));
                worst = worst.max(error);
                // Fourth order: (ν step/gap)⁴ of truncation, and the error of the moments times gap/step.
                assert!(error < 1e-8, "{name}, nu {exponent}, body {body}: {error:e}");
            }
        }
    }
    println!("worst difference {worst:.1e}");
}

#[test]
fn slopes_agree_with_differences() {
    let mut worst: f64 = 0.0;
    for (k, name, halves) in swelling() {
        let halves = halves.each_ref();
        let exponents = [[6.0, 6.0, 6.0], [2.5, 4.0, 3.0], [12.0, 10.0, 6.5]][(k / 3) % 3];
        let laws = taut(&bounded_too(&laws(exponents, true)).swap_remove((k / 9) % 3));
        let gap = loads(&laws, halves).gap;
        let reach = [Some(100.0 * gap), Some(20.0 * gap), None][(k / 2) % 3];
        let slopes = slopes(&laws, reach, halves);
        let error = off_differences(&laws, reach, halves, &slopes);
        worst = worst.max(error);
        assert!(error < 1e-8, "{name}: {error:e}");
    }
    println!("worst difference {worst:.1e}");
}

/// Without laws that take energy the derivatives of both are one symmetric matrix, that of the potential.
#[test]
fn slopes_of_a_potential_are_symmetric() {
    for (k, name, halves) in swelling().filter(|(k, ..)| k % 3 == 2) {
        let laws = taut(&laws([[2.5, 6.0, 12.0][(k / 3) % 3]; 3], false));
        let slopes = slopes(&laws, None, halves.each_ref());
        for (acting, moved) in [(0, 0), (0, 1), (1, 1)] {
            let (own, mirrored) = (slopes.by_place[acting][moved], slopes.by_place[moved][acting].transpose());
            // The plane is in balance to some 1e-14, and B takes exactly what A leaves.
            let error = (own - mirrored).amax() / own.amax();
            assert!(error < 1e-11, "{name}, on {acting} by {moved}: {error:e}");
        }
    }
}

#[test]
fn momenta_and_powers_balance() {
    for (_, name, halves) in swelling() {
        let [one, other] = halves.each_ref();
        for laws in bounded_too(&laws([6.0, 5.0, 4.0], true)) {
            let laws = taut(&laws);
            let found = loads(&laws, [one, other]);
            assert_balanced(&name, [one, other], &found);
            // −dU/dt, of bodies that take their areas along.
            if !(one.swells && other.swells) {
                continue;
            }
            let moved = |by: f64| {
                let later = [one, other].map(|half| {
                    let mut later = half.clone();
                    later.placement.position += by * half.velocity.velocity;
                    later.placement.gradient += by * half.velocity.gradient_rate;
                    later
                });
                loads(&laws, later.each_ref()).energy
            };
            let step = 1e-4 * found.gap;
            let central = |by: f64| (moved(by) - moved(-by)) / (2.0 * by);
            let falling = -(4.0 * central(step) - central(2.0 * step)) / 3.0;
            let repelled = found.powers[LawKind::Repulsion as usize];
            // Rounding of U over the step: 1e-16/1e-4 of U/gap, which is less than the force.
            assert!((falling - repelled).abs() < 1e-8 * found.on[0].force.norm(), "{name}: {falling} and {repelled}");
        }
    }
}

#[test]
fn names_and_axes_do_not_matter() {
    let mut next = noise(0.3);
    let (turn, shift) = (rotation(&mut next), vector(&mut next));
    for (_, name, halves) in swelling() {
        let laws = taut(&laws([6.0, 5.0, 4.0], true));
        assert_turned_alike(&name, &laws, halves.each_ref(), (&turn, &shift));
    }
}

/// Bodies that do not deform have no tension: all measures are one to the last digit, and so is the plane per deformed
/// area, whose force differs by the tension alone.
#[test]
fn tension_is_all_that_the_measure_adds() {
    for (name, mut one, mut other) in pairs() {
        let viscous = laws([6.0, 5.0, 4.0], true);
        let rigid = [AreaMeasure::DeformedArea, AreaMeasure::ReferenceArea, AreaMeasure::DeformedAreaPotential]
            .map(|measure| loads(&PairLaws::new(measure, viscous.laws().to_vec()).unwrap(), [&one, &other]));
        assert!(rigid.iter().all(|found| *found == rigid[0]), "{name}");
        (one.swells, other.swells) = (true, true);
        let slack = PairLaws::new(AreaMeasure::DeformedArea, viscous.laws().to_vec()).unwrap();
        let (slack, taut) = (loads(&slack, [&one, &other]), loads(&taut(&viscous), [&one, &other]));
        assert_eq!((slack.energy, slack.normal, slack.point), (taut.energy, taut.normal, taut.point), "{name}");
        assert_eq!(slack.on[0].force, taut.on[0].force);
        for (half, [slack, taut]) in [&one, &other].into_iter().zip([0, 1].map(|i| [slack.on[i], taut.on[i]])) {
            let tension: Mat3 = (slack.moment - taut.moment) * half.placement.gradient.transpose();
            let (skew, size) = ((tension - tension.transpose()).amax(), tension.amax());
            // B's share of what the two wrenches leave is that of rounding.
            assert!(skew < 1e-11 * slack.force.norm(), "{name}: {skew:e}");
            // It contracts: a sum of I − m⊗m, whose trace is twice ∫U k dA.
            assert!(size > 0.0 && tension.symmetric_eigenvalues().min() > 0.0, "{name}");
        }
    }
}

/// The mirror image in the plane z = 0.
fn mirrored(half: &Half) -> Half {
    let mirror = Mat3::from_diagonal(&Vec3::new(1.0, 1.0, -1.0));
    let Half { placement, velocity, .. } = half;
    Half {
        placement: Placement { position: mirror * placement.position, gradient: mirror * placement.gradient * mirror },
        velocity: Velocity {
            velocity: mirror * velocity.velocity,
            gradient_rate: mirror * velocity.gradient_rate * mirror,
        },
        ..half.clone()
    }
}

/// A body and its mirror image: each feels a plane with half of d₀, and both have its potential.
#[test]
fn mirror_images_feel_a_plane() {
    let mut worst: f64 = 0.0;
    let symmetric = [
        Surface::cuboid(&Vec3::new(0.8, 1.0, 1.3)),
        Surface::ellipsoid(&Vec3::new(0.4, 0.6, 0.8)),
        Surface::cylinder(0.5, 1.1),
    ];
    for (k, surface) in symmetric.iter().enumerate() {
        for exponent in [2.0, 3.5, 6.0] {
            let mut half = Half::new(surface, Vec3::zeros(), rotation(&mut noise(k as f64)), 0.3 + k as f64);
            half.swells = true;
            // Its lowest point is 0.07 above the plane.
            let Placement { position, gradient } = &mut half.placement;
            let level = |height: f64, gradient: &Mat3| GapField::new(height, gradient.tr_mul(&Vec3::z()));
            position.z = 0.07 - surface.smallest_gap(&level(0.0, gradient)).0;
            let field = level(position.z, gradient);
            let laws = laws([exponent; 3], false);
            let pair = loads(&taut(&laws), [&half, &mirrored(&half)]);
            let law = Repulsion { reference_gap: 0.5 * laws.repulsion.reference_gap, ..laws.repulsion };
            let halved = LawSet::new(AreaMeasure::DeformedAreaPotential, vec![ContactLaw::Repulsion(law)]);
            let Velocity { velocity, gradient_rate } = half.velocity;
            let meeting = Meeting {
                surface,
                field,
                motion: RelativeMotion { normal: Vec3::z(), velocity, gradient_rate },
                deformation: Deformation::of(&half.placement.gradient),
            };
            let room = &mut ContactScratch::default();
            let wanted = ContactLoads::integrate(&halved, &meeting, room).unwrap().total();
            let error = off(&numbers(&pair.on[0]), &numbers(&wanted));
            worst = worst.max(error);
            // Moments of curved surfaces are good to 1e-11.
            assert!(error < 1e-11, "{k}, nu {exponent}: {error:e}");
            let energy = 2.0 * contact_potential(&halved, &meeting, room).unwrap();
            assert!((pair.energy / energy - 1.0).abs() < 1e-11, "{k}: {} and {energy}", pair.energy);
        }
    }
    println!("worst difference {worst:.1e}");
}

/// Equal faces a gap g apart hold α d₀ (g/d₀)^(1−ν)/(ν−1) per current area: half of that energy contracts each of both
/// bodies along either edge, M_xx = −U/2λ₁.
#[test]
fn faces_contract_by_half_of_their_energy() {
    let (gap, stretches) = (1e-4, Vec3::new(1.2, 0.9, 0.8));
    let cube = Surface::cuboid(&Vec3::new(1.0, 1.0, 1.0));
    let halves = [0.5, -0.5].map(|side: f64| {
        let position = Vec3::z() * side * (stretches.z + gap);
        let placement = Placement { position, gradient: Mat3::from_diagonal(&stretches) };
        let velocity = Velocity { velocity: Vec3::zeros(), gradient_rate: Mat3::zeros() };
        Half { surface: cube.clone(), placement, velocity, swells: true }
    });
    let laws = taut(&laws([6.0; 3], false));
    let Repulsion { alpha, exponent, reference_gap } = laws.repulsion;
    let area = stretches.x * stretches.y;
    let energy = alpha * reference_gap * (gap / reference_gap).powf(1.0 - exponent) / (exponent - 1.0) * area;
    let found = loads(&laws, halves.each_ref());
    // The sides of the cubes add some 4 gap/side.
    let near = |found: f64, wanted: f64| assert!((found / wanted - 1.0).abs() < 8.0 * gap, "{found} {wanted}");
    near(found.energy, energy);
    for loads in &found.on {
        near(loads.moment.m11, -energy / (2.0 * stretches.x));
        near(loads.moment.m22, -energy / (2.0 * stretches.y));
    }
}
