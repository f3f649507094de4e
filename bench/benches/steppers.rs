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
use gyration_benchmark::{SHAPES, near_table, seconds_each};
use gyration_ode::{BlockMatrix, Components, ImplicitOrder, Integrator, Method, Options, Pattern, System};
use nalgebra::DMatrix;
use std::convert::Infallible;
use std::ops::Range;
use std::time::Instant;

const SIZE: usize = 13;
const WORKS: usize = 3;
const STEPS: u32 = 1000;

/// y' = M y, w'_k = y_k², M with few entries, in blocks of one size.
struct Linear {
    works: usize,
    /// Errors allowed of the numbers of a block, by turns.
    scales: [f64; 2],
    blocks: Vec<Range<usize>>,
    pattern: Pattern,
    components: Components,
    /// Row, column and value of the entries that are not zero.
    entries: Vec<(usize, usize, f64)>,
}

const DECAY: f64 = 1e-3;

impl Linear {
    /// A ring of weakly coupled oscillators in one block, y'_i = y_{i+1} − y_{i−1} − c y_i.
    fn ring() -> Self {
        let row = |i: usize| [(i, (i + 1) % SIZE, 1.0), (i, (i + SIZE - 1) % SIZE, -1.0), (i, i, -DECAY)];
        let entries = (0..SIZE).flat_map(row).collect();
        let blocks = std::iter::once(0..SIZE).collect();
        let (pattern, components) = (Pattern::uncoupled(), Components::apart());
        Self { works: WORKS, scales: [1.0; 2], blocks, pattern, components, entries }
    }

    /// Unit masses between two walls, a block (x, v) each: x_i'' = k Δx_i + c Δx'_i, Δx_i = x_{i−1} − 2x_i + x_{i+1}.
    fn chain(bodies: usize) -> Self {
        let bond = |i: usize, j: usize, sign: f64| {
            [(2 * i + 1, 2 * j, sign * STIFFNESS), (2 * i + 1, 2 * j + 1, sign * DAMPING)]
        };
        let near = move |i: usize| i.saturating_sub(1)..(i + 2).min(bodies);
        let row = move |i: usize| {
            let bonds = near(i).flat_map(move |j| bond(i, j, if i == j { -2.0 } else { 1.0 }));
            std::iter::once((2 * i, 2 * i + 1, 1.0)).chain(bonds)
        };
        let neighbours = (1..bodies).flat_map(|i| [(i - 1, i), (i, i - 1)]);
        let pattern = Pattern::new(bodies, neighbours).with_local_rates(vec![1; bodies]);
        Self {
            works: 0,
            scales: [1e-7, 1e-5],
            blocks: (0..bodies).map(|i| 2 * i..2 * i + 2).collect(),
            components: Components::of(&pattern, bodies),
            pattern,
            entries: (0..bodies).flat_map(row).collect(),
        }
    }
}

impl System for Linear {
    type Inadmissible = Infallible;

    fn dimension(&self) -> usize {
        self.blocks.iter().map(ExactSizeIterator::len).sum()
    }

    fn quadratures(&self) -> usize {
        self.works
    }

    fn blocks(&self) -> &[Range<usize>] {
        &self.blocks
    }

    fn components(&self) -> &Components {
        &self.components
    }

    fn rates(&mut self, _: f64, y: &[f64], dy: &mut [f64], dw: &mut [f64]) -> Result<(), Infallible> {
        dy.fill(0.0);
        self.entries.iter().for_each(|(row, column, value)| dy[*row] += value * y[*column]);
        dw.iter_mut().zip(y).for_each(|(power, value)| *power = value * value);
        Ok(())
    }

    fn jacobian(&mut self, _: f64, _: &[f64], jacobian: &mut BlockMatrix) -> Result<(), Infallible> {
        let size = self.blocks[0].len();
        jacobian.arrange(&self.pattern);
        for (row, column, value) in &self.entries {
            let block = jacobian.block_mut(row / size, column / size).expect("it is in the pattern");
            block[(row % size, column % size)] = *value;
        }
        Ok(())
    }

    fn error_scales(&mut self, _: f64, _: &[f64], _: &[f64], y_scale: &mut [f64], w_scale: &mut [f64]) {
        y_scale.iter_mut().zip(self.scales.iter().cycle()).for_each(|(scale, value)| *scale = *value);
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
    let mut ring = Linear::ring();
    let options = Options { method, max_step: h, initial_step: Some(h), ..DEFAULT };
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
    let mut blocks = [DMatrix::zeros(SIZE, SIZE)];
    let call = seconds_each(|| {
        let bodies = std::hint::black_box(&state.bodies);
        rates(&model, &mut workspace, 0.0, bodies.into(), &mut slopes, &mut powers).expect("it is apart");
    });
    let derivatives = seconds_each(|| {
        let bodies = std::hint::black_box(&state.bodies);
        jacobian(&model, &mut workspace, 0.0, bodies.into(), &mut blocks[..]).expect("it is apart");
    });
    (call, derivatives)
}

const STIFFNESS: f64 = 1e6;
const DAMPING: f64 = 1e4;
const LENGTHS: [usize; 4] = [10, 100, 1000, 10_000];
/// Seven stages, as runs have at the tolerance that is the default.
const DEFAULT: Options =
    Options { method: Method::Auto, order: ImplicitOrder::Thirteen, max_step: f64::INFINITY, initial_step: None };
const CHAIN_STEPS: u32 = 20;

/// Implicit steps of a chain, the first of which makes room; seconds of one, and the integrator at the end.
fn chain_steps(bodies: usize) -> (f64, Integrator) {
    let start: Vec<f64> = (0..2 * bodies).map(|i| if i % 2 == 0 { (1.7 * i as f64).sin() } else { 0.0 }).collect();
    let mut chain = Linear::chain(bodies);
    let options = Options { method: Method::Implicit, initial_step: Some(1e-5), ..DEFAULT };
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
        "\n| bodies in a chain | numbers of factors a body | evaluations a step | factorizations a step | ns a step \
            and body |"
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
