//! Colours of the numbers of a table, as a request asks for them, and of its categories.

use super::request::PlotRequest;
use super::table::TableColumn;
use crate::chart::Palette;
use crate::draw::{Color, color};
use crate::error::PlotError;

/// The palette of values in the unit of a column, evenly or by logarithms as is asked for; `name` stands in the legend.
///
/// # Errors
/// [`PlotError::Arguments`] if they are to be logarithmic, and none is above zero.
pub fn requested(
    request: &PlotRequest,
    column: &TableColumn,
    name: &str,
    values: &[f64],
) -> Result<Palette, PlotError> {
    if request.is_logarithmic("colour") || request.is_logarithmic("color") {
        with_logarithms(name, values)?;
        return Ok(Palette::logarithmic(name, &column.unit, values.iter().copied()));
    }
    Ok(Palette::of(name, &column.unit, values.iter().copied()))
}

/// Refuses numbers of which none has a logarithm.
pub fn with_logarithms(name: &str, values: &[f64]) -> Result<(), PlotError> {
    match values.iter().any(|value| *value > 0.0) {
        true => Ok(()),
        false => Err(PlotError::arguments(
            format!("no number of `{name}` is above zero: none has a logarithm"),
            "leave it out of `logarithmic`",
        )),
    }
}

/// The colour of a category: those of series, then tints of them.
pub fn category(index: usize) -> Color {
    let round = index / color::SERIES.len();
    color::series(index).tint([1.0, 0.5, 0.25][round.min(2)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fourteen_categories_have_colours_of_their_own() {
        let mut colours: Vec<[u8; 3]> = (0..14).map(|index| category(index).rgb).collect();
        colours.sort_unstable();
        colours.dedup();
        assert_eq!(colours.len(), 14);
    }
}
