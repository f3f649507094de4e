//! Normal modes at a wave vector: what the motion of the cells of a ring is projected on.
//!
//!   K(k) ξ_b = ω_b² ξ_b,   |ξ_b| = 1,   2 δ_b = ξ_bᴴ C(k) ξ_b      along coordinates of mass one
//!
//! They are the waves without losses, in the order of the bands, and of several with one frequency the same ones. δ is
//! their decay rate to first order in C; it is exact where C(k) does not join them.

use super::super::at_rest;
use super::bloch::C64;
use super::wave::Asked;
use super::waves::Waves;
use super::{LatticeWaves, NoBands};
use gyration::tensor::{Mat3, Vec3};
use nalgebra::{DMatrix, DVector};

/// The waves at a wave vector as normal modes.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct NormalModes {
    /// ω² [1/s²], ascending with ω; below zero of what grows.
    pub squares: Vec<f64>,
    /// δ [1/s].
    pub decays: Vec<f64>,
    /// ξ, column by column.
    pub shapes: DMatrix<C64>,
}

/// Why the waves of a lattice are no normal modes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum NoNormalModes {
    /// A contraction is a state of first order.
    #[error("bodies drive their own contraction, a state of first order: their waves are no normal modes")]
    Contracts,
    /// Velocities follow from places.
    #[error("bodies without inertia follow their forces at once: their waves are no normal modes")]
    Weightless,
    /// K is not Hermitian.
    #[error("what acts has no potential, so that K(k) is not Hermitian: its waves are no normal modes")]
    NoPotential,
    /// C is not Hermitian.
    #[error("something acts across velocities, as what is gyroscopic does: its waves are no normal modes")]
    Gyroscopic,
}

impl LatticeWaves {
    /// Whether waves without losses are normal modes.
    ///
    /// # Errors
    /// Why not.
    pub(crate) fn have_normal_modes(&self) -> Result<(), NoNormalModes> {
        if self.contracts() {
            return Err(NoNormalModes::Contracts);
        }
        if !self.system.inertial.weightless.is_empty() {
            return Err(NoNormalModes::Weightless);
        }
        if !self.system.has_potential {
            return Err(NoNormalModes::NoPotential);
        }
        if self.system.resists_evenly { Ok(()) } else { Err(NoNormalModes::Gyroscopic) }
    }

    /// Those at κ.
    ///
    /// # Errors
    /// `Roots`.
    pub(crate) fn normal_modes(&self, kappa: [f64; 3]) -> Result<NormalModes, NoBands> {
        let found = self.system.conservative(&kappa, &self.any_direction(), &Asked::default());
        let Waves { branches, .. } = found.map_err(|_| NoBands::Roots(kappa))?;
        let resistance = self.system.wave(&kappa).resistance;
        let square = |root: C64| if root.im != 0.0 { root.im * root.im } else { -root.re * root.re };
        let decay = |shape: &DVector<C64>| 0.5 * shape.dotc(&(&resistance * shape)).re;
        let columns: Vec<DVector<C64>> = branches.iter().map(|wave| wave.shape.clone()).collect();
        Ok(NormalModes {
            // Zero has no sign.
            squares: branches.iter().map(|wave| square(wave.root) + 0.0).collect(),
            decays: columns.iter().map(decay).collect(),
            shapes: DMatrix::from_columns(&columns),
        })
    }

    /// Coordinates of mass one, as many as branches.
    pub(crate) fn coordinate_count(&self) -> usize {
        self.coordinates.counts()[0]
    }

    /// u along these coordinates of what the bodies of a cell do, δp₀ and δP each.
    pub(crate) fn along(&self, motion: impl Fn(usize) -> (Vec3, Mat3)) -> DVector<f64> {
        self.coordinates.within(self.coordinates.moved(&self.frozen, motion))
    }

    /// What the rounding of places as far from the origin as this [m] leaves of u.
    pub(crate) fn rounding(&self, farthest: f64) -> f64 {
        let numbers = at_rest(&self.frozen, &self.rest.bodies);
        f64::EPSILON * self.coordinates.sizes(&self.frozen, &numbers, farthest).norm()
    }
}
