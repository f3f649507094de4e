//! Derivatives of random scenes by random numbers of theirs: numbers, or a reason why there are none.
//!
//! `GYRATION_CASES=0..1000 cargo test --release -p gyration-sim --test tests derivatives_of_random` takes others than
//! those of the ordinary tests.

use crate::random::scene::scene;
use crate::random::stream::Stream;
use crate::random::verdict::run;
use gyration_scene::Scene;
use gyration_sim::Outcome;
use gyration_sim::sensitivity::{At, Sensitivities};
use serde_json::Value;
use std::collections::BTreeMap;

/// Dotted keys of all numbers below a value.
fn numbers(value: &Value, key: &str, found: &mut Vec<String>) {
    let inside = |word: &str| if key.is_empty() { word.to_owned() } else { format!("{key}.{word}") };
    match value {
        Value::Number(_) => found.push(key.to_owned()),
        Value::Array(items) => {
            items.iter().enumerate().for_each(|(index, item)| numbers(item, &inside(&index.to_string()), found));
        }
        Value::Object(table) => table.iter().for_each(|(word, item)| numbers(item, &inside(word), found)),
        _ => {}
    }
}

#[test]
fn derivatives_of_random_scenes_are_numbers_or_told_why_not() {
    let folder = tempfile::tempdir().unwrap();
    let cases = crate::random_scenes::cases(8);
    let mut counts = BTreeMap::new();
    for case in cases {
        let text = scene(case, folder.path());
        let open = |overrides: &[String]| Scene::parse("scene.json", &text, folder.path(), overrides).unwrap();
        let whole = open(&[]);
        // As far as a random scene is run.
        let overrides = match run(&whole).unwrap().outcome {
            Outcome::Stopped(stop) => vec![format!("time.end={:?}", 0.9 * stop.time)],
            _ => Vec::new(),
        };
        let scene = open(&overrides);
        let mut keys = Vec::new();
        numbers(&scene.resolved(), "", &mut keys);
        let mut stream = Stream::of(case ^ 0x5eed);
        let keys: Vec<String> = (0..3).map(|_| keys[stream.index(keys.len())].clone()).collect();
        let body = scene.built().model.name(0);
        let mut quantities: Vec<String> = ["x", "y", "z", "vx"].map(|part| format!("{body}.{part}")).to_vec();
        quantities.push("energy.kinetic".to_owned());
        let found = Sensitivities::along(&scene, &keys, &quantities, At::End);
        let found = found.unwrap_or_else(|refusal| panic!("case {case}, {keys:?}: {refusal}"));
        for (key, derivatives) in keys.iter().zip(&found.derivatives) {
            let (word, told) = match derivatives.at_end() {
                Err(reason) => ("told why not", reason.to_string()),
                Ok(row) => {
                    assert_eq!(row.len(), quantities.len(), "case {case}, {key}");
                    assert!(row.iter().all(|number| number.is_finite()), "case {case}, {key}: {row:?}");
                    ("finite", format!("{row:?}"))
                }
            };
            println!("case {case}, {key}: {told}");
            *counts.entry(word).or_insert(0) += 1;
        }
    }
    println!("{counts:?}");
    assert!(counts.get("finite").copied().unwrap_or(0) > 0, "{counts:?}");
}
