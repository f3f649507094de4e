//! Columns of measurements: lists in the file, or of a CSV file beside it.

use super::csv::{Csv, CsvFault};
use crate::written::{measured_in, toml};
use gyration_scene::Override;
use gyration_scene::input::InputFile;
use serde_json::Value as Json;
use std::path::Path;

/// The overrides of a table `set`.
pub(super) fn settings(input: &InputFile, place: &[&str]) -> Vec<Override> {
    let setting = |key: String| {
        let value = input.value(&[place, &[&key]].concat()).unwrap_or_default();
        Override::new(key, toml(&value).as_str())
    };
    input.keys(place).into_iter().map(setting).collect()
}

/// The CSV file of a table, if it has one; the outer none: it cannot be read.
pub(super) fn csv(input: &mut InputFile, place: &[&str; 2], base: &Path) -> Option<Option<Csv>> {
    let place = [place[0], place[1], "table"];
    let Some(name) = input.take::<String>(&place) else { return Some(None) };
    Csv::read(base, &name).map(Some).map_err(|CsvFault { message, help }| input.note(&place, message, help)).ok()
}

/// A column: a list or a number in the file, or of its CSV file. The outer none: something is wrong with it.
pub(super) fn column(
    input: &mut InputFile,
    place: &[&str; 3],
    unit: Option<&str>,
    csv: Option<&Csv>,
) -> Option<Option<Vec<f64>>> {
    let Some(value) = input.value(place) else {
        return match csv.and_then(|csv| csv.column(place[2])) {
            None => Some(None),
            Some(Ok(numbers)) => Some(Some(numbers)),
            Some(Err(CsvFault { message, help })) => {
                input.note(&[place[0], place[1], "table"], message, help);
                None
            }
        };
    };
    if csv.is_some_and(|csv| csv.column(place[2]).is_some()) {
        let message = format!("`{}` stands here and in the table beside it", place[2]);
        input.note(place, message, "remove one of the two");
        return None;
    }
    let items = match value {
        Json::Array(items) => items,
        one => vec![one],
    };
    let mut numbers = Vec::new();
    for item in &items {
        match measured_in(item, place[2], unit) {
            Ok(number) => numbers.push(number),
            Err((message, help)) => {
                input.note(place, message, help);
                return None;
            }
        }
    }
    Some(Some(numbers))
}
