//! `gyration run`: a scene into a recording.

use crate::arguments::RunArguments;
use crate::error::{CliError, code};
use crate::input::{quoted, ready, shown};
use crate::output;
use crate::progress::RunProgress;
use crate::provenance::provenance;
use crate::waiting::waiting;
use gyration_plot::{OVERVIEW, leave_overview};
use gyration_record::{Attributes, RecordError, Recording, remove};
use gyration_scene::Scene;
use gyration_sim::{Job, Outcome, Reason, RecordingEnd as Ended, Remarks, RunError, RunSummary, Verdict};
use gyration_threads::Threads;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// Names tried for a recording without `-o`.
const MOST_NAMES: usize = 10_000;

/// Runs the scene; the exit code tells whether it reached its end.
pub fn execute(arguments: &RunArguments) -> Result<u8, CliError> {
    let opening = format!("opening {}", arguments.scene.scene);
    let scene = waiting(opening, !arguments.quiet, || ready(&arguments.scene))?;
    let path = directory(arguments, &scene)?;
    let mut job = Job::of(&scene, &provenance());
    if let Some(threads) = arguments.threads {
        job.plan.threads = Some(Threads::asked(Some(threads.get()))?);
    }
    let remarks = job.remarks();
    tell_remarks(arguments, &remarks);
    let mut watch = RunProgress::new(!arguments.quiet, job.model.bodies.len())?;
    let ended = watch.interruption().within(|| {
        if arguments.resume {
            watch.await_first_step();
            return job.resume(&path, &mut watch).map_err(CliError::from);
        }
        let looking = "looking at the start".to_owned();
        let begun = waiting(looking, !arguments.quiet, || job.interruption().within(|| job.begun()))?;
        make_room(arguments, &path)?;
        watch.await_first_step();
        Ok(begun.record(&path, &mut watch)?)
    });
    watch.finish();
    let ended = ended.inspect_err(|error| {
        // Disk full, device gone: what was flushed is there.
        if matches!(error, CliError::Run(RunError::Record(RecordError::Io { .. }))) && Recording::open(&path).is_ok() {
            output::say(&format!("gyration: once that is mended, go on with `{}`", resume_command(arguments, &path)));
        }
    })?;
    if let Some(warning) = leave_overview(&path) {
        output::say(&format!("gyration: {warning}"));
    }
    match ended {
        Ended::Ran(summary) => {
            tell(arguments, &scene, &path, (&*summary, &remarks))?;
            Ok(exit_code(&summary))
        }
        Ended::AlreadyFinished(attributes) => {
            tell_finished(arguments, &path, &attributes)?;
            Ok(code::DONE)
        }
    }
}

/// The exit code that tells a script how the run ended.
fn exit_code(summary: &RunSummary) -> u8 {
    match &summary.outcome {
        Outcome::Completed | Outcome::AtRest { .. } => match summary.ledger.verdict {
            Verdict::Closed => code::DONE,
            Verdict::Open => code::OPEN,
        },
        Outcome::Stopped(stop) if stop.reason == Reason::Interrupted => code::INTERRUPTED,
        Outcome::Stopped(_) => code::ENDED_EARLY,
    }
}

/// Where the recording goes; one that is there must be meant to be resumed or replaced.
fn directory(arguments: &RunArguments, scene: &Scene) -> Result<PathBuf, CliError> {
    let named = || arguments.output.clone().unwrap_or_else(|| numbered(Path::new(""), scene.name(), 1));
    if arguments.resume || arguments.force {
        return Ok(named());
    }
    match &arguments.output {
        None => free_name(Path::new(""), scene.name()),
        Some(path) if exists(path) => Err(CliError::arguments(
            format!("{} exists already", path.display()),
            "go on with it by --resume, replace it by --force, or choose another name",
        )),
        Some(path) => Ok(path.clone()),
    }
}

/// The first name of a recording in a folder that nothing has yet.
fn free_name(folder: &Path, scene: &str) -> Result<PathBuf, CliError> {
    let free = (1..MOST_NAMES).map(|k| numbered(folder, scene, k)).find(|path| !exists(path));
    free.ok_or_else(|| CliError::arguments("too many recordings of this scene here", "name one with -o DIR"))
}

