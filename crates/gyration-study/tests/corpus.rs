//! Studies and measurements that fuzzing has found worth keeping, read again without the fuzzer.

#[path = "../../../fuzz/fuzz_targets/common/calibration.rs"]
mod calibration;
#[path = "../../../fuzz/fuzz_targets/common/measurements.rs"]
mod measurements;
#[path = "../../../fuzz/fuzz_targets/common/replay.rs"]
mod replay;
#[path = "../../../fuzz/fuzz_targets/common/study.rs"]
mod study;

use replay::{replay, replay_texts};

#[test]
fn studies_of_the_corpus_have_their_scenes_or_are_refused_in_words() {
    replay_texts("study", study::check);
}

#[test]
fn measurements_of_the_corpus_are_whole_or_refused_in_words() {
    replay_texts("calibration", calibration::check);
    let folder = tempfile::tempdir().unwrap();
    replay("table", |bytes| measurements::check(folder.path(), bytes));
}
