//! Where pairs of bodies begin to feel each other: at the length that is written, or at the gaps that weight and speeds
//! of the scene say.

use super::body::AssembledBody;
use crate::check::Reporter;
use crate::file;
use crate::key::Key;
use gyration::body::Solid;
use gyration::kinematics::Velocity;
use gyration::pair::{Falling, Mass, PairLaws, Reach};
use gyration::state::{RigidStart, Start};
use gyration::surface::Surface;
use gyration::tensor::Vec3;
use std::collections::HashSet;
use std::sync::Arc;

/// So many velocities are compared one by one; of more, those that are extreme along some directions.
const COMPARED: usize = 1000;
/// So many different solids are looked at two by two; of more, the largest surface with the smallest mass.
const PAIRED: usize = 50;

/// The reach of a contact between these sets of bodies; none where nothing says how long it is, which is noted.
pub(super) fn reach(
    written: file::Reach,
    (laws, sets): (&PairLaws, &[Vec<usize>; 2]),
    falling: &Falling,
    assembled: &[Option<AssembledBody>],
    (key, reporter): (&Key, &mut Reporter<'_>),
) -> Option<Reach> {
    Some(match written {
        file::Reach::Length(length) => Reach::Length(length.value()),
        file::Reach::Auto(_) => {
            if !falling.acts() {
                let message = "nothing says how near bodies come: there is no gravity, and none of them moves";
                reporter.note(
                    &key.key("reach"),
                    message,
                    "write a length: some 25 of the gaps at which they turn back",
                );
                return None;
            }
            let unlimited = Reach::Gaps { falling: *falling, longest: f64::INFINITY };
            Reach::Gaps { falling: *falling, longest: longest(&unlimited, laws, sets, assembled) }
        }
    })
}

/// What brings the bodies of a scene together: gravity, and the largest relative speed of two centres with that of the
/// two surfaces that turn fastest.
pub(super) fn falling(gravity: &Vec3, assembled: &[Option<AssembledBody>]) -> Falling {
    let moving = || assembled.iter().flatten().filter(|body| body.body.solid.surface.is_some());
    let (mut velocities, mut turns): (Vec<Vec3>, Vec<f64>) = moving().map(velocity).unzip();
    if velocities.len() > COMPARED {
        velocities = extremes(&velocities);
    }
    let apart = velocities.iter().flat_map(|one| velocities.iter().map(move |other| (one - other).norm()));
    turns.sort_unstable_by(|one, other| other.total_cmp(one));
    let speed = apart.fold(0.0, f64::max) + turns.iter().take(2).sum::<f64>();
    Falling { gravity: gravity.norm(), speed: if velocities.len() > 1 { speed } else { 0.0 } }
}

/// How fast the centre of a body moves, and its surface about it [m/s].
fn velocity(assembled: &AssembledBody) -> (Vec3, f64) {
    let body = &assembled.body;
    let radius = body.solid.radius().unwrap_or(0.0);
    let (velocity, turn) = match &assembled.start {
        Start::Rigid(RigidStart { velocity, angular_velocity, .. }) => (*velocity, angular_velocity.norm()),
        Start::Affine(_, Velocity { velocity, gradient_rate })
        | Start::Contractile(_, Velocity { velocity, gradient_rate }, _) => (*velocity, gradient_rate.norm()),
    };
    // The centre of a pinned body moves as the pin lets it.
    match &body.pin {
        Some(pin) => (Vec3::zeros(), turn * (radius + pin.point.norm())),
        None => (velocity, turn * radius),
    }
}

/// The velocities that go farthest along the axes, the diagonals of faces and those of a cube.
fn extremes(velocities: &[Vec3]) -> Vec<Vec3> {
    let steps = [-1.0, 0.0, 1.0];
    let directions = steps.iter().flat_map(|x| steps.iter().flat_map(move |y| steps.map(|z| Vec3::new(*x, *y, z))));
    let farthest = |direction: Vec3| {
        velocities.iter().copied().max_by(|one, other| one.dot(&direction).total_cmp(&other.dot(&direction)))
    };
    directions.filter_map(farthest).collect()
}

/// The longest reach of two bodies of two sets [m], or more.
fn longest(reach: &Reach, laws: &PairLaws, sets: &[Vec<usize>; 2], assembled: &[Option<AssembledBody>]) -> f64 {
    let solids = sets.each_ref().map(|set| {
        let mut seen = HashSet::new();
        let solids = set.iter().filter_map(|body| Some(&assembled[*body].as_ref()?.body.solid));
        solids.filter(|solid| seen.insert(Arc::as_ptr(solid))).collect::<Vec<_>>()
    });
    let parts = |solid: &'_ Arc<Solid>| -> Vec<(Surface, f64)> {
        (0..solid.count_parts()).map(|part| (solid.part(part).clone(), solid.mass.mass)).collect()
    };
    let of = |one: &(Surface, f64), other: &(Surface, f64)| {
        reach.of(laws, [one, other].map(|(surface, mass)| Mass { surface, mass: *mass }))
    };
    if solids.iter().all(|solids| solids.len() <= PAIRED) {
        let [one, other] = solids.map(|solids| solids.into_iter().flat_map(parts).collect::<Vec<_>>());
        let pairs = one.iter().flat_map(|one| other.iter().map(|other| of(one, other)));
        return pairs.fold(0.0, f64::max);
    }
    // More is stored between larger surfaces, and less is needed by smaller masses.
    let all = || solids.iter().flatten().copied();
    let lightest = all().map(|solid| solid.mass.mass).fold(f64::INFINITY, f64::min);
    let areas = all().filter_map(|solid| Some(solid.surface.as_ref()?.area()));
    let area = areas.fold(0.0, f64::max);
    // A cube of the largest surface: no ball, whose gap is smaller.
    let cube = Surface::cuboid(&Vec3::repeat((area / 6.0).sqrt()));
    let extreme = (cube, lightest);
    of(&extreme, &extreme)
}
