//! The gallery's `double-well`: a soft ball turns over three hills of b(P_xx² − 1)², then one of its wells keeps it.
//!
//! A ball whose energy beside the elastic one is below b, the height of a hill, cannot leave its well. Source: the
//! ledger of the run.

use gyration_validation::{Answer, Experiment};

#[test]
fn ball_turns_over_three_hills_and_is_caught() {
    let run = Experiment::of_gallery("double-well", &[]).run();
    let place = run.column("ball.P_xx");
    let hills = place.windows(2).filter(|pair| pair[0] * pair[1] < 0.0).count();
    let last = place.iter().rposition(|p| *p > 0.0).unwrap();
    assert_eq!(hills, 3);
    let [kinetic, elastic, load] = ["kinetic", "elastic", "load"].map(|name| run.column(&format!("energy.{name}")));
    let end = place.len() - 1;
    let left = (kinetic[end] + elastic[end] + load[end]) / 0.15;
    println!("last over a hill at {} s; of the height of a hill {left:.3} is left", run.times[last]);
    assert!(left < 1.0 && place[end] < 0.0);
    let works = run.column("work.viscosity");
    assert!(works.windows(2).all(|pair| pair[1] <= pair[0] + 1e-12));
    let answer = |quantity, reference, measured, tolerance, source| {
        Answer { row: None, case: "gallery: double-well", quantity, reference, measured, tolerance, source }.check();
    };
    // ½ · ⅖ m R² ω² at the start, in the bottom of a well.
    let spin = 0.2 * (4.0 / 3.0 * std::f64::consts::PI) * 0.01 * 64.0;
    answer("kinetic energy at the start [J]", spin, kinetic[0], 1e-14, "½Iω²");
    answer("residual over the energy in play", 0.0, run.relative_residual(), 1e-8, "the ledger");
}
