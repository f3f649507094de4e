//! Files that a scene names may change behind its recording: neither a resumption nor a replay takes another one for
//! them.

use crate::runs::{StopAfter, provenance};
use gyration_record::Recording;
use gyration_scene::Scene;
use gyration_sim::replay::{Replay, ReplayError};
use gyration_sim::{Job, RecordingEnd, RunError, Unwatched};
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};

/// A scene that names a file.
struct Case {
    text: &'static str,
    key: &'static str,
    file: &'static str,
    /// As it is when the run is made.
    content: &'static str,
    /// As it is later.
    other: &'static str,
}

const DRIVE: Case = Case {
    text: r#"
        time = { end = 0.2, sample = 0.01 }
        world = { gravity = [0, 0, 0] }
        [[body]]
        name = "crawler"
        shape = { sphere = { radius = 0.05 } }
        density = 1000
        [body.contractile]
        contraction_viscosity = 10
        drive = { table = { file = "q.csv" } }
        material = { mooney_rivlin = { c1 = 3000, c2 = 1000 } }
        viscosity = 20
    "#,
    key: "body.crawler.contractile.drive.table.file",
    file: "q.csv",
    content: "0,0,0,0,0,0,0,0,0,0\n0.2,1,0,0,0,2,0,0,0,3\n",
    other: "0,0,0,0,0,0,0,0,0,0\n0.2,1,0,0,0,2,0,0,0,2\n",
};

const COUPLE: Case = Case {
    text: r#"
        time = { end = 0.2, sample = 0.01 }
        world = { gravity = [0, 0, 0] }
        [[body]]
        name = "rod"
        shape = { box = { size = [0.02, 0.02, 0.1] } }
        density = 1000
        [body.affine]
        material = { mooney_rivlin = { c1 = 3000, c2 = 1000 } }
        viscosity = 20
        couple = { table = "n.csv" }
    "#,
    key: "body.rod.affine.couple.table",
    file: "n.csv",
    content: "0,0,0,0,0,0,0,0,0,0\n0.2,1e-3,0,0,0,2e-3,0,0,0,3e-3\n",
    other: "0,0,0,0,0,0,0,0,0,0\n0.2,1e-3,0,0,0,2e-3,0,0,0,2e-3\n",
};

const FLUID: Case = Case {
    text: r#"
        time = { end = 0.2, sample = 0.01 }
        world = { gravity = [0, 0, 0] }
        fluid = { viscosity = 1, velocity = { table = { file = "u.csv" } } }
        [[body]]
        name = "ball"
        shape = { sphere = { radius = 0.01 } }
        density = 1000
        inclusion = {}
    "#,
    key: "fluid.velocity.table.file",
    file: "u.csv",
    content: "0,0,0,0\n0.2,0.1,0,0\n",
    other: "0,0,0,0\n0.2,0.2,0,0\n",
};

const PLACES: Case = Case {
    text: r#"
        time = { end = 0.2, sample = 0.01 }
        [[body]]
        name = "grain"
        shape = { sphere = { radius = 0.01 } }
        density = 1000
        copies = { places = "places.csv" }
    "#,
    key: "body.grain.copies.places",
    file: "places.csv",
    content: "x,y,z\n0,0,0\n1,0,0\n2,0,0\n",
    other: "x,y,z\n0,0,0\n1,0,0\n3,0,0\n",
};

const MESH: Case = Case {
    text: r#"
        time = { end = 0.2, sample = 0.01 }
        [[body]]
        name = "rock"
        shape = { mesh = { file = "rock.obj", scale = 0.01 } }
        density = 1000
        angular_velocity = [1, 2, 3]
    "#,
    key: "body.rock.shape.mesh.file",
    file: "rock.obj",
    content: "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n",
    other: "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 2\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n",
};

impl Case {
    fn write(&self, folder: &Path, content: &str) {
        fs::write(folder.join(self.file), content).unwrap();
    }

    fn scene(&self, folder: &Path) -> Scene {
        Scene::parse("case.toml", self.text, folder, &[]).unwrap_or_else(|errors| panic!("{errors}"))
    }

    fn resume(&self, folder: &Path) -> Result<RecordingEnd, RunError> {
        Job::of(&self.scene(folder), &provenance()).resume(&recording(folder), &mut Unwatched)
    }
}

fn recording(folder: &Path) -> PathBuf {
    folder.join("case.gyr")
}

fn replay(folder: &Path) -> Result<Replay, ReplayError> {
    Replay::open(&Recording::open(&recording(folder)).unwrap())
}

