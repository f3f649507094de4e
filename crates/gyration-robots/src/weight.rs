//! Mass and inertia as files have them: an inertia tensor about the centre of mass, in a frame of its own.

use crate::pose::Pose;
use crate::report::{Report, named};
use gyration::mass::MassProperties;
use gyration::tensor::Mat3;
use roxmltree::Node;

/// A mass \[kg\] at the origin of a frame within that of the link, and its inertia tensor I there, in the axes of that
/// frame \[kg m²\].
#[derive(Debug, Clone, Copy)]
pub(crate) struct Inertia {
    pub mass: f64,
    pub frame: Pose,
    pub tensor: Mat3,
}

/// The mass properties in the frame of the link, J = R (½ tr(I) 1 − I) Rᵀ; none of a link without mass. Notes those
/// that no body has.
pub(crate) fn weight(node: Node<'_, '_>, inertia: Inertia, report: &mut Report) -> Option<MassProperties> {
    let Inertia { mass, frame, tensor } = inertia;
    if mass < 0.0 {
        report.fault(node, format!("{}: the mass is {mass:?} kg", named(node)), "write a mass > 0, or 0 for none");
        return None;
    }
    if mass == 0.0 {
        if tensor != Mat3::zeros() {
            report.leave_out(node, format!("{}: the inertia", named(node)), "the mass is zero, so the link has none");
        }
        return None;
    }
    let rotation = frame.rotation.rotation();
    let own = Mat3::identity() * (0.5 * tensor.trace()) - tensor;
    let turned = rotation * own * rotation.transpose();
    let euler_tensor = 0.5 * (turned + turned.transpose());
    let found = MassProperties { mass, center: frame.position, euler_tensor, volume: 0.0 };
    if found.validate().is_ok() {
        return Some(found);
    }
    let eigenvalues = tensor.symmetric_eigenvalues();
    let mut moments: Vec<f64> = eigenvalues.iter().copied().collect();
    moments.sort_by(f64::total_cmp);
    let message = format!(
        "{}: no body has these principal moments of inertia: {} kg m²",
        named(node),
        moments.iter().map(|moment| format!("{moment:e}")).collect::<Vec<_>>().join(", ")
    );
    report.fault(node, message, "each is at least 0 and at most the sum of the other two: mend the numbers");
    None
}
