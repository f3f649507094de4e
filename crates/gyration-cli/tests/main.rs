//! The program `gyration` as its users start it: a module a subject.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on has failed")]

mod animation;
mod bands;
#[cfg(feature = "study")]
mod calibrate;
mod commands;
mod common;
mod continuum;
mod drive_plots;
mod export;
mod fields;
mod full_disk;
mod import;
mod meeting_plots;
mod orbit;
mod python;
mod remarks;
mod resistance;
mod resume;
mod run;
mod spectrum;
#[cfg(feature = "study")]
mod study;
#[cfg(feature = "study")]
mod study_plots;
#[cfg(feature = "view")]
mod view;
