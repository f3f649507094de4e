//! What `--set` owes whatever it is given: the same scene, or the same errors, whether the text is read once or anew.

use gyration_scene::{Override, Scene, Template, gallery_scene};
use std::path::Path;

/// Applies overrides, each behind a zero byte but the first, to scenes of the gallery.
pub fn check(input: &str) {
    let overrides: Vec<String> = input.split('\0').map(str::to_owned).collect();
    for name in ["dice", "hop", "tank-tread"] {
        let Ok(text) = gallery_scene(name) else { panic!("the gallery has no {name}") };
        let once = Template::parse("scene.toml", text, Path::new("/nowhere"));
        let once = once.unwrap_or_else(|errors| panic!("{errors}")).scene(&Override::parse_all(&overrides));
        let anew = Scene::parse("scene.toml", text, Path::new("/nowhere"), &overrides);
        match (once, anew) {
            (Ok(once), Ok(anew)) => assert_eq!(once.resolved(), anew.resolved()),
            (Err(once), Err(anew)) => {
                assert!(once.count() > 0);
                assert_eq!(once.to_string(), anew.to_string());
            }
            (once, _) => panic!("read once: {}, read anew the contrary", once.is_ok()),
        }
    }
}
