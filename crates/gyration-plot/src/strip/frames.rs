//! The times of a strip, and what is seen at each of them.

use super::ground::{Ground, Site};
use super::silhouette::Silhouette;
use super::strays::{Strays, strays};
use super::view::{self, View, ViewCriteria};
use crate::draw::Point;
use crate::error::PlotError;
use crate::recorded::{Pose, RecordedScene};
use gyration::support::Support;
use gyration::tensor::{Mat3, Vec3};
use std::ops::Range;

/// Samples by which the motion is judged.
const PROBES: usize = 400;
/// Times in a picture for all of them: as many of these as leave the bodies room.
const STROBE_TIMES: [usize; 4] = [16, 12, 9, 7];
/// Pictures of one time each: a number that fills rows of many lengths.
pub const FRAMES: usize = 12;
/// Bodies drawn at most, each to be told from the others.
const MOST_BODIES: usize = 60;
/// Bodies of a crowd drawn at most.
const MOST_OF_CROWD: usize = 2000;
/// A centre that has moved less than this fraction of the size has not moved to the eye.
const VISIBLE: f64 = 0.02;
/// Half the side of a patch of a support, as a fraction of the largest body's size.
const PATCH: f64 = 0.8;

/// What is seen at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct Outlines {
    /// When [s].
    pub time: f64,
    /// The bodies.
    pub bodies: Vec<Silhouette>,
    /// The supports.
    pub grounds: Vec<Ground>,
}

/// A force from one place to another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Chain {
    /// Where it begins and ends.
    pub ends: [Point; 2],
    /// The force, of the largest that is drawn.
    pub weight: f64,
}

/// Outlines at successive times.
#[derive(Debug, Clone, PartialEq)]
pub struct Strip {
    /// The times, in order.
    pub frames: Vec<Outlines>,
    /// Whether all times share one picture.
    pub shared: bool,
    /// The way of each centre.
    pub paths: Vec<Vec<Point>>,
    /// Bodies that are not drawn.
    pub left_out: usize,
    /// Bodies that fly off, by index and name: the picture does not reach as far.
    pub strays: Vec<(usize, String)>,
    /// A point of the picture, and how far from it strays are shown [m].
    pub room: (Point, f64),
    /// The colour of each body.
    pub hues: Vec<usize>,
    /// Names of the colours, where they do not stand for single bodies.
    pub classes: Vec<String>,
    /// Forces of a crowd, the weakest first.
    pub chains: Vec<Chain>,
}

/// A body that is sampled, at one time.
struct Probe {
    time: f64,
    poses: Vec<Pose>,
}

/// A motion as it is seen from one side.
struct Watched<'a> {
    recorded: &'a RecordedScene<'a>,
    probes: Vec<Probe>,
    strays: Strays,
    view: View,
    /// The probe with which the picture ends.
    last: usize,
    /// How many bodies are drawn.
    drawn: usize,
}

impl<'a> Watched<'a> {
    fn of(recorded: &'a RecordedScene<'a>) -> Result<Self, PlotError> {
        Self::of_first(MOST_BODIES, recorded)
    }

    /// With so many bodies at most.
    fn of_first(most: usize, recorded: &'a RecordedScene<'a>) -> Result<Self, PlotError> {
        recorded.span()?;
        let probes = probes(recorded)?;
        let drawn = recorded.bodies.len().min(most);
        let ways: Vec<Vec<Vec3>> = (0..drawn).map(|body| way(body, &probes)).collect();
        let strays = strays(&ways, &recorded.bodies[..drawn].iter().map(|body| body.size).collect::<Vec<_>>());
        let view = View::of(&motion(recorded, &probes, &strays), recorded.up());
        let last = until_rest(recorded, &probes);
        Ok(Self { recorded, probes, strays, view, last, drawn })
    }

    /// So many times, evenly.
    fn frames(&self, count: usize) -> Vec<Outlines> {
        let indices = evenly(count, self.last + 1);
        indices.map(|index| self.frame(&self.probes[index])).collect()
    }

    fn frame(&self, probe: &Probe) -> Outlines {
        frame(self.recorded, probe, &self.view, self.drawn)
    }

    /// What is seen at a sample alone.
    fn at(&self, row: usize) -> Result<Strip, PlotError> {
        let (time, poses) = self.recorded.poses(row)?;
        let strip = self.strip(vec![self.frame(&Probe { time, poses })], true);
        // What is seen then fills the picture, not where it comes from and goes.
        Ok(Strip { paths: Vec::new(), ..strip })
    }

