//! `gyration orbit`: a motion that repeats itself, and whether its neighbours stay near.

use crate::arguments::OrbitArguments;
use crate::error::{CliError, code};
use crate::input::ready;
use crate::output;
use crate::waiting::waiting;
use gyration_sim::format::{significant, vector};
use gyration_sim::orbit::{OrbitChoice, OrbitSurvey};
use gyration_sim::within_wall_time;
use std::f64::consts::TAU;
use std::fmt::Write as _;

/// So many bodies and multipliers are printed.
const SHOWN: usize = 24;

/// Prints the orbit nearest to the start of a scene, or one of a period, an energy or an amplitude.
pub fn execute(arguments: &OrbitArguments) -> Result<u8, CliError> {
    let name = &arguments.scene.scene;
    let scene = waiting(format!("opening {name}"), true, || ready(&arguments.scene))?;
    let period = arguments.period;
    let choice = match (arguments.energy, &arguments.amplitude, period) {
        (Some(energy), ..) => OrbitChoice::Energy(energy, period),
        (None, Some((column, value)), _) => OrbitChoice::Amplitude(column.clone(), *value, period),
        (None, None, Some(period)) => OrbitChoice::Period(period),
        (None, None, None) => OrbitChoice::Nearest,
    };
    let found = waiting(format!("looking for an orbit of {name}"), true, || {
        within_wall_time(&scene, || OrbitSurvey::of(&scene, &choice, arguments.shift))
    });
    let found =
        found.map_err(|reason| CliError::arguments(reason, "see `gyration orbit --help`; begin nearer to it"))?;
    let text = match arguments.json {
        true => format!("{:#}\n", serde_json::json!(found)),
        false => in_words(scene.title(), &found),
    };
    output::print(&text)?;
    Ok(code::DONE)
}

fn in_words(title: &str, found: &OrbitSurvey) -> String {
    let mut text = format!("{title}\n");
    // Writing to a string does not fail.
    let _ = write_orbit(&mut text, found);
    text
}

fn write_orbit(text: &mut String, found: &OrbitSurvey) -> std::fmt::Result {
    // A wave that has moved on has swung by a part of a turn.
    let turns = match found.shift {
        None => format!(", {} rad/s", significant(TAU / found.period, 8)),
        Some(_) => String::new(),
    };
    writeln!(text, "period      {} s{turns}", significant(found.period, 12))?;
    if let Some([a, b, c]) = found.shift {
        writeln!(text, "moves on    by ({a}, {b}, {c}) cells in that time")?;
    }
    writeln!(text, "energy      {} J", significant(found.energy, 8))?;
    writeln!(text, "comes back  to {:.1e} of how far it goes", found.misfit)?;
    let verdict = if found.stable { "stable: no neighbour leaves it" } else { "unstable: neighbours leave it" };
    writeln!(text, "{verdict}")?;
    writeln!(text, "\nmultipliers    |μ|           angle [rad]")?;
    for [re, im] in found.multipliers.iter().take(SHOWN) {
        writeln!(text, "               {:<14}{}", significant(re.hypot(*im), 8), significant(im.atan2(*re), 6))?;
    }
    if found.multipliers.len() > SHOWN {
        writeln!(text, "               and {} more", found.multipliers.len() - SHOWN)?;
    }
    writeln!(text, "\nstart")?;
    for (name, start) in found.start.iter().take(SHOWN) {
        writeln!(text, "  {name}  position {} m, velocity {} m/s", vector(&start.position), vector(&start.velocity))?;
    }
    Ok(())
}
