//! Blocks that couple: the linear equations of an implicit step are solved by elimination over a pattern.

use crate::common::chain::{Balls, Chain, Shown};
use crate::common::{Problem, distance, fixed, run_system, short, slopes, with};
use allocation_counter::measure;
use gyration_ode::{
    BlockMatrix, Cause, Components, Failure, Integrator, Memory, Method, Options, Pattern, Stepper, System,
};
use std::convert::Infallible;
use std::ops::Range;

const END: f64 = 0.2;

#[test]
fn a_stiff_chain_follows_its_normal_modes() {
    let cases = [(Method::Implicit, Shown::Coupled), (Method::Auto, Shown::Reduced)];
    // The slowest mode of the short chain decays, that of the long one oscillates.
    for ((method, shown), (bodies, time)) in cases.into_iter().flat_map(|case| [(case, (10, 0.02)), (case, (300, END))])
    {
        let mut chain = Chain::new(bodies, shown);
        let start = chain.exact(0.0);
        let end = run_system(&mut chain, &start, &[0.0], (0.0, time), with(method));
        let (exact, s) = (chain.exact(time), end.statistics());
        assert!(exact.iter().any(|value| value.abs() > 0.1));
        let worst = (0..2 * bodies).map(|i| (end.state()[i] - exact[i]).abs() / [1.0, 1e2][i % 2]).fold(0.0, f64::max);
        println!("{bodies} bodies, {method:?}: {worst:.1e}, {s:?}");
        // Errors of some hundred steps of 1e-7 each, in a system that damps them.
        assert!(worst < 1e-5, "{bodies} bodies, {method:?}: {worst:e}");
        // An explicit step is shorter than 3/4e4: the choice must find that the chain is stiff.
        assert!(s.accepted() < 1000 && s.implicit_steps > 20, "{s:?}");
    }
}

/// Steps of fixed size of a linear system: the two eliminations differ by rounding.
#[test]
fn a_chain_of_blocks_steps_like_one_dense_block() {
    let [coupled, reduced, whole] = [Shown::Coupled, Shown::Reduced, Shown::Whole].map(|shown| {
        let mut chain = Chain::new(12, shown);
        chain.atol = 1e3;
        let start = chain.exact(0.0);
        run_system(&mut chain, &start, &[0.0], (0.0, 0.01), fixed(with(Method::Implicit), 1e-4))
    });
    assert_eq!(coupled.statistics().accepted(), whole.statistics().accepted());
    let apart = [&coupled, &reduced].map(|integrator| distance(integrator.state(), whole.state()));
    println!("{}", short(&apart));
    // Velocities of order 100 and matrices of condition 1e4.
    assert!(coupled.state()[1].abs() > 1.0 && apart.iter().all(|apart| *apart < 1e-9), "{}", short(&apart));
    assert!(coupled.entries_of_factors() == 4 * reduced.entries_of_factors() && whole.entries_of_factors() == 0);
}

#[test]
fn the_order_stays_with_coupling() {
    let errors: Vec<f64> = [32, 64, 128]
        .iter()
        .map(|steps| {
            // Slow enough to be resolved; linear, so that any tolerance lets the fixed steps pass.
            let mut chain = Chain::new(20, Shown::Reduced);
            (chain.stiffness, chain.damping, chain.atol) = (100.0, 1.0, 1e3);
            let start = chain.mode(1, 0.0);
            let end = run_system(
                &mut chain,
                &start,
                &[0.0],
                (0.0, 5.0),
                fixed(with(Method::Implicit), 5.0 / f64::from(*steps)),
            );
            assert_eq!(end.statistics().accepted(), *steps as u64);
            distance(end.state(), &chain.mode(1, 5.0))
        })
        .collect();
    println!("errors {}, slopes {:.2?}", short(&errors), slopes(&errors));
    // Half an order for the next term, as for one block (`order`).
    assert!((4.6..5.6).contains(slopes(&errors).last().unwrap()), "{:?}", slopes(&errors));
}

