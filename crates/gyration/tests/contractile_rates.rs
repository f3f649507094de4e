//! Relations that the rates of contractile bodies obey: exact Jacobian, power balance, dissipation, known limits.

use crate::moving::*;
use gyration::body::{Affine, Body, BodyKind, Contractile};
use gyration::contact::AreaMeasure;
use gyration::contractile::{Contraction, ContractionSource, Feedback, FeedbackMeasure, Spin};
use gyration::dynamics::Workspace;
use gyration::dynamics::jacobian;
use gyration::kinematics::{Placement, Velocity};
use gyration::ledger::Work;
use gyration::load::Frame;
use gyration::model::Model;
use gyration::signal::{Signal, Wave};
use gyration::state::{Start, State};
use gyration::tensor::{Mat3, Vec3};
use nalgebra::DMatrix;
use proptest::prelude::*;
use std::sync::Arc;

/// A tensor without any symmetry.
fn tensor(seed: f64) -> Mat3 {
    Mat3::from_fn(|i, j| (1.3 * seed + 2.1 * i as f64 + 0.8 * (j * j) as f64).sin())
}

fn wave(seed: f64) -> Signal {
    Signal::Sine(Wave { amplitude: tensor(seed), frequency: 0.8, phase: 0.3 })
}

/// A drive, with parts that answer to all that a body feels.
fn driven() -> ContractionSource {
    let feedback = |measure, seed| Feedback { measure, gain: tensor(seed), bias: tensor(2.0 * seed), limits: None };
    let along = Vec3::new(0.6, 0.0, 0.8);
    let feedback = vec![
        feedback(FeedbackMeasure::SupportGap, 0.4),
        feedback(FeedbackMeasure::Stretch(along), 0.7),
        feedback(FeedbackMeasure::Rate(along), 1.1),
        Feedback { limits: Some([0.0, 0.1]), ..feedback(FeedbackMeasure::Stretch(along), 1.9) },
    ];
    ContractionSource::Driven { drive: Signal::Sum(vec![wave(0.2), Signal::Constant(tensor(0.9))]), feedback }
}

/// G = I + a small wave.
fn prescribed() -> ContractionSource {
    let Signal::Sine(wave) = wave(0.6) else { unreachable!("a wave is a sine") };
    let small = Signal::Sine(Wave { amplitude: 0.1 * wave.amplitude, ..wave });
    ContractionSource::Prescribed(Signal::Sum(vec![Signal::Constant(Mat3::identity()), small]))
}

/// A body of every kind of contraction, compressible or not, viscous or not, free or pinned.
fn model(exponents: [f64; 4], incompressible: bool, viscous: bool) -> Model {
    let sources = [
        (driven(), None, Spin::Full),
        (driven(), None, Spin::Symmetric),
        (driven(), Some(1.3), Spin::Full),
        (driven(), Some(1.3), Spin::Symmetric),
        (prescribed(), None, Spin::Full),
    ];
    let [cuboid, ..] = shapes();
    let bodies = [false, true].into_iter().flat_map(|pinned| {
        sources.clone().map(|(source, kept_volume, spin)| {
            let body = body(cuboid.clone(), Variant { incompressible, pinned, frame: Frame::Space });
            let mut affine = body.affine().unwrap().clone();
            if !viscous {
                affine.interior.viscosity = Default::default();
            }
            let contraction = Contraction { viscosity: 0.8, kept_volume, spin, source };
            Body { kind: contractile(affine, contraction), ..body }
        })
    });
    attached(Model::new(Vec3::new(0.3, -0.2, -9.81), supports(), bodies), exponents, AreaMeasure::DeformedArea)
}

fn contractile(affine: Affine, contraction: Contraction) -> BodyKind {
    BodyKind::Contractile(Box::new(Contractile::new(affine, contraction)))
}

/// A state above both supports for any 33 numbers in [−1, 1], with every det F and det G as it has to be.
fn state(model: &Model, numbers: &[f64]) -> State {
    let time = 0.37;
    let position = Vec3::new(numbers[0], numbers[1], 1.5 + 0.2 * numbers[2]);
    let rotation = *nalgebra::Rotation3::new(Vec3::new(numbers[3], numbers[7], numbers[11])).matrix();
    let gradient = rotation * (Mat3::identity() + 0.15 * Mat3::from_column_slice(&numbers[3..12]));
    let gradient_rate = Mat3::from_column_slice(&numbers[15..24]);
    let contraction = Mat3::identity() + 0.15 * Mat3::from_column_slice(&numbers[24..33]);
    let start = |body: &Arc<Body>| {
        let (affine, how) = (body.affine().unwrap(), body.contraction().unwrap());
        let restored = how.restore(&affine.interior, time, (&gradient, &gradient_rate, &contraction));
        Start::Contractile(
            Placement { position, gradient: restored.gradient },
            Velocity { velocity: Vec3::new(numbers[12], numbers[13], numbers[14]), gradient_rate: restored.rate },
            restored.contraction,
        )
    };
    let starts: Vec<Start> = model.bodies.iter().map(start).collect();
    State { time, ..State::start(model, &starts) }
}

