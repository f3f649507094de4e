//! Row 2: an incompressible body without elasticity: simple shear P = I + γt e₁⊗e₂ is exact, with π = 0.
//!
//! L = γ e₁⊗e₂ has tr(L²) = 0, so that the constraint asks for no pressure; any a⊗b with a·b = 0 will do, and any mass.

use crate::soft::{self, alone, body, spread};
use gyration::tensor::{Mat3, Vec3};
use gyration_validation::{Case, largest};

const FREE: &str = "material = { mooney_rivlin = { c1 = 0, c2 = 0 } }";

#[test]
fn simple_shear_is_exact_and_needs_no_pressure() {
    let across = Vec3::new(1.0, 2.0, 0.0) * Vec3::new(2.0, -1.0, 3.0).transpose();
    let cases = [
        ("sphere, shear of 3 /s along x", soft::BALL, 3.0 * Vec3::x() * Vec3::y().transpose()),
        ("box 0.1×0.2×0.3 m, shear askew", "shape = { box = { size = [0.1, 0.2, 0.3] } }", across),
    ];
    for (name, shape, rate) in cases {
        let case = Case { row: Some(2), name, source: "P = I + γt e₁⊗e₂, π = 0" };
        let run = alone(&body(shape, FREE, &Mat3::identity(), &rate), (1e-10, 1e-12)).until(5.0).sampled(0.5).run();
        let exact = |t: &f64| Mat3::identity() + *t * rate;
        let (error, size) = spread(&run.matrices("placement_gradient"), run.times.iter().map(exact));
        // The tolerance of the list.
        case.check("largest error of P over 5 s, over its size", 0.0, error / size, 1e-10);
        // A pressure of the size of the inertia: j γ²/V, some ρR²γ²/5.
        let pressures = run.column("body.pressure").into_iter();
        let scale = 1000.0 * 0.01 * rate.norm_squared() / 5.0;
        case.check("largest pressure over ρR²γ²/5", 0.0, largest(pressures) / scale, 1e-10);
        let volume = run.matrices("placement_gradient").into_iter().map(|p| p.determinant() - 1.0);
        case.check("largest error of det P", 0.0, largest(volume), 1e-10);
    }
}
