//! A scene runs as it is watched: pages get every row, steer the run, and cannot slow it.

use crate::common::{FALL, Served, doubles, provenance, singles};
use gyration_scene::Scene;
use gyration_sim::{Job, MemorySink, Simulation, Unwatched};
use gyration_view::{Live, PageSource};
use serde_json::{Value, json};
use std::net::TcpStream;
use std::path::Path;
use tungstenite::{Message, WebSocket};

pub(crate) struct Page {
    socket: WebSocket<TcpStream>,
}

/// What a page knows of a run.
#[derive(Debug, Default)]
pub(crate) struct Watched {
    header: Value,
    pub(crate) times: Vec<f64>,
    /// Rows of the array `position`.
    positions: Vec<f32>,
    pub(crate) network: Vec<f32>,
    blobs: Vec<String>,
    done: Value,
    paused: Option<bool>,
}

impl Page {
    pub(crate) fn open(served: &Served) -> Self {
        let port = served.port;
        let address = format!("ws://127.0.0.1:{port}{}/api/live", served.root);
        let request = tungstenite::ClientRequestBuilder::new(address.parse().unwrap())
            .with_header("Origin", format!("http://127.0.0.1:{port}"));
        let stream = TcpStream::connect(("127.0.0.1", port)).unwrap();
        Self { socket: tungstenite::client(request, stream).unwrap().0 }
    }

    fn wish(&mut self, wish: &Value) {
        self.socket.send(Message::text(wish.to_string())).unwrap();
    }

    /// Reads until something holds; an error message ends it too.
    fn read(&mut self, watched: &mut Watched, until: impl Fn(&Watched) -> bool) -> Option<String> {
        while !until(watched) {
            match self.socket.read().unwrap() {
                Message::Text(text) => {
                    let message: Value = serde_json::from_str(&text).unwrap();
                    match message["type"].as_str().unwrap() {
                        "header" => *watched = Watched { header: message["header"].clone(), ..Watched::default() },
                        "done" => watched.done = message,
                        "progress" => {
                            // Every word on progress is whole, the first one too.
                            assert!(message["time"].is_number() && message["end"].is_number(), "{message}");
                            watched.paused = message["paused"].as_bool();
                        }
                        "error" => return Some(message["message"].as_str().unwrap().to_owned()),
                        other => panic!("{other}"),
                    }
                }
                Message::Binary(bytes) => take(watched, &bytes),
                other => panic!("{other:?}"),
            }
        }
        None
    }

    pub(crate) fn read_all(&mut self) -> Watched {
        let mut watched = Watched::default();
        assert_eq!(self.read(&mut watched, |watched| !watched.done.is_null()), None);
        watched
    }
}

fn take(watched: &mut Watched, bytes: &[u8]) {
    let length = u32::from_le_bytes(*bytes.first_chunk().unwrap()) as usize;
    let head: Value = serde_json::from_slice(&bytes[4..4 + length]).unwrap();
    let payload = &bytes[4 + length..];
    assert_eq!(head["run"], watched.header["run"]);
    if head["kind"] == "blob" {
        return watched.blobs.push(head["name"].as_str().unwrap().to_owned());
    }
    let rows = head["rows"].as_u64().unwrap() as usize;
    if head["kind"] == "network" {
        // Rows have come, then what is pushed in them.
        assert_eq!(head["first"].as_u64().unwrap() as usize + rows, watched.times.len());
        return watched.network.extend(singles(payload));
    }
    assert_eq!(head["first"], watched.times.len());
    watched.times.extend(doubles(&payload[..8 * rows]));
    let first = &watched.header["arrays"][0];
    assert_eq!(first["name"], "position");
    let stride = first["stride"].as_u64().unwrap() as usize;
    watched.positions.extend(singles(&payload[8 * rows..8 * rows + 4 * rows * stride]));
}

fn live(folder: &tempfile::TempDir, text: &str) -> Served {
    Served::new(running(folder, text))
}

/// A text that runs once it is watched.
pub(crate) fn running(folder: &tempfile::TempDir, text: &str) -> PageSource {
    let path = folder.path().join("fall.toml");
    std::fs::write(&path, text).unwrap();
    PageSource::Live(Live::start(path.to_str().unwrap(), &[], provenance()).unwrap())
}

#[test]
fn a_live_run_shows_the_rows_of_a_recorded_one() {
    let folder = tempfile::tempdir().unwrap();
    let served = live(&folder, FALL);
    assert_eq!(served.json("/api/header")["mode"], "live");
    let watched = Page::open(&served).read_all();
    let scene = Scene::parse("fall.toml", FALL, Path::new(""), &[]).unwrap();
    let job = Job::of(&scene, &provenance());
    let mut simulation = Simulation::new(job.model, job.start, job.plan).unwrap();
    let mut sink = MemorySink::default();
    simulation.begin(&mut sink).unwrap();
    simulation.run(&mut sink, &mut Unwatched).unwrap();
    assert_eq!(watched.times, sink.rows.iter().map(|(time, _)| *time).collect::<Vec<_>>());
    let positions = sink.rows.iter().flat_map(|(_, row)| row[..6].iter().map(|x| *x as f32)).collect::<Vec<_>>();
    assert_eq!(watched.positions, positions);
    assert_eq!(watched.done["outcome"], "completed");
    let arrays = watched.header["arrays"].as_array().unwrap();
    assert!(
        arrays.iter().any(|array| array["name"] == "cauchy_stress"),
        "a body that deforms is coloured by its stress"
    );
    assert!(watched.blobs.contains(&"events".to_owned()), "{:?}", watched.blobs);
    // A second page gets all of it too.
    assert_eq!(Page::open(&served).read_all().times, watched.times);
}

