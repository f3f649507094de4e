//! Every kind of error, at its exact place. In a row `§` stands right before the place that the error must point to.

use crate::common::{BALL, Row, TABLE, TIME, assert_error, errors};

#[test]
fn a_study_is_told_from_a_scene() {
    let text = format!("{TIME}{BALL}\n[§keep]\nz = {{ last = \"ball.z\" }}\n");
    assert_error(&text, "keep", "unknown key \"keep\"", "key of studies, which `gyration study` takes");
    // Elsewhere the word is one like any other.
    assert_error(&format!("{TIME}{BALL}§repetitions = 1\n"), "body.ball.repetitions", "unknown key", "known keys");
}

#[test]
fn structure_errors_stand_at_their_place() {
    let rows: &[Row] = &[
        ("§colour = 1", "body.ball.colour", "unknown key \"colour\"", "known keys"),
        ("§velcoity = [0, 0, 1]", "body.ball.velcoity", "unknown key", "did you mean `velocity`?"),
        ("velocity = §[0, 0]", "body.ball.velocity", "expected 3 items, found 2", "m/s"),
        ("velocity = §1", "body.ball.velocity", "found a number", "array of 3 items"),
        ("velocity = [0, §true, 0]", "body.ball.velocity.1", "found a boolean", "\"5 cm/s\""),
        ("velocity = [0, §1979-05-27, 0]", "body.ball.velocity.1", "found a date", "m/s"),
        ("velocity = [0, §\"2 cm\", 0]", "body.ball.velocity.1", "\"2 cm\" is in m, expected m/s", "\"5 cm/s\""),
        ("velocity = [0, §\"2\", 0]", "body.ball.velocity.1", "has no unit", "without quotes"),
        ("velocity = [0, §\"2 cm/sec\", 0]", "body.ball.velocity.1", "unknown unit \"sec\"", "did you mean \"s\"?"),
        ("velocity = [0, §\"fast\", 0]", "body.ball.velocity.1", "does not begin with a number", "\"5 cm/s\""),
        ("velocity = [0, §inf, 0]", "body.ball.velocity.1", "must be finite", "finite"),
        ("velocity = [0, §-inf, 0]", "body.ball.velocity.1", "must be finite", "finite"),
        ("velocity = [0, §nan, 0]", "body.ball.velocity.1", "must be a number", "number"),
        ("velocity = [0, §1e999, 0]", "body.ball.velocity.1", "must be finite", "finite"),
        ("angular_velocity = [0, §\"5 Hz\", 0]", "body.ball.angular_velocity.1", "expected rad/s", "\"3 rpm\""),
        ("orientation = §{ }", "body.ball.orientation", "exactly one key, found 0", "one key of axis_angle, euler_xyz"),
        (
            "orientation = §{ quaternion = [1, 0, 0, 0], euler_xyz = [0, 0, 0] }",
            "body.ball.orientation",
            "exactly one key, found 2",
            "quaternion",
        ),
        (
            "orientation = { §quaternio = [1, 0, 0, 0] }",
            "body.ball.orientation.quaternio",
            "unknown key",
            "`quaternion`",
        ),
        ("orientation = §\"quaternion\"", "body.ball.orientation", "found a string", "{ quaternion = { … } }"),
        (
            "orientation = { axis_angle = §{ axis = [1, 0, 0] } }",
            "body.ball.orientation.axis_angle.angle",
            "missing",
            "Angle (rad)",
        ),
        ("rigid = { §stiffness = 3 }", "body.ball.rigid.stiffness", "unknown key", ""),
        ("inclusion = §{ inertia = true }", "body.ball.inclusion", "the scene has no fluid", "[fluid]"),
        (
            "spring = [{ anchor = [0, 0, 1], stiffness = §-1 }]",
            "body.ball.spring.0.stiffness",
            "must be at least 0 N/m",
            "",
        ),
        (
            "spring = [{ anchor = [0, 0, 1], stiffness = 1, anchor_motion = [{ rotate = { axis = §[0, 0, 0], rate = 1 } }] }]",
            "body.ball.spring.0.anchor_motion.0.rotate.axis",
            "the axis is zero",
            "write a direction",
        ),
        ("spring = [§{ anchor = [0, 0, 1] }]", "body.ball.spring.0.stiffness", "missing", "N/m"),
    ];
    for (line, key, message, help) in rows {
        assert_error(&format!("{TIME}{BALL}{line}\n"), key, message, help);
    }
}

