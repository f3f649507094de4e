//! Relations that hold for every pair of bodies.

use super::{Half, assert_balanced, assert_turned_alike, bounded_too, differences, fall, laws, loads, measured, noise};
use super::{numbers, off, off_differences, pair, pairs, rotation, slopes, vector, within};
use gyration::kinematics::Placement;
use gyration::load::Loads;
use gyration::pair::{PairScratch, PairSlopes, Side};
use gyration::tensor::{Mat3, Vec3, cross_matrix};

#[test]
fn forces_are_the_derivative_of_the_potential() {
    let mut worst: f64 = 0.0;
    for (name, one, other) in pairs() {
        for exponent in [2.0, 2.5, 6.0, 12.0] {
            let laws = laws([exponent; 3], false);
            let reach = (exponent == 6.0).then(|| 30.0 * loads(&laws, [&one, &other]).gap);
            let found = within(&laws, reach, [&one, &other]);
            let step = 2e-3 / exponent * found.gap;
            for body in 0..2 {
                let wanted = fall(&laws, reach, [&one, &other], body, step);
                let error = off(&numbers(&found.on[body]), &wanted);
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
    for (k, (name, one, other)) in pairs().enumerate() {
        let exponents = [[6.0, 6.0, 6.0], [2.5, 4.0, 3.0], [12.0, 10.0, 6.5]][k % 3];
        // Each with one of them.
        let laws = bounded_too(&laws(exponents, true)).swap_remove((k / 3) % 3);
        let (laws, one, other) = measured(k, &laws, [one, other]);
        // Far beyond the gaps, a little beyond them, and none.
        let gap = loads(&laws, [&one, &other]).gap;
        let reach = [Some(100.0 * gap), Some(20.0 * gap), None][(k / 2) % 3];
        let slopes = slopes(&laws, reach, [&one, &other]);
        let error = off_differences(&laws, reach, [&one, &other], &slopes);
        worst = worst.max(error);
        assert!(error < 1e-8, "{name}: {error:e}");
        let (step, by_rate) = (1e-4 * slopes.loads.gap, slopes.by_rate.unwrap());
        for [acting, moved] in [[0, 0], [0, 1], [1, 0], [1, 1]] {
            let wanted = differences(&laws, reach, [&one, &other], [acting, moved], (step, true));
            let error = off(by_rate[acting][moved].as_slice(), &wanted);
            worst = worst.max(error);
            assert!(error < 1e-8, "{name}, rates, on {acting} by {moved}: {error:e}");
        }
    }
    println!("worst difference {worst:.1e}");
}

#[test]
fn momenta_and_powers_balance() {
    for (name, one, other) in pairs() {
        for laws in bounded_too(&laws([6.0, 5.0, 4.0], true)) {
            assert_balanced(&name, [&one, &other], &loads(&laws, [&one, &other]));
        }
    }
}

#[test]
fn names_and_axes_do_not_matter() {
    let mut next = noise(0.3);
    let (turn, shift) = (rotation(&mut next), vector(&mut next));
    for (name, one, other) in pairs() {
        for laws in bounded_too(&laws([6.0, 5.0, 4.0], true)) {
            assert_turned_alike(&name, &laws, [&one, &other], (&turn, &shift));
        }
    }
}

/// Along what rigid bodies can do, six motions of each, against the derivatives by all twelve coordinates. Two balls
/// have formulas that know rigid motions alone, and tests of these.
#[test]
fn slopes_of_rigid_bodies_are_those_along_their_motions() {
    let mut worst: f64 = 0.0;
    let are_balls = |one: &Half, other: &Half| [one, other].iter().all(|half| half.surface.ball().is_some());
    for (k, (name, one, other)) in pairs().enumerate().filter(|(_, (_, one, other))| !are_balls(one, other)) {
        let laws = laws([[6.0, 6.0, 6.0], [2.5, 4.0, 3.0]][k % 2], k % 3 > 0);
        let laws = bounded_too(&laws).swap_remove((k / 2) % 3);
        // Without their strain they may need more room.
        let apart = 0.1 * (one.placement.position - other.placement.position);
        let one = one.turned(&Mat3::identity(), &apart);
        let halves = [one, other].map(|half| {
            let turn = nalgebra::Rotation3::from_matrix(&half.placement.gradient).into_inner();
            let placement = Placement { gradient: turn, ..half.placement };
            Half { placement, ..half }
        });
        let reach = 20.0 * loads(&laws, halves.each_ref()).gap;
        let slopes = |inverse: fn(&Mat3) -> Mat3| {
            let sides = halves
                .each_ref()
                .map(|half| Side { inverse: inverse(&half.placement.gradient), ..half.side(&halves[0]) });
            let pair = pair(&laws, Some(reach), halves.each_ref());
            PairSlopes::integrate(&pair, sides.each_ref(), None, &mut PairScratch::default()).unwrap()
        };
        // By the last digit of its inverse a body is one that deforms.
        let (rigid, general) = (slopes(Mat3::transpose), slopes(|turn| turn.transpose() * (1.0 + f64::EPSILON)));
        assert_eq!(rigid.by_rate.is_some(), general.by_rate.is_some());
        for (acting, moved) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let turn = &halves[moved].placement.gradient;
            let size = general.by_place[acting][moved].amax();
            for axis in 0..3 {
                let unit = Vec3::ith(axis, 1.0);
                for (force, moment) in [(unit, Mat3::zeros()), (Vec3::zeros(), turn * cross_matrix(&unit))] {
                    let motion = nalgebra::SVector::<f64, 12>::from_vec(numbers(&Loads { force, moment }));
                    let [own, wanted] = [&rigid, &general].map(|slopes| slopes.by_place[acting][moved] * motion);
                    worst = worst.max((own - wanted).amax() / size);
                    // Some ten roundings of sums of 24 numbers.
                    assert!((own - wanted).amax() < 1e-13 * size, "{name}: on {acting} by {moved}, axis {axis}");
                }
            }
        }
    }
    println!("worst difference {worst:.1e} of the largest");
}
