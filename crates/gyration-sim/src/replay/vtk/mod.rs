//! A recording as a time series for ParaView: the surfaces of the bodies with all that is known at their points.
//!
//! One `.vtp` a sample holds all bodies, so that a series is one thing to open, to colour and to play; `Threshold` by
//! `body` takes one out. The planes are a second part of each time, supports with a shape a third.
//!
//! | at | array | unit | what |
//! |---|---|---|---|
//! | points | `velocity` | m/s | ṗ₀ + Ṗ X |
//! | points | `gap` | m | distance to the nearest plane |
//! | cells | `body` | – | index of the body; its name in `body_names` |
//! | cells | `traction` | Pa | mean of all laws, with planes and other bodies, per current area: times the area, the contact force on the cell |
//! | cells | `cauchy_stress`, `von_mises` | Pa | mean stress of a body that deforms, NaN of a rigid one |
//! | whole | `TimeValue`, `energy_…`, `work_…`, `contact_force`, `body_names` | s, J, N | as recorded |

mod figures;
mod ground;
mod solids;
mod support_surfaces;

use super::{BodySnapshot, Replay, ReplayError, Snapshot, SurfaceCells};
use figures::Figures;
use ground::Sheets;
use gyration::tensor::{Mat3, Vec3};
use gyration_record::export::vtk::{CompressedNumbers, DataArray, PolyData, SeriesFile, Whole, WholeValues, vtp};
use gyration_record::{RecordError, Recording};
use solids::SolidFigures;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

/// Writes the samples of a recording one by one.
#[derive(Debug, Clone)]
pub struct SurfaceSeries {
    recording: Recording,
    replay: Replay,
    figures: Figures,
    sheets: Option<Sheets>,
    solids: Option<SolidFigures>,
    /// Names of the arrays that have one number a sample.
    scalars: Vec<String>,
}

impl SurfaceSeries {
    /// Prepares what does not change with time.
    ///
    /// # Errors
    /// Those of [`Replay::open`]; `Record` if the recording cannot be read.
    pub fn open(recording: &Recording) -> Result<Self, ReplayError> {
        let replay = Replay::open(recording)?;
        let scalar = recording.arrays().iter().filter(|array| array.dims == ["time"] && array.name != "time");
        Ok(Self {
            figures: Figures::of(replay.model()),
            sheets: Sheets::of(recording, replay.model())?,
            solids: SolidFigures::of(replay.model()),
            scalars: scalar.map(|array| array.name.clone()).collect(),
            recording: recording.clone(),
            replay,
        })
    }

    /// How many cells a sample has.
    pub fn cells(&self) -> usize {
        self.figures.topology().cells()
    }

    /// Writes the files of a sample into a folder; returns how a list in that folder names them.
    ///
    /// # Errors
    /// Those of [`Replay::state`]; `Inadmissible`; `Record` with the file that cannot be written.
    pub fn write(&mut self, row: usize, folder: &Path) -> Result<Vec<SeriesFile>, ReplayError> {
        let (stress, field_data) = (self.replay.cauchy_stress(row)?, self.field_data(row)?);
        let snapshot = self.replay.snapshot(row)?;
        let time = snapshot.state().time;
        let sample = VtkSample { figures: &self.figures, snapshot, stress };
        let data = PolyData { field_data, ..sample.poly_data()? };
        let mut entries = vec![SeriesFile { time, part: 0, file: format!("bodies-{row:06}.vtp") }];
        write(&data, &folder.join(&entries[0].file))?;
        if let Some(sheets) = &self.sheets {
            // Supports that stand still need one file for all times.
            let shown = if sheets.move_with_time() { row } else { 0 };
            let file = format!("supports-{shown:06}.vtp");
            if sheets.move_with_time() || !folder.join(&file).exists() {
                write(&sheets.at(time), &folder.join(&file))?;
            }
            entries.push(SeriesFile { time, part: 1, file });
        }
        if let Some(solids) = &self.solids {
            let shown = if solids.move_with_time() { row } else { 0 };
            let file = format!("solid-supports-{shown:06}.vtp");
            if solids.move_with_time() || !folder.join(&file).exists() {
                write(&solids.at(time), &folder.join(&file))?;
            }
            entries.push(SeriesFile { time, part: if self.sheets.is_some() { 2 } else { 1 }, file });
        }
        Ok(entries)
    }

