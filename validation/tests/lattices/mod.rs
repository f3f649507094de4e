//! Scenes of lattices that several tests share, and their waves.

use gyration_scene::Scene;
use gyration_sim::modes::bands::{BandPath, BandRow, LatticeWaves};
use nalgebra::Complex;
use std::fmt::Write as _;
use std::path::Path;

/// A scene in the making.
#[derive(Debug, Clone)]
pub struct LatticeScene(String);

/// A spring of a lattice scene.
#[derive(Debug, Clone, Copy)]
pub struct Link<'a> {
    /// The names of its bodies.
    pub between: [&'a str; 2],
    /// The cell of the second.
    pub cell: [i32; 3],
    /// Where it holds on to them.
    pub points: [[f64; 3]; 2],
    /// k [N/m], l₀ [m], c [N s/m].
    pub law: [f64; 3],
}

impl Default for Link<'_> {
    fn default() -> Self {
        Self { between: ["a", "a"], cell: [1, 0, 0], points: [[0.0; 3]; 2], law: [1.0, 1.0, 0.0] }
    }
}

impl LatticeScene {
    /// Without a lattice.
    pub fn alone() -> Self {
        Self("world = { gravity = [0, 0, 0] }\ntime = { end = 1, sample = 1 }\n".to_owned())
    }

    /// Of these cell vectors.
    pub fn new(vectors: &[[f64; 3]]) -> Self {
        Self(format!("{}lattice = {{ cell = {vectors:?} }}\n", Self::alone().0))
    }

    /// The same, whose bodies seek their rest.
    pub fn relaxed(vectors: &[[f64; 3]]) -> Self {
        Self(format!("{}lattice = {{ cell = {vectors:?}, relax = [\"granules\"] }}\n", Self::alone().0))
    }

    /// Adds a body: its table.
    pub fn body(mut self, name: &str, place: [f64; 3], table: &str) -> Self {
        let _ = writeln!(self.0, "[[body]]\nname = \"{name}\"\nposition = {place:?}\n{table}");
        self
    }

    /// Adds a mass point.
    pub fn point(self, name: &str, place: [f64; 3], mass: f64) -> Self {
        self.body(name, place, &format!("shape = {{ points = [{{ mass = {mass:?}, at = [0, 0, 0] }}] }}"))
    }

    /// Adds a spring.
    pub fn spring(mut self, link: Link<'_>) -> Self {
        let Link { between, cell, points, law: [stiffness, rest_length, damping] } = link;
        let cell = if cell == [0; 3] { String::new() } else { format!("cell = {cell:?}\n") };
        let _ = write!(
            self.0,
            "[[spring]]\nbetween = {between:?}\n{cell}points = {points:?}\nstiffness = {stiffness:?}\nrest_length = \
             {rest_length:?}\ndamping = {damping:?}\n"
        );
        self
    }

    /// Its text.
    pub fn text(&self) -> &str {
        &self.0
    }

    /// The scene.
    pub fn scene(&self) -> Scene {
        Scene::parse("scene.toml", &self.0, Path::new(""), &[]).unwrap_or_else(|error| panic!("{error}\n{}", self.0))
    }

    /// Its waves.
    pub fn waves(&self) -> LatticeWaves {
        let scene = self.scene();
        let cell = scene.built().cell.as_ref().unwrap();
        LatticeWaves::new(&cell.model, &cell.state, cell.relaxes).unwrap()
    }
}

/// The waves at κ, on the way to another.
pub fn row_towards(waves: &LatticeWaves, kappa: [f64; 3], to: [f64; 3]) -> BandRow {
    let words = |[x, y, z]: [f64; 3]| format!("{x},{y},{z}");
    let path = BandPath::parse(&format!("{} {}", words(kappa), words(to)), 2, &[true; 3]).unwrap();
    waves.row(&path.points[0], true).unwrap()
}

/// The waves at κ.
pub fn row(waves: &LatticeWaves, kappa: [f64; 3]) -> BandRow {
    row_towards(waves, kappa, kappa.map(|kappa| kappa + 0.1))
}

/// ω of all branches, ascending.
pub fn frequencies(waves: &LatticeWaves, kappa: [f64; 3]) -> Vec<f64> {
    row(waves, kappa).branches.iter().map(|branch| branch.omega).collect()
}

