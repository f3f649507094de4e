//! The stroke plane: two measures of a body that contracts against each other, a chart for each such body.
//!
//! What a body gets out of a cycle goes, for small strokes, with the area that its stroke encloses; a stroke to and fro
//! encloses none. The last whole cycle of the drive is drawn with arrows and its signed area told, cycles before it lie
//! behind. Without a period the whole recording is one curve, closed by its chord.

use super::bodies::{MOST_CHARTS, bodies_in_words, contracting_bodies};
use super::component::BodyNumber;
use super::trace::Trace;
use crate::chart::{Axis, Chart, DASHED, LINE, Series, extremes};
use crate::cycle::{AtTime, Cycle, rounded};
use crate::draw::{Stroke, color};
use crate::error::PlotError;
use crate::recorded::RecordedScene;

const HEIGHT: f64 = 210.0;
/// Cycles drawn before the last.
const MOST_CYCLES: f64 = 20.0;
/// An entry of G that varies by less than this part of the one that varies most is not worth an axis.
const VARIES: f64 = 1e-6;
/// A stroke that misses its beginning by more than this part of its ranges shows the chord that closes it.
const OPEN: f64 = 0.01;

/// The charts, with these two measures, or with those between which the stroke encloses most.
pub fn charts(recorded: &RecordedScene, names: &[String]) -> Result<Vec<Chart>, PlotError> {
    let bodies = contracting_bodies(recorded, "stroke")?;
    let mut charts = Vec::new();
    for body in bodies.iter().take(MOST_CHARTS) {
        let measures = match names {
            [across, upwards] => [BodyNumber::named(recorded, across)?, BodyNumber::named(recorded, upwards)?],
            [] => default_measures(recorded, *body)?,
            _ => {
                return Err(PlotError::Arguments {
                    problem: format!("a stroke is drawn by two measures, and {} are given", names.len()),
                    fix: "write two with a comma between them, `--measures G_xz,G_zz`, or none".to_owned(),
                });
            }
        };
        charts.push(MeasurePlane { recorded, body: *body, measures }.chart()?);
    }
    let left_out = bodies.len().saturating_sub(MOST_CHARTS);
    if let Some(last) = charts.last_mut().filter(|_| left_out > 0) {
        last.remarks.push(format!("{} not drawn", bodies_in_words(left_out)));
    }
    Ok(charts)
}

/// The two entries of G between which the stroke encloses the largest area.
///
/// Where none encloses any, the two that vary most; where only one varies, it and the entry of P that varies most.
fn default_measures(recorded: &RecordedScene, body: usize) -> Result<[BodyNumber; 2], PlotError> {
    let entries = Entries::read(recorded, body)?;
    let (contraction, placement) = entries.ranges.split_at(9);
    if let Some((across, upwards)) = entries.largest_loop() {
        return Ok([BodyNumber::entry(recorded, "G", across)?, BodyNumber::entry(recorded, "G", upwards)?]);
    }
    let nothing = PlotError::Nothing { what: "stroke", reason: "the contraction never changes" };
    let Some(first) = largest(contraction, None).filter(|k| contraction[*k] > 0.0) else { return Err(nothing) };
    let second = largest(contraction, Some(first)).filter(|k| contraction[*k] > VARIES * contraction[first]);
    let upwards = match second {
        Some(second) => BodyNumber::entry(recorded, "G", second)?,
        None => BodyNumber::entry(recorded, "P", largest(placement, None).unwrap_or(first))?,
    };
    Ok([BodyNumber::entry(recorded, "G", first)?, upwards])
}

/// The index of the largest number but one; of equal ones the first.
fn largest(numbers: &[f64], but: Option<usize>) -> Option<usize> {
    let others = (0..numbers.len()).filter(|k| Some(*k) != but);
    others.reduce(|best, k| if numbers[best] >= numbers[k] { best } else { k })
}

/// How the entries of G and P go over the last cycle.
struct Entries {
    /// Of G, then of P, row by row.
    ranges: [f64; 18],
    /// Twice the area between two entries of G.
    areas: [[f64; 9]; 9],
    samples: usize,
}

