//! What is wrong with a study is told at once, each with its place and its fix.

use crate::common::{self, sandbox};
use gyration_scene::{LoadError, SceneError};
use gyration_study::Study;

fn errors(text: &str) -> Vec<SceneError> {
    let sandbox = sandbox();
    match Study::parse("s.toml", text, sandbox.path(), &[]) {
        Err(LoadError::Content(errors)) => errors.as_slice().to_vec(),
        Err(other) => panic!("{other}"),
        Ok(_) => panic!("nothing is wrong with {text}"),
    }
}

/// One error with this key, and these words in message and fix.
fn refused(text: &str, line: usize, key: &str, words: [&str; 2]) {
    let errors = errors(text);
    let [error] = &errors[..] else { panic!("{errors:#?}") };
    assert_eq!((error.line, error.key.as_str(), error.file.as_str()), (line, key, "s.toml"), "{error}");
    assert!(error.message.contains(words[0]) && error.help.contains(words[1]), "{error}");
}

/// A study of the ball with a parameter.
fn parameter(text: &str) -> String {
    format!("scene = \"ball.toml\"\n[parameter.p]\n{text}\n")
}

#[test]
fn impossible_distributions_are_refused() {
    let height = "key = \"body.ball.position.2\"\n";
    let refused_as = |variation: &str, key: &str, words| {
        refused(&parameter(&format!("{height}{variation}")), 4, &format!("parameter.p.{key}"), words);
    };
    refused_as("uniform = { from = 2, to = 1 }", "uniform.to", ["not greater than from", "swap"]);
    refused_as("uniform = { from = 1, to = \"100 cm\" }", "uniform.to", ["not greater than from", "a greater end"]);
    refused_as("log_uniform = { from = 3, to = 2 }", "log_uniform.to", ["not greater than from", "swap"]);
    refused_as("log_uniform = { from = -1, to = 1 }", "log_uniform.from", ["no logarithm", "greater than 0"]);
    refused_as("normal = { mean = 0, deviation = 0 }", "normal.deviation", ["no standard deviation", "greater than 0"]);
    refused_as("normal = { mean = 0, deviation = inf }", "normal.deviation", ["finite", "finite"]);
    refused_as("grid = { from = 0, to = 1, count = 0 }", "grid.count", ["at least 1", "1"]);
    refused_as("grid = { from = 0, to = 1, count = 2.5 }", "grid.count", ["no count", "whole"]);
    refused_as("grid = { from = 0, to = 1, count = 3, spacing = \"log\" }", "grid.from", ["no logarithm", "greater"]);
    refused_as("grid = { from = 1, to = 1, count = 3 }", "grid.to", ["all values are 1", "count = 1"]);
    refused_as("grid = { from = 0, to = 1, count = 3, spacing = \"lin\" }", "grid.spacing", ["\"lin\"", "linear"]);
    refused_as("values = []", "values", ["no values", "one"]);
    refused_as("uniform = { from = 0.1, to = \"3 kg\" }", "uniform.to", ["\"3 kg\" is in", "number in m"]);
    refused_as("uniform = { from = 0.1, to = 1, till = 3 }", "uniform.till", ["unknown key", "to"]);
    let text = parameter(&format!("{height}uniform = {{ from = 0.1, to = 3 }}\nwith = \"x\""));
    refused(&text, 5, "parameter.p.with", ["no axis", "leave"]);
}

#[test]
fn what_is_wrong_with_a_study_and_with_its_scene_comes_at_once() {
    let text = "scene = \"ball.toml\"\nsead = 1\n[parameter.p]\nkey = \"body.ball.densty\"\nvalues = [1, 2]\n\
        [parameter.q]\nkey = \"body.ball.density\"\nuniform = { from = 2, to = 1 }\n[keep]\nz = { last = \"ball.zz\" }\n";
    let found: Vec<_> = errors(text).into_iter().map(|error| (error.line, error.key)).collect();
    let keys = ["sead", "parameter.p.key", "parameter.q.uniform.to", "keep.z"];
    for key in keys {
        assert!(found.iter().any(|(_, found)| found == key), "{key}: {found:?}");
    }
    assert_eq!(found.len(), keys.len(), "{found:?}");
}

