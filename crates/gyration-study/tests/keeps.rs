//! What is kept of a run, against closed forms of free motion.

use gyration_record::{Recording, RowHash};
use gyration_sim::Unwatched;
use gyration_study::{Shard, Study, Table, Value, execute};
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::num::NonZeroUsize;
use std::path::Path;

/// A brick in free flight, without gravity unless that is set.
const BRICK: &str = r#"
world = { gravity = [0, 0, 0] }
time = { end = 1, sample = 0.02 }
[[body]]
name = "brick"
shape = { ellipsoid = { semi_axes = [0.3, 0.2, 0.1] } }
density = 1000
"#;

/// What is kept of the only run of a study of the brick.
fn kept(set: &str, keep: &str) -> BTreeMap<String, Value> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("brick.toml"), BRICK).unwrap();
    let text = format!("scene = \"brick.toml\"\n[set]\n{set}\n[keep]\n{keep}\n");
    let study = Study::parse("s.toml", &text, folder.path(), &[]).unwrap_or_else(|error| panic!("{error}"));
    let row = study.row(0);
    study.columns().iter().map(|column| column.name.clone()).zip(row.values).collect()
}

fn near(value: &Value, expected: f64, tolerance: f64) {
    let found = value.number().unwrap();
    assert!((found - expected).abs() < tolerance, "{found:.12}, expected {expected:.12}");
}

#[test]
fn turns_are_those_of_a_steady_spin() {
    let rate = 3.25 * TAU;
    let set = format!("\"body.brick.angular_velocity\" = [0, 0, {rate:?}]");
    let keep = "matter = { turns = \"brick\" }\nform = { shape_turns = \"brick\" }\n\
                against = { turns = \"brick\", axis = [0, 0, -2] }\nform_against = { shape_turns = \"brick\", axis = [0, 0, -2] }";
    let row = kept(&set, keep);
    // The default tolerance is 1e-8 over an angle of 20 rad.
    for (name, expected) in [("matter", 3.25), ("form", 3.25), ("against", -3.25), ("form_against", -3.25)] {
        near(&row[name], expected, 1e-7);
    }
}

#[test]
fn tilt_is_the_largest_angle_from_upright() {
    let keep = "tilt = { tilt = \"brick\" }";
    let spin = "\"body.brick.angular_velocity\" = [0.7, 0, 0]";
    near(&kept(spin, keep)["tilt"], 0.7, 1e-7);
    // Whatever stands upright at the start: here another line of the matter.
    let turned = "\"body.brick.orientation\" = { axis_angle = { axis = [1, 0, 0], angle = 1.2 } }";
    near(&kept(&format!("{spin}\n{turned}"), keep)["tilt"], 0.7, 1e-7);
    let upright = "\"body.brick.angular_velocity\" = [0, 0, 3]";
    near(&kept(upright, keep)["tilt"], 0.0, 1e-12);
}

#[test]
fn distance_is_level_signed_or_reduced_to_a_time() {
    let set = "\"world.gravity\" = [0, 0, -9.81]\n\"body.brick.velocity\" = [3, 4, 1]\n\"time.end\" = 2";
    let keep = "far = { distance = \"brick\" }\nback = { distance = \"brick\", along = [-2, 0, 0] }\n\
                period = { distance = \"brick\", per = \"100 ms\" }\nspeed = { change = \"brick.x\" }";
    let row = kept(set, keep);
    for (name, expected) in [("far", 10.0), ("back", -6.0), ("period", 0.5), ("speed", 6.0)] {
        near(&row[name], expected, 1e-7);
    }
}

#[test]
fn columns_at_events_are_those_of_their_very_time() {
    let set = "\"world.gravity\" = [0, 0, -9.81]\n\"body.brick.velocity\" = [0, 0, 5]\n\"time.sample\" = 0.3";
    let keep = "top = { at = \"apex\", column = \"brick.z\", last = 4 }\nwhen = { at = \"apex\", body = \"brick\", column = \"t\", first = 1 }\n\
                tops = { count = \"apex\" }\nhighest = { maximum = \"brick.z\" }\nmean = { mean = \"brick.vz\" }\nall = { samples = \"t\", last = 2 }";
    let row = kept(set, keep);
    let list = |name: &str| match &row[name] {
        Value::List(values) => values.clone(),
        other => panic!("{other:?}"),
    };
    assert_eq!((list("top").len(), list("when").len(), &row["tops"]), (1, 1, &Value::Integer(1)));
    println!("apex: {:e} m, {:e} s off", list("top")[0] - 25.0 / 19.62, list("when")[0] - 5.0 / 9.81);
    assert!((list("top")[0] - 25.0 / 19.62).abs() < 1e-9 && (list("when")[0] - 5.0 / 9.81).abs() < 1e-8);
    // The samples are at 0, 0.3, 0.6, 0.9 and the end; the mean of a linear function is exact by trapezoids.
    near(&row["highest"], 5.0 * 0.6 - 0.5 * 9.81 * 0.36, 1e-8);
    near(&row["mean"], 5.0 - 0.5 * 9.81, 1e-8);
    // Samples are multiplied, not accumulated.
    assert_eq!(list("all"), [3.0 * 0.3, 1.0]);
}

