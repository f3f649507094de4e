//! Random numbers that repeat: splitmix64, seeded by two numbers.

use std::f64::consts::TAU;

/// A stream of random numbers.
#[derive(Debug, Clone)]
pub struct Stream(u64);

impl Stream {
    /// The stream of a case of a seed; neighbouring ones have nothing in common.
    pub fn of(seed: u64, case: u64) -> Self {
        let mut first = Self(seed);
        let mut second = Self(first.word() ^ case);
        Self(second.word())
    }

    fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number in [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.word() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A number between two.
    pub fn between(&mut self, least: f64, most: f64) -> f64 {
        least + (most - least) * self.unit()
    }

    /// A power of ten between two exponents.
    pub fn decade(&mut self, least: f64, most: f64) -> f64 {
        10_f64.powf(self.between(least, most))
    }

    /// Whether an event of this probability happens.
    pub fn chance(&mut self, probability: f64) -> bool {
        self.unit() < probability
    }

    /// An index below a count.
    pub fn index(&mut self, count: usize) -> usize {
        ((self.unit() * count as f64) as usize).min(count - 1)
    }

    /// One of several.
    pub fn pick<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.index(list.len())]
    }

    /// A vector of unit length in any direction.
    pub fn direction(&mut self) -> [f64; 3] {
        let z = self.between(-1.0, 1.0);
        let (sin, cos) = self.between(0.0, TAU).sin_cos();
        let r = (1.0 - z * z).sqrt();
        [r * cos, r * sin, z]
    }

    /// A matrix with entries between −1 and 1.
    pub fn matrix(&mut self) -> [[f64; 3]; 3] {
        [(); 3].map(|()| [(); 3].map(|()| self.between(-1.0, 1.0)))
    }

    /// A turn in any direction, as a quaternion.
    pub fn turn(&mut self) -> [f64; 4] {
        let (sin, cos) = self.between(0.0, 0.5 * TAU).sin_cos();
        let [x, y, z] = self.direction();
        [cos, sin * x, sin * y, sin * z]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stream_depends_on_its_seed_and_its_case() {
        let first = |seed, case| Stream::of(seed, case).unit();
        assert_eq!(first(1, 2), first(1, 2));
        assert!(first(1, 2) != first(2, 1) && first(1, 2) != first(1, 3));
    }

    #[test]
    fn numbers_fill_their_range() {
        let mut stream = Stream::of(0, 0);
        let (mut least, mut most) = (1.0_f64, 0.0_f64);
        for _ in 0..1000 {
            let number = stream.unit();
            (least, most) = (least.min(number), most.max(number));
        }
        assert!((0.0..0.01).contains(&least) && (0.99..1.0).contains(&most), "{least} {most}");
    }
}
