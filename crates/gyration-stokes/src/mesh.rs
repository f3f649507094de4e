//! Meshes: icospheres, ellipsoids, and the uniform refinement of any surface.

use crate::error::StokesError;
use crate::surface::ClosedSurface;
use std::collections::HashMap;

/// Refinements of an icosphere: 1.3 million triangles, far more than a matrix can be made of.
pub const MAX_REFINEMENTS: u32 = 8;

impl ClosedSurface {
    /// An icosphere of radius one about the origin: 20·4^`refinements` triangles, corners on the sphere.
    ///
    /// # Errors
    /// More than [`MAX_REFINEMENTS`].
    pub fn icosphere(refinements: u32) -> Result<Self, StokesError> {
        if refinements > MAX_REFINEMENTS {
            let value = f64::from(refinements);
            return Err(StokesError::BadOption { what: "number of refinements", must_be: "8 at most", value });
        }
        let mut sphere = Self::new(&icosahedron(), &ICOSAHEDRON)?;
        for _ in 0..refinements {
            sphere = sphere.refined(normalized)?;
        }
        Ok(sphere)
    }

    /// An ellipsoid of these semi-axes about the origin: the icosphere stretched, corners on the ellipsoid.
    ///
    /// Its volume is smaller than the ellipsoid's; [`crate::Faces::Curved`] accounts for it. Alternatively
    /// [`ClosedSurface::inflated`] to the true volume.
    ///
    /// # Errors
    /// A semi-axis that is not positive and finite, or so unlike the others that triangles become degenerate; more than
    /// [`MAX_REFINEMENTS`].
    pub fn ellipsoid(semi_axes: [f64; 3], refinements: u32) -> Result<Self, StokesError> {
        if let Some(&value) = semi_axes.iter().find(|axis| !(axis.is_finite() && **axis > 0.0)) {
            return Err(StokesError::BadOption { what: "semi-axis", must_be: "positive and finite", value });
        }
        Self::icosphere(refinements)?.moved(|p| std::array::from_fn(|k| semi_axes[k] * p[k]))
    }

    /// Each triangle cut into four at the midpoints of its sides, the midpoints put where `project` says.
    ///
    /// # Errors
    /// Those of [`ClosedSurface::new`], for what the projection spoils.
    pub fn refined(&self, project: impl Fn([f64; 3]) -> [f64; 3]) -> Result<Self, StokesError> {
        let mut points = self.points();
        let mut middles: HashMap<(u32, u32), u32> = HashMap::new();
        let mut triangles = Vec::with_capacity(4 * self.triangles.len());
        for [a, b, c] in self.triangles() {
            let [ab, bc, ca] = [(a, b), (b, c), (c, a)].map(|(from, to)| {
                *middles.entry((from.min(to), from.max(to))).or_insert_with(|| {
                    let (p, q) = (points[from as usize], points[to as usize]);
                    points.push(project(std::array::from_fn(|k| 0.5 * (p[k] + q[k]))));
                    (points.len() - 1) as u32
                })
            });
            triangles.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        Self::new(&points, &triangles)
    }

    /// The surface scaled about a point so that it encloses this volume [length³].
    ///
    /// # Errors
    /// A volume that is not positive and finite.
    pub fn inflated(&self, about: [f64; 3], volume: f64) -> Result<Self, StokesError> {
        if !(volume.is_finite() && volume > 0.0) {
            return Err(StokesError::BadOption { what: "volume", must_be: "positive and finite", value: volume });
        }
        let ratio = libm::cbrt(volume / self.volume());
        self.moved(|p| std::array::from_fn(|k| about[k] + ratio * (p[k] - about[k])))
    }
}

fn normalized(p: [f64; 3]) -> [f64; 3] {
    let length = p.iter().map(|x| x * x).sum::<f64>().sqrt();
    p.map(|x| x / length)
}

/// The corners of the regular icosahedron: (0, ±1, ±φ) and its cyclic permutations, φ the golden ratio.
fn icosahedron() -> [[f64; 3]; 12] {
    let golden = 0.5 * (1.0 + 5.0_f64.sqrt());
    let corner = |k: usize| {
        let (one, long) = (if k & 1 == 0 { 1.0 } else { -1.0 }, if k & 2 == 0 { golden } else { -golden });
        let mut p = [0.0; 3];
        (p[(k / 4 + 1) % 3], p[(k / 4 + 2) % 3]) = (one, long);
        normalized(p)
    };
    std::array::from_fn(corner)
}

const ICOSAHEDRON: [[u32; 3]; 20] = [
    [0, 1, 4],
    [0, 6, 1],
    [0, 4, 8],
    [0, 9, 6],
    [0, 8, 9],
    [1, 10, 4],
    [1, 6, 11],
    [1, 11, 10],
    [2, 5, 3],
    [2, 3, 7],
    [2, 8, 5],
    [2, 7, 9],
    [2, 9, 8],
    [3, 5, 10],
    [3, 11, 7],
    [3, 10, 11],
    [4, 5, 8],
    [4, 10, 5],
    [6, 9, 7],
    [6, 7, 11],
];
