//! Scenes, tables and overrides that fuzzing has found worth keeping, read again: by the ordinary compiler, without the
//! fuzzer.

#[path = "../../../fuzz/fuzz_targets/common/replay.rs"]
mod replay;
#[path = "../../../fuzz/fuzz_targets/common/scene.rs"]
mod scene;
#[path = "../../../fuzz/fuzz_targets/common/set.rs"]
mod set;
#[path = "../../../fuzz/fuzz_targets/common/table.rs"]
mod table;

use replay::{replay, replay_texts};

#[test]
fn scenes_of_the_corpus_are_read_or_refused_with_a_place() {
    replay_texts("scene", scene::check);
}

#[test]
fn overrides_of_the_corpus_give_one_scene_or_the_same_errors_both_ways() {
    replay_texts("set", set::check);
}

#[test]
fn tables_of_the_corpus_are_read_or_refused_with_a_place() {
    let folder = tempfile::tempdir().unwrap();
    replay("table", |bytes| table::check(folder.path(), bytes));
}
