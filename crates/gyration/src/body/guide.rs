//! What the motion of a body is kept to: a plane, an axis, a line, strain without rotation.
//!
//! Each is a linear space of velocities (ṗ₀ | Ω) or (ṗ₀ | Ṗ) that does not change in time. The reaction takes no power:
//!
//!   p̈₀ = Π_c a,   Ω̇ = b (I b·α)/(b·I b),   P̈ = Π A                a, α, A without it
//!
//! b is the axis of a rigid body in its own axes; it stands still in space too. The centre and P are apart in the
//! metric of the mass. Source: `docs/theory-rigid.md`, `docs/theory-affine.md`.

use super::{Body, RigidInertia, Slots};
use crate::affine::StrainGuide;
use crate::extended::Extended;
use crate::kinematics::Quaternion;
use crate::tensor::{Mat3, Vec3};
use nalgebra::DMatrix;

/// What the motion of a body is kept to; the part of P of a body that deforms stands with its interior.
#[derive(Debug, Clone, PartialEq)]
pub struct Guide {
    /// p₀ of the start \[m\].
    pub position: Vec3,
    /// Π_c; none where the centre is free, or pinned.
    pub center: Option<Mat3>,
    /// How a rigid body may turn; none where it may turn at will, or deforms.
    pub turn: Option<TurnGuide>,
}

/// How a rigid body may turn: about one axis, or not at all.
#[derive(Debug, Clone, PartialEq)]
pub struct TurnGuide {
    /// The orientation of the start.
    start: Quaternion,
    /// b, unit vector in the body's axes; none if the body does not turn.
    axis: Option<Vec3>,
    /// b ⊗ I b/(b·I b).
    map: Mat3,
}

impl TurnGuide {
    /// About an axis of space (any length but zero), or not at all.
    pub fn new(axis: Option<&Vec3>, start: Quaternion, inertia: &RigidInertia) -> Self {
        let axis = axis.map(|axis| start.rotation().tr_mul(axis).normalize());
        let map = axis.map_or_else(Mat3::zeros, |b| {
            let weighed = inertia.tensor * b;
            b * weighed.transpose() / b.dot(&weighed)
        });
        Self { start: start.normalized(), axis, map }
    }

    /// The axis in space at an orientation of the body, unit vector; none if the body does not turn.
    pub fn axis_in_space(&self, orientation: &Quaternion) -> Option<Vec3> {
        self.axis.map(|axis| orientation.rotation() * axis)
    }

    /// Ω, or Ω̇, without what the reaction takes.
    pub fn within(&self, spin: &Vec3) -> Vec3 {
        self.map * spin
    }

    /// Puts a quaternion back to a turn from the start about the axis.
    fn restore(&self, quaternion: &mut [f64]) {
        let [w, x, y, z] = self.start.0;
        let [turned, rest @ ..] = Quaternion([w, -x, -y, -z]).times(&Quaternion::read(quaternion)).0;
        let along = self.axis.map_or_else(Vec3::zeros, |axis| axis * axis.dot(&Vec3::from(rest)));
        let restored = self.start.times(&Quaternion([turned, along.x, along.y, along.z]));
        quaternion.copy_from_slice(&restored.0);
    }
}

impl Guide {
    /// Puts p₀ and ṗ₀ back, if the state has them; what p₀ lacks, if it is known, is that of the start and of the way
    /// from there, which has the digits of one number.
    fn restore_center(&self, position: &mut [f64], lacking: &mut [f64], velocity: &mut [f64]) {
        let Some(center) = &self.center else { return };
        if !position.is_empty() {
            let way = Vec3::from_fn(|i, _| position[i] - self.position[i] + lacking.get(i).unwrap_or(&0.0));
            let placed = center * way;
            for (i, place) in position.iter_mut().enumerate() {
                let sum = Extended::sum(self.position[i], placed[i]);
                *place = sum.high;
                if let Some(lacking) = lacking.get_mut(i) {
                    *lacking = sum.low;
                }
            }
        }
        if !velocity.is_empty() {
            let moved = center * Vec3::from_column_slice(velocity);
            velocity.copy_from_slice(moved.as_slice());
        }
    }
}

impl Body {
    /// How it may deform, if it deforms and is kept to something.
    pub fn strain_guide(&self) -> Option<&StrainGuide> {
        self.affine()?.interior.guide.as_deref()
    }

    /// Π of (velocity, rate), the velocities that its guide allows; none without a guide.
    pub fn guided_velocities(&self) -> Option<DMatrix<f64>> {
        let guide = self.guide.as_ref()?;
        let slots = Slots::with_inertia(self, 0);
        let (first, count) = (slots.velocity().len(), slots.velocities().len());
        let mut within = DMatrix::identity(count, count);
        if let (Some(center), 1..) = (&guide.center, first) {
            within.view_mut((0, 0), (3, 3)).copy_from(center);
        }
        if let Some(strain) = self.strain_guide() {
            within.view_mut((first, first), (9, 9)).copy_from(strain.map());
        } else if let Some(turn) = &guide.turn {
            within.view_mut((first, first), (3, 3)).copy_from(&turn.map);
        }
        Some(within)
    }

    /// Puts the numbers of its places and velocities back to what its motion is kept to, all of which may be empty: p₀,
    /// the quaternion or P, ṗ₀, and Ω or Ṗ; and what the numbers of p₀ lack, if that is known.
    pub fn restore_guided(&self, [position, attitude, velocity, rate]: [&mut [f64]; 4], lacking: &mut [f64]) {
        let Some(guide) = &self.guide else { return };
        guide.restore_center(position, lacking, velocity);
        if let Some(strain) = self.strain_guide() {
            for numbers in [attitude, rate] {
                if !numbers.is_empty() {
                    let within = strain.within(&Mat3::from_column_slice(numbers));
                    numbers.copy_from_slice(within.as_slice());
                }
            }
        } else if let Some(turn) = &guide.turn {
            turn.restore(attitude);
            if !rate.is_empty() {
                let within = turn.within(&Vec3::from_column_slice(rate));
                rate.copy_from_slice(within.as_slice());
            }
        }
    }
}
