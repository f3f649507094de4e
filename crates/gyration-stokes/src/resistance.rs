//! The resistance matrix of a surface, from the single layer over it.
//!
//! In a fluid of viscosity one at rest at infinity, the body moves with u = U + L (x − c), E = sym L, q = tr L. Let v
//! be the flow of a uniform source q in the body: div v = q in it, 0 outside, no vorticity, no pressure. What is left,
//! u − v, has no divergence in the body and its inner stress is 2 (E − ∇v). By the representation formula on both
//! sides, the traction is
//!
//!   t = ψ + 2 (E − q I) n,    (1/8π) ∫ G ψ dA = −(u − v) on the surface,    ∫ ψ·v dA = 0 (no pressure in the body)
//!
//! and with b = u − v and S the single layer, which is symmetric and positive up to S n = 0 (b is orthogonal to n),
//!
//!   x′·H x = −∫ t·u′ dA = ⟨S⁺ b, b′⟩ − 2V (E:E′ − q q′)
//!
//! A wall adds images to G and v, and q q′ Π to the matrix ([`crate::wall`]).
//!
//! ψ is linear on each triangle, so that the first term is a best approximation from below. s ⟨n,·⟩² is added to S: any
//! s > 0 leaves the solution alone. Sources: Pozrikidis, *Boundary Integral and Singularity Methods* (1992), ch. 2–4;
//! `docs/resistance.md`.

use crate::assembly::SingleLayer;
use crate::coarse::CoarseSpace;
use crate::curvature::{Weight, node_normals, risen};
use crate::dense::{self, Columns, NoFactor, SIDES};
use crate::error::StokesError;
use crate::estimate::largest_share;
use crate::motion::{Mat12, UnitMotion, inner_work, right_sides};
use crate::panel::FlatPanel;
use crate::surface::ClosedSurface;
use crate::vector::Vec3;
use crate::wall::{WallImages, WallPlane};
use gyration_threads::{Interruption, on_own_threads};

/// Bytes of matrices that are taken unless said otherwise: 16,000 unknowns, some 10,000 triangles of a smooth surface.
pub const DEFAULT_MAX_BYTES: u64 = 5 << 29;

/// What the flat triangles stand for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Faces {
    /// A surface that is smooth but for its edges, with the corners on it: its rise above the triangles is added to
    /// first order.
    #[default]
    Curved,
    /// Themselves: the body is the polyhedron.
    Flat,
}

/// What is asked of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StokesOptions {
    /// The centre c of the motions and moments [length].
    pub centre: [f64; 3],
    /// What the triangles stand for.
    pub faces: Faces,
    /// A plane wall without slip that bounds the fluid.
    pub wall: Option<WallPlane>,
    /// Bytes that the matrices may take.
    pub max_bytes: u64,
}

impl Default for StokesOptions {
    fn default() -> Self {
        Self { centre: [0.0; 3], faces: Faces::default(), wall: None, max_bytes: DEFAULT_MAX_BYTES }
    }
}

/// The resistance of a body in a fluid of viscosity one.
#[derive(Debug, Clone, PartialEq)]
pub struct StokesResistance {
    /// H: (f; N row by row) = −H (U; L row by row), f = ∫ t dA, N_ij = ∫ t_i (x − c)_j dA. Symmetric, positive
    /// definite.
    pub matrix: [[f64; 12]; 12],
    /// Estimated relative error: |x·ΔH x| ≤ error · x·H x for every motion x.
    ///
    /// It counts what a space of tractions of half the fineness loses, brought to this mesh at first order; with
    /// [`Faces::Curved`] also the spread of the correction among three rules for the normals, and its square. It is the
    /// sum of the largest shares. On ellipsoids of 80 to 5,120 triangles and aspect ratios up to 20 it is 1 to 4 times
    /// the true error; at 100, where triangles are as long as the body is thick many times over, it falls to half of
    /// it. With [`Faces::Flat`] it knows nothing of a smooth surface for which the triangles may stand.
    pub error: f64,
    /// What [`Faces::Curved`] has added to the matrix of the flat triangles; zeros with [`Faces::Flat`].
    pub curvature: [[f64; 12]; 12],
    nodes: Vec<[usize; 3]>,
    normals: Vec<Vec3>,
    /// −ψ of the twelve motions, by unknown.
    densities: Columns,
}

