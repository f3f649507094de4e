//! Where a body rests over a support, and how fast it gets there.
//!
//! The body is moved along the support's normal without turning. At a gap d the central laws push with F(d) [N]; it
//! rests where F(d) = W, W = −m g·n, and stably so where k = −F'(d) > 0. There, with the resistances c (along n) and
//! c_t (across) of damping and friction,
//!
//!   period 2π/ω, ω² = k/m;   damping ratio ζ = c/(2 m ω);   decay time 1/(ζω) for ζ < 1, of the slower of two
//!   exponentials 1/(ω(ζ − √(ζ²−1))) else;   friction m/c_t
//!
//! F comes from the loads of the contacts without velocity, k, c and c_t from their derivatives. With adhesion there
//! may be several such gaps, or none. On a slope the body goes on: one whose face keeps it from turning slides at the
//! speed
//!
//!   v = m |g_t|/c_t,   g_t = g − n (n·g),
//!
//! at which friction carries the weight's part along it, or at that of `slip` under a bound on friction; one that is
//! round along the slope rolls. A body that something else holds too, a pin, a spring, another support, rests
//! elsewhere: no such gap is then given, but the reason why not. Where more than contacts resists it only the gap is. A
//! body that deforms keeps the P of its start here; where it really rests, deformed by its weight, is its rest state
//! (`modes`).

use super::balance::TrialGaps;
use super::slip::Slip;
use gyration::body::Body;
use gyration::contact::{
    Contact, ContactLoads, ContactScratch, ContactSlopes, Deformation, LawKind, Meeting, RelativeMotion, Term,
};
use gyration::load::Party;
use gyration::load::{LoadSlopes, Loads, OwnForces};
use gyration::model::Model;
use gyration::state::State;
use gyration::surface::{GapField, Surface};
use gyration::tensor::{Mat3, Vec3, cross_matrix};
use nalgebra::{SMatrix, SVector};
use serde::Serialize;
use std::f64::consts::TAU;

/// Gaps between these fractions of the size are searched for a balance, where surfaces keep the digits of small ones.
const SEARCHED: (f64, f64) = (1e-15, 1e3);
/// The least such fraction elsewhere.
const LEAST_ELSEWHERE: f64 = 1e-9;
/// The part of gravity along a support that is rounding.
const LEVEL: f64 = 1e-12;
/// A stiffness against turning below this part of that along the normal times the square of the size is none.
const ROUND: f64 = 1e-6;

/// A gap at which the weight is carried.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RestGap {
    /// d [m].
    pub gap: f64,
    /// Whether the body comes back to it.
    pub stable: bool,
    /// k = −F'(d) [N/m].
    pub stiffness: f64,
    /// Period of the oscillation about it without damping [s]; none where it is not stable.
    pub period: Option<f64>,
    /// ζ, the part of the critical damping; none without damping or where it is not stable.
    pub damping_ratio: Option<f64>,
    /// Time in which the oscillation, or what is left of it, falls to 1/e [s].
    pub damping_time: Option<f64>,
    /// Time in which sliding falls to 1/e [s]; none without friction.
    pub friction_time: Option<f64>,
    /// What friction does; none without friction.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub slip: Option<Slip>,
    /// What the body does along the support; none of one that is level.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub descent: Option<Descent>,
}

/// How a body goes down a slope.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Descent {
    /// It slides at this speed [m/s] in the end.
    Slides {
        /// v [m/s].
        speed: f64,
    },
    /// It slides faster and faster [m/s²]: there is no friction, or not enough.
    Accelerates {
        /// |g_t|, less what friction holds [m/s²].
        acceleration: f64,
    },
    /// Nothing keeps it from turning down the slope: it is round, or stands on an edge.
    Rolls,
}

impl Descent {
    /// v [m/s] of a body that slides at a speed in the end.
    pub fn speed(&self) -> Option<f64> {
        match self {
            Self::Slides { speed } => Some(*speed),
            Self::Accelerates { .. } | Self::Rolls => None,
        }
    }
}

/// A body that approaches a support along its normal, in the orientation of the start.
#[derive(Debug, Clone)]
pub struct Approach<'a> {
    surface: &'a Surface,
    contacts: Vec<&'a Contact>,
    /// n.
    normal: Vec3,
    /// Pᵀn.
    direction: Vec3,
    /// P.
    gradient: Mat3,
    /// How the surface is deformed, if the body may be.
    deformation: Option<Deformation>,
    mass: f64,
    /// J [kg m²].
    euler: Mat3,
    /// g_t.
    along: Vec3,
    size: f64,
    /// Whether more than contacts resists it: what it then does about its rest is not told.
    is_resisted: bool,
    /// Whether gaps far below the size are known.
    keeps_digits: bool,
    /// W = −m g·n [N].
    pub weight: f64,
    /// Smallest distance at the start [m].
    pub initial_gap: f64,
    /// Why the balance on this support alone does not tell where the body rests.
    pub no_rest_because: Option<&'static str>,
}

