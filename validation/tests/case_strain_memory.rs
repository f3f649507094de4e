//! The memory of small strains: an affine sphere in a fluid with inertia, against transforms in closed form.
//!
//! In units of τ = R²ρ_f/η and of 3ηV, with ℓ = √s, a shear x in the plane xy of a sphere with the shear modulus μ, in
//! a fluid that strains by E,
//!
//!   [m s² + s + (5/9) s²/(1 + ℓ) + k] X̂ = m (s x₀ + v₀) + x₀ (1 + (5/9) s/(1 + ℓ)) + Ê [5/3 + s/9 + (5/9) s/(1 + ℓ)]
//!   m = ρ_p/(15ρ_f) + 2/45,   k = 2μτ/(3η)
//!
//! and a growth g of one with the bulk modulus K has no memory: (ρ_p/(15ρ_f) + 1/3) g″ + (4/3) g′ + Kτ/η g = 0. The
//! inverse is the sum over the poles with Re ℓ > 0, roots of a polynomial of ℓ, and an integral over the cut s = −r:
//! (1/π) ∫ Im X̂(r e^(−iπ)) e^(−rt) dr. At t = 0 it must give x₀, or a pole is missing.

use gyration::fluid::unsteady::{settling::settling, spinning::spinning};
use gyration_validation::{Case, Experiment, Run, largest};
use nalgebra::{Complex, SMatrix};
use std::f64::consts::PI;

type Scalar = Complex<f64>;

const RADIUS: f64 = 2e-3;
const VISCOSITY: f64 = 0.3;
const DENSITY: f64 = 900.0;
/// R²ρ_f/η \[s\].
const TAU: f64 = RADIUS * RADIUS * DENSITY / VISCOSITY;
const VOLUME: f64 = 4.0 / 3.0 * PI * RADIUS * RADIUS * RADIUS;
/// The shear at the start, or that of the flow: its square is the error of the linear theory.
const SMALL: f64 = 1e-4;
const SOURCE: &str = "inverse transform: poles and cut";

/// The linear equation of a shear.
#[derive(Debug, Clone, Copy)]
struct Shear {
    inertia: f64,
    stiffness: f64,
}

fn real(number: f64) -> Scalar {
    Complex::new(number, 0.0)
}

/// κ̂ of a strain.
fn memory(s: Scalar) -> Scalar {
    (s.sqrt() + 1.0).inv() * (5.0 / 9.0)
}

/// What the flow does to a sphere, per strain of it.
fn drive(s: Scalar) -> Scalar {
    s * memory(s) + s / 9.0 + 5.0 / 3.0
}

/// (1/π) ∫₀^∞ Im F(r e^(−iπ)) e^(−rt) dr by the trapezoid rule in ln r, which converges exponentially: a pole beside
/// the cut by a fiftieth of itself costs e^(−40).
fn cut(transform: impl Fn(Scalar) -> Scalar, time: f64) -> f64 {
    let step = 0.003;
    let term = |index: i32| {
        let r = (step * f64::from(index)).exp();
        // Below the cut, where √s = −i√r.
        transform(Complex::new(-r, -0.0)).im * (-r * time).exp() * r
    };
    step / PI * (-13_000..20_000).map(term).sum::<f64>()
}

impl Shear {
    /// Of a sphere of so many times the density of the fluid.
    fn new(ratio: f64, stiffness: f64) -> Self {
        Self { inertia: ratio / 15.0 + 2.0 / 45.0, stiffness }
    }

    fn denominator(&self, s: Scalar) -> Scalar {
        s * s * (memory(s) + self.inertia) + s + self.stiffness
    }

    fn slope(&self, s: Scalar) -> Scalar {
        let ell = s.sqrt();
        let of_memory = s * 2.0 / (ell + 1.0) - s * ell / ((ell + 1.0) * (ell + 1.0) * 2.0);
        s * (2.0 * self.inertia) + 1.0 + of_memory * (5.0 / 9.0)
    }

    /// The roots with Re ℓ > 0, of m ℓ⁵ + (m + 5/9) ℓ⁴ + ℓ³ + ℓ² + k ℓ + k, polished by Newton's method.
    fn poles(&self) -> Vec<Scalar> {
        let Self { inertia: m, stiffness: k } = *self;
        let mut companion = SMatrix::<f64, 5, 5>::zeros();
        for (row, coefficient) in [k, k, 1.0, 1.0, m + 5.0 / 9.0].into_iter().enumerate() {
            companion[(row, 4)] = -coefficient / m;
            if row > 0 {
                companion[(row, row - 1)] = 1.0;
            }
        }
        let roots = companion.complex_eigenvalues();
        let polish = |ell: &Scalar| {
            let mut s = ell * ell;
            (0..20).for_each(|_| s -= self.denominator(s) / self.slope(s));
            s
        };
        roots.iter().filter(|ell| ell.re > 0.0).map(polish).collect()
    }

