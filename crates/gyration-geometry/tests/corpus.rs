//! The mesh files that fuzzing has found worth keeping, read again: by the ordinary compiler, without the fuzzer.

#[path = "../../../fuzz/fuzz_targets/common/mesh.rs"]
mod mesh;
#[path = "../../../fuzz/fuzz_targets/common/replay.rs"]
mod replay;

use replay::replay;

#[test]
fn meshes_of_the_corpus_are_sound_or_refused_in_words() {
    for format in ["stl", "obj", "ply"] {
        replay(format, |bytes| mesh::check(&format!("fuzz.{format}"), bytes));
    }
}
