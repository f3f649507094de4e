//! Rest states and small motions about them, against closed forms.

use gyration::affine::{AffineBody, Kinetic, Viscosity};
use gyration::body::{Affine, Body, BodyKind, Pin, RigidInertia, Solid};
use gyration::contact::{AreaMeasure, Contact, ContactLaw, Damping, Friction, LawSet, Repulsion};
use gyration::kinematics::{Placement, Quaternion, Velocity};
use gyration::load::{Spring, SpringLaw};
use gyration::material::{Material, MooneyRivlin, NeoHookeanLog};
use gyration::model::Model;
use gyration::shape::{Cuboid, Shape, Sphere};
use gyration::state::{RigidStart, Start, State};
use gyration::support::{MotionPart, Support, SupportMotion};
use gyration::surface::Surface;
use gyration::tensor::{Mat3, Vec3};
use gyration_sim::modes::{Mode, ModeBehaviour, NoRest, Rest, modes, rest};
use gyration_threads::Interruption;
use std::sync::Arc;
use std::time::Duration;

const GRAVITY: f64 = 9.81;

/// The relative error of a value, printed, and asserted to be below a tolerance.
fn assert_close(name: &str, value: f64, expected: f64, tolerance: f64) {
    let error = (value / expected - 1.0).abs();
    println!("{name}: {value:.12} for {expected:.12}, off by {error:.1e}");
    assert!(error <= tolerance, "{name}: {value} instead of {expected}, off by {error:e}");
}

fn bare(shape: Shape, density: f64) -> Body {
    let mass = shape.mass_properties(density);
    Body {
        kind: BodyKind::Rigid(RigidInertia::new(&mass, None).unwrap()),
        size: shape.size(),
        solid: Solid::new(shape, mass).into(),
        inclusion: None,
        own: Default::default(),
        pin: None,
        guide: None,
    }
}

fn soft(shape: Shape, density: f64, material: Option<Material>, viscosity: f64) -> Body {
    let body = bare(shape, density);
    let viscosity = Viscosity { kirchhoff: viscosity, ..Viscosity::default() };
    let interior = AffineBody::new(&body.solid.mass, None, material, viscosity).unwrap();
    Body { kind: BodyKind::Affine(Box::new(Affine::from(interior))), ..body }
}

fn rubber() -> Option<Material> {
    Some(Material::MooneyRivlin(MooneyRivlin { c1: 3000.0, c2: 1000.0, bulk: None }))
}

fn ball() -> Shape {
    Shape::Sphere(Sphere { radius: 0.1 })
}

fn plane(normal: Vec3) -> Support {
    Support { name: "plane".into(), origin: Vec3::zeros(), normal, motion: SupportMotion::default() }
}

/// The same with a contact.
fn on(contact: Contact, (model, state): (Model, State)) -> (Model, State) {
    let model = model.with_contacts(vec![contact]);
    let state = State { works: vec![0.0; model.works().len()], ..state };
    (model, state)
}

/// The same with a spring to the place above the origin.
fn hung(law: SpringLaw, (model, state): (Model, State)) -> (Model, State) {
    let model = model.with_springs(vec![Spring::to_anchor(0, Vec3::zeros(), Vec3::z(), law)]);
    let state = State { works: vec![0.0; model.works().len()], ..state };
    (model, state)
}

/// A body with supports, starting at a place, not turned.
fn model(gravity: f64, supports: Vec<Support>, body: Body, position: Vec3) -> (Model, State) {
    let start = match body.kind {
        BodyKind::Rigid(_) => Start::Rigid(RigidStart {
            position,
            orientation: Quaternion::IDENTITY,
            velocity: Vec3::zeros(),
            angular_velocity: Vec3::zeros(),
        }),
        BodyKind::Affine(_) | BodyKind::Contractile(_) => Start::Affine(
            Placement { position, gradient: Mat3::identity() },
            Velocity { velocity: Vec3::zeros(), gradient_rate: Mat3::zeros() },
        ),
    };
    let model = Model::new(Vec3::new(0.0, 0.0, -gravity), supports, vec![body]);
    let state = State::start(&model, &[start]);
    (model, state)
}

