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
mod layout;
mod map;
mod palette;
mod request;
mod scatter;
mod source;
mod statistics;
mod table;
#[cfg(test)]
mod tests;

use crate::error::PlotError;
use crate::figure::Figure;
use gyration_study::{DataFrame, Study};
use request::Ordinate;
use table::{ColumnValues, Role, RunTable};

pub use request::{PlotKind, PlotRequest};

/// The picture of a table, which is called `name` where its study has no title: what is asked for, else what its study
/// says of it now, else what it said when the table was made, else what the columns suggest.
///
/// # Errors
/// [`PlotError::Arguments`] where a column does not exist or does not suit the kind of picture.
pub fn of_table(frame: &DataFrame, name: &str, asked: PlotRequest, study: Option<&Study>) -> Result<Figure, PlotError> {
    let stated = study.map_or_else(|| PlotRequest::of_frame(frame), PlotRequest::of_study)?;
    figure(&RunTable::of_frame(frame, name), &asked.or(stated))
}

/// The picture that a request asks for.
fn figure(table: &RunTable, request: &PlotRequest) -> Result<Figure, PlotError> {
    if table.len() == 0 {
        return Err(PlotError::arguments("the table has no rows yet", "wait for the first runs"));
    }
    let kind = request.kind.unwrap_or_else(|| kind_of(table, request));
    let panels = match kind {
        PlotKind::Histogram => histogram::panels(table, request)?,
        PlotKind::Curve => vec![curve::panel(table, request)?],
        PlotKind::Map => vec![map::panel(table, request)?],
        PlotKind::Scatter => vec![scatter::panel(table, request)?],
    };
    let title = request.title.clone().unwrap_or_else(|| table.title.clone());
    let told = [(table.failures(), "failed"), (table.early(), "ended early")];
    let told: Vec<String> =
        told.iter().filter(|(count, _)| *count > 0).map(|(count, what)| format!(", {count} of them {what}")).collect();
    Ok(Figure { title, subtitle: format!("{} runs{}", table.len(), told.concat()), panels })
}

/// The kind of picture that suits the columns.
fn kind_of(table: &RunTable, request: &PlotRequest) -> PlotKind {
    let axis = |name: &Option<String>| match table.column(name.as_deref()?).ok()?.role {
        Role::Axis(axis) => Some(axis),
        _ => None,
    };
    let (x, y) = (axis(&request.x), axis(&request.y));
    let measure = request.y.as_deref().map(Ordinate::read);
    let measured = measure.as_ref().and_then(|measure| table.column(&measure.column).ok());
    if measured.or_else(|| table.kept().ok()).is_some_and(|column| matches!(column.values, ColumnValues::Lists(_))) {
        return PlotKind::Scatter;
    }
    let axes = table.axes().len();
    match (&request.x, &request.y) {
        (Some(_), Some(_)) if x.is_some() && y.is_some() && x != y => PlotKind::Map,
        (Some(_), _) if x.is_some() => PlotKind::Curve,
        (Some(_), Some(_)) => PlotKind::Scatter,
        (Some(_), None) => PlotKind::Histogram,
        (None, Some(_)) if axes > 0 => PlotKind::Curve,
        (None, None) if axes > 1 => PlotKind::Map,
        (None, None) if axes == 1 => PlotKind::Curve,
        _ => PlotKind::Histogram,
    }
}
