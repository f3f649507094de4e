//! A scene that runs slice by slice, as it is asked for, and what it has to tell.

use gyration::dynamics::Exchange;
use gyration_files::GivenFiles;
use gyration_page::store::{Cursor, Message, Store};
use gyration_page::{FileFormat, KeptRun, NetworkTeller, SceneHash, WatchedRun, finish, progress};
use gyration_record::RecordError;
use gyration_scene::Scene;
use gyration_sim::events::Event;
use gyration_sim::{MemorySink, Monitor, Outcome, Progress, Provenance, Reason, Simulation, Sink};
use serde::Deserialize;
use serde_json::{Value, json};

/// What is to be run.
#[derive(Debug, Deserialize)]
struct Asked {
    /// What the scene is called.
    name: String,
    /// Its text.
    scene: String,
    /// Overrides as of `--set`.
    #[serde(default)]
    set: Vec<String>,
}

/// How a run stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Standing {
    /// There is more to do.
    GoesOn = 0,
    /// It is over, or there is none.
    Ended = 1,
    /// It cannot go on; why is among the messages.
    Failed = 2,
}

/// Runs one scene after the other.
#[derive(Default)]
pub struct Engine {
    store: Store,
    cursor: Cursor,
    run: Option<Run>,
    /// The rows of the run that began last, also once it is over.
    kept: Option<KeptRun>,
    /// What scenes may name.
    files: GivenFiles,
}

/// A run under way.
struct Run {
    simulation: Simulation,
    hash: Option<SceneHash>,
    network: Option<NetworkTeller>,
}

impl Engine {
    /// Takes a file that scenes may name from now on.
    pub fn give(&mut self, name: &str, content: Vec<u8>) {
        self.files.give(name, content);
    }

    /// Begins what a text in JSON asks for, in the place of the run before; else that goes on, and why is among the
    /// messages.
    pub fn open(&mut self, asked: &[u8]) -> bool {
        let begun = serde_json::from_slice::<Asked>(asked).map_err(|error| (error.to_string(), None));
        let begun = begun.and_then(|asked| self.begin(&asked).map_err(|words| (words, Some(asked.set))));
        match begun {
            Ok((run, kept)) => {
                (self.run, self.kept) = (Some(run), kept);
                true
            }
            Err((message, set)) => {
                let mut problem = json!({ "message": message });
                if let Some(set) = set {
                    problem["set"] = json!(set);
                }
                self.store.problem(problem);
                false
            }
        }
    }

    fn begin(&mut self, asked: &Asked) -> Result<(Run, Option<KeptRun>), String> {
        let name = format!("{}.toml", asked.name);
        let scene = Scene::among(&name, &asked.scene, self.files.clone().into(), &asked.set);
        let scene = scene.and_then(gyration_sim::complete).map_err(|errors| errors.to_string())?;
        let watched = WatchedRun::of(&scene, &provenance());
        let mut first = MemorySink::default();
        let simulation = watched.begun(&mut first)?;
        watched.publish(&mut self.store);
        let (mut hash, mut kept, network) = (watched.hash(), watched.kept(), watched.network());
        let network_of = network.as_ref();
        let mut sink = Publisher { store: &mut self.store, hash: &mut hash, kept: &mut kept, network: network_of };
        first.hand_on(&mut sink).map_err(|error| error.to_string())?;
        Ok((Run { simulation, hash, network }, kept))
    }

    /// Goes on for so many evaluations of the rates, and some more until a step is whole.
    pub fn advance(&mut self, evaluations: u64) -> Standing {
        let Self { store, run: under_way, kept, .. } = self;
        let Some(run) = under_way else { return Standing::Ended };
        let most = run.simulation.statistics().rate_evaluations.saturating_add(evaluations);
        let mut slice = Slice { most, progress: None };
        let mut sink = Publisher { store, hash: &mut run.hash, kept, network: run.network.as_ref() };
        let ran = run.simulation.run(&mut sink, &mut slice);
        match (ran, slice.progress) {
            (Ok(outcome), Some(progress)) if is_asked(&outcome) => {
                store.progress(progress);
                Standing::GoesOn
            }
            (Ok(outcome), _) => {
                finish(store, &mut run.simulation, outcome, (None, run.hash.take()));
                *under_way = None;
                Standing::Ended
            }
            (Err(error), _) => {
                store.problem(json!({ "message": error.to_string() }));
                *under_way = None;
                Standing::Failed
            }
        }
    }

    /// A part of the run so far as a file, from zero; none behind the last one.
    ///
    /// # Errors
    /// Words for the reader.
    pub fn save(&self, format: FileFormat, part: usize) -> Result<Option<Vec<u8>>, String> {
        let kept = self.kept.as_ref().ok_or("There is no run to be saved.")?;
        kept.part(format, part).map_err(|error| error.to_string())
    }

