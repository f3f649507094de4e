//! A lattice in the five coordinates of a form, divided into simplices: between its nodes, functions are linear.
//!
//!   t = s/h = ⌊t⌋ + f,   f_π(1) ≥ … ≥ f_π(5),   node_0 = ⌊t⌋,   node_k = node_k−1 + e_π(k)
//!   C(s) = Σ w_k C(node_k),   w_k = f_π(k) − f_π(k+1)   (f_π(0) = 1, f_π(6) = 0),   ∂C/∂s_π(k) = (C(node_k) − C(node_k−1))/h
//!
//! The weights are not negative and add up to one: what is between positive definite matrices is positive definite.
//! Where C depends on the place alone, so does the interpolant; it is continuous, and its slopes jump from one simplex
//! to the next. Source: Freudenthal (1942), Kuhn (1960).

use super::stretch::Strain;

/// A node, in units of the spacing.
pub type Node = [i32; 5];
/// How many corners a simplex has.
pub const CORNERS: usize = 6;

/// A simplex: its first node and the order π in which the others are reached.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Simplex {
    first: Node,
    order: [u8; 5],
}

/// A place in a simplex.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LatticePlace {
    /// Where it is.
    pub simplex: Simplex,
    /// w_k.
    pub weights: [f64; CORNERS],
}

/// A place that is this near to a node along an axis, in units of the spacing, is there: the rounding of a symmetric
/// form does not choose between the cells on either side of the plane of symmetry.
const ROUNDING: f64 = 1e-12;

impl LatticePlace {
    /// Of coordinates in a lattice of spacing h; none where they are not finite.
    pub fn of(strain: &Strain, spacing: f64) -> Option<Self> {
        let scaled = strain / spacing;
        if !scaled.iter().all(|t| t.abs() < f64::from(i32::MAX)) {
            return None;
        }
        let snapped = scaled.map(|t| if (t - t.round()).abs() < ROUNDING { t.round() } else { t });
        let parts = snapped.map(|t| t - t.floor());
        let mut order = [0_u8, 1, 2, 3, 4];
        // Stable, so that equal parts keep the order of their axes.
        order.sort_by(|a, b| parts[usize::from(*b)].total_cmp(&parts[usize::from(*a)]));
        let part = |k: usize| match k {
            0 => 1.0,
            CORNERS => 0.0,
            k => parts[usize::from(order[k - 1])],
        };
        let weights = std::array::from_fn(|k| part(k) - part(k + 1));
        // Within the range of the integers, as seen above.
        let first = std::array::from_fn(|axis| snapped[axis].floor() as i32);
        Some(Self { simplex: Simplex { first, order }, weights })
    }
}

impl Simplex {
    /// Its nodes in order.
    pub fn corners(&self) -> [Node; CORNERS] {
        let mut corners = [self.first; CORNERS];
        for k in 1..CORNERS {
            corners[k] = corners[k - 1];
            corners[k][self.axis(k)] += 1;
        }
        corners
    }

    /// π(k), the axis along which the corner k lies from the one before it.
    pub fn axis(&self, k: usize) -> usize {
        usize::from(self.order[k - 1])
    }

    /// Its centre of gravity.
    pub fn center(&self, spacing: f64) -> Strain {
        self.corners().iter().map(|node| strain(node, spacing)).sum::<Strain>() / CORNERS as f64
    }
}

/// s of a node.
pub fn strain(node: &Node, spacing: f64) -> Strain {
    Strain::from(node.map(|count| spacing * f64::from(count)))
}

#[cfg(test)]
mod tests {
    use super::*;

    const SPACING: f64 = 0.3;

    fn places() -> impl Iterator<Item = Strain> {
        (0..200).map(|n| Strain::from_fn(|m, _| 2.0 * (1.7 * f64::from(n) + 2.3 * (m * m) as f64).sin()))
    }

    #[test]
    fn weights_are_shares_and_give_the_place_back() {
        for s in places() {
            let place = LatticePlace::of(&s, SPACING).unwrap_or_else(|| panic!("{s}"));
            assert!(place.weights.iter().all(|weight| *weight >= 0.0));
            let corners = place.simplex.corners();
            let back: Strain = corners.iter().zip(place.weights).map(|(node, w)| w * strain(node, SPACING)).sum();
            assert!((back - s).norm() < 1e-14);
            let center = LatticePlace::of(&place.simplex.center(SPACING), SPACING).unwrap_or_else(|| panic!("{s}"));
            assert_eq!(center.simplex, place.simplex);
        }
    }

    #[test]
    fn rounding_does_not_leave_a_plane_of_symmetry() {
        for rounding in [-1e-16, 0.0, 1e-16] {
            let place = LatticePlace::of(&Strain::from([0.1, 0.2, 0.05, rounding, 0.0]), SPACING);
            let corners = place.map(|place| place.simplex.corners());
            assert!(corners.is_some_and(|corners| corners.iter().all(|node| node[3] >= 0)));
        }
        assert_eq!(LatticePlace::of(&Strain::repeat(f64::NAN), SPACING), None);
    }
}
