//! The ledger over time: energies, what was lost or brought in, and the residual of the balance.

use super::bodies::{time_axis, values};
use crate::chart::{Axis, Chart, DASH_DOTTED, DASHED, DOTTED, LINE, Series};
use crate::draw::{Stroke, color};
use crate::error::PlotError;
use crate::recorded::RecordedScene;

const HEIGHT: f64 = 130.0;
const RESIDUAL_HEIGHT: f64 = 60.0;

/// Stores of energy in the order of the ledger, their names in the legend, and their colours.
const ENERGIES: [(&str, &str, usize); 5] = [
    ("energy_kinetic", "kinetic", 0),
    ("energy_gravity", "gravity", 2),
    ("energy_elastic", "elastic", 4),
    ("energy_contact", "contact", 1),
    ("energy_load", "springs", 3),
];

/// The work that stands out.
const DRIVE: &str = "work_drive";

/// Works in the order of the ledger, their names in the legend, and their colours.
const WORKS: [(&str, &str, usize); 11] = [
    ("work_repulsion", "work of repulsion", 4),
    ("work_damping", "work of damping", 1),
    ("work_friction", "work of friction", 3),
    ("work_adhesion", "work of adhesion", 5),
    ("work_viscosity", "work of viscosity", 0),
    ("work_contraction", "work of contraction", 2),
    (DRIVE, "work of the drive", 6),
    ("work_load", "work of loads", 4),
    ("work_support", "work of supports", 0),
    ("work_fluid", "work of the fluid", 5),
    ("work_constraint", "work of constraints", 5),
];

/// Energies and works over time, and below them the residual.
pub fn charts(recorded: &RecordedScene) -> Result<Vec<Chart>, PlotError> {
    let present = |entries: &[(&'static str, &'static str, usize)]| {
        entries.iter().copied().filter(|(array, _, _)| recorded.has(array)).collect::<Vec<_>>()
    };
    let (energies, works) = (present(&ENERGIES), present(&WORKS));
    if energies.is_empty() {
        return Err(PlotError::Nothing { what: "energy", reason: "the recording has no ledger" });
    }
    let arrays: Vec<&str> = energies.iter().chain(&works).map(|(array, _, _)| *array).collect();
    let stores = energies.len();
    let value = |row: &[&[f64]], k: usize| match row.get(k) {
        Some(entry) => entry[0],
        None => row[..stores].iter().map(|entry| entry[0]).sum(),
    };
    let mut lines = recorded.lines(&arrays, arrays.len() + 1, value)?;
    let sum = lines.pop().unwrap_or_default();
    let entries = energies.iter().chain(&works).zip(lines).enumerate();
    let mut series: Vec<Series> = entries
        .map(|(k, ((array, name, hue), points))| {
            let line = Series::solid(*name, points, *hue);
            // Among a dozen works that of the drive stands out: all others follow from it.
            let dash = if *array == DRIVE { DASH_DOTTED } else { DASHED };
            if k < stores { line } else { line.dashed(dash) }
        })
        .collect();
    let total = Stroke { color: color::INK, width: LINE, dash: DOTTED };
    series.insert(stores, Series { name: "sum of energies".into(), points: sum, stroke: total, arrows: false });
    let y = Axis::linear("energy, work", "J", values(&series));
    let x = time_axis(recorded)?;
    let title = "Energies, and works since the start".to_owned();
    let main = Chart { title, x: x.clone(), y, series, remarks: Vec::new(), height: HEIGHT };
    let mut charts = vec![main];
    if recorded.has("energy_residual") {
        let points = recorded.lines(&["energy_residual"], 1, |row, _| row[0][0])?.concat();
        let series =
            vec![Series { name: String::new(), points, stroke: Stroke::solid(color::INK, 0.9), arrows: false }];
        let y = Axis::linear("residual", "J", values(&series));
        let title = "Residual of the balance: energies gained less works done".to_owned();
        charts.push(Chart { title, x, y, series, remarks: Vec::new(), height: RESIDUAL_HEIGHT });
    }
    Ok(charts)
}
