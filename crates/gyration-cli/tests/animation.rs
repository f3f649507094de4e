//! `gyration export --format gltf`: a file that a reader of the format accepts, and that moves as the recording does.
//!
//! The crate gltf, which refuses documents that the specification does not allow, reads it; what a player shows is
//! computed from its nodes and channels once more, without anything of the exporter.

use crate::common::Sandbox;
use gltf::animation::util::ReadOutputs;
use gyration_record::Recording;
use nalgebra::{Matrix3, Matrix4, Quaternion, UnitQuaternion, Vector3, Vector4};
use std::fs;

type Mat3 = Matrix3<f64>;
type Vec3 = Vector3<f64>;

/// A file and its numbers.
struct Animation {
    document: gltf::Document,
    bytes: Vec<u8>,
}

/// A property of a node at the keys.
enum Values {
    Vectors(Vec<Vec3>),
    Turns(Vec<UnitQuaternion<f64>>),
}

fn vector(v: [f32; 3]) -> Vec3 {
    Vec3::from(v.map(f64::from))
}

fn turn(q: [f32; 4]) -> UnitQuaternion<f64> {
    UnitQuaternion::new_normalize(Quaternion::from_vector(Vector4::from(q.map(f64::from))))
}

impl Animation {
    fn open(path: &std::path::Path) -> Self {
        let file = gltf::Gltf::from_slice(&fs::read(path).unwrap()).unwrap_or_else(|error| panic!("{error}"));
        Self { document: file.document, bytes: file.blob.unwrap() }
    }

    fn node(&self, name: &str) -> gltf::Node<'_> {
        self.document.nodes().find(|node| node.name() == Some(name)).unwrap_or_else(|| panic!("no node {name}"))
    }

    /// The keys of a property of a node, if it is animated.
    fn keys(&self, node: usize, property: gltf::animation::Property) -> Option<(Vec<f64>, Values)> {
        let animation = self.document.animations().next()?;
        let mut channels = animation.channels();
        let channel = channels.find(|it| it.target().node().index() == node && it.target().property() == property)?;
        assert_eq!(channel.sampler().interpolation(), gltf::animation::Interpolation::Linear);
        let reader = channel.reader(|_| Some(&self.bytes));
        let times: Vec<f64> = reader.read_inputs().unwrap().map(f64::from).collect();
        assert!(times.windows(2).all(|pair| pair[0] < pair[1]));
        let values = match reader.read_outputs().unwrap() {
            ReadOutputs::Translations(it) => Values::Vectors(it.map(vector).collect()),
            ReadOutputs::Scales(it) => Values::Vectors(it.map(vector).collect()),
            ReadOutputs::Rotations(it) => Values::Turns(it.into_f32().map(turn).collect()),
            ReadOutputs::MorphTargetWeights(_) => panic!("nothing is morphed"),
        };
        Some((times, values))
    }

    fn vector_at(&self, node: &gltf::Node, property: gltf::animation::Property, time: f64, rest: [f32; 3]) -> Vec3 {
        match self.keys(node.index(), property) {
            Some((times, Values::Vectors(values))) => {
                let (k, part) = place(&times, time);
                values[k].lerp(&values[(k + 1).min(values.len() - 1)], part)
            }
            _ => vector(rest),
        }
    }

    /// T R S of a node at a time: vectors are interpolated linearly, rotations on the sphere.
    fn local(&self, node: &gltf::Node, time: f64) -> Matrix4<f64> {
        use gltf::animation::Property::{Rotation, Scale, Translation};
        let (translation, rotation, scale) = node.transform().decomposed();
        let rotation = match self.keys(node.index(), Rotation) {
            Some((times, Values::Turns(values))) => {
                let (k, part) = place(&times, time);
                values[k].slerp(&values[(k + 1).min(values.len() - 1)], part)
            }
            _ => turn(rotation),
        };
        let translation = self.vector_at(node, Translation, time, translation);
        let scale = self.vector_at(node, Scale, time, scale);
        Matrix4::new_translation(&translation) * rotation.to_homogeneous() * Matrix4::new_nonuniform_scaling(&scale)
    }

    /// Where the mesh of a body is at a time, in the axes of the scene file.
    fn placement(&self, name: &str, time: f64) -> (Vec3, Mat3) {
        let outer = self.node(name);
        let mut matrix = self.local(&self.node("scene, y up"), time) * self.local(&outer, time);
        if let Some(inner) = outer.children().next() {
            matrix *= self.local(&inner, time);
        }
        // y up again to z up: x, −z, y.
        let back = Mat3::new(1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0);
        (back * matrix.fixed_view::<3, 1>(0, 3), back * matrix.fixed_view::<3, 3>(0, 0))
    }
}

