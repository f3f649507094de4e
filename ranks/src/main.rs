//! Runs a scene on several processes: `mpiexec -n 4 gyration-ranks SCENE -o RECORDING`.
//!
//! Each process opens the scene and has all bodies; each steps a share of them, and all tell one another what these
//! have become. The first one records, to the bytes of `gyration run`.

mod arguments;
mod world;

use arguments::Arguments;
use gyration_sim::{Job, Outcome, Provenance, Reason, RecordingEnd, Unwatched};
use gyration_threads::Interruption;
use mpi::Threading;
use mpi::traits::Communicator as _;
use std::num::NonZeroUsize;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use world::World;

/// Those of `gyration run`, which tells more of them apart.
const ENDED_EARLY: u8 = 1;
const BAD_INPUT: u8 = 2;
const INTERRUPTED: u8 = 130;

fn main() -> ExitCode {
    let Some((universe, _)) = mpi::initialize_with_threading(Threading::Funneled) else {
        eprintln!("gyration-ranks: MPI has been begun before");
        return ExitCode::from(BAD_INPUT);
    };
    let world = Arc::new(World::of(&universe.world()));
    let prepared = Arguments::read(std::env::args().skip(1)).and_then(|arguments| {
        let scene = gyration_sim::open(&arguments.scene, &arguments.overrides);
        Ok((scene.map_err(|error| error.to_string())?, arguments))
    });
    // One that cannot begin ends all of them, of which the first of these says why.
    let failed = world.first_that(prepared.is_err());
    let (scene, arguments) = match (prepared, failed) {
        (Ok(prepared), None) => prepared,
        (Err(why), Some(first)) if first == world.rank => {
            eprintln!("gyration-ranks: {why}");
            return ExitCode::from(BAD_INPUT);
        }
        _ => return ExitCode::from(BAD_INPUT),
    };
    let provenance = Provenance {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        commit: option_env!("GYRATION_COMMIT").map(str::to_owned),
    };
    let mut job = Job::of(&scene, &provenance).on_ranks(world.clone());
    job.plan.threads = arguments.threads.or(NonZeroUsize::new(1));
    let flag = Arc::new(AtomicBool::new(false));
    let raised = flag.clone();
    if let Err(error) = ctrlc::set_handler(move || raised.store(true, Ordering::Relaxed)) {
        eprintln!("gyration-ranks: signals cannot be heard, which ends the run at once: {error}");
    }
    let ended = Interruption::in_force().raised_by(flag).within(|| match arguments.resumes {
        true => job.resume(&arguments.recording, &mut Unwatched),
        false => job.record(&arguments.recording, &mut Unwatched),
    });
    let told = match ended {
        Ok(RecordingEnd::Ran(summary)) => {
            if world.rank == 0 {
                println!("{}", summary.in_words);
                println!("{}", world.traffic());
            }
            match &summary.outcome {
                Outcome::Completed | Outcome::AtRest { .. } => 0,
                Outcome::Stopped(stop) if stop.reason == Reason::Interrupted => INTERRUPTED,
                Outcome::Stopped(_) => ENDED_EARLY,
            }
        }
        Ok(RecordingEnd::AlreadyFinished(_)) => {
            if world.rank == 0 {
                println!("the run had ended before: there is nothing to resume");
            }
            0
        }
        Err(error) => {
            eprintln!("gyration-ranks: rank {}: {error}", world.rank);
            // The others may wait for this one for ever.
            universe.world().abort(i32::from(BAD_INPUT))
        }
    };
    ExitCode::from(told)
}
