//! Bonds between bodies.

use super::body::{AssembledBody, lever};
use super::context::SceneContext;
use super::lattice::{Cells, check_cell};
use super::own::{accepted, constants};
use super::start::placement;
use super::unit::Unit;
use crate::check::{PartialScene, Placed, Reporter};
use crate::file::{self, BondDamping, OneOrMany};
use crate::key::Key;
use crate::quantity::{AnyQuantity, si};
use gyration::kinematics::{BodyMotion, Placement, Velocity};
use gyration::lattice::HERE;
use gyration::load::{
    Bond, BondAxes, BondFault, BondLaw, BondPlace, BondStiffness, DISTANCE_NAMES, Dashpot, INVARIANT_NAMES,
    InvariantPotential, Stiffness6,
};
use gyration::tensor::{Mat3, Vec3};
use gyration_expression::{Expression, Scratch};
use std::collections::HashMap;
use std::sync::Arc;

/// Eigenvalues below zero by this part of the largest are rounding.
const SEMIDEFINITE: f64 = 1e-12;
/// Two directions whose cosine differs from one by less are one.
const PARALLEL: f64 = 1e-12;

/// The units of a stiffness: of places, of places by turns, of turns.
const OF_STIFFNESS: [Unit; 3] = [Unit::FORCE_PER_LENGTH, Unit::FORCE_PER_ANGLE, Unit::TORQUE_PER_ANGLE];
/// Those of a damping.
const OF_DAMPING: [Unit; 3] = [Unit::FORCE_PER_VELOCITY, Unit::FORCE_PER_RATE, Unit::TORQUE_PER_RATE];

/// The bonds; notes what is wrong with them.
pub(super) fn bonds(
    partial: &PartialScene,
    assembled: &[Option<AssembledBody>],
    cells: Option<&Cells>,
    context: &SceneContext,
    reporter: &mut Reporter<'_>,
) -> Vec<Bond> {
    let name = |(index, body): (usize, &Option<AssembledBody>)| Some((body.as_ref()?.name.clone(), index));
    let named: HashMap<String, usize> = assembled.iter().enumerate().filter_map(name).collect();
    let bond = |placed: &Placed<file::Bond>| {
        let [Some(&one), Some(&other)] = placed.value.between.each_ref().map(|name| named.get(name)) else {
            return None;
        };
        let bodies = [one, other];
        let [Some(one), Some(other)] = bodies.map(|body| assembled[body].as_ref()) else { return None };
        Written { placed, bodies, assembled: [one, other] }.bond(cells, context, reporter)
    };
    partial.bonds.iter().filter_map(bond).collect()
}

/// A bond as it is written, and its bodies.
struct Written<'a> {
    placed: &'a Placed<file::Bond>,
    bodies: [usize; 2],
    assembled: [&'a AssembledBody; 2],
}

