//! VTK's files of surfaces, `.vtp`, and of grids, `.vti`, one a time, and `.pvd`, which says which file is of which
//! time.
//!
//! XML with its numbers appended: little-endian f64 and i32, compressed block by block with zlib. The topology, the
//! same at every time, is compressed once. These are the formats that ParaView reads without a library; VTKHDF would
//! need HDF5. Source: *VTK file formats*, docs.vtk.org, "XML file formats".

mod compressed;
mod pvd;

pub use compressed::CompressedNumbers;
pub use pvd::{SeriesFile, pvd};

use compressed::NumberKind;
use std::io::{self, Write};

/// Cells of a surface: single points, then triangles.
#[derive(Debug, Clone)]
pub struct Topology {
    points: usize,
    verts: Cells,
    polys: Cells,
}

#[derive(Debug, Clone)]
struct Cells {
    count: usize,
    connectivity: CompressedNumbers,
    offsets: CompressedNumbers,
}

/// A named array of points or cells.
#[derive(Debug, Clone)]
pub struct DataArray {
    /// Its name, as it appears in menus.
    pub name: &'static str,
    /// Its unit; empty for a pure number.
    pub units: &'static str,
    /// Numbers a point or cell: 1, 3, or 9 of a matrix, row by row.
    pub components: usize,
    /// The numbers.
    pub values: CompressedNumbers,
}

/// A named array of the whole.
#[derive(Debug, Clone)]
pub struct Whole {
    /// Its name; VTK knows no unit of such an array.
    pub name: String,
    /// The numbers, or names.
    pub values: WholeValues,
}

/// What it holds.
#[derive(Debug, Clone)]
pub enum WholeValues {
    /// Finite numbers, so many a tuple.
    Numbers(usize, Vec<f64>),
    /// Names.
    Names(Vec<String>),
}

/// A surface at one time.
#[derive(Debug, Clone)]
pub struct PolyData<'a> {
    /// Its cells.
    pub topology: &'a Topology,
    /// Places of the points, three numbers each \[m\].
    pub points: CompressedNumbers,
    /// Arrays with a value for each point.
    pub point_data: Vec<DataArray>,
    /// Arrays with a value for each cell: those of single points first.
    pub cell_data: Vec<DataArray>,
    /// Arrays of the whole.
    pub field_data: Vec<Whole>,
}

impl Topology {
    /// Of single points and polygons of `corners` points each, given by the places of their points.
    pub fn new(points: usize, verts: &[i32], polygons: &[i32], corners: usize) -> Self {
        Self { points, verts: Cells::new(verts, 1), polys: Cells::new(polygons, corners) }
    }

    /// How many cells there are.
    pub fn cells(&self) -> usize {
        self.verts.count + self.polys.count
    }
}

impl Cells {
    fn new(connectivity: &[i32], corners: usize) -> Self {
        let count = connectivity.len() / corners;
        let ends = (1..=count).map(|k| (k * corners) as i32);
        Self {
            count,
            connectivity: CompressedNumbers::integers(connectivity.iter().copied()),
            offsets: CompressedNumbers::integers(ends),
        }
    }
}

/// Writes a surface as `.vtp`.
///
/// # Errors
/// Those of writing.
pub fn vtp(data: &PolyData, out: &mut impl Write) -> io::Result<()> {
    let mut text = VtkText { out, appended: Vec::new(), length: 0 };
    let topology = data.topology;
    text.head("PolyData", "")?;
    text.wholes(&data.field_data)?;
    text.line(&format!(
        "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"0\" NumberOfStrips=\"0\" \
         NumberOfPolys=\"{}\">",
        topology.points, topology.verts.count, topology.polys.count
    ))?;
    text.arrays("PointData", &data.point_data)?;
    text.arrays("CellData", &data.cell_data)?;
    text.line("<Points>")?;
    text.array("Points", "m", 3, &data.points)?;
    text.line("</Points>")?;
    for (section, cells) in [("Verts", &topology.verts), ("Polys", &topology.polys)] {
        if cells.count > 0 {
            text.line(&format!("<{section}>"))?;
            text.array("connectivity", "", 1, &cells.connectivity)?;
            text.array("offsets", "", 1, &cells.offsets)?;
            text.line(&format!("</{section}>"))?;
        }
    }
    text.tail("PolyData")
}

