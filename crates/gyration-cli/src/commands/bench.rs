//! `gyration bench`: how fast this machine runs standard pieces of work, each beside its floor.

use super::picture;
use crate::arguments::BenchArguments;
use crate::error::{CliError, code};
use crate::output;
use crate::provenance::provenance;
use gyration_benchmark::{Arithmetic, BenchmarkRow, Size, measure};
use gyration_plot::{FloorBar, floors};
use gyration_sim::format::significant;
use serde_json::json;
use std::path::PathBuf;

/// Measures, and prints each row as soon as it is known.
pub fn execute(arguments: &BenchArguments) -> Result<u8, CliError> {
    let format = picture::format(arguments.plot.as_deref())?;
    let size = if arguments.quick { Size::Quick } else { Size::Whole };
    let arithmetic = Arithmetic::measured();
    if !arguments.json {
        output::print(&head(&arithmetic))?;
    }
    let mut told = Ok(());
    let rows = measure(&arithmetic, size, |row| {
        if !arguments.json && told.is_ok() {
            told = output::print(&line(row));
        }
    });
    told?;
    if arguments.json {
        output::print(&format!("{:#}\n", as_json(&arithmetic, &rows)))?;
    }
    if let Some(path) = &arguments.plot {
        let bars = rows.iter().filter_map(|row| Some(FloorBar { work: row.work.clone(), ratio: row.ratio()? }));
        let figure = floors(&machine(&arithmetic), &bars.collect::<Vec<_>>());
        picture::write(&figure, Some(path), format, PathBuf::new)?;
    }
    Ok(code::DONE)
}

fn machine(arithmetic: &Arithmetic) -> String {
    let processors = gyration_threads::processors();
    format!(
        "{} {}, processors: {processors}; registers of {} numbers, {} milliard products and sums a second on one \
         thread",
        std::env::consts::ARCH,
        std::env::consts::OS,
        arithmetic.lanes,
        significant(1e-9 * arithmetic.operations, 3)
    )
}

fn head(arithmetic: &Arithmetic) -> String {
    format!(
        "{}\ntimes of a processor, the fastest of some runs; other work on the machine makes them longer\n\n\
         {:>12} {:>12} {:>7}  work\n",
        machine(arithmetic),
        "time",
        "floor",
        "times"
    )
}

fn line(row: &BenchmarkRow) -> String {
    let floor = row.floor.as_ref().map_or("–".to_owned(), |floor| duration(floor.seconds));
    let ratio = row.ratio().map_or("–".to_owned(), |ratio| significant(ratio, 2));
    let of = row.floor.as_ref().map(|floor| format!("floor: {}", floor.of));
    let remark = Some(&row.remark).filter(|remark| !remark.is_empty()).cloned();
    let beside: Vec<String> = remark.into_iter().chain(of).collect();
    let beside = if beside.is_empty() { String::new() } else { format!(" ({})", beside.join("; ")) };
    format!("{:>12} {floor:>12} {ratio:>7}  {}{beside}\n", duration(row.seconds), row.work)
}

/// In the unit that makes a number between one and a thousand.
fn duration(seconds: f64) -> String {
    let units = [(1.0, "s"), (1e-3, "ms"), (1e-6, "µs")];
    let (factor, unit) = units.into_iter().find(|(factor, _)| seconds >= *factor).unwrap_or((1e-9, "ns"));
    format!("{} {unit}", significant(seconds / factor, 3))
}

fn as_json(arithmetic: &Arithmetic, rows: &[BenchmarkRow]) -> serde_json::Value {
    let provenance = provenance();
    let rows: Vec<_> = rows
        .iter()
        .map(|row| {
            json!({
                "key": row.key, "work": row.work, "seconds": row.seconds, "floor": row.floor,
                "times_floor": row.ratio(), "remark": row.remark,
            })
        })
        .collect();
    json!({
        "version": provenance.version, "commit": provenance.commit,
        "machine": {
            "architecture": std::env::consts::ARCH, "system": std::env::consts::OS,
            "processors": gyration_threads::processors(),
            "arithmetic": arithmetic,
        },
        "rows": rows,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_have_the_unit_that_keeps_them_short() {
        let words = [3.2e-7, 1.5e-6, 0.0123, 4.0, 75.0].map(duration);
        assert_eq!(words, ["320 ns", "1.5 µs", "12.3 ms", "4 s", "75 s"]);
    }
}
