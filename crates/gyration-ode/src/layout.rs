//! The sizes, blocks and pattern of a system, as the steppers keep them between two steps.

use std::ops::Range;

use crate::pattern::{Components, Pattern};
use crate::system::System;

/// Sizes, blocks and pattern, copied from the system: u = (y, w) is one vector to the steppers.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct SystemLayout {
    /// The number of components of y.
    pub dimension: usize,
    /// The number of components of u = (y, w).
    pub width: usize,
    /// The blocks of y and, if there are quadratures, the range of w within u.
    pub groups: Vec<Range<usize>>,
    /// How many of the groups are blocks of y.
    pub blocks: usize,
    /// Which blocks enter the rates of which others.
    pub pattern: Pattern,
    /// The blocks that hang together.
    pub components: Components,
}

impl SystemLayout {
    /// The layout of so many quadratures and these blocks.
    ///
    /// # Panics
    /// If the blocks are not consecutive ranges from 0, or the pattern is one of other blocks: a mistake in the system,
    /// not in its data.
    pub fn new(blocks: &[Range<usize>], pattern: &Pattern, quadratures: usize) -> Self {
        let mut dimension = 0;
        for block in blocks {
            assert!(block.start == dimension && block.end >= dimension, "blocks must be consecutive ranges");
            dimension = block.end;
        }
        assert!(pattern.fits(blocks.len()), "the pattern is not one of {} blocks", blocks.len());
        let mut groups = blocks.to_vec();
        if quadratures > 0 {
            groups.push(dimension..dimension + quadratures);
        }
        let (pattern, components) = (pattern.clone(), Components::of(pattern, blocks.len()));
        Self { dimension, width: dimension + quadratures, groups, blocks: blocks.len(), pattern, components }
    }

    /// Copies the layout of a system.
    ///
    /// # Panics
    /// As `new`, and if the blocks do not end where the state does.
    pub fn of<S: System>(system: &S) -> Self {
        let layout = Self::new(system.blocks(), system.pattern(), system.quadratures());
        let (dimension, reached) = (system.dimension(), layout.dimension);
        assert!(dimension == reached, "blocks must cover 0..{dimension}, they end at {reached}");
        layout
    }

    /// Whether the layout is still that of the system.
    pub fn fits<S: System>(&self, system: &S) -> bool {
        self.dimension == system.dimension()
            && self.width == system.dimension() + system.quadratures()
            && self.blocks() == system.blocks()
            && self.pattern == *system.pattern()
    }

    /// The blocks of y.
    pub fn blocks(&self) -> &[Range<usize>] {
        &self.groups[..self.blocks]
    }
}
