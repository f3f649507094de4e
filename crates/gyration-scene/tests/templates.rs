//! Scenes made of a text that was read once, and titles of texts that were not.

use gyration_scene::{ErrorKind, Override, OverrideValue, Scene, Template, gallery, gallery_title};
use std::path::Path;

const TEXT: &str =
    "time = { end = 1, sample = 1 }\n[[body]]\nname = \"a\"\nshape = { sphere = { radius = 1 } }\ndensity = 2\n";

#[test]
fn a_scene_from_a_template_is_that_of_the_text() {
    let template = Template::parse("x.toml", TEXT, Path::new("")).unwrap();
    for overrides in
        [&[][..], &["body.a.density=3".to_owned()], &["body.b.density=3".to_owned()], &["body.0.mass=1".to_owned()]]
    {
        let (one, other) =
            (template.scene(&Override::parse_all(overrides)), Scene::parse("x.toml", TEXT, Path::new(""), overrides));
        assert_eq!(one.as_ref().map(Scene::resolved), other.as_ref().map(Scene::resolved));
    }
    let wrong = ["time.end=2", "body.0.densty=3", "time.end=-1"].map(Override::parse);
    let errors = template.scene(&wrong).unwrap_err();
    let told: Vec<_> = errors.as_slice().iter().map(|error| (error.overriding, error.fault)).collect();
    assert_eq!(told, [(Some(1), ErrorKind::Structure), (Some(2), ErrorKind::Value)]);
}

#[test]
fn numbers_of_a_program_make_the_scene_that_their_texts_make() {
    let template = Template::parse("x.toml", TEXT, Path::new("")).unwrap();
    let (third, many) = (1.0 / 3.0, [0.1, -2e-300, 7.0]);
    let quaternion = OverrideValue::Table("quaternion", vec![0.6, 0.0, 0.8, 0.0]);
    let sets = [
        vec![Override::new("body.a.density", third), Override::new("body.0.position", many)],
        vec![Override::new("body.a.orientation", quaternion), Override::new("time.end", "2 min")],
        vec![Override::new("time.end", 2.0), Override::new("body.a.densty", third), Override::new("time.end", -1.0)],
        vec![Override::new("body.a.velocity.1", 3.0), Override::new("body.a.density", f64::INFINITY)],
    ];
    for set in sets {
        let written: Vec<String> = set.iter().map(Override::to_string).collect();
        let (typed, text) = (template.scene(&set), Scene::parse("x.toml", TEXT, Path::new(""), &written));
        assert_eq!(typed.as_ref().map(Scene::resolved), text.as_ref().map(Scene::resolved), "{written:?}");
        assert_eq!(typed.map(|scene| scene.overrides()).unwrap_or(written.clone()), written);
    }
}

#[test]
fn keys_of_one_place_are_the_same_by_index() {
    let template = Template::parse("x.toml", TEXT, Path::new("")).unwrap();
    assert_eq!(template.by_index(" body . a.velocity.2"), "body.0.velocity.2");
    assert_eq!(template.by_index("body.0.velocity.2"), "body.0.velocity.2");
    assert_eq!(template.by_index("body.b.density"), "body.b.density");
}

#[test]
fn titles_are_those_of_the_scenes() {
    for (name, text) in gallery() {
        assert_eq!(gallery_title(text).as_deref(), Some(Scene::open(name, &[]).unwrap().title()), "{name}");
    }
}
