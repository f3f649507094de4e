//! Complex bands of a lattice, in a form to print: all wave vectors that a frequency has.

use super::bands::{BandOptions, path_of};
use super::cell::{unit_cell, waves_of};
use crate::modes::bands::NoBands;
use gyration_scene::Scene;
use serde::Serialize;

/// Waves that run and waves that die out, of frequencies.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ComplexBandSurvey {
    /// ω [rad/s].
    pub omega: Vec<f64>,
    /// Every κ along the direction, real and imaginary part, nearest to running first.
    pub kappa: Vec<Vec<[f64; 2]>>,
}

/// What is asked of complex bands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ComplexBandOptions {
    /// The direction, from 0.
    pub direction: usize,
    /// The frequencies at the ends [rad/s]; those of the path, and a tenth more, if none are asked for.
    pub omega: Option<[f64; 2]>,
}

impl ComplexBandSurvey {
    /// Along a direction, the other κ as at the first point of a path.
    ///
    /// # Errors
    /// Why there are none, in words.
    pub fn of(
        scene: &Scene,
        path: Option<&str>,
        options: BandOptions,
        complex: ComplexBandOptions,
    ) -> Result<Self, String> {
        let cell = unit_cell(scene)?;
        let direction = complex.direction;
        if !cell.periodic.get(direction).copied().unwrap_or(false) {
            return Err(format!("along {} the lattice has no waves: it is not periodic there", direction + 1));
        }
        let path = path_of(cell, path, options.points)?;
        let told = |error: NoBands| error.to_string();
        let waves = waves_of(cell, options.strain.as_ref()).map_err(told)?;
        let [from, to] = match complex.omega {
            Some(ends) => ends,
            None => {
                let mut most: f64 = 0.0;
                for point in path.points.iter().filter(|point| point.is_vertex) {
                    let row = waves.row(point, false).map_err(told)?;
                    most = row.branches.iter().map(|branch| branch.omega).fold(most, f64::max);
                }
                [0.0, 1.1 * most]
            }
        };
        let last = options.points.saturating_sub(1).max(1) as f64;
        let omega: Vec<f64> = (0..options.points.max(1)).map(|k| from + (to - from) * k as f64 / last).collect();
        let kappa = path.points[0].kappa;
        let found = omega.iter().map(|omega| waves.evanescent(&kappa, direction, *omega));
        let kappa = found.collect::<Result<_, _>>().map_err(told)?;
        Ok(Self { omega, kappa })
    }
}