/// The key before a time, and the part of the way to the next.
fn place(times: &[f64], time: f64) -> (usize, f64) {
    let after = times.iter().position(|key| *key > time).unwrap_or(times.len());
    match after {
        0 => (0, 0.0),
        after if after == times.len() => (after - 1, 0.0),
        after => (after - 1, (time - times[after - 1]) / (times[after] - times[after - 1])),
    }
}

/// p₀ and P of the first body at every sample.
fn recorded(recording: &Recording) -> (Vec<f64>, Vec<(Vec3, Mat3)>) {
    let positions = recording.read("position").unwrap();
    let gradients = recording.read("placement_gradient").unwrap();
    let bodies = positions.shape[1];
    let poses = (0..recording.rows()).map(|row| {
        let place = row * bodies;
        (
            Vec3::from_column_slice(&positions.data[3 * place..][..3]),
            Mat3::from_row_slice(&gradients.data[9 * place..][..9]),
        )
    });
    (recording.times().unwrap(), poses.collect())
}

/// Exports a gallery scene, and compares what is shown at and between the samples.
fn check(scene: &str, body: &str, end: &str) {
    let sandbox = Sandbox::new();
    sandbox.done(&["run", scene, "-o", "run.gyr", "--quiet", "--set", &format!("time.end={end}")]);
    sandbox.done(&["export", "run.gyr", "--format", "gltf"]);
    let animation = Animation::open(&sandbox.path("run.glb"));
    let (times, poses) = recorded(&Recording::open(&sandbox.path("run.gyr")).unwrap());
    assert!(times.len() < 280, "{scene}: all samples should be keys");
    let (mut at_keys, mut between) = (0.0_f64, 0.0_f64);
    for (time, (position, gradient)) in times.iter().zip(&poses) {
        let (shown_position, shown) = animation.placement(body, f64::from(*time as f32));
        at_keys = at_keys.max((shown - gradient).norm() / gradient.norm());
        at_keys = at_keys.max((shown_position - position).norm() / (1.0 + position.norm()));
    }
    for (pair, pose) in times.windows(2).zip(poses.windows(2)) {
        let (_, shown) = animation.placement(body, 0.5 * (pair[0] + pair[1]));
        let change = (pose[1].1 - pose[0].1).norm();
        // From either neighbour no further than they are from each other, and half of that if the way is straight.
        for (_, neighbour) in pose {
            let excess = (shown - neighbour).norm() - 0.55 * change;
            between = between.max(excess / neighbour.norm());
        }
    }
    println!("{scene}: {at_keys:.1e} at keys, {between:.1e} more than half-way between");
    // Numbers of single precision: four roundings of 6e-8, and the key times'.
    assert!(at_keys < 1e-6, "{scene}: {at_keys:e}");
    assert!(between < 2e-3, "{scene}: {between:e}");
}

#[test]
fn a_rigid_body_moves_as_recorded() {
    check("dice", "die", "0.8");
}

#[test]
fn bodies_that_deform_move_as_recorded_through_crossings_of_their_stretches() {
    check("elastic-bounce-tilted", "egg", "0.5");
    check("hop", "block", "0.8");
    check("crawl", "block", "0.8");
}

