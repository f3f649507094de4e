//! Supports that no contact or joint names: bodies fall through them.

use gyration::Party;
use gyration::load::Interaction as _;
use gyration::model::Model;

/// What must be told of supports in a scene with bodies that could touch them.
pub(super) fn notes(model: &Model) -> Vec<String> {
    let feels_walls = model.bodies.iter().any(|body| body.inclusion.as_ref().is_some_and(|it| it.walls.is_some()));
    // What feels planes through the fluid feels all of them.
    if feels_walls || !model.bodies.iter().any(|body| body.solid.surface.is_some()) {
        return Vec::new();
    }
    let has_joint = |party: Party| model.joints().iter().any(|joint| joint.parties().contains(&party));
    let is_touched = |support: usize| model.contacts().iter().any(|contact| contact.support == support);
    let is_met = |support: usize| model.rules().with_supports().any(|(_, rule)| rule.supports.contains(&support));
    let planes = (0..model.supports.len()).filter(|own| !is_touched(*own) && !has_joint(Party::Support(*own)));
    let solids = (0..model.solid_supports.len()).filter(|own| !is_met(*own) && !has_joint(Party::SolidSupport(*own)));
    let untouched = planes.map(Party::Support).chain(solids.map(Party::SolidSupport));
    let note =
        |name: &str| format!("nothing touches the support \"{name}\": no contact names it, and bodies go through it");
    untouched.map(|party| note(model.party_name(party))).collect()
}
