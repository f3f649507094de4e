//! Numbers of contact laws from measurements: known ones come back, what cannot be known is named, bad files are
//! refused.

use crate::common::measured::{BALL, exact, fit, folder};
use gyration_study::calibration::{Calibration, CalibrationError, Fitted};
use gyration_threads::Interruption;
use std::fmt::Write as _;
use std::path::Path;
use std::time::Duration;

/// Measurements of gaps, slopes and pull-off, with these factors on what the scene gives.
fn measurements(factors: impl Fn(usize) -> f64) -> String {
    let sections = |numbers: &[Vec<f64>]| {
        let mut text = String::new();
        let list = |numbers: &[f64]| format!("{numbers:?}");
        let deviations = |numbers: &[f64]| list(&numbers.iter().map(|n| 0.01 * n.abs().max(1e-9)).collect::<Vec<_>>());
        writeln!(text, "[[gap]]\nkey = \"body.ball.density\"\nat = [500, 1000, 4000, 16000]").unwrap();
        writeln!(text, "gap = {}\ndeviation = {}", list(&numbers[0]), deviations(&numbers[0])).unwrap();
        writeln!(text, "[[slope]]\nangle = [\"5 deg\", \"15 deg\", \"30 deg\"]").unwrap();
        writeln!(text, "speed = {}\ndeviation = {}", list(&numbers[1]), deviations(&numbers[1])).unwrap();
        writeln!(text, "[[pull_off]]\nforce = {}\ndeviation = {}", list(&numbers[2]), deviations(&numbers[2])).unwrap();
        text
    };
    let ones = sections(&[vec![1.0; 4], vec![1.0; 3], vec![1.0; 1]]);
    let values = exact(&ones);
    let scaled: Vec<f64> = values.iter().enumerate().map(|(row, value)| value * factors(row)).collect();
    sections(&[scaled[..4].to_vec(), scaled[4..7].to_vec(), scaled[7..].to_vec()])
}

const NUMBERS: &str = r#"
    scene = "ball.toml"
    [fit.alpha]
    key = "contact.0.repulsion.alpha"
    start = "20 kPa"
    [fit.nu]
    key = "contact.0.repulsion.nu"
    start = 5
    [fit.friction]
    key = "contact.0.friction.beta"
    start = 1e4
    [fit.adhesion]
    key = "contact.0.adhesion.beta"
    start = 1e3
    from = 1
    to = "1 MPa"
"#;

#[test]
fn known_laws_come_back_from_what_they_make_measurable() {
    let found = fit(&format!("{NUMBERS}\n{}", measurements(|_| 1.0)));
    for (number, expected) in found.numbers.iter().zip([2e3, 40e3, 4e4, 6.0]) {
        println!("{} = {} ± {:?}, χ² = {:e}", number.name, number.value, number.error, found.chi_squared);
        let known = [("adhesion", 2e3), ("alpha", 40e3), ("friction", 4e4), ("nu", 6.0)];
        let expected = known.iter().find(|(name, _)| *name == number.name).map_or(expected, |(_, value)| *value);
        // ftol = 1e-10 of χ², which is its own scale here: some 1e-8 of the numbers.
        assert!((number.value - expected).abs() < 1e-6 * expected, "{}: {}", number.name, number.value);
    }
    assert!(found.undetermined.is_empty(), "{:?}", found.undetermined);
}

#[test]
fn what_cannot_be_told_apart_is_named() {
    let sections = measurements(|_| 1.0);
    let gaps = sections.split("[[slope]]").next().unwrap();
    let text = format!(
        "scene = \"ball.toml\"\nset = {{ \"contact.0.adhesion.beta\" = 0 }}\n[fit.alpha]\nkey = \"contact.0.repulsion.alpha\"\n\
         [fit.reach]\nkey = \"contact.0.repulsion.d0\"\n[fit.damping]\nkey = \"contact.0.damping.beta\"\n{gaps}"
    );
    let found = fit(&text);
    for undetermined in &found.undetermined {
        println!("{}", undetermined.in_words);
    }
    assert_eq!(found.undetermined.len(), 2);
    assert!(found.numbers.iter().all(|number| number.error.is_none()));
    // What nothing tells stays where it starts, and α and d0 do not run away along their ridge.
    let damping = found.numbers.iter().find(|number| number.name == "damping").unwrap().value;
    assert!((damping / 5e4 - 1.0).abs() < 1e-12, "{damping}");
    assert!(
        found.numbers.iter().all(|number| (0.1..10.0).contains(&(number.value / start(&number.name)))),
        "{:?}",
        found.numbers
    );
    // Only α d0^ν matters: d ln d0 = −d ln α/6.
    let pair = found.undetermined.iter().find(|open| open.direction.len() == 2).unwrap();
    let (alpha, reach) = (pair.direction[0].1, pair.direction[1].1);
    assert!((reach / alpha + 1.0 / 6.0).abs() < 1e-4, "{alpha} {reach}");
}

