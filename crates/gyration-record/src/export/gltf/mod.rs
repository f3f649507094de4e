//! glTF: the motion as an animation, one `.glb` that every viewer and modeller of three-dimensional scenes opens.
//!
//! ```text
//! root: turns "up" (against gravity) to y, as glTF has it
//! ├── body, rigid:     translation p₀, rotation P, its mesh
//! ├── body, deforming: translation p₀, rotation U, scale S  ──  rotation Vᵀ, its mesh        P = U S Vᵀ
//! ├── support, plane:  a sheet with a grid, moving if the support does
//! └── support, solid:  translation, rotation, its mesh
//! ```
//!
//! Lengths in metres, times in seconds, from t = 0. Meshes of bodies with equal surfaces share their numbers. Places
//! are numbers of seven digits: those of bodies that are far from the origin are told from a point among them.

mod container;
mod factors;
mod ground;
mod motion;
mod paint;
mod shading;
#[cfg(test)]
mod tests;

use super::drawing::{Drawing, DrawnBody, DrawnMotion, DrawnSolidSupport, DrawnSupport, Vec3};
use crate::error::RecordError;
use crate::recording::Recording;
use container::Numbers;
use ground::Sheet;
use motion::{Track, carried_keys, keys, tracks};
use nalgebra::UnitQuaternion;
use serde_json::{Value, json};
use shading::{shaded, single};
use std::io::Write;

/// How vertices are joined, by the codes of the format.
const POINTS: u32 = 0;
const LINES: u32 = 1;
const TRIANGLES: u32 = 4;

/// By how much a wireframe is larger than its body, so that it lies outside the triangles.
const LIFT: f64 = 1.003;

/// What of the smallest body rounding may move it by before places are told from a point among the bodies.
const FINE: f64 = 1e-4;

/// What has become of a motion as glTF.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GltfMotion {
    /// The number of samples that became keys, of the body of which most did.
    pub samples: usize,
    /// The point from which places are told [m], if it is not the origin; the `asset` has it in its `extras`.
    pub origin: Option<[f64; 3]>,
}

/// Writes the motion as binary glTF.
///
/// # Errors
/// `NoSurfaces` if the recording is older than they are; `Corrupt`; those of reading; `Io` if `out` fails, under the
/// recording's path.
pub fn gltf(recording: &Recording, out: &mut impl Write) -> Result<GltfMotion, RecordError> {
    let drawing = Drawing::of(recording)?;
    let rows = keys(&recording.times()?, drawing.bodies.len());
    let tracks = tracks(recording, &drawing, &rows)?;
    let document = GltfDocument::new(&drawing, &tracks);
    let origin = document.origin.map(Into::into);
    document.write(recording, out).map_err(RecordError::io("write the glTF of", recording.path()))?;
    let samples = tracks.iter().map(|track| track.samples).max().unwrap_or(rows.len());
    Ok(GltfMotion { samples, origin })
}

/// The middle of bodies so far from the origin that single precision would show; whole metres, or a size that is less.
fn far_middle(drawing: &Drawing, tracks: &[Track]) -> Option<Vec3> {
    let sizes = drawing.bodies.iter().map(|body| body.size).filter(|size| *size > 0.0);
    let smallest = sizes.fold(f64::INFINITY, f64::min);
    let places = || tracks.iter().flat_map(|track| &track.positions);
    let first = places().next()?;
    let (low, high) = places().fold((*first, *first), |(low, high), place| (low.inf(place), high.sup(place)));
    let farthest = low.amax().max(high.amax());
    if farthest * f64::from(f32::EPSILON) <= FINE * smallest {
        return None;
    }
    let (middle, half) = (0.5 * (low + high), 0.5 * (high - low).amax());
    // Else the numbers are as large from there.
    if middle.amax() <= half {
        return None;
    }
    let unit = smallest.min(1.0);
    Some(middle.map(|entry| (entry / unit).round() * unit))
}

/// The document under construction.
#[derive(Default)]
struct GltfDocument {
    numbers: Numbers,
    nodes: Vec<Value>,
    meshes: Vec<Value>,
    materials: Vec<Value>,
    samplers: Vec<Value>,
    channels: Vec<Value>,
    /// The point from which places are told, if it is not the origin.
    origin: Option<Vec3>,
}

impl GltfDocument {
    fn new(drawing: &Drawing, tracks: &[Track]) -> Self {
        let mut this = Self { origin: far_middle(drawing, tracks), ..Self::default() };
        let up = UnitQuaternion::rotation_between(&drawing.up, &Vec3::y());
        // Straight down to up: half a turn about x.
        let up = up.unwrap_or_else(|| UnitQuaternion::from_axis_angle(&Vec3::x_axis(), std::f64::consts::PI));
        this.nodes.push(json!({ "name": "scene, y up", "rotation": quaternion(&up) }));
        let mut children = Vec::new();
        let surfaces: Vec<Value> = drawing.surfaces.iter().map(|surface| this.surface(surface)).collect();
        for (index, (figure, track)) in drawing.bodies.iter().zip(tracks).enumerate() {
            children.push(this.body(index, figure, track, &surfaces));
        }
        let carried = carried(drawing, tracks);
        for ground in &drawing.supports {
            let times = tracks.iter().map(|track| track.times.as_slice()).max_by_key(|times| times.len());
            children.push(this.support(ground, &carried, times.unwrap_or(&[])));
        }
        for solid in &drawing.solid_supports {
            let times = tracks.iter().map(|track| track.times.as_slice()).max_by_key(|times| times.len());
            children.extend(this.solid_support(solid, &surfaces, times.unwrap_or(&[])));
        }
        this.nodes[0]["children"] = children.into();
        this
    }

