//! What can be wrong with a deformable body, each at its exact place (`§`), with the fix.

use crate::common::{BALL, Row, TABLE, TIME, assert_error, errors};
use gyration_scene::Scene;
use std::fs;

const FREE: &str = "affine = {}";
const RUBBER: &str = "affine = { material = { neo_hookean = { shear = 10 } } }";

/// A diagonal matrix as a scene has it, with one more entry.
fn matrix(diagonal: &[f64], entry: (usize, usize, f64)) -> String {
    let number = |row: usize, column: usize| match () {
        () if (row, column) == (entry.0, entry.1) => entry.2,
        () if row == column => diagonal[row],
        () => 0.0,
    };
    let row = |row: usize| {
        let numbers: Vec<String> = (0..diagonal.len()).map(|column| format!("{:?}", number(row, column))).collect();
        format!("[{}]", numbers.join(", "))
    };
    format!("[{}]", (0..diagonal.len()).map(row).collect::<Vec<_>>().join(", "))
}

#[test]
fn errors_of_materials_stand_at_their_place() {
    let rows: &[Row] = &[
        ("mooney_rivlin = { c1 = §-1, c2 = 1 }", "mooney_rivlin.c1", "must be at least 0 Pa", "at least 0"),
        ("mooney_rivlin = { c1 = 1, c2 = 1, bulk = §0 }", "mooney_rivlin.bulk", "greater than 0 Pa", ""),
        ("mooney_rivlin = §{ c1 = 1 }", "mooney_rivlin.c2", "missing", "c2"),
        ("mooney_rivlin = { c1 = §\"1 kg\", c2 = 1 }", "mooney_rivlin.c1", "is in kg, expected Pa", "30 kPa"),
        ("neo_hookean = { shear = 1, §bluk = 3 }", "neo_hookean.bluk", "unknown key", "did you mean `bulk`?"),
        ("§neo_hokean = { shear = 1 }", "neo_hokean", "unknown key", "did you mean `neo_hookean`?"),
        ("fung = { shear = 1, exponent = §0 }", "fung.exponent", "greater than 0", ""),
        ("neo_hookean_log = { mu = 1, lambda = §-0.1 }", "neo_hookean_log.lambda", "at least 0 Pa", ""),
        (
            "st_venant_kirchhoff = { mu = 3, lambda = §-2.1 }",
            "st_venant_kirchhoff.lambda",
            "`lambda` is -2.1: it must be finite and ≥ −2/3 mu",
            "≥ −2/3 mu",
        ),
        ("hencky = { shear = 1, bulk = §-1 }", "hencky.bulk", "at least 0 Pa", ""),
        (
            "hencky = §{ shear = 1 }",
            "hencky.bulk",
            "the key \"bulk\" is missing",
            "`youngs_modulus` and `poissons_ratio`",
        ),
        ("hencky = { §young = 1, poissons_ratio = 0.2 }", "hencky.young", "unknown key", "`youngs_modulus`"),
        (
            "hencky = { youngs_modulus = §1 }",
            "hencky.youngs_modulus",
            "`youngs_modulus` is given without `poissons_ratio`",
            "add `poissons_ratio`",
        ),
        (
            "neo_hookean_log = { youngs_modulus = 1, poissons_ratio = §0.5 }",
            "neo_hookean_log.poissons_ratio",
            "Poisson's ratio is 0.5",
            "from 0 and below 0.5",
        ),
        (
            "neo_hookean = { youngs_modulus = 1, poissons_ratio = §0.6 }",
            "neo_hookean.poissons_ratio",
            "Poisson's ratio is 0.6",
            "at most 0.5",
        ),
        (
            "neo_hookean = { shear = §2, youngs_modulus = 1, poissons_ratio = 0.4 }",
            "neo_hookean.shear",
            "`shear` is given beside `youngs_modulus`",
            "keep one",
        ),
        (
            "neo_hookean_log = { youngs_modulus = 1, poissons_ratio = §-0.1 }",
            "neo_hookean_log.poissons_ratio",
            "Poisson's ratio is -0.1",
            "from 0 and below 0.5",
        ),
        ("orthogonality = { kappa = §-1 }", "orthogonality.kappa", "at least 0 Pa", ""),
        ("orthogonality = §{ kappa = 1e308 }", "orthogonality", "must be finite", ""),
        ("ogden = { mu = §1, alpha = 2 }", "ogden.mu", "expected an array", "array of items"),
        ("ogden = { mu = §[], alpha = [2] }", "ogden.mu", "at least 1 items", ""),
        (
            "ogden = { mu = [1, 2], alpha = §[2] }",
            "ogden.alpha",
            "1 exponents for 2 moduli",
            "one `alpha` for each `mu`",
        ),
        ("ogden = { mu = [1, 2], alpha = [2, §0] }", "ogden.alpha.1", "exponent is 0", "leave the term out"),
        ("ogden = { mu = [1, §2], alpha = [2, -2] }", "ogden.mu.1", "unstable", "the same sign"),
    ];
    for (material, key, message, help) in rows {
        // The arrays and numbers of a wrong kind come twice for the two keys of Ogden's lists; each row has one mark.
        let material = material.replace("alpha = 2 }", "alpha = [2] }");
        let text = format!("{TIME}{BALL}affine = {{ material = {{ {material} }} }}\n");
        assert_error(&text, &format!("body.ball.affine.material.{key}"), message, help);
    }
}

