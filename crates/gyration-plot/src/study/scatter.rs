//! A dot a run, or as many as its list is long: what depends on chance, and bifurcation diagrams.

use super::layout::{HEIGHT, Layers, left_out};
use super::palette::{self, with_logarithms};
use super::request::{Ordinate, PlotRequest};
use super::table::{ColumnValues, Role, RunTable, TableColumn};
use crate::chart::{Axis, AxisScale, Series, Shapes};
use crate::draw::{Point, color};
use crate::error::PlotError;
use crate::figure::Panel;
use std::collections::BTreeMap;

/// With more dots than this they are small.
const MANY: usize = 2000;

/// The chart of a table.
pub fn panel(table: &RunTable, request: &PlotRequest) -> Result<Panel, PlotError> {
    let x = match &request.x {
        Some(name) => table.column(name)?,
        None => table.axis_or(None, 0).or_else(|problem| table.of(Role::Random).next().ok_or(problem))?,
    };
    let y = match &request.y {
        Some(name) => table.column(&Ordinate::read(name).column)?,
        None => table.kept()?,
    };
    let points: Vec<(usize, Point)> = (0..table.len()).flat_map(|run| points(x, y, run)).collect();
    if points.is_empty() {
        return Err(PlotError::arguments(
            format!("no run has numbers of both `{}` and `{}`", x.name, y.name),
            "name columns of numbers: --x NAME --y NAME",
        ));
    }
    let radius = if points.len() > MANY { 0.6 } else { 1.6 };
    let mut layers = match &request.colour {
        Some(name) => coloured(&points, table.column(name)?, request, radius)?,
        None => {
            let at = points.iter().map(|(_, point)| *point).collect();
            Layers { shapes: vec![Shapes::Dots { at, radius, fill: color::series(0) }], series: Vec::new() }
        }
    };
    layers.add_references(request);
    let beside = || request.reference.iter().flat_map(|reference| &reference.points);
    let axis = |column: &TableColumn, side: &str, k: usize| -> Result<Axis, PlotError> {
        let own: Vec<f64> = points.iter().map(|(_, point)| point[k]).collect();
        let values = own.iter().copied().chain(beside().map(|point| point[k]));
        if request.is_logarithmic(side) || column.scale() == AxisScale::Logarithmic {
            with_logarithms(&column.name, &own)?;
            return Ok(Axis::logarithmic(&column.name, &column.unit, values));
        }
        Ok(Axis::linear(&column.name, &column.unit, values))
    };
    let (x, y) = (axis(x, "x", 0)?, axis(y, "y", 1)?);
    let is_out = |axis: &Axis, value: f64| axis.scale == AxisScale::Logarithmic && value <= 0.0;
    let without = points.iter().filter(|(_, point)| is_out(&x, point[0]) || is_out(&y, point[1])).count();
    let remarks = left_out(without);
    Ok(layers.panel(x, y, remarks, HEIGHT))
}

/// The dots of a run; a list goes with a number, or with a list of the same length.
fn points(x: &TableColumn, y: &TableColumn, run: usize) -> Vec<(usize, Point)> {
    let numbers = |column: &TableColumn| match &column.values {
        ColumnValues::Numbers(values) => vec![values[run]],
        ColumnValues::Lists(lists) => lists[run].clone(),
        ColumnValues::Words(_) => Vec::new(),
    };
    let (x, y) = (numbers(x), numbers(y));
    let count = if x.is_empty() || y.is_empty() { 0 } else { x.len().max(y.len()) };
    let at = |values: &[f64], k: usize| if values.len() == 1 { values[0] } else { *values.get(k).unwrap_or(&f64::NAN) };
    let point = |k: usize| (run, [at(&x, k), at(&y, k)]);
    (0..count).map(point).filter(|(_, point)| point.iter().all(|value| value.is_finite())).collect()
}

fn coloured(
    points: &[(usize, Point)],
    column: &TableColumn,
    request: &PlotRequest,
    radius: f64,
) -> Result<Layers, PlotError> {
    let mut dots: BTreeMap<usize, Vec<Point>> = BTreeMap::new();
    match &column.values {
        ColumnValues::Words(words) => {
            let names = column.categories();
            for (run, point) in points {
                if let Some(index) = words[*run].as_ref().and_then(|word| names.iter().position(|name| name == word)) {
                    dots.entry(index).or_default().push(*point);
                }
            }
            let shapes = |(index, at)| Shapes::Dots { at, radius, fill: palette::category(index) };
            let entry = |(index, name): (usize, &String)| Series::swatch(name.clone(), palette::category(index));
            let legend = std::iter::once(Series::heading(&column.name)).chain(names.iter().enumerate().map(entry));
            Ok(Layers { shapes: dots.into_iter().map(shapes).collect(), series: legend.collect() })
        }
        ColumnValues::Numbers(values) => {
            let palette = palette::requested(request, column, &column.name, values)?;
            for (run, point) in points {
                if let Some(shade) = palette.shade(values[*run]) {
                    dots.entry(shade).or_default().push(*point);
                }
            }
            let shapes = |(shade, at)| Shapes::Dots { at, radius, fill: palette.colour(shade) };
            Ok(Layers { shapes: dots.into_iter().map(shapes).collect(), series: palette.legend() })
        }
        ColumnValues::Lists(_) => Err(PlotError::arguments(
            format!("`{}` has several numbers a run, which no colour tells", column.name),
            "name another --colour",
        )),
    }
}
