//! The summary of a run for people: outcome, steps, ledger, momenta, events.

use super::verdict::ROUNDING;
use super::{Attitude, BodySummary, LedgerSummary, MOST_BODIES, RunSummary};
use crate::crowd::CrowdState;
use crate::format::{duration, significant, vector};
use gyration_record::{RecordError, Recording};
use gyration_scene::Scene;
use serde_json::Value;
use std::fmt::Write as _;

impl RunSummary {
    /// The summary as lines of text, as `gyration run` prints it; `start` are the energies [J] at t = 0, in the order
    /// of the ledger.
    pub fn text(&self, scene: &Scene, start: &[f64]) -> String {
        let mut text = format!("{}\noutcome    {}\n", scene.title(), self.in_words);
        // Writing to a string does not fail.
        let _ = writeln!(text, "{}", steps(self));
        text += &ledger(&self.ledger, start);
        text += &dissipation(&self.ledger);
        text += &if self.bodies.len() > MOST_BODIES { crowd(&self.bodies) } else { bodies(&self.bodies) };
        text += &self.crowd.as_ref().map(together).unwrap_or_default();
        text += &events(&self.events);
        if let Some(hash) = &self.row_hash {
            let _ = writeln!(text, "hash       {hash} of all rows");
        }
        text.trim_end().to_owned()
    }

    /// The energies [J] of the first row of its recording, in the order of the ledger.
    ///
    /// # Errors
    /// Those of reading.
    pub fn energies_at_start(&self, recording: &Recording) -> Result<Vec<f64>, RecordError> {
        let first = |(name, _): &(&str, f64)| Ok(recording.read_rows(&format!("energy_{name}"), 0..1)?.data[0]);
        self.ledger.energies.iter().map(first).collect()
    }
}

fn steps(summary: &RunSummary) -> String {
    let count = |name: &str| summary.statistics.get(name).and_then(Value::as_u64).unwrap_or(0);
    let (explicit, implicit) = (count("explicit_steps"), count("implicit_steps"));
    let rejected = count("rejected_for_error") + count("rejected_for_domain") + count("newton_failures");
    let wall = match summary.wall_time {
        None => String::new(),
        Some(short) if short < 10.0 => format!(" in {short:.2} s"),
        Some(long) => format!(" in {}", duration(long)),
    };
    format!(
        "time       {} s simulated{wall}\nsteps      {} ({explicit} explicit, {implicit} implicit), {rejected} \
            rejected",
        significant(summary.time, 7),
        explicit + implicit,
    )
}

/// The ledger as a table, and how well it closes; `start` are the energies at t = 0, in the order of the ledger.
fn ledger(ledger: &LedgerSummary, start: &[f64]) -> String {
    if ledger.energies.is_empty() {
        return "energy     at the end not known: the bodies there could not all be looked at\n".to_owned();
    }
    let mut text = format!("energy [J]  {:>26} {:>16}\n", "at t = 0", "at the end");
    let end: f64 = ledger.energies.iter().map(|(_, value)| value).sum();
    let energies = ledger.energies.iter().map(|(name, value)| (*name, *value)).zip(start);
    for ((name, value), start) in energies {
        let _ = writeln!(text, "  {name:<19} {:>16} {:>16}", number(*start), number(value));
    }
    let _ = writeln!(text, "  {:<19} {:>16} {:>16}", "sum", number(ledger.initial_energy), number(end));
    for (name, value) in &ledger.works {
        let _ = writeln!(text, "  {:<36} {:>16}", format!("work of {name}"), number(*value));
    }
    let _ = writeln!(text, "  {:<36} {:>16}", "residual", number(ledger.residual));
    let relative = ledger.largest_residual / ledger.energy_in_play;
    let relative = if ledger.balance().is_rounding() {
        ", the rounding of the energies".to_owned()
    } else if relative.is_finite() {
        format!(", {relative:.1e} of the energy in play")
    } else {
        String::new()
    };
    let _ = match ledger.warning() {
        None => writeln!(text, "  the balance closes to {:.1e} J{relative}", ledger.largest_residual),
        Some(warning) => writeln!(text, "  warning: {warning}"),
    };
    text
}

/// What a body's own losses took, and the least that one of them took in a step [J].
struct Loss {
    name: &'static str,
    taken: f64,
    least: f64,
}

