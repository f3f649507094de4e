//! A curve in a plane of two measures: thinned to what can be seen, and the area that it encloses.
//!
//!   A = ½ Σ (x_k − x₀)(y_{k+1} − y₀) − (x_{k+1} − x₀)(y_k − y₀),   > 0 counterclockwise
//!
//! closed by the chord from the last point to the first. Through n points of an ellipse this is short by 6.6/n² of the
//! area.

use crate::draw::Point;

/// Points nearer than this part of the ranges to the last one are not kept: less than a pixel of a page.
const NEAREST: f64 = 1.0 / 1500.0;
/// Where a curve has more points than this, those of twice the distance are kept.
const MOST_POINTS: usize = 8000;

/// Takes the points of a curve in their order.
#[derive(Debug, Clone)]
pub struct Trace {
    ranges: [f64; 2],
    nearest: f64,
    kept: Vec<Point>,
    last: Option<Point>,
    twice_area: f64,
    taken: usize,
}

impl Trace {
    /// In a plane of which a picture shows these ranges.
    pub fn new(ranges: [f64; 2]) -> Self {
        let ranges = ranges.map(|range| if range > 0.0 { range } else { 1.0 });
        Self { ranges, nearest: NEAREST, kept: Vec::new(), last: None, twice_area: 0.0, taken: 0 }
    }

    /// Takes the next point.
    pub fn push(&mut self, point: Point) {
        if let (Some(last), Some(first)) = (self.last, self.kept.first()) {
            let [a, b] = [last, point].map(|p| [p[0] - first[0], p[1] - first[1]]);
            self.twice_area += a[0] * b[1] - b[0] * a[1];
        }
        self.taken += 1;
        self.last = Some(point);
        if self.kept.last().is_none_or(|kept| self.distance(*kept, point) >= self.nearest) {
            self.kept.push(point);
        }
        if self.kept.len() > MOST_POINTS {
            self.nearest *= 2.0;
            let all = std::mem::take(&mut self.kept);
            for point in all {
                if self.kept.last().is_none_or(|kept| self.distance(*kept, point) >= self.nearest) {
                    self.kept.push(point);
                }
            }
        }
    }

    fn distance(&self, a: Point, b: Point) -> f64 {
        libm::hypot((b[0] - a[0]) / self.ranges[0], (b[1] - a[1]) / self.ranges[1])
    }

    /// The area that the curve encloses with the chord from its last point to its first.
    pub fn area(&self) -> f64 {
        0.5 * self.twice_area
    }

    /// How many points it was given.
    pub fn taken(&self) -> usize {
        self.taken
    }

    /// From the last point to the first, as a part of the ranges.
    pub fn opening(&self) -> f64 {
        self.kept.first().zip(self.last).map_or(0.0, |(first, last)| self.distance(*first, last))
    }

    /// The chord from the last point to the first.
    pub fn chord(&self) -> Vec<Point> {
        self.last.into_iter().chain(self.kept.first().copied()).collect()
    }

    /// The points kept, with the last one.
    pub fn finish(mut self) -> Vec<Point> {
        let last = self.last.filter(|last| self.kept.last() != Some(last));
        self.kept.extend(last);
        self.kept
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn ellipse(points: usize, turns: f64) -> Trace {
        let mut trace = Trace::new([6.0, 2.0]);
        for k in 0..=points {
            let (sine, cosine) = (TAU * turns * k as f64 / points as f64).sin_cos();
            trace.push([10.0 + 3.0 * cosine, -5.0 + sine]);
        }
        trace
    }

    #[test]
    fn area_has_the_sign_of_the_circulation() {
        for points in [20, 200, 20_000] {
            let (n, ideal) = (points as f64, 3.0 * TAU / 2.0);
            // A polygon of n corners on an ellipse has sin(2π/n)/(2π/n) of its area; the rest is rounding.
            let polygon = ideal * (TAU / n).sin() / (TAU / n);
            let [forth, back] = [1.0, -1.0].map(|turns| ellipse(points, turns).area());
            assert!((forth - polygon).abs() < 1e-12 && (forth + back).abs() < 1e-12, "{points}: {forth}, {back}");
            assert!((1.0 - forth / ideal) < 6.6 / (n * n));
        }
    }

    #[test]
    fn half_an_ellipse_is_closed_by_its_chord() {
        let trace = ellipse(10_000, 0.5);
        assert!((trace.area() - 1.5 * TAU / 2.0).abs() < 1e-6);
        assert!((trace.opening() - 1.0).abs() < 1e-12 && trace.chord().len() == 2);
    }

    #[test]
    fn a_curve_to_and_fro_encloses_nothing() {
        let mut trace = Trace::new([1.0, 1.0]);
        (0..=100).chain((0..100).rev()).for_each(|k| trace.push([f64::from(k), f64::from(k * k)]));
        assert_eq!((trace.area(), trace.opening()), (0.0, 0.0));
    }

    #[test]
    fn many_turns_keep_few_points_and_the_last() {
        let trace = ellipse(1_000_000, 50.25);
        let last = trace.last.unwrap();
        let points = trace.finish();
        assert!(points.len() <= MOST_POINTS + 1, "{}", points.len());
        assert_eq!(points.last(), Some(&last));
        let highest = points.iter().map(|point| point[1]).fold(f64::MIN, f64::max);
        assert!((highest + 4.0).abs() < 1e-3);
    }
}