    /// x of a transform numerator/denominator.
    fn inverse(&self, numerator: impl Fn(Scalar) -> Scalar, time: f64) -> f64 {
        let residues = self.poles().into_iter().map(|s| numerator(s) / self.slope(s) * (s * time).exp());
        residues.sum::<Scalar>().re + cut(|s| numerator(s) / self.denominator(s), time)
    }

    /// What of a free motion is not its poles, from x₀ = 1.
    fn of_cut(&self, time: f64) -> f64 {
        cut(|s| self.released(s) / self.denominator(s), time)
    }

    fn released(&self, s: Scalar) -> Scalar {
        s * self.inertia + 1.0 + s * memory(s)
    }

    /// x of a sphere that is let go with x₀ = 1.
    fn free(&self, time: f64) -> f64 {
        self.inverse(|s| self.released(s), time)
    }

    /// numerator/denominator, of a sphere at rest in a fluid that begins to strain by sin ωt.
    fn answer(&self, numerator: impl Fn(Scalar) -> Scalar, omega: f64, time: f64) -> f64 {
        let at = Complex::new(0.0, omega);
        let periodic = numerator(at) / self.denominator(at) * (at * time).exp();
        periodic.im + self.inverse(|s| numerator(s) * real(omega) / (s * s + omega * omega), time)
    }

    /// x of that sphere.
    fn forced(&self, omega: f64, time: f64) -> f64 {
        self.answer(drive, omega, time)
    }

    /// Its stresslet, in units of 3ηV: what holds it in the flow, less (5/3) s + (2/45) s² + s² κ̂ times X̂.
    fn stressed(&self, omega: f64, time: f64) -> f64 {
        let of_matter = self.inertia - 2.0 / 45.0;
        let left = |s: Scalar| s * s * of_matter - s * (2.0 / 3.0) + self.stiffness;
        self.answer(|s| drive(s) * left(s), omega, time)
    }
}

/// The moment that holds a sphere in a fluid that begins to strain by sin ωt, in units of 3ηV.
fn held(omega: f64, time: f64) -> f64 {
    let at = Complex::new(0.0, omega);
    (drive(at) * (at * time).exp()).im + cut(|s| drive(s) * real(omega) / (s * s + omega * omega), time)
}

/// A run of a sphere of so many times the density of the fluid, until t = `end` and sampled every `sample`, in units of
/// τ.
fn run(ratio: f64, times: (f64, f64), flow: &str, body: &str) -> Run {
    run_with("solver = { rtol = 1e-10, atol = 1e-12 }", ratio, times, flow, body)
}

fn run_with(solver: &str, ratio: f64, (end, sample): (f64, f64), flow: &str, body: &str) -> Run {
    let (end, sample, density) = (end * TAU, sample * TAU, ratio * DENSITY);
    let text = format!(
        "world = {{ gravity = [0, 0, 0] }}
        time = {{ end = {end:?}, sample = {sample:?} }}
        {solver}
        fluid = {{ viscosity = {VISCOSITY}, density = {DENSITY}{flow} }}
        [[body]]
        name = \"ball\"
        shape = {{ sphere = {{ radius = {RADIUS} }} }}
        density = {density:?}
        inclusion = {{ history = true }}
        {body}"
    );
    Experiment::of_scene(&text).run()
}

/// An incompressible sphere of the stiffness k.
fn rubber(stiffness: f64) -> String {
    let c1 = modulus(stiffness);
    format!("affine = {{ material = {{ mooney_rivlin = {{ c1 = {c1:?}, c2 = 0 }} }} }}")
}

fn sheared(stiffness: f64) -> String {
    // Of determinant one.
    let (long, across) = (SMALL.cosh(), SMALL.sinh());
    format!("{}\ngradient = [[{long:?}, {across:?}, 0], [{across:?}, {long:?}, 0], [0, 0, 1]]", rubber(stiffness))
}

/// A flow that begins to shear by SMALL sin ωt, ω in units of 1/τ.
fn swaying(omega: f64) -> String {
    let (rate, frequency) = (SMALL / TAU, omega / (2.0 * PI * TAU));
    format!(
        ", velocity_gradient = {{ sine = {{ amplitude = [[0, {rate:?}, 0], [{rate:?}, 0, 0], [0, 0, 0]], frequency = \
         {frequency:?} }} }}"
    )
}

/// The shear in the plane xy, over SMALL.
fn shears(run: &Run) -> Vec<f64> {
    run.matrices("placement_gradient").iter().map(|p| 0.5 * (p[(0, 1)] + p[(1, 0)]) / SMALL).collect()
}

