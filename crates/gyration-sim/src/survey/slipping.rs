//! What friction does to a body that rests on a support, in numbers that people can compare.
//!
//! With W = −m g·n, and at the gap of rest the resistance c_t of friction to a translation, N the force of the
//! repulsion,
//!
//!   as strong as the weight at W/c_t;   at most Σ μN of it under Coulomb's bound;   creep |g_t| m/(c_t √(1 − x²)), x =
//!   m |g_t|/(Σ μN), below the bound
//!
//! A body that is round about an axis a across n rolls: with the turn ω about a and the velocity v along t = a×n, and D
//! the 2×2 resistance of damping and friction to both, (m v̇, I_a ω̇) = −D (v, ω) has a fast decay, that of the slip,
//! and a slow one, that of the rolling.

use super::rest::Approach;
use super::slip::Slip;
use gyration::contact::{ContactLaw, ContactLoads, ContactScratch, LawKind, LawSet};
use gyration::load::LoadSlopes;
use gyration::tensor::{Mat3, Vec3, cross_matrix};
use nalgebra::{Matrix2, SVector, SymmetricEigen};

/// A rate of decay below this part of the other is rounding.
const ROUNDING: f64 = 1e-13;

impl Approach<'_> {
    /// Of a resistance c_t [N s/m]; none without friction, or without a weight that presses.
    pub(super) fn slip(&self, gap: f64, slopes: &LoadSlopes, resistance: f64, stiffness: f64) -> Option<Slip> {
        if resistance <= 0.0 || self.weight <= 0.0 {
            return None;
        }
        Some(Slip {
            weight_speed: self.weight / resistance,
            bound: self.most_friction(gap).map(|most| most / self.weight),
            rolling_time: self.rolling_time(slopes, stiffness),
        })
    }

    /// Σ μN [N] at a gap; none where a friction has no bound.
    pub(super) fn most_friction(&self, gap: f64) -> Option<f64> {
        let mut scratch = ContactScratch::default();
        let mut sum = 0.0;
        for contact in self.contacts() {
            let laws = contact.law_set.laws();
            let acts = |law: &&ContactLaw| law.terms().iter().flatten().any(|term| term.coefficient != 0.0);
            if !laws.iter().filter(acts).any(|law| law.kind() == LawKind::Friction) {
                continue;
            }
            let mu = contact.law_set.mu()?;
            let repulsion = laws.iter().filter(|law| law.kind() == LawKind::Repulsion).copied().collect();
            let alone = LawSet::new(contact.law_set.measure, repulsion);
            let loads = ContactLoads::integrate(&alone, &self.contact_state(gap), &mut scratch).ok()?;
            sum += mu * loads.total().force.dot(self.normal());
        }
        Some(sum)
    }

    /// The time constant of rolling [s]; none of a body that no axis across n lets turn freely.
    fn rolling_time(&self, slopes: &LoadSlopes, stiffness: f64) -> Option<f64> {
        let normal = self.normal();
        let one = normal.cross(&Vec3::ith(normal.iamin(), 1.0)).normalize();
        let other = normal.cross(&one);
        let [along, across, both] = [one, other, one + other].map(|axis| self.turning_stiffness(slopes, &axis));
        let coupled = 0.5 * (both - along - across);
        let eigen = SymmetricEigen::new(Matrix2::new(along, coupled, coupled, across));
        let least = eigen.eigenvalues.imin();
        if !self.is_round(eigen.eigenvalues[least], stiffness) {
            return None;
        }
        let axis = eigen.eigenvectors[(0, least)] * one + eigen.eigenvectors[(1, least)] * other;
        let motions = [(axis.cross(normal), Mat3::zeros()), (Vec3::zeros(), cross_matrix(&axis) * self.gradient())];
        let motions = motions
            .map(|(velocity, rate)| SVector::<f64, 12>::from_iterator(velocity.iter().chain(rate.iter()).copied()));
        let inertia = [self.mass(), self.inertia_about(&axis)].map(f64::sqrt);
        let entry = |i: usize, j: usize| -motions[i].dot(&(slopes.by_rate * motions[j])) / (inertia[i] * inertia[j]);
        let rates = SymmetricEigen::new(Matrix2::from_fn(entry)).eigenvalues;
        let (slow, fast) = (rates.min(), rates.max());
        (slow > ROUNDING * fast).then(|| 1.0 / slow)
    }
}

