//! The keys of an animation: which samples become keys, and what a body's nodes do at them.
//!
//! 60 keys a second, or 300 in all if that is more, are samples. Between keys a player interpolates translation,
//! rotations and scales by themselves. What it shows is compared with the samples that are left out: where one is
//! missed further than the eye can see, because a body turns or strains fast, or goes to and fro, the interval is
//! halved by one of them. Where none is left out the outcome half-way is compared with the natural mean of the two
//! placements of a body that deforms, and a key put in at that mean.

use super::factors::{GradientFactors, natural_mean};
use crate::error::RecordError;
use crate::export::drawing::{Drawing, DrawnBody, DrawnMotion, Mat3, Vec3};
use crate::recording::Recording;

/// Keys a second that the eye asks for.
const KEYS_A_SECOND: f64 = 60.0;
/// Keys of a motion of less than five seconds.
const SHORT_MOTION: f64 = 300.0;
/// Keys of all bodies together, where there are many: a file of some 100 MB.
const ALL_KEYS: f64 = 2e6;
/// By how much P may be missed half-way, relative to itself.
const MISSED: f64 = 1e-3;
/// By how much P may be missed at samples that are left out, relative to itself, and p₀, relative to the size.
const LEFT_OUT: f64 = 1e-2;
/// Keys of a support in a period of its motion: a straight line misses a circle by half a hundredth of its radius.
const KEYS_A_PERIOD: f64 = 32.0;
/// Keys of a support at most: a file of some 60 MB.
const SUPPORT_KEYS: f64 = 2e6;
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
    /// How many of the keys are samples.
    pub samples: usize,
}

/// The track of a body, sample by sample.
pub(super) struct Follower {
    pub(super) track: Track,
    /// The last key.
    last: Option<Pose>,
    /// The samples since then.
    way: Vec<Pose>,
    /// How often an interval without samples may be halved.
    halvings: usize,
    /// The size of the body \[m\].
    size: f64,
    /// So many keys it has at most besides those that it has in any case.
    room: usize,
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

/// The keys of a support \[s\]: those of the bodies, and as many between as its own motion asks for.
pub(super) fn carried_keys(motion: &DrawnMotion, times: &[f64]) -> Vec<f64> {
    let (Some(first), Some(last)) = (times.first(), times.last()) else { return Vec::new() };
    let spacing = (motion.shortest_period() / KEYS_A_PERIOD).max((last - first) / SUPPORT_KEYS);
    let mut keys = vec![*first];
    for pair in times.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        let parts = ((to - from) / spacing).ceil().max(1.0) as usize;
        for k in 1..=parts {
            let time = if k == parts { to } else { from + (to - from) * k as f64 / parts as f64 };
            // A file has times in single precision.
            if keys.last().is_none_or(|last| time as f32 > *last as f32) {
                keys.push(time);
            }
        }
    }
    keys
}

/// The tracks of all bodies, given the samples that are keys in any case.
///
/// # Errors
/// `Corrupt` where det P ≤ 0 or a number is missing; those of reading.
pub(super) fn tracks(recording: &Recording, drawing: &Drawing, keys: &[usize]) -> Result<Vec<Track>, RecordError> {
    let bodies = drawing.bodies.len();
    let room = (ALL_KEYS / bodies.max(1) as f64) as usize;
    let follower = |body: &DrawnBody| Follower::new(body.is_rigid(), body.size, room);
    let mut followers: Vec<Follower> = drawing.bodies.iter().map(follower).collect();
    let mut due = keys.iter().copied().peekable();
    for chunk in recording.chunks() {
        let times = recording.read_rows("time", chunk.clone())?.data;
        let positions = recording.read_rows("position", chunk.clone())?.data;
        let gradients = recording.read_rows("placement_gradient", chunk.clone())?.data;
        if positions.len() != 3 * bodies * chunk.len() || gradients.len() != 9 * bodies * chunk.len() {
            let reason = format!("`position` and `placement_gradient` are not those of {bodies} bodies");
            return Err(RecordError::corrupt(recording.path(), reason));
        }
        for (row, sample) in chunk.enumerate() {
            let is_key = due.next_if_eq(&sample).is_some();
            for (body, follower) in followers.iter_mut().enumerate() {
                let place = row * bodies + body;
                let pose = Pose {
                    time: times[row],
                    position: Vec3::from_column_slice(&positions[3 * place..][..3]),
                    gradient: Mat3::from_row_slice(&gradients[9 * place..][..9]),
                };
                follower.see(pose, is_key).map_err(|time| {
                    let name = &drawing.bodies[body].name;
                    let reason = format!("the placement of `{name}` at {time} s is none: det P must be > 0");
                    RecordError::corrupt(recording.path(), reason)
                })?;
            }
        }
    }
    Ok(followers.into_iter().map(|follower| follower.track).collect())
}

