//! Rest states and small motions of bodies that drive themselves.

use gyration::dynamics::{Workspace, jacobian};
use gyration_scene::Scene;
use gyration_sim::modes::{Mode, ModeBehaviour, Rest, modes, rest};
use gyration_sim::survey;
use nalgebra::{Complex, DMatrix};
use std::path::Path;

/// A free block with these keys of `contractile`.
fn block(contractile: &str) -> Scene {
    let text = format!(
        "world = {{ gravity = [0, 0, 0] }}\ntime = {{ end = 1, sample = 1 }}\n[[body]]\nname = \"g\"\n\
         shape = {{ box = {{ size = [0.3, 0.1, 0.2] }} }}\ndensity = 900\n[body.contractile]\n{contractile}"
    );
    Scene::parse("scene.toml", &text, Path::new(""), &[]).unwrap_or_else(|errors| panic!("{errors}"))
}

fn found(scene: &Scene) -> (Rest, Vec<Mode>) {
    let (model, start) = (&scene.built().model, &scene.built().state);
    let rest = rest(model, start, 0).unwrap_or_else(|error| panic!("{error}"));
    let modes = modes(model, start, 0, &rest).unwrap();
    (rest, modes)
}

/// diag(x, y, z) as rows.
fn diagonal(values: [f64; 3]) -> String {
    let rows = [0, 1, 2].map(|i| [0, 1, 2].map(|j| if i == j { values[i] } else { 0.0 }));
    format!("{rows:?}")
}

/// Q = gain (|P e_k| − length) along the axis k.
fn feedback(axis: usize, gain: f64, length: f64) -> String {
    let along = |value: f64| [0, 1, 2].map(|k| if k == axis { value } else { 0.0 });
    let [gain_rows, bias_rows] = [gain, -gain * length].map(|value| diagonal(along(value)));
    format!("{{ measure = {{ stretch = {:?} }}, gain = {gain_rows}, bias = {bias_rows} }}", along(2.0))
}

#[test]
fn a_contraction_that_goes_on_is_held_and_said_to_be() {
    let told = |drive: f64| {
        let scene = block(&format!(
            "material = {{ neo_hookean_log = {{ mu = 500, lambda = 1000 }} }}\ncontraction_viscosity = 20\n\
             drive = {{ constant = {{ value = {} }} }}\n",
            diagonal([drive, 0.0, 0.0])
        ));
        survey::modes(&scene).bodies[0].rest_state.as_ref().unwrap().place.left_out.clone()
    };
    let said = told(-100.0).unwrap();
    // V_G = Q/μ_γ.
    assert!(said.starts_with("contraction held") && said.contains(" 5 1/s "), "{said}");
    assert_eq!(told(0.0), None);
}

/// With λ = 0 stretches along the axes do not act on each other: J p̈ = −2μV (p − g), μ_γ ġ = 2μ(p − g) + k (p − 1).
#[test]
fn feedback_on_a_stretch_makes_a_motion_of_third_order() {
    for (gain, drag) in [(-2000.0, 20.0), (150.0, 20.0), (-30.0, 0.5), (-500.0, 1e4)] {
        let (_, found) = found(&block(&format!(
            "material = {{ st_venant_kirchhoff = {{ lambda = 0, mu = 500 }} }}\ncontraction_viscosity = {drag}\n\
             feedback = {}\n",
            feedback(0, gain, 1.0)
        )));
        // 2μV/J, with J = ρV a²/12.
        let square = 2.0 * 500.0 / (900.0 * 0.09 / 12.0);
        // λ³ + (2μ/μ_γ) λ² + a λ − a k/μ_γ = 0.
        let residual = |value: Complex<f64>| {
            let terms =
                [value.powi(3), value * value * (1000.0 / drag), value * square, (-square * gain / drag).into()];
            terms.iter().sum::<Complex<f64>>().norm() / terms.iter().map(|term| term.norm()).sum::<f64>()
        };
        let roots = found.iter().flat_map(|mode| &mode.eigenvalues);
        let roots: Vec<_> = roots.filter(|value| value.norm() > 1e-6 && residual(**value) < 1e-9).collect();
        println!("gain {gain}, drag {drag}: {roots:?}");
        assert_eq!(roots.len(), 3);
        let sum: f64 = roots.iter().map(|value| value.re).sum();
        assert!((sum * drag / -1000.0 - 1.0).abs() < 1e-9, "{sum}");
        // Routh: all decay where 0 < −k < 2μ.
        let grows = found.iter().any(|mode| mode.motion == ModeBehaviour::Grows);
        assert_eq!(grows, !(0.0 < -gain && -gain < 1000.0), "{gain} {drag}");
    }
}

