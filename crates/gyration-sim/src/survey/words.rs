//! One body of a survey in words: what it is, its laws with each support, where it rests.

use super::bodies::{BodySurvey, PairSurvey};
use super::kind::KindSurvey;
use super::modes::{ModeSurvey, RestPlace};
use super::rest::{Descent, RestGap};
use crate::format::{significant, vector};
use std::fmt::{self, Write as _};

// Writing to a string does not fail: the results of writeln! are dropped in this file.

/// A body, under its name.
pub(super) fn write_body(text: &mut String, body: &BodySurvey) {
    let _ = writeln!(text, "body {}", body.name);
    write_body_words(text, body);
}

/// A body without its name.
pub(super) fn write_body_words(text: &mut String, body: &BodySurvey) {
    write_solid(text, body);
    for pair in &body.supports {
        write_pair(text, pair, body.kind.material.is_some());
    }
    write_rest_state(text, body);
}

/// Kind, mass and size.
pub(super) fn write_solid(text: &mut String, body: &BodySurvey) {
    let mass = &body.mass;
    let volume = if mass.volume > 0.0 { format!(", volume {} m³", short(mass.volume)) } else { String::new() };
    let _ = writeln!(text, "  kind            {}", kind(&body.kind));
    for load in &body.kind.loads {
        let _ = writeln!(text, "                  {load}");
    }
    let _ = writeln!(text, "  mass            {} kg{volume}, size {} m", short(mass.mass), short(body.size));
    let _ = writeln!(text, "  centre of mass  {} m in the shape's frame", vector(&mass.center));
    let _ = writeln!(text, "  inertia         {} kg m² about the principal axes", vector(&mass.inertia_principal));
    let _ = writeln!(text, "  Euler tensor    {} kg m² along them", vector(&mass.euler_principal));
}

/// Where a body that deforms rests, and how it moves about that state.
pub(super) fn write_rest_state(text: &mut String, body: &BodySurvey) {
    if let Some(reason) = &body.no_rest_state_because {
        let _ = writeln!(text, "  no rest state: {reason}");
    }
    if let Some(rest) = &body.rest_state {
        let _ = write_rest(text, &rest.place);
        rest.modes.chunk_by(alike).for_each(|modes| write_modes(text, modes));
    }
}

fn kind(kind: &KindSurvey) -> String {
    let words = kind.material.as_ref().map(|material| format!(": {material}")).unwrap_or_default();
    let incompressible = if kind.incompressible { ", incompressible" } else { "" };
    format!("{}{incompressible}{words}", kind.kind)
}

/// Whether two motions have the same frequency and decay to the digits that are printed.
fn alike(a: &ModeSurvey, b: &ModeSurvey) -> bool {
    a.motion == b.motion && short(a.frequency_hz) == short(b.frequency_hz) && decay(a) == decay(b)
}

fn decay(mode: &ModeSurvey) -> String {
    let rates: Vec<String> = mode.decay_rates.iter().filter(|rate| **rate != 0.0).map(|rate| short(*rate)).collect();
    match (mode.motion, rates.first()) {
        (_, None) => "does not decay".to_owned(),
        ("oscillates", Some(rate)) => format!("decays with {rate} 1/s"),
        _ => format!("decays with {} 1/s", rates.join(" and ")),
    }
}

/// Motions of one frequency.
fn write_modes(text: &mut String, modes: &[ModeSurvey]) {
    let Some(first) = modes.first() else { return };
    let head = match first.motion {
        "oscillates" => format!("{} Hz", short(first.frequency_hz)),
        motion => motion.to_owned(),
    };
    let times = if modes.len() > 1 { format!(" (×{})", modes.len()) } else { String::new() };
    let words: Vec<&str> = modes.iter().map(|mode| mode.in_words.as_str()).collect();
    let _ = writeln!(text, "    {head}{times}, {}: {}", decay(first), words.join("; "));
}

fn write_pair(text: &mut String, pair: &PairSurvey, deforms: bool) {
    let _ = writeln!(text, "  on {}: gap {} m at the start", pair.support, short(pair.initial_gap));
    write_laws(text, pair);
    if pair.rests.is_empty() && pair.no_rest_because.is_none() && !pair.laws.is_empty() {
        let weight = short(pair.weight);
        let _ = writeln!(text, "    no gap at which the laws balance the weight's part along the normal, {weight} N");
    }
    for rest in &pair.rests {
        write_gap(text, rest, deforms);
    }
}

