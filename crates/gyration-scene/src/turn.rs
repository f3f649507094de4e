//! How a body that deforms is turned and turns at the start, as its text says: the resolved form has P and Ṗ instead.

use crate::file::{Body, Orientation};
use crate::quantity::AngularVelocity;
use serde_json::Value;

/// Orientation and angular velocity of a text.
#[derive(Debug, Clone)]
pub(crate) struct WrittenTurn {
    orientation: Option<Orientation>,
    angular_velocity: Option<[AngularVelocity; 3]>,
}

impl WrittenTurn {
    /// Those of a body that deforms; none of others, whose resolved form has them, or where nothing is said.
    pub fn of(body: &Body) -> Option<Self> {
        let deforms = body.affine.is_some() || body.contractile.is_some();
        let Body { orientation, angular_velocity, .. } = body;
        let is_said = orientation.is_some() || angular_velocity.is_some();
        (deforms && is_said).then(|| Self { orientation: orientation.clone(), angular_velocity: *angular_velocity })
    }

    /// Puts them beside the matrices of a resolved body.
    pub fn put(&self, body: &mut Value) {
        // Arrays and tables of finite numbers, all of which JSON has.
        if let Some(orientation) = &self.orientation {
            body["orientation"] = serde_json::to_value(orientation).unwrap_or_default();
        }
        if let Some(angular_velocity) = &self.angular_velocity {
            body["angular_velocity"] = serde_json::to_value(angular_velocity).unwrap_or_default();
        }
    }
}
