//! Starting cargo and what it builds, with the same random cases everywhere.

use crate::root;
use std::process::Command;

/// Where the random cases of the property tests start, unless the environment says otherwise: the same commit then
/// gives the same verdict wherever it is tested. `PROPTEST_RNG_SEED=7 cargo xtask test` looks elsewhere.
const SEED: &str = "20261121";
const SEED_VARIABLE: &str = "PROPTEST_RNG_SEED";

/// The cargo that started this program, in the root of the repository.
pub fn cargo() -> Command {
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.current_dir(root());
    seed(&mut command);
    command
}

/// Tells the property tests where to start.
pub fn seed(command: &mut Command) {
    if std::env::var_os(SEED_VARIABLE).is_none() {
        command.env(SEED_VARIABLE, SEED);
    }
}