/// Numbers at the points of a grid at one time.
#[derive(Debug, Clone)]
pub struct ImageData {
    /// How many points along each axis.
    pub counts: [usize; 3],
    /// The first \[m\].
    pub origin: [f64; 3],
    /// From one to the next \[m\].
    pub spacing: [f64; 3],
    /// Arrays with a value for each point, x fastest.
    pub point_data: Vec<DataArray>,
    /// Arrays of the whole.
    pub field_data: Vec<Whole>,
}

/// Writes a grid as `.vti`.
///
/// # Errors
/// Those of writing.
pub fn vti(data: &ImageData, out: &mut impl Write) -> io::Result<()> {
    let mut text = VtkText { out, appended: Vec::new(), length: 0 };
    let extent: String = data.counts.iter().map(|count| format!("0 {} ", count.saturating_sub(1))).collect();
    let three = |numbers: &[f64; 3]| numbers.map(|number| format!("{number:e}")).join(" ");
    let (extent, origin, spacing) = (extent.trim_end(), three(&data.origin), three(&data.spacing));
    text.head("ImageData", &format!(" WholeExtent=\"{extent}\" Origin=\"{origin}\" Spacing=\"{spacing}\""))?;
    text.wholes(&data.field_data)?;
    text.line(&format!("<Piece Extent=\"{extent}\">"))?;
    text.arrays("PointData", &data.point_data)?;
    text.tail("ImageData")
}

/// The XML, and the numbers that come behind it.
struct VtkText<'a, W> {
    out: &'a mut W,
    appended: Vec<&'a CompressedNumbers>,
    /// Bytes of those.
    length: usize,
}

impl<'a, W: Write> VtkText<'a, W> {
    fn line(&mut self, line: &str) -> io::Result<()> {
        writeln!(self.out, "{line}")
    }

    /// What stands before the arrays.
    fn head(&mut self, kind: &str, attributes: &str) -> io::Result<()> {
        self.line(&format!(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"{kind}\" version=\"1.0\" byte_order=\"LittleEndian\" \
             header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n<{kind}{attributes}>"
        ))
    }

    /// What stands behind them, and their numbers.
    fn tail(&mut self, kind: &str) -> io::Result<()> {
        self.line(&format!("</Piece>\n</{kind}>\n<AppendedData encoding=\"raw\">"))?;
        self.append()?;
        self.line("\n</AppendedData>\n</VTKFile>")
    }

    fn wholes(&mut self, wholes: &[Whole]) -> io::Result<()> {
        self.line("<FieldData>")?;
        wholes.iter().try_for_each(|whole| self.whole(whole))?;
        self.line("</FieldData>")
    }

    fn arrays(&mut self, section: &str, arrays: &'a [DataArray]) -> io::Result<()> {
        self.line(&format!("<{section}>"))?;
        for array in arrays {
            self.array(array.name, array.units, array.components, &array.values)?;
        }
        self.line(&format!("</{section}>"))
    }

    fn array(&mut self, name: &str, units: &str, components: usize, values: &'a CompressedNumbers) -> io::Result<()> {
        let kind = match values.kind() {
            NumberKind::Float64 => "Float64",
            NumberKind::Int32 => "Int32",
        };
        let offset = self.length;
        self.length += values.bytes().len();
        self.appended.push(values);
        self.line(&format!(
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"appended\" \
             offset=\"{offset}\">{}</DataArray>",
            units_key(units)
        ))
    }

    /// In plain digits: few numbers, which people like to read.
    fn whole(&mut self, whole: &Whole) -> io::Result<()> {
        let (kind, tuples, components, values) = match &whole.values {
            WholeValues::Numbers(components, numbers) => {
                let digits = numbers.iter().map(|number| format!("{number:e} ")).collect::<String>();
                ("Float64", numbers.len() / components, *components, digits)
            }
            WholeValues::Names(names) => {
                // The codes of the bytes, each name closed by a zero.
                let codes = names.iter().flat_map(|name| name.bytes().chain([0]));
                ("String", names.len(), 1, codes.map(|code| format!("{code} ")).collect())
            }
        };
        self.line(&format!(
            "<DataArray type=\"{kind}\" Name=\"{}\" NumberOfComponents=\"{components}\" NumberOfTuples=\"{tuples}\" \
             format=\"ascii\">{values}</DataArray>",
            whole.name
        ))
    }

    fn append(&mut self) -> io::Result<()> {
        self.out.write_all(b"_")?;
        self.appended.iter().try_for_each(|values| self.out.write_all(values.bytes()))
    }
}

/// The key under which VTK keeps a unit.
fn units_key(units: &str) -> String {
    match units {
        "" => String::new(),
        units => format!("<InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">{units}</InformationKey>"),
    }
}
