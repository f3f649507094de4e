//! A soft ball in simple shear, given as a polyhedron of 320 facets, against the ball itself: the one by boundary
//! elements that follow it, the other in closed form.
//!
//! The polyhedron has the volume of the ball, so that its resistance differs by terms of second order in the height of
//! the sphere above its facets. It takes the form of the ball, inclined and drawn out, while its corners go round:
//! every quarter of a turn is another form.

use gyration::dynamics::Workspace;
use gyration::fluid::{Form, SurfaceForm};
use gyration::immersion::observe_immersion;
use gyration::shape::{Shape, Sphere};
use gyration::tensor::Polar;
use gyration_validation::{Case, Experiment, Run};

const SOURCE: &str = "the same ball, by the resistance of ellipsoids in closed form";
/// Radius [m].
const RADIUS: f64 = 0.005;
/// A fifth of what the resistance of the polyhedron may be wrong by, for the worst of all motions, which this one is
/// not.
const TOLERANCE: f64 = 2e-3;

fn experiment(shape: &str) -> Experiment {
    Experiment::of_scene(&format!(
        r#"
        time = {{ end = 1.5, sample = 0.1 }}
        solver = {{ rtol = 1e-6 }}
        fluid = {{ viscosity = 10, density = 1000, velocity_gradient = [[0, 0, 5], [0, 0, 0], [0, 0, 0]] }}
        [[body]]
        name = "ball"
        density = 1000
        shape = {shape}
        affine = {{ material = {{ neo_hookean = {{ shear = 166.66666666666666 }} }} }}
        inclusion = {{ inertia = false, triangles = 320 }}
        "#
    ))
}

/// A polyhedron of the volume of the ball.
fn polyhedron() -> String {
    let ball = Shape::Sphere(Sphere { radius: RADIUS }).triangulation(320);
    let scale = (4.0 / 3.0 * std::f64::consts::PI * RADIUS.powi(3) / ball.volume()).cbrt();
    let corners: Vec<_> = ball.points.iter().map(|point| format!("{:?}", (scale * point).as_slice())).collect();
    format!("{{ polyhedron = {{ vertices = [{}] }} }}", corners.join(", "))
}

/// Principal stretches, ascending, at the end.
fn stretches(experiment: &Experiment, run: &Run) -> [f64; 3] {
    let gradient = run.end.motion(&experiment.model, 0).placement.gradient;
    let mut stretches: [f64; 3] = Polar::of(&gradient).stretch.symmetric_eigenvalues().into();
    stretches.sort_by(f64::total_cmp);
    stretches
}

#[test]
fn soft_polyhedron_takes_the_form_of_the_ball_in_shear() {
    let case = Case { row: None, name: "soft ball of 320 facets in simple shear", source: SOURCE };
    let (exact, faceted) = (experiment(&format!("{{ sphere = {{ radius = {RADIUS} }} }}")), experiment(&polyhedron()));
    let (reference, measured) = (exact.run(), faceted.run());
    let Some(Form::Surface(SurfaceForm(table))) =
        faceted.model.bodies[0].inclusion.as_ref().map(|inclusion| inclusion.form.clone())
    else {
        panic!("{:?}", faceted.model.bodies[0].inclusion)
    };
    println!("{} steps against {}; {:?} nodes and simplices", measured.steps, reference.steps, table.size());
    let (expected, found) = (stretches(&exact, &reference), stretches(&faceted, &measured));
    let names = ["smallest stretch", "middle stretch", "largest stretch"];
    for (name, (expected, found)) in names.into_iter().zip(expected.into_iter().zip(found)) {
        case.check(name, expected, found, TOLERANCE);
    }
    let angle = |experiment: &Experiment, run: &Run| {
        let mut workspace = Workspace::default();
        let read = workspace.read(&experiment.model, &run.end);
        let seen = read.and_then(|(instant, scratch)| observe_immersion(&instant.at(0), scratch));
        seen.ok().flatten().map_or(f64::NAN, |seen| seen.inclination)
    };
    case.check("inclination [rad]", angle(&exact, &reference), angle(&faceted, &measured), TOLERANCE);
}
