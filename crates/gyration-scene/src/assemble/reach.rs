//! Where pairs of bodies begin to feel each other: at the length that is written, or at the gaps that weight and speeds
//! of the bodies say.

use super::body::AssembledBody;
use crate::check::Reporter;
use crate::file;
use crate::key::Key;
use gyration::body::Solid;
use gyration::pair::{Falling, Mass, PairLaws, Reach};
use gyration::solid_support::SolidSupport;
use gyration::state::{RigidStart, Start};
use gyration::surface::Surface;
use gyration::tensor::Vec3;
use std::collections::HashSet;
use std::sync::Arc;

/// So many velocities of a set are compared one by one; of more, those that are extreme along some directions.
const COMPARED: usize = 1000;
/// So many different solids of a set are looked at one by one; of more, the largest surface with the smallest mass.
const PAIRED: usize = 50;

/// The reach of a contact between two sets of bodies, or a set of bodies and a support with a shape; none where nothing
/// says how long it is, which is noted.
pub(super) fn reach(
    written: file::Reach,
    laws: &PairLaws,
    gravity: &Vec3,
    (sets, support): (&[Vec<usize>; 2], Option<&SolidSupport>),
    (assembled, key, reporter): (&[Option<AssembledBody>], &Key, &mut Reporter<'_>),
) -> Option<Reach> {
    if let file::Reach::Length(length) = written {
        return Some(Reach::Length(length.value()));
    }
    let of = |set: &Vec<usize>| set.iter().filter_map(|body| assembled[*body].as_ref()).collect::<Vec<_>>();
    let sets = sets.each_ref().map(of);
    let key = key.key("reach");
    if let Some(still) = sets.iter().flatten().find(|body| !body.body.has_inertia()) {
        let name = &still.name;
        let message = format!("nothing says how near \"{name}\" comes to others: it has no inertia that carries it");
        reporter.note(&key, message, "write a length: some 25 of the gaps at which their forces balance the fluid's");
        return None;
    }
    let falling = Falling { gravity: gravity.norm(), speed: largest_speed(&sets, support) };
    if !falling.acts() && laws.held_gap().is_none() {
        // Of a body with an error it is not known whether it moves.
        if assembled.iter().all(Option::is_some) {
            let message = "nothing says how near bodies come: there is no gravity, and none of them moves";
            reporter.note(&key, message, "write a length: some 25 of the gaps at which they turn back");
        }
        return None;
    }
    let [least, longest] = extremes(&falling, laws, &sets, support);
    if !(least > 0.0 && longest.is_finite()) {
        let message = "at no gap that is a number do two of the bodies store what brings them together";
        reporter.note(&key, message, "write a length, a larger exponent, or another alpha");
        return None;
    }
    Some(Reach::Gaps { falling, longest, is_common: least == longest })
}

/// The largest speed of a body of one set relative to one of the other at the start, or to a point of a support [m/s].
fn largest_speed(sets: &[Vec<&AssembledBody>; 2], support: Option<&SolidSupport>) -> f64 {
    if let Some(support) = support {
        let fastest = sets[0].iter().map(|body| velocity(body).norm()).fold(0.0, f64::max);
        return fastest + support.largest_speed();
    }
    let velocities = sets.each_ref().map(|set| {
        let all: Vec<Vec3> = set.iter().map(|body| velocity(body)).collect();
        if all.len() > COMPARED { farthest(&all) } else { all }
    });
    let [one, other] = &velocities;
    one.iter().flat_map(|one| other.iter().map(move |other| (one - other).norm())).fold(0.0, f64::max)
}

/// ṗ₀; that of a pinned body follows from its spin, or from Ṗ [m/s].
fn velocity(assembled: &AssembledBody) -> Vec3 {
    let pin = assembled.body.pin.as_ref().map(|pin| &pin.point);
    match (&assembled.start, pin) {
        (Start::Rigid(RigidStart { velocity, .. }), None) => *velocity,
        (Start::Rigid(RigidStart { orientation, angular_velocity, .. }), Some(arm)) => {
            -angular_velocity.cross(&(orientation.rotation() * arm))
        }
        (Start::Affine(_, velocity) | Start::Contractile(_, velocity, _), None) => velocity.velocity,
        (Start::Affine(_, velocity) | Start::Contractile(_, velocity, _), Some(arm)) => -(velocity.gradient_rate * arm),
    }
}

/// The velocities that go farthest along the axes, the diagonals of faces and those of a cube.
fn farthest(velocities: &[Vec3]) -> Vec<Vec3> {
    let steps = [-1.0, 0.0, 1.0];
    let directions = steps.iter().flat_map(|x| steps.iter().flat_map(move |y| steps.map(|z| Vec3::new(*x, *y, z))));
    let farthest = |direction: Vec3| {
        velocities.iter().copied().max_by(|one, other| one.dot(&direction).total_cmp(&other.dot(&direction)))
    };
    directions.filter_map(farthest).collect()
}

/// The shortest and the longest reach of bodies of two sets [m]; of very many different ones no less than the longest.
fn extremes(
    falling: &Falling,
    laws: &PairLaws,
    sets: &[Vec<&AssembledBody>; 2],
    support: Option<&SolidSupport>,
) -> [f64; 2] {
    let carried: Vec<&Arc<Solid>> = support.iter().map(|support| &support.solid).collect();
    let [one, other] = sets.each_ref().map(|set| set.iter().map(|assembled| &assembled.body.solid).collect());
    let solids: [Vec<&Arc<Solid>>; 2] = [one, if support.is_some() { carried } else { other }];
    let kinds = solids.each_ref().map(|solids| {
        let mut seen = HashSet::new();
        let solids = solids.iter().copied();
        let different = solids.filter(|solid| seen.insert(Arc::as_ptr(solid)));
        different.flat_map(parts).collect::<Vec<Mass>>()
    });
    let mut range = [f64::INFINITY, 0.0_f64];
    let mut note = |bodies: [Mass; 2]| {
        let reach = Reach::of_gaps(falling, laws, bodies);
        range = [range[0].min(reach), range[1].max(reach)];
    };
    if kinds.iter().all(|kinds| kinds.len() <= PAIRED) {
        kinds[0].iter().for_each(|one| kinds[1].iter().for_each(|other| note([*one, *other])));
        return range;
    }
    // More is stored between larger surfaces, and less is needed by smaller masses. Cubes of these surfaces: the gap of
    // balls is smaller.
    let bounds = kinds.each_ref().map(|kinds| {
        let area = kinds.iter().map(|kind| kind.surface.area()).fold(0.0, f64::max);
        let lightest = kinds.iter().map(|kind| kind.mass).fold(f64::INFINITY, f64::min);
        (Surface::cuboid(&Vec3::repeat((area / 6.0).sqrt())), lightest)
    });
    note(bounds.each_ref().map(|(surface, mass)| Mass { surface, mass: *mass }));
    // Some that are there: a bound alone is the reach of no two.
    kinds[0].iter().zip(&kinds[1]).take(PAIRED).for_each(|(one, other)| note([*one, *other]));
    range
}

/// The parts of a body that meet others.
fn parts(solid: &Arc<Solid>) -> impl Iterator<Item = Mass<'_>> {
    (0..solid.count_parts()).map(|part| Mass { surface: solid.part(part), mass: solid.mass.mass })
}
