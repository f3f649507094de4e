//! A model at an instant, in two stages that each evaluation goes through once: the motion of every body, then what
//! bodies do to each other. Rates, Jacobian, rows and events look at both.
//!
//! An [`Instant`] lends what both stages found at one time and state. The next one is read into the same memory, so
//! that the compiler refuses to ask an instant behind its end.
//!
//! | file      | what                                                                          |
//! |-----------|-------------------------------------------------------------------------------|
//! | `motions` | places, velocities and what each kind of body needs of them; who is within reach |
//! | `parties` | the two of a pair, with their motions                                       |
//! | `between` | what springs and the pairs within reach do: loads, their derivatives           |
//! | `joined`  | what the motors of joints do                                                   |
//! | `slabs`   | the slabs between bodies, and those from which planes are looked for           |

mod between;
mod joined;
mod motions;
mod parties;
mod slabs;

pub(crate) use between::{outside, with_sides};
pub(crate) use motions::KindAt;
pub use motions::MotionAt;
pub(crate) use parties::PartyAt;
pub use slabs::PairGaps;

use crate::acting::{Load, PairAt, PairEnd};
use crate::body::Slots;
use crate::extended::Numbers;
use crate::fluid::SphereLoads;
use crate::inadmissible::Inadmissible;
use crate::joint::{JointEnd, JointLoads, MotorSlopes};
use crate::lattice::{Cell, HERE};
use crate::load::{BondEnd, BondLoads, BondSlopes, SpringEnd, SpringLoads};
use crate::model::Model;
use crate::pair::PairScratch;
use crate::team::{Rooms, Team};
use crate::tensor::Vec3;
use between::{Between, Looking, Wanted};
use gyration_expression::Scratch as FormulaScratch;
pub(crate) use joined::{jet, second};
pub(crate) use motions::Motions;
use slabs::Remembered;
use std::ops::Deref;

/// A model at a time and state.
#[derive(Debug)]
pub struct Instant<'a> {
    model: &'a Model,
    motions: &'a mut Motions,
    between: &'a mut Between,
    remembered: &'a mut Remembered,
    rooms: Rooms<'a, PairScratch>,
    team: Option<Team>,
    wanted: Wanted,
}

/// A body of a model at an instant: all that its loads and its balance are computed from.
#[derive(Debug, Clone, Copy)]
pub struct BodyAt<'a> {
    moving: MotionAt<'a>,
    between: &'a Between,
}

/// The memory of instants, one after the other.
#[derive(Debug, Clone, Default)]
pub(crate) struct Instants {
    motions: Motions,
    between: Between,
    slabs: PairGaps,
    remembered: Remembered,
    room: PairScratch,
    /// More of that, for a team.
    rooms: Vec<PairScratch>,
    /// Who finds what stands between bodies.
    pub team: Option<Team>,
}

impl Instants {
    /// Reads a state; bodies without inertia are taken to be still.
    ///
    /// # Errors
    /// [`Inadmissible`] where det P ≤ 0 or det G ≤ 0, or where no plane separates two bodies.
    pub fn read<'a>(&'a mut self, model: &'a Model, time: f64, state: Numbers) -> Result<Instant<'a>, Inadmissible> {
        self.motions.read(model, time, state)?;
        let Self { motions, between, remembered, room, rooms, team, .. } = self;
        let rooms = Rooms { own: room, others: rooms };
        Instant { model, motions, between, remembered, rooms, team: *team, wanted: Wanted::Loads }.found()
    }

