//! A form that does not change: its resistance is one matrix in the axes of the body.
//!
//!   (f; Nᵀ row by row) = −η H (v − u∞; L − L∞ row by row),   N = ∫ (x − p₀) ⊗ t dA
//!
//! H symmetric, positive definite, for viscosity 1, about the centre of mass. In its own axes v′ = Rᵀ(v − u∞), L′ =
//! [Ω]× − RᵀL∞R, and the torque about the axes of the body is the axial part of N′ᵀ. The stress of the undisturbed flow
//! is symmetric and the same everywhere: it turns and moves nothing. Source: `docs/theory-fluid.md`.

use super::ambient::{Flow, Fluid};
use super::ellipsoid::FluidEllipsoid;
use crate::kinematics::{Placement, Velocity};
use crate::load::{Mat12, Wrench, WrenchSlope};
use crate::tensor::{Mat3, Vec3, axial, cross_matrix};
use nalgebra::SVector;

type Vec12 = SVector<f64, 12>;

/// The resistance of a form that does not change.
#[derive(Debug, Clone, PartialEq)]
pub struct FixedForm {
    /// H, in the axes of the body.
    pub matrix: Mat12,
    /// Estimated relative error of the power of any motion; 0 of a closed form.
    pub error: f64,
}

/// (v; L row by row).
pub(super) fn packed(velocity: &Vec3, gradient: &Mat3) -> Vec12 {
    Vec12::from_iterator(velocity.iter().chain(gradient.transpose().iter()).copied())
}

/// The two parts of (f; Nᵀ row by row).
pub(super) fn parted(numbers: &Vec12) -> (Vec3, Mat3) {
    (numbers.fixed_rows::<3>(0).into(), Mat3::from_row_iterator(numbers.iter().skip(3).copied()))
}

/// The wrench of a fluid on a rigid body, and what its derivative needs again.
#[derive(Debug, Clone, Copy)]
pub struct RigidDrag<'a> {
    form: &'a FixedForm,
    viscosity: f64,
    rotation: Mat3,
    /// v′.
    slip: Vec3,
    /// RᵀL∞R.
    flow: Mat3,
    /// L∞.
    gradient: Mat3,
    /// f and Nᵀ in the axes of the body.
    load: (Vec3, Mat3),
}

/// The wrench and its derivatives by the place, the turn, the velocity and the spin of a rigid body.
#[derive(Debug, Clone, Copy)]
pub struct DragSlopes {
    /// By δp₀.
    pub by_place: WrenchSlope,
    /// By δθ.
    pub by_turn: WrenchSlope,
    /// By δṗ₀.
    pub by_velocity: WrenchSlope,
    /// By δΩ.
    pub by_spin: WrenchSlope,
}

impl FixedForm {
    /// A form of resistance H about its own centre, which lies at `center` \[m\] from the centre of mass.
    pub fn shifted(matrix: &Mat12, center: &Vec3) -> Self {
        // v_c = v + L c, and the load about the centre of mass is Nᵀ + f ⊗ c: H = Tᵀ H_c T.
        let mut shift = Mat12::identity();
        for i in 0..3 {
            for j in 0..3 {
                shift[(i, 3 + 3 * i + j)] = center[j];
            }
        }
        let moved = shift.transpose() * matrix * shift;
        Self { matrix: 0.5 * (moved + moved.transpose()), error: 0.0 }
    }

    /// The resistance of an ellipsoid about its centre, for viscosity 1.
    pub fn of_ellipsoid(semi_axes: &Vec3) -> Mat12 {
        Self::of(&FluidEllipsoid::new((*semi_axes).into(), 1.0))
    }

    /// The same of the image of an ellipsoid of semi-axes A under P, `carried` = P A \[m\], in the axes of space.
    pub fn of_image(carried: &Mat3) -> Mat12 {
        Self::of(&FluidEllipsoid::of(carried, 1.0))
    }

