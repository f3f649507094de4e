//! Bodies of any form in a fluid, with a resistance that is known in closed form and smooth within a simplex and
//! beyond.
//!
//! The ratio C to the ellipsoid of the same second moments is linear in the coordinates of the form, so that what is
//! interpolated is exact: differences may cross from one simplex into the next.

use gyration::fluid::{
    FixedForm, Form, Inclusion, NoMatrix, ResistanceSource, ResistanceTable, Resolution, SurfaceForm,
};
use gyration::load::Mat12;
use gyration::model::Model;
use gyration::tensor::{Mat3, Vec3};
use std::sync::Arc;

const SEMI_AXES: Vec3 = Vec3::new(0.5, 0.3, 0.4);

/// H = A C Aᵀ with C = 4 + Σ (dev ln E)_ij C_ij.
#[derive(Debug)]
struct Linear;

impl ResistanceSource for Linear {
    fn matrix(&self, stretch: &Mat3) -> Result<Mat12, NoMatrix> {
        let eigen = stretch.symmetric_eigen();
        let logarithm =
            eigen.eigenvectors * Mat3::from_diagonal(&eigen.eigenvalues.map(f64::ln)) * eigen.eigenvectors.transpose();
        let mut ratio = Mat12::identity() * 4.0;
        for (place, part) in logarithm.iter().enumerate() {
            let root = Mat12::from_fn(|i, j| 0.2 * (0.9 * i as f64 + 1.7 * (j * (place + 1)) as f64).sin());
            ratio += (root + root.transpose()) * *part;
        }
        let carried = stretch * Mat3::from_diagonal(&SEMI_AXES);
        let lower = FixedForm::of_image(&carried).cholesky().ok_or(NoMatrix::Inexact(f64::NAN))?.l();
        Ok(lower * ratio * lower.transpose())
    }
}

/// The same bodies, of which those that deform are no ellipsoids.
pub fn of_any_form(mut model: Model) -> Model {
    let second = Mat3::from_diagonal(&SEMI_AXES.component_mul(&SEMI_AXES)) / 5.0;
    // Rounding of matrices of condition 1e3.
    let resolution = Resolution { tolerance: 1e-10, spacing: None };
    let surface = || {
        let table = ResistanceTable::new(Box::new(Linear), &second, resolution).unwrap();
        Form::Surface(SurfaceForm(Arc::new(table)))
    };
    for body in &mut model.bodies {
        let form = surface();
        if let Some(Inclusion { form: before @ Form::Ellipsoid(_), .. }) = &mut Arc::make_mut(body).inclusion {
            *before = form;
        }
    }
    model
}
