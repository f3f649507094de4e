//! A closed surface of flat triangles, checked once, and the same surface with its points moved.
//!
//! Points and triangles are plain numbers; a triangle lists its corners counter-clockwise as seen from the fluid. Sides
//! at which the surface is bent by more than [`CREASE_COSINE`] are edges of the body: tractions may jump there, and no
//! curvature is read off them. Elsewhere the surface is taken for smooth. Which sides are edges is found when the
//! surface is made and kept when it is moved, so that a body that deforms keeps its unknowns.

use crate::error::StokesError;
use crate::vector::Vec3;
use std::collections::HashMap;

/// Cosine of the bend at which a side counts as an edge: 60°, above what a smooth surface of a hundred triangles shows.
pub(crate) const CREASE_COSINE: f64 = 0.5;

/// Smallest height of a triangle over its longest side: below, its integrals lose more digits than the mesh is good
/// for.
pub(crate) const THINNEST: f64 = 1e-4;

/// A closed surface of flat triangles with outward normals.
#[derive(Debug, Clone, PartialEq)]
pub struct ClosedSurface {
    pub(crate) points: Vec<Vec3>,
    pub(crate) triangles: Vec<[usize; 3]>,
    /// For each triangle the node at each corner: the points, doubled at edges.
    pub(crate) nodes: Vec<[usize; 3]>,
    pub(crate) node_count: usize,
    /// The three neighbours of each triangle, along the sides from corner 0, 1, 2.
    pub(crate) neighbours: Vec<[usize; 3]>,
}

impl ClosedSurface {
    /// The surface of these triangles, points counted from 0.
    ///
    /// # Errors
    /// A triangle that is degenerate, not finite or names no point; a surface that is not closed, not connected or
    /// turned inward. That it does not cross itself is not checked here.
    pub fn new(points: &[[f64; 3]], triangles: &[[u32; 3]]) -> Result<Self, StokesError> {
        if triangles.len() < 4 {
            return Err(StokesError::TooFew { count: triangles.len() });
        }
        let triangles: Vec<[usize; 3]> = triangles.iter().map(|t| t.map(|corner| corner as usize)).collect();
        let count = points.len();
        for (triangle, corners) in triangles.iter().enumerate() {
            if let Some(&point) = corners.iter().find(|&&corner| corner >= count) {
                return Err(StokesError::NoSuchPoint { triangle, point, count });
            }
        }
        let points: Vec<Vec3> = points.iter().map(|&p| Vec3::from(p)).collect();
        check_shapes(&points, &triangles)?;
        let neighbours = neighbours(&triangles)?;
        check_connected(&neighbours)?;
        let mut surface = Self { points, triangles, nodes: Vec::new(), node_count: 0, neighbours };
        surface.check_outward()?;
        surface.name_nodes();
        Ok(surface)
    }

    /// The same triangles and edges with every point moved.
    ///
    /// # Errors
    /// As [`ClosedSurface::new`], for what moving can spoil.
    pub fn moved(&self, place: impl Fn([f64; 3]) -> [f64; 3]) -> Result<Self, StokesError> {
        let points: Vec<Vec3> = self.points.iter().map(|p| Vec3::from(place((*p).into()))).collect();
        check_shapes(&points, &self.triangles)?;
        let moved = Self { points, ..self.clone() };
        moved.check_outward()?;
        Ok(moved)
    }

    /// The points [length].
    pub fn points(&self) -> Vec<[f64; 3]> {
        self.points.iter().map(|&p| p.into()).collect()
    }

    /// The corners of the triangles.
    pub fn triangles(&self) -> Vec<[u32; 3]> {
        // The corners came as u32.
        self.triangles.iter().map(|t| t.map(|corner| corner as u32)).collect()
    }

    /// The volume enclosed by the triangles [length³].
    pub fn volume(&self) -> f64 {
        let origin = self.points[self.triangles[0][0]];
        let sum: f64 = self
            .triangles
            .iter()
            .map(|t| {
                let [a, b, c] = t.map(|corner| self.points[corner] - origin);
                a.dot(&b.cross(&c))
            })
            .sum();
        sum / 6.0
    }

    /// How many components of traction are solved for: three for each point, more at edges.
    pub fn unknowns(&self) -> usize {
        3 * self.node_count
    }

