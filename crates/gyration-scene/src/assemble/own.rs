//! The forces that a body has of its own, read from expressions.

use super::context::SceneContext;
use crate::check::{Placed, Reporter};
use crate::file::Body;
use crate::key::Key;
use gyration::kinematics::Placement;
use gyration::load::{OwnForces, PLACE_NAMES, Potential};
use gyration_expression::{ParseError, Scratch, Undefined, check_constants};

/// The forces of a body's own, before it is known where it starts.
#[derive(Debug, Clone)]
pub(super) struct OwnForcesWritten {
    forces: OwnForces,
    /// Key of the potential.
    potential: Key,
}

impl OwnForcesWritten {
    /// Reads them; notes expressions that are none, and constants that cannot be named so.
    pub(super) fn of(placed: &Placed<Body>, context: &SceneContext, reporter: &mut Reporter<'_>) -> Option<Self> {
        let Placed { key, value, .. } = placed;
        let at = key.key("potential");
        // Constants of the scene that are not well formed have been noted.
        let constants = Constants::of(placed, context, reporter)?;
        let potential = match &value.potential {
            None => None,
            Some(text) => {
                let read = Potential::parse(text, &constants.0);
                Some(Box::new(accepted(read, (&at, text), reporter)?))
            }
        };
        Some(Self { forces: OwnForces { potential }, potential: at })
    }

    /// The forces of a body that starts at a place; notes those that are not defined there.
    pub(super) fn at(self, place: &Placement, reporter: &mut Reporter<'_>) -> Option<OwnForces> {
        let scratch = &mut Scratch::default();
        if let Some(potential) = &self.forces.potential {
            defined(potential.loads(place, 0.0, scratch), &self.potential, reporter)?;
        }
        Some(self.forces)
    }
}

/// The constants of the expressions of a body, its own first.
struct Constants(Vec<(String, f64)>);

impl Constants {
    /// Those of a body; none if one of them is no constant, which is noted.
    fn of(placed: &Placed<Body>, context: &SceneContext, reporter: &mut Reporter<'_>) -> Option<Self> {
        let tables = [
            (placed.key.key("constants"), placed.value.constants.as_deref()),
            (Key::root().key("constants"), Some(context.constants?)),
        ];
        let mut all = Vec::new();
        for (key, table) in tables {
            for (name, value) in table.into_iter().flatten() {
                let constant = [(name.clone(), value.0)];
                if let Err(error) = check_constants(&PLACE_NAMES, &constant) {
                    reporter.note(&key.key(name), error.to_string(), "rename it, here and where it stands");
                    return None;
                }
                all.extend(constant);
            }
        }
        Some(Self(all))
    }
}

/// What an expression gives, if it parses.
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

/// What is defined at the start.
fn defined<T>(found: Result<T, Undefined>, key: &Key, reporter: &mut Reporter<'_>) -> Option<T> {
    found
        .map_err(|undefined| {
            let help = "move the body, or write an expression that is smooth there";
            reporter.note(key, format!("at the start {undefined}"), help);
        })
        .ok()
}
