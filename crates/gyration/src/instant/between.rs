//! What springs exert, and what bodies that meet do to each other: the second stage of an instant. Each spring and the
//! plane of each pair are found once, and both bodies have their part of what is exchanged there.

use super::joined::driven;
use super::motions::Motions;
use super::parties::PartyAt;
use super::slabs::{PairGaps, Remembered};
use crate::acting::{PairAt, PairEnd};
use crate::fluid::{SphereLoads, SpheresTouch};
use crate::inadmissible::{FormulaOf, Inadmissible, Quantity};
use crate::joint::{JointLoads, MotorSlopes};
use crate::kinematics::BodyMotion;
use crate::load::{Bond, BondFault, BondLoads, BondPlace, BondSlopes, Interaction, SpringLoads};
use crate::model::{Model, PATIENCE};
use crate::neighbours::Pair;
use crate::pair::{Guess, PairFault, PairLoads, PairScratch, PairSlopes, Side};
use crate::party::Party;
use crate::team::{Rooms, Team, find_each};
use crate::tensor::Vec3;
use gyration_expression::Scratch as FormulaScratch;

/// What springs and the pairs within reach do, these in order of the list.
#[derive(Debug, Clone, Default)]
pub(super) struct Between {
    /// By their place among those within reach; more than there are now, if there were more before.
    pairs: Vec<FoundPair>,
    /// What the springs of the model exert, in their order.
    springs: Vec<SpringLoads>,
    /// What the bonds of the model do, in their order.
    bonds: Vec<BondLoads>,
    /// The derivatives of that; empty where they were not asked for.
    bond_slopes: Vec<BondSlopes>,
    formulas: FormulaScratch,
    /// What the joints of the model do, in their order: their motors, until what keeps them is solved.
    joints: Vec<JointLoads>,
    /// The derivatives of what their motors do; none of one without.
    motor_slopes: Vec<Option<MotorSlopes>>,
    /// What bodies do to one another through the fluid.
    spheres: SphereLoads,
}

/// What a pair within reach does.
#[derive(Debug, Clone, Default)]
struct FoundPair {
    /// None of one that a look at its slab has shown to be out of reach.
    loads: Option<PairLoads>,
    /// The derivatives, or room for them.
    slopes: Option<Box<PairSlopes>>,
    has_slopes: bool,
}

/// Whoever looks at the pairs of an instant.
pub(super) struct Looking<'a> {
    pub model: &'a Model,
    pub motions: &'a Motions,
    pub remembered: &'a mut Remembered,
    pub rooms: Rooms<'a, PairScratch>,
    pub team: Option<Team>,
    pub wanted: Wanted,
    /// The body whose pairs alone are looked at, if it is one.
    pub only: Option<usize>,
}

/// What is asked of pairs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Wanted {
    Loads,
    /// Beside them their derivatives.
    Slopes,
}

/// A pair within reach, and where its plane is looked for first.
struct Looked<'a> {
    pair: &'a Pair,
    parties: &'a [PartyAt<'a>; 2],
    guess: Option<&'a Guess>,
    asked: Wanted,
}

impl Between {
    /// A pair as one of its bodies sees it, given its place among those within reach.
    pub fn pair<'a>(&'a self, end: PairEnd<'a>, place: usize) -> Option<PairAt<'a>> {
        let FoundPair { loads, slopes, has_slopes } = &self.pairs[place];
        Some(PairAt { end, loads: loads.as_ref()?, slopes: slopes.as_deref().filter(|_| *has_slopes) })
    }

    /// What a spring of the model exerts.
    pub fn spring(&self, number: usize) -> &SpringLoads {
        &self.springs[number]
    }

    /// What a bond of the model does.
    pub fn bond(&self, number: usize) -> &BondLoads {
        &self.bonds[number]
    }

    /// The derivatives of what a bond does.
    pub fn bond_slopes(&self, number: usize) -> &BondSlopes {
        &self.bond_slopes[number]
    }

    /// What a joint of the model does.
    pub fn joint(&self, number: usize) -> &JointLoads {
        &self.joints[number]
    }

    /// What bodies do to one another through the fluid.
    pub fn spheres(&self) -> &SphereLoads {
        &self.spheres
    }

