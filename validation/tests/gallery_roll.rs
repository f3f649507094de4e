//! The gallery's `roll`: a cylinder rolls straight down the line of fall, with two thirds of g sin θ.
//!
//! Friction linear in the slip gives no rolling without slip: it bears m g sin θ/3 with the slip v_s = (α/β) tan θ/3,
//! as ν_f = ν: at the height ⟨h⟩ = d/(2ν − 3) of the forces over the lowest line, where the surface is faster by ω⟨h⟩
//! than there. Damping resists the rolling: the field before the line of contact is pressed, that behind is released.

use gyration::tensor::Vec3;
use gyration_validation::{Answer, Experiment, largest};

const CASE: &str = "gallery: roll";
const RADIUS: f64 = 0.03;
const FRICTION: f64 = 3e5 / 14.6e3;
/// ⟨h⟩ of a cylinder with ν = 6 at its rest gap of 0.1 mm [m].
const HEIGHT: f64 = 1e-4 / 9.0;
const SLIP: &str = "(α/β) tan θ/3 − ω⟨h⟩, ⟨h⟩ = d/(2ν−3)";

fn slope() -> f64 {
    5.0_f64.to_radians()
}

/// The line of fall, the horizontal line across it, the normal.
fn axes() -> [Vec3; 3] {
    let (sin, cos) = slope().sin_cos();
    let (across, along) = 30.0_f64.to_radians().sin_cos();
    [
        Vec3::new(cos * along, cos * across, -sin),
        Vec3::new(-across, along, 0.0),
        Vec3::new(sin * along, sin * across, cos),
    ]
}

fn answer(
    case: &'static str,
    quantity: &'static str,
    reference: f64,
    measured: f64,
    tolerance: f64,
    source: &'static str,
) {
    Answer { row: None, case, quantity, reference, measured, tolerance, source }.check();
}

#[test]
fn cylinder_rolls_with_two_thirds_of_the_acceleration_of_sliding() {
    let [fall, across, _] = axes();
    let full = 9.81 * slope().sin();
    let slip = slope().tan() / (3.0 * FRICTION);
    let cases = [
        ("gallery: roll, no damping", Experiment::of_gallery("roll", &["contact.0.damping.beta=0"]), 1e-3),
        // Damping takes more the faster it rolls: 0.2 % of the acceleration between 1 s and 2 s.
        (CASE, Experiment::of_gallery("roll", &[]), 1e-2),
    ];
    for (case, experiment, tolerance) in cases {
        let [early, late] = [1.0, 2.0].map(|time| experiment.motion_at(time));
        let gained = (late.velocity.velocity - early.velocity.velocity).dot(&fall);
        answer(case, "acceleration over g sin θ", 2.0 / 3.0, gained / full, tolerance, "1/(1 + I/(mR²))");
        let surface = late.angular_velocity().dot(&across) * RADIUS;
        let measured = late.velocity.velocity.dot(&fall) - surface;
        // The rest gap is 0.1 mm to a thousandth; damping presses the field before the line of contact.
        answer(case, "slip of the lowest line [m/s]", slip - surface * HEIGHT / RADIUS, measured, 2e-2, SLIP);
    }
}

#[test]
fn cylinder_does_not_drift_off_its_line() {
    let [_, across, _] = axes();
    // The samples of the last step, and the sharper ones of tighter steps, tell the drift of rounding from one of
    // physics.
    for (case, rtol) in [(CASE, "solver.rtol=1e-8"), ("gallery: roll, rtol = 1e-5", "solver.rtol=1e-5")] {
        let run = Experiment::of_gallery("roll", &[rtol]).run();
        let columns = ["cylinder.x", "cylinder.y"].map(|name| run.column(name));
        let drift = largest((0..run.times.len()).map(|k| across.x * columns[0][k] + across.y * columns[1][k]));
        let way = columns[0][run.times.len() - 1].hypot(columns[1][run.times.len() - 1]);
        assert!(way > 1.0, "{way}");
        // Nothing but rounding: the way is 1.1 m.
        answer(case, "largest distance from its line on a way of 1.1 m [m]", 0.0, drift, 1e-12, "symmetry");
    }
}

#[test]
fn ball_thrown_obliquely_keeps_to_its_line() {
    // Level, 37 degrees off the x axis, sliding at first: the ball of `bounce` rolls on after its throw.
    let throw = ["body.ball.velocity=[0.24, 0.18, 0]", "body.ball.position=[0, 0, 0.052]", "time.end=3"];
    let run = Experiment::of_gallery("bounce", &throw).run();
    let [x, y] = ["ball.x", "ball.y"].map(|name| run.column(name));
    let drift = largest(x.iter().zip(&y).map(|(x, y)| 0.8 * y - 0.6 * x));
    assert!(x[x.len() - 1] > 0.3);
    // The tolerance of a step is 1e-9 of the gap.
    answer("ball of bounce on the level", "largest distance from its line [m]", 0.0, drift, 1e-10, "symmetry");
}
