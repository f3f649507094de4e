//! Tables of drives and of prescribed contractions: what is wrong with one is said with its file and line, and the fix.

use crate::common::{BALL, TIME};
use gyration_scene::{Scene, SceneErrors};
use std::fs;

/// What is found in a scene beside a table.
fn beside_table(content: &str, line: &str) -> Result<Scene, SceneErrors> {
    let folder = tempfile::tempdir().unwrap_or_else(|error| panic!("{error}"));
    fs::write(folder.path().join("q.csv"), content).unwrap_or_else(|error| panic!("{error}"));
    let text = format!("{TIME}{BALL}contractile = {{ {line} }}\n");
    Scene::parse("scene.toml", &text, folder.path(), &[])
}

#[test]
fn tables_that_do_not_tell_the_whole_run_are_refused() {
    let row = |time: &str, first: &str| format!("{time},{first},0,0,0,1,0,0,0,1\n");
    let drive = "contraction_viscosity = 1, drive = { table = { file = \"q.csv\" } }";
    let cubic = "prescribed = { table = { file = \"q.csv\", interpolation = \"cubic\" } }";
    let rows: &[(String, &str, &str, &str)] = &[
        (
            row("0", "1") + &row("0.5", "1"),
            drive,
            "q.csv ends early, at 0.5 s: time.end is 1.0 s",
            "end the run at 0.5 s",
        ),
        (row("0", "1") + &row("0.5", "1"), cubic, "ends early", "add rows up to t = 1.0"),
        (row("0.25", "1") + &row("1", "1"), drive, "q.csv begins late, at 0.25 s", "add a row at t = 0"),
        (
            row("0", "1") + &row("2", "1") + &row("1", "1"),
            drive,
            "line 3: the time of row 3, 1 s, is not later",
            "sort",
        ),
        (row("0", "1") + &row("0", "1"), cubic, "line 2: the time of row 2, 0 s, is not later", "each time once"),
        (String::new(), drive, "the table has no row", "at least one row"),
        ("t,a,b,c,d,e,f,g,h,i\n".to_owned(), cubic, "the table has no row", "at least one row"),
        (row("0", "1") + &row("1", "nan"), drive, "line 2: row 2 has a number that is not finite", "finite"),
        ("0,1,2,3\n1,1,2,3\n".to_owned(), drive, "line 1: expected 10 columns, found 4", "`t, Q_xx, Q_xy, Q_xz, Q_yx"),
        (row("0", "one"), cubic, "line 1: column 2 holds \"one\"", "`t, G_xx, G_xy,"),
    ];
    for (content, line, message, help) in rows {
        let Err(found) = beside_table(content, line) else { panic!("taken: {content}") };
        let error = &found.as_slice()[0];
        let name = if line.starts_with("prescribed") { "prescribed" } else { "drive" };
        let key = format!("body.ball.contractile.{name}.table.file");
        assert_eq!((found.count(), error.key.as_str()), (1, key.as_str()), "{found}");
        assert!(error.message.contains(message) && error.help.contains(help), "{found}");
    }
    for line in [drive, cubic] {
        let content = row("-1", "1") + &row("0.5", "2") + &row("7", "1");
        assert!(beside_table(&content, line).is_ok(), "a table may tell more than the run");
    }
}

#[test]
fn a_spline_that_overshoots_below_zero_is_refused() {
    // From 1 to 0.05 within a tenth of the run: the natural spline swings below zero behind the fall.
    let row = |time: f64, stretch: f64| format!("{time},{stretch},0,0,0,1,0,0,0,1\n");
    let content = [(0.0, 1.0), (0.4, 1.0), (0.5, 0.05), (0.6, 0.05), (1.0, 0.05)].map(|(t, g)| row(t, g)).concat();
    let table = |words: &str| format!("prescribed = {{ table = {{ file = \"q.csv\"{words} }} }}");
    assert!(beside_table(&content, &table("")).is_ok(), "straight lines do not");
    let found = beside_table(&content, &table(", interpolation = \"cubic\"")).err().map(|found| found.to_string());
    assert!(found.as_ref().is_some_and(|found| found.contains("its determinant is -0.")), "{found:?}");
}

#[test]
fn a_length_of_the_run_that_is_wrong_is_not_held_against_a_table() {
    let content = "0,1,0,0,0,1,0,0,0,1\n";
    let folder = tempfile::tempdir().unwrap_or_else(|error| panic!("{error}"));
    fs::write(folder.path().join("q.csv"), content).unwrap_or_else(|error| panic!("{error}"));
    let text = format!(
        "[time]\nend = -1\nsample = 0.1\n{BALL}contractile = {{ prescribed = {{ table = {{ file = \"q.csv\" }} }} }}\n"
    );
    let Err(found) = Scene::parse("scene.toml", &text, folder.path(), &[]) else { panic!("taken: {text}") };
    let keys: Vec<&str> = found.into_iter().map(|error| error.key.as_str()).collect();
    assert_eq!(keys, ["time.end"], "{found}");
}

/// A block of the scene reference between fences of this kind.
fn example(fence: &str) -> &'static str {
    let reference = include_str!("../../../docs/scene-reference.md");
    let section = reference.split("## `contractile`").nth(1).unwrap_or_else(|| panic!("no section"));
    let (_, block) = section.split_once(fence).unwrap_or_else(|| panic!("no block {fence:?}"));
    block.split("```").next().unwrap_or_default()
}

#[test]
fn the_examples_of_the_scene_reference_are_taken() {
    let scene = Scene::parse("a.toml", &format!("{TIME}{BALL}{}", example("```toml part of body\n")), "".as_ref(), &[]);
    assert!(scene.is_ok(), "{:?}", scene.err().map(|errors| errors.to_string()));
    let table = "contraction_viscosity = 1, drive = { table = { file = \"q.csv\" } }";
    let scene = beside_table(example("```csv\n"), table);
    assert!(scene.is_ok(), "{:?}", scene.err().map(|errors| errors.to_string()));
}
