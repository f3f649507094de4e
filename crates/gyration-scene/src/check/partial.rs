//! The parts of a scene that are well formed, each with its place; the others have been noted.

use super::Reporter;
use super::copies::{BodyNumbers, Copies, CopyNames};
use super::placed::Placed;
use crate::document::{Diagnostics, Document};
use crate::file::{
    Body, Bond, Contact, Fluid, Joint, Lattice, Record, SceneFile, Solver, SpringBetween, Support, Time, World,
};
use crate::key::Key;
use crate::places::MOST_COPIES;
use crate::quantity::AnyQuantity;
use crate::tree::{Node, Value};
use gyration_files::Files;
use serde::de::DeserializeOwned;
use std::collections::{BTreeMap, BTreeSet};

/// The words by which contacts name a body.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct BodyWords {
    /// Its name and its groups, as far as they are texts.
    pub(crate) words: Vec<String>,
    /// Whether these are all: name and group are written as they must be.
    pub(crate) are_known: bool,
}

impl BodyWords {
    /// Those of a body as it is written.
    pub(crate) fn of(body: &Node) -> Self {
        let group = body.get("group");
        let nodes = match group {
            Some(Node { value: Value::Array(items), .. }) => items.as_slice(),
            group => group.map(std::slice::from_ref).unwrap_or_default(),
        };
        let written: Vec<Option<&str>> = nodes.iter().chain(body.get("name")).map(Node::text).collect();
        let are_known = body.get("name").is_some() && written.iter().all(Option::is_some);
        Self { words: written.into_iter().flatten().map(str::to_owned).collect(), are_known }
    }
}

/// The well-formed parts of a scene.
#[derive(Debug, Clone)]
pub(crate) struct PartialScene {
    pub(crate) title: Option<String>,
    pub(crate) world: World,
    pub(crate) time: Option<Time>,
    pub(crate) solver: Solver,
    pub(crate) record: Option<Record>,
    pub(crate) supports: Vec<Placed<Support>>,
    pub(crate) contacts: Vec<Placed<Contact>>,
    pub(crate) bodies: Vec<Placed<Body>>,
    /// What every body of the file is called, well formed or not.
    pub(crate) roll: Vec<BodyWords>,
    /// The copies of every body of the file.
    pub(crate) copies: Vec<Copies>,
    /// The bodies of the model of every body of the file.
    pub(crate) numbers: BodyNumbers,
    /// Names of copies.
    pub(crate) copy_names: CopyNames,
    pub(crate) springs: Vec<Placed<SpringBetween>>,
    pub(crate) bonds: Vec<Placed<Bond>>,
    pub(crate) joints: Vec<Placed<Joint>>,
    pub(crate) lattice: Option<Lattice>,
    pub(crate) fluid: Option<Fluid>,
    /// Constants of expressions; none if one of them is not well formed.
    pub(crate) constants: Option<BTreeMap<String, AnyQuantity>>,
}

impl PartialScene {
    /// Takes from the document what nothing has been found against; tables of places are among these files.
    pub(crate) fn new(document: &Document, files: &Files, diagnostics: &mut Diagnostics) -> Self {
        let mut this = Self::take(document, diagnostics);
        this.count_copies(files, &mut Reporter::new(document, diagnostics));
        this
    }

    fn take(document: &Document, diagnostics: &mut Diagnostics) -> Self {
        let dirty = diagnostics.iter().map(|diagnostic| diagnostic.key.clone()).collect();
        let mut taker = Taker { root: &document.root, dirty, diagnostics };
        Self {
            title: taker.section("title"),
            world: taker.section("world").unwrap_or_default(),
            time: taker.section("time"),
            solver: taker.section("solver").unwrap_or_default(),
            record: taker.section("record"),
            supports: taker.items("support"),
            contacts: taker.items("contact"),
            bodies: taker.items("body"),
            roll: document.root.get("body").map(Node::items).unwrap_or_default().iter().map(BodyWords::of).collect(),
            copies: Vec::new(),
            numbers: BodyNumbers::default(),
            copy_names: CopyNames::default(),
            springs: taker.items("spring"),
            bonds: taker.items("bond"),
            joints: taker.items("joint"),
            lattice: taker.section("lattice"),
            fluid: taker.section("fluid"),
            constants: match document.root.get("constants") {
                None => Some(BTreeMap::new()),
                Some(_) => taker.section("constants"),
            },
        }
    }

