//! What a mechanician reads off a run in which every kind of load acts, by laws that tie the recorded quantities.
//!
//!   m p̈₀ = m g + f,   f = Σ f_k,   M = Σ M_k
//!   d(K + (p₀ − o) ⊗ m ṗ₀)/dt = Ṗ J Ṗᵀ + ṗ₀ ⊗ m ṗ₀ + N_o + (p₀ − o) ⊗ m g − V (S Pᵀ)ᵀ,   o at the pin
//!   D = P M_frᵀ − V (S Pᵀ − S_e Pᵀ + π 1),   μ_γ V_G = A + Q
//!
//! Derivatives in time are differences of eighth order. A body that drives itself rests on a table in a fluid and is
//! pushed by a rigid one; a spring joins it to an affine one on a pin; a bead feels how the fluid moved before.

use crate::soft::{derivatives, size};
use gyration::tensor::{Mat3, Vec3};
use gyration_validation::{Case, Experiment, Run, largest};

const SPACING: f64 = 1e-4;
/// Samples without a derivative at either end.
const MARGIN: usize = 4;
/// Derivatives at the beginning, where the drag of the bead falls as 1/√t after the jump of its velocity.
const EARLY: usize = 100;
const GRAVITY: Vec3 = Vec3::new(0.0, 0.0, -9.81);
const PIN: Vec3 = Vec3::new(0.03, 0.02, 0.01);
/// Where the pin is, and the origin of affine moments.
const ORIGIN: Vec3 = Vec3::new(-0.05, 0.02, 0.2);
const KINDS: [&str; 6] = ["contact", "pair", "spring", "drag", "friction", "load"];
const MU: f64 = 4000.0;
const LAMBDA: f64 = 6000.0;
const DRAG: f64 = 60.0;
const SHEAR: f64 = 3.0;
const BULK: f64 = 5.0;

const SCENE: &str = r#"
time = { end = 0.05, sample = 1e-4 }
record = { quantities = ["force_total", "moment_total", "force_by_kind", "moment_by_kind", "affine_moment_total",
    "friction_moment", "kinetic_tensor", "canonical_momentum", "kinetic_energy", "elastic_gradient",
    "elastic_stress", "eshelby", "affine_moment", "affine_momentum_total", "stress"], origin = [-0.05, 0.02, 0.2] }
solver = { rtol = 1e-11, atol = 1e-13 }
fluid = { viscosity = 2, density = 300, velocity_gradient = [[0, 0, 1.5], [0, 0, 0], [0, 0, 0]] }
[[support]]
name = "table"
plane = {}
[[contact]]
support = "table"
body = "heart"
repulsion = { alpha = 600, nu = 5, d0 = 0.01 }
friction = { beta = 100, nu = 3, d0 = 0.01 }
[[contact]]
between = ["heart", "stone"]
repulsion = { alpha = 600, nu = 5, d0 = 0.01 }
damping = { beta = 60, nu = 5, d0 = 0.01 }
[[spring]]
between = ["heart", "leaf"]
points = [[0, 0, 0.03], [-0.05, 0.04, 0.03]]
stiffness = 60
rest_length = 0.05
damping = 0.5
[[body]]
name = "heart"
shape = { ellipsoid = { semi_axes = [0.06, 0.05, 0.04] } }
density = 1000
position = [0, 0, 0.052]
velocity = [0.3, -0.1, -0.2]
gradient = [[1.05, 0.1, 0], [-0.1, 0.95, 0.05], [0.02, 0, 1.1]]
gradient_rate = [[0.5, -4, 1], [5, 0.2, -2], [0, 3, -0.5]]
linear_friction = { matrix = FRICTION, frame = "body" }
body_force = ["200*z", "30", "-50*x"]
inclusion = {}
[body.contractile]
material = { neo_hookean_log = { mu = 4000, lambda = 6000 } }
viscosity = 10
internal_friction = { shear = 3, bulk = 5 }
contraction_viscosity = 60
contraction = [[0.95, 0.02, 0], [0, 1.04, 0], [0, 0.03, 1.02]]
drive = { sine = { amplitude = [[900, 200, -100], [50, -300, 150], [0, 100, 700]], frequency = 6, phase = 0.2 } }
[[body]]
name = "leaf"
shape = { box = { size = [0.1, 0.08, 0.06] } }
density = 1000
pin = [0.03, 0.02, 0.01]
position = [-0.08, 0, 0.19]
angular_velocity = [2, -3, 1]
[body.affine]
material = { mooney_rivlin = { c1 = 1500, c2 = 500 } }
viscosity = 5
couple = { value = [[0.1, 0.02, 0], [0, -0.05, 0.03], [0.04, 0, 0.02]] }
gyroscopic = { matrix = SKEW }
[[body]]
name = "stone"
shape = { box = { size = [0.06, 0.05, 0.04] } }
density = 2000
position = [0.01, 0.02, 0.135]
orientation = { axis_angle = { axis = [1, 2, 0.5], angle = 0.3 } }
velocity = [0, 0, -0.5]
angular_velocity = [4, -3, 2]
[[body]]
name = "bead"
shape = { sphere = { radius = 0.02 } }
density = 2500
position = [0.6, 0, 0.3]
velocity = [0.2, 0, 0]
angular_velocity = [0, 20, 5]
inclusion = { history = true }
"#;

