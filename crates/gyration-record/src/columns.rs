//! The columns of the CSV as the metadata name them, `record_columns`: a list in the order of the CSV.
//!
//! An entry is a text, `NAME = ARRAY[INDEX]`, or what labels of the first dimension of arrays have alike:
//!
//!   { "labels": ["a", "b"], "first": 4, "columns": ["x = position[0]", "y = position[1]"] }
//!
//! is short for `a.x = position[12]`, `a.y = position[13]`, `b.x = position[15]`, `b.y = position[16]` where each label
//! has three numbers in `position` and "a" is the fifth of them. Of a crowd the texts would be half of the metadata.

use crate::array::ArrayInfo;
use crate::layout::{ArraySpec, Layout};
use crate::names::is_column;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::HashMap;

/// A column: its name, its array, its place in a row of it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Column {
    pub(crate) name: String,
    pub(crate) array: String,
    pub(crate) index: usize,
}

/// Columns that follow one another.
#[derive(Debug, Serialize, Deserialize)]
#[serde(untagged)]
enum Entry {
    One(String),
    Alike(Alike),
}

/// Those of labels that have the same.
#[derive(Debug, Serialize, Deserialize)]
struct Alike {
    labels: Vec<String>,
    /// The place of the first of them among all.
    first: usize,
    /// Those of each, `NAME = ARRAY[INDEX]`: the index is one among the numbers of a label.
    columns: Vec<String>,
}

/// A column that belongs to a label.
#[derive(Clone, Copy)]
struct Labelled<'a> {
    dim: &'a str,
    label: &'a str,
    /// Of the label among all.
    place: usize,
    /// Its name behind that of the label, its array, and its place among the numbers of the label.
    own: (&'a str, &'a str, usize),
}

/// Which columns of a layout belong to labels.
struct Labels<'a> {
    arrays: HashMap<&'a str, &'a ArraySpec>,
    dims: HashMap<&'a str, &'a [String]>,
}

impl<'a> Labels<'a> {
    fn of(layout: &'a Layout) -> Self {
        Self {
            arrays: layout.arrays.iter().map(|spec| (spec.name.as_str(), spec)).collect(),
            dims: layout.labels.iter().map(|(dim, labels)| (dim.as_str(), labels.as_slice())).collect(),
        }
    }

    fn labelled(&self, (name, array, index): (&'a str, &'a str, usize)) -> Option<Labelled<'a>> {
        let spec = self.arrays.get(array)?;
        let dim = spec.dims.first()?;
        let each = spec.row_len() / dim.size;
        let place = index / each;
        let label = self.dims.get(dim.name.as_str())?.get(place)?;
        let own = (name.strip_prefix(label.as_str())?.strip_prefix('.')?, array, index % each);
        Some(Labelled { dim: &dim.name, label, place, own })
    }

    /// The columns at the beginning of these that belong to one label.
    fn block(&self, columns: &[(&'a str, &'a str, usize)]) -> Vec<Labelled<'a>> {
        let mut found: Vec<Labelled<'a>> = Vec::new();
        for labelled in columns.iter().map_while(|column| self.labelled(*column)) {
            if found.first().is_some_and(|first| (first.dim, first.place) != (labelled.dim, labelled.place)) {
                break;
            }
            found.push(labelled);
        }
        found
    }
}