    /// A place, from the point from which they are told.
    fn place(&self, place: &Vec3) -> [f32; 3] {
        single(&(place - self.origin.unwrap_or_default()))
    }

    /// Vertices and triangles of a surface, without a material yet.
    fn surface(&mut self, surface: &super::drawing::SurfaceMesh) -> Value {
        let shaded = shaded(surface);
        let attributes = json!({
            "POSITION": self.numbers.vertices(&shaded.positions),
            "NORMAL": self.numbers.vertices(&shaded.normals),
        });
        json!({ "attributes": attributes, "indices": self.numbers.indices(&shaded.indices), "mode": TRIANGLES })
    }

    /// The nodes of a body; returns the outer one.
    fn body(&mut self, index: usize, figure: &DrawnBody, track: &Track, surfaces: &[Value]) -> usize {
        let mesh = self.figure(index, figure, surfaces);
        let (outer, inner) = (self.nodes.len(), self.nodes.len() + 1);
        let Some((position, factors)) = track.positions.first().zip(track.factors.first()) else {
            self.nodes.push(json!({ "name": figure.name, "mesh": mesh }));
            return outer;
        };
        let mut node = json!({ "name": figure.name, "translation": self.place(position) });
        let times = self.times(&track.times);
        let positions: Vec<_> = track.positions.iter().map(|position| self.place(position)).collect();
        self.animate(outer, "translation", times, &positions);
        if figure.is_rigid() {
            // U and Vᵀ of a rotation are any pair with the product P.
            let turns: Vec<_> = continuous(track.factors.iter().map(|factors| factors.outer * factors.inner));
            node["rotation"] = json!(turns[0]);
            node["mesh"] = mesh.into();
            self.nodes.push(node);
            self.animate(outer, "rotation", times, &turns);
            return outer;
        }
        node["rotation"] = json!(quaternion(&factors.outer));
        node["scale"] = json!(single(&factors.stretches));
        node["children"] = json!([inner]);
        self.nodes.push(node);
        self.nodes.push(json!({
            "name": format!("{}, axes of stretch", figure.name), "rotation": quaternion(&factors.inner), "mesh": mesh,
        }));
        let each = |of: fn(&factors::GradientFactors) -> [f32; 4]| track.factors.iter().map(of).collect::<Vec<_>>();
        let scales: Vec<_> = track.factors.iter().map(|factors| single(&factors.stretches)).collect();
        self.animate(outer, "rotation", times, &each(|factors| quaternion(&factors.outer)));
        self.animate(outer, "scale", times, &scales);
        self.animate(inner, "rotation", times, &each(|factors| quaternion(&factors.inner)));
        outer
    }

    /// The mesh of a body: its surface and its wireframe, by which the eye sees a ball turn; or its points.
    fn figure(&mut self, index: usize, figure: &DrawnBody, surfaces: &[Value]) -> usize {
        let [fill, line] = paint::body(index, &figure.name).map(|material| self.add_material(material));
        let Some(surface) = figure.surface.and_then(|surface| surfaces.get(surface)) else {
            let points: Vec<_> = figure.points().map(|point| single(&point)).collect();
            let attributes = json!({ "POSITION": self.numbers.vertices(&points) });
            return self
                .add_mesh(&figure.name, vec![json!({ "attributes": attributes, "mode": POINTS, "material": fill })]);
        };
        let mut skin = surface.clone();
        skin["material"] = fill.into();
        let mut primitives = vec![skin];
        let lines: Vec<_> = figure.lines().map(|end| single(&(end * LIFT))).collect();
        if !lines.is_empty() {
            let attributes = json!({ "POSITION": self.numbers.vertices(&lines) });
            primitives.push(json!({ "attributes": attributes, "mode": LINES, "material": line }));
        }
        self.add_mesh(&figure.name, primitives)
    }

    /// The node of a support.
    fn support(&mut self, ground: &DrawnSupport, carried: &[(Vec3, f64)], times: &[f64]) -> usize {
        let sheet = Sheet::under(ground, carried);
        let [surface, grid] = [paint::sheet(), paint::grid()].map(|material| self.add_material(material));
        let normals = [single(&sheet.normal); 4];
        let sheet_primitive = json!({
            "attributes": {
                "POSITION": self.numbers.vertices(&sheet.corners),
                "NORMAL": self.numbers.vertices(&normals),
            },
            "indices": self.numbers.indices(&[0, 1, 2, 0, 2, 3]),
            "material": surface,
            "mode": TRIANGLES,
        });
        let lines = json!({
            "attributes": { "POSITION": self.numbers.vertices(&sheet.lines) }, "material": grid, "mode": LINES,
        });
        let mesh = self.add_mesh(&ground.name, vec![sheet_primitive, lines]);
        self.carried(mesh, &ground.name, (&sheet.center, &UnitQuaternion::identity()), (&ground.motion, times))
    }

