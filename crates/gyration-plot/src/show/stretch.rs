//! Principal stretches over time, a chart for each body that deforms.
//!
//! They are the singular values of P: the lengths, in units of those of the reference shape, of the axes of the
//! ellipsoid that a sphere becomes. Their product is the ratio of the volumes, drawn where it changes.

use super::bodies::{MOST_CHARTS, bodies_in_words, time_axis, values};
use crate::chart::{Axis, Chart, DOTTED, LINE, Series};
use crate::draw::{Point, Stroke, color};
use crate::error::PlotError;
use crate::recorded::{BodyPicture, RecordedScene};
use gyration::tensor::Mat3;

const HEIGHT: f64 = 95.0;
/// A volume that changes by less than this is kept: incompressible bodies keep theirs to 1e-10.
const KEPT: f64 = 1e-6;
/// The fourth line of a body: its volume.
const VOLUME: usize = 3;

/// The charts, one below another.
pub fn charts(recorded: &RecordedScene) -> Result<Vec<Chart>, PlotError> {
    let deforming = |(_, body): &(usize, &BodyPicture)| body.deforms();
    let bodies: Vec<usize> = recorded.bodies.iter().enumerate().filter(deforming).map(|(index, _)| index).collect();
    if bodies.is_empty() {
        return Err(PlotError::Nothing { what: "stretch", reason: "no body of the recording deforms" });
    }
    let drawn = &bodies[..bodies.len().min(MOST_CHARTS)];
    let lines_each = VOLUME + 1;
    let value = |row: &[&[f64]], k: usize| {
        let gradient = Mat3::from_row_slice(&row[0][9 * drawn[k / lines_each]..][..9]);
        if k % lines_each == VOLUME { gradient.determinant() } else { stretches(&gradient)[k % lines_each] }
    };
    let lines = recorded.lines(&["placement_gradient"], lines_each * drawn.len(), value)?;
    let x = time_axis(recorded)?;
    let mut charts: Vec<Chart> = drawn
        .iter()
        .zip(lines.chunks(lines_each))
        .map(|(body, lines)| chart(&recorded.bodies[*body].name, lines, &x))
        .collect();
    let left_out = bodies.len() - drawn.len();
    if let Some(last) = charts.last_mut().filter(|_| left_out > 0) {
        last.remarks.push(format!("{} not drawn", bodies_in_words(left_out)));
    }
    Ok(charts)
}

/// The largest first.
fn stretches(gradient: &Mat3) -> [f64; 3] {
    let mut values: [f64; 3] = gradient.singular_values().into();
    values.sort_by(|a, b| b.total_cmp(a));
    values
}

fn chart(name: &str, lines: &[Vec<Point>], x: &Axis) -> Chart {
    let hues = [("largest", 1), ("middle", 2), ("smallest", 0)];
    let mut series: Vec<Series> =
        hues.iter().zip(lines).map(|((name, hue), points)| Series::solid(*name, points.clone(), *hue)).collect();
    let volume = &lines[VOLUME];
    let first = volume.first().map_or(1.0, |point| point[1]);
    if volume.iter().any(|point| (point[1] - first).abs() > KEPT * first.abs()) {
        let stroke = Stroke { color: color::INK, width: LINE, dash: DOTTED };
        series.push(Series { name: "volume".into(), points: volume.clone(), stroke, arrows: false });
    }
    let y = Axis::linear("stretch", "", values(&series).chain([1.0]));
    let title = format!("Principal stretches of {name}");
    Chart { title, x: x.clone(), y, series, remarks: Vec::new(), height: HEIGHT }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stretches_do_not_depend_on_how_the_body_is_turned() {
        let (sine, cosine) = 0.7f64.sin_cos();
        let turn = Mat3::new(cosine, -sine, 0.0, sine, cosine, 0.0, 0.0, 0.0, 1.0);
        let gradient = turn * Mat3::new(0.5, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 1.0) * turn;
        let found = stretches(&gradient);
        // A few roundings.
        assert!(found.iter().zip([2.0, 1.0, 0.5]).all(|(a, b)| (a - b).abs() < 1e-14), "{found:?}");
    }
}
