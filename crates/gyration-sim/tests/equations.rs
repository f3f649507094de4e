//! The page of equations names keys, scenes, columns and answers that there are.

use gyration_scene::{Scene, gallery, schema};
use gyration_sim::RunPlan;
use gyration_sim::rows::Fields;
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::Path;

const PAGE: &str = include_str!("../../../docs/equations.md");
const ANSWERS: &str = include_str!("../../../docs/known-answers.md");

/// A scene in which every column of the page applies, by one measure of area or the other.
const WHOLE: &str = r#"
time = { end = 1, sample = 1 }
fluid = { viscosity = 1, density = 1 }
[[support]]
name = "table"
plane = {}
motion = { velocity = [0, 0, 0.1] }
[[contact]]
support = "table"
measure = "MEASURE"
repulsion = { alpha = 1, nu = 5 }
damping = { beta = 1, nu = 5 }
friction = { beta = 1, nu = 5 }
adhesion = { beta = 1, nu_attractive = 3, nu_repulsive = 9 }
[[body]]
name = "NAME"
shape = { sphere = { radius = 0.1 } }
density = 1000
position = [0, 0, 1]
inclusion = {}
spring = [{ anchor = [0, 0, 2], stiffness = 1, rest_length = 0.5, damping = 1 }]
contractile = { material = { neo_hookean = { shear = 1000 } }, viscosity = 1, contraction_viscosity = 1 }
[[joint]]
name = "NAME"
between = ["NAME", "space"]
kind = "hinge"
axis = [0, 1, 0]
points = [[0, 0, 0], [0, 0, 1]]
"#;

/// Arrays and columns of a recording of that scene.
fn recorded(measure: &str) -> BTreeSet<String> {
    let text = format!("record.quantities = {:?}\n{WHOLE}", quantities(&schema())).replace("MEASURE", measure);
    let scene = Scene::parse("whole.toml", &text, Path::new(""), &[]).unwrap_or_else(|errors| panic!("{errors}"));
    let built = scene.built();
    let (arrays, _) = Fields::new(&built.model, &RunPlan::from(built).extras).arrays(&built.model);
    arrays.into_iter().flat_map(|array| array.columns.into_iter().chain([array.name])).collect()
}

/// Every word of `record.quantities`.
fn quantities(schema: &Value) -> Vec<String> {
    let words = &schema["$defs"]["Recorded"]["oneOf"];
    words.as_array().unwrap().iter().map(|word| word["const"].as_str().unwrap().to_owned()).collect()
}

/// Every name of a property in a schema.
fn properties(schema: &Value, names: &mut BTreeSet<String>) {
    if let Some(of) = schema.get("properties").and_then(Value::as_object) {
        names.extend(of.keys().cloned());
    }
    match schema {
        Value::Object(entries) => entries.values().for_each(|entry| properties(entry, names)),
        Value::Array(entries) => entries.iter().for_each(|entry| properties(entry, names)),
        _ => {}
    }
}

/// What stands between backticks.
fn quoted(cell: &str) -> impl Iterator<Item = &str> {
    cell.split('`').skip(1).step_by(2)
}

#[test]
fn the_page_of_equations_names_what_there_is() {
    let mut keys = BTreeSet::new();
    let recorded = &recorded("deformed_area") | &recorded("reference_area");
    properties(&schema(), &mut keys);
    let scenes: Vec<&str> = gallery().iter().map(|(name, _)| *name).collect();
    let cells = |line: &'static str| line.split(" | ").map(|cell| cell.trim_matches(['|', ' '])).collect::<Vec<_>>();
    let answers: Vec<Vec<&str>> = ANSWERS.lines().map(cells).filter(|cells| cells.len() > 2).collect();
    let mut rows = 0;
    for line in PAGE.lines().filter(|line| line.starts_with('|') && !line.starts_with("|---")) {
        let cells = cells(line);
        let [_, _, key, scene, column, answer] = cells[..] else { panic!("{line}") };
        if key == "key" {
            continue;
        }
        rows += 1;
        for key in quoted(key) {
            let unknown: Vec<&str> = key.split('.').filter(|part| !keys.contains(*part)).collect();
            assert!(unknown.is_empty(), "`{key}` is no key: {unknown:?}");
        }
        for scene in quoted(scene) {
            assert!(scenes.contains(&scene), "`{scene}` is not in the gallery");
        }
        for column in quoted(column) {
            assert!(recorded.contains(column), "`{column}` is not recorded: {recorded:?}");
        }
        for answer in answer.split("; ").filter(|answer| *answer != "–") {
            let named = answer.trim_matches('`');
            let place = usize::from(answer != named);
            assert!(answers.iter().any(|cells| cells[place] == named), "{answer} is no known answer");
        }
    }
    assert!(rows > 40, "{rows}");
}
