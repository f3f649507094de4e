//! Row 35: a chain of granules that springs join, each with a stretch of its own along the chain.
//!
//!   (4k s² − mω²)(κ + k l² c² − jω²) = 4k²l²s²c²,   s = sin(q/2),   c = cos(q/2)
//!
//! m mass, j Euler moment along the chain, κ stiffness against stretch, l length, k the springs between facing faces.
//! Granule n has u_n = A sin q(n + ½) and P_xx − 1 = B cos q(n + ½), q = πi/N: the last springs then have still points
//! in their middle, and their halves of stiffness 2k are fixed there. Dashpots beside springs between masses give δ =
//! 2c s²/m and ω = √(4k s²/m − δ²).
//!
//! A chain starts at rest in one wave, of 3e-5 of its spacing. After ten periods of the reference the phase of Σ u_n
//! sin q(n + ½) tells the frequency.

use gyration_validation::{Case, Experiment};
use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;

const SPACING: f64 = 0.5;
const LENGTH: f64 = 0.4;
const AMPLITUDE: f64 = 3e-5 * SPACING;
const PERIODS: f64 = 10.0;
/// Large waves differ by the square of their strains, 1e-9; the errors of steps are far below what they may be.
const TOLERANCE: f64 = 1e-8;

/// The springs of a chain along x: between neighbours, and halves of them to still points before and behind.
struct Springs {
    stiffness: f64,
    damping: f64,
    /// From the centre of a granule to its faces [m].
    face: f64,
}

impl Springs {
    fn between(&self, n: usize) -> String {
        let Self { stiffness, damping, face } = self;
        format!(
            "[[spring]]\nbetween = [\"g{n}\", \"g{}\"]\npoints = [[{face}, 0, 0], [{}, 0, 0]]\n\
             stiffness = {stiffness}\n\
             damping = {damping}\nrest_length = {:?}\n",
            n + 1,
            -face,
            SPACING - 2.0 * face,
        )
    }

    /// The key of the first granule (−1) or the last (1).
    fn half(&self, side: f64, n: usize) -> String {
        let anchor = (n as f64 + 0.5 * side) * SPACING;
        format!(
            "spring = [{{ point = [{}, 0, 0], anchor = [{anchor:?}, 0, 0], stiffness = {}, \
             damping = {}, rest_length = {:?} }}]\n",
            side * self.face,
            2.0 * self.stiffness,
            2.0 * self.damping,
            0.5 * SPACING - self.face,
        )
    }

    /// A chain of so many granules, each with its displacement and what else stands in its table.
    fn chain(&self, granules: &[(f64, String)]) -> Experiment {
        let mut text = "world = { gravity = [0, 0, 0] }\ntime = { end = 1, sample = 1 }\n\
                        solver = { rtol = 1e-10, atol = 1e-11 }\n"
            .to_owned();
        let last = granules.len() - 1;
        for (n, (displacement, table)) in granules.iter().enumerate() {
            let place = n as f64 * SPACING + displacement;
            let _ = write!(text, "[[body]]\nname = \"g{n}\"\nposition = [{place:?}, 0, 0]\n{table}");
            match n {
                0 => text.push_str(&self.half(-1.0, n)),
                _ if n == last => text.push_str(&self.half(1.0, n)),
                _ => {}
            }
        }
        (0..last).for_each(|n| text.push_str(&self.between(n)));
        Experiment::of_scene(&text)
    }
}

/// sin q(n + ½) and cos q(n + ½).
fn wave(q: f64, n: usize) -> (f64, f64) {
    (q * (n as f64 + 0.5)).sin_cos()
}

/// Σ u_n sin q(n + ½) and its rate at a time.
fn amplitude(experiment: &Experiment, q: f64, time: f64) -> (f64, f64) {
    let state = experiment.until(time).sampled(time).run().end;
    let granules = 0..experiment.model.bodies.len();
    granules.fold((0.0, 0.0), |(place, rate), n| {
        let motion = state.motion(&experiment.model, n);
        let sine = wave(q, n).0;
        let displacement = motion.placement.position.x - n as f64 * SPACING;
        (place + sine * displacement, rate + sine * motion.velocity.velocity.x)
    })
}

