//! Stacks of balls, the cradle, dominoes.

use super::{ALPHA, DENSITY, GRAVITY, floor, halved_each, laws, row, scene, sphere};
use crate::published::Runs;
use crate::{Experiment, Run, wave};

/// Velocities of the upper and the lower of two balls after the fall, with this gap between them.
fn stack(d0: f64, between: f64) -> [f64; 2] {
    let law = laws(ALPHA, d0, 0.0, 0.0, None);
    let low = 0.02 + 1e-3;
    let high = low + 0.02 + between + 0.01;
    let balls = sphere("lower", 0.02, DENSITY, [0.0, 0.0, low], [0.0, 0.0, -1.0], "")
        + &sphere("upper", 0.01, DENSITY, [0.0, 0.0, high], [0.0, 0.0, -1.0], "");
    let contact = format!("[[contact]]\nbetween = [\"upper\", \"lower\"]\n{law}");
    let experiment = scene([0.0; 3], 0.03, 0.03, &(floor(&law) + &contact + &balls));
    let run = experiment.run();
    [1, 0].map(|body| run.end.motion(&experiment.model, body).velocity.velocity.z)
}

#[test]
fn a_ball_on_a_ball_leaves_as_impacts_that_follow_one_another_say() {
    let [upper, lower] = halved_each(1e-4, |d0| stack(d0, 10e-3));
    row("stack-10-mm-upper").check(upper);
    row("stack-10-mm-lower").check(lower);
    let [upper, _] = halved_each(1e-4, |d0| stack(d0, 1e-3));
    row("stack-1-mm-upper").check(upper);
}

#[test]
fn impacts_that_overlap_lift_the_upper_ball_less() {
    row("stack-0.1-mm-upper").check(Runs::Once(stack(1e-4, 1e-4)[0]));
    row("stack-0.03-mm-upper").check(Runs::Once(stack(1e-4, 3e-5)[0]));
}

/// A number of each of the five balls of the cradle at a sample.
fn balls(run: &Run, sample: usize, column: &str) -> [f64; 5] {
    [0, 1, 2, 3, 4].map(|ball| run.column(&format!("ball-{ball}.{column}"))[sample])
}

#[test]
fn the_line_of_a_cradle_stays_at_the_first_knock() {
    // The last ball has left 5 ms before.
    let run = Experiment::of_gallery("cradle", &[]).until(0.17).run();
    let speeds = balls(&run, 1, "vx");
    println!("speeds after the first knock: {speeds:?}");
    let parted = speeds.windows(2).filter(|pair| pair[1] - pair[0] > 1e-3 * speeds[4]).count();
    row("cradle-breaks").check(Runs::Once(parted as f64));
}

#[test]
fn a_damped_cradle_ends_in_phase() {
    let text = gyration_scene::gallery_scene("cradle").unwrap();
    let damped = text.replace("reach =", "damping = { beta = 5e6, nu = 6, d0 = 1e-4 }\nreach =");
    assert_ne!(damped, text);
    let run = Experiment::of_scene(&damped).until(60.0).sampled(0.02).run();
    let end = run.times.len();
    let (mut apart, mut fastest) = (0.0_f64, 0.0_f64);
    for sample in end - 50..end {
        let speeds = balls(&run, sample, "vx");
        let [low, high] = speeds.iter().fold([f64::MAX, f64::MIN], |[low, high], it| [low.min(*it), high.max(*it)]);
        apart = apart.max(high - low);
        fastest = fastest.max(high.abs()).max(low.abs());
    }
    println!("speeds of at most {fastest} m/s, {apart} m/s apart");
    assert!(fastest > 0.01, "they have come to rest");
    row("cradle-in-phase").check(Runs::Once(apart / fastest));
}

#[test]
fn a_row_of_dominoes_comes_to_the_speed_of_its_wave() {
    let (height, thickness, pitch, dominoes) = (0.05, 0.0075, 0.0275, 15);
    let law = "repulsion = { alpha = 1e3, nu = 6, d0 = 1e-4 }\ndamping = { beta = 5e4, nu = 6, d0 = 1e-4 }\n";
    let mut text = format!(
        "time = {{ end = 0.375, sample = 0.001 }}\nsolver = {{ rtol = 1e-6, atol = 1e-8 }}\n{}\
         friction = {{ beta = 3e5, nu = 6, d0 = 1e-4 }}\n[[contact]]\nbetween = [\"domino\", \"domino\"]\n{law}\
         reach = 5e-3\n",
        floor(law)
    );
    for domino in 0..dominoes {
        text += &format!(
            "[[body]]\nname = \"domino-{domino}\"\ngroup = \"domino\"\ndensity = 700\n\
             shape = {{ box = {{ size = [{thickness}, 0.025, {height}] }} }}\nposition = [{:?}, 0, 0.02512]\n",
            pitch * domino as f64
        );
        if domino == 0 {
            text += "velocity = [0.5, 0, 0.075]\nangular_velocity = [0, 20, 0]\n";
        }
    }
    let run = Experiment::of_scene(&text).run();
    let speeds = wave(&run, dominoes, pitch);
    let speed = speeds[speeds.len() - 1];
    row("dominoes").check(Runs::Once(speed / (GRAVITY * height).sqrt()));
}
