//! Where links, centres of mass, geometry and axes are in space, against products of 4×4 matrices written here.

use crate::{imported, opened};
use gyration::shape::Shape;
use gyration::tensor::{Mat3, Vec3};
use gyration_scene::Scene;
use nalgebra::{Matrix4, Vector4};

/// A link: where its joint is on the one before it, its axis, its inertia and its geometry, each frame as xyz and rpy.
struct Written {
    joint: ([f64; 3], [f64; 3]),
    kind: &'static str,
    axis: [f64; 3],
    inertial: ([f64; 3], [f64; 3]),
    mass: f64,
    /// xx, xy, xz, yy, yz, zz.
    inertia: [f64; 6],
    geometry: ([f64; 3], [f64; 3]),
}

const LINKS: [Written; 4] = [
    Written {
        joint: ([0.1, -0.2, 0.3], [0.3, -0.4, 0.5]),
        kind: "revolute",
        axis: [0.0, 0.6, 0.8],
        inertial: ([0.05, 0.02, -0.1], [0.7, 0.1, -0.2]),
        mass: 2.0,
        inertia: [0.03, 0.001, -0.002, 0.04, 0.003, 0.05],
        geometry: ([0.01, 0.02, 0.03], [0.4, 0.5, 0.6]),
    },
    Written {
        joint: ([0.0, 0.4, 0.1], [-1.1, 0.2, 0.9]),
        kind: "prismatic",
        axis: [1.0, 2.0, -2.0],
        inertial: ([-0.03, 0.1, 0.04], [0.1, -0.6, 0.3]),
        mass: 1.5,
        inertia: [0.02, 0.0, 0.001, 0.025, -0.002, 0.03],
        geometry: ([0.0, 0.1, 0.0], [0.0, 1.2, -0.3]),
    },
    Written {
        joint: ([0.3, 0.0, -0.2], [2.0, -0.3, 0.1]),
        kind: "continuous",
        axis: [1.0, 0.0, 0.0],
        inertial: ([0.0, 0.0, 0.15], [-0.4, 0.8, 1.5]),
        mass: 0.8,
        inertia: [0.011, 0.0005, 0.0, 0.012, 0.0, 0.009],
        geometry: ([0.02, -0.01, 0.1], [1.0, 0.0, 0.5]),
    },
    Written {
        joint: ([-0.1, 0.2, 0.25], [0.2, 0.9, -2.5]),
        kind: "fixed",
        axis: [0.0, 0.0, 1.0],
        inertial: ([0.01, 0.03, 0.02], [0.3, 0.3, 0.3]),
        mass: 0.3,
        inertia: [0.002, 0.0, 0.0, 0.003, 0.0001, 0.0025],
        geometry: ([0.0, 0.0, 0.05], [-0.7, 0.2, 0.1]),
    },
];
const NAMES: [&str; 4] = ["one", "two", "three", "four"];

fn told(numbers: &[f64]) -> String {
    numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(" ")
}

fn urdf() -> String {
    let mut text = "<robot name=\"arm\"><link name=\"world\"/>\n".to_owned();
    for (k, link) in LINKS.iter().enumerate() {
        let (name, parent) = (NAMES[k], if k == 0 { "world" } else { NAMES[k - 1] });
        let origin =
            |(xyz, rpy): ([f64; 3], [f64; 3])| format!("<origin xyz=\"{}\" rpy=\"{}\"/>", told(&xyz), told(&rpy));
        let [xx, xy, xz, yy, yz, zz] = link.inertia;
        text += &format!(
            "<joint name=\"to-{name}\" type=\"{}\"><parent link=\"{parent}\"/><child link=\"{name}\"/>{}\
             <axis xyz=\"{}\"/><limit lower=\"-1\" upper=\"2\"/></joint>\n\
             <link name=\"{name}\"><inertial>{}<mass value=\"{}\"/><inertia ixx=\"{xx}\" ixy=\"{xy}\" ixz=\"{xz}\" \
             iyy=\"{yy}\" iyz=\"{yz}\" izz=\"{zz}\"/></inertial>\n\
             <collision>{}<geometry><box size=\"0.1 0.2 0.3\"/></geometry></collision></link>\n",
            link.kind,
            origin(link.joint),
            told(&link.axis),
            origin(link.inertial),
            link.mass,
            origin(link.geometry),
        );
    }
    text + "</robot>"
}

/// The matrix of a frame by the nine products of sines and cosines.
fn frame((xyz, rpy): ([f64; 3], [f64; 3])) -> Matrix4<f64> {
    let [(sr, cr), (sp, cp), (sy, cy)] = rpy.map(f64::sin_cos);
    let [x, y, z] = xyz;
    #[rustfmt::skip]
    let matrix = Matrix4::new(
        cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr, x,
        sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr, y,
        -sp, cp * sr, cp * cr, z,
        0.0, 0.0, 0.0, 1.0,
    );
    matrix
}

