//! What a scene leaves open: the resistances that only boundary elements tell.
//!
//! To read and to check a scene takes none of them. Where one belongs the model has NaN, with which nothing runs, until
//! [`Scene::complete`] is given the form. What is wrong with a surface is then noted at its key, as any other error.

use crate::document::{Document, Findings};
use crate::error::{Fault, SceneErrors};
use crate::key::Key;
use crate::scene::Scene;
use gyration::body::Body;
use gyration::fluid::{FixedForm, Form, Resistance, Resolution, SurfaceForm, Table};
use gyration::load::Mat12;
use gyration::shape::Shape;
use gyration::tensor::Mat3;
use std::fmt::Display;
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
        let table = self.resolution.and_then(|resolution| Table::new(Box::new(NotYet), &Mat3::identity(), resolution));
        match table {
            Some(table) => Form::Surface(SurfaceForm(Arc::new(table))),
            None => Form::Fixed(Box::new(FixedForm { matrix: Mat12::repeat(f64::NAN), error: f64::NAN })),
        }
    }
}

/// The resistance of a form that is not known.
#[derive(Debug)]
struct NotYet;

impl Resistance for NotYet {
    fn matrix(&self, _: &Mat3) -> Result<Mat12, f64> {
        Err(f64::NAN)
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

/// All of them, and the texts to blame.
#[derive(Debug, Clone)]
pub(crate) struct Unknown {
    pub(crate) forms: Vec<UnknownForm>,
    pub(crate) document: Document,
}

impl Scene {
    /// The forms whose resistance is not known.
    pub fn unknown_forms(&self) -> &[UnknownForm] {
        self.unknown.as_ref().map_or(&[], |unknown| &unknown.forms)
    }

    /// The scene with the forms that are asked for here, each of a body of the model.
    ///
    /// # Errors
    /// Why a surface has no resistance, at the key of its shape.
    pub fn complete<E: Display>(
        mut self,
        mut form: impl FnMut(&Body, &UnknownForm) -> Result<Form, E>,
    ) -> Result<Self, SceneErrors> {
        let Some(Unknown { forms, document }) = self.unknown.take().map(|unknown| *unknown) else { return Ok(self) };
        let mut findings = Findings::of(Fault::Value);
        for asked in forms {
            let body = &mut self.built.model.bodies[asked.body];
            let found = form(body, &asked);
            match (found, &mut body.inclusion) {
                (Ok(found), Some(inclusion)) => inclusion.form = found,
                (Ok(_), None) => {}
                (Err(error), _) => {
                    let key = Key::root().key("body").index(asked.body).key("shape");
                    findings.at(key.span(&document.root), &key, error.to_string(), FIX);
                }
            }
        }
        if findings.is_empty() { Ok(self) } else { Err(document.settle(findings)) }
    }
}
