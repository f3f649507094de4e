//! Motion that is kept to an axis, a line, a plane or strain without rotation, against closed forms and against bodies
//! that stay there by symmetry.

use crate::soft::{self, size};
use gyration::tensor::{Mat3, Vec3, cross_matrix};
use gyration_scene::Recorded;
use gyration_validation::{Case, Experiment, largest};
use std::f64::consts::PI;

const GRAVITY: f64 = 9.81;
const TIGHT: &str = "solver = { rtol = 1e-11, atol = 1e-13 }\n";

/// The period 4 √(I/(mgl)) K(sin θ₀/2) [s], with K by the arithmetic-geometric mean.
fn pendulum(inertia: f64, moment: f64, amplitude: f64) -> f64 {
    let (mut a, mut b) = (1.0, (0.5 * amplitude).cos());
    for _ in 0..40 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    2.0 * PI * (inertia / moment).sqrt() / a
}

#[test]
fn a_box_on_a_hinge_is_a_physical_pendulum() {
    const SOURCE: &str = "T = 4√(I/(mgl)) K(sin θ₀/2)";
    let case = Case { row: None, name: "box pinned 0.3 m off, kept to a skew axis", source: SOURCE };
    // The axis is none of the principal ones: the reaction takes what the products of inertia would turn.
    let (size, amplitude, arm) = ([0.1_f64, 0.24, 0.4], 2.0, 0.3);
    let axis = Vec3::new(0.6, 0.8, 0.0);
    let scene = format!(
        "time = {{ end = 1, sample = 0.01 }}\n{TIGHT}[[body]]\nname = \"box\"\n\
         shape = {{ box = {{ size = {size:?} }} }}\nmass = 3\npin = [0, 0, {arm}]\nkeep = {{ axis = [3, 4, 0] }}\n\
         orientation = {{ axis_angle = {{ axis = [3, 4, 0], angle = {amplitude} }} }}\n"
    );
    let [x, y, z] = size.map(|side| side * side / 12.0);
    let inertia = 3.0 * (axis.x * axis.x * (y + z) + axis.y * axis.y * (x + z) + arm * arm);
    let moment = 3.0 * GRAVITY * arm;
    let reference = pendulum(inertia, moment, amplitude);
    let pinned = Experiment::of_scene(&scene);
    let run = pinned.until(reference).run();
    let motion = run.end.motion(&pinned.model, 0);
    // There θ̇ ≈ θ̈ (t − T), with θ̈ = −(mgl/I) sin θ₀.
    let rate = motion.angular_velocity().dot(&axis);
    case.check("period at 2 rad [s]", reference, reference + rate * inertia / (moment * amplitude.sin()), 1e-9);
    let long = Experiment::of_scene(&scene.replace("end = 1,", "end = 60,")).sampled(0.5).run();
    let off = long.matrices("placement_gradient").into_iter().map(|p| (p * axis - axis).norm());
    case.by("the axis stands still").check("largest move of the axis over 60 s", 0.0, largest(off), 1e-14);
    case.by("the ledger").check("residual over the energy in play", 0.0, long.relative_residual(), 1e-8);
    let free = Experiment::of_scene(&scene.replace("keep", "# keep")).until(reference).run();
    let apart = (free.end.motion(&pinned.model, 0).placement.gradient * axis - axis).norm();
    assert!(apart > 1e-2, "without the hinge the axis is to leave: {apart}");
}

#[test]
fn a_bead_slides_down_a_line_and_tumbles_freely() {
    let case = Case { row: None, name: "box on a tilted line", source: "s = ½ (g·e) t², r = −m (g − (g·e) e)" };
    let experiment = Experiment::of_scene(&format!(
        "time = {{ end = 3, sample = 0.5 }}\n{TIGHT}[[body]]\nname = \"bead\"\nmass = 2\n\
         shape = {{ box = {{ size = [0.1, 0.2, 0.37] }} }}\nposition = [1, 2, 3]\nangular_velocity = [4, -3, 2]\n\
         keep = {{ line = [2, 1, -2] }}\n"
    ));
    let run = experiment.recording([Recorded::ConstraintForce, Recorded::ConstraintMoment]).run();
    let (line, gravity) = (Vec3::new(2.0, 1.0, -2.0) / 3.0, Vec3::new(0.0, 0.0, -GRAVITY));
    let along = gravity.dot(&line);
    let way = run.end.motion(&experiment.model, 0).placement.position - Vec3::new(1.0, 2.0, 3.0);
    case.check("way along the line after 3 s [m]", 4.5 * along, way.dot(&line), 1e-11);
    case.check("way off the line after 3 s [m]", 0.0, (way - line * line.dot(&way)).norm(), 1e-14);
    let held = -2.0 * (gravity - along * line);
    let error = largest(run.vectors_of(0, "constraint_force").iter().map(|force| (force - held).norm()));
    case.check("largest error of the reaction [N]", 0.0, error, 1e-13);
    let moment = largest(run.matrices("constraint_moment").iter().map(size));
    assert!(moment == 0.0, "the line leaves the turn alone: {moment}");
    let spin = run.vectors_of(0, "angular_momentum");
    let own = |k: usize| {
        let (centre, momentum) = (run.vectors_of(0, "position")[k], run.vectors_of(0, "linear_momentum")[k]);
        spin[k] - centre.cross(&momentum)
    };
    let change = (own(6) - own(0)).norm() / own(0).norm();
    case.by("no torque").check("change of the own angular momentum, relative", 0.0, change, 1e-9);
    case.by("the ledger").check("residual over the energy in play", 0.0, run.relative_residual(), 1e-10);
}

