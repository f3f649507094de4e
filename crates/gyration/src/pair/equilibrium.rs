//! The plane of least potential between two bodies, by Newton's method on L = log U.
//!
//!   s_i = √w_i U_i^−q/Σ,   U = Σ^(−1/q),   q = 1/(2(ν−1)),   ∂U/∂U_i = λ_i = s_i U/U_i
//!
//! A plane has three free numbers: n turns along two tangents, and c. Z_i (4×3) is how z_i changes with them. With ρ_i
//! = −Z_iᵀa_i/U_i,
//!
//!   r = Σ s_i ρ_i,   K = Σ s_i [Z_iᵀh_iZ_i/U_i − (1+q) ρ_i⊗ρ_i] + q r⊗r + (ν−1) diag(1, 1, 0)
//!
//! the last of which is what |n| = 1 brings, since L + (ν−1) log|y| does not change along y. K is positive.

use super::fault::PairFault;
use super::gjk::{guessed, separate};
use super::laws::{PairLaws, raised};
use super::plane::{Guess, Plane};
use super::side::{Half, Potential};
use super::{Mat34, Vec4};
use crate::surface::Moments;
use crate::tensor::{Mat3, Vec3};
use nalgebra::{Cholesky, Const, Matrix4x3};

/// A plane, and all that its potential is put together from.
#[derive(Debug, Clone)]
pub(super) struct Placed {
    pub plane: Plane,
    pub potentials: [Potential; 2],
    /// s.
    parts: [f64; 2],
    /// U [J].
    pub energy: f64,
    /// λ.
    pub weights: [f64; 2],
    /// The directions in which n turns.
    pub tangents: [Vec3; 2],
    /// Z.
    heights: [Matrix4x3<f64>; 2],
    /// ρ.
    slopes: [Vec3; 2],
    /// r.
    gradient: Vec3,
    /// δ log χ′ by δ log U.
    switching: f64,
    /// K.
    curvature: Cholesky<f64, Const<3>>,
    /// q.
    power: f64,
}

/// The switching function, four times differentiable: χ(U) = U (1 − U_c/U)₊⁵ in the place of U.
///
///   χ′ = (1 − x)⁴ (1 + 4x),   χ″ = 20 x² (1 − x)³/U,   x = U_c/U
#[derive(Debug, Clone, Copy)]
pub(super) struct Switch {
    /// χ/U.
    pub value: f64,
    /// χ′.
    pub slope: f64,
    /// δ log χ′ by δ log U.
    pub bend: f64,
}

impl Switch {
    /// At an energy, given that at which the pair begins [J].
    pub fn at(threshold: f64, energy: f64) -> Self {
        let part = (threshold / energy).min(1.0);
        let left = 1.0 - part;
        Self {
            value: left.powi(5),
            slope: left.powi(4) * (1.0 + 4.0 * part),
            bend: if left > 0.0 { 20.0 * part * part / (left * (1.0 + 4.0 * part)) } else { 0.0 },
        }
    }
}

/// A squared Newton decrement that is rounding: the plane is known to fifteen digits of what its forces feel.
const CONVERGED: f64 = 1e-29;

/// Below this squared decrement steps are whole, and a decrement that no longer falls is rounding.
const NEAR: f64 = 1e-10;

/// What sums of moments are rounded to.
const ROUNDING: f64 = 1e-13;

/// A squared decrement with which a plane is not found.
const LOST: f64 = 1e-8;

/// More steps, and more halvings of one, than planes take.
const MOST_STEPS: usize = 100;
const MOST_HALVINGS: usize = 60;

/// Two unit vectors across n.
fn tangents(n: &Vec3) -> [Vec3; 2] {
    let first = n.cross(&Vec3::ith(n.iamin(), 1.0)).normalize();
    [first, n.cross(&first)]
}

/// The plane of least potential.
///
/// # Errors
/// [`PairFault`] if nothing separates the bodies, or the plane is beyond the digits of a number.
pub(super) fn place(
    laws: &PairLaws,
    halves: [&Half; 2],
    guess: Option<&Guess>,
    room: &mut [Moments],
) -> Result<Placed, PairFault> {
    let guessed = guess.and_then(|guess| Placed::at(laws, halves, guessed(halves, guess)?, room).ok());
    let mut placed = match guessed {
        Some(placed) => placed,
        None => Placed::at(laws, halves, separate(halves).map_err(PairFault::of_gap)?, room)?,
    };
    let mut left = f64::INFINITY;
    for _ in 0..MOST_STEPS {
        let step = -placed.curvature.solve(&placed.gradient);
        let decrement = -step.dot(&placed.gradient);
        let falls = decrement >= NEAR || decrement <= 0.25 * left;
        left = decrement;
        if decrement <= CONVERGED || !falls {
            break;
        }
        let Some(next) = placed.descend(laws, halves, &step, decrement, room) else { break };
        let stays = next.plane == placed.plane;
        placed = next;
        // Digits tell no other plane.
        if stays {
            break;
        }
    }
    // A plane that is not in balance would push without a potential.
    if left < LOST { Ok(placed) } else { Err(PairFault::NotFound { decrement: left }) }
}