#[test]
fn granules_of_a_chain_oscillate_at_the_frequencies_of_both_branches() {
    let (mass, moment, internal, stiffness) = (2.0, 0.05, 8.0, 6.0);
    let case = Case {
        row: Some(35),
        name: "six granules, m = 2, j = 0.05, κ = 8, k = 6, l = 0.4",
        source: "(4ks² − mω²)(κ + kl²c² − jω²) = 4k²l²s²c²",
    };
    let springs = Springs { stiffness, damping: 0.0, face: 0.5 * LENGTH };
    // 8 κ_o V = κ of the orthogonality energy, V = 0.016 m³.
    let granule = format!(
        "shape = {{ box = {{ size = [{LENGTH}, 0.2, 0.2] }} }}\n\
         mass_properties = {{ mass = {mass}, euler_tensor = [[{moment}, 0, 0], [0, 0.02, 0], [0, 0, 0.02]] }}\n\
         affine = {{ material = {{ orthogonality = {{ kappa = {} }} }} }}\n",
        internal / (8.0 * LENGTH * 0.04)
    );
    let listed = [
        ("q = π/3, acoustic [rad/s]", 2, 1.657808),
        ("q = π/3, optic [rad/s]", 2, 13.215584),
        ("q = π/2, acoustic [rad/s]", 3, 2.376694),
        ("q = π/2, optic [rad/s]", 3, 13.036538),
    ];
    for (quantity, half_waves, listed) in listed {
        let q = PI * f64::from(half_waves) / 6.0;
        let (s, c) = (0.5 * q).sin_cos();
        // mj ω⁴ − (4ks² j + (κ + kl²c²) m) ω² + 4ks² κ = 0.
        let (own, stretch) = (4.0 * stiffness * s * s, internal + stiffness * (LENGTH * c).powi(2));
        let (sum, product) = (own / mass + stretch / moment, own * internal / (mass * moment));
        let root = (0.25 * sum * sum - product).sqrt();
        let square = if quantity.contains("optic") { 0.5 * sum + root } else { product / (0.5 * sum + root) };
        let omega = square.sqrt();
        assert!((omega - listed).abs() < 1e-6, "{omega}");
        let ratio = (own - mass * square) / (2.0 * stiffness * LENGTH * s * c);
        let size = AMPLITUDE / (1.0 + LENGTH * ratio.abs());
        let granules = (0..6).map(|n| {
            let (sine, cosine) = wave(q, n);
            let stretch = 1.0 + size * ratio * cosine;
            (size * sine, format!("{granule}gradient = [[{stretch:?}, 0, 0], [0, 1, 0], [0, 0, 1]]\n"))
        });
        let experiment = springs.chain(&granules.collect::<Vec<_>>());
        let time = PERIODS * TAU / omega;
        let (place, rate) = amplitude(&experiment, q, time);
        let measured = (PERIODS * TAU + (-rate / omega).atan2(place)) / time;
        case.check(quantity, omega, measured, TOLERANCE);
    }
}

#[test]
fn dashpots_between_masses_slow_and_damp_a_wave() {
    let (mass, stiffness, damping) = (0.5, 40.0, 1.5);
    let case = Case {
        row: Some(35),
        name: "four masses, q = π, m = ½, k = 40, c = 1.5",
        source: "δ = 2cs²/m, ω = √(4ks²/m − δ²)",
    };
    let (decay, omega): (f64, f64) = (6.0, 284_f64.sqrt());
    assert!(
        (2.0 * damping / mass - decay).abs() < 1e-15 && (4.0 * stiffness / mass - 36.0 - omega * omega).abs() < 1e-12
    );
    let springs = Springs { stiffness, damping, face: 0.1 };
    let table = format!("shape = {{ sphere = {{ radius = 0.1 }} }}\nmass = {mass}\n");
    let granules: Vec<_> = (0..4).map(|n| (AMPLITUDE * wave(PI, n).0, table.clone())).collect();
    let experiment = springs.chain(&granules);
    // Two periods: a hundredth is left.
    let time = 2.0 * TAU / omega;
    let at = |time: f64| {
        let (place, rate) = if time > 0.0 { amplitude(&experiment, PI, time) } else { (4.0 * AMPLITUDE, 0.0) };
        // x − i(ẋ + δx)/ω ∝ e^(−δt + iωt).
        let across = -(rate + decay * place) / omega;
        (place.hypot(across), across.atan2(place))
    };
    let ((size, phase), (first, early)) = (at(time), at(0.0));
    case.check("decay rate [1/s]", decay, (first / size).ln() / time, TOLERANCE);
    case.check("frequency [rad/s]", omega, (2.0 * TAU + phase - early) / time, TOLERANCE);
}
