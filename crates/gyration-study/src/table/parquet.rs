//! Rows in a Parquet file: written in groups of equal size, read in portions, so that memory does not grow with the
//! file.
//!
//! The three numbers of the run are required, all other cells optional; a list is the three-level LIST of the format.
//! What is written depends on the rows alone. The metadata hold a checksum of the whole file, which is read once more
//! when it is opened: the library does not write the checksums of pages that the format has, and those leave out the
//! metadata.

use super::seal;
use crate::column::{Column, ColumnKind};
use crate::error::StudyError;
use crate::value::{Row, Value};
use ::parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use ::parquet::column::reader::ColumnReader;
use ::parquet::column::writer::ColumnWriter;
use ::parquet::data_type::ByteArray;
use ::parquet::errors::{ParquetError, Result};
use ::parquet::file::metadata::KeyValue;
use ::parquet::file::properties::WriterProperties;
use ::parquet::file::reader::FileReader;
use ::parquet::file::serialized_reader::SerializedFileReader;
use ::parquet::file::writer::{SerializedColumnWriter, SerializedFileWriter};
use ::parquet::schema::types::{Type, TypePtr};
use gyration_files::check;
use serde_json::Value as Json;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Rows of a group.
const GROUP: usize = 1 << 14;
/// Rows of a page: what a reader of many files holds of each column.
const PAGE: usize = 1 << 11;
/// The key of the description among the metadata of a file.
const KEY: &str = "gyration";

/// Writes a file.
pub(super) struct Output {
    path: PathBuf,
    writer: SerializedFileWriter<File>,
    kinds: Vec<ColumnKind>,
    waiting: Vec<Row>,
}

impl Output {
    /// A new file with these columns, and a description in its metadata.
    pub fn create(path: &Path, columns: &[Column], description: &Json) -> std::result::Result<Self, StudyError> {
        let file = File::create(path).map_err(StudyError::io("write", path))?;
        let metadata = [(KEY, description.to_string()), (seal::KEY, check::UNKNOWN.to_owned())];
        let metadata = metadata.map(|(key, text)| KeyValue::new(key.to_owned(), text)).to_vec();
        let properties = WriterProperties::builder()
            .set_created_by(format!("gyration {}", env!("CARGO_PKG_VERSION")))
            .set_compression(Compression::SNAPPY)
            .set_data_page_row_count_limit(PAGE)
            .set_write_batch_size(PAGE)
            .set_key_value_metadata(Some(metadata))
            .build();
        let writer = schema(columns).and_then(|schema| SerializedFileWriter::new(file, schema, Arc::new(properties)));
        let kinds = columns.iter().map(|column| column.kind).collect();
        Ok(Self { path: path.to_owned(), writer: writer.map_err(failed("write", path))?, kinds, waiting: Vec::new() })
    }

    /// One row more.
    pub fn push(&mut self, row: Row) -> std::result::Result<(), StudyError> {
        self.waiting.push(row);
        if self.waiting.len() < GROUP { Ok(()) } else { self.write_group() }
    }

    /// Ends the file and puts its checksum in.
    pub fn close(mut self) -> std::result::Result<(), StudyError> {
        if !self.waiting.is_empty() {
            self.write_group()?;
        }
        // To take the file back instead would lose what the system says: a full disk would be a damaged file.
        self.writer.close().map_err(failed("write", &self.path))?;
        seal::close(&self.path).map_err(StudyError::io("write", &self.path))
    }

    fn write_group(&mut self) -> std::result::Result<(), StudyError> {
        let rows = std::mem::take(&mut self.waiting);
        let mut write = || -> Result<()> {
            let mut group = self.writer.next_row_group()?;
            let mut index = 0;
            while let Some(mut column) = group.next_column()? {
                write_column(&mut column, &rows, index, self.kinds[index])?;
                column.close()?;
                index += 1;
            }
            group.close().map(|_| ())
        };
        write().map_err(failed("write", &self.path))
    }
}

fn failed(action: &'static str, path: &Path) -> impl FnOnce(ParquetError) -> StudyError {
    let path = path.to_owned();
    move |error| match error {
        ParquetError::External(source) => match source.downcast::<std::io::Error>() {
            Ok(source) => StudyError::Io { action, path, source: *source },
            Err(_) => StudyError::damaged(&path, "it is no table of a study"),
        },
        ParquetError::EOF(_) => StudyError::damaged(&path, "it ends too early"),
        _ => StudyError::damaged(&path, "it is no table of a study"),
    }
}

/// The columns that every row has.
const REQUIRED: usize = 3;

