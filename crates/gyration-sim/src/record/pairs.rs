//! What acts between two, sample by sample: the group `pairs` of a recording, and its table.
//!
//! A body is told by its index i ≥ 0, a support by −1 − i: the planes first, then the supports with a shape, each in
//! the order of the scene. What does not apply is NaN.

use gyration::dynamics::{Exchange, ExchangeKind};
use gyration::load::Party;
use gyration::model::Model;
use gyration::tensor::Mat3;
use gyration_record::{Array, ArraySpec, Dimension, Ragged, RaggedArray, RecordError, Recording, cannot_write};
use serde_json::Value;
use std::io::Write;

/// The group of a recording.
const GROUP: &str = "pairs";
/// Entries in a chunk for each body, and at most: 5 MB of them.
const CHUNK_ENTRIES: usize = 64;
const MOST_CHUNK_ENTRIES: usize = 1 << 14;

/// Name, unit, dimensions and meaning of each array, in the order of an entry.
const ARRAYS: [(&str, &str, &[&str], &str); 12] = [
    ("first", "", &[], "index of the first body"),
    ("second", "", &[], "index of the second body, -1 - index of a support"),
    ("cell", "1", &["cell"], "cell of the second as seen from that of the first; NaN without a lattice"),
    ("kind", "", &[], "what acts"),
    ("gap", "m", &[], "smallest gap of a contact"),
    ("normal", "1", &["row"], "normal of a contact, towards the first"),
    ("point", "m", &["row"], "where repulsion passes through the plane; where a spring or bond holds the first"),
    ("force", "N", &["row"], "force on the first; on the second it is the opposite"),
    ("moment_first", "J", &["row", "col"], "affine moment N = P M^T on the first, about its centre of mass"),
    ("moment_second", "J", &["row", "col"], "affine moment N = P M^T on the second; NaN of a support"),
    ("power_damping", "W", &[], "power of the damping of a contact on both"),
    ("power_friction", "W", &[], "power of the friction of a contact on both"),
];

/// The header of the table.
const HEADER: &str = "t,first,second,cell_1,cell_2,cell_3,kind,gap,nx,ny,nz,x,y,z,fx,fy,fz,\
                      N1_xx,N1_xy,N1_xz,N1_yx,N1_yy,N1_yz,N1_zx,N1_zy,N1_zz,\
                      N2_xx,N2_xy,N2_xz,N2_yx,N2_yy,N2_yz,N2_zx,N2_zy,N2_zz,power.damping,power.friction";

/// The layout of the group for a model.
pub(super) fn layout(model: &Model) -> Ragged {
    let array = |(name, units, dims, description): (&str, &str, &[&str], &str)| RaggedArray {
        spec: ArraySpec {
            name: name.into(),
            dims: dims.iter().map(|dim| Dimension::new(*dim, 3)).collect(),
            units: units.into(),
            description: description.into(),
            columns: Vec::new(),
        },
        codes: match name {
            "first" | "second" => Some(Vec::new()),
            "kind" => Some(ExchangeKind::NAMES.map(String::from).into()),
            _ => None,
        },
    };
    let chunk_entries = CHUNK_ENTRIES.saturating_mul(model.bodies.len().next_power_of_two()).min(MOST_CHUNK_ENTRIES);
    Ragged { name: GROUP.into(), arrays: ARRAYS.map(array).into(), chunk_entries }
}

/// What acts between two, as the numbers of the entries of a sample.
pub fn entries<'a>(model: &Model, exchanges: &[Exchange], room: &'a mut Vec<f64>) -> &'a [f64] {
    room.clear();
    exchanges.iter().for_each(|exchange| push_entry(model, exchange, room));
    room
}

/// Appends the numbers of an entry.
fn push_entry(model: &Model, exchange: &Exchange, out: &mut Vec<f64>) {
    let Exchange { parties, cell, kind, gap, normal, point, force, moments, powers } = exchange;
    out.extend(parties.map(|party| index(model, party)));
    let in_lattice = !model.lattice.vectors().is_empty() && parties[1].body().is_some();
    out.extend(cell.map(|n| if in_lattice { f64::from(n) } else { f64::NAN }));
    out.push(f64::from(*kind as u8));
    out.push(gap.unwrap_or(f64::NAN));
    for vector in [*normal, *point, Some(*force)] {
        out.extend(vector.map_or([f64::NAN; 3], <[f64; 3]>::from));
    }
    for moment in moments {
        // nalgebra stores columns; rows are recorded.
        out.extend(moment.unwrap_or(Mat3::repeat(f64::NAN)).transpose().iter());
    }
    out.extend(powers.unwrap_or([f64::NAN; 2]));
}

fn index(model: &Model, party: Party) -> f64 {
    match party {
        Party::Body(index) => index as f64,
        Party::Support(index) => -1.0 - index as f64,
        Party::SolidSupport(index) => -1.0 - (model.supports.len() + index) as f64,
        Party::Space => f64::NAN,
    }
}

/// Writes what acts between two as CSV: a line a sample and pair, with the names of bodies and supports.
///
/// # Errors
/// `NoSuchArray` if the recording has no pairs; those of reading; `Io` if `out` fails, under the recording's path.
pub fn pairs_csv(recording: &Recording, out: &mut impl Write) -> Result<(), RecordError> {
    recording.array(&format!("{GROUP}/first"))?;
    let bodies = recording.labels("body")?.unwrap_or_default();
    let supports = support_names(recording);
    let kinds = &recording.array(&format!("{GROUP}/kind"))?.meanings;
    let failed = || cannot_write(recording.path());
    writeln!(out, "{HEADER}").map_err(failed())?;
    for rows in recording.chunks() {
        let times = recording.read_rows("time", rows.clone())?.data;
        let entries = rows.map(|row| recording.entries(row)).collect::<Result<Vec<_>, _>>()?;
        let Some((first, last)) = entries.first().zip(entries.last()) else { continue };
        // Whole chunks at once: each read decodes those that it touches.
        let start = first.start;
        let all = ARRAYS.map(|(name, ..)| recording.read_rows(&format!("{GROUP}/{name}"), start..last.end));
        let arrays = all.into_iter().collect::<Result<Vec<Array>, _>>()?;
        for (entries, time) in entries.into_iter().zip(times) {
            for entry in entries.start - start..entries.end - start {
                write!(out, "{time:.16e}").map_err(failed())?;
                for (array, (name, ..)) in arrays.iter().zip(ARRAYS) {
                    let width = array.shape.iter().skip(1).product::<usize>();
                    for number in &array.data[entry * width..][..width] {
                        let named = match name {
                            "first" | "second" if *number < 0.0 => supports.get((-1.0 - number) as usize),
                            "first" | "second" => bodies.get(*number as usize),
                            "kind" => kinds.get(*number as usize),
                            _ => None,
                        };
                        match named {
                            Some(name) => write!(out, ",{name}"),
                            // 17 significant digits read back as the same number in any language.
                            None if number.is_finite() => write!(out, ",{number:.16e}"),
                            None => write!(out, ",{number}"),
                        }
                        .map_err(failed())?;
                    }
                }
                writeln!(out).map_err(failed())?;
            }
        }
    }
    Ok(())
}

/// The names of planes, then of supports with a shape.
fn support_names(recording: &Recording) -> Vec<String> {
    let listed = |key: &str| recording.attributes().get(key).and_then(Value::as_array);
    let all = ["supports", "solid_supports"].into_iter().filter_map(listed).flatten();
    all.map(|support| support.get("name").and_then(Value::as_str).unwrap_or_default().to_owned()).collect()
}
