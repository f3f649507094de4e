//! The loads of a fluid on a body of any form that deforms.
//!
//!   (f; Nᵀ row by row) = −η D H(E) D (v; L − L∞ row by row) in the axes R,   P = R U,  U = j^⅓ E,  D = diag(j^⅙, j^½)
//!
//! v is the velocity of the centre of volume against the fluid, and Nᵀ about it: the resistance to a velocity grows
//! like a length, that to a gradient like a volume. The stress of the undisturbed flow, 2η j V sym L∞, adds to Nᵀ; M =
//! Nᵀ P⁻ᵀ + f ⊗ X_c (`inclusion`).
//!
//! Derivatives: δR = R [w]× from `Polar::turn`, δs from δU = Rᵀ δP − [w]× U, and D grows by tr(P⁻¹δP). Source:
//! `docs/theory-fluid.md`.

use super::ambient::{Flow, Fluid};
use super::fixed::{packed, parted};
use super::inclusion::{Form, Inclusion, SurfaceForm};
use super::reference::ReferenceEllipsoid;
use super::stretch::{PrincipalStretch, Strain};
use super::table::{FormInterpolant, ResistanceTable, UnresolvedForm};
use crate::affine::Gyration;
use crate::kinematics::{Placement, Velocity};
use crate::load::{COORDINATES, LoadSlopes, Loads, Mat12, numbers, unit};
use crate::tensor::{Mat3, Polar, Vec3, cross_matrix};
use nalgebra::SVector;

type Vec12 = SVector<f64, 12>;

/// The resistance of a body as deformed as it is.
#[derive(Debug, Clone)]
struct Resisting {
    interpolant: FormInterpolant,
    reference: ReferenceEllipsoid,
    stretch: PrincipalStretch,
    /// H(E) for viscosity 1.
    matrix: Mat12,
    /// The diagonal of D.
    scale: Vec12,
    viscosity: f64,
}

/// A deformable body of any form in the fluid at one instant.
#[derive(Debug, Clone)]
pub struct ImmersedSurface<'a> {
    inclusion: &'a Inclusion,
    resisting: Resisting,
    polar: Polar,
    /// Velocity of the centre and L, both against the flow, in the axes R.
    motion: Vec12,
    /// f and Nᵀ of the disturbance, in the axes R.
    load: Vec12,
    /// L∞ \[1/s\], and 2ηV det P sym L∞ \[N m\], in the axes of space.
    flow: Mat3,
    ambient: Mat3,
    /// V det P \[m³\].
    volume: f64,
    /// ρ_f g \[N/m³\].
    weight: Vec3,
}

/// Numbers that go with the velocity and with the gradient.
fn scales(velocity: f64, gradient: f64) -> Vec12 {
    Vec12::from_fn(|place, _| if place < 3 { velocity } else { gradient })
}

impl Resisting {
    fn of(table: &ResistanceTable, polar: &Polar, volume_ratio: f64, viscosity: f64) -> Result<Self, UnresolvedForm> {
        let stretch = PrincipalStretch::of(&polar.stretch);
        let interpolant = table.around(&stretch)?;
        let reference = table.reference(&stretch)?;
        let matrix = reference.resistance(&interpolant.ratio());
        let scale = scales(libm::pow(volume_ratio, 1.0 / 6.0), volume_ratio.sqrt());
        Ok(Self { interpolant, reference, stretch, matrix, scale, viscosity })
    }

    /// −η D H D x.
    fn act(&self, motion: &Vec12) -> Vec12 {
        (self.matrix * motion.component_mul(&self.scale)).component_mul(&self.scale) * -self.viscosity
    }

    /// −η D ∂H/∂s_m D x.
    fn slopes_on(&self, motion: &Vec12) -> [Vec12; 5] {
        let (lower, ratio) = (&self.reference.lower, self.interpolant.ratio());
        let seen = motion.component_mul(&self.scale);
        let carried = lower.tr_mul(&seen);
        let through = ratio * carried;
        let swept = self.interpolant.slopes_on(&carried);
        let lowers = self.reference.slopes(&self.stretch);
        std::array::from_fn(|m| {
            let change = lowers[m] * through + lower * (ratio * lowers[m].tr_mul(&seen) + swept[m]);
            change.component_mul(&self.scale) * -self.viscosity
        })
    }
}

impl<'a> ImmersedSurface<'a> {
    /// Of a body in motion; none if its form is another.
    ///
    /// # Errors
    /// [`UnresolvedForm`] where its resistance is not known as well as was asked for.
    pub fn of(
        inclusion: &'a Inclusion,
        (fluid, flow, gravity): (&Fluid, &Flow, &Vec3),
        (placement, velocity): (&Placement, &Velocity),
        at: &Gyration,
    ) -> Result<Option<Self>, UnresolvedForm> {
        let Form::Surface(SurfaceForm(table)) = &inclusion.form else { return Ok(None) };
        let polar = Polar::of(&at.gradient);
        let resisting = Resisting::of(table, &polar, at.volume_ratio, fluid.viscosity)?;
        let rotation = &polar.rotation;
        let place = placement.place(&inclusion.center);
        let slip = rotation.tr_mul(&(velocity.at(&inclusion.center) - flow.at(&place)));
        let gradient = rotation.tr_mul(&(at.velocity_gradient - flow.gradient)) * rotation;
        let motion = packed(&slip, &gradient);
        let load = resisting.act(&motion);
        let volume = inclusion.volume * at.volume_ratio;
        let ambient = (flow.gradient + flow.gradient.transpose()) * (fluid.viscosity * volume);
        let weight = fluid.density * gravity;
        Ok(Some(Self { inclusion, resisting, polar, motion, load, flow: flow.gradient, ambient, volume, weight }))
    }

