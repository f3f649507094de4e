//! What `gyration bands` prints of complex bands, and of a cell under strain.

use gyration_sim::format::{significant, vector};
use gyration_sim::survey::{ComplexBandSurvey, StrainSurvey};
use std::fmt::Write as _;

/// Wave vectors of a frequency that are printed at most.
const MOST: usize = 4;

/// A line a frequency: the κ that are nearest to running.
pub fn complex(title: &str, found: &ComplexBandSurvey) -> String {
    let mut text =
        format!("{title}\n\n{:>12}   κ, real and imaginary part; the decay a cell is 2π|Im κ|\n", "ω [rad/s]");
    for (omega, all) in found.omega.iter().zip(&found.kappa) {
        let cell = |[re, im]: &[f64; 2]| match *im {
            0.0 => format!("  {re:>8.5}           "),
            im => format!("  {re:>8.5} {im:>+9.5}i"),
        };
        let cells: String = all.iter().take(MOST).map(cell).collect();
        let left = all.len().saturating_sub(MOST);
        let more = if left > 0 { format!("  and {left} more") } else { String::new() };
        // Writing to a string does not fail.
        let _ = writeln!(text, "{:>12}  {}{more}", significant(*omega, 6), cells.trim_end());
    }
    text
}

/// A line a value: s, stress, the least ω²; then what becomes unstable first.
pub fn strained(title: &str, found: &StrainSurvey) -> String {
    let mut text = format!("{title}\n\n");
    let _ = write_path(&mut text, found);
    let _ = write_instability(&mut text, found);
    text
}

fn write_path(text: &mut String, found: &StrainSurvey) -> std::fmt::Result {
    writeln!(text, "{:>8}{:>13}{:>13}{:>13}{:>14}   at κ", "s", "σ_xx", "σ_yy", "σ_zz", "least ω²")?;
    for row in &found.path {
        let stress: String = (0..3).map(|i| format!("{:>13}", significant(row.stress[i][i], 6))).collect();
        let least = row.least_omega2.map_or("–".to_owned(), |least| significant(least, 6));
        let [x, y, z] = row.at_kappa;
        writeln!(text, "{:>8.4}{stress}{least:>14}   ({x:.4}, {y:.4}, {z:.4})", row.s)?;
    }
    writeln!(text)
}

fn write_instability(text: &mut String, found: &StrainSurvey) -> std::fmt::Result {
    let Some(first) = &found.instability else { return writeln!(text, "stable all along the path") };
    let kind = if first.macroscopic { "long waves grow along" } else { "a pattern grows with" };
    writeln!(text, "unstable from s = {}: {kind} κ = {}", significant(first.s, 8), vector(&first.kappa))
}