fn schema(columns: &[Column]) -> Result<TypePtr> {
    let fields = columns.iter().enumerate().map(|(index, column)| {
        let repetition = if index < REQUIRED { Repetition::REQUIRED } else { Repetition::OPTIONAL };
        let primitive = |kind| Type::primitive_type_builder(&column.name, kind).with_repetition(repetition);
        let field = match column.kind {
            ColumnKind::Integer => primitive(Physical::INT64).build()?,
            ColumnKind::Number => primitive(Physical::DOUBLE).build()?,
            ColumnKind::Text => primitive(Physical::BYTE_ARRAY).with_logical_type(Some(LogicalType::String)).build()?,
            ColumnKind::List => list(&column.name)?,
        };
        Ok(Arc::new(field))
    });
    let fields = fields.collect::<Result<Vec<TypePtr>>>()?;
    Ok(Arc::new(Type::group_type_builder("row").with_fields(fields).build()?))
}

/// optional group NAME (LIST) { repeated group list { required double element; } }
fn list(name: &str) -> Result<Type> {
    let element = Type::primitive_type_builder("element", Physical::DOUBLE).with_repetition(Repetition::REQUIRED);
    let items = Type::group_type_builder("list")
        .with_repetition(Repetition::REPEATED)
        .with_fields(vec![Arc::new(element.build()?)])
        .build()?;
    Type::group_type_builder(name)
        .with_repetition(Repetition::OPTIONAL)
        .with_logical_type(Some(LogicalType::List))
        .with_fields(vec![Arc::new(items)])
        .build()
}

fn write_column(column: &mut SerializedColumnWriter, rows: &[Row], index: usize, kind: ColumnKind) -> Result<()> {
    let cells = || rows.iter().map(|row| row.values.get(index).unwrap_or(&Value::Null));
    let present: Vec<i16> = cells().map(|cell| i16::from(*cell != Value::Null)).collect();
    let levels = (index >= REQUIRED).then_some(present.as_slice());
    match (column.untyped(), kind) {
        (ColumnWriter::Int64ColumnWriter(writer), ColumnKind::Integer) => {
            let integer = |cell: &Value| if let Value::Integer(value) = cell { Some(*value) } else { None };
            writer.write_batch(&cells().filter_map(integer).collect::<Vec<_>>(), levels, None)?;
        }
        (ColumnWriter::DoubleColumnWriter(writer), ColumnKind::Number) => {
            writer.write_batch(&cells().filter_map(Value::number).collect::<Vec<_>>(), levels, None)?;
        }
        (ColumnWriter::ByteArrayColumnWriter(writer), ColumnKind::Text) => {
            let texts: Vec<ByteArray> = cells().filter_map(Value::text).map(ByteArray::from).collect();
            writer.write_batch(&texts, levels, None)?;
        }
        (ColumnWriter::DoubleColumnWriter(writer), ColumnKind::List) => {
            let (mut values, mut defined, mut repeated) = (Vec::new(), Vec::new(), Vec::new());
            for cell in cells() {
                // 0: no list; 1: an empty one; 2: a value, that begins a list (0) or goes on with it (1).
                let Value::List(list) = cell else {
                    defined.push(0);
                    repeated.push(0);
                    continue;
                };
                values.extend_from_slice(list);
                defined.extend(std::iter::repeat_n(if list.is_empty() { 1 } else { 2 }, list.len().max(1)));
                repeated.push(0);
                repeated.extend(std::iter::repeat_n(1, list.len().saturating_sub(1)));
            }
            writer.write_batch(&values, Some(&defined), Some(&repeated))?;
        }
        _ => return Err(ParquetError::General("a column is of another kind than its schema".into())),
    }
    Ok(())
}

/// Reads a file from its first row to its last.
pub(crate) struct Input {
    path: PathBuf,
    reader: SerializedFileReader<File>,
    kinds: Vec<ColumnKind>,
    group: usize,
    columns: Vec<ColumnReader>,
    /// Rows of the group that are still to be read.
    remaining: usize,
}

impl Input {
    /// Opens a file.
    pub fn open(path: &Path) -> std::result::Result<Self, StudyError> {
        let mut file = gyration_files::open(path).map_err(StudyError::io("read", path))?;
        if !seal::is_whole(&mut file).map_err(StudyError::io("read", path))? {
            return Err(StudyError::damaged(path, "it does not match its checksum"));
        }
        let reader = SerializedFileReader::new(file).map_err(failed("read", path))?;
        let fields = reader.metadata().file_metadata().schema().get_fields().iter();
        let kinds = fields.map(kind).collect::<Option<_>>();
        let kinds = kinds.ok_or_else(|| StudyError::damaged(path, "its columns are not those of a study"))?;
        Ok(Self { path: path.to_owned(), reader, kinds, group: 0, columns: Vec::new(), remaining: 0 })
    }

    /// How many rows it has.
    pub fn rows(&self) -> u64 {
        self.reader.metadata().file_metadata().num_rows().try_into().unwrap_or(0)
    }

