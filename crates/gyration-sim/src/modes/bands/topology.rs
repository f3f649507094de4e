//! What is left of the phases of undamped waves when κ goes round: Zak phases and Chern numbers.
//!
//!   ψ = (K^½ ξ, ξ̇),   i ∂ₜψ = [[0, iK^½], [−iK^½, −iC]] ψ,   ω > 0
//!   Zak: −arg Π ⟨ψ_i|ψ_{i+1}⟩ round κ_a,     Chern: Σ −arg/2π of the plaquettes of a mesh, counterclockwise in k
//!
//! Without gyroscopic loads ψ is as good as ξ along coordinates of mass one. Phases are those of the cell, so that ψ is
//! the same at κ and κ plus whole numbers, and a Zak phase depends on what counts as one cell. Branches that touch go
//! together: a Zak phase is then one of the eigenvalues of the product of overlaps (the Wilson loop), a Chern number
//! that of their determinants. Links whose overlaps are small are halved before; of plaquettes the largest phase is
//! told.
//!
//! A product of n overlaps misses the phase by a series in n⁻²: n is doubled, and what is left of the series taken off
//! (Romberg), until that tells no other phase.
//!
//! Sources: J. Zak, *Phys. Rev. Lett.* 62 (1989) 2747; T. Fukui, Y. Hatsugai and H. Suzuki, *J. Phys. Soc. Jpn* 74
//! (2005) 1674.

use super::by_cell::C64;
use super::eigenspaces::{eigenvalues, hermitian, hermitian_eigen};
use super::touching::{Touching, touching};
use super::waves::NEUTRAL;
use super::{LatticeWaves, NoBands};
use gyration_threads::Interruption;
use nalgebra::{ComplexField, DMatrix, Dyn, SymmetricEigen};
use serde::Serialize;
use std::f64::consts::{PI, TAU};

/// An overlap of neighbouring states below this is no neighbourhood: the link is halved.
const OVERLAP: f64 = 0.97;
/// Halvings of a link at most: κ then has no more digits.
const HALVINGS: usize = 40;
/// A phase this near to −π is π.
const AT_PI: f64 = 1e-6;
/// Phases of twice as many links that differ by less are those of any number of them [rad].
const SETTLED: f64 = 1e-10;
/// Doublings of the links at most.
const DOUBLINGS: usize = 7;
/// ω below this part of the largest is zero: ψ has no phase there.
const STILL: f64 = 1e-7;

/// The phases of all branches.
#[derive(Debug, Clone, PartialEq)]
pub struct Topology {
    /// The Zak phases [rad], in (−π, π]: a row a periodic direction, an entry a branch; ascending among branches that
    /// touch on the way, none where ω vanishes and gyroscopic loads act.
    pub zak: Vec<Vec<Option<f64>>>,
    /// By how much twice as many overlaps change a Zak phase [rad].
    pub zak_change: f64,
    /// The Chern numbers of branches that touch no other, and of groups that do; none of a lattice that is not periodic
    /// along two directions.
    pub chern: Vec<BranchChern>,
    /// The gaps of the mesh, ascending; none without Chern numbers.
    pub gaps: Vec<ChernGap>,
    /// The largest |phase| of a plaquette [rad]: beyond π it would count as another.
    pub largest_phase: f64,
}

/// A Chern number.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BranchChern {
    /// The branches, one or those that touch.
    pub branches: Vec<usize>,
    /// The number; none where ω vanishes and gyroscopic loads act.
    pub number: Option<i64>,
}

/// Frequencies at which no wave of the bulk runs, and how many run along an edge.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ChernGap {
    /// Its lower edge [rad/s].
    pub from: f64,
    /// Its upper edge [rad/s].
    pub to: f64,
    /// The branch below it.
    pub below: usize,
    /// The sum of the Chern numbers below: branches that cross the gap on one edge, up less down.
    pub chern: i64,
}