    pub(super) fn of(ellipsoid: &FluidEllipsoid) -> Mat12 {
        let [a, b, c] = ellipsoid.squares;
        let volume = 4.0 / 3.0 * std::f64::consts::PI * (a * b * c).sqrt();
        let mut matrix = Mat12::zeros();
        for place in 0..12 {
            let (velocity, gradient) = parted(&Vec12::ith(place, 1.0));
            let stress = ellipsoid.stress(&ellipsoid.seen(&gradient), &Mat3::zeros()).total;
            let force = ellipsoid.axes * ellipsoid.force(&ellipsoid.axes.tr_mul(&velocity));
            matrix.set_column(place, &-packed(&force, &(volume * ellipsoid.shown(&stress))));
        }
        0.5 * (matrix + matrix.transpose())
    }

    /// −η H x.
    fn act(&self, viscosity: f64, velocity: &Vec3, gradient: &Mat3) -> (Vec3, Mat3) {
        parted(&(self.matrix * packed(velocity, gradient) * -viscosity))
    }

    /// The wrench of the fluid on a body in motion.
    pub fn drag(
        &self,
        (fluid, flow): (&Fluid, &Flow),
        (placement, velocity): (&Placement, &Velocity),
        spin: &Vec3,
    ) -> RigidDrag<'_> {
        let rotation = placement.gradient;
        let slip = rotation.tr_mul(&(velocity.velocity - flow.at(&placement.position)));
        let seen = rotation.tr_mul(&flow.gradient) * rotation;
        let load = self.act(fluid.viscosity, &slip, &(cross_matrix(spin) - seen));
        RigidDrag { form: self, viscosity: fluid.viscosity, rotation, slip, flow: seen, gradient: flow.gradient, load }
    }
}

impl RigidDrag<'_> {
    /// Force, in the axes of space, and torque about the centre of mass, in those of the body.
    pub fn wrench(&self) -> Wrench {
        Wrench { force: self.force(), torque: axial(&self.load.1) }
    }

    /// f \[N\].
    pub fn force(&self) -> Vec3 {
        self.rotation * self.load.0
    }

    /// Nᵀ about the centre of mass, without the stress of the undisturbed flow \[N m\].
    pub fn couple(&self) -> Mat3 {
        self.rotation * self.load.1 * self.rotation.transpose()
    }

    /// The power that the flow past the body turns into heat beyond that of the undisturbed flow \[W\].
    pub fn dissipation(&self, spin: &Vec3) -> f64 {
        -self.load.0.dot(&self.slip) - self.load.1.dot(&(cross_matrix(spin) - self.flow))
    }

    /// The change of the wrench with v′ and L′.
    fn along(&self, velocity: &Vec3, gradient: &Mat3) -> Wrench {
        let (force, couple) = self.form.act(self.viscosity, velocity, gradient);
        Wrench { force: self.rotation * force, torque: axial(&couple) }
    }

    /// The derivatives of the wrench.
    pub fn slopes(&self) -> DragSlopes {
        let Self { rotation, slip, flow, gradient, .. } = self;
        let still = Mat3::zeros();
        let each = |change: &dyn Fn(&Vec3) -> Wrench| {
            let (x, y, z) = (change(&Vec3::x()), change(&Vec3::y()), change(&Vec3::z()));
            WrenchSlope {
                force: Mat3::from_columns(&[x.force, y.force, z.force]),
                torque: Mat3::from_columns(&[x.torque, y.torque, z.torque]),
            }
        };
        let by_turn = each(&|turn| {
            let across = cross_matrix(turn);
            // v′ and L∞ are seen from axes that turn, and the force turns with them.
            let mut change = self.along(&slip.cross(turn), &(across * flow - flow * across));
            change.force += rotation * turn.cross(&self.load.0);
            change
        });
        DragSlopes {
            by_place: each(&|place| self.along(&-rotation.tr_mul(&(gradient * place)), &still)),
            by_turn,
            by_velocity: each(&|velocity| self.along(&rotation.tr_mul(velocity), &still)),
            by_spin: each(&|spin| self.along(&Vec3::zeros(), &cross_matrix(spin))),
        }
    }
}
