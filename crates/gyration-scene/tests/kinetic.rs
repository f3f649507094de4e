//! `kinetic`: other kinetic energies of a body that deforms, and what cannot go with them (`§`).

use crate::common::{BALL, TIME, assert_error, assert_resolves_to_itself, errors};
use gyration::affine::Kinetic;
use gyration_scene::Scene;
use std::path::Path;

#[test]
fn other_kinetic_energies_are_read_and_go_with_a_constant_mass_alone() {
    let scene = |kinetic: &str| {
        let text = format!("{TIME}{BALL}affine = {{ kinetic = {kinetic} }}\n");
        Scene::parse("scene.toml", &text, Path::new(""), &[]).unwrap_or_else(|errors| panic!("{errors}"))
    };
    let invariant = "{ invariant = { A = \"200 g cm^2\", B = -1e-5 } }";
    let kinds = [("\"comoving\"", Kinetic::Comoving), (invariant, Kinetic::Invariant { square: 2e-5, trace: -1e-5 })];
    for (kinetic, expected) in kinds {
        let body = scene(kinetic).built().model.bodies[0].clone();
        assert_eq!(body.affine().unwrap().interior.kinetic, Some(expected));
        assert_resolves_to_itself(&scene(kinetic));
    }
    let cases = [
        ("affine = { kinetic = §\"rigid\" }", "affine.kinetic", "rigid", "comoving"),
        (
            "affine = { kinetic = { invariant = { A = §0, B = 1 } } }",
            "affine.kinetic.invariant.A",
            "keeps the volume",
            "",
        ),
        ("affine = { kinetic = { invariant = { A = 3, B = §-1 } } }", "affine.kinetic.invariant.B", "A + 3 B = 0", ""),
        (
            "affine = { kinetic = §\"comoving\", material = { neo_hookean = { shear = 1 } } }",
            "affine.kinetic",
            "a volume that is kept",
            "`bulk`",
        ),
        ("affine = { kinetic = §\"comoving\" }\npin = [0, 0, 0.1]", "affine.kinetic", "a pin", "`pin`"),
        ("affine = { kinetic = §\"comoving\" }\nkeep = { plane = [0, 0, 1] }", "affine.kinetic", "a guide", "`keep`"),
        (
            "contractile = { kinetic = §\"comoving\", contraction_viscosity = 1 }",
            "contractile.kinetic",
            "drives itself",
            "",
        ),
        (
            "affine = { kinetic = §\"comoving\" }\ninclusion = { inertia = false }\n[fluid]\nviscosity = 1",
            "affine.kinetic",
            "without inertia",
            "",
        ),
    ];
    for (lines, key, message, help) in cases {
        assert_error(&format!("{TIME}{BALL}{lines}\n"), &format!("body.ball.{key}"), message, help);
    }
    let joint = "[[joint]]\nname = \"j\"\nbetween = [\"ball\", \"space\"]\nkind = \"ball\"\n";
    let hinged = format!("affine = {{ kinetic = \"comoving\" }}\n{joint}");
    let text = format!("{TIME}{BALL}{}points = [[0, 0, 0], [0, 0, 1]]\n", hinged);
    let found = errors("scene.toml", &text, &[]);
    assert!(found.to_string().contains("a joint asks for bodies of the kinetic energy"), "{found}");
}
