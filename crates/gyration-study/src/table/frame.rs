//! A table in memory, column by column: for drawings and summaries.

use super::parquet::Input;
use super::shard::Shard;
use super::{PORTION, ROWS, TABLE, journal};
use crate::column::{Column, ColumnKind};
use crate::error::{MANIFEST, StudyError};
use crate::value::{Row, Value};
use serde::Deserialize;
use serde_json::Value as Json;
use std::fs;
use std::path::{Path, PathBuf};

/// A table in memory.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DataFrame {
    columns: Vec<FrameColumn>,
    rows: usize,
    description: Json,
}

/// A column with its cells.
#[derive(Debug, Clone, PartialEq)]
pub struct FrameColumn {
    /// Name, unit, kind.
    pub column: Column,
    /// Its cells.
    pub data: Data,
}

/// The cells of a column.
#[derive(Debug, Clone, PartialEq)]
pub enum Data {
    /// Integers.
    Integer(Vec<Option<i64>>),
    /// Real numbers.
    Number(Vec<Option<f64>>),
    /// Texts.
    Text(Vec<Option<String>>),
    /// Lists of real numbers.
    List(Vec<Option<Vec<f64>>>),
}

/// What a table tells of a parameter.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Described {
    /// Its name.
    pub name: String,
    /// The keys of the scene that it sets.
    pub keys: Vec<String>,
    /// The unit of its numbers.
    pub unit: Option<String>,
    /// Its columns.
    pub columns: Vec<String>,
    /// Its axis of the grid; none of a random one.
    pub axis: Option<usize>,
    /// How many values it has on its axis.
    pub count: Option<u64>,
    /// `linear` or `log`.
    pub scale: String,
}

impl Data {
    fn new(kind: ColumnKind) -> Self {
        match kind {
            ColumnKind::Integer => Self::Integer(Vec::new()),
            ColumnKind::Number => Self::Number(Vec::new()),
            ColumnKind::Text => Self::Text(Vec::new()),
            ColumnKind::List => Self::List(Vec::new()),
        }
    }

    fn push(&mut self, value: Value) {
        match (self, value) {
            (Self::Integer(cells), Value::Integer(value)) => cells.push(Some(value)),
            (Self::Number(cells), Value::Number(value)) => cells.push(Some(value)),
            (Self::Text(cells), Value::Text(value)) => cells.push(Some(value)),
            (Self::List(cells), Value::List(value)) => cells.push(Some(value)),
            (Self::Integer(cells), _) => cells.push(None),
            (Self::Number(cells), _) => cells.push(None),
            (Self::Text(cells), _) => cells.push(None),
            (Self::List(cells), _) => cells.push(None),
        }
    }
}

impl FrameColumn {
    /// The number in a row, if there is one.
    pub fn number(&self, row: usize) -> Option<f64> {
        match &self.data {
            Data::Integer(cells) => cells.get(row).copied().flatten().map(|value| value as f64),
            Data::Number(cells) => cells.get(row).copied().flatten(),
            _ => None,
        }
    }

    /// The text in a row, if there is one.
    pub fn text(&self, row: usize) -> Option<&str> {
        match &self.data {
            Data::Text(cells) => cells.get(row)?.as_deref(),
            _ => None,
        }
    }

    /// The list in a row, if there is one.
    pub fn list(&self, row: usize) -> Option<&[f64]> {
        match &self.data {
            Data::List(cells) => cells.get(row)?.as_deref(),
            _ => None,
        }
    }
}

impl DataFrame {
    /// Reads a table: a folder `NAME.study`, finished or not, or a Parquet file of one.
    ///
    /// # Errors
    /// [`StudyError::NoTable`] if there is none, or a file that cannot be read or is damaged.
    pub fn read(path: &Path) -> Result<Self, StudyError> {
        if path.is_file() {
            return Self::of_files(&[path.to_owned()], &[]);
        }
        let mut before = None;
        loop {
            let (mut files, mut journals) = (Vec::new(), Vec::new());
            let listed = collect(path, &mut files, &mut journals);
            let read = listed.and_then(|()| match files.is_empty() && journals.is_empty() {
                true => Err(StudyError::NoTable { path: path.to_owned(), help: "" }),
                false => Self::of_files(&files, &journals),
            });
            // Of a table under way a journal may have become a chunk meanwhile, and the chunks one file: they are
            // listed again until that tells nothing new.
            let now = Some((files, journals));
            if read.is_ok() || now == before {
                return read;
            }
            before = now;
        }
    }