    /// The same for one body: what pairs do that it has no part in is left out. All bodies have inertia.
    ///
    /// # Errors
    /// Those of [`Instants::read`].
    pub fn read_of<'a>(
        &'a mut self,
        (model, body): (&'a Model, usize),
        time: f64,
        state: Numbers,
    ) -> Result<Instant<'a>, Inadmissible> {
        debug_assert!(model.inertialess().is_empty(), "their velocities follow from all that acts on them");
        self.motions.read(model, time, state)?;
        let Self { motions, between, remembered, room, rooms, team, .. } = self;
        let mut rooms = Rooms { own: room, others: rooms };
        let (wanted, only) = (Wanted::Loads, Some(body));
        let mut looking = Looking { model, motions, remembered, rooms: rooms.lend(), team: *team, wanted, only };
        between.find(&mut looking)?;
        Ok(Instant { model, motions, between, remembered, rooms, team: *team, wanted })
    }

    /// The same with the derivatives of what pairs do.
    ///
    /// # Errors
    /// Those of [`Instants::read`].
    pub fn differentiate<'a>(
        &'a mut self,
        model: &'a Model,
        time: f64,
        state: Numbers,
    ) -> Result<Instant<'a>, Inadmissible> {
        self.motions.read(model, time, state)?;
        let Self { motions, between, remembered, room, rooms, team, .. } = self;
        let rooms = Rooms { own: room, others: rooms };
        Instant { model, motions, between, remembered, rooms, team: *team, wanted: Wanted::Slopes }.found()
    }

    /// How the bodies move in a state, those without inertia taken to be still; not what is between them.
    ///
    /// # Errors
    /// [`Inadmissible`] where det P ≤ 0 or det G ≤ 0.
    pub fn motions(&mut self, model: &Model, time: f64, state: Numbers) -> Result<&Motions, Inadmissible> {
        self.motions.read(model, time, state)?;
        Ok(&self.motions)
    }

    /// The slab between the bodies of each listed pair; infinite where they are out of reach. Bodies without inertia
    /// move as `balance` makes them.
    ///
    /// # Errors
    /// [`Inadmissible`] if no plane separates two of them.
    pub fn slabs(
        &mut self,
        model: &Model,
        time: f64,
        state: Numbers,
        balance: impl FnOnce(Instant) -> Result<(), Inadmissible>,
    ) -> Result<&PairGaps, Inadmissible> {
        self.find_slabs((model, None), time, state, balance)
    }

    /// The same of the pairs of one body; those of all others are left infinite.
    ///
    /// # Errors
    /// [`Inadmissible`] if no plane separates it from another.
    pub fn slabs_of(
        &mut self,
        (model, body): (&Model, usize),
        time: f64,
        state: Numbers,
        balance: impl FnOnce(Instant) -> Result<(), Inadmissible>,
    ) -> Result<&PairGaps, Inadmissible> {
        self.find_slabs((model, Some(body)), time, state, balance)
    }

    fn find_slabs(
        &mut self,
        (model, only): (&Model, Option<usize>),
        time: f64,
        state: Numbers,
        balance: impl FnOnce(Instant) -> Result<(), Inadmissible>,
    ) -> Result<&PairGaps, Inadmissible> {
        if model.rules().is_empty() {
            self.slabs.become_empty();
            return Ok(&self.slabs);
        }
        self.slabs.clear();
        if model.inertialess().is_empty() {
            self.motions.read(model, time, state)?;
        } else {
            balance(self.read(model, time, state)?)?;
        }
        let Self { motions, slabs, remembered, room, rooms, team, .. } = self;
        let rooms = Rooms { own: room, others: rooms };
        let mut looking = Looking { model, motions, remembered, rooms, team: *team, wanted: Wanted::Loads, only };
        between::find_slabs(&mut looking, slabs)?;
        Ok(slabs)
    }

    /// The same as if nothing were known, and from then on planes are looked for where they are then.
    ///
    /// # Errors
    /// [`Inadmissible`] if no plane separates two of them; nothing is remembered then.
    pub fn remember(
        &mut self,
        model: &Model,
        time: f64,
        state: Numbers,
        balance: impl FnOnce(Instant) -> Result<(), Inadmissible>,
    ) -> Result<&PairGaps, Inadmissible> {
        self.remembered.forget();
        self.slabs(model, time, state, balance)?;
        Ok(self.remembered.keep(time, &mut self.slabs))
    }

    /// The slabs that were found last, infinite of pairs that nobody has looked at; none once they are remembered.
    pub fn found(&self) -> &PairGaps {
        &self.slabs
    }

    /// The slabs from which planes are looked for; none where none are remembered.
    pub fn remembered(&self) -> Option<&PairGaps> {
        self.remembered.slabs()
    }
}

