//! What two bodies exchange at their plane, its derivatives, and the slab between them: told, not computed.

use super::plane::Guess;
use crate::contact::LawKind;
use crate::load::{COORDINATES, Loads, Mat12};
use crate::tensor::Vec3;
use nalgebra::ArrayStorage;

/// What a pair of bodies does to both.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct PairLoads {
    /// (f, M) on A and on B.
    pub on: [Loads; 2],
    /// U, with what adhesion stores [J].
    pub energy: f64,
    /// The sum of what each power of the gap stores, without signs [J]: the digits of the energy are those of it.
    pub stored: f64,
    /// The powers [W] of the laws on both bodies.
    pub powers: [f64; LawKind::COUNT],
    /// The width of the slab between the bodies along the normal [m].
    pub gap: f64,
    /// n, from B to A.
    pub normal: Vec3,
    /// Where the force of the repulsion passes through the plane [m].
    pub point: Vec3,
}

/// What a pair of bodies does to both, and its derivatives.
#[derive(Debug, Clone, PartialEq)]
pub struct PairSlopes {
    /// What it does.
    pub loads: PairLoads,
    /// ∂Q_i/∂q_j.
    pub by_place: [[Mat12; 2]; 2],
    /// ∂Q_i/∂q̇_j; none where no law feels velocities.
    pub by_rate: Option<[[Mat12; 2]; 2]>,
}

impl Default for PairSlopes {
    fn default() -> Self {
        Self { loads: PairLoads::default(), by_place: Self::ZEROS, by_rate: None }
    }
}

impl PairSlopes {
    /// No derivatives.
    pub(super) const ZEROS: [[Mat12; 2]; 2] = [[ZERO; 2]; 2];
}

const ZEROS: Vec3 = Vec3::new(0.0, 0.0, 0.0);
const ZERO: Mat12 = Mat12::from_array_storage(ArrayStorage([[0.0; COORDINATES]; COORDINATES]));

/// The slab between two bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairGap {
    /// Its width along the normal of their plane [m]; infinite where that was not asked for.
    pub gap: f64,
    /// How fast it widens [m/s].
    pub rate: f64,
    /// n, from B to A.
    pub normal: Vec3,
    /// ṅ [1/s].
    pub turning: Vec3,
    /// The part of it that is above the plane.
    pub share: f64,
    /// How fast that part grows [1/s]; zero between balls, whose plane is not searched.
    pub sharing: f64,
}

impl PairGap {
    /// Of bodies that are too far apart to ask.
    pub const FAR: Self =
        Self { gap: f64::INFINITY, rate: 0.0, normal: ZEROS, turning: ZEROS, share: 0.5, sharing: 0.0 };

    /// Where the plane will be after a time [s], if all goes on as it does; none for bodies that are far apart.
    pub fn guess(&self, after: f64) -> Option<Guess> {
        let normal = (self.normal + after * self.turning).try_normalize(0.0)?;
        // Neither side loses more than half of its part.
        let share = (self.share + after * self.sharing).clamp(0.5 * self.share, 0.5 * (1.0 + self.share));
        Some(Guess { normal, share })
    }
}
