//! Forces of a body's own: potentials of its place, of its deformation and of time, body forces, frictions.
//!
//!   V = ½kx²                 ω = √(k/m)
//!   V = b(P_xx² − 1)²        J s̈ = −4b s(s² − 1): from s₀ to √(2 − s₀²), T = 2∫₀^π dϑ/(2√(1 + a cos ϑ))/√(2b/J), a = s₀² − 1
//!   V = 4z² − 3z cos 2t      m = ½, from rest: z = ½(cos 2t − cos 4t), its work is the kinetic energy

use crate::soft::{self, alone, body};
use gyration::body::{matrix, vector};
use gyration::dynamics::{Workspace, rates};
use gyration::tensor::{Mat3, Vec3};
use gyration_scene::Scene;
use gyration_sim::sensitivity::{At, Sensitivities};
use gyration_validation::{Case, Experiment, largest};
use std::f64::consts::PI;
use std::path::Path;

/// Mass of the ball of 0.1 m and 1000 kg/m³ [kg].
const MASS: f64 = 4.0 / 3.0 * PI;

/// A rigid ball that starts at rest at x = 0.2 m in ½kx², k = 40 N/m.
const WELL: &str = r#"
    world = { gravity = [0, 0, 0] }
    time = { end = 1, sample = 1 }
    solver = { rtol = 1e-11, atol = 1e-13 }
    [constants]
    k = "40 N/m"
    [[body]]
    name = "ball"
    density = 1000
    shape = { sphere = { radius = 0.1 } }
    position = [0.2, 0, 0]
    potential = "0.5*k*x^2"
"#;

#[test]
fn a_quadratic_potential_swings_with_the_root_of_k_over_m() {
    let case = Case { row: None, name: "ball in V = kx²/2", source: "ω = √(k/m)" };
    let omega = (40.0 / MASS).sqrt();
    let crossing = 2.5 * PI / omega;
    let measured = Experiment::of_scene(WELL).time_when(crossing, |motion| motion.placement.position.x);
    case.check("ω from the third crossing [rad/s]", omega, 2.5 * PI / measured, 1e-9);
    let scene = Scene::parse("scene.toml", WELL, Path::new(""), &[]).unwrap();
    let (keys, quantities) = (["constants.k".to_owned()], ["ball.x".to_owned()]);
    let found = Sensitivities::along(&scene, &keys, &quantities, At::End).unwrap();
    // x = x₀ cos ωt at t = 1 s.
    let reference = -0.2 * omega.sin() / (2.0 * (40.0 * MASS).sqrt());
    case.check("∂x/∂k after 1 s [m²/N]", reference, found.derivatives[0].at_end().unwrap()[0], 1e-7);
}

/// ∫₀^π dϑ/√(1 + a cos ϑ), by the midpoint rule: the integrand is periodic.
fn quadrature(a: f64) -> f64 {
    const POINTS: u32 = 400;
    let term = |k: u32| (1.0 + a * ((f64::from(k) + 0.5) * PI / f64::from(POINTS)).cos()).powf(-0.5);
    PI / f64::from(POINTS) * (0..POINTS).map(term).sum::<f64>()
}

#[test]
fn a_ball_swings_to_and_fro_in_one_half_of_a_double_well() {
    let case = Case {
        row: None,
        name: "free ball in V = b(P_xx² − 1)², s₀ = 1.2",
        source: "T = ∫₀^π dϑ/√(1 + a cos ϑ)/√(2b/J), a = s₀² − 1",
    };
    let (depth, start) = (3.0, 1.2_f64);
    let inertia = MASS * 0.01 / 5.0;
    let rate = (2.0 * depth / inertia).sqrt();
    let period = quadrature(start * start - 1.0) / rate;
    let place = Mat3::from_diagonal(&[start, 1.0, 1.0].into());
    let written = body(soft::BALL, "", &place, &Mat3::zeros());
    let ball =
        alone(&format!("{written}potential = \"b*(P_xx^2 - 1)^2\"\nconstants = {{ b = {depth} }}"), (1e-11, 1e-13));
    // There ṡ ≈ s̈ (t − T), with J s̈ = −4b s(s² − 1).
    let motion = ball.motion_at(period);
    let acceleration = -4.0 * depth * start * (start * start - 1.0) / inertia;
    case.check("period [s]", period, period - motion.velocity.gradient_rate.m11 / acceleration, 1e-9);
    let turned = ball.motion_at(0.5 * period).placement.gradient.m11;
    case.check("other turning point", (2.0 - start * start).sqrt(), turned, 1e-9);
    let run = ball.until(5.0 * period).sampled(period / 32.0).run();
    case.by("the ledger").check("residual over the energy in play", 0.0, run.relative_residual(), 1e-9);
}

#[test]
fn a_shaken_potential_does_work() {
    let case = Case { row: None, name: "ball of ½ kg in V = 4z² − 3z cos 2t", source: "z = ½(cos 2t − cos 4t)" };
    let run = Experiment::of_scene(
        r#"
        world = { gravity = [0, 0, 0] }
        time = { end = 5, sample = 0.1 }
        solver = { rtol = 1e-11, atol = 1e-13 }
        [[body]]
        name = "ball"
        mass = 0.5
        shape = { sphere = { radius = 0.1 } }
        potential = "4*z^2 - 3*z*cos(2*t)"
        "#,
    )
    .run();
    assert!(!run.has("energy.load"), "a potential that changes in time is no energy");
    let expected = |t: &f64| 0.5 * ((2.0 * t).cos() - (4.0 * t).cos());
    let heights = run.column("ball.z");
    let error = largest(run.times.iter().zip(&heights).map(|(t, z)| z - expected(t)));
    case.check("largest error of z at the samples [m]", 0.0, error, 1e-9);
    let (works, kinetic) = (run.column("work.load"), run.column("energy.kinetic"));
    let error = largest(works.iter().zip(&kinetic).map(|(work, energy)| work - energy));
    case.check("work less kinetic energy [J]", 0.0, error, 1e-9);
}

