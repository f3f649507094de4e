//! What the page is told before it is given numbers: the scene, the bodies, the arrays, how the run went.
//!
//! A header is JSON. Its attributes are those of a recording; `outcome` is null until the run is over, and what else a
//! finished recording tells of its run stands under `summary`.

use gyration_record::{ArrayInfo, Attributes, Layout, Recording};
use serde_json::{Map, Value, json};
use std::collections::HashMap;

/// The version of what page and program tell each other.
pub const PROTOCOL: u64 = 1;

/// What the page is used for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PageMode {
    /// The data stand in the page itself.
    Report,
    /// A recording on disk, finished or still growing.
    Recording,
    /// A scene that runs as it is watched.
    Live,
}

impl PageMode {
    /// Its name in a header.
    pub fn name(self) -> &'static str {
        match self {
            Self::Report => "report",
            Self::Recording => "recording",
            Self::Live => "live",
        }
    }
}

/// A growing array.
#[derive(Debug, Clone, PartialEq)]
pub struct ArrayEntry {
    /// Its name.
    pub name: String,
    /// Its unit.
    pub units: String,
    /// What it is, in a line.
    pub description: String,
    /// Names and sizes of the dimensions beside time.
    pub dims: Vec<(String, usize)>,
}

impl ArrayEntry {
    /// Numbers in a row.
    pub fn stride(&self) -> usize {
        self.dims.iter().map(|(_, size)| size).product()
    }

    /// Of a growing array of a recording.
    fn of_array(info: &ArrayInfo) -> Self {
        Self {
            name: info.name.clone(),
            units: info.units.clone(),
            description: info.description.clone(),
            dims: info.dims.iter().cloned().zip(info.shape.iter().copied()).skip(1).collect(),
        }
    }
}

/// All that a header is made of.
#[derive(Debug, Clone, PartialEq)]
pub struct Header {
    /// What the page is used for.
    pub mode: PageMode,
    /// Counts the restarts of a live run, or the recordings that stood at a path, from one.
    pub run: u64,
    /// The attributes of the recording.
    pub attributes: Attributes,
    /// The growing arrays in the order of a row.
    pub arrays: Vec<ArrayEntry>,
    /// CSV columns: name, array, place in its row.
    pub columns: Vec<(String, String, usize)>,
    /// Names of the kinds of events, by index.
    pub event_kinds: Vec<String>,
    /// Numbers of points and triangles of each distinct surface.
    pub surfaces: Vec<(usize, usize)>,
    /// Samples there are.
    pub rows: usize,
    /// Whether the network of forces can be had of each.
    pub network: bool,
    /// Samples kept, of how many, where not all are.
    pub thinned: Option<(usize, usize)>,
    /// What else the reader should know.
    pub notes: Vec<String>,
}

/// Attributes that stand in the header under their own names; others are of the summary.
const OWN: [&str; 12] = [
    "title",
    "scene_name",
    "scene",
    "overrides",
    "resolved",
    "version",
    "commit",
    "tolerances",
    "bodies",
    "supports",
    "solid_supports",
    "gravity",
];

/// Points and triangles of each distinct surface, by the sizes of the arrays that hold them.
fn surfaces(size: impl Fn(&str) -> usize) -> Vec<(usize, usize)> {
    let each = (0..).map(|k| (size(&format!("surface_{k}_points")), size(&format!("surface_{k}_triangles"))));
    each.take_while(|(points, _)| *points > 0).collect()
}

impl Header {
    /// The header of a recording on disk.
    pub fn of_recording(recording: &Recording) -> Self {
        let size = |name: &str| recording.array(name).map_or(0, |array| array.shape.first().copied().unwrap_or(0));
        Self {
            mode: PageMode::Recording,
            run: 1,
            attributes: recording.attributes().clone(),
            arrays: recording.growing().map(ArrayEntry::of_array).collect(),
            columns: recording
                .column_places()
                .map(|(name, array, index)| (name.to_owned(), array.to_owned(), index))
                .collect(),
            event_kinds: recording.event_kinds().to_vec(),
            surfaces: surfaces(size),
            rows: recording.rows(),
            network: false,
            thinned: None,
            notes: Vec::new(),
        }
    }