impl<'a> Approach<'a> {
    /// Of a body to a support; none for mass points.
    pub fn new(model: &'a Model, start: &State, index: usize, support: usize) -> Option<Self> {
        let motion = start.motion(model, index);
        let (body, plane) = (&model.bodies[index], &model.supports[support]);
        let surface = body.solid.surface.as_ref()?;
        let direction = motion.placement.gradient.tr_mul(&plane.normal);
        let height = plane.gap(&motion.placement.position, start.time);
        let (initial_gap, _) = surface.smallest_gap(&GapField::new(height, direction));
        Some(Self {
            surface,
            contacts: model.contacts_of(index).filter(|contact| contact.support == support).collect(),
            normal: plane.normal,
            direction,
            gradient: motion.placement.gradient,
            deformation: body.affine().and_then(|_| Deformation::of(&motion.placement.gradient)),
            mass: body.solid.mass.mass,
            euler: body.solid.mass.euler_tensor,
            along: along_plane(&model.gravity, &plane.normal),
            size: body.size,
            is_resisted: is_resisted(body),
            keeps_digits: body.keeps_digits(surface),
            weight: -body.solid.mass.mass * model.gravity.dot(&plane.normal),
            initial_gap,
            no_rest_because: held_otherwise(model, index),
        })
    }

    /// The contacts of both.
    pub(super) fn contacts(&self) -> &[&'a Contact] {
        &self.contacts
    }

    /// n.
    pub(super) fn normal(&self) -> &Vec3 {
        &self.normal
    }

    /// P.
    pub(super) fn gradient(&self) -> &Mat3 {
        &self.gradient
    }

    /// m [kg].
    pub(super) fn mass(&self) -> f64 {
        self.mass
    }

    /// The moment of inertia about an axis through the centre [kg m²].
    pub(super) fn inertia_about(&self, axis: &Vec3) -> f64 {
        let spatial = self.gradient * self.euler * self.gradient.transpose();
        spatial.trace() - axis.dot(&(spatial * axis))
    }

    /// Whether a stiffness against turning [N m] is none beside that along the normal [N/m].
    pub(super) fn is_round(&self, turning: f64, stiffness: f64) -> bool {
        turning <= ROUND * stiffness * self.size.powi(2)
    }

    /// Whether any law acts.
    pub fn acts(&self) -> bool {
        self.contacts.iter().any(|contact| !contact.law_set.laws().is_empty())
    }

    /// The largest side of the body [m].
    pub fn size(&self) -> f64 {
        self.size
    }

    /// F(d) of the central laws [N]; none where it cannot be computed.
    pub fn force(&self, gap: f64) -> Option<f64> {
        let mut scratch = ContactScratch::default();
        let contact_state = self.contact_state(gap);
        let loads =
            self.contacts.iter().map(|contact| ContactLoads::integrate(&contact.law_set, &contact_state, &mut scratch));
        let total = loads.map(|loads| loads.ok().map(|loads| loads.total())).sum::<Option<Loads>>()?;
        Some(total.force.dot(&self.normal)).filter(|force| force.is_finite())
    }

