//! Units of numbers whose dimension hangs on what they belong to: the kind of a joint, the number of cell vectors, the
//! place in a matrix.

use crate::check::Reporter;
use crate::key::Key;
use crate::tree::Node;
use crate::units::{UnitDimension, parse_quantity};

/// What a number is: in words, how one is written, its dimension, and whether it may be written per angle as well.
pub(super) struct Unit(&'static str, &'static str, UnitDimension, bool);

impl Unit {
    pub const ANGLE: Self = Self("an angle", "\"30 deg\"", UnitDimension::new(0, 0, 0, 1), false);
    pub const TORQUE: Self = Self("a torque", "\"0.1 N m\"", UnitDimension::new(2, 1, -2, 0), false);
    pub const TORQUE_PER_ANGLE: Self = Self("a torque per angle", Self::TORQUE.1, Self::TORQUE.2, true);
    pub const TORQUE_PER_RATE: Self = Self("a torque per rate", "\"0.1 N m s\"", UnitDimension::new(2, 1, -1, 0), true);
    pub const LENGTH: Self = Self("a length", "\"2 cm\"", UnitDimension::new(1, 0, 0, 0), false);
    pub const FORCE: Self = Self("a force", "\"3 N\"", UnitDimension::new(1, 1, -2, 0), false);
    pub const FORCE_PER_ANGLE: Self = Self("a force per angle", Self::FORCE.1, Self::FORCE.2, true);
    pub const FORCE_PER_RATE: Self = Self("a force per rate", "\"3 N s\"", UnitDimension::new(1, 1, -1, 0), true);
    pub const FORCE_PER_LENGTH: Self = Self("a force per length", "\"3 N/m\"", UnitDimension::new(0, 1, -2, 0), false);
    pub const FORCE_PER_VELOCITY: Self =
        Self("a force per velocity", "\"3 N s/m\"", UnitDimension::new(0, 1, -1, 0), false);
    pub const PRESSURE: Self = Self("a pressure", "\"3 kPa\"", UnitDimension::new(-1, 1, -2, 0), false);

    /// Whether a dimension is its own.
    pub fn is_of(&self, dimension: UnitDimension) -> bool {
        self.2 == dimension
    }

    /// Whether all that is written at a key, a number or an array, is without a unit or has this one; notes what has
    /// not, given what it belongs to.
    pub fn is_of_all(&self, key: &Key, owner: &str, reporter: &mut Reporter<'_>) -> bool {
        let node = key.find(&reporter.document.root);
        let items = node.map_or(0, |node| node.items().len());
        if items > 0 {
            return (0..items).filter(|index| !self.is_of_all(&key.index(*index), owner, reporter)).count() == 0;
        }
        let Self(what, example, dimension, per_angle) = self;
        let unit = node.and_then(Node::text).and_then(|text| parse_quantity(text).ok()).map(|(_, unit)| unit.dimension);
        let by_angle = UnitDimension { angle: dimension.angle - 1, ..*dimension };
        let is_right = unit.is_none_or(|unit| unit == *dimension || (*per_angle && unit == by_angle));
        if !is_right {
            let message = format!("of a {owner} this is {what}, and its unit is none of one");
            reporter.note(key, message, format!("write {example}"));
        }
        is_right
    }
}
