//! Bands of a lattice: the waves that run through it.
//!
//!   ξ_i(R, t) = Re ξ_i e^{i(k·R − ωt) − δt},   k = Σ κ_a b_a,   λ = −δ − iω
//!
//! `path` reads wave vectors, `bloch` has the matrices of the small motions of one cell and of those at a wave vector,
//! `waves` their roots, shapes and group velocities, `evanescent` all wave vectors of a frequency, `sound` the speeds
//! of long waves, `stability` the wave that grows first, `edges` how much of a wave runs at a free end, `strained`
//! deforms the cell. The cell is linearized about its rest, or about the state as it is written. `continuum` expands
//! the matrices about k = 0.

mod bloch;
mod bound;
mod by_cell;
mod cell_rest;
mod continuum;
mod doubt;
mod edges;
mod eigenspaces;
mod evanescent;
mod first_order;
mod mesh;
mod normal;
mod path;
#[cfg(test)]
mod relations;
mod sound;
mod stability;
mod strained;
mod topology;
mod touching;
mod varied;
mod wave;
mod waves;

pub use continuum::{Continuum, ContinuumModel, NoContinuum, Reach, Tensor, frequency_error};
pub use doubt::MatrixDoubt;
pub use edges::FreeEdges;
pub use mesh::{BandGap, StateDensity, Zone};
pub use normal::NoNormalModes;
pub(crate) use normal::NormalModes;
pub use path::{BandPath, MOST_POINTS, PathError, PathPoint};
pub use sound::Sound;
pub use stability::{LeastSquare, Stability, Unstable, ZoneMesh};
pub use strained::{Instability, StrainError, StrainPath, StrainedCell, StrainedRow};
pub use topology::{BranchChern, ChernGap, NoTopology, Topology};
pub use varied::VariedCell;

use super::frozen::{FrozenContraction, FrozenSystem};
use super::participation::PARTS;
use super::shape::ModeShape;
use super::system::SystemCoordinates;
use super::{NoRest, Rest, RestContraction, are_driven, equilibrium, held_rest, system_rest};
use bloch::{BlochSystem, C64};
pub(crate) use by_cell::unit_phase;
use gyration::Inadmissible;
use gyration::lattice::Lattice;
use gyration::model::Model;
use gyration::state::State;
use gyration::tensor::{Mat3, Vec3};
use gyration_threads::Interruption;
use nalgebra::DVector;
use serde::Serialize;
use wave::Asked;
use waves::Waves;

/// A cell of a lattice about a state in which it rests, or is written.
#[derive(Debug)]
pub struct LatticeWaves {
    frozen: FrozenSystem,
    coordinates: SystemCoordinates,
    system: BlochSystem,
    lattice: Lattice,
    rest: CellRest,
    /// Whether its bodies have sought their rest.
    is_relaxed: bool,
}

/// Where the cell is looked at, and how it is loaded there.
#[derive(Debug, Clone, PartialEq)]
pub struct CellRest {
    /// The cell vectors [m].
    pub cell: Vec<Vec3>,
    /// The force t_a that each cell vector carries [N]: Σ n_a f of what leads to the cell Σ n_a a_a.
    pub force: Vec<Vec3>,
    /// σ = Σ t_a ⊗ a_a/Ω [Pa; of a sheet N/m, of a chain N].
    pub stress: Mat3,
    /// Where each body rests.
    pub bodies: Vec<Rest>,
    /// The largest acceleration that is left, in numbers of the state; none where the cell rests.
    pub unrest: Option<f64>,
}

/// Why there are no bands.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NoBands {
    /// The cell has no rest state.
    #[error("the cell has no rest state: {0}")]
    Rest(#[from] NoRest),
    /// The roots were not found.
    #[error("the roots at κ = ({:?}, {:?}, {:?}) could not be found: the iteration did not end", .0[0], .0[1], .0[2])]
    Roots([f64; 3]),
    /// The wave vectors of a frequency were not found.
    #[error("the wave vectors at ω = {0:?} rad/s could not be found: the iteration did not end")]
    Evanescent(f64),
    /// Nothing holds the cell.
    #[error("no least energy holds the cell vectors: F̄_{0} has no stiffness, or less than none, under this stress")]
    CellNotHeld(String),
    /// A body cannot follow the cell.
    #[error("\"{0}\" is kept to a line or a plane out of which this strain of the cell takes it: leave out `keep`")]
    Guide(String),
    /// The cell at rest was not found.
    #[error("no cell at rest was found: steps of {0:.1e} in F̄ are left; begin with vectors nearer to it")]
    CellNotFound(f64),
    /// They were given up.
    #[error("they were given up: they take longer than solver.max_wall_time")]
    Interrupted,
}

/// The waves at a wave vector.
#[derive(Debug, Clone, PartialEq)]
pub struct BandRow {
    /// κ.
    pub kappa: [f64; 3],
    /// k [1/m].
    pub k: Vec3,
    /// The branches, ascending in frequency.
    pub branches: Vec<Branch>,
    /// Every root [1/s].
    pub roots: Vec<C64>,
}

