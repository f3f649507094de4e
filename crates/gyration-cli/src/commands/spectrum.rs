//! `gyration spectrum`: how the energy of a ring is shared out among the waves of its cell.

use super::export::explain;
use super::picture;
use crate::arguments::SpectrumArguments;
use crate::error::{CliError, code};
use crate::output;
use crate::waiting::waiting;
use gyration_record::Recording;
use gyration_sim::format::significant;
use gyration_sim::{BranchSpectrum, NoRingSpectrum, RingSpectrum};
use std::fmt::Write as _;
use std::path::PathBuf;

/// So many branches are printed, and so many that gain or lose energy.
const SHOWN: usize = 20;
const CHANGES: usize = 5;
/// A part of the energy below this is none to print.
const LEAST: f64 = 1e-9;

/// Prints the strongest branches of a recording, and who gained energy from whom.
pub fn execute(arguments: &SpectrumArguments) -> Result<u8, CliError> {
    // Before what takes long.
    let format = picture::format(arguments.plot.as_deref())?;
    let recording = Recording::open(&arguments.recording)?;
    let name = arguments.recording.display().to_string();
    let found =
        waiting(format!("projecting {name} on waves"), true, || RingSpectrum::of(&recording, arguments.energies));
    let found = found.map_err(|error| refused(&recording, error))?;
    found.warnings.iter().for_each(|warning| output::say(&format!("warning: {warning}")));
    if let Some(path) = &arguments.plot {
        picture::write(&gyration_plot::spectrum(&recording, &found), Some(path), format, PathBuf::new)?;
    }
    let text = match arguments.json {
        true => format!("{}\n", serde_json::json!(found)),
        false => in_words(&name, &found),
    };
    output::print(&text)?;
    Ok(code::DONE)
}

fn refused(recording: &Recording, error: NoRingSpectrum) -> CliError {
    let fix = match error {
        NoRingSpectrum::Replay(error) => return explain(recording, error),
        NoRingSpectrum::NoLattice => "give the cell in `[lattice]`, with `repeat`, and run the scene anew",
        NoRingSpectrum::NoRing | NoRingSpectrum::TooMany(_) => {
            "write periodic = true, or a list with true where the lattice has no ends, and run the scene anew"
        }
        NoRingSpectrum::Bands(_) => "see `gyration bands` of its scene",
        NoRingSpectrum::NoNormalModes(_) => "`gyration bands` of its scene has the waves themselves",
        NoRingSpectrum::TooFar { .. } => "run the scene with less energy, or to an earlier time.end",
        NoRingSpectrum::Interrupted => "take a run of fewer cells or samples",
    };
    CliError::arguments(error.to_string(), fix)
}

fn in_words(name: &str, found: &RingSpectrum) -> String {
    let mut text = format!("{name}\n");
    // Writing to a string does not fail.
    let _ = write_head(&mut text, found);
    let _ = write_branches(&mut text, found);
    let _ = write_changes(&mut text, found);
    text
}

fn write_head(text: &mut String, found: &RingSpectrum) -> std::fmt::Result {
    let (waves, branches) = (found.kappa.len(), found.omega.first().map_or(0, Vec::len));
    let last = found.t.last().copied().unwrap_or(0.0);
    writeln!(
        text,
        "{waves} wave vectors with {branches} branches each, {} samples to t = {} s",
        found.t.len(),
        significant(last, 6)
    )?;
    writeln!(text, "energy of all branches  {} J, mean over time\n", significant(found.mean_energy(), 8))
}

/// The strongest branches, what bands have of them, and what is measured.
fn write_branches(text: &mut String, found: &RingSpectrum) -> std::fmt::Result {
    let total = found.mean_energy();
    let mut strongest: Vec<(usize, &BranchSpectrum)> = found.branches.iter().enumerate().collect();
    strongest.sort_by(|a, b| b.1.energy.abs().total_cmp(&a.1.energy.abs()));
    let count = strongest.len();
    strongest.retain(|(_, branch)| branch.energy.abs() > LEAST * total.abs());
    let told = strongest.len().min(SHOWN);
    let heads = ["share [%]", "ω of bands", "ω measured", "δ to first order", "δ measured"];
    writeln!(text, "{:>8}{:>9}{:>9}  branch{}", "κ₁", "κ₂", "κ₃", heads.map(|head| format!("{head:>18}")).concat())?;
    for (number, branch) in &strongest[..told] {
        let [a, b, c] = branch.kappa;
        let (wave, own) = (number / found.omega[0].len(), branch.branch);
        let number =
            |value: Option<f64>, digits: i32| value.map_or_else(|| "-".to_owned(), |it| significant(it, digits));
        let columns = [
            number(Some(100.0 * branch.energy / total), 6),
            number(Some(found.omega[wave][own]), 8),
            number(branch.omega, 8),
            number(Some(found.decay[wave][own]), 6),
            number(branch.width, 6),
        ];
        let columns = columns.map(|column| format!("{column:>18}")).concat();
        writeln!(text, "{a:>8.4}{b:>9.4}{c:>9.4}{own:>8}{columns}")?;
    }
    match count - told {
        0 => Ok(()),
        others => writeln!(text, "and {others} others with less"),
    }
}

/// Who gained and who lost energy, from the first quarter of the time to the last.
fn write_changes(text: &mut String, found: &RingSpectrum) -> std::fmt::Result {
    let total = found.mean_energy();
    let changes = found.change.iter().flatten().zip(&found.branches);
    let mut changes: Vec<(f64, &BranchSpectrum)> =
        changes.map(|(change, branch)| (*change, branch)).filter(|it| it.0.abs() > LEAST * total.abs()).collect();
    changes.sort_by(|a, b| b.0.total_cmp(&a.0));
    let gained = changes.iter().take_while(|it| it.0 > 0.0).take(CHANGES);
    let lost = changes.iter().rev().take_while(|it| it.0 < 0.0).take(CHANGES);
    for (word, list) in [("gained", gained.collect::<Vec<_>>()), ("lost", lost.collect())] {
        if list.is_empty() {
            continue;
        }
        writeln!(text, "\n{word} most from the first quarter of the time to the last")?;
        for (change, BranchSpectrum { kappa: [a, b, c], branch, .. }) in list {
            let part = significant(100.0 * change / total, 6);
            writeln!(text, "{a:>8.4}{b:>9.4}{c:>9.4}{branch:>8}{:>18} J, {part} % of all", significant(*change, 6))?;
        }
    }
    Ok(())
}
