//! The fluid, and what makes a body an inclusion in it.
//!
//! A velocity gradient of the undisturbed flow has trace zero at all times: nothing of the fluid is made or lost.

use super::context::SceneContext;
use super::signal::{SignalBuilder, Value, first_fault, not_finite};
use super::start::matrix;
use crate::check::{Placed, Reporter};
use crate::file::{Body, Flow, Fluid as Written, Inclusion as WrittenInclusion, Rows};
use crate::key::Key;
use crate::quantity::{GradientRate, si};
use crate::units::shown;
use crate::unknown::{FIX, UnknownForm, no_surface};
use gyration::body::{Body as Moving, BodyKind};
use gyration::fluid::{FixedForm, Fluid, Form, History, Inclusion, Resolution};
use gyration::mass::MassProperties;
use gyration::shape::{Shape, Sphere};
use gyration::signal::Signal;
use gyration::tensor::{Mat3, Vec3};

/// The fluid of a scene; notes what is wrong with it.
pub(super) fn fluid(written: &Written, context: &SceneContext, reporter: &mut Reporter<'_>) -> Option<Fluid> {
    let key = Key::root().key("fluid");
    let velocity = match &written.velocity {
        Flow::Steady(velocity) => Some(Signal::Constant(velocity.tensor())),
        Flow::Changing(signal) => {
            SignalBuilder { context, reporter, symbol: 'U', rest: Mat3::zeros() }.bounded(signal, &key.key("velocity"))
        }
    };
    let gradient = gradient(&written.velocity_gradient, &key.key("velocity_gradient"), context, reporter);
    Some(Fluid {
        viscosity: written.viscosity.value(),
        density: written.density.value(),
        velocity: velocity?,
        gradient: gradient?,
    })
}

fn gradient(
    written: &Flow<Rows<GradientRate>>,
    key: &Key,
    context: &SceneContext,
    reporter: &mut Reporter<'_>,
) -> Option<Signal> {
    let signal = match written {
        Flow::Steady(rows) => Signal::Constant(rows.tensor()),
        Flow::Changing(signal) => {
            SignalBuilder { context, reporter, symbol: 'L', rest: Mat3::zeros() }.signal(signal, key)?
        }
    };
    let fault = |value: &Mat3| not_finite(value).or_else(|| swells(value));
    let Some((time, message)) = first_fault(&signal, context.end.unwrap_or(0.0), fault) else { return Some(signal) };
    let at = if matches!(signal, Signal::Constant(_)) { String::new() } else { format!("at t = {} s ", shown(time)) };
    let help = "change a diagonal entry so that the three add up to 0, for instance [[1, 0, 0], [0, -1, 0], [0, 0, 0]]";
    reporter.note(key, format!("{at}{message}"), help);
    None
}

/// A trace that rounding of numbers written with ten digits does not explain.
const ROUNDING: f64 = 1e-9;

/// Why a gradient cannot be that of a fluid that keeps its volume.
fn swells(gradient: &Mat3) -> Option<String> {
    let trace = gradient.trace();
    let grows = trace.abs() > ROUNDING * gradient.amax();
    grows.then(|| {
        format!(
            "its trace is {} 1/s: the fluid would swell everywhere, but it is incompressible and has no sources",
            shown(trace)
        )
    })
}

/// The error of a history unless the file gives one.
pub(super) const HISTORY_ERROR: f64 = 1e-6;

/// A body in the fluid: what is known of it when its kind is.
pub(super) struct ImmersedBody<'a> {
    pub(super) placed: &'a Placed<Body>,
    pub(super) shape: &'a Shape,
    pub(super) mass: &'a MassProperties,
    pub(super) kind: &'a BodyKind,
}

