//! From an instant to the rates and their Jacobian: loads, balance, inertialess bodies.
//!
//! `rates` is the file to read first. `loads` is the one loop over what acts on a body; `rigid`, `affine` and
//! `contractile` solve the balance of each kind, `history` that of a sphere whose past motion the fluid feels,
//! `body_rates` that of any body; `jacobian` differentiates it; `inertialess` stands above both, and `rates` over all.

mod affine;
mod body_rates;
mod contact_parts;
mod contacts;
mod contractile;
mod gaps;
mod history;
mod immersed;
mod inertialess;
mod jacobian;
mod loads;
mod pairs;
mod powers;
mod pushes;
mod rates;
mod rigid;

pub use contact_parts::{ContactParts, contact_parts};
pub use contacts::{gap_to_supports, nearest};
pub use gaps::gap_at;
pub use jacobian::{Blocks, Coupling, Lift, Lower};
pub use loads::{Acting, acting, stored_energy};
pub use pairs::PairGaps;
pub use pushes::{Push, each_push};
pub use rates::{jacobian, rates};

pub(crate) use affine::{balance as affine_balance, moment};
pub(crate) use body_rates::body_rates;
pub(crate) use contractile::ContractileMotion;
pub(crate) use history::RigidHistory;
pub(crate) use immersed::{RigidImmersion, immersion};

use crate::contact::ContactScratch;
use crate::inadmissible::Inadmissible;
use crate::instant::Instant;
use crate::model::Model;
use crate::state::State;
use nalgebra::DMatrix;

/// Memory of the mechanics, reused from call to call.
#[derive(Debug, Clone, Default)]
pub struct Workspace {
    instant: Instant,
    scratch: Scratch,
}

/// Room for the moments of contacts and for matrices.
#[derive(Debug, Clone, Default)]
pub struct Scratch {
    pub(crate) contact: ContactScratch,
    pub(crate) pairs: pairs::PairStates,
    /// The Jacobians of bodies with inertia, by their number of rows.
    matrices: Vec<DMatrix<f64>>,
    numbers: Vec<f64>,
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
    /// Reads a state, with the velocities that their balance gives to bodies without inertia.
    ///
    /// # Errors
    /// [`Inadmissible`] where the state is outside the model.
    pub fn read(&mut self, model: &Model, state: &State) -> Result<(&Instant, &mut Scratch), Inadmissible> {
        let Self { instant, scratch } = self;
        instant.read(model, state.time, state.numbers())?;
        pairs::find_planes(model, instant, scratch)?;
        for index in 0..model.bodies.len() {
            if !model.bodies[index].has_inertia() {
                inertialess::solve_balance(model, instant, scratch, index)?;
            }
        }
        Ok((instant, scratch))
    }
}
