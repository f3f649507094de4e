//! Shells of a mesh that enclose the same space more than once, or none.
//!
//! A closed surface may have several pieces: bodies side by side, and voids, whose triangles face the other way. The
//! number of shells around a point, voids counted as −1, is then 0 or 1 everywhere, and the volume is the sum of
//! theirs. It is not where shells cross one another or themselves, where one lies within another of the same sense, and
//! where a void is in nothing.
//!
//!   w(x) = (1/4π) Σ solid angles of the triangles,   tan(Ω/2) = a·(b×c)/(abc + (a·b)c + (b·c)a + (c·a)b)
//!
//! Source of the solid angle: van Oosterom and Strackee 1983.

use gyration::neighbours::{Bounds, BoxTree};
use gyration::shape::Polyhedron;
use gyration::tensor::Vec3;
use std::f64::consts::PI;
use std::fmt;

/// Shells that are compared with one another.
const MOST_SHELLS: usize = 100;
/// Triangles of two shells that are compared.
const MOST_COMPARED: usize = 4_000_000;
/// Triangles of one shell that are: a dozen neighbours of each of three million.
const MOST_WITHIN: usize = 40_000_000;
/// Points of a shell of which it is asked whether they are in another.
const POINTS: usize = 48;
/// How far an edge must pass through a triangle, relative to the size: shells may share faces and edges.
const THROUGH: f64 = 1e-9;
/// Shells whose volumes are told.
const MOST_TOLD: usize = 4;

/// Shells of a mesh that count space more than once, or as less than none.
#[derive(Debug, Clone, PartialEq)]
pub struct Shells {
    /// Which two, from 1 in the order of the file; the same twice for one that is so by itself.
    pub which: [usize; 2],
    /// How they stand to each other.
    pub kind: ShellFault,
    /// Where \[m\].
    pub place: Vec3,
    /// The volume of the mesh as it is counted \[m³\].
    pub sum: f64,
    /// The volume of what the shells enclose \[m³\]; none where they cross.
    pub union: Option<f64>,
    /// The volume of each shell \[m³\], in the order of the file.
    pub own: Vec<f64>,
}

/// How two shells stand to each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ShellFault {
    /// Their surfaces cross; that of one shell itself.
    Crossing,
    /// The second lies within the first and faces the same way.
    Within,
    /// It faces inward and lies in no other.
    VoidInNothing,
}

impl fmt::Display for Shells {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [one, other] = self.which;
        match self.kind {
            ShellFault::Crossing if one == other => write!(f, "its shell {one} crosses itself")?,
            ShellFault::Crossing => write!(f, "its shells {one} and {other} cross")?,
            ShellFault::Within => write!(f, "shell {other} lies within shell {one} and faces the same way")?,
            ShellFault::VoidInNothing => write!(f, "shell {one} is turned inside out")?,
        }
        let [x, y, z] = self.place.into();
        write!(f, " near [{x:.6}, {y:.6}, {z:.6}] m; its volume counts as {:.6e} m³, ", self.sum)?;
        match self.union {
            None if one == other && self.kind == ShellFault::Crossing => {
                write!(f, "each place as often as the surface is wound about it")
            }
            Some(union) => write!(f, "and what it encloses is {union:.6e} m³"),
            None => {
                let own: Vec<String> = self.own.iter().take(MOST_TOLD).map(|volume| format!("{volume:.6e}")).collect();
                let more = if self.own.len() > MOST_TOLD { " …" } else { "" };
                write!(f, "the shells have {}{more} m³", own.join(" + "))
            }
        }
    }
}

/// One closed piece of a mesh.
struct Shell<'a> {
    mesh: &'a Polyhedron,
    triangles: Vec<[usize; 3]>,
    volume: f64,
    least: Vec3,
    most: Vec3,
}

