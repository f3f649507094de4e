//! A recording brought back to life: the model that was run, and its state at any sample.
//!
//! A recording holds (p₀, P, ṗ₀, Ṗ, G) of every body and the scene that says all the rest, so that whatever depends on
//! (Model, State) can be had again without a step: mean stress, tractions, gaps. Nothing is written, and nothing is
//! taken from the arrays of derived quantities, whether or not the run recorded them.

mod cells;
mod error;
mod particles;
mod rebuild;
mod snapshot;
mod summary;
pub mod vtk;
mod window;

pub use cells::SurfaceCells;
pub use error::ReplayError;
pub use particles::particles_xyz;
pub use rebuild::scene;
pub use snapshot::{BodySnapshot, Snapshot};

use crate::crowd::CrowdState;
use crate::fields::{Granules, RecordedPair};
use crate::network::{Push, network};
use gyration::body::{Body, BodyKind};
use gyration::dynamics::{ContactParts, Exchange, Workspace, acting, contact_parts, exchanges};
use gyration::homogeneous::observe_homogeneous;
use gyration::kinematics::{Placement, Quaternion, Velocity};
use gyration::lattice::Lattice;
use gyration::model::Model;
use gyration::state::{RigidStart, Start, State};
use gyration::tensor::{Mat3, Vec3, axial};
use gyration_record::Recording;
use gyration_scene::{CellBlock, Scene};
use nalgebra::{Rotation3, UnitQuaternion};
use std::sync::Arc;
use window::{Window, WindowRow};

/// The model of a recording, and its states by their row.
#[derive(Debug, Clone)]
pub struct Replay {
    model: Model,
    /// By which its bodies follow one another without end.
    periods: Lattice,
    /// Its cells, of a lattice.
    cells: Option<CellBlock>,
    window: Window,
    workspace: Workspace,
}

impl Replay {
    /// Builds the model of a recording again; the rows are those that it has now.
    ///
    /// Files that the scene refers to are looked for in the folder of the recording, then in the current one.
    ///
    /// # Errors
    /// `NoScene`, `Scene` (a mesh or a table may have moved), `OtherFiles` (or have changed), `OtherBody`, `Record`.
    pub fn open(recording: &Recording) -> Result<Self, ReplayError> {
        Ok(Self::of(recording, &rebuild::scene(recording)?))
    }

    /// Of a recording and its scene, as `scene` has built it again.
    pub(crate) fn of(recording: &Recording, scene: &Scene) -> Self {
        let built = scene.built();
        // Those of a lattice span a cell.
        let periods = Lattice::new(built.periods()).unwrap_or_default();
        let (model, window) = (built.model.clone(), Window::new(recording));
        Self { model, periods, cells: built.block, window, workspace: Workspace::default() }
    }

    /// The model.
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// The vectors by which the bodies follow one another without end; those of a lattice span a cell.
    pub(crate) fn periods(&self) -> &Lattice {
        &self.periods
    }

    /// How many cells there are along each vector of the lattice, and which of these are periodic.
    pub(crate) fn cells(&self) -> Option<CellBlock> {
        self.cells
    }

    /// The state at a sample.
    ///
    /// # Errors
    /// `Record` if there is no such row, or it cannot be read.
    pub fn state(&mut self, row: usize) -> Result<State, ReplayError> {
        let row = self.window.row(&self.model, row)?;
        let starts = (0..self.model.bodies.len()).map(|index| start(&self.model, &row, index));
        let mut state = State::start(&self.model, &starts.collect::<Vec<_>>());
        state.time = row.time();
        state.works.copy_from_slice(row.works());
        Ok(state)
    }

