//! Everything that is proved of this crate from outside.

#![allow(clippy::unwrap_used, reason = "the helpers of tests may panic as the tests themselves may")]

mod corpus;
mod meshes;
mod shells;