proptest! {
    // Each case is forty bodies.
    #![proptest_config(ProptestConfig { cases: 2, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn jacobian_and_power_under_a_bound_on_friction_are_those_of_the_rates(
        numbers in numbers(33), exponents in exponents(), mu in 0.01..1.0_f64,
    ) {
        for incompressible in [false, true] {
            let model = bounded(model(exponents, incompressible, true), mu);
            for model in [model.clone(), immersed(model, false)] {
                let state = state(&model, &numbers);
                assert_jacobian_is_the_derivative(&model, &state);
                assert_power_is_the_rate_of_energy(&model, &state);
            }
        }
    }

    #[test]
    fn jacobian_and_power_of_inclusions_are_those_of_their_rates(numbers in numbers(33), exponents in exponents()) {
        for (incompressible, viscous) in [(false, true), (true, false), (true, true)] {
            for inertia in [true, false] {
                let ellipsoids = immersed(model(exponents, incompressible, viscous), inertia);
                for model in [ellipsoids.clone(), any_form::of_any_form(ellipsoids)] {
                    let state = state(&model, &numbers);
                    assert_jacobian_is_the_derivative(&model, &state);
                    assert_power_is_the_rate_of_energy(&model, &state);
                }
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn jacobian_and_power_under_forces_of_their_own_are_those_of_the_rates(
        numbers in numbers(33), exponents in exponents(),
    ) {
        for (incompressible, viscous) in [(false, true), (true, false)] {
            let model = with_own_forces(model(exponents, incompressible, viscous));
            let state = state(&model, &numbers);
            assert_jacobian_is_the_derivative(&model, &state);
            assert_power_is_the_rate_of_energy(&model, &state);
        }
    }

    #[test]
    fn jacobian_is_the_derivative_of_the_rates(numbers in numbers(33), exponents in exponents()) {
        for (incompressible, viscous) in [(false, false), (false, true), (true, false), (true, true)] {
            let model = model(exponents, incompressible, viscous);
            assert_jacobian_is_the_derivative(&model, &state(&model, &numbers));
        }
    }

    #[test]
    fn jacobian_of_a_body_alone_is_the_derivative_of_the_rates(numbers in numbers(33)) {
        // Without contacts, whose steep powers would hide errors of what is inside the body.
        for (incompressible, viscous) in [(false, false), (false, true), (true, false), (true, true)] {
            let Model { bodies, gravity, supports, .. } = model([3.0; 4], incompressible, viscous);
            let model = Model::new(gravity, supports, bodies);
            assert_jacobian_is_the_derivative(&model, &state(&model, &numbers));
        }
    }

    #[test]
    fn jacobian_owes_nothing_to_what_the_block_held_before(numbers in numbers(33)) {
        let Model { bodies, gravity, supports, .. } = model([3.0; 4], true, true);
        let model = Model::new(gravity, supports, bodies);
        let blocks = || -> Vec<_> { model.blocks().iter().map(|block| DMatrix::zeros(block.len(), block.len())).collect() };
        let fill = |state: &State, blocks: &mut [DMatrix<f64>]| {
            jacobian(&model, &mut Workspace::default(), state.time, state.numbers(), blocks).unwrap();
        };
        let (mut fresh, mut used) = (blocks(), blocks());
        let other: Vec<f64> = numbers.iter().map(|number| 0.5 * number).collect();
        fill(&state(&model, &other), &mut used);
        fill(&state(&model, &numbers), &mut used);
        fill(&state(&model, &numbers), &mut fresh);
        prop_assert_eq!(used, fresh);
    }

    #[test]
    fn friction_and_contraction_dissipate(numbers in numbers(33)) {
        let model = model([3.0; 4], true, true);
        let (_, powers) = evaluate(&model, 0.37, &state(&model, &numbers).bodies);
        prop_assert!(model.works().contains(&Work::Drive));
        for (work, power) in model.works().iter().zip(powers) {
            if [Work::Viscosity, Work::Contraction].contains(work) {
                prop_assert!(power <= 0.0, "{} does {power} W", work.name());
            }
        }
    }

    #[test]
    fn power_of_works_is_the_rate_of_energy(numbers in numbers(33), exponents in exponents()) {
        for (incompressible, viscous) in [(false, false), (false, true), (true, false), (true, true)] {
            let model = model(exponents, incompressible, viscous);
            assert_power_is_the_rate_of_energy(&model, &state(&model, &numbers));
        }
    }
}
