//! Cost of transport: what the drive has spent for carrying the weight so far.
//!
//!   c(t) = W⁺(t)/(m g d(t)),   W⁺ = ∫ max(0, V Q·V_G) dt,   d = level distance of the centre of mass from its start
//!
//! the specific mechanical cost of transport: work that the drive takes back does not count as gained. Source: S.
//! Collins, A. Ruina, R. Tedrake, M. Wisse, *Efficient bipedal robots based on passive-dynamic walkers*, Science 307
//! (2005). The net work in its place is drawn dashed. Both grow without bound where d vanishes: they begin where the
//! body has got some way.

use super::bodies::{MOST_LINES, MOST_NAMES, body_series, hue, time_axis, values};
use super::distance::{LevelAxes, NOWHERE};
use super::effort::{self, ARRAYS, Driven, Works};
use crate::chart::{Axis, Chart, DASHED, Series, extremes};
use crate::cycle::{AtTime, Cycle, rounded};
use crate::error::PlotError;
use crate::recorded::RecordedScene;
use crate::thin::Thinner;
use gyration::tensor::Vec3;

const HEIGHT: f64 = 130.0;
/// The cost is drawn where the distance is above this part of the farthest.
const SOME_WAY: f64 = 0.02;
/// A cost that spans more than this factor is drawn over a logarithmic axis.
const WIDE: f64 = 20.0;

/// The chart.
pub fn chart(recorded: &RecordedScene) -> Result<Chart, PlotError> {
    let nothing = |reason: &'static str| Err(PlotError::Nothing { what: "cost", reason });
    let mut driven = Driven::all(recorded, "cost")?;
    driven.truncate(MOST_LINES);
    if recorded.gravity.norm() == 0.0 {
        return nothing(
            "without gravity there is no weight to carry, and the cost of transport is work/(weight × distance)",
        );
    }
    let level = LevelAxes::to(&recorded.up());
    let (driven, farthest): (Vec<Driven>, Vec<f64>) = BodyPath::all(recorded, &level, &driven)?
        .into_iter()
        .zip(&driven)
        .filter(|(way, it)| way.gained > NOWHERE * recorded.bodies[it.body].size)
        .map(|(way, it)| (*it, way.farthest))
        .unzip();
    if driven.is_empty() {
        return nothing(
            "no body that contracts gets anywhere (a millionth of its size, in its last cycle), and the cost of transport is \
             work/(weight × distance)",
        );
    }
    let spent = Spent::read(recorded, &level, &driven, &farthest)?;
    spent.chart(recorded, &driven)
}

/// Where each body started.
fn starts(recorded: &RecordedScene, driven: &[Driven]) -> Result<Vec<Vec3>, PlotError> {
    let (_, poses) = recorded.poses(0)?;
    Ok(driven.iter().map(|it| poses[it.body].position).collect())
}

/// The way of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
struct BodyPath {
    /// The largest level distance from the start [m].
    farthest: f64,
    /// The level distance gained in the last cycle; without a cycle the farthest [m].
    gained: f64,
}

impl BodyPath {
    fn all(recorded: &RecordedScene, level: &LevelAxes, driven: &[Driven]) -> Result<Vec<Self>, PlotError> {
        let (starts, span) = (starts(recorded, driven)?, recorded.span()?);
        let mut farthest = vec![0.0; driven.len()];
        let mark =
            |it: &Driven| Cycle::last(recorded.bodies[it.body].period, span).map(|cycle| AtTime::<2>::at(cycle.start));
        let mut marks: Vec<Option<AtTime<2>>> = driven.iter().map(mark).collect();
        recorded.each_row(&["position"], |time, row| {
            for (k, it) in driven.iter().enumerate() {
                let parts = level.parts(&(Vec3::from_column_slice(&row[0][3 * it.body..][..3]) - starts[k]));
                farthest[k] = f64::max(farthest[k], libm::hypot(parts[0], parts[1]));
                if let Some(mark) = &mut marks[k] {
                    mark.push(time, parts);
                }
            }
        })?;
        let gained = |mark: &Option<AtTime<2>>| mark.as_ref().and_then(AtTime::since).map(|[a, b]| libm::hypot(a, b));
        let ways = farthest.into_iter().zip(&marks);
        Ok(ways.map(|(farthest, mark)| Self { farthest, gained: gained(mark).unwrap_or(farthest) }).collect())
    }
}

