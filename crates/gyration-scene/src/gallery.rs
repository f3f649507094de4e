//! The built-in gallery: scenes that run by their name, compiled into the program.

use crate::read::document;
use gyration_scenes::SCENES;

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