/// The first two shells of a closed mesh that count space more than once; none where there are none.
pub fn doubly_enclosed(mesh: &Polyhedron) -> Option<Shells> {
    let shells = Shell::all(mesh);
    let own: Vec<f64> = shells.iter().map(|shell| shell.volume).collect();
    let sum: f64 = own.iter().sum();
    let told = |which: [usize; 2], kind, place, union| {
        Some(Shells { which: which.map(|k| k + 1), kind, place, sum, union, own: own.clone() })
    };
    let looked_at = &shells[..shells.len().min(MOST_SHELLS)];
    for (index, shell) in looked_at.iter().enumerate() {
        if let Some(place) = shell.crosses_itself() {
            return told([index; 2], ShellFault::Crossing, place, None);
        }
    }
    // For each shell those around it.
    let mut around: Vec<Vec<usize>> = vec![Vec::new(); looked_at.len()];
    for (second, inner) in looked_at.iter().enumerate() {
        for (first, outer) in looked_at.iter().enumerate().filter(|(first, _)| *first != second) {
            if !outer.may_meet(inner) {
                continue;
            }
            if let Some(place) = outer.crossing(inner) {
                return told([first.min(second), first.max(second)], ShellFault::Crossing, place, None);
            }
            if outer.holds(inner) {
                around[second].push(first);
            }
        }
    }
    let sense = |shell: usize| looked_at[shell].volume.signum();
    let depth = |shell: usize| around[shell].iter().map(|outer| sense(*outer)).sum::<f64>();
    // What turns outside into inside and back is the surface of the whole.
    let counts = |shell: &usize| if sense(*shell) > 0.0 { depth(*shell) == 0.0 } else { depth(*shell) == 1.0 };
    let union: Option<f64> =
        (shells.len() == looked_at.len()).then(|| (0..looked_at.len()).filter(counts).map(|shell| own[shell]).sum());
    let fault = (0..looked_at.len()).find(|shell| !counts(shell))?;
    let place = shells[fault].least + 0.5 * (shells[fault].most - shells[fault].least);
    match around[fault].iter().find(|outer| sense(**outer) == sense(fault)) {
        Some(outer) => told([*outer, fault], ShellFault::Within, place, union),
        None => told([fault, fault], ShellFault::VoidInNothing, place, union),
    }
}

impl<'a> Shell<'a> {
    /// The pieces of a mesh, in the order of their first triangles: triangles with a common corner are of one piece.
    fn all(mesh: &'a Polyhedron) -> Vec<Self> {
        let mut parents: Vec<usize> = (0..mesh.vertices.len()).collect();
        for [a, b, c] in &mesh.triangles {
            let root = root(&mut parents, *a);
            for corner in [b, c] {
                let other = self::root(&mut parents, *corner);
                parents[other] = root;
            }
        }
        let mut places = vec![None; mesh.vertices.len()];
        let mut pieces: Vec<Vec<[usize; 3]>> = Vec::new();
        for triangle in &mesh.triangles {
            let root = root(&mut parents, triangle[0]);
            let place = *places[root].get_or_insert_with(|| {
                pieces.push(Vec::new());
                pieces.len() - 1
            });
            pieces[place].push(*triangle);
        }
        pieces.into_iter().map(|triangles| Self::new(mesh, triangles)).collect()
    }

