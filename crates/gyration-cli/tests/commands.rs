//! Commands that need no recording: gallery, schema, completions, help, check.

use crate::common::{BALL, Sandbox, soft_ball};
use serde_json::Value;

#[test]
fn gallery_is_listed_with_titles_and_printed_verbatim() {
    let sandbox = Sandbox::new();
    let list = sandbox.done(&["scenes"]).stdout;
    for name in ["dice", "bounce", "slide"] {
        let text = sandbox.done(&["scenes", name]).stdout;
        let path = format!("{}/../../scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"));
        assert_eq!(text, std::fs::read_to_string(path).unwrap());
        let title = text.lines().find_map(|line| line.strip_prefix("title = ")).unwrap().trim_matches('"');
        assert!(list.lines().any(|line| line.starts_with(name) && line.ends_with(title)), "{list}");
    }
    let said = sandbox.refused(2, &["scenes", "nothing"]);
    assert!(said.stderr.contains("dice"), "{}", said.stderr);
}

#[test]
fn a_new_scene_runs_as_it_is_and_names_the_schema_beside_it() {
    let sandbox = Sandbox::new();
    let said = sandbox.done(&["new", "my scene"]).stderr;
    assert!(said.contains("`gyration run 'my scene.toml'`"), "{said}");
    assert_eq!(sandbox.names(), ["gyration.schema.json", "my scene.toml"]);
    let text = std::fs::read_to_string(sandbox.path("my scene.toml")).unwrap();
    assert!(text.starts_with("#:schema gyration.schema.json\n") && text.contains("title = \"my scene\""), "{text}");
    let schema = std::fs::read_to_string(sandbox.path("gyration.schema.json")).unwrap();
    assert_eq!(schema, sandbox.done(&["schema"]).stdout);
    let run = sandbox.done(&["run", "my scene.toml"]).stderr;
    assert!(run.contains("came to rest") && !run.contains("warning") && !run.contains("note"), "{run}");
    sandbox.refused(2, &["new", "two\nlines"]);
    // What is there stays.
    assert!(sandbox.refused(2, &["new", "my scene.toml"]).stderr.contains("is there already"));
    sandbox.done(&["new"]);
    assert!(sandbox.path("scene.toml").exists());
}

#[test]
fn schema_is_json() {
    let schema: Value = serde_json::from_str(&Sandbox::new().done(&["schema"]).stdout).unwrap();
    assert!(schema["properties"]["body"].is_object());
    for (files, key) in [("study", "parameter"), ("calibration", "fit")] {
        let schema: Value = serde_json::from_str(&Sandbox::new().done(&["schema", files]).stdout).unwrap();
        assert!(schema["properties"][key].is_object(), "{files}");
    }
}

#[test]
fn shells_are_told_commands_options_and_names() {
    let sandbox = Sandbox::with_ball();
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = sandbox.done(&["completions", shell]).stdout;
        assert!(script.contains("GYRATION_COMPLETE"), "{shell}: {script}");
    }
    // As a shell asks that stands behind the last of these words.
    let told = |words: &[&str]| {
        let mut command = sandbox.command(&[&["--", "gyration"][..], words].concat());
        command.env("GYRATION_COMPLETE", "bash").env("_CLAP_COMPLETE_INDEX", words.len().to_string());
        String::from_utf8(command.output().unwrap().stdout).unwrap()
    };
    for (words, wanted) in [
        (&["ex"][..], "export"),
        (&["run", "dom"], "dominoes"),
        (&["run", "bal"], "ball.toml"),
        (&["run", "--res"], "--resume"),
        (&["study", "dice-f"], "dice-fairness"),
    ] {
        assert!(told(words).lines().any(|word| word == wanted), "{words:?}: {}", told(words));
    }
}

#[test]
fn manual_pages_tell_every_command() {
    let sandbox = Sandbox::new();
    let main = sandbox.done(&["man"]).stdout;
    assert!(main.contains(".TH gyration") && main.contains("calibrate"), "{main}");
    std::fs::create_dir(sandbox.path("man")).unwrap();
    sandbox.done(&["man", "man"]);
    let run = std::fs::read_to_string(sandbox.path("man/gyration-run.1")).unwrap();
    assert!(run.contains("\\-\\-resume"), "{run}");
    assert!(sandbox.path("man/gyration.1").exists());
}

