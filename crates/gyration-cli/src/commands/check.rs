//! `gyration check`: what a scene says before it runs.

use super::modes::write_rest;
use super::open;
use crate::arguments::Check;
use crate::check::{self, BodyCheck, KindCheck, LawCheck, ModeCheck, PairCheck, Rest, SceneCheck};
use crate::error::{CliError, code};
use crate::output;
use crate::summary::{plain, vector};
use gyration_scene::{LoadError, Scene};
use gyration_sim::completed;
use serde_json::json;
use std::borrow::Cow;
use std::fmt::Write as _;

/// Stands above the resolved scene, a comment of TOML.
const HEADING: &str = "# The resolved scene: SI units, every default in its place";

/// Prints what can be said of the scene.
pub fn execute(arguments: &Check) -> Result<u8, CliError> {
    let scene = open(&arguments.scene)?;
    let text = if arguments.json {
        let found = survey(&scene)?;
        let value = json!({ "scene": scene.name(), "resolved": scene.resolved(), "bodies": found.bodies });
        format!("{value:#}\n")
    } else {
        in_full(&scene)?
    };
    output::print(&text)?;
    Ok(code::DONE)
}

/// What can be said of a scene. Only the rest state of a body that deforms takes its resistance in the fluid.
fn survey(scene: &Scene) -> Result<SceneCheck, CliError> {
    let deforms = scene.unknown_forms().iter().any(|form| form.resolution.is_some());
    let scene = if deforms { completed(scene).map_err(LoadError::from)? } else { Cow::Borrowed(scene) };
    Ok(check::check(&scene.built().model, &scene.built().state))
}

/// What there is to say in words, and the resolved scene.
pub(crate) fn in_full(scene: &Scene) -> Result<String, CliError> {
    let found = survey(scene)?;
    Ok(in_words(scene, &found) + &resolved(scene)?)
}

/// The resolved scene under a heading; from there on the text is itself a scene.
fn resolved(scene: &Scene) -> Result<String, CliError> {
    let text = toml::to_string(scene.file()).map_err(CliError::Resolved)?;
    Ok(format!("\n{HEADING}\n\n{text}"))
}

// Writing to a string does not fail: the results of writeln! are dropped in this file.

fn in_words(scene: &Scene, found: &SceneCheck) -> String {
    let built = scene.built();
    let plan = &built.plan;
    let title = scene.file().title.clone().unwrap_or_else(|| scene.name().to_owned());
    let mut text = format!("{title}\n\n");
    let _ = writeln!(text, "gravity    {} m/s²", vector(&built.model.gravity.into()));
    let _ = writeln!(text, "time       to {} s, a sample every {} s", plan.end, plan.sample);
    if let Some(rest) = &plan.stop_at_rest {
        let _ = writeln!(text, "           ends early if slower than {} m/s for {} s", rest.speed, rest.hold);
    }
    let _ = writeln!(text, "solver     rtol {:e}, atol {:e}", plan.rtol, plan.atol);
    for support in &built.model.supports {
        let (origin, normal) = (vector(&support.origin.into()), vector(&support.normal.into()));
        let _ = writeln!(text, "support    {}: plane through {origin} m, normal {normal}", support.name);
    }
    for body in &found.bodies {
        text.push('\n');
        write_body(&mut text, body);
    }
    text
}

fn write_body(text: &mut String, body: &BodyCheck) {
    let mass = &body.mass;
    let volume = if mass.volume > 0.0 { format!(", volume {} m³", short(mass.volume)) } else { String::new() };
    let _ = writeln!(text, "body {}", body.name);
    let _ = writeln!(text, "  kind            {}", kind(&body.kind));
    for load in &body.kind.loads {
        let _ = writeln!(text, "                  {load}");
    }
    let _ = writeln!(text, "  mass            {} kg{volume}, size {} m", short(mass.mass), short(body.size));
    let _ = writeln!(text, "  centre of mass  {} m in the shape's frame", vector(&mass.center));
    let _ = writeln!(text, "  inertia         {} kg m² about the principal axes", vector(&mass.inertia_principal));
    let _ = writeln!(text, "  Euler tensor    {} kg m² along them", vector(&mass.euler_principal));
    for pair in &body.supports {
        write_pair(text, pair, body.kind.material.is_some());
    }
    if let Some(reason) = &body.no_rest_state_because {
        let _ = writeln!(text, "  no rest state: {reason}");
    }
    if let Some(rest) = &body.rest_state {
        let _ = write_rest(text, rest);
        rest.modes.chunk_by(alike).for_each(|modes| write_modes(text, modes));
    }
}

