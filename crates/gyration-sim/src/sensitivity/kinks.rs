//! The kinks of a model's signals, and how they move with a number of the scene.
//!
//! Signals are continuous and tell in advance where they are not smooth. There f is continuous, or jumps with the rate
//! of a prescribed contraction; with the instant t_k(p) it takes S along by (f⁻ − f⁺) dt_k/dp. Differences by p are
//! taken on one side of a kink, so far from it that the neighbours' kinks do not lie between.

use crate::island::horizon::next_kink;
use crate::variation::{NoDerivative, SceneVariation};
use gyration::model::Model;

/// More kinks than that are not followed.
const MOST: usize = 100_000;
/// The differences stay nearer to a kink than this part of the mean distance between kinks: by quadratic extrapolation
/// from there, what is smooth comes out to the third power of it.
const NEAR: f64 = 1e-5;
/// And nearer than this part of the smallest distance, which is the length of an edge of a square wave.
const WITHIN: f64 = 0.05;
/// A step that ends at a kink misses it by no more than this part of the time.
const ROUNDING: f64 = 64.0 * f64::EPSILON;
/// How many times as far as a kink moves the differences stay from it.
const DISTANCE: f64 = 8.0;

/// A kink that moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Kink {
    /// t_k [s].
    pub time: f64,
    /// dt_k/dp.
    pub moves: f64,
}

/// The kinks that move with a number, in order of time.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Kinks {
    kinks: Vec<Kink>,
    margin: f64,
    /// How many have been passed.
    passed: usize,
}

impl Kinks {
    /// Whether any kink moves with the number.
    pub fn move_any(&self) -> bool {
        self.kinks.iter().any(|kink| kink.moves != 0.0)
    }

    /// Those of a run to its end [s].
    pub fn of(model: &Model, end: f64, variation: &mut SceneVariation) -> Result<Self, NoDerivative> {
        let times = kinks(model, end);
        if times.is_empty() || variation.starts_only() {
            return Ok(Self::default());
        }
        if times.len() >= MOST {
            return Err(NoDerivative::Reason(format!("its signals have more than {MOST} kinks")));
        }
        let apart = nearest(&times, end);
        let movement = |variation: &mut SceneVariation| {
            let mut part = false;
            let moves = variation.times(|model| {
                let moved = kinks(model, end);
                part |= !are_as_many(&times, &moved, end - WITHIN * apart) || nearest(&moved, end) < WITHIN * apart;
                moved
            });
            moves.map(|moves| (moves, part))
        };
        let (moves, part) = movement(variation)?;
        if !part && moves.iter().all(|moves| *moves == 0.0) {
            return Ok(Self::default());
        }
        loop {
            let ((moves, part), step) = (movement(variation)?, variation.step());
            let farthest = moves.iter().fold(0.0, |most: f64, moves| most.max(moves.abs()));
            let margin = DISTANCE * farthest * step + f64::EPSILON * end;
            let mean = end / (times.len() + 1) as f64;
            if (part || margin > f64::min(NEAR * mean, WITHIN * apart)) && variation.finer().is_ok() {
                continue;
            }
            if part {
                return Err(NoDerivative::Reason(
                    "two of its signals have a kink at the same time, and one of them moves".into(),
                ));
            }
            // Those of both ends of an edge have to find room in it.
            if margin > apart / 6.0 {
                return Err(NoDerivative::Reason("the kinks of its signals move too far for their distance".into()));
            }
            variation.keep_step();
            let kinks = times.into_iter().zip(moves).map(|(time, moves)| Kink { time, moves }).collect();
            return Ok(Self { kinks, margin, passed: 0 });
        }
    }

