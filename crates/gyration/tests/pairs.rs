//! Two bodies and the plane between them: forces are the derivative of the potential, derivatives agree with
//! differences, momenta and powers balance, and nothing depends on who is called A or where all of it stands.

use gyration::contact::{AreaMeasure, ContactLaw, Damping, Friction, LawKind, Repulsion};
use gyration::kinematics::{Placement, Velocity};
use gyration::load::Loads;
use gyration::pair::{Pair, PairLaws, PairLoads, PairScratch, PairSlopes, Side};
use gyration::surface::Surface;
use gyration::tensor::{Mat3, Vec3, axial};
use std::f64::consts::PI;
use std::sync::Arc;

/// A body of a pair.
#[derive(Debug, Clone)]
struct Half {
    surface: Surface,
    placement: Placement,
    velocity: Velocity,
}

/// Numbers in [−1, 1] that no symmetry makes simple.
fn noise(seed: f64) -> impl FnMut() -> f64 {
    let mut k = seed;
    move || {
        k += 1.0;
        (12.9898 * k).sin() * (78.233 * k).cos()
    }
}

fn vector(next: &mut impl FnMut() -> f64) -> Vec3 {
    Vec3::new(next(), next(), next())
}

impl Half {
    fn new(surface: &Surface, position: Vec3, rotation: Mat3, seed: f64) -> Self {
        let mut next = noise(seed);
        let strain = 0.1 * Mat3::from_fn(|_, _| next());
        let velocity = Velocity { velocity: vector(&mut next), gradient_rate: Mat3::from_fn(|_, _| next()) };
        let gradient = rotation * (Mat3::identity() + strain);
        Self { surface: surface.clone(), placement: Placement { position, gradient }, velocity }
    }

    fn side(&self) -> Side<'_> {
        Side {
            surface: &self.surface,
            placement: &self.placement,
            velocity: &self.velocity,
            inverse: self.placement.gradient.try_inverse().unwrap(),
            deformation: None,
            least_gap: 0.0,
        }
    }

    /// One of its twelve coordinates, or of their rates, changed.
    fn shifted(&self, place: usize, by: f64, rates: bool) -> Self {
        let mut moved = self.clone();
        let (vector, matrix) = match rates {
            false => (&mut moved.placement.position, &mut moved.placement.gradient),
            true => (&mut moved.velocity.velocity, &mut moved.velocity.gradient_rate),
        };
        if place < 3 {
            vector[place] += by
        } else {
            matrix[place - 3] += by
        }
        moved
    }

    fn turned(&self, rotation: &Mat3, shift: &Vec3) -> Self {
        let Placement { position, gradient } = &self.placement;
        let Velocity { velocity, gradient_rate } = &self.velocity;
        Self {
            surface: self.surface.clone(),
            placement: Placement { position: rotation * position + shift, gradient: rotation * gradient },
            velocity: Velocity { velocity: rotation * velocity, gradient_rate: rotation * gradient_rate },
        }
    }

    /// p₀ × f + ∫x × q.
    fn torque(&self, loads: &Loads) -> Vec3 {
        let own: Mat3 = loads.moment * self.placement.gradient.transpose();
        self.placement.position.cross(&loads.force) + axial(&own)
    }
}

fn rotation(next: &mut impl FnMut() -> f64) -> Mat3 {
    nalgebra::Rotation3::new(3.0 * vector(next)).into_inner()
}

fn shapes() -> Vec<(&'static str, Surface)> {
    let tetrahedron =
        [Vec3::new(-0.4, -0.4, -0.3), Vec3::new(0.5, -0.3, -0.3), Vec3::new(0.0, 0.6, -0.3), Vec3::z() * 0.6];
    let triangles = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    vec![
        ("box", Surface::cuboid(&Vec3::new(0.8, 1.0, 1.3))),
        ("sphere", Surface::sphere(0.6)),
        ("ellipsoid", Surface::ellipsoid(&Vec3::new(0.4, 0.6, 0.8))),
        ("cylinder", Surface::cylinder(0.5, 1.1)),
        ("cone", Surface::cone(0.5, 1.0)),
        ("capsule", Surface::capsule(0.3, 0.8)),
        ("tetrahedron", Surface::from_triangles(&tetrahedron, &triangles).unwrap()),
    ]
}