    /// Finds the resistance of bodies that feel one another through the fluid, at their places.
    fn place_spheres(&mut self, looking: &Looking) -> Result<(), Inadmissible> {
        let Looking { model, motions, .. } = looking;
        let Some(spheres) = model.spheres() else { return Ok(()) };
        let apart = |[one, other]: [usize; 2]| motions.at(model, other).from(&motions.at(model, one));
        self.spheres.place(spheres, apart).map_err(|SpheresTouch { bodies: [body, other], gap }| {
            let quantity = Quantity::FluidGap { other };
            Inadmissible { body, quantity, value: gap }
        })
    }

    /// Finds what they do at their velocities.
    fn move_spheres(&mut self, looking: &Looking, wanted: Wanted) {
        let Looking { model, motions, .. } = looking;
        let (Some(spheres), Some(fluid)) = (model.spheres(), &model.fluid) else { return };
        let moving = spheres.bodies().iter().map(|body| {
            let at = motions.at(model, *body);
            (&at.motion.placement, &at.motion.velocity, at.inverse())
        });
        let around = (fluid.viscosity, &fluid.flow(motions.time()));
        self.spheres.set_moving(around, moving, wanted == Wanted::Slopes);
    }

    /// Tells what a joint of the model does.
    pub fn set_joint(&mut self, number: usize, loads: JointLoads) {
        self.joints[number] = loads;
    }

    /// Finds what the bonds of an instant do.
    fn find_bonds(&mut self, looking: &Looking) -> Result<(), Inadmissible> {
        let Looking { model, motions, wanted, .. } = looking;
        self.bonds.clear();
        self.bond_slopes.clear();
        for (number, bond) in model.bonds().iter().enumerate() {
            let place = bond_place(model, motions, bond);
            let faulty = |fault| bond_fault(model, motions, number, fault);
            self.bonds.push(bond.loads(&place, &mut self.formulas).map_err(faulty)?);
            if *wanted == Wanted::Slopes {
                self.bond_slopes.push(bond.slopes(&place, &mut self.formulas).map_err(faulty)?);
            }
        }
        Ok(())
    }

    /// Finds what the motors of joints do.
    fn find_motors(&mut self, looking: &Looking) -> Result<(), Inadmissible> {
        self.joints.clear();
        self.motor_slopes.clear();
        let Looking { model, motions, wanted, .. } = looking;
        for number in 0..model.joints().len() {
            let with_slopes = *wanted == Wanted::Slopes;
            let (loads, slopes) = driven(model, motions, number, with_slopes, &mut self.formulas)?;
            self.joints.push(loads);
            self.motor_slopes.push(slopes);
        }
        Ok(())
    }

    /// The derivatives of what the motor of a joint does.
    pub fn motor_slopes(&self, number: usize) -> Option<&MotorSlopes> {
        self.motor_slopes[number].as_ref()
    }

    /// Finds what the springs of an instant exert.
    fn find_springs(&mut self, looking: &Looking) -> Result<(), Inadmissible> {
        let Looking { model, motions, .. } = looking;
        self.springs.clear();
        for number in 0..model.springs().len() {
            self.springs.push(stretched(model, motions, number)?);
        }
        Ok(())
    }

    /// Finds again what the springs of a body exert.
    pub fn find_springs_of(&mut self, body: usize, model: &Model, motions: &Motions) -> Result<(), Inadmissible> {
        for end in model.springs_of(body) {
            self.springs[end.number] = stretched(model, motions, end.number)?;
        }
        Ok(())
    }

    /// Finds what stands between the bodies of an instant.
    pub fn find(&mut self, looking: &mut Looking) -> Result<(), Inadmissible> {
        self.find_springs(looking)?;
        self.find_bonds(looking)?;
        self.find_motors(looking)?;
        self.place_spheres(looking)?;
        self.move_spheres(looking, looking.wanted);
        let count = looking.motions.reached().len();
        if self.pairs.len() < count {
            self.pairs.resize_with(count, FoundPair::default);
        }
        looking.find_reached(&mut self.pairs, |looked, found, room| {
            (found.loads, found.has_slopes) = (None, false);
            if looked.is_out_of_reach() {
                return Ok(());
            }
            found.find(&looked, looked.wanted(), room)
        })
    }

