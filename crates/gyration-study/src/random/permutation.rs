//! Permutations of any length without a table, for Latin hypercubes.
//!
//! A Feistel network permutes the numbers of an even count of bits; numbers beyond the length are passed on until one
//! falls within it (cycle walking: Black and Rogaway 2002), after four rounds of the network on average at most.

/// Rounds of the network: beyond four, what is left of the order is below what a study could see.
const ROUNDS: u64 = 6;

/// The place of `index` in the permutation of `length` that belongs to a key; `index` < `length`.
pub fn permuted(index: u64, length: u64, key: u64) -> u64 {
    let bits = 64 - length.saturating_sub(1).leading_zeros();
    let half = bits.div_ceil(2).max(1);
    let mut at = index;
    loop {
        at = encrypted(at, half, key);
        if at < length {
            return at;
        }
    }
}

/// One pass of the network over 2·half bits.
fn encrypted(number: u64, half: u32, key: u64) -> u64 {
    let mask = (1 << half) - 1;
    let (mut left, mut right) = (number >> half, number & mask);
    for round in 0..ROUNDS {
        let turned = left ^ (mix(right ^ mix(key.wrapping_add(round))) & mask);
        (left, right) = (right, turned);
    }
    left << half | right
}

/// The finalizer of SplitMix64 (Stafford's variant 13): each bit of the result depends on each of the argument.
fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_length_is_permuted() {
        for length in (1..70).chain([1000, 4096, 4097]) {
            for key in [0, 1, u64::MAX] {
                let mut seen: Vec<u64> = (0..length).map(|index| permuted(index, length, key)).collect();
                seen.sort_unstable();
                assert!(seen.into_iter().eq(0..length), "{length}");
            }
        }
    }

    #[test]
    fn places_do_not_remember_the_order() {
        // Correlation of index and place over 2000 numbers: deviation 1/√2000 = 0.022.
        let length = 2000;
        let middle = (length - 1) as f64 / 2.0;
        let variance = ((length * length - 1) as f64) / 12.0;
        for key in 0..20 {
            let sum: f64 =
                (0..length).map(|k| (k as f64 - middle) * (permuted(k, length, mix(key)) as f64 - middle)).sum();
            let correlation = sum / (length as f64 * variance);
            assert!(correlation.abs() < 4.0 * 0.0224, "{correlation}");
        }
    }
}
