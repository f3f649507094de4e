//! Fields of many bodies over a grid, at the last sample: maps over its two longest sides, or lines along one.
//!
//! Shown are [`FIELD_SCALARS`], of a grid with three sides in its middle layer. What is zero everywhere has no panel.

use crate::chart::{Axis, Chart, Palette, Series, ShapeChart, Shapes};
use crate::draw::Point;
use crate::figure::{Figure, Panel};
use crate::show::title;
use gyration_record::Recording;
use gyration_sim::fields::{FIELD_SCALARS, FieldScalar};
use gyration_sim::format::significant;
use gyration_sim::{FieldGrid, FieldLayer, FieldSurvey};
use std::collections::BTreeMap;

/// About the width of a frame beside its legend [pt].
const WIDTH: f64 = 400.0;
/// Heights of a map [pt].
const LEAST: f64 = 70.0;
const MOST: f64 = 210.0;
/// Height of a chart of lines [pt].
const HEIGHT: f64 = 120.0;
/// The names of the axes.
const AXES: [&str; 3] = ["x", "y", "z"];

/// The figure of fields on a grid at their last sample; none where they are not on one, or have no sample.
pub fn fields(recording: &Recording, found: &FieldSurvey) -> Option<Figure> {
    let (grid, fields, time) = (found.grid?, found.fields.last()?, found.times.last()?);
    let layer = Layer::of(&grid);
    let mut panels = Vec::new();
    for shown in &FIELD_SCALARS {
        let all = shown.values(fields);
        let values: Vec<f64> = layer.points.iter().map(|point| all[*point]).collect();
        if values.iter().any(|value| *value != 0.0 && !value.is_nan()) {
            panels.push(if layer.is_line() { layer.line(shown, &values) } else { layer.map(shown, &values) });
        }
    }
    let seen =
        format!("bodies seen with a width of {} m, t = {} s", significant(found.width, 6), significant(*time, 6));
    let subtitle = layer.place.map_or(seen.clone(), |place| format!("{seen}; {place}"));
    Some(Figure { title: title(recording).to_owned(), subtitle, panels })
}

/// The part of a grid that is shown: along two axes, or along one where the other has one point.
struct Layer {
    across: GridLine,
    up: GridLine,
    /// The points of the grid, `across` fastest.
    points: Vec<usize>,
    /// Where it lies, if the grid has others.
    place: Option<String>,
}

/// The points along an axis of the grid.
struct GridLine {
    name: &'static str,
    first: f64,
    spacing: f64,
    count: usize,
}

impl GridLine {
    /// Where the cell of a point begins and ends \[m\].
    fn cell(&self, index: usize) -> [f64; 2] {
        let middle = self.first + self.spacing * index as f64;
        [middle - 0.5 * self.spacing, middle + 0.5 * self.spacing]
    }

    /// From the first cell to the last \[m\].
    fn ends(&self) -> [f64; 2] {
        [self.cell(0)[0], self.cell(self.count - 1)[1]]
    }

    fn length(&self) -> f64 {
        self.spacing * self.count as f64
    }
}

impl Layer {
    fn of(grid: &FieldGrid) -> Self {
        let FieldLayer { through, along, index, points } = FieldLayer::of(grid);
        let [across, up] = along.map(|axis| GridLine {
            name: AXES[axis],
            first: grid.origin[axis],
            spacing: grid.spacing[axis],
            count: grid.counts[axis],
        });
        let at = grid.origin[through] + grid.spacing[through] * index as f64;
        let has_others = grid.counts[through] > 1;
        let place = has_others.then(|| format!("the layer at {} = {} m", AXES[through], significant(at, 4)));
        Self { across, up, points, place }
    }

    fn is_line(&self) -> bool {
        self.up.count == 1
    }

    fn line(&self, shown: &FieldScalar, values: &[f64]) -> Panel {
        let at = |index: usize| self.across.first + self.across.spacing * index as f64;
        let points: Vec<Point> = values.iter().enumerate().map(|(index, value)| [at(index), *value]).collect();
        let x = Axis::exact(self.across.name, "m", at(0), at(self.across.count - 1));
        let y = Axis::linear(shown.name, shown.unit, values.iter().copied());
        let series = vec![Series::solid("", points, 0)];
        Panel::Chart(Chart { title: String::new(), x, y, series, remarks: Vec::new(), height: HEIGHT })
    }

    /// Equal lengths along both axes; the shorter one has room on both sides.
    fn map(&self, shown: &FieldScalar, values: &[f64]) -> Panel {
        let palette = Palette::of("", shown.unit, values.iter().copied());
        let mut cells: BTreeMap<usize, Vec<[Point; 2]>> = BTreeMap::new();
        for (index, value) in values.iter().enumerate() {
            let [left, right] = self.across.cell(index % self.across.count);
            let [below, above] = self.up.cell(index / self.across.count);
            if let Some(shade) = palette.shade(*value) {
                cells.entry(shade).or_default().push([[left, below], [right, above]]);
            }
        }
        let shapes = cells.into_iter().map(|(shade, corners)| Shapes::Areas { corners, fill: palette.colour(shade) });
        let height = (WIDTH * self.up.length() / self.across.length()).clamp(LEAST, MOST);
        let room = |line: &GridLine, whole: f64| {
            let [low, high] = line.ends();
            let beside = 0.5 * (whole - line.length()).max(0.0);
            Axis::exact(line.name, "m", low - beside, high + beside)
        };
        let x = room(&self.across, self.up.length() * WIDTH / height);
        let y = room(&self.up, self.across.length() * height / WIDTH);
        let (title, series) = (shown.name.to_owned(), palette.legend());
        let chart = Chart { title, x, y, series, remarks: Vec::new(), height };
        Panel::ShapeChart(ShapeChart { chart, shapes: shapes.collect() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gyration::tensor::Vec3;

    fn grid(counts: [usize; 3]) -> FieldGrid {
        FieldGrid { counts, origin: Vec3::new(-1.0, 0.0, 2.0), spacing: Vec3::new(0.5, 0.25, 0.125) }
    }

    #[test]
    fn the_middle_layer_lies_along_the_two_longest_sides() {
        let layer = Layer::of(&grid([4, 2, 3]));
        assert_eq!((layer.across.name, layer.up.name), ("x", "z"));
        assert_eq!(layer.points, [4, 5, 6, 7, 12, 13, 14, 15, 20, 21, 22, 23]);
        assert_eq!(layer.place.as_deref(), Some("the layer at y = 0.25 m"));
        assert_eq!(layer.across.ends(), [-1.25, 0.75]);
    }

    #[test]
    fn a_row_of_points_is_a_line_along_its_axis() {
        for (counts, name) in [([5, 1, 1], "x"), ([1, 5, 1], "y"), ([1, 1, 5], "z")] {
            let layer = Layer::of(&grid(counts));
            assert_eq!((layer.across.name, layer.is_line(), layer.points.len()), (name, true, 5), "{counts:?}");
            assert_eq!(layer.place, None);
        }
    }
}
