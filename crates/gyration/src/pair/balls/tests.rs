//! Two balls by their formula and by the general method, the slope of their energy, and Derjaguin's limit.

use crate::contact::{Adhesion, AreaMeasure, ContactLaw, Damping, Friction, LawKind, Repulsion};
use crate::kinematics::{Placement, Quaternion, Velocity};
use crate::load::{Loads, numbers};
use crate::pair::{PairForm, PairLaws, PairLoads, PairScratch, PairSlopes, Side};
use crate::surface::Surface;
use crate::tensor::{Mat3, Vec3, axial, cross_matrix};
use std::sync::Arc;

/// A pair of balls by the formula and by the general method, with what holds their sides.
struct Meeting {
    surfaces: [Surface; 2],
    placements: [Placement; 2],
    velocities: [Velocity; 2],
    pairs: [PairForm; 2],
}

impl Meeting {
    fn new(radii: [f64; 2], exponent: f64, gap: f64, reach: Option<f64>) -> Self {
        Self::resisting(radii, exponent, gap, reach, Vec::new())
    }

    /// With laws beside the repulsion.
    fn resisting(radii: [f64; 2], exponent: f64, gap: f64, reach: Option<f64>, mut laws: Vec<ContactLaw>) -> Self {
        let repulsion = Repulsion { alpha: 3.0, exponent, reference_gap: 0.01 };
        laws.push(ContactLaw::Repulsion(repulsion));
        Self::by(laws, radii, gap, reach)
    }

    /// With these laws.
    fn by(laws: Vec<ContactLaw>, radii: [f64; 2], gap: f64, reach: Option<f64>) -> Self {
        let laws = Arc::new(PairLaws::new(AreaMeasure::ReferenceArea, laws).unwrap());
        let surfaces = radii.map(Surface::sphere);
        let closed = PairForm::new(laws, reach, surfaces.each_ref());
        let general = PairForm { balls: None, ..closed.clone() };
        let normal = Vec3::new(1.0, -2.0, 0.5).normalize();
        let gradient = Quaternion::from_axis_angle(&Vec3::new(1.0, 2.0, 3.0), 0.7).rotation();
        let place = |distance: f64| Placement { position: distance * normal, gradient };
        let velocity = |speed: Vec3| Velocity {
            velocity: speed,
            gradient_rate: cross_matrix(&Vec3::new(0.3, 1.0, -2.0)) * gradient,
        };
        Self {
            placements: [place(radii[0] + radii[1] + gap), place(0.0)],
            velocities: [velocity(Vec3::new(0.1, 0.7, 0.2)), velocity(Vec3::new(-1.0, 0.0, 0.4))],
            pairs: [closed, general],
            surfaces,
        }
    }

    fn sides(&self) -> [Side<'_>; 2] {
        [0, 1].map(|i| Side {
            surface: &self.surfaces[i],
            placement: &self.placements[i],
            from_first: self.placements[i].position - self.placements[0].position,
            velocity: &self.velocities[i],
            inverse: self.placements[i].gradient.transpose(),
            deformation: None,
            least_gap: 0.0,
        })
    }

    fn loads(&self) -> [PairLoads; 2] {
        let sides = self.sides();
        [0, 1]
            .map(|i| PairLoads::integrate(&self.pairs[i], sides.each_ref(), None, &mut PairScratch::default()).unwrap())
    }
}

#[test]
fn balls_do_what_the_general_method_says() {
    let (mut energy, mut force, mut rest) = (0.0_f64, 0.0_f64, 0.0_f64);
    for radii in [[1.0, 1.0], [1.0, 0.3], [0.02, 1.5]] {
        for exponent in [2.0, 2.5, 3.0, 6.0, 12.0] {
            for gap in [1e-4, 0.01, 0.3, 5.0] {
                let meeting = Meeting::new(radii, exponent, gap, None);
                let [closed, general] = meeting.loads();
                let push = general.on[0].force.norm();
                energy = energy.max((closed.energy / general.energy - 1.0).abs());
                for ((closed, general), radius) in closed.on.iter().zip(&general.on).zip(radii) {
                    force = force.max((closed.force - general.force).norm() / push);
                    rest = rest.max((closed.moment - general.moment).norm() / (push * radius));
                }
                rest = rest.max((closed.normal - general.normal).norm() + (closed.gap / general.gap - 1.0).abs());
                rest = rest.max((closed.powers[0] - general.powers[0]).abs() / (push * 2.0));
                let sides = meeting.sides();
                let gaps = meeting
                    .pairs
                    .each_ref()
                    .map(|pair| pair.gap(sides.each_ref(), None, &mut PairScratch::default()).unwrap());
                rest = rest.max((gaps[0].share - gaps[1].share).abs() + (gaps[0].rate - gaps[1].rate).abs());
                rest = rest.max((gaps[0].turning - gaps[1].turning).norm());
            }
        }
    }
    println!("balls: energy {energy:.1e}, forces {force:.1e}, planes and the rest {rest:.1e}");
    // A gap of 1e-4 radii is rounded to 2e-12 of it, which the eleventh power makes 2e-11; the general method finds its
    // plane to half of the digits where U is flat.
    assert!(energy < 5e-11 && force < 5e-11 && rest < 1e-8);
}

