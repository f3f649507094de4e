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

/// The keys of all errors of a scene of two balls, with these lines of the first and these behind both.
fn keys_of_two(first: &str, rest: &str) -> Vec<String> {
    let ball = |lines: &str| format!("[[body]]\nshape = {{ sphere = {{ radius = 0.1 }} }}\nmass = 1\n{lines}\n");
    let second = ball("name = \"b\"\ngroup = \"balls\"\nposition = [1, 0, 1]");
    let text = format!("time = {{ end = 1.0, sample = 0.1 }}\n{}{second}{rest}", ball(first));
    match Scene::parse("scene.toml", &text, Path::new(""), &[]) {
        Ok(_) => Vec::new(),
        Err(errors) => errors.as_slice().iter().map(|error| error.key.clone()).collect(),
    }
}

#[test]
fn a_body_with_an_error_still_counts_for_names_and_groups() {
    let repulsion = "repulsion = { alpha = 1, nu = 6, d0 = 0.01 }\n";
    let contact = |between: &str| format!("[[contact]]\nbetween = {between}\n{repulsion}");
    let spring = "[[spring]]\nbetween = [\"a\", \"b\"]\npoints = [[0, 0, 0], [0, 0, 0]]\nstiffness = 1\n";
    let table = "[[support]]\nname = \"table\"\nplane = {}\ncolour = 1\n";
    let colour = "name = \"a\"\ngroup = \"balls\"\ncolour = \"red\"";
    let rows = [
        (colour, contact("[\"balls\", \"balls\"]"), vec!["body.a.colour"]),
        (colour, contact("[\"a\", \"b\"]") + spring, vec!["body.a.colour"]),
        (
            colour,
            format!("{table}[[contact]]\nsupport = \"table\"\nbody = \"a\"\n{repulsion}"),
            vec!["body.a.colour", "support.table.colour"],
        ),
        // A name or a group that cannot be read may be any.
        ("name = \"a\"\ngroup = 5", contact("[\"balls\", \"balls\"]"), vec!["body.a.group"]),
        ("name = \"a\"\ngroup = [5]", contact("[\"steel\", \"b\"]"), vec!["body.a.group.0"]),
        ("name = 5", contact("[\"a\", \"b\"]") + spring, vec!["body.0.name"]),
        ("name = \"my ball\"", contact("[\"my ball\", \"b\"]"), vec!["body.0.name"]),
        // What is wrong with the contact itself is told beside.
        (colour, contact("[\"b\", \"b\"]"), vec!["body.a.colour", "contact.0.between"]),
        (colour, contact("[\"c\", \"b\"]"), vec!["body.a.colour", "contact.0.between.0"]),
    ];
    for (first, rest, wanted) in rows {
        let mut found = keys_of_two(first, &rest);
        found.sort();
        assert_eq!(found, wanted, "{first}\n{rest}");
    }
}
