//! The parallelepiped of a frame of particles: what repeats itself, and as wide as the bodies elsewhere.

use gyration::lattice::Lattice;
use gyration::tensor::{Mat3, Vec3};
use gyration_scene::CellBlock;
use std::fmt;

/// Bodies that are as near to a plane, in cells, lie in it.
const ROUNDING: f64 = 1e-9;

/// A frame's cell, of bodies that follow one another without end in some direction.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct FrameCell {
    /// Its edges, as columns \[m\].
    edges: Mat3,
    /// Its corner \[m\].
    origin: Vec3,
    /// Along which edges it repeats itself.
    periodic: [bool; 3],
}

impl FrameCell {
    /// Of a lattice and bodies by centre and radius; none where nothing repeats itself.
    ///
    /// Along what is periodic the edge is that of all cells, beside it that of the balls about the bodies.
    pub fn about(lattice: &Lattice, cells: CellBlock, balls: impl Iterator<Item = (Vec3, f64)>) -> Option<Self> {
        let vectors = lattice.vectors().len();
        let periodic: [bool; 3] = std::array::from_fn(|a| a < vectors && cells.periodic[a]);
        if periodic == [false; 3] {
            return None;
        }
        let along = lattice.completed();
        let dual = along.try_inverse()?;
        let (mut low, mut high) = (Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY));
        for (center, radius) in balls {
            let (at, reach) = (dual * center, Vec3::from_fn(|a, _| radius * dual.row(a).norm()));
            (low, high) = (low.inf(&(at - reach)), high.sup(&(at + reach)));
        }
        let (mut edges, mut origin) = (along, Vec3::zeros());
        for a in 0..3 {
            let wide = high[a] - low[a];
            let (from, wide) = if periodic[a] {
                (0.0, f64::from(cells.repeat[a]))
            } else if wide > ROUNDING * (1.0 + low[a].abs()) {
                (low[a], wide)
            } else {
                // Points in a plane, or on a line, fill no cell: it is one unit wide about them.
                (low[a] + 0.5 * (wide - 1.0), 1.0)
            };
            origin += from * along.column(a);
            edges.set_column(a, &(wide * along.column(a)));
        }
        Some(Self { edges, origin, periodic })
    }
}

impl fmt::Display for FrameCell {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        // Without the sign of zero.
        let joined = |numbers: &[f64]| numbers.iter().map(|x| (x + 0.0).to_string()).collect::<Vec<_>>().join(" ");
        let periodic = self.periodic.map(|periodic| if periodic { "T" } else { "F" }).join(" ");
        let (edges, origin) = (joined(self.edges.as_slice()), joined(self.origin.as_slice()));
        write!(f, "Lattice=\"{edges}\" Origin=\"{origin}\" pbc=\"{periodic}\"")
    }
}
