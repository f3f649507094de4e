//! A body before it moves: what equal bodies share.

use crate::kinematics::Placement;
use crate::mass::MassProperties;
use crate::pair::Overlap;
use crate::shape::Shape;
use crate::surface::{GapField, Surface};
use crate::tensor::Vec3;

/// So many overlaps of parts tell ways that are followed until all parts are left.
const MOST_WAYS: usize = 8;

/// Shape, mass and surface; ten thousand equal grains have one.
#[derive(Debug, Clone)]
pub struct Solid {
    /// The shape in its own frame, for whoever draws it.
    pub shape: Shape,
    /// Mass, centre and Euler tensor.
    pub mass: MassProperties,
    /// The surface relative to the centre of mass; none for mass points.
    pub surface: Option<Surface>,
    /// The surfaces of the parts of a union, likewise.
    parts: Vec<Surface>,
    /// The radius of each part that meets other bodies about the centre of mass [m].
    radii: Vec<f64>,
    /// A bound of the radius of each about the middle of its area [m].
    girths: Vec<f64>,
}

impl Solid {
    /// A shape with its mass properties in the frame of the shape.
    pub fn new(shape: Shape, mass: MassProperties) -> Self {
        let surface = shape.surface().map(|surface| surface.translated(&-mass.center));
        let parts = shape.part_surfaces().iter().map(|part| part.translated(&-mass.center)).collect();
        Self::of(shape, mass, surface, parts)
    }

    /// A shape whose surface is another than its own, in one piece and relative to the centre of mass.
    pub fn with_surface(shape: Shape, mass: MassProperties, surface: Surface) -> Self {
        Self::of(shape, mass, Some(surface), Vec::new())
    }

    fn of(shape: Shape, mass: MassProperties, surface: Option<Surface>, parts: Vec<Surface>) -> Self {
        let mut this = Self { shape, mass, surface, parts, radii: Vec::new(), girths: Vec::new() };
        this.radii = (0..this.count_parts()).map(|part| this.part(part).radius()).collect();
        let off =
            |part: usize, radius: f64| this.part(part).area_center().map_or(radius, |middle| middle.norm().min(radius));
        let girth = |(part, radius): (usize, &f64)| radius + off(part, *radius);
        this.girths = this.radii.iter().enumerate().map(girth).collect();
        this
    }

    /// How many parts meet other bodies.
    pub fn count_parts(&self) -> usize {
        if self.surface.is_some() { self.parts.len().max(1) } else { 0 }
    }

    /// The radius of a part about the centre of mass [m].
    ///
    /// # Panics
    /// If there is no such part.
    pub fn part_radius(&self, index: usize) -> f64 {
        self.radii[index]
    }

    /// A bound of the radius of a part about the middle of its area [m]: the mean distance of its points from a plane
    /// that touches it is no larger.
    ///
    /// # Panics
    /// If there is no such part.
    pub fn part_girth(&self, index: usize) -> f64 {
        self.girths[index]
    }

    /// The parts of two, each of one with each of the other, ascending.
    pub fn parts_of([one, other]: [&Self; 2]) -> impl Iterator<Item = [usize; 2]> + use<> {
        let (one, other) = (one.count_parts(), other.count_parts());
        (0..one).flat_map(move |first| (0..other).map(move |second| [first, second]))
    }

    /// The overlap of two, if any of their parts overlap: along that of the ways out of two parts, there and back, and
    /// of the line of the centres, on which all parts are left soonest.
    pub fn overlap(solids: [&Self; 2], placements: [&Placement; 2]) -> Option<Overlap> {
        let surfaces = |[one, other]: [usize; 2]| [solids[0].part(one), solids[1].part(other)];
        let all: Vec<[usize; 2]> = Self::parts_of(solids).collect();
        let reaching = |first: &Placement| {
            let of =
                |parts: &[usize; 2]| Some((*parts, Overlap::check(surfaces(*parts), [first, placements[1]]).err()?));
            all.iter().filter_map(of).collect::<Vec<_>>()
        };
        let found = reaching(placements[0]);
        if all.len() <= 1 {
            return found.into_iter().map(|(_, overlap)| overlap).next();
        }
        let depth_along = |parts: [usize; 2], normal: &Vec3| Overlap::depth_along(surfaces(parts), placements, normal);
        let out = |normal: Vec3| {
            let mut depth =
                found.iter().map(|(parts, _)| depth_along(*parts, &normal)).fold(f64::NEG_INFINITY, f64::max);
            // What the way leads into is left as well; no part comes back.
            for _ in 0..all.len() {
                let moved = Placement { position: placements[0].position + depth * normal, ..*placements[0] };
                let left = reaching(&moved).into_iter().filter(|(_, overlap)| !overlap.touches());
                match left.map(|(parts, _)| depth_along(parts, &normal)).reduce(f64::max) {
                    Some(more) if more > depth => depth = more,
                    _ => break,
                }
            }
            (normal, depth)
        };
        let resolution = found.iter().map(|(_, overlap)| overlap.resolution).reduce(f64::max)?;
        let own = found.iter().take(MOST_WAYS).flat_map(|(_, overlap)| [overlap.normal, -overlap.normal]);
        let central = (placements[0].position - placements[1].position).try_normalize(0.0);
        let shortest = own.chain(central).map(out).min_by(|(_, one), (_, other)| one.total_cmp(other));
        shortest.map(|(normal, depth)| Overlap { normal, depth, resolution })
    }

    /// The largest radius of its parts about the centre of mass [m]; none without a surface.
    pub fn radius(&self) -> Option<f64> {
        self.radii.iter().copied().reduce(f64::max)
    }

    /// Whether it is one ball about its centre of mass.
    pub fn is_ball(&self) -> bool {
        self.count_parts() == 1 && self.part(0).ball().is_some()
    }

    /// The support function h(n) = max X·n over the surface about the centre of mass [m]; −∞ without a surface.
    pub fn extent(&self, direction: &Vec3) -> f64 {
        let lowest = |surface: &Surface| surface.smallest_gap(&GapField::new(0.0, -direction)).0;
        self.surface.as_ref().map_or(f64::NEG_INFINITY, |surface| -lowest(surface))
    }

    /// The surface of a part.
    ///
    /// # Panics
    /// If there is no such part.
    pub fn part(&self, index: usize) -> &Surface {
        match (&self.surface, self.parts.get(index)) {
            (_, Some(part)) => part,
            (Some(whole), None) if index == 0 => whole,
            _ => unreachable!("a pair is between parts that bodies have"),
        }
    }
}
