//! Softer laws of a crowd, as the survey proposes them: a body lies where they say, bounces as before, costs less.

use crate::islands::parsed;
use gyration_scene::Scene;
use gyration_sim::survey::{SoftnessSurvey, Survey};
use gyration_sim::{MemorySink, Outcome, RunPlan, Simulation, Unwatched};
use serde_json::Value;

/// Dice of 2 cm above a floor in one row of columns of three, each turned and thrown down in a way of its own.
fn dice(count: usize, laws: &str, head: &str) -> String {
    let mut text = format!(
        "{head}\n[[support]]\nname = \"floor\"\nplane = {{}}\n[[contact]]\nsupport = \"floor\"\n{laws}\n\
         [[contact]]\nbetween = [\"dice\", \"dice\"]\nreach = \"5 mm\"\n{laws}\n"
    );
    for k in 0..count {
        let [x, z] = [0.036 * (k / 3) as f64, 0.02 + 0.036 * (k % 3) as f64];
        let turn = 0.3 * k as f64;
        text += &format!(
            "[[body]]\nname = \"die-{k}\"\ngroup = \"dice\"\nshape = {{ box = {{ size = [0.02, 0.02, 0.02] }} }}\n\
             density = 1250\nposition = [{x}, 0, {z}]\norientation = {{ euler_xyz = [{turn}, {}, 0] }}\n\
             velocity = [0, 0, -0.5]\n",
            0.5 * turn
        );
    }
    text
}

/// What is proposed, and the same scene with it: each number is written over the one of the scene.
fn softened(text: &str) -> (SoftnessSurvey, Scene) {
    let scene = parsed(text, &[]);
    let [told] = &Survey::of(&scene).unwrap().softness[..] else { panic!("one softness is told") };
    let proposed = serde_json::to_value(&told.proposed).unwrap();
    let laws = ["repulsion", "damping", "friction"].into_iter().filter_map(|law| Some((law, proposed.get(law)?)));
    let numbers = laws.flat_map(|(law, keys)| {
        let keys = keys.as_object().unwrap().iter().filter(|(_, value)| value.is_number());
        keys.map(move |(key, value)| (format!("{law}.{key}"), value.clone())).collect::<Vec<(String, Value)>>()
    });
    let numbers: Vec<(String, Value)> = numbers.collect();
    let of = |contact: &usize| {
        let key = move |(key, value): &(String, Value)| format!("contact.{contact}.{key}={value}");
        numbers.iter().map(key).collect::<Vec<_>>()
    };
    let reaches = told
        .proposed
        .reach_of
        .iter()
        .map(|contact| format!("contact.{contact}.reach={}", told.proposed.reach.unwrap()));
    let overrides: Vec<String> = told.contacts.iter().flat_map(of).chain(reaches).collect();
    (told.clone(), parsed(text, &overrides.iter().map(String::as_str).collect::<Vec<_>>()))
}

/// The laws of the heap, as stiff as ten times nearer, with an exponent of damping and friction.
fn laws(viscous: f64) -> String {
    let beta = if viscous == 6.0 { 100.0 } else { 4e3 };
    format!(
        "repulsion = {{ alpha = 245, nu = 6, d0 = 6e-5 }}\n\
         damping = {{ beta = {beta}, nu = {viscous}, d0 = 6e-5 }}\n\
         friction = {{ beta = {beta}, nu = {viscous}, d0 = 6e-5 }}\n"
    )
}

const HEAD: &str = "time = { end = 0.12, sample = 0.01 }\nsolver = { rtol = 1e-3 }";

/// One die flat above the floor, thrown down, with the laws of the first contact of a scene.
fn alone(like: &Scene, head: &str) -> Scene {
    let contact = serde_json::to_value(&like.file().contact[0]).unwrap();
    let law = |name: &str| format!("{name} = {}\n", toml_of(&contact[name]));
    let laws: String = ["repulsion", "damping", "friction"].into_iter().map(law).collect();
    parsed(
        &format!(
            "{head}\n[[support]]\nname = \"floor\"\nplane = {{}}\n[[contact]]\nsupport = \"floor\"\n{laws}\
             [[body]]\nname = \"die\"\nshape = {{ box = {{ size = [0.02, 0.02, 0.02] }} }}\ndensity = 1250\n\
             position = [0, 0, 0.02]\nvelocity = [0, 0, -0.5]\n"
        ),
        &[],
    )
}

