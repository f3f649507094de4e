//! Meshes whose shells enclose the same space more than once, or less than once.

use gyration::model::Model;
use gyration::shape::{Polyhedron, Shape};
use gyration_geometry::{Shells, doubly_enclosed};

/// Meshes that are looked at.
const MOST_MESHES: usize = 100;

/// What must be told of the meshes of a model; of equal bodies once.
pub(super) fn warnings(model: &Model) -> Vec<String> {
    let mut told = Vec::new();
    let mut seen: Vec<*const Shape> = Vec::new();
    for (body, name) in model.bodies.iter().zip(model.names()) {
        let shape: *const Shape = &body.solid.shape;
        if seen.contains(&shape) {
            continue;
        }
        seen.push(shape);
        let mut meshes = Vec::new();
        collect(&body.solid.shape, &mut meshes);
        let found = meshes.into_iter().filter_map(doubly_enclosed);
        told.extend(found.map(|shells| in_words(name, &shells)));
        if seen.len() > MOST_MESHES {
            break;
        }
    }
    told
}

/// The meshes of a shape, those of its unions among them.
fn collect<'a>(shape: &'a Shape, meshes: &mut Vec<&'a Polyhedron>) {
    match shape {
        Shape::Polyhedron(polyhedron) => meshes.push(polyhedron),
        Shape::Union(union) => union.parts.iter().for_each(|part| collect(&part.shape, meshes)),
        Shape::Box(_)
        | Shape::Sphere(_)
        | Shape::Ellipsoid(_)
        | Shape::Cylinder(_)
        | Shape::Cone(_)
        | Shape::Capsule(_)
        | Shape::Torus(_)
        | Shape::Points(_) => {}
    }
}

fn in_words(body: &str, shells: &Shells) -> String {
    format!("the mesh of \"{body}\" counts space more than once, or less: {shells}")
}
