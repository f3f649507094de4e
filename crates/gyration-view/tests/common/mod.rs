//! What these tests share: recordings of small scenes, a server in a thread, and a browser's part of HTTP.

#![allow(dead_code, clippy::unwrap_used, reason = "each test program uses a part of this")]

use gyration_scene::Scene;
use gyration_sim::{Job, Provenance, Unwatched};
use gyration_view::{Limits, PageSource, Server};
use std::io::{Read, Write};
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use tokio::sync::oneshot;

pub fn provenance() -> Provenance {
    Provenance { version: "0.0.0".into(), commit: None }
}

/// A scene of a ball that falls on a floor.
pub const FALL: &str = r#"
title = "A fall </script> & more"
[time]
end = 0.3
sample = 0.01
[[support]]
name = "floor"
plane = { origin = [0, 0, 0], normal = [0, 0, 1] }
[[contact]]
support = "floor"
repulsion = { alpha = 1e-6, nu = 6 }
[[body]]
name = "ball"
shape = { sphere = { radius = 0.05 } }
mass = 0.1
position = [0, 0, 0.2]
velocity = [0.5, 0, 0]
[[body]]
name = "jelly"
shape = { box = { size = [0.1, 0.1, 0.1] } }
density = 1000.0
affine = { material = { mooney_rivlin = { c1 = 3000.0, c2 = 1000.0 } }, viscosity = 20.0 }
position = [1, 0, 0.2]
"#;

/// Runs a text into a recording in a folder.
pub fn record(folder: &Path, name: &str, text: &str) -> PathBuf {
    let scene = Scene::parse(&format!("{name}.toml"), text, Path::new(""), &[]).unwrap();
    let path = folder.join(format!("{name}.gyr"));
    Job::of(&scene, &provenance()).record(&path, &mut Unwatched).unwrap();
    path
}

/// A server in a thread, until it is dropped.
pub struct Served {
    pub port: u16,
    /// The path under which everything is: a slash and the token.
    pub root: String,
    end: Option<oneshot::Sender<()>>,
    thread: Option<std::thread::JoinHandle<()>>,
}

impl Served {
    pub fn new(source: PageSource) -> Self {
        Self::with_limits(source, Limits::default())
    }

    pub fn with_limits(source: PageSource, limits: Limits) -> Self {
        let server = Server::bind(None).unwrap().with_limits(limits);
        let url = server.url();
        let (port, token) = url.strip_prefix("http://127.0.0.1:").unwrap().split_once('/').unwrap();
        let (port, root) = (port.parse().unwrap(), format!("/{}", token.strip_suffix('/').unwrap()));
        let (end, ended) = oneshot::channel();
        let serve = move || {
            server
                .serve(source, async {
                    let _ = ended.await;
                })
                .unwrap();
        };
        Self { port, root, end: Some(end), thread: Some(std::thread::spawn(serve)) }
    }

    /// A request as the page makes it: status and body.
    pub fn get(&self, path: &str) -> (u16, Vec<u8>) {
        self.ask(path, &self.host())
    }

    /// A request with the token and these headers.
    pub fn ask(&self, path: &str, headers: &str) -> (u16, Vec<u8>) {
        self.ask_anywhere(&format!("{}{path}", self.root), headers)
    }

    /// A request for a whole path, with these headers.
    pub fn ask_anywhere(&self, path: &str, headers: &str) -> (u16, Vec<u8>) {
        answer(self.send(&format!("GET {path} HTTP/1.1\r\n{headers}Connection: close\r\n\r\n")))
    }

    /// A connection over which these bytes were sent.
    pub fn send(&self, bytes: &str) -> TcpStream {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        stream.write_all(bytes.as_bytes()).unwrap();
        stream
    }

    /// The header `Host` as a browser sends it.
    pub fn host(&self) -> String {
        format!("Host: 127.0.0.1:{}\r\n", self.port)
    }

    pub fn json(&self, path: &str) -> serde_json::Value {
        let (status, body) = self.get(path);
        assert_eq!(status, 200, "{path}: {}", String::from_utf8_lossy(&body));
        serde_json::from_slice(&body).unwrap()
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        let _ = self.end.take().unwrap().send(());
        self.thread.take().unwrap().join().unwrap();
    }
}

/// All that is answered until the server closes the connection: status and body.
pub fn answer(mut stream: TcpStream) -> (u16, Vec<u8>) {
    let mut answer = Vec::new();
    stream.read_to_end(&mut answer).unwrap();
    let split = answer.windows(4).position(|four| four == b"\r\n\r\n").unwrap();
    let status = std::str::from_utf8(&answer[9..12]).unwrap().parse().unwrap();
    (status, answer.split_off(split + 4))
}

pub fn doubles(bytes: &[u8]) -> Vec<f64> {
    bytes.as_chunks().0.iter().map(|b| f64::from_le_bytes(*b)).collect()
}

pub fn singles(bytes: &[u8]) -> Vec<f32> {
    bytes.as_chunks().0.iter().map(|b| f32::from_le_bytes(*b)).collect()
}