/// A table of numbers.
fn toml_of(law: &Value) -> String {
    let keys = law.as_object().unwrap().iter().map(|(key, value)| format!("{key} = {value}"));
    format!("{{ {} }}", keys.collect::<Vec<_>>().join(", "))
}

#[test]
fn a_body_lies_where_the_softer_laws_say() {
    let (told, softer) = softened(&dice(9, &laws(3.0), HEAD));
    assert_eq!((told.contacts.clone(), told.bodies, told.proposed.reach_of.clone()), (vec![0, 1], 9, vec![1]));
    assert!((told.thickness - 0.02).abs() < 1e-15 && (told.proposed.rest_gap - 6e-4).abs() < 1e-15);
    assert!((told.rest_gap - 6e-5).abs() < 1e-7 && (told.proposed.reach.unwrap() - 0.015).abs() < 1e-12);
    assert!((told.fewer_steps - 10.0).abs() < 0.1 && told.nearest.is_none());
    // The survey of a body alone finds its gap by another search.
    let survey = Survey::of(&alone(&softer, HEAD)).unwrap();
    let [rest] = &survey.bodies[0].supports[0].rests[..] else { panic!("one gap") };
    assert!((rest.gap / told.proposed.rest_gap - 1.0).abs() < 1e-9, "{} of {}", rest.gap, told.proposed.rest_gap);
    // What lies no nearer than 2 % of its thickness is left alone.
    assert!(Survey::of(&softer).unwrap().softness.is_empty());
}

/// Between faces by the powers alone; what the sides of the die add is of the order of gap over size.
#[test]
fn a_flat_impact_returns_as_much_as_before() {
    let head = "world = { gravity = [0, 0, 0] }\ntime = { end = 0.2, sample = 0.1 }";
    for (viscous, off) in [(6.0, 1e-3), (3.0, 2e-2)] {
        let text = dice(9, &laws(viscous), HEAD);
        let (_, softer) = softened(&text);
        let returned = |scene: &Scene| {
            let scene = alone(scene, head);
            let mut run = simulation(&scene);
            run.run(&mut MemorySink::default(), &mut Unwatched).unwrap();
            2.0 * run.state().motion(&scene.built().model, 0).velocity.velocity.z
        };
        let [now, then] = [returned(&parsed(&text, &[])), returned(&softer)];
        assert!((0.2..0.95).contains(&now), "{viscous}: {now}");
        assert!((then / now - 1.0).abs() < off, "{viscous}: {now} {then}");
    }
}

#[test]
fn a_poured_crowd_takes_half_of_the_steps() {
    let text = dice(9, &laws(3.0), HEAD);
    let (_, softer) = softened(&text);
    let steps = |scene: &Scene| {
        let mut run = simulation(scene);
        assert_eq!(run.run(&mut MemorySink::default(), &mut Unwatched).unwrap(), Outcome::Completed);
        run.statistics().explicit_steps + run.statistics().implicit_steps
    };
    let [now, then] = [steps(&parsed(&text, &[])), steps(&softer)];
    assert!(2 * then < now, "{now} steps, with softer laws {then}");
}

#[test]
fn few_bodies_and_crowds_without_weight_or_with_what_holds_them_are_left_alone() {
    let told = |text: &str| Survey::of(&parsed(text, &[])).unwrap().softness.len();
    assert_eq!(told(&dice(9, &laws(3.0), HEAD)), 1);
    assert_eq!(told(&dice(8, &laws(3.0), HEAD)), 0);
    assert_eq!(told(&dice(9, &laws(3.0), &format!("world = {{ gravity = [0, 0, 0] }}\n{HEAD}"))), 0);
    let sticky = "adhesion = { beta = 1, nu_attractive = 3, nu_repulsive = 9, d0 = 1e-4 }\n";
    assert_eq!(told(&dice(9, &(laws(3.0) + sticky), HEAD)), 0);
}

fn simulation(scene: &Scene) -> Simulation {
    let built = scene.built();
    let mut run = Simulation::new(&built.model, &built.state, RunPlan::from(built)).unwrap();
    run.begin(&mut MemorySink::default()).unwrap();
    run
}
