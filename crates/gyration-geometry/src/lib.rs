//! Shapes from points and from files: convex hulls and meshes.
//!
//! What comes back is closed, oriented outward and has a volume: hulls by construction, meshes because they have passed
//! [`Polyhedron::validate`](gyration::shape::Polyhedron::validate). Paths and scales are the caller's; nothing here
//! knows a scene. The readers of STL, OBJ and PLY are our own: they keep f64, say at which line or byte a file is
//! wrong, and allocate nothing on the word of a header.

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

mod fault;
mod hull;
mod insertion;
mod mesh;
mod obj;
mod ply;
mod ply_header;
mod polygon;
mod shells;
mod stl;

pub use fault::{FileFault, FilePlace, Trouble};
pub use hull::{HullError, hull};
pub use mesh::{MAX_MESH_BYTES, MeshError, parse_mesh, read_mesh};
pub use shells::{ShellFault, Shells, doubly_enclosed};
