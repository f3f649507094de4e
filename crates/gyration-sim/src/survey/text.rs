//! The survey of a scene as text, as `gyration check` prints it.

use super::bodies::{BodySurvey, Survey};
use super::crowd::{MOST_BODIES, sorts, write_crowd};
use super::joints::write_joints;
use super::meetings::write_meetings;
use super::softness::write_softness;
use super::springs::write_springs;
use super::supports::write_supports;
use super::words::write_body_words;
use crate::format::vector;
use gyration_scene::units::shown;
use gyration_scene::{NotToml, Scene};
use std::fmt::Write as _;

/// Stands above the resolved scene, a comment of TOML.
const HEADING: &str = "# The resolved scene: SI units, every default in its place";
/// The same, where bodies of a crowd are left out.
const EXCERPT: &str = "# The resolved scene: SI units, every default in its place; of the bodies the first of each \
                       sort, all with --json";

impl Survey {
    /// The survey of a scene as text, and the resolved scene; from the heading on the text is itself a scene. Of many
    /// bodies, those that are told alike are told once.
    ///
    /// # Errors
    /// [`NotToml`] if the resolved scene has no form in TOML.
    pub fn text(&self, scene: &Scene) -> Result<String, NotToml> {
        if scene.file().body.len() <= MOST_BODIES {
            return Ok(format!("{}\n{HEADING}\n\n{}", in_words(scene, self), scene.to_toml()?));
        }
        let first: Vec<usize> = sorts(&self.bodies).iter().filter_map(|sort| sort.first().copied()).collect();
        Ok(format!("{}\n{EXCERPT}\n\n{}", in_words(scene, self), scene.excerpt(&first)?))
    }
}

// Writing to a string does not fail: the results of writeln! are dropped in this file.

fn in_words(scene: &Scene, survey: &Survey) -> String {
    let built = scene.built();
    let plan = &built.plan;
    let mut text = format!("{}\n\n", scene.title());
    let _ = writeln!(text, "gravity    {} m/s²", vector(&built.model.gravity.into()));
    let _ = writeln!(text, "time       to {} s, a sample every {} s", shown(plan.end), shown(plan.sample));
    if let Some(rest) = &plan.stop_at_rest {
        let (speed, hold) = (shown(rest.speed), shown(rest.hold));
        let _ = writeln!(text, "           ends early if slower than {speed} m/s for {hold} s");
    }
    let _ = writeln!(text, "solver     rtol {:e}, atol {:e}", plan.rtol, plan.atol);
    write_supports(&mut text, &survey.supports);
    write_joints(&mut text, &survey.joints, &survey.linkages);
    write_springs(&mut text, &survey.springs);
    write_meetings(&mut text, &survey.meetings, survey.pairs[0], survey.pairs[1]);
    write_softness(&mut text, &survey.softness);
    for note in &survey.remarks.notes {
        let _ = writeln!(text, "note       {note}");
    }
    for warning in &survey.remarks.warnings {
        let _ = writeln!(text, "warning    {warning}");
    }
    if survey.bodies.len() > MOST_BODIES {
        write_crowd(&mut text, &survey.bodies);
        return text;
    }
    for (names, words) in alike(&survey.bodies) {
        let bodies = if names.len() > 1 { "bodies" } else { "body" };
        let _ = write!(text, "\n{bodies} {}\n{words}", names.join(", "));
    }
    text
}

/// What is told of each body, with the names of those of which the same is told.
fn alike(bodies: &[BodySurvey]) -> Vec<(Vec<&str>, String)> {
    let mut told: Vec<(Vec<&str>, String)> = Vec::new();
    for body in bodies {
        let mut words = String::new();
        write_body_words(&mut words, body);
        match told.iter_mut().find(|(_, known)| *known == words) {
            Some((names, _)) => names.push(&body.name),
            None => told.push((vec![&body.name], words)),
        }
    }
    told
}
