//! Closed forms of balls, faces and translation, and the reach of a pair.

use super::{Half, laws, loads, noise, pair, pairs, rotation, vector, within};
use gyration::contact::{AreaMeasure, ContactLaw, Damping, Repulsion};
use gyration::kinematics::{Placement, Velocity};
use gyration::load::Loads;
use gyration::pair::{PairLaws, PairLoads, PairScratch};
use gyration::surface::Surface;
use gyration::tensor::{Mat3, Vec3};
use std::f64::consts::PI;

/// A body that stands still, with P = 1.
fn still(surface: Surface, height: f64) -> Half {
    let placement = Placement { position: Vec3::z() * height, gradient: Mat3::identity() };
    let velocity = Velocity { velocity: Vec3::zeros(), gradient_rate: Mat3::zeros() };
    Half { surface, placement, velocity, swells: false }
}

#[test]
fn balls_and_faces_have_their_closed_forms() {
    let law = laws([6.0; 3], false);
    let Repulsion { alpha, exponent: nu, reference_gap: d0 } = law.repulsion;
    // Equal balls at any distance.
    for gap in [1e-4_f64, 0.01, 0.3, 5.0] {
        let radius = 0.7;
        let [one, other] = [2.0 * radius + gap, 0.0].map(|height| still(Surface::sphere(radius), height));
        let found = loads(&law, [&one, &other]).on[0].force.z;
        let wanted =
            PI * radius * alpha * d0.powf(nu) * (gap.powf(1.0 - nu) - (gap + 4.0 * radius).powf(1.0 - nu)) / (nu - 1.0);
        assert!((found / wanted - 1.0).abs() < 1e-9, "{gap}: {found} and {wanted}");
    }
    // A cube on a larger slab: the face of each counts, and the whole surfaces in the shares.
    let gap = 1e-5;
    let cube = still(Surface::cuboid(&Vec3::repeat(1.0)), 0.5 + gap);
    let slab = still(Surface::cuboid(&Vec3::new(10.0, 10.0, 1.0)), -0.5);
    let lengths = [6.0_f64.sqrt(), 240.0_f64.sqrt()];
    let share = lengths[1] / (lengths[0] + lengths[1]);
    let mean = share + (1.0 - share) * 0.01_f64.powf(1.0 / (nu - 1.0));
    let wanted = alpha * (gap / d0).powf(-nu) * mean.powf(1.0 - nu);
    let found = loads(&law, [&cube, &slab]).on[0].force.z;
    println!("a cube on a slab: {:.5} of the force of a plane", found / (alpha * (gap / d0).powf(-nu)));
    // The sides of both are felt by gap/side.
    assert!((found / wanted - 1.0).abs() < 1e-3, "{found} and {wanted}");
}

#[test]
fn translation_is_resisted_as_the_normal_force_says_whatever_the_shapes() {
    let law = laws([6.0; 3], true);
    let mut next = noise(7.0);
    for (name, mut one, mut other) in pairs() {
        for half in [&mut one, &mut other] {
            half.velocity = Velocity { velocity: vector(&mut next), gradient_rate: Mat3::zeros() };
        }
        let elastic = loads(&laws([6.0; 3], false), [&one, &other]);
        let (n, push) = (elastic.normal, elastic.on[0].force.norm());
        let speed = (one.velocity.velocity - other.velocity.velocity).dot(&n);
        let found = (loads(&law, [&one, &other]).on[0].force - elastic.on[0].force).dot(&n);
        let (beta, d0) = (0.7, 0.2_f64);
        let wanted = -beta * d0.powi(6) / (1.3 * 0.1_f64.powi(6)) * push * speed;
        assert!((found / wanted - 1.0).abs() < 1e-10, "{name}: {found} and {wanted}");
    }
}