    /// The strip of these times.
    fn strip(&self, frames: Vec<Outlines>, shared: bool) -> Strip {
        let Self { recorded, probes, strays, view, drawn, .. } = self;
        let path = |body: usize| probes.iter().map(|probe| view.project(&probe.poses[body].position)).collect();
        Strip {
            shared,
            frames,
            paths: (0..*drawn).map(path).collect(),
            left_out: recorded.bodies.len() - drawn,
            chains: Vec::new(),
            room: (view.project(&strays.middle), strays.radius),
            strays: strays.bodies.iter().map(|body| (*body, recorded.bodies[*body].name.clone())).collect(),
            hues: recorded.classes.of_body.clone(),
            classes: if recorded.classes.are_bodies() {
                Vec::new()
            } else {
                (0..recorded.classes.names.len()).map(|class| recorded.classes.label(class)).collect()
            },
        }
    }
}

impl Strip {
    /// The strip of a recording.
    ///
    /// # Errors
    /// [`PlotError`] where it cannot be read or has no samples.
    pub fn of(recorded: &RecordedScene) -> Result<Self, PlotError> {
        let watched = Watched::of(recorded)?;
        let still = !supports_move(recorded, &watched.probes);
        let strobe = STROBE_TIMES.into_iter().filter(|_| still).find_map(|count| {
            let kept = without_overlaps(watched.frames(count));
            // Where a third of the times had to be left out, the rest does not tell the motion.
            (kept.len() * 3 >= 2 * count.min(watched.last + 1) && kept.len() > 3).then_some(kept)
        });
        let shared = strobe.is_some();
        Ok(watched.strip(strobe.unwrap_or_else(|| watched.frames(FRAMES)), shared))
    }

    /// The sample of a recording nearest to a time \[s\], or the last.
    ///
    /// # Errors
    /// As there.
    pub fn at(recorded: &RecordedScene, time: Option<f64>) -> Result<Self, PlotError> {
        let watched = Watched::of(recorded)?;
        let rows = recorded.rows();
        let row = match time {
            None => rows.end - 1,
            Some(time) => nearest(rows, time, |row| Ok(recorded.poses(row)?.0))?,
        };
        watched.at(row)
    }

    /// A crowd at a sample, with forces from one place to another \[N\].
    ///
    /// # Errors
    /// As there.
    pub fn with_forces(
        recorded: &RecordedScene,
        row: usize,
        forces: impl IntoIterator<Item = ([Vec3; 2], f64)>,
    ) -> Result<Self, PlotError> {
        let watched = Watched::of_first(MOST_OF_CROWD, recorded)?;
        let mut forces: Vec<([Vec3; 2], f64)> = forces.into_iter().collect();
        forces.sort_by(|(_, one), (_, other)| one.total_cmp(other));
        let largest = forces.last().map_or(1.0, |(_, force)| *force);
        let chain = |(ends, force): ([Vec3; 2], f64)| Chain {
            ends: ends.map(|end| watched.view.project(&end)),
            weight: force / largest,
        };
        let chains = forces.into_iter().map(chain).collect();
        Ok(Self { chains, ..watched.at(row)? })
    }

    /// So many times of a recording, evenly, each a picture of its own, and whether a support moves.
    ///
    /// # Errors
    /// As there.
    pub fn of_times(recorded: &RecordedScene, count: usize) -> Result<(Self, bool), PlotError> {
        let watched = Watched::of(recorded)?;
        Ok((watched.strip(watched.frames(count), false), supports_move(recorded, &watched.probes)))
    }
}

/// The row whose time is nearest; of times that grow.
fn nearest(
    rows: Range<usize>,
    time: f64,
    time_of: impl Fn(usize) -> Result<f64, PlotError>,
) -> Result<usize, PlotError> {
    let (mut low, mut high) = (rows.start, rows.end - 1);
    while high - low > 1 {
        let middle = usize::midpoint(low, high);
        if time_of(middle)? <= time { low = middle } else { high = middle }
    }
    let is_first = (time - time_of(low)?).abs() <= (time_of(high)? - time).abs();
    Ok(if is_first { low } else { high })
}

/// So many indices below `length`, evenly, with the first and the last.
fn evenly(count: usize, length: usize) -> impl Iterator<Item = usize> {
    let count = count.min(length).max(1);
    let last = length.saturating_sub(1);
    (0..count).map(move |k| if count == 1 { last } else { (k * last + (count - 1) / 2) / (count - 1) })
}

fn probes(recorded: &RecordedScene) -> Result<Vec<Probe>, PlotError> {
    let rows = recorded.rows();
    let probe = |row: usize| recorded.poses(row).map(|(time, poses)| Probe { time, poses });
    evenly(PROBES, rows.len()).map(|row| probe(rows.start + row)).collect()
}

/// Where the centre of a body is.
fn way(body: usize, probes: &[Probe]) -> Vec<Vec3> {
    probes.iter().map(|probe| probe.poses[body].position).collect()
}