#[test]
fn impossible_directions_are_refused() {
    let spin = "key = \"body.ball.velocity\"\n";
    let text = parameter(&format!("{spin}direction = {{ magnitude = -1 }}"));
    refused(&text, 4, "parameter.p.direction.magnitude", ["no length", "at least 0"]);
    let text = parameter(&format!("{spin}direction = {{ magnitude = {{ from = 3, to = 1 }} }}"));
    assert_eq!(errors(&text).len(), 1);
}

#[test]
fn unknown_keys_of_the_scene_are_told_by_their_parameter() {
    let uniform = "uniform = { from = 0.1, to = 0.2 }";
    let at = |key: &str| parameter(&format!("key = \"{key}\"\n{uniform}"));
    refused(&at("body.bull.position.2"), 3, "parameter.p.key", ["no item \"bull\"", "ball"]);
    refused(&at("body.ball.densty"), 3, "parameter.p.key", ["unknown key \"densty\"", "density"]);
    refused(&at("body.ball.position"), 3, "parameter.p.key", ["body.ball.position: expected an array", "write"]);
    let text = "scene = \"ball.toml\"\n[set]\n\"time.ende\" = 3\n";
    refused(text, 3, "set.time.ende", ["unknown key", "end"]);
    let text = parameter("key = \"body.ball.velocity\"\nrotation = \"uniform\"");
    refused(&text, 3, "parameter.p.key", ["expected an array", "write"]);
}

#[test]
fn two_parameters_do_not_set_one_key() {
    let text = "scene = \"ball.toml\"\n[parameter.a]\nkey = \"body.0.density\"\nvalues = [1, 2]\n\
                [parameter.b]\nkey = \"body.ball.density\"\nvalues = [1, 2]\n";
    refused(text, 6, "parameter.b.key", ["the parameter \"a\" already sets", "one of the two"]);
    let text = "scene = \"ball.toml\"\n[set]\n\"body.ball.density\" = 3\n[parameter.b]\nkey = \
        \"body.ball.density\"\nvalues = [1, 2]\n";
    refused(text, 5, "parameter.b.key", ["[set] already sets", "one of the two"]);
    // One within the other: the later would hide the earlier.
    let text = "scene = \"ball.toml\"\n[parameter.a]\nkey = \"body.ball.position.2\"\nvalues = [1, 2]\n\
                [parameter.b]\nkey = \"body.ball.position\"\nvalues = [[0, 0, 1]]\n";
    refused(text, 6, "parameter.b.key", ["the parameter \"a\" already sets `body.0.position.2`", "one of the two"]);
}

#[test]
fn every_value_of_a_list_is_looked_at() {
    let text = |values: &str| {
        format!("scene = \"ball.toml\"\n[parameter.a]\nkey = \"body.ball.density\"\nvalues = {values}\n")
    };
    refused(&text("[1000, \"20 m\"]"), 4, "parameter.a.values", ["value 2 of the list", "kg/m"]);
    refused(&text("[1000, nan]"), 4, "parameter.a.values", ["finite", "finite"]);
    refused(&text("[1000, true]"), 4, "parameter.a.values", ["value 2 of the list", "number"]);
}

#[test]
fn axes_that_vary_together_are_of_one_length() {
    let axis = |name: &str, values: &str, with: &str| {
        format!("[parameter.{name}]\nkey = \"body.ball.position.{name}\"\nvalues = {values}\n{with}\n")
    };
    let text = format!("scene = \"ball.toml\"\n{}{}", axis("0", "[1, 2]", ""), axis("1", "[1, 2, 3]", "with = \"0\""));
    refused(&text, 9, "parameter.1.with", ["it has 3 values, and \"0\" has 2", "as many"]);
    let text = text.replace("with = \"0\"", "with = \"2\"");
    refused(&text, 9, "parameter.1.with", ["no axis \"2\"", "0"]);
}

