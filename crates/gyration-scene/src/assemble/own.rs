//! The forces that a body has of its own, read from expressions.

use super::affine::{accepted as accepted_matrix, frame, square};
use super::context::SceneContext;
use crate::check::{Placed, Reporter};
use crate::file::{Body, Entry, LinearFriction};
use crate::key::Key;
use crate::quantity::{AnyQuantity, si};
use gyration::kinematics::Placement;
use gyration::load::{
    BodyForce, FieldOfForce, Formula, FrictionEntry, FrictionMatrix, LinearResistance, LoadSlopes, OwnForces,
    OwnFriction, PLACE_NAMES, PointForce, Potential,
};
use gyration::shape::Shape;
use gyration::tensor::Vec3;
use gyration_expression::{ParseError, Scratch, check_constants};
use std::collections::BTreeMap;
use std::fmt::Display;

/// The forces of a body's own, before it is known where it starts.
#[derive(Debug, Clone)]
pub(super) struct OwnForcesWritten {
    /// All but the force per volume, which needs the shape.
    forces: OwnForces,
    /// Keys of the frictions.
    frictions: Vec<Key>,
    field: Option<FieldOfForce>,
    body: Key,
    has_shape: bool,
}

impl OwnForcesWritten {
    /// Reads them; notes expressions that are none, and constants that cannot be named so.
    pub(super) fn of(placed: &Placed<Body>, context: &SceneContext, reporter: &mut Reporter<'_>) -> Option<Self> {
        let Placed { key, value, .. } = placed;
        // Constants of the scene that are not well formed have been noted.
        let own = (key.key("constants"), value.constants.as_deref());
        let mut reader = Reader { constants: constants(own, context, &PLACE_NAMES, reporter)?, reporter, fails: false };
        let potential = value.potential.as_ref().and_then(|text| {
            let read = Potential::parse(text, &reader.constants);
            reader.accepted(read, &key.key("potential"), text).map(Box::new)
        });
        let field = value.body_force.as_ref().and_then(|entries| reader.field(entries, &key.key("body_force")));
        let mut point_forces = Vec::new();
        for (index, written) in value.force.iter().enumerate() {
            let field = reader.field(&written.value, &key.key("force").index(index).key("value"));
            point_forces.extend(field.map(|field| PointForce { point: si(&written.point), field }));
        }
        let resistance = value.linear_friction.as_ref().and_then(|written| {
            let matrix = written.constant()?;
            let made = LinearResistance::friction(&square(&matrix), frame(written.frame));
            let made = accepted_matrix(made, &key.key("linear_friction").key("matrix"), reader.reporter);
            reader.fails |= made.is_none();
            made.map(Box::new)
        });
        let of_kind = value
            .deformable()
            .and_then(|(name, affine)| Some((key.key(name).key("linear_friction"), affine.linear_friction.as_ref()?)));
        let of_body = value.linear_friction.as_ref().map(|it| (key.key("linear_friction"), &**it));
        let (mut frictions, mut keys) = (Vec::new(), Vec::new());
        for (key, written) in of_kind.into_iter().chain(of_body).filter(|(_, it)| it.constant().is_none()) {
            frictions.extend(reader.friction(written, &key));
            keys.push(key);
        }
        if reader.fails {
            return None;
        }
        let forces = OwnForces { potential, point_forces, resistance, frictions, ..OwnForces::default() };
        Some(Self { forces, frictions: keys, field, body: key.clone(), has_shape: value.shape.is_some() })
    }

    /// The forces of a body of this shape and centre of mass that starts at a place; notes those that are not defined
    /// there.
    pub(super) fn at(
        self,
        place: &Placement,
        (shape, center): (&Shape, &Vec3),
        reporter: &mut Reporter<'_>,
    ) -> Option<OwnForces> {
        let Self { mut forces, frictions, field, body, has_shape } = self;
        let scratch = &mut Scratch::default();
        if let Some(potential) = &forces.potential {
            defined(potential.loads(place, 0.0, scratch), &body.key("potential"), reporter)?;
        }
        for (index, force) in forces.point_forces.iter().enumerate() {
            let key = body.key("force").index(index).key("value");
            let found = LoadSlopes::default().add_point_force(force, place, 0.0, scratch);
            defined(found, &key, reporter)?;
        }
        for (friction, key) in forces.frictions.iter().zip(&frictions) {
            defined(friction.check(place, 0.0, scratch), key, reporter)?;
        }
        if let Some(field) = field {
            let key = body.key("body_force");
            if !has_shape {
                let help = "add a `shape`, or write a `potential` instead";
                reporter.note(&key, "the body has no shape over which a force per volume could act", help);
                return None;
            }
            let made = BodyForce::new(field, shape, center, (place, 0.0));
            forces.body_force = Some(Box::new(defined(made, &key, reporter)?));
        }
        Some(forces)
    }
}

