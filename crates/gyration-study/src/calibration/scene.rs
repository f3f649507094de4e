//! The scenes of measurements: one scene with the numbers and the condition of a measurement, and where its body is.

use super::{Calibration, Experiment};
use gyration::balance::observe;
use gyration::dynamics::Workspace;
use gyration::model::Model;
use gyration::state::State;
use gyration::tensor::Vec3;
use gyration_scene::{Override, Scene};
use gyration_sim::complete;
use std::time::Duration;

impl Calibration {
    /// The scene of a measurement.
    pub(super) fn scene(
        &self,
        experiment: &Experiment,
        condition: f64,
        values: &[f64],
        more: &[Override],
    ) -> Result<Scene, String> {
        let mut overrides = self.overrides(values);
        overrides.extend(experiment.settings.iter().cloned());
        overrides.extend(experiment.key.iter().map(|key| Override::new(key, condition)));
        overrides.extend(more.iter().cloned());
        let found = self.template.scene(&overrides).and_then(complete);
        found.map_err(|errors| errors.as_slice().first().map_or_else(String::new, |error| error.message.clone()))
    }

    /// The scene of measured waves, which starts with none of its own.
    pub(super) fn lattice(&self, table: &Experiment, values: &[f64]) -> Result<Scene, String> {
        let mut overrides = self.overrides(values);
        overrides.extend(table.settings.iter().cloned());
        let found = self.template.scene(&overrides).map(Scene::without_waves).and_then(complete);
        found.map_err(|errors| errors.as_slice().first().map_or_else(String::new, |error| error.message.clone()))
    }

    /// How long the search may take: what the scene says of a run.
    pub(super) fn max_wall_time(&self) -> Option<Duration> {
        self.template.scene(&self.settings).ok()?.built().plan.wall_time()
    }

    /// The part of gravity that presses on a slope: what a scene there is to have.
    pub(super) fn pressing(&self, experiment: &Experiment, scene: &Scene, slope: f64) -> Result<Override, String> {
        let model = &scene.built().model;
        let normal = normal(model, body(model, experiment)?)?;
        let pressing = -normal * (model.gravity.norm() * libm::cos(slope));
        Ok(Override::new("world.gravity", <[f64; 3]>::from(pressing)))
    }

    /// Whether gravity and the planes of supports stay as they are, whatever is fitted.
    pub(super) fn moves_no_support(&self) -> bool {
        let mut keys = self.numbers.iter().flat_map(|number| &number.keys);
        keys.all(|key| key.starts_with("contact.") || key.starts_with("body."))
    }
}

/// The index of the body, which nothing joins to others.
pub(super) fn body(model: &Model, experiment: &Experiment) -> Result<usize, String> {
    let found = model.find_body(&experiment.body);
    let found = found.ok_or_else(|| format!("there is no body `{}`", experiment.body))?;
    if let Some(end) = model.joints_of(found).next() {
        let (name, joint) = (&experiment.body, &end.interaction.name);
        return Err(format!("the joint `{joint}` holds the body `{name}`: what is measured of it would be of both"));
    }
    if model.is_joined(found) {
        let name = &experiment.body;
        return Err(format!(
            "other bodies act on the body `{name}`, which it meets or to which springs join it: what is measured of it \
             would be of all of them"
        ));
    }
    Ok(found)
}

/// The normal of the first support that acts on a body.
pub(super) fn normal(model: &Model, body: usize) -> Result<Vec3, String> {
    let contact = model.contacts_of(body).next();
    let contact = contact.ok_or_else(|| {
        let name = model.name(body);
        if model.has_pairs(body) {
            return format!(
                "{name:?} meets a support with a shape, and what is measured is against a plane: give the support a \
                 `plane` where its face is large beside the body"
            );
        }
        format!("no support acts on {name:?}")
    })?;
    Ok(model.supports[contact.support].normal)
}

/// Where the velocity of a body's centre stands in the state.
pub(super) fn velocity(model: &Model, index: usize) -> Result<usize, String> {
    let body = &model.bodies[index];
    if body.pin.is_some() || body.guide.is_some() || !body.has_inertia() {
        return Err(format!("{:?} is pinned, has a `keep` or has no inertia", model.name(index)));
    }
    Ok(model.slots(index).velocity().start)
}

/// The force of its contacts on a body [N].
pub(super) fn force(model: &Model, state: &State, index: usize) -> Result<Vec3, String> {
    let seen = observe(model, &mut Workspace::default(), state, index);
    seen.map(|seen| seen.contact_force).map_err(|left| left.to_string())
}
