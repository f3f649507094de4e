//! A run continued from its checkpoint, and a run that is sampled, make the steps of a plain run to the last bit.

use crate::common::{self, Problem, barrier, kepler, perihelion, with};
use gyration_ode::{ImplicitOrder, Integrator, Limit, Memory, MemoryError, Method, Options, StepReport, Stepper};

/// Every stepper, and the choice.
fn all() -> [Options; 5] {
    let [five, nine, thirteen] = common::implicit();
    [with(Method::Auto), with(Method::Explicit), five, nine, thirteen]
}

/// A damped drop that comes to rest, stiff at the end: both steppers are used, and quadratures.
fn drop_to_rest() -> (Problem, [f64; 2], f64) {
    (barrier(300.0).tolerances(1e-7, 1e-9), [3.0, 0.0], 200.0)
}

/// Steps to the end, with an action after each.
fn follow(
    problem: &mut Problem,
    mut integrator: Integrator,
    end: f64,
    mut after: impl FnMut(&mut Problem, Integrator) -> Integrator,
) -> (Integrator, Vec<Stepper>) {
    let mut steppers = Vec::new();
    while integrator.time() < end {
        steppers.push(integrator.step(problem, end).unwrap().stepper);
        integrator = after(problem, integrator);
    }
    (integrator, steppers)
}

fn bits(memory: &Memory) -> (Vec<u64>, Vec<u64>) {
    (memory.reals.iter().map(|value| value.to_bits()).collect(), memory.integers.clone())
}

#[test]
fn resuming_at_every_step_changes_no_bit() {
    for options in all() {
        let (mut problem, start, end) = drop_to_rest();
        // The explicit method alone would need a million steps to the end.
        let end = if options.method == Method::Explicit { 4.0 } else { end };
        let options = Options { max_step: 5.0, ..options };
        let fresh = || Integrator::new(0.0, &start, &[0.0, 0.0], options);
        let (plain, steppers) = follow(&mut problem, fresh(), end, |_, integrator| integrator);
        let (resumed, _) = follow(&mut problem, fresh(), end, |_, integrator| {
            Integrator::resume(&integrator.memory(), options).unwrap()
        });
        println!("{options:?}: {:?}", plain.statistics());
        assert_eq!(bits(&plain.memory()), bits(&resumed.memory()), "{options:?}");
        assert_eq!(plain.statistics(), resumed.statistics());
        if options.method == Method::Auto {
            assert!(steppers.contains(&Stepper::Explicit) && steppers.contains(&Stepper::Implicit));
        }
    }
}

/// Whoever is told checkpoint and last step sees what lies within it, and goes on from there.
#[test]
fn a_step_that_somebody_else_made_is_seen_within_to_the_last_bit() {
    for options in all() {
        let (mut problem, start, end) = drop_to_rest();
        let end = if options.method == Method::Explicit { 4.0 } else { end };
        let fresh = || Integrator::new(0.0, &start, &[0.0, 0.0], options);
        let (plain, _) = follow(&mut problem, fresh(), end, |_, integrator| integrator);
        let (told, _) = follow(&mut problem, fresh(), end, |_, integrator| {
            let (memory, last_step) = (integrator.memory(), integrator.last_step_numbers());
            let told = Integrator::resume_within(&memory, &last_step, options).unwrap();
            let (a, b) = integrator.last_step().unwrap();
            assert_eq!(told.last_step(), Some((a, b)));
            for part in [0.0, 0.3, 0.9, 1.0] {
                let within = |integrator: &Integrator| {
                    let (mut y, mut w) = ([0.0; 2], [0.0; 2]);
                    integrator.interpolate(a + part * (b - a), &mut y, &mut w);
                    [y, w].as_flattened().iter().map(|value| value.to_bits()).collect::<Vec<_>>()
                };
                assert_eq!(within(&told), within(&integrator), "{options:?}, {part} of {a} to {b}");
            }
            for cut in [1, 2, last_step.len() - 1] {
                assert!(Integrator::resume_within(&memory, &last_step[..cut], options).is_err());
            }
            told
        });
        assert_eq!(bits(&plain.memory()), bits(&told.memory()), "{options:?}");
    }
}

/// What is said of a step is the same once it has been numbers.
#[test]
fn a_report_of_a_step_is_made_of_its_numbers() {
    let limits =
        [Limit::Error { component: 3 }, Limit::Stability, Limit::Domain, Limit::Newton, Limit::MaxStep, Limit::End];
    for (limit, stepper) in limits.into_iter().zip([Stepper::Explicit, Stepper::Implicit].into_iter().cycle()) {
        let report = StepReport { start: 0.1, end: 0.3, stepper, limit, error: 0.7, projection: 1e-17, rejections: 2 };
        assert_eq!(StepReport::of_numbers(report.numbers()), Some(report));
    }
    assert_eq!(StepReport::of_numbers([9; 8]), None);
}

