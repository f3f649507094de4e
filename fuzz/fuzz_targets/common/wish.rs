//! What the reader of a watcher's wishes owes whatever text it gets: a wish, or a word on why it is none.

use gyration_scene::{Override, Template, gallery_scene};
use gyration_view::Wish;
use std::path::Path;

/// Reads a text as a message of the live page, and opens the scene again as a restart would.
pub fn check(text: &str) {
    match Wish::parse(text) {
        Ok(Wish::Restart { set }) => {
            let Ok(scene) = gallery_scene("dice") else { panic!("the gallery has no dice") };
            let template = Template::parse("dice.toml", scene, Path::new("/nowhere"));
            let template = template.unwrap_or_else(|errors| panic!("{errors}"));
            if let Err(errors) = template.scene(&Override::parse_all(&set)) {
                assert!(errors.count() > 0);
            }
        }
        Ok(Wish::Pause | Wish::Resume) => {}
        Err(reason) => assert!(!reason.is_empty()),
    }
}
