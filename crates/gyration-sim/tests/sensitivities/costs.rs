//! What derivatives take beside a run, in counts; and derivatives at an event.

use crate::sensitivities::support::{scene, strings};
use gyration_sim::Unwatched;
use gyration_sim::events::{APEX, Event};
use gyration_sim::sensitivity::{At, Sensitivities};

/// A die that is thrown and bounces.
const DIE: &str = r#"
    time = { end = 0.3, sample = 0.3 }
    [[support]]
    name = "table"
    plane = {}
    [[contact]]
    support = "table"
    repulsion = { alpha = "245 Pa", nu = 6, d0 = "0.6 mm" }
    damping = { beta = 1e4, nu = 3, d0 = "0.6 mm" }
    friction = { beta = 3e4, nu = 3, d0 = "0.6 mm" }
    [[body]]
    name = "die"
    shape = { box = { size = ["2 cm", "2 cm", "2 cm"] } }
    density = 1250
    position = [0, 0, 0.1]
    orientation = { axis_angle = { axis = [1, 1, 0], angle = "30 deg" } }
    velocity = [0.5, 0, 0]
    angular_velocity = [0, 20, 3]
"#;

/// Numbers with which the rates go by a power, and those that the rates do not know.
const POWERS: [&str; 6] = [
    "contact.0.repulsion.alpha",
    "contact.0.repulsion.d0",
    "contact.0.damping.beta",
    "contact.0.friction.beta",
    "world.gravity.2",
    "body.die.density",
];
const STARTS: [&str; 4] =
    ["body.die.velocity.0", "body.die.velocity.2", "body.die.position.2", "body.die.angular_velocity.1"];

#[test]
fn numbers_that_the_rates_go_with_by_a_power_take_one_evaluation_a_node() {
    let scene = scene(DIE, &[]);
    let counts = |keys: &[&str]| {
        let found = Sensitivities::along(&scene, &strings(keys), &strings(&["die.z"]), At::End).unwrap();
        assert!(found.derivatives.iter().all(|derivatives| derivatives.at_end().is_ok()), "{found:?}");
        println!("{} numbers: {:?}", keys.len(), found.counts);
        found.counts
    };
    let ten = counts(&[&POWERS[..], &STARTS[..]].concat());
    // Of five nodes a step: one of the scene itself, one a number.
    assert_eq!(ten.evaluations, ten.steps * 5 * (1 + POWERS.len() as u64));
    assert_eq!(counts(&STARTS).evaluations, 0);
    // An exponent takes four neighbours, and more while its sides are compared.
    let one = counts(&["contact.0.repulsion.nu"]);
    assert!((20 * one.steps..21 * one.steps + 200).contains(&one.evaluations), "{one:?}");
    // Twice as many steps as the run, which has nothing but places to resolve.
    assert!(ten.steps < 3 * ten.run_steps, "{ten:?}");
}

#[test]
fn derivatives_at_an_event_are_those_of_a_run_that_ends_there() {
    let thrown = |until: &str| scene(DIE, &strings(&[until]));
    let (keys, columns) = (strings(&POWERS[..4]), strings(&["die.z", "die.vx"]));
    let mut has_touched = false;
    let is_apex = |event: &Event| {
        has_touched |= event.kind != APEX;
        has_touched && event.kind == APEX
    };
    let found = Sensitivities::at_event(&thrown("time.end=1"), &keys, &columns, 0.0, is_apex, &mut Unwatched).unwrap();
    let end = found.times[0];
    let shorter = thrown(&format!("time={{ end = {end:?}, sample = {end:?} }}"));
    let expected = Sensitivities::along(&shorter, &keys, &columns, At::End).unwrap();
    for (one, other) in found.derivatives.iter().zip(&expected.derivatives) {
        let (one, other) = (one.at_end().unwrap(), other.at_end().unwrap());
        println!("{one:?} {other:?}");
        let size = other.iter().fold(0.0, |most: f64, entry| most.max(entry.abs()));
        // rtol = 1e-8, and steps that differ.
        assert!(one.iter().zip(other).all(|(one, other)| (one - other).abs() < 1e-6 * size));
    }
    let none = Sensitivities::at_event(&shorter, &keys, &columns, 0.0, |_| false, &mut Unwatched).unwrap();
    assert!(none.values.is_empty() && none.derivatives.iter().all(|derivatives| derivatives.rows.is_empty()));
}
