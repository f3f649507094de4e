//! Where copies of a body are: on a grid, or in a table beside the scene.

use crate::file::CopyGrid;
use crate::quantity::si;
use crate::read::{self, NamedFile};
use crate::suggest;
use crate::table::{self, RowFault, TableFault};
use gyration::kinematics::Quaternion;
use gyration::tensor::Vec3;
use gyration_files::line_of_row;

/// The most copies of a body.
pub(crate) const MOST_COPIES: usize = 1_000_000;

/// What a copy has beyond the body as it is written.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct CopyPlace {
    /// From the position of the body \[m\].
    pub(crate) displacement: Vec3,
    /// A turn of the body as it is written.
    pub(crate) turn: Option<Quaternion>,
    /// More velocity of the centre of mass \[m/s\].
    pub(crate) velocity: Vec3,
    /// More spin, in spatial axes \[rad/s\].
    pub(crate) angular_velocity: Vec3,
}

impl CopyPlace {
    /// All that it says.
    pub(crate) fn numbers(&self) -> impl Iterator<Item = f64> {
        let Self { displacement, turn, velocity, angular_velocity } = *self;
        let vectors = [displacement, velocity, angular_velocity].into_iter().flat_map(<[f64; 3]>::from);
        vectors.chain(turn.into_iter().flat_map(|Quaternion(turn)| turn))
    }
}

/// The places of a grid, x fastest.
pub(crate) fn grid(grid: &CopyGrid) -> Vec<CopyPlace> {
    let [along_x, along_y, along_z] = grid.count.map(|count| 0..count.0 as usize);
    let spacing: Vec3 = si(&grid.spacing);
    let at = |x: usize, y: usize, z: usize| {
        let displacement = Vec3::new(x as f64, y as f64, z as f64).component_mul(&spacing);
        CopyPlace { displacement, ..CopyPlace::default() }
    };
    let rows = along_z.flat_map(|z| along_y.clone().map(move |y| (y, z)));
    rows.flat_map(|(y, z)| along_x.clone().map(move |x| at(x, y, z))).collect()
}

/// The columns of a table that belong together, of which the first must be there.
const COLUMNS: [&[&str]; 4] = [&["x", "y", "z"], &["qw", "qx", "qy", "qz"], &["vx", "vy", "vz"], &["wx", "wy", "wz"]];
/// The same, as a message has them.
const IN_WORDS: &str = "`x,y,z`, `x,y,z,qw,qx,qy,qz`, and so on with `vx,vy,vz` and `wx,wy,wz`";

/// Reads a table of places: a line of names, and a row for each copy in SI units.
///
/// # Errors
/// [`TableFault`] with the line: a file that cannot be read, a column that is missing or not known, what is no number,
/// a quaternion that is zero, no row.
pub(crate) fn read_places(file: NamedFile<'_>) -> Result<Vec<CopyPlace>, TableFault> {
    let bytes = read::named(file)?;
    let content = table::content(&bytes);
    rows(content).map_err(|(start, reason)| {
        let line = if start < content.len() { line_of_row(content, start) } else { 1 };
        TableFault::Malformed { columns: IN_WORDS.to_owned(), path: file.0.path(file.1), line, reason }
    })
}

fn rows(content: &[u8]) -> Result<Vec<CopyPlace>, RowFault> {
    let mut records = table::records(content);
    let (begin, header) = records.next().ok_or_else(|| (content.len(), "the file is empty".to_owned()))??;
    let columns = Columns::of(&header).map_err(|reason| (begin, reason))?;
    let mut places = Vec::new();
    for record in records {
        let (start, record) = record?;
        if places.len() == MOST_COPIES {
            return Err((start, format!("more than {MOST_COPIES} rows")));
        }
        places.push(columns.place(&record).map_err(|reason| (start, reason))?);
    }
    if places.is_empty() {
        return Err((begin, "there is no row behind the line of names".to_owned()));
    }
    Ok(places)
}

/// Where the columns of a table stand.
struct Columns {
    count: usize,
    /// Of each group, the places of its columns; none if it is not there.
    groups: [Option<Vec<usize>>; 4],
}

impl Columns {
    fn of(header: &csv::StringRecord) -> Result<Self, String> {
        let known = || COLUMNS.iter().flat_map(|group| group.iter().copied());
        for (index, name) in header.iter().enumerate() {
            if header.iter().take(index).any(|before| before == name) {
                return Err(format!("the column \"{name}\" occurs twice"));
            }
            if name.parse::<f64>().is_ok() {
                return Err(format!("the first line holds \"{name}\" where it names the columns"));
            }
            if !known().any(|column| column == name) {
                return Err(format!("unknown column \"{name}\": {}", suggest::fix(name, known(), "known columns")));
            }
        }
        let mut groups = [const { None }; 4];
        for (index, names) in COLUMNS.iter().enumerate() {
            let found = |name: &&str| header.iter().position(|column| column == *name);
            if index > 0 && !names.iter().any(|name| found(name).is_some()) {
                continue;
            }
            let missing = |name: &&str| format!("the column \"{name}\" is missing");
            let places = names.iter().map(|name| found(name).ok_or_else(|| missing(name)));
            groups[index] = Some(places.collect::<Result<_, String>>()?);
        }
        Ok(Self { count: header.len(), groups })
    }

    fn place(&self, record: &csv::StringRecord) -> Result<CopyPlace, String> {
        if record.len() != self.count {
            return Err(format!("expected {} columns, found {}", self.count, record.len()));
        }
        let number = |column: usize| match record[column].parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            Ok(number) => Err(format!("column {} holds {number}, which is not finite", column + 1)),
            Err(_) => Err(format!("column {} holds \"{}\", which is no number", column + 1, &record[column])),
        };
        let numbers = |group: &Option<Vec<usize>>| match group {
            Some(columns) => columns.iter().map(|column| number(*column)).collect::<Result<Vec<f64>, String>>(),
            None => Ok(Vec::new()),
        };
        let [place, turn, velocity, spin] = &self.groups;
        let vector =
            |numbers: Vec<f64>| if numbers.is_empty() { Vec3::zeros() } else { Vec3::from_row_slice(&numbers) };
        let turn = match numbers(turn)?[..] {
            [w, x, y, z] => Some(Quaternion::along([w, x, y, z]).ok_or_else(|| "its quaternion is zero".to_owned())?),
            _ => None,
        };
        Ok(CopyPlace {
            displacement: vector(numbers(place)?),
            turn,
            velocity: vector(numbers(velocity)?),
            angular_velocity: vector(numbers(spin)?),
        })
    }
}
