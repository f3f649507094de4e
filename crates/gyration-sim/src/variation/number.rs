//! A number of a scene by its dotted key, and the scene with another number in its place.
//!
//! Numbers are read from the resolved form, so that a default counts as written. They are changed by an override, as
//! `--set` does; an item of a vector or a matrix brings its whole array along, which need not stand in the file.

use crate::resistance::complete;
use gyration_scene::{Override, Scene, SceneErrors, Template};
use serde_json::Value;
use std::sync::Arc;

/// A key that names no number.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{key}: {message}; {help}")]
pub struct UnknownNumber {
    /// The key.
    pub key: String,
    /// What is wrong.
    pub message: String,
    /// What to do.
    pub help: String,
}

/// A number of a scene.
#[derive(Debug, Clone)]
pub(crate) struct SceneNumber {
    /// Its dotted key.
    pub key: String,
    /// What it is, in SI units.
    pub value: f64,
    /// The key that is set: its own, or that of the array around it.
    set_key: String,
    /// What stands there.
    set_value: Value,
    /// Where in that array it is.
    inside: Vec<usize>,
    /// The text in which it is set: as it was written, or the resolved form if it can be set in that only.
    template: Arc<Template>,
    in_resolved: bool,
    /// Whether laws of a contact follow from what it does.
    pub derives_laws: bool,
    /// How a neighbouring scene is made ready.
    completed: fn(Scene) -> Result<Scene, SceneErrors>,
}

/// Tables whose numbers say how something is computed or recorded, not what it is.
const METHOD_TABLES: [&str; 3] = ["solver", "record", "time"];
/// Keys anywhere that do.
const METHOD_KEYS: [&str; 4] = ["triangles", "spacing", "tolerance", "history_error"];
/// Keys of a body that say how it starts.
const OF_THE_START: [&str; 6] =
    ["position", "velocity", "angular_velocity", "orientation", "gradient", "gradient_rate"];
/// A number is changed by this part of it to see whether it has a part in the model.
const BESIDE: f64 = 1e-6;

impl SceneNumber {
    /// Finds a number by its key.
    ///
    /// # Errors
    /// [`UnknownNumber`] if there is no number at this key.
    pub fn find(scene: &Scene, key: &str) -> Result<Self, UnknownNumber> {
        Self::found(scene, key, complete)
    }

    /// The same, of scenes without the waves with which a run starts.
    ///
    /// # Errors
    /// [`UnknownNumber`] if there is no number at this key.
    pub fn find_at_rest(scene: &Scene, key: &str) -> Result<Self, UnknownNumber> {
        Self::found(scene, key, |scene| complete(scene.without_waves()))
    }

    fn found(
        scene: &Scene,
        key: &str,
        completed: fn(Scene) -> Result<Scene, SceneErrors>,
    ) -> Result<Self, UnknownNumber> {
        let numbers = scene.numbers();
        let fault = |message: String, help: String| UnknownNumber { key: key.to_owned(), message, help };
        let mut at = &numbers;
        let mut array: Option<(String, Value)> = None;
        let (mut walked, mut inside): (Vec<&str>, Vec<usize>) = (Vec::new(), Vec::new());
        for word in key.split('.').map(str::trim) {
            let next = match at {
                Value::Object(table) => table.get(word),
                Value::Array(items) => item(items, word).map(|(index, found)| {
                    if !found.is_object() {
                        array.get_or_insert_with(|| (walked.join("."), at.clone()));
                        inside.push(index);
                    }
                    found
                }),
                _ => None,
            };
            let missing = || fault(format!("the scene has no `{word}` {}", place(&walked)), choices(at));
            at = next.ok_or_else(missing)?;
            walked.push(word);
        }
        let value = at.as_f64().ok_or_else(|| match at {
            Value::Object(_) | Value::Array(_) => fault("several numbers stand at this key".into(), choices(at)),
            _ => fault("what stands at this key is no number".into(), "give the key of a number, as to --set".into()),
        })?;
        let (set_key, set_value) = array.unwrap_or_else(|| (key.to_owned(), at.clone()));
        let mut contacts = numbers["contact"].as_array().into_iter().flatten();
        let derives_laws = contacts.any(|contact| contact.get("from").is_some());
        let read = |name: &str, text: &str| {
            let unread = |errors: SceneErrors| fault(first(&errors), "mend the scene".into());
            Template::parse(name, text, scene.base()).map(Arc::new).map_err(unread)
        };
        let mut this = Self {
            key: key.to_owned(),
            value,
            set_key,
            set_value,
            inside,
            template: read("scene", scene.text())?,
            in_resolved: false,
            derives_laws,
            completed,
        };
        if this.scene_at(scene, value).is_err() {
            this.in_resolved = true;
            this.template = read("resolved.json", &scene.resolved().to_string())?;
        }
        Ok(this)
    }