/// Numbers in the factors and evaluations in a step, by counting: both linear in the number of blocks, which has no
/// fill.
#[test]
fn the_cost_of_a_chain_is_linear_in_its_length() {
    let lengths = [10, 100, 1000, 10_000];
    for (bodies, (shown, numbers)) in
        lengths.into_iter().flat_map(|bodies| [(bodies, (Shown::Coupled, 4)), (bodies, (Shown::Reduced, 1))])
    {
        let mut chain = Chain::new(bodies, shown);
        let start = chain.exact(0.0);
        let options = Options { initial_step: Some(1e-4), ..with(Method::Implicit) };
        let mut integrator = Integrator::new(0.0, &start, &[0.0], options);
        for _ in 0..3 {
            integrator.step(&mut chain, 1.0).unwrap();
        }
        // N diagonal blocks and 2(N − 1) beside them, in a real and a complex matrix.
        assert_eq!(integrator.entries_of_factors(), 3 * numbers * (3 * bodies - 2));
        let s = integrator.statistics();
        assert!(s.rate_evaluations < 80 && s.factorizations < 10, "{bodies}: {s:?}");
    }
}

fn bits(memory: &Memory) -> (Vec<u64>, Vec<u64>) {
    (memory.reals.iter().map(|value| value.to_bits()).collect(), memory.integers.clone())
}

/// Balls that bounce, by the implicit method alone, and balls that creep, by the method that is chosen for them.
const FALLS: [(f64, Method); 2] = [(3e5, Method::Implicit), (1e8, Method::Auto)];

/// Lets balls fall for a while, with an action between the steps. Returns the end and how often the pattern changed.
fn fall(
    (damping, method): (f64, Method),
    shown: Shown,
    mut between: impl FnMut(Integrator, Options) -> Integrator,
) -> (Integrator, usize) {
    let mut balls = Balls::new(6, damping, shown);
    let options = Options { max_step: 0.05, ..with(method) };
    let mut integrator = Integrator::new(0.0, &balls.start(), &[], options);
    while integrator.time() < 3.0 {
        integrator.step(&mut balls, 3.0).unwrap();
        integrator = between(integrator, options);
    }
    (integrator, balls.changes)
}

#[test]
fn balls_that_come_to_touch_change_the_pattern_and_not_the_solution() {
    for (case, least) in FALLS.into_iter().zip([10, 5]) {
        let (coupled, changes) = fall(case, Shown::Coupled, |integrator, _| integrator);
        let (whole, _) = fall(case, Shown::Whole, |integrator, _| integrator);
        let apart = distance(coupled.state(), whole.state());
        println!("{case:?}: {apart:.1e} apart, {changes} patterns, {:?}", coupled.statistics());
        assert!(changes >= least && coupled.statistics().implicit_steps > 20);
        // A thousand steps of 1e-7; impacts of balls on balls amplify what came before.
        assert!(apart < 1e-4, "{case:?}: {apart:e}");
    }
}

#[test]
fn resuming_at_every_step_changes_no_bit_while_the_pattern_changes() {
    for case in FALLS {
        let (plain, _) = fall(case, Shown::Coupled, |integrator, _| integrator);
        let resume = |integrator: Integrator, options| Integrator::resume(&integrator.memory(), options).unwrap();
        let (resumed, changes) = fall(case, Shown::Coupled, resume);
        assert_eq!(bits(&plain.memory()), bits(&resumed.memory()), "{case:?}");
        assert!(changes >= 5 && plain.statistics().implicit_steps > 20);
    }
}

