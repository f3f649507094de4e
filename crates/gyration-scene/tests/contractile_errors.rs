//! What can be wrong with a contractile body, each at its exact place (`§`), with the fix.

use crate::common::{BALL, Row, TABLE, TIME, assert_error, errors};
use gyration_scene::Scene;
use std::path::Path;

const RUBBER: &str = "material = { neo_hookean = { shear = 10 } }";
const ZERO: &str = "[[0, 0, 0], [0, 0, 0], [0, 0, 0]]";
const ONE: &str = "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]";

/// A row's line in the place of a key of a driven ball, `Z` being a zero matrix and `I` the unit matrix.
fn driven(line: &str) -> String {
    let line = line.replace("ZERO", ZERO).replace("ONE", ONE);
    format!("{TIME}{BALL}contractile = {{ contraction_viscosity = 1, {line} }}\n")
}

fn prescribed(line: &str) -> String {
    let line = line.replace("ZERO", ZERO).replace("ONE", ONE);
    format!("{TIME}{BALL}contractile = {{ {line} }}\n")
}

#[test]
fn errors_of_a_contraction_stand_at_their_place() {
    let rows: &[Row] = &[
        ("contractile = §{}", "contraction_viscosity", "\"contraction_viscosity\" is missing", "greater than 0"),
        (
            "contractile = { contraction_viscosity = §0 }",
            "contraction_viscosity",
            "greater than 0 Pa s",
            "greater than 0",
        ),
        (
            "contractile = { contraction_viscosity = §-3 }",
            "contraction_viscosity",
            "greater than 0 Pa s",
            "greater than 0",
        ),
        ("contractile = { contraction_viscosity = §\"3 Pa\" }", "contraction_viscosity", "expected Pa s", "mPa s"),
        (
            "contractile = { contraction_viscosity = 1, §contraction_rate = ZERO }",
            "contraction_rate",
            "unknown key",
            "did you mean",
        ),
        ("contractile = { contraction_viscosity = 1, §viscosty = 3 }", "viscosty", "unknown key", "`viscosity`"),
        ("contractile = { contraction_viscosity = 1, viscosity = §-1 }", "viscosity", "at least 0 Pa s", ""),
        (
            "contractile = { contraction_viscosity = 1, contraction = §[[1, 0, 0], [0, 1, 0], [0, 0, -1]] }",
            "contraction",
            "determinant is -1.0: the body would be turned inside out",
            "positive determinant",
        ),
        (
            "contractile = { contraction_viscosity = 1, contraction = §ZERO }",
            "contraction",
            "pressed flat",
            "positive determinant",
        ),
        ("contractile = { contraction_viscosity = 1, contraction = §[1] }", "contraction", "", ""),
        ("contractile = { contraction_viscosity = 1, isochoric = §1 }", "isochoric", "expected true or false", "true"),
        ("contractile = { contraction_viscosity = 1, isochoric = §\"yes\" }", "isochoric", "found a string", "true"),
        (
            "contractile = { contraction_viscosity = 1, spin = §\"symetric\" }",
            "spin",
            "not known",
            "did you mean `symmetric`?",
        ),
        ("contractile = §3", "", "expected a table", "contraction_viscosity"),
    ];
    for (line, key, message, help) in rows {
        let text = format!("{TIME}{BALL}{line}\n").replace("ZERO", ZERO);
        if line.ends_with("§[1] }") {
            let found = errors("scene.toml", &text.replace('§', ""), &[]).to_string();
            assert!(found.contains("expected 3 items, found 1"), "{found}");
            continue;
        }
        let dot = if key.is_empty() { "" } else { "." };
        assert_error(&text, &format!("body.ball.contractile{dot}{key}"), message, help);
    }
}