/// Why there are no phases.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NoTopology {
    /// Something resists or drives.
    #[error(
        "phases are those of waves that neither decay nor grow: leave out damping, friction, fluid, contractions that \
         move, and forces without a potential, as contacts of bodies that deform have them unless measure = \
         \"deformed_area_potential\" (gyroscopic loads may stay)"
    )]
    Losses,
    /// A wave grows.
    #[error(
        "phases are those of waves that neither decay nor grow, and at κ = ({:?}, {:?}, {:?}) one grows",
        .0[0], .0[1], .0[2]
    )]
    Unstable([f64; 3]),
    /// The roots were not found.
    #[error(transparent)]
    Bands(#[from] NoBands),
}

/// The states at a wave vector.
#[derive(Debug, Clone)]
pub(super) struct States {
    /// ω, ascending [rad/s].
    pub omega: Vec<f64>,
    /// ψ of each, column by column.
    vectors: DMatrix<C64>,
}

impl States {
    /// Of some branches.
    fn of(&self, group: &[usize]) -> DMatrix<C64> {
        self.vectors.columns(group[0], group.len()).into_owned()
    }
}

impl LatticeWaves {
    /// The phases of all branches: Zak's along each periodic direction, the other κ as given, Chern's of a mesh of so
    /// many wave vectors along each of two.
    ///
    /// # Errors
    /// [`NoTopology`].
    pub fn topology(&self, kappa: [f64; 3], mesh: usize, periodic: &[bool]) -> Result<Topology, NoTopology> {
        if !self.system.is_lossless {
            return Err(NoTopology::Losses);
        }
        let axes: Vec<usize> = (0..periodic.len()).filter(|a| periodic[*a]).collect();
        let mesh = mesh.max(3);
        let zak = axes.iter().map(|axis| self.zak(kappa, *axis, mesh)).collect::<Result<Vec<_>, _>>()?;
        let change = zak.iter().map(|(_, change)| *change).fold(0.0, f64::max);
        let zak = zak.into_iter().map(|(phases, _)| phases).collect();
        let mut found = Topology { zak, zak_change: change, chern: Vec::new(), gaps: Vec::new(), largest_phase: 0.0 };
        if let [one, other] = axes[..] {
            self.chern([one, other], mesh, &mut found)?;
        }
        Ok(found)
    }

    /// ψ at κ.
    pub(super) fn states(&self, kappa: &[f64; 3]) -> Result<States, NoTopology> {
        if Interruption::due().is_some() {
            return Err(NoBands::Interrupted.into());
        }
        let roots = || NoBands::Roots(*kappa);
        let matrices = self.system.wave(kappa);
        let size = matrices.stiffness.nrows();
        let eigen = hermitian_eigen(hermitian(matrices.stiffness)).ok_or_else(roots)?;
        if eigen.eigenvalues.iter().any(|square| *square < -NEUTRAL * self.system.stiffest) {
            return Err(NoTopology::Unstable(*kappa));
        }
        let frequencies = eigen.eigenvalues.map(|square| libm::sqrt(square.max(0.0)));
        if self.system.is_conservative {
            return Ok(sorted(frequencies.as_slice(), &eigen.eigenvectors, size));
        }
        let along = DMatrix::from_diagonal(&frequencies.map(|omega| C64::new(omega, 0.0)));
        let root = &eigen.eigenvectors * along * eigen.eigenvectors.adjoint();
        let i = C64::new(0.0, 1.0);
        let mut whole = DMatrix::zeros(2 * size, 2 * size);
        whole.view_mut((0, size), (size, size)).copy_from(&(&root * i));
        whole.view_mut((size, 0), (size, size)).copy_from(&(root * -i));
        whole.view_mut((size, size), (size, size)).copy_from(&(matrices.resistance * -i));
        let eigen = hermitian_eigen(hermitian(whole)).ok_or_else(roots)?;
        Ok(sorted(eigen.eigenvalues.as_slice(), &eigen.eigenvectors, size))
    }