/// A body of the scene: its index, mass, volume, J about its centre, and the arm of its pin.
struct Known {
    index: usize,
    name: &'static str,
    mass: f64,
    volume: f64,
    euler: Mat3,
    pin: Option<Vec3>,
}

fn known() -> [Known; 4] {
    let of = |index, name, density: f64, volume: f64, spread: Vec3, pin| {
        let mass = density * volume;
        Known { index, name, mass, volume, euler: Mat3::from_diagonal(&(mass * spread)), pin }
    };
    let squares = |x: f64, y: f64, z: f64| Vec3::new(x * x, y * y, z * z);
    let ball = 4.0 / 3.0 * std::f64::consts::PI;
    [
        of(0, "driven body under every load", 1000.0, ball * 0.06 * 0.05 * 0.04, squares(0.06, 0.05, 0.04) / 5.0, None),
        of(1, "body on a pin under every load", 1000.0, 0.1 * 0.08 * 0.06, squares(0.1, 0.08, 0.06) / 12.0, Some(PIN)),
        of(2, "rigid body that falls on another", 2000.0, 0.06 * 0.05 * 0.04, squares(0.06, 0.05, 0.04) / 12.0, None),
        of(3, "bead in a fluid that remembers", 2500.0, ball * 8e-6, squares(0.02, 0.02, 0.02) / 5.0, None),
    ]
}

fn run() -> Run {
    let wave = |k: usize, phase: f64| (1.7 * k as f64 + phase).sin();
    let square = |entry: &dyn Fn(usize, usize) -> f64| -> String {
        let row = |i: usize| (0..12).map(|j| format!("{:e}", entry(i, j))).collect::<Vec<_>>().join(", ");
        format!("[{}]", (0..12).map(|i| format!("[{}]", row(i))).collect::<Vec<_>>().join(", "))
    };
    let friction = square(&|i, j| 2e-2 * (wave(i, 0.0) * wave(j, 0.0) + wave(i, 1.0) * wave(j, 1.0)));
    let skew = square(&|i, j| 5e-3 * (wave(i, 0.3) * wave(j, 1.1) - wave(i, 1.1) * wave(j, 0.3)));
    Experiment::of_scene(&SCENE.replace("FRICTION", &friction).replace("SKEW", &skew)).run()
}

/// The largest difference of matrices over the largest of those expected.
fn apart(found: &[Mat3], expected: impl IntoIterator<Item = Mat3>) -> f64 {
    let (difference, scale) = crate::soft::spread(found, expected);
    difference / scale
}

/// The samples at which a derivative is compared.
fn later<T>(values: &[T]) -> &[T] {
    &values[MARGIN + EARLY..values.len() - MARGIN]
}