#[test]
fn a_number_that_is_told_beside_one_that_is_not_has_its_whole_error() {
    // Seen from a gap of 1 m, α and ν are almost one number: what two gaps tell of ν leaves α open by more than a
    // factor of twenty.
    let at = "at = [500, 1000]";
    let sections = format!("[[gap]]\nkey = \"body.ball.density\"\n{at}\ngap = [1, 1]\ndeviation = 1\n");
    let gaps = exact(&sections);
    let far = "set = { \"contact.0.adhesion.beta\" = 0 }\n[fit.alpha]\nkey = \"contact.0.repulsion.alpha\"\nstart = 2.56e-12\n\
               [fit.nu]\nkey = \"contact.0.repulsion.nu\"\n";
    let fitted = |factors: [f64; 2]| {
        let measured = [gaps[0] * factors[0], gaps[1] * factors[1]];
        let deviations = [0.01 * gaps[0], 0.01 * gaps[1]];
        fit(&format!(
            "scene = \"ball.toml\"\n{}[[gap]]\nkey = \"body.ball.density\"\n{at}\ngap = {measured:?}\ndeviation = \
                {deviations:?}\n",
            far.replace("= 0 }", "= 0, \"contact.0.repulsion.d0\" = 1 }"),
        ))
    };
    let found = fitted([1.0, 1.0]);
    let nu = |found: &Fitted| found.numbers.iter().find(|number| number.name == "nu").unwrap().clone();
    println!("{:?} {:?}", found.numbers, found.undetermined);
    assert_eq!(found.degrees_of_freedom, 0);
    assert!(found.numbers.iter().any(|number| number.name == "alpha" && number.error.is_none()));
    let [open] = &found.undetermined[..] else { panic!("{:?}", found.undetermined) };
    assert!(open.direction.iter().map(|(name, _)| name.as_str()).eq(["alpha"]));
    // What each measurement does to it when it changes by a tenth of its deviation.
    let moved = [[1.001, 1.0], [1.0, 1.001]].map(|factors| 10.0 * (nu(&fitted(factors)).value - nu(&found).value));
    let (error, expected) = (nu(&found).error.unwrap(), moved[0].hypot(moved[1]));
    println!("ν {} ± {error}, by moving the measurements {expected}", nu(&found).value);
    // The steps are a tenth of an error of a percent of a nonlinear law.
    assert!((error / expected - 1.0).abs() < 0.05, "{error} {expected}");
}

#[test]
fn the_largest_pull_is_found_however_short_its_reach() {
    let pulls: Vec<f64> = ["1e-5", "1e-7", "1e-9", "1e-12"]
        .iter()
        .map(|reach| {
            let set = format!("set = {{ \"contact.0.adhesion.d0\" = {reach}, \"contact.0.repulsion.d0\" = 1e-30 }}");
            let fit = "[fit.a]\nkey = \"contact.0.friction.beta\"";
            let text = format!("scene = \"ball.toml\"\n{set}\n{fit}\n[[pull_off]]\nforce = 1\ndeviation = 1\n");
            Calibration::parse("data.toml", &text, folder().path()).unwrap().predictions().unwrap()[0]
        })
        .collect();
    println!("pulls {pulls:?} N");
    // Of a flat face: β A max(x⁻³ − x⁻⁹), at x⁶ = 3, whatever d₀; its sides add the part d₀ over 5 cm.
    let exact = 2e3 * 0.05f64.powi(2) * (3f64.powf(-0.5) - 3f64.powf(-1.5));
    assert!(pulls.iter().all(|pull| (pull / exact - 1.0).abs() < 1e-3), "{pulls:?} {exact}");
}

