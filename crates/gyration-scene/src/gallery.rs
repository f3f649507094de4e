//! The built-in gallery: scenes that run by their name, compiled into the program.

use crate::read::document;

/// Name and text of each scene, in the order in which they are listed.
static SCENES: &[(&str, &str)] = &[
    ("dice", include_str!("../../../scenes/dice.toml")),
    ("bounce", include_str!("../../../scenes/bounce.toml")),
    ("bounce-flat", include_str!("../../../scenes/bounce-flat.toml")),
    ("bounce-tilted", include_str!("../../../scenes/bounce-tilted.toml")),
    ("slide", include_str!("../../../scenes/slide.toml")),
    ("roll", include_str!("../../../scenes/roll.toml")),
    ("rock", include_str!("../../../scenes/rock.toml")),
    ("adhere", include_str!("../../../scenes/adhere.toml")),
    ("shaker", include_str!("../../../scenes/shaker.toml")),
    ("top", include_str!("../../../scenes/top.toml")),
    ("top-slow", include_str!("../../../scenes/top-slow.toml")),
    ("top-falling", include_str!("../../../scenes/top-falling.toml")),
    ("rattleback", include_str!("../../../scenes/rattleback.toml")),
    ("tippe-top", include_str!("../../../scenes/tippe-top.toml")),
    ("euler-disk", include_str!("../../../scenes/euler-disk.toml")),
    ("rocking-block", include_str!("../../../scenes/rocking-block.toml")),
    ("elastic-bounce", include_str!("../../../scenes/elastic-bounce.toml")),
    ("elastic-bounce-tilted", include_str!("../../../scenes/elastic-bounce-tilted.toml")),
    ("elastic-bounce-spinning", include_str!("../../../scenes/elastic-bounce-spinning.toml")),
    ("elastic-roll", include_str!("../../../scenes/elastic-roll.toml")),
    ("elastic-oscillate", include_str!("../../../scenes/elastic-oscillate.toml")),
    ("spin-flatten", include_str!("../../../scenes/spin-flatten.toml")),
    ("double-well", include_str!("../../../scenes/double-well.toml")),
    ("drop-skew", include_str!("../../../scenes/drop-skew.toml")),
    ("pinned-strain", include_str!("../../../scenes/pinned-strain.toml")),
    ("stiff-limit", include_str!("../../../scenes/stiff-limit.toml")),
    ("kick", include_str!("../../../scenes/kick.toml")),
    ("contract-1", include_str!("../../../scenes/contract-1.toml")),
    ("contract-2", include_str!("../../../scenes/contract-2.toml")),
    ("contract-3", include_str!("../../../scenes/contract-3.toml")),
    ("hop", include_str!("../../../scenes/hop.toml")),
    ("crawl", include_str!("../../../scenes/crawl.toml")),
    ("roll-over", include_str!("../../../scenes/roll-over.toml")),
    ("breathe", include_str!("../../../scenes/breathe.toml")),
    ("scallop", include_str!("../../../scenes/scallop.toml")),
    ("jeffery", include_str!("../../../scenes/jeffery.toml")),
    ("tank-tread", include_str!("../../../scenes/tank-tread.toml")),
    ("tumble-tremble", include_str!("../../../scenes/tumble-tremble.toml")),
    ("extension", include_str!("../../../scenes/extension.toml")),
    ("settle", include_str!("../../../scenes/settle.toml")),
    ("swimmer", include_str!("../../../scenes/swimmer.toml")),
    ("basset", include_str!("../../../scenes/basset.toml")),
    ("collide", include_str!("../../../scenes/collide.toml")),
    ("cradle", include_str!("../../../scenes/cradle.toml")),
    ("dice-pair", include_str!("../../../scenes/dice-pair.toml")),
    ("dominoes", include_str!("../../../scenes/dominoes.toml")),
    ("overhang", include_str!("../../../scenes/overhang.toml")),
    ("soft-collision", include_str!("../../../scenes/soft-collision.toml")),
    ("stack", include_str!("../../../scenes/stack.toml")),
    ("bricks", include_str!("../../../scenes/bricks.toml")),
    ("ball-on-ball", include_str!("../../../scenes/ball-on-ball.toml")),
    ("wedge", include_str!("../../../scenes/wedge.toml")),
    ("billiard", include_str!("../../../scenes/billiard.toml")),
    ("turntable", include_str!("../../../scenes/turntable.toml")),
    ("drum", include_str!("../../../scenes/drum.toml")),
    ("stair", include_str!("../../../scenes/stair.toml")),
    ("pendulum-chain", include_str!("../../../scenes/pendulum-chain.toml")),
    ("linkage", include_str!("../../../scenes/linkage.toml")),
    ("gripper", include_str!("../../../scenes/gripper.toml")),
    ("climber", include_str!("../../../scenes/climber.toml")),
    ("adhesive-cluster", include_str!("../../../scenes/adhesive-cluster.toml")),
    ("diatomic", include_str!("../../../scenes/diatomic.toml")),
    ("affine-chain", include_str!("../../../scenes/affine-chain.toml")),
    ("kagome", include_str!("../../../scenes/kagome.toml")),
    ("contact-chain", include_str!("../../../scenes/contact-chain.toml")),
    ("wave-gap", include_str!("../../../scenes/wave-gap.toml")),
    ("active-chain", include_str!("../../../scenes/active-chain.toml")),
    ("gyroscopes", include_str!("../../../scenes/gyroscopes.toml")),
];

/// Name and text of each scene of the gallery.
pub fn gallery() -> &'static [(&'static str, &'static str)] {
    SCENES
}

/// The text of a scene of the gallery.
///
/// # Errors
/// [`NotInGallery`] if there is no such scene.
pub fn gallery_scene(name: &str) -> Result<&'static str, NotInGallery> {
    find(name).ok_or_else(|| NotInGallery(name.to_owned()))
}

/// The title of a scene, from its text alone: no body of it is made.
pub fn gallery_title(text: &str) -> Option<String> {
    let document = document("", text).ok()?;
    Some(document.root.get("title")?.text()?.to_owned())
}

/// The gallery has no such scene.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("the gallery has no scene `{0}`\n  fix: choose one of {names}", names = SCENES.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", "))]
pub struct NotInGallery(String);

/// The text of a scene of the gallery.
pub(crate) fn find(name: &str) -> Option<&'static str> {
    SCENES.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Scene;

    #[test]
    fn titles_are_those_of_the_scenes() {
        for (name, text) in SCENES {
            assert_eq!(gallery_title(text).as_deref(), Some(Scene::open(name, &[]).unwrap().title()), "{name}");
        }
    }
}
