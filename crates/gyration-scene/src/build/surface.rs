//! The surface of a shape: what makes contact.

use gyration::shape::{Shape, Union};
use gyration::surface::Surface;

/// The surface of a shape in the shape's frame; none if it has only points.
///
/// # Errors
/// What is wrong with the triangles of a polyhedron; nothing, if the shape has been validated.
pub(super) fn surface(shape: &Shape) -> Result<Option<Surface>, String> {
    Ok(Some(match shape {
        Shape::Box(it) => Surface::cuboid(&it.size),
        Shape::Sphere(it) => Surface::sphere(it.radius),
        Shape::Ellipsoid(it) => Surface::ellipsoid(&it.semi_axes),
        Shape::Cylinder(it) => Surface::cylinder(it.radius, it.height),
        Shape::Cone(it) => Surface::cone(it.radius, it.height),
        Shape::Capsule(it) => Surface::capsule(it.radius, it.height),
        Shape::Torus(it) => Surface::torus(it.major_radius, it.minor_radius),
        Shape::Polyhedron(it) => {
            Surface::from_triangles(&it.vertices, &it.triangles).map_err(|error| error.to_string())?
        }
        Shape::Union(it) => return joined(it),
        Shape::Points(_) => return Ok(None),
    }))
}

/// The whole surface of each part that has one.
fn joined(union: &Union) -> Result<Option<Surface>, String> {
    let mut whole: Option<Surface> = None;
    for part in &union.parts {
        if let Some(own) = surface(&part.shape)? {
            let placed = own.transformed(&part.rotation, &part.offset);
            whole = Some(whole.map_or_else(|| placed.clone(), |whole| whole.merged(&placed)));
        }
    }
    Ok(whole)
}
