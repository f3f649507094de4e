//! A fit as text, as `gyration calibrate` prints it.

use super::suspect::is_far;
use super::{Calibration, Fitted, FittedNumber, MeasuredWave, Suspect};
use gyration_scene::unit_of;
use std::fmt::Write as _;

impl Fitted {
    /// The overrides that put the numbers into a scene.
    pub fn overrides(&self) -> Vec<String> {
        let set = |number: &FittedNumber| -> Vec<String> {
            number.keys.iter().map(|key| format!("{key}={:?}", number.value)).collect()
        };
        self.numbers.iter().flat_map(set).collect()
    }

    /// The fit as text.
    pub fn text(&self, calibration: &Calibration) -> String {
        let mut text = format!("{}\n\n", calibration.title());
        let width = self.numbers.iter().map(|number| number.name.len()).max().unwrap_or(0);
        for number in &self.numbers {
            let error = match number.error {
                Some(error) => format!("± {error:.2e}  ({:.2} %)", 100.0 * (error / number.value).abs()),
                None => "not determined".to_owned(),
            };
            let bound = if number.is_on_bound { ", on a bound" } else { "" };
            let unit = number.keys.first().and_then(|key| unit_of(key)).unwrap_or_default();
            let value = format!("{:.6e} {unit}", number.value);
            let _ = writeln!(text, "  {:width$}  {value:<24} {error}{bound}", number.name);
        }
        for undetermined in &self.undetermined {
            let _ = writeln!(text, "\n  {}", undetermined.in_words);
        }
        let _ = writeln!(text, "\nχ² {:.4} with {} degrees of freedom", self.chi_squared, self.degrees_of_freedom);
        if is_far(self.chi_squared, self.degrees_of_freedom) {
            let _ = writeln!(
                text,
                "  far above them: the deviations are too small, a measurement is wrong, or the law does not explain them; the errors \
                 above are too small as well"
            );
        }
        if let Some(suspect) = &self.suspect {
            let _ = writeln!(text, "  {}", suspect.in_words());
        }
        if self.numbers.len() > 1 {
            let _ = writeln!(text, "\ncorrelations");
            for (row, number) in self.correlations.iter().zip(&self.numbers) {
                let cells: String =
                    row.iter().map(|cell| cell.map_or("       –".into(), |cell| format!("{cell:8.3}"))).collect();
                let _ = writeln!(text, "  {:width$}{cells}", number.name);
            }
        }
        residuals(&mut text, calibration, self);
        let options: Vec<String> = self.overrides().iter().map(|setting| format!("--set {setting}")).collect();
        let _ = writeln!(text, "\n{}", options.join(" "));
        text
    }
}

impl Suspect {
    /// Which measurement is wrong, in a sentence.
    pub fn in_words(&self) -> String {
        let Self { table, chi_squared, degrees_of_freedom, measured, expected, .. } = self;
        let (named, there) = match self.row {
            Some(row) => (format!("row {} of {table}", row + 1), "there"),
            None => (table.clone(), "in its first row"),
        };
        format!(
            "{named} is at odds with all others: without it χ² is {chi_squared:.4} with {degrees_of_freedom}, and they \
             tell {expected:.5e} {there} where {measured:.5e} was measured, {:.4e} times as much: look at its unit",
            measured / expected
        )
    }
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
            let wave = table
                .waves
                .get(row.row)
                .map(|MeasuredWave { kappa: [x, y, z], branch }| format!("{x:.4} {y:.4} {z:.4}, {branch}"));
            let condition = if many == 0.0 { String::new() } else { format!("{number} {unit}") };
            (table.kind.measured().1, wave.unwrap_or(condition))
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
