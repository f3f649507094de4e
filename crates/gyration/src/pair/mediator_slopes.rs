//! How damping and friction against a mediator change with the places of both bodies, motions kept.
//!
//!   δ(f | M) = −(δW M + W δM),   δW = δΠ V − Σ η_k δB_k − Σ δη_k B_k
//!   Σ_l ⟨B_k, B_l⟩ δη_l = Σ δB_k·(W M) + B_k·(W δM + (δΠ V − Σ η_l δB_l) M)
//!
//! M of a side changes with its weight κ, with z, by the moments of one more power of the gap, and of friction with G:
//!
//!   δ(G M Gᵀ) = G δM Gᵀ − c − cᵀ,   c = δa⊗(G M e) + a⊗(G M δe),   δa = (0; P⁻¹(δn − δP P⁻¹n))
//!
//! With a bound that is σ δ(f | M) + (f | M) δσ. Since η makes ⟨W, W⟩ least, its change has none of η in it:
//!
//!   δ⟨W, W⟩ = Σ W·(2 (δΠ V − Σ η_k δB_k) M + W δM),   δB = Σ δB_i (B/B_i)²,   δ log N = δ log λ_A + δ log a_A⁰

use super::areas::AreaMoments;
use super::expansion::Change;
use super::laws::ViscousLaw;
use super::mediator::{Mediator, Shares, from_foot, upright};
use super::opening::{Opening, SideChange};
use super::side::{contracted, joined};
use super::state::PairState;
use super::{Mat4, Mat34, Vec4};
use crate::contact::{Bound, LawKind, Sliding};
use crate::load::Mat12;
use crate::surface::Moments;
use crate::tensor::{Mat3, Vec3, cross_matrix};
use nalgebra::{SMatrix, SVector};

type Vec12 = SVector<f64, 12>;
type Mat12x3 = SMatrix<f64, 12, 3>;

/// A mediator with its matrices whole: their changes leave the image of Π.
pub(super) struct Unfolded<'a> {
    of: &'a Mediator,
    /// B.
    fields: [[Mat34; 3]; 2],
    /// B M.
    pressed: [[Mat34; 3]; 2],
    /// W.
    slips: [Mat34; 2],
    /// −W M.
    viscous: [Mat34; 2],
    /// Of a damping that is one-sided.
    opening: Option<UnfoldedOpening<'a>>,
}

/// What makes a damping one-sided, with its matrices whole.
struct UnfoldedOpening<'a> {
    of: &'a Opening,
    /// W_E.
    slips: [Mat34; 2],
    /// Q_E = −W_E M.
    loads: [Mat34; 2],
}

/// A side of a mediator on its way from d^−ν′, whatever changes.
pub(super) struct Slope {
    /// κ · moments of d^−ν′.
    value: Mat4,
    /// −ν′ κ × the moments of d^−(ν′+1), with one X̃ more.
    raised: Moments,
    /// δ log κ by δ log λ of both sides.
    growth: [f64; 2],
    /// (p₀ − foot | P).
    from_foot: Mat34,
    /// What that is along the two tangents and along n.
    arms: [Vec4; 3],
    /// Those of d^−ν′ with the products of the components of the current normal, where areas change.
    areas: Option<[Mat4; 6]>,
    /// V.
    rates: Mat34,
    /// Vᵀn.
    rising: Vec4,
}

impl Slope {
    /// From the moments of ν′ and of ν′ + 1 of a side.
    pub fn new(
        law: &ViscousLaw,
        shares: &Shares,
        (state, areas): (&PairState, &AreaMoments),
        side: usize,
        moments: &[Moments],
    ) -> Self {
        let coefficient = shares.coefficient(law, side);
        let [value, mut raised] = law.slopes.map(|place| moments[place]);
        raised.scale(-law.exponent * coefficient);
        let (half, normal) = (&state.halves[side], state.placed.plane.normal);
        let (from_foot, rates) = (from_foot(half, &state.foot), half.rates());
        let [one, other] = state.placed.tangents;
        Self {
            value: coefficient * joined(value.zeroth, &value.first, &value.second),
            raised,
            growth: shares.growth(law, side),
            from_foot,
            arms: [one, other, normal].map(|direction| from_foot.tr_mul(&direction)),
            areas: areas.joined(side, law.value, coefficient),
            rates,
            rising: rates.tr_mul(&normal),
        }
    }

    /// The change with z.
    fn along(&self, heights: &Vec4) -> Mat4 {
        contracted(&self.raised, heights)
    }
}

