//! The solids of a scene: equal bodies share one.

use gyration::body::Solid;
use gyration::mass::MassProperties;
use gyration::shape::Shape;
use std::collections::HashMap;
use std::sync::Arc;

/// The solids met so far, by the bits of mass and centre, which tell nearly all apart.
#[derive(Debug, Default)]
pub(super) struct Solids(HashMap<[u64; 4], Vec<Arc<Solid>>>);

impl Solids {
    /// The solid of this shape and mass: the one that stands already, or a new one.
    pub(super) fn share(&mut self, shape: Shape, mass: MassProperties) -> Arc<Solid> {
        let [x, y, z] = mass.center.into();
        let alike = self.0.entry([mass.mass, x, y, z].map(f64::to_bits)).or_default();
        if let Some(solid) = alike.iter().find(|solid| solid.mass == mass && solid.shape == shape) {
            return Arc::clone(solid);
        }
        let solid = Arc::new(Solid::new(shape, mass));
        alike.push(Arc::clone(&solid));
        solid
    }
}
