//! `gyration export` and `gyration plot`: columns, formats, stdout, the same bytes for the same recording.

use crate::common::{self, BALL, Sandbox};
use std::fs;
use std::io::Read;
use std::process::Stdio;

fn recorded() -> Sandbox {
    let sandbox = Sandbox::with_ball();
    sandbox.done(&["run", "ball.toml", "--quiet"]);
    sandbox
}

#[test]
fn csv_has_the_columns_of_the_contract() {
    let sandbox = recorded();
    let csv = sandbox.done(&["export", "ball.gyr", "--format", "csv", "-o", "-"]);
    assert_eq!(csv.stderr, "");
    let mut lines = csv.stdout.lines();
    let matrix = |name: &str| {
        ["xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"].map(|at| format!("ball.{name}_{at}")).join(",")
    };
    let header = format!(
        "t,ball.x,ball.y,ball.z,{},ball.vx,ball.vy,ball.vz,{},ball.gap,ball.fx,ball.fy,ball.fz,energy.kinetic,\
         energy.gravity,energy.contact,work.damping,work.friction,energy.residual",
        matrix("P"),
        matrix("Pdot")
    );
    assert_eq!(lines.next(), Some(header.as_str()));
    let rows: Vec<Vec<f64>> =
        lines.map(|line| line.split(',').map(|number| number.parse().unwrap()).collect()).collect();
    assert!(rows.iter().all(|row| row.len() == header.split(',').count()));
    // Samples at k·sample, multiplied; the last is the end.
    let times: Vec<f64> = rows.iter().map(|row| row[0]).collect();
    let expected: Vec<f64> = (0..60).map(|k| f64::from(k) * 0.01).chain([0.6]).collect();
    assert_eq!(times, expected);
    assert_eq!(rows[0][1..4], [0.0, 0.0, 0.2]);
}

#[test]
fn exports_have_default_names() {
    let sandbox = recorded();
    assert_eq!(sandbox.done(&["export", "ball.gyr/", "--format", "csv"]).stdout, "");
    for format in ["npz", "vtk", "gltf"] {
        sandbox.done(&["export", "ball.gyr", "--format", format]);
    }
    let names = ["ball-vtp", "ball.csv", "ball.glb", "ball.gyr", "ball.npz", "ball.pvd", "ball.toml"];
    assert_eq!(sandbox.names(), names);
    assert!(fs::read(sandbox.path("ball.npz")).unwrap().starts_with(b"PK\x03\x04"));
}

#[test]
fn the_name_of_a_file_tells_its_format() {
    let sandbox = recorded();
    for name in ["a.csv", "a.npz", "a.pvd", "a.xyz", "a.glb"] {
        sandbox.done(&["export", "ball.gyr", "-o", name]);
        assert!(sandbox.path(name).exists(), "{name}");
    }
    for (arguments, told) in [(&[][..], "no format is given"), (&["-o", "a.abc"], "the name a.abc does not tell")] {
        let said = sandbox.refused(2, &[&["export", "ball.gyr"], arguments].concat()).stderr;
        assert!(said.contains(told) && said.contains("fix: give --format csv"), "{said}");
    }
}

#[test]
fn what_cannot_be_exported_is_refused() {
    let sandbox = recorded();
    let formats = ["csv", "npz", "vtk", "xyz", "gltf"];
    for format in formats {
        sandbox.refused(3, &["export", "nothing.gyr", "--format", format]);
        sandbox.refused(3, &["export", "ball.toml", "--format", format]);
        sandbox.refused(3, &["export", "ball.gyr", "--format", format, "-o", "no/such/folder"]);
    }
    for format in &formats[1..] {
        sandbox.refused(2, &["export", "ball.gyr", "--format", format, "-o", "-"]);
    }
    sandbox.refused(2, &["export", "ball.gyr", "--format", "gltf", "--every", "2"]);
    sandbox.refused(2, &["export", "ball.gyr", "--format", "vtk", "--every", "0"]);
    assert_eq!(sandbox.names(), ["ball.gyr", "ball.toml"]);
}