#[test]
fn nothing_is_allocated_while_the_pattern_stays() {
    let mut chain = Chain::new(50, Shown::Reduced);
    let start = chain.exact(0.0);
    let mut integrator = Integrator::new(0.0, &start, &[0.0], with(Method::Auto));
    while integrator.statistics().implicit_steps == 0 {
        integrator.step(&mut chain, END).unwrap();
    }
    let counted = measure(|| {
        while integrator.time() < END {
            integrator.step(&mut chain, END).unwrap();
        }
    });
    assert_eq!(counted.count_total, 0);
    assert!(integrator.statistics().implicit_steps > 20);
}

/// x' = a y, y' = a x in two blocks, with what the matrix is to be.
struct Pair {
    rate: f64,
    slope: f64,
    components: Components,
}

impl Pair {
    fn new(rate: f64, slope: f64) -> Self {
        Self { rate, slope, components: Components::of(&Self::pattern(), 2) }
    }

    fn pattern() -> Pattern {
        Pattern::new(2, [(0, 1), (1, 0)])
    }
}

impl System for Pair {
    type Inadmissible = Infallible;

    fn dimension(&self) -> usize {
        2
    }

    fn quadratures(&self) -> usize {
        0
    }

    fn blocks(&self) -> &[Range<usize>] {
        const { &[0..1, 1..2] }
    }

    fn components(&self) -> &Components {
        &self.components
    }

    fn rates(&mut self, _: f64, y: &[f64], dy: &mut [f64], _: &mut [f64]) -> Result<(), Infallible> {
        (dy[0], dy[1]) = (self.rate * y[1], self.rate * y[0]);
        Ok(())
    }

    fn jacobian(&mut self, _: f64, _: &[f64], jacobian: &mut BlockMatrix) -> Result<(), Infallible> {
        jacobian.arrange(&Self::pattern());
        for (row, column) in [(0, 1), (1, 0)] {
            jacobian.block_mut(row, column).unwrap()[(0, 0)] = self.slope;
        }
        Ok(())
    }

    fn error_scales(&mut self, _: f64, _: &[f64], _: &[f64], y_scale: &mut [f64], _: &mut [f64]) {
        y_scale.fill(1e-6);
    }

    fn project(&mut self, _: f64, _: &mut [f64], _: &mut [f64]) -> f64 {
        0.0
    }
}

#[test]
fn a_singular_matrix_costs_a_smaller_step() {
    // The real eigenvalue of the inverse of Radau's matrix: γ/h I − J is singular for h = 1.
    let gamma = 3.637_834_252_744_496;
    let mut pair = Pair::new(gamma, gamma);
    let options = Options { initial_step: Some(1.0), ..with(Method::Implicit) };
    let end = run_system(&mut pair, &[1.0, 0.0], &[], (0.0, 2.0), options);
    let exact = (2.0 * gamma).cosh();
    assert!(end.statistics().newton_failures > 0 && (end.state()[0] / exact - 1.0).abs() < 1e-6);
}

#[test]
fn a_matrix_that_is_no_number_is_an_error() {
    let mut pair = Pair::new(1.0, f64::NAN);
    let mut integrator = Integrator::new(0.0, &[1.0, 0.0], &[], with(Method::Implicit));
    let failure = integrator.step(&mut pair, 1.0).unwrap_err();
    assert!(matches!(failure, Failure::StepTooSmall { cause: Cause::Newton, .. }), "{failure}");
    assert_eq!(integrator.state(), [1.0, 0.0]);
    // The explicit method needs no matrix.
    let mut integrator = Integrator::new(0.0, &[1.0, 0.0], &[], with(Method::Auto));
    assert_eq!(integrator.step(&mut pair, 1.0).unwrap().stepper, Stepper::Explicit);
}

#[test]
#[should_panic = "the components are not those of 1 blocks"]
fn components_of_other_blocks_are_refused() {
    let mut problem = Problem::new(2, |_, _, dy| dy.fill(0.0), |_, _, _| ());
    problem.components = Components::joined(2, [[0, 1]]);
    let _ = Integrator::new(0.0, &[1.0, 0.0], &[], with(Method::Auto)).step(&mut problem, 1.0);
}
