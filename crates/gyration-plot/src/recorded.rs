//! What pictures need of a recording: bodies and supports as they were described, and samples thinned to what can be
//! seen.

use crate::attributes::{MotionPicture, attribute, described, motion};
use crate::classes::BodyClasses;
use crate::draw::Point;
use crate::error::PlotError;
use crate::solids::SolidSupportPicture;
use crate::thin::Thinner;
use gyration::support::Support;
use gyration::tensor::{Mat3, Vec3};
use gyration_record::Recording;
use gyration_record::export::Outlines;
use serde::{Deserialize, Deserializer};
use serde_json::Value;
use std::ops::Range;
use std::sync::Arc;

/// A recording with its descriptions.
#[derive(Debug)]
pub struct RecordedScene<'a> {
    /// The recording.
    pub recording: &'a Recording,
    /// The bodies, in order.
    pub bodies: Vec<BodyPicture>,
    /// The classes by which they are coloured.
    pub classes: BodyClasses,
    /// The supports, in order.
    pub supports: Vec<Support>,
    /// The supports with a shape, in order.
    pub solid_supports: Vec<SolidSupportPicture>,
    /// Acceleration of gravity [m/s²].
    pub gravity: Vec3,
    /// The samples that are shown.
    rows: Range<usize>,
}

/// From when to when a recording is shown [s]; all of it where nothing is said.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct TimeSpan {
    /// The first time.
    pub from: Option<f64>,
    /// The last time.
    pub to: Option<f64>,
}

/// What a drawing needs of a body.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct BodyPicture {
    /// Its name.
    pub name: String,
    /// The word of the scene for how it may deform.
    pub kind: String,
    /// Its mass [kg].
    pub mass: f64,
    /// The largest side of its bounding box [m].
    pub size: f64,
    /// What it looks like, as all of its surface do.
    #[serde(skip)]
    pub look: Arc<Look>,
    /// V of a body that contracts [m³].
    #[serde(default)]
    pub volume: Option<f64>,
    /// The period of what drives it [s], if that repeats itself.
    #[serde(default)]
    pub period: Option<f64>,
}

impl BodyPicture {
    /// Whether P may be more than a rotation.
    pub fn deforms(&self) -> bool {
        self.kind != "rigid"
    }

    /// Whether it drives itself.
    pub fn contracts(&self) -> bool {
        self.kind == "contractile"
    }
}

/// What a body looks like.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Look {
    /// Its wireframe.
    pub outline: Wireframe,
    /// Points whose projected hull is the projected body, relative to the centre of mass [m].
    pub silhouette: Vec<Vec3>,
}

/// Lines of a body.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
pub struct Wireframe {
    /// Points relative to the centre of mass [m].
    #[serde(deserialize_with = "vectors")]
    pub points: Vec<Vec3>,
    /// Lines through points, by index.
    pub polylines: Vec<Vec<usize>>,
}

#[derive(Deserialize)]
struct SupportPicture {
    name: String,
    origin: [f64; 3],
    normal: [f64; 3],
    motion: Option<MotionPicture>,
}

impl From<SupportPicture> for Support {
    fn from(picture: SupportPicture) -> Self {
        let motion = motion(picture.motion);
        Self { name: picture.name, origin: picture.origin.into(), normal: picture.normal.into(), motion }
    }
}

/// The bodies as they are described.
fn bodies(recording: &Recording) -> Result<Vec<BodyPicture>, PlotError> {
    let attributes = recording.attributes();
    let all = attributes.get("bodies").and_then(Value::as_array);
    let Some(all) = all else { return attribute(recording, "bodies") };
    let mut looks = Outlines::of(attributes);
    let body = |body: &Value| {
        let look = looks.shared(body, |part| {
            let silhouette: Vec<[f64; 3]> = described(recording, "bodies", part("silhouette"))?;
            let silhouette = silhouette.into_iter().map(Vec3::from).collect();
            Ok::<_, PlotError>(Look { outline: described(recording, "bodies", part("outline"))?, silhouette })
        })?;
        Ok(BodyPicture { look, ..described(recording, "bodies", body)? })
    };
    all.iter().map(body).collect()
}

/// Points from rows of three numbers.
fn vectors<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<Vec3>, D::Error> {
    let rows = Vec::<[f64; 3]>::deserialize(from)?;
    Ok(rows.into_iter().map(Vec3::from).collect())
}

/// Where a body is at a sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// Centre of mass [m].
    pub position: Vec3,
    /// Placement gradient.
    pub gradient: Mat3,
}

impl<'a> RecordedScene<'a> {
    /// Reads the descriptions.
    ///
    /// # Errors
    /// [`PlotError::Attribute`] if one is missing or is not what it should be.
    pub fn new(recording: &'a Recording) -> Result<Self, PlotError> {
        let supports: Vec<SupportPicture> = attribute(recording, "supports")?;
        let bodies = bodies(recording)?;
        let named = bodies.iter().map(|body| (body.name.as_str(), body.kind.as_str()));
        let classes = BodyClasses::of(named, recording.attributes().get("resolved").unwrap_or(&Value::Null));
        Ok(Self {
            recording,
            bodies,
            classes,
            supports: supports.into_iter().map(Support::from).collect(),
            solid_supports: SolidSupportPicture::all(recording)?,
            gravity: attribute::<[f64; 3]>(recording, "gravity")?.into(),
            rows: 0..recording.rows(),
        })
    }

