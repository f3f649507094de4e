//! The ready studies, as texts.
//!
//! A package of its own, so that the files travel with the sources wherever these are taken from.

/// Name and text of each study, in the order in which they are listed.
pub static STUDIES: &[(&str, &str)] = &[
    ("dice-fairness", include_str!("dice-fairness.toml")),
    ("cuboid-dice", include_str!("cuboid-dice.toml")),
    ("dice-basin", include_str!("dice-basin.toml")),
    ("restitution", include_str!("restitution.toml")),
    ("bounce-bifurcation", include_str!("bounce-bifurcation.toml")),
    ("rocking-overturn", include_str!("rocking-overturn.toml")),
    ("crawl-map", include_str!("crawl-map.toml")),
    ("shear-map", include_str!("shear-map.toml")),
];