#[test]
fn errors_of_friction_and_couples_stand_at_their_place() {
    let ones = [1.0; 12];
    let lopsided = matrix(&ones, (0, 5, 0.5));
    let negative = matrix(&ones, (7, 7, -0.25));
    let skew = matrix(&[0.0; 12], (3, 3, 1.0));
    let small = matrix(&ones[..6], (2, 2, -3.0));
    let rows: &[(String, &str, &str, &str)] = &[
        ("viscosity = §-1".into(), "viscosity", "at least 0 Pa s", ""),
        ("viscosity = §\"3 Pa\"".into(), "viscosity", "expected Pa s", "20 mPa s"),
        ("internal_friction = { shear = §-1 }".into(), "internal_friction.shear", "at least 0 Pa s", ""),
        (
            format!("internal_friction = {{ shear = 1, matrix = §{} }}", matrix(&ones[..6], (0, 0, 1.0))),
            "internal_friction.matrix",
            "stand beside it",
            "keep one",
        ),
        (
            format!("internal_friction = {{ matrix = §{small} }}"),
            "internal_friction.matrix",
            "negative eigenvalue -3",
            "at least 0",
        ),
        (
            "internal_friction = { matrix = §[[1, 0], [0, 1]] }".into(),
            "internal_friction.matrix",
            "expected 6 items",
            "6",
        ),
        (
            format!("linear_friction = {{ matrix = §{lopsided} }}"),
            "linear_friction.matrix",
            "not symmetric: entry (0, 5) is 0.5 and (5, 0) is 0",
            "`gyroscopic`",
        ),
        (
            format!("linear_friction = {{ matrix = §{negative} }}"),
            "linear_friction.matrix",
            "negative eigenvalue -0.25",
            "at least 0",
        ),
        (
            format!("linear_friction = {{ matrix = {}, frame = §\"bdy\" }}", matrix(&ones, (0, 0, 1.0))),
            "linear_friction.frame",
            "not known",
            "`body`",
        ),
        (format!("gyroscopic = {{ matrix = §{skew} }}"), "gyroscopic.matrix", "not skew", "`linear_friction`"),
        (
            "couple = { value = [[0, 0, 0], [0, §\"1 N\", 0], [0, 0, 0]] }".into(),
            "couple.value.1.1",
            "is in kg m s^-2, expected N m",
            "N m",
        ),
        (
            "couple = { table = §\"none.csv\" }".into(),
            "couple.table",
            "none.csv",
            "relative to the folder of the scene",
        ),
        ("couple = §{}".into(), "couple", "exactly one key", "table, value"),
    ];
    for (line, key, message, help) in rows {
        // Of the items of a matrix that is too small each is.
        if line.contains("[[1, 0], [0, 1]]") {
            let found = errors("scene.toml", &format!("{TIME}{BALL}affine = {{ {} }}\n", line.replace('§', "")), &[]);
            assert!(found.to_string().contains(message), "{found}");
            continue;
        }
        assert_error(
            &format!("{TIME}{BALL}affine = {{ {line} }}\n"),
            &format!("body.ball.affine.{key}"),
            message,
            help,
        );
    }
}

