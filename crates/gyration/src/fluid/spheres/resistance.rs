//! Loads on spheres that feel one another through the fluid.
//!
//!   f = −η R̃ u,   R̃ = M⁻¹ + Σ_pairs (R₂ − M₂⁻¹) − R_0,     u = (ṗ₀ − u∞(p₀) | ω − ½ curl u∞)
//!
//! M is the far mobility of all (`tensors`), M₂ its part for two of them, R₂ their exact resistance (`functions`), and
//! R_0 that of each alone, which the body has by itself. For two spheres M⁻¹ cancels M₂⁻¹, and R₂ is left; for more the
//! far field is added in the mobilities and lubrication in the resistances, without stresslets. M₂⁻¹ takes tractions of
//! one form, and u·R u is the largest of 2t·u − t·Gt over all tractions t: R₂ − M₂⁻¹ is not negative, and R̃ + R_0
//! positive definite for any number of spheres. Source: Durlofsky, Brady and Bossis, *J. Fluid Mech.* 180 (1987) 21,
//! without their stresslets; `docs/theory-fluid.md`.

use super::functions::{PairFunctions, PairScalars};
use super::symmetric::Square;
use super::tensors::{Felt, Line, Mat6, Mat6x3, Scalars, Vec6, alone, of_wrench, parts, spin};
use crate::fluid::Flow;
use crate::kinematics::{Placement, Velocity};
use crate::load::{Loads, Mat12};
use crate::tensor::{Mat3, Vec3, axial};
use std::sync::Arc;

/// The spheres of a model that feel one another through the fluid.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ImmersedSpheres {
    /// The indices of the bodies, ascending.
    bodies: Vec<usize>,
    /// R \[m\].
    radii: Vec<f64>,
    /// Those of pairs of different radii.
    functions: Vec<Arc<PairFunctions>>,
    /// Which of these each pair has, in the order of the pairs.
    which: Vec<usize>,
}

/// Two spheres that do not lie apart.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpheresTouch {
    /// The bodies.
    pub bodies: [usize; 2],
    /// The distance of their surfaces \[m\].
    pub gap: f64,
}

/// Two spheres at an instant.
#[derive(Debug, Clone)]
struct Between {
    places: [usize; 2],
    /// M₁₂ and its derivatives by the place of the second.
    far: Mat6,
    far_slopes: [Mat6; 3],
    /// R₂ in the blocks (1, 1), (1, 2), (2, 2), and its derivatives.
    exact: [Mat6; 3],
    exact_slopes: [[Mat6; 3]; 3],
    /// M₂⁻¹.
    far_resistance: Square,
}

/// What the spheres of a model do to one another at an instant.
#[derive(Debug, Clone, Default)]
pub struct SphereLoads {
    viscosity: f64,
    pairs: Vec<Between>,
    /// M⁻¹.
    far: Square,
    /// R̃.
    resistance: Square,
    /// u.
    slips: Vec<f64>,
    /// f.
    forces: Vec<f64>,
    /// ∂f/∂p₀ of all, three columns a sphere; empty where they were not asked for.
    slopes: Vec<[f64; 3]>,
}

impl ImmersedSpheres {
    /// Of these bodies, each with its radius; none of fewer than two.
    pub fn of(spheres: impl IntoIterator<Item = (usize, f64)>) -> Option<Self> {
        let (bodies, radii): (Vec<usize>, Vec<f64>) = spheres.into_iter().unzip();
        if bodies.len() < 2 {
            return None;
        }
        let mut this = Self { bodies, radii, ..Self::default() };
        let mut known: Vec<[f64; 2]> = Vec::new();
        for places in this.pairs().collect::<Vec<_>>() {
            let radii = places.map(|place| this.radii[place]);
            let which = known.iter().position(|other| *other == radii).unwrap_or_else(|| {
                known.push(radii);
                this.functions.push(Arc::new(PairFunctions::new(radii)));
                known.len() - 1
            });
            this.which.push(which);
        }
        Some(this)
    }

    /// The indices of the bodies, ascending.
    pub fn bodies(&self) -> &[usize] {
        &self.bodies
    }

    /// The place of a body among them.
    pub fn place(&self, body: usize) -> Option<usize> {
        self.bodies.binary_search(&body).ok()
    }

    fn pairs(&self) -> impl Iterator<Item = [usize; 2]> + use<> {
        let count = self.bodies.len();
        (0..count).flat_map(move |one| (one + 1..count).map(move |other| [one, other]))
    }
}

impl Between {
    fn at(places: [usize; 2], radii: [f64; 2], functions: &PairFunctions, apart: &Vec3) -> Option<Self> {
        let line = Line::of(apart);
        let exact: PairScalars = functions.at(line.distance);
        let [far, far_slope] = Scalars::far(radii, line.distance);
        let block = far.block(&line);
        let mut far_resistance = Square::default();
        far_resistance.clear(12);
        for (end, radius) in radii.into_iter().enumerate() {
            add_alone(&mut far_resistance, end, alone(radius));
        }
        add_block(&mut far_resistance, [0, 1], &block, 1.0);
        far_resistance.invert().then(|| Self {
            places,
            far: block,
            far_slopes: far.slopes(&far_slope, &line),
            exact: exact.map(|[value, _]| value.block(&line)),
            exact_slopes: exact.map(|[value, slope]| value.slopes(&slope, &line)),
            far_resistance,
        })
    }