fn survey((model, state): &(Model, State)) -> (Rest, Vec<Mode>) {
    let rest = rest(model, state, 0).unwrap_or_else(|error| panic!("{error}"));
    let found = modes(model, state, 0, &rest).unwrap();
    for mode in &found {
        let values: Vec<String> = mode.eigenvalues.iter().map(|value| format!("{value:.6}")).collect();
        println!("  {} {:?} {}", values.join(" "), mode.motion, mode.in_words);
    }
    (rest, found)
}

fn named<'a>(modes: &'a [Mode], words: &str) -> &'a Mode {
    modes
        .iter()
        .find(|mode| mode.in_words == words)
        .unwrap_or_else(|| panic!("no {words} among {:?}", modes.iter().map(|mode| &mode.in_words).collect::<Vec<_>>()))
}

fn of_motion(modes: &[Mode], motion: ModeBehaviour) -> Vec<&Mode> {
    modes.iter().filter(|mode| mode.motion == motion).collect()
}

#[test]
fn incompressible_sphere_rings_in_five_modes_and_is_free_in_six() {
    let (_, found) = survey(&model(0.0, vec![], soft(ball(), 1000.0, rubber(), 20.0), Vec3::zeros()));
    assert_eq!(found.len(), 11);
    let ringing = of_motion(&found, ModeBehaviour::Oscillates);
    assert_eq!((ringing.len(), of_motion(&found, ModeBehaviour::Free).len()), (5, 6));
    // ω₀² = 20 (c₁ + c₂)/(ρR²), δ = μV/(2j) = 5μ/(2ρR²), and the damped ω² = ω₀² − δ².
    let (square, decay) = (20.0 * 4000.0 / (1000.0 * 0.01), 5.0);
    for mode in ringing {
        assert_close(&mode.in_words, mode.eigenvalues[0].norm(), f64::sqrt(square), 1e-13);
        assert_close("frequency", mode.frequency(), f64::sqrt(square - decay * decay), 1e-13);
        assert_close("decay", mode.decay_rates()[0], decay, 1e-12);
        assert_close("ratio", mode.damping_ratio().unwrap(), decay / f64::sqrt(square), 1e-12);
    }
    assert_close("verification's number", f64::sqrt(square), 89.442719100, 1e-11);
    for words in ["shear in the plane xy", "stretch along z", "rotation about x", "translation along y"] {
        named(&found, words);
    }
}

#[test]
fn cube_and_box_have_the_frequencies_of_the_closed_form() {
    let cube = Shape::Box(Cuboid { size: Vec3::repeat(0.1) });
    let (_, found) = survey(&model(0.0, vec![], soft(cube, 1000.0, rubber(), 0.0), Vec3::zeros()));
    let ringing = of_motion(&found, ModeBehaviour::Oscillates);
    assert_eq!(ringing.len(), 5);
    for mode in ringing {
        assert_close(&mode.in_words, mode.frequency(), 138.5640646, 1e-9);
        assert_eq!(mode.decay_rates(), [0.0; 2]);
    }
    // ω_ij² = 2 (c₁ + c₂) V (1/J_i + 1/J_j), J_i = m a_i²/12.
    let size = Vec3::new(0.1, 0.25, 0.4);
    let (_, found) =
        survey(&model(0.0, vec![], soft(Shape::Box(Cuboid { size }), 700.0, rubber(), 0.0), Vec3::zeros()));
    for (i, j, words) in [(0, 1, "xy"), (0, 2, "xz"), (1, 2, "yz")] {
        let inverse = |k: usize| 12.0 / (700.0 * size[k] * size[k]);
        let expected = (2.0 * 4000.0 * (inverse(i) + inverse(j))).sqrt();
        let near =
            found.iter().map(Mode::frequency).min_by(|a, b| (a - expected).abs().total_cmp(&(b - expected).abs()));
        assert_close(words, near.unwrap(), expected, 1e-12);
    }
}