#[test]
fn errors_of_kinds_and_starts_stand_at_their_place() {
    let rows: &[(String, &str, &str, &str)] = &[
        ("rigid = {}\naffine = §{}".into(), "affine", "also `rigid`", "keep one"),
        (
            format!("{FREE}\ngradient = §[[1, 0, 0], [0, 1, 0], [0, 0, -1]]"),
            "gradient",
            "determinant is -1.0: the body would be turned inside out",
            "positive determinant",
        ),
        (
            format!("{FREE}\ngradient = §[[1, 0, 0], [0, 1, 0], [0, 0, 0]]"),
            "gradient",
            "pressed flat",
            "positive determinant",
        ),
        (
            format!("{FREE}\ngradient = §[[1, 1, 1], [1, 1, 1.0000000000000002], [1, 1.0000000000000002, 3]]"),
            "gradient",
            "",
            "positive determinant",
        ),
        (format!("{FREE}\ngradient = §[[1, 0], [0, 1]]"), "gradient", "expected 3 items", ""),
        (
            format!("{FREE}\ngradient_rate = [[§\"1 m\", 0, 0], [0, 1, 0], [0, 0, 0]]"),
            "gradient_rate.0.0",
            "is in m,",
            "1/s",
        ),
        (
            format!("{FREE}\ngradient_rate = §[[1e200, 0, 0], [0, 1, 0], [0, 0, 0]]"),
            "gradient_rate",
            "range of numbers",
            "smaller",
        ),
        (
            format!(
                "{FREE}\ngradient = [[1, 0, 0], [0, 1, 0], [0, 0, 2]]\norientation = §{{ quaternion = [1, 0, 0, 0] }}"
            ),
            "orientation",
            "`gradient` already says",
            "leave `orientation` out",
        ),
        (
            format!("{FREE}\ngradient_rate = [[0, 0, 0], [0, 0, 0], [0, 0, 0]]\nangular_velocity = §[0, 0, 1]"),
            "angular_velocity",
            "`gradient_rate` already says",
            "leave `angular_velocity` out",
        ),
        (
            format!("{RUBBER}\ngradient = §[[2, 0, 0], [0, 2, 0], [0, 0, 2]]"),
            "gradient",
            "its determinant is 8.0",
            "write gradient = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], or give the material a `bulk`",
        ),
        (
            format!("{RUBBER}\ngradient_rate = §[[0, 1, 0], [0, 0, 0], [0, 0, 3]]"),
            "gradient_rate",
            "tr L = 3.0 1/s",
            "write gradient_rate = [[-1.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 2.0]]",
        ),
        (
            format!(
                "{RUBBER}\npin = [0, 0, 0.5]\ngradient_rate = [[1, 0, 0], [0, 1, 0], [0, 0, -2]]\nvelocity = §[0, 0, 0]"
            ),
            "velocity",
            "the centre of mass moves at [-0e0, -0e0, 1e0]",
            "leave `velocity` out: it follows from `gradient_rate`",
        ),
        ("pin = §[0, 0, 2001]".into(), "pin", "2001 m from the centre of mass of a body of 0.2 m", "within 2000 m"),
        (format!("{FREE}\npin = §[0, 0, 2001]"), "pin", "2001 m from", "within 2000 m"),
        (
            format!(
                "{FREE}\ngradient = [[1, 0, 0], [0, 1, 0], [0, 0, 2]]\nspring = [{{ point = [0, 0, 0.05], anchor = §[0, 0, 1.1], stiffness = 1, rest_length = 1 }}]"
            ),
            "spring.0.anchor",
            "no length",
            "move the anchor",
        ),
    ];
    for (lines, key, message, help) in rows {
        if lines.contains("[[1, 0], [0, 1]]") {
            let found = errors("scene.toml", &format!("{TIME}{BALL}{}\n", lines.replace('§', "")), &[]);
            assert!(found.to_string().contains(message), "{found}");
            continue;
        }
        assert_error(&format!("{TIME}{BALL}{lines}\n"), &format!("body.ball.{key}"), message, help);
    }
}

#[test]
fn bodies_without_volume_or_in_a_plane_are_refused_where_it_matters() {
    let body = |lines: &str| format!("{TIME}[[body]]\nname = \"b\"\n{lines}\n");
    let tensor = "mass_properties = { mass = 1, euler_tensor = [[1, 0, 0], [0, 1, 0], [0, 0, 1]] }";
    let points = "shape = { points = [{ mass = 1, at = [1, 0, 0] }, { mass = 1, at = [0, 1, 0] }, { mass = 1, at = [0, 0, 1] }, { mass = 1, at = [0, 0, 0] }] }";
    for shape in [tensor, points] {
        for (line, key) in [
            ("material = §{ hencky = { shear = 1, bulk = 1 } }", "material"),
            ("viscosity = §1", "viscosity"),
            ("internal_friction = §{ bulk = 1 }", "internal_friction"),
        ] {
            let text = body(&format!("{shape}\naffine = {{ {line} }}"));
            assert_error(&text, &format!("body.b.affine.{key}"), "no volume", "a `shape` with a volume");
        }
        let free = body(&format!("{shape}\naffine = {{}}"));
        assert!(Scene::parse("a.toml", &free, "".as_ref(), &[]).is_ok(), "{free}");
    }
    let sheet = "shape = §{ points = [{ mass = 1, at = [1, 0, 0] }, { mass = 1, at = [0, 1, 0] }, { mass = 1, at = [0, 0, 0] }] }";
    assert_error(&body(&format!("{sheet}\naffine = {{}}")), "body.b.shape", "in one plane", "off the plane");
    let pinned = body(&format!("{}\naffine = {{}}\npin = [0, 0, 1]", sheet.replace('§', "")));
    assert!(Scene::parse("a.toml", &pinned, "".as_ref(), &[]).is_ok(), "a pin off the plane gives it thickness");
}