#[test]
fn a_restart_begins_anew_with_other_numbers_and_a_bad_one_is_refused_in_words() {
    let folder = tempfile::tempdir().unwrap();
    let served = live(&folder, FALL);
    let mut page = Page::open(&served);
    let first = page.read_all();
    page.wish(&json!({ "type": "restart", "set": ["body.ball.velocity=[-2, 0, 0]"] }));
    let mut second = Watched::default();
    assert_eq!(page.read(&mut second, |watched| watched.header["run"] == 2 && !watched.done.is_null()), None);
    assert_eq!(second.header["overrides"], json!(["body.ball.velocity=[-2, 0, 0]"]));
    let last_x = |watched: &Watched| watched.positions[watched.positions.len() - 6];
    assert!(last_x(&first) > 0.1 && last_x(&second) < -0.5);
    page.wish(&json!({ "type": "restart", "set": ["body.ball.mass=-1"] }));
    let problem = page.read(&mut second, |_| false).unwrap();
    assert!(problem.contains("body.ball.mass"), "{problem}");
    page.wish(&json!({ "type": "dance" }));
    assert!(page.read(&mut second, |_| false).unwrap().contains("not understood"));
    // The run before is still there for a page that comes now, which is told of the refusal too.
    let mut late = Watched::default();
    let problem = Page::open(&served).read(&mut late, |watched| !watched.done.is_null());
    assert!(problem.is_some_and(|words| words.contains("body.ball.mass")) && late.header["run"] == 2);
}

#[test]
fn a_number_that_is_refused_stops_nothing() {
    let folder = tempfile::tempdir().unwrap();
    // Long enough not to be over before the wish comes.
    let served = live(&folder, &FALL.replace("end = 0.3", "end = 300"));
    let mut page = Page::open(&served);
    let mut watched = Watched::default();
    page.read(&mut watched, |watched| !watched.times.is_empty());
    page.wish(&json!({ "type": "restart", "set": ["body.ball.mass=-1"] }));
    assert!(page.read(&mut watched, |_| false).unwrap().contains("body.ball.mass"));
    let seen = watched.times.len();
    page.read(&mut watched, |watched| watched.times.len() > seen + 100);
    assert_eq!((&watched.header["run"], &watched.done), (&json!(1), &Value::Null));
}

#[test]
fn a_paused_run_waits_and_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    // Long enough not to be over before the wish comes.
    let served = live(&folder, &FALL.replace("end = 0.3", "end = 300"));
    let mut page = Page::open(&served);
    let mut watched = Watched::default();
    page.read(&mut watched, |watched| !watched.times.is_empty());
    page.wish(&json!({ "type": "pause" }));
    page.read(&mut watched, |watched| watched.paused == Some(true));
    assert!(watched.done.is_null());
    page.wish(&json!({ "type": "resume" }));
    let seen = watched.times.len();
    page.read(&mut watched, |watched| watched.paused == Some(false) && watched.times.len() > seen);
}

#[test]
fn a_page_that_reads_nothing_keeps_nobody_waiting() {
    let folder = tempfile::tempdir().unwrap();
    // More rows than sockets buffer.
    let served = live(&folder, &FALL.replace("end = 0.3", "end = 3").replace("sample = 0.01", "sample = 1e-4"));
    let _asleep = Page::open(&served);
    let watched = Page::open(&served).read_all();
    assert_eq!(watched.times.len(), 30_001);
}

/// A box that sinks, and whose resistance takes seconds to compute.
const SINKING: &str = r#"
time = { end = 0.3, sample = 0.01 }
fluid = { viscosity = 1 }
[[body]]
name = "box"
shape = { box = { size = ["6 mm", "5 mm", "4 mm"] } }
density = 2500
inclusion = { triangles = 2000 }
"#;

#[test]
fn a_run_that_is_superseded_is_given_up_while_it_computes_a_matrix() {
    let folder = tempfile::tempdir().unwrap();
    let served = live(&folder, SINKING);
    let mut page = Page::open(&served);
    page.wish(&json!({ "type": "restart", "set": ["body.box.inclusion.triangles=100"] }));
    let mut watched = Watched::default();
    assert_eq!(page.read(&mut watched, |watched| !watched.done.is_null()), None);
    // The run before never began.
    assert_eq!((&watched.header["run"], watched.times.len()), (&json!(1), 31));
}

#[test]
fn other_pages_cannot_open_the_websocket() {
    let folder = tempfile::tempdir().unwrap();
    let served = live(&folder, FALL);
    let upgrade = "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n";
    let other = format!("{}Origin: http://elsewhere.example\r\n{upgrade}", served.host());
    assert_eq!(served.ask("/api/live", &other).0, 403);
    assert_eq!(served.ask_anywhere("/api/live", &format!("{}{upgrade}", served.host())).0, 403, "no token");
}