#[test]
fn compressible_sphere_breathes_at_the_bulk_modulus() {
    // About rest μ/2 (ι₁ − 3) − μ ln J + λ/2 ln²J has the bulk modulus λ + 2μ/3 and the shear modulus μ.
    let (mu, lambda) = (8000.0, 50000.0);
    let material = Some(Material::NeoHookeanLog(NeoHookeanLog { mu, lambda }));
    let body = soft(ball(), 1000.0, material, 0.0);
    let euler = body.solid.mass.euler_tensor.m11;
    let volume = body.solid.mass.volume;
    let (_, found) = survey(&model(0.0, vec![], body, Vec3::zeros()));
    assert_eq!(found.len(), 12);
    let breath = (3.0 * (lambda + 2.0 * mu / 3.0) * volume / euler).sqrt();
    assert_close("breathing", named(&found, "breathing").frequency(), breath, 1e-12);
    assert_close(
        "shear",
        named(&found, "shear in the plane xz").frequency(),
        (2.0 * mu * volume / euler).sqrt(),
        1e-12,
    );
}

/// A box of 2 kg, 0.1×0.1×0.2 m, above a field of α = 1e-6, ν = 6.
fn standing(height: f64, deformable: Option<f64>) -> (Model, State) {
    let shape = Shape::Box(Cuboid { size: Vec3::new(0.1, 0.1, 0.2) });
    let body = match deformable {
        None => bare(shape, 1000.0),
        Some(stiffness) => {
            let material = MooneyRivlin { c1: stiffness, c2: 0.0, bulk: None };
            soft(shape, 1000.0, Some(Material::MooneyRivlin(material)), 0.0)
        }
    };
    let law = Repulsion { alpha: 1e-6, exponent: 6.0, reference_gap: 1.0 };
    let contact = Contact::new(0, 0, LawSet::new(AreaMeasure::default(), vec![ContactLaw::Repulsion(law)]));
    on(contact, model(GRAVITY, vec![plane(Vec3::z())], body, Vec3::new(0.3, -0.2, height)))
}

#[test]
fn rigid_box_rests_on_its_face_and_rocks_about_it() {
    for height in [0.1301, 0.5, 20.0] {
        let (rest, found) = survey(&standing(height, None));
        // The list has 12 digits of the gap, 8 of the frequency.
        assert_close("gap", rest.gap, 0.0292715643344, 2e-12);
        assert_close("vertical", named(&found, "translation along z").frequency().powi(2), 1947.2413, 2e-8);
        assert_eq!(found.len(), 6);
        assert_eq!(of_motion(&found, ModeBehaviour::Free).len(), 3);
        // Nothing has pushed it aside.
        assert!((rest.placement.position.xy() - Vec3::new(0.3, -0.2, 0.0).xy()).norm() < 1e-12);
    }
}

#[test]
fn stiff_affine_box_has_the_slow_modes_of_the_rigid_one() {
    let (_, rigid) = survey(&standing(0.3, None));
    let mut last = f64::INFINITY;
    for stiffness in [1e7, 1e9] {
        let (rest, stiff) = survey(&standing(0.3, Some(stiffness)));
        let frequencies = |modes: &[Mode]| -> Vec<f64> {
            let mut all: Vec<f64> =
                of_motion(modes, ModeBehaviour::Oscillates).into_iter().map(Mode::frequency).collect();
            all.sort_by(f64::total_cmp);
            all.truncate(3);
            all
        };
        let errors = frequencies(&rigid).into_iter().zip(frequencies(&stiff)).map(|(a, b)| (a / b - 1.0).abs());
        let error = errors.fold(0.0, f64::max);
        println!(
            "modulus {stiffness:e}: slow modes off by {error:.1e}, stretches {:?}",
            rest.stretches - Vec3::repeat(1.0)
        );
        // As 1/stiffness: a hundredfold modulus leaves a hundredth, here with a margin of two.
        assert!(error < last / 50.0 && error < 1e-3, "{error:e} after {last:e}");
        last = error;
    }
}

