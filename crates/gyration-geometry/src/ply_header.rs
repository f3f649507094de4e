//! The header of a PLY file: its format, and which elements with which properties follow.

use crate::fault::{FileFault, FilePlace, Trouble};

/// How the values behind the header are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}

/// The type of a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

/// A property of an element.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Property {
    pub name: String,
    /// The type of the number of values before them, for a list.
    pub count: Option<Scalar>,
    pub value: Scalar,
}

/// A kind of record.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Element {
    pub name: String,
    pub count: u64,
    pub properties: Vec<Property>,
    /// Line of the header that announces it.
    pub line: usize,
}

/// The header and where it ends.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PlyHeader {
    pub encoding: Encoding,
    pub elements: Vec<Element>,
    pub bytes: usize,
    pub lines: usize,
}

impl Scalar {
    fn of_name(name: &str) -> Option<Self> {
        Some(match name {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return None,
        })
    }

    /// Bytes of a value in a binary file.
    pub fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }
}

impl Element {
    /// The fewest bytes that a record can take.
    pub fn min_bytes(&self, encoding: Encoding) -> usize {
        let of_property = |property: &Property| match encoding {
            // A digit and a separator.
            Encoding::Text => 2,
            _ => property.count.unwrap_or(property.value).size(),
        };
        self.properties.iter().map(of_property).sum()
    }
}

/// Reads the header, up to and with the line `end_header`.
pub(crate) fn read_header(bytes: &[u8]) -> Result<PlyHeader, FileFault> {
    let mut lines = HeaderLines { bytes, offset: 0, number: 0 };
    let first = lines.next_line()?;
    if first != "ply" {
        return Err(Trouble::unexpected("`ply`", &first).at(lines.place()));
    }
    let mut encoding = None;
    let mut elements: Vec<Element> = Vec::new();
    loop {
        let line = lines.next_line()?;
        let words: Vec<&str> = line.split_whitespace().collect();
        match words.as_slice() {
            [] | ["comment" | "obj_info", ..] => {}
            ["format", name, _] => encoding = encoding_of(name),
            ["element", name, count] => {
                let count = count.parse().map_err(|_| Trouble::unexpected("a number of elements", count));
                let count = count.map_err(|trouble| trouble.at(lines.place()))?;
                elements.push(Element { name: (*name).into(), count, properties: Vec::new(), line: lines.number });
            }
            ["property", rest @ ..] => {
                let unexpected = || Trouble::unexpected("a property of an element", &line).at(lines.place());
                let property = property_of(rest).ok_or_else(unexpected)?;
                elements.last_mut().ok_or_else(unexpected)?.properties.push(property);
            }
            ["end_header"] => break,
            _ => return Err(Trouble::unexpected("a line of a PLY header", &line).at(lines.place())),
        }
    }
    let no_format = Trouble::unexpected("`format ascii|binary_little_endian|binary_big_endian 1.0`", "end_header");
    let encoding = encoding.ok_or(no_format.at(lines.place()))?;
    Ok(PlyHeader { encoding, elements, bytes: lines.offset, lines: lines.number })
}

fn encoding_of(name: &str) -> Option<Encoding> {
    match name {
        "ascii" => Some(Encoding::Text),
        "binary_little_endian" => Some(Encoding::LittleEndian),
        "binary_big_endian" => Some(Encoding::BigEndian),
        _ => None,
    }
}

fn property_of(words: &[&str]) -> Option<Property> {
    match *words {
        ["list", count, value, name] => {
            let count = Scalar::of_name(count).filter(|kind| !matches!(kind, Scalar::F32 | Scalar::F64))?;
            Some(Property { name: name.into(), count: Some(count), value: Scalar::of_name(value)? })
        }
        [value, name] => Some(Property { name: name.into(), count: None, value: Scalar::of_name(value)? }),
        _ => None,
    }
}

struct HeaderLines<'a> {
    bytes: &'a [u8],
    offset: usize,
    number: usize,
}

impl HeaderLines<'_> {
    fn place(&self) -> FilePlace {
        FilePlace::Line(self.number)
    }

    fn next_line(&mut self) -> Result<String, FileFault> {
        let rest = &self.bytes[self.offset..];
        let Some(length) = rest.iter().position(|&byte| byte == b'\n') else {
            return Err(Trouble::Truncated { expected: "`end_header`" }.at(self.place()));
        };
        self.offset += length + 1;
        self.number += 1;
        Ok(String::from_utf8_lossy(&rest[..length]).trim().to_string())
    }
}
