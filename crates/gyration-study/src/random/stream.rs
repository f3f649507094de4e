//! Random streams: one for each seed, number and name, begun without those before it.
//!
//! ChaCha with 8 rounds (Bernstein 2008) under the key (seed, number, name): as far as anybody can tell, streams of
//! different keys have nothing in common. (Streams of a linear generator that differ in their increment alone do: they
//! are shifted copies.)

use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};

/// A stream of random numbers.
#[derive(Debug)]
pub struct RandomStream(ChaCha8Rng);

impl RandomStream {
    /// The stream of a seed, a number (of a run, of a point) and a name (of a parameter).
    pub fn new(seed: u64, number: u64, name: &str) -> Self {
        let mut key = [0; 32];
        key[..8].copy_from_slice(&seed.to_le_bytes());
        key[8..16].copy_from_slice(&number.to_le_bytes());
        key[16..].copy_from_slice(&hash(name.as_bytes()).to_le_bytes());
        Self(ChaCha8Rng::from_seed(key))
    }

    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0.next_u64()
    }

    /// A number in (0, 1).
    pub fn uniform(&mut self) -> f64 {
        unit(self.bits())
    }
}

/// The number in (0, 1) that the first 52 of 64 binary digits give: the middle of its interval, so neither 0 nor 1.
///
/// With one digit more, the last middle would be rounded to 1.
pub fn unit(bits: u64) -> f64 {
    ((bits >> 12) as f64 + 0.5) * (0.5_f64).powi(52)
}

/// FNV-1a of 128 bits.
pub fn hash(bytes: &[u8]) -> u128 {
    const OFFSET: u128 = 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d;
    const PRIME: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013B;
    bytes.iter().fold(OFFSET, |hash, byte| (hash ^ u128::from(*byte)).wrapping_mul(PRIME))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// χ² of the first numbers of two streams over 6,000 runs, on 8 × 8 cells.
    fn chi_squared([one, other]: [(u64, &str); 2]) -> f64 {
        const RUNS: u64 = 6_000;
        let mut cells = [0.0; 64];
        for run in 0..RUNS {
            let [row, column] =
                [one, other].map(|(seed, name)| (8.0 * RandomStream::new(seed, run, name).uniform()) as usize);
            cells[8 * row + column] += 1.0;
        }
        let expected = RUNS as f64 / 64.0;
        cells.iter().map(|count| (count - expected).powi(2) / expected).sum()
    }

    #[test]
    fn streams_of_other_names_and_seeds_are_independent() {
        let names = ["height", "frequency", "radius", "modulus", "spin", "theta", "b", "p1", "attitude", "damping"];
        let keys: Vec<(u64, &str)> = (0..3).flat_map(|seed| names.map(|name| (seed, name))).collect();
        let pairs = keys.iter().enumerate().flat_map(|(index, one)| keys[..index].iter().map(|other| [*one, *other]));
        let found: Vec<f64> = pairs.map(chi_squared).collect();
        // 63 degrees of freedom: 63 ± 11.2; of 435 pairs one in a hundred sets has one above 119, five standard
        // deviations.
        let mean = found.iter().sum::<f64>() / found.len() as f64;
        let most = found.iter().copied().fold(0.0, f64::max);
        println!("χ² of {} pairs: mean {mean:.2}, largest {most:.1}", found.len());
        assert!((mean - 63.0).abs() < 4.0 * 11.2 / (found.len() as f64).sqrt(), "{mean}");
        assert!(most < 119.0, "{most}");
    }

    #[test]
    fn streams_of_neighbouring_runs_are_independent() {
        // Means and products of neighbours: standard deviations 1/√(12 N) and 1/√N; four of them are allowed.
        let first: Vec<f64> = (0..10_001).map(|run| RandomStream::new(0, run, "a").uniform() - 0.5).collect();
        let mean = first.iter().sum::<f64>() / 1e4;
        let correlation = 12.0 / 1e4 * first.windows(2).map(|pair| pair[0] * pair[1]).sum::<f64>();
        assert!(mean.abs() < 4.0 / 120e3_f64.sqrt() && correlation.abs() < 0.04, "{mean} {correlation}");
    }

    #[test]
    fn numbers_stay_within_the_open_interval() {
        assert!(unit(0) > 0.0 && unit(u64::MAX) < 1.0);
        assert_eq!(hash(b"foobar"), 0x343e_1662_793c_64bf_6f0d_3597_ba44_6f18);
    }
}