impl Entries {
    fn read(recorded: &RecordedScene, body: usize) -> Result<Self, PlotError> {
        let (first, last) = recorded.span()?;
        let start = Cycle::last(recorded.bodies[body].period, (first, last)).map_or(first, |cycle| cycle.start);
        let mut limits = [(f64::INFINITY, f64::NEG_INFINITY); 18];
        let (mut areas, mut samples) = ([[0.0; 9]; 9], 0);
        // G at the beginning of the cycle, and at the sample before.
        let mut known: Option<([f64; 9], [f64; 9])> = None;
        recorded.each_row(&["contraction", "placement_gradient"], |time, row| {
            if time < start {
                return;
            }
            let entries = row.iter().flat_map(|array| &array[9 * body..][..9]);
            for ((low, high), entry) in limits.iter_mut().zip(entries) {
                (*low, *high) = (low.min(*entry), high.max(*entry));
            }
            let now: [f64; 9] = std::array::from_fn(|k| row[0][9 * body + k]);
            let (begin, before) = known.unwrap_or((now, now));
            for (i, areas) in areas.iter_mut().enumerate() {
                for (j, area) in areas.iter_mut().enumerate() {
                    *area +=
                        (before[i] - begin[i]) * (now[j] - begin[j]) - (now[i] - begin[i]) * (before[j] - begin[j]);
                }
            }
            known = Some((begin, now));
            samples += 1;
        })?;
        Ok(Self { ranges: limits.map(|(low, high)| high - low), areas, samples })
    }

    /// The pair of entries of G with the largest area, if one encloses any.
    fn largest_loop(&self) -> Option<(usize, usize)> {
        let area = |(i, j): (usize, usize)| 0.5 * self.areas[i][j].abs();
        let pairs = (0..9).flat_map(|i| (i + 1..9).map(move |j| (i, j)));
        let ranges = |(i, j): (usize, usize)| [self.ranges[i], self.ranges[j]];
        let least = VARIES * self.ranges[..9].iter().copied().fold(0.0, f64::max);
        let encloses = |pair: &(usize, usize)| {
            ranges(*pair).iter().all(|range| *range > least) && encloses(area(*pair), ranges(*pair), self.samples)
        };
        pairs.filter(encloses).reduce(|best, pair| if area(best) >= area(pair) { best } else { pair })
    }
}

/// Whether an area is more than what samples of a bent stroke to and fro leave: its passes cut the bend at different
/// points.
///
/// Over a parabola of length a and height b, passed twice in n samples, they leave ⅔ ab/n² at most.
fn encloses(area: f64, ranges: [f64; 2], samples: usize) -> bool {
    area.abs() > ranges[0] * ranges[1] / (samples as f64).powi(2)
}

/// A body in the plane of two measures.
struct MeasurePlane<'a> {
    recorded: &'a RecordedScene<'a>,
    body: usize,
    measures: [BodyNumber; 2],
}

/// What is drawn in it.
struct Drawn {
    last: Trace,
    before: Trace,
    /// From the first sample drawn to the last cycle, in cycles.
    cycles_before: f64,
}

