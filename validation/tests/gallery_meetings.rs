//! The gallery's `collide`, `soft-collision`, `dice-pair`, `overhang`, `cradle` and `dominoes`: bodies that meet.

use gyration::state::State;
use gyration_sim::Outcome;
use gyration_validation::{Case, Experiment, momenta, wave};

#[test]
fn boxes_and_rubber_balls_that_collide_keep_their_momenta() {
    for (name, case) in [("collide", "gallery: collide"), ("soft-collision", "gallery: soft-collision")] {
        let experiment = Experiment::of_gallery(name, &[]);
        let run = experiment.run();
        let (before, after) = (momenta(&experiment.model, &experiment.start), momenta(&experiment.model, &run.end));
        let case = Case { row: None, name: case, source: "momenta of two bodies alone" };
        case.check("change of momentum [kg m/s]", 0.0, (after.0 - before.0).norm(), 1e-14);
        // To the tolerance of the steps.
        case.check("change of angular momentum [kg m²/s]", 0.0, (after.1 - before.1).norm(), 1e-9);
        assert!(run.relative_residual() < 1e-7);
        let turned = [0, 1].map(|body| {
            let spin = |state: &State| state.motion(&experiment.model, body).angular_velocity();
            (spin(&run.end) - spin(&experiment.start)).norm()
        });
        assert!(turned.iter().all(|turned| *turned > 0.5), "{turned:?}: they have met");
    }
}

#[test]
fn dice_that_meet_settle_beside_each_other() {
    let experiment = Experiment::of_gallery("dice-pair", &[]);
    let run = experiment.run();
    let [left, right] = [0, 1].map(|body| run.end.motion(&experiment.model, body));
    let case = Case { row: None, name: "gallery: dice-pair", source: "W = αA (d/d₀)^−ν under a face" };
    // 0.1 N on 4 cm² of 245 Pa; the sides are felt by a hundredth of it.
    for (quantity, motion) in [("gap under the left die [m]", &left), ("gap under the right die [m]", &right)] {
        case.check(quantity, 6.0e-4, motion.placement.position.z - 0.01, 0.02);
    }
    assert!(left.placement.position.x < right.placement.position.x - 0.02 && run.relative_residual() < 1e-7);
}

#[test]
fn a_brick_tips_over_another_beyond_half_of_its_length_and_not_within() {
    for (place, tips) in [("0.045", false), ("0.055", true)] {
        let experiment = Experiment::of_gallery("overhang", &[&format!("body.upper.position.0={place}")]);
        let run = experiment.attempt();
        assert!(!matches!(run.outcome, Outcome::Stopped(_)), "{}", run.outcome.in_words());
        let upper = run.end.motion(&experiment.model, 1);
        let fallen = upper.placement.gradient[(2, 0)].abs() > 0.3;
        assert_eq!(fallen, tips, "at {place} m: {}", upper.placement.gradient);
    }
}

#[test]
fn the_last_ball_of_a_cradle_takes_nearly_all_of_the_speed() {
    let experiment = Experiment::of_gallery("cradle", &[]);
    let run = experiment.sampled(0.001).until(0.3).sampled(0.001).run();
    let fastest = |ball: &str| run.column(&format!("{ball}.vx")).into_iter().fold(0.0, f64::max);
    let (first, last) = (fastest("ball-0"), fastest("ball-4"));
    println!("{:.4} of the speed", last / first);
    // Balls that touch and act at no distance: all of it. Here the others tremble with the rest.
    assert!(last / first > 0.95 && last / first < 1.0, "{first} {last}");
    assert!(run.relative_residual() < 1e-7);
}

#[test]
fn a_row_of_dominoes_topples_faster_without_friction_between_them() {
    let experiment = Experiment::of_gallery("dominoes", &[]).sampled(0.001);
    let run = experiment.run();
    let smooth = Experiment::of_gallery("dominoes", &["contact.1.friction.mu=0"]).until(0.25).sampled(0.001).run();
    let [rough, smooth] = [&run, &smooth].map(|run| wave(run, 6, 0.0375));
    println!("{rough:.4?} and {smooth:.4?} m/s");
    assert!([&rough, &smooth].iter().all(|it| it.windows(2).all(|pair| pair[1] > pair[0])), "{rough:?} {smooth:?}");
    assert!(rough.iter().zip(&smooth).all(|(rough, smooth)| rough < smooth), "{rough:?} {smooth:?}");
    // Van Leeuwen (physics/0401018): 1.6448 √(g H) in a long row with d/H = 0.15, s/H = 0.6 and no slip at the foot.
    let limit = 1.6448 * (9.81_f64 * 0.05).sqrt();
    let share = smooth[3] / limit;
    assert!((0.9..1.0).contains(&share), "the last step at {share} of the speed of a long row");
    let last = run.end.motion(&experiment.model, 5).placement.gradient;
    assert!(last[(0, 2)] > 0.99, "the last one does not lie: {last}");
    assert!(run.relative_residual() < 1e-7);
}

#[test]
fn a_long_row_of_dominoes_comes_to_the_speed_of_its_wave() {
    let (height, thickness, pitch, dominoes) = (0.05, 0.0075, 0.0275, 13);
    let laws = "repulsion = { alpha = 1e3, nu = 6, d0 = 1e-4 }\ndamping = { beta = 5e4, nu = 6, d0 = 1e-4 }\n";
    let mut scene = format!(
        "time = {{ end = 0.4, sample = 0.001 }}\nsolver = {{ rtol = 1e-5, atol = 1e-7 }}\n\
         [[support]]\nname = \"floor\"\nplane = {{}}\n[[contact]]\nsupport = \"floor\"\n{laws}\
         friction = {{ beta = 3e5, nu = 6, d0 = 1e-4 }}\n\
         [[contact]]\nbetween = [\"domino\", \"domino\"]\n{laws}reach = 5e-3\n"
    );
    for domino in 0..dominoes {
        scene += &format!(
            "[[body]]\nname = \"domino-{domino}\"\ngroup = \"domino\"\ndensity = 700\n\
             shape = {{ box = {{ size = [{thickness}, 0.025, {height}] }} }}\nposition = [{:?}, 0, 0.02512]\n",
            pitch * domino as f64
        );
        if domino == 0 {
            scene += "velocity = [0.5, 0, 0.075]\nangular_velocity = [0, 20, 0]\n";
        }
    }
    let speeds = wave(&Experiment::of_scene(&scene).run(), dominoes, pitch);
    let root = (9.81_f64 * height).sqrt();
    println!("{:.4?} √(g H)", speeds.iter().map(|speed| speed / root).collect::<Vec<_>>());
    let case = Case {
        row: None,
        name: "a long row of dominoes, d/H = 0.15, s/H = 0.4, no friction between them",
        source: "v = (s+d)/∫ dθ/ω of dominoes that rest on one another, no slip at the foot: 1.7597 √(gH)",
    };
    case.check("speed of the wave over √(g H)", 1.759737, speeds[speeds.len() - 1] / root, 2e-2);
}