/// −∂U/∂D by differences of sixth order, with a reach and without.
#[test]
fn force_is_the_slope_of_the_energy() {
    for (exponent, reach) in [(2.0, None), (2.5, Some(0.4)), (6.0, None), (6.0, Some(0.5)), (12.0, None)] {
        let (radii, gap) = ([0.7, 0.2], 0.02);
        let energy = |gap: f64| Meeting::new(radii, exponent, gap, reach).loads()[0].energy;
        let step = 1e-3 * gap;
        let difference = |k: f64| (energy(gap + k * step) - energy(gap - k * step)) / (2.0 * k * step);
        let slope = 1.5 * difference(1.0) - 0.6 * difference(2.0) + 0.1 * difference(3.0);
        let found = Meeting::new(radii, exponent, gap, reach).loads()[0];
        let force = found.on[0].force.dot(&found.normal);
        println!(
            "nu {exponent}, reach {reach:?}: force {force:e}, slope of the energy off by {:.1e}",
            slope / -force - 1.0
        );
        assert!((slope / -force - 1.0).abs() < 1e-11);
    }
}

/// Derjaguin's limit: that of balls of one radius R_A R_B/(R_A + R_B) at the whole gap of one of them from a plane, a
/// sphere beside which is a half-space.
#[test]
fn a_ball_feels_one_that_is_a_million_times_larger_as_a_plane() {
    for (radii, small) in [([1.0, 1e-6], 1), ([1e-6, 1.0], 0)] {
        let gap = 1e-8;
        let meeting = Meeting::new(radii, 6.0, gap, None);
        // By hand: far smaller than the places are large, the gap has no digits in them.
        let balls = meeting.pairs[0].balls.as_ref().unwrap();
        let gaps = balls.balance(gap).unwrap();
        let own = balls.ball(small, gap);
        let plane = balls.scale * balls.value(&own);
        let placed = super::PlacedBalls { balls, normal: Vec3::z(), distance: 1.0, gaps };
        let energy = placed
            .loads(&meeting.pairs[0].laws, meeting.sides().each_ref(), 0.0, &mut Default::default())
            .unwrap()
            .energy;
        let balance = |i: usize| {
            let ball = balls.ball(i, gaps[i]);
            balls.shares[i].sqrt() * libm::pow(balls.value(&ball), -0.1) * balls.fall(&ball)
        };
        println!("{radii:?}: energy over that at a plane {:.9}", energy / plane);
        assert!((energy / plane - 1.0).abs() < 1e-5);
        assert!((balance(0) / balance(1) - 1.0).abs() < 1e-12);
    }
}

/// Along what rigid bodies can do: each moved along three axes, and turned about them.
#[test]
fn slopes_are_those_of_the_general_method() {
    let mut worst: f64 = 0.0;
    for (radii, exponent, reach) in
        [([0.7, 0.2], 6.0, None), ([0.7, 0.2], 2.5, Some(0.3)), ([0.3, 0.3], 12.0, Some(0.4)), ([0.1, 4.0], 3.0, None)]
    {
        let meeting = Meeting::new(radii, exponent, 0.02, reach);
        let sides = meeting.sides();
        let [closed, general] = meeting
            .pairs
            .each_ref()
            .map(|pair| PairSlopes::integrate(pair, sides.each_ref(), None, &mut PairScratch::default()).unwrap());
        assert_eq!(closed.by_rate, None);
        for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let gradient = &meeting.placements[j].gradient;
            let motions = (0..3).flat_map(|k| {
                let unit = Vec3::ith(k, 1.0);
                [(unit, Mat3::zeros()), (Vec3::zeros(), gradient * cross_matrix(&unit))]
            });
            for (position, gradient) in motions {
                let moved = numbers(&Loads { force: position, moment: gradient });
                let [closed, general] = [&closed, &general].map(|slopes| slopes.by_place[i][j] * moved);
                worst = worst.max((closed - general).amax() / meeting_size(&meeting, exponent));
            }
        }
    }
    println!("slopes of balls off by {worst:.1e} of the largest");
    // A slab of 0.02 is a difference of places of order one: 1e-14 of it, times ν.
    assert!(worst < 1e-11);
}