/// What the drive did and what was lost within the bodies, and whether each loss is one at every step.
fn dissipation(ledger: &LedgerSummary) -> String {
    let loss = |(name, least): &(&'static str, f64)| {
        ledger.work(name).map(|work| Loss { name, taken: -work + 0.0, least: *least })
    };
    let losses: Vec<Loss> = ledger.least_dissipation.iter().filter_map(loss).collect();
    let lost = |loss: &Loss| format!("lost {} J", significant(loss.taken, 5));
    let words = match (ledger.work("drive"), &losses[..]) {
        (None, []) => return String::new(),
        (None, [only]) => format!("{:<10} {}", only.name, lost(only)),
        (drive, losses) => {
            let did = drive.map(|work| format!("did {} J", significant(work, 5)));
            let lost = losses.iter().map(|loss| format!("{} {}", loss.name, lost(loss)));
            format!("{:<10} {}", "drive", did.into_iter().chain(lost).collect::<Vec<_>>().join(", "))
        }
    };
    format!("{words}{}\n", verdict(&losses, ledger.energy_in_play))
}

/// Whether losses are losses at every step; a gain is told beside the energy in play [J].
fn verdict(losses: &[Loss], in_play: f64) -> String {
    let least = losses.iter().map(|loss| loss.least).fold(f64::INFINITY, f64::min);
    let subject = match losses {
        [] => return String::new(),
        [_] => "it dissipates",
        _ => "both dissipate",
    };
    if least >= 0.0 {
        return format!("; {subject} at every step (least {least:.1e} J)");
    }
    if -least <= ROUNDING * in_play {
        return format!("; {subject} at every step up to rounding (least {least:.1e} J)");
    }
    let relative = -least / in_play;
    format!("; {subject} but for the error of a step (least {least:.1e} J, {relative:.1e} of the energy in play)")
}

fn bodies(bodies: &[BodySummary]) -> String {
    let mut text = String::from("at the end\n");
    for body in bodies {
        let gap = body.gap.map(|gap| format!(", gap {} m", significant(gap, 5))).unwrap_or_default();
        let _ = writeln!(text, "  {:<20} at {} m{gap}", body.name, vector(&body.position));
        let _ = writeln!(text, "  {:<20} momentum {} kg m/s", "", vector(&body.linear_momentum));
        let _ = writeln!(text, "  {:<20} angular momentum {} kg m²/s", "", vector(&body.angular_momentum));
        let _ = match &body.attitude {
            Some(attitude) => writeln!(text, "  {:<20} {}", "", stands(attitude)),
            None => {
                let [first, second, third] = &body.affine_momentum;
                let rows = [vector(first), vector(second), vector(third)].join(" ");
                writeln!(text, "  {:<20} affine momentum {rows} kg m²/s", "")
            }
        };
    }
    if bodies.len() > 1 {
        let _ = writeln!(text, "  {:<20} momentum {} kg m/s", "in all", vector(&total(bodies, |b| &b.linear_momentum)));
        let angular = vector(&total(bodies, |body| &body.angular_momentum));
        let _ = writeln!(text, "  {:<20} angular momentum {angular} kg m²/s", "");
    }
    text
}

/// How a rigid body stands and turns, in a line.
fn stands(attitude: &Attitude) -> String {
    let Attitude { angle, axis, angular_velocity, below } = attitude;
    let turned = match axis {
        Some(axis) => format!("turned by {} deg about {}", significant(angle.to_degrees(), 5), vector(axis)),
        None => "not turned".to_owned(),
    };
    let below = below.map(|side| format!(", {side} looks down")).unwrap_or_default();
    format!("{turned}{below}, angular velocity {} rad/s", vector(angular_velocity))
}

/// The sum over bodies of a vector of theirs.
fn total(bodies: &[BodySummary], of: impl Fn(&BodySummary) -> &[f64; 3]) -> [f64; 3] {
    bodies.iter().fold([0.0; 3], |sum, body| [0, 1, 2].map(|axis| sum[axis] + of(body)[axis]))
}

/// What many bodies have in common at the end: where they are, how far from supports, how fast, and their momentum.
fn crowd(bodies: &[BodySummary]) -> String {
    let mut text = format!("at the end, {} bodies\n", bodies.len());
    let between = |of: &dyn Fn(&BodySummary) -> f64| {
        let range = bodies
            .iter()
            .map(of)
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), value| (least.min(value), most.max(value)));
        format!("{} to {}", significant(range.0, 5), significant(range.1, 5))
    };
    for (axis, name) in ["x", "y", "z"].iter().enumerate() {
        let _ = writeln!(text, "  {name:<20} {} m", between(&|body| body.position[axis]));
    }
    if let Some(nearest) = bodies.iter().filter(|body| body.gap.is_some()).min_by(|a, b| gap(a).total_cmp(&gap(b))) {
        let farthest = bodies.iter().filter_map(|body| body.gap).fold(0.0, f64::max);
        let (least, most) = (significant(gap(nearest), 5), significant(farthest, 5));
        let _ = writeln!(text, "  {:<20} {least} ({}) to {most} m", "gap", nearest.name);
    }
    let fastest = bodies.iter().max_by(|a, b| a.speed.total_cmp(&b.speed));
    let mean = (bodies.iter().map(|body| body.speed * body.speed).sum::<f64>() / bodies.len() as f64).sqrt();
    if let Some(fastest) = fastest {
        let (mean, most) = (significant(mean, 5), significant(fastest.speed, 5));
        let _ =
            writeln!(text, "  {:<20} {mean} m/s in the square mean, at most {most} m/s ({})", "speed", fastest.name);
    }
    let total = vector(&total(bodies, |body| &body.linear_momentum));
    let _ = writeln!(text, "  {:<20} {total} kg m/s in all", "momentum");
    text
}