fn sums_and_balances(case: &Case, run: &Run, body: &Known) {
    let vectors = |name: &str| run.vectors_of(body.index, name);
    let matrices = |name: &str| run.matrices_of(body.index, name);
    let (force, moment) = (vectors("force_total"), matrices("moment_total"));
    let mut force_left = force.clone();
    let mut moment_left = moment.clone();
    for kind in KINDS {
        force_left.iter_mut().zip(vectors(&format!("force_{kind}"))).for_each(|(left, part)| *left -= part);
        moment_left.iter_mut().zip(matrices(&format!("moment_{kind}"))).for_each(|(left, part)| *left -= part);
    }
    let of_vectors = |vectors: &[Vec3]| largest(vectors.iter().map(Vec3::norm));
    let of_matrices = |matrices: &[Mat3]| largest(matrices.iter().map(size));
    let left = of_vectors(&force_left) / of_vectors(&force);
    case.check("largest force that no kind has, over the largest", 0.0, left, 1e-13);
    let left = of_matrices(&moment_left) / of_matrices(&moment);
    case.check("largest moment that no kind has, over the largest", 0.0, left, 1e-13);

    let (p, rate, velocity) = (matrices("placement_gradient"), matrices("gradient_rate"), vectors("velocity"));
    let (place, stress) = (vectors("position"), matrices("stress"));
    let spread = body.euler + body.pin.map_or(Mat3::zeros(), |pin| body.mass * pin * pin.transpose());
    let error = apart(&matrices("canonical_momentum"), rate.iter().map(|rate| rate * spread));
    case.by("∂T/∂Ṗ = Ṗ J").check("largest error of the canonical momentum, relative", 0.0, error, 1e-13);

    let weight = body.mass * GRAVITY;
    let arm = |k: usize| place[k] - ORIGIN;
    if body.pin.is_none() {
        let found = derivatives(&vectors("linear_momentum"), SPACING).split_off(EARLY);
        let errors = found.iter().zip(later(&force)).map(|(found, force)| (found - force - weight).norm());
        let error = largest(errors) / of_vectors(later(&force));
        case.by("m p̈₀ = m g + f").check("largest error of the momentum over the largest force", 0.0, error, 1e-8);
        let (about, own) = (matrices("affine_moment_total"), matrices("affine_moment"));
        let expected = (0..own.len()).map(|k| p[k] * moment[k].transpose() + arm(k) * force[k].transpose());
        case.by("N + (p₀ − o) ⊗ f").check("error of the moment about the origin", 0.0, apart(&about, expected), 1e-13);
    }
    let skew = |(stress, p): (&Mat3, &Mat3)| size(&(stress * p.transpose() - p * stress.transpose()));
    let tension = later(&stress).iter().zip(later(&p)).map(|(stress, p)| size(&(stress * p.transpose())));
    let error = largest(later(&stress).iter().zip(later(&p)).map(skew)) / largest(tension);
    case.by("S Pᵀ symmetric").check("largest skew part of S Pᵀ, relative", 0.0, error, 1e-10);
    // The reaction of a pin has no moment about it, and the orbital part is that of P J_p Ṗᵀ.
    let (total, tensor) = (matrices("affine_moment_total"), matrices("kinetic_tensor"));
    let supplied = |k: usize| {
        let orbital = if body.pin.is_some() { 0.0 } else { body.mass };
        let own = tensor[k] + orbital * velocity[k] * velocity[k].transpose();
        own + total[k] + arm(k) * weight.transpose() - body.volume * (stress[k] * p[k].transpose()).transpose()
    };
    let momentum = matrices("affine_momentum_total");
    let found = derivatives(&momentum, SPACING).split_off(EARLY);
    let expected: Vec<Mat3> = (0..momentum.len()).map(supplied).collect();
    let error = apart(&found, later(&expected).iter().copied());
    case.by("the balance of affine momentum").check(
        "largest error of dK/dt about the origin, relative",
        0.0,
        error,
        1e-8,
    );
}

fn material_of_the_driven_body(case: &Case, run: &Run, body: &Known) {
    let matrices = |name: &str| run.matrices_of(body.index, name);
    let back = |matrix: &Mat3| matrix.try_inverse().unwrap_or_else(Mat3::zeros);
    let (p, rate, g) = (matrices("placement_gradient"), matrices("gradient_rate"), matrices("contraction"));
    let (f, elastic, stress) = (matrices("elastic_gradient"), matrices("elastic_stress"), matrices("stress"));
    let product = f.iter().zip(&g).map(|(f, g)| f * g);
    case.by("F G = P").check("largest error of F G, relative", 0.0, apart(&p, product), 1e-14);
    let slope = |f: &Mat3| MU * (f - back(f).transpose()) + LAMBDA * f.determinant().ln() * back(f).transpose();
    let expected = (0..p.len()).map(|k| g[k].determinant() * slope(&f[k]) * back(&g[k]).transpose());
    case.by("det G ∂φ/∂F G⁻ᵀ").check(
        "largest error of the elastic stress, relative",
        0.0,
        apart(&elastic, expected),
        1e-12,
    );

    let medium = |k: usize| {
        let l = rate[k] * back(&p[k]);
        let d = 0.5 * (l + l.transpose());
        let deviator = d - Mat3::from_diagonal_element(d.trace() / 3.0);
        p[k].determinant() * (2.0 * SHEAR * deviator + Mat3::from_diagonal_element(BULK * d.trace()))
    };
    let energy = |f: &Mat3| {
        let swell = f.determinant().ln();
        0.5 * MU * (f.norm_squared() - 3.0) - MU * swell + 0.5 * LAMBDA * swell * swell
    };
    let eshelby = matrices("eshelby");
    let expected = (0..p.len()).map(|k| {
        let own = stress[k] - medium(k) * back(&p[k]).transpose();
        f[k].transpose() * own * g[k].transpose() - Mat3::from_diagonal_element(g[k].determinant() * energy(&f[k]))
    });
    case.by("Fᵀ S Gᵀ − det G φ I").check(
        "largest error of Eshelby's stress, relative",
        0.0,
        apart(&eshelby, expected),
        1e-12,
    );
    let (drive, velocity) = (matrices("drive"), matrices("contraction_velocity"));
    let pushed: Vec<Mat3> = eshelby.iter().zip(&drive).map(|(a, q)| a + q).collect();
    let law = apart(&pushed, velocity.iter().map(|velocity| DRAG * velocity));
    case.by("μ_γ V_G = A + Q").check("largest error of the law of contraction, relative", 0.0, law, 1e-12);
}

