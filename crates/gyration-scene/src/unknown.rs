//! What a scene leaves open: the resistances that only boundary elements tell, and the waves with which it starts.
//!
//! To read and to check a scene takes none of them. Where one belongs the model has NaN, with which nothing runs, until
//! `Scene::complete` is given the form. What is wrong with a surface is then noted at its key, as any other error.

use crate::document::Document;
use gyration::fluid::{FixedForm, Form, NoMatrix, ResistanceSource, ResistanceTable, Resolution, SurfaceForm};
use gyration::load::Mat12;
use gyration::shape::Shape;
use gyration::tensor::Mat3;
use std::sync::Arc;

/// A form whose resistance is not known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnknownForm {
    /// The index of the body.
    pub body: usize,
    /// About how many triangles are to stand for its surface.
    pub triangles: usize,
    /// How exact it is to be between the forms that are computed; none of a form that does not change.
    pub resolution: Option<Resolution>,
}

impl UnknownForm {
    /// What stands in the model until the form is known.
    pub(crate) fn stand_in(&self) -> Form {
        let table = self
            .resolution
            .and_then(|resolution| ResistanceTable::new(Box::new(NotYet), &Mat3::identity(), resolution));
        match table {
            Some(table) => Form::Surface(SurfaceForm(Arc::new(table))),
            None => Form::Fixed(Box::new(FixedForm { matrix: Mat12::repeat(f64::NAN), error: f64::NAN })),
        }
    }
}

/// Why a form stays unknown.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum NoForm {
    /// There is none, for this reason.
    Surface(String),
    /// It was given up before it was known.
    Interrupted,
}

/// Why a run cannot start with a wave.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NoWave {
    /// Which of the waves it is, if it is one.
    pub wave: Option<usize>,
    /// The key of the wave at which it is wrong.
    pub key: Option<&'static str>,
    /// What is wrong.
    pub problem: String,
    /// What to do.
    pub help: &'static str,
    /// Whether it was given up before it was known.
    pub is_interrupted: bool,
}

/// The resistance of a form that is not known.
#[derive(Debug)]
struct NotYet;

impl ResistanceSource for NotYet {
    fn matrix(&self, _: &Mat3) -> Result<Mat12, NoMatrix> {
        Err(NoMatrix::Inexact(f64::NAN))
    }
}

/// Why a flow around a shape cannot be computed, if that can be told without computing it.
pub(crate) fn no_surface(shape: &Shape) -> Option<&'static str> {
    match shape {
        Shape::Union(_) => Some("a union has no single closed surface: give it as a `mesh` of one closed surface"),
        Shape::Points(_) => {
            Some("a set of points has no single closed surface: give it as a `mesh` of one closed surface")
        }
        _ => None,
    }
}

/// What to do about a surface without a resistance.
pub(crate) const FIX: &str = "write another shape, a mesh that is closed and even, or leave `inclusion` out";

/// A resistance that was given up, and what to do.
pub(crate) const GIVEN_UP: &str = "its resistance takes longer than it may";
pub(crate) const PATIENCE: &str = "raise solver.max_wall_time, or give its `inclusion` fewer `triangles`";

/// All of them, and the texts to blame.
#[derive(Debug, Clone)]
pub(crate) struct Unknown {
    pub(crate) forms: Vec<UnknownForm>,
    pub(crate) document: Document,
}
