//! `gyration calibrate`: numbers of a scene from measurements, with their errors, and a drawing of the fit.

use super::stem;
use crate::arguments::Calibrate;
use crate::error::{CliError, code};
use crate::output;
use crate::plot::calibration;
use crate::plot::draw::Format;
use gyration_scene::unit_of;
use gyration_study::calibration::{Calibration, Fitted};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// χ² is far above the degrees of freedom beyond so many of its standard deviations, √(2·degrees).
const FAR: f64 = 5.0;

/// Fits, prints and draws.
pub fn execute(arguments: &Calibrate) -> Result<u8, CliError> {
    let path = &arguments.data;
    let format = super::plot::format(arguments.output.as_deref())?;
    let calibration = Calibration::load(path)?;
    if let Some(folder) =
        arguments.output.as_deref().and_then(Path::parent).filter(|folder| !folder.as_os_str().is_empty())
        && !folder.is_dir()
    {
        return Err(CliError::arguments(
            format!("there is no folder {}", folder.display()),
            "make it, or write elsewhere",
        ));
    }
    let fitted = calibration.fit()?;
    if arguments.json {
        let mut json = serde_json::to_value(&fitted).unwrap_or_default();
        json["set"] = settings(&fitted).into();
        output::offer(&format!("{json:#}\n"))?;
    } else {
        output::offer(&in_words(&calibration, &fitted))?;
    }
    draw(arguments.output.as_deref(), path, format, &calibration, &fitted)?;
    Ok(code::DONE)
}

fn draw(
    output: Option<&Path>,
    data: &Path,
    format: Format,
    calibration: &Calibration,
    fitted: &Fitted,
) -> Result<(), CliError> {
    let path = output.map_or_else(|| PathBuf::from(format!("{}-fit.svg", stem(data))), Path::to_path_buf);
    let bytes = calibration::figure(calibration, fitted).draw().render(format);
    output::write_file(&path, &bytes)?;
    output::say(&format!("wrote {}", path.display()));
    Ok(())
}

/// The options that put the numbers into a scene.
fn settings(fitted: &Fitted) -> Vec<String> {
    let set = |number: &gyration_study::calibration::FittedNumber| -> Vec<String> {
        number.keys.iter().map(|key| format!("{key}={:?}", number.value)).collect()
    };
    fitted.numbers.iter().flat_map(set).collect()
}

/// Each measurement, what was fitted to it, and how far they are apart.
fn residuals(text: &mut String, calibration: &Calibration, fitted: &Fitted) {
    let _ = writeln!(
        text,
        "\n  table      row     condition           measured   deviation      fitted      (fitted − measured)/deviation"
    );
    for row in &fitted.residuals {
        let table = calibration.experiments().iter().find(|table| table.place() == row.table);
        let (measured, condition) = table.map_or(("", String::new()), |table| {
            let (unit, many) = match &table.key {
                Some(key) => (unit_of(key).unwrap_or_default(), 1.0),
                None => table.kind.shown().unwrap_or(("", 0.0)),
            };
            // Six digits, without the zeros behind.
            let number: f64 = format!("{:.5e}", row.condition * many).parse().unwrap_or(row.condition);
            let condition = if many == 0.0 { String::new() } else { format!("{number} {unit}") };
            (table.kind.measured().1, condition)
        });
        let _ = writeln!(
            text,
            "  {:<10} {:>3}  {condition:<18} {:>11.5e}   {:>8.2e}  {:>11.5e} {measured:<4} {:>8.3}",
            row.table,
            row.row + 1,
            row.measured,
            row.deviation,
            row.fitted,
            row.weighted
        );
    }
}

/// The fit as text.
pub fn in_words(calibration: &Calibration, fitted: &Fitted) -> String {
    let mut text = format!("{}\n\n", calibration.title());
    let width = fitted.numbers.iter().map(|number| number.name.len()).max().unwrap_or(0);
    for number in &fitted.numbers {
        let error = match number.error {
            Some(error) => format!("± {error:.2e}  ({:.2} %)", 100.0 * (error / number.value).abs()),
            None => "not determined".to_owned(),
        };
        let bound = if number.is_on_bound { ", on a bound" } else { "" };
        let unit = number.keys.first().and_then(|key| unit_of(key)).unwrap_or_default();
        let value = format!("{:.6e} {unit}", number.value);
        let _ = writeln!(text, "  {:width$}  {value:<24} {error}{bound}", number.name);
    }
    for undetermined in &fitted.undetermined {
        let _ = writeln!(text, "\n  {}", undetermined.in_words);
    }
    let _ = writeln!(text, "\nχ² {:.4} with {} degrees of freedom", fitted.chi_squared, fitted.degrees_of_freedom);
    let freedom = fitted.degrees_of_freedom as f64;
    if freedom > 0.0 && fitted.chi_squared > freedom + FAR * (2.0 * freedom).sqrt() {
        let _ = writeln!(
            text,
            "  far above them: the deviations are too small, a measurement is wrong, or the law does not explain them; the errors \
             above are too small as well"
        );
    }
    if fitted.numbers.len() > 1 {
        let _ = writeln!(text, "\ncorrelations");
        for (row, number) in fitted.correlations.iter().zip(&fitted.numbers) {
            let cells: String =
                row.iter().map(|cell| cell.map_or("       –".into(), |cell| format!("{cell:8.3}"))).collect();
            let _ = writeln!(text, "  {:width$}{cells}", number.name);
        }
    }
    residuals(&mut text, calibration, fitted);
    let options: Vec<String> = settings(fitted).iter().map(|setting| format!("--set {setting}")).collect();
    let _ = writeln!(text, "\n{}", options.join(" "));
    text
}
