//! Charts: series over two axes, with ticks and a legend beside them.
//!
//! A chart knows nothing of recordings or scenes. Legends stand to the right of the frame, so that they never cover
//! data.

mod axis;
pub mod frame;
mod legend;
mod palette;
mod series;
mod shapes;
pub mod ticks;

pub use axis::{Axis, AxisScale, extremes, raised};
pub use legend::{Legend, SIZE as LEGEND_SIZE};
pub use palette::Palette;
pub use series::{Chart, DASH_DOTTED, DASHED, DOTTED, LINE, Series};
pub use shapes::{ShapeChart, Shapes};
