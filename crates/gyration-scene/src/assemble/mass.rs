//! The mass of a body: a density or a mass on a shape, mass properties given outright, or what the shape brings.
//!
//! Exactly one of `density`, `mass` and `mass_properties`; none for `points`, nor for a union whose parts all have a
//! density. Under a `mass` the densities of the parts are relative weights.

use crate::check::{Placed, Reporter};
use crate::file::{Body, Part, Shape as Written};
use crate::key::Key;
use crate::quantity::si;
use gyration::mass::MassProperties;
use gyration::shape::Shape;
use gyration::tensor::{Mat3, Vec3};

/// Where the mass of a body comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum MassSource {
    /// A density \[kg/m³\] for all parts without one.
    Density(f64),
    /// The total mass \[kg\], spread by the densities of the parts, or evenly.
    Mass(f64),
    /// Given outright.
    Properties(MassProperties),
    /// The shape brings it.
    Shape,
}

/// Whether neither the body nor its shape says what it weighs.
pub(super) fn is_unknown(body: &Body) -> bool {
    let is_said = body.density.is_some() || body.mass.is_some() || body.mass_properties.is_some();
    !is_said && body.shape.as_ref().is_some_and(|shape| !shape.weighs())
}

impl MassSource {
    /// The source of a body's mass; notes a choice that is not exactly one.
    pub(super) fn of(body: &Placed<Body>, reporter: &mut Reporter<'_>) -> Option<Self> {
        let Placed { key, value, .. } = body;
        let given = match (value.density, value.mass, &value.mass_properties) {
            (Some(density), None, None) => Some(Self::Density(density.value())),
            (None, Some(mass), None) => Some(Self::Mass(mass.value())),
            (None, None, Some(_)) => return properties(body, reporter),
            (None, None, None) => None,
            _ => {
                let message = "more than one of density, mass and mass_properties";
                reporter.note(&superfluous(value, key), message, "keep exactly one of them");
                return None;
            }
        };
        let help = "give exactly one of `density`, `mass` and `mass_properties`";
        match (&value.shape, given) {
            (Some(Written::Points(_)), Some(_)) => {
                reporter.note(&superfluous(value, key), "points bring their own mass", "leave the key out");
                None
            }
            (Some(Written::Points(_)), None) => Some(Self::Shape),
            (Some(Written::Union(union)), None) if union.parts.iter().any(Part::weighs) => Some(Self::Shape),
            (Some(_), None) => {
                reporter.note(key, "the body has no mass", help);
                None
            }
            (None, _) => {
                let message = "the key \"shape\" is missing";
                reporter.note(&key.key("shape"), message, "add a shape; only with `mass_properties` can there be none");
                None
            }
            (Some(_), given) => given,
        }
    }

    /// The density of parts that have none of their own.
    pub(super) fn density(&self, shape: &Written) -> Option<f64> {
        match self {
            Self::Density(density) => Some(*density),
            Self::Mass(_) if !shape.weighs() => Some(1.0),
            Self::Mass(_) | Self::Shape => None,
            Self::Properties(_) => Some(1.0),
        }
    }

    /// The mass properties of a shape; notes those that no body can have.
    pub(super) fn weigh(&self, shape: &Shape, key: &Key, reporter: &mut Reporter<'_>) -> Option<MassProperties> {
        let factor = |density: f64| if shape.brings_mass() { 1.0 } else { density };
        let properties = match self {
            Self::Density(density) => shape.mass_properties(factor(*density)),
            Self::Mass(mass) => shape.mass_properties(1.0).with_mass(*mass),
            Self::Properties(given) => MassProperties { volume: shape.mass_properties(1.0).volume, ..*given },
            Self::Shape => shape.mass_properties(1.0),
        };
        match properties.validate() {
            Ok(()) => Some(properties),
            Err(error) => {
                reporter.note(key, error.to_string(), "change the size or the density: the numbers leave their range");
                None
            }
        }
    }
}

/// The key to complain about, of those that stand in the body: the last of the three.
fn superfluous(body: &Body, key: &Key) -> Key {
    match (&body.mass_properties, body.mass) {
        (Some(_), _) => key.key("mass_properties"),
        (None, Some(_)) => key.key("mass"),
        (None, None) => key.key("density"),
    }
}

fn properties(body: &Placed<Body>, reporter: &mut Reporter<'_>) -> Option<MassSource> {
    let key = body.key.key("mass_properties");
    if matches!(body.value.shape, Some(Written::Points(_))) {
        reporter.note(&key, "points bring their own mass", "leave the key out, or choose a shape with a surface");
        return None;
    }
    let given = body.value.mass_properties.as_ref()?;
    let rows = given.euler_tensor.map(|row| si(&row).transpose());
    let properties = MassProperties {
        mass: given.mass.value(),
        center: si(&given.center),
        euler_tensor: Mat3::from_rows(&rows),
        volume: 0.0,
    };
    match properties.validate() {
        Ok(()) => Some(MassSource::Properties(properties)),
        Err(error) => {
            reporter.note(&key.key("euler_tensor"), error.to_string(), "give J = ∫ρ X⊗X dV about the centre of mass");
            None
        }
    }
}

/// A point at the centre of mass, for a body that has no shape.
pub(super) fn lone_point(mass: &MassProperties) -> Shape {
    use gyration::shape::{MassPoint, Points};
    Shape::Points(Points { points: vec![MassPoint { mass: mass.mass, at: mass.center }] })
}

/// A length \[m\] for tolerances: the shape's size, or twice the radius of gyration where it has none.
pub(super) fn size(shape: &Shape, mass: &MassProperties, pin: &Vec3) -> f64 {
    let extent = shape.size();
    if extent > 0.0 {
        return extent;
    }
    2.0 * (mass.euler_tensor.trace() / mass.mass).sqrt().max(pin.norm())
}