/// What the scene of the tests has at a name.
fn start(name: &str) -> f64 {
    match name {
        "alpha" => 40e3,
        "damping" => 5e4,
        _ => 2e-3,
    }
}

#[test]
fn a_linear_scale_gives_the_same_number_and_error() {
    let slopes = exact("[[slope]]\nangle = [0.1, 0.2, 0.3]\nspeed = [1, 1, 1]\ndeviation = 1\n");
    let text = |scale: &str| {
        format!(
            "scene = \"ball.toml\"\n[fit.friction]\nkey = \"contact.0.friction.beta\"\nstart = 3e4\nscale = \"{scale}\"\n\
             [[slope]]\nangle = [0.1, 0.2, 0.3]\nspeed = {slopes:?}\ndeviation = 1e-3\n"
        )
    };
    let [one, other] = ["log", "linear"].map(|scale| fit(&text(scale)).numbers.remove(0));
    println!("friction {} ± {:?}, {} ± {:?}", one.value, one.error, other.value, other.error);
    // Data without errors; the search ends at 1e-10 of χ², which is zero.
    assert!((one.value - 4e4).abs() < 0.04 && (other.value - 4e4).abs() < 0.04);
    assert!((one.error.unwrap() / other.error.unwrap() - 1.0).abs() < 1e-6);
}

/// The start, as a measurement of its own size, held a number back that is larger by far.
#[test]
fn a_linear_scale_finds_a_number_far_above_its_start() {
    let table =
        "[[gap]]\nset = { \"contact.0.adhesion.beta\" = 0 }\nkey = \"body.ball.density\"\nat = [500, 1000, 2000]\n";
    let gaps = exact(&format!("{table}gap = [1, 1, 1]\ndeviation = 1\n"));
    let fitted = |scale: &str, start: f64| {
        fit(&format!(
            "scene = \"ball.toml\"\n[fit.alpha]\nkey = \"contact.0.repulsion.alpha\"\nstart = {start:?}\n\
             scale = \"{scale}\"\n{table}gap = {gaps:?}\ndeviation = 4e-5\n"
        ))
    };
    let expected = fitted("log", 2e4).numbers[0].error.unwrap();
    for start in [1e-4, 1.0, 10.0, 100.0] {
        let found = fitted("linear", start);
        println!("from {start}: {:?} after {} evaluations", found.numbers[0], found.evaluations);
        // The start counts as a measurement with a deviation of 1e3 sizes, α is known to 3.5 %: 1e-9.
        assert!((found.numbers[0].value / 40e3 - 1.0).abs() < 1e-6, "{:?}", found.numbers);
        assert!((found.numbers[0].error.unwrap() / expected - 1.0).abs() < 1e-4, "{:?}", found.numbers);
        assert!(found.undetermined.is_empty(), "{:?}", found.undetermined);
    }
}

#[test]
fn a_number_that_is_pushed_against_its_bound_is_said_to_lie_on_it() {
    let slopes = exact("[[slope]]\nangle = [0.1, 0.2, 0.3]\nspeed = [1, 1, 1]\ndeviation = 1\n");
    let found = fit(&format!(
        "scene = \"ball.toml\"\n[fit.friction]\nkey = \"contact.0.friction.beta\"\nstart = 2e4\nfrom = 1e4\nto = 3e4\n\
         [[slope]]\nangle = [0.1, 0.2, 0.3]\nspeed = {slopes:?}\ndeviation = 1e-4\n"
    ));
    assert!(found.numbers[0].is_on_bound && (found.numbers[0].value / 3e4 - 1.0).abs() < 1e-3, "{:?}", found.numbers);
    let [open] = &found.undetermined[..] else { panic!("{:?}", found.undetermined) };
    assert!(open.in_words.contains("lies on its bound") && found.numbers[0].error.is_none(), "{open:?}");
}

/// Numbers that scatter like a normal distribution: sums of twelve, from a fixed sequence.
fn scatter(seed: u64) -> impl Fn(usize) -> f64 {
    move |row| {
        let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15).wrapping_add(row as u64 + 1);
        let mut next = || {
            state ^= state >> 12;
            state ^= state << 25;
            state ^= state >> 27;
            (state.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 11) as f64 / (1u64 << 53) as f64
        };
        1.0 + 0.01 * ((0..12).map(|_| next()).sum::<f64>() - 6.0)
    }
}

