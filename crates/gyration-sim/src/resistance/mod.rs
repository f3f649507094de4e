//! The resistance of shapes that are no ellipsoids, by boundary elements: asked for when a model is made, not when its
//! scene is read.
//!
//! [`complete`] computes what a scene leaves open; whoever runs a scene, or looks for its small motions, calls it.

mod bodies;
mod deforming;
mod elements;

pub use bodies::{
    BodyResistance, FluidResponse, NoSuchResistance, ResistanceMatrix, ResistanceOptions, Resistances,
    TRIANGLES_ALLOWED, Vibration,
};
pub use deforming::DeformingSurface;
pub use elements::{BoundaryElements, BoundaryResistance, NoResistance, Wall, boundary_resistance};

use crate::waves;
use gyration::body::Body;
use gyration::fluid::{FixedForm, Form, SurfaceForm};
use gyration::model::Model;
use gyration::tensor::Mat3;
use gyration::{Inadmissible, Quantity};
use gyration_scene::{LoadError, NoForm, Scene, SceneErrors, UnknownForm};
use gyration_stokes::StokesError;
use gyration_threads::Interruption;
use std::borrow::Cow;
use std::sync::Arc;

/// Opens a scene by its path or its name in the gallery, ready to run: [`Scene::open`] and [`complete`], for which its
/// `solver.max_wall_time` counts.
///
/// # Errors
/// As of both.
pub fn open(path_or_name: &str, overrides: &[String]) -> Result<Scene, LoadError> {
    within_wall_time(Scene::open(path_or_name, overrides)?)
}

/// Opens a scene as [`open`] does, but at rest: the waves with which its run starts are not looked for.
///
/// # Errors
/// As of [`open`].
pub fn open_at_rest(path_or_name: &str, overrides: &[String]) -> Result<Scene, LoadError> {
    within_wall_time(Scene::open(path_or_name, overrides)?.without_waves())
}

fn within_wall_time(scene: Scene) -> Result<Scene, LoadError> {
    Ok(Interruption::in_force().after(scene.built().plan.wall_time()).within(|| complete(scene))?)
}

/// The scene with the resistances that boundary elements tell, and with its waves: ready to run.
///
/// # Errors
/// Why a surface has no resistance, at the key of its shape; why it has no such wave.
pub fn complete(scene: Scene) -> Result<Scene, SceneErrors> {
    scene.complete(|body, asked| form(body, asked).map_err(NoForm::from), waves::start)
}

/// The same of a scene that is somebody else's.
///
/// # Errors
/// As of [`complete`].
pub fn completed(scene: &Scene) -> Result<Cow<'_, Scene>, SceneErrors> {
    if scene.is_complete() {
        return Ok(Cow::Borrowed(scene));
    }
    complete(scene.clone()).map(Cow::Owned)
}

impl From<NoResistance> for NoForm {
    fn from(none: NoResistance) -> Self {
        match none {
            NoResistance::Surface(StokesError::Interrupted) => Self::Interrupted,
            none => Self::Surface(none.to_string()),
        }
    }
}

/// What the fluid meets of a body that is no ellipsoid.
fn form(body: &Body, asked: &UnknownForm) -> Result<Form, NoResistance> {
    let triangles = asked.triangles;
    let Some(resolution) = asked.resolution else {
        let (center, gradient) = (body.solid.mass.center, Mat3::identity());
        let found =
            boundary_resistance(&body.solid.shape, &BoundaryElements { triangles, center, gradient, wall: None })?;
        return Ok(Form::Fixed(Box::new(FixedForm { matrix: found.matrix, error: found.error })));
    };
    let surface = DeformingSurface::new(&body.solid.shape, triangles);
    // The first of many, by which a surface that has none is found before the run.
    surface.resistance(&Mat3::identity())?;
    surface.table(resolution).map(|table| Form::Surface(SurfaceForm(Arc::new(table)))).ok_or(NoResistance::Flat)
}

/// Refuses a model whose scene has not been completed.
///
/// # Errors
/// The first body whose resistance is not known.
pub(crate) fn check_resistances(model: &Model) -> Result<(), Inadmissible> {
    let is_unknown = |body: &Arc<Body>| match body.inclusion.as_ref().map(|inclusion| &inclusion.form) {
        Some(Form::Fixed(form)) => form.error.is_nan(),
        _ => false,
    };
    match model.bodies.iter().position(is_unknown) {
        Some(body) => Err(Inadmissible { body, quantity: Quantity::Elements, value: f64::NAN }),
        None => Ok(()),
    }
}
