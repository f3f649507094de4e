//! Impulses and largest forces of the contacts of each interval between samples.

use crate::islands::parsed;
use crate::runs::provenance;
use gyration::tensor::Vec3;
use gyration_scene::Scene;
use gyration_sim::{FirstSteps, Job, MemorySink, Simulation, Unwatched};

/// Samples of the columns of a run, and how many steps it took.
struct Run {
    rows: Vec<(f64, Vec<f64>)>,
    names: Vec<String>,
    steps: u64,
}

impl Run {
    fn of(scene: &Scene) -> Self {
        let job = Job::of(scene, &provenance());
        let mut simulation = Simulation::new(job.model, job.start, job.plan).unwrap();
        let mut sink = MemorySink::default();
        simulation.begin(&mut sink).unwrap();
        simulation.run(&mut sink, &mut Unwatched).unwrap();
        let arrays = job.layout().arrays;
        let names = arrays
            .iter()
            .flat_map(|array| (0..array.row_len()).map(|place| format!("{}.{place}", array.name)).collect::<Vec<_>>());
        Self { rows: sink.rows, names: names.collect(), steps: simulation.statistics().accepted() }
    }

    fn at(&self, row: usize, array: &str, place: usize) -> f64 {
        let name = format!("{array}.{place}");
        self.rows[row].1[self.names.iter().position(|known| *known == name).unwrap()]
    }

    fn vector(&self, row: usize, array: &str, body: usize) -> Vec3 {
        Vec3::from_fn(|i, _| self.at(row, array, 3 * body + i))
    }

    /// The sum of the impulses of a body, and the largest of its peaks.
    fn total(&self, body: usize) -> (Vec3, f64) {
        let impulses = (1..self.rows.len()).map(|row| self.vector(row, "impulse", body)).sum();
        let peaks = (0..self.rows.len()).map(|row| self.at(row, "peak_force", body));
        (impulses, peaks.fold(0.0, f64::max))
    }
}

const ASKED: &str = "record = { quantities = [\"impulse\", \"peak_force\"] }";

/// A ball that is thrown at a table, and rolls on.
fn ball(record: &str, gravity: f64, end: f64, sample: f64, more: &str) -> Scene {
    parsed(&ball_text(record, gravity, end, sample, more), &[])
}

/// The same on a table that pushes from a hundred times as far: it turns in milliseconds, which samples resolve.
fn soft_ball(sample: f64) -> Scene {
    parsed(&ball_text(ASKED, -9.81, 0.06, sample, "").replace("d0 = 1e-4", "d0 = 1e-2"), &[])
}

fn ball_text(record: &str, gravity: f64, end: f64, sample: f64, more: &str) -> String {
    format!(
        r#"
        world = {{ gravity = [0, 0, {gravity}] }}
        time = {{ end = {end}, sample = {sample} }}
        {record}
        {more}
        [[support]]
        name = "table"
        plane = {{ origin = [0, 0, 0], normal = [0, 0, 1] }}
        [[contact]]
        support = "table"
        repulsion = {{ alpha = 1e4, nu = 6, d0 = 1e-4 }}
        damping = {{ beta = 20, nu = 6, d0 = 1e-4 }}
        friction = {{ beta = 300, nu = 6, d0 = 1e-4, mu = 0.3 }}
        [[body]]
        name = "ball"
        shape = {{ sphere = {{ radius = 0.02 }} }}
        density = 1000
        position = [0, 0, 0.05]
        velocity = [0.7, 0.2, -1]
        "#
    )
}

fn mass(scene: &Scene, body: usize) -> f64 {
    scene.built().model.bodies[body].solid.mass.mass
}

#[test]
fn impulses_are_the_changes_of_momentum_whatever_the_method_and_the_samples() {
    for (gravity, method, sample) in
        [(0.0, "explicit", 0.06), (0.0, "implicit", 0.06), (-9.81, "explicit", 0.0071), (-9.81, "implicit", 1e-4)]
    {
        let scene = ball(ASKED, gravity, 0.06, sample, &format!("solver = {{ method = \"{method}\" }}"));
        let (run, mass) = (Run::of(&scene), mass(&scene, 0));
        let mut largest: f64 = 0.0;
        for row in 1..run.rows.len() {
            let time = run.rows[row].0 - run.rows[row - 1].0;
            let change = mass * (run.vector(row, "velocity", 0) - run.vector(row - 1, "velocity", 0));
            let pushed = run.vector(row, "impulse", 0) + mass * time * Vec3::new(0.0, 0.0, gravity);
            largest = largest.max((pushed - change).norm() / (mass * 1.2));
        }
        println!("{method}, g {gravity}, sample {sample}: {largest:.1e} of the momentum");
        assert!(largest < 1e-9, "{method} {gravity} {sample}: {largest:e}");
        assert!(run.total(0).0.z > mass, "it bounces");
    }
}

