//! What runs cost, in counts: steps, evaluations, Jacobians, factorizations. A tenth more fails; bytes would only say
//! that numbers have moved.

use crate::islands::parsed;
use gyration_sim::{MemorySink, Outcome, RunPlan, Simulation, Unwatched};

/// A scene, its end [s], and the counts that it took when they were written down: accepted steps, rejected attempts,
/// evaluations of the rates, Jacobians, factorizations.
struct Pinned {
    name: &'static str,
    scene: String,
    end: f64,
    counts: [u64; 5],
}

/// What they may grow by.
const ROOM: f64 = 1.1;

const LAWS: &str = r#"
    repulsion = { alpha = "245 Pa", nu = 6, d0 = "0.6 mm" }
    damping = { beta = 1e4, nu = 3, d0 = "0.6 mm" }
    friction = { beta = 3e5, nu = 3, d0 = "0.6 mm" }
"#;

/// Bricks on one another, a little turned.
fn bricks(count: usize, reach: &str) -> String {
    let brick = |k: usize| {
        let (height, angle) = (0.0156 + 0.0306 * k as f64, 0.01 * (7.0 * k as f64 + 1.0).sin());
        format!(
            "[[body]]\nname = \"b{k}\"\ngroup = \"brick\"\nshape = {{ box = {{ size = [0.1, 0.05, 0.03] }} }}\n\
             density = 1250\nposition = [0, 0, {height}]\n\
             orientation = {{ axis_angle = {{ axis = [0, 0, 1], angle = {angle} }} }}\n"
        )
    };
    format!(
        "[[support]]\nname = \"table\"\nplane = {{}}\n[[contact]]\nsupport = \"table\"{LAWS}\
         [[contact]]\nbetween = [\"brick\", \"brick\"]{LAWS}{reach}\n{}",
        (0..count).map(brick).collect::<String>()
    )
}

/// Balls on a lattice with speeds that no symmetry makes simple, in no gravity.
fn gas(side: usize) -> String {
    let mut text = "world = { gravity = [0, 0, 0] }\n[[contact]]\nbetween = [\"ball\", \"ball\"]\nreach = 0.05\n\
                    repulsion = { alpha = 1e4, nu = 6, d0 = 0.01 }\n"
        .to_owned();
    for k in 0..side.pow(3) {
        let [x, y, z] = [k % side, k / side % side, k / side / side].map(|i| 0.3 * i as f64);
        let [u, v, w] = [1.0, 2.0, 3.0].map(|m: f64| (m * 12.9 * (k as f64 + 1.0)).sin());
        text += &format!(
            "[[body]]\nname = \"b{k}\"\ngroup = \"ball\"\nshape = {{ sphere = {{ radius = 0.1 }} }}\nmass = 1\n\
             position = [{x}, {y}, {z}]\nvelocity = [{u}, {v}, {w}]\n"
        );
    }
    text
}

/// A cube that falls onto a corner, and comes to rest.
fn cube() -> String {
    format!(
        "[[support]]\nname = \"table\"\nplane = {{}}\n[[contact]]\nsupport = \"table\"{LAWS}[[body]]\nname = \"cube\"\n\
         shape = {{ box = {{ size = [0.03, 0.03, 0.03] }} }}\ndensity = 1250\nposition = [0, 0, 0.06]\n\
         orientation = {{ axis_angle = {{ axis = [1, 2, 0.5], angle = 0.7 }} }}\n"
    )
}

#[test]
fn runs_cost_no_more_than_they_did() {
    let pinned = [
        Pinned {
            name: "five bricks within reach",
            scene: bricks(5, "reach = 0.03"),
            end: 0.2,
            counts: [127, 19, 2419, 115, 128],
        },
        Pinned {
            name: "three bricks without a reach",
            scene: bricks(3, ""),
            end: 0.2,
            counts: [108, 15, 1933, 97, 108],
        },
        Pinned { name: "a gas of 64 balls", scene: gas(4), end: 0.5, counts: [1261, 391, 28147, 0, 0] },
        Pinned { name: "a cube that comes to rest", scene: cube(), end: 1.0, counts: [588, 66, 11119, 191, 203] },
    ];
    let mut grown = Vec::new();
    for Pinned { name, scene, end, counts } in pinned {
        let scene = parsed(&scene, &[&format!("time.end={end}"), "time.sample=0.1", "solver.rtol=1e-6"]);
        let built = scene.built();
        let mut run = Simulation::new(&built.model, &built.state, RunPlan::from(built)).unwrap();
        let mut kept = MemorySink::default();
        run.begin(&mut kept).unwrap();
        assert_eq!(run.run(&mut kept, &mut Unwatched).unwrap(), Outcome::Completed, "{name}");
        let s = run.statistics();
        let rejected = s.rejected_error + s.rejected_domain + s.newton_failures;
        let found = [s.accepted(), rejected, s.rate_evaluations, s.jacobians, s.factorizations];
        println!("{name}: {found:?}, pinned {counts:?}");
        if found.iter().zip(&counts).any(|(found, pinned)| *found as f64 > ROOM * *pinned as f64) {
            grown.push(format!("{name}: {found:?} instead of {counts:?}"));
        }
    }
    assert!(grown.is_empty(), "{}", grown.join("\n"));
}
