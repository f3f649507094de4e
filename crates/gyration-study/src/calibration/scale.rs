//! What the search varies in place of a number: its logarithm, or how many times its size it is; between bounds the
//! logit of its place. All are without dimension.
//!
//!   v = p/s or ln p;   u = v, or ln((v − a)/(b − v)) between bounds a < v < b
//!
//! The size s is |p₀| of the start, |p| once that is found far larger, or the way between the bounds.

use super::file;

/// How a number is varied.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Scale {
    pub kind: file::Scale,
    /// s, a whole change of it on a linear scale.
    pub size: f64,
    /// The bounds of the number.
    pub bounds: Option<[f64; 2]>,
}

/// Nearer to a bound than this part of the way between them, the number lies on it.
const ON_BOUND: f64 = 1e-3;

/// A number that is found larger than so many sizes has outgrown them. The pull of the start (`fit`) is meant for one
/// of its size: u of some thousands would make it strong.
const OUTGROWN: f64 = 2.0;

impl Scale {
    /// u of a number.
    pub fn inward(&self, number: f64) -> f64 {
        let value = self.value(number);
        match self.bounds() {
            Some([low, high]) => libm::log((value - low) / (high - value)),
            None => value,
        }
    }

    /// The number, and its derivative by u.
    pub fn outward(&self, u: f64) -> (f64, f64) {
        let (value, slope) = match self.bounds() {
            Some([low, high]) => {
                let part = 1.0 / (1.0 + libm::exp(-u));
                (low + (high - low) * part, (high - low) * part * (1.0 - part))
            }
            None => (u, 1.0),
        };
        match self.kind {
            file::Scale::Linear => (value * self.size, slope * self.size),
            file::Scale::Log => (libm::exp(value), libm::exp(value) * slope),
        }
    }

    /// dv/du at a number: one, or less between bounds.
    pub fn slope(&self, number: f64) -> f64 {
        let value = self.value(number);
        self.bounds().map_or(1.0, |[low, high]| (value - low) * (high - value) / (high - low))
    }

    /// Takes the size of a number that has outgrown its own, if nothing bounds it; whether it has.
    pub fn grow(&mut self, number: f64) -> bool {
        let is_linear = self.kind == file::Scale::Linear && self.bounds.is_none();
        let is_outgrown = is_linear && number.abs() > OUTGROWN * self.size;
        if is_outgrown {
            self.size = number.abs();
        }
        is_outgrown
    }

    /// Whether a number lies on a bound.
    pub fn is_on_bound(&self, number: f64) -> bool {
        self.bounds().is_some_and(|[low, high]| {
            let part = (self.value(number) - low) / (high - low);
            !(ON_BOUND..=1.0 - ON_BOUND).contains(&part)
        })
    }

    fn value(&self, number: f64) -> f64 {
        match self.kind {
            file::Scale::Linear => number / self.size,
            file::Scale::Log => libm::log(number),
        }
    }

    fn bounds(&self) -> Option<[f64; 2]> {
        self.bounds.map(|bounds| bounds.map(|bound| self.value(bound)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_come_back_and_slopes_are_derivatives() {
        for kind in [file::Scale::Log, file::Scale::Linear] {
            for bounds in [None, Some([0.5, 20.0])] {
                let scale = Scale { kind, size: 4.0, bounds };
                for number in [0.7, 3.0, 19.0] {
                    let u = scale.inward(number);
                    let (back, slope) = scale.outward(u);
                    let differences = (scale.outward(u + 1e-6).0 - scale.outward(u - 1e-6).0) / 2e-6;
                    // Rounding of the differences.
                    assert!((back - number).abs() < 1e-13 * number);
                    assert!((slope - differences).abs() < 1e-8 * number, "{slope} {differences}");
                }
            }
        }
    }

    #[test]
    fn only_what_nothing_bounds_outgrows_its_size() {
        let size_of = |kind, bounds, number| {
            let mut scale = Scale { kind, size: 4.0, bounds };
            assert_eq!(scale.grow(number), scale.size > 4.0);
            scale.size
        };
        assert_eq!(size_of(file::Scale::Linear, None, -9.0), 9.0);
        assert_eq!(size_of(file::Scale::Linear, None, 7.0), 4.0);
        assert_eq!(size_of(file::Scale::Linear, Some([0.0, 4.0]), 9.0), 4.0);
        assert_eq!(size_of(file::Scale::Log, None, 9.0), 4.0);
    }
}