/// Symptom: where nothing else asked for samples, the last interval was the whole run: 3.92 N s for 0.08.
#[test]
fn what_belongs_to_an_interval_is_that_of_the_last_sample() {
    let table = "\"world.gravity\" = [0, 0, -9.81]\n\"time.sample\" = 0.1\n\"body.brick.position\" = [0, 0, 0.3]\n\
                 \"support\" = [{ name = \"t\", plane = {} }]\n\
                 \"contact\" = [{ support = \"t\", repulsion = { alpha = 1e3, nu = 4, d0 = 1e-2 } }]\n\
                 \"record.quantities\" = [\"impulse\", \"peak_force\"]";
    let last = "push = { last = \"brick.impulse_z\" }\npeak = { last = \"brick.peak_force\" }\n";
    let (alone, sampled) = (kept(table, last), kept(table, &format!("{last}mean = {{ mean = \"brick.z\" }}")));
    assert_eq!((&alone["push"], &alone["peak"]), (&sampled["push"], &sampled["peak"]));
    // Some of the weight times the interval, not of the run.
    assert!(alone["push"].number().unwrap() < 0.5 * 9.81 * 25.2, "{alone:?}");
}

#[test]
fn the_face_that_looks_down_is_told_by_its_axis() {
    let turned = |axis: &str, angle: &str| {
        let set = format!("\"body.brick.orientation\" = {{ axis_angle = {{ axis = {axis}, angle = \"{angle}\" }} }}");
        let row = kept(&set, "end = { face = \"brick\" }\nstart = { face = \"brick\", at = \"start\" }");
        assert_eq!(row["end"], row["start"]);
        row["end"].text().unwrap().to_owned()
    };
    let faces = [("[1, 0, 0]", "0 deg", "-z"), ("[1, 0, 0]", "170 deg", "+z"), ("[1, 0, 0]", "80 deg", "-y")];
    // By the right hand, +x goes down when the body turns about y.
    for (axis, angle, face) in faces.into_iter().chain([("[0, 1, 0]", "80 deg", "+x"), ("[0, 1, 0]", "-80 deg", "-x")])
    {
        assert_eq!(turned(axis, angle), face, "{axis}, {angle}");
    }
    let spun = "\"body.brick.angular_velocity\" = [0, 1.6, 0]";
    let row = kept(spun, "end = { face = \"brick\" }\nstart = { face = \"brick\", at = \"start\" }");
    assert_eq!((row["start"].text(), row["end"].text()), (Some("-z"), Some("+x")));
}

#[test]
fn recordings_are_left_of_those_that_are_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("brick.toml"), BRICK).unwrap();
    let text = "scene = \"brick.toml\"\nmax_steps = 40\n[parameter.spin]\nkey = \"body.brick.angular_velocity.0\"\nvalues = [0, 2e3, 0.1]\n\
                [set]\n\"body.brick.angular_velocity\" = [0, 0, 1]\n[keep]\nx = { first = \"brick.x\" }\n";
    for (wanted, expected) in [("none", &[][..]), ("failures", &[1]), ("all", &[0, 1, 2])] {
        let overrides = [format!("recordings={wanted}")];
        let study = Study::parse("s.toml", text, folder.path(), &overrides).unwrap_or_else(|error| panic!("{error}"));
        let mut table = Table::create(&folder.path().join(wanted), &study, Shard::WHOLE, false).unwrap();
        assert!(execute(&study, &mut table, NonZeroUsize::MIN, &mut Unwatched).unwrap());
        let outcomes: Vec<_> = (0..3).map(|run| study.row(run).values[4].text().unwrap().to_owned()).collect();
        assert_eq!(outcomes, ["completed", "step_limit", "completed"]);
        for run in 0..3 {
            let path = table.recordings().join(format!("run-{run:06}.gyr"));
            assert_eq!(path.exists(), expected.contains(&run), "{wanted}, {run}");
            if path.exists() {
                has_ended(&path, run != 1);
            }
        }
    }
}

#[test]
fn what_is_kept_of_a_run_with_too_many_steps_is_of_its_last_one() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("brick.toml"), BRICK).unwrap();
    let text = "scene = \"brick.toml\"\nmax_steps = 40\n[set]\n\"body.brick.angular_velocity\" = [2e3, 0, 1]\n\
                \"body.brick.velocity\" = [1, 0, 0]\n[keep]\nway = { change = \"brick.x\" }\n";
    let study = Study::parse("s.toml", text, folder.path(), &[]).unwrap_or_else(|error| panic!("{error}"));
    let row: std::collections::BTreeMap<String, _> =
        study.columns().iter().map(|column| column.name.clone()).zip(study.row(0).values).collect();
    assert_eq!(row["outcome"].text(), Some("step_limit"));
    let (way, time) = (row["way"].number().unwrap(), row["time"].number().unwrap());
    println!("{way} m in {time} s");
    assert!(time > 0.0 && (way / time - 1.0).abs() < 1e-6, "{way} {time}");
}

/// Whoever is over has an outcome and the hash of its rows; whoever came to the end of its steps alone may go on.
fn has_ended(path: &Path, is_over: bool) {
    let recording = Recording::open(path).unwrap();
    let attributes = recording.attributes();
    assert!(recording.rows() > 0);
    assert_eq!(attributes.contains_key("outcome"), is_over);
    let hash = RowHash::of_recording(&recording, recording.rows()).unwrap().to_string();
    assert_eq!(attributes.get("row_hash").and_then(|told| told.as_str()), Some(&*hash).filter(|_| is_over));
}
