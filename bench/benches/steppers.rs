//! What a stepper costs beside the rates: steps of a system whose rates are all but free.
//!
//!     cargo bench -p gyration-bench --bench steppers [-- METHOD]
//!
//! Thirteen components and three quadratures, as of a rigid body under three laws; rates of a few dozen operations. The
//! second table sets the costs of the mechanics beside it: rates, Jacobian and the linear algebra of an implicit step
//! of a cube, in units of the rates, which is how the choice between the steppers counts them. The third is of a stiff
//! chain of coupled blocks, whose cost is to be linear in its length. With a METHOD (explicit, implicit, chain) only
//! the steps are made, for callgrind.
#![allow(clippy::expect_used, reason = "a benchmark that cannot go on has failed")]

use gyration::dynamics::jacobian;
use gyration::dynamics::{Workspace, rates};
use gyration_bench::{SHAPES, near_table, seconds_each};
use gyration_ode::{BlockMatrix, Integrator, Method, Options, Pattern, System};
use nalgebra::DMatrix;
use std::convert::Infallible;
use std::ops::Range;
use std::time::Instant;

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

    fn jacobian(&mut self, _: f64, _: &[f64], jacobian: &mut BlockMatrix) -> Result<(), Infallible> {
        let blocks = jacobian.diagonal_mut();
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

/// Unit masses between two walls, x_i'' = Δ(k x + c x')_i with Δx_i = x_{i−1} − 2x_i + x_{i+1}: a block (x, v) each.
struct Chain {
    blocks: Vec<Range<usize>>,
    pattern: Pattern,
}

const STIFFNESS: f64 = 1e6;
const DAMPING: f64 = 1e4;
const LENGTHS: [usize; 4] = [10, 100, 1000, 10_000];
const CHAIN_STEPS: u32 = 20;

impl Chain {
    fn new(bodies: usize) -> Self {
        let neighbours = (1..bodies).flat_map(|i| [(i - 1, i), (i, i - 1)]);
        Self {
            blocks: (0..bodies).map(|i| 2 * i..2 * i + 2).collect(),
            pattern: Pattern::new(bodies, neighbours).with_local_rates(vec![1; bodies]),
        }
    }
}

impl System for Chain {
    type Inadmissible = Infallible;

    fn dimension(&self) -> usize {
        2 * self.blocks.len()
    }

    fn quadratures(&self) -> usize {
        0
    }

    fn blocks(&self) -> &[Range<usize>] {
        &self.blocks
    }

    fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    fn rates(&mut self, _: f64, y: &[f64], dy: &mut [f64], _: &mut [f64]) -> Result<(), Infallible> {
        let n = self.blocks.len();
        let pull = |i: usize| STIFFNESS * y[2 * i] + DAMPING * y[2 * i + 1];
        for i in 0..n {
            let (before, after) = (if i > 0 { pull(i - 1) } else { 0.0 }, if i + 1 < n { pull(i + 1) } else { 0.0 });
            (dy[2 * i], dy[2 * i + 1]) = (y[2 * i + 1], before - 2.0 * pull(i) + after);
        }
        Ok(())
    }

    fn jacobian(&mut self, _: f64, _: &[f64], jacobian: &mut BlockMatrix) -> Result<(), Infallible> {
        for i in 0..self.blocks.len() {
            for j in i.saturating_sub(1)..(i + 2).min(self.blocks.len()) {
                let block = jacobian.block_mut(i, j).expect("neighbours couple");
                let sign = if i == j { -2.0 } else { 1.0 };
                (block[(1, 0)], block[(1, 1)]) = (sign * STIFFNESS, sign * DAMPING);
            }
            jacobian.diagonal_mut()[i][(0, 1)] = 1.0;
        }
        Ok(())
    }

    fn error_scales(&mut self, _: f64, _: &[f64], _: &[f64], y_scale: &mut [f64], _: &mut [f64]) {
        y_scale.chunks_exact_mut(2).for_each(|body| body.copy_from_slice(&[1e-7, 1e-5]));
    }

    fn project(&mut self, _: f64, _: &mut [f64], _: &mut [f64]) -> f64 {
        0.0
    }
}

/// Implicit steps of a chain, the first of which makes room; seconds of one, and the integrator at the end.
fn chain_steps(bodies: usize) -> (f64, Integrator) {
    let start: Vec<f64> = (0..2 * bodies).map(|i| if i % 2 == 0 { (1.7 * i as f64).sin() } else { 0.0 }).collect();
    let mut chain = Chain::new(bodies);
    let options = Options { method: Method::Implicit, initial_step: Some(1e-5), ..Options::default() };
    let mut integrator = Integrator::new(0.0, &start, &[], options);
    integrator.step(&mut chain, 1.0).expect("a linear system");
    let clock = Instant::now();
    for _ in 0..CHAIN_STEPS {
        integrator.step(&mut chain, 1.0).expect("a linear system");
    }
    (clock.elapsed().as_secs_f64() / f64::from(CHAIN_STEPS), integrator)
}

fn cost_of_coupling() {
    println!(
        "\n| bodies in a chain | numbers of factors a body | evaluations a step | factorizations a step | ns a step and body |"
    );
    for bodies in LENGTHS {
        let (mut seconds, integrator) = chain_steps(bodies);
        for _ in 0..10_000 / bodies {
            seconds = seconds.min(chain_steps(bodies).0);
        }
        let (s, n) = (integrator.statistics(), bodies as f64);
        let steps = s.accepted() as f64;
        let (evaluations, factorizations) = (s.rate_evaluations as f64 / steps, s.factorizations as f64 / steps);
        let entries = integrator.entries_of_factors() as f64 / n;
        println!("| {bodies} | {entries:.1} | {evaluations:.1} | {factorizations:.2} | {:.0} |", 1e9 * seconds / n);
    }
}

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    for (word, method) in [("explicit", Method::Explicit), ("implicit", Method::Implicit)] {
        if words.iter().any(|argument| argument == word) {
            return println!("{STEPS} steps, {} calls", make_steps(method, STEPS));
        }
    }
    if words.iter().any(|argument| argument == "chain") {
        return LENGTHS
            .iter()
            .for_each(|bodies| println!("{bodies}: {} steps", chain_steps(*bodies).1.statistics().accepted()));
    }
    let linear = own_cost();
    println!("\n| shape | rates | Jacobian, in rates | own cost of an implicit step, in rates |");
    for (name, shape, height) in SHAPES {
        let (call, derivatives) = costs_of_mechanics(shape, height);
        println!("| {name} | {:.0} ns | {:.1} | {:.1} |", 1e9 * call, derivatives / call, linear / call);
    }
    cost_of_coupling();
}
