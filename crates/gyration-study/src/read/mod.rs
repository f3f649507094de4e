//! From a study's text to a study: everything that is wrong at once, each with its place and its fix.

mod keep;
mod parameter;
mod probe;

pub(crate) use probe::probe;

use crate::column::{Column, ending, leading};
use crate::file::{Recordings, Sampling};
use crate::keep::Keep;
use crate::parameter::{Parameter, Variation};
use crate::random::MOST_DIMENSIONS;
use crate::written::toml;
use gyration_scene::Template;
use gyration_scene::input::{InputFile, InputRules, fix};
use serde::de::DeserializeOwned;
use serde_json::Value as Json;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::LazyLock;

/// What a study's file may hold.
pub(crate) static RULES: LazyLock<InputRules> = LazyLock::new(|| InputRules::new(&crate::schema()));

/// The most runs of a study.
const MOST_RUNS: u64 = 1 << 40;
/// Whole numbers beyond this are not told from their neighbours.
const MOST_WHOLE: f64 = 9_007_199_254_740_992.0;

/// What a study's file says.
#[derive(Debug, Clone)]
pub(crate) struct Read {
    pub title: Option<String>,
    pub scene: String,
    pub seed: u64,
    pub repetitions: u64,
    pub sampling: Sampling,
    pub recordings: Recordings,
    pub max_steps: Option<u64>,
    pub plot: Json,
    /// `[set]`: key and value as TOML.
    pub settings: Vec<(String, String)>,
    pub parameters: Vec<Parameter>,
    /// How many values each axis has, the slowest first.
    pub axes: Vec<u64>,
    pub keeps: Vec<(String, Keep)>,
}

/// Reads what a input says; what is wrong is noted, and then the rest is worth nothing.
pub(crate) fn read(input: &mut InputFile) -> Read {
    let settings: Vec<_> = input.keys(&["set"]).into_iter().map(|key| setting(input, key)).collect();
    let (parameters, axes) = parameter::parameters(input);
    let keeps = keep::keeps(input);
    let seed = whole(input, &["seed"]).unwrap_or(0);
    let repetitions = whole(input, &["repetitions"]).unwrap_or(1);
    let max_steps = whole(input, &["max_steps"]);
    let read = Read {
        title: input.take(&["title"]),
        scene: input.take(&["scene"]).unwrap_or_default(),
        seed,
        repetitions,
        sampling: or_default(input, "sampling"),
        recordings: or_default(input, "recordings"),
        max_steps,
        plot: input.value(&["plot"]).unwrap_or_default(),
        settings,
        parameters,
        axes,
        keeps,
    };
    dimensions(&read, input);
    names(&read, input);
    count(&read, input);
    read
}

/// What to write for `scene`.
const HOW_TO_NAME: &str = "write a path relative to this file, or a name of the gallery";

/// The scene that a study or calibration names: a path relative to its file, or a name of the gallery; none if there is
/// none.
pub(crate) fn scene(
    input: &mut InputFile,
    name: &str,
    base: &Path,
) -> Option<Result<Template, gyration_scene::LoadError>> {
    if name.is_empty() {
        // That it is missing, or no text, has been said.
        if input.value(&["scene"]).is_some_and(|scene| scene.as_str() == Some("")) {
            input.note(&["scene"], "the scene has no name", HOW_TO_NAME);
        }
        return None;
    }
    let beside = base.join(name);
    let opened = if beside.is_file() { Template::load(&beside) } else { Template::open(name) };
    match opened {
        Err(gyration_scene::LoadError::Read(error)) => {
            input.note(&["scene"], error.to_string(), HOW_TO_NAME);
            None
        }
        other => Some(other),
    }
}

fn or_default<T: DeserializeOwned + Default>(input: &mut InputFile, key: &str) -> T {
    input.take(&[key]).unwrap_or_default()
}

fn setting(input: &mut InputFile, key: String) -> (String, String) {
    let value = input.value(&["set", &key]).unwrap_or_default();
    (key, toml(&value))
}

