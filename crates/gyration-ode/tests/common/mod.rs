//! Problems for the tests of the steppers, made from closures, and a driver.

#![allow(dead_code, clippy::unwrap_used)]

pub mod chain;

use std::ops::Range;

use gyration_ode::{BlockMatrix, Components, ImplicitOrder, Integrator, Method, Options, Statistics, System};
use nalgebra::DMatrix;

type Rates = dyn Fn(f64, &[f64], &mut [f64], &mut [f64]) -> Result<(), &'static str>;
type Jacobian = dyn Fn(f64, &[f64], &mut [DMatrix<f64>]);

/// A system from closures, with the usual error scale atol + rtol |u|.
pub struct Problem {
    pub quadratures: usize,
    pub blocks: Vec<Range<usize>>,
    pub components: Components,
    pub rtol: f64,
    pub atol: f64,
    pub project: fn(&mut [f64]) -> f64,
    rates: Box<Rates>,
    jacobian: Box<Jacobian>,
}

impl Problem {
    /// One block, no quadratures, never outside its domain.
    pub fn new(
        dimension: usize,
        rates: impl Fn(f64, &[f64], &mut [f64]) + 'static,
        jacobian: impl Fn(f64, &[f64], &mut DMatrix<f64>) + 'static,
    ) -> Self {
        Self::general(
            dimension,
            0,
            move |t, y, dy, _| {
                rates(t, y, dy);
                Ok(())
            },
            move |t, y, blocks| jacobian(t, y, &mut blocks[0]),
        )
    }

    /// One block.
    pub fn general(
        dimension: usize,
        quadratures: usize,
        rates: impl Fn(f64, &[f64], &mut [f64], &mut [f64]) -> Result<(), &'static str> + 'static,
        jacobian: impl Fn(f64, &[f64], &mut [DMatrix<f64>]) + 'static,
    ) -> Self {
        Self {
            quadratures,
            blocks: vec![Range { start: 0, end: dimension }],
            components: Components::apart(),
            rtol: 1e-6,
            atol: 1e-9,
            project: |_| 0.0,
            rates: Box::new(rates),
            jacobian: Box::new(jacobian),
        }
    }

    pub fn tolerances(mut self, rtol: f64, atol: f64) -> Self {
        (self.rtol, self.atol) = (rtol, atol);
        self
    }
}

impl System for Problem {
    type Inadmissible = &'static str;

    fn dimension(&self) -> usize {
        self.blocks.last().unwrap().end
    }

    fn quadratures(&self) -> usize {
        self.quadratures
    }

    fn blocks(&self) -> &[Range<usize>] {
        &self.blocks
    }

    fn components(&self) -> &Components {
        &self.components
    }

    fn rates(&mut self, t: f64, y: &[f64], dy: &mut [f64], dw: &mut [f64]) -> Result<(), &'static str> {
        (self.rates)(t, y, dy, dw)
    }

    fn jacobian(&mut self, t: f64, y: &[f64], jacobian: &mut BlockMatrix) -> Result<(), &'static str> {
        (self.jacobian)(t, y, jacobian.diagonal_mut());
        Ok(())
    }

    fn error_scales(&mut self, _: f64, y: &[f64], w: &[f64], y_scale: &mut [f64], w_scale: &mut [f64]) {
        for (scale, value) in y_scale.iter_mut().chain(w_scale).zip(y.iter().chain(w)) {
            *scale = self.atol + self.rtol * value.abs();
        }
    }

    fn project(&mut self, _: f64, y: &mut [f64], _: &mut [f64]) -> f64 {
        (self.project)(y)
    }
}

/// Integrates to the end; returns the integrator there.
pub fn run(problem: &mut Problem, y: &[f64], w: &[f64], span: (f64, f64), options: Options) -> Integrator {
    run_system(problem, y, w, span, options)
}

/// As `run`, of any system.
pub fn run_system<S: System>(system: &mut S, y: &[f64], w: &[f64], span: (f64, f64), options: Options) -> Integrator {
    let mut integrator = Integrator::new(span.0, y, w, options);
    while integrator.time() < span.1 {
        integrator.step(system, span.1).unwrap();
    }
    integrator
}

pub fn with(method: Method) -> Options {
    Options { method, ..Options::default() }
}

