//! Two bodies and the plane between them: forces are the derivative of the potential, derivatives agree with
//! differences, momenta and powers balance, and nothing depends on who is called A or where all of it stands.

mod adhesion;
mod overlaps;
mod relations;
mod tension;
mod values;

use gyration::contact::{AreaMeasure, ContactLaw, Damping, Deformation, Friction, LawKind, Repulsion};
use gyration::kinematics::{Placement, Velocity};
use gyration::load::Loads;
use gyration::pair::{PairForm, PairLaws, PairLoads, PairScratch, PairSlopes, Side};
use gyration::surface::Surface;
use gyration::tensor::{Mat3, Vec3, axial};
use std::sync::Arc;

/// A body of a pair.
#[derive(Debug, Clone)]
struct Half {
    surface: Surface,
    placement: Placement,
    velocity: Velocity,
    /// Whether its areas change where laws are per deformed area.
    swells: bool,
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
        Self { surface: surface.clone(), placement: Placement { position, gradient }, velocity, swells: false }
    }

    /// As one of two, of which `first` is A.
    fn side(&self, first: &Self) -> Side<'_> {
        Side {
            surface: &self.surface,
            placement: &self.placement,
            from_first: self.placement.position - first.placement.position,
            velocity: &self.velocity,
            inverse: self.placement.gradient.try_inverse().unwrap(),
            deformation: Deformation::of(&self.placement.gradient).filter(|_| self.swells),
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
            swells: self.swells,
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
        laws.push(ContactLaw::Damping(Damping { beta: 0.7, exponent: damping, reference_gap: 0.2, release: None }));
        laws.push(ContactLaw::Friction(Friction { beta: 0.9, exponent: friction, reference_gap: 0.15, mu: None }));
    }
    PairLaws::new(AreaMeasure::ReferenceArea, laws).unwrap()
}

/// The same laws, and these with a bound on friction that it meets and exceeds, and one-sided damping.
fn bounded_too(laws: &PairLaws) -> Vec<PairLaws> {
    let bounded = |mu: f64| {
        let bind = |law: &ContactLaw| match law {
            ContactLaw::Friction(friction) => ContactLaw::Friction(Friction { mu: Some(mu), ..*friction }),
            ContactLaw::Damping(damping) => ContactLaw::Damping(Damping { release: Some(0.3), ..*damping }),
            other => *other,
        };
        PairLaws::new(laws.measure, laws.laws().iter().map(bind).collect()).unwrap()
    };
    vec![laws.clone(), bounded(10.0), bounded(0.2)]
}

/// Every other pair per deformed area.
fn measured(k: usize, laws: &PairLaws, [mut one, mut other]: [Half; 2]) -> (PairLaws, Half, Half) {
    let deformed = k.is_multiple_of(2);
    (one.swells, other.swells) = (deformed, deformed);
    let measure = if deformed { AreaMeasure::DeformedArea } else { AreaMeasure::ReferenceArea };
    (PairLaws::new(measure, laws.laws().to_vec()).unwrap(), one, other)
}

fn pair(laws: &PairLaws, reach: Option<f64>, halves: [&Half; 2]) -> PairForm {
    PairForm::new(Arc::new(laws.clone()), reach, halves.map(|half| &half.surface))
}

fn loads(laws: &PairLaws, halves: [&Half; 2]) -> PairLoads {
    within(laws, None, halves)
}

fn within(laws: &PairLaws, reach: Option<f64>, [one, other]: [&Half; 2]) -> PairLoads {
    let pair = pair(laws, reach, [one, other]);
    PairLoads::integrate(&pair, [&one.side(one), &other.side(one)], None, &mut PairScratch::default()).unwrap()
}

/// −∂(energy) by the twelve coordinates of a body, by differences of fourth order.
fn fall(laws: &PairLaws, reach: Option<f64>, halves: [&Half; 2], body: usize, step: f64) -> Vec<f64> {
    let energy = |place: usize, by: f64| {
        let mut halves = halves.map(Half::clone);
        halves[body] = halves[body].shifted(place, by, false);
        within(laws, reach, halves.each_ref()).energy
    };
    let slope = |place: usize| {
        let central = |by: f64| (energy(place, by) - energy(place, -by)) / (2.0 * by);
        -(4.0 * central(step) - central(2.0 * step)) / 3.0
    };
    (0..12).map(slope).collect()
}

