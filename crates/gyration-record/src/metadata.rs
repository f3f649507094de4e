//! The Zarr v3 metadata of a recording: which arrays there are, how long they are, and the attributes.
//!
//! The group's `zarr.json` holds the attributes and, as consolidated metadata, those of every array; it is replaced as
//! one file, so that a reader sees all arrays at one length. What this crate needs beside Zarr stands in the group's
//! attributes: `record_format`, `record_arrays` (the growing arrays in the order of a row), `record_columns` (see
//! `columns`) and `record_checksum` (CRC-32C of this file with zeros in its place). Keys are written in a fixed order.
//! Recordings of earlier versions have no checksum.

use crate::Attributes;
use crate::array::{ArrayInfo, DataType};
use crate::columns::{self, Column, ColumnFault};
use crate::error::RecordError;
use crate::layout::{BOUNDARY, ENTRY, Layout, Ragged, RaggedArray, START};
use crate::names::{METADATA, is_name, is_path, is_word};
use crate::zarr::{Marker, ZarrGroup, array_of, attribute_text, group_head, group_tail};
use gyration_files::check;
use serde_json::Value;
use serde_json::value::RawValue;
use std::collections::BTreeMap;
use std::path::Path;

/// The version of the format that this crate writes; it reads those before it too. In the first all columns are texts.
pub(crate) const FORMAT: u64 = 2;
/// The attribute with the columns of the CSV.
const COLUMNS: &str = "record_columns";
/// Rows in a chunk of the events, for each of those whom they may befall.
const EVENT_CHUNK_ROWS: usize = 256;
/// Rows in a chunk of the events at most.
const MOST_EVENT_CHUNK_ROWS: usize = 1 << 16;
/// The attribute with the checksum of the metadata.
const CHECKSUM: &str = "record_checksum";
/// What stands before that checksum in the file, among the attributes and nowhere else: quotes within a text are
/// escaped.
const CHECKSUM_PLACE: &str = "\n    \"record_checksum\": \"";

/// The whole metadata of a recording.
#[derive(Debug, Clone)]
pub(crate) struct Group<A = Attributes> {
    pub(crate) attributes: A,
    /// The growing arrays in the order of a row, `time` first; the events; the fixed arrays and labels.
    pub(crate) arrays: Vec<ArrayInfo>,
}

/// Attributes as text: what a writer keeps, a quarter of what they take as values.
pub(crate) type AttributeTexts = BTreeMap<String, Box<RawValue>>;

impl Group {
    /// The metadata of a new recording.
    pub(crate) fn new(layout: &Layout, mut attributes: Attributes) -> Result<Self, RecordError> {
        check_attributes(&attributes)?;
        let columns = columns::written(&layout.columns()?, layout)
            .map_err(|error| RecordError::layout(format!("the columns: {error}")))?;
        let mut arrays = vec![ArrayInfo::growing("time", "time", layout.chunk_rows, "s", "time")];
        arrays.extend(layout.arrays.iter().map(|spec| ArrayInfo::of(spec, Some(("time", layout.chunk_rows)))));
        if !layout.event_kinds.is_empty() {
            let named = layout.labels.iter().map(|(_, labels)| labels.len()).max().unwrap_or(1).max(1);
            let rows = EVENT_CHUNK_ROWS.saturating_mul(named.next_power_of_two()).min(MOST_EVENT_CHUNK_ROWS);
            let event = |name, units, description| ArrayInfo::growing(name, "event", rows, units, description);
            let code = |array| ArrayInfo { data_type: DataType::Int32, ..array };
            arrays.push(event("event_time", "s", "time of the event"));
            arrays.push(ArrayInfo {
                meanings: layout.event_kinds.clone(),
                ..code(event("event_kind", "", "kind of the event"))
            });
            arrays.push(code(event("event_body", "", "index of the body, -1 for none")));
        }
        if let Some(ragged) = &layout.ragged {
            arrays.extend(ragged_arrays(ragged, layout.chunk_rows));
        }
        let order = arrays.iter().map(|array| Value::from(array.name.clone())).collect::<Vec<_>>();
        arrays.extend(layout.fixed.iter().map(|fixed| ArrayInfo::of(&fixed.spec, None)));
        arrays.extend(layout.labels.iter().map(|(dim, labels)| ArrayInfo::labels(dim, labels.len())));
        attributes.insert("record_format".into(), FORMAT.into());
        attributes.insert("record_arrays".into(), order.into());
        attributes.insert(COLUMNS.into(), columns);
        Ok(Self { attributes, arrays })
    }