#[test]
fn standard_errors_cover_the_truth_as_often_as_they_should() {
    let runs = 64;
    let exact = exact(
        "[[gap]]\nkey = \"body.ball.density\"\nat = [500, 1000, 4000, 16000]\ngap = [1, 1, 1, 1]\ndeviation = 1\n",
    );
    let (mut within, mut chi_squared) = (0, 0.0);
    for seed in 0..runs {
        let factor = scatter(seed + 1);
        let gaps: Vec<f64> = exact.iter().enumerate().map(|(row, gap)| gap * factor(row)).collect();
        let deviations: Vec<f64> = exact.iter().map(|gap| 0.01 * gap).collect();
        let found = fit(&format!(
            "scene = \"ball.toml\"\n[fit.alpha]\nkey = \"contact.0.repulsion.alpha\"\n[fit.nu]\nkey = \"contact.0.repulsion.nu\"\n\
             [[gap]]\nkey = \"body.ball.density\"\nat = [500, 1000, 4000, 16000]\ngap = {gaps:?}\ndeviation = {deviations:?}\n"
        ));
        chi_squared += found.chi_squared;
        for (number, truth) in found.numbers.iter().zip([40e3, 6.0f64]) {
            // On the scale of the search, on which errors are normal.
            let off = (number.value / truth).ln() * number.value / number.error.unwrap();
            within += usize::from(off.abs() < 1.0);
        }
    }
    let (share, per_degree) = (within as f64 / 128.0, chi_squared / 128.0);
    println!("{within} of 128 within one standard error, χ²/dof {per_degree:.3}");
    // 68.3 % expected; the two numbers of a fit go together: √(0.683·0.317/64) = 6 %, three of them.
    assert!((share - 0.683).abs() < 0.18, "{share}");
    // √(2/128) = 12.5 %, three of them.
    assert!((per_degree - 1.0).abs() < 0.375, "{per_degree}");
}

