//! The connections: how many there may be, and how long one is waited for.
//!
//! A connection begins as a stranger's. With the first request that has the token it takes a place among the known
//! ones, or waits for one. Strangers have room of their own, in which the oldest gives way to the newest: those who
//! have no token, however many and however slow, do not keep out those who have. A request that does not come whole, a
//! websocket whose handshake does not, and a peer that does not read are left after a while. What is kept for all of
//! them has a bound.

use axum::{Extension, Router};
use hyper::server::conn::http1;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use std::collections::VecDeque;
use std::io::{self, IoSlice};
use std::pin::Pin;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};
use std::task::{Context, Poll};
use std::time::Duration;
use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::{Notify, OwnedSemaphorePermit, Semaphore};
use tokio::time::Sleep;

/// After the system gave no connection, because it has no more of them to give.
const PAUSE: Duration = Duration::from_secs(1);

/// What a server puts up with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Connections at once that have shown the token; further ones wait until one ends.
    pub connections: usize,
    /// Connections at once that have not, or wait; further ones take the place of the oldest.
    pub strangers: usize,
    /// Time for the head of a request to come, from the connection or from the answer before.
    pub request: Duration,
    /// Time without a byte taken by a peer to which there is something to send.
    pub unread: Duration,
}

impl Default for Limits {
    /// Enough for dozens of pages; none of them needs a second for its request.
    fn default() -> Self {
        let (request, unread) = (Duration::from_secs(10), Duration::from_secs(60));
        Self { connections: 64, strangers: 64, request, unread }
    }
}

/// Answers whoever comes, for ever.
pub(super) async fn serve(listener: TcpListener, router: Router, limits: Limits) {
    let places = Arc::new(Semaphore::new(limits.connections));
    let mut strangers = Strangers { most: limits.strangers.max(1), all: VecDeque::new() };
    loop {
        match listener.accept().await {
            Ok((stream, _)) => {
                let visitor = Arc::new(Visitor::new(&places));
                strangers.let_in(&visitor);
                let connection =
                    Connection { stream, unread: limits.unread, stalled: None, _visitor: Arc::clone(&visitor) };
                tokio::spawn(answer(connection, router.clone(), visitor, limits.request));
            }
            Err(_) => tokio::time::sleep(PAUSE).await,
        }
    }
}

/// Answers the requests of a connection, unless it has to give way. Bodies are not read: one that comes ends the
/// connection after the answer.
async fn answer(connection: Connection, router: Router, visitor: Arc<Visitor>, request: Duration) {
    let mut http = http1::Builder::new();
    http.timer(TokioTimer::new()).header_read_timeout(request);
    let router = TowerToHyperService::new(router.layer(Extension(Arc::clone(&visitor))));
    let served = http.serve_connection(TokioIo::new(connection), router).with_upgrades();
    tokio::select! {
        // A peer that goes away, or that is left: there is nobody to tell.
        _ = served => {}
        () = visitor.sent_away.notified() => {}
    }
}

/// Who is at the other end of a connection.
pub(super) struct Visitor {
    places: Arc<Semaphore>,
    /// The place of one who has shown the token.
    place: Mutex<Option<OwnedSemaphorePermit>>,
    /// Whether it has to give way.
    sent_away: Notify,
}

impl Visitor {
    fn new(places: &Arc<Semaphore>) -> Self {
        Self { places: Arc::clone(places), place: Mutex::new(None), sent_away: Notify::new() }
    }

    /// Takes a place, which it keeps until the connection ends, as soon as there is one: it has shown the token.
    pub(super) async fn show_token(&self) {
        if self.is_known() {
            return;
        }
        // The places are never closed.
        let place = Arc::clone(&self.places).acquire_owned().await.ok();
        *self.lock() = place;
    }

    fn is_known(&self) -> bool {
        self.lock().is_some()
    }

    fn lock(&self) -> MutexGuard<'_, Option<OwnedSemaphorePermit>> {
        self.place.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The connections that have no place, the oldest first.
struct Strangers {
    most: usize,
    all: VecDeque<Weak<Visitor>>,
}

impl Strangers {
    /// Lets one more in, in the place of the oldest if there are too many.
    fn let_in(&mut self, visitor: &Arc<Visitor>) {
        self.all.retain(|other| other.upgrade().is_some_and(|other| !other.is_known()));
        while self.all.len() >= self.most {
            if let Some(oldest) = self.all.pop_front().and_then(|oldest| oldest.upgrade()) {
                oldest.sent_away.notify_one();
            }
        }
        self.all.push_back(Arc::downgrade(visitor));
    }
}

/// A connection with its visitor, whose place a websocket keeps too. It fails if nothing is taken for long.
struct Connection {
    stream: TcpStream,
    unread: Duration,
    /// Runs out while there is something to send that is not taken.
    stalled: Option<Pin<Box<Sleep>>>,
    _visitor: Arc<Visitor>,
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