    /// f and M of the fluid.
    pub fn loads(&self, at: &Gyration) -> Loads {
        let force = self.drag() - self.volume * self.weight;
        Loads { force, moment: self.couple() * at.inverse.transpose() + force * self.inclusion.center.transpose() }
    }

    /// The force of the fluid without the weight of what is displaced \[N\].
    pub fn drag(&self) -> Vec3 {
        self.polar.rotation * parted(&self.load).0
    }

    /// N about the centre of the volume, the stress of the undisturbed flow included \[N m\].
    pub fn couple(&self) -> Mat3 {
        self.shown(&parted(&self.load).1) + self.ambient
    }

    /// The power that the flow past the body turns into heat beyond that of the undisturbed flow \[W\].
    pub fn dissipation(&self) -> f64 {
        -self.load.dot(&self.motion)
    }

    /// V det P \[m³\].
    pub fn volume(&self) -> f64 {
        self.volume
    }

    /// The ellipsoid that stands for it: principal axes in space, and the squares of its semi-axes but for a common
    /// factor.
    pub fn principal(&self) -> (Mat3, [f64; 3]) {
        let ellipsoid = &self.resisting.reference.ellipsoid;
        (self.polar.rotation * ellipsoid.axes, ellipsoid.squares)
    }

    /// A tensor in the axes of space from one in the axes R.
    fn shown(&self, tensor: &Mat3) -> Mat3 {
        self.polar.rotation * tensor * self.polar.rotation.transpose()
    }

    /// Adds f and M and their derivatives.
    pub fn add_to(&self, slopes: &mut LoadSlopes, at: &Gyration) {
        slopes.loads += self.loads(at);
        let (rotation, center) = (&self.polar.rotation, &self.inclusion.center);
        let along = |slip: &Vec3, gradient: &Mat3| {
            let seen = packed(&rotation.tr_mul(slip), &(rotation.tr_mul(gradient) * rotation));
            let (force, couple) = parted(&self.resisting.act(&seen));
            let force = rotation * force;
            Loads { force, moment: self.shown(&couple) * at.inverse.transpose() + force * center.transpose() }
        };
        let mut add = |by_rate: bool, coordinate: usize, slope: &Loads| {
            let matrix = if by_rate { &mut slopes.by_rate } else { &mut slopes.by_place };
            let numbers = numbers(slope);
            let mut column = matrix.column_mut(coordinate);
            column += numbers;
        };
        for axis in 0..3 {
            let still = Mat3::zeros();
            add(true, axis, &along(&Vec3::ith(axis, 1.0), &still));
            add(false, axis, &along(&-self.flow.column(axis), &still));
        }
        let by_strain = self.resisting.slopes_on(&self.motion);
        for coordinate in 3..COORDINATES {
            let change = unit(coordinate - 3);
            add(true, coordinate, &along(&(change * center), &(change * at.inverse)));
            add(false, coordinate, &self.along_gradient(at, &change, &by_strain));
        }
    }

    /// δf and δM along δP.
    fn along_gradient(&self, at: &Gyration, change: &Mat3, by_strain: &[Vec12; 5]) -> Loads {
        let Self { resisting, polar, inclusion, .. } = self;
        let rotation = &polar.rotation;
        let (spread, turn) = (change * at.inverse, cross_matrix(&polar.turn(change)));
        let growth = spread.trace();
        let stretched = rotation.tr_mul(change) - turn * polar.stretch;
        let strain: Strain = resisting.stretch.strain_along(&(stretched / libm::cbrt(at.volume_ratio)));
        // The place and the axes in which the motion is seen, and what resists it.
        let (slip, gradient) = parted(&self.motion);
        let slip_change = -rotation.tr_mul(&(self.flow * (change * inclusion.center))) - turn * slip;
        let gradient_change =
            gradient * turn - turn * gradient - rotation.tr_mul(&(at.velocity_gradient * spread)) * rotation;
        let grown = scales(growth / 6.0, 0.5 * growth);
        let seen = packed(&slip_change, &gradient_change) + grown.component_mul(&self.motion);
        let mut load_change = resisting.act(&seen) + grown.component_mul(&self.load);
        for (slope, part) in by_strain.iter().zip(strain.iter()) {
            load_change += slope * *part;
        }
        let ((force, couple), (force_change, couple_change)) = (parted(&self.load), parted(&load_change));
        let force = rotation * (turn * force + force_change) - (self.volume * growth) * self.weight;
        let couple = self.shown(&(turn * couple - couple * turn + couple_change)) + growth * self.ambient
            - self.couple() * spread.transpose();
        Loads { force, moment: couple * at.inverse.transpose() + force * inclusion.center.transpose() }
    }
}
