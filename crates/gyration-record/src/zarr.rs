//! The `zarr.json` files of Zarr v3 as types of their own, and the one codec that needs code.
//!
//! Only what recordings use is here: regular chunks, little-endian numbers, texts in `vlen-utf8`, the checksum `crc32c`
//! behind a chunk, inline consolidated metadata. Source: Zarr core specification version 3.0; `consolidated_metadata`
//! as zarr-python 3 writes it.

use crate::Attributes;
use crate::array::{ArrayInfo, DataType};
use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use serde_json::value::RawValue;
use std::collections::BTreeMap;

/// The `zarr.json` of one array.
pub(crate) fn array_json(array: &ArrayInfo) -> Vec<u8> {
    json(&ZarrArray::of(array))
}

/// What a group's file ends with.
const END: &str = "\n}\n";

/// How far what an attribute holds stands from the left.
const INDENT: usize = 4;
/// What is longer than that stands on several lines.
const LINE: usize = 120;

/// The value of an attribute as text that is indented as it stands in the `zarr.json` of a recording.
///
/// # Errors
/// None of a value.
pub(crate) fn attribute_text(value: &Value) -> serde_json::Result<Box<RawValue>> {
    RawValue::from_string(indented(value, INDENT))
}

/// A value as text, lists and objects that are short on one line.
fn indented(value: &Value, indent: usize) -> String {
    let within = indent + 2;
    let (parts, [open, close]): (Vec<String>, _) = match value {
        Value::Array(items) => (items.iter().map(|item| indented(item, within)).collect(), ["[", "]"]),
        Value::Object(items) => {
            let entry =
                |(key, item): (&String, &Value)| format!("{}: {}", Value::from(key.as_str()), indented(item, within));
            (items.iter().map(entry).collect(), ["{", "}"])
        }
        scalar => return scalar.to_string(),
    };
    let length = parts.iter().map(|part| part.len() + 2).sum::<usize>();
    if indent + length <= LINE && !parts.iter().any(|part| part.contains('\n')) {
        return format!("{open}{}{close}", parts.join(", "));
    }
    let [line, last] = [within, indent].map(|indent| format!("\n{}", " ".repeat(indent)));
    format!("{open}{line}{}{last}{close}", parts.join(&format!(",{line}")))
}

/// The `zarr.json` of a whole recording up to the end of its attributes, which stand in alphabetical order, whatever
/// order they were set in.
pub(crate) fn group_head<'a>(attributes: impl Iterator<Item = (&'a str, &'a RawValue)>) -> Vec<u8> {
    let attributes: BTreeMap<_, _> = attributes.collect();
    let mut text = json(&ZarrGroup::<_, ()> { attributes, ..ZarrGroup::empty() });
    text.truncate(text.len() - END.len());
    text
}

/// What follows them: the metadata of the arrays.
pub(crate) fn group_tail(arrays: &[ArrayInfo], subgroup: Option<&str>) -> Vec<u8> {
    let arrays = arrays.iter().map(|array| (array.name.clone(), Node::Array(Box::new(ZarrArray::of(array)))));
    let subgroup = subgroup.map(|name| (name.to_owned(), Node::Group(ZarrGroup::empty())));
    let metadata = Some(Consolidated::of(arrays.chain(subgroup).collect()));
    let mut text = json(&ZarrGroup { consolidated_metadata: metadata, ..ZarrGroup::<NoAttributes, _>::empty() });
    text.drain(..group_head(std::iter::empty()).len());
    text
}

/// The `zarr.json` of a group within a recording, with the metadata of its arrays.
pub(crate) fn subgroup_json(name: &str, arrays: &[ArrayInfo]) -> Vec<u8> {
    let within = |array: &ArrayInfo| {
        let own = array.name.strip_prefix(name)?.strip_prefix('/')?;
        Some((own.to_owned(), Node::Array(Box::new(ZarrArray::of(array)))))
    };
    let metadata = arrays.iter().filter_map(within).collect();
    json(&ZarrGroup {
        consolidated_metadata: Some(Consolidated::of(metadata)),
        ..ZarrGroup::<NoAttributes, _>::empty()
    })
}

/// The `zarr.json` of the group that holds the state: it keeps readers from wondering about its files.
pub(crate) fn state_json() -> Vec<u8> {
    json(&ZarrGroup::<NoAttributes, ()>::empty())
}

/// Numbers in Zarr's `bytes`, little-endian.
pub(crate) fn encode_numbers(values: &[f64]) -> Vec<u8> {
    values.iter().flat_map(|value| value.to_le_bytes()).collect()
}

