//! log U of two bodies about a plane, to second order in the three numbers of planes.
//!
//!   s_i = √w_i U_i^−q/Σ,   U = Σ^(−1/q),   q = 1/(2(ν−1)),   ∂U/∂U_i = λ_i = s_i U/U_i
//!
//! A plane has three free numbers: n turns along two tangents, and c. Z_i (4×3) is how z_i changes with them. With ρ_i
//! = −Z_iᵀa_i/U_i,
//!
//!   r = Σ s_i ρ_i,   K = Σ s_i [Z_iᵀh_iZ_i/U_i − (1+q) ρ_i⊗ρ_i] + q r⊗r + (ν−1) diag(1, 1, 0)
//!
//! the last of which is what |n| = 1 brings, since L + (ν−1) log|y| does not change along y. K is positive.

use super::areas::{AreaPotentials, Stretch, potentials_along, stretch};
use super::fault::PairFault;
use super::laws::PairLaws;
use super::mean::Mean;
use super::placed::{Placed, Switch};
use super::plane::Plane;
use super::side::{Half, Potential};
use super::{Mat34, Vec4};
use crate::surface::Moments;
use crate::tensor::{Mat3, Vec3};
use nalgebra::{Cholesky, Const};

/// L = log U about a plane.
#[derive(Debug, Clone)]
pub(super) struct Expansion {
    pub plane: Plane,
    pub potentials: [Potential; 2],
    /// U, s and q.
    pub mean: Mean,
    /// The directions in which n turns.
    pub tangents: [Vec3; 2],
    /// ρ.
    slopes: [Vec3; 2],
    /// r.
    gradient: Vec3,
    /// K.
    pub curvature: Cholesky<f64, Const<3>>,
}

/// A Newton step of the plane, whole.
#[derive(Debug, Clone, Copy)]
pub(super) struct Step {
    /// −K⁻¹r.
    pub by: Vec3,
    /// The squared Newton decrement r·K⁻¹r.
    pub decrement: f64,
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
    /// δ log U.
    pub growth: f64,
    /// δ log U_i.
    pub by_side: [f64; 2],
    /// What the area factors change of U_i, and of its derivatives by z.
    pub areas: Option<[Potential; 2]>,
    /// How the moments of each side change with its area factor.
    pub stretch: [Option<Stretch>; 2],
    /// What the plane moves by.
    pub plane: Vec3,
}

/// Two unit vectors across n.
fn tangents(n: &Vec3) -> [Vec3; 2] {
    let first = n.cross(&Vec3::ith(n.iamin(), 1.0)).normalize();
    [first, n.cross(&first)]
}

impl Expansion {
    /// About a plane, of least potential or not.
    ///
    /// # Errors
    /// [`PairFault`] if it does not separate the bodies, or a potential is no number.
    pub fn about(laws: &PairLaws, halves: [&Half; 2], plane: Plane, room: &mut [Moments]) -> Result<Self, PairFault> {
        let tangents = tangents(&plane.normal);
        let [above, below] = halves;
        let potentials = [above.potential(laws, &plane, room)?, below.potential(laws, &plane, room)?];
        let values = potentials.each_ref().map(|potential| potential.value);
        let mean = Mean::of(values, halves.map(|half| half.root_share), laws.repulsion.exponent);
        let Mean { parts, power, .. } = mean;
        let slopes = [0, 1].map(|i| -halves[i].by_plane(&tangents, &potentials[i].first) / potentials[i].value);
        let gradient: Vec3 = parts[0] * slopes[0] + parts[1] * slopes[1];
        let bent = laws.repulsion.exponent - 1.0;
        let mut curvature = power * gradient * gradient.transpose() + Mat3::from_diagonal(&Vec3::new(bent, bent, 0.0));
        for i in 0..2 {
            let own = halves[i].bent_by_plane(&tangents, &potentials[i].second) / potentials[i].value;
            curvature += parts[i] * (own - (1.0 + power) * slopes[i] * slopes[i].transpose());
        }
        let curvature = curvature.cholesky().ok_or(PairFault::NotFound { decrement: f64::NAN })?;
        Ok(Self { plane, potentials, mean, tangents, slopes, gradient, curvature })
    }

    /// The step to where the gradient of the expansion vanishes.
    pub fn step(&self) -> Step {
        let by = -self.curvature.solve(&self.gradient);
        Step { by, decrement: -by.dot(&self.gradient) }
    }

    /// The plane after a part of a step.
    pub fn moved(&self, part: f64, step: &Step) -> Plane {
        self.plane.moved(&self.tangents, &(part * step.by))
    }

