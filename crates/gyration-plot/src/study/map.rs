//! Cells over two parameters of the grid: basins coloured by their outcome, fields of a number.
//!
//! A cell reaches halfway to its neighbours, on the scale on which the parameter is even. Of several runs of a cell the
//! most frequent word is shown, or the mean of the numbers; of a list it is the change from its first number to its
//! last.

use super::layout::{Layers, left_out};
use super::palette;
use super::request::{Ordinate, PlotRequest};
use super::table::{ColumnValues, Role, RunTable, TableColumn};
use crate::chart::{Axis, AxisScale, Palette, Series, Shapes};
use crate::draw::Point;
use crate::error::PlotError;
use crate::figure::Panel;
use std::collections::BTreeMap;

/// Height of the frame [pt].
const HEIGHT: f64 = 330.0;

/// The chart of a table.
pub fn panel(table: &RunTable, request: &PlotRequest) -> Result<Panel, PlotError> {
    let [x, y] = [(request.x.as_deref(), 0), (request.y.as_deref(), 1)]
        .map(|(name, index)| table.axis_or(name, index).and_then(CellEdges::of));
    let (x, y) = (x?, y?);
    let shown = match request.colour.as_deref() {
        Some(name) => Ordinate::read(name),
        None => Ordinate { column: table.kept()?.name.clone(), values: Vec::new() },
    };
    let column = table.column(&shown.column)?;
    let cells = cells(&x, &y, table.len());
    let name = request.colour.as_ref().unwrap_or(&column.name);
    let mut without = 0;
    let mut of_numbers = |values: &[f64]| -> Result<Layers, PlotError> {
        let means = means(&cells, values);
        let shown: Vec<f64> = means.iter().flatten().copied().collect();
        let palette = palette::requested(request, column, name, &shown)?;
        without = means.iter().flatten().filter(|mean| palette.shade(**mean).is_none()).count();
        Ok(of_numbers(&cells, &means, &palette))
    };
    let mut layers = match &column.values {
        ColumnValues::Words(words) if shown.values.is_empty() => of_words(&cells, name, &column.categories(), words),
        ColumnValues::Words(words) => {
            let hit = |word: &Option<String>| {
                word.as_ref().map_or(f64::NAN, |word| f64::from(u8::from(shown.values.contains(word))))
            };
            of_numbers(&words.iter().map(hit).collect::<Vec<_>>())?
        }
        ColumnValues::Numbers(values) => of_numbers(values)?,
        ColumnValues::Lists(lists) => {
            let change = |list: &Vec<f64>| list.last().zip(list.first()).map_or(f64::NAN, |(last, first)| last - first);
            of_numbers(&lists.iter().map(change).collect::<Vec<_>>())?
        }
    };
    layers.add_references(request);
    let remarks = left_out(without);
    Ok(layers.panel(x.axis(), y.axis(), remarks, HEIGHT))
}

/// A parameter and the edges of its cells.
struct CellEdges<'a> {
    column: &'a TableColumn,
    numbers: &'a [f64],
    levels: Vec<f64>,
    edges: Vec<f64>,
}

impl<'a> CellEdges<'a> {
    fn of(column: &'a TableColumn) -> Result<Self, PlotError> {
        let levels = column.levels();
        let (Some(numbers), true) = (column.numbers(), levels.len() > 1) else {
            return Err(PlotError::arguments(
                format!("`{}` has not several numbers for the cells of a map", column.name),
                "a map needs two axes of numbers: --x NAME --y NAME, or another --kind",
            ));
        };
        if !matches!(column.role, Role::Axis(_)) && 2 * levels.len() > numbers.len() {
            return Err(PlotError::arguments(
                format!("`{}` has hardly a value twice: there are no cells of a map", column.name),
                "a map needs two axes of the grid; for random numbers there is --kind scatter",
            ));
        }
        let even = |value: f64| if column.scale() == AxisScale::Logarithmic { libm::log(value) } else { value };
        let back = |value: f64| if column.scale() == AxisScale::Logarithmic { libm::exp(value) } else { value };
        let places: Vec<f64> = levels.iter().map(|level| even(*level)).collect();
        let last = places.len() - 1;
        let mut edges = vec![back(1.5 * places[0] - 0.5 * places[1])];
        edges.extend(places.windows(2).map(|pair| back(0.5 * (pair[0] + pair[1]))));
        edges.push(back(1.5 * places[last] - 0.5 * places[last - 1]));
        Ok(Self { column, numbers, levels, edges })
    }

