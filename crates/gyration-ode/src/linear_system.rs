//! The linear equations of a step: the Jacobian, and the factors made of it.

use crate::factor::ComponentFactors;
use crate::layout::SystemLayout;
use crate::radau::Radau;
use crate::spectrum::{least_spectral_radius, spectral_radius};
use gyration_blocks::{BlockMatrix, Components, Pattern, Singular};

/// The Jacobian of a step with its factors.
///
/// Where blocks may couple, room is made when it is first needed: an explicit run needs none.
#[derive(Debug, Clone)]
pub(crate) struct LinearSystem {
    method: &'static Radau,
    jacobian: BlockMatrix,
    /// The blocks that hang together in it.
    components: Components,
    factors: ComponentFactors,
    /// The pattern for which there are factors, if there are any.
    analysed: Option<Pattern>,
}

impl LinearSystem {
    /// For the stages of a method; without room yet.
    pub fn of(method: &'static Radau) -> Self {
        Self {
            method,
            jacobian: BlockMatrix::default(),
            components: Components::apart(),
            factors: ComponentFactors::default(),
            analysed: None,
        }
    }

    /// Takes note of a new layout.
    pub fn set_layout(&mut self, layout: &SystemLayout) {
        self.jacobian = BlockMatrix::default();
        self.analysed = None;
        if layout.components.are_apart() {
            self.cleared(layout);
            self.analyse(layout);
        }
    }

    /// The Jacobian, its diagonal filled with zeros, to be arranged and written.
    pub fn cleared(&mut self, layout: &SystemLayout) -> &mut BlockMatrix {
        if self.jacobian.diagonal().len() == layout.blocks().len() {
            self.jacobian.clear();
        } else {
            self.jacobian = BlockMatrix::new(layout.blocks());
        }
        &mut self.jacobian
    }

    /// Makes room for the factors of the Jacobian, unless there is.
    fn analyse(&mut self, layout: &SystemLayout) {
        let pattern = self.jacobian.pattern();
        if self.analysed.as_ref() != Some(pattern) {
            debug_assert!(layout.components.contain(pattern), "blocks couple across the components of the system");
            // Those of before go first.
            self.factors = ComponentFactors::default();
            self.components = Components::of(pattern, layout.blocks().len());
            self.factors = ComponentFactors::new(layout.blocks(), &self.components, &self.jacobian, self.method);
            self.analysed = Some(pattern.clone());
        }
    }

    /// Factorizes γ/h I − J and (α + iβ)/h I − J of every pair.
    ///
    /// # Errors
    /// `Singular` if one of them is singular or not finite.
    pub fn factorize(&mut self, layout: &SystemLayout, h: f64) -> Result<(), Singular> {
        self.jacobian.settle();
        self.analyse(layout);
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
        self.analysed.as_ref().map_or(0, |_| self.factors.entries())
    }

    /// A lower bound of the spectral radius of the Jacobian.
    pub fn least_spectral_radius(&self) -> f64 {
        least_spectral_radius(&self.jacobian, &self.components)
    }

    /// The spectral radius of the Jacobian; `work` has room for two vectors.
    pub fn spectral_radius(&self, layout: &SystemLayout, scale: &[f64], work: &mut [f64]) -> f64 {
        spectral_radius((&self.jacobian, &self.components), layout, scale, work)
    }
}
