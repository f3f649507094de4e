//! Drawings: a list of marks on a page, and the three formats that they are written in.
//!
//! Lengths are points (1/72 inch), x to the right, y downwards, the origin in the upper left corner. A drawing knows
//! nothing of charts, recordings or scenes. Its bytes depend on the marks alone: no dates, no names of machines.

pub mod color;
mod film;
pub mod font;
mod format;
mod geometry;
mod label;
mod marks;
mod pdf;
mod png;
mod svg;

pub use color::Color;
pub use film::{Film, FilmFrame};
pub use format::Format;
pub use geometry::{Point, Rect};
pub use label::Label;
pub use marks::{Anchor, Mark, Moment, Page, Path, Stroke, Text};