impl Follower {
    /// Of a body of this size \[m\], with room for so many keys.
    pub fn new(is_rigid: bool, size: f64, room: usize) -> Self {
        let halvings = if is_rigid { 0 } else { HALVINGS };
        Self { track: Track::default(), last: None, way: Vec::new(), halvings, size, room }
    }

    /// Takes the next sample; an error is the time at which P is no placement.
    pub fn see(&mut self, pose: Pose, is_key: bool) -> Result<(), f64> {
        let determinant = pose.gradient.determinant();
        if !pose.position.iter().all(|x| x.is_finite()) || determinant.is_nan() || determinant <= 0.0 {
            return Err(pose.time);
        }
        self.way.push(pose);
        if is_key {
            let way = std::mem::take(&mut self.way);
            let halvings = self.halvings;
            self.approach(&way, halvings).ok_or(pose.time)?;
            (self.way, self.last) = (way, Some(pose));
            self.way.clear();
        }
        Ok(())
    }

    /// Adds the last sample of a way as a key, and before it those that are needed; none where P is no placement.
    fn approach(&mut self, way: &[Pose], halvings: usize) -> Option<()> {
        let (to, left_out) = way.split_last()?;
        let last = self.track.factors.last().copied().unwrap_or(GradientFactors::identity());
        let next = last.follow(&to.gradient)?;
        if let Some(from) = self.last.filter(|from| are_apart(from.time, to.time)) {
            let missed = |sample: &Pose| {
                let part = (sample.time - from.time) / (to.time - from.time);
                let place = from.position + part * (to.position - from.position);
                let shown = last.between(&next, part).product();
                (shown - sample.gradient).norm() > LEFT_OUT * sample.gradient.norm()
                    || (place - sample.position).norm() > LEFT_OUT * self.size
            };
            let middle = left_out.len() / 2;
            if self.track.times.len() < self.room && left_out.iter().any(missed) {
                self.approach(&way[..=middle], halvings)?;
                return self.approach(&way[middle + 1..], halvings);
            }
            if left_out.is_empty() && halvings > 0 {
                let mean = natural_mean(&from.gradient, &to.gradient)?;
                if (last.between(&next, 0.5).product() - mean).norm() > MISSED * mean.norm() {
                    let time = 0.5 * (from.time + to.time);
                    let middle = Pose { time, position: 0.5 * (from.position + to.position), gradient: mean };
                    self.approach(&[middle], halvings - 1)?;
                    // It is none that was recorded.
                    self.track.samples -= 1;
                    return self.approach(way, halvings - 1);
                }
            }
        }
        // Times that a file cannot tell apart are one.
        if self.track.times.last().is_some_and(|time| *time as f32 >= to.time as f32) {
            self.track.times.pop();
            self.track.positions.pop();
            self.track.factors.pop();
            self.track.samples = self.track.samples.saturating_sub(1);
        }
        self.track.times.push(to.time);
        self.track.positions.push(to.position);
        self.track.factors.push(next);
        self.track.samples += 1;
        self.last = Some(*to);
        Some(())
    }
}

/// Whether one may stand between two times, which a file has in single precision \[s\].
fn are_apart(from: f64, to: f64) -> bool {
    let [from, middle, to] = [from, 0.5 * (from + to), to].map(|time| time as f32);
    from < middle && middle < to
}
