//! A body in the fluid: what it has to know of itself, and the loads of the fluid on it.
//!
//!   f = f_d − ρ_f V det P g,   M = Nᵀ P⁻ᵀ + f ⊗ X_c,   Nᵀ = V det P σ      (σ, f_d: `ellipsoid`)
//!
//! X_c is the centre of the volume from the centre of mass; velocities are taken, and the weight of the displaced fluid
//! acts, there. Hydrostatic pressure does not press on the body: it counts as a force. Source: `docs/theory-fluid.md`.

use super::ambient::{Flow, Fluid};
use super::ellipsoid::{FluidEllipsoid, Stress};
use super::fixed::FixedForm;
use super::history::History;
use super::table::{ResistanceTable, UnresolvedForm};
use crate::affine::Gyration;
use crate::inadmissible::Quantity;
use crate::kinematics::{Placement, Velocity};
use crate::load::{COORDINATES, LoadSlopes, Loads, numbers};
use crate::tensor::{Mat3, Vec3};
use std::sync::Arc;

/// The ratio of the longest to the shortest semi-axis above which the rates of an inclusion are not known: its
/// resistances along and across differ by the square, which is most of the digits of a number.
pub const MOST_SLENDER: f64 = 1e6;

/// What makes a body an inclusion.
#[derive(Debug, Clone, PartialEq)]
pub struct Inclusion {
    /// Whether the body has inertia; without, its velocities are those that the balance gives.
    pub inertia: bool,
    /// V, the volume that it displaces \[m³\].
    pub volume: f64,
    /// X_c, the centre of that volume from the centre of mass, in the body's axes \[m\].
    pub center: Vec3,
    /// What the fluid meets.
    pub form: Form,
    /// The history force on a sphere, if that counts; of one that deforms with that of its strain.
    pub history: Option<History>,
    /// R of a rigid sphere about its centre of mass that feels others like it through the fluid \[m\].
    pub neighbours: Option<f64>,
    /// R of a rigid sphere about its centre of mass that feels the planes of the model through the fluid \[m\].
    pub walls: Option<f64>,
}

/// What the fluid meets.
#[derive(Debug, Clone, PartialEq)]
pub enum Form {
    /// A form that does not change.
    Fixed(Box<FixedForm>),
    /// The image of an ellipsoid of these semi-axes \[m\] along the body's axes.
    Ellipsoid(Vec3),
    /// The image of any other shape.
    Surface(SurfaceForm),
}

/// A form of which there is a table; equal if the table is the same one.
#[derive(Debug, Clone)]
pub struct SurfaceForm(pub Arc<ResistanceTable>);

impl PartialEq for SurfaceForm {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

/// A deformable ellipsoid in the fluid at one instant.
#[derive(Debug, Clone, Copy)]
pub struct ImmersedEllipsoid<'a> {
    inclusion: &'a Inclusion,
    semi_axes: &'a Vec3,
    /// Its principal axes and resistance.
    pub ellipsoid: FluidEllipsoid,
    /// Relative velocity of its centre, in the principal axes \[m/s\].
    slip: Vec3,
    /// L in the principal axes \[1/s\].
    gradient: Mat3,
    /// L∞ in the principal axes \[1/s\].
    flow: Mat3,
    /// σ in the principal axes \[Pa\].
    stress: Stress,
    /// V det P \[m³\].
    volume: f64,
    /// ρ_f g \[N/m³\].
    weight: Vec3,
}