impl ImmersedBody<'_> {
    /// What makes it an inclusion: none if it is none. Outside none where something is wrong, which is noted.
    pub(super) fn inclusion(&self, context: &SceneContext, reporter: &mut Reporter<'_>) -> Option<Option<Inclusion>> {
        let Some(written) = &self.placed.value.inclusion else { return Some(None) };
        let key = self.placed.key.key("inclusion");
        let around = self.is_in_a_fluid(context, &key, reporter);
        let still = written.inertia || self.gives_no_velocity(reporter);
        let has_kernel = !written.history || self.may_have_history(written, context, &key, reporter);
        let form = self.form(written, reporter).filter(|_| can_be_resolved(written, &key, reporter));
        let filled = self.shape.mass_properties(1.0);
        let (volume, center) = (filled.volume, filled.center - self.mass.center);
        let others = ("neighbours", "what they do to one another through the fluid");
        let neighbours = match written.neighbours {
            true => Some(self.felt_radius(others, written, context, reporter)?),
            false => None,
        };
        let walls = match written.walls {
            true if self.may_feel_walls(context, reporter) => {
                Some(self.felt_radius(("walls", "what a wall does to them"), written, context, reporter)?)
            }
            true => return None,
            false => None,
        };
        let history =
            if written.history && has_kernel { self.history(written, context, &key, reporter)? } else { None };
        (around && still && has_kernel).then_some(Some(Inclusion {
            inertia: written.inertia,
            volume,
            center,
            form: form?,
            history,
            neighbours,
            walls,
        }))
    }

    /// The radius of a sphere that feels others, or walls, by this key; notes what cannot be felt by.
    fn felt_radius(
        &self,
        (name, what): (&str, &str),
        written: &WrittenInclusion,
        context: &SceneContext,
        reporter: &mut Reporter<'_>,
    ) -> Option<f64> {
        let key = self.placed.key.key("inclusion").key(name);
        let faults = [
            (
                !matches!(self.kind, BodyKind::Rigid(_)),
                format!("only of rigid spheres is it known {what}"),
                format!("leave out `{name}`, or what makes the body deform"),
            ),
            (
                written.history,
                "the flow between bodies and walls is taken without its inertia, and has no history".to_owned(),
                format!("leave out one of `history` and `{name}`"),
            ),
            (
                context.has_lattice,
                "the flow of the bodies in all cells of a lattice has no finite sum".to_owned(),
                format!("leave `{name}` out, or write the bodies without `[lattice]`"),
            ),
        ];
        for (_, message, help) in faults.iter().filter(|(applies, ..)| *applies) {
            reporter.note(&key, message, help);
        }
        let Shape::Sphere(Sphere { radius }) = self.shape else {
            let help = format!("write `shape = {{ sphere = {{ radius = … }} }}`, or leave `{name}` out");
            reporter.note(&key, format!("only of spheres is it known {what}"), help);
            return None;
        };
        if self.mass.center.norm() > ROUNDING * radius {
            reporter.note(&key, "the centre of mass is not that of the sphere", "give it a `density` or a `mass`");
            return None;
        }
        (!faults.iter().any(|(applies, ..)| *applies)).then_some(*radius)
    }

    /// Notes what beside the body is not as walls are felt.
    fn may_feel_walls(&self, context: &SceneContext, reporter: &mut Reporter<'_>) -> bool {
        let key = self.placed.key.key("inclusion").key("walls");
        let faults = [
            (
                !context.has_support,
                "the scene has no plane that could be a wall of the fluid",
                "add a `[[support]]` with a `plane`, or leave `walls` out",
            ),
            (
                context.supports_move,
                "beside a wall that moves the fluid does not rest",
                "leave out `walls`, or the `motion` of the supports",
            ),
            (
                context.fluid_flows,
                "the undisturbed flow would have to end at the wall",
                "leave out `walls`, or `velocity` and `velocity_gradient` of the fluid",
            ),
        ];
        for (_, message, help) in faults.iter().filter(|(applies, ..)| *applies) {
            reporter.note(&key, *message, *help);
        }
        !faults.iter().any(|(applies, ..)| *applies)
    }

    fn is_in_a_fluid(&self, context: &SceneContext, key: &Key, reporter: &mut Reporter<'_>) -> bool {
        if !context.has_fluid {
            let help = "add a section `[fluid]` with a `viscosity`, or leave `inclusion` out";
            reporter.note(key, "the scene has no fluid", help);
        }
        context.has_fluid
    }

    /// Notes velocities that a body without inertia cannot be given.
    fn gives_no_velocity(&self, reporter: &mut Reporter<'_>) -> bool {
        let Placed { key, value, .. } = self.placed;
        let moves = |vector: Option<Vec3>| vector.is_some_and(|vector| vector != Vec3::zeros());
        let given = [
            ("velocity", moves(Some(si(&value.velocity)))),
            ("angular_velocity", moves(value.angular_velocity.as_ref().map(si))),
            ("gradient_rate", value.gradient_rate.as_ref().map(matrix).is_some_and(|rate| rate != Mat3::zeros())),
        ];
        let mut still = true;
        for (name, _) in given.iter().filter(|(_, given)| *given) {
            let message = "a body without inertia moves as the balance of forces says, from the start on";
            reporter.note(&key.key(name), message, format!("leave `{name}` out, or write `inertia = true`"));
            still = false;
        }
        still
    }

    /// Notes what a history force cannot be had for.
    fn may_have_history(
        &self,
        written: &WrittenInclusion,
        context: &SceneContext,
        key: &Key,
        reporter: &mut Reporter<'_>,
    ) -> bool {
        let key = key.key("history");
        let sphere = matches!(self.shape, Shape::Sphere(_));
        let centered = self.mass.center.norm() <= ROUNDING * self.shape.size();
        let faults = [
            (
                !sphere,
                "only of a sphere is the history of the flow known in closed form",
                "write `shape = { sphere = { radius = … } }`, or leave `history` out",
            ),
            (
                matches!(self.kind, BodyKind::Contractile(_)),
                "the history of the flow about a body that drives itself is not followed",
                "leave out one of `contractile` and `history`",
            ),
            (
                !written.inertia,
                "a body without inertia has no history",
                "write `inertia = true`, or leave `history` out",
            ),
            (sphere && !centered, "the centre of mass is not that of the sphere", "give it a `density` or a `mass`"),
            (self.placed.value.pin.is_some(), "the body is pinned", "leave out one of `pin` and `history`"),
            (self.placed.value.keep.is_some(), "the body has a `keep`", "leave out one of `keep` and `history`"),
            (
                context.fluid.is_some_and(|[_, density]| density == 0.0),
                "the history of the flow is its inertia, and the fluid has no density",
                "give `fluid.density` in kg/m³, or leave `history` out",
            ),
        ];
        for (_, message, help) in faults.iter().filter(|(applies, ..)| *applies) {
            reporter.note(&key, *message, *help);
        }
        !faults.iter().any(|(applies, ..)| *applies)
    }

    /// The history force on a sphere over the run; notes numbers that are out of all proportion.
    fn history(
        &self,
        written: &WrittenInclusion,
        context: &SceneContext,
        key: &Key,
        reporter: &mut Reporter<'_>,
    ) -> Option<Option<History>> {
        let (Shape::Sphere(Sphere { radius }), Some(fluid), Some(end)) = (self.shape, context.fluid, context.end)
        else {
            return Some(None);
        };
        let error = written.history_error.unwrap_or(HISTORY_ERROR);
        let strains = context.fluid_has_gradient || matches!(self.kind, BodyKind::Affine(_));
        let history = if strains { History::of_straining_sphere } else { History::of_sphere };
        match history(*radius, fluid, end, error) {
            Ok(history) => Some(Some(history)),
            Err(unresolved) => {
                let help = "look at `fluid.viscosity`, `fluid.density`, the radius and `time.end`: R²ρ/η is the time \
                    in question";
                reporter.note(&key.key("history"), unresolved.to_string(), help);
                None
            }
        }
    }

    /// What the fluid meets, or what stands in for it; notes a shape without a surface.
    fn form(&self, written: &WrittenInclusion, reporter: &mut Reporter<'_>) -> Option<Form> {
        let rigid = matches!(self.kind, BodyKind::Rigid(_));
        let Some(semi_axes) = self.shape.semi_axes() else {
            if let Some(message) = no_surface(self.shape) {
                reporter.note(&self.placed.key.key("shape"), message, FIX);
                return None;
            }
            return Some(asked(written, !rigid, 0).stand_in());
        };
        if !rigid {
            return Some(Form::Ellipsoid(semi_axes));
        }
        let matrix = FixedForm::of_ellipsoid(&semi_axes);
        Some(Form::Fixed(Box::new(FixedForm::shifted(&matrix, &-self.mass.center))))
    }
}