#[test]
fn section_errors_stand_at_their_place() {
    let rows: &[Row] = &[
        ("§wrold = {}\n", "wrold", "unknown key \"wrold\"", "did you mean `world`?"),
        ("fluid = { viscosity = §0 }\n", "fluid.viscosity", "must be greater than 0", "greater than 0"),
        ("title = §3\n", "title", "expected a string, found a number", "a string"),
        ("world = §3\n", "world", "expected a table", "gravity"),
        ("world.gravity = [0, 0, §\"9.81 m/s\"]\n", "world.gravity.2", "expected m/s^2", "9.81 m/s^2"),
        ("solver.rtol = §1e-20\n", "solver.rtol", "at least 1e-14", "from 1e-14 to 0.01"),
        ("solver.rtol = §1\n", "solver.rtol", "at most 0.01", "from 1e-14 to 0.01"),
        ("solver.rtol = §\"1e-8\"\n", "solver.rtol", "found a string", "without quotes"),
        ("solver.atol = §-1e-9\n", "solver.atol", "at least 0", ""),
        ("solver.method = §\"explicitt\"\n", "solver.method", "\"explicitt\" is not known", "did you mean `explicit`?"),
        ("solver.max_step = §0\n", "solver.max_step", "greater than 0 s", ""),
        ("solver.max_wall_time = §\"10 kg\"\n", "solver.max_wall_time", "is in kg, expected s", ""),
        ("solver.threads = §2.5\n", "solver.threads", "must be whole, found 2.5", "a whole number from 1 to 1024"),
        ("solver.threads = §0\n", "solver.threads", "at least 1", "a whole number from 1 to 1024"),
        ("support = §3\n", "support", "expected an array", ""),
        ("support = [§3]\n", "support.0", "expected a table", "name = …"),
    ];
    for (head, key, message, help) in rows {
        assert_error(&format!("{head}{TIME}{BALL}"), key, message, help);
    }
    assert_error(&format!("§{BALL}"), "time", "the key \"time\" is missing", "end");
    assert_error(&format!("§{TIME}"), "body", "the key \"body\" is missing", "bodies");
    assert_error(&format!("body = §[]\n{TIME}"), "body", "at least 1 items, found 0", "");
    assert_error(&format!("§[time]\nend = 1\n{BALL}"), "time.sample", "missing", "Spacing");
    assert_error(&format!("[time]\nend = §0\nsample = 0.1\n{BALL}"), "time.end", "greater than 0 s, found 0 s", "");
    assert_error(
        &format!("[time]\nend = 1\nsample = §1e-9\n{BALL}"),
        "time.sample",
        "are more than 1e8",
        "at least 1e-8 s",
    );
    assert_error(
        &format!("{TIME}stop_at_rest = {{ speed = §-1, hold = 1 }}\n{BALL}"),
        "time.stop_at_rest.speed",
        "greater",
        "",
    );
}

#[test]
fn errors_of_fluids_stand_at_their_place() {
    let swelling = "[[0, 1, 0], [0, 0, 0], [0, 0, 0.5]]";
    let rows: &[(&str, &str, &str, &str)] = &[
        ("viscosity = §-1", "fluid.viscosity", "must be greater than 0 Pa s", "greater than 0"),
        ("viscosity = 1\ndensity = §-1", "fluid.density", "at least 0 kg/m^3", ""),
        (
            "viscosity = 1\nvelocity = §1",
            "fluid.velocity",
            "found a number",
            "one key of constant, ramp, sine, square, sum, table",
        ),
        ("viscosity = 1\nvelocity = [1, §\"2 m\", 0]", "fluid.velocity.1", "is in m, expected m/s", ""),
        ("viscosity = 1\nvelocity = { §sin = {} }", "fluid.velocity.sin", "unknown key", "`sine`"),
        (
            "viscosity = 1\nvelocity = { table = { file = §\"no.csv\" } }",
            "fluid.velocity.table.file",
            "cannot read",
            "relative to the folder",
        ),
    ];
    for (line, key, message, help) in rows {
        assert_error(&format!("{TIME}{BALL}[fluid]\n{line}\n"), key, message, help);
    }
    let text = format!("{TIME}{BALL}[fluid]\nviscosity = 1\nvelocity_gradient = §{swelling}\n");
    assert_error(&text, "fluid.velocity_gradient", "its trace is 0.5 1/s: the fluid would swell", "add up to 0");
    let text = format!(
        "{TIME}{BALL}[fluid]\nviscosity = 1\nvelocity_gradient = §{{ sine = {{ amplitude = {swelling}, frequency = 1 \
            }} }}\n"
    );
    assert_error(&text, "fluid.velocity_gradient", "at t = ", "add up to 0");
}