    fn of_files(files: &[PathBuf], journals: &[PathBuf]) -> Result<Self, StudyError> {
        let mut frame = Self::default();
        let mut rows: Vec<Row> = Vec::new();
        for (index, file) in files.iter().enumerate() {
            let mut input = Input::open(file)?;
            if index == 0 {
                frame.begin(&input.columns(), input.description().unwrap_or_default());
            }
            loop {
                let portion = input.next(PORTION)?;
                if portion.is_empty() {
                    break;
                }
                match files.len() + journals.len() {
                    1 => portion.into_iter().for_each(|row| frame.push(row)),
                    _ => rows.extend(portion),
                }
            }
        }
        for journal in journals {
            let columns: Vec<Column> = match frame.columns.is_empty() {
                false => frame.columns.iter().map(|column| column.column.clone()).collect(),
                true => {
                    let (columns, description) = described_beside(journal)?;
                    frame.begin(&columns, description);
                    columns
                }
            };
            rows.extend(journal::read(journal, &columns)?.0);
        }
        rows.sort_by_key(Row::run);
        rows.dedup_by_key(|row| row.run());
        rows.into_iter().for_each(|row| frame.push(row));
        Ok(frame)
    }

    fn begin(&mut self, columns: &[Column], description: Json) {
        let column = |column: &Column| FrameColumn { column: column.clone(), data: Data::new(column.kind) };
        self.columns = columns.iter().map(column).collect();
        self.description = description;
    }

    fn push(&mut self, row: Row) {
        let mut values = row.values.into_iter();
        self.columns.iter_mut().for_each(|column| column.data.push(values.next().unwrap_or_default()));
        self.rows += 1;
    }

    /// A frame of columns that are at hand, with what is told of them.
    pub fn of_columns(columns: Vec<FrameColumn>, rows: usize, description: Json) -> Self {
        Self { columns, rows, description }
    }

    /// How many rows it has.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Its columns, in order.
    pub fn columns(&self) -> &[FrameColumn] {
        &self.columns
    }

    /// A column by its name.
    pub fn column(&self, name: &str) -> Option<&FrameColumn> {
        self.columns.iter().find(|column| column.column.name == name)
    }

    /// What is told of the table: see `describe`; null if nothing is.
    pub fn description(&self) -> &Json {
        &self.description
    }

    /// What the study asks, if it says so.
    pub fn title(&self) -> Option<&str> {
        self.description.get("title")?.as_str()
    }

    /// What is varied.
    pub fn parameters(&self) -> Vec<Described> {
        let told = self.description.get("parameters").cloned().unwrap_or_default();
        serde_json::from_value(told).unwrap_or_default()
    }

    /// The columns of what is kept.
    pub fn kept(&self) -> Vec<&str> {
        let told = self.description.get("kept").and_then(Json::as_array).into_iter().flatten();
        told.filter_map(Json::as_str).collect()
    }

    /// Its `[plot]`, if it has one.
    pub fn plot(&self) -> Option<&Json> {
        self.description.get("plot").filter(|plot| !plot.is_null())
    }

    /// Runs of each point of the grid.
    pub fn repetitions(&self) -> u64 {
        self.description.get("repetitions").and_then(Json::as_u64).unwrap_or(1)
    }
}

/// The files that hold the rows of a folder: the finished table, or its chunks and journals, or those of its shards.
fn collect(folder: &Path, files: &mut Vec<PathBuf>, journals: &mut Vec<PathBuf>) -> Result<(), StudyError> {
    let table = folder.join(TABLE);
    if table.is_file() {
        files.push(table);
        return Ok(());
    }
    let list = |folder: &Path| -> Result<Vec<PathBuf>, StudyError> {
        if !folder.is_dir() {
            return Ok(Vec::new());
        }
        let entries = fs::read_dir(folder).map_err(StudyError::io("read", folder))?;
        let mut paths: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
        paths.sort();
        Ok(paths)
    };
    for path in list(&folder.join(ROWS))? {
        match path.extension().and_then(|ending| ending.to_str()) {
            Some("parquet") => files.push(path),
            Some("jsonl") => journals.push(path),
            _ => {}
        }
    }
    for path in list(folder)? {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if Shard::of_folder(&name).is_some() {
            collect(&path, files, journals)?;
        }
    }
    Ok(())
}

/// The columns that the manifest of a journal tells.
fn described_beside(journal: &Path) -> Result<(Vec<Column>, Json), StudyError> {
    let folder = journal.parent().and_then(Path::parent).unwrap_or(Path::new(""));
    let manifest = super::disk::read_manifest(folder)?;
    let columns = serde_json::from_value(manifest.get("columns").cloned().unwrap_or_default());
    let unknown = |_: serde_json::Error| StudyError::damaged(&folder.join(MANIFEST), "it does not tell its columns");
    let columns = columns.map_err(unknown)?;
    Ok((columns, manifest))
}
