//! Adhesion between bodies: its forces are the derivative of its energy though something else places the plane.

use super::{Half, fall, measured, noise, numbers, off_differences, pairs, rotation, slopes, vector, within};
use gyration::contact::{Adhesion, AreaMeasure, ContactLaw, Damping, Friction, LawKind, Repulsion};
use gyration::load::Loads;
use gyration::pair::{PairLaws, PairLawsError};
use gyration::surface::Surface;

fn adhesion(attractive: f64, repulsive: f64) -> ContactLaw {
    ContactLaw::Adhesion(Adhesion {
        beta: 2.3,
        attractive_exponent: attractive,
        repulsive_exponent: repulsive,
        reference_gap: 0.12,
    })
}

fn repulsion(exponent: f64) -> ContactLaw {
    ContactLaw::Repulsion(Repulsion { alpha: 1.3, exponent, reference_gap: 0.1 })
}

fn viscous() -> [ContactLaw; 2] {
    [
        ContactLaw::Damping(Damping { beta: 0.7, exponent: 5.0, reference_gap: 0.2, release: None }),
        ContactLaw::Friction(Friction { beta: 0.9, exponent: 4.0, reference_gap: 0.15, mu: None }),
    ]
}

/// Placed by a repulsion, softer or harder, and by what adhesion itself repels by.
fn kinds() -> [PairLaws; 4] {
    let kinds = [
        vec![repulsion(6.0), adhesion(3.0, 9.0)],
        vec![repulsion(2.5), adhesion(4.0, 7.5)],
        vec![adhesion(2.0, 6.0)],
        vec![repulsion(12.0), adhesion(2.5, 4.0)],
    ];
    kinds.map(|laws| PairLaws::new(AreaMeasure::ReferenceArea, laws).unwrap())
}

#[test]
fn forces_are_the_derivative_of_the_energy() {
    let mut worst: f64 = 0.0;
    for (k, (name, one, other)) in pairs().enumerate() {
        for (kind, laws) in kinds().iter().enumerate() {
            let gap = within(laws, None, [&one, &other]).gap;
            let reach = ((k + kind) % 3 == 0).then_some([8.0, 30.0][kind % 2] * gap);
            let found = within(laws, reach, [&one, &other]);
            let step = 2e-4 * found.gap;
            for body in 0..2 {
                let wanted = fall(laws, reach, [&one, &other], body, step);
                // What pushes and what pulls may cancel.
                let size = found.stored / found.gap;
                let apart =
                    numbers(&found.on[body]).iter().zip(&wanted).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
                worst = worst.max(apart / size);
                assert!(apart < 1e-8 * size, "{name}, kind {kind}, reach {reach:?}, body {body}: {:e}", apart / size);
            }
        }
    }
    println!("worst difference {worst:.1e}");
}

#[test]
fn slopes_agree_with_differences() {
    let mut worst: f64 = 0.0;
    for (k, (name, one, other)) in pairs().enumerate() {
        let kinds = kinds();
        let (laws, one, other) = measured(k / 2, &kinds[k % kinds.len()], [one, other]);
        let laws = &laws;
        let gap = within(laws, None, [&one, &other]).gap;
        let reach = [None, Some(20.0 * gap)][(k / 2) % 2];
        let slopes = slopes(laws, reach, [&one, &other]);
        let error = off_differences(laws, reach, [&one, &other], &slopes);
        worst = worst.max(error);
        assert!(error < 1e-7, "{name}: {error:e}");
    }
    println!("worst difference {worst:.1e}");
}

#[test]
fn momenta_and_powers_balance() {
    for (k, (name, one, other)) in pairs().enumerate() {
        let mut laws = vec![adhesion(3.0, 9.0)];
        laws.extend(viscous());
        laws.extend((k % 2 == 0).then(|| repulsion(6.0)));
        let laws = PairLaws::new(AreaMeasure::ReferenceArea, laws).unwrap();
        let found = within(&laws, Some(1.0), [&one, &other]);
        let [above, below] = &found.on;
        assert_eq!(above.force, -below.force, "{name}");
        let torques = [one.torque(above), other.torque(below)];
        let size = found.stored / found.gap;
        // The places are some 4 m from the origin.
        assert!((torques[0] + torques[1]).norm() < 1e-13 * 4.0 * size, "{name}");
        let power: f64 = [(&one, above), (&other, below)]
            .map(|(half, loads)| loads.power(&half.velocity.velocity, &half.velocity.gradient_rate))
            .iter()
            .sum();
        let booked: f64 = found.powers.iter().sum();
        assert!((power - booked).abs() < 1e-10 * size, "{name}: {power} and {booked}");
        // −dW/dt, and −dU/dt where a repulsion places the plane.
        let central = found.powers[LawKind::Adhesion as usize] + found.powers[LawKind::Repulsion as usize];
        let moved = |by: f64| {
            let later = [&one, &other].map(|half| {
                let mut later = half.clone();
                later.placement.position += by * half.velocity.velocity;
                later.placement.gradient += by * half.velocity.gradient_rate;
                later
            });
            within(&laws, Some(1.0), later.each_ref()).energy
        };
        let step = 1e-4 * found.gap;
        let central_difference = |by: f64| (moved(by) - moved(-by)) / (2.0 * by);
        let falling = -(4.0 * central_difference(step) - central_difference(2.0 * step)) / 3.0;
        assert!((falling - central).abs() < 1e-7 * size, "{name}: {falling} and {central}");
    }
}

