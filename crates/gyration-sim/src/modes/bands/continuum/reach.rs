//! How short waves may be before a model is off by one in a hundred.

use super::super::{LatticeWaves, NoBands};
use super::{Continuum, ContinuumModel, NoContinuum};
use gyration::tensor::Vec3;
use serde::Serialize;
use std::f64::consts::TAU;

/// The error of a frequency at which a model ends.
const OFF: f64 = 0.01;
/// Wave vectors between the centre and the boundary of the zone at which it is looked for.
const LOOKS: u32 = 48;
/// κ below this belongs to waves that no lattice is long enough for; frequencies nearer to zero are soon rounding.
const LONGEST: f64 = 1e-4;
/// Halvings of what lies between two of them.
const HALVINGS: u32 = 40;

/// Where a model ends along a direction.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Reach {
    /// The unit vector along which waves run.
    pub direction: [f64; 3],
    /// The wavelength [m] at which the worst of the long waves is first off by 1 %; none where none is up to the
    /// boundary of the zone, or one is however long it is.
    pub wavelength: Option<f64>,
    /// Whether it is off however long waves are.
    pub throughout: bool,
}

impl Continuum {
    /// Where a model ends, along the reciprocal vectors of what is periodic and the diagonals between them.
    ///
    /// # Errors
    /// [`NoContinuum`] if roots are not found.
    pub fn reach(
        &self,
        waves: &LatticeWaves,
        model: ContinuumModel,
        periodic: &[bool],
    ) -> Result<Vec<Reach>, NoContinuum> {
        let at_rest = self.squares(model, &Vec3::zeros())?;
        let long = at_rest.iter().filter(|square| **square <= 0.0).count();
        let along = |direction: [f64; 3]| {
            let wavelength = |part: f64| TAU / waves.wave_vector(&direction.map(|it| part * it)).norm();
            let is_off = |part: f64| self.is_off(waves, model, direction.map(|it| part * it), long);
            let mut ends = None;
            for look in 1..=LOOKS {
                let part = |look: u32| 0.5 * f64::from(look) / f64::from(LOOKS);
                if is_off(part(look))? {
                    ends = Some([part(look - 1), part(look)]);
                    break;
                }
            }
            if let Some([good, bad]) = &mut ends {
                for _ in 0..HALVINGS {
                    let middle = 0.5 * (*good + *bad);
                    *(if is_off(middle)? { &mut *bad } else { &mut *good }) = middle;
                }
            }
            let unit = waves.wave_vector(&direction).normalize();
            let throughout = ends.is_some_and(|[_, bad]| bad < LONGEST);
            let wavelength = ends.filter(|_| !throughout).map(|[_, bad]| wavelength(bad));
            Ok(Reach { direction: unit.into(), wavelength, throughout })
        };
        directions(periodic).into_iter().map(along).collect()
    }

    /// Whether one of so many of the lowest waves at κ is off.
    fn is_off(
        &self,
        waves: &LatticeWaves,
        model: ContinuumModel,
        kappa: [f64; 3],
        long: usize,
    ) -> Result<bool, NoBands> {
        let lattice = waves.frequencies(&kappa)?;
        let own = self.frequencies(model, &waves.wave_vector(&kappa))?;
        let mut errors = own.iter().zip(&lattice).take(long).filter_map(|(own, exact)| frequency_error(*own, *exact));
        Ok(errors.any(|error| error >= OFF))
    }
}

/// |ω_c/ω − 1|; none where ω is zero.
pub fn frequency_error(own: f64, exact: f64) -> Option<f64> {
    (exact > 0.0).then(|| (own / exact - 1.0).abs())
}

/// κ of what is looked at: along each direction that is periodic, then between them.
fn directions(periodic: &[bool]) -> Vec<[f64; 3]> {
    let free: Vec<usize> = (0..periodic.len()).filter(|a| periodic[*a]).collect();
    let with = |axes: &[usize], signs: &[f64]| {
        let mut kappa = [0.0; 3];
        axes.iter().zip(signs).for_each(|(axis, sign)| kappa[*axis] = *sign);
        kappa
    };
    let mut directions: Vec<[f64; 3]> = free.iter().map(|axis| with(&[*axis], &[1.0])).collect();
    for (number, one) in free.iter().enumerate() {
        for other in &free[number + 1..] {
            directions.extend([1.0, -1.0].map(|sign| with(&[*one, *other], &[1.0, sign])));
        }
    }
    if let [_, _, _] = free[..] {
        let signs = [[1.0, 1.0, 1.0], [1.0, 1.0, -1.0], [1.0, -1.0, 1.0], [-1.0, 1.0, 1.0]];
        directions.extend(signs.map(|signs| with(&free, &signs)));
    }
    directions
}