    /// The messages since the last call, as frames: u32 kind (0 text, 1 binary), u32 length, the bytes, zeros up to a
    /// multiple of eight; little-endian.
    pub fn frames(&mut self) -> Vec<u8> {
        let mut frames = Vec::new();
        loop {
            let messages = self.store.take(&mut self.cursor);
            if messages.is_empty() {
                return frames;
            }
            messages.into_iter().for_each(|message| append(&mut frames, message));
        }
    }
}

fn append(frames: &mut Vec<u8>, message: Message) {
    let (kind, bytes) = match message {
        Message::Text(text) => (0_u32, text.into_bytes()),
        Message::Binary(bytes) => (1, bytes),
    };
    // Of the memory of a page, which has 32 bits, no message is longer.
    frames.extend(kind.to_le_bytes());
    frames.extend((bytes.len() as u32).to_le_bytes());
    frames.extend(bytes);
    frames.resize(frames.len().next_multiple_of(8), 0);
}

fn provenance() -> Provenance {
    Provenance {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        commit: option_env!("GYRATION_COMMIT").map(str::to_owned),
    }
}

fn is_asked(outcome: &Outcome) -> bool {
    matches!(outcome, Outcome::Stopped(stop) if stop.reason == Reason::Interrupted)
}

/// Publishes and keeps rows and events.
struct Publisher<'a> {
    store: &'a mut Store,
    hash: &'a mut Option<SceneHash>,
    kept: &'a mut Option<KeptRun>,
    network: Option<&'a NetworkTeller>,
}

impl Sink for Publisher<'_> {
    fn exchanges(&mut self, exchanges: &[Exchange]) -> Result<(), RecordError> {
        if let Some(network) = self.network {
            network.tell(self.store, exchanges);
        }
        Ok(())
    }

    fn row(&mut self, time: f64, row: &[f64]) -> Result<(), RecordError> {
        if let Some(hash) = self.hash {
            hash.add_row(time, row);
        }
        if let Some(kept) = self.kept {
            kept.add_row(time, row);
        }
        self.store.row(time, row);
        Ok(())
    }

    fn event(&mut self, event: &Event) -> Result<(), RecordError> {
        let Event { time, kind, body } = *event;
        let event = gyration_record::Event { time, kind, body: Some(body) };
        self.store.event(event);
        if let Some(kept) = self.kept {
            kept.add_event(event);
        }
        Ok(())
    }
}

/// Ends a slice after so many evaluations of the run; where it was then.
struct Slice {
    most: u64,
    progress: Option<Value>,
}