    /// Finds the copies of all bodies; notes what is wrong with them.
    fn count_copies(&mut self, files: &Files, reporter: &mut Reporter<'_>) {
        let written = reporter.document.root.get("body").map(Node::items).unwrap_or_default();
        let is_written = |body: &Node| if body.get("copies").is_some() { Copies::Unknown } else { Copies::Alone };
        self.copies = written.iter().map(is_written).collect();
        let in_lattice = reporter.document.root.get("lattice").is_some();
        let mut total = 0;
        for body in &self.bodies {
            let copies = Copies::of(body, files, in_lattice, reporter);
            total += copies.count();
            self.copies[body.number] = if total > MOST_COPIES && copies != Copies::Alone {
                total -= copies.count();
                let message = format!("with these there are more than {MOST_COPIES} bodies");
                reporter.note(&body.key.key("copies"), message, "write fewer");
                Copies::Unknown
            } else {
                copies
            };
        }
        for (words, copies) in self.roll.iter_mut().zip(&self.copies) {
            words.are_known &= *copies != Copies::Unknown;
        }
        self.numbers = BodyNumbers::of(self.copies.iter());
        let copied = self.bodies.iter().filter(|body| self.copies[body.number] != Copies::Alone);
        self.copy_names = CopyNames::of(copied.map(|body| (body.value.name.as_str(), self.numbers.range(body.number))));
    }

    /// The whole file, if all of it is well formed.
    pub(crate) fn complete(self) -> Option<SceneFile> {
        Some(SceneFile {
            title: self.title,
            world: self.world,
            time: self.time?,
            solver: self.solver,
            record: self.record,
            support: self.supports.into_iter().map(|placed| placed.value).collect(),
            contact: self.contacts.into_iter().map(|placed| placed.value).collect(),
            body: self.bodies.into_iter().map(|placed| placed.value).collect(),
            bond: self.bonds.into_iter().map(|placed| placed.value).collect(),
            joint: self.joints.into_iter().map(|placed| placed.value).collect(),
            spring: self.springs.into_iter().map(|placed| placed.value).collect(),
            lattice: self.lattice,
            fluid: self.fluid,
            constants: self.constants?,
        })
    }
}

struct Taker<'a> {
    root: &'a Node,
    dirty: BTreeSet<Key>,
    diagnostics: &'a mut Diagnostics,
}

impl Taker<'_> {
    fn section<T: DeserializeOwned>(&mut self, name: &str) -> Option<T> {
        let node = self.root.get(name)?;
        self.take(node, &Key::root().key(name))
    }

    fn items<T: DeserializeOwned>(&mut self, name: &str) -> Vec<Placed<T>> {
        let key = Key::root().key(name);
        let items = self.root.get(name).map(Node::items).unwrap_or_default();
        let take = |(index, node)| {
            let key = key.index(index);
            self.take(node, &key).map(|value| Placed { key, number: index, value })
        };
        items.iter().enumerate().filter_map(take).collect()
    }

    fn take<T: DeserializeOwned>(&mut self, node: &Node, key: &Key) -> Option<T> {
        // What lies inside of a key follows it in the order of keys.
        if self.dirty.range(key..).next().is_some_and(|found| key.holds(found)) {
            return None;
        }
        match serde_json::from_value(node.to_json()) {
            Ok(value) => Some(value),
            Err(error) => {
                self.diagnostics.at(node.span, key, error.to_string(), "see the scene reference");
                None
            }
        }
    }
}