    /// Where to look instead at a time: there, or at three times on its side of a kink that is too near, from which a
    /// parabola leads to it. Times with their weights; a kink itself counts as before.
    pub fn beside(&self, time: f64) -> [(f64, f64); 3] {
        let near = |kink: &&Kink| (time - kink.time).abs() < self.margin;
        let first = self.kinks.partition_point(|kink| kink.time < time - self.margin);
        let Some(kink) = self.kinks[first..].first().filter(near) else {
            return [(time, 1.0), (time, 0.0), (time, 0.0)];
        };
        let side = if self.is_at(kink, time) || time < kink.time { -1.0 } else { 1.0 };
        parabola(kink.time, side, self.margin, time)
    }

    /// The kink that a step which ends at a time has come to, once: the steps of a run are short about a jump.
    pub fn come_to(&mut self, time: f64) -> Option<Kink> {
        let kink = self.kinks.get(self.passed).filter(|kink| time > kink.time || self.is_at(kink, time)).copied()?;
        self.passed += 1;
        Some(kink)
    }

    /// Whether a step that ends at a time has come to a kink.
    pub fn has_come(&self, time: f64) -> bool {
        self.kinks.get(self.passed).is_some_and(|kink| time > kink.time || self.is_at(kink, time))
    }

    /// A step ends at a kink but for rounding.
    fn is_at(&self, kink: &Kink, time: f64) -> bool {
        is_same(kink.time, time)
    }
}

/// Three times on one side of a kink, at one, two and three margins from it, with the weights by which a parabola leads
/// from there to a time.
pub(super) fn parabola(kink: f64, side: f64, margin: f64, time: f64) -> [(f64, f64); 3] {
    let away = side * (time - kink) / margin;
    let place = |times: f64| kink + side * times * margin;
    [
        (place(1.0), 0.5 * (away - 2.0) * (away - 3.0)),
        (place(2.0), -(away - 1.0) * (away - 3.0)),
        (place(3.0), 0.5 * (away - 1.0) * (away - 2.0)),
    ]
}

/// Two times are the same but for rounding.
fn is_same(one: f64, other: f64) -> bool {
    (one - other).abs() < ROUNDING * one
}

/// The smallest distance of two kinks [s]; that of a single one is the end.
fn nearest(times: &[f64], end: f64) -> f64 {
    times.windows(2).map(|pair| pair[1] - pair[0]).fold(end, f64::min)
}

/// Whether two lists of kinks have as many, but for those that come over the end or go: later than `late`.
fn are_as_many(one: &[f64], other: &[f64], late: f64) -> bool {
    let both = one.len().min(other.len());
    one[both..].iter().chain(&other[both..]).all(|time| *time > late)
}

/// Whether a step of a run has ended at a kink of a signal.
pub(super) fn ends_at_kink(model: &Model, from: f64, to: f64) -> bool {
    next_kink(model, from).is_some_and(|kink| kink <= to || is_same(kink, to))
}

/// The kinks of all signals of a model up to a time [s].
fn kinks(model: &Model, end: f64) -> Vec<f64> {
    let mut times = Vec::new();
    let mut time = 0.0;
    while let Some(kink) = next_kink(model, time).filter(|kink| *kink > time && *kink < end) {
        times.push(kink);
        time = kink;
        if times.len() >= MOST {
            break;
        }
    }
    times
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn beside_a_kink_a_parabola_leads_on_from_its_own_side() {
        let kinks = Kinks { kinks: vec![Kink { time: 1.0, moves: 1.0 }], margin: 0.01, passed: 0 };
        let parabola = |t: f64| 3.0 - t + 2.0 * t * t;
        for time in [0.5, 0.991, 0.999, 1.0, 1.001, 1.009, 1.5] {
            let places = kinks.beside(time);
            let value: f64 = places.iter().map(|(place, weight)| weight * parabola(*place)).sum();
            assert!((value - parabola(time)).abs() < 1e-12, "{time}: {value}");
            let far = places.iter().filter(|(_, weight)| *weight != 0.0).all(|(place, _)| (place - 1.0).abs() > 0.0099);
            let own_side = places.iter().all(|(place, _)| (*place > 1.0) == (time > 1.0));
            assert!(far && own_side, "{time}: {places:?}");
        }
    }
}