impl Monitor for Slice {
    fn after_step(&mut self, now: &Progress) -> Option<Reason> {
        if now.statistics.rate_evaluations < self.most {
            return None;
        }
        self.progress = Some(progress(now));
        Some(Reason::Interrupted)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gyration_sim::{Job, RecordingEnd, Unwatched};

    fn asked(name: &str, set: &[&str]) -> Vec<u8> {
        let text = gyration_scene::gallery_scene(name).unwrap();
        json!({ "name": name, "scene": text, "set": set }).to_string().into_bytes()
    }

    /// The texts among some frames.
    fn texts(frames: &[u8]) -> Vec<Value> {
        let (mut texts, mut rest) = (Vec::new(), frames);
        while let Some((head, behind)) = rest.split_at_checked(8) {
            let number = |at: usize| u32::from_le_bytes([head[at], head[at + 1], head[at + 2], head[at + 3]]) as usize;
            if number(0) == 0 {
                texts.push(serde_json::from_slice(&behind[..number(4)]).unwrap());
            }
            rest = &behind[number(4).next_multiple_of(8)..];
        }
        texts
    }

    /// Runs to the end in slices; the last text, and how many slices.
    fn run(engine: &mut Engine, slice: u64) -> (Value, usize) {
        let (mut slices, mut all) = (1, Vec::new());
        while engine.advance(slice) == Standing::GoesOn {
            slices += 1;
            all.extend(engine.frames());
        }
        all.extend(engine.frames());
        (texts(&all).pop().unwrap(), slices)
    }

    /// Of bodies that deform the page is given more than the scene records, of those that meet many islands run.
    #[test]
    fn slices_leave_no_trace_and_the_hash_is_that_of_the_recording() {
        let folder = tempfile::tempdir().unwrap();
        for (name, end) in [("elastic-bounce", "time.end=1"), ("dice-pair", "time.end=0.1")] {
            let scene = gyration_sim::open(name, &[end.to_owned()]).unwrap();
            let job = Job::of(&scene, &provenance());
            let RecordingEnd::Ran(told) = job.record(&folder.path().join(name), &mut Unwatched).unwrap() else {
                panic!("{name} had been run")
            };
            let mut counts = Vec::new();
            for slice in [100, u64::MAX] {
                let mut engine = Engine::default();
                assert!(engine.open(&asked(name, &[end])));
                let (done, slices) = run(&mut engine, slice);
                assert_eq!((&done["type"], &done["hash"]), (&json!("done"), &json!(told.row_hash)), "{name}, {slice}");
                counts.push(slices);
            }
            assert!(counts[0] > 3 && counts[1] == 1, "{name}: {counts:?} slices");
        }
    }

    fn saved(engine: &Engine, format: FileFormat) -> Vec<u8> {
        (0..).map_while(|part| engine.save(format, part).unwrap()).flatten().collect()
    }

    /// The page is given stresses and parts of the contact forces besides, which no file has; rows in several chunks.
    #[test]
    fn files_are_those_that_are_exported_of_the_recording() {
        let folder = tempfile::tempdir().unwrap();
        for (name, set) in [("elastic-bounce", ["time.end=1", "time.sample=1e-4"]), ("stack", ["time.end=0.1", ""])] {
            let set: Vec<_> = set.into_iter().filter(|one| !one.is_empty()).collect();
            let scene = gyration_sim::open(name, &set.iter().map(|one| (*one).to_owned()).collect::<Vec<_>>()).unwrap();
            let path = folder.path().join(name);
            Job::of(&scene, &provenance()).record(&path, &mut Unwatched).unwrap();
            let recording = gyration_record::Recording::open(&path).unwrap();
            let (mut table, mut motion) = (Vec::new(), Vec::new());
            gyration_record::export::csv(&recording, &mut table).unwrap();
            gyration_record::export::gltf(&recording, &mut motion).unwrap();
            let mut engine = Engine::default();
            assert!(engine.save(FileFormat::Csv, 0).is_err());
            assert!(engine.open(&asked(name, &set)));
            engine.advance(20);
            let so_far = saved(&engine, FileFormat::Csv);
            assert!(table.starts_with(&so_far) && so_far.len() < table.len(), "{name}");
            run(&mut engine, 1000);
            assert!(saved(&engine, FileFormat::Csv) == table, "{name}");
            assert!(saved(&engine, FileFormat::Glb) == motion, "{name}");
        }
    }

    #[test]
    fn meshes_and_tables_are_found_among_the_files_that_were_given() {
        let text = |extra: &str| {
            let text = gyration_scene::gallery_scene("bounce").unwrap();
            let lines = text.lines().map(|line| match line.starts_with("shape =") {
                true => "shape = { mesh = { file = \"parts/wedge.obj\" } }",
                false => line,
            });
            lines.collect::<Vec<_>>().join("\n").replace("[[body]]", &format!("[[body]]\n{extra}"))
        };
        let ask =
            |text: String| json!({ "name": "own", "scene": text, "set": ["time.end=0.01"] }).to_string().into_bytes();
        let mut engine = Engine::default();
        assert!(!engine.open(&ask(text(""))));
        let refused = texts(&engine.frames()).pop().unwrap();
        let words = refused["message"].as_str().unwrap();
        assert!(words.contains("parts/wedge.obj: there is no such file in this page yet"), "{words}");
        assert!(words.contains("fix: drop the file on the page"), "{words}");
        let wedge = "v 0 0 0\nv .1 0 0\nv 0 .1 0\nv 0 0 .1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
        engine.give("wedge.obj", wedge.into());
        assert!(engine.open(&ask(text(""))), "{:?}", texts(&engine.frames()));
        assert_eq!(run(&mut engine, 1000).0["type"], "done");
        assert!(!engine.open(&ask(text("copies = { places = \"places.csv\" }"))));
        assert!(texts(&engine.frames()).pop().unwrap()["message"].as_str().unwrap().contains("fix: drop the file"));
        engine.give("places.csv", b"x,y,z\n0,0,0\n1,0,0\n".to_vec());
        assert!(engine.open(&ask(text("copies = { places = \"places.csv\" }"))), "{:?}", texts(&engine.frames()));
    }

    #[test]
    fn a_run_goes_on_where_another_is_refused() {
        let mut engine = Engine::default();
        assert!(engine.open(&asked("bounce", &["time.end=1"])));
        assert_eq!(engine.advance(20), Standing::GoesOn);
        engine.frames();
        assert!(!engine.open(&asked("bounce", &["time.end=-1"])));
        let refused = texts(&engine.frames()).pop().unwrap();
        assert_eq!((&refused["type"], &refused["set"]), (&json!("error"), &json!(["time.end=-1"])));
        assert!(refused["message"].as_str().unwrap().contains('^'), "{refused}");
        assert!(!engine.open(b"no scene"));
        assert_eq!(texts(&engine.frames())[0]["type"], "error");
        assert_eq!(run(&mut engine, 1000).0["type"], "done");
        assert_eq!(engine.advance(1), Standing::Ended);
    }
}
