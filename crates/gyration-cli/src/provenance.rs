//! The program that runs: what recordings say of where they come from.

use gyration_sim::Provenance;

/// Version and commit of this program.
pub fn provenance() -> Provenance {
    Provenance { version: env!("CARGO_PKG_VERSION").to_owned(), commit: Some(env!("GYRATION_COMMIT").to_owned()) }
}