/// Times that are no numbers passed without a word, with pictures of other times.
#[test]
fn times_that_are_no_finite_numbers_are_refused() {
    let sandbox = recorded();
    for time in ["nan", "inf", "-inf", "1e999"] {
        for arguments in [
            ["export", "ball.gyr", "--format", "png", "--at", time],
            ["export", "ball.gyr", "--format", "gif", "--from", time],
            ["export", "ball.gyr", "--format", "mp4", "--to", time],
        ] {
            let said = sandbox.refused(2, &arguments).stderr;
            assert!(said.contains("no finite number") && said.contains(time), "{arguments:?}: {said}");
        }
        for end in ["--from", "--to"] {
            let said = sandbox.refused(2, &["plot", "ball.gyr", "energy", end, time]).stderr;
            assert!(said.contains("no finite number"), "{end} {time}: {said}");
        }
    }
    assert_eq!(sandbox.names(), ["ball.gyr", "ball.toml"]);
}

#[test]
fn failed_export_leaves_the_old_file_and_no_half_of_a_new_one() {
    let sandbox = recorded();
    for format in ["csv", "npz", "vtk", "xyz", "gltf"] {
        sandbox.done(&["export", "ball.gyr", "--format", format]);
    }
    let before = common::tree(&sandbox.path("."));
    let chunk = sandbox.path("ball.gyr/position/c.0.0.0");
    fs::write(&chunk, b"short").unwrap();
    for format in ["csv", "npz", "vtk", "xyz", "gltf"] {
        sandbox.refused(3, &["export", "ball.gyr", "--format", format]);
    }
    fs::write(&chunk, &before[chunk.strip_prefix(sandbox.path(".")).unwrap()]).unwrap();
    assert!(before == common::tree(&sandbox.path(".")));
}

#[test]
fn surfaces_for_paraview_are_listed_with_their_times() {
    let sandbox = recorded();
    let said = sandbox.done(&["export", "ball.gyr", "--format", "vtk", "--every", "25", "-o", "series.pvd"]);
    assert!(said.stderr.contains("4 samples of 1620 cells"), "{}", said.stderr);
    let list = fs::read_to_string(sandbox.path("series.pvd")).unwrap();
    let listed: Vec<&str> = list.lines().filter(|line| line.contains("part=\"0\"")).collect();
    // Every 25th of 61 samples, and the last.
    let expected = [("0e0", 0), ("2.5e-1", 25), ("5e-1", 50), ("6e-1", 60)];
    assert_eq!(listed.len(), expected.len());
    for (line, (time, row)) in listed.iter().zip(expected) {
        let file = format!("series-vtp/bodies-{row:06}.vtp");
        assert_eq!(*line, format!("<DataSet timestep=\"{time}\" part=\"0\" file=\"{file}\"/>"));
        assert!(fs::read(sandbox.path(&file)).unwrap().starts_with(b"<?xml"));
    }
    // A table that stands still has one file for all times.
    assert_eq!(list.matches("series-vtp/supports-000000.vtp").count(), 4);
    assert_eq!(fs::read_dir(sandbox.path("series-vtp")).unwrap().count(), 5);
}

