//! What changes bands, and how far they may be off, in words.

use gyration_sim::format::significant;
use gyration_sim::survey::BandSurvey;
use std::fmt::Write as _;

/// What differences leave of zero.
const ROUNDING: f64 = 1e-9;

fn without_rounding(change: f64) -> f64 {
    if change.abs() <= ROUNDING { 0.0 } else { change }
}

/// ∂ln ω/∂ln p of each branch by each number, at the vertices of the path.
pub fn write_derivatives(text: &mut String, found: &BandSurvey) -> std::fmt::Result {
    let Some(derivatives) = &found.derivatives else { return Ok(()) };
    let keys = &derivatives.by_key.0;
    let width = keys.iter().map(|(key, _)| key.len()).max().unwrap_or(0).max(24);
    for row in &found.vertices {
        let [a, b, c] = found.kappa[*row];
        let label = found.labels.iter().find(|(at, _)| at == row).map(|(_, name)| format!(" {name}"));
        writeln!(text, "\n∂ln ω/∂ln p by branch at{} κ = ({a:.4}, {b:.4}, {c:.4})", label.unwrap_or_default())?;
        for ((key, by_row), number) in keys.iter().zip(&derivatives.numbers) {
            let cell = |(change, omega): (&Option<f64>, &f64)| match change {
                Some(change) => format!("{:>12}", significant(without_rounding(change * number / omega), 4)),
                None => format!("{:>12}", "–"),
            };
            let cells: String = by_row[*row].iter().zip(&found.omega[*row]).map(cell).collect();
            writeln!(text, "  {key:width$}{cells}")?;
        }
    }
    Ok(())
}

/// By how much the branches may be off: the most of each.
pub fn write_bound(text: &mut String, found: &BandSurvey) -> std::fmt::Result {
    let Some(bound) = &found.bound else { return Ok(()) };
    let branches = bound.first().map_or(0, Vec::len);
    let most = |branch: usize| -> Option<f64> {
        bound.iter().map(|row| row[branch]).try_fold(0.0, |most: f64, own| Some(most.max(own?)))
    };
    let cell = |branch: usize| format!("{:>12}", most(branch).map_or("–".to_owned(), |most| format!("{most:.1e}")));
    writeln!(text, "{:>26}{}   may be off by at most", "", (0..branches).map(cell).collect::<String>())
}
