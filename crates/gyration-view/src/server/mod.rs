//! The local server: the page, and what it asks for.
//!
//! ```text
//! GET /TOKEN/                          the page
//! GET /TOKEN/api/header                header of a recording; of a live run only that it is one
//! GET /TOKEN/api/blob/NAME?from=&to=   numbers of a recording
//! GET /TOKEN/api/live                  websocket of a live run
//! GET /TOKEN/api/bands, /api/wave      waves of a lattice
//! GET /TOKEN/api/fields                fields of a recording
//! ```
//!
//! It listens on 127.0.0.1 and answers only requests that call it by that name, have the token of its address and come
//! from its own page: neither a page from elsewhere in the same browser nor another user of the machine can read or
//! steer it. How many connections there are, and how long one is waited for, has [`Limits`].

mod address;
mod connections;
mod fields;
mod guard;
mod shown;
mod socket;
mod waves;

use crate::error::ViewError;
use crate::live::Live;
use crate::page;
use crate::stored::Stored;
use address::Address;
use axum::Router;
use axum::extract::{Path, Query, State};
use axum::http::{StatusCode, header};
use axum::response::{Html, IntoResponse, Redirect, Response};
use axum::routing::get;
pub use connections::Limits;
use serde::Deserialize;
use serde_json::json;
use shown::{BadRequest, Shown, ShownRecording, apart};
use std::future::Future;
use std::net::{Ipv4Addr, TcpListener};
use std::sync::Arc;

/// What is shown.
pub enum PageSource {
    /// A recording on disk.
    Recording(Box<Stored>),
    /// A scene that runs as it is watched.
    Live(Live),
}

/// A server that has its port, but does not answer yet.
pub struct Server {
    listener: TcpListener,
    address: Address,
    limits: Limits,
}

impl Server {
    /// Takes a port of 127.0.0.1, or a free one, and a fresh token.
    ///
    /// # Errors
    /// `Port` if the port is not to be had, `NoRandomNumbers` if the token is not.
    pub fn bind(port: Option<u16>) -> Result<Self, ViewError> {
        let asked = port.unwrap_or(0);
        let failed = |source| ViewError::Port { port: asked, source };
        let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, asked)).map_err(failed)?;
        listener.set_nonblocking(true).map_err(failed)?;
        let port = listener.local_addr().map_err(failed)?.port();
        Ok(Self { listener, address: Address::fresh(port)?, limits: Limits::default() })
    }

    /// The same with other limits.
    #[must_use]
    pub fn with_limits(self, limits: Limits) -> Self {
        Self { limits, ..self }
    }

    /// The address of the page, with its token: who has it may ask.
    pub fn url(&self) -> String {
        self.address.url()
    }

    /// Answers until `end` is done.
    ///
    /// # Errors
    /// `Server` if the system takes away what the server needs.
    pub fn serve(self, source: PageSource, end: impl Future<Output = ()>) -> Result<(), ViewError> {
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().map_err(ViewError::Server)?;
        let shown = match source {
            PageSource::Recording(stored) => Shown::Recording(ShownRecording::of(*stored)),
            PageSource::Live(live) => Shown::Live(live),
        };
        let router = router(Arc::new(shown), self.address);
        let served = runtime.block_on(async move {
            let listener = tokio::net::TcpListener::from_std(self.listener)?;
            tokio::select! {
                () = connections::serve(listener, router, self.limits) => {}
                () = end => {}
            }
            Ok(())
        });
        // Pages that are still connected are not waited for.
        runtime.shutdown_background();
        served.map_err(ViewError::Server)
    }
}

fn router(shown: Arc<Shown>, address: Address) -> Router {
    let root = address.root();
    let page = format!("{root}/");
    let pages = Router::new()
        .route("/", get(index))
        .route("/api/header", get(header_of))
        .route("/api/blob/{*name}", get(blob_of))
        .route("/api/live", get(socket::live))
        .with_state(Arc::clone(&shown))
        .merge(waves::routes(Arc::clone(&shown)))
        .merge(fields::routes(shown));
    // What the page asks for stands relative to its address, which must therefore end with a slash.
    let moved = Redirect::temporary(&page);
    Router::new()
        .nest(&page, pages)
        .route(&root, get(|| async { moved }))
        .layer(axum::middleware::from_fn_with_state(address, guard::guard))
}

async fn index() -> Response {
    match page::html() {
        Ok(html) => Html(html).into_response(),
        Err(error) => BadRequest::from(error).into_response(),
    }
}

async fn header_of(State(shown): State<Arc<Shown>>) -> Result<Response, BadRequest> {
    let json = match &*shown {
        Shown::Live(_) => json!({ "protocol": gyration_page::header::PROTOCOL, "mode": "live" }),
        Shown::Recording(known) => known.opened_anew()?.header().to_json(),
    };
    Ok(([(header::CONTENT_TYPE, "application/json")], json.to_string()).into_response())
}

/// Rows of a blob; all without.
#[derive(Debug, Deserialize)]
struct RowsQuery {
    from: Option<usize>,
    to: Option<usize>,
}

async fn blob_of(
    State(shown): State<Arc<Shown>>,
    Path(name): Path<String>,
    Query(rows): Query<RowsQuery>,
) -> Result<Response, BadRequest> {
    let Some(stored) = shown.stored() else {
        return Err(BadRequest(StatusCode::NOT_FOUND, "a live run is sent by websocket, at /api/live".to_owned()));
    };
    let rows = rows.from.unwrap_or(0)..rows.to.unwrap_or(stored.rows());
    let bytes = apart(move || Ok(stored.blob(&name, rows, 1)?)).await?;
    Ok(([(header::CONTENT_TYPE, "application/octet-stream")], bytes).into_response())
}