#[test]
fn particles_have_the_numbers_of_the_table() {
    let sandbox = recorded();
    let said = sandbox.done(&["export", "ball.gyr", "--every", "25", "-o", "ball.xyz"]);
    assert!(said.stderr.contains("4 of 61 samples"), "{}", said.stderr);
    let table = sandbox.done(&["export", "ball.gyr", "--format", "csv", "-o", "-"]).stdout;
    let rows: Vec<Vec<f64>> =
        table.lines().skip(1).map(|line| line.split(',').map(|number| number.parse().unwrap()).collect()).collect();
    let text = fs::read_to_string(sandbox.path("ball.xyz")).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    let frames = lines.as_chunks::<3>().0;
    assert_eq!((frames.len(), lines.len()), (4, 12));
    for ([count, head, body], row) in frames.iter().zip([0, 25, 50, 60]) {
        let row = &rows[row];
        assert_eq!(*count, "1");
        assert!(head.starts_with("Properties=type:S:1:id:I:1:pos:R:3:velo:R:3:force:R:3:"), "{head}");
        assert!(head.ends_with(&format!(" Time={:e} pbc=\"F F F\"", row[0])), "{head}");
        let mut words = body.split(' ');
        assert_eq!([words.next(), words.next()], [Some("sphere"), Some("0")]);
        let numbers: Vec<f64> = words.map(|word| word.parse().unwrap()).collect();
        assert_eq!(numbers.len(), 30, "{body}");
        assert!((numbers[9] / 0.523_598_775_598_298_8 - 1.0).abs() < 1e-14, "{}", numbers[9]);
        assert_eq!(numbers[10..14], [0.05; 4]);
        // t, p₀, P, ṗ₀, Ṗ, gap, force.
        assert_eq!((&numbers[..3], &numbers[3..6], &numbers[6..9]), (&row[1..4], &row[13..16], &row[26..29]));
        // To the rounding of the quaternion that P was.
        let off = numbers[numbers.len() - 9..].iter().zip(&row[4..13]).map(|(a, b)| (a - b).abs());
        assert!(off.fold(0.0, f64::max) < 1e-15, "{body}");
    }
}

#[test]
fn a_series_replaces_an_earlier_one_and_nothing_else() {
    let sandbox = recorded();
    let export = ["export", "ball.gyr", "--format", "vtk"];
    sandbox.done(&export);
    let before = common::tree(&sandbox.path("ball-vtp"));
    sandbox.done(&["export", "ball.gyr", "--format", "vtk", "--every", "30"]);
    assert_eq!(common::tree(&sandbox.path("ball-vtp")).len(), 4);
    sandbox.done(&export);
    assert!(before == common::tree(&sandbox.path("ball-vtp")), "the same recording should give the same bytes");
    sandbox.write("ball-vtp/notes.txt", "mine");
    let said = sandbox.refused(2, &export);
    assert!(said.stderr.contains("notes.txt"), "{}", said.stderr);
    assert!(sandbox.path("ball-vtp/notes.txt").exists() && !sandbox.path("ball-vtp.part").exists());
}

#[test]
fn recordings_of_earlier_and_later_versions_are_told() {
    let sandbox = recorded();
    let metadata = sandbox.path("ball.gyr/zarr.json");
    // As a program that knows nothing of checksums writes it.
    let mut group: serde_json::Value = serde_json::from_slice(&fs::read(&metadata).unwrap()).unwrap();
    group["attributes"].as_object_mut().unwrap().remove("record_checksum").unwrap();
    let text = serde_json::to_string_pretty(&group).unwrap();
    fs::write(&metadata, text.replace("\"surface\":", "\"skin\":")).unwrap();
    let said = sandbox.refused(3, &["export", "ball.gyr", "--format", "gltf"]);
    assert!(said.stderr.contains("no surfaces") && said.stderr.contains("run its scene again"), "{}", said.stderr);
    // Surfaces come from the scene there.
    sandbox.done(&["export", "ball.gyr", "--format", "vtk", "--every", "60"]);
    fs::write(&metadata, text.replace("\"record_format\": 2", "\"record_format\": 3")).unwrap();
    for format in ["csv", "npz", "vtk", "gltf"] {
        let said = sandbox.refused(3, &["export", "ball.gyr", "--format", format]);
        assert!(said.stderr.contains("format 3"), "{}", said.stderr);
    }
    fs::write(&metadata, &text[..text.len() / 2]).unwrap();
    for format in ["csv", "npz", "vtk", "xyz", "gltf"] {
        sandbox.refused(3, &["export", "ball.gyr", "--format", format]);
    }
    fs::write(&metadata, text).unwrap();
    let points = sandbox.path("ball.gyr/surface_0_points/c.0.0");
    fs::write(&points, vec![0xff; fs::read(&points).unwrap().len()]).unwrap();
    let said = sandbox.refused(3, &["export", "ball.gyr", "--format", "gltf"]);
    assert!(said.stderr.contains("surface_0_points"), "{}", said.stderr);
}

