//! Strips: the outlines of bodies at successive times, to scale.
//!
//! Where the bodies leave room for one another and the supports stand still, all times share one picture, as under a
//! stroboscope; otherwise each time has a picture of its own. Or the times follow one another in one place (`motion`).

mod clock;
mod frames;
mod ground;
mod marks;
mod motion;
mod paint;
mod silhouette;
mod strays;
mod view;

pub use frames::Strip;
pub use motion::Motion;