/// The derivatives of what acts on one body by the coordinates, or their rates, of one, by such differences; column by
/// column.
fn differences(
    laws: &PairLaws,
    reach: Option<f64>,
    halves: [&Half; 2],
    [acting, moved]: [usize; 2],
    (step, rates): (f64, bool),
) -> Vec<f64> {
    let shifted = |place: usize, by: f64| {
        let mut halves = halves.map(Half::clone);
        halves[moved] = halves[moved].shifted(place, by, rates);
        numbers(&within(laws, reach, halves.each_ref()).on[acting])
    };
    let column = |place: usize| {
        let central = |by: f64| {
            let (up, down) = (shifted(place, by), shifted(place, -by));
            up.into_iter().zip(down).map(move |(up, down)| (up - down) / (2.0 * by))
        };
        central(step).zip(central(2.0 * step)).map(|(near, far)| (4.0 * near - far) / 3.0)
    };
    (0..12).flat_map(column).collect()
}

fn slopes(laws: &PairLaws, reach: Option<f64>, [one, other]: [&Half; 2]) -> PairSlopes {
    let pair = pair(laws, reach, [one, other]);
    PairSlopes::integrate(&pair, [&one.side(one), &other.side(one)], None, &mut PairScratch::default()).unwrap()
}

/// How far the derivatives of both by the coordinates of both are from differences; the loads that come with them are
/// those without.
fn off_differences(laws: &PairLaws, reach: Option<f64>, halves: [&Half; 2], found: &PairSlopes) -> f64 {
    let at = within(laws, reach, halves);
    for body in 0..2 {
        let apart = off(&numbers(&found.loads.on[body]), &numbers(&at.on[body]));
        // Both planes are those of least potential to rounding, whose slopes the loads of motions feel in first order.
        assert!(apart < 1e-11, "{apart:e}");
    }
    let apart = |[acting, moved]: [usize; 2]| {
        let wanted = differences(laws, reach, halves, [acting, moved], (1e-4 * at.gap, false));
        off(found.by_place[acting][moved].as_slice(), &wanted)
    };
    [[0, 0], [0, 1], [1, 0], [1, 1]].map(apart).into_iter().fold(0.0, f64::max)
}

/// Forces and torques are opposite, the power on both is what the laws book, and viscous ones take some.
fn assert_balanced(name: &str, [one, other]: [&Half; 2], found: &PairLoads) {
    let [above, below] = &found.on;
    assert_eq!(above.force, -below.force, "{name}");
    let torques = [one.torque(above), other.torque(below)];
    // The places are some 4 m from the origin.
    assert!((torques[0] + torques[1]).norm() < 1e-13 * 4.0 * above.force.norm(), "{name}");
    let power: f64 = [(one, above), (other, below)]
        .map(|(half, loads)| loads.power(&half.velocity.velocity, &half.velocity.gradient_rate))
        .iter()
        .sum();
    let booked: f64 = found.powers.iter().sum();
    assert!((power - booked).abs() < 1e-11 * above.force.norm(), "{name}: {power} and {booked}");
    for kind in [LawKind::Damping, LawKind::Friction] {
        assert!(found.powers[kind as usize] < 0.0, "{name}");
    }
}

/// Names of the two do not matter, nor do axes.
fn assert_turned_alike(name: &str, laws: &PairLaws, [one, other]: [&Half; 2], (turn, shift): (&Mat3, &Vec3)) {
    let found = loads(laws, [one, other]);
    let swapped = loads(laws, [other, one]);
    let turned = loads(laws, [&one.turned(turn, shift), &other.turned(turn, shift)]);
    for body in 0..2 {
        let Loads { force, moment } = found.on[body];
        let apart = off(&numbers(&swapped.on[1 - body]), &numbers(&found.on[body]));
        assert!(apart < 1e-11, "{name}: {apart:e}");
        let wanted = Loads { force: turn * force, moment: turn * moment };
        let apart = off(&numbers(&turned.on[body]), &numbers(&wanted));
        assert!(apart < 1e-11, "{name}: {apart:e}");
    }
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
            let sides = [one.side(&one), other.side(&one)];
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