/// What many bodies do together at the end: how they move about their mean, and what they touch.
fn together(crowd: &CrowdState) -> String {
    let mut text = String::new();
    if let Some(temperature) = crowd.temperature {
        let parts = [crowd.drift, crowd.agitation, crowd.turning].map(|energy| significant(energy, 5));
        let [drift, agitation, turning] = parts;
        let _ = writeln!(text, "  {:<20} {} m²/s², granular", "temperature", significant(temperature, 5));
        let _ = writeln!(
            text,
            "  {:<20} {drift} J with their mean, {agitation} J about it, {turning} J turning and straining",
            "kinetic energy"
        );
    }
    let [between, supports] = crowd.contacts;
    if let (Some(mean), Some(largest)) = (crowd.mean_force, crowd.largest_force) {
        let (mean, largest) = (significant(mean, 5), significant(largest, 5));
        let _ = writeln!(
            text,
            "  {:<20} {between} between bodies, {supports} with supports, {} of a body; {mean} N in the mean, at most \
                {largest} N",
            "contacts",
            significant(crowd.coordination, 4),
        );
    }
    text
}

/// The gap of a body, if it has one.
fn gap(body: &BodySummary) -> f64 {
    body.gap.unwrap_or(f64::INFINITY)
}

fn events(events: &Value) -> String {
    let counts = events.as_object().into_iter().flatten();
    let counts: Vec<String> = counts
        .filter_map(|(kind, count)| Some((kind, count.as_u64().filter(|count| *count > 0)?)))
        .map(|(kind, count)| format!("{count} {}", kind.replace('_', " ")))
        .collect();
    if counts.is_empty() { String::new() } else { format!("events     {}\n", counts.join(", ")) }
}

/// Seven digits, in a column.
fn number(value: f64) -> String {
    format!("{value:.6e}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_crowd_is_told_by_what_its_bodies_have_in_common() {
        let body = |k: usize| BodySummary {
            name: format!("b{k}"),
            position: [k as f64, 1.0, -0.5 * k as f64],
            gap: (k > 0).then_some(0.25 * k as f64),
            speed: if k == 3 { 2.0 } else { 0.0 },
            linear_momentum: [0.5, 0.0, k as f64],
            angular_momentum: [0.0; 3],
            affine_momentum: [[0.0; 3]; 3],
            attitude: None,
        };
        let text = crowd(&(0..4).map(body).collect::<Vec<_>>());
        let lines: Vec<String> =
            text.lines().map(|line| line.split_whitespace().collect::<Vec<_>>().join(" ")).collect();
        let expected = [
            "at the end, 4 bodies",
            "x 0 to 3 m",
            "y 1 to 1 m",
            "z -1.5 to 0 m",
            "gap 0.25 (b1) to 0.75 m",
            "speed 1 m/s in the square mean, at most 2 m/s (b3)",
            "momentum (2, 0, 6) kg m/s in all",
        ];
        assert_eq!(lines, expected);
    }

    #[test]
    fn losses_are_told_with_whether_they_are_losses_at_every_step() {
        let loss = |name, least| Loss { name, taken: 1.0, least };
        let both = [loss("contraction", 1e-9), loss("viscosity", 0.0)];
        assert_eq!(verdict(&both, 4.0), "; both dissipate at every step (least 0.0e0 J)");
        assert_eq!(verdict(&both[..1], 4.0), "; it dissipates at every step (least 1.0e-9 J)");
        let rounding = verdict(&[loss("viscosity", -1e-16)], 4.0);
        assert_eq!(rounding, "; it dissipates at every step up to rounding (least -1.0e-16 J)");
        let gained = verdict(&[loss("viscosity", -2e-9)], 4.0);
        assert!(
            gained.ends_with("but for the error of a step (least -2.0e-9 J, 5.0e-10 of the energy in play)"),
            "{gained}"
        );
        assert_eq!(verdict(&[], 4.0), "");
    }
}
