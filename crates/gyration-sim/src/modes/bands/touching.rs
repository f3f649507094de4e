//! Which branches touch on a line or in a plane of wave vectors.
//!
//! The gap between two neighbours of a mesh, round which it closes, is followed down from its lowest places in
//! shrinking steps, wherever it may vanish between the places of the mesh.

/// Branches nearer than this part of the largest frequency touch.
const TOUCH: f64 = 1e-7;
/// The shortest step in κ.
const SHORTEST: f64 = 1e-10;
/// The lowest places that are followed down.
const MOST: usize = 4;

/// Branches in groups that touch.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Touching {
    /// The groups, ascending.
    pub groups: Vec<Vec<usize>>,
    /// The least and the largest frequency of the mesh [rad/s].
    pub least: f64,
    pub most: f64,
}

/// The groups of branches, given ω of each place of a mesh, the first direction fastest, and ω anywhere.
pub(super) fn touching<E>(
    omega: &[Vec<f64>],
    mesh: [usize; 2],
    at: impl Fn([f64; 2]) -> Result<Vec<f64>, E>,
) -> Result<Touching, E> {
    let all = || omega.iter().flatten().copied();
    let (least, most) = (all().fold(f64::INFINITY, f64::min), all().fold(0.0, f64::max));
    let count = omega.first().map_or(0, Vec::len);
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for branch in 0..count {
        let touches = branch > 0 && {
            let gap = |row: &[f64]| row[branch] - row[branch - 1];
            let gaps: Vec<f64> = omega.iter().map(|row| gap(row)).collect();
            least_gap(&gaps, mesh, TOUCH * most, |place| Ok(gap(&at(place)?)))? <= TOUCH * most
        };
        match groups.last_mut().filter(|_| touches) {
            Some(group) => group.push(branch),
            None => groups.push(vec![branch]),
        }
    }
    Ok(Touching { groups, least, most })
}

/// The least gap that is found; the search ends at one that is small enough.
fn least_gap<E>(
    gaps: &[f64],
    [wide, high]: [usize; 2],
    enough: f64,
    at: impl Fn([f64; 2]) -> Result<f64, E>,
) -> Result<f64, E> {
    let beside = |number: usize| {
        let (x, y) = (number % wide, number / wide);
        let around = (0..9).map(move |k| ((x + wide + k % 3 - 1) % wide, (y + high + k / 3 - 1) % high));
        around.map(|(x, y)| gaps[y * wide + x])
    };
    // Where it may vanish before the next place: the gap changes by as much from place to place.
    let may_vanish = |number: &usize| {
        let own = gaps[*number];
        let is_lowest = beside(*number).all(|gap| gap >= own);
        is_lowest && own <= 2.0 * beside(*number).map(|gap| gap - own).fold(0.0, f64::max)
    };
    let mut least = gaps.iter().copied().fold(f64::INFINITY, f64::min);
    let mut lowest: Vec<usize> = (0..gaps.len()).filter(may_vanish).collect();
    lowest.sort_by(|a, b| gaps[*a].total_cmp(&gaps[*b]));
    for number in lowest.into_iter().take(MOST) {
        let spacing = [1.0 / wide as f64, 1.0 / high as f64];
        let mut place = [(number % wide) as f64 * spacing[0], (number / wide) as f64 * spacing[1]];
        let (mut own, mut step) = (gaps[number], 0.5);
        while own > enough && step * spacing[0] > SHORTEST {
            let mut better = None;
            for k in (0..9).filter(|k| *k != 4 && (high > 1 || k / 3 == 1)) {
                let offset = [(k % 3) as f64 - 1.0, (k / 3) as f64 - 1.0];
                let there: [f64; 2] = std::array::from_fn(|a| place[a] + step * spacing[a] * offset[a]);
                let gap = at(there)?;
                if gap < better.map_or(own, |(best, _)| best) {
                    better = Some((gap, there));
                }
            }
            match better {
                Some(found) => (own, place) = found,
                None => step *= 0.5,
            }
        }
        least = least.min(own);
        if least <= enough {
            break;
        }
    }
    Ok(least)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    /// Two branches 3 ± |f| over a mesh of 10.
    fn groups(mesh: [usize; 2], half: impl Fn([f64; 2]) -> f64) -> Vec<Vec<usize>> {
        let at = |place: [f64; 2]| vec![3.0 - half(place).abs(), 3.0 + half(place).abs()];
        let number = |k: usize| [(k % mesh[0]) as f64 / mesh[0] as f64, (k / mesh[0]) as f64 / mesh[1] as f64];
        let omega: Vec<Vec<f64>> = (0..mesh[0] * mesh[1]).map(|k| at(number(k))).collect();
        let found = touching(&omega, mesh, |place| Ok::<_, Infallible>(at(place)));
        found.unwrap_or_else(|never| match never {}).groups
    }

    #[test]
    fn branches_that_meet_between_the_places_of_a_mesh_touch() {
        let wave = |place: f64, at: f64| libm::sin(std::f64::consts::PI * (place - at));
        assert_eq!(groups([10, 1], |[x, _]| wave(x, 0.333)), [vec![0, 1]]);
        let cone = |[x, y]: [f64; 2]| libm::hypot(wave(x, 0.377), wave(y, 0.741));
        assert_eq!(groups([10, 10], cone), [vec![0, 1]]);
    }

    #[test]
    fn branches_with_a_narrow_gap_do_not() {
        let wave = |place: f64, at: f64| libm::sin(std::f64::consts::PI * (place - at));
        assert_eq!(groups([10, 1], |[x, _]| libm::hypot(wave(x, 0.333), 1e-5)), [vec![0], vec![1]]);
        let cone = |[x, y]: [f64; 2]| libm::hypot(libm::hypot(wave(x, 0.377), wave(y, 0.741)), 1e-5);
        assert_eq!(groups([10, 10], cone), [vec![0], vec![1]]);
    }
}