#[test]
fn what_is_told_of_loads_momenta_and_stresses_ties_together() {
    let case = Case { row: None, name: "", source: "the recorded kinds" };
    let run = run();
    let bodies = known();
    for kind in KINDS {
        let most = largest(
            bodies.iter().flat_map(|body| run.vectors_of(body.index, &format!("force_{kind}"))).map(|f| f.norm()),
        );
        println!("{kind}: forces to {most:.2e} N");
        assert!(most > 1e-3, "{kind} acts on nobody");
    }
    for body in &bodies {
        let case = Case { name: body.name, ..case };
        sums_and_balances(&case, &run, body);
    }
    let [heart, leaf, _, bead] = &bodies;
    material_of_the_driven_body(&Case { name: heart.name, ..case }, &run, heart);

    // D against S, S_e and π of the columns.
    for body in [heart, leaf] {
        let matrices = |name: &str| run.matrices_of(body.index, name);
        let [p, stress, elastic, linear] =
            ["placement_gradient", "stress", "elastic_stress", "moment_friction"].map(&matrices);
        let pressure = run.scalars_of(body.index, "pressure");
        let expected = (0..p.len()).map(|k| {
            let push = if pressure[k].is_nan() { 0.0 } else { pressure[k] };
            let inner = (stress[k] - elastic[k]) * p[k].transpose() + Mat3::from_diagonal_element(push);
            p[k] * linear[k].transpose() - body.volume * inner
        });
        let error = apart(&matrices("friction_moment"), expected);
        let case = Case { name: body.name, ..case }.by("P M_frᵀ − V (S Pᵀ − S_e Pᵀ + π 1)");
        case.check("largest error of D, relative", 0.0, error, 1e-10);
    }
    for body in [heart, bead] {
        let swell = run.matrices_of(body.index, "placement_gradient").into_iter().map(|p| p.determinant());
        let without = run.vectors_of(body.index, "drag");
        let expected: Vec<Vec3> =
            without.iter().zip(swell).map(|(drag, swell)| drag - 300.0 * body.volume * swell * GRAVITY).collect();
        let found = run.vectors_of(body.index, "force_drag");
        let apart = largest(later(&found).iter().zip(later(&expected)).map(|(found, force)| (found - force).norm()));
        let error = apart / largest(later(&expected).iter().map(Vec3::norm));
        let case = Case { name: body.name, ..case }.by("drag − ρ_f V det P g");
        case.check("largest error of the force of the fluid, relative", 0.0, error, 1e-12);
    }
    let centre = |index: usize| run.scalars_of(index, "kinetic_energy_centre");
    let internal = |index: usize| run.scalars_of(index, "kinetic_energy_internal");
    let parts: Vec<_> = bodies.iter().flat_map(|body| [centre(body.index), internal(body.index)]).collect();
    let sums = run.column("energy.kinetic");
    let left = largest(sums.iter().enumerate().map(|(k, sum)| sum - parts.iter().map(|part| part[k]).sum::<f64>()));
    Case { name: "four bodies joined", ..case }.by("the ledger").check(
        "kinetic energy less its parts, over it",
        0.0,
        left / largest(sums),
        1e-13,
    );
}
