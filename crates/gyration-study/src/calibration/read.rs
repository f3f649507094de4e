//! From a file of measurements to a calibration: everything that is wrong at once, each with its place and its fix.

use super::check::{is_possible, keys_once, starts};
use super::columns::{column, csv, settings};
use super::dispersion;
use super::number::{is_written, number, number_at};
use super::{Calibration, Experiment, ExperimentKind};
use gyration_scene::input::{InputFile, InputRules, fix};
use gyration_scene::{LoadError, Override, Template, unit_of};
use serde_json::Value as Json;
use std::f64::consts::FRAC_PI_2;
use std::path::Path;
use std::sync::LazyLock;

/// What a file of measurements may hold.
static RULES: LazyLock<InputRules> = LazyLock::new(|| InputRules::new(&super::schema()));

impl Calibration {
    /// Reads a file; paths in it are relative to its folder.
    ///
    /// # Errors
    /// [`LoadError`] with everything that is wrong in it.
    pub fn load(path: &Path) -> Result<Self, LoadError> {
        let input = InputFile::load(path, &RULES, &[])?;
        Self::of(input, path.parent().unwrap_or(Path::new("")), &stem(path))
    }

    /// Reads a text; `name` is what messages call it, paths in it are relative to `base`.
    ///
    /// # Errors
    /// [`LoadError`] with everything that is wrong in it.
    pub fn parse(name: &str, text: &str, base: &Path) -> Result<Self, LoadError> {
        let input = InputFile::parse(name, text, &RULES, &[])?;
        Self::of(input, base, &stem(Path::new(name)))
    }

    fn of(mut input: InputFile, base: &Path, name: &str) -> Result<Self, LoadError> {
        let scene: String = input.take(&["scene"]).unwrap_or_default();
        let template = match crate::read::scene(&mut input, &scene, base) {
            Some(opened) => Some(opened?),
            None => None,
        };
        let settings = settings(&input, &["set"]);
        let resolved = template.as_ref().and_then(|template| resolved(&mut input, template, &settings));
        let names = input.keys(&["fit"]);
        if names.is_empty() {
            input.note(&["fit"], "there is no number to find", "write [fit.alpha] with its `key`");
        }
        let numbers: Vec<_> = names.iter().filter_map(|name| number(&mut input, name, resolved.as_ref())).collect();
        if let (Some(template), Some(resolved)) = (&template, &resolved) {
            numbers.iter().for_each(|number| is_written(&mut input, number, template, &settings, resolved));
        }
        if let Some(template) = &template {
            keys_once(&mut input, &numbers, template);
        }
        let mut experiments = Vec::new();
        for kind in ExperimentKind::SECTIONS {
            let count = input.value(&[kind.word()]).and_then(|tables| tables.as_array().map(Vec::len)).unwrap_or(0);
            for index in 0..count {
                experiments.extend(match kind {
                    ExperimentKind::Dispersion => dispersion::read(&mut input, index, base, resolved.as_ref()),
                    _ => experiment(&mut input, kind, index, base, resolved.as_ref()),
                });
            }
        }
        let rows: usize = experiments.iter().map(|table: &Experiment| table.measured.len()).sum();
        if input.is_sound() && rows < numbers.len() {
            let message = format!("{rows} measurements cannot tell {} numbers", numbers.len());
            input.note(&["fit"], message, "measure more, or fit fewer numbers");
        }
        if let (true, Some(template)) = (input.is_sound(), &template) {
            starts(&mut input, &numbers, template, &settings);
        }
        let title = input.take(&["title"]);
        input.finish()?;
        // A input without fault has named its scene.
        let template = template.map_or_else(|| Template::open(&scene), Ok)?;
        Ok(Self { title, name: name.to_owned(), template, settings, numbers, experiments })
    }
}

fn stem(path: &Path) -> String {
    path.file_stem().map_or_else(|| "calibration".to_owned(), |stem| stem.to_string_lossy().into_owned())
}

/// The numbers of the scene with the settings; what is wrong with it is noted.
fn resolved(input: &mut InputFile, template: &Template, settings: &[Override]) -> Option<Json> {
    match template.scene(settings) {
        Ok(scene) => Some(scene.numbers()),
        Err(errors) => {
            let place = if settings.is_empty() { "scene" } else { "set" };
            input.note(&[place], format!("the scene has errors: {errors}"), "mend the scene first");
            None
        }
    }
}

