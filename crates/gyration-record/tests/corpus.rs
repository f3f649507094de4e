//! Damaged recordings that fuzzing has found worth keeping, read and resumed again without the fuzzer.

#[path = "../../../fuzz/fuzz_targets/common/recording.rs"]
mod recording;
#[path = "../../../fuzz/fuzz_targets/common/replay.rs"]
mod replay;

#[test]
fn damaged_recordings_of_the_corpus_are_read_or_refused_in_words() {
    let folder = tempfile::tempdir().unwrap();
    let sound = recording::Sound::new(folder.path());
    replay::replay("recording", |bytes| sound.check(bytes));
}
