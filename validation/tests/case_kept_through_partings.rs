//! Two balls that hit each other off centre with loss, within a reach, and part: what damping and friction took is the
//! kinetic energy lost, to the end of the run. Three balls that hit a fourth at rest from all sides, without loss: by
//! symmetry it stays where it is, and they turn back with the speed that they came with.

use gyration_validation::{Case, Experiment};

fn ball(name: &str, place: [f64; 2], speed: [f64; 2]) -> String {
    let ([x, y], [u, v]) = (place, speed);
    format!(
        "[[body]]\nname = \"{name}\"\ngroup = \"g\"\nshape = {{ sphere = {{ radius = 0.05 }} }}\nmass = 1\n\
         position = [{x}, {y}, 0]\nvelocity = [{u}, {v}, 0]\n"
    )
}

#[test]
fn what_damping_and_friction_took_stays_when_balls_part() {
    let text = r#"
        world = { gravity = [0, 0, 0] }
        time = { end = 0.3, sample = 0.01 }
        [[support]]
        name = "far wall"
        plane = { origin = [0, 0, -9] }
        [[contact]]
        support = "far wall"
        body = "b"
        repulsion = { alpha = 1e3, nu = 6, d0 = 1e-3 }
        damping = { beta = 1e3, nu = 6, d0 = 1e-3 }
        [[contact]]
        between = ["g", "g"]
        repulsion = { alpha = 1e3, nu = 6, d0 = 1e-3 }
        damping = { beta = 1e3, nu = 6, d0 = 1e-3 }
        friction = { beta = 1e3, nu = 6, d0 = 1e-3 }
        reach = 0.05
    "#;
    let run = Experiment::of_scene(&format!(
        "{}{}{}",
        text.replace("far wall", "wall"),
        ball("a", [-0.12, 0.0], [0.5, 0.0]),
        ball("b", [0.12, 0.01], [-0.5, 0.0])
    ))
    .run();
    let last = |name: &str| run.column(name)[run.times.len() - 1];
    let works = last("work.damping") + last("work.friction");
    let case = Case { row: None, name: "two balls that part within a reach", source: "conservation of energy" };
    case.check("work of damping and friction [J]", last("energy.kinetic") - 0.25, works, 1e-7);
    case.check("residual of the ledger, of the energy in play", 0.0, run.relative_residual(), 1e-7);
}

#[test]
fn a_ball_that_three_others_hit_at_once_stays_where_it_is() {
    let mut text = String::from(
        "world = { gravity = [0, 0, 0] }\ntime = { end = 1, sample = 0.01 }\n[[contact]]\nbetween = [\"g\", \"g\"]\n\
         repulsion = { alpha = 1e3, nu = 6, d0 = 1e-3 }\n",
    );
    text += &ball("c", [0.0; 2], [0.0; 2]);
    for k in 0..3 {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / 3.0).sin_cos();
        text += &ball(&format!("r{k}"), [0.13 * cos, 0.13 * sin], [-0.5 * cos, -0.5 * sin]);
    }
    let run = Experiment::of_scene(&text).run();
    let last = |name: &str| run.column(name)[run.times.len() - 1];
    let case = Case { row: None, name: "three balls hit a fourth at once", source: "symmetry, elastic impact" };
    case.check("place of the fourth [m]", 0.0, last("c.x").hypot(last("c.y")), 1e-9);
    // The potential at 30 mm, which is not the same at the end, is 1e-6 of the energy.
    case.check("speed of the third [m/s]", 0.5, last("r2.vx").hypot(last("r2.vy")), 1e-6);
    println!("{} steps", run.steps);
    assert!(run.steps < 100);
}