#[cfg(test)]
mod tests {
    use super::super::rest::{Approach, Descent, RestGap};
    use gyration_scene::Scene;
    use std::path::Path;

    /// A body on a plane under a gravity of slope tan θ, with friction of c = 300 s/m and damping of 2 s/m.
    fn rest(shape: &str, tan: f64, mu: &str) -> RestGap {
        let text = format!(
            r#"
            world = {{ gravity = [{:?}, 0, -10] }}
            time = {{ end = 1, sample = 1 }}
            [[support]]
            name = "table"
            plane = {{}}
            [[contact]]
            support = "table"
            repulsion = {{ alpha = 1000, nu = 6, d0 = 1e-4 }}
            damping = {{ beta = 2000, nu = 6, d0 = 1e-4 }}
            friction = {{ beta = 3e5, nu = 6, d0 = 1e-4{mu} }}
            [[body]]
            name = "body"
            shape = {{ {shape} }}
            mass = 0.5
            position = [0, 0, 0.1]
            "#,
            10.0 * tan
        );
        let scene = Scene::parse("scene.toml", &text, Path::new(""), &[]).unwrap();
        let built = scene.built();
        let mut rests = Approach::new(&built.model, &built.state, 0, 0).unwrap().rests();
        rests.remove(0)
    }

    const BLOCK: &str = "box = { size = [0.1, 0.1, 0.02] }";

    #[test]
    fn a_block_creeps_slides_or_gets_faster_as_the_bound_says() {
        let close = |found: f64, known: f64| assert!((found / known - 1.0).abs() < 1e-9, "{found} for {known}");
        let viscous = rest(BLOCK, 0.25, "");
        let slip = viscous.slip.unwrap();
        close(slip.weight_speed, 1.0 / 300.0);
        assert_eq!((slip.bound, slip.rolling_time), (None, None));
        close(viscous.descent.unwrap().speed().unwrap(), 0.25 / 300.0);
        let bounded = rest(BLOCK, 0.25, ", mu = 0.5");
        close(bounded.slip.unwrap().bound.unwrap(), 0.5);
        close(bounded.slip.unwrap().creep().unwrap(), 0.5 / 300.0);
        close(bounded.descent.unwrap().speed().unwrap(), 0.25 / (300.0 * 0.75_f64.sqrt()));
        let Some(Descent::Accelerates { acceleration }) = rest(BLOCK, 0.8, ", mu = 0.5").descent else { panic!() };
        close(acceleration, 10.0 * (0.8 - 0.5));
    }

    /// What resists rolling of a ball at a gap that is small beside it: damping, and the spread of the heights at which
    /// friction acts.
    #[test]
    fn rolling_decays_as_damping_and_friction_say() {
        let radius = 0.05;
        let found = rest("sphere = { radius = 0.05 }", 0.0, "");
        let part = found.gap / radius;
        let known = 5.0 / 7.0 * 10.0 * (2.0 * part / 4.0 + 300.0 * (1.0 / 6.0 - 1.0 / 16.0) * part * part);
        let time = found.slip.unwrap().rolling_time.unwrap();
        println!("d/R {part:.1e}: rolling decays in {time} s, for {}", 1.0 / known);
        // In first order of the gap; slip is 300 times as fast.
        assert!((time * known - 1.0).abs() < 5.0 * part, "{time} for {}", 1.0 / known);
    }
}
