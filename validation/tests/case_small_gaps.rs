//! Impacts that a field stops 10⁻¹⁴ … 10⁻¹³ m above the table: so short that they are those of a rigid body without
//! loss, the velocity of the point that hits being reversed,
//!
//!   J = −2 v_n / (1/m + n·(I⁻¹ (r × n)) × r),   Δṗ₀ = J n/m,   Δ(I ω) = r × J n
//!
//! The gap is the difference of two lengths of some 0.1 m: of sixteen digits one or two would be left. State and gap
//! are kept to twice the digits, so that the energy balance closes as it does at any other gap.

use gyration::tensor::{Mat3, Vec3};
use gyration_validation::{Case, Experiment};

const EDGES: Vec3 = Vec3::new(0.1, 0.06, 0.4);
const DENSITY: f64 = 500.0;
const SPEED: f64 = 1.5;
/// The gap from which it comes down [m].
const START: f64 = 1e-4;

struct Impact {
    name: &'static str,
    orientation: &'static str,
    repulsion: &'static str,
    /// How many corners hit together: two of an edge, or one.
    corners: usize,
}

const IMPACTS: [Impact; 3] = [
    Impact {
        name: "block on its edge, d₀ = 1e-8, ν = 3",
        orientation: "{ axis_angle = { axis = [0, 1, 0], angle = 0.3 } }",
        repulsion: "{ alpha = 1e11, nu = 3, d0 = 1e-8 }",
        corners: 2,
    },
    Impact {
        name: "block on a corner, d₀ = 1e-8, ν = 5.5",
        orientation: "{ axis_angle = { axis = [1.0, 2.0, 0.3], angle = 0.5 } }",
        repulsion: "{ alpha = 1e12, nu = 5.5, d0 = 1e-8 }",
        corners: 1,
    },
    Impact {
        name: "block on a corner, d₀ = 1e-9, ν = 12",
        orientation: "{ axis_angle = { axis = [-0.5, 2.0, 0.3], angle = 0.4 } }",
        repulsion: "{ alpha = 1e-7, nu = 12, d0 = 1e-9 }",
        corners: 1,
    },
];

/// The block at a height of its centre [m].
fn block(impact: &Impact, height: f64) -> Experiment {
    let Impact { orientation, repulsion, .. } = impact;
    let [x, y, z] = [EDGES.x, EDGES.y, EDGES.z];
    Experiment::of_scene(&format!(
        r#"
        time = {{ end = {end}, sample = {end} }}
        solver = {{ rtol = 1e-9, atol = 1e-12 }}
        world = {{ gravity = [0, 0, 0] }}
        [[support]]
        name = "table"
        plane = {{ origin = [0, 0, 0], normal = [0, 0, 1] }}
        [[contact]]
        support = "table"
        repulsion = {repulsion}
        [[body]]
        name = "block"
        shape = {{ box = {{ size = [{x}, {y}, {z}] }} }}
        density = {DENSITY}
        position = [0, 0, {height:e}]
        orientation = {orientation}
        velocity = [0, 0, -{SPEED}]
        "#,
        end = 2.0 * START / SPEED,
    ))
}

#[test]
fn impacts_far_below_the_size_reverse_the_velocity_of_what_hits() {
    for impact in &IMPACTS {
        let rotation = block(impact, 1.0).run().matrices("placement_gradient")[0];
        let mut corners: Vec<Vec3> = (0..8)
            .map(|k| {
                let side = |axis: usize| if k >> axis & 1 == 1 { 0.5 } else { -0.5 };
                rotation * Vec3::from_fn(|axis, _| side(axis) * EDGES[axis])
            })
            .collect();
        corners.sort_by(|a, b| a.z.total_cmp(&b.z));
        let hit = corners[..impact.corners].iter().sum::<Vec3>() / impact.corners as f64;

        let mass = DENSITY * EDGES.product();
        let squares = EDGES.component_mul(&EDGES);
        let own = Vec3::new(squares.y + squares.z, squares.x + squares.z, squares.x + squares.y) * (mass / 12.0);
        let inertia = |rotation: &Mat3| rotation * Mat3::from_diagonal(&own) * rotation.transpose();
        let arm = hit.cross(&Vec3::z());
        let mobility = rotation * Mat3::from_diagonal(&own.map(f64::recip)) * rotation.transpose();
        let impulse = 2.0 * SPEED / (1.0 / mass + (mobility * arm).dot(&arm));

        let experiment = block(impact, START - hit.z);
        let run = experiment.run();
        let after = experiment.motion_at(2.0 * START / SPEED);
        let case = Case { row: None, name: impact.name, source: "elastic impact of a rigid body" };
        // The field reaches some 1e-8 of the size, within which the block turns.
        let speed = after.velocity.velocity.z;
        case.check("ż after the impact [m/s]", impulse / mass - SPEED, speed, 1e-6 * SPEED);
        // Between the impact and the end it turns freely: it is its angular momentum that stays.
        let momentum = inertia(&after.placement.gradient) * after.angular_velocity();
        let error = (momentum - impulse * arm).norm() / (impulse * arm).norm();
        case.check("relative error of the angular momentum", 0.0, error, 1e-6);
        case.check("residual of the ledger, of the energy in play", 0.0, run.relative_residual(), 1e-7);
        let closest = run.times_of("closest_approach")[0];
        let placement = experiment.motion_at(closest).placement;
        let gaps = corners.iter().map(|corner| placement.place(&(rotation.tr_mul(corner))).z);
        let gap = gaps.fold(f64::INFINITY, f64::min);
        println!("{}: smallest gap {gap:.1e} m", impact.name);
        assert!(gap < 1e-12, "{}: {gap:e}", impact.name);
    }
}
