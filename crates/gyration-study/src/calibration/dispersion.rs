//! Frequencies of waves through a lattice: read, and computed from its bands with their derivatives.

use super::columns::{column, csv, settings};
use super::predict::Prediction;
use super::{Calibration, Experiment, ExperimentKind, FreeNumber, MeasuredWave};
use gyration_scene::input::InputFile;
use gyration_sim::survey::VariedBands;
use serde_json::Value as Json;
use std::path::Path;

/// The columns of a table, each with its unit.
const COLUMNS: [(&str, Option<&str>); 6] = [
    ("kappa_1", None),
    ("kappa_2", None),
    ("kappa_3", None),
    ("branch", None),
    ("omega", Some("rad/s")),
    ("error", Some("rad/s")),
];
/// Where the last of them stand.
const BRANCH: usize = 3;
const OMEGA: usize = 4;
const ERROR: usize = 5;

/// Reads a table; what is wrong with it is noted.
pub(super) fn read(input: &mut InputFile, index: usize, base: &Path, resolved: Option<&Json>) -> Option<Experiment> {
    let at = index.to_string();
    let place = [ExperimentKind::Dispersion.word(), at.as_str()];
    let columns = columns(input, &place, base)?;
    if !are_possible(input, &place, &columns) {
        return None;
    }
    if resolved?.get("lattice").is_none_or(Json::is_null) {
        let message = "the scene has no `[lattice]`, so that no waves run through it";
        input.note(&place, message, "name a scene that has one");
        return None;
    }
    let [first, second, third, branches, measured, deviations] = columns;
    let waves = (0..measured.len())
        .map(|row| MeasuredWave { kappa: [first[row], second[row], third[row]], branch: branches[row] as usize });
    let waves: Vec<MeasuredWave> = waves.collect();
    let norm = |wave: &MeasuredWave| wave.kappa.iter().map(|part| part * part).sum::<f64>().sqrt();
    Some(Experiment {
        kind: ExperimentKind::Dispersion,
        index,
        body: String::new(),
        settings: settings(input, &[place[0], place[1], "set"]),
        key: None,
        conditions: waves.iter().map(norm).collect(),
        waves,
        measured,
        deviations,
    })
}

/// The columns, all of one length.
fn columns(input: &mut InputFile, place: &[&str; 2], base: &Path) -> Option<[Vec<f64>; 6]> {
    let file = csv(input, place, base)?;
    // All are read before any is missed: everything that is wrong is told at once.
    let read = COLUMNS.map(|(name, unit)| column(input, &[place[0], place[1], name], unit, file.as_ref()));
    let read: Vec<Option<Vec<f64>>> = read.into_iter().collect::<Option<_>>()?;
    for needed in [0, BRANCH, OMEGA, ERROR] {
        if read[needed].is_none() {
            let has = file.as_ref().map_or(String::new(), |csv| format!("; {}", csv.names()));
            let message = format!("`{}` is missing", COLUMNS[needed].0);
            input.note(place, message, format!("write a list of numbers, one a wave{has}"));
            return None;
        }
    }
    let count = read[OMEGA].as_ref().map_or(0, Vec::len);
    let mut columns: [Vec<f64>; 6] = Default::default();
    for (number, (column, read)) in columns.iter_mut().zip(read).enumerate() {
        let read = read.unwrap_or_else(|| vec![0.0]);
        *column = if read.len() == 1 && number != OMEGA { vec![read[0]; count] } else { read };
        if column.len() != count {
            let message =
                format!("{count} values of `omega` stand against {} of `{}`", column.len(), COLUMNS[number].0);
            input.note(place, message, "write lists of the same length, or one number for all");
            return None;
        }
    }
    Some(columns)
}

/// Whether any waves are such; what is not is noted.
fn are_possible(input: &mut InputFile, place: &[&str; 2], columns: &[Vec<f64>; 6]) -> bool {
    let is_branch = |value: &f64| *value >= 0.0 && value.fract() == 0.0 && *value < f64::from(u32::MAX);
    let is_positive = |value: &f64| *value > 0.0;
    let wrong = |number: usize, is_right: fn(&f64) -> bool| columns[number].iter().position(|value| !is_right(value));
    let rules = [
        (
            BRANCH,
            wrong(BRANCH, is_branch),
            "count branches 0, 1, 2, … by ascending frequency, as `gyration bands` does",
        ),
        (OMEGA, wrong(OMEGA, is_positive), "write frequencies ω above zero, in rad/s: 2π times those in Hz"),
        (ERROR, wrong(ERROR, is_positive), "write the standard deviation of each frequency, above zero"),
    ];
    let mut all = true;
    for (number, row, help) in rules {
        if let Some(row) = row {
            let message = format!("row {}: {:?} cannot be", row + 1, columns[number][row]);
            input.note(&[place[0], place[1], COLUMNS[number].0], message, help);
            all = false;
        }
    }
    all
}

impl Calibration {
    /// The frequency of every row of a table.
    ///
    /// # Errors
    /// Why there are none, in words.
    pub(super) fn frequencies(&self, table: &Experiment, values: &[f64]) -> Result<Vec<f64>, String> {
        let bands = VariedBands::of(&self.lattice(table, values)?, None, &[])?;
        table.waves.iter().map(|wave| Ok(branch(&bands, wave)?.0)).collect()
    }

    /// The same with derivatives by the numbers: sums over the keys of each.
    ///
    /// # Errors
    /// Why there are none, in words.
    pub(super) fn predicted_frequencies(&self, table: &Experiment, values: &[f64]) -> Result<Vec<Prediction>, String> {
        let keys: Vec<String> = self.numbers.iter().flat_map(|number| number.keys.clone()).collect();
        let bands = VariedBands::of(&self.lattice(table, values)?, None, &keys)?;
        let predict = |wave: &MeasuredWave| {
            let (value, changes) = branch(&bands, wave)?;
            let mut changes = changes.into_iter();
            let slope = |number: &FreeNumber| {
                let own: Vec<Option<f64>> = changes.by_ref().take(number.keys.len()).collect();
                own.into_iter().sum::<Option<f64>>().ok_or_else(|| {
                    format!("branch {} at κ = {:?} has no frequency that could change", wave.branch, wave.kappa)
                })
            };
            Ok(Prediction { value, slopes: self.numbers.iter().map(slope).collect::<Result<_, String>>()? })
        };
        table.waves.iter().map(predict).collect()
    }
}

impl Experiment {
    /// One wave of it alone.
    pub(super) fn of_wave(&self, wave: &MeasuredWave) -> Self {
        Self { waves: vec![*wave], ..self.clone() }
    }
}

/// ω of a wave, and its derivatives.
fn branch(bands: &VariedBands, wave: &MeasuredWave) -> Result<(f64, Vec<Option<f64>>), String> {
    let MeasuredWave { kappa, branch } = wave;
    let mut found = bands.at(*kappa)?;
    let count = found.omega.len();
    match found.omega.get(*branch) {
        Some(omega) => Ok((*omega, found.changes.swap_remove(*branch))),
        None => Err(format!("there is no branch {branch}: the lattice has {count}, counted from 0")),
    }
}
