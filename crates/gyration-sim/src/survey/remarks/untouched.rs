//! Planes that no contact, spring or joint names: bodies fall through them.

use gyration::Party;
use gyration::load::Interaction as _;
use gyration::model::Model;

/// What must be told of planes in a scene with bodies that could touch them.
pub(super) fn notes(model: &Model) -> Vec<String> {
    let feels_walls = model.bodies.iter().any(|body| body.inclusion.as_ref().is_some_and(|it| it.walls.is_some()));
    // What feels planes through the fluid feels all of them.
    if feels_walls || !model.bodies.iter().any(|body| body.solid.surface.is_some()) {
        return Vec::new();
    }
    let is_named = |support: usize| {
        let has = |parties: [Party; 2]| parties.contains(&Party::Support(support));
        model.contacts().iter().any(|contact| contact.support == support)
            || model.springs().iter().any(|spring| has(spring.parties()))
            || model.joints().iter().any(|joint| has(joint.parties()))
    };
    let untouched = model.supports.iter().enumerate().filter(|(support, _)| !is_named(*support));
    let note =
        |name: &str| format!("nothing touches the support \"{name}\": no contact names it, and bodies go through it");
    untouched.map(|(_, support)| note(&support.name)).collect()
}
