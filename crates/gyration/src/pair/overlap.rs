//! Two convex bodies that reach each other: how far, and which way apart.

use super::deepest::shortest_way;
use super::gjk::separate;
use super::laws::shares;
use super::side::Side;
use super::state::halves;
use crate::kinematics::{Placement, Velocity};
use crate::surface::curved::Patch;
use crate::surface::{GapField, Surface};
use crate::tensor::{Mat3, Vec3};

/// Two bodies that no plane separates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Overlap {
    /// A way for A that separates them.
    pub normal: Vec3,
    /// How far along it [m]: the shortest way apart, to a thousandth.
    pub depth: f64,
    /// A depth that cannot be told from none [m].
    pub resolution: f64,
}

/// From the point of A that is lowest along a way to that of B that is highest.
fn difference(surfaces: [&Surface; 2], placements: [&Placement; 2], normal: &Vec3) -> Vec3 {
    // From the centre of B.
    let lowest = |i: usize, normal: &Vec3| {
        let Placement { position, gradient } = placements[i];
        let field = GapField::new(0.0, gradient.tr_mul(normal));
        position - placements[1].position + gradient * surfaces[i].smallest_gap(&field).1
    };
    lowest(1, &-normal) - lowest(0, normal)
}

/// A distance that cannot be told from zero, relative to the size and the distance of the centres.
const RESOLUTION: f64 = 64.0 * f64::EPSILON;

impl Overlap {
    /// Whether they touch: neither apart nor into each other, as far as numbers tell.
    pub fn touches(&self) -> bool {
        self.depth <= self.resolution
    }

    /// The way of A along a direction until a plane across it stands between the two \[m\]; below zero where one does.
    pub fn depth_along(surfaces: [&Surface; 2], placements: [&Placement; 2], normal: &Vec3) -> f64 {
        difference(surfaces, placements, normal).dot(normal)
    }

    /// Whether two convex bodies are apart.
    ///
    /// # Errors
    /// How they overlap.
    pub fn check(surfaces: [&Surface; 2], placements: [&Placement; 2]) -> Result<(), Self> {
        let velocity = Velocity { velocity: Vec3::zeros(), gradient_rate: Mat3::zeros() };
        let between = placements[0].position - placements[1].position;
        // |P X| is the speed of X under the gradient rate P.
        let size = [0, 1].map(|i| surfaces[i].fastest_point(&Vec3::zeros(), &placements[i].gradient));
        if between.norm() > size[0] + size[1] {
            return Ok(());
        }
        let [one, other] = [0, 1].map(|i| Side {
            surface: surfaces[i],
            placement: placements[i],
            from_first: placements[i].position - placements[0].position,
            velocity: &velocity,
            inverse: Mat3::identity(),
            deformation: None,
            least_gap: RESOLUTION * (size[i] + between.norm()),
        });
        let halves = halves([&one, &other], shares(surfaces.map(Surface::area)), false);
        if separate(halves.each_ref()).is_ok() {
            return Ok(());
        }
        let resolution: f64 = halves.iter().map(|half| half.side.least_gap).sum();
        let difference = |normal: &Vec3| difference(surfaces, placements, normal);
        let told = |normal: Vec3| (normal, difference(&normal).dot(&normal));
        // Of bodies that touch, the line of the centres may be the way to the last digit.
        let central = between.try_normalize(0.0).map(told);
        let search = shortest_way(&difference);
        // The search approaches a face between round bodies, and does not meet it.
        let faces = search.into_iter().flat_map(|(way, _)| {
            let of = [0, 1].map(|i| faces_along(surfaces[i], placements[i], if i == 0 { -way } else { way }));
            let [above, below] = of;
            above.into_iter().map(|normal| -normal).chain(below).map(told).collect::<Vec<_>>()
        });
        let found = faces.chain(search).chain(central);
        let shortest = found.min_by(|(_, one), (_, other)| one.total_cmp(other));
        let (normal, depth) = shortest.unwrap_or((Vec3::z(), f64::NAN));
        if depth < -resolution { Ok(()) } else { Err(Self { normal, depth, resolution }) }
    }
}

/// How near to a way the normals of faces are that are tried: the cosine of 26°.
const NEAR: f64 = 0.9;
/// Faces that are tried.
const MOST_FACES: usize = 200;

/// The normals of the flat faces of a body near a way, in space.
fn faces_along(surface: &Surface, placement: &Placement, way: Vec3) -> Vec<Vec3> {
    let Some(inverse) = placement.gradient.try_inverse() else { return Vec::new() };
    let facets = surface.facets.triangles().map(|[a, b, c]| (b - a).cross(&(c - a)));
    let disks = surface.patches.iter().filter_map(Patch::flat_normal).flat_map(|normal| [normal, -normal]);
    let normals = facets.chain(disks).filter_map(|normal| inverse.tr_mul(&normal).try_normalize(0.0));
    normals.filter(|normal| normal.dot(&way) > NEAR).take(MOST_FACES).collect()
}