/// The ledger of a sphere of the stiffness k closes but for the rounding of its elastic energy, c₁ V (ι₁ − 3).
fn closes(run: &Run, stiffness: f64) {
    let rounding = 16.0 * f64::EPSILON * modulus(stiffness) * VOLUME;
    println!("residual of the ledger {:.1e}, {} steps", run.relative_residual(), run.steps);
    assert!(run.largest_residual < 1e-7 * run.energy_in_play + rounding, "{:e} J", run.largest_residual);
}

/// c₁ of the stiffness k \[Pa\]: μ = 2 c₁.
fn modulus(stiffness: f64) -> f64 {
    0.25 * 3.0 * VISCOSITY / TAU * stiffness
}

#[test]
fn closed_forms_have_all_poles() {
    for (ratio, stiffness) in [(1.0, 2000.0), (8.0, 500.0), (1.0, 0.1), (0.01, 1.0)] {
        let shear = Shear::new(ratio, stiffness);
        assert!((shear.free(0.0) - 1.0).abs() < 1e-9, "{}", shear.free(0.0));
        assert!(shear.forced(3.0, 0.0).abs() < 1e-9, "{}", shear.forced(3.0, 0.0));
    }
}

#[test]
fn a_shear_of_a_rubber_sphere_swings_as_the_closed_form_says() {
    for (name, ratio, stiffness) in
        [("rubber sphere of the fluid's density", 1.0, 2000.0), ("heavy rubber sphere", 8.0, 500.0)]
    {
        let shear = Shear::new(ratio, stiffness);
        let pole = shear.poles().into_iter().find(|s| s.im > 0.0).unwrap_or_else(|| real(f64::NAN));
        let (end, sample) = (-3.0 / pole.re, 0.2 / pole.im);
        let run = run(ratio, (end, sample), "", &sheared(stiffness));
        let found = shears(&run);
        let times: Vec<f64> = run.times.iter().map(|time| time / TAU).collect();
        let errors = times.iter().zip(&found).map(|(time, x)| x - shear.free(*time));
        let case = Case { row: None, name, source: SOURCE };
        case.check("largest error of a shear that swings, over the first", 0.0, largest(errors), 1e-6);
        // Without the part of the cut, three in a row are y₊ = p y − q y₋ with q = e^(2 Re s h), p = 2√q cos(Im s h).
        let swings: Vec<f64> = times.iter().zip(&found).map(|(time, x)| x - shear.of_cut(*time)).collect();
        let swings = &swings[..swings.len() - 1];
        let mut sums = [0.0; 5];
        for three in swings.windows(3) {
            let [y, z, next] = [three[1], -three[0], three[2]];
            for (sum, term) in sums.iter_mut().zip([y * y, y * z, z * z, y * next, z * next]) {
                *sum += term;
            }
        }
        let [aa, ab, bb, ac, bc] = sums;
        let [p, q] = [(bb * ac - ab * bc) / (aa * bb - ab * ab), (aa * bc - ab * ac) / (aa * bb - ab * ab)];
        let step = sample;
        let (decay, frequency) = (-0.5 * q.ln() / step, (0.5 * p / q.sqrt()).acos() / step);
        case.check("decay rate of the shear, times τ", -pole.re, decay, 1e-5);
        case.check("frequency of the shear, times τ", pole.im, frequency, 1e-5);
        closes(&run, stiffness);
    }
}

#[test]
fn a_growth_swings_without_memory() {
    let (ratio, stiffness) = (2.0, 400.0);
    // Kτ/η: λ + ⅔μ = K.
    let bulk = VISCOSITY / TAU * stiffness;
    let shear = 0.3 * bulk;
    let lambda = bulk - 2.0 / 3.0 * shear;
    let grown = 1.0 + 1e-6;
    let text = format!(
        "affine = {{ material = {{ st_venant_kirchhoff = {{ lambda = {lambda:?}, mu = {shear:?} }} }} }}
        gradient = [[{grown}, 0, 0], [0, {grown}, 0], [0, 0, {grown}]]"
    );
    let run = run(ratio, (2.0, 0.01), "", &text);
    let inertia = ratio / 15.0 + 1.0 / 3.0;
    let decay = 2.0 / 3.0 / inertia;
    let frequency = (stiffness / inertia - decay * decay).sqrt();
    let exact =
        |time: f64| (-decay * time).exp() * ((frequency * time).cos() + decay / frequency * (frequency * time).sin());
    let found = run.matrices("placement_gradient").into_iter().map(|p| (p.trace() / 3.0 - 1.0) / 1e-6);
    let errors = run.times.iter().zip(found).map(|(time, g)| g - exact(time / TAU));
    let case = Case { row: None, name: "breathing sphere in a fluid with inertia", source: "damped oscillator" };
    // The square of the growth, and the rounding of P.
    case.check("largest error of a growth that swings, over the first", 0.0, largest(errors), 1e-5);
    // That of St Venant and Kirchhoff has no such rounding.
    closes(&run, 0.0);
}

