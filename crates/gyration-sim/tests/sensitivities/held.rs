//! Bounded friction, adhesion, supports that turn, anchors and joints, beside differences of runs.

use crate::sensitivities::support::{TIGHT, disagreement, strings};

/// A block that slides on a table and is slowed down by a bounded friction; damping lets go of what recedes.
const SLIDING: &str = r#"
    time = { end = 0.15, sample = 0.1 }
    [[support]]
    name = "table"
    plane = { normal = [0.1, 0, 1] }
    [[contact]]
    support = "table"
    repulsion = { alpha = 1e3, nu = 6, d0 = 0.003 }
    damping = { beta = 1e3, nu = 6, d0 = 0.003, one_sided = true }
    friction = { beta = 1e5, nu = 6, d0 = 0.003, mu = 0.3 }
    [[body]]
    name = "block"
    shape = { box = { size = [0.1, 0.1, 0.06] } }
    density = 1000
    position = [0, 0, 0.039]
    velocity = [1.2, 0.3, 0]
"#;

#[test]
fn a_sliding_block_agrees_with_differences_of_runs() {
    let keys = ["contact.0.friction.mu", "contact.0.friction.beta", "contact.0.damping.beta", "body.block.velocity.1"];
    let quantities = ["block.x", "block.vx", "block.vy", "block.P_xz", "work.friction", "work.damping"];
    let worst = disagreement(SLIDING, &strings(&TIGHT), &keys, &quantities, 1e-4);
    assert!(worst < 1e-5, "{worst:e}");
}

/// A ball and a soft box that stick to each other.
const STICKING: &str = r#"
    time = { end = 0.2, sample = 0.1 }
    world = { gravity = [0, 0, 0] }
    [[contact]]
    between = ["a", "b"]
    measure = "reference_area"
    repulsion = { alpha = 2e3, nu = 6, d0 = 0.01 }
    adhesion = { beta = 500, nu_attractive = 4, nu_repulsive = 8, d0 = 0.01 }
    damping = { beta = 50, nu = 4, d0 = 0.01, one_sided = true }
    friction = { beta = 500, nu = 4, d0 = 0.01, mu = 0.2 }
    [[body]]
    name = "a"
    shape = { sphere = { radius = 0.1 } }
    mass = 1
    position = [0, 0.02, 0.25]
    velocity = [0.2, 0, -0.5]
    [[body]]
    name = "b"
    shape = { box = { size = [0.2, 0.2, 0.2] } }
    mass = 2
    affine = { material = { neo_hookean_log = { mu = 2e4, lambda = 4e4 } }, viscosity = 5 }
"#;

#[test]
fn bodies_that_stick_agree_with_differences_of_runs() {
    let keys = ["contact.0.friction.mu", "contact.0.adhesion.beta", "body.a.position.2"];
    let quantities = ["a.x", "a.vz", "b.P_xz", "energy.contact", "work.friction"];
    let worst = disagreement(STICKING, &strings(&TIGHT), &keys, &quantities, 1e-4);
    assert!(worst < 1e-5, "{worst:e}");
}

/// A ball at a drum that turns and shakes, another on a spring whose anchor goes round, a rod on a hinge that is
/// shaken.
const CARRIED: &str = r#"
    time = { end = 0.2, sample = 0.1 }
    [[support]]
    name = "drum"
    shape = { cylinder = { radius = 0.1, height = 0.4 } }
    orientation = { axis_angle = { axis = [1, 0, 0], angle = 1.4 } }
    motion = [{ rotate = { axis = [0, 1, 0.2], rate = 4 } },
              { oscillate = { direction = [0, 0, 1], amplitude = 0.01, frequency = 3 } }]
    [[contact]]
    between = ["drum", "ball"]
    repulsion = { alpha = 1e3, nu = 6, d0 = 0.003 }
    damping = { beta = 1e3, nu = 6, d0 = 0.003 }
    friction = { beta = 1e4, nu = 6, d0 = 0.003 }
    [[body]]
    name = "ball"
    shape = { sphere = { radius = 0.05 } }
    mass = 0.3
    position = [0.03, 0, 0.17]
    [[body]]
    name = "led"
    shape = { sphere = { radius = 0.05 } }
    mass = 0.2
    position = [1, 0, 0]
    spring = [{ anchor = [1.2, 0, 0.1], stiffness = 20, rest_length = 0.1, damping = 0.3,
                anchor_motion = { rotate = { axis = [0, 0, 1], point = [1, 0, 0], rate = 5 } } }]
    [[body]]
    name = "rod"
    shape = { box = { size = [0.04, 0.04, 0.3] } }
    mass = 0.4
    position = [0, 1, 0.15]
    velocity = [0, 0, 0.1884955592153876]
    [[joint]]
    name = "hip"
    between = ["rod", "shaker"]
    kind = "hinge"
    axis = [0, 1, 0]
    points = [[0, 0, 0.15], [0, 1, 0.3]]
    limits = [-1, 2]
    stop = { repulsion = { alpha = 0.1, nu = 4, d0 = 0.1 } }
    drive = { torque = "0.4*cos(5*t) - 0.05*rate" }
    [[support]]
    name = "shaker"
    plane = {}
    motion = { oscillate = { direction = [0, 0, 1], amplitude = 0.03, frequency = 1 } }
"#;

#[test]
fn what_moves_as_prescribed_agrees_with_differences_of_runs() {
    let keys = [
        "support.drum.motion.0.rotate.rate",
        "support.drum.motion.1.oscillate.amplitude",
        "body.led.spring.0.anchor_motion.rotate.rate",
        "body.rod.mass",
    ];
    let quantities = ["ball.x", "ball.vz", "led.x", "led.vy", "rod.x", "rod.Pdot_xz", "work.support", "work.load"];
    let worst = disagreement(CARRIED, &strings(&TIGHT), &keys, &quantities, 1e-4);
    assert!(worst < 1e-5, "{worst:e}");
}

/// Two bodies that a bond holds as they start: rest goes with the start.
const BONDED: &str = r#"
    time = { end = 0.3, sample = 0.1 }
    world = { gravity = [0, 0, 0] }
    [[bond]]
    between = ["a", "b"]
    stiffness = [50, 20, 20, 0.3, 0.1, 0.1]
    [[body]]
    name = "a"
    shape = { sphere = { radius = 0.05 } }
    mass = 0.5
    position = [0.01, 0, 0.02]
    velocity = [0, 0.3, 0.1]
    [[body]]
    name = "b"
    shape = { box = { size = [0.1, 0.12, 0.09] } }
    mass = 0.7
    position = [0.3, 0, 0]
    orientation = { axis_angle = { axis = [0, 1, 1], angle = 0.4 } }
    angular_velocity = [0, 1, 0]
"#;

/// Symptom: of two at rest the start of one moved both, (0.27, 0.73) for (1, 0).
#[test]
fn bodies_at_a_bond_that_rests_as_they_start_agree_with_differences_of_runs() {
    let keys = ["body.a.position.0", "body.a.position.2", "body.b.orientation.axis_angle.angle", "body.a.velocity.1"];
    let quantities = ["a.x", "a.vz", "b.x", "b.P_xz", "energy.kinetic"];
    let worst = disagreement(BONDED, &strings(&TIGHT), &keys, &quantities, 1e-4);
    assert!(worst < 1e-6, "{worst:e}");
}
