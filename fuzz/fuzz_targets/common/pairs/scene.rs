//! A scene of two to four bodies that fly at each other, made of bytes.
//!
//! Sizes are of twelve decades, masses of twenty, speeds of eight; the coefficients of laws and materials are such that
//! the bodies turn back, within many decades too. A zero stands for what is usual.

use super::numbers::Numbers;
use super::shapes::{quaternion, shape, soft_shape};
use serde_json::{Value, json};

/// The scene, and how it is to be run.
pub struct Asked {
    /// The scene file, in JSON.
    pub text: String,
    /// Whether nothing but the bodies themselves acts on them, so that their momentum stays.
    pub is_free: bool,
    /// Whether it is to be surveyed.
    pub is_surveyed: bool,
    /// The window after which a second run goes on from the checkpoint of the first.
    pub resumed_after: usize,
}

/// What is usual in a scene.
struct Scales {
    /// Of the largest body [m].
    size: f64,
    /// Of the bodies at the start [m/s].
    speed: f64,
    /// Kinetic, of a usual body [J].
    energy: f64,
    /// At which bodies turn back [m].
    gap: f64,
}

/// Reads all bytes.
pub fn scene(bytes: &[u8], most_windows: usize) -> Asked {
    let numbers = &mut Numbers::of(bytes);
    let (is_surveyed, resumed_after) = (numbers.chance(5), 1 + numbers.index(most_windows - 1));
    let (size, speed, mass) = (numbers.decade(-6.0, 6.0), numbers.decade(-4.0, 4.0), numbers.decade(-6.0, 6.0));
    let gap = size * numbers.decade(-5.0, -1.0);
    let scales = Scales { size, speed, energy: 0.5 * mass * speed * speed, gap };
    let count = [2, 2, 3, 4][numbers.index(4)];
    let mut contacts = vec![contact(numbers, &scales)];
    if numbers.chance(4) {
        contacts.push(contact(numbers, &scales));
    }
    let bodies: Vec<Value> = (0..count).map(|k| body(numbers, k, mass, &scales)).collect();
    let time = size / speed;
    let end = time * numbers.between(1.0, 8.0);
    let rtol = 10_f64.powi(-4 - numbers.index(8) as i32);
    let method = ["auto", "explicit", "implicit"][numbers.index(3)];
    let mut is_free = bodies.iter().all(|body| body["pin"].is_null());
    let mut asked = json!({
        "world": { "gravity": [0, 0, 0] },
        "time": { "end": end, "sample": end / 16.0 },
        "solver": { "rtol": rtol, "atol": 1e-2 * rtol, "method": method },
        "body": bodies,
        "contact": contacts,
    });
    if numbers.chance(4) {
        asked["spring"] = json!([spring(numbers, &scales)]);
    }
    if numbers.chance(4) {
        asked["world"]["gravity"] = json!(numbers.vector().map(|x| x * speed / time));
        is_free = false;
    }
    if numbers.chance(4) {
        asked["time"]["stop_at_rest"] = json!({ "speed": 1e-2 * speed, "hold": 0.1 * time });
    }
    if numbers.chance(3) {
        add_floor(numbers, &mut asked, &scales);
        is_free = false;
    }
    Asked { text: asked.to_string(), is_free, is_surveyed, resumed_after }
}

/// One of the bodies about the corners of a tetrahedron, towards the middle and a little beside it.
fn body(numbers: &mut Numbers, k: usize, mass: f64, scales: &Scales) -> Value {
    let Scales { size, speed, energy, .. } = *scales;
    let corner = [[1.0, 1.0, 1.0], [-1.0, -1.0, 1.0], [-1.0, 1.0, -1.0], [1.0, -1.0, -1.0]][k];
    let apart = size * numbers.between(0.4, 0.8);
    let (shift, beside, spin) = (numbers.vector(), numbers.vector(), numbers.vector());
    let position = [0, 1, 2].map(|i| apart * (corner[i] + 0.2 * shift[i]));
    let velocity = [0, 1, 2].map(|i| speed * (0.3 * beside[i] - 0.6 * corner[i]));
    let groups = [vec!["all"], vec!["all", "odd"], vec!["all", "odd"], vec!["odd"]];
    // Some are small beside the others.
    let own_size = if numbers.chance(4) { size * numbers.decade(-4.0, 0.0) } else { size };
    let is_soft = numbers.chance(5);
    let shape = if is_soft { soft_shape(numbers, own_size) } else { shape(numbers, own_size) };
    let mut body = json!({
        "name": format!("b{k}"),
        "group": groups[numbers.index(4)],
        "shape": shape,
        "mass": mass * numbers.decade(-4.0, 4.0),
        "position": position,
        "orientation": { "quaternion": quaternion(numbers) },
        "angular_velocity": spin.map(|x| x * speed / size),
    });
    if is_soft {
        body["affine"] = affine(numbers, energy / size.powi(3), size / speed);
    }
    // The velocity of a body that is pinned follows from its spin.
    match numbers.chance(1) {
        true => body["pin"] = json!(numbers.vector().map(|x| 0.5 * own_size * x)),
        false => body["velocity"] = json!(velocity),
    }
    body
}

