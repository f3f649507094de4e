//! The steppers through their public face: orders, accuracy, events, restarts, stiff and block systems.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on has failed")]

mod accuracy;
mod blocks;
mod common;
mod events;
mod order;
mod restart;
mod stiff;
mod switching;
