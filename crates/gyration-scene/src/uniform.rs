//! Random numbers by a seed: ChaCha with 8 rounds.
//!
//!   q = (√(1−a) sin 2πb, √(1−a) cos 2πb, √a sin 2πc, √a cos 2πc)
//!
//! is uniform over the rotations for a, b, c uniform in [0, 1) (Shoemake 1992).

use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};
use gyration::kinematics::Quaternion;
use gyration::tensor::Vec3;
use std::f64::consts::TAU;

/// A stream of numbers uniform in [0, 1), the same for a seed on every machine.
#[derive(Debug)]
pub struct Uniform(ChaCha8Rng);

impl Uniform {
    /// The stream of a seed.
    pub fn of_seed(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    /// The next number.
    pub fn number(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 * 0.5_f64.powi(53)
    }

    /// A vector of three.
    pub(crate) fn vector(&mut self) -> Vec3 {
        Vec3::from([0; 3].map(|_| self.number()))
    }

    /// The quaternion of a rotation, every one being as likely.
    pub(crate) fn rotation(&mut self) -> Quaternion {
        let [a, b, c] = self.vector().into();
        let ((sin_b, cos_b), (sin_c, cos_c)) = (libm::sincos(TAU * b), libm::sincos(TAU * c));
        let (first, second) = ((1.0 - a).sqrt(), a.sqrt());
        Quaternion([first * sin_b, first * cos_b, second * sin_c, second * cos_c])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gyration::tensor::Mat3;

    #[test]
    fn every_rotation_is_as_likely() {
        let mut numbers = Uniform::of_seed(3);
        const COUNT: usize = 20_000;
        let mut mean = Mat3::zeros();
        let mut squares = Mat3::zeros();
        for _ in 0..COUNT {
            let q = numbers.rotation();
            assert!((q.norm() - 1.0).abs() < 1e-15);
            let rotation = q.rotation();
            mean += rotation / COUNT as f64;
            squares += rotation.component_mul(&rotation) / COUNT as f64;
        }
        // Of a uniform rotation ⟨R_ij⟩ = 0, ⟨R_ij²⟩ = 1/3 with variances 1/3 and 4/45: five deviations of the means.
        let (first, second) = (5.0 * (1.0 / 3.0 / COUNT as f64).sqrt(), 5.0 * (4.0 / 45.0 / COUNT as f64).sqrt());
        println!("largest mean {:.4} of {first:.4}", mean.amax());
        assert!(mean.amax() < first, "{mean}");
        assert!((squares - Mat3::repeat(1.0 / 3.0)).amax() < second, "{squares}");
    }
}