#[test]
fn errors_of_inclusions_stand_at_their_place() {
    let fluid = |density: f64| format!("[fluid]\nviscosity = 1\ndensity = {density}\n");
    let rows: &[Row] = &[
        ("inclusion = { §inetria = false }", "body.ball.inclusion.inetria", "unknown key", "did you mean `inertia`?"),
        (
            "inclusion = { inertia = false }\nvelocity = §[1, 0, 0]",
            "body.ball.velocity",
            "moves as the balance of forces says",
            "inertia = true",
        ),
        (
            "inclusion = { inertia = false, history = §true }",
            "body.ball.inclusion.history",
            "without inertia has no history",
            "inertia = true",
        ),
        ("inclusion = { tolerance = §0 }", "body.ball.inclusion.tolerance", "out of range", "from 0.000001 to 0.5"),
        ("inclusion = { spacing = §2 }", "body.ball.inclusion.spacing", "out of range", "from 0.001 to 1"),
        ("inclusion = { triangles = §3 }", "body.ball.inclusion.triangles", "at least 80", "from 80"),
        (
            "inclusion = { history = true, history_error = §1 }",
            "body.ball.inclusion.history_error",
            "at most 0.1",
            "from 1e-10",
        ),
        ("inclusion = { history = §true }\npin = [0, 0, 0]", "body.ball.inclusion.history", "pinned", "one of"),
        (
            "inclusion = { history = §true }\ncontractile = { material = { mooney_rivlin = { c1 = 1, c2 = 0 } }, \
             contraction_viscosity = 1, drive = { constant = { value = [[0, 0, 0], [0, 0, 0], [0, 0, 0]] } } }",
            "body.ball.inclusion.history",
            "drives itself is not followed",
            "one of `contractile` and `history`",
        ),
        (
            "inclusion = { history = true }\naffine = { kinetic = §\"comoving\" }",
            "body.ball.affine.kinetic",
            "a history of the flow asks for",
            "one of `history` and `kinetic`",
        ),
        (
            "inclusion = { neighbours = §true }\naffine = {}",
            "body.ball.inclusion.neighbours",
            "rigid spheres",
            "deform",
        ),
        (
            "inclusion = { neighbours = §true, history = true }",
            "body.ball.inclusion.neighbours",
            "has no history",
            "one of `history` and `neighbours`",
        ),
        ("inclusion = { walls = §true }", "body.ball.inclusion.walls", "no plane", "[[support]]"),
    ];
    for (line, key, message, help) in rows {
        assert_error(&format!("{}{TIME}{BALL}{line}\n", fluid(1.0)), key, message, help);
    }
    let text = format!("{}{TIME}{BALL}inclusion = {{ history = §true }}\n", fluid(0.0));
    assert_error(&text, "body.ball.inclusion.history", "the fluid has no density", "fluid.density");
    let ellipsoid = "shape = { ellipsoid = { semi_axes = [1, 1, 2] } }";
    let grain = format!("[[body]]\nname = \"grain\"\ndensity = 1\n{ellipsoid}\naffine = {{}}\n");
    let text = format!("{}{TIME}{grain}inclusion = {{ history = §true }}\n", fluid(1.0));
    assert_error(&text, "body.grain.inclusion.history", "only of a sphere", "sphere = { radius");
    let cube = "[[body]]\nname = \"cube\"\nmass = 1\nshape = { box = { size = [1, 1, 1] } }\n";
    let text = format!("{}{TIME}{cube}inclusion = {{ neighbours = §true }}\n", fluid(0.0));
    assert_error(&text, "body.cube.inclusion.neighbours", "only of spheres", "sphere = { radius");
    let wall = |fluid: &str, support: &str| {
        format!("[fluid]\nviscosity = 1\n{fluid}{TIME}[[support]]\nname = \"wall\"\nplane = {{}}\n{support}{BALL}")
    };
    let moving = wall("", "motion = { velocity = [1, 0, 0] }\n") + "inclusion = { walls = §true }\n";
    assert_error(&moving, "body.ball.inclusion.walls", "a wall that moves", "`motion`");
    let flowing = wall("velocity = [1, 0, 0]\n", "") + "inclusion = { walls = §true }\n";
    assert_error(&flowing, "body.ball.inclusion.walls", "the undisturbed flow would have to end", "`velocity`");
}

