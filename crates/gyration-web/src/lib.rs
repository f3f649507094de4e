//! The engine in a page: a module without imports, which a worker of the page calls.
//!
//! | export | what |
//! |---|---|
//! | `input(len)` | room for so many bytes of input |
//! | `file(name, content)` | takes a file that scenes may name: so many bytes of its name, so many of its content |
//! | `open(len)` | begins what the input says, `{ "name", "scene", "set" }` in JSON; 0, or 1 if it is refused |
//! | `advance(evaluations)` | runs for about so many evaluations; 0 goes on, 1 has ended, 2 failed |
//! | `output()`, `output_len()` | the messages since the last call, as frames ([`Engine::frames`]) |
//! | `save(format, part)` | a part of the run so far as a file, CSV or GLB; 0 behind the last, 1 made, 2 failed |
//! | `saved()`, `saved_len()` | that part, or the words of the failure |
//! | `message()`, `message_len()` | the words of the panic behind a trap |
//!
//! What is told are the messages of a live run (`gyration-page`). The engine needs no clock: the worker asks for slices
//! as long as it likes. A page has one thread, and so has this.

mod engine;
pub mod exports;

pub use engine::{Engine, Standing};
