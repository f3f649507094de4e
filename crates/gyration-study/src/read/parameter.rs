//! `[parameter.NAME]`: keys, and exactly one way in which they vary.

use crate::file::{self, Direction, Grid, Measured, Normal, Range, Spacing};
use crate::parameter::{AxisValues, Distribution, Parameter, Variation, columns};
use crate::value::Value;
use crate::written::{measured, toml, unit_at};
use gyration_scene::input::InputFile;
use serde_json::Value as Json;

/// The ways in which a parameter can vary.
const WAYS: [&str; 7] = ["values", "grid", "uniform", "log_uniform", "normal", "rotation", "direction"];
/// The longest axis that is worked out number by number.
const MOST_STEPS: f64 = 1_099_511_627_776.0;

/// Reads a parameter at a place.
struct ParameterReader<'a> {
    input: &'a mut InputFile,
    name: &'a str,
    /// The key whose unit its numbers have.
    key: String,
}

/// The parameters in their order, and the lengths of the axes, the slowest first.
pub(super) fn parameters(input: &mut InputFile) -> (Vec<Parameter>, Vec<u64>) {
    let mut found: Vec<(Parameter, Option<String>)> = Vec::new();
    let mut first = 0;
    for name in input.keys(&["parameter"]) {
        let Some(written) = input.take::<file::Parameter>(&["parameter", &name]) else { continue };
        let Some(parameter) = parameter(input, &name, &written, &mut first) else { continue };
        found.push((parameter, written.with));
    }
    let axes = axes(input, &mut found);
    (found.into_iter().map(|(parameter, _)| parameter).collect(), axes)
}

fn parameter(input: &mut InputFile, name: &str, written: &file::Parameter, first: &mut usize) -> Option<Parameter> {
    let place = ["parameter", name];
    let keys = match (&written.key, &written.keys) {
        (Some(key), None) => vec![key.clone()],
        (None, Some(keys)) if !keys.is_empty() => keys.clone(),
        _ => {
            input.note(&place, "expected exactly one of `key` and `keys`", "write key = \"body.die.position.2\"");
            return None;
        }
    };
    let ways: Vec<&str> =
        input.keys(&place).iter().filter_map(|key| WAYS.iter().find(|way| *way == key)).copied().collect();
    let [way] = ways[..] else {
        let found = if ways.is_empty() { "none".to_owned() } else { ways.join(" and ") };
        let help = format!("write one of {}", WAYS.join(", "));
        input.note(&place, format!("expected exactly one way in which it varies, found {found}"), help);
        return None;
    };
    let mut reader = ParameterReader { input, name, key: keys[0].clone() };
    let variation = match way {
        "values" => reader.listed(written.values.as_deref().unwrap_or_default()),
        "grid" => reader.grid(written.grid.as_ref()?),
        _ => reader.random(written, way).map(|distribution| {
            let variation = Variation::Random { distribution, first: *first };
            *first += distribution.dimensions();
            variation
        }),
    }?;
    if written.with.is_some() && !matches!(variation, Variation::Axis { .. }) {
        let message = "a random parameter has no axis to share";
        reader.input.note(&[&place[..], &["with"]].concat(), message, "leave `with` out");
        return None;
    }
    let unit = unit_at(&keys[0]).map(str::to_owned);
    let columns = columns(name, unit.as_deref(), &variation);
    Some(Parameter { name: name.to_owned(), keys, unit, variation, columns })
}

/// Numbers the axes; those that vary together share one.
fn axes(input: &mut InputFile, found: &mut [(Parameter, Option<String>)]) -> Vec<u64> {
    let mut lengths = Vec::new();
    for (parameter, with) in found.iter_mut() {
        if let (Variation::Axis { axis, steps }, None) = (&mut parameter.variation, &with) {
            *axis = lengths.len();
            lengths.push(steps.count());
        }
    }
    let leaders: Vec<(String, usize)> = found
        .iter()
        .filter_map(|(parameter, with)| match (&parameter.variation, with) {
            (Variation::Axis { axis, .. }, None) => Some((parameter.name.clone(), *axis)),
            _ => None,
        })
        .collect();
    for (parameter, with) in found.iter_mut() {
        let (Variation::Axis { axis, steps }, Some(with)) = (&mut parameter.variation, &with) else { continue };
        let place = ["parameter", &parameter.name, "with"];
        match leaders.iter().find(|(name, _)| name == with) {
            Some((_, leader)) => {
                *axis = *leader;
                let (own, other) = (steps.count(), lengths[*leader]);
                if own != other {
                    let message = format!("it has {own} values, and \"{with}\" has {other}");
                    input.note(&place, message, "give both as many");
                }
            }
            None => {
                let help = super::known(with, leaders.iter().map(|(name, _)| name.as_str()), "axes");
                input.note(&place, format!("there is no axis \"{with}\" of its own"), help);
            }
        }
    }
    lengths
}