    /// Whether ψ has no phase where ω vanishes.
    fn is_still(&self, group: &[usize], touching: &Touching) -> bool {
        !self.system.is_conservative && group[0] == 0 && touching.least <= STILL * touching.most
    }

    /// The Zak phase of each branch along a direction, and by how much the last doubling has changed one [rad].
    fn zak(&self, kappa: [f64; 3], axis: usize, mesh: usize) -> Result<(Vec<Option<f64>>, f64), NoTopology> {
        let at = |part: f64| {
            let mut there = kappa;
            there[axis] = part;
            there
        };
        let states = |part: f64| self.states(&at(part));
        let at_link = |k: usize| {
            let part = k as f64 / mesh as f64;
            Ok::<_, NoTopology>((part, states(part)?))
        };
        let mut points = (0..mesh).map(at_link).collect::<Result<Vec<_>, _>>()?;
        let omega: Vec<Vec<f64>> = points.iter().map(|(_, states)| states.omega.clone()).collect();
        let touching = touching(&omega, [mesh, 1], |[part, _]| Ok::<_, NoTopology>(states(part)?.omega))?;
        let groups: Vec<&Vec<usize>> =
            touching.groups.iter().filter(|group| !self.is_still(group, &touching)).collect();
        for _ in 0..HALVINGS {
            let are_far = |ends: [&States; 2]| -> Option<bool> {
                let overlap = |group: &&Vec<usize>| least_overlap(&ends.map(|states| states.of(group)));
                Some(groups.iter().map(overlap).collect::<Option<Vec<_>>>()?.into_iter().any(|least| least < OVERLAP))
            };
            let (count, mut more) = (points.len(), Vec::new());
            for (k, point) in points.iter().enumerate() {
                more.push(point.clone());
                if are_far([&point.1, &points[(k + 1) % count].1]).ok_or(NoBands::Roots(kappa))? {
                    let part = middle(&points, k);
                    more.push((part, states(part)?));
                }
            }
            points = more;
            if points.len() == count {
                break;
            }
        }
        let mut tables = Vec::new();
        for group in &groups {
            tables.push(Romberg::new(loop_phases(&points, group).ok_or(NoBands::Roots(kappa))?));
        }
        for _ in 0..DOUBLINGS {
            if tables.iter().all(Romberg::is_settled) {
                break;
            }
            let mut halved = Vec::new();
            for (k, point) in points.iter().enumerate() {
                let part = middle(&points, k);
                halved.extend([point.clone(), (part, states(part)?)]);
            }
            points = halved;
            for (table, group) in tables.iter_mut().zip(&groups) {
                table.refine(loop_phases(&points, group).ok_or(NoBands::Roots(kappa))?);
            }
        }
        let change = tables.iter().map(|table| table.change).fold(0.0, f64::max);
        let mut tables = tables.into_iter();
        let mut phases = Vec::new();
        for group in &touching.groups {
            match self.is_still(group, &touching) {
                true => phases.extend(group.iter().map(|_| None)),
                false => phases.extend(tables.next().into_iter().flat_map(Romberg::phases).map(Some)),
            }
        }
        Ok((phases, change))
    }