impl<'a> ImmersedEllipsoid<'a> {
    /// Of a body in motion; none if its form is fixed.
    ///
    /// # Errors
    /// [`UnresolvedForm`] for a needle or disc beyond [`MOST_SLENDER`].
    pub fn of(
        inclusion: &'a Inclusion,
        (fluid, flow, gravity): (&Fluid, &Flow, &Vec3),
        (placement, velocity): (&Placement, &Velocity),
        at: &Gyration,
    ) -> Result<Option<Self>, UnresolvedForm> {
        let Form::Ellipsoid(semi_axes) = &inclusion.form else { return Ok(None) };
        let ellipsoid = FluidEllipsoid::of(&(at.gradient * Mat3::from_diagonal(semi_axes)), fluid.viscosity);
        let slenderness = ellipsoid.slenderness();
        if slenderness.is_nan() || slenderness > MOST_SLENDER {
            return Err(UnresolvedForm { quantity: Quantity::Slenderness, value: slenderness });
        }
        let place = placement.place(&inclusion.center);
        let slip = ellipsoid.axes.tr_mul(&(velocity.at(&inclusion.center) - flow.at(&place)));
        let gradient = ellipsoid.seen(&at.velocity_gradient);
        let ambient = ellipsoid.seen(&flow.gradient);
        let stress = ellipsoid.stress(&gradient, &ambient);
        let (volume, weight) = (inclusion.volume * at.volume_ratio, fluid.density * gravity);
        Ok(Some(Self { inclusion, semi_axes, ellipsoid, slip, gradient, flow: ambient, stress, volume, weight }))
    }

    /// f and M of the fluid.
    pub fn loads(&self, at: &Gyration) -> Loads {
        let force = self.drag() - self.volume * self.weight;
        let moment = self.couple() * at.inverse.transpose() + force * self.inclusion.center.transpose();
        Loads { force, moment }
    }

    /// f_d \[N\].
    pub fn drag(&self) -> Vec3 {
        self.ellipsoid.axes * self.ellipsoid.force(&self.slip)
    }

    /// Nᵀ about the centre of the volume \[N m\].
    pub fn couple(&self) -> Mat3 {
        self.volume * self.stress()
    }

    /// σ \[Pa\].
    pub fn stress(&self) -> Mat3 {
        self.ellipsoid.shown(&self.stress.total)
    }

    /// The power that the flow past the body turns into heat beyond that of the undisturbed flow \[W\]: −f_d·(U − U∞) −
    /// V det P (σ − 2η sym L∞)·(L − L∞) ≥ 0.
    pub fn dissipation(&self, viscosity: f64) -> f64 {
        let ambient = (self.flow + self.flow.transpose()) * viscosity;
        let couple = (self.stress.total - ambient).dot(&(self.gradient - self.flow));
        -self.ellipsoid.force(&self.slip).dot(&self.slip) - self.volume * couple
    }

    /// Adds f and M and their derivatives.
    pub fn add_to(&self, slopes: &mut LoadSlopes, at: &Gyration) {
        slopes.loads += self.loads(at);
        let center = &self.inclusion.center;
        // About the centre of the volume; then its place p_c = p₀ + P X_c, and M = M_c + f ⊗ X_c.
        let mut add = |by_rate: bool, coordinate: usize, slope: &Loads| {
            let matrix = if by_rate { &mut slopes.by_rate } else { &mut slopes.by_place };
            let full = Loads { force: slope.force, moment: slope.moment + slope.force * center.transpose() };
            let numbers = numbers(&full);
            let mut column = matrix.column_mut(coordinate);
            column += numbers;
        };
        let Self { ellipsoid, flow, .. } = self;
        for axis in 0..3 {
            let seen: Vec3 = ellipsoid.axes.row(axis).transpose();
            let by_rate = Loads { force: ellipsoid.axes * ellipsoid.force(&seen), moment: Mat3::zeros() };
            let by_place = Loads { force: -(ellipsoid.axes * ellipsoid.force(&(flow * seen))), moment: Mat3::zeros() };
            add(true, axis, &by_rate);
            add(false, axis, &by_place);
            for b in 0..3 {
                if center[b] != 0.0 {
                    add(true, 3 + 3 * b + axis, &by_rate.scaled(center[b]));
                    add(false, 3 + 3 * b + axis, &by_place.scaled(center[b]));
                }
            }
        }
        let directions = DerivativeTerms::of(self, at);
        for coordinate in 3..COORDINATES {
            let (j, b) = ((coordinate - 3) % 3, (coordinate - 3) / 3);
            add(false, coordinate, &self.along_gradient(&directions, (j, b)));
            add(true, coordinate, &self.along_rate(&directions, (j, b)));
        }
    }