#[test]
fn flat_box_on_the_field_of_its_bottom_rocks_as_in_the_closed_form() {
    // ω² = mg(νL²/(12d) − h/2)/I, bottom face only: row 19.
    let (side, height, mass) = (0.1, 0.2, 2.0);
    let (model, state) = standing(0.2, None);
    let mut body = (*model.bodies[0]).clone();
    let half = 0.5 * side;
    let corners = [(-half, -half), (-half, half), (half, half), (half, -half)];
    let corners = corners.map(|(x, y)| Vec3::new(x, y, -0.5 * height));
    let facet = Surface::from_triangles(&corners, &[[0, 1, 2], [0, 2, 3]]).unwrap();
    Arc::make_mut(&mut body.solid).surface = Some(facet);
    let single = (model.with_bodies([body]), state);
    let (rest, found) = survey(&single);
    let gap = (1e-6 * side * side / (mass * GRAVITY)).powf(1.0 / 6.0);
    assert_close("gap", rest.gap, gap, 1e-13);
    let inertia = mass * (side * side + height * height) / 12.0;
    let expected = (mass * GRAVITY * (6.0 * side * side / (12.0 * gap) - 0.5 * height) / inertia).sqrt();
    for words in ["rotation about x", "rotation about y"] {
        assert_close(words, named(&found, words).frequency(), expected, 1e-11);
    }
    // The list's gap was rounded.
    assert_close("listed", expected, 13.4565099703, 1e-9);
}

/// A ball with a field that carries it some millimetres above a plane.
fn resting_ball(normal: Vec3, friction: f64, deformable: bool) -> (Model, State) {
    let body = if deformable { soft(ball(), 1000.0, rubber(), 20.0) } else { bare(ball(), 1000.0) };
    let laws = vec![
        ContactLaw::Repulsion(Repulsion { alpha: 40e3, exponent: 6.0, reference_gap: 2e-3 }),
        ContactLaw::Damping(Damping { beta: 500.0, exponent: 6.0, reference_gap: 2e-3, release: None }),
        ContactLaw::Friction(Friction { beta: friction, exponent: 6.0, reference_gap: 2e-3, mu: None }),
    ];
    let contact = Contact::new(0, 0, LawSet::new(AreaMeasure::DeformedAreaPotential, laws));
    on(contact, model(GRAVITY, vec![plane(normal)], body, 0.5 * normal))
}

#[test]
fn rigid_ball_on_a_table_rolls_freely_and_slides_with_friction() {
    let (_, found) = survey(&resting_ball(Vec3::z(), 2e3, false));
    let free = of_motion(&found, ModeBehaviour::Free);
    assert_eq!(free.len(), 5);
    // The field is not a point: its friction away from the axis stops rolling too, and a spin about the vertical, but
    // slowly.
    let mut rates: Vec<f64> = free.iter().map(|mode| mode.decay_rates()[1]).collect();
    rates.sort_by(f64::total_cmp);
    println!("rates {rates:?}");
    assert!(rates[2] < 0.01 * rates[3] && rates[0] > 0.0);
    // Sliding without turning would decay as (β/α) g; at the contact point (1 + 5/2) times as fast, to the order of
    // d/R.
    assert_close("sliding", rates[4], 3.5 * 2e3 / 40e3 * GRAVITY, 0.02);
}

