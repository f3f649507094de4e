//! How short waves may be before a model is off by one in a hundred.
//!
//! Long waves are those whose frequency vanishes with k. A branch of short ones may be below them, so that they are
//! told by what they look like: of all waves at k those that are most like the motions which D(0) does not oppose.

use super::super::bloch::C64;
use super::super::{LatticeWaves, NoBands};
use super::{Continuum, ContinuumModel, ModelWaves, NoContinuum};
use gyration::tensor::Vec3;
use gyration_threads::Interruption;
use nalgebra::DMatrix;
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
        let long = [
            self.long_waves(self.condensed.whole(&Vec3::zeros()), 0)?,
            self.long_waves(self.matrices(model, &Vec3::zeros()), self.loose(model))?,
        ];
        let along = |direction: [f64; 3]| {
            let wavelength = |part: f64| TAU / waves.wave_vector(&direction.map(|it| part * it)).norm();
            let is_off = |part: f64| self.is_off(&waves.wave_vector(&direction.map(|it| part * it)), model, &long);
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

    /// What the long waves of a lattice or a model look like, given its D and M at k = 0, and how many more there are.
    fn long_waves(&self, at_rest: (DMatrix<C64>, DMatrix<C64>), loose: usize) -> Result<LongWaves, NoBands> {
        let at_rest = ModelWaves::of(at_rest).ok_or(NoBands::Roots([0.0; 3]))?;
        let squares = self.told(at_rest.squares);
        let free: Vec<usize> = (0..squares.len()).filter(|wave| squares[*wave] <= 0.0).collect();
        Ok(LongWaves { motions: at_rest.vectors.select_columns(&free), loose })
    }

    /// Whether one of the long waves at k is off.
    fn is_off(&self, k: &Vec3, model: ContinuumModel, [lattice, own]: &[LongWaves; 2]) -> Result<bool, NoBands> {
        if Interruption::due().is_some() {
            return Err(NoBands::Interrupted);
        }
        let of = |long: &LongWaves, matrices| {
            let waves = ModelWaves::of(matrices).ok_or(NoBands::Roots([0.0; 3]))?;
            let squares = self.told(long.squares(&waves));
            Ok::<_, NoBands>(squares.into_iter().map(|square| libm::sqrt(square.max(0.0))))
        };
        let exact = of(lattice, self.condensed.whole(k))?;
        let mut errors =
            of(own, self.matrices(model, k))?.zip(exact).filter_map(|(own, exact)| frequency_error(own, exact));
        Ok(errors.any(|error| error >= OFF))
    }
}

/// The motions that nothing opposes as long as they are the same everywhere.
struct LongWaves {
    /// Column by column, in axes along which M is one.
    motions: DMatrix<C64>,
    /// How many more there are that stay where they are.
    loose: usize,
}

impl LongWaves {
    /// ω² of as many of these waves, those that are most like them, ascending.
    fn squares(&self, waves: &ModelWaves) -> Vec<f64> {
        let along = self.motions.adjoint() * &waves.vectors;
        let shares: Vec<f64> = along.column_iter().map(|column| column.norm_squared()).collect();
        let mut order: Vec<usize> = (0..waves.squares.len()).collect();
        order.sort_by(|one, other| shares[*other].total_cmp(&shares[*one]));
        let long = order.iter().take(self.motions.ncols()).map(|wave| waves.squares[*wave]);
        let mut squares: Vec<f64> = long.chain(std::iter::repeat_n(0.0, self.loose)).collect();
        squares.sort_by(f64::total_cmp);
        squares
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
