//! `gyration study STUDY plot`: pictures of a table.

use crate::common::Sandbox;

/// Two heights, a random speed: six runs.
const STUDY: &str = r#"
title = "How high a ball is"
scene = "ball.toml"
repetitions = 3

[parameter.drop]
key = "body.ball.position.2"
values = [0.2, 0.3]

[parameter.speed]
key = "body.ball.velocity.0"
uniform = { from = 0, to = 1 }

[keep]
top = { maximum = "ball.z" }
face = { face = "ball" }
apexes = { at = "apex", body = "ball", column = "ball.z", last = 2 }

[plot]
y = "top"
"#;

fn studied() -> Sandbox {
    let sandbox = Sandbox::with_ball();
    sandbox.write("balls.toml", STUDY);
    sandbox.done(&["study", "balls.toml", "--quiet"]);
    sandbox
}

#[test]
fn a_table_is_drawn_by_plot_as_well_and_told_as_json() {
    let sandbox = studied();
    sandbox.done(&["plot", "balls.study"]);
    let drawn = std::fs::read(sandbox.path("balls.svg")).unwrap();
    sandbox.done(&["study", "balls.study", "plot", "-o", "again.svg"]);
    assert_eq!(drawn, std::fs::read(sandbox.path("again.svg")).unwrap());
    assert!(sandbox.refused(2, &["plot", "balls.study", "height"]).stderr.contains("--colour"));
    let told = sandbox.done(&["study", "balls.toml", "--resume", "--json"]).stdout;
    let told: serde_json::Value = serde_json::from_str(&told).unwrap();
    assert_eq!((told["runs"].as_u64(), told["points"].as_u64()), (Some(6), Some(2)));
    assert_eq!(told["columns"]["top"]["count"].as_u64(), Some(6));
}

#[test]
fn study_draws_what_it_says_and_what_is_asked_for() {
    let sandbox = studied();
    let pictures: [(&[&str], &str, &str); 6] = [
        (&[], "balls.svg", "top"),
        (&["--y", "apexes", "-o", "apexes.svg"], "apexes.svg", "apexes"),
        (&["--x", "top", "--kind", "histogram", "-o", "tops.svg"], "tops.svg", "runs"),
        (&["--x", "speed", "--y", "top", "--colour", "face", "-o", "dots.svg"], "dots.svg", "speed"),
        (&["--x", "drop", "--y", "face=+z,-z", "-o", "share.svg"], "share.svg", "share of face"),
        (&["-o", "balls.png"], "balls.png", "PNG"),
    ];
    for (more, file, words) in pictures {
        sandbox.done(&[&["study", "balls.toml", "plot"], more].concat());
        let picture = String::from_utf8_lossy(&std::fs::read(sandbox.path(file)).unwrap()).into_owned();
        assert!(picture.contains(words), "{more:?}: {file} does not contain {words}");
    }
    let table = sandbox.done(&["study", "balls.study/table.parquet", "plot", "-o", "-"]);
    let folder = sandbox.done(&["study", "balls.study", "plot", "-o", "-"]);
    assert!(table.stdout.contains("How high a ball is") && table.stdout == folder.stdout);
}

#[test]
fn the_file_says_what_is_drawn_also_after_the_runs() {
    let sandbox = studied();
    // Another picture of the same runs.
    sandbox.write("balls.toml", &STUDY.replace("y = \"top\"", "x = \"drop\"\ny = \"face=+z,-z\"\ntitle = \"Faces\""));
    let drawn = sandbox.done(&["study", "balls.toml", "plot", "-o", "-"]).stdout;
    assert!(drawn.contains("Faces") && drawn.contains("share of face"), "{drawn}");
    let drawn = sandbox.done(&["study", "balls.toml", "plot", "--set", "plot.title=\"Sides\"", "-o", "-"]).stdout;
    assert!(drawn.contains("Sides") && !drawn.contains("Faces"), "{drawn}");
    sandbox.refused(2, &["study", "balls.study", "plot", "--set", "plot.title=\"Sides\""]);
    // A slip is found before anything runs, and before anything is drawn.
    for (plot, words) in [
        ("y = \"tip\"", "a column `tip`, which it will not have"),
        ("kolor = 3", "has no key `kolor`"),
        ("logarithmic = [\"z\"]", "a logarithmic axis `z`"),
    ] {
        sandbox.write("slip.toml", &STUDY.replace("y = \"top\"", plot));
        let said = sandbox.refused(2, &["study", "slip.toml"]).stderr;
        assert!(said.contains(words) && said.contains("fix:"), "{said}");
        assert!(!sandbox.names().contains(&"slip.study".to_owned()));
    }
    let said = sandbox.refused(2, &["study", "balls.toml", "plot", "--x", "drop", "--y", "outcome=complete"]).stderr;
    assert!(said.contains("no run has `complete`") && said.contains("completed"), "{said}");
}

#[test]
fn what_cannot_be_drawn_is_refused_with_the_fix() {
    let sandbox = studied();
    let refused: [(&[&str], &str); 4] = [
        (&["--y", "tops"], "its columns are run, point"),
        (&["--kind", "map"], "the study has no such axis"),
        (&["-o", "balls.bmp"], ".svg, .png, .pdf or .gif"),
        (&["--x", "apexes", "--kind", "curve"], "is a list"),
    ];
    for (more, words) in refused {
        let said = sandbox.refused(2, &[&["study", "balls.toml", "plot"], more].concat());
        assert!(said.stderr.contains(words), "{more:?}: {}", said.stderr);
    }
    let said = sandbox.run(&["study", "dice-fairness", "plot"]);
    assert!(said.code != Some(0) && said.stderr.contains("gyration study dice-fairness"), "{}", said.stderr);
}