    /// The same of the samples within a span.
    ///
    /// # Errors
    /// [`PlotError::Arguments`] if there are none; those of reading.
    pub fn within(self, span: TimeSpan) -> Result<Self, PlotError> {
        if span == TimeSpan::default() {
            return Ok(self);
        }
        let times = self.recording.read("time")?.data;
        // A time that is written means the sample at it, whatever rounding has left.
        let rounding = 1e-12 * times.last().map_or(0.0, |last| last.abs());
        let first = times.partition_point(|time| *time < span.from.unwrap_or(f64::NEG_INFINITY) - rounding);
        let end = times.partition_point(|time| *time <= span.to.unwrap_or(f64::INFINITY) + rounding);
        if first >= end {
            let [from, to] = [times.first(), times.last()].map(|time| time.copied().unwrap_or_default());
            let fix = format!("the recording has {} of them, from {from} to {to} s", times.len());
            return Err(PlotError::arguments("no sample is within that span", fix));
        }
        Ok(Self { rows: first..end, ..self })
    }

    /// The samples that are shown.
    pub fn rows(&self) -> Range<usize> {
        self.rows.clone()
    }

    /// The direction against gravity; the first support's normal without gravity, z without either.
    pub fn up(&self) -> Vec3 {
        let against = -self.gravity;
        if against.norm() > 0.0 {
            return against.normalize();
        }
        self.supports.first().map_or(Vec3::z(), |support| support.normal)
    }

    /// Whether there is an array of this name.
    pub fn has(&self, array: &str) -> bool {
        self.recording.array(array).is_ok()
    }

    /// The time of the first and of the last sample [s].
    ///
    /// # Errors
    /// Those of reading.
    pub fn span(&self) -> Result<(f64, f64), PlotError> {
        let Range { start, end } = self.rows;
        if end == start {
            return Err(PlotError::Empty { path: self.recording.path().to_path_buf() });
        }
        let time = |row: usize| Ok::<_, PlotError>(self.recording.read_rows("time", row..row + 1)?.data[0]);
        Ok((time(start)?, time(end - 1)?))
    }

    /// Lines over time: `value(row, k)` of line k, from the rows of the named arrays.
    ///
    /// # Errors
    /// Those of reading.
    pub fn lines(
        &self,
        arrays: &[&str],
        count: usize,
        value: impl Fn(&[&[f64]], usize) -> f64,
    ) -> Result<Vec<Vec<Point>>, PlotError> {
        let mut thinners = self.thinners(count);
        self.each_row(arrays, |time, row| {
            thinners.iter_mut().enumerate().for_each(|(k, thinner)| thinner.push(time, value(row, k)));
        })?;
        Ok(thinners.into_iter().map(Thinner::finish).collect())
    }

    /// So many lines to be filled, sample by sample.
    pub fn thinners(&self, count: usize) -> Vec<Thinner> {
        vec![Thinner::new(self.rows.len()); count]
    }

    /// Goes once through the samples: the time [s] and the rows of the named arrays.
    ///
    /// # Errors
    /// Those of reading.
    pub fn each_row(&self, arrays: &[&str], mut each: impl FnMut(f64, &[&[f64]])) -> Result<(), PlotError> {
        let shown = |rows: Range<usize>| rows.start.max(self.rows.start)..rows.end.min(self.rows.end);
        for rows in self.recording.chunks().map(shown).filter(|rows| !rows.is_empty()) {
            let times = self.recording.read_rows("time", rows.clone())?.data;
            let read = |name: &&str| self.recording.read_rows(name, rows.clone());
            let chunk = arrays.iter().map(read).collect::<Result<Vec<_>, _>>()?;
            for (index, time) in times.iter().enumerate() {
                let row_of = |data: &'_ [f64]| {
                    let stride = data.len() / times.len();
                    index * stride..(index + 1) * stride
                };
                let row: Vec<&[f64]> = chunk.iter().map(|array| &array.data[row_of(&array.data)]).collect();
                each(*time, &row);
            }
        }
        Ok(())
    }

    /// The time of a sample and where every body is then.
    ///
    /// # Errors
    /// Those of reading.
    pub fn poses(&self, row: usize) -> Result<(f64, Vec<Pose>), PlotError> {
        let read = |name: &str| self.recording.read_rows(name, row..row + 1);
        let (time, positions, gradients) = (read("time")?, read("position")?, read("placement_gradient")?);
        let poses = positions.data.chunks_exact(3).zip(gradients.data.chunks_exact(9));
        let poses =
            poses.map(|(p, g)| Pose { position: Vec3::from_column_slice(p), gradient: Mat3::from_row_slice(g) });
        Ok((time.data[0], poses.collect()))
    }
}