impl Written<'_> {
    fn bond(&self, cells: Option<&Cells>, context: &SceneContext, reporter: &mut Reporter<'_>) -> Option<Bond> {
        let Placed { key, value, .. } = self.placed;
        let cell = value.cell.map_or(HERE, |cell| cell.map(|n| n.0 as i32));
        if cell != HERE && !check_cell(cell, cells, &key.key("cell"), reporter) {
            return None;
        }
        if self.bodies[0] == self.bodies[1] && cell == HERE {
            return None;
        }
        let points: [Vec3; 2] = value.points.each_ref().map(si);
        for (end, body) in self.assembled.iter().enumerate() {
            if body.body.is_point() {
                lever(&points[end], &key.key("points").index(end), reporter);
            }
            if !body.body.has_inertia() {
                let message = format!("\"{}\" has no inertia: this version has no bonds of such bodies", body.name);
                reporter.note(&key.key("between").index(end), message, "use a spring, or let the body have inertia");
                return None;
            }
        }
        let laws = [
            ("law", value.law.is_some()),
            ("potential", value.potential.is_some()),
            ("stiffness", value.stiffness.is_some()),
        ];
        let given: Vec<&str> = laws.iter().filter(|(_, is_given)| *is_given).map(|(name, _)| *name).collect();
        if given.len() > 1 || (given.is_empty() && value.damping.is_none()) {
            let message = match &given[..] {
                [] => "it has none of `law`, `potential`, `stiffness` and `damping`".to_owned(),
                several => format!("it has {} of `law`, `potential` and `stiffness`", several.len()),
            };
            reporter.note(key, message, "keep one of `law`, `potential` and `stiffness`, or `damping` alone");
            return None;
        }
        let has_axes = value.stiffness.is_some() || matches!(value.damping, Some(BondDamping::Matrix(_)));
        if value.axes.is_some() && !has_axes {
            let message = "`axes` are those of `stiffness` and of a 6×6 `damping`, and this bond has neither";
            reporter.note(&key.key("axes"), message, "leave them out");
            return None;
        }
        let shift = cells.map_or_else(Vec3::zeros, |cells| cells.lattice.place(cell));
        let placements = self.assembled.map(|body| placement(&body.start));
        let apart = placements[1].place(&points[1]) + shift - placements[0].place(&points[0]);
        let axes = match has_axes {
            true => Some(self.axes(&placements, &apart, &shift, reporter)?),
            false => None,
        };
        let law = self.law(axes.as_ref(), context, reporter)?;
        let damping = self.damping(axes.as_ref(), reporter)?;
        let bond = Bond { bodies: self.bodies, points, cell, law, damping };
        self.check_start(&bond, &placements, shift, reporter).then_some(bond)
    }

    /// The potential, if there is one.
    fn law(
        &self,
        axes: Option<&BondAxes>,
        context: &SceneContext,
        reporter: &mut Reporter<'_>,
    ) -> Option<Option<BondLaw>> {
        let Placed { key, value, .. } = self.placed;
        if let Some(text) = &value.law {
            let constants = self.constants(&DISTANCE_NAMES, context, reporter)?;
            let read = Expression::parse(text, &DISTANCE_NAMES, &constants);
            let read = accepted(read, (&key.key("law"), text), reporter)?.holding(&[1]);
            return Some(Some(BondLaw::Distance(Arc::new(read))));
        }
        if let Some(text) = &value.potential {
            let constants = self.constants(&INVARIANT_NAMES, context, reporter)?;
            let read = InvariantPotential::parse(text, &constants);
            let read = accepted(read, (&key.key("potential"), text), reporter)?;
            return Some(Some(BondLaw::Invariants(Arc::new(read))));
        }
        let Some(written) = &value.stiffness else { return Some(None) };
        let matrix = matrix(written, (&key.key("stiffness"), &OF_STIFFNESS), reporter)?;
        let axes = axes?.clone();
        Some(Some(BondLaw::Stiffness(Arc::new(BondStiffness { axes, matrix }))))
    }

    fn damping(&self, axes: Option<&BondAxes>, reporter: &mut Reporter<'_>) -> Option<Option<Dashpot>> {
        let Placed { key, value, .. } = self.placed;
        Some(match &value.damping {
            None => None,
            Some(BondDamping::Number(c)) if c.value() == 0.0 => None,
            Some(BondDamping::Number(c)) => Some(Dashpot::Vector(c.value())),
            Some(BondDamping::Matrix(rows)) => {
                let rows = OneOrMany::Many(rows.to_vec());
                let matrix = matrix(&rows, (&key.key("damping"), &OF_DAMPING), reporter)?;
                Some(Dashpot::Matrix(Arc::new((axes?.clone(), matrix))))
            }
        })
    }

    /// The axes of stiffness and damping: as they are written, or from centre to centre and the space axis least along
    /// that.
    fn axes(
        &self,
        placements: &[Placement; 2],
        apart: &Vec3,
        shift: &Vec3,
        reporter: &mut Reporter<'_>,
    ) -> Option<BondAxes> {
        let Placed { key, value, .. } = self.placed;
        let key = key.key("axes");
        let (first, second) = match value.axes {
            Some([first, second]) => (Vec3::from(first), Vec3::from(second)),
            None => {
                let between = placements[1].position + shift - placements[0].position;
                // Of space axes that are as much along it the first counts.
                let along = between.abs();
                let least = (0..3).fold(0, |least, k| if along[k] < along[least] { k } else { least });
                (between, Vec3::ith(least, 1.0))
            }
        };
        let Some(axis) = first.try_normalize(0.0) else {
            reporter.note(&key, "the axis has no direction", "write the direction of the bond, and one across it");
            return None;
        };
        let across = second - axis * axis.dot(&second);
        let Some(across) = across.try_normalize(PARALLEL * second.norm()) else {
            reporter.note(&key, "the two directions are one", "write a second direction across the first");
            return None;
        };
        let axes = Mat3::from_columns(&[axis, across, axis.cross(&across)]);
        Some(BondAxes::new(&axes, placements.each_ref(), apart))
    }

    /// The constants of its expressions: its own, then those of the scene.
    fn constants(
        &self,
        variables: &[&str],
        context: &SceneContext,
        reporter: &mut Reporter<'_>,
    ) -> Option<Vec<(String, f64)>> {
        let Placed { key, value, .. } = self.placed;
        constants((key.key("constants"), value.constants.as_ref()), context, variables, reporter)
    }

    /// Whether it has loads and derivatives at the start; notes why not.
    fn check_start(&self, bond: &Bond, placements: &[Placement; 2], shift: Vec3, reporter: &mut Reporter<'_>) -> bool {
        let Placed { key, value, .. } = self.placed;
        let still = Velocity { velocity: Vec3::zeros(), gradient_rate: Mat3::zeros() };
        let motions = placements.map(|placement| BodyMotion { placement, velocity: still });
        let place = BondPlace {
            motions: motions.each_ref(),
            inverses: placements.map(|it| it.gradient.try_inverse().unwrap_or_else(Mat3::identity)),
            turn: self.assembled.map(|body| !body.body.is_point()),
            shift,
            time: 0.0,
        };
        let Err(fault) = bond.slopes(&place, &mut Scratch::default()) else { return true };
        let key = key.key(if value.law.is_some() { "law" } else { "potential" });
        match fault {
            BondFault::NoLength => {
                let message = "both points are at one place, where V has no derivative";
                reporter.note(&key, message, "move a point, or write a law with V′ = 0 at l = 0");
            }
            BondFault::Undefined(undefined) => {
                let help = "move a body, or write an expression that is smooth there";
                reporter.note(&key, format!("at the start {undefined}"), help);
            }
        }
        false
    }
}