fn laws(exponents: [f64; 3], viscous: bool) -> PairLaws {
    let [repulsion, damping, friction] = exponents;
    let mut laws = vec![ContactLaw::Repulsion(Repulsion { alpha: 1.3, exponent: repulsion, reference_gap: 0.1 })];
    if viscous {
        laws.push(ContactLaw::Damping(Damping { beta: 0.7, exponent: damping, reference_gap: 0.2 }));
        laws.push(ContactLaw::Friction(Friction { beta: 0.9, exponent: friction, reference_gap: 0.15 }));
    }
    PairLaws::new(AreaMeasure::ReferenceArea, laws).unwrap()
}

fn pair(laws: &PairLaws, reach: Option<f64>, halves: [&Half; 2]) -> Pair {
    Pair::new([0, 1], [0, 0], Arc::new(laws.clone()), reach, halves.map(|half| &half.surface))
}

fn loads(laws: &PairLaws, halves: [&Half; 2]) -> PairLoads {
    within(laws, None, halves)
}

fn within(laws: &PairLaws, reach: Option<f64>, [one, other]: [&Half; 2]) -> PairLoads {
    let pair = pair(laws, reach, [one, other]);
    PairLoads::integrate(&pair, [&one.side(), &other.side()], None, &mut PairScratch::default()).unwrap()
}

/// Every pair of shapes, some apart, some close.
fn pairs() -> impl Iterator<Item = (String, Half, Half)> {
    let shapes = shapes();
    let count = shapes.len();
    (0..count * count).filter(move |k| k / count <= k % count).map(move |k| {
        let ((one, above), (other, below)) = (&shapes[k / count], &shapes[k % count]);
        let mut next = noise(10.0 * k as f64);
        let way = vector(&mut next).normalize();
        let (a, b) = (rotation(&mut next), rotation(&mut next));
        let place = |distance: f64| {
            let shift = Vec3::new(3.0, -2.0, 1.0);
            (Half::new(above, shift + distance * way, a, k as f64), Half::new(below, shift, b, 0.5 + k as f64))
        };
        // The distance at which they are some 0.03 or 0.3 apart, by halving.
        let apart = |distance: f64| {
            let (one, other) = place(distance);
            let pair = pair(&laws([6.0; 3], false), None, [&one, &other]);
            let sides = [one.side(), other.side()];
            let found = PairLoads::integrate(&pair, sides.each_ref(), None, &mut PairScratch::default());
            found.is_ok_and(|loads| loads.gap > if k % 2 == 0 { 0.03 } else { 0.3 })
        };
        let (mut near, mut far) = (0.0, 4.0);
        for _ in 0..20 {
            let middle = 0.5 * (near + far);
            if apart(middle) { far = middle } else { near = middle }
        }
        let (above, below) = place(far);
        (format!("{one} and {other}"), above, below)
    })
}

fn numbers(loads: &Loads) -> Vec<f64> {
    loads.force.iter().chain(loads.moment.iter()).copied().collect()
}

