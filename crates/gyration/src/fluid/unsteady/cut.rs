//! Integrals over the cut of √p, by which motions with a history force are given in closed form.

/// ∫₀^∞ f(q) dq for a smooth f that is O(1) at 0 and O(q^−2) at infinity.
///
/// The trapezoid rule in ln q, which converges exponentially, with steps halved until the sum changes by 1e-12 of
/// itself: the error is then that of rounding. A sharp resonance asks for short steps; at the shortest it may have a
/// relative width of 1e-6.
pub(super) fn integral(f: impl Fn(f64) -> f64) -> f64 {
    // Beyond e^±40 less than 1e-17 is left.
    const REACH: f64 = 40.0;
    const HALVINGS: usize = 20;
    let mut step = REACH / 256.0;
    let term = |logarithm: f64| {
        let q = libm::exp(logarithm);
        q * f(q)
    };
    let mut sum = step * (-256..=256).map(|index| term(f64::from(index) * step)).sum::<f64>();
    for _ in 0..HALVINGS {
        let count = (REACH / step).round() as i64;
        let between = step * (-count..count).map(|index| term((index as f64 + 0.5) * step)).sum::<f64>();
        let finer = 0.5 * (sum + between);
        let settled = (finer - sum).abs() <= 1e-12 * finer.abs();
        sum = finer;
        step *= 0.5;
        if settled {
            break;
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn integrals_have_their_known_values() {
        let gauss = integral(|q| (-q * q * 1e4).exp());
        assert!((gauss - 0.005 * PI.sqrt()).abs() < 1e-14 * gauss);
        // A peak of relative width 1e-2.
        let peak = integral(|q| 1e-2 / ((q - 1.0).powi(2) + 1e-4));
        assert!((peak - (PI - 1e-2_f64.atan())).abs() < 1e-13, "{peak}");
    }
}
