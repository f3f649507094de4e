//! Whole runs through the public face: a module a subject. `no_allocation` is a program of its own, for its allocator.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on has failed")]

mod contracting;
mod copies;
mod corpus;
mod counts;
mod crowd;
mod deforming;
mod dissipation;
mod equations;
mod exchanges;
mod fields;
mod impulses;
mod interruptions;
mod islands;
mod joined;
mod joint_modes;
mod joint_survey;
mod joints;
mod lattices;
mod long_bodies;
mod meetings;
mod modes;
mod neighbours;
mod network;
mod own_forces;
mod partings;
mod pressed;
mod random;
mod random_scenes;
mod ranks;
mod remarks;
mod replay;
mod resumption;
mod run_loop;
mod runs;
mod scene_files;
mod sensitivities;
mod settled;
mod short_range;
mod softness;
mod stepping;
mod surfaces;
mod touching;
mod turning_supports;
mod waves;