/// What the laws forbid, and whether they alone tell where the body rests.
pub(super) fn write_laws(text: &mut String, pair: &PairSurvey) {
    if pair.laws.is_empty() {
        let _ = writeln!(text, "    no law acts between the two");
        return;
    }
    for law in &pair.laws {
        let _ = writeln!(text, "    {}", law.verdict());
    }
    if !pair.forbids_touching {
        let _ = writeln!(text, "    no law forbids touching: a body that is fast enough gets there, and the run stops");
    }
    if let Some(reason) = pair.no_rest_because {
        let _ = writeln!(text, "    no gap of rest is given: {reason}, and this support alone does not tell");
    }
}

fn write_gap(text: &mut String, rest: &RestGap, deforms: bool) {
    if !rest.stable {
        let _ = writeln!(text, "    balance at a gap of {} m, unstable", short(rest.gap));
        return;
    }
    let if_so = if deforms { "if it kept the shape of its start" } else { "in this orientation" };
    let gap = short(rest.gap);
    let _ = match rest.descent {
        None => writeln!(text, "    rests at a gap of {gap} m {if_so}"),
        Some(Descent::Slides { speed }) => {
            // Rocking and friction may excite each other: a steady slide need not be what comes.
            writeln!(
                text,
                "    slides down the slope at {} m/s once it is steady, at a gap of {gap} m {if_so}",
                short(speed)
            )
        }
        Some(Descent::Accelerates { acceleration }) => {
            let along = short(acceleration);
            writeln!(text, "    slides down the slope with {along} m/s², at a gap of {gap} m {if_so}")
        }
        Some(Descent::Rolls) => writeln!(text, "    rolls or tips down the slope, at a gap of {gap} m {if_so}"),
    };
    let period = rest.period.map_or_else(String::new, |period| format!(", period {} s", short(period)));
    let _ = writeln!(text, "      stiffness {} N/m{period}", short(rest.stiffness));
    if let (Some(ratio), Some(time)) = (rest.damping_ratio, rest.damping_time) {
        let kind = if ratio < 1.0 { "oscillates" } else { "creeps" };
        let _ = writeln!(text, "      damping ratio {}: {kind}, decays in {} s", short(ratio), short(time));
    }
    if let Some(time) = rest.friction_time {
        let slow = if rest.slip.is_some_and(|slip| slip.bound.is_some()) { "slow sliding" } else { "sliding" };
        let _ = writeln!(text, "      {slow} decays in {} s{}", short(time), friction(rest));
    }
    if let Some(time) = rest.slip.and_then(|slip| slip.rolling_time) {
        let _ = writeln!(text, "      slow rolling decays in {} s", short(time));
    }
}

/// What friction does, in a clause.
fn friction(rest: &RestGap) -> String {
    let Some(slip) = rest.slip else { return String::new() };
    match slip.bound.zip(slip.creep()) {
        None => format!("; friction is as strong as the weight at {} m/s", short(slip.weight_speed)),
        Some((bound, creep)) => format!(
            "; friction holds up to {} of what presses on the support, and what it holds creeps: at {} m/s under {} \
             of it",
            short(bound),
            short(creep),
            short(std::f64::consts::FRAC_1_SQRT_2 * bound),
        ),
    }
}

/// Place, gap, stretches and pressure at rest.
pub fn write_rest(text: &mut String, rest: &RestPlace) -> fmt::Result {
    let gap = rest.gap.map(|gap| format!(", gap {} m", short(gap))).unwrap_or_default();
    writeln!(text, "  rests at {} m{gap}", vector(&rest.position))?;
    if rest.stretches != [1.0; 3] {
        let pressure = rest.pressure.map(|pressure| format!(", pressure {} Pa", short(pressure))).unwrap_or_default();
        writeln!(text, "  stretches {}{pressure}", rest.stretches.map(|stretch| format!("{stretch:.6}")).join(", "))?;
    }
    if let Some(contraction) = &rest.contraction {
        let rows = contraction.map(|row| vector(&row));
        writeln!(text, "  contraction stands still at {}", rows.join(", "))?;
    }
    if let Some(left_out) = &rest.left_out {
        writeln!(text, "  {left_out}")?;
    }
    Ok(())
}

/// Five digits.
pub(super) fn short(value: f64) -> String {
    significant(value, 5)
}
