//! The solids and bodies of a scene: equal ones are one.

use gyration::body::{Body, Solid};
use gyration::mass::MassProperties;
use gyration::shape::Shape;
use std::collections::HashMap;
use std::sync::Arc;

/// The solids met so far, and the last body of each.
#[derive(Debug, Default)]
pub(super) struct Solids {
    /// By the bits of mass and centre, which tell nearly all apart.
    solids: HashMap<[u64; 4], Vec<Arc<Solid>>>,
    /// By the place of its solid in memory, which it keeps.
    bodies: HashMap<*const Solid, Arc<Body>>,
}

impl Solids {
    /// The solid of this shape and mass: the one that stands already, or a new one.
    pub(super) fn share(&mut self, shape: Shape, mass: MassProperties) -> Arc<Solid> {
        let [x, y, z] = mass.center.into();
        let alike = self.solids.entry([mass.mass, x, y, z].map(f64::to_bits)).or_default();
        if let Some(solid) = alike.iter().find(|solid| solid.mass == mass && solid.shape == shape) {
            return Arc::clone(solid);
        }
        let solid = Arc::new(Solid::new(shape, mass));
        alike.push(Arc::clone(&solid));
        solid
    }

    /// A body that equals the last one of its solid is that one.
    pub(super) fn share_body(&mut self, body: Body) -> Arc<Body> {
        let solid = Arc::as_ptr(&body.solid);
        if let Some(known) = self.bodies.get(&solid).filter(|known| known.can_stand_for(&body)) {
            return Arc::clone(known);
        }
        let body = Arc::new(body);
        self.bodies.insert(solid, Arc::clone(&body));
        body
    }
}
