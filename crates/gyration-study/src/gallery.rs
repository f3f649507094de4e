//! The ready studies, compiled into the program.

/// Name and text of each study, in the order in which they are listed.
static STUDIES: &[(&str, &str)] = &[
    ("dice-fairness", include_str!("../../../studies/dice-fairness.toml")),
    ("cuboid-dice", include_str!("../../../studies/cuboid-dice.toml")),
    ("dice-basin", include_str!("../../../studies/dice-basin.toml")),
    ("restitution", include_str!("../../../studies/restitution.toml")),
    ("bounce-bifurcation", include_str!("../../../studies/bounce-bifurcation.toml")),
    ("rocking-overturn", include_str!("../../../studies/rocking-overturn.toml")),
    ("crawl-map", include_str!("../../../studies/crawl-map.toml")),
    ("shear-map", include_str!("../../../studies/shear-map.toml")),
];

/// Name and text of each ready study.
pub fn studies() -> &'static [(&'static str, &'static str)] {
    STUDIES
}

/// The text of a ready study.
pub(crate) fn find(name: &str) -> Option<&'static str> {
    STUDIES.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
}
