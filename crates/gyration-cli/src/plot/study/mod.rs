//! Pictures of studies: how often, how on average, where.
//!
//! ```text
//! table, request → kind (histogram, curve, map, scatter) → chart with areas, dots, intervals → figure
//! ```
//!
//! | columns                             | picture, unless something else is asked for                     |
//! |-------------------------------------|------------------------------------------------------------------|
//! | a list is kept                      | scatter: its numbers over the axis of the grid                   |
//! | two axes of the grid, or more       | map: cells of the first two, coloured by what is kept            |
//! | one axis of the grid                | curve: means or shares with intervals of 95 %                    |
//! | none                                | histogram of what is kept                                        |
//!
//! The same table gives the same bytes.

mod curve;
mod histogram;
mod map;
mod palette;
mod request;
mod scatter;
mod source;
mod statistics;
mod table;
#[cfg(test)]
mod tests;

use super::chart::{Chart, DASH_DOTTED, DASHED, DOTTED, Field, Figure, LINE, Panel, Series, Shapes};
use super::draw::{Color, Stroke, color};
pub use request::{Kind, Measure, Request};
pub use table::{Column, Role, Table, Values};

/// Why there is no picture of a study.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{problem}\n  fix: {fix}")]
pub struct Unfit {
    /// What is wrong.
    pub problem: String,
    /// What to do.
    pub fix: String,
}

impl Unfit {
    fn new(problem: impl Into<String>, fix: impl Into<String>) -> Self {
        Self { problem: problem.into(), fix: fix.into() }
    }
}

/// Height of the frame of a chart [pt].
const HEIGHT: f64 = 240.0;
/// Width of the samples of areas in legends [pt].
const SWATCH: f64 = 7.0;

/// The picture of a table.
///
/// # Errors
/// [`Unfit`] where a column does not exist or does not suit the kind of picture.
pub fn figure(table: &Table, request: &Request) -> Result<Figure, Unfit> {
    if table.len() == 0 {
        return Err(Unfit::new("the table has no rows yet", "wait for the first runs"));
    }
    let kind = request.kind.unwrap_or_else(|| kind_of(table, request));
    let panels = match kind {
        Kind::Histogram => histogram::panels(table, request)?,
        Kind::Curve => vec![curve::panel(table, request)?],
        Kind::Map => vec![map::panel(table, request)?],
        Kind::Scatter => vec![scatter::panel(table, request)?],
    };
    let title = request.title.clone().unwrap_or_else(|| table.title.clone());
    let told = [(table.failures(), "failed"), (table.early(), "ended early")];
    let told: Vec<String> =
        told.iter().filter(|(count, _)| *count > 0).map(|(count, what)| format!(", {count} of them {what}")).collect();
    Ok(Figure { title, subtitle: format!("{} runs{}", table.len(), told.concat()), panels })
}

/// The kind of picture that suits the columns.
fn kind_of(table: &Table, request: &Request) -> Kind {
    let axis = |name: &Option<String>| match table.column(name.as_deref()?).ok()?.role {
        Role::Axis(axis) => Some(axis),
        _ => None,
    };
    let (x, y) = (axis(&request.x), axis(&request.y));
    let measure = request.y.as_deref().map(Measure::read);
    let measured = measure.as_ref().and_then(|measure| table.column(&measure.column).ok());
    if measured.or_else(|| kept(table).ok()).is_some_and(|column| matches!(column.values, Values::Lists(_))) {
        return Kind::Scatter;
    }
    let axes = table.axes().len();
    match (&request.x, &request.y) {
        (Some(_), Some(_)) if x.is_some() && y.is_some() && x != y => Kind::Map,
        (Some(_), _) if x.is_some() => Kind::Curve,
        (Some(_), Some(_)) => Kind::Scatter,
        (Some(_), None) => Kind::Histogram,
        (None, Some(_)) if axes > 0 => Kind::Curve,
        (None, None) if axes > 1 => Kind::Map,
        (None, None) if axes == 1 => Kind::Curve,
        _ => Kind::Histogram,
    }
}

/// The first column of what is kept; the outcome if nothing is.
fn kept(table: &Table) -> Result<&Column, Unfit> {
    table.of(Role::Kept).next().map_or_else(|| table.column("outcome"), Ok)
}

/// The column of a name, or the axis of the grid of this index.
fn axis_or<'a>(table: &'a Table, name: Option<&str>, index: usize) -> Result<&'a Column, Unfit> {
    let missing = || Unfit::new("the study has no such axis of a grid", "say which columns: --x NAME --y NAME");
    name.map_or_else(|| table.axes().get(index).copied().ok_or_else(missing), |name| table.column(name))
}

/// The entry of an area or of dots in a legend.
fn swatch(name: impl Into<String>, color: Color) -> Series {
    Series { name: name.into(), points: Vec::new(), stroke: Stroke::solid(color, SWATCH), arrows: false }
}

/// The entry of a legend that says what the next ones are.
fn heading(name: impl Into<String>) -> Series {
    swatch(name, Color { rgb: [0xFF; 3], opacity: 0.0 })
}

/// The colours of numbers, of this name and unit.
///
/// # Errors
/// [`Unfit`] if they are to be logarithmic, and none is above zero.
fn coloured_by(request: &Request, what: (&str, &str), values: Vec<f64>) -> Result<palette::Palette, Unfit> {
    if request.is_logarithmic("colour") || request.is_logarithmic("color") {
        with_logarithms(what.0, &values)?;
        return Ok(palette::Palette::logarithmic(what, values));
    }
    Ok(palette::Palette::of(what, values))
}

/// Refuses numbers of which none has a logarithm.
fn with_logarithms(name: &str, values: &[f64]) -> Result<(), Unfit> {
    match values.iter().any(|value| *value > 0.0) {
        true => Ok(()),
        false => Err(Unfit::new(
            format!("no number of `{name}` is above zero: none has a logarithm"),
            "leave it out of `logarithmic`",
        )),
    }
}

/// The remark on what a logarithmic scale leaves out.
fn left_out(count: usize) -> Vec<String> {
    if count == 0 { Vec::new() } else { vec![format!("{count} left out: not above zero")] }
}

/// What is known from elsewhere, above everything else: lines, or dots in a ring.
fn references(request: &Request, shapes: &mut Vec<Shapes>, series: &mut Vec<Series>) {
    for (index, reference) in request.reference.iter().enumerate() {
        let ink = if index == 0 { color::INK } else { color::GREY };
        if reference.line {
            let dash = [DASHED, DOTTED, DASH_DOTTED][index % 3];
            let stroke = Stroke { dash, ..Stroke::solid(color::INK, LINE) };
            let points = reference.points.clone();
            series.push(Series { name: reference.name.clone(), points, stroke, arrows: false });
        } else {
            let dots = |radius: f64, fill: Color| Shapes::Dots { at: reference.points.clone(), radius, fill };
            shapes.extend([dots(4.4, color::WHITE), dots(3.4, ink)]);
            series.push(swatch(reference.name.clone(), ink));
        }
    }
}

/// A chart over its shapes.
fn painted(chart: Chart, shapes: Vec<Shapes>) -> Panel {
    Panel::Field(Field { chart, shapes })
}