fn experiment(
    input: &mut InputFile,
    kind: ExperimentKind,
    index: usize,
    base: &Path,
    resolved: Option<&Json>,
) -> Option<Experiment> {
    let at = index.to_string();
    let place = [kind.word(), at.as_str()];
    let inside = |word: &'static str| [place[0], place[1], word];
    let kind = if kind == ExperimentKind::Slope && begins(input, &place)? { ExperimentKind::Begins } else { kind };
    let file = csv(input, &place, base)?;
    let key: Option<String> = input.take(&inside("key"));
    let (condition, unit) =
        kind.condition().map_or(("at", key.as_deref().and_then(unit_of)), |(name, unit)| (name, Some(unit)));
    let (result, result_unit) = kind.measured();
    let mut read = |word: &'static str, unit: Option<&str>| column(input, &inside(word), unit, file.as_ref());
    // All three are read before any is missed: everything that is wrong is told at once.
    let columns = (read(condition, unit), read(result, Some(result_unit)), read("deviation", Some(result_unit)));
    let (conditions, measured, deviations) = (columns.0?, columns.1?, columns.2?);
    let has = file.as_ref().map_or(String::new(), |csv| format!("; {}", csv.names()));
    let Some(measured) = measured else {
        input.note(
            &place,
            format!("`{result}` is missing"),
            format!("write what was measured, a list of numbers{has}"),
        );
        return None;
    };
    let count = measured.len();
    let conditions = match conditions {
        Some(_) if condition == "at" && key.is_none() => {
            input.note(
                &inside("at"),
                "nothing says what this is",
                "write `key`, the number of the scene that differs from row to row",
            );
            return None;
        }
        Some(conditions) => conditions,
        None if condition == "at" && key.is_none() => vec![0.0; count],
        None => {
            input.note(
                &place,
                format!("`{condition}` is missing"),
                format!("write a list as long as that of what was measured{has}"),
            );
            return None;
        }
    };
    if conditions.len() != count {
        let message = format!("{count} values of `{result}` stand against {} of `{condition}`", conditions.len());
        input.note(&place, message, "write lists of the same length");
        return None;
    }
    let Some(deviations) = deviations else {
        let help = format!("write the standard deviation of a measurement: what repeating it would scatter by{has}");
        input.note(&place, "`deviation` is missing", help);
        return None;
    };
    let deviations = if deviations.len() == 1 { vec![deviations[0]; count] } else { deviations };
    if deviations.len() != count || deviations.iter().any(|deviation| *deviation <= 0.0) {
        let help = "write one number, or one a row; each greater than zero";
        input.note(&inside("deviation"), "the deviations do not suit the measurements", help);
        return None;
    }
    let most = if kind == ExperimentKind::Slope { FRAC_PI_2 } else { f64::INFINITY };
    if kind.condition().is_some() && conditions.iter().any(|condition| *condition <= 0.0 || *condition >= most) {
        let message = format!("one value of `{condition}` is no {condition} that can be measured at");
        input.note(
            &inside(condition),
            message,
            "write heights above zero, and angles between 0 and pi/2, or strings: \"5 deg\"",
        );
        return None;
    }
    if let Some(row) = (0..count).find(|row| !is_possible(kind, conditions[*row], measured[*row], deviations[*row])) {
        let message = format!("row {}: {:?} {result_unit} cannot be", row + 1, measured[row]);
        let help = "write numbers above zero, rebounds not above the height of the drop, angles below pi/2; numbers \
            are in SI units, strings have their own";
        input.note(&inside(result), message, help);
        return None;
    }
    if let Some(key) = key.as_ref().filter(|key| resolved.is_some_and(|resolved| number_at(resolved, key).is_none())) {
        let message = format!("the scene has no number at `{key}`");
        input.note(&inside("key"), message, "write the dotted key of a number, as of --set: body.block.density");
        return None;
    }
    let body = body(input, &place, resolved)?;
    let settings = settings(input, &inside("set"));
    Some(Experiment { kind, index, body, settings, key, conditions, waves: Vec::new(), measured, deviations })
}

/// Whether a slope is one at which a body begins to slide; none if it cannot be.
fn begins(input: &mut InputFile, place: &[&str; 2]) -> Option<bool> {
    let inside = |word: &'static str| [place[0], place[1], word];
    let begins = input.take(&inside("begins")).unwrap_or(false);
    if begins && input.value(&inside("speed")).is_some() {
        let message = "where it begins to slide, a body has no speed yet";
        input.note(&inside("speed"), message, "leave it out: `angle` is what was measured");
        return None;
    }
    Some(begins)
}

/// The body that is named, or the only one; one that is written alone.
fn body(input: &mut InputFile, place: &[&str; 2], resolved: Option<&Json>) -> Option<String> {
    let bodies = resolved?.get("body")?.as_array()?;
    let names: Vec<&str> = bodies.iter().filter_map(|body| body.get("name")?.as_str()).collect();
    let named: Option<String> = input.take(&[place[0], place[1], "body"]);
    let meant = named.as_deref().or(if let [only] = names[..] { Some(only) } else { None });
    if let Some(original) = meant.and_then(|meant| original_of(bodies, meant)) {
        let message = format!("the body `{original}` has `copies`, and what is measured is of a body by itself");
        input.note(place, message, format!("name a scene in which `{original}` has no `copies`"));
        return None;
    }
    match (named, names.as_slice()) {
        (Some(named), names) if names.contains(&named.as_str()) => Some(named),
        (Some(named), names) => {
            let help = fix(&named, names.iter().copied(), "the bodies are");
            input.note(&[place[0], place[1], "body"], format!("the scene has no body `{named}`"), help);
            None
        }
        (None, [only]) => Some((*only).to_owned()),
        (None, names) => {
            input.note(place, "`body` is missing", format!("write one of {}", names.join(", ")));
            None
        }
    }
}

/// The body with `copies` that a name is of, its own or that of a copy.
fn original_of<'a>(bodies: &'a [Json], named: &str) -> Option<&'a str> {
    let is_number = |rest: &str| rest.strip_prefix('-').is_some_and(|number| number.parse::<usize>().is_ok());
    let copied = bodies.iter().filter(|body| body.get("copies").is_some_and(|copies| !copies.is_null()));
    let mut originals = copied.filter_map(|body| body.get("name")?.as_str());
    originals.find(|name| named.strip_prefix(name).is_some_and(|rest| rest.is_empty() || is_number(rest)))
}
