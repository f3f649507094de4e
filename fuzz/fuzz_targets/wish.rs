//! Messages that a live page sends over its websocket.
#![no_main]
#![forbid(unsafe_code)]

use libfuzzer_sys::fuzz_target;

#[path = "common/wish.rs"]
mod wish;

fuzz_target!(|input: &str| wish::check(input));