impl Placed {
    /// At a plane, of least potential or not.
    ///
    /// # Errors
    /// [`PairFault`] if it does not separate the bodies, or a potential is no number.
    pub fn at(laws: &PairLaws, halves: [&Half; 2], plane: Plane, room: &mut [Moments]) -> Result<Self, PairFault> {
        let power = 0.5 / (laws.repulsion.exponent - 1.0);
        let tangents = tangents(&plane.normal);
        let [above, below] = halves;
        let potentials = [above.potential(laws, &plane, room)?, below.potential(laws, &plane, room)?];
        // The lower one has the larger s; their ratio may be too small for a number, not too large.
        let [low, high] = if potentials[0].value <= potentials[1].value { [0, 1] } else { [1, 0] };
        let mut parts = halves.map(|half| half.root_share);
        parts[high] *= libm::pow(potentials[low].value / potentials[high].value, power);
        let parts = parts.map(|part| part / (parts[0] + parts[1]));
        // U = U_i (s_i²/w_i)^(ν−1), of the side whose part is the larger.
        let larger = usize::from(parts[1] > parts[0]);
        let squeezed = (parts[larger] / halves[larger].root_share).powi(2);
        let energy = potentials[larger].value * raised(squeezed, laws.repulsion.exponent - 1.0);
        let weights = [0, 1].map(|i| parts[i] * energy / potentials[i].value);
        let zeros = Vec3::zeros();
        let heights = halves.map(|half| {
            let [one, other] = tangents.map(|tangent| half.heights_by(&tangent, 0.0));
            Matrix4x3::from_columns(&[one, other, half.heights_by(&zeros, 1.0)])
        });
        let slopes = [0, 1].map(|i| -heights[i].tr_mul(&potentials[i].first) / potentials[i].value);
        let gradient: Vec3 = parts[0] * slopes[0] + parts[1] * slopes[1];
        let bent = laws.repulsion.exponent - 1.0;
        let mut curvature = power * gradient * gradient.transpose() + Mat3::from_diagonal(&Vec3::new(bent, bent, 0.0));
        for i in 0..2 {
            let own = heights[i].tr_mul(&(potentials[i].second * heights[i])) / potentials[i].value;
            curvature += parts[i] * (own - (1.0 + power) * slopes[i] * slopes[i].transpose());
        }
        let curvature = curvature.cholesky().ok_or(PairFault::NotFound { decrement: f64::NAN })?;
        let switching = 0.0;
        Ok(Self {
            plane,
            potentials,
            parts,
            energy,
            weights,
            tangents,
            heights,
            slopes,
            gradient,
            switching,
            curvature,
            power,
        })
    }

    /// Lets the pair begin at an energy U_c [J].
    pub fn switch(&mut self, threshold: f64) {
        let switch = Switch::at(threshold, self.energy);
        self.energy *= switch.value;
        self.weights = self.weights.map(|weight| switch.slope * weight);
        self.switching = switch.bend;
    }

    /// Whether they do nothing to each other.
    pub fn is_out_of_reach(&self) -> bool {
        self.weights == [0.0; 2]
    }

    /// A plane of less potential along a step; none if that is not to be had.
    fn descend(
        &self,
        laws: &PairLaws,
        halves: [&Half; 2],
        step: &Vec3,
        decrement: f64,
        room: &mut [Moments],
    ) -> Option<Self> {
        let mut part = 1.0;
        for _ in 0..MOST_HALVINGS {
            if let Ok(next) = Self::at(laws, halves, self.plane.moved(&self.tangents, &(part * step)), room)
                && (next.energy <= self.energy * (1.0 + ROUNDING) || decrement < NEAR)
            {
                return Some(next);
            }
            part *= 0.5;
        }
        None
    }

    /// A change of the coordinates of both, (δq_A, δq_B), with that of the plane.
    pub fn along(&self, halves: [&Half; 2], change: [&Mat34; 2]) -> Change {
        let own = [0, 1].map(|i| halves[i].sign * change[i].tr_mul(&self.plane.normal));
        let growth =
            |heights: [Vec4; 2]| [0, 1].map(|i| -self.potentials[i].first.dot(&heights[i]) / self.potentials[i].value);
        let mean = |growth: [f64; 2]| self.parts[0] * growth[0] + self.parts[1] * growth[1];
        let at_rest = growth(own);
        let mut right = Vec3::zeros();
        for i in 0..2 {
            let Potential { value, first, second } = &self.potentials[i];
            let turned = halves[i].sign * change[i] * first;
            let tilted = Vec3::new(self.tangents[0].dot(&turned), self.tangents[1].dot(&turned), 0.0);
            let slope = (self.heights[i].tr_mul(&(second * own[i])) - tilted) / *value - self.slopes[i] * at_rest[i];
            right += self.parts[i] * (slope - self.power * (at_rest[i] - mean(at_rest)) * self.slopes[i]);
        }
        let moved = -self.curvature.solve(&right);
        let heights = [0, 1].map(|i| own[i] + self.heights[i] * moved);
        let by_side = growth(heights);
        let growth = mean(by_side);
        Change {
            normal: self.tangents[0] * moved.x + self.tangents[1] * moved.y,
            first: [0, 1].map(|i| -(self.potentials[i].second * heights[i])),
            weights: by_side.map(|side| (1.0 + self.power) * (growth - side) + self.switching * growth),
            heights,
        }
    }
}

/// What changes with the coordinates of two bodies.
#[derive(Debug, Clone, Copy)]
pub(super) struct Change {
    /// δn.
    pub normal: Vec3,
    /// δz.
    pub heights: [Vec4; 2],
    /// δa.
    pub first: [Vec4; 2],
    /// δ log λ.
    pub weights: [f64; 2],
}