fn kind(kind: &KindCheck) -> String {
    let words = kind.material.as_ref().map(|material| format!(": {material}")).unwrap_or_default();
    let incompressible = if kind.incompressible { ", incompressible" } else { "" };
    format!("{}{incompressible}{words}", kind.kind)
}

/// Whether two motions have the same frequency and decay to the digits that are printed.
fn alike(a: &ModeCheck, b: &ModeCheck) -> bool {
    a.motion == b.motion && short(a.frequency_hz) == short(b.frequency_hz) && decay(a) == decay(b)
}

fn decay(mode: &ModeCheck) -> String {
    let rates: Vec<String> = mode.decay_rates.iter().filter(|rate| **rate != 0.0).map(|rate| short(*rate)).collect();
    match (mode.motion, rates.first()) {
        (_, None) => "does not decay".to_owned(),
        ("oscillates", Some(rate)) => format!("decays with {rate} 1/s"),
        _ => format!("decays with {} 1/s", rates.join(" and ")),
    }
}

/// Motions of one frequency.
fn write_modes(text: &mut String, modes: &[ModeCheck]) {
    let Some(first) = modes.first() else { return };
    let head = match first.motion {
        "oscillates" => format!("{} Hz", short(first.frequency_hz)),
        motion => motion.to_owned(),
    };
    let times = if modes.len() > 1 { format!(" (×{})", modes.len()) } else { String::new() };
    let words: Vec<&str> = modes.iter().map(|mode| mode.in_words.as_str()).collect();
    let _ = writeln!(text, "    {head}{times}, {}: {}", decay(first), words.join("; "));
}

fn write_pair(text: &mut String, pair: &PairCheck, deforms: bool) {
    let _ = writeln!(text, "  on {}: gap {} m at the start", pair.support, short(pair.initial_gap));
    if pair.laws.is_empty() {
        let _ = writeln!(text, "    no law acts between the two");
        return;
    }
    for law in &pair.laws {
        let _ = writeln!(text, "    {}", verdict(law));
    }
    if !pair.forbids_touching {
        let _ = writeln!(text, "    no law forbids touching: a body that is fast enough gets there, and the run stops");
    }
    if let Some(reason) = pair.no_rest_because {
        let _ = writeln!(text, "    no gap of rest is given: {reason}, and this support alone does not tell");
    } else if pair.rests.is_empty() {
        let weight = pair.weight;
        let _ = writeln!(
            text,
            "    no gap at which the laws balance the weight's part along the normal, {} N",
            short(weight)
        );
    }
    for rest in &pair.rests {
        write_gap(text, rest, deforms);
    }
}

/// The touch-or-not verdict on a law.
fn verdict(law: &LawCheck) -> String {
    let LawCheck { law: name, exponent, .. } = law;
    let (Some(feature), Some(critical)) = (law.feature, law.critical_exponent) else {
        return format!("{name:<10} ν = {exponent}");
    };
    match law.forbids_touching {
        _ if !law.acts => format!("{name:<10} has no strength: does nothing"),
        Some(true) => format!("{name:<10} ν = {exponent} ≥ {critical} ({feature}): forbids touching"),
        Some(false) => format!("{name:<10} ν = {exponent} < {critical} ({feature}): does not forbid touching"),
        None => format!("{name:<10} ν = {exponent}: acts across the normal, forbids nothing"),
    }
}

fn write_gap(text: &mut String, rest: &Rest, deforms: bool) {
    if !rest.stable {
        let _ = writeln!(text, "    balance at a gap of {} m, unstable", short(rest.gap));
        return;
    }
    let if_so = if deforms { "if it kept the shape of its start" } else { "in this orientation" };
    let _ = writeln!(text, "    rests at a gap of {} m {if_so}", short(rest.gap));
    let period = rest.period.map_or_else(String::new, |period| format!(", period {} s", short(period)));
    let _ = writeln!(text, "      stiffness {} N/m{period}", short(rest.stiffness));
    if let (Some(ratio), Some(time)) = (rest.damping_ratio, rest.damping_time) {
        let kind = if ratio < 1.0 { "oscillates" } else { "creeps" };
        let _ = writeln!(text, "      damping ratio {}: {kind}, decays in {} s", short(ratio), short(time));
    }
    if let Some(time) = rest.friction_time {
        let _ = writeln!(text, "      sliding decays in {} s", short(time));
    }
}

/// Five digits.
fn short(value: f64) -> String {
    plain(value, 5)
}
