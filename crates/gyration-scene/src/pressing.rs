//! A body that lies on a level plane, on the side on which its centre is lowest.
//!
//!   F(d) = m g,   F = ∫ α (d_X/d₀)^−ν dA
//!
//! d the gap of the lowest point, d_X that of a point X of the surface: the body is weighed as it is in its reference
//! shape.

use gyration::body::Solid;
use gyration::contact::{
    AreaMeasure, ContactLaw, ContactLoads, ContactScratch, LawSet, Meeting, RelativeMotion, Repulsion,
};
use gyration::surface::{GapField, Surface};
use gyration::tensor::{Mat3, Vec3};

/// Gaps among which that of rest is sought, over the size of the body.
pub(crate) const GAPS: [f64; 2] = [1e-12, 1e2];

/// A body that lies on its lowest side.
#[derive(Debug, Clone, Copy)]
pub struct Pressing<'a> {
    /// What it is.
    pub solid: &'a Solid,
    /// m g \[N\].
    pub weight: f64,
    surface: &'a Surface,
    /// Pᵀn of the plane below.
    direction: Vec3,
}

impl<'a> Pressing<'a> {
    /// A body under gravity \[m/s²\]; none without a surface or weight.
    pub fn new(solid: &'a Solid, gravity: f64) -> Option<Self> {
        let (surface, weight) = (solid.surface.as_ref()?, solid.mass.mass * gravity);
        let direction = -solid.shape.lowest_side(&solid.mass.center);
        (weight > 0.0).then_some(Self { solid, weight, surface, direction })
    }

    /// Twice the height of its centre over the plane that it would touch \[m\]: the side of a cube, the diameter of a
    /// ball, the thickness of a coin.
    pub fn thickness(&self) -> f64 {
        -2.0 * self.surface.smallest_gap(&GapField::new(0.0, self.direction)).0
    }

    /// α \[Pa\] with which it lies at the gap d₀ \[m\]; not a number where it has no such place.
    pub fn strength(&self, gap: f64, exponent: f64) -> f64 {
        let law = Repulsion { alpha: 1.0, exponent, reference_gap: gap };
        let laws = LawSet::new(AreaMeasure::DeformedArea, vec![ContactLaw::Repulsion(law)]);
        let motion = RelativeMotion { normal: self.direction, velocity: Vec3::zeros(), gradient_rate: Mat3::zeros() };
        let field = self.surface.field_at(gap, self.direction);
        let meeting = Meeting { surface: self.surface, field, motion, deformation: None };
        let loads = ContactLoads::integrate(&laws, &meeting, &mut ContactScratch::default());
        loads.map_or(f64::NAN, |loads| self.weight / loads.total().force.dot(&self.direction))
    }

    /// The gap \[m\] at which it lies on a repulsion: where α (d/d₀)^−ν = α₁, α₁ the strength that it needs there as
    /// d₀. None where it has no such gap.
    pub fn rest_gap(&self, law: &Repulsion) -> Option<f64> {
        let Repulsion { alpha, exponent, reference_gap } = *law;
        let size = self.solid.shape.size();
        let excess = |logarithm: f64| {
            let needed = self.strength(libm::exp(logarithm), exponent);
            libm::log(alpha / needed) - exponent * (logarithm - libm::log(reference_gap))
        };
        root_of_falling(GAPS.map(|gap| libm::log(gap * size)), excess).map(libm::exp)
    }
}

/// Where a falling function changes its sign, to the last digit; none where it does not.
pub(crate) fn root_of_falling([mut low, mut high]: [f64; 2], function: impl Fn(f64) -> f64) -> Option<f64> {
    let ends = [function(low), function(high)];
    if ends[0].is_nan() || ends[0] < 0.0 || ends[1] > 0.0 {
        return None;
    }
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return Some(middle);
        }
        if function(middle) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gyration::shape::{Cuboid, Shape, Sphere};
    use std::f64::consts::PI;

    const LAW: Repulsion = Repulsion { alpha: 300.0, exponent: 6.0, reference_gap: 1e-3 };

    fn solid(shape: Shape) -> Solid {
        let mass = shape.mass_properties(1000.0);
        Solid::new(shape, mass)
    }

    /// F = α (d/d₀)^−ν a² of a face, beside which the sides are nothing at small gaps.
    #[test]
    fn a_box_lies_on_its_widest_side_at_the_gap_of_that_face() {
        let solid = solid(Shape::Box(Cuboid { size: [0.02, 0.2, 0.3].into() }));
        let body = Pressing::new(&solid, 10.0).unwrap();
        assert!((body.thickness() - 0.02).abs() < 1e-16, "{}", body.thickness());
        let gap = 1e-3 * (300.0 * 0.06 / body.weight).powf(1.0 / 6.0);
        assert!((body.rest_gap(&LAW).unwrap() / gap - 1.0).abs() < 1e-3);
    }

    /// F = πRα d₀ (d/d₀)^(1−ν)·2/(ν−1) (1 − …) of a ball, whose far side is nothing at small gaps.
    #[test]
    fn a_ball_lies_at_its_gap_and_strength_and_gap_agree() {
        let solid = solid(Shape::Sphere(Sphere { radius: 0.05 }));
        let body = Pressing::new(&solid, 10.0).unwrap();
        assert!((body.thickness() - 0.1).abs() < 1e-16, "{}", body.thickness());
        let gap = 1e-3 * (2.0 * PI * 0.05 * 1e-3 * 300.0 / (5.0 * body.weight)).powf(0.2);
        let found = body.rest_gap(&LAW).unwrap();
        assert!((found / gap - 1.0).abs() < 1e-2, "{found:e} {gap:e}");
        let again = Repulsion { alpha: body.strength(found, 6.0), reference_gap: found, ..LAW };
        assert!((body.rest_gap(&again).unwrap() / found - 1.0).abs() < 1e-12);
        assert!(Pressing::new(&solid, 0.0).is_none());
    }
}