/// Adhesion with a repulsion and without, its plane placed by the one or by what it repels by itself.
#[test]
fn balls_adhere_as_the_general_method_says() {
    let (mut loads, mut slopes) = (0.0_f64, 0.0_f64);
    for (radii, [attractive, repulsive, exponent], gap, reach) in [
        ([0.3, 0.3], [3.0, 9.0, 6.0], 0.02, None),
        ([0.7, 0.2], [2.0, 4.0, 6.0], 0.02, None),
        ([0.7, 0.2], [2.5, 6.5, 2.5], 0.3, Some(0.9)),
        ([0.1, 4.0], [3.0, 9.0, 6.0], 0.01, Some(0.05)),
        ([0.1, 4.0], [4.0, 8.0, 12.0], 0.05, None),
    ] {
        let adhesion =
            Adhesion { beta: 7.0, attractive_exponent: attractive, repulsive_exponent: repulsive, reference_gap: 0.02 };
        let adhesion = ContactLaw::Adhesion(adhesion);
        let repulsion = ContactLaw::Repulsion(Repulsion { alpha: 3.0, exponent, reference_gap: 0.01 });
        for laws in [vec![adhesion], vec![repulsion, adhesion]] {
            let meeting = Meeting::by(laws, radii, gap, reach);
            let sides = meeting.sides();
            let [closed, general] = meeting
                .pairs
                .each_ref()
                .map(|pair| PairSlopes::integrate(pair, sides.each_ref(), None, &mut PairScratch::default()).unwrap());
            let size = repulsive.max(exponent) * closed.loads.stored / gap;
            for (own, other) in closed.loads.on.iter().zip(&general.loads.on) {
                loads = loads.max((numbers(own) - numbers(other)).amax() / size);
            }
            loads = loads.max((closed.loads.energy - general.loads.energy).abs() / closed.loads.stored);
            loads = loads.max((closed.loads.stored / general.loads.stored - 1.0).abs());
            for kind in LawKind::ALL {
                let power = |slopes: &PairSlopes| slopes.loads.powers[kind as usize];
                loads = loads.max((power(&closed) - power(&general)).abs() / size);
            }
            assert_eq!(closed.loads, meeting.loads()[0]);
            for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                let gradient = &meeting.placements[j].gradient;
                let motions = (0..3).flat_map(|k| {
                    let unit = Vec3::ith(k, 1.0);
                    [(unit, Mat3::zeros()), (Vec3::zeros(), gradient * cross_matrix(&unit))]
                });
                for (position, gradient) in motions {
                    let moved = numbers(&Loads { force: position, moment: gradient });
                    let [closed, general] = [&closed, &general].map(|slopes| slopes.by_place[i][j] * moved);
                    slopes = slopes.max((closed - general).amax() * gap / size);
                }
            }
        }
    }
    println!("balls that adhere: loads off by {loads:.1e}, slopes by {slopes:.1e}");
    assert!(loads < 1e-11 && slopes < 1e-10);
}

/// Damping, friction or both, of exponents of their own; friction viscous, and with bounds that it meets and exceeds;
/// damping one-sided.
fn resistances(exponents: [f64; 2]) -> [Vec<ContactLaw>; 6] {
    let [one, other] = exponents;
    let damping = |release| ContactLaw::Damping(Damping { beta: 5e4, exponent: one, reference_gap: 0.01, release });
    let (one_sided, damping) = (damping(Some(0.5)), damping(None));
    let friction = |mu| ContactLaw::Friction(Friction { beta: 4e5, exponent: other, reference_gap: 0.02, mu });
    let [near, far] = [Some(1e6), Some(0.3)].map(friction);
    let friction = friction(None);
    let both = vec![one_sided, friction];
    [vec![damping], vec![friction], vec![damping, friction], vec![near], vec![damping, far], both]
}

/// Force and torque, since a rigid body feels no more of a moment.
fn felt(loads: &Loads, gradient: &Mat3) -> [Vec3; 2] {
    [loads.force, axial(&(loads.moment * gradient.transpose()))]
}