#[test]
fn errors_of_supports_and_contacts_stand_at_their_place() {
    let rows: &[Row] = &[
        ("[[support]]\nname = \"a\"\nplane = { normal = §[0, 0, 0] }\n", "support.a.plane.normal", "zero", "[0, 0, 1]"),
        ("[[support]]\nname = §\"a b\"\nplane = {}\n", "support.1.name", "not a name", "letters"),
        ("[[support]]\nname = §\"table\"\nplane = {}\n", "support.table.name", "occurs twice", "name of its own"),
        ("§[[support]]\nname = \"a\"\n", "support.a.plane", "missing", "plane"),
        (
            "[[support]]\nname = \"a\"\nplane = {}\nmotion = { oscillate = { direction = §[0, 0, 0], amplitude = 1, frequency = 1 } }\n",
            "support.a.motion.oscillate.direction",
            "zero",
            "",
        ),
        ("[[contact]]\nsupport = §\"tabel\"\n", "contact.0.support", "no support \"tabel\"", "did you mean `table`?"),
        ("[[contact]]\nsupport = \"table\"\nbody = §\"bell\"\n", "contact.0.body", "no body \"bell\"", "`ball`"),
        ("[[contact]]\nsupport = \"table\"\nmeasure = §\"area\"\n", "contact.0.measure", "not known", "reference_area"),
        (
            "[[contact]]\nsupport = \"table\"\nrepulsion = { alpha = 1, nu = §0 }\n",
            "contact.0.repulsion.nu",
            "greater than 0",
            "",
        ),
        (
            "[[contact]]\nsupport = \"table\"\nrepulsion = §{ alpha = 1, nu = 40, d0 = 1e-9 }\n",
            "contact.0.repulsion",
            "leaves the range of numbers",
            "d0",
        ),
        (
            "[[contact]]\nsupport = \"table\"\nrepulsion = { alpha = §\"1 Pa s/m\", nu = 6 }\n",
            "contact.0.repulsion.alpha",
            "expected Pa",
            "30 kPa",
        ),
        (
            "[[contact]]\nsupport = \"table\"\nfriction = { beta = 1, nu = §\"6 m\" }\n",
            "contact.0.friction.nu",
            "expected a number, found a string",
            "pure number",
        ),
        (
            "[[contact]]\nsupport = \"table\"\nfriction = { beta = 1, nu = 6, mu = §0.3 }\n",
            "contact.0.friction.mu",
            "a part of the force of a repulsion",
            "give the contact a `repulsion`",
        ),
        (
            "[[contact]]\nsupport = \"table\"\nrepulsion = { alpha = 0, nu = 6 }\n\
             friction = { beta = 1, nu = 6, mu = §0 }\n",
            "contact.0.friction.mu",
            "this contact has none",
            "leave mu out",
        ),
        (
            "[[contact]]\nsupport = \"table\"\nrepulsion = { alpha = 1, nu = 6 }\n\
             friction = { beta = 1, nu = 6, mu = §-0.1 }\n",
            "contact.0.friction.mu",
            "at least 0",
            "",
        ),
        (
            "[[contact]]\nsupport = \"table\"\nfriction = { beta = 1, nu = 6, §muu = 0.3 }\n",
            "contact.0.friction.muu",
            "muu",
            "did you mean `mu`?",
        ),
        (
            "[[contact]]\nsupport = \"table\"\ndamping = { beta = 1, nu = 6, one_sided = §true }\n",
            "contact.0.damping.one_sided",
            "at a speed that a repulsion tells",
            "leave one_sided out",
        ),
        (
            "[[contact]]\nsupport = \"table\"\ndamping = { beta = 1, nu = 6, one_sided = §1 }\n",
            "contact.0.damping.one_sided",
            "expected",
            "",
        ),
        (
            "[[contact]]\nsupport = \"table\"\ndamping = { beta = 1, nu = 6, §mu = 0.3 }\n",
            "contact.0.damping.mu",
            "mu",
            "",
        ),
        (
            "[[contact]]\nsupport = \"table\"\ndamping = { beta = 1, nu = 6, d0 = §0 }\n",
            "contact.0.damping.d0",
            "greater than 0 m",
            "",
        ),
        (
            "[[contact]]\nsupport = \"table\"\nadhesion = { beta = 1, nu_attractive = 4, nu_repulsive = §4 }\n",
            "contact.0.adhesion.nu_repulsive",
            "not greater than nu_attractive",
            "nu_repulsive > nu_attractive",
        ),
    ];
    for (text, key, message, help) in rows {
        assert_error(&format!("{TIME}{BALL}{TABLE}{text}"), key, message, help);
    }
}

