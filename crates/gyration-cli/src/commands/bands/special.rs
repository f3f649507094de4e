//! What `gyration bands` prints of complex bands, of phases, and of a cell under strain.

use gyration_sim::format::{significant, vector};
use gyration_sim::survey::{ComplexBandSurvey, StrainSurvey, TopologySurvey};
use std::f64::consts::PI;
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

/// A line a direction with the Zak phase of each branch; then Chern numbers, and gaps with what crosses them.
pub fn topology(title: &str, found: &TopologySurvey) -> String {
    let mut text = format!("{title}\n\n");
    let _ = write_phases(&mut text, found);
    text
}

fn write_phases(text: &mut String, found: &TopologySurvey) -> std::fmt::Result {
    writeln!(text, "Zak phases by branch [π]")?;
    for (direction, phases) in found.directions.iter().zip(&found.zak) {
        let cell = |phase: &Option<f64>| match phase {
            // Zero has no sign.
            Some(phase) => format!("{:>10.5}", (1e5 * phase / PI).round() / 1e5 + 0.0),
            None => format!("{:>10}", "–"),
        };
        writeln!(text, "  along κ{}{}", direction, phases.iter().map(cell).collect::<String>())?;
    }
    if found.chern.is_empty() {
        return Ok(());
    }
    writeln!(text, "\nChern numbers")?;
    for group in found.chern.iter().map(|group| &group.0) {
        let number = group.number.map_or("–".to_owned(), |number| number.to_string());
        match group.branches[..] {
            [first, .., last] => writeln!(text, "  branches {first} to {last}, which touch: {number}")?,
            _ => writeln!(text, "  branch {}: {number}", group.branches[0])?,
        }
    }
    writeln!(text)?;
    if found.gaps.is_empty() {
        return writeln!(text, "no gaps between branches");
    }
    for gap in &found.gaps {
        let (from, to) = (significant(gap.from, 6), significant(gap.to, 6));
        let edges = match gap.chern {
            0 => "nothing must run along an edge".to_owned(),
            number => format!("Chern numbers below add up to {number}: as many branches cross it on an edge"),
        };
        writeln!(text, "gap {from} … {to} rad/s above branch {}, {edges}", gap.below)?;
    }
    Ok(())
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
