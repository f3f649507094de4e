//! The survey of joints: what they are, and the freedoms that they leave.

use gyration_scene::Scene;
use gyration_sim::survey::{Survey, modes};
use serde_json::json;
use std::path::Path;

const SCENE: &str = r#"
    time = { end = 1, sample = 1 }
    [[support]]
    name = "table"
    plane = { origin = [0, 0, -9] }
    [[body]]
    name = "arm"
    shape = { box = { size = [0.2, 0.1, 0.1] } }
    mass = 1
    [[body]]
    name = "soft"
    shape = { sphere = { radius = 0.1 } }
    mass = 1
    affine = { material = { neo_hookean = { shear = 1000 } } }
    position = [0.3, 0, 0]
    [[body]]
    name = "bead"
    shape = { points = [{ mass = 1, at = [0, 0, 0] }] }
    position = [5, 0, 0]
    [[body]]
    name = "free"
    shape = { sphere = { radius = 0.1 } }
    mass = 1
    position = [0, 9, 0]
    [[joint]]
    name = "hip"
    between = ["space", "arm"]
    kind = "hinge"
    axis = [0, 1, 0]
    points = [[-0.1, 0, 0], [-0.1, 0, 0]]
    limits = [-0.5, 1]
    stop = { repulsion = { alpha = 1, nu = 2, d0 = 0.1 } }
    [[joint]]
    name = "wrist"
    between = ["arm", "soft"]
    kind = "ball"
    points = [[0.2, 0, 0], [-0.1, 0, 0]]
    [[joint]]
    name = "rod"
    between = ["bead", "table"]
    kind = "distance"
    points = [[0, 0, 0], [5, 0, 2]]
"#;

#[test]
fn joints_are_told_with_the_freedoms_that_they_leave() {
    let scene = Scene::parse("scene.toml", SCENE, Path::new(""), &[]).unwrap();
    let survey = Survey::of(&scene).unwrap();
    let words = survey.text(&scene).unwrap();
    for line in [
        "joint      hip: hinge of space and arm, 5 equations, 0 rad at the start, stopped at -0.5 and 1 rad\n",
        "joint      wrist: ball of arm and soft, 3 equations\n",
        "joint      rod: distance of bead and table, 1 equation, 2 m at the start\n",
        // 6 and 11, since the volume is kept; 5 and 3 equations.
        "linkage    arm, soft: 17 coordinates less 8 equations leave 9 freedoms\n",
        "linkage    bead: 3 coordinates less 1 equation leave 2 freedoms\n",
    ] {
        assert!(words.contains(line), "{line}{words}");
    }
    let told = serde_json::to_value(&survey).unwrap();
    assert_eq!(told["joints"][0]["between"], json!(["space", "arm"]));
    assert_eq!(told["joints"][0]["limits"], json!([-0.5, 1.0]));
    assert_eq!(
        told["linkages"][0],
        json!({ "bodies": ["arm", "soft"], "coordinates": 17, "equations": 8, "freedoms": 9 })
    );
    let table = json!({
        "name": "table", "plane": { "origin": [0.0, 0.0, -9.0], "normal": [0.0, 0.0, 1.0] }, "moves": false
    });
    assert_eq!(told["supports"], json!([table]));
    let found = modes(&scene);
    let count = |number: usize| found.systems[number].rest_state.as_ref().map(|rest| rest.modes.len());
    assert_eq!(count(0), Some(9), "{:?}", found.systems);
}
