//! Checkpoints from which a run goes on.
#![no_main]
#![forbid(unsafe_code)]

use libfuzzer_sys::fuzz_target;
use std::sync::LazyLock;

#[path = "common/checkpoint.rs"]
mod checkpoint;

static SOUND: LazyLock<checkpoint::Sound> = LazyLock::new(checkpoint::Sound::new);

fuzz_target!(|bytes: &[u8]| SOUND.check(bytes));
