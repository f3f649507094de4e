//! Random bodies: kind, shape, mass, start, springs, and how they are immersed.

use super::draft::Draft;
use super::materials::{affine, contractile};
use super::shapes::{ShapeKind, any, closed, meeting, shape};
use super::toml::{Matrix, UNIT, Vector, determinant, deviator, list, product, rotation, rows, scaled, scaled_rows};
use std::fmt::Write as _;

/// A body of a scene.
#[derive(Debug)]
pub struct RandomBody {
    /// Its table.
    pub text: String,
    /// Whether it can touch anything.
    pub has_surface: bool,
    /// P at the start, where it may be joined to another body.
    pub joinable: Option<Joinable>,
}

/// What a joint needs of a body.
#[derive(Debug, Clone, Copy)]
pub struct Joinable {
    /// P at the start.
    pub placement: Matrix,
    /// Whether it deforms.
    pub deforms: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Rigid,
    Affine,
    Contractile,
}

/// Where a body starts.
#[derive(Debug, Clone, Copy)]
pub struct Place {
    /// Its centre of mass [m].
    pub at: Vector,
    /// Where it flies to, more or less.
    pub towards: Vector,
    /// The line that names its groups, if it has any.
    pub groups: &'static str,
    /// Whether it starts at rest, as bodies do that are joined.
    pub rests: bool,
}

/// A body; in a fluid of this density [kg/m³], most are immersed.
pub fn body(draft: &mut Draft, name: &str, place: Place, fluid: Option<f64>) -> RandomBody {
    let kind = draft.stream.pick(&[Kind::Rigid, Kind::Rigid, Kind::Affine, Kind::Affine, Kind::Contractile]);
    let fluid = fluid.filter(|_| draft.stream.chance(0.8));
    let of = match (fluid, kind) {
        (Some(_), _) if draft.stream.chance(if kind == Kind::Rigid { 0.7 } else { 0.9 }) => {
            draft.stream.pick(&[ShapeKind::Sphere, ShapeKind::Ellipsoid])
        }
        _ if draft.meets => meeting(draft, kind != Kind::Rigid),
        (Some(_), _) | (None, Kind::Contractile) => closed(draft, kind != Kind::Rigid),
        (None, _) => any(draft, kind != Kind::Rigid),
    };
    let size = draft.size;
    let mut text = format!("[[body]]\nname = \"{name}\"\n{}shape = {}\n", place.groups, shape(draft, of, size));
    mass(draft, &mut text, of);
    let _ = writeln!(text, "position = {}", list(&place.at));
    let immersion = fluid.map(|density| Immersion::of(draft, of, kind, density));
    if let Some(immersion) = &immersion {
        let _ = writeln!(text, "inclusion = {{ {} }}", immersion.text);
    }
    let (table, flesh) = match kind {
        Kind::Rigid => ("rigid = {}", None),
        Kind::Affine => ("[body.affine]", Some(affine(draft, of != ShapeKind::Points))),
        Kind::Contractile => ("[body.contractile]", Some(contractile(draft))),
    };
    let may_have = Start {
        deformed: kind == Kind::Affine,
        is_incompressible: flesh.as_ref().is_some_and(|flesh| flesh.is_incompressible),
        has_inertia: immersion.as_ref().is_none_or(|immersion| immersion.has_inertia),
        is_pinned: immersion.is_none() && !place.rests && !draft.isolated && draft.stream.chance(0.1),
    };
    let placement = start(draft, &mut text, may_have, place);
    if !draft.isolated && draft.stream.chance(0.15) {
        spring(draft, &mut text, place.at);
    }
    let flesh = flesh.map_or(String::new(), |flesh| flesh.text);
    // Joints hold bodies with inertia, and none with a memory of the flow.
    let joins = immersion.is_none_or(|immersion| immersion.has_inertia && !immersion.has_history);
    let joinable = joins.then_some(Joinable { placement, deforms: kind != Kind::Rigid });
    RandomBody { text: format!("{text}{table}\n{flesh}\n"), has_surface: of != ShapeKind::Points, joinable }
}

/// Points have masses of their own, parts of a union weights.
fn mass(draft: &mut Draft, text: &mut String, of: ShapeKind) {
    let _ = match of {
        ShapeKind::Points => Ok(()),
        _ if of != ShapeKind::Union && draft.stream.chance(0.3) => writeln!(text, "density = {:?}", draft.density()),
        _ => writeln!(text, "mass = {:?}", draft.mass),
    };
}

/// How a body is in the fluid.
struct Immersion {
    text: String,
    has_inertia: bool,
    has_history: bool,
}

