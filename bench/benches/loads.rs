//! Loads of one body near a table under three laws, with and without their derivatives, the moments of a stretched
//! body, and the rates and the Jacobian of the whole body around them.
#![allow(clippy::expect_used, reason = "a benchmark that cannot go on has failed")]

use divan::Bencher;
use gyration::contact::{ContactScratch, ContactWrench, LawSet, RelativeMotion, RigidLoads, RigidMotion};
use gyration::dynamics::{Workspace, jacobian, rates};
use gyration::state::Turn;
use gyration::surface::{GapClosed, GapField, Kernel, MomentPlan, MomentRequest, Moments, OrientedMoments, Surface};
use gyration::tensor::Mat3;
use gyration_benchmark::{SHAPES, near_table};
use nalgebra::DMatrix;

fn main() {
    divan::main();
}

const NAMES: [&str; 6] = ["box", "sphere", "cylinder", "cone", "ellipsoid", "torus"];

fn set_up(name: &str, exponents: (f64, f64)) -> (gyration::model::Model, gyration::state::State) {
    let (_, shape, height) = SHAPES.into_iter().find(|(shape, ..)| *shape == name).unwrap_or(SHAPES[0]);
    near_table(shape, height, exponents)
}

/// The contact of the body with the table at its start.
fn meeting(model: &gyration::model::Model, state: &gyration::state::State) -> (GapField, RigidMotion) {
    let motion = state.motion(model, 0);
    let support = &model.supports[0];
    let field = support.gap_field(&motion.placement, 0.0);
    let relative = RelativeMotion::to(support, &motion, 0.0);
    let turn = Turn::read(model.slots(0), &state.bodies);
    (field, RigidMotion::new(&relative, &motion.placement.gradient, turn.spin))
}

/// Times one way of integrating the laws of the body's contact.
fn bench_contact<T>(
    bencher: Bencher,
    (name, exponents): (&str, (f64, f64)),
    integrate: fn(&LawSet, &Surface, &GapField, &RigidMotion, &mut ContactScratch) -> Result<T, GapClosed>,
) {
    let (model, state) = set_up(name, exponents);
    let (field, motion) = meeting(&model, &state);
    let body = &model.bodies[0];
    let surface = body.solid.surface.as_ref().expect("every shape here has a surface");
    let mut scratch = ContactScratch::default();
    bencher.bench_local(|| {
        integrate(&model.contacts()[0].law_set, surface, divan::black_box(&field), &motion, &mut scratch)
    });
}

#[divan::bench(args = NAMES)]
fn loads(bencher: Bencher, name: &str) {
    bench_contact(bencher, (name, (6.0, 3.0)), RigidLoads::integrate);
}

#[divan::bench(args = NAMES)]
fn loads_with_jacobian(bencher: Bencher, name: &str) {
    bench_contact(bencher, (name, (6.0, 3.0)), ContactWrench::integrate);
}

#[divan::bench(args = NAMES)]
fn loads_real(bencher: Bencher, name: &str) {
    bench_contact(bencher, (name, (6.3, 3.2)), RigidLoads::integrate);
}

#[divan::bench(args = NAMES)]
fn loads_with_jacobian_real(bencher: Bencher, name: &str) {
    bench_contact(bencher, (name, (6.3, 3.2)), ContactWrench::integrate);
}

/// A stretch and shear of a few tenths, and the cofactor of its gradient.
fn stretched() -> (Mat3, Mat3) {
    let gradient = Mat3::new(1.2, 0.1, -0.2, 0.0, 0.9, 0.15, 0.1, -0.1, 0.8);
    let cofactor = gradient.try_inverse().expect("the gradient is regular").transpose() * gradient.determinant();
    (gradient, cofactor)
}

