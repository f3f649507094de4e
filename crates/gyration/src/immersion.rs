//! What a fluid and a body in it do to each other: forces, stresses, and what suspensions are described by.
//!
//!   N = ∫ (x − x_c) ⊗ t dA,   V_t = V det P,   Σ = Nᵀ/V_t − 2η sym L           (particle stress, per volume of particle)
//!   stresslet = V_t dev sym Σ,   rotlet_i = ε_ijk N_jk
//!   [η] = Σ·E∞/(2η E∞·E∞),   N₁ = Σ_ee − Σ_gg,   N₂ = Σ_gg − Σ_vv            (to be multiplied with the volume fraction)
//!
//! t is the whole traction of the fluid, with the stress of the undisturbed flow, E∞ = sym L∞. In a simple shear L∞ =
//! γ̇ e ⊗ g, v = e × g, the longest axis a is inclined by atan(a·g/a·e), and a body of revolution with axis p and
//! aspect ratio r moves on an orbit C = √((p·g)² + (p·e)²/r²)/|p·v| (Leal and Hinch), told as C/(1 + C). What does not
//! apply is NaN. Source: Batchelor (1970); `docs/theory-fluid.md`.

use crate::dynamics::{RigidImmersion, Scratch, beside_walls, history_reaction, immersion};
use crate::fluid::{Fluid, HistoryReaction, Immersed};
use crate::inadmissible::Inadmissible;
use crate::instant::{BodyAt, KindAt, MotionAt};
use crate::state::{BodyMotion, Turn};
use crate::tensor::{Mat3, Vec3, axial, cross_matrix};

/// What is told of an inclusion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImmersionObservation {
    /// Force of the fluid without the weight of what is displaced \[N\].
    pub drag: Vec3,
    /// Torque of the fluid about the centre of the volume \[N m\].
    pub rotlet: Vec3,
    /// Stresslet \[N m\], symmetric and traceless.
    pub stresslet: Mat3,
    /// Σ \[Pa\].
    pub particle_stress: Mat3,
    /// \[η\], the increment of the viscosity of a dilute suspension over η and the volume fraction.
    pub intrinsic_viscosity: f64,
    /// N₁ and N₂ over the volume fraction \[Pa\].
    pub normal_stress_differences: [f64; 2],
    /// What the disturbance of the flow turns into heat beyond that of the undisturbed flow \[W\].
    pub dissipated_power: f64,
    /// Semi-axes of an ellipsoid, descending \[m\].
    pub semi_axes: Vec3,
    /// Angle of the longest axis from the direction of a simple shear, in its plane \[rad\].
    pub inclination: f64,
    /// C/(1 + C) of a body of revolution in simple shear.
    pub orbit_constant: f64,
}

/// The traction of the fluid on a body.
struct Tractions {
    drag: Vec3,
    /// Nᵀ about the centre of the volume.
    couple: Mat3,
    volume: f64,
    dissipation: f64,
    /// Principal axes and semi-axes of an ellipsoid, or of that which has the second moments of a body that deforms.
    form: Option<(Mat3, [f64; 3])>,
    is_ellipsoid: bool,
}

/// Observes one body; none if it is not immersed.
///
/// # Errors
/// [`Inadmissible`] where the state is outside the model.
pub fn observe_immersion(at: &BodyAt, scratch: &mut Scratch) -> Result<Option<ImmersionObservation>, Inadmissible> {
    let Some(fluid) = &at.model.fluid else { return Ok(None) };
    let tractions = match at.kind() {
        KindAt::Rigid(_, turn) => rigid(at, turn)?,
        KindAt::Affine(..) | KindAt::Contractile(..) => deformable(at, fluid)?,
    };
    let remembered = history_reaction(at, scratch)?;
    let tractions = tractions.map(|tractions| tractions.with(remembered.as_ref()));
    Ok(tractions.map(|tractions| told(fluid, at.time, at.motion, &tractions)))
}

impl Tractions {
    /// With those of the history, if the body has one.
    fn with(self, history: Option<&HistoryReaction>) -> Self {
        let Some(history) = history else { return self };
        Self { drag: self.drag + history.force, couple: self.couple + history.couple, ..self }
    }
}

fn rigid(at: &BodyAt, turn: &Turn) -> Result<Option<Tractions>, Inadmissible> {
    let (Some(inclusion), Some(immersed)) = (&at.body.inclusion, RigidImmersion::of(at)) else { return Ok(None) };
    let rotation = &at.motion.placement.gradient;
    let steady = immersed.drag.force();
    let arm = rotation * inclusion.center;
    let (mut force, mut torque) = (Vec3::zeros(), Vec3::zeros());
    let mut dissipation = immersed.drag.dissipation(&turn.spin);
    if let Some(radius) = inclusion.walls {
        let walls = beside_walls(at, radius)?;
        force += walls.wrench().0;
        torque += walls.wrench().1;
        dissipation += walls.dissipation();
    }
    if let Some(place) = at.model.spheres().and_then(|spheres| spheres.place(at.index)) {
        let (felt, turned) = at.spheres().wrench(place);
        force += felt;
        torque += turned;
        dissipation += at.spheres().dissipation(place);
    }
    Ok(Some(Tractions {
        drag: steady + force,
        // The axial part of [T]×/2 is T.
        couple: immersed.drag.couple() + immersed.ambient - steady * arm.transpose() + 0.5 * cross_matrix(&torque),
        volume: inclusion.volume,
        dissipation,
        form: at.body.solid.shape.semi_axes().map(|axes| (*rotation, axes.into())),
        is_ellipsoid: true,
    }))
}

