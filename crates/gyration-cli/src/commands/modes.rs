//! `gyration modes`: the rest state of each body, or of bodies together, and the small motions about it.

use crate::arguments::Modes;
use crate::error::{CliError, code};
use crate::input::ready;
use crate::output;
use crate::waiting::waiting;
use gyration::body::Body;
use gyration::load::Spring;
use gyration_scene::Scene;
use gyration_sim::format::significant;
use gyration_sim::survey::{self, BodyModes, ModeSurvey, Named, SceneModes, ShapeSurvey, SystemModes, write_rest};
use gyration_sim::within_wall_time;
use std::fmt::Write as _;

/// Columns of a terminal that the tables fit in.
const WIDTH: usize = 100;
/// Entries of shapes below this are printed as zero.
const LEAST_SEEN: f64 = 5e-4;
/// Of so many bodies of a system at most the shapes are printed.
const MOST_SHOWN: usize = 12;

/// Prints the modes of every body.
pub fn execute(arguments: &Modes) -> Result<u8, CliError> {
    let name = &arguments.scene.scene;
    let scene = waiting(format!("opening {name}"), true, || ready(&arguments.scene))?;
    let found = || match arguments.json {
        true => format!("{:#}\n", survey::modes_in_json(&scene)),
        false => in_words(&scene),
    };
    let looking = format!("looking for the rest states of {name}");
    let text = waiting(looking, true, || within_wall_time(&scene, found));
    output::print(&text)?;
    Ok(code::DONE)
}

fn in_words(scene: &Scene) -> String {
    let mut text = format!("{}\n{}", scene.title(), assumptions(scene));
    let SceneModes { bodies, systems } = survey::modes(scene);
    let all = &scene.built().model.bodies;
    let mut alone = all.iter().zip(&bodies).filter(|(_, modes)| modes.system.is_none());
    // Writing to a string does not fail.
    let _ = alone.try_for_each(|(body, modes)| write_body(&mut text, body, modes));
    let _ = systems.iter().enumerate().try_for_each(|(number, system)| {
        let members = bodies.iter().zip(all).filter(|(body, _)| body.system == Some(number));
        write_system(&mut text, number, system, &members.map(|(_, body)| &**body).collect::<Vec<_>>())
    });
    text
}

/// What the modes are about.
fn assumptions(scene: &Scene) -> String {
    let model = &scene.built().model;
    let moves = model.supports.iter().any(|support| !support.motion.is_fixed())
        || model.solid_supports.iter().any(|support| !support.motion.is_fixed())
        || model.springs().iter().filter_map(Spring::anchor).any(|anchor| !anchor.motion.is_fixed());
    let moving = if moves { ";\nsupports and anchors that move are held where they are at t = 0" } else { "" };
    let cells = scene.built().cell.as_ref().filter(|cell| cell.load.is_some() && cell.periodic.contains(&true));
    let vectors = cells.map_or("", |_| ", in cells whose vectors rest");
    format!("Small motions about the rest state that bodies get to from their start{vectors}{moving}\n")
}

/// A body under its name.
fn write_body(text: &mut String, body: &Body, modes: &BodyModes) -> std::fmt::Result {
    let pinned = if body.pin.is_some() { ", pinned" } else { "" };
    let material = modes.kind.material.as_ref().map(|material| format!(": {material}")).unwrap_or_default();
    writeln!(text, "\nbody {}, {}{pinned}{material}", modes.name, modes.kind.kind)?;
    if let Some(reason) = &modes.no_rest_state_because {
        let lines = wrapped(&format!("no rest state: {reason}"), WIDTH - 2);
        lines.iter().try_for_each(|line| writeln!(text, "  {line}"))?;
    }
    if let Some(rest) = &modes.rest_state {
        write_rest(text, &rest.place)?;
        write_table(text, &rest.modes)?;
        write_shapes(text, &rest.modes, 0.5 * body.size)?;
    }
    Ok(())
}

/// Bodies that act on one another, under the number of their system.
fn write_system(text: &mut String, number: usize, system: &SystemModes, bodies: &[&Body]) -> std::fmt::Result {
    writeln!(text, "\nsystem {number}: {}", wrapped(&system.bodies.join(", "), WIDTH - 12).join("\n  "))?;
    if let Some(reason) = &system.no_rest_state_because {
        let lines = wrapped(&format!("no rest state: {reason}"), WIDTH - 2);
        lines.iter().try_for_each(|line| writeln!(text, "  {line}"))?;
    }
    let Some(rest) = &system.rest_state else { return Ok(()) };
    for (name, place) in &rest.bodies.0 {
        writeln!(text, "{name}")?;
        write_rest(text, place)?;
    }
    write_table(text, &rest.modes)?;
    if bodies.len() > MOST_SHOWN {
        return writeln!(text, "\nThe shapes of {} bodies stand in what --json prints.", bodies.len());
    }
    write_system_shapes(text, &rest.modes, bodies)
}

