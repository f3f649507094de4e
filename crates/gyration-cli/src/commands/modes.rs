//! `gyration modes`: the rest state of each body, and the small motions about it.

use super::ready;
use crate::arguments::Check;
use crate::check::{KindCheck, ModeCheck, RestState, ShapeCheck};
use crate::error::{CliError, code};
use crate::output;
use crate::summary::{plain, vector};
use gyration::body::Body;
use gyration_scene::Scene;
use serde_json::{Value, json};
use std::fmt::Write as _;

/// Columns of a terminal that the tables fit in.
const WIDTH: usize = 100;
/// Entries of shapes below this are printed as zero.
const LEAST_SEEN: f64 = 5e-4;

/// Prints the modes of every body.
pub fn execute(arguments: &Check) -> Result<u8, CliError> {
    let scene = ready(&arguments.scene)?;
    let text = if arguments.json {
        format!("{:#}\n", all_in_json(&scene))
    } else {
        let title = scene.file().title.clone().unwrap_or_else(|| scene.name().to_owned());
        let mut text = format!("{title}\n{}", assumptions(&scene));
        // Writing to a string does not fail.
        let _ = found(&scene).try_for_each(|(body, state)| write_body(&mut text, body, &state));
        text
    };
    output::print(&text)?;
    Ok(code::DONE)
}

/// Each body and its rest state.
fn found(scene: &Scene) -> impl Iterator<Item = (&Body, Result<RestState, String>)> {
    let built = scene.built();
    let bodies = built.model.bodies.iter().enumerate();
    bodies.map(|(index, body)| (body, RestState::of(&built.model, &built.state, index)))
}

/// The modes of every body.
pub(crate) fn all_in_json(scene: &Scene) -> Value {
    let bodies: Vec<Value> = found(scene).map(|(body, state)| in_json(body, &state)).collect();
    json!({ "scene": scene.name(), "bodies": bodies })
}

/// What the modes are about.
fn assumptions(scene: &Scene) -> String {
    let model = &scene.built().model;
    let moves = model.supports.iter().any(|support| support.motion != gyration::support::SupportMotion::Fixed);
    let moving = if moves { ";\nsupports that move are held where they are at t = 0" } else { "" };
    format!("Small motions about the rest state that each body gets to from its start{moving}\n")
}

fn in_json(body: &Body, state: &Result<RestState, String>) -> Value {
    let (rest, reason) = match state {
        Ok(rest) => (json!(rest), Value::Null),
        Err(reason) => (Value::Null, json!(reason)),
    };
    json!({ "name": body.name, "kind": KindCheck::of(body), "rest_state": rest, "no_rest_state_because": reason })
}

/// A body under its name.
fn write_body(text: &mut String, body: &Body, state: &Result<RestState, String>) -> std::fmt::Result {
    let kind = KindCheck::of(body);
    let pinned = if body.pin.is_some() { ", pinned" } else { "" };
    let material = kind.material.map(|material| format!(": {material}")).unwrap_or_default();
    writeln!(text, "\nbody {}, {}{pinned}{material}", body.name, kind.kind)?;
    match state {
        Err(reason) => {
            let lines = wrapped(&format!("no rest state: {reason}"), WIDTH - 2);
            lines.iter().try_for_each(|line| writeln!(text, "  {line}"))
        }
        Ok(rest) => {
            write_rest(text, rest)?;
            write_table(text, &rest.modes)?;
            write_shapes(text, &rest.modes, 0.5 * body.size)
        }
    }
}

/// Place, gap, stretches and pressure at rest.
pub fn write_rest(text: &mut String, rest: &RestState) -> std::fmt::Result {
    let gap = rest.gap.map(|gap| format!(", gap {} m", plain(gap, 5))).unwrap_or_default();
    writeln!(text, "  rests at {} m{gap}", vector(&rest.position))?;
    if rest.stretches != [1.0; 3] {
        let pressure =
            rest.pressure.map(|pressure| format!(", pressure {} Pa", plain(pressure, 5))).unwrap_or_default();
        writeln!(text, "  stretches {}{pressure}", rest.stretches.map(|stretch| format!("{stretch:.6}")).join(", "))?;
    }
    Ok(())
}