fn place(frame: &Matrix4<f64>) -> Vec3 {
    frame.fixed_view::<3, 1>(0, 3).into_owned()
}

fn axes(frame: &Matrix4<f64>) -> Mat3 {
    frame.fixed_view::<3, 3>(0, 0).into_owned()
}

/// The frames of the links in space.
fn links() -> Vec<Matrix4<f64>> {
    let mut frames = Vec::new();
    let mut outer = Matrix4::identity();
    for link in &LINKS {
        outer *= frame(link.joint);
        frames.push(outer);
    }
    frames
}

fn close(one: &Vec3, other: &Vec3) {
    assert!((one - other).norm() < 1e-14, "{one} {other}");
}

fn placement(scene: &Scene, body: usize) -> (Vec3, Mat3) {
    let built = scene.built();
    let placement = built.state.motion(&built.model, body).placement;
    (placement.position, placement.gradient)
}

#[test]
fn links_of_an_arm_are_where_forward_kinematics_has_them() {
    let import = imported(&urdf());
    let scene = opened(&import);
    let model = &scene.built().model;
    assert_eq!(model.bodies.len(), 4);
    for (k, (link, outer)) in LINKS.iter().zip(links()).enumerate() {
        assert_eq!(model.name(k), NAMES[k]);
        let (position, gradient) = placement(&scene, k);
        let inertial = outer * frame(link.inertial);
        close(&position, &place(&inertial));
        // The inertia tensor in space.
        let [xx, xy, xz, yy, yz, zz] = link.inertia;
        let own = Mat3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
        let expected = axes(&inertial) * own * axes(&inertial).transpose();
        let mass = &model.bodies[k].solid.mass;
        let found = gradient * mass.inertia() * gradient.transpose();
        assert!((found - expected).norm() < 1e-15, "{k}: {found} {expected}");
        assert_eq!(mass.mass, link.mass);
        // The box in space.
        let Shape::Union(union) = &model.bodies[k].solid.shape else { panic!("{:?}", model.bodies[k].solid.shape) };
        let geometry = outer * frame(link.geometry);
        close(&(position + gradient * (union.parts[0].offset - mass.center)), &place(&geometry));
        let turned = gradient * union.parts[0].rotation;
        assert!((turned - axes(&geometry)).norm() < 1e-14, "{turned} {geometry}");
    }
}

#[test]
fn joints_of_an_arm_stand_where_their_frames_do() {
    let import = imported(&urdf());
    let scene = opened(&import);
    let file = scene.file();
    assert_eq!(file.joint.len(), 4);
    for (k, (link, outer)) in LINKS.iter().zip(links()).enumerate() {
        let joint = &file.joint[k];
        let parent = if k == 0 { "space" } else { NAMES[k - 1] };
        assert_eq!(joint.between, [parent.to_owned(), NAMES[k].to_owned()]);
        let vector = |point: &[gyration_scene::quantity::Length; 3]| Vec3::from(point.map(|entry| entry.0));
        let (before, after) =
            (if k == 0 { (Vec3::zeros(), Mat3::identity()) } else { placement(&scene, k - 1) }, placement(&scene, k));
        for ((position, gradient), point) in [before, after].iter().zip(&joint.points) {
            close(&(position + gradient * vector(point)), &place(&outer));
        }
        let Some(axis) = joint.axis else {
            assert_eq!(link.kind, "fixed");
            continue;
        };
        let [x, y, z] = link.axis;
        let expected = (outer * Vector4::new(x, y, z, 0.0)).xyz().normalize();
        close(&(before.1 * Vec3::from(axis)), &expected);
        // Coordinates of the scene are those of the file.
        let limits = joint.limits.map(|limits| limits.map(|limit| limit.0));
        assert_eq!(limits, (link.kind != "continuous").then_some([-1.0, 2.0]), "{}", link.kind);
    }
}

#[test]
fn links_keep_their_axes_where_the_angle_of_the_hinge_is_zero_in_them() {
    let of = |rpy: &str| {
        let link = "<inertial><mass value=\"1\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"1\"/></inertial>";
        let import = imported(&format!(
            "<robot name=\"r\"><link name=\"world\"/><link name=\"a\">{link}</link>\
             <joint name=\"j\" type=\"continuous\"><parent link=\"world\"/><child link=\"a\"/>\
             <origin rpy=\"{rpy}\"/><axis xyz=\"0 0 1\"/></joint></robot>"
        ));
        placement(&opened(&import), 0).1
    };
    // Tilted as most robots have it: the axes are those of the link.
    assert!((of("1.5 0 0") - axes(&frame(([0.0; 3], [1.5, 0.0, 0.0])))).norm() < 1e-15);
    // Turned about the axis, or turned over: those of the body before it, so that the angle is zero.
    assert_eq!(of("0 0 1.5"), Mat3::identity());
    assert_eq!(of(&format!("{:?} 0 0", std::f64::consts::PI)), Mat3::identity());
}