#[test]
fn bad_files_are_refused_with_place_and_fix() {
    let folder = folder();
    std::fs::write(folder.path().join("gaps.csv"), "gap, deviation\n1e-3, 1e-5\n\n# a remark\n2e-3, x\n").unwrap();
    std::fs::write(folder.path().join("drops.csv"), "hight, rebound\n0.1, 0.05\n").unwrap();
    std::fs::write(folder.path().join("short.csv"), "gap, deviation\n# a remark\n1e-3\n").unwrap();
    std::fs::write(folder.path().join("bytes.csv"), b"gap, note\n1e-3, \xb5m\n").unwrap();
    std::fs::write(folder.path().join("twice.csv"), "# a remark\nnote, gap, note, gap\n, 1e-3, , 2e-3\n").unwrap();
    std::fs::write(folder.path().join("semicolons.csv"), "gap; deviation\n1,5; 0,1\n").unwrap();
    let grains = format!("{BALL}copies = {{ grid = {{ count = [2, 1, 1], spacing = [1, 1, 1] }} }}\n");
    std::fs::write(folder.path().join("grains.toml"), grains).unwrap();
    let cases = [
        ("scene = \"grains.toml\"", "[[gap]]\ngap = 1e-3\ndeviation = 1e-5", "the body `ball` has `copies`"),
        (
            "scene = \"grains.toml\"",
            "[[gap]]\nbody = \"ball\"\ngap = 1e-3\ndeviation = 1e-5",
            "name a scene in which `ball` has no `copies`",
        ),
        (
            "scene = \"grains.toml\"",
            "[[gap]]\nbody = \"ball-0\"\ngap = 1e-3\ndeviation = 1e-5",
            "the body `ball` has `copies`",
        ),
        ("scene = \"ball.toml\"", "[[drop]]\nheight = 0.1\nrebound = 0.2\ndeviation = 1e-3", "row 1: 0.2 m cannot be"),
        ("scene = \"ball.toml\"", "[[slope]]\nangle = 0.1\nspeed = -0.2\ndeviation = 1e-3", "cannot be"),
        (
            "scene = \"ball.toml\"",
            "[[gap]]\nkey = \"body.ball.dens\"\nat = [1, 2]\ngap = [1e-3, 2e-3]\ndeviation = 1e-5",
            "no number at `body.ball.dens`",
        ),
        ("scene = \"ball.toml\"", "[[gap]]\nat = [1, 2]\ngap = [1e-3, 2e-3]\ndeviation = 1e-5", "write `key`"),
        ("scene = \"ball.toml\"", "[fit.b]\nkey = \"contact.0.repulsion.alpha\"", "already fitted as \"a\""),
        (
            "scene = \"ball.toml\"",
            "[[gap]]\nset = { \"contact.0.repulsion.alpha\" = 2 }\ngap = 1e-3\ndeviation = 1e-5",
            "cannot be set for one table",
        ),
        (
            "scene = \"ball.toml\"\nset = { \"contact.0.repulsion.alpha\" = 2e4 }",
            "",
            "`contact.0.repulsion.alpha` is fitted as \"a\", and cannot be set too",
        ),
        (
            "scene = \"ball.toml\"\nset = { \"body.0.density\" = 500 }",
            "[fit.b]\nkey = \"body.ball.density\"",
            "write it as the `start` of fit.b",
        ),
        ("scene = \"ball.toml\"", "[fit.b]\nkey = \"body.ball.position.0\"", "begins at zero"),
        ("scene = \"ball.toml\"", "[[drop]]\ntable = \"drops.csv\"\nrebound = 1", "remove one of the two"),
        ("scene = \"bal.toml\"", "", "no such file"),
        ("scene = \"bal.toml\"", "", "write a path relative to this file"),
        ("scene = \"ball.toml\"", "[[gap]]\ngap = [1e-3]\ndeviation = 1e-5\ndeviatoin = 2", "deviatoin"),
        ("scene = \"ball.toml\"", "[[gap]]\ngap = [1e-3]\n", "deviation"),
        ("scene = \"ball.toml\"", "[[gap]]\ngap = \"3 kg\"\ndeviation = 1e-5", "kg"),
        ("scene = \"ball.toml\"", "[[gap]]\ngap = 1e-3\ndeviation = 0", "deviations"),
        ("scene = \"ball.toml\"", "[[gap]]\nbody = \"bal\"\ngap = 1e-3\ndeviation = 1e-5", "did you mean `ball`"),
        ("scene = \"ball.toml\"", "[[drop]]\nheight = [0.1, 0.2]\nrebound = 0.1\ndeviation = 1e-3", "same length"),
        ("scene = \"ball.toml\"", "[[gap]]\ntable = \"gaps.csv\"", "gaps.csv:5: deviation is \"x\""),
        ("scene = \"ball.toml\"", "[[drop]]\ntable = \"drops.csv\"", "drops.csv has the columns hight, rebound"),
        ("scene = \"ball.toml\"", "[[gap]]\ntable = \"gabs.csv\"", "gabs.csv cannot be read"),
        ("scene = \"ball.toml\"", "[[gap]]\ntable = \"short.csv\"", "short.csv:3: the row has 1 of 2 cells"),
        ("scene = \"ball.toml\"", "[[gap]]\ntable = \"bytes.csv\"", "bytes.csv:2: the row is not UTF-8 text"),
        (
            "scene = \"ball.toml\"",
            "[[gap]]\ntable = \"twice.csv\"\ndeviation = 1e-5",
            "twice.csv:2: several columns are called gap",
        ),
        ("scene = \"ball.toml\"", "[[gap]]\ntable = \"semicolons.csv\"", "semicolons.csv:1: the names are not divided"),
        ("scene = \"ball.toml\"", "[[gap]]\ntable = \"semicolons.csv\"", "by commas, and write decimals with a point"),
        ("scene = \"ball.toml\"", "[[slope]]\nangle = \"95 deg\"\nspeed = 1\ndeviation = 1", "no angle that can"),
        ("scene = \"ball.toml\"", "[[pull_off]]\nforce = \"2 mm\"\ndeviation = 1", "force in N"),
        ("scene = \"ball.toml\"", "", "cannot tell"),
        ("scene = \"ball.toml\"", "[fit.b]\nkey = \"contact.0.repulsion.beta\"", "no number at"),
        ("scene = \"ball.toml\"", "[fit.b]\nkey = \"contact.0.repulsion.nu\"\nfrom = 7\nto = 9", "between the bounds"),
        (
            "scene = \"ball.toml\"",
            "[fit.b]\nkey = \"contact.0.repulsion.nu\"\nstart = 5\nfrom = 10\nto = 1",
            "data.toml:8:6: fit.b.to: the bound to = 1.0 is not greater than from = 10.0",
        ),
        ("scene = \"ball.toml\"", "[fit.b]\nkey = \"contact.0.repulsion.nu\"\nfrom = 2\nto = 2", "a greater `to`"),
    ];
    for (scene, sections, expected) in cases {
        let text = format!("{scene}\n[fit.a]\nkey = \"contact.0.repulsion.alpha\"\n{sections}\n");
        let message = Calibration::parse("data.toml", &text, folder.path()).unwrap_err().to_string();
        assert!(message.contains(expected), "{sections}: {message}");
        assert!(message.contains("data.toml:") && message.contains("fix:"), "{message}");
    }
    assert!(Calibration::load(Path::new("/nowhere/data.toml")).is_err());
    // The start was told without its place, as that of a measurement.
    let text = "scene = \"ball.toml\"\n[fit.a]\nkey = \"contact.0.repulsion.alpha\"\nstart = -1\n[[gap]]\ngap = 1e-3\n\
                deviation = 1e-5\n";
    let message = Calibration::parse("data.toml", text, folder.path()).unwrap_err().to_string();
    assert!(message.contains("data.toml:4:9: fit.a.start: ") && message.contains("must be at least 0 Pa"), "{message}");
}