#[test]
fn errors_of_bodies_stand_at_their_place() {
    let sphere = "shape = { sphere = { radius = 1 } }";
    let two = format!(
        "[[body]]\nname = \"b\"\n{sphere}\nmass = 1\nposition = [0, 0, 9]\n\
         [[body]]\nname = \"c\"\n{sphere}\nmass = 1\nposition = [0, 0, 7]\n"
    );
    let rows: &[(String, &str, &str, &str)] = &[
        (format!("§[[body]]\nname = \"b\"\n{sphere}"), "body.b", "no mass", "exactly one"),
        (format!("[[body]]\nname = \"b\"\n{sphere}\ndensity = 1\nmass = \
            §2"), "body.b.mass", "more than one", "exactly one"),
        ("§[[body]]\nname = \"b\"\nmass = 1".into(), "body.b.shape", "missing", "mass_properties"),
        (format!("[[body]]\nname = \"b\"\n{sphere}\nmass = §0"), "body.b.mass", "greater than 0 kg", ""),
        (format!("[[body]]\nname = §\"ball\"\n{sphere}\nmass = 1"), "body.ball.name", "occurs twice", ""),
        (format!("§[[body]]\n{sphere}\nmass = 1"), "body.1.name", "missing", "name"),
        ("[[body]]\nname = \"b\"\nmass = 1\nshape = { box = { size = [1, §-2, 1] } \
            }".into(), "body.b.shape.box.size.1", "greater than 0 m, found -2 m", ""),
        (
            "[[body]]\nname = \"b\"\nmass = 1\nshape = { torus = { major_radius = 1, minor_radius = §2 } }".into(),
            "body.b.shape.torus.minor_radius",
            "major_radius must be the larger",
            "",
        ),
        (
            "[[body]]\nname = \"b\"\nmass = 1\nshape = { polyhedron = { vertices = §[[0,0,0],[1,0,0],[0,1,0],[1,1,0]] } }".into(),
            "body.b.shape.polyhedron.vertices",
            "in a plane",
            "volume",
        ),
        (
            "[[body]]\nname = \"b\"\nmass = 1\nshape = { mesh = { file = §\"none.stl\" } }".into(),
            "body.b.shape.mesh.file",
            "none.stl",
            "relative to the folder of the scene",
        ),
        (
            "[[body]]\nname = \"b\"\nshape = §{ points = [{ mass = 1, at = [0, 0, 0] }, { mass = 1, at = [1, 0, 0] }] \
                }".into(),
            "body.b.shape",
            "on one line",
            "off the line",
        ),
        (
            "[[body]]\nname = \"b\"\nshape = { points = [{ mass = 1, at = [0, 0, 0] }] }\nmass = §1".into(),
            "body.b.mass",
            "their own mass",
            "leave",
        ),
        ("[[body]]\nname = \"b\"\nshape = { points = §[] }".into(), "body.b.shape.points", "no points", "at = "),
        (
            format!("[[body]]\nname = \"b\"\nshape = {{ union = {{ parts = [{{ density = 1, {sphere} }}, §{{ {sphere} \
                }}] }} }}"),
            "body.b.shape.union.parts.1.density",
            "no density",
            "give the part",
        ),
        (
            format!("[[support]]\nname = \"s\"\nshape = {{ union = {{ parts = [{{ density = 1, {sphere} }}, \
                §{{ {sphere} }}] }} }}"),
            "support.s.shape.union.parts.1.density",
            "no density",
            "give the part",
        ),
        (
            format!(
                "[[body]]\nname = \"b\"\n{sphere}\nmass_properties = {{ mass = 1, euler_tensor = §[[1, 0, 0], [0, 1, 0], [0, 0, -1]] }}"
            ),
            "body.b.mass_properties.euler_tensor",
            "negative principal value -1",
            "",
        ),
        (
            format!(
                "[[body]]\nname = \"b\"\n{sphere}\nmass_properties = {{ mass = 1, euler_tensor = §[[1, 1, 0], [0, 1, 0], [0, 0, 1]] }}"
            ),
            "body.b.mass_properties.euler_tensor",
            "not symmetric",
            "",
        ),
        (
            format!("[[body]]\nname = \"b\"\n{sphere}\nmass = 1\norientation = {{ quaternion = §[0, 0, 0, 0] }}"),
            "body.b.orientation.quaternion",
            "zero",
            "[w, x, y, z]",
        ),
        (
            format!("[[body]]\nname = \"b\"\n{sphere}\nmass = 1\norientation = {{ axis_angle = {{ axis = §[0, 0, 0], angle = 1 }} }}"),
            "body.b.orientation.axis_angle.axis",
            "zero",
            "",
        ),
        (
            format!("[[body]]\nname = \"b\"\n{sphere}\nmass = 1\ngradient = §[[1, 0, 0], [0, 1, 0], [0, 0, 1]]"),
            "body.b.gradient",
            "rigid body",
            "`orientation`",
        ),
        (
            format!("[[body]]\nname = \"b\"\n{sphere}\nmass = 1\ngradient_rate = §[[1, 0, 0], [0, 1, 0], [0, 0, 1]]"),
            "body.b.gradient_rate",
            "rigid body",
            "`angular_velocity`",
        ),
        (
            format!("[[body]]\nname = \"b\"\n{sphere}\nmass = 1\npin = [0, 0, 1]\nangular_velocity = [1, 0, \
                0]\nvelocity = §[0, 0, 0]"),
            "body.b.velocity",
            "[0e0, 1e0, 0e0]",
            "leave `velocity` out",
        ),
        (
            format!("[[body]]\nname = \"b\"\n{sphere}\nmass = 1\nspring = [{{ anchor = §[0, 0, 0], stiffness = 1, rest_length = 1 }}]"),
            "body.b.spring.0.anchor",
            "no length",
            "move the anchor",
        ),
        (
            format!("{two}[[spring]]\nbetween = [\"b\", §\"d\"]\nstiffness = 1"),
            "spring.0.between.1",
            "no body or group \"d\"",
            "one of: b, ball, c",
        ),
        (
            format!("{two}[[spring]]\nbetween = [\"b\", §\"b\"]\nstiffness = 1"),
            "spring.0.between.1",
            "both ends are at the body",
            "two different bodies",
        ),
        (
            format!(
                "{two}[[spring]]\nbetween = [\"b\", \"c\"]\npoints = §[[0, 0, -1], [0, 0, 1]]\n\
                 stiffness = 1\ndamping = 2"
            ),
            "spring.0.points",
            "no length",
            "leave out `rest_length` and `damping`",
        ),
        (
            format!("{two}[[spring]]\nbetween = [\"b\", \"c\"]\nstiffness = §-1"),
            "spring.0.stiffness",
            "",
            "",
        ),
        (
            format!("{two}[[spring]]\nbetween = §[\"b\"]\nstiffness = 1"),
            "spring.0.between",
            "",
            "",
        ),
        (
            format!("[[body]]\nname = \"b\"\n{sphere}\nmass = 1\nposition = §[0, 0, 0.75]\n[[contact]]\nsupport = \
                \"table\"\nbody = \"b\""),
            "body.b.position",
            "reaches the support \"table\" at the start: its smallest gap is -2.5",
            "more than 2.5",
        ),
        (
            "[[body]]\nname = \"b\"\nshape = { points = [{ mass = 1, at = [0, 0, 0] }, { mass = 1, at = [1, 0, 0] }, { mass = 1, at = [0, 1, 0] }] }\n\
             [[contact]]\nsupport = \"table\"\nbody = §\"b\""
                .into(),
            "contact.0.body",
            "no surface",
            "",
        ),
        (
            format!("§[[body]]\nname = \"b\"\n{sphere}\ndensity = 1e308"),
            "body.b",
            "it must be finite",
            "",
        ),
    ];
    for (text, key, message, help) in rows {
        assert_error(&format!("{TIME}{BALL}{TABLE}{text}\n"), key, message, help);
    }
}