/// The surface of the body and the gap that it has when it is stretched and raised by a tenth of its height.
fn stretched_meeting(name: &str) -> (Surface, GapField, Mat3) {
    let (model, state) = set_up(name, (6.0, 3.0));
    let (field, _) = meeting(&model, &state);
    let surface = model.bodies[0].solid.surface.clone().expect("every shape here has a surface");
    let (gradient, cofactor) = stretched();
    let direction = gradient.tr_mul(&field.direction);
    let (gap, _) = surface.smallest_gap(&field);
    let (lowest, _) = surface.smallest_gap(&GapField::new(0.0, direction));
    (surface, GapField::new(gap - lowest, direction), cofactor)
}

fn plan(requests: &[(f64, usize)]) -> MomentPlan {
    let request = |&(exponent, order)| MomentRequest { kernel: Kernel::Power(exponent), order };
    MomentPlan::new(requests.iter().map(request).collect())
}

#[divan::bench(args = NAMES)]
fn deformed_moments(bencher: Bencher, name: &str) {
    let (surface, field, cofactor) = stretched_meeting(name);
    let plan = plan(&[(6.0, 1), (3.0, 2)]);
    let mut out = [Moments::default(); 2];
    bencher.bench_local(|| surface.deformed_moments(divan::black_box(&field), &cofactor, &plan, &mut out));
}

#[divan::bench(args = NAMES)]
fn undeformed_moments(bencher: Bencher, name: &str) {
    let (surface, field, _) = stretched_meeting(name);
    let plan = plan(&[(6.0, 1), (3.0, 2)]);
    let mut out = [Moments::default(); 2];
    bencher.bench_local(|| surface.planned_moments(divan::black_box(&field), &plan, &mut out));
}

#[divan::bench(args = NAMES)]
fn oriented_moments(bencher: Bencher, name: &str) {
    let (surface, field, cofactor) = stretched_meeting(name);
    let plan = plan(&[(6.0, 1), (3.0, 2)]);
    let mut out = [OrientedMoments::default(); 2];
    bencher.bench_local(|| surface.oriented_moments(divan::black_box(&field), &cofactor, &plan, &mut out));
}

#[divan::bench(args = NAMES)]
fn oriented_moments_with_fourth(bencher: Bencher, name: &str) {
    let (surface, field, cofactor) = stretched_meeting(name);
    let plan = plan(&[(6.0, 1), (3.0, 2), (5.0, 0)]);
    let mut out = [OrientedMoments::default(); 3];
    bencher.bench_local(|| surface.oriented_moments(divan::black_box(&field), &cofactor, &plan, &mut out));
}

fn bench_rates(bencher: Bencher, name: &str, exponents: (f64, f64)) {
    let (model, state) = set_up(name, exponents);
    let mut workspace = Workspace::default();
    let (mut slopes, mut powers) = (vec![0.0; model.dimension()], vec![0.0; model.works().len()]);
    bencher.bench_local(|| {
        let bodies = divan::black_box(&state.bodies);
        rates(&model, &mut workspace, 0.0, bodies.into(), &mut slopes, &mut powers)
    });
}

fn bench_jacobian(bencher: Bencher, name: &str, exponents: (f64, f64)) {
    let (model, state) = set_up(name, exponents);
    let mut workspace = Workspace::default();
    let mut blocks = [DMatrix::zeros(13, 13)];
    bencher.bench_local(|| {
        let bodies = divan::black_box(&state.bodies);
        jacobian(&model, &mut workspace, 0.0, bodies.into(), &mut blocks[..])
    });
}

#[divan::bench(args = NAMES)]
fn rates_integer(bencher: Bencher, name: &str) {
    bench_rates(bencher, name, (6.0, 3.0));
}

#[divan::bench(args = NAMES)]
fn rates_real(bencher: Bencher, name: &str) {
    bench_rates(bencher, name, (6.3, 3.2));
}

#[divan::bench(args = NAMES)]
fn jacobian_integer(bencher: Bencher, name: &str) {
    bench_jacobian(bencher, name, (6.0, 3.0));
}

#[divan::bench(args = NAMES)]
fn jacobian_real(bencher: Bencher, name: &str) {
    bench_jacobian(bencher, name, (6.3, 3.2));
}
