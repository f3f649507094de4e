//! One-sided damping between two bodies (`contact/one_sided`): that of the motion V + (s(w) − w) E, E the motion of A
//! along n alone. With W_E the slip of E against the mediator that it brings, K = ⟨W_E, W_E⟩ and w = ⟨W_E, W⟩/K,
//!
//!   (f | M) = −W M − (s − w) W_E M,   power = −(⟨W, W⟩ + (s − w) K w)
//!
//! Derivatives have −(s′ − 1)/K Q_E⊗Q_E beside those of viscous damping by the motion, Q_E = −W_E M, and (s′ − 1) Q_E
//! δw by the places, in which the change of W, W_E is that at η kept:
//!
//!   δw = (δ⟨W_E, W⟩ − w δK)/K

use super::Mat34;
use super::directions::Rows;
use crate::contact::Shift;
use crate::tensor::Vec3;

/// One-sided damping; the slips of the mediator are W + (s − w) W_E.
#[derive(Debug, Clone)]
pub(super) struct Opening {
    pub shift: Shift,
    /// w [m/s].
    pub speed: f64,
    /// K [N s/m].
    pub resistance: f64,
    /// W_E.
    pub slips: [Rows; 2],
    /// W_E M.
    pub resisted: [Rows; 2],
    /// η of E.
    pub motion: Vec3,
}

/// How a side of a mediator changes: δ(ΠV) − Σ η_k δB_k of W + (s − w) W_E, δB and δM.
pub(super) struct SideChange<'a> {
    pub side: usize,
    pub slip: &'a Mat34,
    pub tilted: &'a Mat34,
    pub moments: &'a super::Mat4,
}

impl Opening {
    /// What is taken, given the square of the slips [W]: it has (s − w)² K and 2 (s − w) K w in it.
    pub fn power(&self, squared: f64) -> f64 {
        self.shift.by * self.resistance * (self.shift.by + self.speed) - squared
    }

    /// −(s′ − 1)/K.
    pub fn by_motion(&self) -> f64 {
        -self.shift.slope / self.resistance
    }

    /// η of E.
    pub fn motion(&self) -> &Vec3 {
        &self.motion
    }

    /// s − w, with which E is in the motion that is damped [m/s].
    pub fn by(&self) -> f64 {
        self.shift.by
    }
}
