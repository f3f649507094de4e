//! What keeps a recording or a run from being shown.

use gyration_files::in_words;
use gyration_record::RecordError;
use gyration_sim::replay::ReplayError;
use std::io;

/// Failure to show something.
#[derive(Debug, thiserror::Error)]
pub enum ViewError {
    /// The recording cannot be read.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// The states of the recording cannot be had again.
    #[error(transparent)]
    Replay(#[from] ReplayError),
    /// The program was built without the page.
    #[error(
        "this program was built without the page that shows recordings: {reason}\n  \
         fix: install Node 20 or later and build again, \
         or build the page elsewhere (`npm ci && npm run build` in viewer/) and build with GYRATION_PAGE=viewer/dist/index.html"
    )]
    NoPage {
        /// What was wrong when it was built.
        reason: &'static str,
    },
    /// The port is not to be had.
    #[error(
        "cannot listen on port {port} of 127.0.0.1: {}\n  fix: leave out --port, and a free one is taken",
        in_words(source)
    )]
    Port {
        /// The port asked for.
        port: u16,
        /// The system's reason.
        source: io::Error,
    },
    /// There is no token to be had for the address.
    #[error("the operating system gives no random numbers, which the address of the page needs")]
    NoRandomNumbers(#[source] getrandom::Error),
    /// The server broke down.
    #[error("the local server failed: {}", in_words(.0))]
    Server(io::Error),
}
