use gyration_sim::*;
use std::path::Path;
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let scene = match gyration_scene::Scene::open(&args[1], &args[2..]) {
        Ok(s) => s,
        Err(e) => {
            println!("{e}");
            return;
        }
    };
    let job = Job::of(&scene, &Provenance { version: "x".into(), commit: None });
    let mut sink = MemorySink::default();
    let t = std::time::Instant::now();
    let mut sim = Simulation::new(job.model, job.start, job.plan).unwrap();
    sim.begin(&mut sink).unwrap();
    let out = sim.run(&mut sink, &mut Unwatched).unwrap();
    let el = t.elapsed();
    let s = RunSummary::of(job.model, &mut sim, out, el);
    println!("{}", serde_json::to_string_pretty(&s).unwrap());
    for e in sink.events.iter().take(30) {
        println!("{e:?}");
    }
    let _ = Path::new("");
}
