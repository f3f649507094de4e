//! Row 27: d/dt(T + V det G φ) = V (Q·V_G − μ_γ|V_G|² − μ|sym ḞF⁻¹|²), with det G far from one.
//!
//! Once through the works that the program integrates, and once through differences of eighth order of recorded
//! energies, with the powers put together from recorded P, Ṗ, G, V_G and Q.

use crate::soft::{BALL, derivatives};
use gyration::tensor::Mat3;
use gyration_validation::{Case, Experiment, Run, largest};

const DRAG: f64 = 30.0;
const VISCOSITY: f64 = 25.0;
const SAMPLE: f64 = 2.5e-4;
/// V of the ball [m³].
const VOLUME: f64 = 4.0 / 3.0 * std::f64::consts::PI * 1e-3;

fn driven() -> Run {
    Experiment::of_scene(&format!(
        r#"
        world = {{ gravity = [0, 0, 0] }}
        time = {{ end = 0.5, sample = {SAMPLE} }}
        solver = {{ rtol = 1e-11, atol = 1e-13 }}
        [[body]]
        name = "body"
        density = 1000
        {BALL}
        angular_velocity = [3, -2, 5]
        contractile = {{ material = {{ mooney_rivlin = {{ c1 = 3000, c2 = 1000 }} }}, viscosity = {VISCOSITY}, contraction_viscosity = {DRAG},
            drive = {{ sine = {{ amplitude = [[900, 200, -100], [50, -300, 150], [0, 100, 700]], frequency = 3, phase = 0.2 }} }} }}
        "#
    ))
    .run()
}

fn symmetric(matrix: Mat3) -> Mat3 {
    0.5 * (matrix + matrix.transpose())
}

#[test]
fn power_of_the_drive_goes_where_the_balance_says() {
    let case = Case {
        row: Some(27),
        name: "driven spinning ball",
        source: "d/dt(T + V det G φ) = V(Q·V_G − μ_γ V_G² − μ (sym ḞF⁻¹)²)",
    };
    let run = driven();
    let volumes: Vec<f64> = run.matrices("contraction").iter().map(Mat3::determinant).collect();
    let (least, most) = (volumes.iter().copied().fold(f64::MAX, f64::min), volumes.iter().copied().fold(0.0, f64::max));
    println!("det G from {least:.3} to {most:.3}");
    assert!(most / least > 2.0, "det G is to change: {least} to {most}");
    case.check("residual of the ledger over the energy in play", 0.0, run.relative_residual(), 1e-8);

    let energies: Vec<f64> =
        run.column("energy.kinetic").iter().zip(run.column("energy.elastic")).map(|(t, w)| t + w).collect();
    let rates = derivatives(&energies, SAMPLE);
    let (p, rate) = (run.matrices("placement_gradient"), run.matrices("gradient_rate"));
    let (g, v, q) = (run.matrices("contraction"), run.matrices("contraction_velocity"), run.matrices("drive"));
    let power = |k: usize| {
        let f = p[k] * g[k].try_inverse().unwrap_or_else(Mat3::zeros);
        let back = |matrix: &Mat3| matrix.try_inverse().unwrap_or_else(Mat3::zeros);
        let straining = symmetric(rate[k] * back(&p[k]) - f * v[k] * back(&f));
        VOLUME * (q[k].dot(&v[k]) - DRAG * v[k].norm_squared() - VISCOSITY * straining.norm_squared())
    };
    let powers: Vec<f64> = (4..4 + rates.len()).map(power).collect();
    let scale = largest(powers.iter().copied());
    let apart = largest(rates.iter().zip(&powers).map(|(rate, power)| rate - power));
    // Differences: rounding of the energies, 1e-16/h, and the ninth derivative of what rings at some 90 rad/s.
    case.by("differences of eighth order").check(
        "largest difference of the two sides, relative",
        0.0,
        apart / scale,
        1e-8,
    );
    let trend = largest(run.column("work.contraction").windows(2).map(|pair| (pair[1] - pair[0]).max(0.0)));
    case.by("the reduced dissipation inequality").check(
        "largest gain by contraction between samples [J]",
        0.0,
        trend,
        0.0,
    );
}