#[test]
fn soft_ball_rests_flattened_and_its_rest_state_is_in_balance() {
    let (model, state) = resting_ball(Vec3::z(), 0.0, true);
    let (rest, found) = survey(&(model.clone(), state.clone()));
    assert_eq!(found.len(), 11);
    println!("stretches {:?}, pressure {:?}", rest.stretches, rest.pressure);
    assert!(rest.stretches[0] > 1.01 && rest.stretches[2] < 0.98);
    assert!((rest.placement.gradient.determinant() - 1.0).abs() < 1e-14);
    // Turned about the vertical it is as wide as before.
    assert_close("round", rest.stretches[0], rest.stretches[1], 1e-9);
    // From its rest state the search stays where it is.
    let still = Velocity { velocity: Vec3::zeros(), gradient_rate: Mat3::zeros() };
    let again = State::start(&model, &[Start::Affine(rest.placement, still)]);
    let second = gyration_sim::modes::rest(&model, &again, 0).unwrap();
    assert!((second.placement.gradient - rest.placement.gradient).norm() < 1e-12);
    assert!((second.placement.position - rest.placement.position).norm() < 1e-12);
    assert!(of_motion(&found, ModeBehaviour::Grows).is_empty());
    // In the plane of the table the ball is free to slide and to turn about the vertical.
    for words in ["translation along x", "translation along y", "rotation about z"] {
        assert_eq!(named(&found, words).motion, ModeBehaviour::Free);
    }
}

#[test]
fn box_on_its_corner_finds_a_face() {
    for deformable in [None, Some(1e5)] {
        let (model, state) = standing(0.4, deformable);
        let turn = Quaternion::from_axis_angle(&Vec3::new(1.0, 0.4, 0.2), 0.9);
        let motion = state.motion(&model, 0);
        let start = match deformable {
            None => Start::Rigid(RigidStart {
                position: motion.placement.position,
                orientation: turn,
                velocity: Vec3::new(1.0, 0.0, 3.0),
                angular_velocity: Vec3::new(9.0, 2.0, 1.0),
            }),
            Some(_) => Start::Affine(Placement { gradient: turn.rotation(), ..motion.placement }, motion.velocity),
        };
        let tilted = State::start(&model, &[start]);
        let (rest, found) = survey(&(model, tilted));
        // One of the box's axes stands upright, and the rest state is stable.
        let up = rest.placement.gradient.tr_mul(&Vec3::z()).amax();
        println!("upright to {:.1e}", up - 1.0);
        assert!((up - 1.0).abs() < 0.05 && of_motion(&found, ModeBehaviour::Grows).is_empty());
        if deformable.is_none() {
            assert!((up - 1.0).abs() < 1e-12);
        }
    }
}

#[test]
fn pendulum_has_its_frequency_hanging_and_its_growth_upside_down() {
    let (length, side) = (0.5, 0.1);
    for (sign, motion) in [(1.0, ModeBehaviour::Oscillates), (-1.0, ModeBehaviour::Grows)] {
        let mut body = bare(Shape::Box(Cuboid { size: Vec3::repeat(side) }), 1000.0);
        let pin = Pin { point: Vec3::new(0.0, 0.0, sign * length), anchor: Vec3::zeros() };
        body.kind = BodyKind::Rigid(RigidInertia::new(&body.solid.mass, Some(&pin)).unwrap());
        body.pin = Some(pin);
        let (_, found) = survey(&model(GRAVITY, vec![], body, -pin.point));
        assert_eq!(found.len(), 3);
        // ω² = m g l/(m l² + m a²/6).
        let rate = (GRAVITY * length / (length * length + side * side / 6.0)).sqrt();
        let mode = named(&found, "rotation about x");
        assert_eq!(mode.motion, motion);
        assert_close("pendulum", mode.eigenvalues[0].norm(), rate, 1e-13);
        assert_eq!(named(&found, "rotation about z").motion, ModeBehaviour::Free);
    }
}

#[test]
fn pinned_incompressible_body_has_eight_modes() {
    let mut body = soft(ball(), 1000.0, rubber(), 0.0);
    let pin = Pin { point: Vec3::new(0.0, 0.0, 0.1), anchor: Vec3::zeros() };
    let interior = AffineBody::new(&body.solid.mass, Some(&pin.point), rubber(), Viscosity::default()).unwrap();
    body.kind = BodyKind::Affine(Box::new(Affine::from(interior)));
    body.pin = Some(pin);
    let (rest, found) = survey(&model(GRAVITY, vec![], body, Vec3::new(0.0, 0.0, -0.1)));
    assert_eq!(found.len(), 8);
    // It hangs from its top, stretched by its weight.
    assert!(rest.stretches[0] > 1.01 && (rest.placement.gradient.determinant() - 1.0).abs() < 1e-14);
    assert_eq!(of_motion(&found, ModeBehaviour::Free).len(), 1);
}

