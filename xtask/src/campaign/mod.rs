//! A campaign: random scenes, each checked, run, killed and resumed, and audited.
//!
//! Of every scene is asked that `check` and `run` agree, that the ledger has the verdict that its rows give and a run
//! with an open one says so, that gaps stay positive, times grow and volumes are kept, that the bytes of a run that was
//! killed or interrupted at random moments and resumed on one to seven threads are those of a run on one thread, that
//! each of the first steps resumes to the same bytes, that planes found anew push as those remembered, that bodies
//! alone keep their momenta, that names and the order of bodies change nothing, that exit codes are those documented,
//! and that nothing panics or runs beyond its wall time. A scene depends on the seed and its number alone. Those that
//! fail stay in a folder each, with the cause.

mod bodies;
mod contacts;
mod draft;
mod first_steps;
mod materials;
mod meetings;
mod options;
mod process;
mod report;
mod scene;
mod shapes;
mod stream;
mod table;
mod tally;
mod toml;
mod trial;

use crate::cargo::cargo;
use crate::steps::Steps;
use crate::{PROGRAM, parallel};
use options::Options;
use process::Place;
use scene::RandomScene;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Mutex;
use std::time::Duration;
use stream::Stream;
use tally::CampaignTally;
use trial::{Trial, Verdict};

/// The scenes that every test command tries.
const IN_TESTS: u64 = 20;

/// Runs a campaign as the words say; fails if a scene does.
pub fn run(words: &[&str]) -> ExitCode {
    match Options::parse(words).and_then(|options| conducted(&options)) {
        Ok(tally) => {
            println!("{}", tally.text());
            if tally.failures.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
        }
        Err(reason) => {
            eprintln!("xtask: {reason}");
            ExitCode::FAILURE
        }
    }
}

/// A small campaign with the program that the tests built.
pub fn check(steps: &mut Steps, program: &Path) {
    let options = Options { scenes: IN_TESTS, wall_time: 1.0, ..Options::default() };
    let tally = Campaign { program, options: &options }.conduct();
    println!("\n==> campaign: {}", tally.text());
    steps.tally.passed += tally.passed();
    for (case, cause) in tally.failures {
        steps.complain(format!("scene {case} of the campaign (`cargo xtask campaign --only {case}`): {cause}"));
    }
}

/// A campaign with the program named, or with one built for speed.
fn conducted(options: &Options) -> Result<CampaignTally, String> {
    let program = match &options.program {
        Some(program) => program.clone(),
        None => built()?,
    };
    let program = program.canonicalize().map_err(|error| format!("{}: {error}", program.display()))?;
    Ok(Campaign { program: &program, options }.conduct())
}

fn built() -> Result<PathBuf, String> {
    let status = cargo().args(["build", "--release", "--package", "gyration-cli"]).status();
    match status {
        Ok(status) if status.success() => Ok(crate::target_directory().join("release").join(PROGRAM)),
        Ok(status) => Err(format!("the program was not built: {status}")),
        Err(error) => Err(format!("cargo: {error}")),
    }
}

/// Scenes on trial, as many at once as there are cores.
struct Campaign<'a> {
    program: &'a Path,
    options: &'a Options,
}

impl Campaign<'_> {
    fn conduct(&self) -> CampaignTally {
        let tally = Mutex::new(CampaignTally::default());
        parallel::each(self.options.cases(), |case| {
            let verdict = self.tried(case);
            if let Err(cause) = &verdict {
                println!("scene {case}: {cause}");
            }
            if let Ok(mut tally) = tally.lock() {
                tally.take(case, verdict);
            }
        });
        tally.into_inner().unwrap_or_else(|poisoned| poisoned.into_inner())
    }

    /// Puts one scene on trial; its folder stays if it fails, or if it is the only one.
    fn tried(&self, case: u64) -> Result<Verdict, String> {
        let Options { seed, wall_time, only, .. } = *self.options;
        let folder = crate::target_directory().join("campaign").join(format!("{seed}-{case}"));
        // What an earlier campaign left there is not resumed.
        let _ = fs::remove_dir_all(&folder);
        // Time to start, to reach the limit and to say so.
        let limit = Duration::from_secs_f64(2.0 * wall_time + 10.0);
        let place = Place { program: self.program, folder: folder.clone(), limit };
        let stream = Stream::of(!seed, case);
        let verdict = Trial { place, wall_time, stream }.judge(&RandomScene::of(seed, case));
        match &verdict {
            Err(cause) => drop(fs::write(folder.join("cause.txt"), format!("{cause}\n"))),
            Ok(_) if only.is_none() => drop(fs::remove_dir_all(&folder)),
            Ok(_) => {}
        }
        verdict
    }
}
