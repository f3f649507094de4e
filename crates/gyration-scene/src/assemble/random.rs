//! Random places of copies, none nearer than a gap to another.
//!
//! Copies come one by one. The centre of each is drawn uniformly in the box until its bounding sphere, wider by the
//! gap, is clear of the spheres of those before it, and of the surfaces of what they have contacts with (random
//! sequential addition). A sphere holds its body however this is turned, so that rotations are drawn apart.

use crate::file::RandomCopies;
use crate::places::CopyPlace;
use crate::quantity::si;
use crate::uniform::Uniform;
use gyration::body::Solid;
use gyration::kinematics::Placement;
use gyration::neighbours::{Bounds, BoxTree};
use gyration::pair::Overlap;
use gyration::shape::{Shape, Sphere};
use gyration::support::Support;
use gyration::surface::Surface;
use gyration::tensor::{Mat3, Vec3};

/// How often a place is drawn for a copy.
const MOST_DRAWS: usize = 10_000;

/// What copies must keep clear of.
#[derive(Debug)]
pub(super) struct Around<'a> {
    planes: Vec<&'a Support>,
    solids: Vec<(&'a Solid, Placement)>,
    /// The boxes of the solids, by their places among these.
    boxes: BoxTree,
}

impl<'a> Around<'a> {
    /// Planes, of which they must be above, and solids, as far as they have a surface.
    pub(super) fn new(planes: Vec<&'a Support>, solids: impl Iterator<Item = (&'a Solid, Placement)>) -> Self {
        let solids: Vec<_> = solids.filter(|(solid, _)| solid.surface.is_some()).collect();
        let bounds = |(solid, placement): &(&Solid, Placement)| {
            Bounds::about(&placement.position, placement.stretch_bound() * solid.radius().unwrap_or_default())
        };
        let boxes = BoxTree::new(solids.iter().map(bounds).zip(0..));
        Self { planes, solids, boxes }
    }

    /// Whether a ball of this radius \[m\] at a place is clear of all.
    fn is_clear_of(&self, ball: &Surface, center: &Vec3, radius: f64) -> bool {
        if self.planes.iter().any(|plane| plane.gap(center, 0.0) <= radius) {
            return false;
        }
        let here = Placement { position: *center, gradient: Mat3::identity() };
        self.boxes.touching(&Bounds::about(center, radius)).all(|index| {
            let (solid, placement) = &self.solids[index];
            let is_clear = |part: usize| Overlap::check([ball, solid.part(part)], [&here, placement]).is_ok();
            (0..solid.count_parts()).all(is_clear)
        })
    }
}

/// What places are drawn for.
pub(super) struct RandomPlaces<'a> {
    pub(super) written: &'a RandomCopies,
    /// Of the bounding sphere of a copy \[m\].
    pub(super) radius: f64,
    /// The position of the body as it is written \[m\].
    pub(super) position: Vec3,
    pub(super) around: &'a Around<'a>,
}

impl RandomPlaces<'_> {
    /// The places.
    ///
    /// # Errors
    /// How many copies have found one, where no draw brings another.
    pub(super) fn draw(&self) -> Result<Vec<CopyPlace>, usize> {
        let Self { written, radius, position, around } = self;
        let (count, gap) = (written.count.0 as usize, written.gap.value());
        let mut numbers = Uniform::of_seed(written.seed.0 as u64);
        let [low, high]: [Vec3; 2] = written.bounds.each_ref().map(si);
        let (apart, clear) = (2.0 * radius + gap, radius + gap);
        // What has no surface has no contacts either.
        let ball = if clear > 0.0 { Shape::Sphere(Sphere { radius: clear }).surface() } else { None };
        let mut centers: Vec<Vec3> = Vec::with_capacity(count);
        let mut tree = BoxTree::default();
        let mut places = Vec::with_capacity(count);
        for number in 0..count {
            let is_free = |displacement: &Vec3| {
                let center = position + displacement;
                let bounds = Bounds::about(&center, apart);
                tree.touching(&bounds).all(|other| (centers[other] - center).norm() > apart)
                    && ball.as_ref().is_none_or(|ball| around.is_clear_of(ball, &center, clear))
            };
            let mut draws = (0..MOST_DRAWS).map(|_| low + (high - low).component_mul(&numbers.vector()));
            let displacement = draws.find(is_free).ok_or(number)?;
            let center = position + displacement;
            tree.insert(Bounds::about(&center, 0.0), number);
            centers.push(center);
            let turn = written.turn.then(|| numbers.rotation());
            places.push(CopyPlace { displacement, turn, ..CopyPlace::default() });
        }
        Ok(places)
    }
}
