//! Linkages whose joints come to depend on one another: stretched out, folded, or flat.
//!
//! Where σ, the sine of what is left to such a place, is small, the forces of the joints follow from the motion by a
//! division by σ², and the digits of a number are lost that often. Steps that end short of it get shorter without end.

use super::Island;
use crate::outcome::Stop;
use gyration::Party;
use gyration::extended::Numbers;
use gyration::load::Interaction as _;
use gyration_ode::StepReport;

/// A step in which no body turns by more is one that may end beside such a place [rad]: there σ² is what a start may
/// not have either.
const SHORT: f64 = 1e-5;

impl Island {
    /// Tests whether the joints at the end of the last step can still be told from one another, where longer steps were
    /// rejected.
    pub(super) fn check_linkages(&mut self, report: &StepReport) -> Result<(), Stop> {
        let span = report.end - report.start;
        if report.rejections == 0 || self.model().joints().is_empty() || self.fastest_turn() * span > SHORT {
            return Ok(());
        }
        let state = Numbers { high: self.integrator.state(), low: self.integrator.state_low() };
        let (model, workspace) = self.system.observed();
        let found = workspace.dependent_joint(model, report.end, state);
        let left = match found {
            Ok(None) => return Ok(()),
            Ok(Some(dependent)) => dependent.inadmissible(model),
            Err(left) => left,
        };
        Err(Stop::by_inadmissible(model, report.end, &left))
    }

    /// The largest rate at which a body with a joint turns, or its P changes, at the end of the last step [1/s]; of a
    /// mass point that at which it goes its size.
    fn fastest_turn(&self) -> f64 {
        let model = self.model();
        let rate = |body: usize| {
            let (velocity, body) = (&self.step_ends[body].motion.velocity, &model.bodies[body]);
            if body.is_point() { velocity.velocity.norm() / body.size } else { velocity.gradient_rate.norm() }
        };
        let joined = model.joints().iter().flat_map(|joint| joint.parties().into_iter().filter_map(Party::body));
        joined.map(rate).fold(0.0, f64::max)
    }
}
