//! The linear equations of a step: the Jacobian, and the factors made of it.

use crate::block_matrix::BlockMatrix;
use crate::factor::ComponentFactors;
use crate::layout::SystemLayout;
use crate::linear::Singular;
use crate::radau::Radau;
use crate::spectrum::{least_spectral_radius, spectral_radius};

/// The Jacobian of a step with its factors.
///
/// Where blocks couple, room is made when it is first needed: an explicit run whose pattern changes with every contact
/// analyses none of them.
#[derive(Debug, Clone)]
pub(crate) struct LinearSystem {
    method: &'static Radau,
    jacobian: BlockMatrix,
    factors: ComponentFactors,
    /// Whether both have the layout of the system.
    ready: bool,
}

impl LinearSystem {
    /// For the stages of a method; without room yet.
    pub fn of(method: &'static Radau) -> Self {
        Self { method, jacobian: BlockMatrix::default(), factors: ComponentFactors::default(), ready: false }
    }

    /// Takes note of a new layout.
    pub fn set_layout(&mut self, layout: &SystemLayout) {
        self.ready = false;
        if layout.pattern.is_uncoupled() {
            self.make_room(layout);
        }
    }

    fn make_room(&mut self, layout: &SystemLayout) {
        self.jacobian = BlockMatrix::new(layout.blocks(), &layout.pattern);
        self.factors = ComponentFactors::new(layout, &self.jacobian, self.method);
        self.ready = true;
    }

    /// The Jacobian, filled with zeros.
    pub fn cleared(&mut self, layout: &SystemLayout) -> &mut BlockMatrix {
        if self.ready {
            self.jacobian.clear();
        } else {
            self.make_room(layout);
        }
        &mut self.jacobian
    }

    /// Factorizes γ/h I − J and (α + iβ)/h I − J of every pair.
    ///
    /// # Errors
    /// `Singular` if one of them is singular or not finite.
    pub fn factorize(&mut self, h: f64) -> Result<(), Singular> {
        self.factors.factorize(h, &self.jacobian, self.method)
    }

    /// Solves (γ/h I − J) x = b in place.
    pub fn solve_real(&mut self, b: &mut [f64]) {
        self.factors.solve_real(b);
    }

    /// Solves ((α + iβ)/h I − J) x = b of a pair in place, b = real + i imaginary.
    pub fn solve_complex(&mut self, pair: usize, real: &mut [f64], imaginary: &mut [f64]) {
        self.factors.solve_complex(pair, real, imaginary);
    }

    /// What the linear algebra of a step costs beside that of the same blocks without coupling.
    pub fn relative_cost(&self) -> f64 {
        self.factors.relative_cost()
    }

    /// How many numbers the factors of coupled blocks are.
    pub fn entries_of_factors(&self) -> usize {
        if self.ready { self.factors.entries() } else { 0 }
    }

    /// A lower bound of the spectral radius of the Jacobian.
    pub fn least_spectral_radius(&self, layout: &SystemLayout) -> f64 {
        least_spectral_radius(&self.jacobian, layout)
    }

    /// The spectral radius of the Jacobian; `work` has room for two vectors.
    pub fn spectral_radius(&self, layout: &SystemLayout, scale: &[f64], work: &mut [f64]) -> f64 {
        spectral_radius(&self.jacobian, layout, scale, work)
    }
}