impl Instant<'_> {
    /// With what stands between bodies found.
    fn found(mut self) -> Result<Self, Inadmissible> {
        let (between, mut looking) = self.looking();
        between.find(&mut looking)?;
        Ok(self)
    }

    /// What stands between bodies, and whoever looks for it.
    fn looking(&mut self) -> (&mut Between, Looking<'_>) {
        let Self { model, motions, between, remembered, rooms, team, wanted } = self;
        (between, Looking { model, motions, remembered, rooms: rooms.lend(), team: *team, wanted: *wanted, only: None })
    }

    /// Finds again what pairs do that feel the velocities of bodies without inertia.
    ///
    /// # Errors
    /// [`Inadmissible`] if no plane separates two bodies.
    pub(crate) fn find_felt_pairs(&mut self) -> Result<(), Inadmissible> {
        let wanted = self.wanted;
        self.find_felt(wanted)
    }

    /// The same with the derivatives by which a balance is found.
    ///
    /// # Errors
    /// As there.
    pub(crate) fn differentiate_felt_pairs(&mut self) -> Result<(), Inadmissible> {
        self.find_felt(Wanted::Slopes)
    }

    fn find_felt(&mut self, wanted: Wanted) -> Result<(), Inadmissible> {
        let (between, mut looking) = self.looking();
        between.find_felt(&mut looking, wanted)
    }

    /// The model.
    pub fn model(&self) -> &Model {
        self.model
    }

    /// A body.
    #[inline]
    pub fn at(&self, index: usize) -> BodyAt<'_> {
        BodyAt { moving: self.motions.at(self.model, index), between: self.between }
    }

    /// The pairs (i, j) of bodies of which j acts on i at this instant, in order of i; some come twice.
    pub fn joins(&self) -> impl Iterator<Item = (usize, usize)> {
        (0..self.model.bodies.len()).flat_map(|body| self.partners(body).map(move |other| (body, other)))
    }

    /// The bodies that act on a body at this instant; some come twice.
    pub(crate) fn partners(&self, body: usize) -> impl Iterator<Item = usize> {
        let springs = self.model.springs_of(body).filter_map(|end| end.other().body());
        let bonds = self.model.bonds_of(body).map(|end| end.other_body());
        let joints = self.model.joints_of(body).filter_map(|end| end.other().body());
        // A body is beside its own images, which say nothing of another.
        springs
            .chain(bonds)
            .chain(joints)
            .filter(move |other| *other != body)
            .chain(self.at(body).pairs().filter(|pair| pair.acts()).filter_map(|pair| pair.other_body()))
            .chain(self.model.felt_in_fluid(body))
    }

    /// What springs, bonds and pairs do across cells: the cell of the second party as seen from that of the first, and
    /// the force on the first [N]. To be asked now and then: it allocates.
    pub fn across_cells(&self) -> Vec<(Cell, Vec3)> {
        let springs = self.model.springs().iter().enumerate();
        let springs = springs.map(|(number, spring)| (spring.cell, self.between.spring(number).force));
        let bonds = self.model.bonds().iter().enumerate();
        let bonds = bonds.map(|(number, bond)| (bond.cell, self.between.bond(number).on[0].force));
        let bodies = 0..self.model.bodies.len();
        let pairs = bodies.flat_map(|body| self.at(body).pairs().filter(|pair| pair.end.counts()));
        let pairs = pairs.map(|pair| (pair.end.interaction.cell, pair.on_body().force));
        springs.chain(bonds).chain(pairs).filter(|(cell, _)| *cell != HERE).collect()
    }

    /// Evaluates the formulas of all bonds and motors once more, in their order.
    ///
    /// # Errors
    /// [`Inadmissible`] where one is undefined.
    pub(crate) fn evaluate_formulas(&self, formulas: &mut FormulaScratch) -> Result<(), Inadmissible> {
        between::evaluate_formulas(self.model, self.motions, formulas)
    }

    /// Tells what a joint of the model does.
    pub(crate) fn set_joint(&mut self, number: usize, loads: JointLoads) {
        self.between.set_joint(number, loads);
    }

    /// What a joint of the model does.
    pub(crate) fn joint(&self, number: usize) -> &JointLoads {
        self.between.joint(number)
    }

    /// Whether derivatives were asked for.
    pub(crate) fn has_slopes(&self) -> bool {
        self.wanted == Wanted::Slopes
    }

    /// How the bodies move.
    pub(crate) fn motions(&self) -> &Motions {
        self.motions
    }

    /// The numbers that were read.
    pub(crate) fn state(&self) -> &[f64] {
        self.motions.state()
    }

    /// Gives a body without inertia its motion, from numbers of its own; its springs are found again, but not yet what
    /// its pairs do ([`Instant::find_felt_pairs`]).
    ///
    /// # Errors
    /// [`Inadmissible`] where det P ≤ 0 or det G ≤ 0, or a spring has no length.
    pub(crate) fn set_motion(&mut self, index: usize, slots: &Slots, numbers: &[f64]) -> Result<(), Inadmissible> {
        let body = &self.model.bodies[index];
        debug_assert!(!body.has_inertia());
        self.motions.read_body(body, index, slots, numbers)?;
        self.between.find_springs_of(index, self.model, self.motions)
    }
}