    /// Its columns, with their units where the file tells them.
    pub fn columns(&self) -> Vec<Column> {
        let told: Option<Vec<Column>> =
            self.description().and_then(|told| serde_json::from_value(told.get("columns")?.clone()).ok());
        let fields = self.reader.metadata().file_metadata().schema().get_fields().iter();
        let found = fields.zip(&self.kinds).map(|(field, kind)| Column::new(field.name(), None, *kind));
        let found: Vec<Column> = found.collect();
        let same = |told: &Vec<Column>| {
            told.len() == found.len() && told.iter().zip(&found).all(|(a, b)| (&a.name, a.kind) == (&b.name, b.kind))
        };
        told.filter(same).unwrap_or(found)
    }

    /// The description that it was written with.
    pub fn description(&self) -> Option<Json> {
        let metadata = self.reader.metadata().file_metadata().key_value_metadata()?;
        let found = metadata.iter().find(|entry| entry.key == KEY)?;
        serde_json::from_str(found.value.as_ref()?).ok()
    }

    /// So many of the next rows at most; none behind the last.
    pub fn next(&mut self, most: usize) -> std::result::Result<Vec<Row>, StudyError> {
        self.portion(most).map_err(failed("read", &self.path))
    }

    fn portion(&mut self, most: usize) -> Result<Vec<Row>> {
        while self.remaining == 0 {
            if self.group == self.reader.num_row_groups() {
                return Ok(Vec::new());
            }
            let group = self.reader.get_row_group(self.group)?;
            self.columns = (0..self.kinds.len()).map(|index| group.get_column_reader(index)).collect::<Result<_>>()?;
            self.remaining = group.metadata().num_rows().try_into().unwrap_or(0);
            self.group += 1;
        }
        let count = most.min(self.remaining);
        self.remaining -= count;
        let mut rows = vec![Row { values: Vec::with_capacity(self.kinds.len()) }; count];
        for (index, (reader, kind)) in self.columns.iter_mut().zip(&self.kinds).enumerate() {
            let cells = read_column(reader, *kind, count, index < REQUIRED)?;
            if cells.len() != count {
                return Err(ParquetError::General("a column is shorter than its group".into()));
            }
            rows.iter_mut().zip(cells).for_each(|(row, cell)| row.values.push(cell));
        }
        Ok(rows)
    }
}

fn kind(field: &TypePtr) -> Option<ColumnKind> {
    if field.is_group() {
        return Some(ColumnKind::List);
    }
    match field.get_physical_type() {
        Physical::INT64 => Some(ColumnKind::Integer),
        Physical::DOUBLE => Some(ColumnKind::Number),
        Physical::BYTE_ARRAY => Some(ColumnKind::Text),
        _ => None,
    }
}

/// The next cells of a column.
fn read_column(reader: &mut ColumnReader, kind: ColumnKind, count: usize, is_required: bool) -> Result<Vec<Value>> {
    let (mut defined, mut repeated) = (Vec::new(), Vec::new());
    macro_rules! values {
        ($reader:expr, $read_repeated:expr) => {{
            let mut values = Vec::new();
            let mut read = 0;
            while read < count {
                let levels = $read_repeated.then_some(&mut repeated);
                let wanted = (!is_required).then_some(&mut defined);
                let (records, _, _) = $reader.read_records(count - read, wanted, levels, &mut values)?;
                if records == 0 {
                    break;
                }
                read += records;
            }
            values.into_iter()
        }};
    }
    let cells = match (reader, kind) {
        (ColumnReader::Int64ColumnReader(reader), ColumnKind::Integer) => {
            optional(values!(reader, false).map(Value::Integer), &defined, is_required)
        }
        (ColumnReader::DoubleColumnReader(reader), ColumnKind::Number) => {
            optional(values!(reader, false).map(Value::Number), &defined, is_required)
        }
        (ColumnReader::ByteArrayColumnReader(reader), ColumnKind::Text) => {
            let text = |bytes: ByteArray| Value::Text(String::from_utf8_lossy(bytes.data()).into_owned());
            optional(values!(reader, false).map(text), &defined, is_required)
        }
        (ColumnReader::DoubleColumnReader(reader), ColumnKind::List) => {
            let values = values!(reader, true);
            lists(values, &defined, &repeated)
        }
        _ => return Err(ParquetError::General("a column is of another kind than its schema".into())),
    };
    Ok(cells)
}

fn optional(mut values: impl Iterator<Item = Value>, defined: &[i16], is_required: bool) -> Vec<Value> {
    if is_required {
        return values.collect();
    }
    let cell = |level: &i16| if *level == 0 { Value::Null } else { values.next().unwrap_or_default() };
    defined.iter().map(cell).collect()
}

fn lists(mut values: impl Iterator<Item = f64>, defined: &[i16], repeated: &[i16]) -> Vec<Value> {
    let mut lists: Vec<Value> = Vec::new();
    for (defined, repeated) in defined.iter().zip(repeated) {
        if *repeated == 0 {
            lists.push(if *defined == 0 { Value::Null } else { Value::List(Vec::new()) });
        }
        if let (2, Some(Value::List(list))) = (defined, lists.last_mut()) {
            list.extend(values.next());
        }
    }
    lists
}