    /// The change of what the pair adds to f, at fixed velocities, with the place of the second along an axis.
    fn change(&self, axis: usize, slips: &[Vec6; 2], far_forces: &[Vec6; 2]) -> [Vec6; 2] {
        let [own, between, other] = self.exact_slopes.map(|slopes| slopes[axis]);
        let far = &self.far_slopes[axis];
        let felt = [far * far_forces[1], far.transpose() * far_forces[0]];
        let pulled = halves(&self.far_resistance.image(&joined(&felt)));
        [
            -(own * slips[0] + between * slips[1]) - pulled[0],
            -(between.transpose() * slips[0] + other * slips[1]) - pulled[1],
        ]
    }
}

/// The numbers of one sphere.
fn six(numbers: &[f64], place: usize) -> Vec6 {
    Vec6::from_column_slice(&numbers[6 * place..6 * place + 6])
}

fn halves(numbers: &[f64]) -> [Vec6; 2] {
    [six(numbers, 0), six(numbers, 1)]
}

fn joined(parts: &[Vec6; 2]) -> Vec<f64> {
    parts.iter().flat_map(|part| part.iter().copied()).collect()
}

fn add_alone(matrix: &mut Square, place: usize, [linear, angular]: [f64; 2]) {
    for k in 0..6 {
        matrix.add(6 * place + k, 6 * place + k, if k < 3 { linear } else { angular });
    }
}

/// Adds a block off the diagonal, and its mirror image; on the diagonal the block alone.
fn add_block(matrix: &mut Square, [one, other]: [usize; 2], block: &Mat6, factor: f64) {
    for i in 0..6 {
        for j in 0..6 {
            let value = factor * block[(i, j)];
            matrix.add(6 * one + i, 6 * other + j, value);
            if one != other {
                matrix.add(6 * other + j, 6 * one + i, value);
            }
        }
    }
}

impl SphereLoads {
    /// Finds the resistance, given the place of one sphere as seen from another \[m\], by their bodies.
    ///
    /// # Errors
    /// [`SpheresTouch`] for two that are not apart.
    pub fn place(&mut self, spheres: &ImmersedSpheres, apart: impl Fn([usize; 2]) -> Vec3) -> Result<(), SpheresTouch> {
        let count = spheres.bodies.len();
        let Self { pairs, far, resistance, .. } = self;
        pairs.clear();
        far.clear(6 * count);
        resistance.clear(6 * count);
        for (place, radius) in spheres.radii.iter().enumerate() {
            let alone = alone(*radius);
            add_alone(far, place, alone);
            add_alone(resistance, place, alone.map(|mobility| -1.0 / mobility));
        }
        for (places, which) in spheres.pairs().zip(&spheres.which) {
            let bodies = places.map(|place| spheres.bodies[place]);
            let radii = places.map(|place| spheres.radii[place]);
            let apart = apart(bodies);
            let gap = apart.norm() - radii[0] - radii[1];
            let touch = SpheresTouch { bodies, gap };
            // Also where it is no number.
            if gap.is_nan() || gap <= 0.0 {
                return Err(touch);
            }
            let pair = Between::at(places, radii, &spheres.functions[*which], &apart).ok_or(touch)?;
            add_block(far, places, &pair.far, 1.0);
            for (at, block) in [[0, 0], [0, 1], [1, 1]].into_iter().zip(&pair.exact) {
                add_block(resistance, at.map(|end| places[end]), block, 1.0);
            }
            for (i, j) in (0..144).map(|k| (k / 12, k % 12)) {
                let [row, column] = [i, j].map(|k| 6 * places[k / 6] + k % 6);
                resistance.add(row, column, -pair.far_resistance.at(i, j));
            }
            pairs.push(pair);
        }
        if !far.invert() {
            return Err(SpheresTouch { bodies: [spheres.bodies[0], spheres.bodies[1]], gap: f64::NAN });
        }
        for (i, j) in (0..36 * count * count).map(|k| (k / (6 * count), k % (6 * count))) {
            resistance.add(i, j, far.at(i, j));
        }
        Ok(())
    }