#[test]
fn lists_are_told_as_json_too() {
    let sandbox = Sandbox::new();
    for arguments in [["scenes", "--json"], ["study", "--json"]] {
        let list: Value = serde_json::from_str(&sandbox.done(&arguments).stdout).unwrap();
        let first = &list.as_array().unwrap()[0];
        assert!(first["name"].is_string() && first["title"].as_str().is_some_and(|title| !title.is_empty()), "{first}");
    }
}

#[test]
fn help_and_version_go_to_stdout() {
    let help = Sandbox::new().done(&["--help"]);
    assert!(help.stderr.is_empty() && help.stdout.contains("completions") && help.stdout.contains("calibrate"));
    assert!(Sandbox::new().done(&["--version"]).stdout.starts_with("gyration 0."));
}

#[test]
fn bad_arguments_are_refused() {
    let sandbox = Sandbox::with_ball();
    for arguments in [
        &["fly"][..],
        &[],
        &["run"],
        &["run", "ball.toml", "--resume", "--force"],
        &["export", "x.gyr", "--format", "xlsx"],
        &["plot", "ball.toml", "colour"],
        &["run", "ball.toml", "--set", "body.ball.density"],
        &["run", "ball.toml", "--set", "body.bull.density=3"],
    ] {
        sandbox.refused(2, arguments);
    }
    assert_eq!(sandbox.names(), ["ball.toml"]);
}

#[test]
fn scene_that_is_not_there_is_told_from_a_bad_one() {
    let sandbox = Sandbox::new();
    let said = sandbox.refused(3, &["run", "bal.toml"]);
    assert!(said.stderr.starts_with("gyration: error: bal.toml"), "{}", said.stderr);
    sandbox.write("bad.toml", &BALL.replace("density", "densty"));
    let said = sandbox.refused(2, &["check", "bad.toml"]);
    assert!(
        said.stderr.contains("bad.toml:24:1: body.ball.densty") && said.stderr.contains("density"),
        "{}",
        said.stderr
    );
}

#[test]
fn errors_have_no_colors_in_a_pipe() {
    let sandbox = Sandbox::new();
    for command in [&["run", "nothing"][..], &["fly"]] {
        assert!(!sandbox.run(command).stderr.contains('\x1b'));
    }
}

#[test]
fn check_finds_the_gap_at_which_the_weight_is_carried() {
    let sandbox = Sandbox::with_ball();
    let found: Value = serde_json::from_str(&sandbox.done(&["check", "ball.toml", "--json"]).stdout).unwrap();
    let body = &found["bodies"][0];
    let pair = &body["supports"][0];
    assert_eq!((body["name"].as_str(), pair["support"].as_str()), (Some("ball"), Some("table")));
    let (radius, alpha, d0) = (0.05f64, 40e3, 2e-3f64);
    let mass = 1000.0 * 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3);
    // Hat-box theorem: F = 2πRα d₀⁶ (d⁻⁵ − (d + 2R)⁻⁵)/5, which falls with d.
    let force = |d: f64| {
        2.0 * std::f64::consts::PI * radius * alpha * d0.powi(6) * (d.powi(-5) - (d + 2.0 * radius).powi(-5)) / 5.0
    };
    let (mut low, mut high) = (1e-6f64, 1.0f64);
    for _ in 0..200 {
        let middle = (low * high).sqrt();
        if force(middle) > mass * 9.81 { low = middle } else { high = middle }
    }
    let number = |value: &Value| value.as_f64().unwrap();
    let close = |value: &Value, expected: f64, tolerance: f64| {
        let relative = (number(value) / expected - 1.0).abs();
        assert!(relative < tolerance, "{value} should be {expected}: {relative:e}");
    };
    // Closed forms and halving are good to rounding.
    close(&body["mass"]["mass"], mass, 1e-13);
    close(&body["mass"]["inertia_principal"][0], 0.4 * mass * radius * radius, 1e-13);
    close(&pair["initial_gap"], 0.15, 1e-12);
    let rest = &pair["rests"][0];
    close(&rest["gap"], low, 1e-11);
    // F' by differences, good to 1e-9: step² of truncation and rounding over the step.
    let step = 1e-5 * low;
    let stiffness = -(force(low + step) - force(low - step)) / (2.0 * step);
    close(&rest["stiffness"], stiffness, 1e-7);
    close(&rest["period"], std::f64::consts::TAU * (mass / stiffness).sqrt(), 1e-7);
    // Damping has the exponent of the repulsion: c = (β/α) F, and sliding decays in m/c_t, c_t = (β_f/α) F.
    let damping = 4e3 / alpha * mass * 9.81;
    close(&rest["damping_ratio"], damping / (2.0 * (mass * stiffness).sqrt()), 1e-7);
    close(&rest["friction_time"], alpha / 2e3 / 9.81, 1e-9);
    assert_eq!(pair["rests"].as_array().unwrap().len(), 1);
    let verdicts: Vec<_> =
        pair["laws"].as_array().unwrap().iter().map(|law| law["forbids_touching"].as_bool()).collect();
    assert_eq!(verdicts, [Some(true), Some(true), None]);
}