#[test]
fn a_pair_is_nothing_beyond_its_reach_and_less_than_whole_within() {
    let mut tightest: f64 = 0.0;
    for (name, mut one, mut other) in pairs() {
        // Rigid bodies: the bound is of their own surfaces.
        let mut next = noise(4.0);
        for half in [&mut one, &mut other] {
            half.placement.gradient = rotation(&mut next);
        }
        let way = (one.placement.position - other.placement.position).normalize();
        one.placement.position += way;
        for exponent in [2.0, 2.5, 6.0, 12.0] {
            let laws = laws([exponent; 3], true);
            let whole = loads(&laws, [&one, &other]);
            // The slab is no wider than the distance.
            let beyond = within(&laws, Some(0.999 * whole.gap), [&one, &other]);
            assert_eq!((beyond.energy, beyond.on[0].force.norm()), (0.0, 0.0), "{name}, nu {exponent}");
            let reach = 30.0 * whole.gap;
            let inside = within(&laws, Some(reach), [&one, &other]);
            let part = inside.energy / whole.energy;
            tightest = tightest.max(part);
            assert!(part > 0.0 && part < 1.0, "{name}, nu {exponent}: {part}");
        }
    }
    println!("at a thirtieth of the reach up to {tightest:.9} of the energy");
}

#[test]
fn balls_out_of_reach_have_the_gap_of_their_plane() {
    let law = laws([6.0; 3], true);
    let [one, other] = [(0.3, 2.1), (0.8, 0.0)].map(|(radius, height)| {
        let mut half = still(Surface::sphere(radius), height);
        half.placement.position.x += 0.7 * height;
        half
    });
    let pair = pair(&law, Some(0.5), [&one, &other]);
    let told = pair.gap_of_balls((one.placement.position - other.placement.position).norm()).unwrap();
    let found = within(&law, Some(0.5), [&one, &other]);
    assert_eq!((found.energy, found.on[0]), (0.0, Loads::default()));
    assert!((told - found.gap).abs() < 1e-14, "{told} {found:?}");
}

/// Bodies face to face, anywhere and turned anyhow, at gaps that few digits tell from zero.
#[test]
fn planes_are_found_between_faces_that_nearly_touch() {
    let law = laws([6.0; 3], false);
    let cube = || Surface::cuboid(&Vec3::repeat(1.0));
    let kinds = [
        (cube(), cube(), 1.0),
        (Surface::cuboid(&Vec3::new(10.0, 10.0, 1.0)), cube(), 1.0),
        (Surface::cylinder(0.5, 1.0), cube(), 1.0),
        (Surface::cylinder(0.5, 1.0), Surface::cylinder(0.3, 1.0), 1.0),
    ];
    let mut next = noise(0.7);
    for (kind, (above, below, height)) in kinds.into_iter().enumerate() {
        for gap in [1e-4, 1e-5, 1e-6, 1e-7] {
            for _ in 0..10 {
                let (turn, twist) = (rotation(&mut next), 3.0 * next());
                let twist = nalgebra::Rotation3::from_axis_angle(&Vec3::z_axis(), twist).into_inner();
                let place = turn * Vec3::new(0.4 * next(), 0.4 * next(), height + gap);
                let mut halves = [still(above.clone(), 0.0), still(below.clone(), 0.0)];
                halves[0].placement = Placement { position: place, gradient: turn * twist };
                halves[1].placement.gradient = turn;
                let pair = pair(&law, None, halves.each_ref());
                let sides = halves.each_ref().map(|half| half.side(&halves[0]));
                let found = PairLoads::integrate(&pair, sides.each_ref(), None, &mut PairScratch::default());
                let told = found.unwrap_or_else(|closed| panic!("kind {kind} at {gap:e}: {closed}")).gap;
                assert!(told > 0.0 && told < gap + 1e-14, "kind {kind}: {told:e} of {gap:e}");
            }
        }
    }
}

#[test]
fn viscous_laws_without_strength_do_nothing() {
    let repulsion = ContactLaw::Repulsion(Repulsion { alpha: 1.0, exponent: 6.0, reference_gap: 0.1 });
    let none = ContactLaw::Damping(Damping { beta: 0.0, exponent: 6.0, reference_gap: 0.1, release: None });
    let law = |laws| PairLaws::new(AreaMeasure::DeformedArea, laws).unwrap();
    let halves = [still(Surface::sphere(0.5), 1.1), still(Surface::sphere(0.5), 0.0)];
    let [with, without] = [law(vec![repulsion, none]), law(vec![repulsion])];
    assert_eq!(loads(&with, halves.each_ref()), loads(&without, halves.each_ref()));
}