    /// Finds again what pairs do of which a body has no inertia, as far as they feel its velocity or their power is a
    /// work, or that with its derivatives: their planes stay.
    pub fn find_felt(&mut self, looking: &mut Looking, wanted: Wanted) -> Result<(), Inadmissible> {
        // Slopes of the instant stay asked for.
        let asked = if looking.wanted == Wanted::Slopes { Wanted::Slopes } else { wanted };
        self.move_spheres(looking, asked);
        let books = !looking.model.has_potential();
        if !looking.model.rules().all().iter().any(|rule| books || rule.laws.feel_velocities()) {
            return Ok(());
        }
        looking.find_reached(&mut self.pairs, |looked, found, room| {
            if found.has_slopes && looked.feels_balance(books) {
                found.find(&looked, wanted, room)?;
                // Those of the instant stay asked for.
                found.has_slopes = true;
            }
            Ok(())
        })
    }
}

impl FoundPair {
    /// Finds what a pair does, and the derivatives of that where they are wanted.
    fn find(&mut self, looked: &Looked, wanted: Wanted, room: &mut PairScratch) -> Result<(), PairFault> {
        self.loads = Some(match wanted {
            Wanted::Loads => looked.loads(room)?,
            Wanted::Slopes => {
                let slopes = self.slopes.get_or_insert_default();
                looked.find_slopes(slopes, room)?;
                slopes.loads
            }
        });
        self.has_slopes = wanted == Wanted::Slopes;
        Ok(())
    }
}

impl Looked<'_> {
    /// What is to be found: derivatives if they were asked for, or if the balance of a body without inertia needs them.
    fn wanted(&self) -> Wanted {
        if self.is_balanced() { Wanted::Slopes } else { self.asked }
    }

    /// Whether it does nothing, as the plane tells that it had before.
    fn is_out_of_reach(&self) -> bool {
        let Some(guess) = self.guess else { return false };
        with_sides(self.pair, self.parties, |sides| self.pair.form.is_out_of_reach(sides, guess))
    }

    /// Whether one of the two has no inertia.
    fn is_balanced(&self) -> bool {
        self.parties.iter().any(|party| !party.has_inertia())
    }

    /// Whether it feels the velocity of a body without inertia, or `books` the power that this gives.
    fn feels_balance(&self, books: bool) -> bool {
        self.is_balanced() && (books || self.pair.form.laws.feel_velocities())
    }

    fn loads(&self, room: &mut PairScratch) -> Result<PairLoads, PairFault> {
        with_sides(self.pair, self.parties, |sides| PairLoads::integrate(&self.pair.form, sides, self.guess, room))
    }

    fn find_slopes(&self, slopes: &mut PairSlopes, room: &mut PairScratch) -> Result<(), PairFault> {
        with_sides(self.pair, self.parties, |sides| slopes.find(&self.pair.form, sides, self.guess, room))
    }
}

/// Evaluates the formulas of all bonds and motors once, in their order.
pub(super) fn evaluate_formulas(
    model: &Model,
    motions: &Motions,
    formulas: &mut FormulaScratch,
) -> Result<(), Inadmissible> {
    for (number, bond) in model.bonds().iter().enumerate() {
        let loads = bond.loads(&bond_place(model, motions, bond), formulas);
        loads.map_err(|fault| bond_fault(model, motions, number, fault))?;
    }
    (0..model.joints().len()).try_for_each(|number| driven(model, motions, number, false, formulas).map(|_| ()))
}

/// The two bodies of a bond.
fn bond_place<'a>(model: &'a Model, motions: &'a Motions, bond: &Bond) -> BondPlace<'a> {
    let bodies = bond.bodies.map(|body| motions.at(model, body));
    BondPlace {
        motions: [bodies[0].motion, bodies[1].motion],
        inverses: [bodies[0].inverse(), bodies[1].inverse()],
        turn: [!bodies[0].body.is_point(), !bodies[1].body.is_point()],
        shift: model.lattice.place(bond.cell),
        time: motions.time(),
    }
}

/// A state outside the model, for what became of a bond.
fn bond_fault(model: &Model, motions: &Motions, number: usize, fault: BondFault) -> Inadmissible {
    let first = motions.at(model, model.bonds()[number].bodies[0]);
    match fault {
        BondFault::NoLength => first.outside(Quantity::BondLength { bond: number }, 0.0),
        BondFault::Undefined(undefined) => {
            let of = FormulaOf::Bond(number);
            first.outside(Quantity::Formula { of, undefined }, undefined.argument)
        }
    }
}