#[test]
fn check_says_so_in_words() {
    let sandbox = Sandbox::with_ball();
    let words = sandbox.done(&["check", "ball.toml", "--set", "contact.0.repulsion.nu=1.5"]).stdout;
    assert!(words.contains("ν = 1.5 < 2 (smooth point): does not forbid touching"), "{words}");
    assert!(words.contains("rests at a gap of") && !words.contains("no law forbids touching"), "{words}");
    let without = ["--set", "contact.0.repulsion.nu=1.5", "--set", "contact.0.damping.beta=0"];
    let words = sandbox.done(&[&["check", "ball.toml"][..], &without].concat()).stdout;
    assert!(words.contains("no strength") && words.contains("no law forbids touching"), "{words}");
    let words = sandbox.done(&["check", "ball.toml", "--set", "world.gravity=[0,0,1]"]).stdout;
    assert!(words.contains("no gap at which"), "{words}");
}

#[test]
fn check_shows_a_resolved_scene_that_resolves_to_itself() {
    let sandbox = Sandbox::with_ball();
    sandbox.write("ball.toml", &format!("{BALL}orientation = {{ euler_xyz = [\"30 deg\", 0, 0.1] }}\n"));
    let changed = ["check", "ball.toml", "--set", "body.ball.spring=[{ anchor = [0, 0, 1], stiffness = 3 }]"];
    for arguments in [&changed[..], &["check", "dice"]] {
        let words = sandbox.done(arguments).stdout;
        let (_, resolved) = words.split_once("# The resolved scene").unwrap();
        sandbox.write("resolved.toml", &format!("#{resolved}"));
        // Numbers are shown without the rounding of a unit, with which the scene itself has them.
        let again = sandbox.done(&["check", "resolved.toml"]).stdout;
        assert_eq!(again.split_once("# The resolved scene").unwrap().1, resolved);
        let json = sandbox.done(&[arguments, &["--json"]].concat()).stdout;
        let before: Value = serde_json::from_str(&json).unwrap();
        assert!(before["resolved"]["solver"]["atol"].is_number(), "defaults stand in it");
    }
}

#[test]
fn no_gap_of_rest_is_given_where_one_support_does_not_tell() {
    let sandbox = Sandbox::with_ball();
    let spring = "body.ball.spring=[{ anchor = [0, 0, 1], stiffness = 3 }]";
    for (key, word) in [(spring, "springs"), ("body.ball.pin=[0, 0, 0.01]", "pin")] {
        let still = ["check", "ball.toml", "--set", "body.ball.velocity=[0, 0, 0]", "--set", key];
        no_gap_of_rest(&sandbox, &still, word);
    }
    let wall = "[[support]]\nname = \"wall\"\nplane = { origin = [-1, 0, 0], normal = [1, 0, 0] }\n";
    let contact = "[[contact]]\nsupport = \"wall\"\nrepulsion = { alpha = 1e-6, nu = 6 }\n";
    sandbox.write("corner.toml", &format!("{BALL}{wall}{contact}"));
    no_gap_of_rest(&sandbox, &["check", "corner.toml"], "other supports");
    // A wall that does not push changes nothing.
    let weak = ["check", "corner.toml", "--json", "--set", "contact.1.repulsion.alpha=0"];
    let found: Value = serde_json::from_str(&sandbox.done(&weak).stdout).unwrap();
    let pair = &found["bodies"][0]["supports"][0];
    assert!(pair["no_rest_because"].is_null() && pair["rests"][0]["gap"].is_number(), "{pair}");
}

