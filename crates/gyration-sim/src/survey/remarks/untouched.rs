//! Supports that no contact or joint names: bodies fall through them; supports with a shape that a body which answers
//! to its gap does not feel.

use gyration::Party;
use gyration::contractile::{ContractionSource, FeedbackMeasure};
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

/// What must be told of feedbacks on the gap: it is that to planes.
pub(super) fn unfelt(model: &Model) -> Option<String> {
    let solid = model.solid_supports.first()?;
    let answers = |body: &usize| {
        let source = model.bodies[*body].contraction().map(|contraction| &contraction.source);
        let Some(ContractionSource::Driven { feedback, .. }) = source else { return false };
        feedback.iter().any(|part| part.measure == FeedbackMeasure::SupportGap)
    };
    let body = (0..model.bodies.len()).find(answers)?;
    Some(format!(
        "the feedback of \"{}\" on its gap feels planes alone: \"{}\" is a support with a shape, and changes nothing \
         of it",
        model.name(body),
        solid.name
    ))
}
