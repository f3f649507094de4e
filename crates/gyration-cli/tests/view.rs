//! `gyration view` and `gyration report`: what they say, how they end, what they refuse.
//!
//! A program built without the page says how to get it; then that is what these tests see.

use crate::common::Sandbox;
use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::process::{Command, Stdio};

fn has_page() -> bool {
    gyration_view::page::html().is_ok()
}

fn recorded() -> Sandbox {
    let sandbox = Sandbox::with_ball();
    sandbox.done(&["run", "ball.toml", "--quiet"]);
    sandbox
}

#[test]
fn a_report_is_one_file_with_page_and_data() {
    let sandbox = recorded();
    if !has_page() {
        let said = sandbox.refused(2, &["report", "ball.gyr"]);
        assert!(said.stderr.contains("install Node 20"), "{}", said.stderr);
        return;
    }
    let said = sandbox.done(&["report", "ball.gyr/"]);
    assert_eq!(said.stdout, "");
    assert!(said.stderr.starts_with("wrote ball.html (61 samples, "), "{}", said.stderr);
    let html = fs::read_to_string(sandbox.path("ball.html")).unwrap();
    assert!(
        html.len() < 3_000_000 && html.contains("id=\"gyration-header\"") && html.contains("data-blob=\"position\"")
    );
    sandbox.done(&["report", "ball.gyr", "-o", "other.html"]);
    assert_eq!(html, fs::read_to_string(sandbox.path("other.html")).unwrap(), "the same recording, the same bytes");
}

#[test]
fn what_cannot_be_shown_is_refused_in_words() {
    let sandbox = recorded();
    for command in ["view", "report"] {
        sandbox.refused(3, &[command, "nothing.gyr"]);
        fs::create_dir_all(sandbox.path("empty")).unwrap();
        let said = sandbox.refused(3, &[command, "empty"]);
        assert!(said.stderr.contains("is not a recording"), "{}", said.stderr);
    }
    sandbox.refused(2, &["view", "ball.gyr", "--set", "time.end=1"]);
    let said = sandbox.refused(2, &["view", "ball.toml", "--set", "body.ball.density=-1"]);
    assert!(said.stderr.contains("body.ball.density"), "{}", said.stderr);
    if has_page() {
        let taken = TcpListener::bind("127.0.0.1:0").unwrap();
        let port = taken.local_addr().unwrap().port().to_string();
        let said = sandbox.refused(2, &["view", "ball.gyr", "--no-open", "--port", &port]);
        assert!(said.stderr.contains(&format!("cannot listen on port {port}")), "{}", said.stderr);
    }
}

#[cfg(unix)]
#[test]
fn the_page_is_served_until_it_is_interrupted() {
    let sandbox = recorded();
    if !has_page() {
        sandbox.refused(2, &["view", "ball.gyr", "--no-open"]);
        return;
    }
    for (what, mode) in [("ball.gyr", "\"recording\""), ("ball.toml", "\"live\"")] {
        let mut command = sandbox.command(&["view", what, "--no-open"]);
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let mut url = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut url).unwrap();
        let (host, token) = url.trim().strip_prefix("http://").unwrap().split_once('/').unwrap();
        let get = |path: &str| {
            let mut stream = TcpStream::connect(host).unwrap();
            write!(stream, "GET /{path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n").unwrap();
            let mut answer = String::new();
            stream.read_to_string(&mut answer).unwrap();
            answer
        };
        assert!(get(token).contains("<!--gyration-data-->"), "the page, without data of its own");
        assert!(get(&format!("{token}api/header")).contains(&format!("\"mode\":{mode}")), "{what}");
        assert!(get("api/header").starts_with("HTTP/1.1 403 "), "{what}: without the token");
        assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
        assert_eq!(child.wait().unwrap().code(), Some(0), "{what}");
    }
}