#[test]
fn a_strained_body_must_not_reach_a_support_at_the_start() {
    let contact = "[[contact]]\nsupport = \"table\"\n";
    let text = |height: f64, mark: &str| {
        let start = "gradient = [[0.5, 0, 0], [0, 0.5, 0], [0, 0, 4]]\naffine = {}\n";
        format!(
            "{TIME}{TABLE}{contact}{}{start}",
            BALL.replace("position = [0, 0, 1]", &format!("position = {mark}[0, 0, {height}]"))
        )
    };
    // Four times longer than wide: the sphere of radius 0.1 reaches 0.4 down.
    assert_error(&text(0.39, "§"), "body.ball.position", "its smallest gap is -1.000000e-2 m", "1.000000e-2 m");
    assert!(Scene::parse("a.toml", &text(0.41, ""), "".as_ref(), &[]).is_ok());
}

#[test]
fn errors_in_the_table_of_a_couple_name_its_line() {
    let folder = tempfile::tempdir().unwrap_or_else(|error| panic!("{error}"));
    let zeros = ",0".repeat(9);
    let rows: &[(String, &str, &str)] = &[
        (format!("0{zeros}\n1,2,3\n"), "line 2: expected 10 columns, found 3", "t, N_xx"),
        (
            format!("t,a,b,c,d,e,f,g,h,i\n# still\n0{zeros}\n\n1{}\n", ",x".repeat(9)),
            "line 5: column 2 holds \"x\"",
            "t, N_xx",
        ),
        (
            format!("t,a,b,c,d,e,f,g,h,i\n1{zeros}\n1{zeros}\n"),
            "line 3: the time of row 2, 1 s, is not later",
            "sort the rows",
        ),
        (format!("0{zeros}\n1,inf{}\n", ",0".repeat(8)), "line 2: row 2 has a number that is not finite", "finite"),
        ("t,a,b,c,d,e,f,g,h,i\n".to_owned(), "the table has no row", "at least one row"),
        (String::new(), "the table has no row", "at least one row"),
        (format!("O.0{zeros}\n"), "line 1: column 1 holds \"O.0\"", "t, N_xx"),
        (format!("0;{}\n", zeros.replace(',', ";")), "line 1: expected 10 columns, found 1", "t, N_xx"),
    ];
    for (content, message, help) in rows {
        fs::write(folder.path().join("couple.csv"), content).unwrap_or_else(|error| panic!("{error}"));
        let text = format!("{TIME}{BALL}affine = {{ couple = {{ table = \"couple.csv\" }} }}\n");
        let Err(found) = Scene::parse("scene.toml", &text, folder.path(), &[]) else { panic!("taken: {content}") };
        let error = &found.as_slice()[0];
        assert_eq!((found.count(), error.key.as_str()), (1, "body.ball.affine.couple.table"), "{found}");
        assert!(error.message.contains(message) && error.help.contains(help), "{found}");
    }
    fs::write(folder.path().join("couple.csv"), b"0,\xff\n").unwrap_or_else(|error| panic!("{error}"));
    let text = format!("{TIME}{BALL}affine = {{ couple = {{ table = \"couple.csv\" }} }}\n");
    let found = Scene::parse("scene.toml", &text, folder.path(), &[]).err().map(|found| found.to_string());
    assert!(found.is_some_and(|found| found.contains("line 1: it is not valid UTF-8")));
}

#[test]
fn errors_of_the_record_table_stand_at_their_place() {
    let rows: &[Row] = &[
        ("quantities = [\"stress\", §\"stress\"]", "quantities.1", "already recorded", "once"),
        ("quantities = [§\"stres\"]", "quantities.0", "not known", "did you mean `stress`?"),
        ("quantities = §\"stress\"", "quantities", "expected an array", "array"),
        ("origin = [0, 0, §\"1 s\"]", "origin.2", "is in s", "m"),
        ("§quantity = []", "quantity", "unknown key", "quantities"),
    ];
    for (line, key, message, help) in rows {
        assert_error(&format!("{TIME}[record]\n{line}\n{BALL}"), &format!("record.{key}"), message, help);
    }
}

#[test]
fn wrong_numbers_of_a_material_show_beside_a_wrong_type() {
    let text = format!(
        "{TIME}{BALL}velocity = [1, 2]\naffine = {{ material = {{ ogden = {{ mu = [1], alpha = [-2] }} }} }}\n"
    );
    let found = errors("scene.toml", &text, &[]);
    let keys: Vec<&str> = found.into_iter().map(|error| error.key.as_str()).collect();
    assert_eq!(keys, ["body.ball.velocity", "body.ball.affine.material.ogden.mu.0"], "{found}");
}