#[test]
fn strain_without_rotation_rings_as_if_no_couple_turned_it() {
    let case = Case { row: None, name: "rubber sphere, stretch_only", source: "N_c = −N; the oscillation of row 8" };
    // N = ν [e_z]×: on P = diag(a, a, l) it turns alone, and the reaction is −N.
    let couple = 0.5 * cross_matrix(&Vec3::z());
    let narrow = 2.0_f64.powf(-0.5);
    let stretched = Mat3::from_diagonal(&Vec3::new(narrow, narrow, 2.0));
    let ball = |more: &str, keep: &str| {
        let affine = format!("{}{more}", soft::RUBBER);
        let body = soft::body(soft::BALL, &affine, &stretched, &Mat3::zeros());
        soft::alone(&format!("{body}{keep}"), (1e-11, 1e-13))
    };
    let value = ", couple = { value = [[0, -0.5, 0], [0.5, 0, 0], [0, 0, 0]] }";
    let free = ball("", "").run();
    let kept = ball(value, "keep = { stretch_only = true }\n").sampled(0.1);
    let run = kept.recording([Recorded::ConstraintMoment, Recorded::CauchyStress]).run();
    let error = largest(run.matrices("constraint_moment").iter().map(|found| size(&(found + couple))));
    case.check("largest error of the reaction over 1 s [N m]", 0.0, error, 1e-10);
    let gradient = |run: &gyration_validation::Run| *run.matrices("placement_gradient").last().unwrap();
    case.check("l after 1 s", gradient(&free).m33, gradient(&run).m33, 1e-8);
    let skew = largest(run.matrices("placement_gradient").iter().map(|p| size(&(p - p.transpose()))));
    case.check("largest skew part of P", 0.0, skew, 1e-14);
    case.by("the ledger").check("residual over the energy in play", 0.0, run.relative_residual(), 1e-9);
    let volume = largest(run.matrices("placement_gradient").iter().map(|p| p.determinant() - 1.0));
    case.by("det P = 1").check("largest change of the volume", 0.0, volume, 1e-14);
}

#[test]
fn a_block_that_is_kept_to_its_plane_rocks_as_by_symmetry() {
    let case =
        Case { row: None, name: "rocking block in an oblique plane", source: "the run without `keep`, by symmetry" };
    let turned = |angle: &str| format!("body.block.orientation={{ quaternion = {angle} }}");
    // 10 degrees about e_y, then 30 degrees about the vertical.
    let (tilt, turn) = (PI / 36.0, PI / 12.0);
    let straight = [tilt.cos(), 0.0, tilt.sin(), 0.0];
    let oblique = [turn.cos() * tilt.cos(), -turn.sin() * tilt.sin(), turn.cos() * tilt.sin(), turn.sin() * tilt.cos()];
    let quick = ["time.end=0.7", "time.sample=0.1", "solver.rtol=1e-10", "solver.atol=1e-12"];
    let run = |more: &[String]| {
        let settings: Vec<&str> = quick.iter().copied().chain(more.iter().map(String::as_str)).collect();
        Experiment::of_gallery("rocking-block", &settings).run()
    };
    let free = run(&[turned(&format!("{straight:?}"))]);
    let normal = Vec3::new(-0.5, 0.75_f64.sqrt(), 0.0);
    let keep = format!("body.block.keep={{ plane = [{:?}, {:?}, 0] }}", normal.x, normal.y);
    let kept = run(&[turned(&format!("{oblique:?}")), keep]);
    let about = gyration::kinematics::Quaternion::from_axis_angle(&Vec3::z(), 2.0 * turn).rotation();
    let [from, found] = [&free, &kept].map(|run| run.matrices("placement_gradient"));
    let apart = largest(from.iter().zip(&found).map(|(free, kept)| size(&(about * free - kept))));
    case.check("largest difference of P over 0.7 s", 0.0, apart, 1e-7);
    let off = largest(kept.vectors_of(0, "position").iter().map(|place| place.dot(&normal)));
    case.by("n·p₀ stays").check("largest way off the plane [m]", 0.0, off, 1e-15);
    case.by("the ledger").check("residual over the energy in play", 0.0, kept.relative_residual(), 1e-7);
}
