//! The reader of recordings, and what resumes them: bytes of its files and their structure.
#![no_main]
#![forbid(unsafe_code)]

use libfuzzer_sys::fuzz_target;
use std::sync::LazyLock;

#[path = "../../crates/gyration-record/tests/common/mod.rs"]
mod common;
#[path = "common/recording.rs"]
mod recording;
#[path = "common/scratch.rs"]
mod scratch;

static SOUND: LazyLock<recording::Sound> = LazyLock::new(|| recording::Sound::new(&scratch::folder()));

fuzz_target!(|bytes: &[u8]| SOUND.check(bytes));
