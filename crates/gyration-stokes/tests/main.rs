//! The resistance of closed surfaces through the public face: a module a subject.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on has failed")]

mod ellipsoid;
mod reference;
mod refusals;
mod relations;
mod sphere;
mod wall;