/// The shapes of a system: a line a mode and body, where it moves.
fn write_system_shapes(
    text: &mut String,
    modes: &[ModeSurvey<Named<ShapeSurvey>>],
    bodies: &[&Body],
) -> std::fmt::Result {
    writeln!(text, "\nShapes; of the points at half the size of each body from its centre the fastest moves by 1,")?;
    writeln!(text, "and δP is times that length.")?;
    let names = modes.iter().flat_map(|mode| &mode.shape.0).map(|(name, _)| name);
    let width = names.map(|name| name.chars().count()).max().unwrap_or(0);
    writeln!(text, "mode  {:width$}{}", "", shape_heading())?;
    for (index, mode) in modes.iter().enumerate() {
        let ahead = mode.quadrature.iter().flat_map(|shapes| &shapes.0).map(|shape| ("+i".to_owned(), shape));
        let lines = mode.shape.0.iter().map(|shape| ((index + 1).to_string(), shape)).chain(ahead);
        for (place, (number, (name, shape))) in lines.enumerate() {
            let radius = 0.5 * bodies[place % bodies.len()].size;
            if is_seen(shape, radius) {
                write_shape(text, &format!("{number:>4}  {name:<width$}"), shape, radius)?;
            }
        }
    }
    Ok(())
}

/// The names of the twelve numbers of a shape.
fn shape_heading() -> String {
    let cells = |cells: &[&str]| cells.iter().map(|cell| format!("{cell:>7}")).collect::<String>();
    let matrix = ["xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"];
    format!("{}  {}", cells(&["x", "y", "z"]), cells(&matrix))
}

/// A line a mode: frequency, decay, damping ratio, what it is.
fn write_table<S>(text: &mut String, modes: &[ModeSurvey<S>]) -> std::fmt::Result {
    let line = |cells: [&str; 5]| {
        format!("{:>4}  {:>10}  {:>10}  {:>22}  {:>9}  ", cells[0], cells[1], cells[2], cells[3], cells[4])
    };
    let heading = line(["mode", "f [Hz]", "ω [rad/s]", "decay [1/s]", "damping"]);
    writeln!(text, "\n{heading}motion")?;
    for (index, mode) in modes.iter().enumerate() {
        let number = (index + 1).to_string();
        let hertz =
            if mode.motion == "oscillates" { significant(mode.frequency_hz, 6) } else { mode.motion.to_owned() };
        let omega = if mode.frequency > 0.0 { significant(mode.frequency, 6) } else { String::new() };
        let ratio = mode.damping_ratio.map(|ratio| significant(ratio, 4)).unwrap_or_default();
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

/// One rate of a motion that oscillates, or what is not zero of them.
fn decay<S>(mode: &ModeSurvey<S>) -> String {
    let rates: Vec<String> = mode.decay_rates.iter().map(|rate| significant(*rate, 5)).collect();
    match (mode.motion, &mode.decay_rates[..]) {
        ("oscillates", _) => rates[0].clone(),
        ("free", [.., fast]) if *fast == 0.0 => String::new(),
        ("free", _) => rates[rates.len() - 1].clone(),
        // A pair of eigenvalues has one growth.
        ("unstable", _) if mode.frequency > 0.0 => rates[0].clone(),
        _ => rates.join(", "),
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

/// Whether an entry is more than zero in print.
fn is_seen(shape: &ShapeSurvey, radius: f64) -> bool {
    let gradient = shape.gradient.iter().flatten().map(|value| value * radius);
    shape.translation.iter().copied().chain(gradient).any(|value| value.abs() >= LEAST_SEEN)
}

/// The shapes: a line of twelve numbers a mode, and another for a part out of step.
fn write_shapes(text: &mut String, modes: &[ModeSurvey], radius: f64) -> std::fmt::Result {
    writeln!(text, "\nShapes; of the points at {} m from the centre the fastest moves by 1.", significant(radius, 5))?;
    writeln!(text, "mode  δp₀{:>18}  δP · {} m", "", significant(radius, 5))?;
    writeln!(text, "    {}", shape_heading())?;
    for (index, mode) in modes.iter().enumerate() {
        write_shape(text, &format!("{:>4}", index + 1), &mode.shape, radius)?;
        if let Some(quadrature) = mode.quadrature.as_ref().filter(|shape| is_seen(shape, radius)) {
            write_shape(text, "  +i", quadrature, radius)?;
        }
    }
    Ok(())
}

fn write_shape(text: &mut String, number: &str, shape: &ShapeSurvey, radius: f64) -> std::fmt::Result {
    let entry = |value: &f64| if value.abs() < LEAST_SEEN { format!("{:>7}", 0) } else { format!("{value:>7.3}") };
    let center: String = shape.translation.iter().map(entry).collect();
    let gradient: String = shape.gradient.iter().flatten().map(|value| entry(&(value * radius))).collect();
    writeln!(text, "{number}{center}  {gradient}")
}