    /// The body at a gap, without velocity.
    pub(super) fn contact_state(&self, gap: f64) -> Meeting<'a> {
        Meeting {
            surface: self.surface,
            field: self.surface.field_at(gap, self.direction),
            motion: RelativeMotion { normal: self.normal, velocity: Vec3::zeros(), gradient_rate: Mat3::zeros() },
            deformation: self.deformation,
        }
    }

    /// (f | M) of all laws and their derivatives by (p₀ | P) and the rates; none where they are not numbers.
    fn slopes(&self, gap: f64) -> Option<LoadSlopes> {
        let (mut scratch, contact_state) = (ContactScratch::default(), self.contact_state(gap));
        let mut slopes = LoadSlopes::default();
        for contact in &self.contacts {
            ContactSlopes::integrate(&contact.law_set, &contact_state, &mut scratch).ok()?.add_to(&mut slopes);
        }
        let mut entries = slopes.by_place.iter().chain(slopes.by_rate.iter());
        entries.all(|entry| entry.is_finite()).then_some(slopes)
    }

    /// All gaps at which the weight is carried, ascending; none for a body that is held otherwise as well.
    pub fn rests(&self) -> Vec<RestGap> {
        if !self.acts() || self.no_rest_because.is_some() {
            return Vec::new();
        }
        let least = if self.keeps_digits { SEARCHED.0 } else { LEAST_ELSEWHERE };
        let trials = TrialGaps::between(least * self.size, SEARCHED.1 * self.size);
        let balance = |gap: f64| Some(self.force(gap)? - self.weight);
        let roots = if self.only_pushes() { trials.root_of_falling(balance) } else { trials.roots(balance) };
        roots.into_iter().filter_map(|root| self.rest_at(root)).collect()
    }

    /// Whether F(d) falls with the gap: all central terms push.
    fn only_pushes(&self) -> bool {
        let laws = self.contacts.iter().flat_map(|contact| contact.law_set.laws());
        let mut central = laws.filter(|law| law.kind().is_central()).flat_map(|law| law.terms()).flatten();
        central.all(|term| term.coefficient >= 0.0)
    }

    /// Whether any law resists what moves across the normal: of a resistance along it alone rounding is left there.
    fn resists_sliding(&self) -> bool {
        let laws = self.contacts.iter().flat_map(|contact| contact.law_set.laws());
        laws.filter(|law| law.kind() == LawKind::Friction).flat_map(|law| law.terms()).flatten().any(acts)
    }

    /// What the body does along a slope, where the laws have these slopes and this stiffness along n.
    fn descent(&self, gap: f64, slopes: &LoadSlopes, stiffness: f64) -> Option<Descent> {
        let down = self.along.try_normalize(0.0)?;
        let (acceleration, resistance) = (self.along.norm(), against(&slopes.by_rate, &down));
        if !self.resists_sliding() || resistance <= 0.0 {
            return Some(Descent::Accelerates { acceleration });
        }
        if self.is_round(self.turning_stiffness(slopes, &self.normal.cross(&down)), stiffness) {
            return Some(Descent::Rolls);
        }
        let viscous = self.mass * acceleration / resistance;
        let Some(most) = self.most_friction(gap) else { return Some(Descent::Slides { speed: viscous }) };
        let part = self.mass * acceleration / most;
        Some(match part < 1.0 {
            true => Descent::Slides { speed: viscous / (1.0 - part * part).sqrt() },
            false => Descent::Accelerates { acceleration: acceleration - most / self.mass },
        })
    }

    /// d²U/dθ² of a turn about an axis through the centre [N m]: P = exp(θ[a]×) P₀ has δP = [a]× P₀, δ²P = [a]×² P₀.
    pub(super) fn turning_stiffness(&self, slopes: &LoadSlopes, axis: &Vec3) -> f64 {
        let (turn, bend) = (cross_matrix(axis) * self.gradient, cross_matrix(axis).pow(2) * self.gradient);
        let change = slopes.by_place.fixed_view::<9, 9>(3, 3) * SVector::<f64, 9>::from_column_slice(turn.as_slice());
        0.0 - turn.dot(&Mat3::from_column_slice(change.as_slice())) - bend.dot(&slopes.loads.moment)
    }

    fn rest_at(&self, gap: f64) -> Option<RestGap> {
        let slopes = self.slopes(gap)?;
        // Any direction across the normal.
        let across = self.normal.cross(&Vec3::ith(self.normal.iamin(), 1.0)).normalize();
        let stiffness = against(&slopes.by_place, &self.normal);
        let normal_resistance = against(&slopes.by_rate, &self.normal);
        let slides = self.resists_sliding() && !self.is_resisted;
        let tangential_resistance = if slides { against(&slopes.by_rate, &across) } else { 0.0 };
        let stable = stiffness > 0.0;
        let frequency = stable.then(|| (stiffness / self.mass).sqrt());
        let damped = frequency.filter(|_| normal_resistance > 0.0 && !self.is_resisted);
        let ratio = damped.map(|frequency| normal_resistance / (2.0 * self.mass * frequency));
        Some(RestGap {
            gap,
            stable,
            stiffness,
            period: frequency.map(|frequency| TAU / frequency),
            damping_ratio: ratio,
            damping_time: frequency.zip(ratio).map(|(frequency, ratio)| decay_time(frequency, ratio)),
            friction_time: (tangential_resistance > 0.0).then(|| self.mass / tangential_resistance),
            slip: self.slip(gap, &slopes, tangential_resistance, stiffness),
            descent: if self.is_resisted { None } else { self.descent(gap, &slopes, stiffness) },
        })
    }
}

/// −e·∂f e, by the centre's place [N/m] or velocity [N s/m].
fn against(by: &SMatrix<f64, 12, 12>, direction: &Vec3) -> f64 {
    0.0 - direction.dot(&(by.fixed_view::<3, 3>(0, 0) * direction))
}

/// g_t; nothing where it is rounding.
fn along_plane(gravity: &Vec3, normal: &Vec3) -> Vec3 {
    let along = gravity - normal * normal.dot(gravity);
    if along.norm() <= LEVEL * gravity.norm() { Vec3::zeros() } else { along }
}

