//! What a recording holds: arrays that grow with time, fixed arrays, labels of dimensions, kinds of events, columns.
//!
//! The layout is fixed when a recording is created. A row is the numbers of all growing arrays, one after the other in
//! the order of the layout, each flattened with its last dimension fastest.

use crate::error::RecordError;
use crate::names::{is_column, is_name, is_word};
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// The dimensions along which arrays grow: samples, events, entries of a ragged group, and where those of a sample
/// begin, one more than there are samples.
pub(crate) const GROWING: [&str; 4] = ["time", "event", ENTRY, BOUNDARY];
/// The dimension of the entries of a ragged group.
pub(crate) const ENTRY: &str = "entry";
/// That of where they begin.
pub(crate) const BOUNDARY: &str = "boundary";
/// The array of where they begin.
pub(crate) const START: &str = "start";

/// A dimension of an array beside time.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Dimension {
    /// Name, such as `body`, `row`, `col`.
    pub name: String,
    /// Size, at least 1.
    pub size: usize,
}

impl Dimension {
    /// A dimension of this name and size.
    pub fn new(name: impl Into<String>, size: usize) -> Self {
        Self { name: name.into(), size }
    }
}

/// An array: its name, its dimensions beside time, and what its numbers mean.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct ArraySpec {
    /// Name, `[A-Za-z_][A-Za-z0-9_]*`.
    pub name: String,
    /// Dimensions beside time, slowest first; none for a scalar.
    pub dims: Vec<Dimension>,
    /// Unit, such as `m/s`; `1` for a pure number.
    pub units: String,
    /// One line that says what it is.
    pub description: String,
    /// Name of the CSV column of each component; empty: not in the CSV. No names at all: none is.
    pub columns: Vec<String>,
}

impl ArraySpec {
    /// Numbers in a row of this array: the product of its sizes.
    pub fn row_len(&self) -> usize {
        self.dims.iter().map(|dim| dim.size).product()
    }
}

/// An array without time, written once.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FixedArray {
    /// Name, dimensions and meaning; it has no columns.
    pub spec: ArraySpec,
    /// The values, last dimension fastest.
    pub values: Vec<f64>,
}

/// Entries of which each sample has a number of its own, as arrays in a group of their own.
///
/// Beside the arrays the group has `start`: the entries of sample k are those from `start[k]` to `start[k + 1]`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Ragged {
    /// Name of the group, `[A-Za-z_][A-Za-z0-9_]*`.
    pub name: String,
    /// Its arrays, in the order of an entry.
    pub arrays: Vec<RaggedArray>,
    /// Entries in a chunk file, at least 1.
    pub chunk_entries: usize,
}

/// An array of a ragged group.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RaggedArray {
    /// Name, dimensions beside the entry, meaning; no columns.
    pub spec: ArraySpec,
    /// Names of the values 0, 1, … of whole numbers, none of which may have a name; none: it has real numbers.
    pub codes: Option<Vec<String>>,
}

impl Ragged {
    /// Numbers in an entry.
    pub fn entry_len(&self) -> usize {
        self.arrays.iter().map(|array| array.spec.row_len()).sum()
    }
}

/// All that a recording holds.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Layout {
    /// Arrays that grow with time, in the order of a row. The coordinate `time` comes by itself.
    pub arrays: Vec<ArraySpec>,
    /// Arrays without time.
    pub fixed: Vec<FixedArray>,
    /// Entries of which each sample has a number of its own.
    pub ragged: Option<Ragged>,
    /// Labels of dimensions, such as the names of the bodies: a reader may then select by name.
    pub labels: Vec<(String, Vec<String>)>,
    /// Names of the kinds of events, by code from zero, `[A-Za-z0-9_]+`; none: no events are recorded.
    pub event_kinds: Vec<String>,
    /// All column names in the order of the CSV; the column `t` comes first by itself.
    pub csv_order: Vec<String>,
    /// Rows in a chunk file, at least 1; see [`chunk_rows_for`]. It must not depend on anything that a resumed run
    /// could see differently.
    pub chunk_rows: usize,
}

/// A number of rows in a chunk that suits a run: one chunk for a short run, no more than 8 MiB to rewrite at a flush.
///
/// `row_len` numbers in a row, `expected_rows` the rows of the whole run. A power of two from 1 to 16384.
pub fn chunk_rows_for(row_len: usize, expected_rows: usize) -> usize {
    const MOST_BYTES: usize = 8 << 20;
    const MOST_ROWS: usize = 1 << 14;
    let row_bytes = row_len.saturating_add(1).saturating_mul(8);
    let fits = (MOST_BYTES / row_bytes).max(1);
    let fits = 1 << fits.ilog2();
    expected_rows.clamp(1, MOST_ROWS).next_power_of_two().min(fits)
}

