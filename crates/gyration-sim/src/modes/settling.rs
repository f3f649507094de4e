//! The way to a state in which contractions stand still, from one in which bodies rest while these are held.

use super::frozen::FrozenSystem;
use super::system::SystemCoordinates;
use crate::singular_values::SingularValues;
use gyration::Inadmissible;
use gyration_threads::Interruption;
use nalgebra::{DMatrix, DVector};

/// Steps on the way to a state in which the contraction stands still, at most, and steps of Newton's from where it then
/// has come to: what creeps under a stiff friction takes long.
const MOST: [usize; 2] = [300, 60];
/// The farthest that Newton's steps may strain a relaxed shape in all.
const FARTHEST: f64 = 0.5;
/// The most that a step may strain body or relaxed shape.
const LARGEST_STRAIN: f64 = 0.2;
/// By how much a relaxed shape would be strained at its speed over the time of a step.
const PACE: f64 = 0.02;
/// Halvings of a step that leaves the model, at most.
const HALVINGS: usize = 40;
/// Singular values below this part of the largest are those of directions that nothing feels.
const NEUTRAL: f64 = 1e-10;
/// Singular values below this part of the largest are those of weak directions.
const WEAK: f64 = 1e-4;
/// Along weak directions, forces below this part of the largest of the search are rounding, which chooses no way.
const NO_FORCE: f64 = 1e-9;
/// Steps smaller than this are the last, once they no longer halve.
const SMALL: f64 = 1e-8;
/// A contraction stands still if it would take this strain to stop it.
const STILL: f64 = 1e-8;

/// The state in which bodies and contractions stand still, to which both get from some numbers without inertia.
///
///   (K + C/τ) z − B γ = r,   γ/τ − (D + E/τ) z − H γ = V_G
///
/// by implicit steps of a time τ, in which V_G strains as much as one step may; as V_G vanishes they become those of
/// Newton's method. Of many states that stand still, as a shape has that flows without resistance, it so comes to the
/// one that the way ends in; directions that nothing feels are left alone. Where the way is long, Newton's method goes
/// on from where it has led. None where a contraction goes on, or nobody waits any longer.
pub(super) fn settled(frozen: &mut FrozenSystem, start: Vec<f64>) -> Result<Option<Vec<f64>>, Inadmissible> {
    let (mut numbers, mut last, mut largest) = (start, f64::INFINITY, 0.0);
    let mut strained = 0.0;
    for steps in (0..MOST[0] + MOST[1]).take_while(|_| Interruption::due().is_none()) {
        let coordinates = SystemCoordinates::at(frozen, &numbers)?;
        let rates = frozen.rates(&numbers)?;
        let force = coordinates.force(&rates);
        let speeds = coordinates.contraction_velocities(frozen, &numbers, &rates);
        let velocity = coordinates.along(&speeds);
        let slopes = frozen.slopes(&numbers)?;
        let (stiffness, first) = coordinates.first_order(&speeds, &slopes);
        let (size, own) = (force.len(), velocity.len());
        let mut system = DMatrix::zeros(size + own, size + own);
        let rate = if steps < MOST[0] { velocity.amax() / PACE } else { 0.0 };
        system.view_mut((0, 0), (size, size)).copy_from(&(stiffness + rate * coordinates.resistance(&slopes)));
        system.view_mut((0, size), (size, own)).copy_from(&-first.forces);
        system.view_mut((size, 0), (own, size)).copy_from(&-(&first.by_place + rate * &first.by_rate));
        system.view_mut((size, size), (own, own)).copy_from(&-&first.own);
        (size..size + own).for_each(|k| system[(k, k)] += rate);
        let right = DVector::from_iterator(size + own, force.iter().chain(velocity.iter()).copied());
        let Some(step) = least_squares(system, right, size, &mut largest) else { return Ok(None) };
        let (mut z, mut strains) = (step.rows(0, size).into_owned(), step.rows(size, own).into_owned());
        let gaps = frozen.gaps(&numbers);
        let shapes = coordinates.shapes(frozen, &z);
        let strain = shapes.iter().enumerate().map(|(body, shape)| {
            let length = gaps[body].least().min(frozen.bodies()[body].size);
            (shape.translation.norm() / length).max((shape.gradient * frozen.inverse(&numbers, body)).norm())
        });
        let strain = strain.fold(0.0, f64::max).max(strains.norm());
        if strain == 0.0 || (strain <= SMALL && strain > 0.5 * last) {
            let stands = velocity.norm() <= STILL * first.own.norm().max(first.by_rate.norm());
            return Ok(stands.then_some(numbers));
        }
        if !strain.is_finite() {
            return Ok(None);
        }
        last = strain;
        let cut = (LARGEST_STRAIN / strain).min(1.0);
        (z, strains) = (z * cut, strains * cut);
        if steps >= MOST[0] {
            strained += strains.norm();
            if strained > FARTHEST {
                return Ok(None);
            }
        }
        let mut part = 1.0;
        let ahead = (0..HALVINGS).find_map(|_| {
            let mut ahead = numbers.clone();
            coordinates.advance(&mut ahead, &(part * &z), &(part * &strains));
            let is_held = frozen.project(&mut ahead);
            part *= 0.5;
            (is_held && frozen.rates(&ahead).is_ok()).then_some(ahead)
        });
        let Some(ahead) = ahead else { return Ok(None) };
        numbers = ahead;
    }
    Ok(None)
}

/// The shortest solution of A x = b, the first `size` equations and unknowns those of the body, in units in which body
/// and contraction act on each other as strongly; `most` is the largest |b| of the search.
fn least_squares(
    mut matrix: DMatrix<f64>,
    mut right: DVector<f64>,
    size: usize,
    most: &mut f64,
) -> Option<DVector<f64>> {
    let own = right.len() - size;
    let ratio = |one: f64, other: f64| if one > 0.0 && other > 0.0 { one / other } else { 1.0 };
    let stiffness = matrix.view((0, 0), (size, size)).norm();
    let unit = ratio(stiffness, matrix.view((0, size), (size, own)).norm());
    matrix.columns_mut(size, own).scale_mut(unit);
    let weight = ratio(stiffness, matrix.rows(size, own).norm());
    matrix.rows_mut(size, own).scale_mut(weight);
    right.rows_mut(size, own).scale_mut(weight);
    let found = SingularValues::of(&matrix)?;
    *most = right.norm().max(*most);
    let stiffest = found.largest();
    let mut solved = DVector::zeros(right.len());
    for k in found.above(NEUTRAL * stiffest) {
        let (value, along) = (found.values[k], found.left(k).dot(&right));
        if value > WEAK * stiffest || along.abs() > NO_FORCE * *most {
            solved += found.right(k) * (along / value);
        }
    }
    solved.rows_mut(size, own).scale_mut(unit);
    Some(solved)
}
