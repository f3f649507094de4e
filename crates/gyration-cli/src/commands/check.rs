//! `gyration check`: what a scene says before it runs.

use crate::arguments::Check;
use crate::error::{CliError, code};
use crate::input::{open, ready};
use crate::output;
use crate::provenance::provenance;
use crate::waiting::waiting;
use gyration_scene::{LoadError, Scene};
use gyration_sim::format::significant;
use gyration_sim::survey::Survey;
use gyration_sim::{FirstSteps, Job, MemorySink, MomentumChange, RunError, Simulation};
use serde_json::json;
use std::num::NonZeroUsize;

/// Pairs of bodies that are looked at here as a run does.
const MOST_PAIRS: usize = 1000;

/// Prints what can be said of the scene.
pub fn execute(arguments: &Check) -> Result<u8, CliError> {
    let name = &arguments.scene.scene;
    // Steps need the resistances that only a run needs; waves make another start.
    let opened = || match open(&arguments.scene)? {
        scene if arguments.steps.is_none() && scene.built().waves.is_none() => Ok(scene),
        _ => ready(&arguments.scene),
    };
    let scene = waiting(format!("opening {name}"), true, opened)?;
    let job = Job::of(&scene, &provenance());
    begins(&scene, &job)?;
    let survey = waiting(format!("surveying {name}"), true, || Survey::of(&scene)).map_err(LoadError::from)?;
    let first_steps = |most: NonZeroUsize| {
        let steps = || job.interruption().within(|| FirstSteps::of(&job, most.get()));
        waiting(format!("stepping {name}"), true, steps)
    };
    let steps = arguments.steps.map(first_steps).transpose()?;
    let text = if arguments.json {
        let mut value = json!({ "scene": scene.name(), "resolved": scene.resolved(), "bodies": survey.bodies });
        let told = [
            ("supports", json!(survey.supports)),
            ("joints", json!(survey.joints)),
            ("linkages", json!(survey.linkages)),
            ("springs", json!(survey.springs)),
        ];
        for (name, list) in told {
            if list.as_array().is_some_and(|list| !list.is_empty()) {
                value[name] = list;
            }
        }
        if !survey.meetings.is_empty() {
            value["meetings"] = json!(survey.meetings);
            let left_out = survey.pairs[0] - survey.meetings.len();
            if left_out > 0 {
                value["meetings_left_out"] = json!(left_out);
            }
        }
        if !survey.softness.is_empty() {
            value["softness"] = json!(survey.softness);
        }
        for (name, told) in [("notes", &survey.remarks.notes), ("warnings", &survey.remarks.warnings)] {
            if !told.is_empty() {
                value[name] = json!(told);
            }
        }
        if let Some(FirstSteps { windows, difference, planes, momenta }) = &steps {
            value["steps"] =
                json!({ "count": windows, "difference": difference, "planes": planes, "changes": momenta });
        }
        format!("{value:#}\n")
    } else {
        survey.text(&scene)? + &steps.as_ref().map(in_words).unwrap_or_default()
    };
    output::print(&text)?;
    let failed = steps.and_then(|steps| steps.difference);
    if let Some(what) = &failed {
        output::say(&format!("gyration: a resumed run is another one: {what}; this is a fault of the program"));
    }
    Ok(if failed.is_some() { code::ENDED_EARLY } else { code::DONE })
}

/// Refuses a start from which a run would not begin. Resistances that only a run needs are not computed for that, and
/// where very many pairs take long the run tells.
fn begins(scene: &Scene, job: &Job) -> Result<(), CliError> {
    if !scene.unknown_forms().is_empty() || job.model.count_pairs()[1] > MOST_PAIRS {
        return Ok(());
    }
    let begun = job.interruption().within(|| {
        let mut simulation = Simulation::new(job.model, job.start, job.plan)?;
        simulation.begin(&mut MemorySink::default())
    });
    match begun {
        // The survey is given up as well.
        Ok(()) | Err(RunError::Interrupted(_)) => Ok(()),
        Err(error) => Err(error.into()),
    }
}

/// A paragraph below the survey.
fn in_words(steps: &FirstSteps) -> String {
    let FirstSteps { windows, difference, planes, momenta } = steps;
    let resumed = if difference.is_none() { "each resumes to the same bytes" } else { "not all resume the same" };
    let mut text = format!("\nfirst steps: {windows}, {resumed}");
    if *planes > 0.0 {
        text += &format!("; planes found anew push alike to {}", significant(*planes, 2));
    }
    if let Some(MomentumChange { momentum, angular_momentum }) = momenta {
        text += &format!("; momentum kept to {}", significant(*momentum, 2));
        text += &angular_momentum.map(|it| format!(", angular momentum to {}", significant(it, 2))).unwrap_or_default();
        text += " of what moves";
    }
    text + "\n"
}