/// About how many triangles a surface is divided into, unless said otherwise.
pub const TRIANGLES: usize = 1280;
/// The largest relative error of the power by interpolation, unless said otherwise: about that of so many flat
/// triangles.
const TOLERANCE: f64 = 1e-2;

/// The form of a body that only boundary elements tell.
pub(super) fn unknown(written: &Body, body: &Moving, index: usize) -> Option<UnknownForm> {
    let inclusion = written.inclusion.as_ref().filter(|_| body.solid.shape.semi_axes().is_none())?;
    Some(asked(inclusion, !matches!(body.kind, BodyKind::Rigid(_)), index))
}

fn asked(written: &WrittenInclusion, deforms: bool, body: usize) -> UnknownForm {
    let triangles = written.triangles.map_or(TRIANGLES, |triangles| triangles as usize);
    let resolution = Resolution { tolerance: written.tolerance.unwrap_or(TOLERANCE), spacing: written.spacing };
    UnknownForm { body, triangles, resolution: deforms.then_some(resolution) }
}

/// Notes errors and spacings of a table that are out of all proportion.
fn can_be_resolved(written: &WrittenInclusion, key: &Key, reporter: &mut Reporter<'_>) -> bool {
    let given = [("tolerance", written.tolerance, 1e-6..=0.5), ("spacing", written.spacing, 1e-3..=1.0)];
    let mut can = true;
    for (name, value, range) in given {
        if let Some(value) = value.filter(|value| !range.contains(value)) {
            let help = format!("write a number from {} to {}", range.start(), range.end());
            reporter.note(&key.key(name), format!("{value:?} is out of range"), help);
            can = false;
        }
    }
    can
}
