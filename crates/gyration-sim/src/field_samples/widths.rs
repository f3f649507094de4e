//! The widths with which the bodies of a recording can be seen.

use super::NoFields;
use crate::fields::Weight;
use crate::replay::Replay;
use gyration::lattice::Lattice;
use gyration::tensor::Vec3;
use std::f64::consts::PI;

/// A width and the extent of the bodies are no farther apart: below, ten digits of r/b are left of the places; above,
/// all bodies are in one place to twelve.
const PROPORTION: f64 = 1e6;
/// A point sees no more bodies that follow one another without end, each some 0.1 µs, where a program waits for it.
pub(super) const MOST_SEEN: f64 = 2e7;
/// The same where a page does.
pub(super) const MOST_ON_PAGE: f64 = 2e5;

/// The widths that there are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Widths {
    /// The diagonal of the box of all centres, with the largest body and the longest period; a metre of what has none
    /// \[m\].
    extent: f64,
    /// The largest with which a point does not see too many; no limit without periods \[m\].
    in_ring: f64,
    /// How many are too many.
    most_seen: f64,
}

impl Widths {
    /// Of a recording and the corners of the box of its centres, where a point may see so many bodies.
    pub fn of(replay: &Replay, [low, high]: &[Vec3; 2], most_seen: f64) -> Self {
        let bodies = &replay.model().bodies;
        let periods = replay.periods().vectors().iter().map(Vec3::norm).fold(0.0, f64::max);
        let sizes = bodies.iter().map(|body| body.size).fold(0.0, f64::max);
        let extent = (high - low).norm() + sizes + periods;
        let extent = if extent > 0.0 { extent } else { 1.0 };
        Self { extent, in_ring: widest_in_ring(replay.periods(), most_seen / bodies.len().max(1) as f64), most_seen }
    }

    /// The largest \[m\].
    pub fn widest(&self) -> f64 {
        self.in_ring.min(PROPORTION * self.extent)
    }

    /// The weight of a width \[m\].
    ///
    /// # Errors
    /// `Width`, `Extent`, `Wide`.
    pub fn weight(&self, width: f64) -> Result<Weight, NoFields> {
        let [least, most] = [self.extent / PROPORTION, self.extent * PROPORTION];
        let width = length(width)?;
        if width > self.in_ring {
            return Err(NoFields::Wide { width, most: self.in_ring, seen: self.most_seen });
        }
        if width < least || width > most {
            return Err(NoFields::Extent { width, least, most });
        }
        Ok(Weight::new(width))
    }
}

/// A width, if it is a length at all.
pub(super) fn length(width: f64) -> Result<f64, NoFields> {
    if width > 0.0 && width.is_finite() { Ok(width) } else { Err(NoFields::Width(width)) }
}

/// The largest width with which a point sees no more than so many images of a body, in the cells that the box of its
/// reach touches: along a period at least one \[m\]. To three digits, so that it can be written.
fn widest_in_ring(periods: &Lattice, most: f64) -> f64 {
    // Along each period, with a width of a metre.
    let reach = Weight::new(1.0).reach();
    let mut images: Vec<f64> = periods.reciprocal().iter().map(|vector| reach * vector.norm() / PI).collect();
    images.sort_by(|one, other| other.total_cmp(one));
    let most = most.max(1.0);
    let (mut widest, mut seen) = (f64::INFINITY, 1.0);
    for (images, count) in images.iter().zip(1..) {
        seen *= images;
        widest = f64::min(widest, libm::pow(most / seen, 1.0 / f64::from(count)));
    }
    if widest.is_finite() { rounded_down(widest) } else { widest }
}

/// The first three digits of a number.
fn rounded_down(number: f64) -> f64 {
    let digit = libm::pow(10.0, libm::log10(number).floor() - 2.0);
    // The number that is written so.
    format!("{:.2e}", (number / digit).floor() * digit).parse().unwrap_or(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring(periods: &[Vec3], bodies: usize) -> f64 {
        widest_in_ring(&Lattice::new(periods.to_vec()).unwrap(), MOST_ON_PAGE / bodies as f64)
    }

    #[test]
    fn a_width_in_a_ring_is_that_of_its_bodies_and_not_of_its_cell() {
        let [x, y, z] = [Vec3::x(), Vec3::y(), Vec3::z()];
        // 18 images a period and width: 2e5/18, √2e5/18, ∛2e5/18.
        assert_eq!([ring(&[x], 1), ring(&[x, y], 1), ring(&[x, y, z], 1)], [11100.0, 24.8, 3.24]);
        assert_eq!([ring(&[4.0 * x, 4.0 * y], 16), ring(&[2.0 * x, 2.0 * y, 2.0 * z], 8)], [24.8, 3.24]);
        // Along a period that is longer than the reach there is one image: the short one alone counts.
        assert_eq!(ring(&[x, 1e9 * y], 1), 11100.0);
        // More bodies than may be seen: each once.
        assert_eq!(ring(&[100.0 * x, 100.0 * y, 100.0 * z], 1_000_000), 5.55);
        assert_eq!(widest_in_ring(&Lattice::default(), 3.0), f64::INFINITY);
    }

    #[test]
    fn widths_are_in_proportion_to_the_bodies() {
        let widths = Widths { extent: 2.0, in_ring: f64::INFINITY, most_seen: MOST_ON_PAGE };
        for width in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(widths.weight(width), Err(NoFields::Width(_))), "{width}");
        }
        for width in [1e-200, 1.9e-6, 2.1e6, 1e308] {
            assert!(matches!(widths.weight(width), Err(NoFields::Extent { .. })), "{width}");
        }
        assert!([2.1e-6, 1.9e6].iter().all(|width| widths.weight(*width).is_ok()));
        let in_ring = Widths { in_ring: 3.0, ..widths };
        assert!(in_ring.weight(in_ring.widest()).is_ok());
        let told = in_ring.weight(1e9).unwrap_err().to_string();
        assert_eq!(
            told,
            "with the width 1.00e9 m each point sees more than 200000 bodies of a ring: write one of 3 m or less"
        );
    }
}
