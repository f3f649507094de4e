//! Exports of a recording to formats that everything reads.
//!
//! They pass chunk by chunk, so that a long run needs no more memory than a short one; an animation is thinned.

mod csv;
mod drawing;
mod gltf;
#[cfg(not(target_family = "wasm"))]
mod npz;
pub mod vtk;

pub use csv::{CsvTable, csv};
pub use drawing::Outlines;
pub use gltf::{GltfMotion, gltf};
#[cfg(not(target_family = "wasm"))]
pub use npz::npz;