/// A body that deforms under about so large a stress [Pa], within about so long [s].
fn affine(numbers: &mut Numbers, stress: f64, time: f64) -> Value {
    let kind = numbers.index(6);
    let mut modulus = || stress * numbers.decade(-1.0, 4.0);
    let [mu, lambda] = [modulus(), modulus()];
    let material = match kind {
        0 => json!({ "neo_hookean_log": { "mu": mu, "lambda": lambda } }),
        1 => json!({ "mooney_rivlin": { "c1": mu, "c2": lambda } }),
        2 => json!({ "mooney_rivlin": { "c1": mu, "c2": lambda, "bulk": mu + lambda } }),
        3 => json!({ "st_venant_kirchhoff": { "lambda": lambda, "mu": mu } }),
        4 => json!({ "hencky": { "shear": mu, "bulk": lambda } }),
        _ => return json!({}),
    };
    let mut affine = json!({ "material": material });
    if numbers.chance(8) {
        affine["viscosity"] = json!(stress * time * numbers.decade(-3.0, 2.0));
    }
    affine
}

/// Laws between bodies, of groups or of two by name.
fn contact(numbers: &mut Numbers, scales: &Scales) -> Value {
    let Scales { size, speed, energy, gap } = *scales;
    let between = match numbers.index(16) {
        0..=7 => ["all", "all"],
        8..=9 => ["all", "odd"],
        10 => ["odd", "odd"],
        11..=12 => ["b0", "b1"],
        _ => ["b1", "all"],
    };
    let measure = match numbers.index(32) {
        0..=15 => "reference_area",
        31 => "deformed_area_potential",
        _ => "deformed_area",
    };
    let pressure = energy / (gap * size * size);
    let mut law = |key: &str, coefficient: f64, lowest: f64| {
        let nu = numbers.between(lowest, 14.0);
        // Whole exponents have formulas of their own.
        let nu = if numbers.chance(8) { nu.round() } else { nu };
        json!({ key: coefficient * numbers.decade(-6.0, 6.0), "nu": nu, "d0": gap })
    };
    let mut contact = json!({
        "between": between,
        "measure": measure,
        "repulsion": law("alpha", pressure, 1.8),
    });
    let [damping, friction] = [(); 2].map(|()| law("beta", 1e-2 * pressure / speed, 0.5));
    for (key, law) in [("damping", damping), ("friction", friction)] {
        if numbers.chance(6) {
            contact[key] = law;
        }
    }
    if numbers.chance(6) {
        contact["reach"] = json!(gap * numbers.decade(-1.0, 3.0));
    }
    contact
}

/// A spring between the first two bodies.
fn spring(numbers: &mut Numbers, scales: &Scales) -> Value {
    let Scales { size, speed, energy, .. } = *scales;
    let points = [0, 1].map(|_| numbers.vector().map(|x| 0.3 * size * x));
    json!({
        "between": ["b1", "b0"],
        "points": points,
        "stiffness": energy / (size * size) * numbers.decade(-3.0, 3.0),
        "rest_length": size * numbers.unit(),
        "damping": energy / (size * speed) * numbers.unit(),
    })
}

/// A plane below all bodies, with laws of its own.
fn add_floor(numbers: &mut Numbers, asked: &mut Value, scales: &Scales) {
    let Scales { size, energy, gap, .. } = *scales;
    asked["support"] = json!([{ "name": "floor", "plane": { "origin": [0, 0, -2.0 * size] } }]);
    let alpha = energy / (gap * size * size) * numbers.decade(-3.0, 3.0);
    let law =
        json!({ "support": "floor", "repulsion": { "alpha": alpha, "nu": numbers.between(2.0, 9.0), "d0": gap } });
    asked["contact"].as_array_mut().into_iter().for_each(|contacts| contacts.push(law.clone()));
}