#[test]
fn measurement_in_another_unit_is_named() {
    let alpha = "scene = \"ball.toml\"\n[fit.alpha]\nkey = \"contact.0.repulsion.alpha\"\nstart = 30e3\n";
    let friction = "[fit.friction]\nkey = \"contact.0.friction.beta\"\nstart = 3e4\n";
    let cases = [
        (friction, 2..3, 1e-3, ("gap.0", Some(2))),
        // The friction would explain all of the slopes.
        ("", 4..7, 0.1, ("slope.0", None)),
    ];
    for (more, wrong, factor, (table, row)) in cases {
        let data = measurements(|row| if wrong.contains(&row) { factor } else { 1.0 });
        let fitted = fit(&format!("{alpha}{more}{data}"));
        let suspect =
            fitted.suspect.unwrap_or_else(|| panic!("{table}: nobody is suspected, χ² {}", fitted.chi_squared));
        println!("χ² {:.4e}; {}", fitted.chi_squared, suspect.in_words());
        assert_eq!((suspect.table.as_str(), suspect.row), (table, row));
        assert!((suspect.measured / suspect.expected / factor - 1.0).abs() < 1e-6, "{}", suspect.in_words());
    }
}

/// A gap of the book in metres instead of millimetres.
const IN_METRES: [&str; 2] = ["\"0.3312 mm\"", "\"0.3312 m\""];

/// A search that fails does so with coarse runs, too.
const COARSE: &str = "[set]\n\"solver.rtol\" = 1e-5\n\"solver.atol\" = 1e-7";
/// What takes most of the time, and tells of the damping alone.
const DROPS: [&str; 2] =
    ["[fit.damping]\nkey = \"contact.0.damping.beta\"\n", "[[drop]]\ntable = \"drops.csv\"\ndeviation = \"3 mm\"\n"];

/// The measurements of the book with one of them in another unit, without some lines.
fn misread([right, wrong]: [&str; 2], more: &str, without: &[&str]) -> CalibrationError {
    let book = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/examples/calibrate");
    let mut changed = std::fs::read_to_string(book.join("measurements.toml")).unwrap();
    let more = format!("{more}\n[fit.repulsion]");
    let removed = without.iter().map(|lines| (*lines, ""));
    for (old, new) in removed.chain([(right, wrong), ("[fit.repulsion]", more.as_str())]) {
        assert!(changed.contains(old), "{old}");
        changed = changed.replacen(old, new, 1);
    }
    Calibration::parse("data.toml", &changed, &book).unwrap().fit().unwrap_err()
}

/// One so far off leads the search where nothing can be computed.
#[test]
fn measurement_that_leads_the_search_astray_is_named() {
    let lost = misread(IN_METRES, "", &DROPS).to_string();
    println!("{lost}");
    assert!(lost.contains("row 2 of gap.0 is at odds") && lost.contains("unit"), "{lost}");
}

/// A force of pull-off a thousand times too large leads the search along a valley that has hardly an end: the force
/// agrees there, all else is off.
#[test]
fn measurement_that_keeps_the_search_from_its_end_is_named() {
    let lost = misread(["\"0.409 N\"", "409"], COARSE, &[]).to_string();
    println!("{lost}");
    // Derivatives of 1e-6 a step leave four digits of what the others tell.
    assert!(lost.contains("30 evaluations; row 1 of pull_off.0 is at odds") && lost.contains("9.658"), "{lost}");
}

