//! Symptom: a wrong type in one key of a body hid the wrong values of its other keys until it was mended.

use gyration_scene::Scene;
use std::path::Path;

const HEAD: &str = "time = { end = 1.0, sample = 0.1 }\n[[body]]\nname = \"die\"\n";

/// The keys of all errors of a scene with this body.
fn keys(body: &str) -> Vec<String> {
    let errors = match Scene::parse("scene.toml", &format!("{HEAD}{body}"), Path::new(""), &[]) {
        Ok(_) => return Vec::new(),
        Err(errors) => errors,
    };
    errors.as_slice().iter().map(|error| error.key.clone()).collect()
}

#[test]
fn a_wrong_type_does_not_hide_wrong_values_of_other_keys() {
    let body = "shape = { torus = { major_radius = 1, minor_radius = 2 } }\ndensity = 1\nvelocity = [1, 2]\n\
                orientation = { quaternion = [0, 0, 0, 0] }\n";
    let found = keys(body);
    for key in ["body.die.velocity", "body.die.orientation.quaternion", "body.die.shape.torus.minor_radius"] {
        assert!(found.iter().any(|found| found == key), "{key} is not among {found:?}");
    }
    assert_eq!(found.len(), 3, "{found:?}");
}

#[test]
fn what_a_wrong_key_leaves_open_is_not_held_against_the_others() {
    // Without its density the body has no mass, and the union's part none to take: only the density is at fault.
    let union = "shape = { union = { parts = [{ shape = { sphere = { radius = 1 } } }] } }\ndensity = [1]\n";
    assert_eq!(keys(union), ["body.die.density"]);
    // Without its pin the velocity would be free, without its spin it would contradict the pin.
    let pinned = "shape = { sphere = { radius = 1 } }\ndensity = 1\npin = [0, 0, 1]\nvelocity = [1, 0, 0]\n\
                  angular_velocity = [0, \"fast\", 0]\n";
    assert_eq!(keys(pinned), ["body.die.angular_velocity.1"]);
}
