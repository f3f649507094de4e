//! Columns of the CSV over time, a chart for each unit.

use super::bodies::{MOST_LINES, MOST_NAMES, THIN, time_axis, values};
use crate::chart::{Axis, Chart, Series};
use crate::draw::Point;
use crate::error::PlotError;
use crate::recorded::RecordedScene;
use crate::thin::Thinner;

const HEIGHT: f64 = 130.0;

/// A column that is drawn.
struct Column<'a> {
    name: &'a str,
    unit: &'a str,
    /// Which of the arrays, and where in its row.
    place: (usize, usize),
}

/// The columns of these names, in which `*` stands for any letters.
///
/// # Errors
/// [`PlotError::Arguments`] for a name that no column has, or for more columns than can be told apart.
pub fn charts(recorded: &RecordedScene, names: &[String]) -> Result<Vec<Chart>, PlotError> {
    let recording = recorded.recording;
    let mut arrays: Vec<&str> = Vec::new();
    let mut columns: Vec<Column> = Vec::new();
    for name in names {
        let matching = recording.column_places().filter(|(column, ..)| is_like(column, name));
        let before = columns.len();
        for (name, array, index) in matching {
            if columns.iter().any(|column| column.name == name) {
                continue;
            }
            let known = arrays.iter().position(|known| *known == array);
            let place = known.unwrap_or_else(|| {
                arrays.push(array);
                arrays.len() - 1
            });
            let unit = recording.array(array)?.units.as_str();
            columns.push(Column { name, unit: if unit == "1" { "" } else { unit }, place: (place, index) });
        }
        if columns.len() == before && !columns.iter().any(|column| is_like(column.name, name)) {
            return Err(no_column(recorded, name));
        }
    }
    if columns.len() > MOST_LINES {
        let problem = format!("these are {} columns, more than {MOST_LINES} that can be told apart", columns.len());
        return Err(PlotError::arguments(problem, "name fewer, in several pictures"));
    }
    let mut thinners = recorded.thinners(columns.len());
    recorded.each_row(&arrays, |time, row| {
        for (column, thinner) in columns.iter().zip(&mut thinners) {
            thinner.push(time, row[column.place.0][column.place.1]);
        }
    })?;
    let mut lines: Vec<Option<Vec<Point>>> =
        thinners.into_iter().map(|thinner| Some(Thinner::finish(thinner))).collect();
    let mut charts = Vec::new();
    for unit in columns.iter().map(|column| column.unit) {
        let mut series: Vec<Series> = Vec::new();
        for (column, line) in columns.iter().zip(&mut lines).filter(|(column, _)| column.unit == unit) {
            // Those of a unit are drawn with its first.
            series.extend(line.take().map(|points| Series::solid(column.name, points, series.len())));
        }
        if series.is_empty() {
            continue;
        }
        if series.len() > MOST_NAMES {
            series.iter_mut().for_each(|line| line.stroke.width = THIN);
        }
        let title = match &series[..] {
            [only] => only.name.clone(),
            all => format!("{} columns", all.len()),
        };
        let y = Axis::linear("", unit, values(&series));
        charts.push(Chart { title, x: time_axis(recorded)?, y, series, remarks: Vec::new(), height: HEIGHT });
    }
    Ok(charts)
}

/// Whether a name is of a form in which `*` stands for any letters.
fn is_like(name: &str, form: &str) -> bool {
    let mut parts = form.split('*');
    let Some(mut rest) = parts.next().and_then(|first| name.strip_prefix(first)) else { return false };
    let mut parts: Vec<&str> = parts.collect();
    let Some(last) = parts.pop() else { return rest.is_empty() };
    for part in parts {
        let Some(at) = rest.find(part) else { return false };
        rest = &rest[at + part.len()..];
    }
    rest.ends_with(last)
}

fn no_column(recorded: &RecordedScene, name: &str) -> PlotError {
    let mut columns: Vec<&str> = recorded.recording.column_places().map(|(column, ..)| column).collect();
    let own = name.rsplit('.').next().unwrap_or(name);
    // Those with the same ending, or the same beginning, are what was meant.
    let stem = name.split(['.', '*']).next().unwrap_or(name);
    let near = |column: &&str| column.rsplit('.').next() == Some(own) || (!stem.is_empty() && column.starts_with(stem));
    if columns.iter().any(near) {
        columns.retain(near);
    }
    let more = if columns.len() > MOST_NAMES { ", …" } else { "" };
    columns.truncate(MOST_NAMES);
    let fix = format!(
        "there are {}{more}; `*` stands for any letters, as in *.vx; [record] quantities adds others",
        columns.join(", ")
    );
    PlotError::arguments(format!("the recording has no column `{name}`"), fix)
}

#[cfg(test)]
mod tests {
    use super::is_like;

    #[test]
    fn a_star_stands_for_any_letters() {
        for (name, form, expected) in [
            ("joint.hip.angle", "joint.hip.angle", true),
            ("joint.hip.angle", "joint.*.angle", true),
            ("joint.hip.angle", "*.angle", true),
            ("joint.hip.angle", "*", true),
            ("joint.hip.angle", "j*.*e", true),
            ("joint.hip.angle", "joint.hip", false),
            ("joint.hip.angle", "hip*", false),
            ("joint.hip.fx", "joint.*.angle", false),
            ("ab", "ab*b", false),
        ] {
            assert_eq!(is_like(name, form), expected, "{name} {form}");
        }
    }
}