fn deformable(at: &MotionAt, fluid: &Fluid) -> Result<Option<Tractions>, Inadmissible> {
    let Some(immersed) = immersion(at)? else { return Ok(None) };
    let (axes, squares) = immersed.principal();
    Ok(Some(Tractions {
        drag: immersed.drag(),
        couple: immersed.couple(),
        volume: immersed.volume(),
        dissipation: immersed.dissipation(fluid.viscosity),
        form: Some((axes, squares.map(f64::sqrt))),
        is_ellipsoid: matches!(immersed, Immersed::Ellipsoid(_)),
    }))
}

fn told(fluid: &Fluid, time: f64, motion: &BodyMotion, tractions: &Tractions) -> ImmersionObservation {
    let flow = fluid.flow(time).gradient;
    let inverse = motion.placement.gradient.try_inverse().unwrap_or(Mat3::from_element(f64::NAN));
    let gradient = motion.velocity.gradient_rate * inverse;
    let particle_stress = tractions.couple / tractions.volume - (gradient + gradient.transpose()) * fluid.viscosity;
    let symmetric = 0.5 * (particle_stress + particle_stress.transpose());
    let stresslet = symmetric - Mat3::from_diagonal_element(symmetric.trace() / 3.0);
    let strain = 0.5 * (flow + flow.transpose());
    let shear = Shear::of(&flow);
    let along = |direction: &Vec3| direction.dot(&(symmetric * direction));
    let differences = shear.as_ref().map_or([f64::NAN; 2], |Shear { flow, gradient, vorticity }| {
        [along(flow) - along(gradient), along(gradient) - along(vorticity)]
    });
    let form = tractions.form.map(|(axes, lengths)| Axes::sorted(&axes, lengths));
    let seen = form.as_ref().zip(shear.as_ref());
    // Of any other shape, only the direction of its longest axis has a meaning.
    let exact = form.as_ref().filter(|_| tractions.is_ellipsoid);
    ImmersionObservation {
        drag: tractions.drag,
        rotlet: axial(&tractions.couple),
        stresslet: tractions.volume * stresslet,
        particle_stress,
        intrinsic_viscosity: particle_stress.dot(&strain) / (2.0 * fluid.viscosity * strain.norm_squared()),
        normal_stress_differences: differences,
        dissipated_power: tractions.dissipation,
        semi_axes: exact.map_or(Vec3::from_element(f64::NAN), |form| form.lengths.into()),
        inclination: seen.map_or(f64::NAN, |(form, shear)| form.inclination(shear)),
        orbit_constant: exact.zip(shear.as_ref()).map_or(f64::NAN, |(form, shear)| form.orbit(shear)),
    }
}

/// L∞ = γ̇ e ⊗ g: unit vectors e, g and v = e × g.
struct Shear {
    flow: Vec3,
    gradient: Vec3,
    vorticity: Vec3,
}

/// What of a flow is no simple shear may be rounding of its numbers.
const ROUNDING: f64 = 1e-9;

impl Shear {
    /// None of any other flow.
    fn of(gradient: &Mat3) -> Option<Self> {
        let rate = gradient.norm();
        let column = (0..3).map(|k| gradient.column(k).into_owned()).max_by(|a, b| a.norm().total_cmp(&b.norm()))?;
        let flow = column.try_normalize(0.0)?;
        let across = gradient.tr_mul(&flow) / rate;
        let rest = gradient - rate * flow * across.transpose();
        (rest.norm() <= ROUNDING * rate && flow.dot(&across).abs() <= ROUNDING).then(|| Self {
            flow,
            gradient: across,
            vorticity: flow.cross(&across),
        })
    }
}

/// Principal axes by length, descending.
struct Axes {
    directions: [Vec3; 3],
    lengths: [f64; 3],
}

/// Lengths whose ratio differs from one by less are equal: a direction between them has no meaning.
const EQUAL: f64 = 1e-6;

impl Axes {
    fn sorted(axes: &Mat3, lengths: [f64; 3]) -> Self {
        let mut order = [0, 1, 2];
        order.sort_by(|a, b| lengths[*b].total_cmp(&lengths[*a]));
        Self { directions: order.map(|k| axes.column(k).into_owned()), lengths: order.map(|k| lengths[k]) }
    }

    fn are_equal(&self, one: usize, other: usize) -> bool {
        (self.lengths[one] / self.lengths[other] - 1.0).abs() < EQUAL
    }

    /// In (−π/2, π/2]; of the part in the plane of the shear.
    fn inclination(&self, shear: &Shear) -> f64 {
        if self.are_equal(0, 1) {
            return f64::NAN;
        }
        let [along, across] = [self.directions[0].dot(&shear.flow), self.directions[0].dot(&shear.gradient)];
        if libm::hypot(along, across) < EQUAL {
            return f64::NAN;
        }
        let angle = libm::atan2(across, along);
        let half = std::f64::consts::FRAC_PI_2;
        if angle > half {
            angle - 2.0 * half
        } else if angle <= -half {
            angle + 2.0 * half
        } else {
            angle
        }
    }

    fn orbit(&self, shear: &Shear) -> f64 {
        let axis = match (self.are_equal(0, 1), self.are_equal(1, 2)) {
            (true, false) => 2,
            (false, true) => 0,
            _ => return f64::NAN,
        };
        let (p, ratio) = (&self.directions[axis], self.lengths[axis] / self.lengths[1]);
        let plane = libm::hypot(p.dot(&shear.gradient), p.dot(&shear.flow) / ratio);
        plane / (plane + p.dot(&shear.vorticity).abs())
    }
}