    /// Why a derivative by this number would mean nothing, if that can be told from its key.
    pub fn is_no_quantity(&self) -> Option<String> {
        let words = || self.key.split('.');
        let [first, last] = [words().next()?, words().next_back()?];
        let is_method = METHOD_TABLES.contains(&first) || METHOD_KEYS.contains(&last);
        is_method.then(|| "it says how the motion is computed or recorded, not how it is".into())
    }

    /// Whether the number has a part in the first state only, not in the equations: the model beside it is the same.
    ///
    /// Pins and guides stay where the start has put them, bonds with a stiffness rest there, and angles of hinges count
    /// from there.
    pub fn starts_only(&self, scene: &Scene) -> bool {
        let mut words = self.key.split('.');
        let is_start = words.next() == Some("body") && words.nth(1).is_some_and(|part| OF_THE_START.contains(&part));
        // Places of rest serve rows, not rates.
        let model = |scene: &Scene| format!("{:?}", scene.built().model.clone().resting_at([]));
        let beside = || self.scene_at(scene, self.value + BESIDE * self.value.abs().max(1.0));
        is_start && beside().is_ok_and(|beside| model(&beside) == model(scene))
    }

    /// The scene with another value in this place.
    ///
    /// # Errors
    /// The first thing that is wrong with it then, in words.
    pub fn scene_at(&self, scene: &Scene, value: f64) -> Result<Scene, String> {
        let mut changed = self.set_value.clone();
        let leaf = self.inside.iter().try_fold(&mut changed, |at, index| at.get_mut(index));
        *leaf.ok_or("its array has changed")? = value.into();
        let setting = format!("{}={changed}", self.set_key);
        let all = if self.in_resolved { vec![setting] } else { [scene.overrides(), vec![setting]].concat() };
        let found = self.template.scene(&Override::parse_all(&all)).and_then(self.completed);
        found.map_err(|errors| first(&errors))
    }
}

/// The first thing that is wrong with a scene.
fn first(errors: &SceneErrors) -> String {
    errors.as_slice().first().map_or_else(String::new, |error| error.message.clone())
}

/// An item of an array by its name or its index.
fn item<'a>(items: &'a [Value], word: &str) -> Option<(usize, &'a Value)> {
    let by_name = items.iter().position(|item| item.get("name").and_then(Value::as_str) == Some(word));
    let index = by_name.or_else(|| word.parse().ok())?;
    Some((index, items.get(index)?))
}

fn place(walked: &[&str]) -> String {
    if walked.is_empty() { "at its root".into() } else { format!("in `{}`", walked.join(".")) }
}

/// What could stand next in a key.
fn choices(at: &Value) -> String {
    match at {
        Value::Object(table) => {
            let names: Vec<&str> = table.keys().map(String::as_str).collect();
            format!("there are: {}", names.join(", "))
        }
        Value::Array(items) => {
            let names: Vec<&str> = items.iter().filter_map(|item| item.get("name")?.as_str()).collect();
            match (names.is_empty(), items.len()) {
                (false, _) => format!("there are: {}", names.join(", ")),
                (true, 0) => "the array is empty".into(),
                (true, count) => format!("name one of them by its index, 0 to {}", count - 1),
            }
        }
        _ => "the key leads past a value".into(),
    }
}