#[test]
fn spring_pendulum_bounces_and_swings() {
    let body = bare(ball(), 1000.0);
    let (stiffness, mass) = (400.0, body.solid.mass.mass);
    let spring = SpringLaw { stiffness, rest_length: 0.5, damping: 2.0 };
    let (rest, found) = survey(&hung(spring, model(GRAVITY, vec![], body, Vec3::new(0.4, 0.1, 0.8))));
    let length = 0.5 + mass * GRAVITY / stiffness;
    assert_close("length", 1.0 - rest.placement.position.z, length, 1e-13);
    let bounce = named(&found, "translation along z");
    assert_close("bounce", bounce.eigenvalues[0].norm(), (stiffness / mass).sqrt(), 1e-12);
    assert_close("decay", bounce.decay_rates()[0], 2.0 / (2.0 * mass), 1e-11);
    assert_close("swing", named(&found, "translation along x").frequency(), (GRAVITY / length).sqrt(), 1e-12);
}

#[test]
fn a_search_that_nobody_waits_for_is_given_up() {
    let spring = SpringLaw { stiffness: 400.0, rest_length: 0.5, damping: 2.0 };
    let body = bare(ball(), 1000.0);
    let (model, start) = hung(spring, model(GRAVITY, vec![], body, Vec3::new(0.4, 0.1, 0.8)));
    let at_once = Interruption::default().after(Some(Duration::ZERO));
    assert_eq!(at_once.within(|| rest(&model, &start, 0)), Err(NoRest::Interrupted));
    assert!(rest(&model, &start, 0).is_ok());
}

#[test]
fn what_has_no_rest_state_is_said_in_words() {
    let falling = model(GRAVITY, vec![], bare(ball(), 1000.0), Vec3::z());
    assert_eq!(rest(&falling.0, &falling.1, 0), Err(NoRest::Falls));
    let slope = Vec3::new(0.6, 0.0, 0.8);
    let sliding = resting_ball(slope, 1e3, true);
    let refusal = rest(&sliding.0, &sliding.1, 0).unwrap_err();
    println!("{refusal}");
    // g sinθ, downhill.
    let NoRest::Slides { along, acceleration } = refusal else { panic!("{refusal}") };
    assert!((acceleration - 0.6 * GRAVITY).abs() < 1e-14 && (along - Vec3::new(0.8, 0.0, -0.6)).norm() < 1e-14);
    // Without a material its own weight flattens a body that a field carries.
    let (model, state) = resting_ball(Vec3::z(), 0.0, true);
    let mut body = (*model.bodies[0]).clone();
    if let BodyKind::Affine(affine) = &mut body.kind {
        affine.interior.material = None;
    }
    let flattening = model.clone().with_bodies([body.clone()]);
    let refusal = rest(&flattening, &state, 0).unwrap_err();
    println!("{refusal}");
    assert!(matches!(refusal, NoRest::Deforms { .. }));
    if let BodyKind::Affine(affine) = &mut body.kind {
        affine.interior.kinetic = Some(Kinetic::Comoving);
    }
    assert_eq!(rest(&model.with_bodies([body]), &state, 0), Err(NoRest::NoConstantMass));
}