#[test]
fn what_is_kept_is_checked() {
    let kept = |keep: &str| format!("scene = \"ball.toml\"\n[keep]\nk = {keep}\n");
    refused(&kept("{ last = \"ball.zz\" }"), 3, "keep.k", ["no column \"ball.zz\"", "ball.z"]);
    refused(&kept("{ face = \"bal\" }"), 3, "keep.k", ["no body \"bal\"", "ball"]);
    refused(&kept("{ count = \"apexes\" }"), 3, "keep.k.count", ["no event", "apex"]);
    refused(&kept("{ lst = \"ball.z\" }"), 3, "keep.k.lst", ["unknown key", "last"]);
    refused(&kept("{ last = \"ball.z\", first = \"ball.z\" }"), 3, "keep.k", ["exactly one", "write one of"]);
    refused(&kept("{}"), 3, "keep.k", ["exactly one", "write one of"]);
    refused(&kept("{ at = \"apex\", column = \"ball.z\" }"), 3, "keep.k", ["`first` and `last`", "last = 32"]);
    refused(&kept("{ at = \"apex\", column = \"ball.z\", last = 0 }"), 3, "keep.k.last", ["no count", "whole"]);
    refused(&kept("{ face = \"ball\", at = \"middle\" }"), 3, "keep.k.at", ["\"middle\"", "start"]);
    refused(&kept("{ tilt = \"ball\", axis = [0, 0, 1] }"), 3, "keep.k.axis", ["does not belong", "leave"]);
    refused(&kept("{ turns = \"ball\", axis = [0, 0, 0] }"), 3, "keep.k.axis", ["zero", "direction"]);
    refused(&kept("{ distance = \"ball\", per = \"3 m\" }"), 3, "keep.k.per", ["in m", "number in s"]);
    refused(
        "scene = \"ball.toml\"\n[keep]\ntime = { last = \"t\" }\n",
        3,
        "keep.time",
        ["already has a column", "name"],
    );
}

#[test]
fn numbers_of_runs_are_checked() {
    let with = |line: &str| format!("scene = \"ball.toml\"\n{line}\n");
    refused(&with("repetitions = 0"), 2, "repetitions", ["at least 1", "1"]);
    refused(&with("repetitions = 1.5"), 2, "repetitions", ["not a whole number", "whole"]);
    refused(&with("repetitions = 2e12"), 2, "repetitions", ["more than", "fewer"]);
    refused(&with("seed = -1"), 2, "seed", ["at least 0", "0"]);
    refused(&with("sampling = \"halton\""), 2, "sampling", ["not known", "sobol"]);
    refused(&with("sead = 1"), 2, "sead", ["unknown key", "seed"]);
    refused(&with("body = []"), 2, "body", ["unknown key", "key of scenes, which `gyration run` takes"]);
    refused(&with("fit = {}"), 2, "fit", ["unknown key", "`gyration calibrate`"]);
    let rotations: String =
        (0..8).map(|k| format!("[parameter.p{k}]\nkey = \"body.{k}.orientation\"\nrotation = \"uniform\"\n")).collect();
    let errors = errors(&format!("scene = \"ball.toml\"\nsampling = \"sobol\"\n{rotations}"));
    let sampling = errors.iter().find(|error| error.key == "sampling").unwrap();
    assert!(sampling.message.contains("24 dimensions") && sampling.help.contains("latin_hypercube"), "{sampling}");
    // The scene has one body, that of the index 0.
    assert_eq!(errors.len(), 8);
}

#[test]
fn everything_comes_at_once_and_scenes_speak_for_themselves() {
    let text =
        "scene = \"ball.toml\"\nrepetitions = 0\n[parameter.a]\nkey = \"body.ball.density\"\n[keep]\nk = { lst = 1 }\n";
    let keys: Vec<String> = errors(text).into_iter().map(|error| error.key).collect();
    assert_eq!(keys, ["repetitions", "parameter.a", "keep.k.lst"]);
    refused("scene = \"bal.toml\"\n", 1, "scene", ["bal.toml: no such file", "path"]);
    // Found by fuzzing: it was refused without a word.
    refused("scene = \"\"\n", 1, "scene", ["no name", "path"]);
    let sandbox = sandbox();
    std::fs::write(sandbox.path().join("bad.toml"), common::BALL.replace("density", "densty")).unwrap();
    let text = "scene = \"bad.toml\"\n";
    let error = Study::parse("s.toml", text, sandbox.path(), &[]).unwrap_err().to_string();
    assert!(error.contains("bad.toml:18:1: body.ball.densty"), "{error}");
    assert!(matches!(Study::open("dice-farness", &[]), Err(LoadError::Read(_))));
}
