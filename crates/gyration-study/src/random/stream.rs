//! Random streams: one for each seed, number and name, begun without those before it.
//!
//! PCG XSL RR 128/64 (O'Neill 2014), whose increment is the stream. Whatever is drawn from one says nothing of another, and
//! nothing of the order in which runs are made.

use rand_core::Rng;
use rand_pcg::Pcg64;

/// A stream of random numbers.
#[derive(Debug, Clone)]
pub struct Stream(Pcg64);

impl Stream {
    /// The stream of a seed, a number (of a run, of a point) and a name (of a parameter).
    pub fn new(seed: u64, number: u64, name: &str) -> Self {
        let state = u128::from(mix(seed ^ 0x9E37_79B9_7F4A_7C15)) << 64 | u128::from(mix(number));
        Self(Pcg64::new(state, hash(name.as_bytes())))
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

/// The finalizer of SplitMix64 (Stafford's variant 13): each bit of the result depends on each of the argument.
pub fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
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

    #[test]
    fn streams_of_neighbours_have_nothing_in_common() {
        // Means and correlations of 10⁴ first numbers: standard deviations 1/√(12 N) and 1/√N; four of them are allowed.
        let count = 10_000;
        let first = |seed: u64, name: &str| -> Vec<f64> {
            (0..count).map(|run| Stream::new(seed, run, name).uniform() - 0.5).collect()
        };
        let streams = [first(0, "a"), first(0, "b"), first(1, "a"), first(0, "a").into_iter().skip(1).collect()];
        let n = count as f64;
        for (index, one) in streams.iter().enumerate() {
            let mean = one.iter().sum::<f64>() / n;
            assert!(mean.abs() < 4.0 / (12.0 * n).sqrt(), "mean {mean}");
            for other in &streams[..index] {
                let correlation = 12.0 / n * one.iter().zip(other).map(|(x, y)| x * y).sum::<f64>();
                assert!(correlation.abs() < 4.0 / n.sqrt(), "correlation {correlation}");
            }
        }
    }

    #[test]
    fn numbers_stay_within_the_open_interval() {
        assert!(unit(0) > 0.0 && unit(u64::MAX) < 1.0);
        assert_eq!(hash(b"foobar"), 0x343e_1662_793c_64bf_6f0d_3597_ba44_6f18);
    }
}