    fn check_outward(&self) -> Result<(), StokesError> {
        let volume = self.volume();
        if volume > 0.0 { Ok(()) } else { Err(StokesError::Inward { volume }) }
    }

    pub(crate) fn normal(&self, triangle: usize) -> Vec3 {
        let [a, b, c] = self.triangles[triangle].map(|corner| self.points[corner]);
        (b - a).cross(&(c - a)).normalize()
    }

    /// Corners that meet across smooth sides share a node; nodes are numbered in the order of the triangles.
    fn name_nodes(&mut self) {
        let mut root: Vec<usize> = (0..3 * self.triangles.len()).collect();
        for (triangle, neighbours) in self.neighbours.iter().enumerate() {
            for (side, &other) in neighbours.iter().enumerate() {
                if self.normal(triangle).dot(&self.normal(other)) > CREASE_COSINE {
                    for corner in [side, (side + 1) % 3] {
                        let point = self.triangles[triangle][corner];
                        let there = (0..3).find(|&k| self.triangles[other][k] == point).unwrap_or(0);
                        join(&mut root, 3 * triangle + corner, 3 * other + there);
                    }
                }
            }
        }
        let mut names = HashMap::new();
        let mut name = |corner: usize| {
            let next = names.len();
            *names.entry(find(&mut root, corner)).or_insert(next)
        };
        self.nodes = (0..self.triangles.len()).map(|t| [0, 1, 2].map(|k| name(3 * t + k))).collect();
        self.node_count = names.len();
    }
}

fn find(root: &mut [usize], mut at: usize) -> usize {
    while root[at] != at {
        root[at] = root[root[at]];
        at = root[at];
    }
    at
}

fn join(root: &mut [usize], one: usize, other: usize) {
    let (one, other) = (find(root, one), find(root, other));
    root[one.max(other)] = one.min(other);
}

/// Refuses points that are not finite and triangles that are too thin.
fn check_shapes(points: &[Vec3], triangles: &[[usize; 3]]) -> Result<(), StokesError> {
    if let Some(point) = points.iter().position(|p| !p.iter().all(|x| x.is_finite())) {
        return Err(StokesError::NotFinite { point });
    }
    for (triangle, corners) in triangles.iter().enumerate() {
        let [a, b, c] = corners.map(|corner| points[corner]);
        let longest = (b - a).norm().max((c - b).norm()).max((a - c).norm());
        let ratio = (b - a).cross(&(c - a)).norm() / (longest * longest);
        // A triangle of coinciding points gives 0/0.
        if ratio.is_nan() || ratio < THINNEST {
            let ratio = if ratio.is_nan() { 0.0 } else { ratio };
            return Err(StokesError::Degenerate { triangle, ratio, limit: THINNEST });
        }
    }
    Ok(())
}

/// The neighbours of each triangle along its sides.
fn neighbours(triangles: &[[usize; 3]]) -> Result<Vec<[usize; 3]>, StokesError> {
    let mut sides: HashMap<(usize, usize), (usize, usize)> = HashMap::with_capacity(3 * triangles.len());
    for (triangle, t) in triangles.iter().enumerate() {
        for k in 0..3 {
            let entry = sides.entry((t[k], t[(k + 1) % 3])).or_insert((triangle, 0));
            entry.1 += 1;
        }
    }
    let across = |triangle: usize, k: usize| {
        let (from, to) = (triangles[triangle][k], triangles[triangle][(k + 1) % 3]);
        let found = |key| sides.get(&key).copied().unwrap_or((triangle, 0));
        match (found((from, to)).1, found((to, from))) {
            (1, (other, 1)) => Ok(other),
            (_, (_, neighbours)) => Err(StokesError::NotClosed { triangle, from, to, neighbours }),
        }
    };
    (0..triangles.len()).map(|t| Ok([across(t, 0)?, across(t, 1)?, across(t, 2)?])).collect()
}

fn check_connected(neighbours: &[[usize; 3]]) -> Result<(), StokesError> {
    let mut reached = vec![false; neighbours.len()];
    let mut waiting = vec![0];
    reached[0] = true;
    while let Some(triangle) = waiting.pop() {
        for &other in &neighbours[triangle] {
            if !std::mem::replace(&mut reached[other], true) {
                waiting.push(other);
            }
        }
    }
    match reached.iter().position(|seen| !seen) {
        Some(triangle) => Err(StokesError::NotConnected { triangle }),
        None => Ok(()),
    }
}