impl Immersion {
    fn of(draft: &mut Draft, of: ShapeKind, kind: Kind, density: f64) -> Self {
        let is_ellipsoid = matches!(of, ShapeKind::Sphere | ShapeKind::Ellipsoid);
        let remembered = of == ShapeKind::Sphere && kind != Kind::Contractile;
        let history = remembered && density > 0.0 && draft.stream.chance(0.5);
        let has_inertia = history || draft.meets || draft.stream.chance(0.6);
        let mut text = format!("inertia = {has_inertia}, history = {history}");
        if !is_ellipsoid {
            // Few and rough: what is tested is not the resistance.
            let most = if kind == Kind::Rigid { 200 } else { 40 };
            let _ = write!(text, ", triangles = {}", 80 + draft.stream.index(most));
            if kind != Kind::Rigid {
                text.push_str(", tolerance = 0.3");
            }
        }
        Self { text, has_inertia, has_history: history }
    }
}

/// How a body may start.
#[derive(Debug, Clone, Copy)]
struct Start {
    /// Whether it may start deformed.
    deformed: bool,
    is_incompressible: bool,
    has_inertia: bool,
    is_pinned: bool,
}

/// Writes how a body starts; P.
fn start(draft: &mut Draft, text: &mut String, start: Start, place: Place) -> Matrix {
    let turn = draft.stream.turn();
    let spin = draft.speed() / draft.size * draft.stream.decade(-2.0, 0.3);
    let placement = start.deformed.then(|| stretched(draft, &rotation(turn), start.is_incompressible));
    let _ = match &placement {
        Some(placement) => writeln!(text, "gradient = {}", rows(placement)),
        None => writeln!(text, "orientation = {{ quaternion = {} }}", list(&turn)),
    };
    let moves = start.has_inertia && !place.rests;
    if moves {
        let _ = match &placement {
            Some(placement) => {
                let rate = scaled_rows(&deviator(&draft.stream.matrix()), 0.3 * spin);
                writeln!(text, "gradient_rate = {}", rows(&product(&rate, placement)))
            }
            None => writeln!(text, "angular_velocity = {}", list(&scaled(draft.stream.direction(), spin))),
        };
    }
    if start.is_pinned {
        let pin = scaled(draft.stream.direction(), draft.size * draft.stream.unit());
        let _ = writeln!(text, "pin = {}", list(&pin));
    } else if moves {
        // Towards what it may meet, or without gravity it may never come there.
        let speed = draft.speed() * draft.stream.decade(-1.0, 0.3);
        let (way, beside) = (direction(place), draft.stream.direction());
        let velocity = [0, 1, 2].map(|k| speed * (way[k] + 0.4 * beside[k]));
        let _ = writeln!(text, "velocity = {}", list(&velocity));
    }
    placement.unwrap_or_else(|| rotation(turn))
}

/// The direction from a body to where it flies.
fn direction(Place { at, towards, .. }: Place) -> Vector {
    let way = [0, 1, 2].map(|k| towards[k] - at[k]);
    let length = way.iter().map(|x| x * x).sum::<f64>().sqrt();
    scaled(way, 1.0 / length.max(f64::MIN_POSITIVE))
}

/// A placement R U with stretches of at most a fifth; det = 1 where the body keeps its volume.
fn stretched(draft: &mut Draft, turn: &Matrix, is_incompressible: bool) -> Matrix {
    let mut stretch = draft.stream.matrix();
    for (i, row) in stretch.iter_mut().enumerate() {
        for (j, entry) in row.iter_mut().enumerate() {
            *entry = UNIT[i][j] + 0.1 * *entry;
        }
    }
    let placement = product(turn, &stretch);
    let size = if is_incompressible { determinant(&placement).cbrt() } else { 1.0 };
    scaled_rows(&placement, 1.0 / size)
}

fn spring(draft: &mut Draft, text: &mut String, at: Vector) {
    let (size, mass) = (draft.size, draft.mass);
    let stiffness = mass * draft.pull / size * draft.stream.decade(-1.0, 2.0);
    let point = list(&scaled(draft.stream.direction(), 0.5 * size));
    let anchor = list(&[at[0], at[1], at[2] + 3.0 * size]);
    let mut keys = format!("point = {point}, anchor = {anchor}, stiffness = {stiffness:?}");
    if draft.stream.chance(0.5) {
        let damping = (stiffness * mass).sqrt() * draft.stream.decade(-2.0, 0.0);
        let _ = write!(keys, ", rest_length = {:?}, damping = {damping:?}", 2.0 * size * draft.stream.unit());
    }
    let _ = writeln!(text, "spring = [{{ {keys} }}]");
}
