//! Bodies that fly off: those whose ways reach far beyond where most bodies are. They are not to make all others small.
//!
//!   r_i = max |p_i − m| + ℓ_i/2 over the samples,   stray: r_i > 4 R,   R = the median of r_i, 3 ℓ at least
//!
//! m is the median place, component by component, ℓ the largest size. Where more than a third fly, that is the motion,
//! and none is a stray. The viewer's page has the same strays (`viewer/src/data/strays.ts`).

use crate::chart::extremes;
use gyration::tensor::Vec3;

/// A stray goes so many times as far as most.
const FAR: f64 = 4.0;
/// Bodies that stay together are given so many sizes of room.
const LEAST_SIZES: f64 = 3.0;

/// Bodies that fly off.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Strays {
    /// Which, ascending.
    pub bodies: Vec<usize>,
    /// m [m].
    pub middle: Vec3,
    /// R [m]: as far from m a picture reaches.
    pub radius: f64,
}

/// The bodies that fly off, by the ways of their centres [m] and their sizes [m].
pub fn strays(ways: &[Vec<Vec3>], sizes: &[f64]) -> Strays {
    if ways.len() < 2 {
        return Strays::default();
    }
    let middle = Vec3::from_fn(|axis, _| median(ways.iter().flatten().map(|place| place[axis])));
    let reach = |(way, size): (&Vec<Vec3>, &f64)| {
        extremes(way.iter().map(|place| (place - middle).norm())).map_or(0.0, |(_, far)| far) + 0.5 * size
    };
    let reaches: Vec<f64> = ways.iter().zip(sizes).map(reach).collect();
    let room = LEAST_SIZES * sizes.iter().copied().fold(0.0, f64::max);
    let radius = median(reaches.iter().copied()).max(room);
    let far: Vec<usize> = (0..ways.len()).filter(|body| reaches[*body] > FAR * radius).collect();
    let bodies = if far.len() > (ways.len() / 3).max(1) { Vec::new() } else { far };
    Strays { bodies, middle, radius }
}

/// The lower median of the finite values; zero without any.
fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.filter(|value| value.is_finite()).collect();
    values.sort_by(f64::total_cmp);
    values.len().checked_sub(1).map_or(0.0, |last| values[last / 2])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Bodies of size 0.1 in a row, the last ones of which fly off to a distance.
    fn flying(count: usize, flying: usize, distance: f64) -> Vec<usize> {
        let way = |body: usize| {
            let speed = if body + flying >= count { distance } else { 0.0 };
            (0..=20).map(|k| Vec3::new(0.1 * body as f64, 0.0, speed * f64::from(k) / 20.0)).collect()
        };
        strays(&(0..count).map(way).collect::<Vec<_>>(), &vec![0.1; count]).bodies
    }

    #[test]
    fn one_that_flies_away_is_a_stray_however_few_stay() {
        assert_eq!(flying(10, 1, 50.0), [9]);
        assert_eq!(flying(2, 1, 50.0), [1]);
        // Within reach of the others it is one of them; alone it is all there is.
        assert!(flying(10, 1, 1.0).is_empty() && flying(1, 1, 50.0).is_empty());
    }

    #[test]
    fn where_many_fly_none_is_a_stray() {
        assert_eq!(flying(9, 3, 50.0), [6, 7, 8]);
        assert!(flying(9, 4, 50.0).is_empty());
    }
}