#[test]
fn a_strain_set_free_in_a_thick_fluid_ends_in_a_tail() {
    let stiffness = 0.1;
    let shear = Shear::new(1.0, stiffness);
    let run = run(1.0, (400.0, 4.0), "", &sheared(stiffness));
    let found = shears(&run);
    let errors = run.times.iter().zip(&found).map(|(time, x)| x - shear.free(time / TAU));
    let case = Case { row: None, name: "soft sphere let go in a thick fluid", source: SOURCE };
    case.check("largest error of the shear until 400 τ, over the first", 0.0, largest(errors), 1e-6);
    // Beyond the poles x is −(5/9) s^(3/2)/k in the transform: −5/(12√π k) t^(−5/2).
    let last = found[found.len() - 1];
    let late = 400.0;
    case.check("shear at 400 τ, over the first", shear.free(late), last, 2e-3);
    let tail = -5.0 / (12.0 * PI.sqrt() * stiffness) * late.powf(-2.5);
    println!("closed form over the first term of its tail: {:.3}", shear.free(late) / tail);
    closes(&run, stiffness);
}

#[test]
fn spheres_in_a_flow_that_sways_answer_as_the_closed_form_says() {
    let omega = 5.0;
    let times = (4.0, 0.05);
    let moment = |run: &Run| -> Vec<f64> {
        let unit = 3.0 * VISCOSITY * VOLUME * SMALL / TAU;
        run.matrices("stresslet").iter().map(|stresslet| stresslet[(0, 1)] / unit).collect()
    };
    let source = SOURCE;
    let hard = run(1.0, times, &swaying(omega), "");
    let errors = hard.times.iter().zip(moment(&hard)).map(|(time, s)| s - held(omega, time / TAU));
    let case = Case { row: None, name: "rigid sphere in a flow that sways", source };
    case.check("largest error of the stresslet, over 3ηV times the strain rate", 0.0, largest(errors), 3e-6);
    let usual = run_with("", 1.0, times, &swaying(omega), "");
    let errors = usual.times.iter().zip(moment(&usual)).map(|(time, s)| s - held(omega, time / TAU));
    case.check("the same at the default tolerances", 0.0, largest(errors), 1e-4);
    let soft = run(1.0, times, &swaying(omega), &rubber(20.0));
    let shear = Shear::new(1.0, 20.0);
    let errors = soft.times.iter().zip(shears(&soft)).map(|(time, x)| x - shear.forced(omega, time / TAU));
    let case = Case { row: None, name: "rubber sphere in a flow that sways", source };
    case.check("largest error of its shear, over that of the flow", 0.0, largest(errors), 1e-6);
    let errors = soft.times.iter().zip(moment(&soft)).map(|(time, s)| s - shear.stressed(omega, time / TAU));
    case.check("largest error of its stresslet, over 3ηV times the strain rate", 0.0, largest(errors), 3e-6);
    closes(&soft, 20.0);
}

#[test]
fn stiff_rubber_spheres_sink_and_spin_as_rigid_ones_do() {
    let ratio = 2.5;
    let text = |more: &str| format!("{}\n{more}", rubber(500.0));
    let spin = 3.0;
    let spun = run(ratio, (10.0, 0.5), "", &text(&format!("angular_velocity = [0, 0, {spin}]")));
    let spins = spun.matrices("gradient_rate").into_iter().zip(spun.matrices("placement_gradient"));
    let spins = spins.map(|(rate, p)| {
        let l = rate * p.try_inverse().unwrap_or_else(|| panic!("det P = 1"));
        0.5 * (l[(1, 0)] - l[(0, 1)]) / spin
    });
    let errors = spun.times.iter().zip(spins).map(|(time, spin)| spin - spinning(ratio / 15.0, time / TAU));
    let case =
        Case { row: None, name: "rubber sphere set spinning and let go", source: "inverse transform, on the cut" };
    case.check("largest error of Ω/Ω₀ until 10 τ", 0.0, largest(errors.skip(1)), 1e-6);
    closes(&spun, 500.0);
    let force = "force = [{ point = [0, 0, 0], value = [1e-4, 0, 0] }]";
    let pulled = run(ratio, (10.0, 0.5), "", &text(force));
    let last = 1e-4 / (6.0 * PI * VISCOSITY * RADIUS);
    let inertia = (2.0 * ratio + 1.0) / 9.0;
    let speeds = pulled.column("ball.vx");
    let errors = pulled.times.iter().zip(speeds).map(|(time, v)| v / last - settling(inertia, time / TAU));
    let case = Case { row: None, name: "rubber sphere that is pulled from rest", source: "Basset (1888), closed form" };
    case.check("largest error of v until 10 τ", 0.0, largest(errors), 5e-6);
    closes(&pulled, 500.0);
}