#[test]
fn all_errors_of_a_file_come_at_once_in_its_order() {
    let text = format!(
        "[time]\nend = -1\nsample = 0.1\n{TABLE}[[contact]]\nsupport = \"tabel\"\nmeasure = 1\n{BALL}colour = 1\nvelocity = [0, 0]\n\
         [[body]]\nname = \"die\"\nshape = {{ box = {{ size = [1, 1, 1] }} }}\norientation = {{ quaternion = [0, 0, 0, 0] }}\n"
    );
    let found = errors("scene.toml", &text, &["solver.rtol=1".to_owned(), "solver.atol=-1".to_owned()]);
    let keys: Vec<&str> = found.into_iter().map(|error| error.key.as_str()).collect();
    let expected = [
        "time.end",
        "contact.0.support",
        "contact.0.measure",
        "body.ball.colour",
        "body.ball.velocity",
        "body.die",
        "body.die.orientation.quaternion",
        "solver.rtol",
        "solver.atol",
    ];
    assert_eq!(keys, expected, "{found}");
}

#[test]
fn all_syntax_errors_come_at_once() {
    let found = errors("scene.toml", "title = \nsolver = {\n[time\nend = 1\nend = 2\n", &[]);
    assert!(found.count() >= 2, "{found}");
    assert!(found.into_iter().all(|error| error.message.starts_with("not valid TOML")), "{found}");
    assert_eq!((found.as_slice()[0].line, found.as_slice()[0].column), (1, 9), "{found}");
}

