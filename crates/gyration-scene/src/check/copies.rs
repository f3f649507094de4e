//! Which bodies of the model each body of the file stands for, and where the file says that its copies are.

use super::{Placed, Reporter};
use crate::file::{Body, Copies as Written, CopyGrid, RandomCopies};
use crate::file_sum::sum_of;
use crate::key::{Key, split_copy};
use crate::places::{CopyPlace, MOST_COPIES, grid, read_places};
use crate::quantity::si;
use gyration_files::Files;
use std::collections::BTreeMap;
use std::ops::Range;

/// The copies of a body, as far as the file tells where they are.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Copies {
    /// It has none, and is itself in the model.
    Alone,
    /// At these places.
    Placed(Vec<CopyPlace>),
    /// At places that are drawn.
    Random(RandomCopies),
    /// Something about them is wrong, which has been noted.
    Unknown,
}

impl Copies {
    /// Those of a well-formed body; notes what is wrong with them.
    pub(super) fn of(body: &Placed<Body>, files: &Files, in_lattice: bool, reporter: &mut Reporter<'_>) -> Self {
        let Some(written) = &body.value.copies else { return Self::Alone };
        let key = body.key.key("copies");
        let mut is_sound = check_body(body, in_lattice, reporter);
        let found = match &**written {
            Written::Grid(written) => {
                is_sound &= check_grid(written, &key.key("grid"), reporter);
                if is_sound { Self::Placed(grid(written)) } else { Self::Unknown }
            }
            Written::Places(file) => match read_places((files, file)) {
                Ok(places) => {
                    reporter.read(&key.key("places"), file, sum_of(places.iter().flat_map(CopyPlace::numbers)));
                    Self::Placed(places)
                }
                Err(fault) => {
                    reporter.note(&key.key("places"), fault.to_string(), fault.help(files));
                    Self::Unknown
                }
            },
            Written::Random(written) => {
                is_sound &= check_random(written, &key.key("random"), reporter);
                Self::Random(*written)
            }
        };
        if is_sound { found } else { Self::Unknown }
    }

    /// How many bodies of the model they are.
    pub(super) fn count(&self) -> usize {
        match self {
            Self::Alone | Self::Unknown => 1,
            Self::Placed(places) => places.len(),
            Self::Random(written) => written.count.0 as usize,
        }
    }
}

/// The bodies of the model that belong to each body of the file, well formed or not.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct BodyNumbers {
    /// Where those of each begin, and where the last end.
    starts: Vec<usize>,
}

impl Default for BodyNumbers {
    /// Of no body.
    fn default() -> Self {
        Self { starts: vec![0] }
    }
}

impl BodyNumbers {
    pub(super) fn of<'a>(copies: impl Iterator<Item = &'a Copies>) -> Self {
        let mut starts = vec![0];
        let mut next = 0;
        starts.extend(copies.map(|copies| {
            next += copies.count();
            next
        }));
        Self { starts }
    }

    /// How many bodies the model has.
    pub(crate) fn count(&self) -> usize {
        self.starts[self.starts.len() - 1]
    }

    /// Those of a body of the file.
    pub(crate) fn range(&self, number: usize) -> Range<usize> {
        self.starts[number]..self.starts[number + 1]
    }

    /// The body of the file that each body of the model belongs to.
    pub(crate) fn written(&self) -> Vec<usize> {
        let bodies = 0..self.starts.len() - 1;
        bodies.flat_map(|number| std::iter::repeat_n(number, self.range(number).len())).collect()
    }
}

/// Which names are those of copies.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct CopyNames(BTreeMap<String, Range<usize>>);

impl CopyNames {
    /// Those of bodies with these names and bodies of the model.
    pub(super) fn of<'a>(copied: impl Iterator<Item = (&'a str, Range<usize>)>) -> Self {
        Self(copied.map(|(name, range)| (name.to_owned(), range)).collect())
    }

    /// The body of the model that a name is of, if it is that of a copy.
    pub(crate) fn find(&self, name: &str) -> Option<usize> {
        let (of, number) = split_copy(name)?;
        let range = self.0.get(of)?;
        (number < range.len()).then(|| range.start + number)
    }

    /// Whether a body of the file has copies.
    pub(crate) fn has(&self, name: &str) -> bool {
        self.0.contains_key(name)
    }

    /// How many copies a body of the file has; none if it is no name of one that has any.
    pub(super) fn count(&self, name: &str) -> Option<usize> {
        self.0.get(name).map(Range::len)
    }
}

/// Whether a body may have copies; notes why not.
fn check_body(body: &Placed<Body>, in_lattice: bool, reporter: &mut Reporter<'_>) -> bool {
    let key = body.key.key("copies");
    if in_lattice {
        let help = "write the bodies of a cell one by one; the lattice repeats them";
        reporter.note(&key, "a cell of a lattice has no copies", help);
    }
    if !body.value.spring.is_empty() {
        let message = "its `spring` leads to a point of space, which all copies would have in common";
        let help = "write a `potential`, or the bodies one by one";
        reporter.note(&key, message, help);
    }
    !in_lattice && body.value.spring.is_empty()
}

/// Whether a grid has as many places as copies; notes it otherwise.
fn check_grid(written: &CopyGrid, key: &Key, reporter: &mut Reporter<'_>) -> bool {
    let mut is_sound = true;
    let counts = written.count.map(|count| count.0 as usize);
    let total = counts.into_iter().try_fold(1_usize, |product, count| product.checked_mul(count));
    if total.is_none_or(|total| total > MOST_COPIES) {
        let message = format!("more than {MOST_COPIES} copies");
        reporter.note(&key.key("count"), message, "write smaller numbers, or several bodies");
        is_sound = false;
    }
    for (along, (count, spacing)) in counts.iter().zip(&written.spacing).enumerate() {
        if *count > 1 && spacing.0 == 0.0 {
            let message = format!("{count} copies would be at one place");
            let help = "write the distance from one to the next, or a count of 1";
            reporter.note(&key.key("spacing").index(along), message, help);
            is_sound = false;
        }
    }
    is_sound
}

/// Whether a box has its corners in order; notes it otherwise.
fn check_random(written: &RandomCopies, key: &Key, reporter: &mut Reporter<'_>) -> bool {
    let [low, high] = written.bounds.each_ref().map(si);
    let turned = (0..3).find(|along| high[*along] < low[*along]);
    if let Some(along) = turned {
        let message = format!("along {} the second corner is below the first", ["x", "y", "z"][along]);
        reporter.note(&key.key("box"), message, "write the least corner first, [[0, 0, 0], [1, 1, 1]]");
    }
    let is_bounded = (high - low).add_scalar(written.gap.value()).product().is_finite();
    if !is_bounded {
        let message = "the volume of the box, with the gap around it, is beyond all numbers";
        reporter.note(&key.key("box"), message, "write a smaller box, or a smaller gap");
    }
    turned.is_none() && is_bounded
}