#[test]
fn errors_of_drives_stand_at_their_place() {
    let rows: &[Row] = &[
        ("drive = §3", "drive", "found a number", "one key of constant, ramp, sine, square, sum, table"),
        ("drive = §{}", "drive", "exactly one key, found 0", "constant"),
        ("drive = { §sin = { amplitude = ZERO, frequency = 1 } }", "drive.sin", "unknown key", "did you mean `sine`?"),
        ("drive = { constant = §{} }", "drive.constant.value", "missing", "value"),
        (
            "drive = { constant = { value = §[[1, 0, 0], [0, 1, 0]] } }",
            "drive.constant.value",
            "3 items, found 2",
            "3 items",
        ),
        (
            "drive = { constant = { value = [[1, 0, 0], §[0, 1], [0, 0, 1]] } }",
            "drive.constant.value.1",
            "3 items, found 2",
            "3 items",
        ),
        (
            "drive = { constant = { value = [[1, 0, 0], [0, §inf, 0], [0, 0, 1]] } }",
            "drive.constant.value.1.1",
            "must be finite",
            "finite",
        ),
        (
            "drive = { constant = { value = [[1, 0, 0], [0, §\"3 m\", 0], [0, 0, 1]] } }",
            "drive.constant.value.1.1",
            "is in m, expected Pa",
            "30 kPa",
        ),
        (
            "drive = §{ constant = { value = [[1e200, 0, 0], [0, 0, 0], [0, 0, 1]] } }",
            "drive",
            "at t = 0 s it leaves the range of numbers",
            "smaller",
        ),
        ("drive = { sine = §{ amplitude = ZERO } }", "drive.sine.frequency", "missing", "Hz"),
        (
            "drive = { sine = { amplitude = ZERO, frequency = §-1 } }",
            "drive.sine.frequency",
            "at least 0 Hz",
            "at least 0",
        ),
        (
            "drive = { square = { amplitude = ZERO, frequency = 1, phase = §\"1 s\" } }",
            "drive.square.phase",
            "expected rad",
            "deg",
        ),
        ("drive = { ramp = { to = ZERO, duration = §0 } }", "drive.ramp.duration", "greater than 0 s", ""),
        ("drive = { ramp = §{ duration = 1 } }", "drive.ramp.to", "missing", "rows"),
        ("drive = { table = { file = §\"none.csv\" } }", "drive.table.file", "none.csv", "relative to the folder"),
        (
            "drive = { table = { file = \"none.csv\", interpolation = §\"spline\" } }",
            "drive.table.interpolation",
            "not known",
            "linear",
        ),
        ("drive = { sum = §[] }", "drive.sum", "at least 1 items, found 0", ""),
        (
            "drive = { sum = [{ constant = { value = ZERO } }, { ramp = { to = ZERO, duration = §-1 } }] }",
            "drive.sum.1.ramp.duration",
            "greater than 0 s",
            "",
        ),
    ];
    for (line, key, message, help) in rows {
        assert_error(&driven(line), &format!("body.ball.contractile.{key}"), message, help);
    }
}

#[test]
fn errors_of_feedback_stand_at_their_place() {
    let rows: &[Row] = &[
        ("feedback = §3", "feedback", "found a number", "a table { measure = …, gain = … }, or an array of such"),
        ("feedback = §{ measure = { stretch = [1, 0, 0] } }", "feedback.gain", "missing", "Pa per unit"),
        (
            "feedback = [{ measure = { stretch = [1, 0, 0] }, gain = ONE }, §{ gain = ONE }]",
            "feedback.1.measure",
            "missing",
            "What the body feels",
        ),
        ("feedback = { measure = §\"gap\", gain = ONE }", "feedback.measure", "there is no support", "[[support]]"),
        ("feedback = { measure = §\"gasp\", gain = ONE }", "feedback.measure", "not known here", "did you mean `gap`?"),
        (
            "feedback = { measure = §\"stretch\", gain = ONE }",
            "feedback.measure",
            "found a string",
            "write { stretch = { … } }",
        ),
        (
            "feedback = { measure = §7, gain = ONE }",
            "feedback.measure",
            "expected one of \"support_gap\", \"gap\" or a table with one key of rate, stretch",
            "",
        ),
        (
            "feedback = { measure = { §strech = [1, 0, 0] }, gain = ONE }",
            "feedback.measure.strech",
            "unknown key",
            "`stretch`",
        ),
        (
            "feedback = [{ measure = { rate = §[0, 0, 0] }, gain = ONE }]",
            "feedback.0.measure.rate",
            "the direction is zero",
            "[0, 0, 1]",
        ),
        (
            "feedback = { measure = { stretch = §[0, 0, 0] }, gain = ONE }",
            "feedback.measure.stretch",
            "the direction is zero",
            "[0, 0, 1]",
        ),
        (
            "feedback = { measure = { stretch = [1, 0, 0] }, gain = [[1, 0, 0], [0, §inf, 0], [0, 0, 1]] }",
            "feedback.gain.1.1",
            "must be finite",
            "",
        ),
        (
            "feedback = { measure = { stretch = [1, 0, 0] }, gain = ONE, bias = [[0, 0, 0], [0, §nan, 0], [0, 0, 0]] }",
            "feedback.bias.1.1",
            "must be a number",
            "",
        ),
        (
            "feedback = { measure = { stretch = [1, 0, 0] }, gain = ONE, limits = §[1, 1] }",
            "feedback.limits",
            "1 and 1, do not increase",
            "[least, most]",
        ),
        (
            "feedback = { measure = { stretch = [1, 0, 0] }, gain = §[[1e300, 0, 0], [0, 0, 0], [0, 0, 0]], limits = \
                [0, 1e9] }",
            "feedback.gain",
            "leaves the range of numbers at a limit",
            "smaller",
        ),
    ];
    for (line, key, message, help) in rows {
        assert_error(&driven(line), &format!("body.ball.contractile.{key}"), message, help);
    }
}

