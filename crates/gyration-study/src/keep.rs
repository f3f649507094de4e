//! What is kept of a run.

use crate::column::{Column, ColumnKind};
use gyration::tensor::Vec3;

/// One of the things that are kept.
#[derive(Debug, Clone, PartialEq)]
pub enum Keep {
    /// The material axis nearest to straight down.
    Face {
        /// The body, by name.
        body: String,
        /// At the start instead of the end.
        at_start: bool,
    },
    /// A column, by its values at the start, at the end, or over the samples.
    Column {
        /// Its name.
        column: String,
        /// What of it.
        measure: Statistic,
    },
    /// How many events.
    Count {
        /// Index into `EVENT_KINDS`.
        event: usize,
        /// The body, by name; all if none.
        body: Option<String>,
    },
    /// The values of a column at events.
    At {
        /// Index into `EVENT_KINDS`.
        event: usize,
        /// The body of the events, by name; all if none.
        body: Option<String>,
        /// The column.
        column: String,
        /// How many of them.
        pick: Pick,
    },
    /// The values of a column at samples.
    Samples {
        /// The column.
        column: String,
        /// How many of them.
        pick: Pick,
    },
    /// The largest angle between the vertical and the line that was upright [rad].
    Tilt {
        /// The body, by name.
        body: String,
    },
    /// How often matter or form turned.
    Turns {
        /// The body, by name.
        body: String,
        /// About which unit vector.
        axis: Vec3,
        /// The form instead of the matter.
        of_form: bool,
    },
    /// The level distance of the centre of mass from its start [m].
    Distance {
        /// The body, by name.
        body: String,
        /// Signed, in this direction.
        along: Option<Vec3>,
        /// The time to which it is reduced [s].
        per: Option<f64>,
    },
}

/// What is kept of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Statistic {
    /// Its value at the start.
    First,
    /// Its value at the end.
    Last,
    /// The latter less the former.
    Change,
    /// The smallest over the samples.
    Minimum,
    /// The greatest over the samples.
    Maximum,
    /// The mean over time.
    Mean,
}

/// How many of a list are kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pick {
    /// So many of the first.
    First(usize),
    /// So many of the last.
    Last(usize),
}

impl Keep {
    /// Whether it takes the samples of the run, and not only its ends.
    pub(crate) fn needs_samples(&self) -> bool {
        match self {
            Self::Column { measure, .. } => !matches!(measure, Statistic::First | Statistic::Last | Statistic::Change),
            Self::Samples { .. } | Self::Tilt { .. } | Self::Turns { .. } => true,
            Self::Face { .. } | Self::Count { .. } | Self::At { .. } | Self::Distance { .. } => false,
        }
    }

    /// The column of a recording that it is made from.
    pub(crate) fn column(&self) -> Option<&str> {
        match self {
            Self::Column { column, .. } | Self::At { column, .. } | Self::Samples { column, .. } => Some(column),
            _ => None,
        }
    }

    /// Its column of the table; `unit` is that of the column it is made from.
    pub(crate) fn table_column(&self, name: &str, unit: Option<&str>) -> Column {
        match self {
            Self::Face { .. } => Column::new(name, None, ColumnKind::Text),
            Self::Column { .. } => Column::new(name, unit, ColumnKind::Number),
            Self::Count { .. } => Column::new(name, None, ColumnKind::Integer),
            Self::At { .. } | Self::Samples { .. } => Column::new(name, unit, ColumnKind::List),
            Self::Tilt { .. } => Column::new(name, Some("rad"), ColumnKind::Number),
            Self::Turns { .. } => Column::new(name, Some("1"), ColumnKind::Number),
            Self::Distance { .. } => Column::new(name, Some("m"), ColumnKind::Number),
        }
    }
}
