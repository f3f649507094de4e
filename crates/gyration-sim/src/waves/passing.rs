//! Waves as they pass: where the bodies of a block of cells are over one period.
//!
//!   p = p_i + R + Re a u e^{i(k·R − φ)},   P = exp(Re a A e^{i(k·R − φ)}) P_i,   A = δP P_i⁻¹,   φ = ωt from 0 to 2π
//!
//! The amplitude a is one to be seen. Decay and growth are left out. A wave without frequency does not pass: it swings,
//! with cos φ in the place of e^{−iφ}.

use super::{C64, Moved, WaveStart, exponential};
use crate::modes::bands::{BandPath, LatticeWaves, PathPoint};
use gyration::kinematics::Placement;
use gyration::tensor::{Mat3, Vec3};
use gyration_scene::UnitCell;
use std::f64::consts::TAU;

/// Instants of a period, the end besides.
const INSTANTS: usize = 48;
/// Cells of a block along each of one, two or three periodic directions.
const CELLS: [u32; 3] = [8, 6, 4];

/// The waves of a lattice over a block of its cells.
#[derive(Debug)]
pub struct PassingWaves {
    waves: LatticeWaves,
    block: WaveStart,
    scale: f64,
}

/// A wave over one period.
#[derive(Debug, Clone, PartialEq)]
pub struct Passing {
    /// ω [rad/s].
    pub omega: f64,
    /// δ [1/s], which is left out.
    pub decay: f64,
    /// The instants [s], both ends of the period among them; parts of the period where ω is zero.
    pub times: Vec<f64>,
    /// Where the bodies are at each: the copies of a body in all cells follow one another, the first direction fastest.
    pub placements: Vec<Vec<Placement>>,
}

impl PassingWaves {
    /// The waves of a cell, about the state of which its bands are; along what is not periodic the block has the cells
    /// that are written.
    pub fn new(cell: UnitCell, waves: LatticeWaves) -> Self {
        let periodic: [bool; 3] = std::array::from_fn(|a| cell.periodic.get(a).copied().unwrap_or(false));
        let along = CELLS[periodic.iter().filter(|it| **it).count().clamp(1, CELLS.len()) - 1];
        let (unit, of_block) = (cell.repeat, |a: usize| if periodic[a] { along } else { cell.repeat[a] });
        // What is drawn may move by a part of the nearest length there is.
        let lengths = waves.rest().cell.iter().zip(&cell.periodic).filter(|it| *it.1).map(|it| it.0.norm());
        let scale = lengths.chain(cell.model.bodies.iter().map(|body| body.size)).fold(f64::INFINITY, f64::min);
        let repeat = std::array::from_fn(of_block);
        let block = WaveStart { cell, unit, repeat, ring: [false; 3], waves: Vec::new() };
        Self { waves, block, scale }
    }

    /// How many cells the block has along each direction.
    pub fn repeat(&self) -> [u32; 3] {
        self.block.repeat
    }

    /// The cell vectors at rest [m].
    pub fn cell(&self) -> &[Vec3] {
        &self.waves.rest().cell
    }

    /// The wave of a branch at the first point of a path; its fastest coordinate, strains and turns times the size of
    /// their body, goes as far as this part of the shortest length: of a cell vector, or of a body.
    ///
    /// # Errors
    /// Why there is none, in words.
    pub fn passing(&self, path: &str, branch: usize, part: f64) -> Result<Passing, String> {
        if !(0.0..=1.0).contains(&part) {
            return Err(format!("{part} is no part of a length: give a number from 0 to 1"));
        }
        let cell = &self.block.cell;
        let path = BandPath::parse(path, 2, &cell.periodic).map_err(|error| error.to_string())?;
        let point: &PathPoint = &path.points[0];
        let row = self.waves.row(point, true).map_err(|error| error.to_string())?;
        let count = row.branches.len();
        let Some(wave) = row.branches.get(branch) else {
            return Err(format!("there are {count} branches, counted from 0"));
        };
        let still = Moved::new(&self.block, &cell.model, &self.waves);
        let motions = still.motions(wave);
        let fastest = still.fastest(&motions);
        let scale = fastest.map_or(C64::new(0.0, 0.0), |it| it.conj() * (part * self.scale / it.norm_sqr()));
        let period = if wave.omega > 0.0 { TAU / wave.omega } else { 1.0 };
        let times: Vec<f64> = (0..=INSTANTS).map(|k| period * k as f64 / INSTANTS as f64).collect();
        let at = |instant: usize| {
            let angle = TAU * instant as f64 / INSTANTS as f64;
            let swing = C64::new(libm::cos(angle), if wave.omega > 0.0 { -libm::sin(angle) } else { 0.0 });
            let mut moved = Moved::new(&self.block, &cell.model, &self.waves);
            moved.put(wave, &motions, scale * swing, |place| place.factor(&point.kappa, None));
            self.placements(&moved)
        };
        let placements = (0..=INSTANTS).map(at).collect();
        Ok(Passing { omega: wave.omega, decay: wave.decay, times, placements })
    }

    /// Where the bodies of all cells are.
    fn placements(&self, moved: &Moved<'_>) -> Vec<Placement> {
        let of = |(index, body): (usize, &super::Displaced)| {
            let (kind, at) = moved.origin(index);
            let whole: [u32; 3] = std::array::from_fn(|a| at[a] / self.block.unit[a] * self.block.unit[a]);
            let cell = self.cell().iter().zip(whole).map(|(vector, n)| f64::from(n) * vector).sum::<Vec3>();
            let [turned, _] = exponential(&body.spread, &Mat3::zeros());
            Placement {
                position: self.waves.place(kind) + cell + body.translation,
                gradient: turned * self.waves.rest().bodies[kind].placement.gradient,
            }
        };
        moved.bodies.iter().enumerate().map(of).collect()
    }
}