/// The costs of each body.
struct Spent {
    /// W⁺/(m g d) and W/(m g d).
    lines: [Vec<Vec<[f64; 2]>>; 2],
    /// W⁺/(m g d) over the last cycle, where there is one.
    by_cycle: Vec<Option<f64>>,
    works: Vec<Works>,
}

impl Spent {
    fn read(
        recorded: &RecordedScene,
        level: &LevelAxes,
        driven: &[Driven],
        farthest: &[f64],
    ) -> Result<Self, PlotError> {
        let (starts, span) = (starts(recorded, driven)?, recorded.span()?);
        let weights: Vec<f64> =
            driven.iter().map(|it| recorded.bodies[it.body].mass * recorded.gravity.norm()).collect();
        let cycle = |it: &Driven| Cycle::last(recorded.bodies[it.body].period, span);
        // Distances along the two level directions, and W⁺.
        let mut marks: Vec<Option<AtTime<3>>> =
            driven.iter().map(|it| cycle(it).map(|c| AtTime::at(c.start))).collect();
        let mut works = vec![Works::default(); driven.len()];
        let mut thinners = recorded.thinners(2 * driven.len());
        recorded.each_row(&[ARRAYS[0], ARRAYS[1], "position"], |time, row| {
            for (k, it) in driven.iter().enumerate() {
                works[k].push(time, it.power(row));
                let parts = level.parts(&(Vec3::from_column_slice(&row[2][3 * it.body..][..3]) - starts[k]));
                if let Some(mark) = &mut marks[k] {
                    mark.push(time, [parts[0], parts[1], works[k].positive]);
                }
                let distance = libm::hypot(parts[0], parts[1]);
                let drawn = distance > SOME_WAY * farthest[k];
                for (thinner, work) in thinners[2 * k..].iter_mut().zip([works[k].positive, works[k].net]) {
                    thinner.push(time, if drawn { work / (weights[k] * distance) } else { f64::NAN });
                }
            }
        })?;
        let mut lines = [Vec::new(), Vec::new()];
        thinners.into_iter().map(Thinner::finish).enumerate().for_each(|(k, line)| lines[k % 2].push(line));
        let cost = |(mark, weight): (&Option<AtTime<3>>, &f64)| {
            let [a, b, work] = mark.as_ref()?.since()?;
            Some(work / (weight * libm::hypot(a, b)))
        };
        Ok(Self { lines, by_cycle: marks.iter().zip(&weights).map(cost).collect(), works })
    }

    fn chart(self, recorded: &RecordedScene, driven: &[Driven]) -> Result<Chart, PlotError> {
        let bodies: Vec<usize> = driven.iter().map(|it| it.body).collect();
        let [spent, net] = self.lines;
        let (mut series, mut remarks) = body_series(recorded, &bodies, spent);
        let alone = series.len() == 1;
        if alone {
            series[0].name = "work that the drive does".into();
        }
        for (k, points) in net.into_iter().enumerate() {
            let name = match (alone, k) {
                (true, _) => "net work",
                (false, 0) => "dashed: net work",
                _ => "",
            };
            // Beside the line that it may coincide with: another colour, unless colours tell bodies.
            let hue = hue(recorded, bodies[k]) + usize::from(alone);
            series.push(Series::solid(name, points, hue).dashed(DASHED));
        }
        for (body, cost) in bodies.iter().zip(&self.by_cycle).take(MOST_NAMES) {
            let of =
                if alone { "last cycle".to_owned() } else { format!("last cycle of {}", recorded.bodies[*body].name) };
            remarks.extend(cost.map(|cost| format!("{of}: {}", rounded(cost))));
        }
        remarks.extend(effort::sampling(recorded, &self.works)?.filter(|_| alone));
        let wide = extremes(values(&series)).is_some_and(|(low, high)| low > 0.0 && high > WIDE * low);
        let axis = if wide { Axis::logarithmic } else { Axis::linear };
        let y = axis("work/(weight × distance)", "", values(&series).collect::<Vec<f64>>());
        let title = "Cost of transport: work of the drive so far".to_owned();
        Ok(Chart { title, x: time_axis(recorded)?, y, series, remarks, height: HEIGHT })
    }
}
