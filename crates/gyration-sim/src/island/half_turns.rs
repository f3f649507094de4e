//! Hinges that turn past half a turn, where the angle that their drive is told goes from π to −π.

use super::Island;
use crate::outcome::Stop;
use gyration::dynamics::observe_joint;
use gyration::joint::{Joint, JointKind};
use gyration::state::State;
use gyration_ode::StepReport;
use std::f64::consts::PI;

/// Whether the drive of a joint may depend on its angle.
fn is_told(joint: &Joint) -> bool {
    joint.kind == JointKind::Hinge && joint.motor.is_feedback()
}

impl Island {
    /// Whether no drive has jumped in the last step: what comes behind a jump is not what was meant.
    pub(super) fn check_half_turns(&mut self, report: &StepReport) -> Result<(), Stop> {
        if !self.model().joints().iter().any(is_told) {
            return Ok(());
        }
        let [before, after] = [report.start, report.end].map(|time| self.angles(time));
        let angles = before.into_iter().zip(after).enumerate();
        for (joint, (before, after)) in angles.filter_map(|(joint, (before, after))| Some((joint, (before?, after?)))) {
            let turned = (after - before).abs();
            if turned <= PI {
                continue;
            }
            // The way round the other side.
            let rate = (2.0 * PI - turned).copysign(before) / (report.end - report.start);
            let joint = &self.model().joints()[joint];
            if let Some(jump) = joint.motor.jump_at_half_turn(rate, report.end) {
                return Err(Stop::by_half_turn(&joint.name, report.end, jump));
            }
        }
        Ok(())
    }

    /// The angles of such joints within the last step [rad].
    fn angles(&mut self, time: f64) -> Vec<Option<f64>> {
        let State { bodies, low, works, time: sampled } = &mut self.sampled;
        *sampled = time;
        self.integrator.interpolate_extended(time, bodies, works, Some(low));
        let (model, workspace) = self.system.observed();
        let read = workspace.read(model, &self.sampled).ok();
        let angle = |(instant, scratch): &(_, &mut _), (number, joint): (usize, &Joint)| {
            is_told(joint).then(|| observe_joint(instant, scratch, number).angle)?
        };
        let joints = model.joints().iter().enumerate();
        read.map_or_else(Vec::new, |read| joints.map(|joint| angle(&read, joint)).collect())
    }
}
