//! What many bodies do together over time, computed anew from model and states, and the forces between them at the end.

use super::bodies::{time_axis, values};
use super::no_replay;
use crate::chart::{Axis, Chart, Series};
use crate::draw::Point;
use crate::error::PlotError;
use crate::figure::Panel;
use crate::recorded::RecordedScene;
use crate::strip::Strip;
use gyration::Party;
use gyration::dynamics::Exchange;
use gyration::tensor::Vec3;
use gyration_sim::CrowdState;
use gyration_sim::replay::{CrowdSnapshot, Replay};

const HEIGHT: f64 = 110.0;
/// Samples at which the contacts are looked for.
const SAMPLES: usize = 200;

/// A number of a crowd over time.
type Number = fn(&CrowdState) -> f64;

/// Kinetic energies, granular temperature, contacts of a body, and the forces at the last sample.
pub fn panels(recorded: &RecordedScene) -> Result<Vec<Panel>, PlotError> {
    if recorded.bodies.len() < 2 {
        return Err(PlotError::Nothing { what: "crowd", reason: "there is one body" });
    }
    recorded.span()?;
    let mut replay = Replay::open(recorded.recording).map_err(no_replay)?;
    let times = recorded.recording.times()?;
    let rows = recorded.rows();
    let count = rows.len().min(SAMPLES);
    let chosen = (0..count).map(|k| rows.start + k * (rows.len() - 1) / (count - 1).max(1));
    let mut states: Vec<(f64, CrowdState)> = Vec::with_capacity(count);
    let mut at_the_end = Vec::new();
    for row in chosen {
        let CrowdSnapshot { state, contacts } = replay.crowd(row).map_err(no_replay)?;
        states.push((times[row], state));
        at_the_end = contacts;
    }
    let line = |number: Number| -> Vec<Point> { states.iter().map(|(time, state)| [*time, number(state)]).collect() };
    let x = time_axis(recorded)?;
    let chart = |title: &str, name: &str, unit: &str, series: Vec<Series>| {
        let y = Axis::linear(name, unit, values(&series));
        Panel::Chart(Chart { title: title.to_owned(), x: x.clone(), y, series, remarks: Vec::new(), height: HEIGHT })
    };
    let energies: [(&str, Number); 3] = [
        ("of all with their mean", |state| state.drift),
        ("about the mean", |state| state.agitation),
        ("turning and straining", |state| state.turning),
    ];
    let energies = energies.iter().enumerate().map(|(hue, (name, number))| Series::solid(*name, line(*number), hue));
    let temperature = Series::solid("", line(|state| state.temperature.unwrap_or(0.0)), 0);
    let contacts = Series::solid("", line(|state| state.coordination), 0);
    let mut panels = vec![
        chart("Kinetic energy", "energy", "J", energies.collect()),
        chart(
            "Granular temperature: a third of the mean square of v about the mean",
            "temperature",
            "m²/s²",
            vec![temperature],
        ),
        chart("Contacts of a body, with a hundredth of the mean force or more", "contacts", "", vec![contacts]),
    ];
    let last = rows.end - 1;
    let (_, poses) = recorded.poses(last)?;
    let places: Vec<Vec3> = poses.iter().map(|pose| pose.position).collect();
    panels.push(Panel::Strip(Strip::with_forces(
        recorded,
        last,
        at_the_end.iter().filter_map(|one| ends(one, &places)),
    )?));
    Ok(panels)
}

/// From where to where a contact is drawn, and its force \[N\]: between centres, or from a centre to the support.
fn ends(contact: &Exchange, places: &[Vec3]) -> Option<([Vec3; 2], f64)> {
    let [Party::Body(first), second] = contact.parties else { return None };
    let other = match second {
        Party::Body(second) => places[second],
        Party::Support(_) | Party::SolidSupport(_) | Party::Space => contact.point?,
    };
    Some(([places[first], other], contact.force.norm()))
}
