//! Bodies that deform, free and near a table.

use gyration::affine::{AffineBody, Viscosity};
use gyration::body::{Affine, Body, BodyKind, Contractile, Solid};
use gyration::contact::{AreaMeasure, Contact, ContactLaw, Damping, Friction, LawSet, Repulsion};
use gyration::contractile::{Contraction, ContractionSource, Spin};
use gyration::kinematics::{Placement, Quaternion, Velocity};
use gyration::material::{Hencky, Material, MooneyRivlin, NeoHookeanLog, Ogden, OgdenTerm};
use gyration::model::Model;
use gyration::shape::{Cuboid, Shape};
use gyration::signal::{Signal, Wave};
use gyration::state::{Start, State};
use gyration::support::{Support, SupportMotion};
use gyration::tensor::{Mat3, Vec3, cross_matrix};

/// The materials measured, by name.
pub const MATERIALS: [&str; 5] = ["mooney_rivlin", "mooney_rivlin_bulk", "neo_hookean_log", "ogden", "hencky"];

/// A material by its name.
///
/// # Panics
/// If there is no such name.
pub fn material(name: &str) -> Material {
    let rubber = |bulk| Material::MooneyRivlin(MooneyRivlin { c1: 7.0, c2: 3.0, bulk });
    match name {
        "mooney_rivlin" => rubber(None),
        "mooney_rivlin_bulk" => rubber(Some(100.0)),
        "neo_hookean_log" => Material::NeoHookeanLog(NeoHookeanLog { mu: 20.0, lambda: 100.0 }),
        "ogden" => {
            let terms = [(10.0, 1.3), (-3.0, -2.0)].map(|(mu, alpha)| OgdenTerm { mu, alpha });
            Material::Ogden(Ogden { terms: terms.to_vec(), bulk: None })
        }
        "hencky" => Material::Hencky(Hencky { shear: 20.0, bulk: 100.0 }),
        other => panic!("no material {other}"),
    }
}

/// A stretch and shears of determinant one.
fn strain() -> Mat3 {
    Mat3::new(1.25, 0.1, 0.0, 0.0, 1.0, 0.05, 0.0, 0.0, 0.8)
}

/// A unit cube of density one, deforming and spinning; free in space.
///
/// # Panics
/// If it has no inertia: a mistake in this file.
pub fn free_cube(material: Material) -> (Model, State) {
    cube(material, Vec::new(), 2.0, Vec3::zeros())
}

/// The soft cube of the comparison with other solvers: rest gap 0.03, ν = 6, damping and friction ν = 3, gravity one.
///
/// # Panics
/// As [`free_cube`].
pub fn cube_over_table(material: Material, height: f64) -> (Model, State) {
    let laws = vec![
        ContactLaw::Repulsion(Repulsion { alpha: 0.03f64.powi(6), exponent: 6.0, reference_gap: 1.0 }),
        ContactLaw::Damping(Damping { beta: 5e-5, exponent: 3.0, reference_gap: 1.0, release: None }),
        ContactLaw::Friction(Friction { beta: 5e-5, exponent: 3.0, reference_gap: 1.0, mu: None }),
    ];
    cube(material, laws, height, -Vec3::z())
}

/// The free cube, contracting: driven, μ_γ = 0.8, G apart from I; compared with [`free_cube`].
///
/// # Panics
/// As [`free_cube`].
pub fn contracting_cube(material: Material) -> (Model, State) {
    let (model, state) = free_cube(material);
    let Model { gravity, supports, bodies, .. } = model;
    let motion = state.bodies.clone();
    let bodies = bodies.into_iter().map(|body| {
        let affine = body.affine().cloned().unwrap_or_else(|| panic!("the cube deforms"));
        let wave =
            Wave { amplitude: Mat3::new(3.0, 0.5, 0.0, 0.0, -1.0, 0.0, 0.3, 0.0, 2.0), frequency: 2.0, phase: 0.3 };
        let source = ContractionSource::Driven { drive: Signal::Sine(wave), feedback: Vec::new() };
        let contraction = Contraction { viscosity: 0.8, kept_volume: None, spin: Spin::Full, source };
        Body { kind: BodyKind::Contractile(Box::new(Contractile::new(affine, contraction))), ..(*body).clone() }
    });
    let model = Model::new(gravity, supports, bodies);
    let contraction = Mat3::new(1.1, 0.05, 0.0, 0.0, 0.9, 0.1, -0.05, 0.0, 1.0);
    let contraction = contraction / libm::cbrt(contraction.determinant());
    let mut state = State { works: vec![0.0; model.works().len()], ..state };
    state.bodies = motion.into_iter().chain(contraction.iter().copied()).collect();
    (model, state)
}

fn cube(material: Material, laws: Vec<ContactLaw>, height: f64, gravity: Vec3) -> (Model, State) {
    let shape = Shape::Box(Cuboid { size: Vec3::repeat(1.0) });
    let mass = shape.mass_properties(1.0);
    let viscosity = Viscosity { kirchhoff: 0.5, ..Viscosity::default() };
    let interior = AffineBody::new(&mass, None, Some(material), viscosity).unwrap_or_else(|error| panic!("{error}"));
    let rotation = Quaternion::from_axis_angle(&Vec3::new(1.0, 0.7, 0.3), 0.5).rotation();
    let gradient = if laws.is_empty() { rotation * strain() } else { rotation };
    let rate = cross_matrix(&Vec3::new(1.0, 0.5, 2.0)) * gradient;
    let contacts =
        if laws.is_empty() { Vec::new() } else { vec![Contact::new(0, 0, LawSet::new(AreaMeasure::default(), laws))] };
    let body = Body {
        kind: BodyKind::Affine(Box::new(Affine::from(interior))),
        size: shape.size(),
        solid: Solid::new(shape, mass).into(),
        inclusion: None,
        guide: None,
        own: Default::default(),
        pin: None,
    };
    let table =
        Support { name: "table".into(), origin: Vec3::zeros(), normal: Vec3::z(), motion: SupportMotion::default() };
    let model = Model::new(gravity, vec![table], vec![body]).with_contacts(contacts);
    let start = Start::Affine(
        Placement { position: Vec3::new(0.0, 0.0, height), gradient },
        Velocity { velocity: Vec3::new(0.3, 0.0, 0.0), gradient_rate: rate },
    );
    let state = State::start(&model, &[start]);
    (model, state)
}