/// One wave.
#[derive(Debug, Clone, PartialEq)]
pub struct Branch {
    /// ω [rad/s].
    pub omega: f64,
    /// δ [1/s]; negative where the wave grows.
    pub decay: f64,
    /// ∂ω/∂k [m/s]; none where ω has no derivative.
    pub velocity: Option<Vec3>,
    /// Shares of the kinetic energy: translation, rotation, shear, stretch, breathing.
    pub participation: [f64; PARTS],
    /// Shares of the kinetic energy at the edges that were asked for: where the cells begin, where they end.
    pub at_edges: Vec<[f64; 2]>,
    /// How each body moves; none where that was not asked for.
    pub shapes: Vec<BandShape>,
    /// ∂ω by each number that was asked for [rad/s per unit of it], ascending among branches of one frequency; none
    /// where ω has no derivative.
    pub changes: Vec<Option<f64>>,
    /// By how much ω may be off [rad/s]; none where that was not asked for, or is not known.
    pub bound: Option<f64>,
}

/// What is asked of the waves at a point.
#[derive(Debug, Clone, Copy, Default)]
pub struct RowRequest<'a> {
    /// Whether shapes are wanted.
    pub shapes: bool,
    /// Numbers by which ω is differentiated.
    pub varied: &'a [VariedCell],
    /// How far the matrices may be off, if bounds are wanted.
    pub doubt: Option<&'a MatrixDoubt>,
    /// Edges at which shares are wanted.
    pub edges: &'a [FreeEdges],
}

/// How a body moves in a wave: δp₀ and δP [1/m] in real and imaginary parts, so scaled that Σ |ξ|² = 1 along
/// coordinates of mass one.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BandShape {
    /// δp₀.
    pub translation: [[f64; 2]; 3],
    /// δP, row by row.
    pub gradient: [[[f64; 2]; 3]; 3],
}

/// Accelerations below this part of the stiffness over a size are those of a state at rest.
const AT_REST: f64 = 1e-9;

impl LatticeWaves {
    /// The waves of a lattice whose cell a model is; its bodies seek their rest first, or stay as they are written.
    ///
    /// # Errors
    /// [`NoBands`].
    pub fn new(model: &Model, start: &State, relaxes: bool) -> Result<Self, NoBands> {
        let members: Vec<usize> = (0..model.bodies.len()).collect();
        if members.iter().any(|body| model.bodies[*body].history().is_some()) {
            return Err(NoRest::Remembered.into());
        }
        let sought = if relaxes { Some(system_rest(model, start, &members)?) } else { None };
        let goes_on = |rest: &Rest| matches!(rest.contraction, Some(RestContraction::GoesOn(_)));
        let follows = match &sought {
            Some(rests) if rests.iter().any(goes_on) => FrozenContraction::Held,
            _ => FrozenContraction::Driven,
        };
        let mut frozen = FrozenSystem::new(model, start, &members, follows);
        let numbers = match &sought {
            Some(rests) => super::at_rest(&frozen, rests),
            None => frozen.start.clone(),
        };
        let lattice = Lattice::clone(&model.lattice);
        let rates = frozen.rates(&numbers).map_err(NoRest::from)?;
        let coordinates = SystemCoordinates::at(&mut frozen, &numbers).map_err(NoRest::from)?;
        let system = BlochSystem::at(&mut frozen, &coordinates, &lattice, (&numbers, &rates)).map_err(NoRest::from)?;
        let left = members.iter().flat_map(|body| {
            let (slots, size) = (frozen.slots(*body), frozen.bodies()[*body].size);
            let of = |range: std::ops::Range<usize>, size: f64| rates[range].iter().map(move |rate| rate.abs() / size);
            of(slots.velocity(), size).chain(of(slots.rate(), 1.0)).collect::<Vec<f64>>()
        });
        let left = left.fold(0.0, f64::max);
        let unrest = (left > AT_REST * system.stiffest).then_some(left);
        let bodies = sought.unwrap_or_else(|| equilibrium::rest_at(&mut frozen, &numbers));
        let (force, stress) = carried(&mut frozen, &lattice, &numbers).map_err(NoRest::from)?;
        let rest = CellRest { cell: lattice.vectors().to_vec(), force, stress, bodies, unrest };
        Ok(Self { frozen, coordinates, system, lattice, rest, is_relaxed: relaxes })
    }

    /// Where the cell is looked at.
    pub fn rest(&self) -> &CellRest {
        &self.rest
    }

    /// Where a body rests in space [m].
    pub fn place(&self, body: usize) -> Vec3 {
        self.frozen.in_space(body, &self.rest.bodies[body].placement.position)
    }

    /// k of κ [1/m].
    pub fn wave_vector(&self, kappa: &[f64; 3]) -> Vec3 {
        self.lattice.reciprocal().iter().zip(kappa).map(|(vector, kappa)| *kappa * vector).sum()
    }

