//! What a stepper costs beside the rates: steps of a system whose rates are all but free.
//!
//!     cargo bench -p gyration-bench --bench steppers [-- METHOD]
//!
//! Thirteen components and three quadratures, as of a rigid body under three laws; rates of a few dozen operations. The
//! second table sets the costs of the mechanics beside it: rates, Jacobian and the linear algebra of an implicit step
//! of a cube, in units of the rates, which is how the choice between the steppers counts them. With a METHOD
//! (explicit, implicit) only the steps are made, for callgrind.
#![allow(clippy::expect_used, reason = "a benchmark that cannot go on has failed")]

use gyration::dynamics::jacobian;
use gyration::dynamics::{Workspace, rates};
use gyration_bench::{SHAPES, near_table, seconds_each};
use gyration_ode::{Integrator, Method, Options, System};
use nalgebra::DMatrix;
use std::convert::Infallible;
use std::ops::Range;

const SIZE: usize = 13;
const WORKS: usize = 3;
const STEPS: u32 = 1000;

/// A chain of weakly coupled oscillators, y'_i = y_{i+1} − y_{i−1} − c y_i around a ring, w'_k = y_k².
struct Ring {
    block: Range<usize>,
}

const DECAY: f64 = 1e-3;

impl System for Ring {
    type Inadmissible = Infallible;

    fn dimension(&self) -> usize {
        SIZE
    }

    fn quadratures(&self) -> usize {
        WORKS
    }

    fn blocks(&self) -> &[Range<usize>] {
        std::slice::from_ref(&self.block)
    }

    fn rates(&mut self, _: f64, y: &[f64], dy: &mut [f64], dw: &mut [f64]) -> Result<(), Infallible> {
        for i in 0..SIZE {
            let (after, before) = (y[if i + 1 == SIZE { 0 } else { i + 1 }], y[if i == 0 { SIZE - 1 } else { i - 1 }]);
            dy[i] = after - before - DECAY * y[i];
        }
        for (power, value) in dw.iter_mut().zip(y) {
            *power = value * value;
        }
        Ok(())
    }

    fn jacobian(&mut self, _: f64, _: &[f64], blocks: &mut [DMatrix<f64>]) -> Result<(), Infallible> {
        for i in 0..SIZE {
            blocks[0][(i, (i + 1) % SIZE)] = 1.0;
            blocks[0][(i, (i + SIZE - 1) % SIZE)] = -1.0;
            blocks[0][(i, i)] = -DECAY;
        }
        Ok(())
    }

    fn error_scales(&mut self, _: f64, _: &[f64], _: &[f64], y_scale: &mut [f64], w_scale: &mut [f64]) {
        y_scale.fill(1.0);
        w_scale.fill(1.0);
    }

    fn project(&mut self, _: f64, _: &mut [f64], _: &mut [f64]) -> f64 {
        0.0
    }
}

/// Steps of fixed size; returns the calls of the rates.
fn make_steps(method: Method, steps: u32) -> u64 {
    let h = 0.01;
    let start: Vec<f64> = (0..SIZE).map(|i| (1.7 * i as f64).sin()).collect();
    let mut ring = Ring { block: 0..SIZE };
    let options = Options { method, max_step: h, initial_step: Some(h) };
    let mut integrator = Integrator::new(0.0, &start, &[0.0; WORKS], options);
    for _ in 0..steps {
        integrator.step(&mut ring, f64::INFINITY).expect("a linear system");
    }
    integrator.statistics().rate_evaluations
}

/// Prints what steps cost; returns the seconds of an implicit one.
fn own_cost() -> f64 {
    println!("| steps | ns a step | calls a step | ns a call |");
    let mut implicit = 0.0;
    for method in [Method::Explicit, Method::Implicit] {
        let calls = make_steps(method, STEPS) as f64 / f64::from(STEPS);
        let steps = seconds_each(|| {
            std::hint::black_box(make_steps(method, STEPS));
        });
        let step = steps / f64::from(STEPS);
        println!("| {method:?} | {:.0} | {calls:.1} | {:.0} |", 1e9 * step, 1e9 * step / calls);
        implicit = step;
    }
    implicit
}

/// Seconds of one call of the rates and of the Jacobian.
fn costs_of_mechanics(shape: &str, height: f64) -> (f64, f64) {
    let (model, state) = near_table(shape, height, (6.0, 3.0));
    let mut workspace = Workspace::default();
    let (mut slopes, mut powers) = (vec![0.0; model.dimension()], vec![0.0; model.works().len()]);
    let mut blocks = vec![DMatrix::zeros(SIZE, SIZE)];
    let call = seconds_each(|| {
        let bodies = std::hint::black_box(&state.bodies);
        rates(&model, &mut workspace, 0.0, bodies, &mut slopes, &mut powers).expect("it is apart");
    });
    let derivatives = seconds_each(|| {
        let bodies = std::hint::black_box(&state.bodies);
        jacobian(&model, &mut workspace, 0.0, bodies, &mut blocks).expect("it is apart");
    });
    (call, derivatives)
}

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    for (word, method) in [("explicit", Method::Explicit), ("implicit", Method::Implicit)] {
        if words.iter().any(|argument| argument == word) {
            return println!("{STEPS} steps, {} calls", make_steps(method, STEPS));
        }
    }
    let linear = own_cost();
    println!("\n| shape | rates | Jacobian, in rates | own cost of an implicit step, in rates |");
    for (name, shape, height) in SHAPES {
        let (call, derivatives) = costs_of_mechanics(shape, height);
        println!("| {name} | {:.0} ns | {:.1} | {:.1} |", 1e9 * call, derivatives / call, linear / call);
    }
}