impl MeasurePlane<'_> {
    fn arrays(&self) -> [&'static str; 2] {
        [self.measures[0].array, self.measures[1].array]
    }

    fn point(&self, row: &[&[f64]]) -> [f64; 2] {
        [0, 1].map(|k| self.measures[k].of(row[k], self.body))
    }

    /// The range of each measure over the whole recording.
    fn ranges(&self) -> Result<[f64; 2], PlotError> {
        let mut ranges = [(f64::INFINITY, f64::NEG_INFINITY); 2];
        self.recorded.each_row(&self.arrays(), |_, row| {
            for ((low, high), value) in ranges.iter_mut().zip(self.point(row)) {
                (*low, *high) = (low.min(value), high.max(value));
            }
        })?;
        Ok(ranges.map(|(low, high)| high - low))
    }

    /// Follows the stroke through the samples.
    fn follow(&self, cycle: Option<&Cycle>) -> Result<Drawn, PlotError> {
        let (first, _) = self.recorded.span()?;
        let ranges = self.ranges()?;
        let (start, period) = cycle.map_or((first, f64::INFINITY), |cycle| (cycle.start, cycle.period));
        let from = if cycle.is_some() { first.max(start - MOST_CYCLES * period) } else { first };
        let (mut last, mut before) = (Trace::new(ranges), Trace::new(ranges));
        let mut mark = AtTime::at(start);
        self.recorded.each_row(&self.arrays(), |time, row| {
            let point = self.point(row);
            if !point.iter().all(|value| value.is_finite()) {
                return;
            }
            if mark.push(time, point) {
                let beginning = mark.found().unwrap_or(point);
                before.push(beginning);
                last.push(beginning);
            }
            if time > start {
                last.push(point);
            } else if time >= from && time < start {
                before.push(point);
            }
        })?;
        Ok(Drawn { last, before, cycles_before: (start - from) / period })
    }

    fn chart(&self) -> Result<Chart, PlotError> {
        let body = &self.recorded.bodies[self.body];
        let cycle = Cycle::last(body.period, self.recorded.span()?);
        let Drawn { last, before, cycles_before } = self.follow(cycle.as_ref())?;
        let remarks = self.remarks(&last, cycle.as_ref());
        let (opening, chord) = (last.opening(), last.chord());
        let mut series = Vec::new();
        if cycles_before > 0.0 {
            let stroke = Stroke::solid(color::SERIES[5], 0.6);
            let name = format!("{} cycles before", rounded(cycles_before));
            series.push(Series { name, points: before.finish(), stroke, arrows: false });
        }
        let name = match &cycle {
            Some(cycle) => format!("last cycle, {}", cycle.in_words()),
            None => "whole recording".to_owned(),
        };
        let stroke = Stroke::solid(color::SERIES[0], LINE);
        series.push(Series { name, points: last.finish(), stroke, arrows: true });
        if opening > OPEN {
            let stroke = Stroke { color: color::GREY, width: 0.9, dash: DASHED };
            series.push(Series { name: "closed by its chord".into(), points: chord, stroke, arrows: false });
        }
        let [across, upwards] = &self.measures;
        let axis = |measure: &BodyNumber, k: usize| {
            let values = series.iter().flat_map(|series| &series.points).map(|point| point[k]);
            Axis::linear(&measure.label, &measure.unit, values)
        };
        let (x, y) = (axis(across, 0), axis(upwards, 1));
        let title = format!("Stroke of {}: {} against {}", body.name, upwards.label, across.label);
        Ok(Chart { title, x, y, series, remarks, height: HEIGHT })
    }

    /// Area, sense, sampling.
    fn remarks(&self, last: &Trace, cycle: Option<&Cycle>) -> Vec<String> {
        let [across, upwards] = &self.measures;
        let units = [&across.unit, &upwards.unit].map(String::as_str).join(" ");
        let area = format!("{} {units}", rounded(last.area()));
        let points = last.clone().finish();
        let range = |k: usize| extremes(points.iter().map(|point| point[k])).map_or(0.0, |(low, high)| high - low);
        let sense = match encloses(last.area(), [range(0), range(1)], last.taken()) {
            false => "to and fro",
            true if last.area() > 0.0 => "counterclockwise",
            true => "clockwise",
        };
        let mut remarks = vec![format!("area {}", area.trim_end()), sense.to_owned()];
        if cycle.is_some() {
            // The beginning of the cycle is no sample of its own.
            remarks.push(format!("{} samples a cycle", last.taken().saturating_sub(1)));
        }
        remarks
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A stroke of n samples a cycle in the plane, its phase shifted within a sample.
    fn stroke(samples: usize, shift: f64, place: impl Fn(f64) -> [f64; 2]) -> Trace {
        let mut trace = Trace::new([2.0, 1.0]);
        (0..=samples).for_each(|k| trace.push(place((k as f64 + shift) / samples as f64 * std::f64::consts::TAU)));
        trace
    }

    #[test]
    fn entries_that_are_but_rounding_have_no_axis() {
        let mut entries = Entries { ranges: [0.0; 18], areas: [[0.0; 9]; 9], samples: 40 };
        (entries.ranges[1], entries.ranges[8]) = (1e-17, 0.2);
        entries.areas[1][8] = 1e-18;
        assert_eq!(entries.largest_loop(), None);
        (entries.ranges[2], entries.areas[2][8]) = (0.1, -0.01);
        assert_eq!(entries.largest_loop(), Some((2, 8)));
    }

    #[test]
    fn bent_strokes_to_and_fro_enclose_nothing() {
        for samples in [20, 41, 100] {
            for shift in [0.0, 0.1, 0.3, 0.5] {
                let bent = |phase: f64| [phase.sin(), phase.sin().powi(2)];
                let area = stroke(samples, shift, bent).area();
                assert!(!encloses(area, [2.0, 1.0], samples + 1), "{samples}, {shift}: {area}");
                let open = |phase: f64| [phase.sin(), phase.sin().powi(2) + 0.02 * phase.cos()];
                let area = stroke(samples, shift, open).area();
                assert!(encloses(area, [2.0, 1.04], samples + 1), "{samples}, {shift}: {area}");
            }
        }
    }
}
