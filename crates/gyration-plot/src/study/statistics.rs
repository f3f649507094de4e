//! Intervals in which a mean or a proportion is believed to lie, and the test of equal chances.
//!
//!   mean        x̄ ± t₀.₉₇₅(n − 1) s/√n                                                   (Student)
//!   proportion  [p̂ + z²/2n ± z √(p̂(1 − p̂)/n + z²/4n²)]/(1 + z²/n),   z = z₀.₉₇₅            (Wilson 1927)
//!   χ² = Σ (nᵢ − n/k)²/(n/k);   P(χ² > x) = Q((k − 1)/2, x/2),   Q(a + 1, y) = Q(a, y) + yᵃ e^−y/Γ(a + 1)

/// The quantile 0.975 of the normal distribution.
const Z: f64 = 1.959_963_984_540_054;

/// A number and the interval of 95 % about it; without an interval the ends are NaN.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// The number.
    pub value: f64,
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

/// The mean of values; its interval needs two of them. NaN without any.
pub fn mean(values: &[f64]) -> Estimate {
    let n = values.len() as f64;
    let value = values.iter().sum::<f64>() / n;
    if values.len() < 2 {
        return Estimate { value, low: f64::NAN, high: f64::NAN };
    }
    let variance = values.iter().map(|x| (x - value).powi(2)).sum::<f64>() / (n - 1.0);
    let half = student(n - 1.0) * (variance / n).sqrt();
    Estimate { value, low: value - half, high: value + half }
}

/// The proportion of `hits` among `n`; NaN if `n` is 0.
pub fn proportion(hits: usize, n: usize) -> Estimate {
    let (count, n) = (hits as f64, n as f64);
    let value = count / n;
    let scale = 1.0 + Z * Z / n;
    let center = (value + Z * Z / (2.0 * n)) / scale;
    let half = Z / scale * (value * (1.0 - value) / n + Z * Z / (4.0 * n * n)).sqrt();
    Estimate { value, low: center - half, high: center + half }
}

/// The quantile 0.975 of Student's distribution with so many degrees of freedom.
///
/// Exact for one and two, else by the expansion of Abramowitz and Stegun 26.7.5, within 1e-3 from four on.
pub fn student(freedom: f64) -> f64 {
    if freedom < 1.5 {
        return 12.706_204_736;
    }
    if freedom < 2.5 {
        return 4.302_652_730;
    }
    let power = |k: i32| Z.powi(k);
    let terms = [
        (power(3) + Z) / 4.0,
        (5.0 * power(5) + 16.0 * power(3) + 3.0 * Z) / 96.0,
        (3.0 * power(7) + 19.0 * power(5) + 17.0 * power(3) - 15.0 * Z) / 384.0,
        (79.0 * power(9) + 776.0 * power(7) + 1482.0 * power(5) - 1920.0 * power(3) - 945.0 * Z) / 92160.0,
    ];
    terms.iter().rev().fold(0.0, |sum, term| (sum + term) / freedom) + Z
}

/// χ² of counts against equal chances, and the probability of a larger one.
pub fn chi_square(counts: &[usize]) -> (f64, f64) {
    let expected = counts.iter().sum::<usize>() as f64 / counts.len() as f64;
    let value = counts.iter().map(|count| (*count as f64 - expected).powi(2) / expected).sum();
    (value, exceeds(value, counts.len() - 1))
}

/// P(χ² > x) with so many degrees of freedom.
fn exceeds(x: f64, freedom: usize) -> f64 {
    let y = 0.5 * x;
    let odd = freedom % 2 == 1;
    let (mut order, mut tail) = if odd { (0.5, erfc(y.sqrt())) } else { (1.0, libm::exp(-y)) };
    // yᵃ e^−y/Γ(a + 1): for a = ½ it is 2 √(y/π) e^−y.
    let mut term = libm::exp(-y) * if odd { 2.0 * (y / std::f64::consts::PI).sqrt() } else { y };
    while order < 0.5 * freedom as f64 {
        tail += term;
        order += 1.0;
        term *= y / order;
    }
    if freedom == 0 { 1.0 } else { tail.min(1.0) }
}

/// The complementary error function for x ≥ 0, within 1.5e-7: Abramowitz and Stegun 7.1.26.
fn erfc(x: f64) -> f64 {
    let t = 1.0 / (1.0 + 0.327_591_1 * x);
    let factors = [1.061_405_429, -1.453_152_027, 1.421_413_741, -0.284_496_736, 0.254_829_592];
    factors.iter().fold(0.0, |sum, factor| (sum + factor) * t) * libm::exp(-x * x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn students_quantiles_are_those_of_the_tables() {
        // Tables with three decimals; the expansion is off by 6e-3 at three degrees of freedom.
        let table = [(1.0, 12.706, 1e-3), (2.0, 4.303, 1e-3), (3.0, 3.182, 7e-3), (4.0, 2.776, 2e-3)];
        let rest = [(10.0, 2.228, 1e-3), (30.0, 2.042, 1e-3), (1000.0, 1.962, 1e-3)];
        for (freedom, expected, tolerance) in table.into_iter().chain(rest) {
            assert!((student(freedom) - expected).abs() < tolerance, "{freedom}: {}", student(freedom));
        }
    }

    #[test]
    fn wilsons_interval_never_leaves_zero_to_one() {
        // 0 of 10: [0, z²/(n + z²)]; 81 of 263: Newcombe (1998), method 3: 0.2553 to 0.3662.
        let none = proportion(0, 10);
        assert!(none.low.abs() < 1e-15 && (none.high - Z * Z / (10.0 + Z * Z)).abs() < 1e-12, "{none:?}");
        let some = proportion(81, 263);
        assert!((some.low - 0.2553).abs() < 1e-4 && (some.high - 0.3662).abs() < 1e-4, "{some:?}");
    }

    #[test]
    fn tails_of_chi_square_are_those_of_the_tables() {
        for (freedom, limit) in [(1, 3.841), (2, 5.991), (3, 7.815), (5, 11.070), (10, 18.307)] {
            assert!((exceeds(limit, freedom) - 0.05).abs() < 2e-5, "{freedom}: {}", exceeds(limit, freedom));
        }
        assert_eq!(chi_square(&[10, 10, 10]), (0.0, 1.0));
        assert!((exceeds(20.515, 5) - 1e-3).abs() < 1e-6);
    }

    #[test]
    fn mean_of_one_value_has_no_interval() {
        let one = mean(&[3.0]);
        assert!(one.value == 3.0 && one.low.is_nan());
        let two = mean(&[1.0, 3.0]);
        assert!((two.high - (2.0 + 12.706_204_736)).abs() < 1e-9, "{two:?}");
    }
}
