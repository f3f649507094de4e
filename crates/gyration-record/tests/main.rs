//! Recordings on disk through the public face: a module a subject.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on has failed")]

mod common;
mod contract;
mod corpus;
mod flips;
mod kill;
mod memory;
mod python;
