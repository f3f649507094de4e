//! The waves with which a run starts.
//!
//!   δp = Re u e^{ik·R},   P = exp(Re A e^{ik·R}) P_i,   A = δP P_i⁻¹;   their rates with λ = −δ − iω before the shape
//!
//! They are put on the rest state of the cell. Waves of a list add, and so do their rates. In random waves each of the
//! N cells' waves has the energy E, with the amplitude √(2E/N)/ω of a shape of length one along coordinates of mass
//! one; κ and −κ are different waves, and zero modes none.

mod exponential;
mod logarithm;
mod passing;

use crate::modes::Rest;
use crate::modes::bands::{BandShape, Branch, LatticeWaves, NoBands, StrainedCell, unit_phase};
use exponential::exponential;
use gyration::body::{Body, BodyKind, Slots};
use gyration::kinematics::{Placement, Quaternion, Velocity};
use gyration::model::Model;
use gyration::state::{RigidStart, Start, State};
use gyration::tensor::{Mat3, Vec3, axial};
use gyration_scene::{NoWave, Packet, StartingWave, Uniform, WaveRun, WaveStart};
use gyration_threads::Interruption;
use nalgebra::{Complex, ComplexField, Matrix3, Vector3};

pub(crate) use logarithm::logarithm;
pub use passing::{Passing, PassingWaves};

type C64 = Complex<f64>;

/// The most bodies of a cell whose waves are found: the matrices have the square of them.
const MOST_BODIES: usize = 300;
/// The largest |A| of a small motion.
pub(crate) const LARGEST: f64 = 1.0;
/// Coordinates within this part of the fastest are as fast: rounding does not choose.
const AS_FAST: f64 = 1e-6;

/// The run that starts with waves, from where its bodies rest without them, in cells whose vectors rest if they are to.
///
/// # Errors
/// [`NoWave`].
pub fn start(model: &Model, asked: &WaveStart) -> Result<WaveRun, NoWave> {
    let cell = &asked.cell;
    let fault = |problem: String, help| NoWave { wave: None, key: None, problem, help, is_interrupted: false };
    if cell.model.bodies.len() > MOST_BODIES {
        let many = cell.model.bodies.len();
        let problem = format!("{many} bodies lie side by side between free ends, and waves are found of {MOST_BODIES}");
        return Err(fault(problem, "make it a packet with a κ along them, or repeat fewer cells along what is free"));
    }
    let (waves, strain) = match cell.load {
        None => (LatticeWaves::new(&cell.model, &cell.state, cell.relaxes), None),
        Some(load) => {
            let rest = StrainedCell::new(&cell.model, &cell.state).at_rest(load).map_err(|error| none(error, None))?;
            (rest.at(&Mat3::identity()).map(|(_, waves)| waves), Some(*rest.rest()))
        }
    };
    let waves = waves.map_err(|error| none(error, None))?;
    let carried = strain.map(|strain| model.clone().with_cells_deformed(&strain, model.lattice.deformed(&strain)));
    let model = carried.as_ref().unwrap_or(model);
    if waves.contracts() {
        let problem = "a body drives its own contraction, which a wave does not set".to_owned();
        return Err(fault(problem, "leave the wave out, or prescribe the contraction"));
    }
    let mut moved = Moved::new(asked, &cell.model, &waves);
    for (index, wave) in asked.waves.iter().enumerate() {
        moved.add(index, wave)?;
    }
    let most = moved.bodies.iter().map(|moved| moved.spread.norm()).fold(0.0, f64::max);
    if most > LARGEST {
        let problem = format!("bodies are turned or strained by {most:.3}: that is no small motion");
        return Err(fault(problem, "give the waves less amplitude or energy, or hold what turns almost freely"));
    }
    let place = |body| moved.rests()[moved.origin(body).0].placement.position;
    let places: Vec<Vec3> = (0..model.bodies.len()).map(place).collect();
    Ok(WaveRun { model: model.clone().resting_at(places), state: moved.state(model), strain })
}

/// Why there is no wave, where there are no bands.
fn none(error: NoBands, wave: Option<usize>) -> NoWave {
    let help = match error {
        NoBands::Rest(_) => "change the cell, or write relax = [] to start from the state as it is written",
        NoBands::Roots(_) | NoBands::Evanescent(_) => "take another wave vector",
        NoBands::CellNotHeld(_) | NoBands::CellNotFound(_) | NoBands::Guide(_) => "leave \"cell\" out of `relax`",
        NoBands::Interrupted => "raise solver.max_wall_time",
    };
    NoWave { wave, key: None, is_interrupted: error == NoBands::Interrupted, problem: error.to_string(), help }
}

/// How a body moves in a wave: u [m] and A.
#[derive(Debug, Clone, Copy)]
struct Motion {
    translation: Vector3<C64>,
    spread: Matrix3<C64>,
}

