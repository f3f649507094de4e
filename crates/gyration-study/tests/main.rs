//! Studies and calibrations through the public face: a module a subject.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on has failed")]

mod begins;
mod book;
mod calibration;
mod common;
mod corpus;
mod dispersion;
mod errors;
mod flips;
mod keeps;
mod python;
mod random;
mod rebounds;
mod robust;
mod table;