impl Layout {
    /// Numbers in a row, time not counted.
    pub fn row_len(&self) -> usize {
        self.arrays.iter().map(ArraySpec::row_len).sum()
    }

    /// Checks names, sizes and columns.
    ///
    /// # Errors
    /// `Layout`, with the first thing that is wrong.
    pub fn check(&self) -> Result<(), RecordError> {
        if self.chunk_rows == 0 {
            return Err(RecordError::layout("chunk_rows is 0; see chunk_rows_for"));
        }
        let sizes = self.dimension_sizes()?;
        self.check_names(&sizes)?;
        if let Some(ragged) = &self.ragged {
            check_ragged(ragged)?;
        }
        for fixed in &self.fixed {
            let (name, len) = (&fixed.spec.name, fixed.spec.row_len());
            if fixed.values.len() != len || !fixed.spec.columns.is_empty() {
                return Err(RecordError::layout(format!("the fixed array `{name}` takes {len} values and no columns")));
            }
        }
        for (dim, labels) in &self.labels {
            if sizes.get(dim.as_str()) != Some(&labels.len()) {
                let count = labels.len();
                return Err(RecordError::layout(format!("{count} labels do not fit the dimension `{dim}`")));
            }
        }
        self.columns().map(|_| ())
    }

    /// Where each CSV column is found, in the order of the CSV: its name, its array and its place in a row of it.
    pub(crate) fn columns(&self) -> Result<Vec<(&str, &str, usize)>, RecordError> {
        let mut places = HashMap::with_capacity(self.csv_order.len());
        for array in &self.arrays {
            if !array.columns.is_empty() && array.columns.len() != array.row_len() {
                let (name, len) = (&array.name, array.row_len());
                return Err(RecordError::layout(format!("the array `{name}` takes {len} column names or none")));
            }
            for (index, column) in array.columns.iter().enumerate().filter(|(_, column)| !column.is_empty()) {
                if !is_column(column)
                    || column == "t"
                    || places.insert(column.as_str(), (array.name.as_str(), index)).is_some()
                {
                    return Err(RecordError::layout(format!("the column `{column}` is taken twice or not a name")));
                }
            }
        }
        let mut columns = Vec::with_capacity(self.csv_order.len());
        for column in &self.csv_order {
            let (array, index) = places.remove(column.as_str()).ok_or_else(|| {
                RecordError::layout(format!("csv_order names `{column}`, which is no column or was named before"))
            })?;
            columns.push((column.as_str(), array, index));
        }
        match places.keys().min() {
            Some(column) => Err(RecordError::layout(format!("csv_order leaves out the column `{column}`"))),
            None => Ok(columns),
        }
    }

    /// Sizes of the dimensions by name.
    fn dimension_sizes(&self) -> Result<BTreeMap<&str, usize>, RecordError> {
        let mut sizes = BTreeMap::new();
        for spec in self.specs() {
            let mut own = BTreeSet::new();
            for Dimension { name, size } in &spec.dims {
                let array = &spec.name;
                if !is_name(name) || GROWING.contains(&name.as_str()) || !own.insert(name) || *size == 0 {
                    return Err(RecordError::layout(format!(
                        "the dimension `{name}` of `{array}` is empty, taken twice, reserved or not a name"
                    )));
                }
                if *sizes.entry(name.as_str()).or_insert(*size) != *size {
                    return Err(RecordError::layout(format!("the dimension `{name}` of `{array}` has two sizes")));
                }
            }
        }
        Ok(sizes)
    }

    /// Names are unique, and none is reserved or that of a dimension.
    fn check_names(&self, sizes: &BTreeMap<&str, usize>) -> Result<(), RecordError> {
        let mut taken: BTreeSet<&str> =
            ["time", "state", "event_time", "event_kind", "event_body"].into_iter().collect();
        taken.extend(sizes.keys());
        taken.extend(self.ragged.iter().map(|ragged| ragged.name.as_str()));
        for spec in self.arrays.iter().chain(self.fixed.iter().map(|fixed| &fixed.spec)) {
            if !is_name(&spec.name) || !taken.insert(&spec.name) {
                let name = &spec.name;
                return Err(RecordError::layout(format!("the array name `{name}` is taken, reserved or not a name")));
            }
        }
        let mut labelled = BTreeSet::new();
        if let Some((dim, _)) = self.labels.iter().find(|(dim, _)| !labelled.insert(dim)) {
            return Err(RecordError::layout(format!("the dimension `{dim}` is labelled twice")));
        }
        match self.event_kinds.iter().find(|kind| !is_word(kind)) {
            Some(kind) => Err(RecordError::layout(format!("the kind of event `{kind}` is not a word"))),
            None => Ok(()),
        }
    }

