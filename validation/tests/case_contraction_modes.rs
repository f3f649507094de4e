//! A free block that feels one of its stretches: what `modes` tells against the closed form, and a run against both.
//!
//!   p̈ = −a (p − g),   μ_γ ġ = 2μ (p − g) + k (p − 1),   a = 2μV/J:   λ³ + (2μ/μ_γ) λ² + a λ − a k/μ_γ = 0
//!
//! Samples of p − 1 at equal times h obey x_{n+3} = e₁ x_{n+2} − e₂ x_{n+1} + e₃ x_n, with the elementary symmetric
//! functions e of the three e^{λh}.

use gyration_sim::modes::{modes, rest};
use gyration_validation::{Case, Experiment, largest};
use nalgebra::Complex;

const MU: f64 = 554.054054;
const DRAG: f64 = 20.0;
const GAIN: f64 = -2000.0;
const SAMPLE: f64 = 0.02;

fn scene() -> String {
    format!(
        r#"
        world = {{ gravity = [0, 0, 0] }}
        time = {{ end = 2, sample = {SAMPLE} }}
        solver = {{ rtol = 1e-11, atol = 1e-13 }}
        [[body]]
        name = "g"
        shape = {{ box = {{ size = [0.37, 0.1, 0.1] }} }}
        mass_properties = {{ mass = 1.7, euler_tensor = [[0.013, 0, 0], [0, 0.0065, 0], [0, 0, 0.0065]] }}
        gradient = [[1.000001, 0, 0], [0, 1, 0], [0, 0, 1]]
        [body.contractile]
        material = {{ st_venant_kirchhoff = {{ lambda = 0, mu = {MU} }} }}
        contraction_viscosity = {DRAG}
        [body.contractile.feedback]
        measure = {{ stretch = [1, 0, 0] }}
        gain = [[{GAIN}, 0, 0], [0, 0, 0], [0, 0, 0]]
        bias = [[{}, 0, 0], [0, 0, 0], [0, 0, 0]]
        "#,
        -GAIN
    )
}

/// The real root of λ³ + bλ² + cλ + d by Newton's method, and the pair that is left.
fn roots(b: f64, c: f64, d: f64) -> (f64, Complex<f64>) {
    let mut real = -b;
    for _ in 0..50 {
        real -= (((real + b) * real + c) * real + d) / ((3.0 * real + 2.0 * b) * real + c);
    }
    let (sum, product) = (b + real, -d / real);
    let pair = Complex::new(-0.5 * sum, (product - 0.25 * sum * sum).sqrt());
    (real, pair)
}

#[test]
fn feedback_runs_away_as_its_modes_tell() {
    let case = Case { row: None, name: "block that feels its stretch", source: "closed form" };
    let square = 2.0 * MU * 0.37 * 0.1 * 0.1 / 0.013;
    let (real, pair) = roots(2.0 * MU / DRAG, square, -square * GAIN / DRAG);
    let scene = gyration_scene::Scene::parse("scene.toml", &scene(), std::path::Path::new(""), &[]).unwrap();
    let (model, start) = (&scene.built().model, &scene.built().state);
    let at_rest = rest(model, start, 0).unwrap();
    let found = modes(model, start, 0, &at_rest).unwrap();
    let growing = &found[0].eigenvalues;
    case.check("growth [1/s]", pair.re, growing[0].re, 1e-10);
    case.check("frequency [rad/s]", pair.im, growing[0].im, 1e-10);
    let decays = found.iter().filter(|mode| mode.eigenvalues.len() == 1).map(|mode| mode.decay_rates()[0]);
    let fastest = decays.fold(0.0, f64::max);
    case.check("decay of the contraction [1/s]", -real, fastest, 1e-10);

    let run = Experiment::of_scene(&self::scene()).run();
    let x: Vec<f64> = run.column("g.P_xx").iter().map(|stretch| stretch - 1.0).collect();
    let (one, two) = ((real * SAMPLE).exp(), (pair * SAMPLE).exp());
    let (sum, product) = (2.0 * two.re, two.norm_sqr());
    let next = |x: &[f64]| (one + sum) * x[2] - (one * sum + product) * x[1] + one * product * x[0];
    let off = largest(x.windows(4).map(|x| (x[3] - next(x)) / x.iter().fold(0.0_f64, |most, x| most.max(x.abs()))));
    // What is not linear, as large as the strain: a millionth that has grown forty times.
    case.by("linear recurrence of the closed form").check("run off the recurrence, of its strain", 0.0, off, 2e-4);
}
