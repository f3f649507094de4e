//! The mechanics through its public face: a module a subject.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on has failed")]

mod affine_balance;
mod affine_rates;
mod between;
mod bonds;
mod contact_wrench;
mod contractile_balance;
mod contractile_rates;
mod curved_moments;
mod deformed;
mod deformed_moments;
mod deformed_relations;
mod facet_moments;
mod felt_in_fluid;
mod guides;
mod joints;
mod mass;
mod materials;
mod moving;
mod pairs;
mod rigid_rates;
mod shapes;
mod solid_supports;
mod solids;
mod triangulations;
mod volume_rules;
