//! Dimensioned numbers as people write them: `2 cm`, `30 kPa`, `15 deg`, `5 m/s`, `2 g/cm3`, `0.1 N s/m`.
//!
//!   value in SI = number · Π (prefixᵢ · unitᵢ)^kᵢ,    dimension = Σ kᵢ dim(unitᵢ)
//!
//! A dimension is the vector of exponents of metre, kilogram, second and radian. The radian counts as a dimension of
//! its own, so that `5 Hz` is not taken for an angular velocity nor `3 rpm` for a frequency. The grammar is `number
//! unit`, where a unit is a sequence of symbols, each with an optional SI prefix and an integer power (`m^3`, `m3`,
//! `m³`, `s^-1`), joined by blanks, `*` or `·` (product) and `/` (everything up to the next operator divides);
//! parentheses group. Offsets (temperatures) and fractional powers are not units here.

mod parse;
mod symbols;

pub use parse::{UnitError, parse_quantity, parse_unit};

use std::fmt;

/// The exponents of the base units in a product of units.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct UnitDimension {
    /// Power of the metre.
    pub length: i32,
    /// Power of the kilogram.
    pub mass: i32,
    /// Power of the second.
    pub time: i32,
    /// Power of the radian.
    pub angle: i32,
}

impl UnitDimension {
    /// The dimension with these exponents of metre, kilogram, second and radian.
    pub const fn new(length: i32, mass: i32, time: i32, angle: i32) -> Self {
        Self { length, mass, time, angle }
    }

    /// The dimension of a product of two units; none if an exponent does not fit.
    pub(crate) fn times(self, other: Self) -> Option<Self> {
        Some(Self {
            length: self.length.checked_add(other.length)?,
            mass: self.mass.checked_add(other.mass)?,
            time: self.time.checked_add(other.time)?,
            angle: self.angle.checked_add(other.angle)?,
        })
    }

    /// The dimension of an integer power of a unit; none if an exponent does not fit.
    pub(crate) fn power(self, exponent: i32) -> Option<Self> {
        Some(Self {
            length: self.length.checked_mul(exponent)?,
            mass: self.mass.checked_mul(exponent)?,
            time: self.time.checked_mul(exponent)?,
            angle: self.angle.checked_mul(exponent)?,
        })
    }
}

/// Writes the base units, `kg m^-1 s^-2`; `1` for a pure number.
impl fmt::Display for UnitDimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut separator = "";
        for (symbol, power) in [("kg", self.mass), ("m", self.length), ("s", self.time), ("rad", self.angle)] {
            match power {
                0 => continue,
                1 => write!(f, "{separator}{symbol}")?,
                _ => write!(f, "{separator}{symbol}^{power}")?,
            }
            separator = " ";
        }
        if separator.is_empty() { f.write_str("1") } else { Ok(()) }
    }
}

/// A unit: its size in SI units and its dimension.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    /// How many SI units make one of these.
    pub size: f64,
    /// The exponents of the base units.
    pub dimension: UnitDimension,
}

impl Unit {
    /// The pure number one.
    pub(crate) const ONE: Self = Self { size: 1.0, dimension: UnitDimension::new(0, 0, 0, 0) };

    /// The product of two units; none if it leaves the range of exponents.
    pub(crate) fn times(self, other: Self) -> Option<Self> {
        Some(Self { size: self.size * other.size, dimension: self.dimension.times(other.dimension)? })
    }

    /// An integer power of a unit; none if it leaves the range of exponents.
    pub(crate) fn power(self, exponent: i32) -> Option<Self> {
        Some(Self { size: self.size.powi(exponent), dimension: self.dimension.power(exponent)? })
    }
}

/// The number that a value stands for, without what the rounding of a change of units has left: 1250 for
/// 1249.9999999999998.
pub fn without_rounding(value: f64) -> f64 {
    /// What few operations leave, in parts of the value.
    const ROUNDING: f64 = 4.0 * f64::EPSILON;
    let rounded = (11..15).find_map(|decimals| {
        let rounded: f64 = format!("{value:.decimals$e}").parse().ok()?;
        ((rounded - value).abs() <= ROUNDING * value.abs()).then_some(rounded)
    });
    rounded.unwrap_or(value)
}

/// A number as people write it: `0` and `0.01`, but `1e-14`, and without rounding.
pub fn shown(value: f64) -> String {
    let value = without_rounding(value);
    if value == value.trunc() && value.abs() < 1e6 { format!("{value}") } else { format!("{value:?}") }
}

#[cfg(test)]
mod tests;
