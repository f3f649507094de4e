//! What many bodies do together, against what is counted by hand.

use crate::islands::parsed;
use gyration::dynamics::Workspace;
use gyration_scene::Scene;
use gyration_sim::CrowdState;

/// Six balls of 2 kg on a line along x. The first two are a gap of 1 mm apart, the next two of 3 mm, where the force is
/// a third to the fifth power, 0.4 %, of that; the last two are far. One stands above a plane.
const BALLS: &str = r#"
world = { gravity = [0, 0, 0] }
time = { end = 1, sample = 1 }
[[contact]]
between = ["balls", "balls"]
repulsion = { alpha = 1e4, nu = 6, d0 = "1 mm" }
"#;

fn crowd(lines: &str, motions: [([f64; 3], [f64; 3], [f64; 3]); 6]) -> CrowdState {
    let bodies = motions.iter().enumerate().map(|(k, (position, velocity, spin))| {
        format!(
            "[[body]]\nname = \"b{k}\"\ngroup = \"balls\"\nshape = {{ sphere = {{ radius = 0.1 }} }}\nmass = 2\n\
             position = {position:?}\nvelocity = {velocity:?}\nangular_velocity = {spin:?}\n"
        )
    });
    let scene: Scene = parsed(&format!("{BALLS}{lines}{}", bodies.collect::<String>()), &[]);
    let built = scene.built();
    let mut workspace = Workspace::default();
    let (instant, scratch) = workspace.read(&built.model, &built.state).unwrap();
    CrowdState::of(&instant, scratch).unwrap()
}

fn is_near(found: f64, known: f64) {
    assert!((found - known).abs() <= 1e-12 * known.abs(), "{found} of {known}");
}

#[test]
fn kinetic_energy_is_told_in_three_parts() {
    let still = [0.0; 3];
    let motions = [
        ([0.0, 0.0, 0.0], [3.0, 0.0, 0.0], still),
        ([1.0, 0.0, 0.0], [1.0, 1.0, 0.0], still),
        ([2.0, 0.0, 0.0], [1.0, -1.0, 0.0], [0.0, 0.0, 5.0]),
        ([3.0, 0.0, 0.0], [0.0, 0.0, 2.0], still),
        ([4.0, 0.0, 0.0], [1.0, 0.0, -2.0], still),
        ([5.0, 0.0, 0.0], [0.0, 0.0, 0.0], still),
    ];
    let state = crowd("", motions);
    // V = (1, 0, 0); v − V: (2, 0, 0), (0, 1, 0), (0, −1, 0), (−1, 0, 2), (0, 0, −2), (−1, 0, 0).
    is_near(state.drift, 0.5 * 12.0);
    is_near(state.agitation, 0.5 * 2.0 * (4.0 + 1.0 + 1.0 + 5.0 + 4.0 + 1.0));
    is_near(state.turning, 0.5 * 0.4 * 2.0 * 0.01 * 25.0);
    is_near(state.temperature.unwrap(), 16.0 / (3.0 * 6.0));
}

#[test]
fn a_contact_counts_from_a_hundredth_of_the_mean_force_on() {
    let at = |x: f64, z: f64| ([x, 0.0, z], [0.0; 3], [0.0; 3]);
    let row = [at(0.0, 0.0), at(0.201, 0.0), at(1.0, 0.0), at(1.203, 0.0), at(3.0, 0.0), at(5.0, 0.0)];
    let state = crowd("", row);
    assert_eq!(state.contacts, [1, 0], "{state:?}");
    is_near(state.coordination, 2.0 / 6.0);
    assert_eq!(state.mean_force, state.largest_force);
    // What is far weaker than what it takes to turn a body round is no contact, be there no other.
    let mut apart = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0].map(|x| at(x, 0.0));
    apart[0].1 = [1.0, 0.0, 0.0];
    let state = crowd("", apart);
    assert_eq!((state.contacts, state.mean_force), ([0, 0], None), "{state:?}");
    // A plane below the last, as strong at the same gap as a second contact.
    let plane = "[[support]]\nname = \"floor\"\nplane = {}\n[[contact]]\nsupport = \"floor\"\nbody = \"b5\"\n\
                 repulsion = { alpha = 1e4, nu = 6, d0 = \"1 mm\" }\n";
    let state = crowd(plane, row.map(|(place, ..)| at(place[0], if place[0] > 4.0 { 0.101 } else { 0.5 })));
    assert_eq!(state.contacts, [1, 1], "{state:?}");
    is_near(state.coordination, 3.0 / 6.0);
    let (mean, largest) = (state.mean_force.unwrap(), state.largest_force.unwrap());
    assert!(largest > mean && mean > 0.5 * largest, "{state:?}");
}