#[test]
fn what_a_fluid_remembers_is_no_drag() {
    // Symptom: a ball on a spring crept, with decay rates of a million.
    let text = "world = { gravity = [0, 0, 0] }\ntime = { end = 1, sample = 1 }\n\
                fluid = { viscosity = 0.1, density = 1 }\nlattice = { cell = [[0.1, 0, 0]] }\n[[body]]\n\
                name = \"ball\"\nshape = { sphere = { radius = 0.02 } }\ndensity = 1000\n\
                inclusion = { history = true }\nspring = [{ anchor = [0, 0, 0], stiffness = 10 }]\n";
    let scene = gyration_scene::Scene::parse("scene.toml", text, std::path::Path::new(""), &[]).unwrap();
    let cell = scene.built().cell.as_ref().unwrap();
    assert_eq!(rest(&cell.model, &cell.state, 0).unwrap_err(), NoRest::Remembered);
    let waves = gyration_sim::modes::bands::LatticeWaves::new(&cell.model, &cell.state, false);
    assert!(waves.is_err_and(|error| error.to_string().contains("history = false")));
}

#[test]
fn supports_that_move_are_held_where_they_are_at_the_start() {
    let (model, state) = standing(0.2, None);
    let mut moving = model.clone();
    let (direction, frequency) = (Vec3::z(), 50.0);
    let wobble = MotionPart::Oscillation { direction, amplitude: 0.01, frequency, phase: 0.5 * std::f64::consts::PI };
    Arc::make_mut(&mut moving.supports)[0].motion = SupportMotion::new(vec![wobble]);
    let (still, raised) = (rest(&model, &state, 0).unwrap(), rest(&moving, &state, 0).unwrap());
    assert!((raised.placement.position.z - still.placement.position.z - 0.01).abs() < 1e-13);
    assert_close("gap", raised.gap, still.gap, 1e-12);
}

#[test]
fn brick_that_falls_on_its_edge_is_not_turned_about_the_vertical() {
    // Far above the table all stiffnesses vanish but the material's; the free turn about the vertical must not be mixed
    // with the fall.
    let material = Some(Material::NeoHookeanLog(NeoHookeanLog { mu: 8000.0, lambda: 20000.0 }));
    let body = soft(Shape::Box(Cuboid { size: Vec3::new(0.2, 0.1, 0.06) }), 1000.0, material, 0.0);
    let law = Repulsion { alpha: 40e3, exponent: 6.0, reference_gap: 2e-3 };
    let laws = LawSet::new(AreaMeasure::DeformedAreaPotential, vec![ContactLaw::Repulsion(law)]);
    let (model, _) = on(Contact::new(0, 0, laws), model(GRAVITY, vec![plane(Vec3::z())], body, Vec3::zeros()));
    let gradient = Quaternion::from_axis_angle(&Vec3::y(), 0.5).rotation();
    let still = Velocity { velocity: Vec3::zeros(), gradient_rate: Mat3::zeros() };
    let start = State::start(&model, &[Start::Affine(Placement { position: 0.4 * Vec3::z(), gradient }, still)]);
    let (rest, _) = survey(&(model, start));
    let gradient = rest.placement.gradient;
    let aside = [gradient.m12, gradient.m21, gradient.m23, gradient.m32].map(f64::abs).into_iter().fold(0.0, f64::max);
    println!("aside {aside:.1e}, lying to {:.1e}", gradient.m13);
    // It lies on its largest face; noise of the search does not grow.
    assert!(aside < 1e-6 && gradient.m13.abs() < 1e-9 && rest.stretches[2] > 0.95);
}

/// A damping with d₀ = 1000 km is 10²⁹ times that of the scene at the same gap.
#[test]
fn motions_whose_rates_are_thirty_orders_apart_have_a_direction() {
    for d0 in ["5e-3", "1e3", "1e6"] {
        let overrides = [format!("contact.0.damping.d0={d0}")];
        let scene = gyration_scene::Scene::open("elastic-bounce-spinning", &overrides).unwrap();
        let (_, modes) = survey(&(scene.built().model.clone(), scene.built().state.clone()));
        for mode in &modes {
            let shape = &mode.shapes[0];
            let entries = shape.translation.iter().chain(shape.gradient.iter());
            assert!(entries.clone().all(|entry| entry.is_finite()), "{d0}: {mode:?}");
            assert!(entries.map(|entry| entry * entry).sum::<f64>() > 0.0, "{d0}: {mode:?}");
        }
    }
}
