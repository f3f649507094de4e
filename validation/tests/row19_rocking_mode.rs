//! Row 19: the rocking mode of a flat box that stands on the field of its bottom face alone.
//!
//!   ω² = mg (νL²/(12 d) − h/2)/I,   I = m (L² + h²)/12,   αA d^−ν = mg
//!
//! with base L × L, height h, rest gap d. It is unstable where d > νL²/(6h): the field is then too soft for the height,
//! and a tilt grows as cosh(|ω| t).

use gyration::body::{BodyKind, RigidInertia};
use gyration::contact::{ContactLaw, Repulsion};
use gyration::dynamics::Workspace;
use gyration::dynamics::jacobian;
use gyration::tensor::{Mat3, Vec3};
use gyration_sim::Tolerance;
use gyration_validation::{Case as Known, Experiment, FacetBody};
use nalgebra::DMatrix;
use std::f64::consts::PI;
use std::sync::Arc;

const BASE: f64 = 0.1;
const MASS: f64 = 2.0;
const GRAVITY: f64 = 9.81;

struct Case {
    name: &'static str,
    height: f64,
    nu: f64,
    /// Rest gap [m].
    gap: f64,
}

impl Case {
    /// α [Pa] that carries the box at its gap, d₀ = 1 m.
    fn alpha(&self) -> f64 {
        MASS * GRAVITY * self.gap.powf(self.nu) / (BASE * BASE)
    }

    fn known(&self) -> Known {
        Known { row: Some(19), name: self.name, source: "ω² = mg(νL²/(12d) − h/2)/I" }
    }

    fn inertia(&self) -> f64 {
        MASS * (BASE * BASE + self.height * self.height) / 12.0
    }

    /// ω² [1/s²].
    fn square(&self) -> f64 {
        MASS * GRAVITY * (self.nu * BASE * BASE / (12.0 * self.gap) - 0.5 * self.height) / self.inertia()
    }

    /// The angle [rad] by which a box that starts with this tilt leans at a time [s].
    fn tilt_after(&self, tilt: f64, time: f64) -> f64 {
        self.standing(tilt).motion_at(time).placement.gradient.m13.asin()
    }

    /// The box at its rest gap, tilted about y [rad]: the facet of `FacetBody`, with the mass of a box above it.
    fn standing(&self, tilt: f64) -> Experiment {
        let law = Repulsion { alpha: self.alpha(), exponent: self.nu, reference_gap: 1.0 };
        let body = FacetBody {
            mass: MASS,
            area: BASE * BASE,
            laws: vec![ContactLaw::Repulsion(law)],
            gravity: GRAVITY,
            gap: self.gap + 0.5 * self.height,
            tilt,
            velocity: 0.0,
        };
        let mut experiment = body.experiment(Tolerance { rtol: 1e-12, atol: 1e-14 });
        let body = &mut experiment.model.bodies[0];
        let down = Vec3::new(0.0, 0.0, -0.5 * self.height);
        let squares = Vec3::new(BASE * BASE, BASE * BASE, self.height * self.height);
        let body = Arc::make_mut(body);
        let solid = Arc::make_mut(&mut body.solid);
        solid.surface = solid.surface.as_ref().map(|facet| facet.translated(&down));
        solid.mass.euler_tensor = Mat3::from_diagonal(&(squares * (MASS / 12.0)));
        body.kind =
            BodyKind::Rigid(RigidInertia::new(&body.solid.mass, None).unwrap_or_else(|error| panic!("{error}")));
        experiment
    }
}

/// Rest gap of α = 1e-6 with ν = 6, as in the list.
fn listed() -> Case {
    let gap = (1e-6 * BASE * BASE / (MASS * GRAVITY)).powf(1.0 / 6.0);
    Case { name: "box 0.1×0.1×0.2 m of 2 kg on its bottom face, α = 1e-6, ν = 6", height: 0.2, nu: 6.0, gap }
}

const STIFF: Case =
    Case {
        name: "box 0.1×0.1×0.3 m of 2 kg on its bottom face, d = 2 mm, ν = 12", height: 0.3, nu: 12.0, gap: 2e-3
    };

/// ω² from the Jacobian: the rate of Ω_y by the tilt, which is twice the y component of the quaternion.
fn square_of_the_jacobian(experiment: &Experiment) -> f64 {
    let mut blocks = [DMatrix::zeros(13, 13)];
    let bodies = &experiment.start.bodies;
    jacobian(&experiment.model, &mut Workspace::default(), 0.0, bodies.into(), &mut blocks[..])
        .unwrap_or_else(|error| panic!("{error:?}"));
    -0.5 * blocks[0][(11, 5)]
}

#[test]
fn box_on_the_field_rocks_at_the_frequency_of_the_closed_form() {
    let listed = listed();
    // The list has 13.4565099703; its gap was rounded.
    assert!((listed.square().sqrt() - 13.4565099703).abs() < 1e-8, "{}", listed.square().sqrt());
    for case in [listed, STIFF] {
        let omega = case.square().sqrt();
        let of_the_jacobian = square_of_the_jacobian(&case.standing(0.0)).sqrt();
        case.known().check("rocking frequency of the exact Jacobian [rad/s]", omega, of_the_jacobian, 1e-12);
        // Some 1e-4 of the gap at the edge: the square of that is what the linear mode leaves out.
        let tilt = 1e-4 * case.gap / (0.5 * BASE);
        // θ = θ₀ cos ωt, five quarters of a period later: ωt = 5π/2 + ε with sin ε = −θ/θ₀.
        let time = 2.5 * PI / omega;
        let later = case.tilt_after(tilt, time);
        let measured = (2.5 * PI - (later / tilt).asin()) / time;
        case.known().check("rocking frequency of the motion [rad/s]", omega, measured, 1e-7);
    }
}

#[test]
fn box_too_high_for_its_field_falls_over() {
    // νL²/(6h) = 0.05 m.
    let case =
        Case { name: "box 0.1×0.1×0.2 m of 2 kg on its bottom face, d = 0.06 m, ν = 6", gap: 0.06, ..listed() };
    assert!(case.square() < 0.0);
    case.known().check(
        "ω² of the exact Jacobian [1/s²]",
        case.square(),
        square_of_the_jacobian(&case.standing(0.0)),
        1e-12,
    );
    let (tilt, growth) = (1e-6, (-case.square()).sqrt());
    let time = 3.0 / growth;
    let later = case.tilt_after(tilt, time);
    // The tilt has grown to 1e-5; the tolerances of rotation leave 1e-14 of one.
    case.known().check("rate at which a tilt grows [1/s]", growth, (later / tilt).acosh() / time, 1e-7);
    let stable = Case { gap: 0.0499, ..case };
    assert!(stable.square() > 0.0 && square_of_the_jacobian(&stable.standing(0.0)) > 0.0);
}
