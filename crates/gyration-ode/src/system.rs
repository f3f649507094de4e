//! What a system of ordinary differential equations must say to be integrated.
//!
//!   dy/dt = f(t, y),   dw/dt = g(t, y)
//!
//! y is the state, w are quadratures: integrals that do not feed back (work, impulse, distance). They cost no linear
//! algebra, yet are integrated, controlled and interpolated with the same care as y. The Jacobian ∂f/∂y consists of
//! blocks; which of them couple is the system's to say with each Jacobian. The integrator asks for nothing else: it
//! knows neither bodies nor forces.

use std::ops::Range;

use crate::extended::{Extended, ExtendedMut};
use gyration_blocks::{BlockMatrix, Components};

/// A system dy/dt = f(t, y), dw/dt = g(t, y) on a domain that may have a boundary.
///
/// All methods must be functions of their arguments alone: the integrator evaluates states that it later rejects, and a
/// run continued from a checkpoint must repeat the same numbers.
pub trait System {
    /// Why a state is outside the domain of the equations (a gap closed, a volume gone).
    type Inadmissible: Clone + std::fmt::Debug;

    /// The number of components of y.
    fn dimension(&self) -> usize;

    /// The number of components of w; may be 0.
    fn quadratures(&self) -> usize;

    /// How many of these, the last ones, have no part in the error of a step: it is the same with and without them.
    fn free_quadratures(&self) -> usize {
        0
    }

    /// The blocks of y: consecutive ranges, a partition of `0..dimension`. They may change between steps.
    fn blocks(&self) -> &[Range<usize>];

    /// Sets of blocks such that no block enters the rates of one in another set: each block by itself, unless a system
    /// says otherwise. They hold at every state until the next step, before which they may change.
    ///
    /// Stiffness is judged set by set.
    fn components(&self) -> &Components {
        static APART: Components = Components::apart();
        &APART
    }

    /// The rates dy = f(t, y) and dw = g(t, y); every entry is to be written.
    ///
    /// # Errors
    /// `Inadmissible` if the state lies outside the domain. The step is then retried with a smaller size.
    fn rates(&mut self, t: f64, y: &[f64], dy: &mut [f64], dw: &mut [f64]) -> Result<(), Self::Inadmissible>;

    /// The rates at a state of twice the digits; by default those of its rounded numbers.
    ///
    /// For systems in which small differences of large numbers matter. The steppers ask by the methods for such states
    /// alone.
    ///
    /// # Errors
    /// As of [`System::rates`].
    fn extended_rates(
        &mut self,
        t: f64,
        y: Extended,
        dy: &mut [f64],
        dw: &mut [f64],
    ) -> Result<(), Self::Inadmissible> {
        self.rates(t, y.high, dy, dw)
    }

    /// The exact Jacobian ∂f/∂y, block (i, j) = ∂f_i/∂y_j; it arrives filled with zeros.
    ///
    /// A system whose blocks couple at this state [arranges](BlockMatrix::arrange) the matrix in this call, within its
    /// components; one that does not has the diagonal alone. The steppers compare the pattern with that of the step
    /// before, and analyse it anew only where it differs.
    ///
    /// # Errors
    /// `Inadmissible` if the state lies outside the domain.
    fn jacobian(&mut self, t: f64, y: &[f64], jacobian: &mut BlockMatrix) -> Result<(), Self::Inadmissible>;

    /// The Jacobian at a state of twice the digits; by default that of its rounded numbers.
    ///
    /// # Errors
    /// As of [`System::jacobian`].
    fn extended_jacobian(&mut self, t: f64, y: Extended, jacobian: &mut BlockMatrix) -> Result<(), Self::Inadmissible> {
        self.jacobian(t, y.high, jacobian)
    }

    /// The absolute error allowed in a step, per component, at this state (relative and absolute tolerance together).
    ///
    /// Positive; +∞ frees a component from error control. Called at admissible states only.
    fn error_scales(&mut self, t: f64, y: &[f64], w: &[f64], y_scale: &mut [f64], w_scale: &mut [f64]);

    /// Brings y back to its manifold (a unit quaternion, say) after a step that ends at t; returns the size of the
    /// correction.
    ///
    /// What the correction changes of a balance that quadratures keep may be added to them.
    fn project(&mut self, t: f64, y: &mut [f64], w: &mut [f64]) -> f64;

    /// The same for a state of twice the digits; by default the rounded numbers are projected and the rest stays.
    fn extended_project(&mut self, t: f64, y: ExtendedMut, w: &mut [f64]) -> f64 {
        self.project(t, y.high, w)
    }
}
