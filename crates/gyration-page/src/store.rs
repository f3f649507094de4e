//! What a run has published so far, and how far each page has taken it.

use crate::binary;
use crate::blob;
use gyration_record::Event;
use serde_json::{Value, json};
use std::sync::Arc;

/// Bytes of numbers in one message at most: a page draws between two messages.
const MOST_BYTES: usize = 2 << 20;

/// A run as far as it has got.
#[derive(Debug, Default)]
pub struct Store {
    run: u64,
    header: Option<Arc<str>>,
    /// Blobs that do not grow: the surfaces.
    fixed: Vec<(String, Vec<u8>)>,
    /// Numbers in a row of each array.
    strides: Vec<usize>,
    times: Vec<f64>,
    /// The rows, one after the other.
    values: Vec<f32>,
    /// Networks of forces, one behind the other, and where that of each row ends; empty where they are not told.
    network: (Vec<f32>, Vec<usize>),
    events: Vec<Event>,
    /// The last word on how far it is; counted, so that a page knows whether it has had it.
    progress: (u64, Value),
    done: Option<Value>,
    paused: bool,
    /// Why the run last asked for could not begin, counted, with its overrides; null once another one has begun.
    problem: (u64, Value),
}

/// How far a page has taken a store.
#[derive(Debug, Default)]
pub struct Cursor {
    run: u64,
    fixed: usize,
    rows: usize,
    events: usize,
    progress: u64,
    paused: bool,
    done: bool,
    problem: u64,
}

/// A message to a page.
#[derive(Debug, Clone, PartialEq)]
pub enum Message {
    /// JSON.
    Text(String),
    /// A head and numbers (`binary`).
    Binary(Vec<u8>),
}

impl Store {
    /// Forgets the run before and begins a new one.
    pub fn begin(&mut self, header: &Value, fixed: Vec<(String, Vec<u8>)>, strides: Vec<usize>) {
        let start = json!({ "time": 0.0, "end": header["end"], "steps": 0, "step": 0.0, "limited_by": "" });
        let header = json!({ "type": "header", "header": header }).to_string();
        *self = Self {
            run: self.run + 1,
            header: Some(header.into()),
            fixed,
            strides,
            progress: (self.progress.0 + 1, start),
            problem: (self.problem.0, Value::Null),
            ..Self::default()
        };
    }

    /// The number that the next run will have.
    pub fn next_run(&self) -> u64 {
        self.run + 1
    }

    /// Appends a row.
    pub fn row(&mut self, time: f64, row: &[f64]) {
        self.times.push(time);
        self.values.extend(row.iter().map(|value| *value as f32));
    }

    /// Appends the network of forces of the row that comes next ([`blob::network`]).
    pub fn network(&mut self, network: &[f32]) {
        let (numbers, ends) = &mut self.network;
        numbers.extend(network);
        ends.push(numbers.len());
    }

    /// Appends an event.
    pub fn event(&mut self, event: Event) {
        self.events.push(event);
    }

    /// Says how far the run is ([`crate::progress`]).
    pub fn progress(&mut self, progress: Value) {
        self.progress = (self.progress.0 + 1, progress);
    }

    /// Says how it ended.
    pub fn finish(&mut self, done: Value) {
        self.done = Some(done);
    }

    /// Says whether it waits.
    pub fn pause(&mut self, paused: bool) {
        self.paused = paused;
    }

    /// Keeps a message, and beside it the overrides that it is of.
    pub fn problem(&mut self, problem: Value) {
        self.problem = (self.problem.0 + 1, problem);
    }