    /// All described arrays.
    fn specs(&self) -> impl Iterator<Item = &ArraySpec> {
        let ragged = self.ragged.iter().flat_map(|ragged| &ragged.arrays).map(|array| &array.spec);
        self.arrays.iter().chain(self.fixed.iter().map(|fixed| &fixed.spec)).chain(ragged)
    }
}

/// Checks the name of a ragged group and what it holds; the names of its arrays are those of the group alone.
fn check_ragged(ragged: &Ragged) -> Result<(), RecordError> {
    let name = &ragged.name;
    if !is_name(name) || ragged.chunk_entries == 0 || ragged.arrays.is_empty() {
        return Err(RecordError::layout(format!("the ragged group `{name}` has no name, no arrays or empty chunks")));
    }
    let mut taken = BTreeSet::from([START]);
    for RaggedArray { spec, codes } in &ragged.arrays {
        let is_free = is_name(&spec.name) && taken.insert(&spec.name);
        let words = codes.iter().flatten().all(|word| is_word(word));
        if !is_free || !words || !spec.columns.is_empty() {
            let array = &spec.name;
            return Err(RecordError::layout(format!("the array `{array}` of `{name}` is taken or not a name")));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn layout() -> Layout {
        let position = ArraySpec {
            name: "position".into(),
            dims: vec![Dimension::new("body", 2), Dimension::new("col", 3)],
            columns: ["a.x", "a.y", "", "b.x", "b.y", ""].map(String::from).into(),
            ..ArraySpec::default()
        };
        Layout {
            arrays: vec![position],
            csv_order: ["b.x", "b.y", "a.x", "a.y"].map(String::from).into(),
            labels: vec![("body".into(), vec!["a".into(), "b".into()])],
            chunk_rows: 4,
            ..Layout::default()
        }
    }

    #[test]
    fn columns_follow_the_order_of_the_csv() {
        let layout = layout();
        layout.check().unwrap();
        let columns = layout.columns().unwrap();
        assert_eq!(columns[0], ("b.x", "position", 3));
        assert_eq!(columns[3], ("a.y", "position", 1));
    }

    #[test]
    fn contradictory_layouts_are_refused_by_name() {
        let refused = |change: &dyn Fn(&mut Layout), name: &str| {
            let mut layout = layout();
            change(&mut layout);
            let message = layout.check().unwrap_err().to_string();
            assert!(message.contains(name), "{message} should name {name}");
        };
        refused(&|l| l.chunk_rows = 0, "chunk_rows");
        refused(&|l| l.csv_order.truncate(3), "a.y");
        refused(&|l| l.csv_order.push("a.x".into()), "a.x");
        refused(&|l| l.arrays[0].columns.truncate(5), "position");
        refused(&|l| l.arrays[0].columns[2] = "a,z".into(), "a,z");
        refused(&|l| l.arrays[0].columns[2] = "t".into(), "`t`");
        refused(&|l| l.arrays[0].name = "../x".into(), "../x");
        refused(&|l| l.arrays[0].name = "state".into(), "state");
        refused(&|l| l.arrays[0].name = "col".into(), "col");
        refused(&|l| l.arrays.push(l.arrays[0].clone()), "position");
        refused(&|l| l.arrays[0].dims[0].size = 0, "body");
        refused(&|l| l.arrays[0].dims[0].name = "time".into(), "time");
        refused(&|l| l.labels[0].1.truncate(1), "body");
        refused(&|l| l.labels.push(l.labels[0].clone()), "body");
        refused(&|l| l.event_kinds.push("lift off".into()), "lift off");
        refused(&|l| l.fixed.push(FixedArray::default()), "``");
        let ragged = |array: &str| Ragged {
            name: "pairs".into(),
            arrays: vec![RaggedArray {
                spec: ArraySpec { name: array.into(), ..ArraySpec::default() },
                codes: Some(vec!["one".into()]),
            }],
            chunk_entries: 4,
        };
        let mut layout = layout();
        layout.ragged = Some(ragged("position"));
        layout.check().unwrap();
        refused(&|l| l.ragged = Some(ragged("start")), "start");
        refused(&|l| l.ragged = Some(ragged("../x")), "../x");
        refused(&|l| l.ragged = Some(Ragged { name: "position".into(), ..ragged("first") }), "position");
        refused(&|l| l.ragged = Some(Ragged { chunk_entries: 0, ..ragged("first") }), "pairs");
    }

    #[test]
    fn chunks_suit_short_and_wide_runs() {
        assert_eq!(chunk_rows_for(50, 0), 1);
        assert_eq!(chunk_rows_for(50, 201), 256);
        assert_eq!(chunk_rows_for(50, 100_000_000), 16384);
        // 31 000 columns: 8 MiB hold 33 rows.
        assert_eq!(chunk_rows_for(31_000, 100_000), 32);
        assert_eq!(chunk_rows_for(usize::MAX / 16, 10), 1);
    }
}