impl ClosedSurface {
    /// The resistance matrix about a centre.
    ///
    /// # Errors
    /// Matrices larger than allowed; a centre that is not finite; a wall that is touched, crossed or too near for the
    /// triangles that face it; a surface that crosses itself, if that makes the single layer indefinite; a mesh so
    /// coarse that a motion is not resisted; an interruption in force on this thread.
    pub fn resistance(&self, options: &StokesOptions) -> Result<StokesResistance, StokesError> {
        self.check(options)?;
        let interruption = Interruption::in_force();
        on_own_threads(|| interruption.within(|| self.resistance_here(options)))
    }

    fn resistance_here(&self, options: &StokesOptions) -> Result<StokesResistance, StokesError> {
        let panels = FlatPanel::all(self);
        let normals = node_normals(&panels, self.node_count, Weight::Angle);
        let wall = options.wall.as_ref().map(|plane| WallImages::new(plane, &panels)).transpose()?;
        let layer = SingleLayer::new(&panels, self.node_count, wall.as_ref())?;
        let pressure = layer.pressure;
        let LayerSolution { densities, energy, lost } = self.solve(layer, &panels, options)?;
        let volume = self.volume();
        let beside =
            |x: &UnitMotion, y: &UnitMotion| pressure * x.expansion() * y.expansion() - volume * inner_work(x, y);
        let mut matrix = energy + UnitMotion::matrix(beside);
        let mut uncertain = vec![lost];
        let (mut curvature, mut second_order) = (Mat12::zeros(), 0.0);
        if options.faces == Faces::Curved {
            let by = |weight| risen(&panels, &node_normals(&panels, self.node_count, weight), &densities);
            curvature = by(Weight::Angle);
            matrix += curvature;
            second_order = largest_share(&matrix, &[curvature])?.powi(2);
            uncertain.extend([Weight::Area, Weight::Sphere].map(|weight| curvature - by(weight)));
        }
        let error = largest_share(&matrix, &uncertain)? + second_order;
        let rows = |matrix: Mat12| std::array::from_fn(|i| std::array::from_fn(|j| matrix[(i, j)]));
        let (matrix, curvature) = (rows(matrix), rows(curvature));
        Ok(StokesResistance { matrix, error, curvature, nodes: self.nodes.clone(), normals, densities })
    }

    fn check(&self, options: &StokesOptions) -> Result<(), StokesError> {
        if let Some(&value) = options.centre.iter().find(|value| !value.is_finite()) {
            return Err(StokesError::BadOption { what: "centre", must_be: "finite", value });
        }
        let (unknowns, limit) = (self.unknowns(), options.max_bytes);
        let bytes = dense::bytes(unknowns) + dense::bytes(CoarseSpace::new(self).order());
        match bytes > limit {
            true => Err(StokesError::TooLarge { triangles: self.triangles.len(), unknowns, bytes, limit }),
            false => Ok(()),
        }
    }

    /// Solves S φ = b for the twelve motions, φ = −ψ without pressure in the body.
    fn solve(
        &self,
        layer: SingleLayer,
        panels: &[FlatPanel],
        options: &StokesOptions,
    ) -> Result<LayerSolution, StokesError> {
        let SingleLayer { half: mut matrix, expansion, pressure } = layer;
        let sides = right_sides(panels, &options.centre.into(), &expansion);
        regularize(&mut matrix, panels);
        let coarse = CoarseSpace::new(self);
        let coarse_sides = coarse.sides(&sides);
        let coarse_matrix = coarse.matrix(&matrix);
        let mut densities = sides.clone();
        matrix.factor().map_err(|none| self.indefinite(none))?.solve(&mut densities);
        let mut coarse_densities = coarse_sides.clone();
        // A subspace of a definite space is definite, but for rounding.
        coarse_matrix.factor().map_err(|none| self.indefinite(none.in_row(0)))?.solve(&mut coarse_densities);
        let energy = products(&densities, &sides);
        let lost = (energy - products(&coarse_densities, &coarse_sides)) * coarse.factor();
        set_pressure(&mut densities, panels, &expansion, (pressure, self.volume()));
        Ok(LayerSolution { densities, energy, lost })
    }