/// The fix was to read the grammar of TOML.
#[test]
fn numbers_without_a_digit_at_their_point_are_told_as_meant() {
    for (written, meant) in [
        ("§.06", "write 0.06"),
        ("§+.5", "write 0.5"),
        ("§-.5e-3", "write -0.5e-3"),
        ("[1, §.25]", "write 0.25"),
        ("6.§", "write 6.0"),
        ("-6.§", "write -6.0"),
        ("1.§e5", "write 1.0e5"),
        ("§06", "write 6"),
        ("§00.5", "write 0.5"),
        ("6.§e", "see https://toml.io for the syntax"),
    ] {
        let place = written.find('§').unwrap();
        let text = format!("title = \"µ\"\nradius = {}\nend = 1\n", written.replace('§', ""));
        let found = errors("scene.toml", &text, &[]);
        let error = &found.as_slice()[0];
        assert_eq!((error.line, error.column, error.help.as_str()), (2, 10 + place, meant), "{written}: {found}");
        assert!(error.message.starts_with("not valid TOML"), "{found}");
    }
}

#[test]
fn large_whole_numbers_are_told_without_rounding() {
    let seed = "copies = { random = { count = 5, box = [[0, 0, 0], [1, 1, 1]], seed = §18446744073709551615 } }";
    let message = "must be at most 9007199254740991, found";
    let help = "write a whole number from 0 to 9007199254740991";
    assert_error(&format!("{TIME}{BALL}{seed}\n"), "body.ball.copies.random.seed", message, help);
}

/// A group without a name stood in the list of names, as nothing before a comma.
#[test]
fn nobody_is_offered_a_name_without_letters() {
    let contact = "[[contact]]\nbetween = [\"zzz\", \"ball\"]\nrepulsion = { alpha = 1, nu = 6 }\n";
    let found = errors("scene.toml", &format!("{TIME}{BALL}group = \"\"\n{contact}"), &[]).to_string();
    assert!(found.contains("no body, group or support \"zzz\"") && !found.contains("one of: ,"), "{found}");
}

#[test]
fn an_error_shows_its_line_and_its_fix() {
    let found = errors("scene.toml", &format!("{TIME}{BALL}velocity = [0, \"2 cm\", 0]\n"), &[]);
    let expected = "scene.toml:9:16: body.ball.velocity.1: \"2 cm\" is in m, expected m/s (m s^-1)\n  \
                    9 | velocity = [0, \"2 cm\", 0]\n    |                ^^^^^^\n  \
                    fix: write a number in m/s, or a string such as \"5 cm/s\"";
    assert_eq!(found.to_string(), expected);
}