    /// Whether a contraction moves, so that waves have states of first order.
    pub fn contracts(&self) -> bool {
        self.coordinates.contracts()
    }

    /// The waves at κ with their shapes.
    ///
    /// # Errors
    /// [`NoBands`].
    pub fn branches(&self, kappa: [f64; 3]) -> Result<Vec<Branch>, NoBands> {
        let point = PathPoint { kappa, along: [0.0; 3], label: None, is_vertex: false, begins: false };
        Ok(self.row(&point, true)?.branches)
    }

    /// A direction that is no symmetry: it tells waves of one frequency apart where no other is given.
    fn any_direction(&self) -> Vec3 {
        self.wave_vector(&[0.83, 0.47, 0.29]).normalize()
    }

    /// The shapes of a wave.
    fn shapes(&self, wave: &DVector<C64>) -> Vec<BandShape> {
        let [real, imaginary] =
            [wave.map(|z| z.re), wave.map(|z| z.im)].map(|part| self.coordinates.shapes(&self.frozen, &part));
        let shape = |(re, im): (&ModeShape, &ModeShape)| BandShape {
            translation: [0, 1, 2].map(|i| [re.translation[i], im.translation[i]]),
            gradient: [0, 1, 2].map(|i| [0, 1, 2].map(|j| [re.gradient[(i, j)], im.gradient[(i, j)]])),
        };
        real.iter().zip(&imaginary).map(shape).collect()
    }

    /// All complex κ along a direction (0, 1, 2) that ω has [rad/s], real and imaginary part, the others as given; |Im
    /// κ| ascends and is at most 6.
    ///
    /// # Errors
    /// [`NoBands`].
    pub fn evanescent(&self, kappa: &[f64; 3], direction: usize, omega: f64) -> Result<Vec<[f64; 2]>, NoBands> {
        if Interruption::due().is_some() {
            return Err(NoBands::Interrupted);
        }
        self.system.evanescent(kappa, direction, omega)
    }

    /// The waves at a point of a path.
    ///
    /// # Errors
    /// [`NoBands`].
    pub fn row(&self, point: &PathPoint, shapes: bool) -> Result<BandRow, NoBands> {
        self.row_of(point, RowRequest { shapes, ..RowRequest::default() })
    }

    /// The same with what is asked for.
    ///
    /// # Errors
    /// [`NoBands`].
    pub fn row_of(&self, point: &PathPoint, request: RowRequest<'_>) -> Result<BandRow, NoBands> {
        if Interruption::due().is_some() {
            return Err(NoBands::Interrupted);
        }
        let kappa = point.kappa;
        let along = self.wave_vector(&point.along);
        let along = along.try_normalize(0.0).unwrap_or_else(|| self.any_direction());
        let changes = request.varied.iter().map(VariedCell::matrices).collect();
        let found = self.system.waves(&kappa, &along, &Asked { changes, doubt: request.doubt });
        let Waves { branches, roots } = found.map_err(|_| NoBands::Roots(kappa))?;
        let branches = branches.iter().map(|wave| Branch {
            omega: wave.root.im.abs(),
            // Zero has no sign.
            decay: 0.0 - wave.root.re,
            velocity: wave.velocity,
            participation: self.system.participation(&wave.shape),
            at_edges: request.edges.iter().map(|edges| edges.shares(&self.system, &wave.shape)).collect(),
            shapes: if request.shapes { self.shapes(&wave.shape) } else { Vec::new() },
            changes: wave.changes.clone(),
            bound: wave.bound,
        });
        let mut branches: Vec<Branch> = branches.collect();
        edges::share_alike(&mut branches);
        Ok(BandRow { kappa, k: self.wave_vector(&kappa), branches, roots })
    }
}

/// The rest of a cell while contractions are held, and the forces that its vectors carry there.
fn held_forces(model: &Model, start: &State) -> Result<(Vec<Rest>, Vec<Vec3>), NoBands> {
    let members: Vec<usize> = (0..model.bodies.len()).collect();
    let (mut frozen, numbers) = held_rest(model, start, &members)?;
    let (forces, _) = carried(&mut frozen, &model.lattice, &numbers).map_err(NoRest::from)?;
    Ok((equilibrium::rest_at(&mut frozen, &numbers), forces))
}

/// The forces that the cell vectors carry, and the stress.
fn carried(frozen: &mut FrozenSystem, lattice: &Lattice, numbers: &[f64]) -> Result<(Vec<Vec3>, Mat3), Inadmissible> {
    let mut forces = vec![Vec3::zeros(); lattice.vectors().len()];
    // ∂E/∂(place of the second party) is what it does to the first.
    for (cell, on_first) in frozen.across_cells(numbers)? {
        forces.iter_mut().zip(cell).for_each(|(force, n)| *force += f64::from(n) * on_first);
    }
    let products = forces.iter().zip(lattice.vectors()).map(|(force, vector)| force * vector.transpose());
    let stress = products.sum::<Mat3>() / lattice.volume();
    Ok((forces, stress))
}
