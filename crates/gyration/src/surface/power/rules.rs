//! Gauss–Legendre rules on [0, 1] with their weights multiplied by the powers of the node.
//!
//! Nodes and weights were computed with 40 digits by Newton's method on the Legendre polynomial; a test checks them
//! against the monomials that they integrate exactly.

use super::HIGHEST_DEGREE;

/// A rule ∫₀¹ x^k f dx ≈ Σ_i w_i x_i^k f(x_i).
#[derive(Debug)]
pub(super) struct Rule<const N: usize> {
    /// x_i.
    pub nodes: [f64; N],
    /// w_i x_i^k, one row for each k.
    pub weights: [[f64; N]; HIGHEST_DEGREE + 1],
}

impl<const N: usize> Rule<N> {
    const fn new(nodes: [f64; N], base: [f64; N]) -> Self {
        let mut weights = [base; HIGHEST_DEGREE + 1];
        let mut k = 1;
        while k <= HIGHEST_DEGREE {
            let mut i = 0;
            while i < N {
                weights[k][i] = weights[k - 1][i] * nodes[i];
                i += 1;
            }
            k += 1;
        }
        Self { nodes, weights }
    }
}

/// Four points.
pub(super) static FOUR_POINTS: Rule<4> = Rule::new(
    [0.069_431_844_202_973_71, 0.330_009_478_207_571_87, 0.669_990_521_792_428_1, 0.930_568_155_797_026_3],
    [0.173_927_422_568_726_93, 0.326_072_577_431_273_07, 0.326_072_577_431_273_07, 0.173_927_422_568_726_93],
);

/// Eight points.
pub(super) static EIGHT_POINTS: Rule<8> = Rule::new(
    [
        0.019_855_071_751_231_884,
        0.101_666_761_293_186_64,
        0.237_233_795_041_835_5,
        0.408_282_678_752_175_1,
        0.591_717_321_247_825,
        0.762_766_204_958_164_5,
        0.898_333_238_706_813_4,
        0.980_144_928_248_768_1,
    ],
    [
        0.050_614_268_145_188_13,
        0.111_190_517_226_687_24,
        0.156_853_322_938_943_63,
        0.181_341_891_689_181,
        0.181_341_891_689_181,
        0.156_853_322_938_943_63,
        0.111_190_517_226_687_24,
        0.050_614_268_145_188_13,
    ],
);

/// Twelve points.
pub(super) static TWELVE_POINTS: Rule<12> = Rule::new(
    [
        0.009_219_682_876_640_375,
        0.047_941_371_814_762_57,
        0.115_048_662_902_847_65,
        0.206_341_022_856_691_3,
        0.316_084_250_500_909_9,
        0.437_383_295_744_265_54,
        0.562_616_704_255_734_5,
        0.683_915_749_499_090_1,
        0.793_658_977_143_308_7,
        0.884_951_337_097_152_3,
        0.952_058_628_185_237_5,
        0.990_780_317_123_359_7,
    ],
    [
        0.023_587_668_193_255_914,
        0.053_469_662_997_659_21,
        0.080_039_164_271_673_11,
        0.101_583_713_361_532_96,
        0.116_746_268_269_177_4,
        0.124_573_522_906_701_39,
        0.124_573_522_906_701_39,
        0.116_746_268_269_177_4,
        0.101_583_713_361_532_96,
        0.080_039_164_271_673_11,
        0.053_469_662_997_659_21,
        0.023_587_668_193_255_914,
    ],
);

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_exact<const N: usize>(rule: &Rule<N>) {
        for degree in 0..2 * N {
            let sum: f64 = (0..N).map(|i| rule.weights[0][i] * rule.nodes[i].powi(degree as i32)).sum();
            let exact = 1.0 / (degree + 1) as f64;
            // Rounding of N terms.
            assert!((sum / exact - 1.0).abs() < 1e-14, "degree {degree} of {N} points: {sum:e} against {exact:e}");
        }
    }

    #[test]
    fn rules_integrate_monomials_up_to_twice_their_points() {
        assert_exact(&FOUR_POINTS);
        assert_exact(&EIGHT_POINTS);
        assert_exact(&TWELVE_POINTS);
    }
}
