//! Words that are no keys where they stand: what is meant, or where else they belong.

use crate::common::{BALL, Row, TABLE, TIME, assert_error};

#[test]
fn words_that_are_no_keys_there_are_explained() {
    let rows: &[Row] = &[
        ("§rotation = [0, 0, 1]", "body.ball.rotation", "unknown key", "`orientation`"),
        ("§young = 1e6", "body.ball.young", "unknown key", "youngs_modulus"),
        ("§thickness = 0.1", "body.ball.thickness", "unknown key", "`size = [x, y, z]`"),
        ("§restitution = 0.5", "body.ball.restitution", "unknown key", "`[[contact]]`"),
        ("§mu = 0.5", "body.ball.mu", "unknown key", "`[[contact]]`"),
        ("§static = true", "body.ball.static", "is a support", "[[support]] with name"),
        ("§radius = 0.5", "body.ball.radius", "unknown key", "`body.shape.sphere.radius`"),
    ];
    for (line, key, message, help) in rows {
        assert_error(&format!("{TIME}{BALL}{line}\n"), key, message, help);
    }
    let contact = |line: &str| format!("{TIME}{TABLE}{BALL}[[contact]]\nsupport = \"table\"\n{line}\n");
    assert_error(&contact("§mu = 0.4"), "contact.0.mu", "unknown key", "its place is `contact.friction.mu`");
    assert_error(&contact("§restitution = 0.4"), "contact.0.restitution", "unknown key", "`contact.from.restitution`");
    assert_error(&contact("§stiffness = 0.4"), "contact.0.stiffness", "unknown key", "`from = { layer");
    assert_error(&format!("{TIME}§dt = 0.01\n{BALL}"), "time.dt", "unknown key", "`[solver] rtol`");
    let shape = |line: &str| format!("shape = {{ cylinder = {{ radius = 1, height = 1, {line} }} }}");
    let disc = format!("{TIME}{}", BALL.replace("shape = { sphere = { radius = 0.1 } }", &shape("§thickness = 1")));
    assert_error(&disc, "body.ball.shape.cylinder.thickness", "unknown key", "write `height`");
    assert_error(&format!("{TIME}{BALL}§spin = 1\n"), "body.ball.spin", "unknown key", "`angular_velocity =");
    let joint = format!(
        "{TIME}{BALL}[[joint]]\nname = \"j\"\nbetween = [\"ball\", \"space\"]\nkind = \"ball\"\n\
         points = [[0, 0, 0], [0, 0, 1]]\n§motor = 1\n"
    );
    assert_error(&joint, "joint.j.motor", "unknown key", "`drive = {");
    let kind = joint.replace("kind = \"ball\"", "kind = §\"spherical\"").replace("§motor = 1\n", "");
    assert_error(&kind, "joint.j.kind", "is not known here", "it is called \"ball\" here");
    // The nearest place is told, within the table or around it.
    let rows: &[Row] = &[
        ("copies = { §spacing = 1 }", "body.ball.copies.spacing", "unknown key", "is `body.copies.grid.spacing`"),
        ("rigid = { §density = 1 }", "body.ball.rigid.density", "unknown key", "is `body.density`"),
    ];
    for (line, key, message, help) in rows {
        assert_error(&format!("{TIME}{BALL}{line}\n"), key, message, help);
    }
    // Of a material it is the beginning of a key.
    let soft = format!("{TIME}{BALL}affine = {{ material = {{ hencky = {{ §young = 1, poissons_ratio = 0.2 }} }} }}\n");
    assert_error(&soft, "body.ball.affine.material.hencky.young", "unknown key", "did you mean `youngs_modulus`?");
}