#[test]
fn surfaces_of_a_recording_with_a_mesh_need_the_mesh_and_an_animation_does_not() {
    let sandbox = Sandbox::new();
    let shape = "{ sphere = { radius = \"5 cm\" } }";
    sandbox.write("ball.toml", &BALL.replace(shape, "{ mesh = { file = \"body.obj\" } }").replace("0.6", "0.01"));
    let mesh = "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
    sandbox.write("body.obj", mesh);
    sandbox.done(&["run", "ball.toml", "--quiet"]);
    sandbox.done(&["export", "ball.gyr", "--format", "vtk"]);
    fs::remove_file(sandbox.path("body.obj")).unwrap();
    let said = sandbox.refused(2, &["export", "ball.gyr", "--format", "vtk"]);
    assert!(said.stderr.contains("body.obj") && said.stderr.contains("gltf"), "{}", said.stderr);
    sandbox.done(&["export", "ball.gyr", "--format", "gltf"]);
}

#[cfg(unix)]
#[test]
fn export_goes_through_links_and_into_devices() {
    let sandbox = recorded();
    sandbox.done(&["export", "ball.gyr", "--format", "csv", "-o", "/dev/null"]);
    sandbox.write("real.csv", "");
    std::os::unix::fs::symlink("real.csv", sandbox.path("link.csv")).unwrap();
    sandbox.done(&["export", "ball.gyr", "--format", "csv", "-o", "link.csv"]);
    assert!(fs::read_to_string(sandbox.path("real.csv")).unwrap().starts_with("t,ball.x"));
    assert_eq!(sandbox.names(), ["ball.gyr", "ball.toml", "link.csv", "real.csv"]);
}

