//! The gallery's `slide`: the block comes to the terminal speed (α/β) tan θ, which has neither its mass nor its size.
//!
//! Friction with the exponent of repulsion is (β/α) × pressure × velocity at every point. It pulls below the centre of
//! mass, so that the front edge is nearer to the slope; the sum is the same.

use gyration_validation::{Answer, Experiment};

#[test]
fn block_slides_at_a_terminal_speed_without_mass_and_size() {
    let terminal = 400.0 / 485.3 * 20.0_f64.to_radians().tan();
    // Smaller and larger ones start where their lower face has the gap of the scene's own, about 1 mm.
    let cases: [(&str, &[&str]); 4] = [
        ("gallery: slide", &[]),
        ("gallery: slide, ten times heavier", &["body.block.density=8000"]),
        (
            "gallery: slide, half as large",
            &["body.block.shape.box.size=[0.05, 0.05, 0.02]", "body.block.position=[0.00377, 0, 0.01035]"],
        ),
        (
            "gallery: slide, twice as wide and half as high",
            &["body.block.shape.box.size=[0.2, 0.2, 0.02]", "body.block.position=[0.00377, 0, 0.01035]"],
        ),
    ];
    for (case, others) in cases {
        let velocity = Experiment::of_gallery("slide", others).run().end;
        let experiment = Experiment::of_gallery("slide", others);
        let velocity = velocity.motion(&experiment.model, 0).velocity.velocity;
        let (sin, cos) = 20.0_f64.to_radians().sin_cos();
        let answer = |quantity, reference, measured, tolerance, source| {
            Answer { row: None, case, quantity, reference, measured, tolerance, source }.check()
        };
        // e^−22 of the start is left after 2 s.
        let down = velocity.x * cos - velocity.z * sin;
        answer("speed down the slope after 2 s [m/s]", terminal, down, 1e-6, "(α/β) tan θ");
        answer("velocity across the slope [m/s]", 0.0, velocity.y, 1e-12, "symmetry");
    }
}
