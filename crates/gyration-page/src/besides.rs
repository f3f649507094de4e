//! What the page shows of a model beside what its scene records.
//!
//! Bodies that deform are coloured by their stress. Where bodies meet, or stand against supports of several normals,
//! the sum of the contact forces does not tell what of it is normal and what tangential: the parts are had contact by
//! contact.

use gyration::body::BodyKind;
use gyration::model::Model;
use gyration_scene::Recorded;

/// What the page shows of a model beside what its scene records.
pub fn recorded_besides(model: &Model) -> Vec<Recorded> {
    let stress = deforms(model).then_some(Recorded::CauchyStress);
    let parts = [Recorded::NormalForce, Recorded::TangentialForce, Recorded::PairForce];
    stress.into_iter().chain(parts.into_iter().filter(|_| has_parts(model))).collect()
}

/// Whether bodies may push one another.
pub fn has_network(model: &Model) -> bool {
    model.bodies.len() > 1 && !model.rules().is_empty()
}

/// Whether a body has stresses.
pub fn deforms(model: &Model) -> bool {
    model.bodies.iter().any(|body| !matches!(body.kind, BodyKind::Rigid(_)))
}

/// Whether the sum of the contact forces on a body may not tell their normal part.
pub fn has_parts(model: &Model) -> bool {
    let normals_differ = |body: usize| {
        let mut normals = model.contacts_of(body).map(|contact| &model.supports[contact.support].normal);
        let first = normals.next();
        normals.any(|normal| Some(normal) != first)
    };
    !model.rules().is_empty() || (0..model.bodies.len()).any(normals_differ)
}