fn no_gap_of_rest(sandbox: &Sandbox, arguments: &[&str], word: &str) {
    let words = sandbox.done(arguments).stdout;
    assert!(words.contains("no gap of rest is given") && words.contains(word), "{words}");
    assert!(!words.contains("rests at") && !words.contains("no gap at which"), "{words}");
    let found = sandbox.done(&[arguments, &["--json"]].concat()).stdout;
    let found: Value = serde_json::from_str(&found).unwrap();
    for pair in found["bodies"][0]["supports"].as_array().unwrap() {
        assert_eq!(pair["rests"], Value::Array(Vec::new()));
        assert!(pair["no_rest_because"].as_str().is_some_and(|reason| reason.contains(word)), "{pair}");
    }
}

#[test]
fn adhesion_may_hold_a_body_from_below() {
    let sandbox = Sandbox::with_ball();
    let adhesion = "contact.0.adhesion={ beta = 1e5, nu_attractive = 4, nu_repulsive = 8, d0 = 0.002 }";
    let hanging = ["--set", adhesion, "--set", "contact.0.repulsion.alpha=0", "--set", "world.gravity=[0,0,9.81]"];
    let hanging = [&["check", "ball.toml", "--json"][..], &hanging].concat();
    let found: Value = serde_json::from_str(&sandbox.done(&hanging).stdout).unwrap();
    let rests = found["bodies"][0]["supports"][0]["rests"].as_array().unwrap();
    // Near the support the ball comes back, farther off it falls.
    assert_eq!(rests.iter().map(|rest| rest["stable"].as_bool().unwrap()).collect::<Vec<_>>(), [true, false]);
}

#[test]
fn modes_of_a_soft_ball_ring_as_in_the_closed_form() {
    let sandbox = Sandbox::new();
    sandbox.write("soft.toml", &soft_ball());
    let weightless = ["modes", "soft.toml", "--set", "contact=[]", "--set", "world.gravity=[0, 0, 0]"];
    let json = sandbox.done(&[&weightless[..], &["--json"]].concat()).stdout;
    let found: Value = serde_json::from_str(&json).unwrap();
    let state = &found["bodies"][0]["rest_state"];
    let modes = state["modes"].as_array().unwrap();
    assert_eq!(modes.len(), 11);
    // ω₀² = 20 (c₁ + c₂)/(ρR²), δ = 5μ/(2ρR²), ω² = ω₀² − δ²; rounding of a few hundred operations.
    let (square, decay) = (20.0 * 4000.0 / 2.5, 20.0);
    let ringing: Vec<&Value> = modes.iter().filter(|mode| mode["motion"] == "oscillates").collect();
    assert_eq!(ringing.len(), 5);
    for mode in ringing {
        let number = |key: &str| mode[key].as_f64().unwrap();
        assert!((number("frequency") / f64::sqrt(square - decay * decay) - 1.0).abs() < 1e-12);
        assert!((mode["decay_rates"][0].as_f64().unwrap() / decay - 1.0).abs() < 1e-12);
        assert!((number("frequency_hz") * std::f64::consts::TAU / number("frequency") - 1.0).abs() < 1e-14);
        assert_eq!(mode["shape"]["translation"], serde_json::json!([0.0, 0.0, 0.0]));
    }
    let words = sandbox.done(&weightless).stdout;
    assert!(words.contains("shear in the plane xy") && words.contains("Mooney–Rivlin, c1 3000 Pa"), "{words}");
    assert!(words.lines().all(|line| line.chars().count() <= 100), "{words}");
}

