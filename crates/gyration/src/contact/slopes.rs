//! The derivatives of the loads of one contact on a body that moves homogeneously.
//!
//! Moments change with the gap, ∂(d^−ν) = −ν d^−(ν+1)(δg₀ + δm·X), and per deformed area with the area factor, δk = k
//! (I − m⊗m)·H, H = δP P⁻¹: the formulas of `resultant` with other moments. With the velocity they change as they
//! stand. In the coordinates q = (p₀ | P), a 3×4 matrix with the loads Q = (f | M) beside it, and X̃ = (1; X),
//!
//!   ∂Q/∂q = (∂Q by gap) ⊗ n + …,   ∂Q_ia/∂q̇_jb = −n_i n_j ∫κ_N X̃_a X̃_b dA − (δ_ij − n_i n_j) ∫κ_T X̃_a X̃_b dA
//!
//! with κ_N, κ_T of damping and friction. Under Coulomb's bound κ_T is σ κ, and the derivatives are those of its
//! product with the viscous friction Q_T: Q_T ⊗ ∂σ beside, by the motion σ g Q_T ⊗ Q_T (`bound`). One-sided damping is
//! that of the motion with s − w added along n: Q_N ⊗ ∂(s − w) beside, Q_N the damping of a motion with n alone, by the
//! motion −(s′ − 1)/B Q_N ⊗ Q_N (`one_sided`).

use super::law_set::{ContactScratch, LawSet};
use super::meeting::{Meeting, RelativeMotion};
use super::resultant::SplitMotion;
use super::sums::{SumSlopes, Sums, push};
use super::tension::{PAIR, TensionSlopes};
use super::{Action, AreaMeasure, Bound, Shift, Sliding};
use crate::load::{COORDINATES, LoadSlopes, Loads, numbers};
use crate::surface::{GapClosed, Moments, OrientedMoments};
use crate::tensor::{Mat3, Vec3};

/// The loads of one contact and their derivatives.
#[derive(Debug, Clone, Copy)]
pub struct ContactSlopes {
    /// f and M of all laws together.
    pub total: Loads,
    motion: RelativeMotion,
    /// ∂(f, M)/∂g₀ and ∂(f, M)/∂m along the three axes, velocities kept.
    by_gap: [Loads; 4],
    /// ∂(f, M)/∂H_jl at 3j + l, H = δP P⁻¹, gaps and velocities kept; with P⁻¹.
    by_stretch: Option<([Loads; 9], Mat3)>,
    /// Σ β d₀^ν × moments of damping and of friction.
    viscous: [Sums; 2],
    bounded: Option<BoundedFriction>,
    opening: Option<OpeningDamping>,
}

/// One-sided damping, and what that of a motion with n alone is.
#[derive(Debug, Clone, Copy)]
struct OpeningDamping {
    shift: Shift,
    /// Σ β d₀^ν × moments.
    sums: Sums,
    loads: Loads,
}

/// Friction with a bound, and what it is without it.
#[derive(Debug, Clone, Copy)]
struct BoundedFriction {
    bound: Bound,
    /// Σ β d₀^ν × moments.
    sums: Sums,
    loads: Loads,
}