/// The implicit method of every order.
pub fn implicit() -> [Options; 3] {
    [ImplicitOrder::Five, ImplicitOrder::Nine, ImplicitOrder::Thirteen]
        .map(|order| Options { order, ..with(Method::Implicit) })
}

/// The implicit method of every order, and the choice between the steppers.
pub fn for_stiff() -> [Options; 4] {
    let [five, nine, thirteen] = implicit();
    [five, nine, thirteen, with(Method::Auto)]
}

/// Steps of fixed size: `Options` that hold the step at h. The error allowed has to be large enough for it.
pub fn fixed(options: Options, h: f64) -> Options {
    Options { max_step: h, initial_step: Some(h), ..options }
}

/// The largest difference.
pub fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Slopes of log₂ between successive errors, for steps halved each time.
pub fn slopes(errors: &[f64]) -> Vec<f64> {
    errors.windows(2).map(|pair| (pair[0] / pair[1]).log2()).collect()
}

pub fn rejections(s: &Statistics) -> u64 {
    s.rejected_error + s.rejected_domain + s.newton_failures
}

/// x'' = −ω² x, one block, quadrature ∫ x² dt.
pub fn oscillator(omega: f64) -> Problem {
    let square = omega * omega;
    Problem::general(
        2,
        1,
        move |_, y, dy, dw| {
            (dy[0], dy[1], dw[0]) = (y[1], -square * y[0], y[0] * y[0]);
            Ok(())
        },
        move |_, _, blocks| {
            blocks[0][(0, 1)] = 1.0;
            blocks[0][(1, 0)] = -square;
        },
    )
}

/// The plane Kepler problem, GM = 1: (x, y, vx, vy).
pub fn kepler() -> Problem {
    Problem::new(
        4,
        |_, s, d| {
            let cube = (s[0] * s[0] + s[1] * s[1]).powf(1.5);
            d.copy_from_slice(&[s[2], s[3], -s[0] / cube, -s[1] / cube]);
        },
        |_, s, j| {
            let square = s[0] * s[0] + s[1] * s[1];
            let (cube, fifth) = (square.powf(1.5), square.powf(2.5));
            (j[(0, 2)], j[(1, 3)]) = (1.0, 1.0);
            j[(2, 0)] = 3.0 * s[0] * s[0] / fifth - 1.0 / cube;
            j[(3, 1)] = 3.0 * s[1] * s[1] / fifth - 1.0 / cube;
            (j[(2, 1)], j[(3, 0)]) = (3.0 * s[0] * s[1] / fifth, 3.0 * s[0] * s[1] / fifth);
        },
    )
}

/// Perihelion state of an ellipse of unit major half-axis.
pub fn perihelion(eccentricity: f64) -> [f64; 4] {
    [1.0 - eccentricity, 0.0, 0.0, ((1.0 + eccentricity) / (1.0 - eccentricity)).sqrt()]
}

/// y'' = y⁻⁶ − 1 − c y⁻² y', a drop onto a barrier, with quadratures ∫ y⁻⁶ dt and the dissipated ∫ c y⁻² y'² dt.
pub fn barrier(damping: f64) -> Problem {
    Problem::general(
        2,
        2,
        move |_, y, dy, dw| {
            if y[0] <= 0.0 {
                return Err("gap closed");
            }
            let (push, drag) = (y[0].powi(-6), damping * y[0].powi(-2) * y[1]);
            (dy[0], dy[1]) = (y[1], push - 1.0 - drag);
            (dw[0], dw[1]) = (push, drag * y[1]);
            Ok(())
        },
        move |_, y, blocks| {
            blocks[0][(0, 1)] = 1.0;
            blocks[0][(1, 0)] = -6.0 * y[0].powi(-7) + 2.0 * damping * y[0].powi(-3) * y[1];
            blocks[0][(1, 1)] = -damping * y[0].powi(-2);
        },
    )
}

/// The energy of the barrier problem: y'²/2 + y⁻⁵/5 + y.
pub fn barrier_energy(y: &[f64]) -> f64 {
    0.5 * y[1] * y[1] + 0.2 * y[0].powi(-5) + y[0]
}

/// Numbers for the log.
pub fn short(values: &[f64]) -> String {
    values.iter().map(|value| format!("{value:.2e}")).collect::<Vec<_>>().join(" ")
}
