//! Bodies without inertia that have come to rest under a bound on friction: all their velocities are rounding.

use crate::islands::parsed;
use crate::runs::provenance;
use gyration_sim::{Job, MemorySink, Outcome, Simulation, Unwatched};

/// A rod and a ball that sink to the bed of a viscous fluid.
fn sinking(one_sided: bool, kind: &str) -> String {
    format!(
        "time = {{ end = 20, sample = 10 }}\nfluid = {{ viscosity = 1.4, density = 1260 }}\n\
         [[support]]\nname = \"bed\"\nplane = {{}}\n[[contact]]\nsupport = \"bed\"\n\
         repulsion = {{ alpha = 100, nu = 6, d0 = 1e-5 }}\n\
         damping = {{ beta = 1e3, nu = 6, d0 = 1e-5, one_sided = {one_sided} }}\n\
         friction = {{ beta = 1e5, nu = 6, d0 = 1e-5, mu = 0.3 }}\n\
         [[body]]\nname = \"rod\"\nshape = {{ ellipsoid = {{ semi_axes = [5e-3, 1.26e-3, 1.26e-3] }} }}\n\
         density = 2600\nposition = [0.02, 0, 0.006]\ninclusion = {{ inertia = false }}\n{kind}\n\
         orientation = {{ axis_angle = {{ axis = [0, 1, 0], angle = \"45 deg\" }} }}\n\
         [[body]]\nname = \"ball\"\nshape = {{ sphere = {{ radius = 2e-3 }} }}\ndensity = 2600\n\
         position = [0, 0, 0.0125]\ninclusion = {{ inertia = false }}\n"
    )
}

#[test]
fn bodies_without_inertia_stay_where_they_have_settled() {
    for (one_sided, kind) in [(false, ""), (true, ""), (false, "keep = { plane = [0, 1, 0] }")] {
        let scene = parsed(&sinking(one_sided, kind), &[]);
        let provenance = provenance();
        let job = Job::of(&scene, &provenance);
        let mut simulation = Simulation::new(job.model, job.start, job.plan).unwrap();
        let mut sink = MemorySink::default();
        simulation.begin(&mut sink).unwrap();
        let outcome = simulation.run(&mut sink, &mut Unwatched).unwrap();
        assert_eq!(outcome, Outcome::Completed, "one-sided {one_sided}, {kind}");
        let [.., middle, end] = &sink.rows[..] else { panic!("less than two rows") };
        let moved = middle.1[..3].iter().zip(&end.1).map(|(then, now)| (now - then).abs()).fold(0.0, f64::max);
        println!("one-sided {one_sided}, {kind}: {} steps, moved by {moved:.1e} m in the last 10 s", {
            simulation.statistics().accepted()
        });
        // A gap is micrometres.
        assert!(moved < 1e-9 && end.1[2] < 1.3e-3, "{moved}");
    }
}