impl ContactSlopes {
    /// Integrates the laws of a contact and their derivatives over the surface of a body.
    ///
    /// # Errors
    /// [`GapClosed`] if a point of the surface lies on or behind the plane.
    pub fn integrate(laws: &LawSet, meeting: &Meeting, scratch: &mut ContactScratch) -> Result<Self, GapClosed> {
        let plan = laws.derivatives();
        let moments = scratch.take(plan.requests().len());
        meeting.moments(laws, plan, moments)?;
        let motion = meeting.motion;
        let RelativeMotion { normal, velocity, gradient_rate } = &motion;
        let mut sums = SumSlopes::new(laws, moments);
        let split = SplitMotion::new(&motion);
        let bounded = sums.bind(laws, moments, |friction| split.lost(friction)).map(|(bound, sums)| {
            let loads = sums.act(Action::Tangential, normal, velocity, gradient_rate);
            BoundedFriction { bound, sums, loads }
        });
        let SumSlopes { values, by_gap: slopes } = sums;
        let [_, damping, friction] = values;
        let opening = split.shift(laws, &damping).map(|shift| {
            let loads = damping.act(Action::Normal, normal, normal, &Mat3::zeros());
            OpeningDamping { shift, sums: damping, loads }
        });
        let mut total = Loads::default();
        let mut by_gap = [Loads::default(); 4];
        for action in Action::ALL.into_iter().filter(|action| laws.acts(*action)) {
            let velocity = OpeningDamping::moved(&opening, action, velocity, normal);
            total += values[action as usize].act(action, normal, &velocity, gradient_rate);
            for (sum, slope) in by_gap.iter_mut().zip(&slopes[action as usize]) {
                *sum += slope.act(action, normal, &velocity, gradient_rate);
            }
        }
        if let Some(opening) = &opening {
            for (sum, slope) in by_gap.iter_mut().zip(&slopes[Action::Normal as usize]) {
                *sum += opening.along(&split, slope);
            }
        }
        let viscous = [damping, friction];
        let mut this = Self { total, motion, by_gap, by_stretch: None, viscous, bounded, opening };
        this.stretch(laws, meeting, scratch)?;
        Ok(this)
    }

    /// The derivatives through the area factor.
    fn stretch(&mut self, laws: &LawSet, meeting: &Meeting, scratch: &mut ContactScratch) -> Result<(), GapClosed> {
        let Some(deformation) = meeting.area_change(laws) else { return Ok(()) };
        let plan = laws.values();
        let moments = scratch.take_oriented(plan.requests().len());
        meeting.surface.oriented_moments(&meeting.field, &deformation.cofactor, plan, moments)?;
        let RelativeMotion { normal, velocity, gradient_rate } = &self.motion;
        // The loads with the weights m_a m_b; with (I − m⊗m)_jl they are δ_jl times their trace less those of jl.
        let pairs: [Loads; 6] = std::array::from_fn(|pair| {
            let mut sums = pair_sums(laws, moments, pair);
            self.bind(laws, moments, pair, &mut sums);
            let acting = Action::ALL.into_iter().filter(|action| laws.acts(*action));
            let loads: Loads = acting
                .map(|action| {
                    let velocity = OpeningDamping::moved(&self.opening, action, velocity, normal);
                    sums[action as usize].act(action, normal, &velocity, gradient_rate)
                })
                .sum();
            let split = SplitMotion::new(&self.motion);
            let damping = &sums[Action::Normal as usize];
            [loads].into_iter().chain(self.opening.iter().map(|opening| opening.along(&split, damping))).sum()
        });
        let trace: Loads = [pairs[0], pairs[3], pairs[5]].into_iter().sum();
        let mut by_stretch = PAIR.map(|pair| pairs[pair].scaled(-1.0));
        for place in [0, 4, 8] {
            by_stretch[place] += trace;
        }
        if laws.measure == AreaMeasure::DeformedAreaPotential {
            self.tighten_by_gap(laws, moments, &deformation.inverse);
            if let Some(tension) = TensionSlopes::integrate(laws, meeting, scratch)? {
                self.total.moment -= tension.total * deformation.inverse.transpose();
                tighten(&tension, &deformation.inverse, &mut by_stretch);
            }
        }
        self.by_stretch = Some((by_stretch, deformation.inverse));
        Ok(())
    }

    /// The same with the bound of friction, which changes, too.
    fn bind(&self, laws: &LawSet, moments: &[OrientedMoments], pair: usize, sums: &mut [Sums; Action::COUNT]) {
        let Some(BoundedFriction { bound, sums: free, .. }) = &self.bounded else { return };
        let friction = &mut sums[Action::Tangential as usize];
        let push = push(laws, |planned| planned.term.coefficient * moments[planned.value].pairs[pair].zeroth);
        let lost = SplitMotion::new(&self.motion).lost(friction);
        let change = bound.change(&Sliding { lost, resistance: friction.zeroth, push });
        friction.scale(bound.factor());
        friction.add_scaled(change, free);
    }