#[test]
fn errors_of_a_prescribed_contraction_stand_at_their_place() {
    let rows: &[Row] = &[
        (
            "prescribed = §{ sine = { amplitude = ONE, frequency = 1 } }",
            "prescribed",
            "at t = 0 s its determinant is 0.0: the body would be pressed flat",
            "{ sum = [{ constant = { value = [[1, 0, 0], [0, 1, 0], [0, 0, 1]] } }, …] }",
        ),
        // 1 + 1.5 sin(2πt) falls below zero at t = 0.616.
        (
            "prescribed = §{ sum = [{ constant = { value = ONE } }, { sine = { amplitude = [[1.5, 0, 0], [0, 0, 0], [0, 0, 0]], frequency = 1 } }] }",
            "prescribed",
            "at t = 0.625 s its determinant is -0.06",
            "keep det G > 0 over the whole run",
        ),
        (
            "prescribed = §{ ramp = { to = [[-1, 0, 0], [0, 1, 0], [0, 0, 1]], duration = 0.5 } }",
            "prescribed",
            "at t = 0.25 s its determinant is 0.0",
            "det G > 0",
        ),
        (
            "prescribed = §{ sum = [{ constant = { value = ONE } }, { square = { amplitude = ZERO, frequency = 1 } }] \
                }",
            "prescribed",
            "jumps with a square wave",
            "use a sine, a ramp or a table",
        ),
        (
            "prescribed = { sum = [{ constant = { value = ONE } }, { ramp = §{ to = ONE, duration = 1 } }] }",
            "prescribed.sum.1.ramp.from",
            "open where the ramp starts",
            "add `from`",
        ),
        (
            "prescribed = { constant = { value = [[1, 0, 0], [0, §\"1 Pa\", 0], [0, 0, 1]] } }",
            "prescribed.constant.value.1.1",
            "found a string",
            "pure number",
        ),
        (
            "prescribed = §{ ramp = { to = ONE, duration = 1 } }, material = { neo_hookean = { shear = 10 } }",
            "prescribed",
            "its rate jumps, and the volume of an incompressible body",
            "interpolation = \"cubic\"",
        ),
        (
            "prescribed = { constant = { value = ONE } }, drive = §{ constant = { value = ZERO } }",
            "drive",
            "`prescribed` stands beside it: Q is then what it takes",
            "keep one of `drive` and `prescribed`",
        ),
        (
            "prescribed = { constant = { value = ONE } }, feedback = §{ measure = { stretch = [1, 0, 0] }, gain = ONE \
                }",
            "feedback",
            "`prescribed` stands beside it",
            "keep one",
        ),
        (
            "prescribed = { constant = { value = ONE } }, contraction = §ONE",
            "contraction",
            "it says where G starts",
            "keep one of `contraction` and `prescribed`",
        ),
        ("prescribed = { constant = { value = ONE } }, isochoric = §true", "isochoric", "stands beside it", "keep one"),
        ("prescribed = { constant = { value = ONE } }, spin = §\"full\"", "spin", "stands beside it", "keep one"),
    ];
    for (line, key, message, help) in rows {
        assert_error(&prescribed(line), &format!("body.ball.contractile.{key}"), message, help);
    }
    let compressible = prescribed(
        "prescribed = { ramp = { to = ONE, duration = 1 } }, material = { neo_hookean = { shear = 10, bulk = 1 } }",
    );
    assert!(Scene::parse("a.toml", &compressible, Path::new(""), &[]).is_ok(), "a compressible body takes a kink");
}