#[test]
fn laws_of_a_recording_with_a_mesh_need_the_same_mesh() {
    let sandbox = Sandbox::new();
    let tetrahedron =
        |size: f64| format!("v 0 0 0\nv {size} 0 0\nv 0 {size} 0\nv 0 0 {size}\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
    fs::create_dir(sandbox.path("scenes")).unwrap();
    let shape = "{ sphere = { radius = \"5 cm\" } }";
    let text = BALL.replace(shape, "{ mesh = { file = \"body.obj\" } }").replace("0.6", "0.01");
    sandbox.write("scenes/ball.toml", &text);
    sandbox.write("scenes/body.obj", &tetrahedron(0.1));
    sandbox.done(&["run", "scenes/ball.toml", "--quiet"]);
    let laws = ["plot", "ball.gyr", "laws"];
    let refused = || sandbox.refused(2, &laws);
    let said = refused();
    assert!(said.stderr.contains("body.obj") && said.stderr.contains("gyration plot SCENE laws"), "{}", said.stderr);
    // A mesh of that name that is another one must not be taken for it.
    sandbox.write("body.obj", &tetrahedron(0.05));
    assert!(refused().stderr.contains("has changed"));
    sandbox.write("body.obj", &tetrahedron(0.1));
    sandbox.done(&laws);
    sandbox.done(&["plot", "scenes/ball.toml", "laws"]);
    // Beside the scene the recording finds the mesh from anywhere.
    fs::remove_file(sandbox.path("body.obj")).unwrap();
    fs::rename(sandbox.path("ball.gyr"), sandbox.path("scenes/ball.gyr")).unwrap();
    sandbox.done(&["plot", "scenes/ball.gyr", "laws"]);
}

#[test]
fn another_table_of_places_is_told_by_whatever_builds_the_scene_again() {
    let sandbox = Sandbox::new();
    let grains = r#"
        time = { end = 0.05, sample = 0.01 }
        [[body]]
        name = "grain"
        shape = { sphere = { radius = 0.01 } }
        density = 1000
        copies = { places = "places.csv" }
    "#;
    let places = "x,y,z\n0,0,0\n1,0,0\n2,0,0\n";
    sandbox.write("grains.toml", grains);
    sandbox.write("places.csv", places);
    sandbox.done(&["run", "grains.toml", "--quiet"]);
    let again = [
        &["export", "grains.gyr", "--format", "vtk"][..],
        &["export", "grains.gyr", "--format", "xyz"],
        &["plot", "grains.gyr", "crowd"],
        &["fields", "grains.gyr", "--width", "1"],
        &["run", "grains.toml", "--resume"],
    ];
    for other in ["x,y,z\n0,0,0\n1,0,0\n3,0,0\n", "x,y,z\n0,0,0\n1,0,0\n2,0,0\n3,0,0\n"] {
        sandbox.write("places.csv", other);
        for arguments in again {
            let said = sandbox.refused(2, arguments).stderr;
            assert!(said.contains("places.csv") && said.contains("body.grain.copies.places"), "{arguments:?}: {said}");
            assert!(said.contains("has changed") && said.contains("put the file back"), "{arguments:?}: {said}");
        }
        // What needs no scene is written.
        sandbox.done(&["export", "grains.gyr", "--format", "csv", "-o", "-"]);
    }
    assert_eq!(sandbox.names(), ["grains.gyr", "grains.toml", "places.csv"]);
    sandbox.write("places.csv", places);
    again.iter().for_each(|arguments| _ = sandbox.done(arguments));
}

#[test]
fn films_and_pictures_are_written() {
    let sandbox = Sandbox::with_ball();
    sandbox.done(&["run", "ball.toml", "--quiet"]);
    let said = sandbox.done(&["export", "ball.gyr", "-o", "ball.gif"]).stderr;
    assert!(said.contains("pixels"), "{said}");
    let film = fs::read(sandbox.path("ball.gif")).unwrap();
    assert!(film.starts_with(b"GIF89a") && film.ends_with(&[0x3b]));
    // Of each picture its control block, with the delay.
    let delays: Vec<u16> = film
        .windows(8)
        .filter(|block| block.starts_with(&[0x21, 0xf9, 4]))
        .map(|block| u16::from_le_bytes([block[4], block[5]]))
        .collect();
    let lasts = f64::from(delays.iter().sum::<u16>()) / 100.0;
    assert!(delays.len() > 10 && said.contains(&format!("{lasts:.1} s")), "{delays:?}: {said}");
    let said = sandbox.done(&["export", "ball.gyr", "--format", "png", "--at", "0.101"]).stderr;
    assert!(
        said.contains("t = 0.1 s") && fs::read(sandbox.path("ball.png")).unwrap().starts_with(b"\x89PNG"),
        "{said}"
    );
    assert!(sandbox.refused(2, &["export", "ball.gyr", "--format", "gif", "--at", "0.1"]).stderr.contains("png only"));
    let without = sandbox.command(&["export", "ball.gyr", "-o", "ball.mp4"]).env("PATH", "").output().unwrap();
    let said = String::from_utf8_lossy(&without.stderr);
    assert!(without.status.code() == Some(2) && said.contains("ffmpeg") && said.contains("--format gif"), "{said}");
}

#[test]
fn closed_pipes_are_quiet() {
    let sandbox = Sandbox::with_ball();
    // More rows than a pipe holds.
    sandbox.done(&["run", "ball.toml", "--quiet", "--set", "time.sample=1e-4"]);
    for arguments in [&["export", "ball.gyr", "--format", "csv", "-o", "-"][..], &["schema"]] {
        let mut child = sandbox.command(arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let mut start = [0; 16];
        child.stdout.take().unwrap().read_exact(&mut start).unwrap();
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{arguments:?}");
        assert_eq!(output.stderr, b"", "{arguments:?}");
    }
}

#[test]
fn pictures_come_in_the_format_of_their_ending() {
    let sandbox = recorded();
    for (name, start) in [("a.svg", &b"<svg"[..]), ("a.png", b"\x89PNG\r\n\x1a\n"), ("a.pdf", b"%PDF-1.")] {
        let arguments = ["plot", "ball.gyr", "strip", "height", "gap", "energy", "forces", "laws", "-o", name];
        sandbox.done(&arguments);
        let first = fs::read(sandbox.path(name)).unwrap();
        assert!(first.starts_with(start), "{name}");
        sandbox.done(&arguments);
        assert!(first == fs::read(sandbox.path(name)).unwrap(), "{name} should have the same bytes again");
    }
    let svg = sandbox.done(&["plot", "ball.gyr", "height", "-o", "-"]).stdout;
    assert!(svg.starts_with("<svg") && svg.ends_with("</svg>\n"));
    sandbox.done(&["plot", "ball.gyr"]);
    sandbox.done(&["plot", "ball.toml"]);
    assert!(sandbox.path("ball-overview.svg").exists() && sandbox.path("ball-laws.svg").exists());
    let overview = fs::read(sandbox.path("ball.gyr/overview.svg")).unwrap();
    assert!(overview == fs::read(sandbox.path("ball-overview.svg")).unwrap());
}

#[test]
fn what_cannot_be_drawn_is_refused() {
    let sandbox = recorded();
    let said = sandbox.refused(2, &["plot", "ball.toml", "height"]);
    assert!(said.stderr.contains("gyration run"), "{}", said.stderr);
    sandbox.refused(2, &["plot", "ball.gyr", "-o", "ball.jpeg"]);
    sandbox.refused(3, &["plot", "nothing"]);
    fs::create_dir(sandbox.path("empty.gyr")).unwrap();
    sandbox.refused(3, &["plot", "empty.gyr"]);
    let without = BALL.split("[[contact]]").next().unwrap().to_owned()
        + "[[body]]\nname = \"p\"\nshape = { sphere = { radius = 1 } }\ndensity = 1\nposition = [0, 0, 2]\n";
    sandbox.write("free.toml", &without);
    sandbox.refused(2, &["plot", "free.toml", "laws"]);
}

#[test]
fn an_export_takes_no_name_of_another_format_and_none_of_the_recording() {
    let sandbox = recorded();
    for (format, name) in [("gltf", "a.gltf"), ("vtk", "a.vtp"), ("csv", "a.npz"), ("csv", "ball.gyr/zarr.json")] {
        let said = sandbox.refused(2, &["export", "ball.gyr", "--format", format, "-o", name]);
        assert!(said.stderr.contains("another format"), "{}", said.stderr);
    }
    let before = common::tree(&sandbox.path("ball.gyr"));
    for name in ["ball.gyr/position/c.0.0.0", "ball.gyr/state/checkpoint"] {
        let said = sandbox.refused(3, &["export", "ball.gyr", "--format", "csv", "-o", name]);
        assert!(said.stderr.contains("a part of a recording"), "{}", said.stderr);
    }
    assert!(before == common::tree(&sandbox.path("ball.gyr")), "a recording was written over");
    sandbox.done(&["export", "ball.gyr", "--format", "csv", "-o", "ball.txt"]);
    let [named, by_itself] = [&["--format", "csv", "-o", "-"][..], &["-o", "-"]]
        .map(|rest| sandbox.done(&[&["export", "ball.gyr"], rest].concat()).stdout);
    assert!(named == by_itself && named.starts_with("t,"), "{by_itself}");
}
