//! What a deformable body in a scene becomes: materials, friction, loads, start, resolved form.

use crate::common::{BLOCK, TIME, assert_resolves_to_itself, block, start};
use gyration::affine::{Gyration, Viscosity};
use gyration::body::{Affine, BodyKind};
use gyration::load::Couple;
use gyration::material::{Fung, Hencky, Material, MooneyRivlin, NeoHookeanLog, Ogden, OgdenTerm, StVenantKirchhoff};
use gyration::tensor::{Mat3, Vec3, cross_matrix};
use gyration_scene::{Record, Recorded, Scene};
use std::fs;
use std::path::Path;

const RUBBER: &str = "affine = { material = { mooney_rivlin = { c1 = 3000.0, c2 = 1000.0 } }, viscosity = 20.0 }\n";

fn affine(scene: &Scene) -> &Affine {
    let BodyKind::Affine(affine) = &scene.built().model.bodies[0].kind else { panic!("the body is affine") };
    affine
}

#[test]
fn materials_have_the_moduli_that_the_file_gives() {
    let ogden = |bulk| {
        let terms = vec![OgdenTerm { mu: 630.0, alpha: 1.3 }, OgdenTerm { mu: -10.0, alpha: -2.0 }];
        Material::Ogden(Ogden { terms, bulk })
    };
    let rows: &[(&str, Material)] = &[
        (
            "mooney_rivlin = { c1 = \"3 kPa\", c2 = 1000 }",
            Material::MooneyRivlin(MooneyRivlin { c1: 3000.0, c2: 1000.0, bulk: None }),
        ),
        (
            "mooney_rivlin = { c1 = 0, c2 = 0, bulk = \"1 bar\" }",
            Material::MooneyRivlin(MooneyRivlin { c1: 0.0, c2: 0.0, bulk: Some(1e5) }),
        ),
        ("neo_hookean = { shear = 8 }", Material::MooneyRivlin(MooneyRivlin { c1: 4.0, c2: 0.0, bulk: None })),
        ("ogden = { mu = [630, -10], alpha = [1.3, -2] }", ogden(None)),
        ("ogden = { mu = [\"630 Pa\", -10], alpha = [1.3, -2], bulk = 7 }", ogden(Some(7.0))),
        (
            "fung = { shear = 2, exponent = 0.5, bulk = 3 }",
            Material::Fung(Fung { shear: 2.0, exponent: 0.5, bulk: Some(3.0) }),
        ),
        ("neo_hookean_log = { mu = 2, lambda = 0 }", Material::NeoHookeanLog(NeoHookeanLog { mu: 2.0, lambda: 0.0 })),
        (
            "st_venant_kirchhoff = { mu = 3, lambda = -2 }",
            Material::StVenantKirchhoff(StVenantKirchhoff { lambda: -2.0, mu: 3.0 }),
        ),
        ("hencky = { shear = 2, bulk = 5 }", Material::Hencky(Hencky { shear: 2.0, bulk: 5.0 })),
        // E = 2μ(1 + ν), with μ = 2: λ = 2 at ν = 1/4, K = 5 at ν = 1/4 of E = 7.5.
        (
            "neo_hookean_log = { youngs_modulus = \"5 Pa\", poissons_ratio = 0.25 }",
            Material::NeoHookeanLog(NeoHookeanLog { mu: 2.0, lambda: 2.0 }),
        ),
        (
            "st_venant_kirchhoff = { youngs_modulus = 2, poissons_ratio = -0.5 }",
            Material::StVenantKirchhoff(StVenantKirchhoff { lambda: -1.0, mu: 2.0 }),
        ),
        (
            "hencky = { youngs_modulus = 7.5, poissons_ratio = 0.25 }",
            Material::Hencky(Hencky { shear: 3.0, bulk: 5.0 }),
        ),
        (
            "neo_hookean = { youngs_modulus = 24, poissons_ratio = 0.5 }",
            Material::MooneyRivlin(MooneyRivlin { c1: 4.0, c2: 0.0, bulk: None }),
        ),
        (
            "neo_hookean = { youngs_modulus = 7.5, poissons_ratio = 0.25 }",
            Material::MooneyRivlin(MooneyRivlin { c1: 1.5, c2: 0.0, bulk: Some(5.0) }),
        ),
        ("orthogonality = { kappa = 2 }", Material::StVenantKirchhoff(StVenantKirchhoff { lambda: 0.0, mu: 8.0 })),
    ];
    for (written, material) in rows {
        let scene = block(&format!("affine = {{ material = {{ {written} }} }}"));
        assert_eq!(affine(&scene).interior.material.as_ref(), Some(material), "{written}");
        assert_resolves_to_itself(&scene);
    }
}

