//! Where to interpolate 1/√p, so that the error in time is small from the least lag to the span.
//!
//! Points of density ν in ln x, x = √p, make |B| = e^(−νπ²/2) on the real axis and e^(−νπ²/4) at arg x = π/4, where p
//! is imaginary and time is felt. Up to x = 1/√θ the kernel is wanted to the same digits everywhere, e^−Λ. Beyond, an
//! error that counts in ∫|κ − κ̃| dt may grow as √p: the digits needed, and with them the density, fall linearly in ln
//! x to zero at the length Λ (a taper, as in Newman's and Stahl's approximations of |x|). So with v = ln x from the
//! lowest point,
//!
//!   ν(v) = D min(Λ, Λ + l − v),    l = ½ ln(span/θ),    D = 4/π²
//!   ∫ν = D (Λl + Λ²/2) = m   ⇒   Λ = −l + √(l² + 2m/D)
//!
//! and the points lie where ∫ν is half-integer. At the low end they are moved from eᵛ to cosh v, as Zolotarev's points
//! gather at the end of an interval. For span = θ this is ε ~ e^−Λ = e^(−π√n) with n = m/2 modes.

use std::f64::consts::PI;

/// D in units of 4/π². At 1.15 rather than 1 a given number of modes reaches the least error, from 1e-3 to 1e-9: the
/// asymptotic law leaves out a factor of |B| that grows with the number of points.
const DENSITY: f64 = 1.15 * 4.0 / (PI * PI);

/// How many points, m = D (Λl + Λ²/2), the need Λ = `need` asks for; `reference` is θ ≤ span.
pub(super) fn count(need: f64, span: f64, reference: f64) -> f64 {
    DENSITY * need * (0.5 * libm::log(span / reference) + 0.5 * need)
}

/// Points xⱼ = (lowest/√span) cosh vⱼ, rising; `reference` is θ ≤ span.
pub(super) fn points(count: usize, lowest: f64, span: f64, reference: f64) -> Vec<f64> {
    let length = 0.5 * libm::log(span / reference);
    let need = (length * length + 2.0 * count as f64 / DENSITY).sqrt() - length;
    let place = |index: usize| {
        // ∫ν/D up to the point, and how much of it lies beyond v = l.
        let share = (index as f64 + 0.5) / DENSITY;
        let beyond = share - need * length;
        if beyond < 0.0 { share / need } else { length + need - (need * need - 2.0 * beyond).sqrt() }
    };
    (0..count).map(|index| lowest / span.sqrt() * libm::cosh(place(index))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn count_is_that_of_the_need() {
        // The last point lies half a point before the end, at v = l + Λ − √(1/D).
        let (need, span) = (12.0_f64, 1e4_f64);
        let points = points(count(need, span, 1.0).round() as usize, 1.0, span, 1.0);
        let last = points.last().unwrap() * span.sqrt();
        assert!((last.acosh() - (0.5 * span.ln() + need - (1.0 / DENSITY).sqrt())).abs() < 0.1);
    }

    #[test]
    fn points_rise_from_the_span_and_thin_out() {
        for (span, reference) in [(1.0, 1.0), (1e4, 1.0), (1e-5, 1e-5)] {
            let points = points(41, 2.0, span, reference);
            assert_eq!(points.len(), 41);
            assert!(points[0] > 2.0 / span.sqrt() && points[0] < 2.2 / span.sqrt());
            let gaps: Vec<f64> = points.windows(2).map(|pair| (pair[1] / pair[0]).ln()).collect();
            // cosh gathers the first ones; from there on the gaps widen.
            assert!(gaps.iter().all(|gap| *gap > 0.0) && gaps.windows(2).all(|pair| pair[1] > pair[0] - 1e-12));
        }
    }
}