#[test]
fn modes_say_why_there_is_no_rest_state() {
    let sandbox = Sandbox::with_ball();
    let falling = ["modes", "ball.toml", "--set", "contact=[]"];
    let words = sandbox.done(&falling).stdout;
    assert!(words.contains("no rest state: nothing holds the body against gravity"), "{words}");
    let found: Value = serde_json::from_str(&sandbox.done(&[&falling[..], &["--json"]].concat()).stdout).unwrap();
    assert!(found["bodies"][0]["rest_state"].is_null() && found["bodies"][0]["no_rest_state_because"].is_string());
    let slope = ["modes", "ball.toml", "--set", "support.table.plane.normal=[0.1, 0, 1]"];
    assert!(sandbox.done(&slope).stdout.contains("the body slides on"));
    let found: Value = serde_json::from_str(&sandbox.done(&["modes", "ball.toml", "--json"]).stdout).unwrap();
    assert_eq!(found["bodies"][0]["rest_state"]["modes"].as_array().unwrap().len(), 6);
}

#[test]
fn check_tells_the_rest_state_of_a_body_that_deforms() {
    let sandbox = Sandbox::new();
    sandbox.write("soft.toml", &soft_ball());
    let found: Value = serde_json::from_str(&sandbox.done(&["check", "soft.toml", "--json"]).stdout).unwrap();
    let body = &found["bodies"][0];
    assert_eq!((&body["kind"]["kind"], &body["kind"]["incompressible"]), (&"affine".into(), &true.into()));
    let rest = &body["rest_state"];
    let stretch = |k: usize| rest["stretches"][k].as_f64().unwrap();
    // Flattened by its weight, its volume kept.
    assert!(stretch(0) > 1.001 && stretch(2) < 0.999 && (stretch(0) * stretch(1) * stretch(2) - 1.0).abs() < 1e-13);
    assert!(rest["pressure"].as_f64().unwrap() > 0.0 && rest["gap"].as_f64().unwrap() > 0.0);
    let words = sandbox.done(&["check", "soft.toml"]).stdout;
    for part in
        ["affine, incompressible: Mooney–Rivlin", "viscosity 20 Pa s", "if it kept the shape", "stretches", "Hz"]
    {
        assert!(words.contains(part), "{part}: {words}");
    }
    let rigid: Value = serde_json::from_str(&sandbox.done(&["check", "dice", "--json"]).stdout).unwrap();
    assert!(rigid["bodies"][0]["rest_state"].is_null() && rigid["bodies"][0]["kind"]["kind"] == "rigid");
}

/// A pipe into which somebody writes as soon as somebody reads, so that a program which opens it does not wait for
/// ever.
#[cfg(unix)]
fn pipe(path: &std::path::Path) {
    assert!(std::process::Command::new("mkfifo").arg(path).status().unwrap().success());
    let path = path.to_owned();
    std::thread::spawn(move || std::fs::File::create(path));
}

#[cfg(unix)]
#[test]
fn a_pipe_where_a_file_is_expected_is_refused_before_it_is_opened() {
    let sandbox = Sandbox::with_ball();
    sandbox.done(&["run", "ball.toml", "--quiet", "--set", "time.end=0.05"]);
    for name in ["pipe.toml", "pipe.stl", "pipe.csv"] {
        pipe(&sandbox.path(name));
    }
    let sphere = "sphere = { radius = \"5 cm\" }";
    sandbox.write("mesh.toml", &BALL.replace(sphere, "mesh = { file = \"pipe.stl\" }"));
    sandbox.write("study.toml", "scene = \"pipe.toml\"\n[parameter.x]\nkey = \"time.end\"\nvalues = [1]\n");
    let fit = "scene = \"ball.toml\"\nfit.nu = { key = \"contact.0.repulsion.nu\", start = 5 }\n";
    sandbox.write("fit.toml", &format!("{fit}[[gap]]\ntable = \"pipe.csv\"\nkey = \"body.ball.density\"\n"));
    let refused = |arguments: &[&str], file: &str| {
        let said = sandbox.run(arguments);
        assert!([Some(2), Some(3)].contains(&said.code), "{arguments:?}: {}", said.stderr);
        for words in [file, "it is a pipe, a device or a socket, not a file: save what it gives in a file"] {
            assert!(said.stderr.contains(words), "{arguments:?} says not {words}: {}", said.stderr);
        }
    };
    for command in ["check", "run", "modes"] {
        refused(&[command, "pipe.toml"], "pipe.toml");
    }
    refused(&["check", "mesh.toml"], "pipe.stl");
    if cfg!(feature = "study") {
        refused(&["study", "pipe.toml"], "pipe.toml");
        refused(&["study", "study.toml"], "pipe.toml");
        refused(&["calibrate", "fit.toml"], "pipe.csv");
    }
    let chunk = "ball.gyr/position/c.0.0.0";
    std::fs::remove_file(sandbox.path(chunk)).unwrap();
    pipe(&sandbox.path(chunk));
    refused(&["export", "ball.gyr", "--format", "csv", "-o", "-"], chunk);
    std::fs::remove_file(sandbox.path("ball.gyr/zarr.json")).unwrap();
    pipe(&sandbox.path("ball.gyr/zarr.json"));
    refused(&["plot", "ball.gyr"], "ball.gyr/zarr.json");
    let said = sandbox.run(&["check", "."]);
    assert!(said.code == Some(3) && said.stderr.contains("a folder, not a file: name a file in it"), "{}", said.stderr);
}

