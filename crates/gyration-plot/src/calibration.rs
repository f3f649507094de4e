//! What was measured and what was fitted to it: dots with their standard deviations, curves with their bands of 95 %.
//!
//! A table whose rows have no condition, or all the same, is drawn over the numbers of its rows, counted from one.

use crate::chart::{Axis, Chart, DASHED, LINE, Series, ShapeChart, Shapes};
use crate::draw::{Point, Stroke, color};
use crate::figure::{Figure, Panel};
use gyration_scene::unit_of;
use gyration_study::calibration::{Calibration, Curve, Fitted, Residual};

/// Height of a frame [pt].
const HEIGHT: f64 = 150.0;
/// Radius of dots [pt].
const RADIUS: f64 = 2.4;

/// The figure of a fit.
pub fn figure(calibration: &Calibration, fitted: &Fitted) -> Figure {
    let panels = calibration.curves(fitted).iter().map(|curve| panel(curve, fitted)).collect();
    let subtitle = format!("fit: χ² = {:.3} with {} degrees of freedom", fitted.chi_squared, fitted.degrees_of_freedom);
    Figure { title: calibration.title().to_owned(), subtitle, panels }
}

fn panel(curve: &Curve, fitted: &Fitted) -> Panel {
    let table = &curve.experiment;
    let is_own = |row: &&Residual| row.table == table.place() && curve.rows.contains(&row.row);
    let rows: Vec<&Residual> = fitted.residuals.iter().filter(is_own).collect();
    let over_rows = curve.points.len() < 2;
    let many = table.kind.shown().map_or(1.0, |(_, many)| many);
    let place = |row: &Residual| if over_rows { row.row as f64 + 1.0 } else { many * row.condition };
    let (measured, unit) = table.kind.measured();
    let ends = |row: &&Residual| [-1.0, 1.0].map(|side| [place(row), row.measured + side * row.deviation]);
    let dots = rows.iter().map(|row| [place(row), row.measured]).collect();
    let shapes = vec![
        Shapes::Intervals { ends: rows.iter().map(ends).collect(), stroke: Stroke::solid(color::INK, 0.8) },
        Shapes::Dots { at: dots, radius: RADIUS, fill: color::INK },
    ];
    // A point alone is drawn as a level line across the rows.
    let places = |condition: f64| if over_rows { vec![0.5, rows.len() as f64 + 0.5] } else { vec![many * condition] };
    let line = |side: f64| -> Vec<Point> {
        let points = curve.points.iter();
        points.flat_map(|p| places(p.condition).into_iter().map(move |x| [x, p.value + side * p.half_width])).collect()
    };
    let mut series = vec![Series::solid("fit", line(0.0), 0)];
    for (side, name) in [(-1.0, "95 %"), (1.0, "")] {
        let edge = Series::solid(name, line(side), 0).dashed(DASHED);
        series.push(Series { stroke: Stroke { width: 0.6 * LINE, ..edge.stroke }, ..edge });
    }
    let lines = series.iter().flat_map(|series| series.points.clone());
    let all: Vec<Point> = lines.chain(rows.iter().flat_map(ends)).collect();
    let level = all.iter().map(|point| point[0]);
    let x = match (&table.key, table.kind.condition().zip(table.kind.shown())) {
        _ if over_rows => Axis::linear("row", "", level),
        (Some(key), _) => Axis::linear(key, unit_of(key).unwrap_or_default(), level),
        (None, Some(((name, _), (unit, _)))) => Axis::linear(name, unit, level),
        (None, None) => Axis::linear("row", "", level),
    };
    let y = Axis::linear(measured, unit, all.iter().map(|point| point[1]));
    let branch = curve.branch.map_or(String::new(), |branch| format!(", branch {branch}"));
    let title = format!("{}, {}{branch}", table.place(), table.subject());
    let remarks = vec!["measured, with its".to_owned(), "standard deviation".to_owned()];
    Panel::ShapeChart(ShapeChart { chart: Chart { title, x, y, series, remarks, height: HEIGHT }, shapes })
}