    /// η: no gap changes by more than this part of it with a step, given the radii R of both about their centres [m]
    /// and their smallest gaps [m].
    ///
    ///   η = max (|δg₀| + |δm| R)/d
    pub fn stretch(&self, halves: [&Half; 2], radii: [f64; 2], gaps: [f64; 2], step: &Step) -> f64 {
        let of_side = |i: usize| {
            let change = self.heights_after(halves[i], &step.by);
            (change[0].abs() + radii[i] * change.fixed_rows::<3>(1).norm()) / gaps[i]
        };
        of_side(0).max(of_side(1))
    }

    /// The smaller s.
    pub fn least_part(&self) -> f64 {
        self.mean.parts[0].min(self.mean.parts[1])
    }

    /// The plane in balance, as if this one were.
    pub fn placed(&self) -> Placed {
        Placed {
            plane: self.plane,
            tangents: self.tangents,
            energy: self.mean.energy,
            first: [0, 1].map(|i| self.potentials[i].first),
            weights: [0, 1].map(|i| self.mean.parts[i] * self.mean.energy / self.potentials[i].value),
            switch: Switch::NONE,
        }
    }

    /// The plane after a step, and what is exchanged there, in first order; U, which is least there, changes in second.
    pub fn placed_after(&self, halves: [&Half; 2], step: &Step) -> Placed {
        let plane = self.moved(1.0, step);
        let Placed { energy, first, weights, switch, .. } = self.placed();
        let heights = halves.map(|half| self.heights_after(half, &step.by));
        let growth = self.growth(&heights);
        let mean = self.mean.along(growth);
        Placed {
            plane,
            tangents: tangents(&plane.normal),
            energy,
            first: [0, 1].map(|i| first[i] - self.potentials[i].second * heights[i]),
            weights: [0, 1].map(|i| weights[i] * (1.0 + (1.0 + self.mean.power) * (mean - growth[i]))),
            switch,
        }
    }

    /// δn, given what the plane moves by.
    pub fn turned(&self, by: &Vec3) -> Vec3 {
        self.tangents[0] * by.x + self.tangents[1] * by.y
    }

    /// δz of a side.
    pub fn heights_after(&self, half: &Half, by: &Vec3) -> Vec4 {
        half.heights_by(&self.turned(by), by.z)
    }

    /// δ log U_i, given δz.
    pub fn growth(&self, heights: &[Vec4; 2]) -> [f64; 2] {
        [0, 1].map(|i| -self.potentials[i].first.dot(&heights[i]) / self.potentials[i].value)
    }

    /// A change of the coordinates of both, (δq_A, δq_B), with that of the plane in balance, which this one is; δ log
    /// χ′ by δ log U is `switching`.
    pub fn along(&self, halves: [&Half; 2], change: [&Mat34; 2], switching: f64, areas: &AreaPotentials) -> Change {
        let own = [0, 1].map(|i| halves[i].sign * change[i].tr_mul(&self.plane.normal));
        let stretch = [0, 1].map(|i| stretch(halves[i], change[i]));
        let areas = potentials_along(areas, &stretch);
        let swollen = |growth: [f64; 2]| match &areas {
            Some(areas) => [0, 1].map(|i| growth[i] + areas[i].value / self.potentials[i].value),
            None => growth,
        };
        let at_rest = swollen(self.growth(&own));
        let mean_at_rest = self.mean.along(at_rest);
        let mut right = Vec3::zeros();
        for i in 0..2 {
            let Potential { value, first, second } = &self.potentials[i];
            let turned = halves[i].sign * change[i] * first;
            let tilted = Vec3::new(self.tangents[0].dot(&turned), self.tangents[1].dot(&turned), 0.0);
            let lost = areas.as_ref().map_or_else(|| second * own[i], |areas| second * own[i] - areas[i].first);
            let slope = (halves[i].by_plane(&self.tangents, &lost) - tilted) / *value - self.slopes[i] * at_rest[i];
            right += self.mean.parts[i] * (slope - self.mean.power * (at_rest[i] - mean_at_rest) * self.slopes[i]);
        }
        let moved = -self.curvature.solve(&right);
        let heights = [0, 1].map(|i| own[i] + self.heights_after(halves[i], &moved));
        let by_side = swollen(self.growth(&heights));
        let growth = self.mean.along(by_side);
        let mut first = [0, 1].map(|i| -(self.potentials[i].second * heights[i]));
        if let Some(areas) = &areas {
            first.iter_mut().zip(areas).for_each(|(first, own)| *first += own.first);
        }
        Change {
            normal: self.turned(&moved),
            first,
            weights: by_side.map(|side| (1.0 + self.mean.power) * (growth - side) + switching * growth),
            growth,
            by_side,
            areas,
            stretch,
            plane: moved,
            heights,
        }
    }
}
