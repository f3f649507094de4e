//! `gyration study`: thousands of runs of a scene into one table; shards, and their joining.

mod bar;
mod plot;
mod summary;

pub use plot::draw_table;

use crate::arguments::{StudyAction, StudyArguments};
use crate::error::{CliError, code};
use crate::input::{quoted, shown};
use crate::output;
use bar::StudyBar;
use gyration_plot::study::PlotRequest;
use gyration_study::{Digest, Shard, Study, Table, execute as make, merge, studies};
use gyration_threads::Threads;
use serde_json::{Value, json};
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Does what was asked; the exit code tells whether the table is complete.
pub fn execute(arguments: &StudyArguments) -> Result<u8, CliError> {
    let Some(name) = &arguments.study else { return list(arguments.json) };
    // A table is drawn wherever it comes from: its study need not be there.
    if let Some(StudyAction::Plot(wanted)) = &arguments.action {
        return plot::execute(name, wanted, arguments);
    }
    let study = Study::open(name, &arguments.overrides)?;
    let path = arguments.output.clone().unwrap_or_else(|| PathBuf::from(format!("{}.study", study.name())));
    match &arguments.action {
        None | Some(StudyAction::Plot(_)) => run(arguments, &study, &path),
        Some(StudyAction::Merge) => join(arguments, &study, &path),
    }
}

/// The ready studies, with what they ask.
fn list(in_json: bool) -> Result<u8, CliError> {
    let titled = studies().iter().map(|(name, text)| {
        let study = Study::parse(&format!("{name}.toml"), text, Path::new(""), &[]);
        (name, study.ok().and_then(|study| study.title().map(str::to_owned)).unwrap_or_default())
    });
    if in_json {
        let list: Value = titled.map(|(name, title)| json!({ "name": name, "title": title })).collect();
        output::print(&format!("{list:#}\n"))?;
        return Ok(code::DONE);
    }
    let list: String = titled.map(|(name, title)| format!("{name:<18} {title}\n")).collect();
    output::print(&(list + "\n`gyration study NAME` makes one; `gyration study NAME plot` draws its table.\n"))?;
    Ok(code::DONE)
}

/// Makes the runs that are missing.
fn run(arguments: &StudyArguments, study: &Study, path: &Path) -> Result<u8, CliError> {
    let shard = shard(arguments.shard.as_deref())?;
    PlotRequest::of_study(study)?;
    let threads = Threads::asked(arguments.threads.map(NonZeroUsize::get))?;
    let mut table = match arguments.resume {
        true => Table::resume(path, study, shard)?,
        false => Table::create(path, study, shard, arguments.force)?,
    };
    if table.is_complete() {
        if !arguments.quiet {
            output::say(&format!("{} is complete. Nothing was done.", shown(table.folder())));
        }
        let digest = Digest::read(&table.file())?;
        if arguments.json {
            print_json(study, &digest, &table.file())?;
        }
        return Ok(summary::verdict(&digest));
    }
    let mut watch = StudyBar::new(!arguments.quiet && !arguments.json)?;
    let (began, before) = (Instant::now(), table.rows());
    let made = make(study, &mut table, threads, &mut watch);
    watch.finish();
    let is_complete = made?;
    let made = table.rows() - before;
    if is_complete {
        let digest = Digest::read(&table.file())?;
        if arguments.json {
            print_json(study, &digest, &table.file())?;
        } else if !arguments.quiet {
            let effort =
                summary::StudyCost { runs: made, seconds: began.elapsed().as_secs_f64(), threads: threads.get() };
            output::say(&summary::in_words(study, &digest, &effort));
            output::say(&format!("table      {}", shown(&table.file())));
        }
        return Ok(summary::verdict(&digest));
    }
    output::say(&format!("gyration: the study was interrupted after {} of {} runs", table.rows(), table.runs()));
    output::say(&format!("gyration: go on with `{}`", resume_command(arguments, path)));
    Ok(code::INTERRUPTED)
}

/// `K/N`
fn shard(text: Option<&str>) -> Result<Shard, CliError> {
    let Some(text) = text else { return Ok(Shard::WHOLE) };
    let numbers = text.split_once('/').and_then(|(k, n)| Some((k.trim().parse().ok()?, n.trim().parse().ok()?)));
    match numbers {
        Some((number, count)) => Ok(Shard::new(number, count)?),
        None => {
            Err(CliError::arguments(format!("\"{text}\" is no shard"), "write --shard K/N with K from 1 to N, 3/8"))
        }
    }
}

fn join(arguments: &StudyArguments, study: &Study, path: &Path) -> Result<u8, CliError> {
    let began = Instant::now();
    let file = merge(path, study, arguments.force)?;
    let digest = Digest::read(&file)?;
    if arguments.json {
        print_json(study, &digest, &file)?;
    } else if !arguments.quiet {
        let effort = summary::StudyCost { runs: 0, seconds: began.elapsed().as_secs_f64(), threads: 1 };
        output::say(&summary::in_words(study, &digest, &effort));
        output::say(&format!("table      {}", shown(&file)));
    }
    Ok(summary::verdict(&digest))
}

fn print_json(study: &Study, digest: &Digest, table: &Path) -> Result<(), CliError> {
    let mut value = summary::in_json(study, digest);
    value["table"] = json!(shown(table));
    output::print(&format!("{value:#}\n"))
}

/// The command by which an interrupted study goes on.
fn resume_command(arguments: &StudyArguments, path: &Path) -> String {
    let study = arguments.study.as_deref().unwrap_or_default();
    let mut command = format!("gyration study {} -o {}", quoted(study), quoted(&shown(path)));
    for text in &arguments.overrides {
        command += &format!(" --set {}", quoted(text));
    }
    if let Some(shard) = &arguments.shard {
        command += &format!(" --shard {shard}");
    }
    command + " --resume"
}