    /// The bodies at a sample.
    ///
    /// # Errors
    /// Those of [`state`](Replay::state).
    pub fn snapshot(&mut self, row: usize) -> Result<Snapshot<'_>, ReplayError> {
        let state = self.state(row)?;
        Ok(Snapshot::new(&self.model, row, state))
    }

    /// The mean Cauchy stress σ = S Pᵀ/det P of each body at a sample \[Pa\]; none of a rigid body.
    ///
    /// # Errors
    /// Those of [`state`](Replay::state); `Inadmissible` where the row is outside the model, which no run records.
    pub fn cauchy_stress(&mut self, row: usize) -> Result<Vec<Option<Mat3>>, ReplayError> {
        let state = self.state(row)?;
        let Self { model, workspace, .. } = self;
        let outside = |source| ReplayError::Inadmissible { row, source };
        let (instant, scratch) = workspace.read(model, &state).map_err(outside)?;
        let mut stress = |(index, body): (usize, &Arc<Body>)| {
            if body.affine().is_none() {
                return Ok(None);
            }
            let at = instant.at(index);
            let acting = acting(&at, scratch).map_err(outside)?;
            let seen = observe_homogeneous(&at, &acting, scratch, &Vec3::zeros()).map_err(outside)?;
            Ok(Some(seen.cauchy_stress))
        };
        model.bodies.iter().enumerate().map(&mut stress).collect()
    }

    /// The contact force on each body at a sample, along and across the normals of its contacts.
    ///
    /// # Errors
    /// Those of [`cauchy_stress`](Replay::cauchy_stress).
    pub fn contact_parts(&mut self, row: usize) -> Result<Vec<ContactParts>, ReplayError> {
        let state = self.state(row)?;
        let Self { model, workspace, .. } = self;
        let outside = |source| ReplayError::Inadmissible { row, source };
        let (instant, scratch) = workspace.read(model, &state).map_err(outside)?;
        let parts = |index| contact_parts(&instant.at(index), scratch).map_err(outside);
        (0..model.bodies.len()).map(parts).collect()
    }

    /// Who pushes whom at a sample.
    ///
    /// # Errors
    /// Those of [`cauchy_stress`](Replay::cauchy_stress).
    pub fn network(&mut self, row: usize) -> Result<Vec<Push>, ReplayError> {
        let state = self.state(row)?;
        let Self { model, workspace, .. } = self;
        let outside = |source| ReplayError::Inadmissible { row, source };
        let (instant, scratch) = workspace.read(model, &state).map_err(outside)?;
        let mut found = Vec::new();
        exchanges(&instant, scratch, &mut found).map_err(outside)?;
        Ok(network(model, found))
    }

    /// The bodies of a sample as granules; pairs as recorded, if they are given, else those of the replay.
    ///
    /// # Errors
    /// Those of [`cauchy_stress`](Replay::cauchy_stress).
    pub(crate) fn granules(&mut self, row: usize, recorded: Option<&[RecordedPair]>) -> Result<Granules, ReplayError> {
        let state = self.state(row)?;
        let Self { model, workspace, periods, .. } = self;
        let outside = |source| ReplayError::Inadmissible { row, source };
        let (instant, scratch) = workspace.read(model, &state).map_err(outside)?;
        Granules::of(&instant, scratch, state.time, recorded, periods.clone()).map_err(outside)
    }

    /// What many bodies do together at a sample.
    ///
    /// # Errors
    /// Those of [`cauchy_stress`](Replay::cauchy_stress).
    pub fn crowd(&mut self, row: usize) -> Result<CrowdSnapshot, ReplayError> {
        let state = self.state(row)?;
        let Self { model, workspace, .. } = self;
        let outside = |source| ReplayError::Inadmissible { row, source };
        let (instant, scratch) = workspace.read(model, &state).map_err(outside)?;
        let (state, contacts) = CrowdState::with_contacts(&instant, scratch).map_err(outside)?;
        Ok(CrowdSnapshot { state, contacts })
    }
}

/// What many bodies do together at a sample.
#[derive(Debug, Clone)]
pub struct CrowdSnapshot {
    /// What all do together.
    pub state: CrowdState,
    /// The contacts that count.
    pub contacts: Vec<Exchange>,
}

/// A body's part of the state from its row: the inverse of `State::motion`.
fn start(model: &Model, row: &WindowRow, index: usize) -> Start {
    let position = model.in_cell(index, &row.position(index));
    let placement = Placement { position, gradient: row.gradient(index) };
    let velocity = Velocity { velocity: row.velocity(index), gradient_rate: row.gradient_rate(index) };
    match &model.bodies[index].kind {
        BodyKind::Rigid(_) => {
            let rotation = Rotation3::from_matrix_unchecked(placement.gradient);
            let q = UnitQuaternion::from_rotation_matrix(&rotation);
            // Ṗ Rᵀ = [ω]×, whose axial vector is 2ω.
            let spin = velocity.gradient_rate * placement.gradient.transpose();
            Start::Rigid(RigidStart {
                position: placement.position,
                orientation: Quaternion([q.w, q.i, q.j, q.k]),
                velocity: velocity.velocity,
                angular_velocity: 0.5 * axial(&spin),
            })
        }
        BodyKind::Affine(_) => Start::Affine(placement, velocity),
        BodyKind::Contractile(_) => Start::Contractile(placement, velocity, row.contraction(index)),
    }
}