#[test]
fn sums_and_peaks_are_the_same_however_finely_a_run_is_sampled() {
    let (coarse, fine) = (Run::of(&soft_ball(0.013)), Run::of(&soft_ball(0.013e-3)));
    let (one, other) = (coarse.total(0), fine.total(0));
    assert!((one.0 - other.0).norm() < 1e-12 * one.0.norm(), "{} {}", one.0, other.0);
    println!("largest force {} {}", one.1, other.1);
    // Within a step the peak is that of a polynomial through nine forces.
    assert!((one.1 - other.1).abs() < 1e-5 * one.1, "{} {}", one.1, other.1);
    // Interval by interval, against the forces of the thousand samples within.
    for row in 1..coarse.rows.len() {
        let within =
            fine.rows.iter().enumerate().filter(|(_, (time, _))| {
                *time >= coarse.rows[row - 1].0 - 1e-12 && *time <= coarse.rows[row].0 + 1e-12
            });
        let sampled = within.map(|(n, _)| fine.vector(n, "contact_force", 0).norm()).fold(0.0, f64::max);
        let peak = coarse.at(row, "peak_force", 0);
        println!("{row}: {peak} {sampled}");
        assert!((peak - sampled).abs() <= 2e-5 * sampled.max(1e-6), "{row}: {peak} {sampled}");
    }
}

#[test]
fn a_run_that_is_not_asked_steps_the_same() {
    let usual = Run::of(&ball("", -9.81, 0.06, 0.01, ""));
    let asked = Run::of(&ball(ASKED, -9.81, 0.06, 0.01, ""));
    assert_eq!(usual.steps, asked.steps);
    for row in 0..usual.rows.len() {
        for place in 0..3 {
            assert_eq!(usual.at(row, "position", place), asked.at(row, "position", place));
        }
        assert_eq!(usual.at(row, "work_friction", 0), asked.at(row, "work_friction", 0));
    }
    assert!(!usual.names.iter().any(|name| name.starts_with("impulse") || name.starts_with("peak")));
}

/// Symptom: where nothing dissipates, the evaluations for impulses alone had a vote on which method went on.
#[test]
fn a_ball_on_a_ball_steps_the_same_if_it_is_asked() {
    let text = |record: &str| {
        format!(
            "time = {{ end = 0.45, sample = 0.45 }}\n{record}\n[[support]]\nname = \"smooth\"\n\
             shape = {{ sphere = {{ radius = 0.1 }} }}\n[[contact]]\nsupport = \"smooth\"\n\
             repulsion = {{ alpha = 12e6, nu = 6, d0 = 1e-5 }}\n[[body]]\nname = \"b\"\n\
             shape = {{ sphere = {{ radius = 0.02 }} }}\ndensity = 7800\n\
             position = [0.0238423064, 0, 0.1176177900]\n"
        )
    };
    let [usual, asked] = ["", ASKED].map(|record| Run::of(&parsed(&text(record), &[])));
    assert_eq!(usual.steps, asked.steps);
    let last = usual.rows.len() - 1;
    (0..3).for_each(|place| assert_eq!(usual.at(last, "position", place), asked.at(last, "position", place)));
}

/// Balls that meet and part, each an island of its own in between: what is pushed is in none of them lost.
fn billiard(sample: f64) -> Scene {
    let mut text = format!(
        "world = {{ gravity = [0, 0, 0] }}\ntime = {{ end = 0.4, sample = {sample} }}\n{ASKED}\n[[contact]]\n\
         between = [\"all\", \"all\"]\nreach = 0.002\nrepulsion = {{ alpha = 1e4, nu = 6, d0 = 1e-4 }}\n\
         damping = {{ beta = 20, nu = 6, d0 = 1e-4 }}\n"
    );
    for (k, (x, y, v)) in [(0.0, 0.0, 1.0), (0.1, 0.01, 0.0), (0.2, -0.01, 0.0), (0.33, 0.0, -0.5)].iter().enumerate() {
        text += &format!(
            "[[body]]\nname = \"b{k}\"\ngroup = \"all\"\nshape = {{ sphere = {{ radius = 0.02 }} }}\n\
             density = 1000\nposition = [{x}, {y}, 0]\nvelocity = [{v}, 0, 0]\n"
        );
    }
    parsed(&text, &[])
}

#[test]
fn islands_that_merge_and_fall_apart_lose_no_impulse() {
    let scene = billiard(0.013);
    let run = Run::of(&scene);
    let last = run.rows.len() - 1;
    let fine = Run::of(&billiard(0.0007));
    for body in 0..4 {
        let mass = mass(&scene, body);
        let change = mass * (run.vector(last, "velocity", body) - run.vector(0, "velocity", body));
        let (pushed, peak) = run.total(body);
        assert!((pushed - change).norm() < 1e-9 * mass, "{body}: {pushed} {change}");
        assert!(pushed.norm() > 0.01 * mass && peak > 0.0, "{body} is struck");
        let (again, peak_again) = fine.total(body);
        assert!((pushed - again).norm() < 1e-12 * mass, "{body}: {pushed} {again}");
        assert!((peak - peak_again).abs() < 1e-5 * peak, "{body}: {peak} {peak_again}");
    }
}

#[test]
fn impulses_and_peaks_resume_after_every_window() {
    for scene in [billiard(0.013), ball(ASKED, -9.81, 0.06, 0.0031, "")] {
        let steps = FirstSteps::of(&Job::of(&scene, &provenance()), 300).unwrap();
        assert!(steps.windows > 20 && steps.difference.is_none(), "{steps:?}");
    }
}