/// A block that feels its three stretches finds the state in which its drive is nothing; the eigenvalues are those of
/// the whole Jacobian there, whether or not material and contraction keep their volumes, and whatever V_G may be.
#[test]
fn eigenvalues_with_contraction_are_those_of_the_whole_jacobian() {
    let compressible = "{ neo_hookean_log = { mu = 4000, lambda = 9000 } }";
    let incompressible = "{ mooney_rivlin = { c1 = 1500, c2 = 500 } }";
    let volume = "isochoric = true\n";
    let spin = "spin = \"symmetric\"\n";
    // Lengths of volume one where that is kept; strains of G that are free. Its turns are not felt: stresses here are
    // none.
    for (material, more, lengths, contractions) in [
        (compressible, "", [1.1, 0.95, 1.02], 6),
        (compressible, spin, [1.1, 0.95, 1.02], 6),
        (incompressible, "", [1.1, 0.95, 1.02], 5),
        (incompressible, spin, [1.1, 0.95, 1.02], 5),
        (compressible, volume, [1.1, 0.95, 1.0 / (1.1 * 0.95)], 5),
    ] {
        let parts = [0, 1, 2].map(|axis| feedback(axis, -900.0, lengths[axis])).join(", ");
        let scene = block(&format!(
            "material = {material}\nviscosity = 3\ncontraction_viscosity = 40\n{more}feedback = [{parts}]\n"
        ));
        let (rest, found) = found(&scene);
        let mut expected = lengths;
        expected.sort_by(|a, b| b.total_cmp(a));
        for (stretch, expected) in rest.stretches.iter().zip(expected) {
            assert!((stretch - expected).abs() < 1e-9, "{material} {more}: {stretch} for {expected}");
        }
        let size = rest.block().len();
        let mut blocks = [DMatrix::zeros(size, size)];
        jacobian(&scene.built().model, &mut Workspace::default(), 0.0, rest.block().into(), &mut blocks[..]).unwrap();
        let all = blocks[0].complex_eigenvalues();
        let fastest = all.iter().map(|value| value.norm()).fold(0.0, f64::max);
        for value in found.iter().flat_map(|mode| &mode.eigenvalues) {
            let off = all.iter().map(|other| (other - value).norm()).fold(f64::INFINITY, f64::min);
            // Zeros of the whole matrix are double: known to the square root of rounding.
            assert!(off < 1e-6 * fastest, "{material} {more}: {value} is off by {off:e}");
        }
        let singles = found.iter().filter(|mode| mode.eigenvalues.len() == 1).count();
        assert_eq!((found.len(), singles), (12 + contractions, contractions), "{material} {more}");
    }
}

/// A block between two springs, which pull at its ends.
fn pulled(material: &str, rest_length: f64) -> Scene {
    let spring = |end: f64| {
        format!(
            "{{ point = [{:?}, 0, 0], anchor = [{:?}, 0, 0], stiffness = 50, rest_length = {rest_length:?} }}",
            0.05 * end,
            0.2 * end
        )
    };
    let text = format!(
        "world = {{ gravity = [0, 0, 0] }}\ntime = {{ end = 1, sample = 1 }}\n[[body]]\nname = \"g\"\n\
         shape = {{ box = {{ size = [0.1, 0.1, 0.1] }} }}\ndensity = 1000\n\
         contractile = {{ material = {material}, viscosity = 1, contraction_viscosity = 25 }}\n\
         spring = [{}, {}]\n",
        spring(1.0),
        spring(-1.0)
    );
    Scene::parse("scene.toml", &text, Path::new(""), &[]).unwrap_or_else(|errors| panic!("{errors}"))
}

/// Symptom: a shape that flows without resistance stands still in many states, and of these Newton's method found one
/// of stretches (1.02, 0.0016, 0.0012). Runs of 60 s end at (1.02, 0.99998, 0.99998) and (1.2, 0.99903, 0.99903).
#[test]
fn a_shape_that_flows_comes_to_where_a_run_comes_to() {
    let cases = [
        ("{ st_venant_kirchhoff = { lambda = 0, mu = 500 } }", 0.149, [1.02, 0.99998]),
        ("{ neo_hookean_log = { mu = 500, lambda = 500 } }", 0.149, [1.02, 0.99998]),
        ("{ mooney_rivlin = { c1 = 300, c2 = 100 } }", 0.14, [1.2, 0.99903]),
    ];
    for (material, rest_length, [along, across]) in cases {
        let (rest, _) = found(&pulled(material, rest_length));
        println!("{material}: {:?}", rest.stretches);
        assert!((rest.stretches[0] - along).abs() < 1e-6, "{material}: {}", rest.stretches);
        assert!((rest.stretches[1] - across).abs() < 1e-2 && (rest.stretches[2] - across).abs() < 1e-2, "{material}");
    }
}