    /// With attributes as text.
    ///
    /// # Errors
    /// `Layout` for an attribute that is no JSON, of which there is none.
    pub(crate) fn into_texts(self) -> Result<Group<AttributeTexts>, RecordError> {
        Ok(Group {
            attributes: self.attributes.into_iter().map(as_text).collect::<Result<_, _>>()?,
            arrays: self.arrays,
        })
    }

    /// Reads the group's `zarr.json`.
    pub(crate) fn from_json(path: &Path, bytes: &[u8]) -> Result<Self, RecordError> {
        let no = |reason: String| RecordError::NotARecording { path: path.to_path_buf(), reason };
        // Attributes first: another format may differ in all the rest.
        let mut marker: Marker = serde_json::from_slice(bytes).map_err(|e| no(format!("zarr.json: {e}")))?;
        match marker.attributes.get("record_format").and_then(Value::as_u64) {
            None => return Err(no("zarr.json has no attribute `record_format`".into())),
            Some(1..=FORMAT) => {}
            Some(found) => return Err(RecordError::Version { path: path.to_path_buf(), found, supported: FORMAT }),
        }
        let group: ZarrGroup = serde_json::from_slice(bytes).map_err(|e| no(format!("zarr.json: {e}")))?;
        let mut found = BTreeMap::new();
        for (name, node) in group.consolidated_metadata.map(|c| c.metadata).unwrap_or_default() {
            let array = array_of(node).map_err(|e| no(format!("zarr.json: `{}`: {e}", name.escape_debug())))?;
            found.extend(array.map(|array| (name, array)));
        }
        let order = marker.attributes.get("record_arrays").and_then(Value::as_array);
        let ordered = order.into_iter().flatten().filter_map(Value::as_str).map(String::from);
        let names = ordered.collect::<Vec<_>>();
        let mut arrays = Vec::new();
        for name in names {
            let array = found
                .remove(&name)
                .ok_or_else(|| no(format!("zarr.json lacks the array `{}`", name.escape_debug())))?;
            arrays.push(array.info(name).map_err(no)?);
        }
        for (name, array) in found {
            arrays.push(array.info(name).map_err(no)?);
        }
        if arrays.first().is_none_or(|array| !array.grows_with("time")) {
            return Err(no("zarr.json does not begin with the array `time`".into()));
        }
        let checksum = marker.attributes.remove(CHECKSUM);
        let group = Self { attributes: marker.attributes, arrays };
        check_names(&group).map_err(no)?;
        if checksum.is_some() && check::is_sealed(bytes, CHECKSUM_PLACE) != Some(true) {
            let file = path.join(METADATA);
            let reason = format!(
                "it does not match its checksum; take it from a copy or, if you changed it yourself, remove its \
                 attribute {CHECKSUM}"
            );
            return Err(RecordError::corrupt(&file, reason));
        }
        Ok(group)
    }

    /// The CSV columns.
    pub(crate) fn columns(&self) -> Vec<Column> {
        columns::read(self.attributes.get(COLUMNS), &self.arrays)
    }
}

impl<A> Group<A> {
    /// The name of the ragged group; none without one.
    pub(crate) fn ragged(&self) -> Option<&str> {
        self.arrays.iter().find(|array| array.grows_with(BOUNDARY))?.name.strip_suffix("/start")
    }

    /// Rows along a growing dimension; none if nothing grows along it.
    pub(crate) fn rows(&self, dim: &str) -> Option<usize> {
        self.arrays.iter().find(|array| array.grows_with(dim)).map(|array| array.shape[0])
    }

