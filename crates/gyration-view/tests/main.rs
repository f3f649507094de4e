//! What pages get, through the public face: a module a subject.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on has failed")]

mod common;
mod connections;
mod corpus;
mod fields;
mod live;
mod network;
mod recording;
mod report;
mod waves;