#[test]
fn supports_move_and_bodies_have_names_normals_and_colours() {
    let sandbox = Sandbox::new();
    sandbox.done(&["run", "shaker", "-o", "run.gyr", "--quiet", "--set", "time.end=0.2"]);
    let said = sandbox.done(&["export", "run.gyr", "--format", "gltf", "-o", "out.glb"]);
    assert!(said.stderr.contains("wrote out.glb (101 of 101 samples)"), "{}", said.stderr);
    let animation = Animation::open(&sandbox.path("out.glb"));
    let table = animation.node("table");
    let (times, places) = animation.keys(table.index(), gltf::animation::Property::Translation).unwrap();
    let Values::Vectors(places) = places else { panic!("translations are vectors") };
    for (time, place) in times.iter().zip(places) {
        let expected = 3.23e-3 * (std::f64::consts::TAU * 10.0 * time - 145_f64.to_radians()).sin();
        assert!((place.z - expected).abs() < 1e-8, "{time}: {} {expected}", place.z);
    }
    let mesh = animation.node("ball").mesh().unwrap();
    let primitive = mesh.primitives().next().unwrap();
    let reader = primitive.reader(|_| Some(&animation.bytes));
    let normals = reader.read_normals().unwrap();
    for (position, normal) in reader.read_positions().unwrap().zip(normals) {
        assert!((vector(position).norm() - 0.01).abs() < 1e-8);
        assert!(vector(position).normalize().dot(&vector(normal)) > 0.999);
    }
    let color = primitive.material().pbr_metallic_roughness().base_color_factor();
    assert!(color[2] > color[0] && color[3] == 1.0, "{color:?}");
    assert_eq!(animation.document.scenes().next().unwrap().name(), Some("A ball on a shaken table bounces in step"));
}

#[test]
fn long_recordings_are_thinned() {
    let sandbox = Sandbox::with_ball();
    sandbox.done(&["run", "ball.toml", "--quiet", "--set", "time.sample=1e-4"]);
    sandbox.done(&["export", "ball.gyr", "--format", "gltf"]);
    let animation = Animation::open(&sandbox.path("ball.glb"));
    let ball = animation.node("ball").index();
    let (times, _) = animation.keys(ball, gltf::animation::Property::Translation).unwrap();
    // 300 of 6,001, and a few where it bounces between two of them.
    assert!((290..=320).contains(&times.len()), "{}", times.len());
    assert!((times[times.len() - 1] - 0.6).abs() < 1e-7 && times[0] == 0.0);
}

#[test]
fn places_far_from_the_origin_are_told_from_a_point_among_the_bodies() {
    let sandbox = Sandbox::new();
    let scene = |x: f64, other: f64| {
        format!(
            "time = {{ end = 0.2, sample = 0.01 }}\n[[support]]\nname = \"ground\"\nplane = {{ origin = [0, 0, -1] }}\n\
             [[body]]\nname = \"ball\"\ndensity = 1000\nshape = {{ sphere = {{ radius = 1e-3 }} }}\n\
             position = [{x:?}, 0, 0]\nvelocity = [0.1, 0, 0]\n[[body]]\nname = \"box\"\ndensity = 1000\n\
             shape = {{ box = {{ size = [0.01, 0.01, 0.01] }} }}\nposition = [{other:?}, 0.05, 0]\n"
        )
    };
    // About the origin numbers are as large from anywhere.
    let cases =
        [(6.4e6, 6.4e6, "(6400000."), (-1000.0, -1000.0, "(-999.99"), (1.0, 1.0, ""), (-1000.0, 1000.0 - 0.02, "")];
    for (x, other, from) in cases {
        fs::write(sandbox.path("far.toml"), scene(x, other)).unwrap();
        sandbox.done(&["run", "far.toml", "--quiet", "--force"]);
        let said = sandbox.done(&["export", "far.gyr", "--format", "gltf"]).stderr;
        assert_eq!(said.contains("places from"), !from.is_empty(), "{said}");
        assert!(said.contains(from), "{said}");
        let animation = Animation::open(&sandbox.path("far.glb"));
        // The first chunk, behind a head of twenty bytes, is the document.
        let bytes = fs::read(sandbox.path("far.glb")).unwrap();
        let length = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
        let document: serde_json::Value = serde_json::from_slice(&bytes[20..20 + length]).unwrap();
        let origin = document["asset"]["extras"]["origin"][0].as_f64().unwrap_or_default();
        let ball = animation.node("ball").index();
        let (times, values) = animation.keys(ball, gltf::animation::Property::Translation).unwrap();
        let Values::Vectors(places) = values else { panic!("places") };
        for (time, place) in times.iter().zip(places) {
            let error = place.x + origin - (x + 0.1 * time);
            let rounding = 1e-8 + 6e-8 * (x - origin).abs() + 1e-15 * x.abs();
            assert!(error.abs() < rounding, "{x} {time} {error:e}");
        }
    }
}
