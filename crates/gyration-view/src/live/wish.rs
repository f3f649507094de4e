//! What a watcher may want of a live run.

use serde::Deserialize;

/// What a watcher may want.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(tag = "type", rename_all = "snake_case", deny_unknown_fields)]
pub enum Wish {
    /// Wait.
    Pause,
    /// Go on.
    Resume,
    /// Begin again.
    Restart {
        /// Overrides of the scene, as of `--set`.
        set: Vec<String>,
    },
}

impl Wish {
    /// Reads a message of a page.
    ///
    /// # Errors
    /// In words: why it is none.
    pub fn parse(text: &str) -> Result<Self, String> {
        serde_json::from_str(text).map_err(|_| "not understood: this is no wish of the page".to_owned())
    }
}