/// What a spring exerts.
fn stretched(model: &Model, motions: &Motions, number: usize) -> Result<SpringLoads, Inadmissible> {
    let spring = &model.springs()[number];
    spring.loads(&model.lattice, motions.time(), |body| motions.motion(body)).map_err(|length| {
        let body = spring.parties()[0].body().unwrap_or_default();
        Inadmissible { body, quantity: Quantity::SpringLength { spring: number }, value: length }
    })
}

/// Finds the slabs between the bodies of all listed pairs.
pub(super) fn find_slabs(looking: &mut Looking, slabs: &mut PairGaps) -> Result<(), Inadmissible> {
    let slabs = slabs.begin(looking.motions.near());
    looking.find_pairs(
        slabs,
        |number| number,
        |looked, slab, room| {
            let Some(Looked { pair, parties, guess, .. }) = looked else { return Ok(()) };
            *slab = with_sides(pair, parties, |sides| pair.form.gap(sides, guess, room))?;
            Ok(())
        },
    )
}

impl Looking<'_> {
    /// Finds what is asked of the pairs within reach, by their places among these.
    fn find_reached<T: Send>(
        &mut self,
        found: &mut [T],
        find: impl Fn(Looked, &mut T, &mut PairScratch) -> Result<(), PairFault> + Sync,
    ) -> Result<(), Inadmissible> {
        let reached = self.motions.reached();
        self.find_pairs(
            &mut found[..reached.len()],
            |place| reached[place],
            |looked, found, room| looked.map_or(Ok(()), |looked| find(looked, found, room)),
        )
    }

    /// Finds what is asked of listed pairs, given the number of each; none is looked at that is out of reach, or of
    /// other bodies.
    fn find_pairs<T: Send>(
        &mut self,
        found: &mut [T],
        number: impl Fn(usize) -> usize + Sync,
        find: impl Fn(Option<Looked>, &mut T, &mut PairScratch) -> Result<(), PairFault> + Sync,
    ) -> Result<(), Inadmissible> {
        let Self { model, motions, remembered, rooms, team, wanted, only } = self;
        let pairs = motions.near().pairs();
        remembered.find(pairs);
        let remembered = &**remembered;
        find_each(*team, found, rooms.lend(), |index, found, room| {
            let number = number(index);
            let pair = &pairs.all()[number];
            if (index + 1).is_multiple_of(PATIENCE) && model.is_given_up() {
                return Err(Inadmissible { body: first(pair), quantity: Quantity::Interruption, value: f64::NAN });
            }
            let parties = motions.parties(model, pair);
            let guess = remembered.guess(number, motions.time());
            let looked = Looked { pair, parties: &parties, guess: guess.as_ref(), asked: *wanted };
            let is_asked = only.is_none_or(|body| pair.parties.contains(&Party::Body(body)));
            let looked = motions.place(number).filter(|_| is_asked).map(|_| looked);
            find(looked, found, room).map_err(|fault| outside(pair, fault))
        })
    }
}

/// The body of a pair that stands first.
fn first(pair: &Pair) -> usize {
    pair.parties[0].body().unwrap_or_else(|| unreachable!("a body stands first in a pair"))
}

/// A state outside the model, for what became of a plane.
pub(crate) fn outside(pair: &Pair, fault: PairFault) -> Inadmissible {
    let (other, rule) = (pair.parties[1], pair.rule);
    let (quantity, value) = match fault {
        PairFault::Overlap { gap } => (Quantity::PairGap { other, rule }, gap),
        PairFault::NotFound { decrement } => (Quantity::PairPlane { other, rule }, decrement),
        PairFault::Singular(_) => (Quantity::PairPlane { other, rule }, f64::NAN),
    };
    Inadmissible { body: first(pair), quantity, value }
}

/// Hands the two sides of a pair to `each`.
pub(crate) fn with_sides<T>(pair: &Pair, parties: &[PartyAt; 2], each: impl FnOnce([&Side; 2]) -> T) -> T {
    let apart = PartyAt::apart(parties, pair.cell);
    let [one, other] = [0, 1].map(|end| {
        let party = &parties[end];
        let BodyMotion { placement, velocity } = party.motion();
        Side {
            surface: party.solid().part(pair.parts[end]),
            placement,
            from_first: if end == 0 { Vec3::zeros() } else { apart },
            velocity,
            inverse: party.inverse(),
            deformation: party.deformation(),
            least_gap: party.least_distance(apart.norm()),
        }
    });
    each([&one, &other])
}
