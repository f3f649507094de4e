//! Colours of a number: from light to dark where it has one sign, through white where it has both; evenly, or by its
//! logarithm.

use super::axis::{Axis, AxisScale, extremes};
use super::series::Series;
use super::ticks::Tick;
use crate::draw::Color;

/// Light to dark in even steps of lightness, told apart by all readers.
const SEQUENCE: [Color; 5] = [
    Color::new(0xFC, 0xF3, 0xC9),
    Color::new(0xA5, 0xD8, 0xB8),
    Color::new(0x3F, 0xA6, 0xB8),
    Color::new(0x1F, 0x62, 0x9E),
    Color::new(0x14, 0x1F, 0x57),
];
/// Below zero, zero, above zero.
const TWO_SIDED: [Color; 5] = [
    Color::new(0x00, 0x3C, 0x6E),
    Color::new(0x56, 0xA0, 0xD4),
    Color::new(0xF7, 0xF7, 0xF7),
    Color::new(0xEE, 0x93, 0x4F),
    Color::new(0x8A, 0x35, 0x00),
];
/// A sign with less than this part of the range is scatter about zero.
const SMALLEST_SIDE: f64 = 0.1;
/// Into how many colours the range is divided: cells of one colour are one path.
const SHADES: usize = 64;

/// About how many entries a legend has.
const ENTRIES: usize = 8;

/// A range of numbers and its colours.
#[derive(Debug, Clone, PartialEq)]
pub struct Palette {
    axis: Axis,
    colours: [Color; 5],
}

impl Palette {
    /// The palette of values; symmetric about zero where they have both signs.
    pub fn of(name: &str, unit: &str, values: impl IntoIterator<Item = f64>) -> Self {
        let (low, high) = extremes(values).unwrap_or((0.0, 1.0));
        let (low, high) = if high > low { (low, high) } else { (low - 0.5, high + 0.5) };
        if low < 0.0 && high > 0.0 && high.min(-low) > SMALLEST_SIDE * high.max(-low) {
            let most = high.max(-low);
            return Self { axis: Axis::exact(name, unit, -most, most), colours: TWO_SIDED };
        }
        Self { axis: Axis::exact(name, unit, low, high), colours: SEQUENCE }
    }

    /// The palette of the logarithms of those values that have one.
    pub fn logarithmic(name: &str, unit: &str, values: impl IntoIterator<Item = f64>) -> Self {
        let (low, high) = extremes(values.into_iter().filter(|value| *value > 0.0)).unwrap_or((0.1, 10.0));
        let (low, high) = if high > low { (low, high) } else { (low / 2.0, high * 2.0) };
        let axis = Axis { scale: AxisScale::Logarithmic, ..Axis::exact(name, unit, low, high) };
        Self { axis, colours: SEQUENCE }
    }

    /// The index of the colour of a value; none where it has none.
    pub fn shade(&self, value: f64) -> Option<usize> {
        let place = self.axis.place(value);
        place.is_finite().then(|| ((place * SHADES as f64) as usize).min(SHADES - 1))
    }

    /// The colour of an index.
    pub fn colour(&self, shade: usize) -> Color {
        self.at((shade as f64 + 0.5) / SHADES as f64)
    }

    fn at(&self, place: f64) -> Color {
        let along = place.clamp(0.0, 1.0) * (self.colours.len() - 1) as f64;
        let first = (along as usize).min(self.colours.len() - 2);
        let part = along - first as f64;
        let mixed = |k: usize| {
            let [a, b] = [first, first + 1].map(|index| f64::from(self.colours[index].rgb[k]));
            (a + part * (b - a)).round() as u8
        };
        Color::new(mixed(0), mixed(1), mixed(2))
    }

    /// Entries of a legend: name and unit, then round values with their colours, from the largest.
    pub fn legend(&self) -> Vec<Series> {
        let mut ticks = self.axis.ticks(ENTRIES);
        if ticks.iter().filter(|tick| tick.label.is_some()).count() < 2 {
            // A range too short for powers of ten.
            ticks = Axis { scale: AxisScale::Linear, ..self.axis.clone() }.ticks(ENTRIES / 2);
        }
        let entry = |tick: &Tick| {
            let words = tick.label.as_ref()?;
            Some(Series::swatch(words.clone(), self.at(self.axis.place(tick.value))))
        };
        std::iter::once(Series::heading(self.axis.label())).chain(ticks.iter().rev().filter_map(entry)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lightness(colour: Color) -> f64 {
        let [red, green, blue] = colour.rgb.map(f64::from);
        0.299 * red + 0.587 * green + 0.114 * blue
    }

    #[test]
    fn a_larger_number_is_darker_where_there_is_one_sign() {
        let palette = Palette::of("speed", "m/s", [2.0, 5.0]);
        let lights: Vec<f64> = (0..SHADES).map(|shade| lightness(palette.colour(shade))).collect();
        assert!(lights.windows(2).all(|pair| pair[0] > pair[1]), "{lights:?}");
    }

    #[test]
    fn zero_is_white_where_there_are_both_signs() {
        let palette = Palette::of("speed", "m/s", [-1.0, 3.0]);
        assert!(lightness(palette.colour(palette.shade(0.0).unwrap())) > 235.0);
        assert_eq!([-3.0, 3.0, f64::NAN].map(|value| palette.shade(value)), [Some(0), Some(SHADES - 1), None]);
    }

    #[test]
    fn equal_factors_are_equal_steps_of_colour_where_asked() {
        let palette = Palette::logarithmic("time", "s", [0.0, 1e-3, 1.0, 1e3, -2.0]);
        assert_eq!([1e-3, 1.0, 1e3].map(|value| palette.shade(value)), [Some(0), Some(SHADES / 2), Some(SHADES - 1)]);
        assert_eq!([0.0, -2.0].map(|value| palette.shade(value)), [None, None]);
        let legend: Vec<String> = palette.legend().into_iter().map(|entry| entry.name).collect();
        assert_eq!(legend[..2], ["time [s]", "10^{3}"]);
        assert_eq!(legend.len(), 8);
        let narrow = Palette::logarithmic("time", "s", [2.1, 4.9]).legend();
        assert!(narrow.len() > 2, "{narrow:?}");
    }

    #[test]
    fn a_legend_is_short_and_has_a_name() {
        let legend: Vec<String> =
            Palette::of("gap", "m", [1.2e-4, 3.9e-4]).legend().into_iter().map(|entry| entry.name).collect();
        assert_eq!(legend[..2], ["gap [µm]", "350"], "{legend:?}");
    }
}
