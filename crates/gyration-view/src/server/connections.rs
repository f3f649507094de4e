//! The connections: how many there may be, and how long one is waited for.
//!
//! A request that does not come whole, a websocket whose handshake does not, and a peer that does not read are left
//! after a while. So no number of them keeps others from being answered for long, and what is kept for them has a
//! bound.

use axum::Router;
use hyper::server::conn::http1;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use std::io::{self, IoSlice};
use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll};
use std::time::Duration;
use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tokio::time::Sleep;

/// After the system gave no connection, because it has no more of them to give.
const PAUSE: Duration = Duration::from_secs(1);

/// What a server puts up with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Connections at once; further ones wait until one ends.
    pub connections: usize,
    /// Time for the head of a request to come, from the connection or from the answer before.
    pub request: Duration,
    /// Time without a byte taken by a peer to which there is something to send.
    pub unread: Duration,
}

impl Default for Limits {
    /// Enough for dozens of pages; none of them needs a second for its request.
    fn default() -> Self {
        Self { connections: 64, request: Duration::from_secs(10), unread: Duration::from_secs(60) }
    }
}

/// Answers whoever comes, for ever.
pub(super) async fn serve(listener: TcpListener, router: Router, limits: Limits) {
    let places = Arc::new(Semaphore::new(limits.connections));
    // The places are never closed: this is for ever.
    while let Ok(place) = Arc::clone(&places).acquire_owned().await {
        match listener.accept().await {
            Ok((stream, _)) => {
                let connection = Connection { stream, unread: limits.unread, stalled: None, _place: place };
                tokio::spawn(answer(connection, router.clone(), limits.request));
            }
            Err(_) => tokio::time::sleep(PAUSE).await,
        }
    }
}

/// Answers the requests of a connection. Bodies are not read: one that comes ends the connection after the answer.
async fn answer(connection: Connection, router: Router, request: Duration) {
    let mut http = http1::Builder::new();
    http.timer(TokioTimer::new()).header_read_timeout(request);
    let served = http.serve_connection(TokioIo::new(connection), TowerToHyperService::new(router)).with_upgrades();
    // A peer that goes away, or that is left: there is nobody to tell.
    let _ = served.await;
}

/// A connection with its place among those allowed, which a websocket keeps too. It fails if nothing is taken for long.
struct Connection {
    stream: TcpStream,
    unread: Duration,
    /// Runs out while there is something to send that is not taken.
    stalled: Option<Pin<Box<Sleep>>>,
    _place: OwnedSemaphorePermit,
}

impl Connection {
    /// What became of a write, or a failure if none has got on for long.
    fn in_time<T>(&mut self, context: &mut Context<'_>, write: Poll<io::Result<T>>) -> Poll<io::Result<T>> {
        if write.is_ready() {
            self.stalled = None;
            return write;
        }
        let unread = self.unread;
        let stalled = self.stalled.get_or_insert_with(|| Box::pin(tokio::time::sleep(unread)));
        stalled.as_mut().poll(context).map(|()| Err(io::ErrorKind::TimedOut.into()))
    }
}

impl AsyncRead for Connection {
    fn poll_read(mut self: Pin<&mut Self>, context: &mut Context<'_>, to: &mut ReadBuf<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_read(context, to)
    }
}

impl AsyncWrite for Connection {
    fn poll_write(mut self: Pin<&mut Self>, context: &mut Context<'_>, bytes: &[u8]) -> Poll<io::Result<usize>> {
        let write = Pin::new(&mut self.stream).poll_write(context, bytes);
        self.in_time(context, write)
    }

    fn poll_write_vectored(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        parts: &[IoSlice<'_>],
    ) -> Poll<io::Result<usize>> {
        let write = Pin::new(&mut self.stream).poll_write_vectored(context, parts);
        self.in_time(context, write)
    }

    fn is_write_vectored(&self) -> bool {
        self.stream.is_write_vectored()
    }

    fn poll_flush(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_flush(context)
    }

    fn poll_shutdown(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_shutdown(context)
    }
}
