//! Bodies that meet and checkpoints that fuzzing has found worth keeping, run again without the fuzzer.
//!
//! `GYRATION_DUMP=FOLDER` writes checkpoints of the fuzzed scene there: seeds for `fuzz/corpus/checkpoint`.

#[path = "../../../fuzz/fuzz_targets/common/checkpoint.rs"]
mod checkpoint;
#[path = "../../../fuzz/fuzz_targets/common/pairs.rs"]
mod pairs;
#[path = "../../../fuzz/fuzz_targets/common/replay.rs"]
mod replay;

use checkpoint::Meeting;
use replay::replay;
use std::cell::Cell;

#[test]
fn meetings_of_the_corpus_are_refused_with_a_place_or_run_soundly() {
    replay("pairs", pairs::check);
}

#[test]
fn checkpoints_of_the_corpus_are_refused_in_words_or_gone_on_from() {
    let (meeting, taken) = (Meeting::new(), Cell::new(0));
    replay("checkpoint", |bytes| taken.set(taken.get() + usize::from(meeting.check(bytes))));
    assert!(taken.get() >= 5, "only {} are checkpoints of this version: renew the seeds", taken.get());
}

#[test]
fn checkpoints_of_the_fuzzed_scene_are_gone_on_from() {
    let meeting = Meeting::new();
    let checkpoints = meeting.checkpoints(60);
    assert!(checkpoints.len() > 20, "the run ends after {} windows", checkpoints.len());
    for (window, bytes) in checkpoints.iter().enumerate() {
        assert!(meeting.check(bytes), "window {window}");
        if let Ok(folder) = std::env::var("GYRATION_DUMP") {
            std::fs::write(format!("{folder}/{window:03}"), bytes).unwrap();
        }
    }
}