/// Reader of the expressions of a body.
struct Reader<'a, 'b> {
    constants: Vec<(String, f64)>,
    reporter: &'a mut Reporter<'b>,
    /// True once one of them is none.
    fails: bool,
}

impl Reader<'_, '_> {
    /// Result of an expression, if it parses.
    fn accepted<T>(&mut self, read: Result<T, ParseError>, key: &Key, text: &str) -> Option<T> {
        let made = accepted(read, (key, text), self.reporter);
        self.fails |= made.is_none();
        made
    }

    fn field(&mut self, entries: &[Entry; 3], key: &Key) -> Option<FieldOfForce> {
        let texts = entries.each_ref().map(|entry| match entry {
            Entry::Number(number) => format!("{number:?}"),
            Entry::Expression(text) => text.to_string(),
        });
        match FieldOfForce::parse(texts.each_ref().map(String::as_str), &self.constants) {
            Ok(field) => Some(field),
            Err((component, error)) => self.accepted(Err(error), &key.index(component), &texts[component]),
        }
    }

    fn formula(&mut self, text: &str, key: &Key) -> Option<Formula> {
        let read = Formula::parse(text, &self.constants);
        self.accepted(read, key, text)
    }

    /// A friction that changes with place or time.
    fn friction(&mut self, written: &LinearFriction, key: &Key) -> Option<OwnFriction> {
        let matrix = match (written.numbers(), &written.scale) {
            (Some(numbers), Some(Entry::Expression(scale))) => {
                let made = LinearResistance::friction(&square(&numbers), frame(written.frame));
                let is_friction = accepted_matrix(made, &key.key("matrix"), self.reporter).is_some();
                self.fails |= !is_friction;
                let scale = self.formula(scale, &key.key("scale"));
                FrictionMatrix::Scaled(Box::new(square(&numbers)), scale.filter(|_| is_friction)?)
            }
            (_, Some(_)) => {
                self.fails = true;
                let help = "multiply the entries by it, or write numbers in the matrix";
                self.reporter.note(&key.key("scale"), "the matrix has expressions already", help);
                return None;
            }
            _ => FrictionMatrix::Entries(self.entries(&written.matrix, &key.key("matrix"))?),
        };
        Some(OwnFriction::new(matrix, frame(written.frame)))
    }

    fn entries(&mut self, matrix: &[[Entry; 12]; 12], key: &Key) -> Option<Box<[[FrictionEntry; 12]; 12]>> {
        let mut entries = Box::new([const { [const { FrictionEntry::Constant(0.0) }; 12] }; 12]);
        for (row, (made, written)) in entries.iter_mut().zip(matrix).enumerate() {
            for (column, (made, written)) in made.iter_mut().zip(written).enumerate() {
                *made = match written {
                    Entry::Number(number) => FrictionEntry::Constant(*number),
                    Entry::Expression(text) => {
                        FrictionEntry::Formula(Box::new(self.formula(text, &key.index(row).index(column))?))
                    }
                };
            }
        }
        Some(entries)
    }
}

/// What an expression gives, if it parses; notes why not.
pub(super) fn accepted<T>(
    read: Result<T, ParseError>,
    (key, text): (&Key, &str),
    reporter: &mut Reporter<'_>,
) -> Option<T> {
    let error = match read {
        Ok(made) => return Some(made),
        Err(error) => error,
    };
    let help = "see \"Expressions\" in the scene reference";
    match error.column() {
        Some(column) => reporter.note_within(key, (text, column), error.to_string(), help),
        None => reporter.note(key, error.to_string(), help),
    }
    None
}

/// The constants of expressions of these variables: those of a body or bond, which stand at a key, then those of the
/// scene; none if some of them are no constants, which is noted.
pub(super) fn constants(
    (key, own): (Key, Option<&BTreeMap<String, AnyQuantity>>),
    context: &SceneContext,
    variables: &[&str],
    reporter: &mut Reporter<'_>,
) -> Option<Vec<(String, f64)>> {
    let tables = [(key, own), (Key::root().key("constants"), Some(context.constants?))];
    let (mut all, mut are_constants) = (Vec::new(), true);
    for (key, table) in tables {
        for (name, value) in table.into_iter().flatten() {
            let constant = [(name.clone(), value.0)];
            if let Err(error) = check_constants(variables, &constant) {
                reporter.note(&key.key(name), error.to_string(), "rename it, here and where it stands");
                are_constants = false;
            }
            all.extend(constant);
        }
    }
    are_constants.then_some(all)
}

/// Result of what is defined at the start.
fn defined<T>(found: Result<T, impl Display>, key: &Key, reporter: &mut Reporter<'_>) -> Option<T> {
    found
        .map_err(|fault| {
            let help = "move the body, or write expressions that are smooth and allowed there";
            reporter.note(key, format!("at the start {fault}"), help);
        })
        .ok()
}
