//! A body that deforms in the fluid: an ellipsoid in closed form, or any other shape by a table.

use super::ambient::{Flow, Fluid};
use super::inclusion::{Form, ImmersedEllipsoid, Inclusion};
use super::surface::ImmersedSurface;
use super::table::UnresolvedForm;
use crate::affine::Gyration;
use crate::kinematics::{Placement, Velocity};
use crate::load::{LoadSlopes, Loads};
use crate::tensor::{Mat3, Vec3};

/// A deformable body in the fluid at one instant.
#[expect(
    clippy::large_enum_variant,
    reason = "the closed form costs microseconds, of which an allocation would be a part"
)]
#[derive(Debug, Clone)]
pub enum Immersed<'a> {
    /// The image of an ellipsoid.
    Ellipsoid(ImmersedEllipsoid<'a>),
    /// The image of any other shape.
    Surface(Box<ImmersedSurface<'a>>),
}

impl<'a> Immersed<'a> {
    /// Of a body in motion, in a fluid and its flow, under gravity; none if its form is fixed.
    ///
    /// # Errors
    /// [`UnresolvedForm`] where its resistance is not known as well as was asked for.
    pub fn of(
        inclusion: &'a Inclusion,
        around: (&Fluid, &Flow, &Vec3),
        moving: (&Placement, &Velocity),
        at: &Gyration,
    ) -> Result<Option<Self>, UnresolvedForm> {
        Ok(match inclusion.form {
            Form::Fixed(_) => None,
            Form::Ellipsoid(_) => ImmersedEllipsoid::of(inclusion, around, moving, at)?.map(Self::Ellipsoid),
            Form::Surface(_) => {
                ImmersedSurface::of(inclusion, around, moving, at)?.map(|surface| Self::Surface(Box::new(surface)))
            }
        })
    }

    /// f and M of the fluid.
    #[inline]
    pub fn loads(&self, at: &Gyration) -> Loads {
        match self {
            Self::Ellipsoid(ellipsoid) => ellipsoid.loads(at),
            Self::Surface(surface) => surface.loads(at),
        }
    }

    /// Adds f and M and their derivatives.
    pub fn add_to(&self, slopes: &mut LoadSlopes, at: &Gyration) {
        match self {
            Self::Ellipsoid(ellipsoid) => ellipsoid.add_to(slopes, at),
            Self::Surface(surface) => surface.add_to(slopes, at),
        }
    }

    /// The force of the fluid without the weight of what is displaced \[N\].
    pub fn drag(&self) -> Vec3 {
        match self {
            Self::Ellipsoid(ellipsoid) => ellipsoid.drag(),
            Self::Surface(surface) => surface.drag(),
        }
    }

    /// Nᵀ about the centre of the volume \[N m\].
    pub fn couple(&self) -> Mat3 {
        match self {
            Self::Ellipsoid(ellipsoid) => ellipsoid.couple(),
            Self::Surface(surface) => surface.couple(),
        }
    }

    /// The power that the flow past the body turns into heat beyond that of the undisturbed flow \[W\].
    pub fn dissipation(&self, viscosity: f64) -> f64 {
        match self {
            Self::Ellipsoid(ellipsoid) => ellipsoid.dissipation(viscosity),
            Self::Surface(surface) => surface.dissipation(),
        }
    }

    /// V det P \[m³\].
    pub fn volume(&self) -> f64 {
        match self {
            Self::Ellipsoid(ellipsoid) => ellipsoid.volume(),
            Self::Surface(surface) => surface.volume(),
        }
    }

    /// Principal axes in space, a column each, and the squares of the semi-axes: of any other shape, those of the
    /// ellipsoid of the same second moments, the squares but for a common factor.
    pub fn principal(&self) -> (Mat3, [f64; 3]) {
        match self {
            Self::Ellipsoid(ellipsoid) => (ellipsoid.ellipsoid.axes, ellipsoid.ellipsoid.squares),
            Self::Surface(surface) => surface.principal(),
        }
    }
}