/// A body force −κx on a free body of the density ρ: p̈₀ = −(κ det P/ρ) p₀, P̈ = −(κ det P/ρ) P.
#[test]
fn a_central_body_force_draws_a_free_body_together() {
    let case = Case { row: None, name: "free ellipsoid under b = −κx", source: "P̈ = −(κV det P/m) P" };
    let (strength, density) = (700.0, 1000.0);
    let place = Mat3::new(1.1, 0.2, -0.1, 0.0, 0.9, 0.3, 0.1, -0.2, 1.2);
    let text = |place: &Mat3, position: [f64; 3]| {
        let shape = "shape = { ellipsoid = { semi_axes = [0.1, 0.15, 0.07] } }";
        let written = body(shape, "", place, &Mat3::zeros());
        let force = "body_force = [\"-k*x\", \"-k*y\", \"-k*z\"]";
        format!("{written}position = {position:?}\n{force}\nconstants = {{ k = {strength} }}")
    };
    let thrown = alone(&text(&place, [0.3, -0.4, 0.5]), (1e-11, 1e-13));
    let (mut slopes, mut powers) = (vec![0.0; thrown.start.bodies.len()], vec![0.0; thrown.model.works().len()]);
    let numbers = (&thrown.start.bodies[..]).into();
    rates(&thrown.model, &mut Workspace::default(), 0.0, numbers, &mut slopes, &mut powers).unwrap();
    let slots = thrown.model.slots(0);
    let rate = -strength * place.determinant() / density;
    let linear = vector(&slopes[slots.velocity()]) - rate * Vec3::new(0.3, -0.4, 0.5);
    let own = matrix(&slopes[slots.rate()]) - rate * place;
    case.check(
        "largest error of p̈₀ and P̈ over κ/ρ",
        0.0,
        largest(linear.iter().chain(&own).map(|e| e.abs())) / 0.7,
        1e-13,
    );
    // With P = s 1 and p₀ = 0: ½ ṡ² + (κ/ρ) s⁵/5 stays what it is.
    let collapsing = alone(&text(&Mat3::identity(), [0.0; 3]), (1e-11, 1e-13)).motion_at(1.0);
    let (s, speed) = (collapsing.placement.gradient.m11, collapsing.velocity.gradient_rate.m11);
    let reference = -(0.4 * strength / density * (1.0 - s.powi(5))).sqrt();
    case.check("ṡ of P = s 1 after 1 s [1/s]", reference, speed, 1e-9);
}

#[test]
fn a_body_force_of_the_square_of_x_is_that_of_the_moments() {
    let case = Case { row: None, name: "cube under b = x²", source: "∫x² = V(x₀² + s²/12)" };
    let written = body(soft::CUBE, "", &Mat3::identity(), &Mat3::zeros());
    let cube =
        alone(&format!("{written}position = [0.3, 0, 0]\nbody_force = [\"x^2\", \"exp(x)\", 0]"), (1e-11, 1e-13));
    let (mut slopes, mut powers) = (vec![0.0; cube.start.bodies.len()], vec![0.0; cube.model.works().len()]);
    let numbers = (&cube.start.bodies[..]).into();
    rates(&cube.model, &mut Workspace::default(), 0.0, numbers, &mut slopes, &mut powers).unwrap();
    let acceleration = vector(&slopes[cube.model.slots(0).velocity()]);
    case.check("p̈_x [m/s²]", (0.09 + 0.01 / 12.0) / 1000.0, acceleration.x, 1e-13);
    // The mean of eˣ over the cube, by a rule.
    let mean = (0.35_f64.exp() - 0.25_f64.exp()) / 0.1;
    case.by("the mean of eˣ").check("p̈_y [m/s²]", mean / 1000.0, acceleration.y, 1e-13);
}

/// m v̇ = −c(1 + x²/l²) v: v = v₀ − (c/m)(x + x³/(3l²)).
#[test]
fn friction_that_grows_with_the_place_stops_a_rigid_ball() {
    let case = Case { row: None, name: "rigid ball in friction c(1 + x²)", source: "v = v₀ − (c/m)(x + x³/3)" };
    let zeros = "0, ".repeat(10);
    let rows = |entry: &str| {
        format!("[[{entry}, 0, {zeros}], {}]", format!("[0, 0, {zeros}],").repeat(11)).replace(", ]", "]")
    };
    let scaled = format!("{{ matrix = {}, scale = \"1 + x^2\" }}", rows("0.8"));
    let entries = format!("{{ matrix = {} }}", rows("\"c*(1 + x^2)\""));
    for (written, quantity) in
        [(scaled, "speed after 2 s, scaled [m/s]"), (entries, "speed after 2 s, by entries [m/s]")]
    {
        let lines = format!("velocity = [1, 0, 0]\nlinear_friction = {written}\nconstants = {{ c = 0.8 }}");
        let ball = alone(&format!("{}\n{lines}", soft::BALL), (1e-11, 1e-13)).until(2.0);
        let run = ball.run();
        let motion = run.end.motion(&ball.model, 0);
        let x = motion.placement.position.x;
        let reference = 1.0 - 0.8 / MASS * (x + x.powi(3) / 3.0);
        case.check(quantity, reference, motion.velocity.velocity.x, 1e-10);
        assert!(run.relative_residual() < 1e-10, "{:e}", run.relative_residual());
    }
}