    /// The header of a run that has not begun.
    pub fn of_layout(layout: &Layout, attributes: Attributes, run: u64) -> Self {
        let entry = |spec: &gyration_record::ArraySpec| ArrayEntry {
            name: spec.name.clone(),
            units: spec.units.clone(),
            description: spec.description.clone(),
            dims: spec.dims.iter().map(|dim| (dim.name.clone(), dim.size)).collect(),
        };
        let size = |name: &str| {
            let found = layout.fixed.iter().find(|fixed| fixed.spec.name == name);
            found.and_then(|fixed| fixed.spec.dims.first()).map_or(0, |dim| dim.size)
        };
        let named = |spec: &gyration_record::ArraySpec| {
            let columns = spec.columns.iter().enumerate().filter(|(_, column)| !column.is_empty());
            columns.map(|(index, column)| (column.clone(), spec.name.clone(), index)).collect::<Vec<_>>()
        };
        let mut columns: Vec<_> = layout.arrays.iter().flat_map(named).collect();
        let places: HashMap<&String, usize> = layout.csv_order.iter().zip(0..).collect();
        columns.sort_by_key(|(name, _, _)| places.get(name));
        Self {
            mode: PageMode::Live,
            run,
            attributes,
            arrays: layout.arrays.iter().map(entry).collect(),
            columns,
            event_kinds: layout.event_kinds.clone(),
            surfaces: surfaces(size),
            rows: 0,
            network: false,
            thinned: None,
            notes: Vec::new(),
        }
    }

    /// Whether the run is over.
    pub fn is_complete(&self) -> bool {
        self.attributes.contains_key("outcome")
    }

    /// The header as the page takes it.
    pub fn to_json(&self) -> Value {
        let mut header = Map::new();
        for name in OWN {
            header.insert(name.to_owned(), self.attributes.get(name).cloned().unwrap_or(Value::Null));
        }
        header.insert("bodies".into(), self.bodies());
        header.insert("outcome".into(), self.attributes.get("outcome").cloned().unwrap_or(Value::Null));
        let is_own =
            |name: &str| OWN.contains(&name) || ["outcome", "outlines"].contains(&name) || name.starts_with("record_");
        let summary = self.attributes.iter().filter(|(name, _)| !is_own(name));
        header.insert("summary".into(), Value::Object(summary.map(|(k, v)| (k.clone(), v.clone())).collect()));
        let arrays = self.arrays.iter().map(|array| {
            json!({ "name": array.name, "units": array.units, "description": array.description,
                    "dims": array.dims, "stride": array.stride() })
        });
        let surfaces =
            self.surfaces.iter().map(|(points, triangles)| json!({ "points": points, "triangles": triangles }));
        let end = self.attributes.get("resolved").and_then(|scene| scene.pointer("/time/end"));
        let rest = json!({
            "protocol": PROTOCOL,
            "mode": self.mode.name(),
            "run": self.run,
            "arrays": arrays.collect::<Vec<_>>(),
            "columns": self.columns,
            "event_kinds": self.event_kinds,
            "surfaces": surfaces.collect::<Vec<_>>(),
            "rows": self.rows,
            "network": self.network,
            "end": end,
            "complete": self.is_complete(),
            "thinned": self.thinned.map(|(kept, of)| json!({ "kept": kept, "of": of })),
            "notes": self.notes,
        });
        if let Value::Object(rest) = rest {
            header.extend(rest);
        }
        Value::Object(header)
    }

    /// The bodies without what only drawings on paper need: the silhouette, and the outline of one that has a surface.
    fn bodies(&self) -> Value {
        let mut bodies = self.attributes.get("bodies").and_then(Value::as_array).cloned().unwrap_or_default();
        for body in bodies.iter_mut().filter_map(Value::as_object_mut) {
            body.remove("silhouette");
            let surface = body.entry("surface").or_insert(Value::Null);
            if !surface.is_null() {
                body.remove("outline");
            }
        }
        Value::Array(bodies)
    }
}
