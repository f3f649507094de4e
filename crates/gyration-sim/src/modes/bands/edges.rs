//! The edges of a ribbon or a slab: where its cells end along a direction that is not periodic, and how much of a wave
//! runs there.
//!
//!   s = Σ_edge T_i / Σ T_i
//!
//! T_i is the kinetic energy of a body. An edge is a quarter of the cells deep, rounded down, so that fewer than four
//! have none: a wave that is alike all over has a quarter of its energy at most at each, one that dies out inwards
//! nearly all of it at one. Waves of one frequency and one velocity are any that span the same motions, and have the
//! mean of their shares, which does not depend on which.

use super::Branch;
use super::bloch::{BlochSystem, C64};
use super::eigenspaces::SAME;
use nalgebra::DVector;

/// One in so many cells that lie side by side is at an edge.
const PART: u32 = 4;
/// Velocities nearer than this part of the largest are one.
const ALIKE: f64 = 1e-6;

/// The two edges of a lattice along a direction.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FreeEdges {
    /// The direction, from 0.
    pub direction: usize,
    /// How many cells deep each is.
    pub cells: u32,
    /// Of each body of the cell the edge at which it is, 0 where the cells begin, 1 where they end.
    side: Vec<Option<usize>>,
}

impl FreeEdges {
    /// Of a cell of so many bodies that holds so many cells along each direction, the copies of a body one behind the
    /// other, the first direction fastest; none along what is periodic or fewer than four cells wide.
    pub fn of(repeat: &[u32; 3], periodic: &[bool], bodies: usize) -> Vec<Self> {
        let count: u32 = repeat.iter().product();
        let ends = |axis: &usize| periodic.get(*axis) == Some(&false) && repeat[*axis] >= PART;
        let along = |direction: usize| {
            let (many, before) = (repeat[direction], repeat[..direction].iter().product::<u32>());
            let cells = many / PART;
            let side = |body: usize| {
                let at = body as u32 % count / before % many;
                if at < cells { Some(0) } else { (at + cells >= many).then_some(1) }
            };
            Self { direction, cells, side: (0..bodies).map(side).collect() }
        };
        (0..3).filter(ends).map(along).collect()
    }

    /// The shares of the kinetic energy of a motion at both.
    pub(super) fn shares(&self, system: &BlochSystem, shape: &DVector<C64>) -> [f64; 2] {
        let (mut shares, mut all) = ([0.0; 2], 0.0);
        for (energies, side) in system.energies(shape).zip(&self.side) {
            let energy: f64 = energies.iter().sum();
            all += energy;
            if let Some(side) = side {
                shares[*side] += energy;
            }
        }
        shares.map(|share| if all > 0.0 { share / all } else { 0.0 })
    }
}

/// Gives waves that nothing tells apart the mean of their shares.
pub(super) fn share_alike(branches: &mut [Branch]) {
    let size = |branch: &Branch| libm::hypot(branch.omega, branch.decay);
    let speed = |branch: &Branch| branch.velocity.map_or(0.0, |velocity| velocity.norm());
    let [most, fastest] = [size as fn(&Branch) -> f64, speed].map(|of| branches.iter().map(of).fold(0.0, f64::max));
    let is_one = |one: &Branch, other: &Branch| {
        let apart = libm::hypot(one.omega - other.omega, one.decay - other.decay);
        apart <= SAME * most
            && match (one.velocity, other.velocity) {
                (Some(one), Some(other)) => (one - other).norm() <= ALIKE * fastest,
                (one, other) => one.is_none() && other.is_none(),
            }
    };
    let mean = |branch: &Branch, edge: usize| {
        let alike: Vec<&Branch> = branches.iter().filter(|other| is_one(branch, other)).collect();
        [0, 1].map(|side| alike.iter().map(|it| it.at_edges[edge][side]).sum::<f64>() / alike.len() as f64)
    };
    let means = |branch: &Branch| (0..branch.at_edges.len()).map(|edge| mean(branch, edge)).collect::<Vec<_>>();
    let shares: Vec<_> = branches.iter().map(means).collect();
    branches.iter_mut().zip(shares).for_each(|(branch, shares)| branch.at_edges = shares);
}

#[cfg(test)]
mod tests {
    use super::super::PARTS;
    use super::*;
    use gyration::tensor::Vec3;

    #[test]
    fn edges_are_a_quarter_of_the_cells_of_each_free_direction() {
        let found = FreeEdges::of(&[1, 5, 1], &[true, false], 10);
        let [low, high, none] = [Some(0), Some(1), None];
        assert_eq!(found.len(), 1);
        assert_eq!((found[0].direction, found[0].cells), (1, 1));
        assert_eq!(found[0].side, [low, none, none, none, high].repeat(2));
        let depths = [(1, None), (3, None), (4, Some(1)), (7, Some(1)), (10, Some(2))];
        for (many, cells) in depths {
            let found = FreeEdges::of(&[1, many, 1], &[true, false], many as usize);
            assert_eq!(found.first().map(|edges| edges.cells), cells, "{many} cells");
        }
    }

    #[test]
    fn a_rod_has_edges_along_both_of_its_free_directions() {
        let found = FreeEdges::of(&[4, 1, 4], &[false, true, false], 16);
        let sides = [0, 9, 9, 1].map(|side| (side < 2).then_some(side));
        assert_eq!(found.iter().map(|edges| edges.direction).collect::<Vec<_>>(), [0, 2]);
        assert_eq!(found[0].side, sides.repeat(4));
        assert_eq!(found[1].side, sides.map(|side| [side; 4]).concat());
    }

    #[test]
    fn waves_that_nothing_tells_apart_have_the_mean_of_their_shares() {
        let wave = |omega: f64, velocity: f64, shares: [f64; 2]| Branch {
            omega,
            decay: 0.0,
            velocity: Some(velocity * Vec3::x()),
            participation: [0.0; PARTS],
            at_edges: vec![shares],
            shapes: Vec::new(),
            changes: Vec::new(),
            bound: None,
        };
        let mut branches = [
            wave(1.0, 0.0, [1.0, 0.0]),
            wave(1.0, 2.0, [0.0, 0.9]),
            wave(1.0, 0.0, [0.0, 0.5]),
            wave(3.0, 0.0, [0.2; 2]),
        ];
        share_alike(&mut branches);
        let shares = branches.map(|branch| branch.at_edges[0]);
        assert_eq!(shares, [[0.5, 0.25], [0.0, 0.9], [0.5, 0.25], [0.2; 2]]);
    }
}