/// The k-th name of a recording of a scene.
fn numbered(folder: &Path, scene: &str, k: usize) -> PathBuf {
    match k {
        1 => folder.join(format!("{scene}.gyr")),
        k => folder.join(format!("{scene}-{k}.gyr")),
    }
}

/// Whether something has this name; a link that leads nowhere is something as well.
fn exists(path: &Path) -> bool {
    path.symlink_metadata().is_ok()
}

/// Removes the recording that is to be replaced; the new run has a start within the model.
fn make_room(arguments: &RunArguments, path: &Path) -> Result<(), CliError> {
    if arguments.force && path.symlink_metadata().is_ok() {
        remove(path)?;
    }
    Ok(())
}

/// What must be told of the run before it begins.
fn tell_remarks(arguments: &RunArguments, remarks: &Remarks) {
    if !arguments.quiet {
        remarks.notes.iter().for_each(|note| output::say(&format!("gyration: note: {note}")));
    }
    remarks.warnings.iter().for_each(|warning| output::say(&format!("gyration: warning: {warning}")));
}

fn tell(
    arguments: &RunArguments,
    scene: &Scene,
    path: &Path,
    (summary, before): (&RunSummary, &Remarks),
) -> Result<(), CliError> {
    let start = summary.energies_at_start(&Recording::open(path)?)?;
    let picture = shown(&path.join(OVERVIEW));
    if arguments.json {
        let names = summary.ledger.energies.iter().map(|(name, _)| (*name).to_owned());
        let start: Attributes = names.zip(start.iter().map(|value| json!(value))).collect();
        let mut value = json!({ "recording": shown(path), "picture": picture, "energies_at_start": start });
        if let (Some(all), Ok(Value::Object(told))) = (value.as_object_mut(), serde_json::to_value(summary)) {
            all.extend(told);
        }
        output::offer(&format!("{value:#}\n"))?;
    } else if !arguments.quiet {
        output::say(&summary.text(scene, &start));
        output::say(&format!("recording  {}\npicture    {picture}", shown(path)));
    }
    for warning in summary.warnings.iter().filter(|warning| !before.warnings.contains(warning)) {
        output::say(&format!("gyration: warning: {warning}"));
    }
    if let (Some(warning), true) = (summary.ledger.warning(), arguments.quiet || arguments.json) {
        output::say(&format!("gyration: warning: {warning}"));
    }
    let Outcome::Stopped(_) = &summary.outcome else { return Ok(()) };
    // An exit code alone does not tell what happened.
    if arguments.quiet || arguments.json {
        output::say(&format!("gyration: {}", summary.in_words));
    }
    if !summary.outcome.is_final() {
        output::say(&format!("gyration: go on with `{}`", resume_command(arguments, path)));
    }
    Ok(())
}

fn tell_finished(arguments: &RunArguments, path: &Path, attributes: &Attributes) -> Result<(), CliError> {
    let outcome = attributes.get("outcome_in_words").and_then(Value::as_str).unwrap_or("finished");
    if arguments.json {
        let told = ["outcome", "statistics", "ledger", "largest_residual", "energy_in_play", "events", "row_hash"];
        let told = told.iter().filter_map(|name| Some(((*name).to_owned(), attributes.get(*name)?.clone())));
        let mut value: Attributes = told.collect();
        value.insert("recording".into(), json!(shown(path)));
        value.insert("in_words".into(), json!(outcome));
        value.insert("already_finished".into(), json!(true));
        output::offer(&format!("{:#}\n", Value::Object(value)))?;
    } else if !arguments.quiet {
        output::say(&format!("{} had ended before: {}. Nothing was done.", shown(path), outcome.trim_end_matches('.')));
    }
    Ok(())
}

/// The command by which an interrupted run goes on.
fn resume_command(arguments: &RunArguments, path: &Path) -> String {
    let overrides = arguments.scene.overrides.iter().map(|text| format!(" --set {}", quoted(text)));
    let overrides: String = overrides.collect();
    format!("gyration run {} -o {}{overrides} --resume", quoted(&arguments.scene.scene), quoted(&shown(path)))
}
