//! What the scene parser owes whatever text it gets: a scene that resolves to itself, or errors with a place.

use gyration_scene::{Scene, SceneErrors};
use std::path::Path;

/// Reads a text as a scene, with the overrides that stand behind it, each after a zero byte.
pub fn check(input: &str) {
    let mut parts = input.split('\0');
    let text = parts.next().unwrap_or_default();
    let overrides: Vec<String> = parts.map(str::to_owned).collect();
    match read("scene.toml", text, &overrides) {
        Ok(scene) => {
            assert!(scene.built().state.bodies.iter().all(|number| number.is_finite()), "a start that is not finite");
            let resolved = scene.resolved();
            let again = read("again.json", &resolved.to_string(), &[]);
            let again = again.unwrap_or_else(|errors| panic!("a resolved scene is refused: {errors}"));
            assert_eq!(again.resolved(), resolved, "a resolved scene resolves to another");
        }
        Err(errors) => {
            assert!(errors.count() > 0 && !errors.to_string().is_empty());
            assert!(errors.into_iter().all(|error| error.line > 0 && error.column > 0 && !error.message.is_empty()));
        }
    }
}

fn read(name: &str, text: &str, overrides: &[String]) -> Result<Scene, SceneErrors> {
    Scene::parse(name, text, Path::new("/nowhere"), overrides)
}
