//! Numbers with a dimension, as the file's types hold them.
//!
//! A plain number is in SI units; a string carries its unit. The schema of each quantity names its SI unit under the
//! keyword `unit`, and the checker compares the unit of a string with it; [`Positive`] and [`NonNegative`] add the
//! standard keywords `exclusiveMinimum` and `minimum`. By the time a quantity is deserialized it has been checked.

use crate::units::parse_quantity;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Deserialize, Deserializer, Error, Visitor};
use serde::{Deserialize as DeriveDeserialize, Serialize};
use std::borrow::Cow;
use std::fmt;

/// The schema keyword that holds the SI unit of a quantity.
pub(crate) const UNIT: &str = "unit";
/// The schema keyword of a number in whose place an expression may stand.
pub(crate) const EXPRESSION: &str = "expression";
/// The schema keyword of a number that may have any unit.
pub(crate) const ANY_UNIT: &str = "anyUnit";
/// The schema keyword that holds the words by which a quantity may be left to the program.
pub(crate) const WORDS: &str = "words";

macro_rules! quantities {
    ($($(#[$doc:meta])* $name:ident $unit:literal $example:literal;)*) => {$(
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Default, Serialize)]
        #[serde(transparent)]
        pub struct $name(
            /// The value in SI units.
            pub f64,
        );

        impl From<$name> for f64 {
            fn from(quantity: $name) -> Self {
                quantity.0
            }
        }

        impl<'de> Deserialize<'de> for $name {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                deserializer.deserialize_any(NumberOrText).map(Self)
            }
        }

        impl JsonSchema for $name {
            fn schema_name() -> Cow<'static, str> {
                stringify!($name).into()
            }

            fn json_schema(_: &mut SchemaGenerator) -> Schema {
                let description = concat!("A number in ", $unit, ", or a string with a unit.");
                json_schema!({
                    "description": description, "type": ["number", "string"], "unit": $unit, "examples": [$example],
                })
            }
        }
    )*};
}

quantities! {
    /// Length \[m\].
    Length "m" "2 cm";
    /// Mass \[kg\].
    Mass "kg" "10 g";
    /// Time \[s\].
    Duration "s" "10 ms";
    /// Angle \[rad\].
    Angle "rad" "30 deg";
    /// Frequency \[Hz\].
    Frequency "Hz" "5 Hz";
    /// Velocity \[m/s\].
    Velocity "m/s" "5 cm/s";
    /// Angular velocity \[rad/s\].
    AngularVelocity "rad/s" "3 rpm";
    /// Acceleration \[m/s²\].
    Acceleration "m/s^2" "9.81 m/s^2";
    /// Mass density \[kg/m³\].
    Density "kg/m^3" "1.2 g/cm^3";
    /// Euler tensor \[kg m²\].
    EulerMoment "kg m^2" "40 g cm^2";
    /// Rate of a gradient \[1/s\].
    GradientRate "1/s" "3 1/s";
    /// Rate of decay \[1/s\].
    DecayRate "1/s" "5 1/s";
    /// Pressure \[Pa\]: strength of repulsion and adhesion, moduli of materials.
    Pressure "Pa" "30 kPa";
    /// Damping traction per velocity \[Pa s/m\]: strength of damping and friction.
    SurfaceDamping "Pa s/m" "2 Pa s/m";
    /// Dynamic viscosity \[Pa s\].
    Viscosity "Pa s" "20 mPa s";
    /// Energy \[J\].
    Energy "J" "1 nJ";
    /// Torque, affine moment \[N m\].
    Torque "N m" "3 mN m";
    /// Stiffness of a spring \[N/m\].
    Stiffness "N/m" "2 kN/m";
    /// Damping of a spring \[N s/m\].
    SpringDamping "N s/m" "0.1 N s/m";
    /// Constant of gravitation \[N m²/kg²\].
    GravitationalConstant "N m^2/kg^2" "6.674e-11 N m^2/kg^2";
}

/// A number of any dimension, in SI units once read: a constant of the expressions.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Serialize)]
#[serde(transparent)]
pub struct AnyQuantity(
    /// The value in SI units.
    pub f64,
);

impl From<AnyQuantity> for f64 {
    fn from(quantity: AnyQuantity) -> Self {
        quantity.0
    }
}

impl<'de> Deserialize<'de> for AnyQuantity {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(NumberOrText).map(Self)
    }
}

impl JsonSchema for AnyQuantity {
    fn schema_name() -> Cow<'static, str> {
        "AnyQuantity".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A number in SI units, or a string with any unit.", "type": ["number", "string"],
            "anyUnit": true, "examples": ["100 N/m"],
        })
    }
}

/// Takes a number, or a string whose unit has been checked.
struct NumberOrText;

impl Visitor<'_> for NumberOrText {
    type Value = f64;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number or a string with a unit")
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<f64, E> {
        Ok(value)
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<f64, E> {
        Ok(value as f64)
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<f64, E> {
        Ok(value as f64)
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<f64, E> {
        let (number, unit) = parse_quantity(text).map_err(E::custom)?;
        Ok(number * unit.size)
    }
}

/// A number or quantity that is greater than zero.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Serialize, DeriveDeserialize)]
#[serde(transparent)]
pub struct Positive<T>(
    /// The number or quantity.
    pub T,
);

/// A number or quantity that is not negative.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Default, Serialize, DeriveDeserialize)]
#[serde(transparent)]
pub struct NonNegative<T>(
    /// The number or quantity.
    pub T,
);

impl<T: Into<f64>> Positive<T> {
    /// The number in SI units.
    pub fn value(self) -> f64 {
        self.0.into()
    }
}

impl<T: Into<f64>> NonNegative<T> {
    /// The number in SI units.
    pub fn value(self) -> f64 {
        self.0.into()
    }
}

impl<T: JsonSchema> JsonSchema for Positive<T> {
    fn schema_name() -> Cow<'static, str> {
        format!("Positive{}", T::schema_name()).into()
    }

    fn inline_schema() -> bool {
        true
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let mut schema = generator.subschema_for::<T>();
        schema.insert("exclusiveMinimum".to_owned(), 0.into());
        schema
    }
}

impl<T: JsonSchema> JsonSchema for NonNegative<T> {
    fn schema_name() -> Cow<'static, str> {
        format!("NonNegative{}", T::schema_name()).into()
    }

    fn inline_schema() -> bool {
        true
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let mut schema = generator.subschema_for::<T>();
        schema.insert("minimum".to_owned(), 0.into());
        schema
    }
}

/// The values of three quantities in SI units.
pub(crate) fn si<T: Into<f64> + Copy>(vector: &[T; 3]) -> nalgebra::Vector3<f64> {
    nalgebra::Vector3::from(vector.map(Into::into))
}