/// δp, A and their rates of a body of a run.
#[derive(Debug, Clone, Copy)]
struct Displaced {
    translation: Vec3,
    spread: Mat3,
    velocity: Vec3,
    spread_rate: Mat3,
}

/// All bodies of a run, as far as waves have moved them.
struct Moved<'a> {
    asked: &'a WaveStart,
    cell: &'a Model,
    waves: &'a LatticeWaves,
    bodies: Vec<Displaced>,
}

impl<'a> Moved<'a> {
    fn new(asked: &'a WaveStart, cell: &'a Model, waves: &'a LatticeWaves) -> Self {
        let cells = count(&asked.repeat);
        let kinds = cell.bodies.len() / count(&asked.unit);
        Self { asked, cell, waves, bodies: vec![Displaced::NOT; kinds * cells] }
    }

    fn rests(&self) -> &'a [Rest] {
        &self.waves.rest().bodies
    }

    fn origin(&self, body: usize) -> (usize, [u32; 3]) {
        origin(body, &self.asked.repeat, &self.asked.unit)
    }

    /// Adds a wave, or all of them.
    fn add(&mut self, index: usize, wave: &StartingWave) -> Result<(), NoWave> {
        let found = |kappa: [f64; 3]| self.waves.branches(kappa).map_err(|error| none(error, Some(index)));
        match wave {
            StartingWave::Single { kappa, branch, amplitude, packet } => {
                let branches = found(*kappa)?;
                let fault = |key, problem, help| NoWave {
                    wave: Some(index),
                    key: Some(key),
                    problem,
                    help,
                    is_interrupted: false,
                };
                let Some(branch) = branches.get(*branch) else {
                    let problem = format!("there are {} branches, counted from 0", branches.len());
                    return Err(fault("branch", problem, "take one of `gyration bands`"));
                };
                if branch.omega == 0.0 {
                    let problem = "this wave has frequency zero: it does not run".to_owned();
                    return Err(fault("kappa", problem, "take another kappa or branch of `gyration bands`"));
                }
                let motions = self.motions(branch);
                let scale = self
                    .fastest(&motions)
                    .map_or(C64::new(0.0, 0.0), |fastest| fastest.conjugate() * (*amplitude / fastest.norm_sqr()));
                self.put(branch, &motions, scale, |place| place.factor(kappa, packet.as_ref()));
            }
            StartingWave::Random { energy, seed } => {
                let WaveStart { repeat, unit, .. } = *self.asked;
                let counts: [u32; 3] = std::array::from_fn(|a| repeat[a] / unit[a]);
                let mut phases = Uniform::of_seed(*seed);
                for number in 0..count(&counts) as u32 {
                    let along = [number % counts[0], number / counts[0] % counts[1], number / counts[0] / counts[1]];
                    let kappa = std::array::from_fn(|a| f64::from(along[a]) / f64::from(counts[a]));
                    for branch in self.waves.branches(kappa).map_err(|error| none(error, Some(index)))? {
                        let turns = phases.number();
                        if branch.omega == 0.0 {
                            continue;
                        }
                        let amplitude = libm::sqrt(2.0 * energy / count(&counts) as f64) / branch.omega;
                        let motions = self.motions(&branch);
                        self.put(&branch, &motions, unit_phase(turns) * amplitude, |place| place.factor(&kappa, None));
                        if Interruption::due().is_some() {
                            return Err(none(NoBands::Interrupted, Some(index)));
                        }
                    }
                }
            }
        }
        Ok(())
    }

    /// How the bodies of the cell move in a wave.
    fn motions(&self, branch: &Branch) -> Vec<Motion> {
        let of_body = |(shape, rest): (&BandShape, &Rest)| {
            let complex = |[re, im]: [f64; 2]| C64::new(re, im);
            let translation = Vector3::from(shape.translation.map(complex));
            let gradient = Matrix3::from_fn(|i, j| complex(shape.gradient[i][j]));
            let inverse = rest.placement.gradient.try_inverse().unwrap_or_else(Mat3::identity);
            Motion { translation, spread: gradient * inverse.map(|entry| C64::new(entry, 0.0)) }
        };
        branch.shapes.iter().zip(self.rests()).map(of_body).collect()
    }

    /// The coordinate that moves fastest, strains and turns times the body's size.
    fn fastest(&self, motions: &[Motion]) -> Option<C64> {
        let entries = motions.iter().zip(&self.cell.bodies).flat_map(|(motion, body)| {
            let size = if body.is_point() { 0.0 } else { body.size };
            let spread = motion.spread.transpose() * C64::new(size, 0.0);
            motion.translation.iter().chain(spread.iter()).copied().collect::<Vec<_>>()
        });
        let entries: Vec<C64> = entries.collect();
        let most = entries.iter().map(|entry| entry.modulus()).fold(0.0, f64::max);
        entries.into_iter().find(|entry| most > 0.0 && entry.modulus() >= (1.0 - AS_FAST) * most)
    }

    /// Adds a motion of the cell to all cells.
    fn put(&mut self, branch: &Branch, motions: &[Motion], scale: C64, factor: impl Fn(&CellPlace<'_>) -> C64) {
        let root = C64::new(-branch.decay, -branch.omega);
        for body in 0..self.bodies.len() {
            let (kind, at) = self.origin(body);
            let Motion { translation, spread } = motions[kind];
            let factor = scale * factor(&CellPlace { at, asked: self.asked });
            let moved = &mut self.bodies[body];
            moved.translation += translation.map(|entry| (factor * entry).re);
            moved.spread += spread.map(|entry| (factor * entry).re);
            moved.velocity += translation.map(|entry| (root * factor * entry).re);
            moved.spread_rate += spread.map(|entry| (root * factor * entry).re);
        }
    }

    /// The state of the run.
    fn state(&self, model: &Model) -> State {
        let start = |(index, moved): (usize, &Displaced)| {
            let (kind, _) = self.origin(index);
            moved.from(&model.bodies[index], &self.rests()[kind])
        };
        let starts: Vec<Start> = self.bodies.iter().enumerate().map(start).collect();
        State::start(model, &starts)
    }
}