/// The field that is v everywhere.
fn uniform(v: &Vec3) -> Mat34 {
    let mut uniform = Mat34::zeros();
    uniform.set_column(0, v);
    uniform
}

/// Σ η_k B_k.
fn combined(motion: &Vec3, fields: &[Mat34; 3]) -> Mat34 {
    motion.x * fields[0] + motion.y * fields[1] + motion.z * fields[2]
}

/// B_k · A of each k.
fn along(fields: &[Mat34; 3], weighed: &Mat34) -> Vec3 {
    Vec3::from_fn(|k, _| fields[k].dot(weighed))
}

/// n⊗n or 1 − n⊗n.
fn projector(kind: LawKind, n: &Vec3) -> Mat3 {
    let along = n * n.transpose();
    if kind == LawKind::Damping { along } else { Mat3::identity() - along }
}

/// Adds a factor times Q_i ⊗ Q_j.
fn add_product(factor: f64, loads: &[Mat34; 2], slopes: &mut [[Mat12; 2]; 2]) {
    let loads = loads.each_ref().map(|loads| Vec12::from_column_slice(loads.as_slice()));
    for (side, acting) in loads.iter().enumerate() {
        for (body, moved) in loads.iter().enumerate() {
            slopes[side][body].ger(factor, acting, moved, 1.0);
        }
    }
}

impl<'a> Unfolded<'a> {
    pub fn new(of: &'a Mediator) -> Self {
        let whole = |rows: &_| of.directions.matrix(rows);
        let opening = of.opening.as_ref().map(|opening| UnfoldedOpening {
            of: opening,
            slips: opening.slips.each_ref().map(whole),
            loads: opening.resisted.each_ref().map(|rows| -whole(rows)),
        });
        Self {
            of,
            fields: of.fields.each_ref().map(|fields| fields.each_ref().map(whole)),
            pressed: of.pressed.each_ref().map(|pressed| pressed.each_ref().map(whole)),
            slips: of.slips.each_ref().map(whole),
            viscous: [0, 1].map(|side| of.viscous(side)),
            opening,
        }
    }

    /// Adds the derivatives of (f | M) on each side by the motion of each, places kept.
    ///
    ///   ∂(f | M)_i/∂V_j = G_i S⁻¹ G_jᵀ − δ_ij M_i⊗Π,   G_i = (B_1M_i, B_2M_i, B_3M_i),   S_kl = Σ ⟨B_k, B_l⟩
    ///
    /// G is 12×3; the B_k lie in the image of Π. A bound takes σ of that, and σ g Q_i ⊗ Q_j beside, Q = (f | M) without
    /// it; one-sided damping has −(s′ − 1)/K Q_i ⊗ Q_j beside, Q = (f | M) of E.
    pub fn add_by_rates(&self, normal: &Vec3, slopes: &mut [[Mat12; 2]; 2]) {
        let Mediator { kind, moments, system, bound, .. } = self.of;
        let projector = projector(*kind, normal);
        let factor = bound.as_ref().map_or(1.0, Bound::factor);
        let pressed = self.pressed.each_ref().map(|pressed| {
            Mat12x3::from_columns(&pressed.each_ref().map(|pressed| Vec12::from_column_slice(pressed.as_slice())))
        });
        for (body, pressed_by) in pressed.iter().enumerate() {
            let motion = factor * system.solve(&pressed_by.transpose());
            for (side, pressed) in pressed.iter().enumerate() {
                slopes[side][body] += pressed * motion;
            }
            slopes[body][body] -= (factor * moments[body]).kronecker(&projector);
        }
        if let Some(bound) = bound {
            add_product(bound.by_motion(), &self.viscous, slopes);
        }
        if let Some(opening) = &self.opening {
            add_product(opening.of.by_motion(), &opening.loads, slopes);
        }
    }

