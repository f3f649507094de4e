//! The keys of an animation: which samples become keys, and what a body's nodes do at them.
//!
//! At most 60 keys a second, or 300 in all if that is more; all but those between two halvings are samples. Between
//! keys a player interpolates translation, rotations and scales by themselves. Of a body that deforms the outcome
//! half-way is compared with the natural mean of the two placements: where it is further off than the eye can see,
//! because the axes of stretch turn, the interval is halved by a key at that mean.

use super::factors::{GradientFactors, natural_mean};
use crate::error::RecordError;
use crate::export::drawing::{Drawing, DrawnBody, Mat3, Vec3};
use crate::recording::Recording;

/// Keys a second that the eye asks for.
const KEYS_A_SECOND: f64 = 60.0;
/// Keys of a motion of less than five seconds.
const SHORT_MOTION: f64 = 300.0;
/// Keys of all bodies together, where there are many: a file of some 100 MB.
const ALL_KEYS: f64 = 2e6;
/// By how much P may be missed half-way, relative to itself.
const MISSED: f64 = 1e-3;
/// How often an interval is halved at most.
const HALVINGS: usize = 6;

/// A body at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Pose {
    /// \[s\].
    pub time: f64,
    /// p₀ \[m\].
    pub position: Vec3,
    /// P.
    pub gradient: Mat3,
}

/// What the nodes of a body do.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Track {
    /// Of the keys \[s\].
    pub times: Vec<f64>,
    /// p₀ \[m\].
    pub positions: Vec<Vec3>,
    /// P; of a rigid body a rotation alone.
    pub factors: Vec<GradientFactors>,
}

/// The samples that become keys.
pub(super) fn keys(times: &[f64], bodies: usize) -> Vec<usize> {
    let (Some(first), Some(last)) = (times.first(), times.last()) else { return Vec::new() };
    let duration = last - first;
    let most = (KEYS_A_SECOND * duration).max(SHORT_MOTION).min(ALL_KEYS / bodies.max(1) as f64);
    // Multiples of a decimal spacing are so to rounding only.
    let spacing = duration / most * (1.0 - 1e-6);
    let mut chosen = vec![0];
    let mut due = first + spacing;
    for (row, time) in times.iter().enumerate().skip(1) {
        if *time >= due || row + 1 == times.len() {
            chosen.push(row);
            due = time + spacing;
        }
    }
    chosen
}

/// The poses of every body at some rows, in order.
///
/// # Errors
/// Those of reading.
pub(super) fn poses(recording: &Recording, bodies: usize, rows: &[usize]) -> Result<Vec<Vec<Pose>>, RecordError> {
    let mut poses = vec![Vec::with_capacity(rows.len()); bodies];
    for chunk in recording.chunks() {
        let wanted = rows.iter().filter(|row| chunk.contains(row)).map(|row| row - chunk.start);
        let mut wanted = wanted.peekable();
        if wanted.peek().is_none() {
            continue;
        }
        let times = recording.read_rows("time", chunk.clone())?.data;
        let positions = recording.read_rows("position", chunk.clone())?.data;
        let gradients = recording.read_rows("placement_gradient", chunk.clone())?.data;
        if positions.len() != 3 * bodies * chunk.len() || gradients.len() != 9 * bodies * chunk.len() {
            let reason = format!("`position` and `placement_gradient` are not those of {bodies} bodies");
            return Err(RecordError::corrupt(recording.path(), reason));
        }
        for row in wanted {
            for (body, poses) in poses.iter_mut().enumerate() {
                let place = row * bodies + body;
                poses.push(Pose {
                    time: times[row],
                    position: Vec3::from_column_slice(&positions[3 * place..][..3]),
                    gradient: Mat3::from_row_slice(&gradients[9 * place..][..9]),
                });
            }
        }
    }
    Ok(poses)
}

/// The tracks of all bodies.
///
/// # Errors
/// `Corrupt` where det P ≤ 0 or a number is missing; those of reading.
pub(super) fn tracks(recording: &Recording, drawing: &Drawing, rows: &[usize]) -> Result<Vec<Track>, RecordError> {
    let poses = poses(recording, drawing.bodies.len(), rows)?;
    let one = |(figure, poses): (&DrawnBody, &Vec<Pose>)| {
        Track::of(poses, figure.is_rigid()).map_err(|time| {
            let reason = format!("the placement of `{}` at {time} s is none: det P must be > 0", figure.name);
            RecordError::corrupt(recording.path(), reason)
        })
    };
    drawing.bodies.iter().zip(&poses).map(one).collect()
}

impl Track {
    /// Follows the poses of a body; an error is the time at which P is no placement.
    pub fn of(poses: &[Pose], is_rigid: bool) -> Result<Self, f64> {
        let mut track = Self::default();
        let halvings = if is_rigid { 0 } else { HALVINGS };
        for pair in poses.first().iter().map(|first| [*first, *first]).chain(poses.windows(2).map(|p| [&p[0], &p[1]])) {
            if !pair[1].position.iter().all(|x| x.is_finite()) || track.approach(pair[0], pair[1], halvings).is_none() {
                return Err(pair[1].time);
            }
        }
        Ok(track)
    }

    /// Adds the key `to`, and before it those that the way there needs; none where P is no placement.
    fn approach(&mut self, from: &Pose, to: &Pose, halvings: usize) -> Option<()> {
        let last = self.factors.last().copied().unwrap_or(GradientFactors::identity());
        let next = last.follow(&to.gradient)?;
        if halvings > 0 && to.time > from.time {
            let mean = natural_mean(&from.gradient, &to.gradient)?;
            if (last.half_way(&next).product() - mean).norm() > MISSED * mean.norm() {
                let middle = Pose {
                    time: 0.5 * (from.time + to.time),
                    position: 0.5 * (from.position + to.position),
                    gradient: mean,
                };
                self.approach(from, &middle, halvings - 1)?;
                return self.approach(&middle, to, halvings - 1);
            }
        }
        self.times.push(to.time);
        self.positions.push(to.position);
        self.factors.push(next);
        Some(())
    }
}
