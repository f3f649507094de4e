//! Supports with a shape that turn about an axis through the origin, which is outside of them: they are carried round.

use crate::format::significant;
use gyration::model::Model;
use gyration::solid_support::SolidSupport;
use gyration::support::MotionPart;
use gyration::tensor::Vec3;

/// What must be told of supports whose axis may have been left at the origin.
pub(super) fn notes(model: &Model) -> Vec<String> {
    model.solid_supports.iter().filter_map(note).collect()
}

fn note(support: &SolidSupport) -> Option<String> {
    let place = support.start.position;
    let aside = |part: &MotionPart| match part {
        MotionPart::Rotation { axis, point, rate } if *point == Vec3::zeros() && *rate != 0.0 => {
            Some((place - axis * axis.dot(&place)).norm())
        }
        _ => None,
    };
    let aside = support.motion.parts().iter().filter_map(aside).fold(0.0, f64::max);
    (aside > support.solid.radius().unwrap_or(f64::INFINITY)).then(|| {
        format!(
            "the support \"{}\" is carried round the origin, {} m from its centre: `motion.rotate.point` is a point of \
             the axis",
            support.name,
            significant(aside, 3)
        )
    })
}
