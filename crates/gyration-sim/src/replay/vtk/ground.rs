//! The supports as sheets under the whole motion.

use super::support_surfaces::{Owners, support_surfaces};
use gyration::model::Model;
use gyration::support::{Support, SupportMotion};
use gyration::tensor::Vec3;
use gyration_record::export::vtk::{PolyData, Topology};
use gyration_record::{RecordError, Recording};

/// By how much a sheet is wider than the motion above it.
const MARGIN: f64 = 1.2;

/// A rectangle of each support.
#[derive(Debug, Clone)]
pub(super) struct Sheets {
    sheets: Vec<Sheet>,
    topology: Topology,
}

#[derive(Debug, Clone)]
struct Sheet {
    name: String,
    corners: [Vec3; 4],
    motion: SupportMotion,
}

impl Sheets {
    /// Of the supports of a model; none without any.
    ///
    /// # Errors
    /// Those of reading.
    pub(super) fn of(recording: &Recording, model: &Model) -> Result<Option<Self>, RecordError> {
        if model.supports.is_empty() {
            return Ok(None);
        }
        let (low, high) = extent(recording)?;
        let size = model.bodies.iter().map(|body| body.size).fold(0.0, f64::max);
        let half = 0.5 * MARGIN * ((high - low).max() + size);
        let sheets: Vec<Sheet> =
            model.supports.iter().map(|support| Sheet::under(support, &(0.5 * (low + high)), half)).collect();
        let corners: Vec<i32> = (0..4 * sheets.len()).map(|corner| corner as i32).collect();
        Ok(Some(Self { topology: Topology::new(corners.len(), &[], &corners, 4), sheets }))
    }

    /// Whether any support moves.
    pub(super) fn move_with_time(&self) -> bool {
        self.sheets.iter().any(|sheet| !sheet.motion.is_fixed())
    }

    /// The sheets at a time \[s\].
    pub(super) fn at(&self, time: f64) -> PolyData<'_> {
        let place = |sheet: &Sheet| {
            if sheet.motion.turns() {
                let carried = sheet.motion.carriage(time);
                return sheet.corners.map(|corner| carried.place(&corner));
            }
            let shift = sheet.motion.displacement(time);
            sheet.corners.map(|corner| corner + shift)
        };
        let places: Vec<Vec3> = self.sheets.iter().flat_map(place).collect();
        let numbers: Vec<i32> = (0..self.sheets.len()).map(|support| support as i32).collect();
        let names = self.sheets.iter().map(|sheet| sheet.name.clone()).collect();
        support_surfaces(&self.topology, &places, Owners { cells: numbers, names }, time)
    }
}

impl Sheet {
    /// About the foot of the middle, counter-clockwise seen from the free side.
    fn under(support: &Support, middle: &Vec3, half: f64) -> Self {
        let n = &support.normal;
        let foot = middle - n * (middle - support.origin).dot(n);
        let along = if n.x.abs() < 0.9 { Vec3::x() } else { Vec3::y() };
        let u = (along - n * n.dot(&along)).normalize() * half;
        let v = n.cross(&u);
        let corners = [foot - u - v, foot + u - v, foot + u + v, foot - u + v];
        Self { name: support.name.clone(), corners, motion: support.motion.clone() }
    }
}

/// The smallest and largest coordinates of all centres of mass \[m\].
fn extent(recording: &Recording) -> Result<(Vec3, Vec3), RecordError> {
    let (mut low, mut high) = (Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY));
    for rows in recording.chunks() {
        for position in recording.read_rows("position", rows)?.data.chunks_exact(3) {
            let position = Vec3::from_column_slice(position);
            (low, high) = (low.inf(&position), high.sup(&position));
        }
    }
    Ok((low, high))
}