#[test]
fn json_errors_stand_at_their_place() {
    let text = "{\n  \"time\": {\"end\": 1, \"sample\": 0.1},\n  \"body\": [{\"shape\": {\"points\": []}, \"colour\": \
        null}]\n}";
    let found = errors("scene.json", text, &[]);
    let places: Vec<(usize, usize, &str)> =
        found.into_iter().map(|error| (error.line, error.column, error.key.as_str())).collect();
    assert_eq!(places, [(3, 12, "body.0.name"), (3, 38, "body.0.colour")], "{found}");
    for (text, line, column) in
        [("{\"a\": 1,}", 1, 9), ("{\"a\": 01}", 1, 7), ("{\"a\": 1 \"b\": 2}", 1, 9), ("{\n\"a\": 1, \"a\": 2}", 2, 9)]
    {
        let found = errors("scene.json", text, &[]);
        let error = &found.as_slice()[0];
        assert_eq!((found.count(), error.line, error.column), (1, line, column), "{found}");
        assert!(error.message.starts_with("not valid JSON"), "{found}");
    }
}

/// Symptom: `np.float64(0.37)` was six errors of a syntax that the user had not written.
#[test]
fn what_numpy_printed_is_one_error_that_says_so() {
    let ball = |lines: &str| format!("{TIME}{BALL}{lines}");
    let help = "print plain numbers: float(x)";
    let message = "np.float64(0.1) is how NumPy prints a number, not the number itself, 3 times in this text";
    // What is no print of NumPy's stays as it is: texts and comments.
    let vector = "velocity = [§np.float64(0.1), np.float64(0.2), # np.float64(1)\n numpy.float64(-0.3)]\n";
    assert_error(&ball(vector), "", message, help);
    let array = "velocity = §array([1., 2.,\n       3.], dtype=float32)\n";
    assert_error(&ball(array), "", "dtype=float32 … is how NumPy prints a number", help);
    // Whatever else is wrong with the syntax comes beside, at its place.
    let found = errors("scene.toml", &ball("velocity = [np.int64(1), 0, 0]\nmass = 3\n"), &[]);
    let places: Vec<_> = found.as_slice().iter().map(|error| (error.line, error.column)).collect();
    assert_eq!(places, [(9, 13), (10, 1)], "{found}");
    let json = r#"{ "title": "np.float64(1)", "time": { "end": np.float64(1.5), "sample": np.True_ } }"#;
    let found = errors("scene.json", json, &[]);
    assert_eq!((found.count(), found.as_slice()[0].column), (1, 46), "{found}");
    assert!(found.to_string().contains("np.float64(1.5) is how NumPy prints"), "{found}");
    for (set, column) in [("time.end=np.float64(2)", 10), ("body.ball.velocity=[np.float64(2), 0, 0]", 21)] {
        let found = errors("scene.toml", &ball(""), &[set.to_owned()]);
        let [error] = found.as_slice() else { panic!("{found}") };
        assert!(error.message.contains("how NumPy prints") && error.column == column, "{found}");
    }
    // A bracket that is not closed ends the search.
    let open = "velocity = [np.float64(1, 0, 0]\n";
    assert!(!errors("scene.toml", &ball(open), &[]).to_string().contains("NumPy"));
}

#[test]
fn numbers_with_a_unit_are_told_without_rounding() {
    let row = "[[contact]]\nsupport = \"table\"\nreach = §\"-12.5 mm\"\n";
    assert_error(&format!("{TIME}{TABLE}{BALL}{row}"), "contact.0.reach", "found -0.0125 m", "greater than 0 m");
    let found = errors("scene.toml", &format!("{TIME}{BALL}density = \"-1.25 g/cm^3\"\n"), &[]);
    assert!(found.to_string().contains("found -1250 kg/m^3"), "{found}");
}

#[test]
fn a_reach_is_a_length_or_to_be_found() {
    let contact = "[[contact]]\nbetween = [\"ball\", \"ball\"]\nreach = §\"automatic\"\n\
                   repulsion = { alpha = 1, nu = 6 }\n";
    let text = format!("{TIME}{BALL}{contact}");
    assert_error(&text, "contact.0.reach", "\"automatic\"", "a string such as \"2 cm\", or \"auto\"");
}