    fn place(&self, run: usize) -> Option<usize> {
        self.column.level(&self.levels, self.numbers[run])
    }

    fn axis(&self) -> Axis {
        let (low, high) = (self.edges[0], self.edges[self.edges.len() - 1]);
        Axis { scale: self.column.scale(), ..Axis::exact(&self.column.name, &self.column.unit, low, high) }
    }
}

/// The corners of a cell and its runs.
struct MapCell {
    corners: [Point; 2],
    runs: Vec<usize>,
}

/// The cells that have runs, from the lower left.
fn cells(x: &CellEdges, y: &CellEdges, count: usize) -> Vec<MapCell> {
    let mut runs: BTreeMap<(usize, usize), Vec<usize>> = BTreeMap::new();
    for run in 0..count {
        if let (Some(across), Some(up)) = (x.place(run), y.place(run)) {
            runs.entry((up, across)).or_default().push(run);
        }
    }
    let corner = |across: usize, up: usize| [x.edges[across], y.edges[up]];
    let cell = |((up, across), runs)| MapCell { corners: [corner(across, up), corner(across + 1, up + 1)], runs };
    runs.into_iter().map(cell).collect()
}

/// Cells of one colour each, in rows: neighbours of a row are joined.
fn areas(cells: &[MapCell], colours: impl Iterator<Item = Option<usize>>) -> BTreeMap<usize, Vec<[Point; 2]>> {
    let mut areas: BTreeMap<usize, Vec<[Point; 2]>> = BTreeMap::new();
    let mut previous = None;
    for (cell, colour) in cells.iter().zip(colours) {
        if let Some(colour) = colour {
            let row = areas.entry(colour).or_default();
            let joins = |last: &[Point; 2]| last[1] == [cell.corners[0][0], cell.corners[1][1]];
            match row.last_mut() {
                Some(last) if previous == Some(colour) && joins(last) => last[1] = cell.corners[1],
                _ => row.push(cell.corners),
            }
        }
        previous = colour;
    }
    areas
}

fn of_words(cells: &[MapCell], title: &str, names: &[String], words: &[Option<String>]) -> Layers {
    let most_frequent = |cell: &MapCell| {
        let mut counts = vec![0; names.len()];
        let places = cell.runs.iter().filter_map(|run| words[*run].as_ref());
        places.filter_map(|word| names.iter().position(|name| name == word)).for_each(|index| counts[index] += 1);
        let most = counts.iter().copied().max().filter(|most| *most > 0)?;
        counts.iter().position(|count| *count == most)
    };
    let areas = areas(cells, cells.iter().map(most_frequent));
    let shapes = |(index, corners)| Shapes::Areas { corners, fill: palette::category(index) };
    let entry = |(index, name): (usize, &String)| Series::swatch(name.clone(), palette::category(index));
    let legend = std::iter::once(Series::heading(title)).chain(names.iter().enumerate().map(entry));
    Layers { shapes: areas.into_iter().map(shapes).collect(), series: legend.collect() }
}

/// The mean of the numbers of each cell, where it has some.
fn means(cells: &[MapCell], values: &[f64]) -> Vec<Option<f64>> {
    let mean = |cell: &MapCell| {
        let here: Vec<f64> = cell.runs.iter().map(|run| values[*run]).filter(|value| value.is_finite()).collect();
        (!here.is_empty()).then(|| here.iter().sum::<f64>() / here.len() as f64)
    };
    cells.iter().map(mean).collect()
}

fn of_numbers(cells: &[MapCell], means: &[Option<f64>], palette: &Palette) -> Layers {
    let areas = areas(cells, means.iter().map(|mean| palette.shade((*mean)?)));
    let shapes = |(shade, corners)| Shapes::Areas { corners, fill: palette.colour(shade) };
    Layers { shapes: areas.into_iter().map(shapes).collect(), series: palette.legend() }
}