impl<'a> Deref for BodyAt<'a> {
    type Target = MotionAt<'a>;

    #[inline]
    fn deref(&self) -> &MotionAt<'a> {
        &self.moving
    }
}

impl<'a> BodyAt<'a> {
    /// Hands what acts on it to `each`.
    #[inline]
    pub fn try_each_load<E>(&self, each: impl FnMut(Load<'a>) -> Result<(), E>) -> Result<(), E> {
        self.moving.model.try_each_load_with(self.moving.index, self.pairs(), each)
    }

    /// What a spring of the model exerts.
    pub(crate) fn spring(&self, end: &SpringEnd) -> &'a SpringLoads {
        self.between.spring(end.number)
    }

    /// What a bond of the model does.
    pub(crate) fn bond(&self, end: &BondEnd) -> &'a BondLoads {
        self.between.bond(end.number)
    }

    /// What a joint of the model does.
    pub(crate) fn joint(&self, end: &JointEnd) -> &'a JointLoads {
        self.between.joint(end.number)
    }

    /// The derivatives of what its motor does, at an instant of which they were asked; none without one.
    pub(crate) fn motor_slopes(&self, end: &JointEnd) -> Option<&'a MotorSlopes> {
        self.between.motor_slopes(end.number)
    }

    /// What bodies do to one another through the fluid.
    pub(crate) fn spheres(&self) -> &'a SphereLoads {
        self.between.spheres()
    }

    /// What a bond of this number does.
    pub fn bond_loads(&self, number: usize) -> &'a BondLoads {
        self.between.bond(number)
    }

    /// The derivatives of that, at an instant of which they were asked.
    pub(crate) fn bond_slopes(&self, end: &BondEnd) -> &'a BondSlopes {
        self.between.bond_slopes(end.number)
    }

    /// The pairs of which it is one, but those that are known to be out of reach.
    pub(crate) fn pairs(&self) -> impl Iterator<Item = PairAt<'a>> + use<'a> {
        let own = *self;
        own.near().pairs().of(own.index).filter_map(move |end| own.pair(&end))
    }

    /// A listed pair of which it is one; none that is known to be out of reach.
    pub(crate) fn pair(&self, end: &PairEnd<'a>) -> Option<PairAt<'a>> {
        let Self { moving, between } = *self;
        between.pair(*end, moving.place(end)?)
    }
}
