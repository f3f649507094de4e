//! Bodies that meet and damaged checkpoints that fuzzing has found worth keeping, read again without the fuzzer.

#[path = "../../../fuzz/fuzz_targets/common/checkpoint.rs"]
mod checkpoint;
#[path = "../../../fuzz/fuzz_targets/common/meeting.rs"]
mod meeting;
#[path = "../../../fuzz/fuzz_targets/common/replay.rs"]
mod replay;

use replay::{mutate, replay, replay_texts};

#[test]
fn meetings_of_the_corpus_begin_or_are_refused_in_words() {
    replay_texts("meeting", meeting::check);
}

#[test]
fn checkpoints_of_the_corpus_go_on_or_are_refused_in_words() {
    let sound = checkpoint::Sound::new();
    replay("checkpoint", |bytes| sound.check(bytes));
}

#[test]
#[ignore = "minutes: GYRATION_MUTATIONS=100000 with --ignored"]
fn mutations_of_meetings_begin_or_are_refused_in_words() {
    mutate("meeting", |bytes| {
        if let Ok(text) = std::str::from_utf8(bytes) {
            meeting::check(text);
        }
    });
}

#[test]
#[ignore = "minutes: GYRATION_MUTATIONS=100000 with --ignored"]
fn mutations_of_checkpoints_go_on_or_are_refused_in_words() {
    let sound = checkpoint::Sound::new();
    mutate("checkpoint", |bytes| sound.check(bytes));
}