/// Labels in Zarr's `vlen-utf8`: count, then length and bytes of each, lengths in little-endian u32.
pub(crate) fn encode_labels(labels: &[String]) -> Vec<u8> {
    let length = |len: usize| u32::try_from(len).unwrap_or(u32::MAX).to_le_bytes();
    let mut bytes = length(labels.len()).to_vec();
    for label in labels {
        bytes.extend(length(label.len()));
        bytes.extend(label.as_bytes());
    }
    bytes
}

/// Reads `vlen-utf8`; none if the bytes are not that.
pub(crate) fn decode_labels(bytes: &[u8]) -> Option<Vec<String>> {
    let (count, mut rest) = bytes.split_first_chunk::<4>()?;
    let mut labels = Vec::new();
    for _ in 0..u32::from_le_bytes(*count) {
        let (length, tail) = rest.split_first_chunk::<4>()?;
        let (label, tail) = tail.split_at_checked(u32::from_le_bytes(*length) as usize)?;
        labels.push(String::from_utf8(label.to_vec()).ok()?);
        rest = tail;
    }
    rest.is_empty().then_some(labels)
}

fn json(value: &impl Serialize) -> Vec<u8> {
    // Only maps with keys that are not strings can fail, and there are none.
    let mut bytes = serde_json::to_vec_pretty(value).unwrap_or_default();
    bytes.push(b'\n');
    bytes
}

#[derive(Deserialize)]
pub(crate) struct Marker {
    #[serde(default)]
    pub(crate) attributes: Attributes,
}

/// The attributes are borrowed to write them; `Marker` reads them.
#[derive(Serialize, Deserialize)]
pub(crate) struct ZarrGroup<A = IgnoredAny, N = Value> {
    zarr_format: u8,
    node_type: String,
    attributes: A,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) consolidated_metadata: Option<Consolidated<N>>,
}

#[derive(Serialize, Deserialize)]
pub(crate) struct Consolidated<N> {
    kind: String,
    must_understand: bool,
    pub(crate) metadata: BTreeMap<String, N>,
}

/// The attributes of a group that has none.
type NoAttributes = BTreeMap<String, ()>;

/// What a group holds.
#[derive(Serialize)]
#[serde(untagged)]
enum Node {
    Array(Box<ZarrArray>),
    Group(ZarrGroup<NoAttributes, ()>),
}

/// An array of consolidated metadata; none of a group.
///
/// # Errors
/// In words, where it is neither.
pub(crate) fn array_of(node: Value) -> Result<Option<ZarrArray>, String> {
    match node.get("node_type").and_then(Value::as_str) {
        Some("group") => Ok(None),
        _ => serde_json::from_value(node).map(Some).map_err(|error| error.to_string()),
    }
}

#[derive(Serialize, Deserialize)]
pub(crate) struct ZarrArray {
    zarr_format: u8,
    node_type: String,
    shape: Vec<usize>,
    data_type: DataType,
    chunk_grid: Named<ChunkGrid>,
    chunk_key_encoding: Named<KeyEncoding>,
    fill_value: Value,
    codecs: Vec<Codec>,
    #[serde(default)]
    attributes: ArrayAttributes,
    dimension_names: Vec<String>,
}

#[derive(Serialize, Deserialize)]
struct Named<C> {
    name: String,
    configuration: C,
}

#[derive(Serialize, Deserialize)]
struct ChunkGrid {
    chunk_shape: Vec<usize>,
}

#[derive(Serialize, Deserialize)]
struct KeyEncoding {
    separator: String,
}

/// What is done to the elements of a chunk, one after the other.
#[derive(PartialEq, Serialize, Deserialize)]
#[serde(tag = "name", content = "configuration")]
enum Codec {
    #[serde(rename = "bytes")]
    Bytes { endian: Endian },
    #[serde(rename = "vlen-utf8")]
    Texts {},
    #[serde(rename = "crc32c")]
    Checksum,
}

#[derive(PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Endian {
    Little,
}

/// By the CF conventions, which xarray's users know.
#[derive(Default, Serialize, Deserialize)]
#[serde(default)]
struct ArrayAttributes {
    #[serde(skip_serializing_if = "String::is_empty")]
    units: String,
    #[serde(skip_serializing_if = "String::is_empty")]
    long_name: String,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    flag_values: Vec<i32>,
    #[serde(skip_serializing_if = "String::is_empty")]
    flag_meanings: String,
}

/// How recordings store elements of a type.
fn codecs(data_type: DataType, is_checked: bool) -> Vec<Codec> {
    let plain = if data_type == DataType::String { Codec::Texts {} } else { Codec::Bytes { endian: Endian::Little } };
    std::iter::once(plain).chain(is_checked.then_some(Codec::Checksum)).collect()
}