    /// The Chern numbers of the plane of two directions.
    fn chern(&self, [one, other]: [usize; 2], mesh: usize, found: &mut Topology) -> Result<(), NoTopology> {
        let at = |[first, second]: [f64; 2]| {
            let mut kappa = [0.0; 3];
            (kappa[one], kappa[other]) = (first, second);
            kappa
        };
        let place = |k: usize| (k % mesh) as f64 / mesh as f64;
        let line = |row: usize| -> Result<Vec<States>, NoTopology> {
            (0..mesh).map(|k| self.states(&at([place(k), place(row)]))).collect()
        };
        let first = line(0)?;
        let mut omega: Vec<Vec<f64>> = first.iter().map(|states| states.omega.clone()).collect();
        for row in 1..mesh {
            omega.extend(line(row)?.into_iter().map(|states| states.omega));
        }
        let touching = touching(&omega, [mesh, mesh], |part| Ok::<_, NoTopology>(self.states(&at(part))?.omega))?;
        let mut turns = vec![0.0; touching.groups.len()];
        let mut below = first.clone();
        for row in 0..mesh {
            let above = if row + 1 == mesh { first.clone() } else { line(row + 1)? };
            for k in 0..mesh {
                let next = (k + 1) % mesh;
                let corners = [&below[k], &below[next], &above[next], &above[k]];
                for (turn, group) in turns.iter_mut().zip(&touching.groups) {
                    let phase = plaquette(&corners.map(|states| states.of(group)));
                    found.largest_phase = found.largest_phase.max(phase.abs());
                    *turn -= phase / TAU;
                }
            }
            below = above;
        }
        let reciprocal = self.lattice.reciprocal();
        let normal = reciprocal[one].cross(&reciprocal[other]);
        let side = f64::signum(normal[normal.iamax()]);
        let numbers = touching.groups.iter().zip(&turns).map(|(group, turns)| BranchChern {
            branches: group.clone(),
            number: (!self.is_still(group, &touching)).then(|| (side * turns).round() as i64),
        });
        found.chern = numbers.collect();
        found.gaps = gaps(&omega, &found.chern);
        Ok(())
    }
}

/// The middle of a link of a line that closes at one, the last of which leads back to the first.
fn middle(points: &[(f64, States)], link: usize) -> f64 {
    let end = points.get(link + 1).map_or(1.0 + points[0].0, |point| point.0);
    0.5 * (points[link].0 + end)
}

/// The eigenvalues of AᴴA with their vectors, A the overlaps of two neighbours.
fn squared(overlap: &DMatrix<C64>) -> Option<SymmetricEigen<C64, Dyn>> {
    hermitian_eigen(hermitian(overlap.adjoint() * overlap))
}

/// The least overlap of the states of a group between two places.
fn least_overlap([from, to]: &[DMatrix<C64>; 2]) -> Option<f64> {
    let squares = squared(&(from.adjoint() * to))?;
    Some(squares.eigenvalues.iter().copied().fold(f64::INFINITY, f64::min).max(0.0).sqrt())
}

/// The unitary part of the overlaps of the states of a group between two places, by the polar decomposition.
fn link([from, to]: [DMatrix<C64>; 2]) -> Option<DMatrix<C64>> {
    let overlap = from.adjoint() * to;
    let squares = squared(&overlap)?;
    let inverse = squares.eigenvalues.map(|square| C64::new(1.0 / libm::sqrt(square.max(f64::MIN_POSITIVE)), 0.0));
    let size = &squares.eigenvectors * DMatrix::from_diagonal(&inverse) * squares.eigenvectors.adjoint();
    Some(overlap * size)
}

/// The phases of the loop of overlaps of a group over points of a line.
fn loop_phases(points: &[(f64, States)], group: &[usize]) -> Option<Vec<f64>> {
    let mut product = DMatrix::<C64>::identity(group.len(), group.len());
    for (k, (_, states)) in points.iter().enumerate() {
        let (_, next) = &points[(k + 1) % points.len()];
        product *= link([states.of(group), next.of(group)])?;
    }
    let mut phases: Vec<f64> = eigenvalues(&product)?.iter().map(|value| -value.argument()).collect();
    phases.sort_by(f64::total_cmp);
    Some(phases)
}

/// Phases of loops of n, 2n, 4n, … links, and what they tend to.
struct Romberg {
    /// The last row of the table: the phases as they are, then without n⁻², without n⁻⁴, …
    row: Vec<Vec<f64>>,
    /// The best of that row, and by how much it differs from the one before, or from the best of the row before [rad]:
    /// two may agree by chance.
    best: Vec<f64>,
    change: f64,
}

impl Romberg {
    fn new(phases: Vec<f64>) -> Self {
        Self { row: vec![phases.clone()], best: phases, change: f64::INFINITY }
    }

