//! Numbers of twice the digits, y = high + low: a state whose small differences survive its large values.
//!
//! A body of 0.1 m that comes to rest 1e-13 m above its support has a gap that is the difference of two lengths of 0.1
//! m: of its sixteen digits three are left, and the force of a steep law is noise. What a step adds is known to all its
//! digits, since it is small. So it is added without loss,
//!
//!   s = fl(a + b),   e = (a − (s − (s − a))) + (b − (s − a)),   s + e = a + b exactly,
//!
//! and e is kept beside s. Source: Møller, *BIT* 5 (1965); Knuth, *TAOCP* 2, §4.2.2.

/// A vector of twice the digits, entry by entry high + low.
///
/// |low| is about half a unit in the last place of high.
#[derive(Debug, Clone, Copy)]
pub struct Extended<'a> {
    /// The numbers, rounded.
    pub high: &'a [f64],
    /// What they lack.
    pub low: &'a [f64],
}

/// A vector of twice the digits, to be changed.
#[derive(Debug)]
pub struct ExtendedMut<'a> {
    /// The numbers, rounded.
    pub high: &'a mut [f64],
    /// What they lack.
    pub low: &'a mut [f64],
}

/// a + b and what its rounding leaves out.
#[inline(always)]
pub(crate) fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let of_b = sum - a;
    (sum, (a - (sum - of_b)) + (b - of_b))
}

/// (high + low) + change, rounded to the nearest number and what that lacks.
#[inline(always)]
pub fn add(high: f64, low: f64, change: f64) -> (f64, f64) {
    let (sum, error) = two_sum(high, change);
    two_sum(sum, low + error)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thousand_small_changes_are_not_lost() {
        let (mut high, mut low, mut plain) = (0.1, 0.0, 0.1);
        let change = 1.7e-19;
        for _ in 0..1000 {
            (high, low) = add(high, low, change);
            plain += change;
        }
        // Half a unit of 0.1 is 7e-18: plain sums stay where they are.
        assert_eq!(plain, 0.1);
        assert!(((high - 0.1) + low - 1.7e-16).abs() < 1e-30, "{:e}", (high - 0.1) + low);
    }
}
