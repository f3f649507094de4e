//! The program `gyration`; what it does is in the library beside it.

#![forbid(unsafe_code)]

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(gyration_cli::run(std::env::args_os()))
}