/// What holds a body besides a single support, in words.
fn held_otherwise(model: &Model, index: usize) -> Option<&'static str> {
    let body = &model.bodies[index];
    let acts = |contact: &&Contact| contact.law_set.laws().iter().flat_map(|law| law.terms()).flatten().any(acts);
    let mut supports = model.contacts_of(index).filter(acts).map(|contact| contact.support);
    let first = supports.next();
    if body.pin.is_some() {
        Some("a pin holds the body as well")
    } else if body.guide.is_some() {
        Some("a constraint, `keep`, holds the body as well")
    } else if model.joints_of(index).next().is_some() {
        Some("a joint holds the body as well")
    } else if model.meets_bodies(index) {
        Some("other bodies meet it as well")
    } else if model.has_pairs(index) {
        Some("supports with a shape meet it as well")
    } else if model.springs_of(index).any(|end| end.other() == Party::Space) || model.is_joined(index) {
        Some("springs pull at the body as well")
    } else if body.inclusion.is_some() {
        Some("the fluid acts on the body as well")
    } else if body.own.hold() {
        Some("forces of its own act on the body as well")
    } else if body.affine().is_some_and(|affine| affine.couple.is_some()) {
        Some("a couple acts on the body as well")
    } else if supports.any(|support| Some(support) != first) {
        Some("the laws of other supports act on the body as well")
    } else {
        None
    }
}

/// Whether more than contacts resists the way of a body's centre.
fn is_resisted(body: &Body) -> bool {
    let OwnForces { resistance, frictions, absorption, .. } = &body.own;
    let of_its_own = resistance.is_some() || !frictions.is_empty() || absorption.is_some();
    of_its_own || body.affine().is_some_and(|affine| !affine.resistances.is_empty())
}

fn acts(term: Term) -> bool {
    term.coefficient != 0.0
}

/// The time constant [s] of an oscillator of angular frequency ω [rad/s] and damping ratio ζ, that of its slowest part.
fn decay_time(frequency: f64, ratio: f64) -> f64 {
    if ratio < 1.0 {
        return 1.0 / (ratio * frequency);
    }
    // ζ − √(ζ²−1) without cancellation.
    (ratio + (ratio * ratio - 1.0).sqrt()) / frequency
}

#[cfg(test)]
mod tests {
    use super::*;

    /// αA (d/d₀)^−ν = W of the bottom face of a cube, which alone is near: at d₀ = 1e-13 m the sides and the top add
    /// nothing that a number would hold.
    #[test]
    fn rest_gaps_far_below_the_size_are_found() {
        for (edge, reference_gap) in [(1.0, 1e-13), (1e-3, 1e-17), (100.0, 1e-9)] {
            let weight = 500.0 * 9.81 * edge * edge * edge;
            let alpha = 3.0 * weight / (edge * edge);
            let text = format!(
                r#"
                time = {{ end = 1, sample = 1 }}
                support = [{{ name = "table", plane = {{ origin = [0, 0, 0], normal = [0, 0, 1] }} }}]
                contact = [{{ support = "table", repulsion = {{ alpha = {alpha:e}, nu = 4, d0 = {reference_gap:e} }} }}]
                [[body]]
                name = "cube"
                shape = {{ box = {{ size = [{edge:e}, {edge:e}, {edge:e}] }} }}
                density = 500
                position = [0, 0, {:e}]
                "#,
                2.0 * edge
            );
            let scene = gyration_scene::Scene::parse("cube.toml", &text, std::path::Path::new(""), &[]).unwrap();
            let built = scene.built();
            let rests = Approach::new(&built.model, &built.state, 0, 0).unwrap().rests();
            let known = reference_gap * 3.0_f64.powf(0.25);
            assert_eq!(rests.len(), 1, "{edge}: {rests:?}");
            assert!((rests[0].gap / known - 1.0).abs() < 1e-8, "{edge}: {:e} for {known:e}", rests[0].gap);
        }
    }

    #[test]
    fn decay_is_that_of_the_slowest_part() {
        let frequency = 3.0;
        assert!((decay_time(frequency, 0.5) - 2.0 / 3.0).abs() < 1e-15);
        // From both sides of critical damping, where two roots meet as a square root.
        let (below, above) = (decay_time(frequency, 1.0 - 1e-12), decay_time(frequency, 1.0 + 1e-12));
        assert!((below - above).abs() < 1e-5);
        // Far beyond, the body creeps with c/k = 2ζ/ω.
        assert!((decay_time(frequency, 1e9) / (2e9 / frequency) - 1.0).abs() < 1e-12);
    }
}