    fn is_settled(&self) -> bool {
        self.change < SETTLED
    }

    /// Takes the phases of twice as many links.
    fn refine(&mut self, phases: Vec<f64>) {
        let mut row = vec![alike(&self.row[0], phases)];
        let apart = |one: &[f64], other: &[f64]| {
            one.iter().zip(other).map(|(one, other)| (one - other).abs()).fold(0.0, f64::max)
        };
        let (mut best, mut least) = (row[0].clone(), f64::INFINITY);
        for (k, before) in self.row.iter().enumerate() {
            let factor = libm::exp2(2.0 * (k + 1) as f64) - 1.0;
            let better: Vec<f64> = row[k].iter().zip(before).map(|(new, old)| new + (new - old) / factor).collect();
            let change = apart(&better, &row[k]);
            if change < least {
                (best, least) = (better.clone(), change);
            }
            row.push(better);
        }
        self.change = least.max(apart(&best, &self.best));
        (self.best, self.row) = (best, row);
    }

    /// What they tend to, in (−π, π], ascending.
    fn phases(self) -> Vec<f64> {
        let mut phases: Vec<f64> = self.best.into_iter().map(|phase| within(principal(phase))).collect();
        phases.sort_by(f64::total_cmp);
        phases
    }
}

/// Phases in that turn in which, and in that order in which, they are nearest to others.
fn alike(others: &[f64], phases: Vec<f64>) -> Vec<f64> {
    let count = phases.len();
    let shifted = |by: usize| -> Vec<f64> {
        let phase = |k: usize| others[k] + principal(phases[(k + by) % count] - others[k]);
        (0..count).map(phase).collect()
    };
    let apart = |phases: &[f64]| -> f64 { phases.iter().zip(others).map(|(one, other)| (one - other).abs()).sum() };
    let nearest = (0..count).map(shifted).min_by(|one, other| apart(one).total_cmp(&apart(other)));
    nearest.unwrap_or_default()
}

/// A phase in [−π, π].
fn principal(phase: f64) -> f64 {
    phase - TAU * (phase / TAU).round()
}

/// The largest so many frequencies with their vectors, ascending.
fn sorted(values: &[f64], vectors: &DMatrix<C64>, count: usize) -> States {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|a, b| values[*a].total_cmp(&values[*b]));
    let order = &order[values.len() - count..];
    let omega = order.iter().map(|k| values[*k].max(0.0)).collect();
    States { omega, vectors: vectors.select_columns(order) }
}

/// arg ⟨1|2⟩⟨2|3⟩⟨3|4⟩⟨4|1⟩, of determinants.
fn plaquette(corners: &[DMatrix<C64>; 4]) -> f64 {
    let product = (0..4).fold(C64::new(1.0, 0.0), |product, k| {
        let overlap = (corners[k].adjoint() * &corners[(k + 1) % 4]).determinant();
        let size = overlap.modulus();
        if size > 0.0 { product * overlap / size } else { product }
    });
    product.argument()
}

/// A phase in (−π, π].
fn within(phase: f64) -> f64 {
    if phase <= -PI + AT_PI { phase + TAU } else { phase + 0.0 }
}

/// Between which groups no frequency of the mesh lies.
fn gaps(omega: &[Vec<f64>], chern: &[BranchChern]) -> Vec<ChernGap> {
    let (mut sum, mut gaps) = (Some(0), Vec::new());
    for pair in chern.windows(2) {
        sum = sum.zip(pair[0].number).map(|(sum, number)| sum + number);
        let (Some(last), Some(first), Some(chern)) = (pair[0].branches.last(), pair[1].branches.first(), sum) else {
            continue;
        };
        let from = omega.iter().map(|row| row[*last]).fold(0.0, f64::max);
        let to = omega.iter().map(|row| row[*first]).fold(f64::INFINITY, f64::min);
        if to > from {
            gaps.push(ChernGap { from, to, below: *last, chern });
        }
    }
    gaps
}
