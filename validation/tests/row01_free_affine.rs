//! Row 1: an affine body without forces or stress.
//!
//!   P = P₀ + t Ṗ₀,   p₀ = a + t v,   K = P J Ṗᵀ = P₀JṖ₀ᵀ + t Ṗ₀JṖ₀ᵀ
//!
//! Linear and angular momentum and the energy stay. det P is a cubic of t: with P₀ = I and Ṗ₀ = −I it vanishes at t = 1
//! s.

use crate::soft::{self, alone, body, spread};
use gyration::tensor::{Mat3, Vec3};
use gyration_scene::Recorded;
use gyration_sim::{Outcome, Reason};
use gyration_validation::{Case, largest};

const SOURCE: &str = "P = P₀ + t Ṗ₀";
const TOLERANCES: (f64, f64) = (1e-10, 1e-12);
/// What 10 rows of products of numbers of order one leave.
const ROUNDING: f64 = 1e-12;

#[test]
fn free_body_moves_in_a_straight_line_of_matrices() {
    let case = Case { row: Some(1), name: "box 0.1×0.2×0.3 m without stress, 10 s", source: SOURCE };
    let start = Mat3::new(1.2, 0.3, -0.1, 0.2, 0.9, 0.4, 0.0, -0.5, 1.1);
    let rate = Mat3::new(0.5, -1.0, 0.2, 2.0, 0.3, 0.7, -0.4, 0.1, 0.6);
    let shape = "shape = { box = { size = [0.1, 0.2, 0.3] } }\nvelocity = [0.3, -0.2, 0.1]\nposition = [1, 2, 3]";
    let run = alone(&body(shape, "", &start, &rate), TOLERANCES).until(10.0).sampled(1.0);
    let run = run.recording([Recorded::AffineMomentumTotal]).run();
    let times = &run.times;

    let (error, size) = spread(&run.matrices("placement_gradient"), times.iter().map(|t| start + *t * rate));
    case.check("largest error of P, over its size", 0.0, error / size, ROUNDING);
    let euler = Mat3::from_diagonal(&(Vec3::new(0.01, 0.04, 0.09) * (6.0 / 12.0)));
    let momentum = |t: &f64| (start + *t * rate) * euler * rate.transpose();
    let (error, size) = spread(&run.matrices("affine_momentum"), times.iter().map(momentum));
    case.check("largest error of K, over its size", 0.0, error / size, ROUNDING);
    let velocity = Vec3::new(0.3, -0.2, 0.1);
    let orbital = |t: &f64| 6.0 * (Vec3::new(1.0, 2.0, 3.0) + *t * velocity) * velocity.transpose();
    let total = times.iter().map(|t| momentum(t) + orbital(t));
    let (error, size) = spread(&run.matrices("affine_momentum_total"), total);
    case.check("largest error of K about the origin, over its size", 0.0, error / size, ROUNDING);
    let height = run.column("body.z");
    case.check("height of the centre after 10 s [m]", 4.0, height[10], ROUNDING);

    let conserved = case.by("conservation");
    let energy = 0.5 * (6.0 * 0.14 + (rate * euler).dot(&rate));
    let kinetic = run.column("energy.kinetic");
    let drift = largest(kinetic.iter().map(|kinetic| kinetic / energy - 1.0));
    conserved.check("largest relative error of the energy", 0.0, drift, ROUNDING);
    let spins = run.matrices("affine_momentum").into_iter().map(|k| k - k.transpose()).collect::<Vec<_>>();
    let first = momentum(&0.0) - momentum(&0.0).transpose();
    let (drift, _) = spread(&spins, times.iter().map(|_| first));
    conserved.check("largest error of the angular momentum, over its size", 0.0, drift / first.amax(), ROUNDING * 10.0);
}

#[test]
fn body_that_shrinks_to_a_point_ends_as_inverted() {
    let case = Case { row: Some(1), name: "cube with P₀ = I, Ṗ₀ = −I", source: "det P = (1 − t)³" };
    let body = body(soft::CUBE, "", &Mat3::identity(), &-Mat3::identity());
    let run = alone(&body, TOLERANCES).until(2.0).sampled(0.25).attempt();
    let Outcome::Stopped(stop) = &run.outcome else { panic!("{:?}", run.outcome) };
    println!("{}", run.outcome.in_words());
    assert_eq!((stop.reason, stop.body.as_deref()), (Reason::Inverted, Some("body")));
    case.check("time of the inversion [s]", 1.0, stop.time, 1e-12);
    let left = run.column("body.P_xx")[3];
    case.check("P_xx at 0.75 s", 0.25, left, ROUNDING);
}