#[test]
fn resuming_before_the_first_step_changes_no_bit() {
    let options = with(Method::Auto);
    let integrator = Integrator::new(0.0, &perihelion(0.2), &[], options);
    let resumed = Integrator::resume(&integrator.memory(), options).unwrap();
    let [first, second] = [integrator, resumed].map(|integrator| {
        let (integrator, _) = follow(&mut kepler(), integrator, 1.0, |_, integrator| integrator);
        bits(&integrator.memory())
    });
    assert_eq!(first, second);
}

#[test]
fn sampling_changes_no_bit() {
    for options in all() {
        let (mut problem, start, end) = drop_to_rest();
        let end = if options.method == Method::Explicit { 4.0 } else { end };
        let fresh = || Integrator::new(0.0, &start, &[0.0, 0.0], options);
        let (plain, _) = follow(&mut problem, fresh(), end, |_, integrator| integrator);
        let (sampled, _) = follow(&mut problem, fresh(), end, |_, integrator| {
            let (a, b) = integrator.last_step().unwrap();
            let before = bits(&integrator.memory());
            let (mut y, mut w) = ([0.0; 2], [0.0; 2]);
            integrator.interpolate(0.5 * (a + b), &mut y, &mut w);
            assert_eq!(bits(&integrator.memory()), before);
            integrator
        });
        assert_eq!(bits(&plain.memory()), bits(&sampled.memory()), "{options:?}");
    }
}

/// At both ends the interpolant is the state itself, projected as it is; between them it stays near.
#[test]
fn interpolation_meets_the_accepted_states() {
    for options in all() {
        let mut problem = kepler().tolerances(1e-6, 1e-6);
        problem.project = |y| {
            y[0] *= 1.0 + 1e-9;
            1e-9
        };
        let mut integrator = Integrator::new(0.0, &perihelion(0.5), &[], options);
        for _ in 0..20 {
            let before = integrator.state().to_vec();
            let report = integrator.step(&mut problem, 100.0).unwrap();
            let mut y = [0.0; 4];
            integrator.interpolate(report.start, &mut y, &mut []);
            assert_eq!(y.as_slice(), before);
            integrator.interpolate(report.end, &mut y, &mut []);
            assert_eq!(y.as_slice(), integrator.state());
            // Continuous there: a relative 1e-12 of the step before its end, within what the rates allow.
            integrator.interpolate(report.end - 1e-12 * (report.end - report.start), &mut y, &mut []);
            assert!(common::distance(&y, integrator.state()) < 1e-11);
        }
    }
}

#[test]
fn numbers_that_are_no_checkpoint_are_refused() {
    let options = Options::default();
    let good = Integrator::new(0.0, &[1.0, 2.0], &[3.0], options).memory();
    assert!(Integrator::resume(&good, options).is_ok());
    let mut wrong = good.clone();
    wrong.integers[0] = 99;
    assert_eq!(Integrator::resume(&wrong, options).unwrap_err(), MemoryError::Version { found: 99 });
    let mut short = good.clone();
    short.reals.pop();
    assert!(matches!(Integrator::resume(&short, options), Err(MemoryError::Length { .. })));
    let mut sizes = good.clone();
    sizes.integers[1] = u64::MAX;
    assert!(matches!(Integrator::resume(&sizes, options), Err(MemoryError::Length { .. })));
    let of_another = Options { order: ImplicitOrder::Nine, ..options };
    assert_eq!(Integrator::resume(&good, of_another).unwrap_err(), MemoryError::Order { found: 5 });
    // A time, the next step, the mistakes of the choice of a stepper, the last counter.
    let step = good.reals.len() - 11;
    for (place, number) in [(0, f64::NAN), (step, -1.0), (step, f64::INFINITY)] {
        let mut damaged = good.clone();
        damaged.reals[place] = number;
        let found = Integrator::resume(&damaged, options);
        assert!(matches!(found, Err(MemoryError::Number { .. })), "{place}: {number}");
    }
    for place in [8, 9, good.integers.len() - 1] {
        let mut damaged = good.clone();
        damaged.integers[place] = u64::MAX;
        assert!(matches!(Integrator::resume(&damaged, options), Err(MemoryError::Number { .. })), "{place}");
    }
}