    /// The change of (f | M) on both sides with the places of both, (δq_A, δq_B), motions kept.
    pub fn along_places(
        &self,
        state: &PairState,
        slopes: &[Slope; 2],
        places: [&Mat34; 2],
        change: &Change,
    ) -> [Mat34; 2] {
        let Mediator { kind, motion, moments: weights, system, bound, .. } = self.of;
        let (mut right, mut lost, mut resistances, mut mean) = (Vec3::zeros(), 0.0, [0.0; 2], 0.0);
        let changed = [0, 1].map(|side| {
            let moments = self.moments_along(state, side, &slopes[side], places[side], change);
            let fields = self.fields_along(state, &slopes[side], places[side], change);
            let Slope { rates, rising, .. } = &slopes[side];
            let sign = if *kind == LawKind::Damping { 1.0 } else { -1.0 };
            let turned = change.normal * rising.transpose()
                + state.placed.plane.normal * rates.tr_mul(&change.normal).transpose();
            let mut slip = sign * turned - combined(motion, &fields);
            if let Some(opening) = &self.opening {
                let mut tilted = -combined(opening.of.motion(), &fields);
                if side == 0 {
                    slip += opening.of.by() * uniform(&change.normal);
                    tilted += uniform(&change.normal);
                }
                let change = SideChange { side, slip: &slip, tilted: &tilted, moments: &moments };
                mean += self.mean_along(opening, &change);
            }
            let slipped = slip * weights[side];
            let changed = self.slips[side] * moments + slipped;
            right += along(&self.fields[side], &changed) - along(&fields, &self.viscous[side]);
            if bound.is_some() {
                lost += (changed + slipped).dot(&self.slips[side]);
                resistances[side] = moments[(0, 0)];
            }
            changed
        });
        let motion = system.solve(&right);
        let viscous = [0, 1].map(|side| combined(&motion, &self.pressed[side]) - changed[side]);
        if let Some(opening) = &self.opening {
            return [0, 1].map(|side| viscous[side] + opening.opened(side, mean));
        }
        let Some(bound) = bound else { return viscous };
        let own = self.of.resistances();
        let resistance = (0..2).map(|side| resistances[side] * (own[1 - side] / (own[0] + own[1])).powi(2)).sum();
        let push = state.placed.push() * change.weights[0] + state.placed.weights[0] * change.first[0][0];
        let growth = bound.change(&Sliding { lost, resistance, push });
        [0, 1].map(|side| bound.factor() * viscous[side] + growth * self.viscous[side])
    }

    /// δB of a side.
    fn fields_along(&self, state: &PairState, slope: &Slope, place: &Mat34, change: &Change) -> [Mat34; 3] {
        let (normal, tangents) = (&state.placed.plane.normal, &state.placed.tangents);
        let turns = tangents.map(|tangent| tangent.dot(&change.normal));
        if self.of.kind == LawKind::Damping {
            let tilt = |k: usize| {
                let arm = place.tr_mul(&tangents[k]) - turns[k] * slope.arms[2];
                change.normal * slope.arms[k].transpose() + normal * arm.transpose()
            };
            [uniform(&change.normal), tilt(0), tilt(1)]
        } else {
            let spin = cross_matrix(&change.normal) * slope.from_foot + cross_matrix(normal) * place;
            [uniform(&(-turns[0] * normal)), uniform(&(-turns[1] * normal)), spin]
        }
    }

    /// δM of a side.
    fn moments_along(&self, state: &PairState, side: usize, slope: &Slope, place: &Mat34, change: &Change) -> Mat4 {
        let heights = &change.heights[side];
        let growth = slope.growth[0] * change.weights[0] + slope.growth[1] * change.weights[1];
        let mut changed = growth * slope.value + slope.along(heights);
        if let (Some(areas), Some(stretch)) = (&slope.areas, &change.stretch[side]) {
            areas.iter().zip(stretch).for_each(|(own, weight)| changed += *weight * own);
        }
        let Some(feet) = &self.of.feet else { return changed };
        let (foot, half) = (&feet[side], &state.halves[side]);
        let across = foot.across.fixed_rows::<3>(1);
        let turned = half.side.inverse * (change.normal - place.fixed_columns::<3>(1) * across);
        let image = |heights: &Vec4| foot.image(&(slope.value * heights)).transpose();
        let cross = upright(&turned) * image(&foot.heights) + foot.across * image(&(half.sign * heights));
        foot.carried(&changed) - cross - cross.transpose()
    }
}

impl Unfolded<'_> {
    /// What the change of one side adds to K δw; the slips that change being those of the mediator, (s − w) δK is in
    /// it.
    fn mean_along(&self, opening: &UnfoldedOpening, change: &SideChange) -> f64 {
        let SideChange { side, slip, tilted, moments } = change;
        let (own, weight) = (&opening.slips[*side], &self.of.moments[*side]);
        let (swept, pressed, turned) = (own * *moments, own * weight, *tilted * weight);
        let product = turned.dot(&self.slips[*side]) + pressed.dot(slip) + swept.dot(&self.slips[*side]);
        product - (opening.of.speed + opening.of.shift.by) * (2.0 * turned.dot(own) + swept.dot(own))
    }
}

impl UnfoldedOpening<'_> {
    /// (s′ − 1) Q_E δw on a side, given K δw.
    fn opened(&self, side: usize, mean: f64) -> Mat34 {
        self.of.shift.slope * mean / self.of.resistance * self.loads[side]
    }
}
