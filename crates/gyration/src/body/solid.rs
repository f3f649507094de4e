//! A body before it moves: what equal bodies share.

use crate::kinematics::Placement;
use crate::mass::MassProperties;
use crate::pair::Overlap;
use crate::shape::Shape;
use crate::surface::{GapField, Surface};
use crate::tensor::Vec3;

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
        let mut this = Self { shape, mass, surface, parts, radii: Vec::new() };
        this.radii = (0..this.count_parts()).map(|part| this.part(part).radius()).collect();
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

    /// The parts of two, each of one with each of the other, ascending.
    pub fn parts_of([one, other]: [&Self; 2]) -> impl Iterator<Item = [usize; 2]> + use<> {
        let (one, other) = (one.count_parts(), other.count_parts());
        (0..one).flat_map(move |first| (0..other).map(move |second| [first, second]))
    }

    /// How two overlap, if any of their parts do: of the ways out of two parts the one along which it is shortest to come
    /// out of all.
    pub fn overlap(solids: [&Self; 2], placements: [&Placement; 2]) -> Option<Overlap> {
        let surfaces = |[one, other]: [usize; 2]| [solids[0].part(one), solids[1].part(other)];
        let all: Vec<[usize; 2]> = Self::parts_of(solids).collect();
        let reaching = |first: &Placement| {
            let of =
                |parts: &[usize; 2]| Some((*parts, Overlap::check(surfaces(*parts), [first, placements[1]]).err()?));
            all.iter().filter_map(of).collect::<Vec<_>>()
        };
        let found = reaching(placements[0]);
        if found.len() == all.len().min(1) {
            return found.into_iter().map(|(_, overlap)| overlap).next();
        }
        let out = |(_, overlap): &([usize; 2], Overlap)| {
            let (normal, mut depth) = (overlap.normal, overlap.depth);
            // Parts that it reaches on its way are left behind, too: each of them once.
            for _ in 0..all.len() {
                let moved = Placement { position: placements[0].position + depth * normal, ..*placements[0] };
                let left = reaching(&moved).into_iter().filter(|(_, overlap)| !overlap.touches());
                let more = left.map(|(parts, _)| Overlap::depth_along(surfaces(parts), placements, &normal));
                match more.reduce(f64::max) {
                    Some(more) if more > depth => depth = more,
                    _ => break,
                }
            }
            Overlap { depth, ..*overlap }
        };
        found.iter().map(out).min_by(|one, other| one.depth.total_cmp(&other.depth))
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
