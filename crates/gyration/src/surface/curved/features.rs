//! Where an integral over the parallels of an ellipsoid needs fine resolution.
//!
//! As a function of the polar angle θ from the lowest point f, the integral of the area element |B s| around a parallel
//! is analytic, but singular close to real θ where the parallel touches the place where |B s| dips: the ends ±e_i of the
//! longest axis (B_i smallest), at cos θ = |f_i|, and the great circle normal to the shortest axis (B_j largest), at
//! sin θ = |f_j|. The distance of the singularity is about (|B s| in the dip)/(largest B). The gap vanishes at θ = iη.

use std::f64::consts::PI;

use crate::tensor::Vec3;

/// Places θ in [0, π] with the distance of the singularity from each, in increasing order of θ.
#[derive(Debug, Clone, Copy)]
pub(super) struct Features {
    places: [(f64, f64); 6],
    count: usize,
}

impl Features {
    /// The features for gaps from `near` to `far`, cofactor B and lowest direction f.
    pub(super) fn new(near: f64, far: f64, cofactor: &Vec3, lowest: &Vec3) -> Self {
        /// Dips wider than this share of the sphere need no care of their own.
        const SMOOTH: f64 = 0.8;
        let (i, j) = (cofactor.imin(), cofactor.imax());
        let largest = cofactor[j];
        let grazing = 2.0 * (near / far).sqrt().min(1.0 - 1e-9).atanh();
        let mut features = Self { places: [(0.0, f64::INFINITY); 6], count: 0 };
        features.push(0.0, grazing);
        features.push(PI, 2.0);
        let tip = cofactor[i] / largest;
        if tip < SMOOTH {
            let angle = lowest[i].abs().min(1.0).acos();
            features.push(angle, tip);
            features.push(PI - angle, tip);
            let mut touching = *lowest;
            touching[j] = 0.0;
            let length = touching.norm();
            let dip =
                if length > 1e-8 { cofactor.component_mul(&touching).norm() / length } else { cofactor[i] } / largest;
            let angle = lowest[j].abs().min(1.0).asin();
            if dip < SMOOTH && length > 1e-8 {
                features.push(angle, dip);
                features.push(PI - angle, dip);
            }
        }
        features.sorted()
    }

    fn push(&mut self, place: f64, width: f64) {
        self.places[self.count] = (place, width);
        self.count += 1;
    }

    /// In order, each width reduced to the distance of the nearest singularity of any feature.
    fn sorted(mut self) -> Self {
        let given = self.places;
        for place in &mut self.places[..self.count] {
            let distance = |other: &(f64, f64)| other.1.hypot(place.0 - other.0);
            place.1 = given[..self.count].iter().map(distance).fold(place.1, f64::min);
        }
        self.places[..self.count].sort_by(|a, b| a.0.total_cmp(&b.0));
        self
    }

    /// The intervals (from, to, width) that cover 0 ≤ θ ≤ `last`, `from` being the end to grade to.
    pub(super) fn intervals(&self, last: f64) -> impl Iterator<Item = (f64, f64, f64)> {
        let places = self.places;
        (1..self.count).flat_map(move |k| {
            let ((left, left_width), (right, right_width)) = (places[k - 1], places[k]);
            let middle = 0.5 * (left + right);
            let low = (left < middle.min(last)).then(|| (left, middle.min(last), left_width));
            let high = (middle < right.min(last)).then(|| {
                // A cut interval is still graded to the feature beyond the cut.
                if right <= last {
                    (right, middle, right_width)
                } else {
                    (last, middle, right_width.hypot(right - last))
                }
            });
            low.into_iter().chain(high)
        })
    }
}