    fn indefinite(&self, none: NoFactor) -> StokesError {
        let NoFactor::NotDefinite(unknown) = none else { return StokesError::Interrupted };
        let node = unknown / 3;
        let triangle = self.nodes.iter().position(|nodes| nodes.contains(&node)).unwrap_or(0);
        StokesError::NotDefinite { unknown, triangle }
    }
}

/// The single layer solved for the twelve motions.
struct LayerSolution {
    /// φ = −ψ.
    densities: Columns,
    /// ⟨S⁺ b, b′⟩.
    energy: Mat12,
    /// What of it the space of tractions is estimated to lose.
    lost: Mat12,
}

/// Σ φ_k b′_k, symmetric.
fn products(densities: &Columns, sides: &Columns) -> Mat12 {
    let mut sum = Mat12::zeros();
    for (density, side) in densities.iter().zip(sides) {
        for i in 0..SIDES {
            (0..=i).for_each(|j| sum[(i, j)] += 0.5 * (density[i] * side[j] + density[j] * side[i]));
        }
    }
    Mat12::from_fn(|i, j| sum[(i.max(j), i.min(j))])
}

/// S = half + halfᵀ + s ⟨n,·⟩², s such that n, otherwise of eigenvalue 0, gets one like the others.
fn regularize(half: &mut dense::Symmetric, panels: &[FlatPanel]) {
    let mut normal = vec![0.0; half.order];
    let mut area = 0.0;
    for panel in panels {
        area += panel.area;
        for node in panel.nodes {
            (0..3).for_each(|a| normal[3 * node + a] += panel.normal()[a] * panel.area / 3.0);
        }
    }
    // A sphere of radius R: eigenvalues near R/3 of S in the mean, s A of the added term.
    let strength = (area / (4.0 * std::f64::consts::PI)).sqrt() / (3.0 * area);
    half.symmetrize(|i, j| strength * normal[i] * normal[j]);
}

/// Adds the multiple of n to each density with which ∫ φ·v dA = q Π: no pressure in the body but that of the wall.
fn set_pressure(densities: &mut Columns, panels: &[FlatPanel], expansion: &[f64], (wall, volume): (f64, f64)) {
    let mut pressure = UnitMotion::all().map(|motion| -motion.expansion() * wall / volume);
    for (density, v) in densities.iter().zip(expansion) {
        (0..SIDES).for_each(|k| pressure[k] += density[k] * v / volume);
    }
    let nodes = expansion.len() / 3;
    for (node, normal) in node_normals(panels, nodes, Weight::Angle).iter().enumerate() {
        for a in 0..3 {
            (0..SIDES).for_each(|k| densities[3 * node + a][k] -= pressure[k] * normal[a]);
        }
    }
}

impl StokesResistance {
    /// The traction t at the corners of each triangle, for the motion x = (U; L row by row) [force/area].
    pub fn tractions(&self, motion: &[f64; 12]) -> Vec<[[f64; 3]; 3]> {
        let unit = UnitMotion::all();
        let at = |node: usize| {
            let mut traction = Vec3::zeros();
            for (k, (weight, motion)) in motion.iter().zip(&unit).enumerate() {
                let density = Vec3::from_fn(|a, _| self.densities[3 * node + a][k]);
                let inner = motion.strain() * self.normals[node] - motion.expansion() * self.normals[node];
                traction += *weight * (2.0 * inner - density);
            }
            traction.into()
        };
        self.nodes.iter().map(|nodes| nodes.map(at)).collect()
    }
}
