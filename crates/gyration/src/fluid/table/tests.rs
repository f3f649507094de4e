//! What a table promises: errors below the tolerance, second order, the same numbers in whatever order it is asked.

use super::*;
use crate::fluid::FixedForm;
use crate::tensor::Vec3;
use std::sync::atomic::AtomicUsize;
use std::sync::atomic::Ordering::Relaxed;

/// An ellipsoid that is measured by a sphere, so that C is far from constant.
#[derive(Debug)]
struct Skew {
    carried: Mat3,
    /// Forms with |dev ln E| beyond it have no resistance.
    reach: f64,
    /// How many matrices are still waited for.
    patience: AtomicUsize,
}

impl ResistanceSource for Skew {
    fn matrix(&self, stretch: &Mat3) -> Result<Mat12, NoMatrix> {
        if self.patience.fetch_update(Relaxed, Relaxed, |left| left.checked_sub(1)).is_err() {
            self.patience.store(usize::MAX, Relaxed);
            return Err(NoMatrix::Interrupted);
        }
        if PrincipalStretch::of(stretch).strain().norm() > self.reach {
            return Err(NoMatrix::Inexact(0.3));
        }
        Ok(FixedForm::of_image(&(stretch * self.carried)))
    }
}

fn table(tolerance: f64, spacing: Option<f64>, reach: f64) -> ResistanceTable {
    impatient(tolerance, spacing, (reach, usize::MAX))
}

/// One that is given up once after so many matrices.
fn impatient(tolerance: f64, spacing: Option<f64>, (reach, patience): (f64, usize)) -> ResistanceTable {
    let source = Skew { carried: Mat3::from_diagonal(&Vec3::new(1.0, 0.6, 0.5)), reach, patience: patience.into() };
    let table =
        ResistanceTable::new(Box::new(source), &Mat3::from_diagonal_element(0.1), Resolution { tolerance, spacing });
    table.unwrap_or_else(|| panic!("a sphere has a volume"))
}

/// Forms all around the undeformed one.
fn forms() -> impl DoubleEndedIterator<Item = PrincipalStretch> {
    (0..60).map(|n| {
        PrincipalStretch::at(&Strain::from_fn(|m, _| {
            0.5 * (1.7 * f64::from(n) * (1.0 + m as f64) + 0.3 * m as f64).sin()
        }))
    })
}

/// H of the table, and its error.
fn measured(table: &ResistanceTable, stretch: &PrincipalStretch) -> Result<(Mat12, f64), UnresolvedForm> {
    let matrix = table.matrix(&stretch.matrix())?;
    let exact = table.source.matrix(&stretch.matrix()).unwrap_or_else(|_| Mat12::zeros());
    Ok((matrix, largest_error(&matrix, &exact)))
}

fn largest(table: &ResistanceTable) -> f64 {
    forms().map(|form| measured(table, &form).map_or(f64::NAN, |(_, error)| error)).fold(0.0, f64::max)
}

#[test]
fn errors_at_any_form_are_below_the_tolerance() {
    let table = table(1e-2, None, 10.0);
    let error = largest(&table);
    println!("largest error {error:.2e} of a tolerance of 1e-2 with {:?} nodes and simplices", table.size());
    assert!(error > 1e-4, "{error}: the test sees nothing");
    assert!(error < 1e-2, "{error}");
}

#[test]
fn error_falls_with_the_square_of_the_spacing() {
    let [coarse, fine] = [0.2, 0.1].map(|spacing| largest(&table(1.0, Some(spacing), 10.0)));
    let order = (coarse / fine).log2();
    println!("errors {coarse:.2e} and {fine:.2e}: order {order:.2}");
    // The forms lie elsewhere in the simplices of the one lattice than in those of the other.
    assert!((1.5..2.5).contains(&order), "{order}");
}

#[test]
fn forms_that_are_resolved_too_coarsely_have_no_resistance() {
    let coarse = table(1e-3, Some(0.5), 10.0);
    let refused = forms().filter_map(|form| measured(&coarse, &form).err()).collect::<Vec<_>>();
    assert!(!refused.is_empty());
    for UnresolvedForm { quantity, value } in refused {
        assert_eq!(quantity, Quantity::Interpolation);
        assert!(value > 1e-3, "{value}");
    }
}

#[test]
fn forms_without_a_matrix_have_no_resistance() {
    let short = table(1e-1, Some(0.5), 1.2);
    let far = PrincipalStretch::at(&Strain::from([1.4, 0.1, 0.2, 0.05, 0.0]));
    let refused = short.around(&far).err().unwrap_or_else(|| panic!("{short:?}"));
    assert_eq!(refused, UnresolvedForm { quantity: Quantity::Elements, value: 0.3 });
}

#[test]
fn numbers_do_not_depend_on_the_order_of_the_questions() {
    let (one, other) = (table(1e-2, None, 10.0), table(1e-2, None, 10.0));
    let bits = |table: &ResistanceTable, form: &PrincipalStretch| {
        let (matrix, _) = measured(table, form).unwrap_or_else(|error| panic!("{error:?}"));
        matrix.iter().map(|entry| entry.to_bits()).collect::<Vec<_>>()
    };
    let forth: Vec<_> = forms().map(|form| bits(&one, &form)).collect();
    let mut back: Vec<_> = forms().rev().map(|form| bits(&other, &form)).collect();
    back.reverse();
    assert_eq!(forth, back);
}

/// Whoever comes back gets what he would have got at once: nothing that was given up is kept as an answer.
#[test]
fn what_was_given_up_is_known_when_it_is_asked_for_again() {
    let patient = table(1e-2, None, 10.0);
    for patience in [0, 3, 6, 8, 20] {
        let impatient = impatient(1e-2, None, (10.0, patience));
        let mut given_up = 0;
        for form in forms() {
            let stretch = form.matrix();
            let found = impatient.matrix(&stretch).or_else(|UnresolvedForm { quantity, .. }| {
                assert_eq!(quantity, Quantity::Interruption);
                given_up += 1;
                impatient.matrix(&stretch)
            });
            assert_eq!(found, patient.matrix(&stretch));
        }
        assert_eq!((given_up, impatient.size()), (1, patient.size()));
    }
}