fn motion(recorded: &RecordedScene, probes: &[Probe], strays: &Strays) -> ViewCriteria {
    let bodies = (0..recorded.bodies.len().min(MOST_BODIES)).filter(|body| !strays.bodies.contains(body));
    let path = |body: usize| way(body, probes);
    let turns = probes.windows(2).flat_map(|pair| {
        let turn = |body: usize| view::turn(&pair[0].poses[body].gradient, &pair[1].poses[body].gradient);
        bodies.clone().map(turn).collect::<Vec<Vec3>>()
    });
    let strains = |body: usize| {
        let stretches: Vec<Mat3> = probes.iter().map(|probe| view::left_stretch(&probe.poses[body].gradient)).collect();
        let mean = stretches.iter().sum::<Mat3>() / stretches.len().max(1) as f64;
        stretches.into_iter().map(move |stretch| stretch - mean)
    };
    ViewCriteria {
        paths: bodies.clone().map(path).collect(),
        turns: turns.collect(),
        strains: bodies.clone().filter(|body| recorded.bodies[*body].deforms()).flat_map(strains).collect(),
        normals: recorded.supports.iter().map(|support| support.normal).collect(),
        size: recorded.bodies.iter().map(|body| body.size).fold(0.0, f64::max),
    }
}

/// Whether a support moves to the eye.
fn supports_move(recorded: &RecordedScene, probes: &[Probe]) -> bool {
    let size = recorded.bodies.iter().map(|body| body.size).fold(0.0, f64::max);
    let height = |support: &Support, probe: &Probe| support.gap(&Vec3::zeros(), probe.time);
    recorded.solid_supports.iter().any(|support| !support.motion.is_fixed())
        || recorded.supports.iter().any(|support| {
            let heights = probes.iter().map(|probe| height(support, probe) - height(support, &probes[0]));
            support.motion.turns()
                || heights.fold(0.0, |largest: f64, height| largest.max(height.abs())) > VISIBLE * size
        })
}

/// The probe from which on nothing moves to the eye; the last if something moves to the end.
fn until_rest(recorded: &RecordedScene, probes: &[Probe]) -> usize {
    let Some(last) = probes.last() else { return 0 };
    let moved = |probe: &Probe| {
        recorded.bodies.iter().zip(probe.poses.iter().zip(&last.poses)).any(|(body, (pose, end))| {
            let shift = (pose.position - end.position).norm() / body.size;
            // The points of the surface move by half of the size times the change of the gradient.
            shift.max(0.5 * (pose.gradient - end.gradient).norm()) > VISIBLE
        })
    };
    let still = probes.iter().rposition(moved).map_or(0, |index| index + 1);
    // A little of the rest is shown as well.
    (still + probes.len() / 20).min(probes.len() - 1)
}

fn frame(recorded: &RecordedScene, probe: &Probe, view: &View, drawn: usize) -> Outlines {
    let bodies = recorded.bodies.iter().zip(&probe.poses).take(drawn).enumerate();
    let bodies: Vec<Silhouette> = bodies.map(|(index, (body, pose))| Silhouette::of(index, body, pose, view)).collect();
    let mean = probe.poses.iter().map(|pose| pose.position).sum::<Vec3>() / probe.poses.len().max(1) as f64;
    let size = recorded.bodies.iter().map(|body| body.size).fold(0.0, f64::max);
    let site = Site { mean, half_side: PATCH * size };
    let solids = recorded.solid_supports.iter().map(|support| Ground::of_solid(support, probe.time, view));
    let ground = |support| Ground::of(support, probe.time, &site, view);
    Outlines { time: probe.time, bodies, grounds: solids.chain(recorded.supports.iter().filter_map(ground)).collect() }
}

/// The frames in which no body covers much of itself at a time before; the first and the last are among them.
fn without_overlaps(frames: Vec<Outlines>) -> Vec<Outlines> {
    /// Centres nearer than this fraction of the size cover each other.
    const ROOM: f64 = 0.55;
    let covers = |a: &Outlines, b: &Outlines| {
        a.bodies.iter().zip(&b.bodies).any(|(a, b)| {
            let distance = libm::hypot(a.center[0] - b.center[0], a.center[1] - b.center[1]);
            distance < ROOM * a.size.max(b.size)
        })
    };
    let mut kept: Vec<Outlines> = Vec::new();
    let mut frames = frames.into_iter();
    let last = frames.next_back();
    for frame in frames.by_ref() {
        let free = |other: &Outlines| !covers(other, &frame);
        if kept.iter().all(free) && last.as_ref().is_none_or(free) {
            kept.push(frame);
        }
    }
    kept.extend(last);
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn indices_are_even_and_hold_both_ends() {
        assert_eq!(evenly(3, 11).collect::<Vec<_>>(), [0, 5, 10]);
        assert_eq!(evenly(10, 3).collect::<Vec<_>>(), [0, 1, 2]);
        assert_eq!(evenly(5, 1).collect::<Vec<_>>(), [0]);
    }

    #[test]
    fn the_sample_nearest_to_a_time_is_found() {
        let row = |time: f64| nearest(0..11, time, |row| Ok(0.1 * row as f64)).unwrap_or(usize::MAX);
        assert_eq!([row(-1.0), row(0.04), row(0.06), row(0.34), row(0.36), row(2.0)], [0, 0, 1, 3, 4, 10]);
    }
}