    /// Sets the rows along a growing dimension.
    pub(crate) fn set_rows(&mut self, dim: &str, rows: usize) {
        for array in self.arrays.iter_mut().filter(|array| array.grows_with(dim)) {
            array.shape[0] = rows;
        }
    }
}

/// Metadata as they are written.
impl Group<AttributeTexts> {
    /// The group's `zarr.json`.
    pub(crate) fn to_json(&self) -> Result<Vec<u8>, RecordError> {
        let (_, place) = as_text((CHECKSUM.into(), check::UNKNOWN.into()))?;
        let attributes = self.attributes.iter().map(|(name, text)| (name.as_str(), &**text));
        let mut text = group_head(attributes.chain([(CHECKSUM, &*place)]));
        text.extend(group_tail(&self.arrays, self.ragged()));
        check::seal(&mut text, CHECKSUM_PLACE);
        Ok(text)
    }

    /// Sets attributes; a null removes one.
    pub(crate) fn patch(&mut self, patch: Attributes) -> Result<(), RecordError> {
        check_attributes(&patch)?;
        for (name, value) in patch {
            self.attributes.remove(&name);
            if !value.is_null() {
                self.attributes.extend([as_text((name, value))?]);
            }
        }
        Ok(())
    }
}

/// An attribute with its value as text.
fn as_text((name, value): (String, Value)) -> Result<(String, Box<RawValue>), RecordError> {
    let text =
        attribute_text(&value).map_err(|error| RecordError::layout(format!("the attribute `{name}`: {error}")))?;
    Ok((name, text))
}

/// The arrays of a ragged group: where the entries of each sample begin, and these.
fn ragged_arrays(ragged: &Ragged, chunk_rows: usize) -> impl Iterator<Item = ArrayInfo> {
    let named = |name: &str| format!("{}/{name}", ragged.name);
    let start = ArrayInfo::growing(&named(START), BOUNDARY, chunk_rows, "", "entry with which each sample begins");
    let start = ArrayInfo { data_type: DataType::Int32, ..start };
    let array = move |array: &RaggedArray| {
        let mut info = ArrayInfo::of(&array.spec, Some((ENTRY, ragged.chunk_entries)));
        info.name = named(&array.spec.name);
        if let Some(codes) = &array.codes {
            (info.data_type, info.meanings) = (DataType::Int32, codes.clone());
        }
        info
    };
    std::iter::once(start).chain(ragged.arrays.iter().map(array))
}

/// Refuses the names that this crate uses itself.
fn check_attributes(attributes: &Attributes) -> Result<(), RecordError> {
    match attributes.keys().find(|name| name.starts_with("record_")) {
        Some(name) => Err(RecordError::layout(format!("the attribute `{name}` has a reserved name"))),
        None => Ok(()),
    }
}

/// Checks all names of a recording that somebody else may have written.
///
/// # Errors
/// In words: the first name that is none, and what is allowed.
fn check_names(group: &Group) -> Result<(), String> {
    let refuse = |what: &str, name: &str, allowed: &str| {
        Err(format!("zarr.json names {what} `{}`; allowed are {allowed}", name.escape_debug()))
    };
    for array in &group.arrays {
        if !is_path(&array.name) {
            return refuse("the array", &array.name, "letters, digits and _, no digit first, and not `state`");
        }
        if let Some(dim) = array.dims.iter().find(|dim| !is_name(dim)) {
            return refuse("the dimension", dim, "letters, digits and _, no digit first");
        }
        if let Some(kind) = array.meanings.iter().find(|kind| !is_word(kind)) {
            return refuse("the kind of event", kind, "letters, digits and _");
        }
    }
    columns::check(group.attributes.get(COLUMNS), &group.arrays).or_else(|fault| match fault {
        ColumnFault::Name(name) => refuse("the column", &name, "letters, digits, _, - and points"),
        ColumnFault::TooMany => Err("zarr.json names more columns than a row has numbers".into()),
        ColumnFault::Place(text) => {
            Err(format!("zarr.json names the column `{}`, and no array has that place", text.escape_debug()))
        }
        ColumnFault::Unreadable => Err(format!("zarr.json has no list of columns, `{COLUMNS}`, or one that is none")),
    })
}