/// The largest difference of numbers, relative to the largest of them.
fn off(found: &[f64], wanted: &[f64]) -> f64 {
    let size = wanted.iter().fold(0.0_f64, |most, number| most.max(number.abs()));
    let differences = found.iter().zip(wanted).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, f64::max) / size
}

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
                let energy = |place: usize, by: f64| {
                    let mut halves = [one.clone(), other.clone()];
                    halves[body] = halves[body].shifted(place, by, false);
                    within(&laws, reach, halves.each_ref()).energy
                };
                let slope = |place: usize| {
                    let central = |by: f64| (energy(place, by) - energy(place, -by)) / (2.0 * by);
                    -(4.0 * central(step) - central(2.0 * step)) / 3.0
                };
                let wanted: Vec<f64> = (0..12).map(slope).collect();
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
        let laws = laws(exponents, true);
        // Far beyond the gaps, a little beyond them, and none.
        let gap = loads(&laws, [&one, &other]).gap;
        let reach = [Some(100.0 * gap), Some(20.0 * gap), None][(k / 2) % 3];
        let sides = [one.side(), other.side()];
        let slopes = PairSlopes::integrate(
            &pair(&laws, reach, [&one, &other]),
            sides.each_ref(),
            None,
            &mut PairScratch::default(),
        )
        .unwrap();
        let at = within(&laws, reach, [&one, &other]);
        for body in 0..2 {
            assert!(off(&numbers(&slopes.on[body]), &numbers(&at.on[body])) < 1e-12);
        }
        let step = 1e-4 * at.gap;
        for (rates, found) in [(false, &slopes.by_place), (true, &slopes.by_rate)] {
            for (acting, moved) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                let shifted = |place: usize, by: f64| {
                    let mut halves = [one.clone(), other.clone()];
                    halves[moved] = halves[moved].shifted(place, by, rates);
                    numbers(&within(&laws, reach, halves.each_ref()).on[acting])
                };
                let column = |place: usize| {
                    let central = |by: f64| {
                        let (up, down) = (shifted(place, by), shifted(place, -by));
                        up.into_iter().zip(down).map(move |(up, down)| (up - down) / (2.0 * by))
                    };
                    central(step).zip(central(2.0 * step)).map(|(near, far)| (4.0 * near - far) / 3.0)
                };
                let wanted: Vec<f64> = (0..12).flat_map(column).collect();
                let error = off(found[acting][moved].as_slice(), &wanted);
                worst = worst.max(error);
                assert!(error < 1e-8, "{name}, rates {rates}, on {acting} by {moved}: {error:e}");
            }
        }
    }
    println!("worst difference {worst:.1e}");
}

#[test]
fn momenta_and_powers_balance() {
    for (name, one, other) in pairs() {
        let laws = laws([6.0, 5.0, 4.0], true);
        let found = loads(&laws, [&one, &other]);
        let [above, below] = &found.on;
        assert_eq!(above.force, -below.force, "{name}");
        let torques = [one.torque(above), other.torque(below)];
        // The places are some 4 m from the origin.
        assert!((torques[0] + torques[1]).norm() < 1e-13 * 4.0 * above.force.norm(), "{name}");
        let power: f64 = [(&one, above), (&other, below)]
            .map(|(half, loads)| loads.power(&half.velocity.velocity, &half.velocity.gradient_rate))
            .iter()
            .sum();
        let booked: f64 = found.powers.iter().sum();
        assert!((power - booked).abs() < 1e-11 * above.force.norm(), "{name}: {power} and {booked}");
        for kind in [LawKind::Damping, LawKind::Friction] {
            assert!(found.powers[kind as usize] < 0.0, "{name}");
        }
    }
}

#[test]
fn names_and_axes_do_not_matter() {
    let mut next = noise(0.3);
    let (turn, shift) = (rotation(&mut next), vector(&mut next));
    for (name, one, other) in pairs() {
        let laws = laws([6.0, 5.0, 4.0], true);
        let found = loads(&laws, [&one, &other]);
        let swapped = loads(&laws, [&other, &one]);
        let turned = loads(&laws, [&one.turned(&turn, &shift), &other.turned(&turn, &shift)]);
        for body in 0..2 {
            let Loads { force, moment } = found.on[body];
            let apart = off(&numbers(&swapped.on[1 - body]), &numbers(&found.on[body]));
            assert!(apart < 1e-11, "{name}: {apart:e}");
            let wanted = Loads { force: turn * force, moment: turn * moment };
            let apart = off(&numbers(&turned.on[body]), &numbers(&wanted));
            assert!(apart < 1e-11, "{name}: {apart:e}");
        }
    }
}

/// A body that stands still, with P = 1.
fn still(surface: Surface, height: f64) -> Half {
    let placement = Placement { position: Vec3::z() * height, gradient: Mat3::identity() };
    let velocity = Velocity { velocity: Vec3::zeros(), gradient_rate: Mat3::zeros() };
    Half { surface, placement, velocity }
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
fn a_pair_is_nothing_beyond_its_reach_and_nearly_whole_well_within() {
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
