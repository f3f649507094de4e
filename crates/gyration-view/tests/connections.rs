//! The server answers who has its address, and neither many connections nor slow ones keep it from that.

use crate::common::{FALL, Served, answer, record};
use crate::live::{Page, running};
use gyration_view::{Limits, PageSource, Stored};
use std::io::{ErrorKind, Read};
use std::net::TcpStream;
use std::time::Duration;

/// Long for a request, short for a test.
const SOON: Duration = Duration::from_secs(1);

fn recording(folder: &tempfile::TempDir, limits: Limits) -> Served {
    let path = record(folder.path(), "fall", FALL);
    Served::with_limits(PageSource::Recording(Box::new(Stored::open(&path).unwrap())), limits)
}

/// Waits until the server closes a connection; what it has sent.
fn left(mut stream: TcpStream) -> String {
    // If it never does, the test fails instead of waiting for ever.
    stream.set_read_timeout(Some(60 * SOON)).unwrap();
    let mut said = Vec::new();
    match stream.read_to_end(&mut said) {
        Err(error) if error.kind() != ErrorKind::ConnectionReset => panic!("not closed: {error}"),
        _ => String::from_utf8_lossy(&said).into_owned(),
    }
}

#[test]
fn who_has_not_the_token_is_refused_and_told_of_the_address() {
    let folder = tempfile::tempdir().unwrap();
    let served = recording(&folder, Limits::default());
    let other = Served::new(running(&folder, FALL));
    assert_ne!(served.root, other.root);
    assert_eq!(served.get("/api/header").0, 200);
    let shorter = &served.root[..served.root.len() - 1];
    for root in ["", "/0123456789abcdef0123456789abcdef", &other.root, shorter] {
        for path in ["/", "/api/header", "/api/blob/time", "/api/live", "/none"] {
            let (status, words) = served.ask_anywhere(&format!("{root}{path}"), &served.host());
            assert_eq!(status, 403, "{root}{path}");
            let words = String::from_utf8(words).unwrap();
            assert!(words.contains("the address that `gyration view` printed"), "{words}");
        }
    }
    assert_eq!(served.get("/none").0, 404);
    // The address without the slash at its end leads to the page too.
    assert_eq!(served.get("").0, 307);
}

#[test]
fn a_request_that_does_not_come_whole_is_dropped_while_others_are_answered() {
    let folder = tempfile::tempdir().unwrap();
    let served = recording(&folder, Limits { request: SOON, ..Limits::default() });
    let head = format!("GET {}/api/header HTTP/1.1\r\n{}", served.root, served.host());
    let halves = [
        String::new(),
        "GET".to_owned(),
        head.clone(),
        format!("{head}Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"),
    ]
    .map(|half| served.send(&half));
    let no_body = served.send(&format!("{}Content-Length: 1000\r\n\r\n", head.replace("GET", "POST")));
    assert_eq!(served.get("/api/header").0, 200);
    for half in halves {
        let said = left(half);
        assert!(!said.contains(" 200 ") && !said.contains(" 101 "), "{said}");
    }
    assert!(left(no_body).contains(" 405 "));
    let idle = served.send(&format!("{head}\r\n"));
    assert!(left(idle).contains(" 200 "), "answered, then left as no further request comes");
}

#[test]
fn a_page_that_only_listens_is_kept() {
    let folder = tempfile::tempdir().unwrap();
    let served =
        Served::with_limits(running(&folder, FALL), Limits { request: SOON, unread: SOON, ..Limits::default() });
    let mut page = Page::open(&served);
    // A request that is dropped for its silence: the page has been silent for as long.
    left(served.send("GET"));
    assert_eq!(page.read_all().times.len(), 31);
}

#[test]
fn connections_beyond_those_allowed_wait_for_a_place() {
    let folder = tempfile::tempdir().unwrap();
    let served = Served::with_limits(running(&folder, FALL), Limits { connections: 1, ..Limits::default() });
    let mut page = Page::open(&served);
    let request = format!("GET {}/api/header HTTP/1.1\r\n{}Connection: close\r\n\r\n", served.root, served.host());
    let mut waiting = served.send(&request);
    // The server has had time to answer: it has sent a whole run since.
    assert_eq!(page.read_all().times.len(), 31);
    waiting.set_nonblocking(true).unwrap();
    let early = waiting.read(&mut [0]).unwrap_err();
    assert_eq!(early.kind(), ErrorKind::WouldBlock, "answered beyond the limit");
    waiting.set_nonblocking(false).unwrap();
    drop(page);
    assert_eq!(answer(waiting).0, 200);
}

#[test]
fn more_connections_than_allowed_are_outlived() {
    let folder = tempfile::tempdir().unwrap();
    let served = recording(&folder, Limits { connections: 4, request: SOON, ..Limits::default() });
    let crowd: Vec<_> = (0..100).map(|_| served.send("GET / HTTP/1.1\r\n")).collect();
    drop(crowd);
    assert_eq!(served.get("/api/header").0, 200);
    // Those that stay are dropped for their silence.
    let crowd: Vec<_> = (0..8).map(|_| served.send("GET / HTTP/1.1\r\n")).collect();
    assert_eq!(served.get("/api/header").0, 200);
    drop(crowd);
}

/// Nobody waits out the strangers' silence here: they would be left after an hour.
#[test]
fn those_without_the_token_do_not_keep_out_one_who_has_it() {
    let folder = tempfile::tempdir().unwrap();
    let limits = Limits { connections: 2, strangers: 4, request: 3600 * SOON, unread: 3600 * SOON };
    let served = recording(&folder, limits);
    let crowd: Vec<_> = (0..12).map(|_| served.send("GET / HTTP/1.1\r\n")).collect();
    assert_eq!(served.get("/api/header").0, 200);
    // The oldest have given way, the newest stay.
    let mut crowd = crowd.into_iter();
    crowd.by_ref().take(8).for_each(|old| assert_eq!(left(old), ""));
    let mut newest = crowd.last().unwrap();
    newest.set_nonblocking(true).unwrap();
    assert_eq!(newest.read(&mut [0]).unwrap_err().kind(), ErrorKind::WouldBlock);
}

#[test]
fn who_has_shown_the_token_gives_way_to_nobody() {
    let folder = tempfile::tempdir().unwrap();
    let limits = Limits { connections: 1, strangers: 1, request: 3600 * SOON, unread: 3600 * SOON };
    let served = Served::with_limits(running(&folder, FALL), limits);
    let mut page = Page::open(&served);
    let crowd: Vec<_> = (0..8).map(|_| served.send("GET / HTTP/1.1\r\n")).collect();
    assert_eq!(page.read_all().times.len(), 31);
    drop(crowd);
}

#[test]
fn who_does_not_read_loses_the_place() {
    let folder = tempfile::tempdir().unwrap();
    // More rows than sockets buffer.
    let text = FALL.replace("end = 0.3", "end = 3").replace("sample = 0.01", "sample = 1e-4");
    let served =
        Served::with_limits(running(&folder, &text), Limits { connections: 1, unread: SOON, ..Limits::default() });
    let _asleep = Page::open(&served);
    assert_eq!(served.get("/api/header").0, 200);
}
