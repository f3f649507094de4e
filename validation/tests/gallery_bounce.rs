//! The gallery's `bounce`, `bounce-flat` and `bounce-tilted` behave as their names say.
//!
//!   a ball with ν_d = ν − 2:  every bounce returns the same part of the speed, since closest gap and speed go together as
//!                             d ∝ v^(−2/(ν−2)), and damping over repulsion as v d^(ν−ν_d)
//!   a flat block with ν_d = ν:  x − ln(1+x) = −y − ln(1−y), x = βv_in/α, y = βv_out/α
//!   a corner that strikes, without loss:  impulse p = 2v/(1/m + (r×n)·I⁻¹(r×n)), spin I⁻¹(r×n) p

use gyration::body::BodyKind;
use gyration::tensor::Vec3;
use gyration_validation::{Answer, Experiment, largest};

const GRAVITY: f64 = 9.81;

/// Heights above a level at the apexes, the start first.
fn apexes(experiment: &Experiment, level: f64, count: usize) -> Vec<f64> {
    let run = experiment.run();
    let times: Vec<f64> = run.times_of("apex").into_iter().take(count).collect();
    assert_eq!(times.len(), count);
    let height = |time| experiment.motion_at(time).placement.position.z - level;
    std::iter::once(0.0).chain(times).map(height).collect()
}

/// The parts of the speed at the level that the bounces return.
fn returns(heights: &[f64]) -> Vec<f64> {
    heights.windows(2).map(|pair| (pair[1] / pair[0]).sqrt()).collect()
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
fn every_bounce_of_the_ball_returns_the_same_part_of_the_speed() {
    const CASE: &str = "gallery: bounce";
    let weightless = Experiment::of_gallery("bounce", &["world.gravity=[0, 0, 0]", "body.ball.velocity=[0, 0, -1]"]);
    let restitution = weightless.motion_at(1.5).velocity.velocity.z;
    // 2 mm above the table the field carries the ball; below, it is stronger than gravity.
    let returns = returns(&apexes(&Experiment::of_gallery("bounce", &[]), 0.052, 5));
    for (quantity, part) in [("first bounce", returns[0]), ("fifth bounce", returns[4])] {
        // The fifth rises 2 cm only, where gravity is no longer nothing beside the field 2 mm above the table.
        answer(CASE, quantity, restitution, part, 1e-2, "a bounce without gravity");
    }
    let run = Experiment::of_gallery("bounce", &["time.end=0.8", "time.sample=0.8"]).run();
    let motion = run.end.motion(&Experiment::of_gallery("bounce", &[]).model, 0);
    let (speed, rolling) = (motion.velocity.velocity.x, motion.angular_velocity().y * 0.05);
    // Friction acts where the field is, a part of a millimetre above the lowest point of a ball of 5 cm.
    answer(CASE, "speed along the table after three bounces [m/s]", 0.3 * 5.0 / 7.0, speed, 1e-2, "5/7 of the throw");
    answer(CASE, "speed of the surface over that of the ball", 1.0, rolling / speed, 1e-2, "rolling");
}

/// What returns of x: y with −y − ln(1−y) = x − ln(1+x), by bisection.
fn returned(x: f64) -> f64 {
    let target = x - x.ln_1p();
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let y: f64 = 0.5 * (low + high);
        if -y - (-y).ln_1p() < target { low = y } else { high = y }
    }
    low
}

#[test]
fn flat_block_bounces_by_the_closed_form_without_turning() {
    const CASE: &str = "gallery: bounce-flat";
    let experiment = Experiment::of_gallery("bounce-flat", &[]);
    let heights = apexes(&experiment, 0.021, 3);
    let ratio = 350.0 / 314.0;
    let names = ["first bounce", "second bounce", "third bounce"];
    let returns = returns(&heights);
    for ((quantity, height), part) in names.into_iter().zip(&heights).zip(&returns) {
        let x = ratio * (2.0 * GRAVITY * height).sqrt();
        // Gravity over the 1 mm of the field: g d/v², largest at the third bounce, of 0.5 m/s.
        answer(CASE, quantity, returned(x) / x, *part, 5e-2, "x − ln(1+x) = −y − ln(1−y)");
    }
    assert!(returns[0] < returns[1] && returns[1] < returns[2], "{returns:?}");
    let run = experiment.run();
    let tilt = ["block.P_zx", "block.P_zy"].map(|name| largest(run.column(name)));
    // Nothing tilts it but rounding, 1e-16 at the first impact, which the bounces magnify by 1e7 and more.
    answer(CASE, "largest tilt [rad]", 0.0, tilt[0].max(tilt[1]), 1e-6, "symmetry");
    let tilted = ["body.block.orientation={ axis_angle = { axis = [0, 1, 0], angle = 1e-6 } }"];
    let grown = largest(Experiment::of_gallery("bounce-flat", &tilted).run().column("block.P_zx"));
    assert!(grown > 1e-4, "a flat fall is unstable: the tilt of 1e-6 has grown to {grown:e}");
}

/// The spin (spatial axes) that the first impact of the tilted block leaves, predicted and found [rad/s].
fn spin_of_the_corner(alpha: f64) -> (Vec3, Vec3) {
    let alpha = format!("contact.0.repulsion.alpha={alpha:e}");
    let lossless = ["contact.0.damping.beta=0", "contact.0.friction.beta=0", &alpha];
    let experiment = Experiment::of_gallery("bounce-tilted", &lossless);
    let motion = experiment.motion_at(0.0_f64.next_up());
    let half = Vec3::new(0.06, 0.04, 0.02);
    // The lowest corner, from the centre of mass in spatial axes.
    let down = motion.placement.gradient.tr_mul(&Vec3::z());
    let corner = motion.placement.gradient * half.component_mul(&down.map(|c| -c.signum()));
    let fall = motion.placement.position.z + corner.z;
    let body = &experiment.model.bodies[0];
    let BodyKind::Rigid(inertia) = &body.kind else { panic!("the body is rigid") };
    let inverse = motion.placement.gradient * inertia.inverse * motion.placement.gradient.transpose();
    let arm = corner.cross(&Vec3::z());
    let impulse = 2.0 * (2.0 * GRAVITY * fall).sqrt() / (1.0 / body.solid.mass.mass + arm.dot(&(inverse * arm)));
    // Just after the corner has left: before another one comes down.
    let left = experiment.run().times_of("lift_off")[0];
    (inverse * arm * impulse, experiment.motion_at(left).angular_velocity())
}

#[test]
fn corner_that_strikes_turns_the_fall_into_spin() {
    const CASE: &str = "gallery: bounce-tilted, no damping or friction";
    const SOURCE: &str = "p = 2v/(1/m + (r×n)·I⁻¹(r×n)), ω = I⁻¹(r×n) p";
    // A field that is strong enough only near the table makes the impact short: the block turns less meanwhile.
    let cases = [("spin after the first impact", 314.0, 0.1), ("the same, α a million times smaller", 314e-6, 0.01)];
    for (quantity, alpha, tolerance) in cases {
        let (predicted, found) = spin_of_the_corner(alpha);

        answer(CASE, quantity, 0.0, (found - predicted).norm() / predicted.norm(), tolerance, SOURCE);
    }
    let run = Experiment::of_gallery("bounce-tilted", &[]).run();
    let up = run.column("block.P_zz");
    // Flat, on the large face: what remains of the rocking at the speed of rest is far below 1e-3.
    answer("gallery: bounce-tilted", "P_zz at the end", 1.0, up[up.len() - 1].abs(), 1e-3, "it lies flat");
}
