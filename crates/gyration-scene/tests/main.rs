//! Reading scenes through the public face: a module a subject.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on has failed")]

mod affine;
mod affine_errors;
mod behaviour;
mod common;
mod contractile;
mod contractile_errors;
mod contractile_robust;
mod contractile_tables;
mod copies;
mod corpus;
mod errors;
mod file_sums;
mod joints;
mod keeps;
mod kinetic;
mod lattice_errors;
mod meant;
mod meetings;
mod own_forces;
mod robust;
mod scenes;
mod solid_supports;
mod templates;
mod together;