/// A line a mode: frequency, decay, damping ratio, what it is.
fn write_table(text: &mut String, modes: &[ModeCheck]) -> std::fmt::Result {
    let line = |cells: [&str; 5]| {
        format!("{:>4}  {:>10}  {:>10}  {:>22}  {:>9}  ", cells[0], cells[1], cells[2], cells[3], cells[4])
    };
    let heading = line(["mode", "f [Hz]", "ω [rad/s]", "decay [1/s]", "damping"]);
    writeln!(text, "\n{heading}motion")?;
    for (index, mode) in modes.iter().enumerate() {
        let number = (index + 1).to_string();
        let oscillates = mode.motion == "oscillates";
        let (hertz, omega) = if oscillates {
            (plain(mode.frequency_hz, 6), plain(mode.frequency, 6))
        } else {
            (mode.motion.to_owned(), String::new())
        };
        let ratio = mode.damping_ratio.map(|ratio| plain(ratio, 4)).unwrap_or_default();
        let start = line([&number, &hertz, &omega, &decay(mode), &ratio]);
        let room = WIDTH - heading.chars().count();
        let mut words = wrapped(&mode.in_words, room).into_iter();
        writeln!(text, "{start}{}", words.next().unwrap_or_default())?;
        for more in words {
            writeln!(text, "{:width$}{more}", "", width = heading.chars().count())?;
        }
    }
    Ok(())
}

/// One rate of a motion that oscillates, or what is not zero of the two.
fn decay(mode: &ModeCheck) -> String {
    let [slow, fast] = mode.decay_rates;
    match mode.motion {
        "oscillates" => plain(slow, 5),
        "free" if fast == 0.0 => String::new(),
        "free" => plain(fast, 5),
        _ => format!("{}, {}", plain(slow, 5), plain(fast, 5)),
    }
}

/// Words in lines of so many characters at most, as far as single words allow.
fn wrapped(words: &str, room: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in words.split(' ') {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= room => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

impl ShapeCheck {
    /// Whether an entry is more than zero in print.
    fn is_seen(&self, radius: f64) -> bool {
        let gradient = self.gradient.iter().flatten().map(|value| value * radius);
        self.translation.iter().copied().chain(gradient).any(|value| value.abs() >= LEAST_SEEN)
    }
}

/// The shapes: a line of twelve numbers a mode, and another for a part out of step.
fn write_shapes(text: &mut String, modes: &[ModeCheck], radius: f64) -> std::fmt::Result {
    writeln!(text, "\nShapes; of the points at {} m from the centre the fastest moves by 1.", plain(radius, 5))?;
    let matrix = ["xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"];
    let cells = |cells: &[&str]| cells.iter().map(|cell| format!("{cell:>7}")).collect::<String>();
    writeln!(text, "mode  δp₀{:>18}  δP · {} m", "", plain(radius, 5))?;
    writeln!(text, "    {}  {}", cells(&["x", "y", "z"]), cells(&matrix))?;
    for (index, mode) in modes.iter().enumerate() {
        write_shape(text, &(index + 1).to_string(), &mode.shape, radius)?;
        if let Some(quadrature) = mode.quadrature.as_ref().filter(|shape| shape.is_seen(radius)) {
            write_shape(text, "+i", quadrature, radius)?;
        }
    }
    Ok(())
}

fn write_shape(text: &mut String, number: &str, shape: &ShapeCheck, radius: f64) -> std::fmt::Result {
    let entry = |value: &f64| if value.abs() < LEAST_SEEN { format!("{:>7}", 0) } else { format!("{value:>7.3}") };
    let center: String = shape.translation.iter().map(entry).collect();
    let gradient: String = shape.gradient.iter().flatten().map(|value| entry(&(value * radius))).collect();
    writeln!(text, "{number:>4}{center}  {gradient}")
}