#[test]
fn errors_of_kinds_and_starts_of_contractile_bodies_stand_at_their_place() {
    let ready = "contractile = { contraction_viscosity = 1, material = { neo_hookean = { shear = 10 } }";
    let rows: &[(String, &str, &str, &str)] = &[
        ("rigid = {}\ncontractile = §{ contraction_viscosity = 1 }".into(), "contractile", "also `rigid`", "keep one"),
        (
            "affine = {}\ncontractile = §{ contraction_viscosity = 1 }".into(),
            "contractile",
            "the body is also `affine`",
            "keep one of `affine` and `contractile`",
        ),
        (
            format!("{ready}, contraction = [[2, 0, 0], [0, 1, 0], [0, 0, 1]] }}\ngradient = §{ONE}"),
            "gradient",
            "det P/det G is 0.5, which an incompressible body keeps at 1",
            "or give the material a `bulk`",
        ),
        (
            format!("{ready}, isochoric = true }}\ngradient_rate = §{ONE}"),
            "gradient_rate",
            "its volume would change at tr L = 3.0 1/s",
            "write gradient_rate = [[0.0, 0.0, 0.0],",
        ),
        (
            format!(
                "contractile = {{ {RUBBER}, prescribed = {{ sum = [{{ constant = {{ value = {ONE} }} }}, \
                 {{ sine = {{ amplitude = {ONE}, frequency = 0.5 }} }}] }} }}\ngradient_rate = §{ZERO}"
            ),
            "gradient_rate",
            "the contraction of the incompressible body",
            "write gradient_rate = [[3.14159265358979",
        ),
        (
            "contractile = { contraction_viscosity = 1 }\ngradient = §[[1, 0, 0], [0, 1, 0], [0, 0, -1]]".into(),
            "gradient",
            "turned inside out",
            "positive determinant",
        ),
        (
            "contractile = { contraction_viscosity = 1 }\ngradient_rate = [[0, 0, 0], [0, 0, 0], [0, 0, \
                0]]\nangular_velocity = §[0, 0, 1]"
                .into(),
            "angular_velocity",
            "`gradient_rate` already says",
            "leave `angular_velocity` out",
        ),
    ];
    for (lines, key, message, help) in rows {
        // An isotropic contraction of 1 + sin falls to zero only in the second half of its period.
        assert_error(&format!("{TIME}{BALL}{lines}\n"), &format!("body.ball.{key}"), message, help);
    }
}

#[test]
fn a_body_without_volume_or_surface_cannot_contract_or_feel() {
    let tensor = "mass_properties = { mass = 1, euler_tensor = [[1, 0, 0], [0, 1, 0], [0, 0, 1]] }";
    let points = "shape = { points = [{ mass = 1, at = [1, 0, 0] }, { mass = 1, at = [0, 1, 0] }, { mass = 1, at = [0, 0, 1] }, { mass = 1, at = [0, 0, 0] }] }";
    for shape in [tensor, points] {
        let text = format!("{TIME}[[body]]\nname = \"b\"\n{shape}\ncontractile = §{{ contraction_viscosity = 1 }}\n");
        assert_error(&text, "body.b.contractile", "no volume", "make it `affine`");
        let feels = format!(
            "{TIME}{TABLE}[[body]]\nname = \"b\"\n{shape}\n\
             contractile = {{ contraction_viscosity = 1, feedback = [{{ measure = \"gap\", gain = {ONE} }}] }}\n"
        );
        let found = errors("scene.toml", &feels, &[]);
        let keys: Vec<&str> = found.into_iter().map(|error| error.key.as_str()).collect();
        assert_eq!(keys, ["body.b.contractile", "body.b.contractile.feedback.0.measure"], "{found}");
        assert!(found.to_string().contains("no surface that could be near a support"), "{found}");
    }
}

#[test]
fn errors_of_a_contraction_show_beside_those_of_other_keys() {
    let text = format!(
        "{TIME}{BALL}velocity = [1, 2]\ncontractile = {{ contraction = {ZERO}, drive = {{ table = {{ file = \"x.csv\" }} }} }}\n"
    );
    let found = errors("scene.toml", &text, &[]);
    let mut keys: Vec<&str> = found.into_iter().map(|error| error.key.as_str()).collect();
    keys.sort_unstable();
    let expected = ["contraction", "contraction_viscosity", "drive.table.file"];
    let expected: Vec<String> = expected.iter().map(|key| format!("body.ball.contractile.{key}")).collect();
    assert_eq!(keys[..3], expected, "{found}");
    assert_eq!(keys[3..], ["body.ball.velocity"], "{found}");
}
