//! What a system of ordinary differential equations must say to be integrated.
//!
//!   dy/dt = f(t, y),   dw/dt = g(t, y)
//!
//! y is the state, w are quadratures: integrals that do not feed back (work, impulse, distance). They cost no linear
//! algebra, yet are integrated, controlled and interpolated with the same care as y. The Jacobian ∂f/∂y is block
//! diagonal; blocks that do not touch each other need not know each other. The integrator asks for nothing else: it
//! knows neither bodies nor forces.

use std::ops::Range;

use nalgebra::DMatrix;

use crate::report::{Cause, Statistics};

/// A system dy/dt = f(t, y), dw/dt = g(t, y) on a domain that may have a boundary.
///
/// All methods must be functions of their arguments alone: the integrator evaluates states that it later rejects, and
/// a run continued from a checkpoint must repeat the same numbers.
pub trait System {
    /// Why a state is outside the domain of the equations (a gap closed, a volume gone).
    type Inadmissible: Clone + std::fmt::Debug;

    /// The number of components of y.
    fn dimension(&self) -> usize;

    /// The number of components of w; may be 0.
    fn quadratures(&self) -> usize;

    /// The diagonal blocks of ∂f/∂y: consecutive ranges, a partition of `0..dimension`. They may change between steps.
    fn blocks(&self) -> &[Range<usize>];

    /// The rates dy = f(t, y) and dw = g(t, y); every entry is to be written.
    ///
    /// # Errors
    /// `Inadmissible` if the state lies outside the domain. The step is then retried with a smaller size.
    fn rates(&mut self, t: f64, y: &[f64], dy: &mut [f64], dw: &mut [f64]) -> Result<(), Self::Inadmissible>;

    /// The exact Jacobian ∂f/∂y, one square matrix a block; the matrices arrive filled with zeros.
    ///
    /// # Errors
    /// `Inadmissible` if the state lies outside the domain.
    fn jacobian(&mut self, t: f64, y: &[f64], blocks: &mut [DMatrix<f64>]) -> Result<(), Self::Inadmissible>;

    /// The absolute error allowed in a step, per component, at this state (relative and absolute tolerance together).
    ///
    /// Positive; +∞ frees a component from error control. Called at admissible states only.
    fn error_scales(&mut self, t: f64, y: &[f64], w: &[f64], y_scale: &mut [f64], w_scale: &mut [f64]);

    /// Brings y back to its manifold (a unit quaternion, say) after a step that ends at t; returns the size of the correction.
    ///
    /// What the correction changes of a balance that quadratures keep may be added to them.
    fn project(&mut self, t: f64, y: &mut [f64], w: &mut [f64]) -> f64;
}

/// Sizes and blocks, copied from the system: u = (y, w) is one vector to the steppers.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Layout {
    /// The number of components of y.
    pub dimension: usize,
    /// The number of components of u = (y, w).
    pub width: usize,
    /// The blocks of y and, if there are quadratures, the range of w within u.
    pub groups: Vec<Range<usize>>,
    /// How many of the groups are blocks of y.
    pub blocks: usize,
}

impl Layout {
    /// Copies the layout of a system.
    ///
    /// # Panics
    /// If the blocks do not partition `0..dimension`: a mistake in the system, not in its data.
    pub fn of<S: System>(system: &S) -> Self {
        let (dimension, quadratures) = (system.dimension(), system.quadratures());
        let mut groups = system.blocks().to_vec();
        let mut reached = 0;
        for block in &groups {
            assert!(block.start == reached && block.end >= reached, "blocks must be consecutive ranges");
            reached = block.end;
        }
        assert!(reached == dimension, "blocks must cover 0..{dimension}, they end at {reached}");
        let blocks = groups.len();
        if quadratures > 0 {
            groups.push(dimension..dimension + quadratures);
        }
        Self { dimension, width: dimension + quadratures, groups, blocks }
    }

    /// Whether the layout is still that of the system.
    pub fn fits<S: System>(&self, system: &S) -> bool {
        self.dimension == system.dimension()
            && self.width == system.dimension() + system.quadratures()
            && self.groups[..self.blocks] == *system.blocks()
    }

    /// The diagonal blocks of the Jacobian.
    pub fn blocks(&self) -> &[Range<usize>] {
        &self.groups[..self.blocks]
    }
}

/// An instant of the solution: u = (y, w), its rate and the error allowed there.
#[derive(Debug, Clone, Default)]
pub(crate) struct Point {
    pub t: f64,
    pub u: Vec<f64>,
    pub rate: Vec<f64>,
    pub scale: Vec<f64>,
}

impl Point {
    pub fn new(t: f64, u: Vec<f64>) -> Self {
        let (rate, scale) = (vec![0.0; u.len()], vec![0.0; u.len()]);
        Self { t, u, rate, scale }
    }
}

/// The system, with its layout and the counters, as a stepper sees it during an attempt.
pub(crate) struct Context<'a, S: System> {
    pub system: &'a mut S,
    pub layout: &'a Layout,
    pub statistics: &'a mut Statistics,
}

impl<S: System> Context<'_, S> {
    /// Rates of u = (y, w), refused unless state and rates are finite.
    ///
    /// # Errors
    /// `Cause::Inadmissible` from the system, `Cause::NotFinite` with the index of the component in u.
    pub fn evaluate(&mut self, t: f64, u: &[f64], rate: &mut [f64]) -> Result<(), Cause<S::Inadmissible>> {
        let y = &u[..self.layout.dimension];
        all_finite(y)?;
        let (dy, dw) = rate.split_at_mut(self.layout.dimension);
        self.statistics.rate_evaluations += 1;
        self.system.rates(t, y, dy, dw).map_err(Cause::Inadmissible)?;
        all_finite(rate)
    }

    /// Projects a new state and evaluates its rate, which so belongs to the projected state; returns the correction.
    ///
    /// # Errors
    /// As `evaluate`.
    pub fn land(&mut self, point: &mut Point) -> Result<f64, Cause<S::Inadmissible>> {
        let (y, w) = point.u.split_at_mut(self.layout.dimension);
        let correction = self.system.project(point.t, y, w);
        self.evaluate(point.t, &point.u, &mut point.rate)?;
        Ok(correction)
    }

    /// The error allowed at a point, which must be admissible.
    pub fn scales(&mut self, point: &mut Point) {
        let (y, w) = point.u.split_at(self.layout.dimension);
        let (y_scale, w_scale) = point.scale.split_at_mut(self.layout.dimension);
        self.system.error_scales(point.t, y, w, y_scale, w_scale);
    }
}

fn all_finite<I>(values: &[f64]) -> Result<(), Cause<I>> {
    // Without a branch for each, since all of them nearly always are: 0·x is zero unless x is infinite or not a number.
    let (chunks, rest) = values.as_chunks::<4>();
    let mut products = [0.0; 4];
    for chunk in chunks {
        products = std::array::from_fn(|i| products[i] + 0.0 * chunk[i]);
    }
    if products.iter().sum::<f64>() + rest.iter().map(|value| 0.0 * value).sum::<f64>() == 0.0 {
        return Ok(());
    }
    match values.iter().position(|value| !value.is_finite()) {
        Some(index) => Err(Cause::NotFinite { index }),
        None => Ok(()),
    }
}