#[test]
fn a_file_that_has_changed_is_refused_with_its_key() {
    for case in [DRIVE, COUPLE, FLUID, PLACES, MESH] {
        let (sandbox, key) = (tempfile::tempdir().unwrap(), case.key);
        let folder = sandbox.path();
        case.write(folder, case.content);
        Job::of(&case.scene(folder), &provenance()).record(&recording(folder), &mut StopAfter(1)).unwrap();
        for has_ended in [false, true] {
            let recorded = Recording::open(&recording(folder)).unwrap();
            assert_eq!(recorded.attributes().contains_key("outcome"), has_ended, "{key}");
            case.write(folder, case.other);
            match case.resume(folder) {
                Err(RunError::OtherScene { what, fix, .. }) => {
                    assert_eq!(what, format!("{key}: the file {} has changed since the run was made", case.file));
                    assert_eq!(fix, "put the file back as it was");
                }
                other => panic!("{key}: {other:?}"),
            }
            let refused = replay(folder).unwrap_err();
            let told = refused.to_string();
            assert!(matches!(refused, ReplayError::OtherFiles { .. }), "{told}");
            assert!(told.contains(case.file) && told.contains(key) && told.contains("has changed"), "{told}");
            // A remark changes no number.
            case.write(folder, &format!("# a remark\n{}", case.content));
            replay(folder).unwrap();
            case.resume(folder).unwrap();
        }
    }
}

#[test]
fn other_overrides_are_told_before_other_files() {
    let sandbox = tempfile::tempdir().unwrap();
    let folder = sandbox.path();
    MESH.write(folder, MESH.content);
    let provenance = provenance();
    Job::of(&MESH.scene(folder), &provenance).record(&recording(folder), &mut StopAfter(1)).unwrap();
    let scaled = ["body.rock.shape.mesh.scale=0.02".to_owned()];
    let scaled = Scene::parse("case.toml", MESH.text, folder, &scaled).unwrap();
    match Job::of(&scaled, &provenance).resume(&recording(folder), &mut Unwatched) {
        Err(RunError::OtherScene { what, fix, .. }) => {
            assert_eq!(what, "body.rock.shape.mesh.scale: 0.01 there, 0.02 here");
            assert_eq!(fix, "it was made without --set");
        }
        other => panic!("{other:?}"),
    }
}

/// What may differ between a run and its resumption need not be repeated.
#[test]
fn overrides_that_may_differ_are_not_asked_for() {
    let sandbox = tempfile::tempdir().unwrap();
    let folder = sandbox.path();
    MESH.write(folder, MESH.content);
    let of = |overrides: &[&str]| {
        let overrides: Vec<String> = overrides.iter().map(ToString::to_string).collect();
        Scene::parse("case.toml", MESH.text, folder, &overrides).unwrap()
    };
    let scene = of(&["time.end=0.3", "solver.max_wall_time=60", "solver.threads=1"]);
    Job::of(&scene, &provenance()).record(&recording(folder), &mut StopAfter(1)).unwrap();
    match Job::of(&of(&["solver.threads=2"]), &provenance()).resume(&recording(folder), &mut Unwatched) {
        Err(RunError::OtherScene { fix, .. }) => assert_eq!(fix, "repeat --set 'time.end=0.3'"),
        other => panic!("{other:?}"),
    }
    Job::of(&of(&["time.end=0.3"]), &provenance()).resume(&recording(folder), &mut Unwatched).unwrap();
}

/// Changes the attributes of a recording by hand.
fn edit(path: &Path, change: impl FnOnce(&mut serde_json::Map<String, Value>)) {
    let metadata = path.join("zarr.json");
    let mut group: Value = serde_json::from_slice(&fs::read(&metadata).unwrap()).unwrap();
    let attributes = group["attributes"].as_object_mut().unwrap();
    attributes.remove("record_checksum");
    change(attributes);
    fs::write(metadata, serde_json::to_vec(&group).unwrap()).unwrap();
}

#[test]
fn recordings_without_checksums_of_files_are_read_and_resumed() {
    let sandbox = tempfile::tempdir().unwrap();
    let (folder, case) = (sandbox.path(), PLACES);
    case.write(folder, case.content);
    Job::of(&case.scene(folder), &provenance()).record(&recording(folder), &mut Unwatched).unwrap();
    edit(&recording(folder), |attributes| {
        let files = attributes.remove("files").unwrap();
        assert_eq!((&files[0]["key"], &files[0]["file"]), (&json!(case.key), &json!(case.file)));
    });
    // Nothing is compared.
    case.write(folder, case.other);
    replay(folder).unwrap();
    assert!(matches!(case.resume(folder), Ok(RecordingEnd::AlreadyFinished(_))));
    // As an earlier version left it: a checksum of how all bodies start.
    edit(&recording(folder), |attributes| _ = attributes.insert("places".into(), json!("f256bb9a")));
    match case.resume(folder) {
        Err(RunError::OtherScene { what, .. }) => assert!(what.contains("a file that they are made of"), "{what}"),
        other => panic!("{other:?}"),
    }
    replay(folder).unwrap();
    case.write(folder, case.content);
    assert!(matches!(case.resume(folder), Ok(RecordingEnd::AlreadyFinished(_))));
}