impl<N> Consolidated<N> {
    fn of(metadata: BTreeMap<String, N>) -> Self {
        Self { kind: "inline".into(), must_understand: false, metadata }
    }
}

impl<A: Default, N> ZarrGroup<A, N> {
    fn empty() -> Self {
        Self { zarr_format: 3, node_type: "group".into(), attributes: A::default(), consolidated_metadata: None }
    }
}

impl ZarrArray {
    pub(crate) fn of(array: &ArrayInfo) -> Self {
        Self {
            zarr_format: 3,
            node_type: "array".into(),
            shape: array.shape.clone(),
            data_type: array.data_type,
            chunk_grid: Named { name: "regular".into(), configuration: ChunkGrid { chunk_shape: array.chunk.clone() } },
            // A point as separator: a chunk is a file, not a path of directories.
            chunk_key_encoding: Named { name: "default".into(), configuration: KeyEncoding { separator: ".".into() } },
            fill_value: array.data_type.fill(),
            codecs: codecs(array.data_type, array.is_checked),
            attributes: ArrayAttributes {
                units: array.units.clone(),
                long_name: array.description.clone(),
                flag_values: (0..).take(array.meanings.len()).collect(),
                flag_meanings: array.meanings.join(" "),
            },
            dimension_names: array.dims.clone(),
        }
    }

    /// The array described; an error says what is strange.
    pub(crate) fn info(self, name: String) -> Result<ArrayInfo, String> {
        let is_checked = self.codecs.contains(&Codec::Checksum);
        if self.codecs != codecs(self.data_type, is_checked) {
            return Err(format!("the array `{}` is stored in another way than recordings are", name.escape_debug()));
        }
        let (shape, chunk) = (self.shape, self.chunk_grid.configuration.chunk_shape);
        let bytes = chunk.iter().try_fold(8_usize, |bytes, size| bytes.checked_mul(*size));
        let fits = bytes.is_some() && shape.len() == chunk.len() && shape.len() == self.dimension_names.len();
        if !fits || chunk.contains(&0) || chunk.get(1..) != shape.get(1..) {
            return Err(format!(
                "the shape {shape:?} and the chunks {chunk:?} of `{}` do not fit",
                name.escape_debug()
            ));
        }
        Ok(ArrayInfo {
            name,
            dims: self.dimension_names,
            shape,
            chunk,
            units: self.attributes.units,
            description: self.attributes.long_name,
            meanings: self.attributes.flag_meanings.split_whitespace().map(String::from).collect(),
            data_type: self.data_type,
            is_checked,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn head_and_tail_are_the_whole_file() {
        let attributes = serde_json::json!({ "title": "a\n}\n", "bodies": [1, { "name": "b" }], "empty": {} });
        let named = || attributes.as_object().unwrap().iter().map(|(name, value)| (name.as_str(), value));
        let arrays =
            [ArrayInfo::growing("time", "time", 7, "s", "time"), ArrayInfo::growing("time", "pairs/force", 7, "N", "")];
        for attributes in [named().collect::<BTreeMap<_, _>>(), BTreeMap::new()] {
            let node = |array: &ArrayInfo| (array.name.clone(), Node::Array(Box::new(ZarrArray::of(array))));
            let subgroup = ("pairs".to_owned(), Node::Group(ZarrGroup::empty()));
            let metadata = Consolidated::of(arrays.iter().map(node).chain([subgroup]).collect());
            let whole = json(&ZarrGroup {
                attributes: attributes.clone(),
                consolidated_metadata: Some(metadata),
                ..ZarrGroup::empty()
            });
            let texts: BTreeMap<_, _> =
                attributes.into_iter().map(|(name, value)| (name, attribute_text(value).unwrap())).collect();
            let head = group_head(texts.iter().map(|(name, text)| (*name, &**text)));
            let parts = [head, group_tail(&arrays, Some("pairs"))].concat();
            let value = |text: &[u8]| serde_json::from_slice::<Value>(text).unwrap();
            assert_eq!(value(&parts), value(&whole), "{}", String::from_utf8_lossy(&parts));
        }
    }

    #[test]
    fn labels_survive_and_damaged_ones_are_told() {
        let labels = ["die", "", "käse"].map(String::from).to_vec();
        let bytes = encode_labels(&labels);
        assert_eq!(decode_labels(&bytes), Some(labels));
        for end in 0..bytes.len() {
            assert_eq!(decode_labels(&bytes[..end]), None, "cut at {end}");
        }
    }
}