    /// Finds the forces at the velocities of the spheres, in a fluid of this viscosity; where they are wanted, also the
    /// derivatives by their places.
    pub fn set_moving<'a>(
        &mut self,
        (viscosity, flow): (f64, &Flow),
        motions: impl Iterator<Item = (&'a Placement, &'a Velocity, Mat3)>,
        with_slopes: bool,
    ) {
        let swirl = 0.5 * axial(&flow.gradient);
        self.viscosity = viscosity;
        self.slips.clear();
        for (placement, velocity, inverse) in motions {
            let slip = velocity.velocity - flow.at(&placement.position);
            let spin = spin(&(velocity.gradient_rate * inverse)) - swirl;
            self.slips.extend(slip.iter().chain(spin.iter()));
        }
        self.forces = self.resistance.image(&self.slips);
        self.forces.iter_mut().for_each(|force| *force *= -viscosity);
        self.slopes.clear();
        if with_slopes {
            self.find_slopes(&flow.gradient);
        }
    }

    fn find_slopes(&mut self, gradient: &Mat3) {
        let Self { viscosity, pairs, far, resistance, slips, slopes, .. } = self;
        let size = slips.len();
        let count = size / 6;
        slopes.resize(size * count, [0.0; 3]);
        let far_forces = far.image(slips);
        // The changes of M f of all, column by column.
        let mut felt = vec![vec![0.0; size]; 3 * count];
        let mut add = |row: usize, column: usize, axis: usize, value: f64| slopes[row * count + column][axis] += value;
        for Between { places: [one, other], far_slopes, .. } in &*pairs {
            for (axis, slope) in far_slopes.iter().enumerate() {
                let changes = [slope * six(&far_forces, *other), slope.transpose() * six(&far_forces, *one)];
                for (place, change) in [one, other].into_iter().zip(changes) {
                    for k in 0..6 {
                        felt[3 * other + axis][6 * place + k] += change[k];
                        felt[3 * one + axis][6 * place + k] -= change[k];
                    }
                }
            }
        }
        for (column, felt) in felt.iter().enumerate() {
            for (row, value) in far.image(felt).into_iter().enumerate() {
                add(row, column / 3, column % 3, *viscosity * value);
            }
        }
        for pair in &*pairs {
            let own = pair.places.map(|place| six(slips, place));
            let forces = halves(&pair.far_resistance.image(&joined(&own)));
            for axis in 0..3 {
                let changes = pair.change(axis, &own, &forces);
                for (place, change) in pair.places.into_iter().zip(changes) {
                    for k in 0..6 {
                        add(6 * place + k, pair.places[1], axis, *viscosity * change[k]);
                        add(6 * place + k, pair.places[0], axis, -*viscosity * change[k]);
                    }
                }
            }
        }
        // Where a sphere moves the undisturbed flow is another: δu = −L∞ δp₀.
        for row in 0..size {
            for column in 0..count {
                let own = Vec3::from_column_slice(&resistance.row(row)[6 * column..6 * column + 3]);
                let change = gradient.tr_mul(&own);
                (0..3).for_each(|axis| add(row, column, axis, *viscosity * change[axis]));
            }
        }
    }

    /// Force \[N\] and torque about the centre \[N m\] of what the others change for a sphere, in the axes of space.
    pub fn wrench(&self, place: usize) -> (Vec3, Vec3) {
        parts(&six(&self.forces, place))
    }

    /// What of the power of the fluid's loads these have, taken at the velocities beside the undisturbed flow \[W\].
    pub fn dissipation(&self, place: usize) -> f64 {
        -six(&self.forces, place).dot(&six(&self.slips, place))
    }

    /// f and M of a sphere of the gradient P.
    pub fn loads(&self, place: usize, gradient: &Mat3) -> Loads {
        of_wrench(&six(&self.forces, place), gradient)
    }

    /// ∂Q_i/∂q_j and ∂Q_i/∂q̇_j, the former only where it was asked for; `on` is P_i, `of` are P_j⁻¹ and Ṗ_j.
    pub fn coupling(&self, [i, j]: [usize; 2], on: &Mat3, of: (&Mat3, &Mat3)) -> [Mat12; 2] {
        let count = self.slips.len() / 6;
        let by_slip = Mat6::from_fn(|row, column| -self.viscosity * self.resistance.at(6 * i + row, 6 * j + column));
        let by_place = |row: usize| match self.slopes.is_empty() {
            true => [0.0; 3],
            false => self.slopes[(6 * i + row) * count + j],
        };
        let felt = Felt { by_slip, by_place: Mat6x3::from_fn(|row, axis| by_place(row)[axis]) };
        let own = (i == j).then(|| self.wrench(i).1);
        felt.coupling(own.as_ref(), on, of)
    }

    /// R̃ + R_0 of the spheres, row by row, for viscosity 1: its properties are tested, and a run needs R̃ alone.
    #[cfg(test)]
    pub(super) fn whole_resistance(&self, spheres: &ImmersedSpheres) -> Vec<Vec<f64>> {
        let size = 6 * spheres.radii.len();
        let mut rows: Vec<Vec<f64>> = (0..size).map(|row| self.resistance.row(row).to_vec()).collect();
        for (k, row) in rows.iter_mut().enumerate() {
            row[k] += 1.0 / alone(spheres.radii[k / 6])[usize::from(k % 6 > 2)];
        }
        rows
    }
}
