//! The gallery's `pendulum-chain`, `linkage`, `gripper` and `adhesive-cluster`: bodies that are joined, or hold each
//! other.

use gyration_validation::{Case, Experiment, Run, largest};

const GRAVITY: f64 = 9.81;

fn last(run: &Run, column: &str) -> f64 {
    *run.column(column).last().unwrap()
}

/// The forces on the left ends of equal level rods in a row that are let go, the first one on a fixed hinge: rods of
/// mass m, length l and moment of inertia I about their centres, p = 1/m, q = l²/4I,
///
///   (p + q) F₀ − (p − q) F₁ = g,   (p − q) F_{k−1} − 2 (p + q) F_k + (p − q) F_{k+1} = 0,   F_n = 0
fn forces_when_let_go(rods: usize, mass: f64, length: f64, inertia: f64) -> Vec<f64> {
    let (p, q) = (1.0 / mass, 0.25 * length * length / inertia);
    // From the free end: F_k = r_k F_{k−1}.
    let mut ratios = vec![0.0; rods + 1];
    for k in (1..rods).rev() {
        ratios[k] = (p - q) / (2.0 * (p + q) - (p - q) * ratios[k + 1]);
    }
    let mut forces = vec![GRAVITY / (p + q - (p - q) * ratios[1])];
    for ratio in &ratios[1..rods] {
        forces.push(ratio * forces[forces.len() - 1]);
    }
    forces
}

#[test]
fn a_chain_let_go_pulls_at_its_hinges_as_statics_of_its_accelerations_says() {
    let experiment = Experiment::of_gallery("pendulum-chain", &[]);
    let run = experiment.run();
    let mass = experiment.model.bodies[0].solid.mass.mass;
    let inertia = mass * (0.2 * 0.2 + 0.01 * 0.01) / 12.0;
    let expected = forces_when_let_go(5, mass, 0.2, inertia);
    // On the first party, space or the rod before.
    let found = (0..5).map(|k| -run.column(&format!("joint.hinge-{k}.fz"))[0]);
    let error = largest(found.zip(&expected).map(|(found, expected)| found - expected));
    let case = Case { row: None, name: "gallery: pendulum-chain", source: "equations of five rods in a row" };
    case.check("largest error of the forces at the start over the weight", 0.0, error / (5.0 * mass * GRAVITY), 1e-12);
    case.by("the ledger").check("residual over the energy in play", 0.0, run.relative_residual(), 1e-8);
}

#[test]
fn a_four_bar_swings_its_rocker_as_its_lengths_say() {
    let run = Experiment::of_gallery("linkage", &[]).run();
    let (crank, coupler, rocker, base) = (0.1, 0.3, 0.25, 0.3);
    let axis = |body: &str, row: usize| ["P_xx", "P_zx"].map(|entry| run.column(&format!("{body}.{entry}"))[row]);
    let error = (0..run.times.len()).step_by(20).map(|row| {
        let [cos, sin] = axis("crank", row);
        // From the end of the crank to the pivot, and where the two circles meet above it.
        let way = [base - crank * cos, -crank * sin];
        let distance = way[0].hypot(way[1]);
        let along = (coupler * coupler - rocker * rocker + distance * distance) / (2.0 * distance);
        let across = (coupler * coupler - along * along).sqrt();
        let unit = way.map(|component| component / distance);
        let meet = [crank * cos + along * unit[0] - across * unit[1], crank * sin + along * unit[1] + across * unit[0]];
        let [x, z] = axis("rocker", row).map(|component| rocker * component);
        (base + x - meet[0]).hypot(z - meet[1])
    });
    let case = Case { row: None, name: "gallery: linkage", source: "two circles that meet" };
    case.check("largest error of the place of the rocker's end [m]", 0.0, largest(error), 1e-12);
    // The motor gives way by its torque over 0.5 N m s.
    let rates =
        run.column("crank.vx").iter().zip(run.column("crank.vz")).map(|(x, z)| x.hypot(z) / 0.05).collect::<Vec<_>>();
    let (least, most) = rates[100..].iter().fold((f64::INFINITY, 0.0_f64), |(a, b), it| (a.min(*it), b.max(*it)));
    println!("the crank turns at {least:.3} to {most:.3} rad/s");
    assert!(least > 5.0 && most < 7.5, "{least} {most}");
    assert!(run.relative_residual() < 1e-7, "{}", run.relative_residual());
}

#[test]
fn a_gripper_holds_a_ball_by_a_creep_and_not_without_friction() {
    let experiment = Experiment::of_gallery("gripper", &[]);
    let run = experiment.run();
    let (c, mu, torque) = (1000.0, 0.8, 0.2);
    let arm = last(&run, "palm.z") - last(&run, "ball.z");
    // Each finger presses with N and carries half of the weight: f = c N w/√(1 + (c w/μ)²).
    let share = 0.5 * experiment.model.bodies[3].solid.mass.mass * GRAVITY * arm / torque;
    let expected = share / (c * (1.0 - (share / mu) * (share / mu)).sqrt());
    let case = Case { row: None, name: "gallery: gripper", source: "f = c N w/√(1 + (c w/μ)²), N = torque/arm" };
    // Friction works at half the width of a finger from the hinge, which takes a hundredth of the torque.
    case.check("creep of the ball [m/s]", expected, last(&run, "palm.vz") - last(&run, "ball.vz"), 5e-2);
    assert!(last(&run, "ball.z") > 0.12, "it is not lifted");
    assert!(run.relative_residual() < 1e-7, "{}", run.relative_residual());
    let slips = Experiment::of_gallery("gripper", &["contact.1.friction.mu=0.02"]).run();
    assert!(last(&slips, "ball.z") < 0.04, "it is lifted without friction");
}

#[test]
fn balls_that_stick_rest_where_attraction_and_repulsion_balance() {
    let experiment = Experiment::of_gallery("adhesive-cluster", &[]);
    let run = experiment.run();
    let places = (0..5).map(|ball| run.end.motion(&experiment.model, ball).placement.position).collect::<Vec<_>>();
    let (radius, d0) = (0.01, 5e-5);
    let mut gaps: Vec<f64> = Vec::new();
    for (k, one) in places.iter().enumerate() {
        gaps.extend(places[..k].iter().map(|other| (one - other).norm() - 2.0 * radius));
    }
    let held: Vec<f64> = gaps.into_iter().filter(|gap| *gap < 2.0 * d0).collect();
    println!("gaps {held:?}");
    // Three in a triangle, one on either side of it, which do not touch each other.
    assert_eq!(held.len(), 9, "{held:?}");
    let rest = 0.25_f64.powf(1.0 / 6.0) * d0;
    let case = Case {
        row: None, name: "gallery: adhesive-cluster", source: "x² /(ν_a − 1) = x⁸/(ν_r − 1), x = d₀/g"
    };
    case.check(
        "largest error of a gap over the gap at rest",
        0.0,
        largest(held.iter().map(|gap| gap / rest - 1.0)),
        1e-3,
    );
    let momentum = ["vx", "vy", "vz"].map(|axis| {
        let sum = |row: usize| (0..5).map(|ball| run.column(&format!("grain-{ball}.{axis}"))[row]).sum::<f64>();
        sum(run.times.len() - 1) - sum(0)
    });
    case.by("momentum").check("change of the mean velocity [m/s]", 0.0, largest(momentum) / 5.0, 1e-15);
    assert!(run.relative_residual() < 1e-7, "{}", run.relative_residual());
}