    fn new(mesh: &'a Polyhedron, triangles: Vec<[usize; 3]>) -> Self {
        let (mut least, mut most) = (Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY));
        for point in triangles.iter().flat_map(|triangle| mesh.corners(triangle)) {
            (least, most) = (least.inf(&point), most.sup(&point));
        }
        let origin = least + 0.5 * (most - least);
        let signed = |triangle: &[usize; 3]| {
            let [a, b, c] = mesh.corners(triangle).map(|corner| corner - origin);
            a.dot(&b.cross(&c)) / 6.0
        };
        let volume = triangles.iter().map(signed).sum();
        Self { mesh, triangles, volume, least, most }
    }

    fn size(&self) -> f64 {
        (self.most - self.least).norm()
    }

    /// Whether the boxes around two shells have space in common.
    fn may_meet(&self, other: &Self) -> bool {
        (0..3).all(|axis| self.least[axis] < other.most[axis] && other.least[axis] < self.most[axis])
    }

    /// A place where an edge of the surface passes through a triangle of it.
    fn crosses_itself(&self) -> Option<Vec3> {
        let corners: Vec<[Vec3; 3]> = self.triangles.iter().map(|triangle| self.mesh.corners(triangle)).collect();
        let boxes = || corners.iter().map(|[a, b, c]| bounds(a).with(&bounds(b)).with(&bounds(c)));
        let tree = BoxTree::new(boxes().zip(0..));
        let size = self.size();
        let mut compared = 0;
        for (bounds, one) in boxes().zip(&corners) {
            // In no order: the place of the first in that of the file is told.
            let near = tree.touching(&bounds).inspect(|_| compared += 1);
            let through = near.filter_map(|other| Some((other, passes(one, &corners[other], size)?)));
            if let Some((_, place)) = through.min_by_key(|(other, _)| *other) {
                return Some(place);
            }
            if compared > MOST_WITHIN {
                break;
            }
        }
        None
    }

    /// A place where the surfaces cross: where an edge passes through a triangle, or where some of the other shell is
    /// within this one and some is not.
    fn crossing(&self, other: &Self) -> Option<Vec3> {
        let (mine, theirs) = (self.within(other), other.within(self));
        let size = self.size().min(other.size());
        let mut compared = 0;
        for one in &mine {
            for two in theirs.iter().filter(|two| overlap(one, two)) {
                compared += 1;
                if let Some(place) = passes(one, two, size).or_else(|| passes(two, one, size)) {
                    return Some(place);
                }
            }
            if compared > MOST_COMPARED {
                break;
            }
        }
        let (inside, outside): (Vec<Vec3>, Vec<Vec3>) = other
            .points()
            .filter_map(|point| Some((point, self.holds_point(&point)?)))
            .fold(Default::default(), |(mut inside, mut outside), (point, is_inside)| {
                if is_inside {
                    inside.push(point)
                } else {
                    outside.push(point)
                }
                (inside, outside)
            });
        if outside.is_empty() { None } else { inside.first().copied() }
    }

    /// Whether the other shell, which does not cross this one, lies within it.
    fn holds(&self, other: &Self) -> bool {
        other.points().filter_map(|point| self.holds_point(&point)).next().unwrap_or(false)
    }

    /// Its triangles in the box of another shell, with the extent of each along x.
    fn within(&self, other: &Self) -> Vec<[Vec3; 3]> {
        let corners = self.triangles.iter().map(|triangle| self.mesh.corners(triangle));
        let meets = |corners: &[Vec3; 3]| {
            (0..3).all(|axis| {
                let least = corners.iter().map(|corner| corner[axis]).fold(f64::INFINITY, f64::min);
                let most = corners.iter().map(|corner| corner[axis]).fold(f64::NEG_INFINITY, f64::max);
                least <= other.most[axis] && other.least[axis] <= most
            })
        };
        corners.filter(meets).collect()
    }

    /// Points of it, spread over its triangles: their middles.
    fn points(&self) -> impl Iterator<Item = Vec3> {
        let stride = self.triangles.len().div_ceil(POINTS);
        self.triangles.iter().step_by(stride).map(|triangle| self.mesh.corners(triangle).iter().sum::<Vec3>() / 3.0)
    }

    /// Whether a point is within; none on the surface, as far as numbers tell.
    fn holds_point(&self, point: &Vec3) -> Option<bool> {
        let angle = |triangle: &[usize; 3]| {
            let [a, b, c] = self.mesh.corners(triangle).map(|corner| corner - point);
            let [la, lb, lc] = [a.norm(), b.norm(), c.norm()];
            let below = la * lb * lc + a.dot(&b) * lc + b.dot(&c) * la + c.dot(&a) * lb;
            2.0 * libm::atan2(a.dot(&b.cross(&c)), below)
        };
        let winding = self.triangles.iter().map(angle).sum::<f64>() / (4.0 * PI);
        let turns = winding.abs();
        // On a face it is a half, on an edge another part of one.
        if turns < 0.01 { Some(false) } else { (turns > 0.99).then_some(true) }
    }
}

/// The first of a set of corners, with the way to it shortened.
fn root(parents: &mut [usize], mut corner: usize) -> usize {
    while parents[corner] != corner {
        parents[corner] = parents[parents[corner]];
        corner = parents[corner];
    }
    corner
}

/// The box of a point.
fn bounds(point: &Vec3) -> Bounds {
    Bounds::about(point, 0.0)
}

/// Whether the extents of two triangles along every axis have a place in common.
fn overlap(one: &[Vec3; 3], two: &[Vec3; 3]) -> bool {
    (0..3).all(|axis| {
        let extent = |corners: &[Vec3; 3]| {
            let [a, b, c] = [corners[0][axis], corners[1][axis], corners[2][axis]];
            (a.min(b).min(c), a.max(b).max(c))
        };
        let ((least, most), (other_least, other_most)) = (extent(one), extent(two));
        least <= other_most && other_least <= most
    })
}

/// The place where an edge of one triangle passes through the inside of another.
fn passes(one: &[Vec3; 3], through: &[Vec3; 3], size: f64) -> Option<Vec3> {
    let [a, b, c] = *through;
    let normal = (b - a).cross(&(c - a)).try_normalize(0.0)?;
    let height = |point: &Vec3| normal.dot(&(point - a));
    let least = THROUGH * size;
    (0..3).find_map(|edge| {
        let (from, to) = (one[edge], one[(edge + 1) % 3]);
        let (above, below) = (height(&from), height(&to));
        if above.abs() <= least || below.abs() <= least || (above > 0.0) == (below > 0.0) {
            return None;
        }
        let place = from + (to - from) * (above / (above - below));
        // On the inner side of all three edges, by more than rounding.
        let sides = [(a, b), (b, c), (c, a)];
        let is_inside = sides.iter().all(|(start, end)| {
            let along = end - start;
            normal.dot(&along.cross(&(place - start))) > least * along.norm()
        });
        is_inside.then_some(place)
    })
}
