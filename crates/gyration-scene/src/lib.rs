//! The scene file: parse, check, fill in defaults, build a model and its first state.
//!
//! ```text
//! text → tree (TOML or JSON, with places) → overrides → structure (JSON Schema) → values → model, state, plan
//! ```
//!
//! [`Scene::open`] does all of it; [`Template`] reads a text once for many scenes. Everything that is wrong with a
//! scene comes at once, with file, line, column, dotted key and fix ([`SceneErrors`]); a file that cannot be read at
//! all is a [`ReadError`]. The types of the file are in [`mod@file`]; their units and defaults are decided here and
//! nowhere else. This crate integrates nothing, and computes no flow: resistances that only boundary elements tell are
//! asked for when a scene is to be run ([`Scene::complete`]).

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

mod assemble;
mod check;
mod defaults;
mod document;
mod error;
pub mod file;
mod file_sum;
mod gallery;
pub mod input;
mod key;
mod overriding;
mod places;
mod pressing;
pub mod quantity;
mod read;
mod scene;
mod schema;

mod suggest;
mod table;
mod template;
mod tree;
mod turn;
mod uniform;
pub mod units;
mod unknown;

pub use assemble::{
    Built, CellBlock, CellLoad, ENDLESS_CELLS, Packet, Plan, Record, StartingWave, StopAtRest, TRIANGLES, UnitCell,
    WaveRun, WaveStart,
};
pub use error::{ErrorKind, LoadError, NotToml, ReadError, SceneError, SceneErrors};
pub use file::{Method, Recorded};
pub use file_sum::FileSum;
pub use gallery::{NotInGallery, gallery, gallery_scene, gallery_title};
pub use overriding::{Override, OverrideValue};
pub use pressing::Pressing;
pub use scene::Scene;
pub use schema::{schema, schema_of, written_schema};
pub use suggest::{fix as suggestion, listed};
pub use template::{Template, unit_of};
pub use uniform::Uniform;
pub use unknown::{NoForm, NoWave, UnknownForm};
