//! The layer of a grid that a picture shows.

use super::FieldGrid;

/// The part of a grid along two axes: its middle layer along the axis with the fewest points; of equal ones along the
/// last.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FieldLayer {
    /// The axis that leads out of the layer.
    pub through: usize,
    /// The axes of the layer; where one has one point alone it is the second.
    pub along: [usize; 2],
    /// Which layer it is along the axis that leads out of it.
    pub index: usize,
    /// The points of the grid in it, along the first axis fastest.
    pub points: Vec<usize>,
}

impl FieldLayer {
    /// Of a grid.
    pub fn of(grid: &FieldGrid) -> Self {
        let counts = grid.counts;
        let (through, along) = Self::axes(&counts);
        let strides = [1, counts[0], counts[0] * counts[1]];
        let index = counts[through] / 2;
        let point = |i: usize, j: usize| i * strides[along[0]] + j * strides[along[1]] + index * strides[through];
        let points = (0..counts[along[1]]).flat_map(|j| (0..counts[along[0]]).map(move |i| (i, j)));
        Self { through, along, index, points: points.map(|(i, j)| point(i, j)).collect() }
    }

    /// The axis that leads out of the layer of a grid with so many points along each, and those of the layer.
    pub(super) fn axes(counts: &[usize; 3]) -> (usize, [usize; 2]) {
        let through = (0..3).rev().min_by_key(|axis| counts[*axis]).unwrap_or(2);
        let mut along = match through {
            0 => [1, 2],
            1 => [0, 2],
            _ => [0, 1],
        };
        if counts[along[0]] == 1 {
            along.swap(0, 1);
        }
        (through, along)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gyration::tensor::Vec3;

    #[test]
    fn the_middle_layer_lies_along_the_two_longest_sides() {
        let grid =
            FieldGrid { counts: [4, 2, 3], origin: Vec3::new(-1.0, 0.0, 2.0), spacing: Vec3::new(0.5, 0.25, 0.125) };
        let layer = FieldLayer::of(&grid);
        assert_eq!((layer.along, layer.through, layer.index), ([0, 2], 1, 1));
        assert_eq!(layer.points, [4, 5, 6, 7, 12, 13, 14, 15, 20, 21, 22, 23]);
        for (counts, along) in [([5, 1, 1], [0, 1]), ([1, 5, 1], [1, 0]), ([1, 1, 5], [2, 0])] {
            let layer = FieldLayer::of(&FieldGrid { counts, ..grid });
            assert_eq!((layer.along, layer.points.len()), (along, 5), "{counts:?}");
            assert_eq!(FieldLayer::axes(&counts), (layer.through, along), "{counts:?}");
        }
    }
}
