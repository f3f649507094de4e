//! How two balls move along their normal and across it, and what resistances make of that.

use super::PlacedBalls;
use crate::contact::{LawKind, OneSided, Shift};
use crate::load::Loads;
use crate::pair::side::{SIGNS, Side};
use crate::tensor::{Mat3, Vec3, axial, cross_matrix};
use nalgebra::SMatrix;

type Mat3x9 = SMatrix<f64, 3, 9>;

/// What two balls resist one another by, or its change with the slab.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Resistance {
    /// D₀ [N s/m].
    pub approach: f64,
    /// D_⊥ [N m s].
    pub tilt: f64,
    /// F₀ [N s/m].
    pub slip: f64,
    /// k [N m s].
    pub drill: f64,
}

/// How two balls move, along their normal and across it.
pub(super) struct Moving {
    pub normal: Vec3,
    /// h [m].
    pub heights: [f64; 2],
    /// n·v [m/s].
    pub approach: f64,
    /// That which damping resists [m/s]: s(n·v) of a one-sided one; and its derivative.
    pub damped: f64,
    pub damped_slope: f64,
    /// v [m/s].
    pub velocity: Vec3,
    /// u [m/s].
    pub slip: Vec3,
    /// ω_A and ω_B [rad/s].
    pub spins: [Vec3; 2],
    /// ω.
    pub spin: Vec3,
}

/// How their motion is seen to change with one component of p_A − p_B: δn = Πδ/D, δg = n·δ.
pub(super) struct Shifted {
    /// δg.
    pub wider: f64,
    /// δn [1/m].
    pub turned: Vec3,
    /// δ(n·v) [1/s].
    pub approached: f64,
    /// δu [1/s].
    pub slipped: Vec3,
}

impl Resistance {
    /// That of friction alone.
    pub fn of_friction(&self) -> Self {
        Self { approach: 0.0, tilt: 0.0, ..*self }
    }

    /// Adds a law, given M₀ and M_⊥ of both sides.
    pub fn add(&mut self, kind: LawKind, whole: f64, across: f64) {
        if kind == LawKind::Damping {
            self.approach += whole;
            self.tilt += across;
        } else {
            self.slip += whole;
            self.drill += 2.0 * across;
        }
    }
}

impl Moving {
    /// `release` is w₀ of one-sided damping [m/s].
    pub fn new(placed: &PlacedBalls, sides: [&Side; 2], release: Option<f64>) -> Self {
        let normal = placed.normal;
        let heights = [0, 1].map(|i| placed.balls.radii[i] + placed.gaps[i]);
        let spins = sides.map(|side| 0.5 * axial(&(side.velocity.gradient_rate * side.inverse)));
        let velocity = sides[0].velocity.velocity - sides[1].velocity.velocity;
        let approach = velocity.dot(&normal);
        let rolling = heights[0] * spins[0] + heights[1] * spins[1];
        let slip = velocity - approach * normal - rolling.cross(&normal);
        let (damped, damped_slope) = release.map_or((approach, 1.0), |release| {
            let Shift { by, slope } = OneSided(release).shift(approach);
            (approach + by, 1.0 + slope)
        });
        Self { normal, heights, approach, damped, damped_slope, velocity, slip, spins, spin: spins[0] - spins[1] }
    }

    /// How it is seen with one component of p_A − p_B changed, given how the gaps of both grow with the slab.
    pub fn shifted(&self, placed: &PlacedBalls, axis: usize, shares_of_gap: [f64; 2]) -> Shifted {
        let Self { normal: n, heights, approach, velocity, spins, .. } = self;
        let rolling = heights[0] * spins[0] + heights[1] * spins[1];
        let growing = shares_of_gap[0] * spins[0] + shares_of_gap[1] * spins[1];
        let wider = n[axis];
        let turned = (Vec3::ith(axis, 1.0) - wider * n) / placed.distance;
        let approached = velocity.dot(&turned);
        let slipped = -(approached * n + *approach * turned) - wider * growing.cross(n) - rolling.cross(&turned);
        Shifted { wider, turned, approached, slipped }
    }

    /// −f_A: what a resistance makes of this motion.
    pub fn force(&self, by: &Resistance) -> Vec3 {
        by.approach * self.damped * self.normal + by.slip * self.slip
    }

    /// D_⊥ Πω + k (n·ω) n.
    pub fn twist(&self, by: &Resistance) -> Vec3 {
        by.tilt * self.spin + (by.drill - by.tilt) * self.normal.dot(&self.spin) * self.normal
    }

    /// τ of a side.
    pub fn torque(&self, side: usize, by: &Resistance) -> Vec3 {
        self.heights[side] * by.slip * self.normal.cross(&self.slip) - SIGNS[side] * self.twist(by)
    }

    /// The powers of damping and of friction [W].
    pub fn powers(&self, by: &Resistance) -> [f64; 2] {
        let drilling = self.normal.dot(&self.spin).powi(2);
        let tilting = self.normal.cross(&self.spin).norm_squared();
        let damping = by.approach * (self.approach * self.damped) + by.tilt * tilting;
        [-damping, -(by.slip * self.slip.norm_squared() + by.drill * drilling)]
    }
}

/// (f | M), given f and τ.
pub(super) fn column(force: &Vec3, torque: &Vec3, gradient: &Mat3) -> Loads {
    Loads { force: *force, moment: 0.5 * cross_matrix(torque) * gradient }
}

/// ω by the columns of Ṗ: ω = ½ Σ P e_k × Ṗ e_k.
pub(super) fn spin_by_rate(gradient: &Mat3) -> Mat3x9 {
    let mut spin = Mat3x9::zeros();
    for k in 0..3 {
        spin.fixed_columns_mut::<3>(3 * k).copy_from(&(0.5 * cross_matrix(&gradient.column(k).into())));
    }
    spin
}
