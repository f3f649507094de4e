//! A soft ellipsoid in a viscous shear: the loads of the fluid, their derivative, rates and Jacobian, and whole runs.
//!
//! `cargo bench -p gyration-bench --bench inclusion`
#![allow(clippy::expect_used, reason = "a benchmark that cannot go on has failed")]

use divan::Bencher;
use gyration::affine::Gyration;
use gyration::dynamics::jacobian;
use gyration::dynamics::{Workspace, rates};
use gyration::fluid::{Fluid, Form, ImmersedEllipsoid, Inclusion};
use gyration::kinematics::{Placement, Velocity};
use gyration::load::LoadSlopes;
use gyration::signal::Signal;
use gyration::tensor::{Mat3, Vec3};
use gyration_benchmark::particle_in_shear;
use gyration_ode::{Integrator, Options};
use gyration_sim::Tolerance;
use gyration_sim::adapter::ModelSystem;
use nalgebra::DMatrix;

fn main() {
    divan::main();
}

/// An ellipsoid in motion in a simple shear.
struct Immersed {
    inclusion: Inclusion,
    fluid: Fluid,
    placement: Placement,
    velocity: Velocity,
}

impl Immersed {
    fn new() -> Self {
        let form = Form::Ellipsoid(Vec3::new(1.0, 0.8, 0.6));
        let inclusion = Inclusion {
            inertia: true,
            volume: 2.0,
            center: Vec3::zeros(),
            form,
            history: None,
            neighbours: None,
            walls: None,
        };
        let shear = Mat3::new(0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
        let fluid = Fluid {
            viscosity: 1.0,
            density: 0.0,
            velocity: Signal::Constant(Mat3::zeros()),
            gradient: Signal::Constant(shear),
        };
        let gradient = Mat3::new(1.1, 0.2, 0.0, -0.1, 0.9, 0.1, 0.0, 0.2, 1.0);
        let rate = Mat3::new(0.1, 0.5, 0.0, -0.4, 0.2, 0.0, 0.3, 0.0, -0.3);
        let placement = Placement { position: Vec3::new(0.1, 0.2, 0.3), gradient };
        Self { inclusion, fluid, placement, velocity: Velocity { velocity: Vec3::x(), gradient_rate: rate } }
    }

    /// The loads, and their derivative if there is room for it.
    fn loads(&self, slopes: Option<&mut LoadSlopes>) -> f64 {
        let at = Gyration::of(&self.placement.gradient, &self.velocity.gradient_rate).expect("det P > 0");
        let around = (&self.fluid, &self.fluid.flow(0.0), &Vec3::zeros());
        let body = ImmersedEllipsoid::of(&self.inclusion, around, (&self.placement, &self.velocity), &at)
            .expect("it is not too slender")
            .expect("it is an ellipsoid");
        match slopes {
            None => body.loads(&at).force.x,
            Some(slopes) => {
                body.add_to(slopes, &at);
                slopes.loads.force.x
            }
        }
    }
}

#[divan::bench]
fn loads(bencher: Bencher) {
    let immersed = Immersed::new();
    bencher.bench_local(|| divan::black_box(&immersed).loads(None));
}

#[divan::bench]
fn loads_and_derivative(bencher: Bencher) {
    let immersed = Immersed::new();
    bencher.bench_local(|| {
        let mut slopes = LoadSlopes::default();
        divan::black_box(&immersed).loads(Some(&mut slopes))
    });
}

#[divan::bench(args = [true, false])]
fn rates_with_inertia(bencher: Bencher, inertia: bool) {
    let (model, state) = particle_in_shear(inertia);
    let mut workspace = Workspace::default();
    let (mut slopes, mut powers) = (vec![0.0; model.dimension()], vec![0.0; model.works().len()]);
    bencher.bench_local(|| {
        let bodies = divan::black_box(&state.bodies);
        rates(&model, &mut workspace, 0.0, bodies.into(), &mut slopes, &mut powers)
    });
}

#[divan::bench(args = [true, false])]
fn jacobian_with_inertia(bencher: Bencher, inertia: bool) {
    let (model, state) = particle_in_shear(inertia);
    let mut workspace = Workspace::default();
    let mut blocks = [DMatrix::zeros(model.dimension(), model.dimension())];
    bencher.bench_local(|| {
        let bodies = divan::black_box(&state.bodies);
        jacobian(&model, &mut workspace, 0.0, bodies.into(), &mut blocks[..])
    });
}

/// A hundred units of shear at the default tolerances; prints the steps it takes.
#[divan::bench(args = [true, false], sample_count = 10)]
fn run_of_a_hundred_shears(bencher: Bencher, inertia: bool) {
    let (model, state) = particle_in_shear(inertia);
    let run = || {
        let tolerance = Tolerance { rtol: 1e-8, atol: 1e-10 };
        let mut system = ModelSystem::new(model.clone(), &state, tolerance).expect("the start is admissible");
        let mut integrator = Integrator::new(0.0, &state.bodies, &state.works, Options::default());
        while integrator.time() < 100.0 {
            integrator.step(&mut system, 100.0).expect("nothing is touched");
        }
        *integrator.statistics()
    };
    let statistics = run();
    eprintln!("inertia {inertia}: {} steps, {} rate evaluations", statistics.accepted(), statistics.rate_evaluations);
    bencher.bench_local(run);
}
