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
use super::mediator::{Mediator, slipped, uniform};
use crate::contact::{OneSided, Shift};
use crate::tensor::Vec3;

/// One-sided damping; the slips of the mediator are W + (s − w) W_E.
#[derive(Debug, Clone)]
pub(super) struct Opening {
    shift: Shift,
    /// w [m/s].
    speed: f64,
    /// K [N s/m].
    resistance: f64,
    /// W_E.
    slips: [Mat34; 2],
    /// η of E.
    motion: Vec3,
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

impl Mediator {
    /// Makes it that of a one-sided damping.
    pub(super) fn open(&mut self, one_sided: OneSided, normal: &Vec3) {
        let moved = [uniform(normal), Mat34::zeros()];
        let (motion, slips) = slipped(&self.system, &self.pressed, &self.fields, moved);
        let product = |other: &[Mat34; 2]| -> f64 {
            (0..2).map(|side| (slips[side] * self.moments[side]).dot(&other[side])).sum()
        };
        let resistance = product(&slips);
        if resistance <= 0.0 {
            return;
        }
        let speed = product(&self.slips) / resistance;
        let shift = one_sided.shift(speed);
        for (slip, opening) in self.slips.iter_mut().zip(&slips) {
            *slip += shift.by * opening;
        }
        self.motion += shift.by * motion;
        self.opening = Some(Opening { shift, speed, resistance, slips, motion });
    }

    /// Q_E on a side.
    pub(super) fn opening_loads(&self, opening: &Opening, side: usize) -> Mat34 {
        -(opening.slips[side] * self.moments[side])
    }

    /// What the change of one side adds to K δw; the slips that change being those of the mediator, (s − w) δK is in
    /// it.
    pub(super) fn mean_along(&self, opening: &Opening, change: &SideChange) -> f64 {
        let SideChange { side, slip, tilted, moments } = change;
        let (own, weight) = (&opening.slips[*side], &self.moments[*side]);
        let (swept, pressed, turned) = (own * *moments, own * weight, *tilted * weight);
        let product = turned.dot(&self.slips[*side]) + pressed.dot(slip) + swept.dot(&self.slips[*side]);
        product - (opening.speed + opening.shift.by) * (2.0 * turned.dot(own) + swept.dot(own))
    }

    /// (s′ − 1) Q_E δw on a side, given K δw.
    pub(super) fn opened(&self, opening: &Opening, side: usize, mean: f64) -> Mat34 {
        opening.shift.slope * mean / opening.resistance * self.opening_loads(opening, side)
    }
}