impl ParameterReader<'_> {
    /// Notes what is wrong at a key of the parameter.
    fn note(&mut self, keys: &[&str], message: impl Into<String>, help: impl Into<String>) {
        self.input.note(&[&["parameter", self.name][..], keys].concat(), message, help);
    }

    fn number(&mut self, keys: &[&str], value: &Json) -> Option<f64> {
        measured(value, &self.key).map_err(|(message, help)| self.note(keys, message, help)).ok()
    }

    fn pair(&mut self, way: &str, names: [&str; 2], values: [&Measured; 2]) -> Option<[f64; 2]> {
        let numbers = [0, 1].map(|k| self.number(&[way, names[k]], &values[k].0));
        Some([numbers[0]?, numbers[1]?])
    }

    /// Two ends in their order; both positive where ratios count.
    fn range(&mut self, way: &str, from: &Measured, to: &Measured, is_logarithmic: bool) -> Option<[f64; 2]> {
        let [low, high] = self.pair(way, ["from", "to"], [from, to])?;
        if low >= high {
            let help = if low > high { "swap the two ends" } else { "write a greater end" };
            self.note(&[way, "to"], format!("{high:?} is not greater than from = {low:?}"), help);
            return None;
        }
        if is_logarithmic && low <= 0.0 {
            self.note(&[way, "from"], format!("{low:?} has no logarithm"), "write a number greater than 0");
            return None;
        }
        Some([low, high])
    }

    fn random(&mut self, written: &file::Parameter, way: &str) -> Option<Distribution> {
        match way {
            "uniform" => {
                let Range { from, to } = written.uniform.as_ref()?;
                self.range(way, from, to, false).map(|[from, to]| Distribution::Uniform { from, to })
            }
            "log_uniform" => {
                let Range { from, to } = written.log_uniform.as_ref()?;
                self.range(way, from, to, true).map(|[from, to]| Distribution::LogUniform { from, to })
            }
            "normal" => {
                let Normal { mean, deviation } = written.normal.as_ref()?;
                let [mean, deviation] = self.pair(way, ["mean", "deviation"], [mean, deviation])?;
                if deviation <= 0.0 {
                    let message = format!("{deviation:?} is no standard deviation");
                    self.note(&[way, "deviation"], message, "write a number greater than 0");
                    return None;
                }
                Some(Distribution::Normal { mean, deviation })
            }
            "rotation" => Some(Distribution::Rotation),
            _ => self.direction(written.direction.as_ref()?),
        }
    }

    fn direction(&mut self, written: &Direction) -> Option<Distribution> {
        // The unit is that of the components.
        self.key = format!("{}.0", self.key);
        let magnitude = &written.magnitude.0;
        let [from, to] = match (magnitude.get("from"), magnitude.get("to")) {
            (Some(from), Some(to)) if magnitude.as_object().is_some_and(|table| table.len() == 2) => {
                let [from, to] = [from, to].map(|end| Measured(end.clone()));
                self.range("direction", &from, &to, false)?
            }
            _ => [self.number(&["direction", "magnitude"], magnitude)?; 2],
        };
        if from < 0.0 {
            self.note(&["direction", "magnitude"], format!("{from:?} is no length"), "write a number of at least 0");
            return None;
        }
        Some(Distribution::Direction { from, to })
    }

    fn grid(&mut self, grid: &Grid) -> Option<Variation> {
        let count = grid.count;
        if count.fract() != 0.0 || count > MOST_STEPS {
            self.note(
                &["grid", "count"],
                format!("{count:?} is no count of values"),
                format!("write a whole number from 1 to {MOST_STEPS}"),
            );
            return None;
        }
        let [from, to] = self.pair("grid", ["from", "to"], [&grid.from, &grid.to])?;
        let is_logarithmic = grid.spacing == Spacing::Log;
        if is_logarithmic && (from <= 0.0 || to <= 0.0) {
            let wrong = if from <= 0.0 { ("from", from) } else { ("to", to) };
            self.note(&["grid", wrong.0], format!("{:?} has no logarithm", wrong.1), "write a number greater than 0");
            return None;
        }
        if count > 1.0 && from == to {
            self.note(&["grid", "to"], format!("all values are {to:?}"), "write another end, or count = 1");
            return None;
        }
        let steps = AxisValues::Grid { from, to, count: count as u64, is_logarithmic };
        Some(Variation::Axis { axis: 0, steps })
    }

    /// Values as they are written: one kind of cells for all.
    fn listed(&mut self, values: &[Json]) -> Option<Variation> {
        if values.is_empty() {
            self.note(&["values"], "no values", "write one at least");
            return None;
        }
        let found: Vec<_> = values.iter().map(|value| self.cells(value)).collect();
        let is_one_measured = found.iter().any(Result::is_ok);
        for (index, value) in found.iter().enumerate() {
            if let Err((message, help)) = value
                && (is_one_measured || values[index].is_null())
            {
                self.note(&["values"], format!("value {} of the list: {message}", index + 1), help.clone());
                return None;
            }
        }
        let numbers = self.numbers(values);
        let cells = |index: usize, value: &Json| match &numbers {
            Some(numbers) => numbers[index].iter().copied().map(Value::Number).collect(),
            None => vec![Value::Text(value.as_str().map_or_else(|| toml(value), str::to_owned))],
        };
        let listed = values.iter().enumerate().map(|(index, value)| (toml(value), cells(index, value)));
        Some(Variation::Axis { axis: 0, steps: AxisValues::Listed(listed.collect()) })
    }

    /// The numbers of a value.
    ///
    /// # Errors
    /// Message and fix, if it is neither a number nor an array of numbers.
    fn cells(&self, value: &Json) -> Result<Vec<f64>, (String, String)> {
        match value {
            Json::Array(items) => {
                let item = |(k, item): (usize, &Json)| measured(item, &format!("{}.{k}", self.key));
                items.iter().enumerate().map(item).collect()
            }
            value => measured(value, &self.key).map(|number| vec![number]),
        }
    }

    /// The numbers of the values, if all are numbers, or arrays of equally many.
    fn numbers(&self, values: &[Json]) -> Option<Vec<Vec<f64>>> {
        let all: Vec<Vec<f64>> = values.iter().map(|value| self.cells(value).ok()).collect::<Option<_>>()?;
        let is_array = |value: &Json| value.is_array();
        let same = values.iter().all(|value| is_array(value) == is_array(&values[0]))
            && all.iter().all(|numbers| numbers.len() == all[0].len() && !numbers.is_empty());
        same.then_some(all)
    }
}
