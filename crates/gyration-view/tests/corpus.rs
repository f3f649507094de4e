//! Messages of live pages that fuzzing has found worth keeping, read again without the fuzzer.

#[path = "../../../fuzz/fuzz_targets/common/replay.rs"]
mod replay;
#[path = "../../../fuzz/fuzz_targets/common/wish.rs"]
mod wish;

#[test]
fn messages_of_the_corpus_are_wishes_or_refused_in_words() {
    replay::replay_texts("wish", wish::check);
}