#[test]
fn a_recording_may_be_named_with_a_slash_at_its_end() {
    let sandbox = Sandbox::with_ball();
    let run = ["run", "ball.toml", "--quiet", "--set", "time.end=0.05", "-o", "out.gyr/"];
    sandbox.done(&run);
    assert_eq!(sandbox.names(), ["ball.toml", "out.gyr"]);
    sandbox.refused(2, &run);
    sandbox.done(&[&run[..], &["--resume"]].concat());
    sandbox.done(&[&run[..], &["--force"]].concat());
    assert_eq!(sandbox.names(), ["ball.toml", "out.gyr"]);
}

#[test]
fn a_title_tells_a_terminal_nothing_but_letters() {
    let sandbox = Sandbox::with_ball();
    let title = "\u{1b}]0;owned\u{7}\u{9b}2J käse";
    sandbox.write("ball.toml", &soft_ball().replace("A ball on a table", r"\u001b]0;owned\u0007\u009b2J käse"));
    let run = ["run", "ball.toml", "--set", "time.end=0.02", "-o", "ball.gyr"];
    for arguments in [&["check", "ball.toml"][..], &["check", "ball.toml", "--json"], &["modes", "ball.toml"], &run] {
        let said = sandbox.done(arguments);
        let printed = format!("{}{}", said.stdout, said.stderr);
        assert!(printed.contains(r"\u001b]0;owned\u0007\u009b2J käse"), "{arguments:?}: {printed:?}");
        assert!(!printed.contains(|c: char| c.is_control() && c != '\n'), "{arguments:?}: {printed:?}");
    }
    let json: Value = serde_json::from_str(&sandbox.done(&["check", "ball.toml", "--json"]).stdout).unwrap();
    assert_eq!(json["resolved"]["title"], title);
    let svg = sandbox.done(&["plot", "ball.gyr", "gap", "-o", "-"]).stdout;
    assert!(svg.starts_with("<svg") && !svg.contains('\u{1b}') && !svg.contains('\u{9b}'), "{svg}");
    sandbox.write("named.toml", &BALL.replace("\"ball\"", r#""\u001b[2J""#));
    let said = sandbox.refused(2, &["check", "named.toml"]);
    assert!(said.stderr.contains("is not a name") && !said.stderr.contains('\u{1b}'), "{:?}", said.stderr);
}

#[test]
fn a_machine_is_measured_row_by_row() {
    let sandbox = Sandbox::new();
    let said = sandbox.done(&["bench", "--quick", "--json", "--plot", "floors.svg"]).stdout;
    let found: serde_json::Value = serde_json::from_str(&said).unwrap();
    let rows = found["rows"].as_array().unwrap();
    let key = |row: &serde_json::Value| row["key"].as_str().unwrap().to_owned();
    let keys: Vec<String> = rows.iter().map(key).collect();
    for wanted in ["rates/box", "jacobian/box", "pair/boxes", "throw", "cube/rigid", "cube/affine", "free-cube"] {
        assert!(keys.contains(&wanted.to_owned()), "{wanted}: {keys:?}");
    }
    for row in rows {
        assert!(row["seconds"].as_f64().unwrap() > 0.0, "{row}");
    }
    assert!(found["machine"]["arithmetic"]["operations"].as_f64().unwrap() > 1e6);
    assert!(std::fs::read_to_string(sandbox.path("floors.svg")).unwrap().contains("times its floor"));
}