    fn field_data(&self, row: usize) -> Result<Vec<Whole>, RecordError> {
        let whole = |name: &str, components: usize, numbers: Vec<f64>| Whole {
            name: name.to_owned(),
            values: WholeValues::Numbers(components, numbers),
        };
        let read = |name: &str| Ok::<_, RecordError>(self.recording.read_rows(name, row..row + 1)?.data);
        let mut all = vec![whole("TimeValue", 1, read("time")?)];
        for name in &self.scalars {
            all.push(whole(name, 1, read(name)?));
        }
        all.push(whole("contact_force", 3, read("contact_force")?));
        let names = self.replay.model().names().map(str::to_owned).collect();
        all.push(Whole { name: "body_names".into(), values: WholeValues::Names(names) });
        Ok(all)
    }
}

/// What is known at one sample.
struct VtkSample<'a> {
    figures: &'a Figures,
    snapshot: Snapshot<'a>,
    /// Of each body; none of a rigid one.
    stress: Vec<Option<Mat3>>,
}

impl<'a> VtkSample<'a> {
    /// The surface, without the arrays of the whole.
    fn poly_data(&self) -> Result<PolyData<'a>, ReplayError> {
        let model = self.snapshot.model();
        let touch = !model.contacts().is_empty() || !model.rules().is_empty();
        let deform = self.stress.iter().any(Option::is_some);
        let velocity = self.at_points(|body, x| body.motion().velocity.at(x).into());
        let mut point_data = vec![DataArray { name: "velocity", units: "m/s", components: 3, values: velocity }];
        if !model.supports.is_empty() {
            let values = self.at_points(|body, x| [body.gap(x)]);
            point_data.push(DataArray { name: "gap", units: "m", components: 1, values });
        }
        let bodies = self.figures.bodies_of_cells();
        let numbers = CompressedNumbers::integers(bodies.iter().map(|body| *body as i32));
        let mut cell_data = vec![DataArray { name: "body", units: "", components: 1, values: numbers }];
        if touch {
            cell_data.push(DataArray {
                name: "traction",
                units: "Pa",
                components: 3,
                values: self.tractions(&bodies)?,
            });
        }
        if deform {
            let of_body: Vec<Mat3> = self.stress.iter().map(|it| it.unwrap_or(Mat3::repeat(f64::NAN))).collect();
            // Rows, where nalgebra has columns.
            let rows =
                CompressedNumbers::floats(bodies.iter().flat_map(|body| of_body[*body].transpose().data.0).flatten());
            let equivalent: Vec<f64> = of_body.iter().map(von_mises).collect();
            let scalars = CompressedNumbers::floats(bodies.iter().map(|body| equivalent[*body]));
            cell_data.push(DataArray { name: "cauchy_stress", units: "Pa", components: 9, values: rows });
            cell_data.push(DataArray { name: "von_mises", units: "Pa", components: 1, values: scalars });
        }
        Ok(PolyData {
            topology: self.figures.topology(),
            points: self.at_points(|body, x| body.place(x).into()),
            point_data,
            cell_data,
            field_data: Vec::new(),
        })
    }

    /// The values at all points.
    fn at_points<const N: usize>(&self, value: impl Fn(&BodySnapshot, &Vec3) -> [f64; N]) -> CompressedNumbers {
        let mut values = Vec::new();
        for (index, points) in self.figures.points().enumerate() {
            let body = self.snapshot.body(index);
            values.extend(points.iter().flat_map(|point| value(&body, point)));
        }
        CompressedNumbers::floats(values)
    }

    /// Of all cells; single points bear none.
    fn tractions(&self, bodies: &[usize]) -> Result<CompressedNumbers, ReplayError> {
        let skins: Vec<Option<&SurfaceCells>> = self.figures.skins().collect();
        let of_triangles: Vec<Vec3> = self.snapshot.mean_tractions(&skins)?.into_iter().flatten().collect();
        let points = bodies.len() - of_triangles.len();
        let all = std::iter::repeat_n(Vec3::zeros(), points).chain(of_triangles);
        Ok(CompressedNumbers::floats(all.flat_map(<[f64; 3]>::from)))
    }
}

/// √(3/2 |dev σ|²), the stress of von Mises \[Pa\].
fn von_mises(stress: &Mat3) -> f64 {
    let deviator = stress - Mat3::from_diagonal_element(stress.trace() / 3.0);
    (1.5 * deviator.norm_squared()).sqrt()
}

fn write(data: &PolyData, path: &Path) -> Result<(), RecordError> {
    let failed = |source| RecordError::Io { action: "write", path: path.to_path_buf(), source };
    let mut out = BufWriter::new(File::create(path).map_err(failed)?);
    vtp(data, &mut out).and_then(|()| out.flush()).map_err(failed)
}
