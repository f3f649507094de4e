//! Checkpoints of a run of bodies that meet, and the run that goes on from them.
#![no_main]
#![forbid(unsafe_code)]

use libfuzzer_sys::fuzz_target;
use std::sync::LazyLock;

#[path = "common/checkpoint.rs"]
mod checkpoint;

static MEETING: LazyLock<checkpoint::Meeting> = LazyLock::new(checkpoint::Meeting::new);

fuzz_target!(|bytes: &[u8]| {
    MEETING.check(bytes);
});