#[test]
fn names_and_axes_do_not_matter() {
    let mut next = noise(0.7);
    let (turn, shift) = (rotation(&mut next), vector(&mut next));
    for (k, (name, one, other)) in pairs().enumerate() {
        let laws = &kinds()[k % 4];
        let found = within(laws, None, [&one, &other]);
        let swapped = within(laws, None, [&other, &one]);
        let turned = within(laws, None, [&one.turned(&turn, &shift), &other.turned(&turn, &shift)]);
        let size = found.stored / found.gap;
        for body in 0..2 {
            let Loads { force, moment } = found.on[body];
            let wanted = Loads { force: turn * force, moment: turn * moment };
            for (own, wanted) in [(&swapped.on[1 - body], &found.on[body]), (&turned.on[body], &wanted)] {
                let apart = numbers(own).iter().zip(numbers(wanted)).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
                assert!(apart < 1e-11 * size, "{name}: {:e}", apart / size);
            }
        }
    }
}

/// Beyond the reach nothing is left of the attraction either, and within it begins smoothly.
#[test]
fn attraction_ends_with_the_reach() {
    let laws = &kinds()[0];
    for surface in [Surface::sphere(0.4), Surface::cuboid(&nalgebra::Vector3::new(0.7, 0.8, 0.9))] {
        let at = |distance: f64| {
            let mut halves =
                [0, 1].map(|_| Half::new(&surface, vector(&mut noise(0.1)), rotation(&mut noise(3.0)), 0.2));
            halves[0].placement.gradient = rotation(&mut noise(3.0));
            halves[1].placement.gradient = halves[0].placement.gradient;
            let axis: nalgebra::Vector3<f64> = halves[1].placement.gradient.column(2).into();
            halves[0].placement.position = halves[1].placement.position + distance * axis;
            within(laws, Some(0.5), halves.each_ref())
        };
        let size = at(1.0).stored;
        assert!(size > 0.0);
        let nothing = at(1.6);
        assert_eq!((nothing.energy, nothing.stored), (0.0, 0.0));
        assert_eq!(nothing.on, [Loads::default(); 2]);
        assert_eq!(nothing.powers, [0.0; LawKind::COUNT]);
    }
}

/// Equal faces at a gap have the tractions of one at it, whatever places the plane.
#[test]
fn equal_faces_attract_as_a_face_and_a_plane() {
    let cube = Surface::cuboid(&nalgebra::Vector3::new(1.0, 1.0, 1.0));
    let gap = 1e-4;
    for with_repulsion in [false, true] {
        let mut laws = vec![adhesion(3.0, 9.0)];
        laws.extend(with_repulsion.then(|| repulsion(6.0)));
        let factors: f64 = laws.iter().map(|law| law.factor(gap)).sum();
        let laws = PairLaws::new(AreaMeasure::ReferenceArea, laws).unwrap();
        let mut halves = [0, 1].map(|_| Half::new(&cube, vector(&mut noise(0.1)), rotation(&mut noise(3.0)), 0.2));
        for half in &mut halves {
            half.placement.gradient = nalgebra::Matrix3::identity();
        }
        halves[0].placement.position = halves[1].placement.position + (1.0 + gap) * nalgebra::Vector3::z();
        let found = within(&laws, None, halves.each_ref());
        let error = found.on[0].force.z / factors - 1.0;
        println!("faces, repulsion {with_repulsion}: {error:.1e}");
        // The sides of the cubes add some 4 gap/side.
        assert!(error.abs() < 8.0 * gap);
    }
}

#[test]
fn what_cannot_act_between_bodies_is_refused() {
    let refused = |laws: Vec<ContactLaw>| PairLaws::new(AreaMeasure::ReferenceArea, laws).unwrap_err();
    assert_eq!(refused(vec![viscous()[0]]), PairLawsError::NoRepulsion);
    let silent = Adhesion { beta: 0.0, attractive_exponent: 3.0, repulsive_exponent: 6.0, reference_gap: 1.0 };
    assert_eq!(refused(vec![ContactLaw::Adhesion(silent)]), PairLawsError::NoRepulsion);
    let weak = PairLawsError::TooWeak { kind: LawKind::Adhesion, exponent: 1.5 };
    assert_eq!(refused(vec![repulsion(6.0), adhesion(1.5, 6.0)]), weak);
}