/// Along what rigid bodies can do, a turn by θ changing Ṗ as it changes P; and by their velocities and spins.
#[test]
fn balls_resist_as_the_general_method_says() {
    let (mut loads, mut slopes) = (0.0_f64, 0.0_f64);
    let radii = [[0.3, 0.3], [0.7, 0.2], [0.1, 4.0]];
    let exponents = [(6.0, [6.0, 6.0]), (2.5, [1.5, 3.0]), (12.0, [4.0, 7.3])];
    for (radii, (exponent, viscous)) in radii.into_iter().flat_map(|radii| exponents.map(|exponent| (radii, exponent)))
    {
        for (gap, reach) in [(1e-3, None), (0.02, Some(0.3)), (1.0, None)] {
            for laws in resistances(viscous) {
                let meeting = Meeting::resisting(radii, exponent, gap, reach, laws);
                let sides = meeting.sides();
                let found = meeting.pairs.each_ref().map(|pair| {
                    PairSlopes::integrate(pair, sides.each_ref(), None, &mut PairScratch::default()).unwrap()
                });
                let [closed, general] = &found;
                assert_eq!(closed.loads, meeting.loads()[0]);
                for (i, radius) in radii.into_iter().enumerate() {
                    let gradient = &meeting.placements[i].gradient;
                    let [[push, twist], [other_push, other_twist]] =
                        [closed, general].map(|slopes| felt(&slopes.loads.on[i], gradient));
                    let size = other_push.norm() * (1.0 + radius) + other_twist.norm();
                    loads = loads.max(((push - other_push).norm() + (twist - other_twist).norm()) / size);
                    let power = |slopes: &PairSlopes| -> f64 { slopes.loads.powers.iter().sum() };
                    loads = loads.max((power(closed) - power(general)).abs() / power(general).abs());
                }
                slopes = slopes.max(differ(&meeting, &found, meeting_size(&meeting, exponent)));
            }
        }
    }
    println!("balls that resist: loads off by {loads:.1e}, slopes by {slopes:.1e} of the largest");
    // Gaps of 1e-3 are rounded to 1e-12 of them, times ν; M_⊥ of the general method is a difference.
    assert!(loads < 1e-10 && slopes < 1e-9);
}

/// The largest difference of the derivatives of force and torque, as a part of them and of those of the repulsion.
fn differ(meeting: &Meeting, found: &[PairSlopes; 2], repelled: f64) -> f64 {
    let mut worst: f64 = 0.0;
    for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
        let (own, turned) = (&meeting.placements[i].gradient, &meeting.placements[j].gradient);
        let rate = &meeting.velocities[j].gradient_rate;
        let still = Loads { force: Vec3::zeros(), moment: Mat3::zeros() };
        let motions = (0..3).flat_map(|k| {
            let unit = Vec3::ith(k, 1.0);
            let turn = |a: &Mat3| Loads { force: Vec3::zeros(), moment: cross_matrix(&unit) * a };
            let moved = Loads { force: unit, moment: Mat3::zeros() };
            [(moved, still), (turn(turned), turn(rate)), (still, moved), (still, turn(turned))]
        });
        for (place, rates) in motions {
            let turn = if i == j { place.moment } else { Mat3::zeros() };
            let changes = found.each_ref().map(|slopes| {
                let by_rate = slopes.by_rate.as_ref().unwrap();
                let change = slopes.by_place[i][j] * numbers(&place) + by_rate[i][j] * numbers(&rates);
                let Loads { force, moment } = crate::load::loads(&change);
                let about = moment * own.transpose() + slopes.loads.on[i].moment * turn.transpose();
                [force, axial(&about)]
            });
            let [[push, twist], [other_push, other_twist]] = changes;
            let size = other_push.norm() + other_twist.norm();
            let off = (push - other_push).norm() + (twist - other_twist).norm();
            worst = worst.max(off / (size + repelled));
        }
    }
    worst
}

/// Of balls whose energy is too small for a number.
#[test]
fn slopes_of_next_to_nothing_are_zeros() {
    let meeting = Meeting::new([1.0, 1.0], 40.0, 1e8, None);
    let (pair, sides) = (&meeting.pairs[0], meeting.sides());
    let found = PairSlopes::integrate(pair, sides.each_ref(), None, &mut PairScratch::default()).unwrap();
    assert_eq!(found.loads.energy, 0.0);
    assert!(found.by_place.iter().flatten().all(|slopes| slopes.amax() == 0.0));
}

/// The size of slopes [N/m].
fn meeting_size(meeting: &Meeting, exponent: f64) -> f64 {
    let found = &meeting.loads()[0];
    exponent * found.on[0].force.norm() / found.gap
}
