//! From an instant to the rates and their Jacobian: loads, balance, inertialess bodies.
//!
//! `rates` is the file to read first. `loads` is the one loop over what acts on a body; `rigid`, `affine` and
//! `contractile` solve the balance of each kind, `history` and `affine_history` that of a sphere whose past motion the
//! fluid feels, `body_rates` that of any body, `guided` and `reaction` what a guide makes of it; `jacobian`
//! differentiates it, `switching` tells where it cannot; `inertialess` stands above both, `joints` above these, and
//! `rates` over all.

mod affine;
mod affine_history;
mod body_rates;
mod by_kind;
mod contact_parts;
mod contacts;
mod contractile;
mod exchanges;
mod gaps;
mod guided;
mod history;
mod history_reaction;
mod immersed;
mod inertialess;
mod jacobian;
mod joints;
mod loads;
mod outside;
mod pair_tractions;
mod powers;
mod pushes;
mod rates;
mod reaction;
mod rigid;
mod switching;

pub use by_kind::{LoadsByKind, loads_by_kind};
pub use contact_parts::{ContactParts, contact_parts};
pub use contacts::{gap_to_supports, nearest};
pub use exchanges::{Exchange, ExchangeKind, exchanges};
pub use gaps::gap_at;
pub use jacobian::{Blocks, Coupling, Lift, Lower};
pub use joints::{DependentJoint, Held, JointEquation, JointMisfit, JointObservation, observe_joint};
pub use loads::{Acting, acting, stored_energy};
pub use outside::joint_exchanges;
pub use pair_tractions::{PairTractionsAt, each_pair_traction};
pub use pushes::{Push, each_push};
pub use rates::{jacobian, rates};
pub use reaction::reaction;

pub(crate) use affine::{balance as affine_balance, moment};
pub(crate) use body_rates::{BodyLoads, body_rates};
pub(crate) use by_kind::{about_pin, linear_friction};
pub(crate) use contractile::ContractileMotion;
pub(crate) use history_reaction::{history_reaction, of_history};
pub(crate) use immersed::{RigidImmersion, beside_walls, immersion};
pub(crate) use outside::outside_loads;

use crate::body::Body;
use crate::contact::ContactScratch;
use crate::extended::Numbers;
use crate::inadmissible::Inadmissible;
use crate::instant::{Instant, Instants, PairGaps};
use crate::kinematics::Placement;
use crate::load::FrictionFault;
use crate::model::Model;
use crate::pair::PairScratch;
use crate::state::State;
use crate::team::Team;
use crate::tensor::Vec3;
use nalgebra::DMatrix;

/// Memory of the mechanics, reused from call to call.
#[derive(Debug, Clone, Default)]
pub struct Workspace {
    instants: Instants,
    scratch: Scratch,
    /// More scratch, for a team.
    rooms: Vec<Scratch>,
    /// What acts on each body.
    loads: Vec<BodyLoads>,
}

/// Room for the moments of contacts and pairs, and for matrices.
#[derive(Debug, Clone, Default)]
pub struct Scratch {
    pub(crate) contact: ContactScratch,
    pub(crate) pairs: PairScratch,
    pub(crate) formulas: gyration_expression::Scratch,
    /// The Jacobians that bodies without inertia would have with it, by their number of rows.
    matrices: Vec<DMatrix<f64>>,
    balances: inertialess::Balances,
    joints: joints::JointEquations,
    numbers: Vec<f64>,
    /// Of the instant that was read last.
    far_slabs: gaps::FarSlabs,
}

impl Scratch {
    /// Zeros, to be given back.
    pub(crate) fn take_numbers(&mut self, count: usize) -> Vec<f64> {
        let mut numbers = std::mem::take(&mut self.numbers);
        numbers.clear();
        numbers.resize(count, 0.0);
        numbers
    }

    /// Keeps the room of numbers for the next time.
    pub(crate) fn give_back(&mut self, numbers: Vec<f64>) {
        self.numbers = numbers;
    }
}

impl Workspace {
    /// Shares out what comes among a team, or no longer: the same is found.
    pub fn work_with(&mut self, team: Option<Team>) {
        self.instants.team = team;
    }

