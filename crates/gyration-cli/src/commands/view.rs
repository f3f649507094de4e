//! `gyration view`: a recording, or a scene that runs as it is watched, on a page of a local server.

use crate::arguments::ViewArguments;
use crate::error::{CliError, code};
use crate::output;
use crate::provenance::provenance;
use gyration_files::in_words;
use gyration_scene::Scene;
use gyration_view::{Live, PageSource, Server, Stored, page};
use std::path::Path;

/// Serves the page until Ctrl-C.
pub fn execute(arguments: &ViewArguments) -> Result<u8, CliError> {
    let what = source(arguments)?;
    page::html()?;
    let server = Server::bind(arguments.port)?;
    let url = server.url();
    let (end, ended) = tokio::sync::oneshot::channel();
    let mut end = Some(end);
    ctrlc::set_handler(move || {
        // The second time there is nobody left to tell.
        end.take().map(|end| end.send(()));
    })?;
    output::offer(&format!("{url}\n"))?;
    output::say(&format!("{} is at {url} until Ctrl-C", arguments.source));
    if !arguments.no_open
        && let Err(error) = open::that_detached(&url)
    {
        output::say(&format!("gyration: no browser could be started ({}): open the address in one", in_words(&error)));
    }
    server.serve(what, async {
        let _ = ended.await;
    })?;
    Ok(code::DONE)
}

/// What is to be shown; a scene with errors is refused before anything is served.
fn source(arguments: &ViewArguments) -> Result<PageSource, CliError> {
    let path = Path::new(&arguments.source);
    if !path.is_dir() {
        Scene::open(&arguments.source, &arguments.overrides)?;
        let live = Live::start(&arguments.source, &arguments.overrides, provenance());
        return Ok(PageSource::Live(live.map_err(gyration_view::ViewError::Server)?));
    }
    if !arguments.overrides.is_empty() {
        return Err(CliError::arguments("--set changes a scene, not a recording", "leave out --set"));
    }
    Ok(PageSource::Recording(Box::new(Stored::open(path)?)))
}
