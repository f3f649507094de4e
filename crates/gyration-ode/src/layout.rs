//! The sizes, blocks and components of a system, as the steppers keep them between two steps.

use std::ops::Range;

use crate::system::System;
use gyration_blocks::Components;

/// Sizes, blocks and components, copied from the system: u = (y, w) is one vector to the steppers.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct SystemLayout {
    /// The number of components of y.
    pub dimension: usize,
    /// The number of components of u = (y, w).
    pub width: usize,
    /// The blocks of y and, if there are quadratures that have a part in the error of a step, their range within u.
    pub groups: Vec<Range<usize>>,
    /// How many of the groups are blocks of y.
    pub blocks: usize,
    /// The components of the system, each listed.
    pub components: Components,
}

impl SystemLayout {
    /// The layout of so many quadratures, these blocks and their components.
    ///
    /// # Panics
    /// If the blocks are not consecutive ranges from 0, or the components are of other blocks: a mistake in the system,
    /// not in its data.
    pub fn new(blocks: &[Range<usize>], components: &Components, quadratures: usize) -> Self {
        let mut dimension = 0;
        for block in blocks {
            assert!(block.start == dimension && block.end >= dimension, "blocks must be consecutive ranges");
            dimension = block.end;
        }
        let mut groups = blocks.to_vec();
        if quadratures > 0 {
            groups.push(dimension..dimension + quadratures);
        }
        let components = components.listed(blocks.len());
        Self { dimension, width: dimension + quadratures, groups, blocks: blocks.len(), components }
    }

    /// Copies the layout of a system.
    ///
    /// # Panics
    /// As `new`, and if the blocks do not end where the state does.
    pub fn of<S: System>(system: &S) -> Self {
        let mut layout = Self::new(system.blocks(), system.components(), system.quadratures());
        let free = system.free_quadratures();
        if let Some(watched) = layout.groups.get_mut(layout.blocks).filter(|_| free > 0) {
            watched.end -= free;
        }
        let (dimension, reached) = (system.dimension(), layout.dimension);
        assert!(dimension == reached, "blocks must cover 0..{dimension}, they end at {reached}");
        layout
    }

    /// Whether the layout is still that of the system.
    pub fn fits<S: System>(&self, system: &S) -> bool {
        self.dimension == system.dimension()
            && self.width == system.dimension() + system.quadratures()
            && self.blocks() == system.blocks()
            && self.components.are(system.components())
    }

    /// Whether there are quadratures, none of which has a part in the error of a step.
    pub fn has_only_free_quadratures(&self) -> bool {
        self.width > self.dimension && self.groups.get(self.blocks).is_none_or(Range::is_empty)
    }

    /// The blocks of y.
    pub fn blocks(&self) -> &[Range<usize>] {
        &self.groups[..self.blocks]
    }
}