/// The columns of a layout, given in the order of the CSV as name, array and place.
///
/// # Errors
/// None of texts and numbers.
pub(crate) fn written(mut columns: &[(&str, &str, usize)], layout: &Layout) -> serde_json::Result<Value> {
    let labels = Labels::of(layout);
    let text = |(name, array, index): (&str, &str, usize)| format!("{name} = {array}[{index}]");
    let mut entries = Vec::new();
    while let Some(column) = columns.first() {
        let block = labels.block(columns);
        let Some(first) = block.first() else {
            entries.push(Entry::One(text(*column)));
            columns = &columns[1..];
            continue;
        };
        let own = |block: &[Labelled<'_>]| block.iter().map(|labelled| text(labelled.own)).collect::<Vec<_>>();
        let mut alike = Alike { labels: vec![first.label.into()], first: first.place, columns: own(&block) };
        columns = &columns[block.len()..];
        loop {
            let next = labels.block(columns);
            let follows = |next: &Labelled<'_>| (next.dim, next.place) == (first.dim, first.place + alike.labels.len());
            let is_alike = next.iter().map(|labelled| labelled.own).eq(block.iter().map(|labelled| labelled.own));
            match next.first().filter(|next| follows(next) && is_alike) {
                Some(labelled) => alike.labels.push(labelled.label.into()),
                None => break,
            }
            columns = &columns[next.len()..];
        }
        entries.push(Entry::Alike(alike));
    }
    serde_json::to_value(entries)
}

/// The columns that an attribute names, as far as it does.
pub(crate) fn read(attribute: Option<&Value>, arrays: &[ArrayInfo]) -> Vec<Column> {
    let arrays: HashMap<&str, &ArrayInfo> = arrays.iter().map(|array| (array.name.as_str(), array)).collect();
    let mut columns = Vec::new();
    for entry in entries(attribute) {
        match entry {
            Entry::One(text) => columns.extend(parsed(&text).map(|(name, array, index)| Column {
                name: name.into(),
                array: array.into(),
                index,
            })),
            Entry::Alike(alike) => {
                let own: Vec<_> = alike.columns.iter().filter_map(|text| parsed(text)).collect();
                for (nth, label) in alike.labels.iter().enumerate() {
                    columns.extend(own.iter().filter_map(|(name, array, index)| {
                        let info = arrays.get(array)?;
                        let each = info.row_len().checked_div(*info.shape.get(1)?)?;
                        let index = alike.first.checked_add(nth)?.checked_mul(each)?.checked_add(*index)?;
                        Some(Column { name: format!("{label}.{name}"), array: (*array).into(), index })
                    }));
                }
            }
        }
    }
    columns
}

/// What is wrong with the columns that an attribute names.
pub(crate) enum ColumnFault {
    /// They are no list of entries.
    Unreadable,
    /// A name that is none.
    Name(String),
    /// A place that no array has, as it is written.
    Place(String),
    /// More than a row has numbers.
    TooMany,
}

/// Checks what somebody else may have written.
///
/// # Errors
/// [`ColumnFault`]
pub(crate) fn check(attribute: Option<&Value>, arrays: &[ArrayInfo]) -> Result<(), ColumnFault> {
    let written = attribute.and_then(Value::as_array).ok_or(ColumnFault::Unreadable)?;
    let growing = arrays.iter().filter(|array| array.grows_with("time"));
    let numbers: HashMap<&str, &ArrayInfo> = growing.map(|array| (array.name.as_str(), array)).collect();
    let mut left = numbers.values().map(|array| array.row_len()).fold(0_usize, usize::saturating_add);
    for entry in written {
        let entry = Entry::deserialize(entry).map_err(|_| ColumnFault::Unreadable)?;
        let (labels, first, columns) = match entry {
            Entry::One(text) => (None, 0, vec![text]),
            Entry::Alike(alike) => (Some(alike.labels), alike.first, alike.columns),
        };
        let count = labels.as_ref().map_or(1, Vec::len);
        left = left.checked_sub(count.saturating_mul(columns.len())).ok_or(ColumnFault::TooMany)?;
        if let Some(label) = labels.iter().flatten().find(|label| !is_column(label)) {
            return Err(ColumnFault::Name(label.clone()));
        }
        for text in columns {
            let (name, array, index) = parsed(&text).ok_or_else(|| ColumnFault::Place(text.clone()))?;
            if !is_column(name) {
                return Err(ColumnFault::Name(name.into()));
            }
            let has_place = |array: &ArrayInfo| match &labels {
                None => index < array.row_len(),
                Some(_) => {
                    let of_dim = array.shape.get(1).copied().unwrap_or(0);
                    let end = first.checked_add(count);
                    end.is_some_and(|end| end <= of_dim) && index < array.row_len().checked_div(of_dim).unwrap_or(0)
                }
            };
            if !numbers.get(array).is_some_and(|array| has_place(array)) {
                return Err(ColumnFault::Place(text));
            }
        }
    }
    Ok(())
}

fn entries(attribute: Option<&Value>) -> impl Iterator<Item = Entry> {
    attribute.and_then(Value::as_array).into_iter().flatten().filter_map(|entry| Entry::deserialize(entry).ok())
}

/// Name, array and index of `NAME = ARRAY[INDEX]`.
fn parsed(text: &str) -> Option<(&str, &str, usize)> {
    let (name, place) = text.split_once(" = ")?;
    let (array, index) = place.strip_suffix(']')?.split_once('[')?;
    Some((name, array, index.parse().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::layout::Dimension;

    /// Bodies of which "c.d" has no pressure, in an order that leaves out the first; a number without a label.
    fn layout() -> Layout {
        let array = |name: &str, dims: &[(&str, usize)], columns: &[&str]| ArraySpec {
            name: name.into(),
            dims: dims.iter().map(|(name, size)| Dimension::new(*name, *size)).collect(),
            columns: columns.iter().map(|column| column.to_string()).collect(),
            ..ArraySpec::default()
        };
        let position = ["a.x", "a.y", "b.x", "b.y", "c.d.x", "c.d.y", "e.x", "e.y"];
        Layout {
            arrays: vec![
                array("position", &[("body", 4), ("col", 2)], &position),
                array("pressure", &[("body", 4)], &["a.p", "b.p", "", "e.p"]),
                array("energy", &[], &["energy"]),
                // No label of its own, though it sounds like one.
                array("sum", &[], &["a.sum"]),
            ],
            labels: vec![("body".into(), ["a", "b", "c.d", "e"].map(String::from).into())],
            csv_order: "b.x b.y b.p c.d.x c.d.y energy a.x a.y a.p a.sum e.x e.y e.p"
                .split(' ')
                .map(String::from)
                .collect(),
            chunk_rows: 4,
            ..Layout::default()
        }
    }

    fn arrays(layout: &Layout) -> Vec<ArrayInfo> {
        layout.arrays.iter().map(|spec| ArrayInfo::of(spec, Some(("time", 4)))).collect()
    }

    #[test]
    fn columns_are_read_as_they_were_written() {
        let layout = layout();
        layout.check().unwrap();
        let columns = layout.columns().unwrap();
        let attribute = written(&columns, &layout).unwrap();
        let found = read(Some(&attribute), &arrays(&layout));
        let found: Vec<_> =
            found.iter().map(|column| (column.name.as_str(), column.array.as_str(), column.index)).collect();
        assert_eq!(found, columns, "{attribute:#}");
        assert!(check(Some(&attribute), &arrays(&layout)).is_ok());
        // As format 1 has them.
        let texts: Vec<String> =
            columns.iter().map(|(name, array, index)| format!("{name} = {array}[{index}]")).collect();
        let old = read(Some(&texts.into()), &arrays(&layout));
        assert_eq!(old, read(Some(&attribute), &arrays(&layout)));
    }

    #[test]
    fn a_thousand_that_are_alike_take_one_entry() {
        let labels: Vec<String> = (0..1000).map(|k| format!("b{k}")).collect();
        let columns: Vec<String> =
            labels.iter().flat_map(|label| ["x", "y"].map(|axis| format!("{label}.{axis}"))).collect();
        let position = ArraySpec {
            name: "position".into(),
            dims: vec![Dimension::new("body", 1000), Dimension::new("col", 2)],
            columns: columns.clone(),
            ..ArraySpec::default()
        };
        let labels = vec![("body".into(), labels)];
        let layout = Layout { arrays: vec![position], labels, csv_order: columns, chunk_rows: 1, ..Layout::default() };
        let attribute = written(&layout.columns().unwrap(), &layout).unwrap();
        assert_eq!(attribute.as_array().unwrap().len(), 1);
        assert_eq!(read(Some(&attribute), &arrays(&layout))[1999].index, 1999);
    }

    #[test]
    fn more_columns_than_numbers_are_refused() {
        let many =
            serde_json::json!([{ "labels": vec!["b"; 100], "first": 0, "columns": vec!["x = position[0]"; 100] }]);
        assert!(matches!(check(Some(&many), &arrays(&layout())), Err(ColumnFault::TooMany)));
        let foreign = serde_json::json!([{ "labels": ["a,"], "first": usize::MAX, "columns": ["x = position[1]"] }]);
        assert!(matches!(check(Some(&foreign), &arrays(&layout())), Err(ColumnFault::Name(name)) if name == "a,"));
        assert!(read(Some(&foreign), &arrays(&layout())).is_empty());
    }

    /// Symptom: an export ended in a panic, or lacked columns.
    #[test]
    fn columns_that_are_nowhere_are_refused() {
        let arrays = arrays(&layout());
        let entry =
            |first: usize, text: &str| serde_json::json!([{ "labels": ["a"], "first": first, "columns": [text] }]);
        for (attribute, is_there) in [
            (serde_json::json!(["x = position[7]"]), true),
            (serde_json::json!(["x = position[8]"]), false),
            (serde_json::json!(["x = nothing[0]"]), false),
            (serde_json::json!(["x"]), false),
            (serde_json::json!([17]), false),
            (serde_json::json!("x = position[0]"), false),
            (entry(3, "x = position[1]"), true),
            (entry(4, "x = position[1]"), false),
            (entry(3, "x = position[2]"), false),
            (entry(usize::MAX, "x = position[0]"), false),
            (entry(0, "x = energy[0]"), false),
        ] {
            assert_eq!(check(Some(&attribute), &arrays).is_ok(), is_there, "{attribute}");
        }
        assert!(check(None, &arrays).is_err());
    }
}