    /// What a page has not had yet, a few messages at a time; none: it has had all.
    pub fn take(&self, cursor: &mut Cursor) -> Vec<Message> {
        let mut messages = Vec::new();
        if let Some(header) = self.header.as_ref().filter(|_| cursor.run != self.run) {
            *cursor = Cursor { run: self.run, problem: cursor.problem, ..Cursor::default() };
            messages.push(Message::Text(header.to_string()));
        }
        for (name, bytes) in &self.fixed[cursor.fixed..] {
            messages.push(self.blob(name, bytes));
            cursor.fixed += 1;
        }
        let full = self.take_rows(cursor, &mut messages);
        if cursor.events < self.events.len() {
            cursor.events = self.events.len();
            messages.push(self.blob("events", &blob::events(&self.events)));
        }
        let moved = cursor.progress != self.progress.0 || cursor.paused != self.paused;
        if moved && !self.progress.1.is_null() {
            (cursor.progress, cursor.paused) = (self.progress.0, self.paused);
            let mut progress = json!({ "type": "progress", "paused": self.paused });
            if let (Some(all), Some(told)) = (progress.as_object_mut(), self.progress.1.as_object()) {
                all.extend(told.clone());
            }
            messages.push(Message::Text(progress.to_string()));
        }
        if cursor.problem != self.problem.0 {
            cursor.problem = self.problem.0;
            if let Some(problem) = self.problem.1.as_object() {
                let mut error = problem.clone();
                error.insert("type".to_owned(), "error".into());
                messages.push(Message::Text(Value::Object(error).to_string()));
            }
        }
        // The end is told once every row is there.
        if let Some(done) = self.done.as_ref().filter(|_| !cursor.done && !full) {
            cursor.done = true;
            messages.push(Message::Text(done.to_string()));
        }
        messages
    }

    /// Takes rows, as many as one message holds; whether there are more.
    fn take_rows(&self, cursor: &mut Cursor, messages: &mut Vec<Message>) -> bool {
        let all: usize = self.strides.iter().sum();
        let first = cursor.rows;
        let last = self.times.len().min(first + (MOST_BYTES / (4 * all + 8)).max(1));
        if first == last {
            return false;
        }
        let mut payload = blob::doubles(self.times[first..last].iter().copied());
        let mut offset = 0;
        for stride in &self.strides {
            for row in self.values[first * all..last * all].chunks_exact(all) {
                payload.extend(row[offset..offset + stride].iter().flat_map(|value| value.to_le_bytes()));
            }
            offset += stride;
        }
        let head = json!({ "kind": "rows", "run": self.run, "first": first, "rows": last - first });
        messages.push(Message::Binary(binary::encode(&head, &payload)));
        let (numbers, ends) = &self.network;
        if let Some(end) = ends.get(last - 1) {
            let start = first.checked_sub(1).map_or(0, |before| ends[before]);
            let head = json!({ "kind": "network", "run": self.run, "first": first, "rows": last - first });
            messages.push(Message::Binary(binary::encode(&head, &blob::floats(&numbers[start..*end]))));
        }
        cursor.rows = last;
        last < self.times.len()
    }

    fn blob(&self, name: &str, bytes: &[u8]) -> Message {
        Message::Binary(binary::encode(&json!({ "kind": "blob", "run": self.run, "name": name }), bytes))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A store is all that pages see; this one stands for a page that takes everything.
    #[test]
    fn a_store_is_handed_on_once_and_in_order() {
        let mut store = Store::default();
        store.begin(&json!({ "run": store.next_run() }), vec![("surface/0/points".into(), vec![0; 12])], vec![1, 2]);
        for k in 0..3 {
            store.row(f64::from(k), &[1.0, 2.0, 3.0]);
        }
        let mut cursor = Cursor::default();
        assert_eq!(store.take(&mut cursor).len(), 4, "header, surface, rows, progress");
        assert!(store.take(&mut cursor).is_empty());
        store.finish(json!({ "type": "done" }));
        assert_eq!(store.take(&mut cursor).len(), 1);
        store.begin(&json!({}), Vec::new(), vec![1]);
        assert_eq!(store.take(&mut cursor).len(), 2, "header and progress of the next run");
    }
}