/// A symmetric matrix that is not negative, whose entries have these units.
fn matrix(
    written: &OneOrMany<[AnyQuantity; 6]>,
    (key, units): (&Key, &[Unit; 3]),
    reporter: &mut Reporter<'_>,
) -> Option<Stiffness6> {
    // Of an entry i, j, or of one on the diagonal.
    let turns = |index: usize| usize::from(index >= 3);
    let mut is_right = |key: &Key, turns: usize| units[turns].is_of_all(key, "bond", reporter);
    let wrong = match written {
        OneOrMany::One(_) => (0..6).filter(|i| !is_right(&key.index(*i), 2 * turns(*i))).count(),
        OneOrMany::Many(rows) => {
            let entries = (0..rows.len()).flat_map(|i| (0..6).map(move |j| (i, j)));
            entries.filter(|(i, j)| !is_right(&key.index(*i).index(*j), turns(*i) + turns(*j))).count()
        }
    };
    if wrong > 0 {
        return None;
    }
    let matrix = match written {
        OneOrMany::One(diagonal) => Stiffness6::from_diagonal(&nalgebra::SVector::from(diagonal.map(|entry| entry.0))),
        OneOrMany::Many(rows) if rows.len() == 6 => Stiffness6::from_fn(|i, j| rows[i][j].0),
        OneOrMany::Many(rows) => {
            let message = format!("it has {} rows", rows.len());
            reporter.note(key, message, "write six numbers, or six rows of six");
            return None;
        }
    };
    let largest = matrix.amax();
    if (matrix - matrix.transpose()).amax() > SEMIDEFINITE * largest {
        reporter.note(key, "the matrix is not symmetric", "let each pair of entries be equal");
        return None;
    }
    let least = matrix.symmetric_eigenvalues().min();
    if least < -SEMIDEFINITE * largest {
        let message = format!("the matrix is not positive semidefinite: it has the eigenvalue {least:e}");
        reporter.note(key, message, "write one without negative eigenvalues");
        return None;
    }
    Some(matrix)
}
