//! A force per volume, b(x, t) [N/m³] at a point of space, over the volume that a body fills; of points per mass,
//! [N/kg].
//!
//!   f = ∫ b dv,   M = ∫ b ⊗ X dv,   dv = det P dV,   x = p₀ + P X
//!   ∂Q/∂q = ∫ (∂b/∂x) ⊗ X̃ ⊗ X̃ dv + Q ⊗ P⁻ᵀ         (by P alone)
//!
//! All of it is a sum over the points of a rule, which is exact where b is a polynomial of x: of degree d in b, d + 1
//! in M. Its work is always booked as one: b need have no potential.

use super::{LoadSlopes, Loads, add_blocks, unit};
use crate::kinematics::Placement;
use crate::shape::{Shape, VolumeRule};
use crate::tensor::{Mat3, Vec3};
use gyration_expression::{Expression, ParseError, Scratch, Undefined};

/// The numbers that a force per volume may have.
pub const POINT_NAMES: [&str; 4] = ["x", "y", "z", "t"];
/// The index of t among them.
const TIME: usize = 3;

/// Degree of the rule for what is no polynomial, where the shape allows it.
const DEGREE: usize = 9;
/// By how much the degree of the rule exceeds it with which it is compared.
const FINER: usize = 6;
/// The most points of a rule, unless a rule of the lowest degree has more.
const MOST_POINTS: usize = 4096;
/// The largest degree of a polynomial that is integrated exactly.
const LARGEST_DEGREE: usize = 12;

/// Differences below this part of the largest force are the rounding of places.
const ALIKE: f64 = 1e-9;

/// The components of b.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldOfForce([Expression; 3]);

/// A force per volume on a body.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyForce {
    field: FieldOfForce,
    rule: VolumeRule,
    /// True if the weights are masses, which deformation does not change.
    of_points: bool,
    /// The relative error of the rule at the start; none where it is exact.
    error: Option<f64>,
}

impl FieldOfForce {
    /// Reads the components.
    ///
    /// # Errors
    /// [`ParseError`] and which component.
    pub fn parse(texts: [&str; 3], constants: &[(String, f64)]) -> Result<Self, (usize, ParseError)> {
        let read = |component: usize| {
            let parsed = Expression::parse(texts[component], &POINT_NAMES, constants);
            parsed.map(|expression| expression.holding(&[TIME])).map_err(|error| (component, error))
        };
        Ok(Self([read(0)?, read(1)?, read(2)?]))
    }

    /// True if t stands in it.
    pub fn uses_time(&self) -> bool {
        self.0.iter().any(|component| component.uses(TIME))
    }

    /// The degree of the polynomial in x, y, z that b is; none if it is none.
    pub fn degree(&self) -> Option<usize> {
        self.0.iter().map(|component| component.degree(&[0, 1, 2])).try_fold(0, |most, degree| Some(degree?.max(most)))
    }

    /// Whether b is the same at these points and as far beyond them [m], at some times, to rounding; where it has no
    /// value it is.
    pub fn is_alike(&self, points: &[Vec3], beyond: &Vec3) -> bool {
        let scratch = &mut Scratch::default();
        let mut pairs = Vec::new();
        for time in [0.0, 0.37, 1.7] {
            for point in points {
                let mut value = |place: &Vec3| self.at(place, time, false, scratch).ok().map(|(force, _)| force);
                pairs.extend(value(point).zip(value(&(point + beyond))));
            }
        }
        let largest = pairs.iter().map(|(here, there)| here.amax().max(there.amax())).fold(0.0, f64::max);
        pairs.iter().all(|(here, there)| (here - there).amax() <= ALIKE * largest)
    }

    /// b and ∂b/∂x at a point.
    pub(super) fn at(
        &self,
        place: &Vec3,
        time: f64,
        slopes: bool,
        scratch: &mut Scratch,
    ) -> Result<(Vec3, Mat3), Undefined> {
        let (numbers, mut gradient) = ([place.x, place.y, place.z, time], [0.0; POINT_NAMES.len()]);
        let (mut force, mut by_place) = (Vec3::zeros(), Mat3::zeros());
        for (row, component) in self.0.iter().enumerate() {
            if slopes {
                force[row] = component.gradient(&numbers, scratch, &mut gradient)?;
                (0..3).for_each(|column| by_place[(row, column)] = gradient[column]);
            } else {
                force[row] = component.value(&numbers, scratch)?;
            }
        }
        Ok((force, by_place))
    }
}