#[test]
fn an_affine_body_without_parameters_is_free_and_compressible() {
    let scene = block("affine = {}");
    let Affine { interior, couple, resistances } = affine(&scene);
    assert!(interior.material.is_none() && !interior.dissipates() && couple.is_none() && resistances.is_empty());
    // V = 6, J = m/12 diag(1, 4, 9).
    assert!((interior.volume - 6.0).abs() < 1e-14);
    assert!((interior.euler_tensor - Mat3::from_diagonal(&Vec3::new(1.0, 4.0, 9.0))).amax() < 1e-14);
    let resolved = scene.resolved();
    let body = resolved.pointer("/body/0").unwrap();
    assert_eq!(body.pointer("/affine").unwrap().to_string(), r#"{"viscosity":0.0}"#);
    assert_eq!(body.pointer("/gradient").unwrap().to_string(), "[[1.0,0.0,0.0],[0.0,1.0,0.0],[0.0,0.0,1.0]]");
    assert!(body.pointer("/gradient_rate").is_some());
    for absent in ["rigid", "orientation", "angular_velocity"] {
        assert!(body.get(absent).is_none(), "{absent} is left over");
    }
    assert_resolves_to_itself(&scene);
}

#[test]
fn the_affine_example_of_the_contract_builds_as_it_says() {
    let text = "[time]\nend = 2.0\nsample = 0.01\n[[body]]\nname = \"rubber\"\n\
                shape = { ellipsoid = { semi_axes = [0.1, 0.1, 0.1] } }\ndensity = 1000.0\n\
                affine = { material = { mooney_rivlin = { c1 = 3000.0, c2 = 1000.0 } }, viscosity = 20.0 }\n\
                position = [1, 0, 0.3]\ngradient = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\n\
                gradient_rate = [[0, 0, 0], [0, 0, 0], [0, 0, 0]]\n";
    let scene = Scene::parse("scene.toml", text, Path::new(""), &[]).unwrap();
    assert!(affine(&scene).interior.is_incompressible());
    assert_eq!(affine(&scene).interior.viscosity, Viscosity { kirchhoff: 20.0, shear: 0.0, bulk: 0.0 });
    assert_eq!(start(&scene).placement.gradient, Mat3::identity());
    assert_eq!(start(&scene).velocity.gradient_rate, Mat3::zeros());
    assert_resolves_to_itself(&scene);
}

#[test]
fn friction_and_loads_are_those_that_the_file_gives() {
    let unit = |size: usize, sense: f64| {
        let row = |row: usize| {
            let entry = |column: usize| match (row, column) {
                (0, 1) => 1.0,
                (1, 0) => sense,
                (row, column) if row == column && sense > 0.0 => 2.0,
                _ => 0.0,
            };
            format!("{:?}", (0..size).map(entry).collect::<Vec<f64>>())
        };
        format!("[{}]", (0..size).map(row).collect::<Vec<_>>().join(", "))
    };
    let newtonian = block("affine = { viscosity = \"2 Pa s\", internal_friction = { shear = \"30 mPa s\" } }");
    let expected = Viscosity { kirchhoff: 2.0, shear: 0.03, bulk: 0.0 };
    assert_eq!(affine(&newtonian).interior.viscosity, expected);
    let resolved = newtonian.resolved();
    assert_eq!(resolved.pointer("/body/0/affine/internal_friction/bulk").unwrap(), 0.0);
    assert_resolves_to_itself(&newtonian);
    let anisotropic = block(&format!("affine = {{ internal_friction = {{ matrix = {} }} }}", unit(6, 1.0)));
    // L = e_x ⊗ e_x at rest: τ = 2 e_x ⊗ e_x + 1 e_y ⊗ e_y, and S = τ.
    let stretching = Mat3::from_diagonal(&Vec3::x());
    let gyration = Gyration::of(&Mat3::identity(), &stretching).unwrap();
    let stress = affine(&anisotropic).interior.balance(&gyration, &Mat3::zeros()).stress;
    assert!((stress - Mat3::from_diagonal(&Vec3::new(2.0, 1.0, 0.0))).amax() < 1e-14, "{stress}");
    assert_resolves_to_itself(&anisotropic);
    let resisted = block(&format!(
        "affine = {{ linear_friction = {{ matrix = {}, frame = \"body\" }}, gyroscopic = {{ matrix = {} }},\n\
         couple = {{ value = [[0, \"1 N m\", 0], [0, 0, 2], [0, 0, 0]] }} }}",
        unit(12, 1.0),
        unit(12, -1.0),
    ));
    let dissipate: Vec<bool> = affine(&resisted).resistances.iter().map(|load| load.dissipates()).collect();
    assert_eq!(dissipate, [true, false]);
    // f = −H v with v = e_x: −(2, 1, 0) of the friction, −(0, −1, 0) of the gyroscopic load.
    let velocity = gyration::kinematics::Velocity { velocity: Vec3::x(), gradient_rate: Mat3::zeros() };
    let one = Mat3::identity();
    let force: Vec3 = affine(&resisted).resistances.iter().map(|load| load.loads(&one, &one, &velocity).force).sum();
    assert!((force - Vec3::new(-2.0, 0.0, 0.0)).amax() < 1e-14, "{force}");
    let couple = Mat3::new(0.0, 1.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0);
    assert_eq!(affine(&resisted).couple, Some(Couple::Constant(couple)));
    assert_resolves_to_itself(&resisted);
}

#[test]
fn the_table_of_a_couple_is_read_relative_to_the_scene() {
    let folder = tempfile::tempdir().unwrap();
    let text = format!("{BLOCK}affine = {{ couple = {{ table = \"loads/n.csv\" }} }}\n");
    fs::create_dir(folder.path().join("loads")).unwrap();
    let rows = "0, 1,2,3, 4,5,6, 7,8,9\r\n# a remark\r\n\r\n2, 3,2,3, 4,5,6, 7,8,\"9.5\"\r\n";
    for names in
        ["", "t,N_xx,N_xy,N_xz,N_yx,N_yy,N_yz,N_zx,N_zy,N_zz\r\n", "\u{feff}t,a,b,c,d,e,f,g,h,i\r\n", "\u{feff}"]
    {
        fs::write(folder.path().join("loads/n.csv"), format!("{names}{rows}")).unwrap();
        let scene = Scene::parse("scene.toml", &text, folder.path(), &[]).unwrap_or_else(|errors| panic!("{errors}"));
        let couple = affine(&scene).couple.clone().unwrap();
        assert_eq!(couple.at(1.0), Mat3::new(2.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.25));
        assert_eq!(couple.next_kink(0.0), Some(2.0));
        assert_eq!(scene.resolved().pointer("/body/0/affine/couple/table").unwrap(), "loads/n.csv");
    }
}

#[test]
fn a_deformable_body_starts_turned_or_strained() {
    let orientation = "orientation = { euler_xyz = [\"90 deg\", 0, 0] }";
    let turned = Mat3::new(1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0);
    let strained = Mat3::new(1.0, 0.5, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 3.0);
    let gradient = "gradient = [[1, 0.5, 0], [0, 2, 0], [0, 0, 3]]";
    let spin = "angular_velocity = [0, 0, 2]";
    let given = Mat3::new(0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 4.0, 0.0);
    let rate = "gradient_rate = [[0, 0, 1], [0, 0, 0], [0, \"4 1/s\", 0]]";
    let turning = cross_matrix(&Vec3::new(0.0, 0.0, 2.0));
    let rows: &[(&str, &str, Mat3, Mat3)] = &[
        ("", "", Mat3::identity(), Mat3::zeros()),
        (orientation, "", turned, Mat3::zeros()),
        (orientation, spin, turned, turning * turned),
        (orientation, rate, turned, given),
        (gradient, "", strained, Mat3::zeros()),
        (gradient, spin, strained, turning * strained),
        (gradient, rate, strained, given),
        ("", spin, Mat3::identity(), turning),
    ];
    for (first, second, p, pdot) in rows {
        let scene = block(&format!("affine = {{}}\n{first}\n{second}"));
        let motion = start(&scene);
        // A quarter turn is one to a few roundings.
        assert!((motion.placement.gradient - p).amax() < 1e-15, "{first} {second}");
        assert!((motion.velocity.gradient_rate - pdot).amax() < 1e-15, "{first} {second}");
        assert_resolves_to_itself(&scene);
    }
}

#[test]
fn the_centre_of_a_pinned_deformable_body_follows_its_pin() {
    let scene = block(
        "affine = {}\nposition = [1, 2, 3]\npin = [0, 0, 1]\ngradient = [[1, 0, 0.5], [0, 1, 0], [0, 0, 2]]\n\
         gradient_rate = [[0, 0, 3], [0, 0, 0], [0, 0, -1]]",
    );
    let pin = scene.built().model.bodies[0].pin.unwrap();
    assert_eq!(pin.anchor, Vec3::new(1.5, 2.0, 5.0));
    let motion = start(&scene);
    assert_eq!(motion.placement.position, Vec3::new(1.0, 2.0, 3.0));
    assert_eq!(motion.velocity.velocity, Vec3::new(-3.0, 0.0, 1.0));
    // J about the pin is m r ⊗ r more.
    let euler_tensor = affine(&scene).interior.euler_tensor;
    assert!((euler_tensor - Mat3::from_diagonal(&Vec3::new(1.0, 4.0, 21.0))).amax() < 1e-14, "{euler_tensor}");
    assert_resolves_to_itself(&scene);
}

#[test]
fn an_incompressible_body_starts_on_its_constraint() {
    let strained = |excess: f64, growth: f64| {
        let last = (1.0 + excess) / 1.5;
        format!(
            "{RUBBER}gradient = [[1.5, 0.3, 0], [0, 1, -0.2], [0, 0, {last:?}]]\n\
             gradient_rate = [[1.5, 2, 0], [0, 0, 5], [7, 0, {:?}]]",
            last * (growth - 1.0) + 0.28
        )
    };
    // Rounding of the file's numbers, and what is still taken to be meant.
    for (excess, growth) in [(0.0, 0.0), (1e-15, 1e-14), (3e-10, -4e-10), (-9e-10, 9e-10)] {
        let scene = block(&strained(excess, growth));
        let motion = start(&scene);
        let p = motion.placement.gradient;
        let l = motion.velocity.gradient_rate * p.try_inverse().unwrap();
        println!("excess {excess:e}: det P − 1 = {:e}, tr L = {:e}", p.determinant() - 1.0, l.trace());
        // A few roundings of numbers up to 1.5 and 7.
        assert!((p.determinant() - 1.0).abs() < 5e-15 && l.trace().abs() < 5e-14);
        assert!((p[(2, 2)] - 1.0 / 1.5).abs() < 1e-9, "it moved by no more than it had to");
        assert_resolves_to_itself(&scene);
    }
    for (excess, growth, key) in [(1.1e-9, 0.0, "gradient"), (0.0, 1.2e-9, "gradient_rate")] {
        let text = format!("{BLOCK}{}\n", strained(excess, growth));
        let found = Scene::parse("scene.toml", &text, Path::new(""), &[]).err().unwrap();
        assert_eq!((found.count(), found.as_slice()[0].key.as_str()), (1, format!("body.b.{key}").as_str()), "{found}");
    }
}

#[test]
fn the_offered_start_of_an_incompressible_body_is_accepted() {
    let text = format!(
        "{BLOCK}{RUBBER}gradient = [[1.5, 0.3, 0], [0.1, 3, -0.2], [0, 0.4, 0.9]]\n\
         gradient_rate = [[1.5, 2, 0], [0, 4, 5], [7, 0, 1]]\n"
    );
    let found = Scene::parse("scene.toml", &text, Path::new(""), &[]).err().unwrap();
    let offered: Vec<&str> = found
        .into_iter()
        .map(|error| error.help.trim_start_matches("write ").split(", or give").next().unwrap())
        .collect();
    assert_eq!(offered.len(), 2, "{found}");
    let scene = block(&format!("{RUBBER}{}\n{}", offered[0], offered[1]));
    assert!((start(&scene).placement.gradient.determinant() - 1.0).abs() < 1e-14);
}

#[test]
fn a_fast_spin_is_no_change_of_volume() {
    // Rounding of tr L grows with ω: 1e8 rad/s of a body of micrometres leave more than 1e-9 1/s.
    let scene = block(&format!(
        "{RUBBER}orientation = {{ axis_angle = {{ axis = [1, 2, 3], angle = 1 }} }}\nangular_velocity = [1e8, -2e8, \
            3e8]"
    ));
    assert_resolves_to_itself(&scene);
}

#[test]
fn what_is_recorded_on_request_stands_beside_the_plan() {
    let scene = |record: &str| {
        let text = format!("{record}\n{BLOCK}affine = {{}}\n");
        Scene::parse("scene.toml", &text, Path::new(""), &[]).unwrap_or_else(|errors| panic!("{errors}"))
    };
    assert_eq!(scene("").built().record, Record::default());
    assert!(scene("").resolved().get("record").is_none());
    let words = "velocity_gradient affine_momentum_total affine_moment moment_power comoving_momentum momentum_residual \
                 principal_stretches rotation cauchy_stress stress force_total moment_total force_by_kind moment_by_kind \
                 affine_moment_total friction_moment kinetic_tensor canonical_momentum kinetic_energy elastic_gradient \
                 elastic_stress eshelby spin vorticity";
    let quoted: Vec<String> = words.split(' ').map(|word| format!("\"{word}\"")).collect();
    let asked = scene(&format!("[record]\nquantities = [{}]\norigin = [0, 0, \"2 cm\"]", quoted.join(", ")));
    let Record { quantities, origin, .. } = &asked.built().record;
    assert_eq!(*origin, Vec3::new(0.0, 0.0, 0.02));
    assert_eq!((quantities.len(), quantities[9], quantities[21]), (24, Recorded::Stress, Recorded::Eshelby));
    assert_resolves_to_itself(&asked);
}

#[test]
fn a_material_that_is_named_has_a_law_and_a_density() {
    let shape = "name = \"b\"\nshape = { box = { size = [1, 1, 1] } }\n";
    let scene = |lines: &str| {
        let text = format!("{TIME}[[body]]\n{shape}{lines}\n");
        Scene::parse("scene.toml", &text, Path::new(""), &[]).unwrap_or_else(|errors| panic!("{errors}"))
    };
    let rubber = scene("affine = { material = \"rubber\" }");
    assert_resolves_to_itself(&rubber);
    assert_eq!(rubber.resolved().pointer("/body/0/density").and_then(serde_json::Value::as_f64), Some(1100.0));
    let law = Material::MooneyRivlin(MooneyRivlin { c1: 0.25e6, c2: 0.0, bulk: None });
    assert_eq!(affine(&rubber).interior.material, Some(law));
    let heavy = scene("affine = { material = \"steel\" }\nmass = 5");
    assert_eq!(heavy.built().model.bodies[0].solid.mass.mass, 5.0);
    let own = scene("contractile = { material = \"silicone\", contraction_viscosity = 50 }\ndensity = 900");
    assert_eq!(own.built().model.bodies[0].solid.mass.mass, 900.0);
    for name in ["nylon", "glass", "aluminium"] {
        assert_resolves_to_itself(&scene(&format!("affine = {{ material = \"{name}\" }}")));
    }
}