/// The body of the cell that a body of the run is a copy of, and the cell of the run in which this is.
pub(crate) fn origin(body: usize, repeat: &[u32; 3], unit: &[u32; 3]) -> (usize, [u32; 3]) {
    let cells = count(repeat);
    let mut number = (body % cells) as u32;
    let at = repeat.map(|many| {
        let along = number % many;
        number /= many;
        along
    });
    let within = (0..3).rev().fold(0, |within, a| within * unit[a] + at[a] % unit[a]);
    (body / cells * count(unit) + within as usize, at)
}

/// How a body starts that rests.
pub(crate) fn resting(body: &Body, rest: &Rest) -> Start {
    Displaced::NOT.from(body, rest)
}

impl Displaced {
    /// At rest.
    const NOT: Self = Self {
        translation: Vec3::new(0.0, 0.0, 0.0),
        spread: Mat3::new(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
        velocity: Vec3::new(0.0, 0.0, 0.0),
        spread_rate: Mat3::new(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    };

    /// How a body starts that has moved so far from its rest.
    fn from(&self, body: &Body, rest: &Rest) -> Start {
        let Placement { position, gradient } = rest.placement;
        let position = position + self.translation;
        let [turned, rate] = exponential(&self.spread, &self.spread_rate);
        let velocity = self.velocity;
        let place = Placement { position, gradient: turned * gradient };
        let moving = Velocity { velocity, gradient_rate: rate * gradient };
        match &body.kind {
            BodyKind::Rigid(_) => {
                let turn = 0.5 * axial(&self.spread);
                let angle = turn.norm();
                let at_rest = Quaternion::read(&rest.block()[Slots::of(body, 0).attitude()]);
                let orientation = match turn.try_normalize(0.0) {
                    Some(axis) => Quaternion::from_axis_angle(&axis, angle).times(&at_rest),
                    None => at_rest,
                };
                let angular_velocity = 0.5 * axial(&(rate * turned.transpose()));
                Start::Rigid(RigidStart { position, orientation, velocity, angular_velocity })
            }
            BodyKind::Affine(_) => Start::Affine(place, moving),
            // Its contraction is prescribed, or it has none of its own.
            BodyKind::Contractile(_) => Start::Contractile(place, moving, Mat3::identity()),
        }
    }
}

/// A cell of the run.
struct CellPlace<'a> {
    at: [u32; 3],
    asked: &'a WaveStart,
}

impl CellPlace<'_> {
    /// e^{ik·R}, within a packet e^{ik·R − |n − n₀|²/2w²} where n − n₀ is the way round the ring that is shorter.
    fn factor(&self, kappa: &[f64; 3], packet: Option<&Packet>) -> C64 {
        let Some(Packet { at, width }) = packet else {
            return unit_phase((0..3).map(|a| turns(kappa[a], self.at[a])).sum());
        };
        let away: [f64; 3] = std::array::from_fn(|a| {
            let (away, many) = (f64::from(self.at[a]) - at[a], f64::from(self.asked.repeat[a]));
            if self.asked.ring[a] { away - many * (away / many).round() } else { away }
        });
        let square: f64 = away.iter().map(|away| away * away).sum();
        let turns = (0..3).map(|a| kappa[a] * (at[a] + away[a])).sum();
        unit_phase(turns) * libm::exp(-0.5 * square / (width * width))
    }
}

/// κn without whole turns.
fn turns(kappa: f64, n: u32) -> f64 {
    let turns = kappa * f64::from(n);
    turns - turns.round()
}

/// How many cells there are.
fn count(repeat: &[u32; 3]) -> usize {
    repeat.iter().map(|many| *many as usize).product()
}
