//! What adhesion does to two bodies at the plane that something else places.
//!
//! W(q, y) is a function of the coordinates and of the plane, y*(q) where r(q, y*) = 0 (`expansion`), so that
//!
//!   −dW/dq = −∂W/∂q + p·∂r/∂q,   K p = ∂W/∂y
//!   (f | M)_i = σ_i [n⊗(A_i + e_i) − b_i p_t⊗a_i],   A_i = −Σ ∂W/∂U_i^m ∂U_i^m/∂z,   b_i = s_i/U_i
//!   e_i = b_i (h_iζ_i − ω_i a_i),   ζ_i = Z_i p,   ω_i = −(1+q) π_i + q Σ s_jπ_j,   π_i = −a_i·ζ_i/U_i
//!
//! p_t is what p turns n by. Without the part of p the forces of the two would not be opposite.

use super::expansion::Expansion;
use super::fault::PairFault;
use super::mean::Mean;
use super::plane::Plane;
use super::pull::{Pull, PullTerm};
use super::side::{Half, Potential};
use super::{Mat34, Vec4};
use crate::surface::Moments;
use crate::tensor::Vec3;

/// What adhesion does at a plane in balance, whatever its reach.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pulled {
    /// W [J].
    pub energy: f64,
    /// Σ |W| of its powers [J].
    pub stored: f64,
    pub terms: [Option<Term>; 2],
    /// A.
    pub pulls: [Vec4; 2],
    /// p_t.
    pub turn: Vec3,
    pub carried: [Carried; 2],
    /// (f | M).
    pub on: [Mat34; 2],
}

/// A power of the gap at a plane.
#[derive(Debug, Clone, Copy)]
pub(super) struct Term {
    pub law: PullTerm,
    pub mean: Mean,
    /// U_i of this power, with the strength of the law.
    pub potentials: [Potential; 2],
}

/// What the shift p of the plane brings to a side.
#[derive(Debug, Clone, Copy)]
pub(super) struct Carried {
    /// b.
    pub scale: f64,
    /// ζ.
    pub heights: Vec4,
    /// h ζ.
    pub stiff: Vec4,
    /// π.
    pub growth: f64,
    /// ω.
    pub weight: f64,
    /// e.
    pub pull: Vec4,
}

/// U of a side, from the moments of the plan of adhesion.
fn potential(law: &PullTerm, moments: &[Moments]) -> Potential {
    Potential::new(law.coefficient(), law.exponent, law.places.map(|place| &moments[place]))
}

impl Term {
    /// ±λ of a side.
    pub fn weight(&self, side: usize) -> f64 {
        self.law.sign * self.mean.parts[side] * self.mean.energy / self.potentials[side].value
    }

    /// At a plane, from the moments of both sides.
    fn new(law: &PullTerm, halves: [&Half; 2], moments: [&[Moments]; 2]) -> Self {
        let potentials = moments.map(|own| potential(law, own));
        let values = potentials.each_ref().map(|potential| potential.value);
        let mean = Mean::of(values, halves.map(|half| half.root_share), law.exponent);
        Self { law: *law, mean, potentials }
    }
}

/// Σ Z_iᵀv_i: what v_A·δz_A + v_B·δz_B is by the three numbers of planes.
pub(super) fn by_plane(halves: [&Half; 2], tangents: &[Vec3; 2], v: [&Vec4; 2]) -> Vec3 {
    halves[0].by_plane(tangents, v[0]) + halves[1].by_plane(tangents, v[1])
}

/// What a shift p of the plane brings to both sides.
pub(super) fn carried(expansion: &Expansion, halves: [&Half; 2], shift: &Vec3) -> [Carried; 2] {
    let Mean { parts, power, .. } = expansion.mean;
    let heights = halves.map(|half| expansion.heights_after(half, shift));
    let growth = expansion.growth(&heights);
    let mean = expansion.mean.along(growth);
    [0, 1].map(|i| {
        let Potential { value, first, second } = &expansion.potentials[i];
        let scale = parts[i] / value;
        let stiff = second * heights[i];
        let weight = power * mean - (1.0 + power) * growth[i];
        let pull = scale * (stiff - weight * first);
        Carried { scale, heights: heights[i], stiff, growth: growth[i], weight, pull }
    })
}

impl Carried {
    /// e of a part of a side, given its potential.
    fn of_part(&self, own: &Potential) -> Vec4 {
        self.scale * (own.second * self.heights - self.weight * own.first)
    }

    /// (f | M)/σ, given A + e and a.
    fn on(&self, normal: &Vec3, turn: &Vec3, pull: &Vec4, first: &Vec4) -> Mat34 {
        normal * pull.transpose() - self.scale * turn * first.transpose()
    }
}

impl Pulled {
    /// (f | M)/σ on a part of a side, given the moments of adhesion over it and its potential.
    pub fn on_part(&self, side: usize, normal: &Vec3, moments: &[Moments], own: &Potential) -> Mat34 {
        let pull = |term: &Term| term.weight(side) * potential(&term.law, moments).first;
        let pull: Vec4 = self.terms.iter().flatten().map(pull).sum();
        let carried = &self.carried[side];
        carried.on(normal, &self.turn, &(pull + carried.of_part(own)), &own.first)
    }

    /// At a plane in balance, about which log U is expanded.
    ///
    /// # Errors
    /// [`PairFault`] if a potential is no number.
    pub fn new(
        pull: &Pull,
        halves: [&Half; 2],
        expansion: &Expansion,
        room: [&mut [Moments]; 2],
    ) -> Result<Self, PairFault> {
        let plane: &Plane = &expansion.plane;
        let [above, below] = room;
        halves[0].moments(plane, &pull.values, above)?;
        halves[1].moments(plane, &pull.values, below)?;
        let terms = pull.terms.map(|law| law.map(|law| Term::new(&law, halves, [&*above, &*below])));
        let (mut energy, mut stored) = (0.0, 0.0);
        let mut pulls = [Vec4::zeros(); 2];
        for term in terms.iter().flatten() {
            energy += term.law.sign * term.mean.energy;
            stored += term.mean.energy;
            for (side, pull) in pulls.iter_mut().enumerate() {
                *pull += term.weight(side) * term.potentials[side].first;
            }
        }
        let by_plane = by_plane(halves, &expansion.tangents, pulls.each_ref());
        if !(energy.is_finite() && by_plane.iter().all(|number| number.is_finite())) {
            return Err(PairFault::NotFound { decrement: f64::NAN });
        }
        let shift = -expansion.curvature.solve(&by_plane);
        let turn = expansion.turned(&shift);
        let carried = carried(expansion, halves, &shift);
        let on = [0, 1].map(|i| {
            let (pull, first) = (pulls[i] + carried[i].pull, &expansion.potentials[i].first);
            halves[i].sign * carried[i].on(&plane.normal, &turn, &pull, first)
        });
        Ok(Self { energy, stored, terms, pulls, turn, carried, on })
    }
}
