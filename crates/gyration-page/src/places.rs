//! Where the numbers of a scene stand among those that a page is given.

use gyration_record::ArraySpec;
use std::ops::Range;

/// The places of the arrays of the scene in a row that the page is given.
#[derive(Debug, Clone)]
pub(crate) struct ScenePlaces(Vec<Range<usize>>);

impl ScenePlaces {
    /// Those of some arrays in a row of all; none if one is not among them.
    pub(crate) fn among(arrays: &[ArraySpec], all: &[ArraySpec]) -> Option<Self> {
        let (mut places, mut end) = (Vec::new(), 0);
        for array in all {
            places.push((&array.name, end..end + array.row_len()));
            end += array.row_len();
        }
        let place = |array: &ArraySpec| Some(places.iter().find(|(name, _)| **name == array.name)?.1.clone());
        arrays.iter().map(place).collect::<Option<_>>().map(Self)
    }

    /// The numbers of the scene in a row.
    pub(crate) fn of<'a>(&'a self, row: &'a [f64]) -> impl Iterator<Item = &'a [f64]> {
        self.0.iter().map(|place| &row[place.clone()])
    }
}