    /// The change of the tension with the gap: U′ = −c d^−ν.
    fn tighten_by_gap(&mut self, laws: &LawSet, moments: &[OrientedMoments], inverse: &Mat3) {
        for planned in laws.terms().iter().filter(|planned| planned.term.action == Action::Central) {
            let oriented = &moments[planned.value].pairs;
            for (place, slope) in self.by_gap.iter_mut().enumerate() {
                let part = |moments: &Moments| if place == 0 { moments.zeroth } else { moments.first[place - 1] };
                let [xx, xy, xz, yy, yz, zz] = oriented.map(|moments| part(&moments));
                let across = Mat3::new(yy + zz, -xy, -xz, -xy, xx + zz, -yz, -xz, -yz, xx + yy);
                slope.moment += planned.term.coefficient * across * inverse.transpose();
            }
        }
    }

    /// Adds the derivatives by (p₀ | P) and their rates.
    pub fn add_to(&self, slopes: &mut LoadSlopes) {
        let normal = &self.motion.normal;
        slopes.loads += self.total;
        let by_gap = self.by_gap.each_ref().map(numbers);
        for (coordinate, column) in slopes.by_place.as_mut_slice().chunks_exact_mut(COORDINATES).enumerate() {
            let (slope, along) = (&by_gap[coordinate / 3], normal[coordinate % 3]);
            for (entry, slope) in column.iter_mut().zip(slope.iter()) {
                *entry += along * slope;
            }
        }
        if let Some((by_stretch, inverse)) = &self.by_stretch {
            let by_stretch = by_stretch.each_ref().map(numbers);
            let by_gradient = slopes.by_place.as_mut_slice()[3 * COORDINATES..].chunks_exact_mut(COORDINATES);
            for (place, column) in by_gradient.enumerate() {
                // δP = e_j ⊗ e_B has H_jl = F_Bl.
                let (j, b) = (place % 3, place / 3);
                let [x, y, z] = [0, 1, 2].map(|l| (&by_stretch[3 * j + l], inverse[(b, l)]));
                for (row, entry) in column.iter_mut().enumerate() {
                    *entry += (x.1 * x.0[row] + y.1 * y.0[row]) + z.1 * z.0[row];
                }
            }
        }
        let along = normal * normal.transpose();
        let [damping, friction] = &self.viscous;
        slopes.resist(&along, damping.zeroth, &damping.first, &damping.second);
        slopes.resist(&(Mat3::identity() - along), friction.zeroth, &friction.first, &friction.second);
        if let Some(BoundedFriction { bound, loads, .. }) = &self.bounded {
            let loads = numbers(loads);
            slopes.by_rate.ger(bound.by_motion(), &loads, &loads, 1.0);
        }
        if let Some(OpeningDamping { shift, sums, loads }) = &self.opening {
            let loads = numbers(loads);
            slopes.by_rate.ger(-shift.slope / sums.zeroth, &loads, &loads, 1.0);
        }
    }
}

impl OpeningDamping {
    /// The velocity that an action feels.
    fn moved(opening: &Option<Self>, action: Action, velocity: &Vec3, normal: &Vec3) -> Vec3 {
        match opening {
            Some(opening) if action == Action::Normal => velocity + opening.shift.by * normal,
            _ => *velocity,
        }
    }

    /// What the change of the shift with that of the sums of damping adds.
    fn along(&self, split: &SplitMotion, change: &Sums) -> Loads {
        self.loads.scaled(self.shift.slope * split.mean_along(&self.sums, change))
    }
}

/// The sums of each action over the terms of a contact with the weights of one pair of normals.
fn pair_sums(laws: &LawSet, moments: &[OrientedMoments], pair: usize) -> [Sums; Action::COUNT] {
    let mut sums = [Sums::default(); Action::COUNT];
    for planned in laws.terms() {
        let term = &planned.term;
        sums[term.action as usize].add(term.coefficient, term.action, &moments[planned.value].pairs[pair]);
    }
    sums
}

/// −T P⁻ᵀ changes by (T Hᵀ − δT) P⁻ᵀ.
fn tighten(tension: &TensionSlopes, inverse: &Mat3, by_stretch: &mut [Loads; 9]) {
    for (place, (slope, change)) in by_stretch.iter_mut().zip(&tension.by_stretch).enumerate() {
        let (j, l) = (place / 3, place % 3);
        let mut back = Mat3::zeros();
        back.set_column(j, &tension.total.column(l));
        slope.moment += (back - change) * inverse.transpose();
    }
}