/// The frequency that is nearest to one.
pub fn nearest(frequencies: &[f64], to: f64) -> f64 {
    frequencies.iter().copied().min_by(|a, b| (a - to).abs().total_cmp(&(b - to).abs())).unwrap()
}

/// The root that is nearest to one.
pub fn nearest_root(row: &BandRow, to: Complex<f64>) -> Complex<f64> {
    row.roots.iter().copied().min_by(|a, b| (a - to).norm().total_cmp(&(b - to).norm())).unwrap()
}

/// A granule of case 8: mass, Euler moment along x, stiffness against stretch along x [J], its own material.
#[derive(Debug, Clone, Copy)]
pub struct Granule {
    pub mass: f64,
    pub moment: f64,
    pub stiffness: f64,
}

/// m 2 kg, j 0.05 kg m², κ 8 J, springs of 6 N/m between faces, 0.4 m apart, at a spacing of 1 m.
pub const GRANULE: Granule = Granule { mass: 2.0, moment: 0.05, stiffness: 8.0 };
pub const BETWEEN: f64 = 6.0;
pub const LENGTH: f64 = 0.4;
/// Its volume [m³].
pub const VOLUME: f64 = 0.004;

impl Granule {
    /// 2μV = κ: its stiffness against stretch along each axis.
    pub fn material(&self) -> String {
        format!("material = {{ st_venant_kirchhoff = {{ lambda = 0, mu = {:?} }} }}", 0.5 * self.stiffness / VOLUME)
    }

    /// The table of its body; `kind` as in `affine = { … }`.
    pub fn table(&self, kind: &str) -> String {
        format!(
            "shape = {{ box = {{ size = [{LENGTH}, 0.1, 0.1] }} }}\nmass_properties = {{ mass = {:?}, euler_tensor = \
             [[{:?}, 0, 0], [0, 0.02, 0], [0, 0, 0.03]] }}\n{kind}\n",
            self.mass, self.moment
        )
    }

    pub fn affine(&self) -> String {
        self.table(&format!("affine = {{ {} }}", self.material()))
    }

    /// ω² of both branches, the acoustic one first: mj ω⁴ − (4ks² j + (κ + kl²c²) m) ω² + 4ks² κ = 0.
    pub fn squares(&self, q: f64) -> [f64; 2] {
        let (s, c) = (0.5 * q).sin_cos();
        let (own, stretch) = (4.0 * BETWEEN * s * s, self.stiffness + BETWEEN * (LENGTH * c).powi(2));
        let (sum, product) =
            (own / self.mass + stretch / self.moment, own * self.stiffness / (self.mass * self.moment));
        let root = (0.25 * sum * sum - product).sqrt();
        [product / (0.5 * sum + root), 0.5 * sum + root]
    }
}

/// The spring between the faces of granules of case 8.
pub fn between_faces<'a>(between: [&'a str; 2], cell: [i32; 3]) -> Link<'a> {
    let half = 0.5 * LENGTH;
    Link { between, cell, points: [[half, 0.0, 0.0], [-half, 0.0, 0.0]], law: [BETWEEN, 1.0 - LENGTH, 0.0] }
}

/// Granules of case 8 whose contraction has this drag and follows their stretch with this gain.
pub fn granules_that_feel(gain: f64, drag: f64) -> LatticeScene {
    let kind = format!(
        "contractile = {{ {}, contraction_viscosity = {drag}, drive = {{ constant = {{ value = [[0, 0, 0], [0, 0, \
         0], [0, 0, 0]] }} }}, feedback = {{ measure = {{ stretch = [1, 0, 0] }}, gain = [[{}, 0, 0], [0, 0, 0], \
         [0, 0, 0]], bias = [[{gain}, 0, 0], [0, 0, 0], [0, 0, 0]] }} }}",
        GRANULE.material(),
        -gain,
    );
    let chain = LatticeScene::new(&[[1.0, 0.0, 0.0]]).body("a", [0.0; 3], &GRANULE.table(&kind));
    chain.spring(between_faces(["a", "a"], [1, 0, 0]))
}
