//! The steppers through their public face: orders, accuracy, events, resumption, stiff systems, blocks and their
//! coupling.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on has failed")]

mod accuracy;
mod blocks;
mod common;
mod coupling;
mod events;
mod extended;
mod order;
mod resumption;
mod stiff;
mod switching;