/// On a slow machine a short time is over before anything is known: a longer one is then tried.
#[test]
fn search_ends_with_the_wall_time_of_its_scene_and_says_where_it_was() {
    for seconds in (0..).map(|attempt| 0.25 * f64::from(1 << attempt)) {
        let early = misread(IN_METRES, &format!("[set]\n\"solver.max_wall_time\" = {seconds:?}"), &DROPS);
        let CalibrationError::Interrupted { reached, .. } = &early else { panic!("{early:?}") };
        println!("after {seconds} s: {reached}");
        if reached.contains("row 2 of gap.0") {
            return;
        }
        assert_eq!(reached, "before the measurements were computed once");
    }
}

/// Without a residual χ² was that of nothing, −0.
#[test]
fn search_that_has_computed_nothing_tells_no_sum_of_squares() {
    let text = "scene = \"ball.toml\"\n[fit.alpha]\nkey = \"contact.0.repulsion.alpha\"\n\
                [[gap]]\ngap = 4e-3\ndeviation = 1e-5\n";
    let calibration = Calibration::parse("data.toml", text, folder().path()).unwrap();
    let no_time = Interruption::default().after(Some(Duration::ZERO));
    let message = no_time.within(|| calibration.fit()).unwrap_err().to_string();
    assert!(message.contains("after solver.max_wall_time, before the measurements were computed once"), "{message}");
    assert!(message.contains("fix: raise solver.max_wall_time") && !message.contains("χ²"), "{message}");
}

/// Wherever a search is given up, it says so: no fit comes of runs that did not end.
#[test]
fn search_that_is_given_up_anywhere_is_no_fit() {
    let number = "[fit.damping]\nkey = \"contact.0.damping.beta\"\nstart = 3e4\n";
    let drops = |rebound: &[f64]| format!("[[drop]]\nheight = [0.05, 0.1]\nrebound = {rebound:?}\ndeviation = 1e-3\n");
    let rebound = exact(&drops(&[1e-3, 1e-3]));
    let text = format!("scene = \"ball.toml\"\n{number}{}", drops(&rebound));
    let whole = fit(&text);
    let (folder, mut given_up) = (folder(), 0);
    let calibration = Calibration::parse("data.toml", &text, folder.path()).unwrap();
    for attempt in 0.. {
        let most = Duration::from_secs_f64(1e-3 * 1.5f64.powi(attempt));
        match Interruption::default().after(Some(most)).within(|| calibration.fit()) {
            Err(error) => assert!(matches!(error, CalibrationError::Interrupted { .. }), "{error}"),
            Ok(fitted) => {
                assert!(fitted == whole);
                break;
            }
        }
        given_up += 1;
    }
    println!("{given_up} times given up");
    assert!(given_up > 3, "{given_up}");
}

#[test]
fn what_is_said_of_a_contact_is_fitted_as_a_law_is() {
    let folder = tempfile::TempDir::new().unwrap();
    let laws = BALL.find("repulsion").unwrap()..BALL.find("[[body]]").unwrap();
    let mut scene = BALL.to_owned();
    scene.replace_range(laws, "from = { rest_gap = \"0.2 mm\" }\n");
    std::fs::write(folder.path().join("said.toml"), scene).unwrap();
    let text = "scene = \"said.toml\"\n[fit.gap]\nkey = \"contact.0.from.rest_gap\"\n[[gap]]\ngap = [\"0.31 mm\"]\n\
                deviation = \"1 um\"\n";
    let found = Calibration::parse("data.toml", text, folder.path()).unwrap().fit().unwrap();
    println!("gap = {:e}", found.numbers[0].value);
    assert!((found.numbers[0].value / 0.31e-3 - 1.0).abs() < 1e-7);
    let follows = text.replace("from.rest_gap", "repulsion.alpha");
    let refusal = Calibration::parse("data.toml", &follows, folder.path()).unwrap_err().to_string();
    assert!(refusal.contains("`repulsion` of this contact follows from its `from`"), "{refusal}");
    assert!(refusal.contains("fit one of contact.0.from.nu, contact.0.from.rest_gap"), "{refusal}");
}
