//! The scenes that fuzzing has found worth keeping, read again: by the ordinary compiler, without the fuzzer.

#[path = "../../../fuzz/fuzz_targets/common/replay.rs"]
mod replay;
#[path = "../../../fuzz/fuzz_targets/common/scene.rs"]
mod scene;

use replay::replay;

#[test]
fn scenes_of_the_corpus_are_read_or_refused_with_a_place() {
    replay("scene", |bytes| {
        // The fuzzer's own rule: what is no text is no input.
        if let Ok(text) = std::str::from_utf8(bytes) {
            scene::check(text);
        }
    });
}