impl BodyForce {
    /// A force on a shape whose centre of mass is there, with the rule that it needs; `place` at the `time` tells how
    /// wrong a rule is for what is no polynomial.
    ///
    /// # Errors
    /// [`Undefined`] where b has no value or derivative there.
    pub fn new(
        field: FieldOfForce,
        shape: &Shape,
        center: &Vec3,
        (place, time): (&Placement, f64),
    ) -> Result<Self, Undefined> {
        let of_points = matches!(shape, Shape::Points(_));
        let rule = |degree: usize| VolumeRule::of(shape, degree).translated(&-center);
        let made = |rule: VolumeRule| Self { field: field.clone(), rule, of_points, error: None };
        let scratch = &mut Scratch::default();
        let exact = field.degree().filter(|degree| *degree <= LARGEST_DEGREE);
        let Some(degree) = exact.map(|degree| degree + 1).filter(|_| !of_points) else {
            // Points are summed over, whatever b is.
            let mut degree = DEGREE;
            let mut chosen = rule(degree);
            while !of_points && chosen.nodes.len() > MOST_POINTS && degree > 2 {
                degree -= 1;
                chosen = rule(degree);
            }
            let mut found = made(chosen);
            found.differentiated(place, time, scratch)?;
            if !of_points {
                found.error = Some(found.apart_from(&made(rule(degree + FINER)), place, time)?);
            }
            return Ok(found);
        };
        let full = rule(degree);
        let bounds = shape.bounds();
        let lattice = (degree + 1).pow(3);
        let found = made(match full.nodes.len() > lattice {
            true => {
                let (min, max) = (bounds.min - center, bounds.max - center);
                full.condensed(&crate::shape::Bounds { min, max }, degree)
            }
            false => full,
        });
        found.differentiated(place, time, scratch)?;
        Ok(found)
    }

    /// b.
    pub fn field(&self) -> &FieldOfForce {
        &self.field
    }

    /// The relative error of its rule at the start; none where it is exact.
    pub fn error(&self) -> Option<f64> {
        self.error
    }

    /// Number of points of its rule.
    pub fn points(&self) -> usize {
        self.rule.nodes.len()
    }

    /// f and M.
    ///
    /// # Errors
    /// [`Undefined`] where b has no finite value.
    pub fn loads(&self, place: &Placement, time: f64, scratch: &mut Scratch) -> Result<Loads, Undefined> {
        let (mut force, mut moment) = (Vec3::zeros(), Mat3::zeros());
        for node in &self.rule.nodes {
            let (there, _) = self.field.at(&place.place(&node.at), time, false, scratch)?;
            let share = node.weight * there;
            force += share;
            moment += share * node.at.transpose();
        }
        Ok(Loads { force, moment }.scaled(self.growth(place)))
    }

    /// dv/dV, one of points.
    fn growth(&self, place: &Placement) -> f64 {
        if self.of_points { 1.0 } else { place.gradient.determinant() }
    }

    /// The derivatives, to find that they are there.
    fn differentiated(&self, place: &Placement, time: f64, scratch: &mut Scratch) -> Result<(), Undefined> {
        LoadSlopes::default().add_body_force(self, place, time, scratch)
    }

    /// The largest difference of f or M from those of a finer rule, in parts of ∫|b| dv and of that times the radius.
    fn apart_from(&self, finer: &Self, place: &Placement, time: f64) -> Result<f64, Undefined> {
        let scratch = &mut Scratch::default();
        let (one, other) = (self.loads(place, time, scratch)?, finer.loads(place, time, scratch)?);
        let (mut scale, mut radius) = (0.0, 0.0_f64);
        for node in &finer.rule.nodes {
            let (there, _) = finer.field.at(&place.place(&node.at), time, false, scratch)?;
            scale += (node.weight * finer.growth(place)).abs() * there.norm();
            radius = radius.max(node.at.norm());
        }
        if scale == 0.0 {
            return Ok(0.0);
        }
        Ok(((one.force - other.force).norm() / scale).max((one.moment - other.moment).norm() / (scale * radius)))
    }
}

impl LoadSlopes {
    /// Adds a force per volume.
    ///
    /// # Errors
    /// [`Undefined`] where b has no first derivative.
    pub fn add_body_force(
        &mut self,
        load: &BodyForce,
        place: &Placement,
        time: f64,
        scratch: &mut Scratch,
    ) -> Result<(), Undefined> {
        let growth = load.growth(place);
        let (mut force, mut moment) = (Vec3::zeros(), Mat3::zeros());
        for node in &load.rule.nodes {
            let (there, by_place) = load.field.at(&place.place(&node.at), time, true, scratch)?;
            let weight = growth * node.weight;
            let share = weight * there;
            force += share;
            moment += share * node.at.transpose();
            let point = |a: usize| if a == 0 { 1.0 } else { node.at[a - 1] };
            add_blocks(&mut self.by_place, &by_place, |a, b| weight * point(a) * point(b));
        }
        let loads = Loads { force, moment };
        self.loads += loads;
        // δ det P = det P tr(P⁻¹ δP).
        let inverse = if load.of_points { None } else { place.gradient.try_inverse() };
        for coordinate in (0..9).filter(|_| inverse.is_some()) {
            let spread = inverse.map_or(0.0, |inverse| (inverse * unit(coordinate)).trace());
            self.add_by_place(3 + coordinate, &loads.scaled(spread));
        }
        Ok(())
    }
}