    /// δf and δσ along each of [`FORMS`].
    fn forms(&self) -> [(Vec3, Mat3); 6] {
        let mut forms = [(Vec3::zeros(), Mat3::zeros()); 6];
        for ((i, j), out) in FORMS.into_iter().zip(&mut forms) {
            let mut change = Mat3::zeros();
            change[(i, j)] = 1.0;
            change[(j, i)] = 1.0;
            let slope = self.ellipsoid.along_form(&change);
            let stress = self.ellipsoid.stress_along(&slope, &self.stress, &self.gradient);
            *out = (self.ellipsoid.force_along(&slope, &self.slip), stress);
        }
        forms
    }

    /// δf and δM_c along δP = e_j ⊗ e_B.
    fn along_gradient(&self, directions: &DerivativeTerms, (j, b): (usize, usize)) -> Loads {
        let Self { ellipsoid, gradient, stress, volume, weight, .. } = self;
        let axis: Vec3 = ellipsoid.axes.row(j).transpose();
        let back = &directions.back[b];
        let (form_drag, form_stress) = directions.along_form(&axis, b);
        // δP P⁻¹ in the principal axes; δL = −L δP P⁻¹.
        let spread = axis * back.transpose();
        let growth = axis.dot(back);
        let stress_change = form_stress - ellipsoid.along_gradient(&(gradient * spread));
        let couple = stress.total * growth + stress_change - stress.total * spread.transpose();
        let drag = ellipsoid.axes * form_drag;
        Loads { force: drag - (volume * growth) * weight, moment: directions.moment(&couple, *volume) }
    }

    /// δM_c along δṖ = e_j ⊗ e_B.
    fn along_rate(&self, directions: &DerivativeTerms, (j, b): (usize, usize)) -> Loads {
        let axis: Vec3 = self.ellipsoid.axes.row(j).transpose();
        let change = self.ellipsoid.along_gradient(&(axis * directions.back[b].transpose()));
        Loads { force: Vec3::zeros(), moment: directions.moment(&change, self.volume) }
    }

    /// V det P \[m³\].
    pub fn volume(&self) -> f64 {
        self.volume
    }
}

/// The entries of a symmetric tensor.
const FORMS: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)];

/// What the columns of the derivative have in common; in the principal axes N.
struct DerivativeTerms {
    /// Nᵀ P A² e_B.
    swept: [Vec3; 3],
    /// Nᵀ P⁻ᵀ e_B.
    back: [Vec3; 3],
    /// N and P⁻¹ N.
    axes: Mat3,
    carried: Mat3,
    /// δf and δσ along each symmetric δQ of one entry, or of one and its mirror image.
    forms: [(Vec3, Mat3); 6],
}

impl DerivativeTerms {
    fn of(body: &ImmersedEllipsoid, at: &Gyration) -> Self {
        let axes = &body.ellipsoid.axes;
        let swept = axes.tr_mul(&(at.gradient * Mat3::from_diagonal(&body.semi_axes.component_mul(body.semi_axes))));
        let carried = at.inverse * axes;
        let column = |matrix: &Mat3, b: usize| matrix.column(b).into_owned();
        let back = carried.transpose();
        Self {
            swept: [column(&swept, 0), column(&swept, 1), column(&swept, 2)],
            back: [column(&back, 0), column(&back, 1), column(&back, 2)],
            axes: *axes,
            carried,
            forms: body.forms(),
        }
    }

    /// δf and δσ along δP = e_j ⊗ e_B: δQ = e_j ⊗ (P A² e_B) and its mirror image; `axis` is e_j in the principal axes.
    fn along_form(&self, axis: &Vec3, b: usize) -> (Vec3, Mat3) {
        let swept = &self.swept[b];
        let (mut force, mut stress) = (Vec3::zeros(), Mat3::zeros());
        for ((i, j), (drag, change)) in FORMS.into_iter().zip(&self.forms) {
            // Twice the entry on the diagonal, where it is its own mirror image.
            let entry = axis[i] * swept[j] + axis[j] * swept[i];
            force += entry * drag;
            stress += entry * change;
        }
        (force, stress)
    }

    /// V det P X P⁻ᵀ of an X in the principal axes.
    fn moment(&self, couple: &Mat3, volume: f64) -> Mat3 {
        volume * self.axes * couple * self.carried.transpose()
    }
}