    /// Reads a state, with the velocities that their balance gives to bodies without inertia.
    ///
    /// # Errors
    /// [`Inadmissible`] where the state is outside the model.
    pub fn read<'a>(
        &'a mut self,
        model: &'a Model,
        state: &State,
    ) -> Result<(Instant<'a>, &'a mut Scratch), Inadmissible> {
        self.read_at(model, state.time, state.numbers())
    }

    fn read_at<'a>(
        &'a mut self,
        model: &'a Model,
        time: f64,
        state: Numbers,
    ) -> Result<(Instant<'a>, &'a mut Scratch), Inadmissible> {
        let Self { instants, scratch, .. } = self;
        scratch.far_slabs.clear();
        let mut instant = instants.read(model, time, state)?;
        inertialess::solve(&mut instant, scratch)?;
        joints::solve(&mut instant, scratch)?;
        Ok((instant, scratch))
    }

    /// The force of all contacts of a body [N]. Of the others only their places are looked at, where all have inertia.
    ///
    /// # Errors
    /// [`Inadmissible`] where the state is outside the model.
    pub fn contact_force(&mut self, (model, body): (&Model, usize), state: &State) -> Result<Vec3, Inadmissible> {
        if !model.inertialess().is_empty() {
            let (instant, scratch) = self.read(model, state)?;
            return Ok(loads::acting(&instant.at(body), scratch)?.contact.force);
        }
        let Self { instants, scratch, .. } = self;
        scratch.far_slabs.clear();
        let instant = instants.read_of((model, body), state.time, state.numbers())?;
        loads::contact_force(&instant.at(body), scratch)
    }

    /// Tests the frictions of a body that change with its place.
    ///
    /// # Errors
    /// [`FrictionFault`] of the first one whose matrix has no value, is not symmetric or not positive semi-definite.
    pub fn check_frictions(&mut self, body: &Body, placement: &Placement, time: f64) -> Result<(), FrictionFault> {
        let formulas = &mut self.scratch.formulas;
        body.own.frictions.iter().try_for_each(|friction| friction.check(placement, time, formulas))
    }

    /// The slab between the bodies of each listed pair; infinite where they are out of reach.
    ///
    /// # Errors
    /// [`Inadmissible`] if no plane separates two of them.
    pub fn pair_gaps(&mut self, model: &Model, time: f64, state: Numbers) -> Result<&PairGaps, Inadmissible> {
        let Self { instants, scratch, .. } = self;
        instants.slabs(model, time, state, |mut instant| inertialess::solve(&mut instant, scratch))
    }

    /// The same of the pairs of one body; those of all others are infinite, since nobody looks at them.
    ///
    /// # Errors
    /// [`Inadmissible`] if no plane separates it from another.
    pub fn pair_gaps_of(
        &mut self,
        (model, body): (&Model, usize),
        time: f64,
        state: Numbers,
    ) -> Result<&PairGaps, Inadmissible> {
        let Self { instants, scratch, .. } = self;
        instants.slabs_of((model, body), time, state, |mut instant| inertialess::solve(&mut instant, scratch))
    }

    /// The gap of a body to what it has a contact with [m]: a support, to all the digits of the state, or a body that
    /// it acts on; infinite without. Of the others only their places are looked at.
    ///
    /// # Errors
    /// [`Inadmissible`] where det P ≤ 0 or det G ≤ 0, or if no plane separates it from another.
    pub fn gap_of(&mut self, (model, body): (&Model, usize), time: f64, state: Numbers) -> Result<f64, Inadmissible> {
        let slabs = self.pair_gaps_of((model, body), time, state)?;
        let near = slabs.acting_on(model, body).map(|slab| slab.gap).fold(f64::INFINITY, f64::min);
        let motions = self.instants.motions(model, time, state)?;
        Ok(near.min(contacts::support_gap_at(&motions.at(model, body))))
    }

    /// The slabs that were found last, infinite of pairs that nobody has looked at since something failed; none once
    /// they are remembered.
    pub fn found_gaps(&self) -> &PairGaps {
        self.instants.found()
    }

    /// The slabs as if nothing were known, and from then on planes are looked for where they are then: what follows is
    /// the same for whoever comes to this state.
    ///
    /// # Errors
    /// [`Inadmissible`] if no plane separates two of them; nothing is remembered then.
    pub fn remember_pairs(&mut self, model: &Model, time: f64, state: Numbers) -> Result<&PairGaps, Inadmissible> {
        let Self { instants, scratch, .. } = self;
        instants.remember(model, time, state, |mut instant| inertialess::solve(&mut instant, scratch))
    }

    /// The slabs that are remembered; none if none are.
    pub fn remembered_gaps(&self) -> Option<&PairGaps> {
        self.instants.remembered()
    }
}