/// A whole number that is written at a place, if one is; notes what is none.
fn whole(input: &mut InputFile, place: &[&str]) -> Option<u64> {
    let number: f64 = input.take(place)?;
    if number.fract() != 0.0 || number.abs() > MOST_WHOLE {
        input.note(place, format!("{number:?} is not a whole number of at most 15 digits"), "write a whole number");
        return None;
    }
    Some(number as u64)
}

/// The points of Sobol have so many coordinates, and no more.
fn dimensions(read: &Read, input: &mut InputFile) {
    let random = read.parameters.iter().filter_map(|parameter| match &parameter.variation {
        Variation::Random { distribution, .. } => Some(distribution.dimensions()),
        Variation::Axis { .. } => None,
    });
    let needed: usize = random.sum();
    if read.sampling == Sampling::Sobol && needed > MOST_DIMENSIONS {
        let message =
            format!("the random parameters take {needed} dimensions, and Sobol's points have {MOST_DIMENSIONS}");
        input.note(&["sampling"], message, "write \"latin_hypercube\" or \"random\"");
    }
}

/// Notes places of the scene that are set twice.
pub(crate) fn keys_once(read: &Read, template: &Template, input: &mut InputFile) {
    let mut seen: BTreeMap<String, String> = BTreeMap::new();
    let plain = |key: &str| template.by_index(key);
    // A parameter may set a part of what [set] has set, but nothing else may be set above or below another.
    let hides = |other: &str, owner: &str, key: &str| {
        let is_within = |inner: &str, outer: &str| inner.strip_prefix(outer).is_some_and(|rest| rest.starts_with('.'));
        other == key || is_within(other, key) || is_within(key, other) && owner != "[set]"
    };
    for (key, _) in &read.settings {
        seen.insert(plain(key), "[set]".to_owned());
    }
    for parameter in &read.parameters {
        for key in &parameter.keys {
            let own = plain(key);
            if let Some((other, owner)) = seen.iter().find(|(other, owner)| hides(other, owner, &own)) {
                let place = ["parameter", &parameter.name, if parameter.keys.len() == 1 { "key" } else { "keys" }];
                let what = if *other == own { format!("`{key}`") } else { format!("`{other}`, and this `{key}`") };
                input.note(&place, format!("{owner} already sets {what}"), "keep one of the two");
            }
            seen.insert(own, format!("the parameter \"{}\"", parameter.name));
        }
    }
}

/// Notes names that are none, and columns that occur twice.
fn names(read: &Read, input: &mut InputFile) {
    let mut taken: BTreeMap<String, &str> = BTreeMap::new();
    for Column { name, .. } in leading().into_iter().chain(ending()) {
        taken.insert(name, "every table");
    }
    let parameters = read.parameters.iter().flat_map(|parameter| {
        parameter.columns.iter().map(|column| ("parameter", parameter.name.as_str(), column.name.as_str()))
    });
    let keeps = read.keeps.iter().map(|(name, _)| ("keep", name.as_str(), name.as_str()));
    for (section, name, column) in parameters.chain(keeps) {
        if let Some(owner) = taken.insert(column.to_owned(), section) {
            let owner = if owner == "every table" { owner.to_owned() } else { format!("a {owner} of this study") };
            input.note(&[section, name], format!("{owner} already has a column `{column}`"), "give it another name");
        }
    }
    for section in ["parameter", "keep"] {
        for name in input.keys(&[section]) {
            if name.is_empty() || !name.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"_-".contains(&byte)) {
                let help = "use letters A to Z and a to z, digits, `_` and `-`";
                input.note(&[section, &name], format!("\"{name}\" is not a name"), help);
            }
        }
    }
}

/// Notes a study of too many runs.
fn count(read: &Read, input: &mut InputFile) {
    let product = |total: Option<u64>, length: &u64| total.and_then(|total| total.checked_mul(*length));
    let runs = read.axes.iter().fold(Some(read.repetitions), product);
    if runs.is_none_or(|runs| runs > MOST_RUNS) {
        let place = if read.repetitions > MOST_RUNS { "repetitions" } else { "parameter" };
        input.note(&[place], format!("more than {MOST_RUNS} runs"), "write fewer repetitions or shorter axes");
    }
}

/// The fix for a name that is not known.
fn known<'a>(word: &str, known: impl IntoIterator<Item = &'a str> + Clone, what: &str) -> String {
    fix(word, known, what)
}
