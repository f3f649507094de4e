//! Bodies that lose their volume: the end is told as that, with what presses them.

use crate::islands::parsed;
use crate::runs::provenance;
use gyration_sim::{Job, MemorySink, Outcome, Reason, Simulation, Stop, Unwatched};

/// How a run of one body ends early.
fn stop(head: &str, body: &str) -> Stop {
    let text = format!("{head}\nsolver = {{ rtol = 1e-10 }}\n[[body]]\nname = \"b\"\n{body}\n");
    let scene = parsed(&text, &[]);
    let job = Job::of(&scene, &provenance());
    let mut simulation = Simulation::new(job.model, job.start, job.plan).unwrap();
    let mut sink = MemorySink::default();
    simulation.begin(&mut sink).unwrap();
    match simulation.run(&mut sink, &mut Unwatched).unwrap() {
        Outcome::Stopped(stop) => stop,
        other => panic!("{other:?}"),
    }
}

const STILL: &str = "time = { end = 10, sample = 0.5 }\nworld = { gravity = [0, 0, 0] }";
const BOX: &str = "shape = { box = { size = [0.3, 0.4, 0.5] } }\nmass = 2";

/// det P that a stop tells.
fn told(stop: &Stop) -> f64 {
    let number = stop.what.rsplit(' ').next().unwrap();
    number.parse().unwrap_or_else(|_| panic!("{}", stop.what))
}

/// The end was said to be that no step meets the tolerance, with advice on contacts, of which there are none.
#[test]
fn a_body_that_loads_press_flat_is_flattened() {
    // With c = 0.02 J/J_zz, J_zz = m h²/12, the couple gives P P̈ = −c along z, which ends at √(π/2c), and the
    // potential P̈ = −c, which ends at √(2/c).
    let c: f64 = 0.02 / (2.0 * 0.25 / 12.0);
    let couple = "affine = { couple = { value = [[0, 0, 0], [0, 0, 0], [0, 0, -0.02]] } }";
    for (loads, named, time) in [
        (couple, "its `couple`", f64::sqrt(std::f64::consts::PI / (2.0 * c))),
        ("affine = {}\npotential = \"0.02*P_zz\"", "its `potential`", f64::sqrt(2.0 / c)),
    ] {
        let stop = stop(STILL, &format!("{BOX}\n{loads}"));
        assert_eq!((stop.reason, stop.body.as_deref()), (Reason::Inverted, Some("b")), "{stop:?}");
        // Steps err by 1e-10 each.
        assert!((stop.time - time).abs() < 1e-9, "{} {time}", stop.time);
        assert!(stop.what.starts_with("body \"b\" is flattened") && (0.0..1e-9).contains(&told(&stop)), "{stop:?}");
        assert!(stop.advice.ends_with(&format!("weaken what presses it: {named}.")), "{}", stop.advice);
        assert!(!stop.advice.contains("contact"), "{}", stop.advice);
    }
}

#[test]
fn a_body_that_its_rates_flatten_is_to_start_slower() {
    let rate = "affine = {}\ngradient_rate = [[0, 0, 0], [0, 0, 0], [0, 0, -1]]";
    let stop = stop(STILL, &format!("{BOX}\n{rate}"));
    assert!(stop.reason == Reason::Inverted && stop.advice.ends_with("with a smaller `gradient_rate`."), "{stop:?}");
    assert!((0.0..1e-9).contains(&told(&stop)), "{}", stop.what);
}

/// A drive was blamed, which there is not, and det P was that of a trial, -8e3.
#[test]
fn a_contractile_body_without_a_drive_is_pressed_by_its_own_gravity() {
    let head = "time = { end = 0.1, sample = 0.01 }\nworld = { gravity = [0, 0, 0], self_gravity = { constant = 1 } }";
    let ball = "shape = { sphere = { radius = 0.1 } }\ndensity = 1000\n\
                contractile = { material = { neo_hookean = { shear = 1000 } }, viscosity = 5, \
                contraction_viscosity = 100 }";
    let stop = stop(head, ball);
    assert_eq!((stop.reason, stop.body.as_deref()), (Reason::Inverted, Some("b")), "{stop:?}");
    assert!((0.0..1e-9).contains(&told(&stop)), "{}", stop.what);
    assert!(
        stop.advice.starts_with("It has no drive") && stop.advice.contains(": its own gravity."),
        "{}",
        stop.advice
    );
}