    /// The node of a support with a shape.
    fn solid_support(&mut self, solid: &DrawnSolidSupport, surfaces: &[Value], times: &[f64]) -> Option<usize> {
        let mut skin = surfaces.get(solid.surface?)?.clone();
        skin["material"] = self.add_material(paint::sheet()).into();
        let mesh = self.add_mesh(&solid.name, vec![skin]);
        let start = (&Vec3::from(solid.position), &solid.turn());
        Some(self.carried(mesh, &solid.name, start, (&solid.motion, times)))
    }

    /// The node of what is carried along with a support, from where it starts.
    fn carried(
        &mut self,
        mesh: usize,
        name: &str,
        (center, turn): (&Vec3, &UnitQuaternion<f64>),
        (motion, times): (&DrawnMotion, &[f64]),
    ) -> usize {
        let origin = self.origin.unwrap_or_default();
        let at = |time: f64| {
            let (by, shift) = motion.carried(time);
            (single(&(by * center + shift - origin)), by * turn)
        };
        let node = self.nodes.len();
        let (place, turned) = at(times.first().copied().unwrap_or(0.0));
        let mut first = json!({ "name": name, "mesh": mesh, "translation": place });
        if motion.turns() || turned != UnitQuaternion::identity() {
            first["rotation"] = json!(quaternion(&turned));
        }
        self.nodes.push(first);
        if motion.moves() && !times.is_empty() {
            let times = carried_keys(motion, times);
            let (places, turns): (Vec<_>, Vec<_>) = times.iter().map(|time| at(*time)).unzip();
            let times = self.times(&times);
            self.animate(node, "translation", times, &places);
            if motion.turns() {
                let turns: Vec<_> = continuous(turns.into_iter());
                self.animate(node, "rotation", times, &turns);
            }
        }
        node
    }

    fn add_material(&mut self, material: Value) -> usize {
        self.materials.push(material);
        self.materials.len() - 1
    }

    fn add_mesh(&mut self, name: &str, primitives: Vec<Value>) -> usize {
        self.meshes.push(json!({ "name": name, "primitives": primitives }));
        self.meshes.len() - 1
    }

    /// The accessor of these key times.
    fn times(&mut self, times: &[f64]) -> usize {
        let times: Vec<_> = times.iter().map(|time| [*time as f32]).collect();
        self.numbers.keys(&times)
    }

    /// Lets a property of a node go through these values.
    fn animate<const N: usize>(&mut self, node: usize, property: &str, times: usize, values: &[[f32; N]]) {
        let output = self.numbers.keys(values);
        self.channels.push(json!({
            "sampler": self.samplers.len(), "target": { "node": node, "path": property },
        }));
        self.samplers.push(json!({ "input": times, "output": output, "interpolation": "LINEAR" }));
    }

    fn write(self, recording: &Recording, out: &mut impl Write) -> std::io::Result<()> {
        let said = |name: &str| recording.attributes().get(name).and_then(Value::as_str).unwrap_or_default();
        let title = if said("title").is_empty() { said("scene_name") } else { said("title") };
        let mut document = json!({
            "asset": { "version": "2.0", "generator": format!("gyration {}", said("version")) },
            "scene": 0,
            "scenes": [{ "name": title, "nodes": [0] }],
            "nodes": self.nodes,
            "meshes": self.meshes,
            "materials": self.materials,
        });
        if let Some(origin) = self.origin {
            document["asset"]["extras"] = json!({ "origin": [origin.x, origin.y, origin.z] });
        }
        if !self.channels.is_empty() {
            document["animations"] = json!([{ "name": title, "channels": self.channels, "samplers": self.samplers }]);
        }
        self.numbers.write(document, out)
    }
}

/// Where the bodies come in the whole motion: centres and half of their sizes.
fn carried(drawing: &Drawing, tracks: &[Track]) -> Vec<(Vec3, f64)> {
    let of_body = |(figure, track): (&DrawnBody, &Track)| {
        let half = 0.5 * figure.size;
        track.positions.iter().map(|position| (*position, half)).collect::<Vec<_>>()
    };
    drawing.bodies.iter().zip(tracks).flat_map(of_body).collect()
}

/// Quaternions of which each is the nearer one to the last.
fn continuous(turns: impl Iterator<Item = UnitQuaternion<f64>>) -> Vec<[f32; 4]> {
    let mut last = UnitQuaternion::identity();
    let next = |turn| {
        last = factors::nearest_sign(turn, &last);
        quaternion(&last)
    };
    turns.map(next).collect()
}

/// x, y, z, w.
fn quaternion(turn: &UnitQuaternion<f64>) -> [f32; 4] {
    [turn.i as f32, turn.j as f32, turn.k as f32, turn.w as f32]
}
