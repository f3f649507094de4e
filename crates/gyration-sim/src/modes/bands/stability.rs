//! The wave against which a lattice is least stable: the least ω² over the zone.
//!
//! ω² are the eigenvalues of the Hermitian part of K(κ), whatever resists. A mesh tells where to begin, a search in
//! shrinking steps goes down from there. At κ = 0 translations of everything are left out; what long waves do instead
//! is told by ω²/k² (`sound`), of which the least over all directions is sought in the same way.

use super::eigenspaces::{hermitian, hermitian_eigen};
use super::{LatticeWaves, NoBands};
use gyration::tensor::Vec3;
use gyration_threads::Interruption;

/// ω² below zero by less than this part of the stiffest is rounding.
const ROUNDING: f64 = 1e-10;
/// ω² that differ by less than this part of the stiffest are the same.
const LEVEL: f64 = 1e-14;
/// The shortest step in κ.
const SHORTEST: f64 = 1e-8;
/// The length in κ by which the direction of long waves is told.
const SHORT: f64 = 1e-3;
/// Directions of long waves that are looked at first, in a plane and in space.
const DIRECTIONS: [usize; 2] = [36, 200];

/// The least ω² of a lattice.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LeastSquare {
    /// ω² [1/s²].
    pub square: f64,
    /// κ.
    pub kappa: [f64; 3],
    /// The branch, counted by ω².
    pub branch: usize,
}

/// The wave against which a lattice is unstable.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unstable {
    /// κ; of a macroscopic one that of a long wave in its direction.
    pub kappa: [f64; 3],
    /// The branch, counted by ω².
    pub branch: usize,
    /// Whether long waves grow: the lattice yields as a whole.
    pub macroscopic: bool,
}

/// How stable a lattice is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stability {
    /// The least ω², translations of everything aside.
    pub least: LeastSquare,
    /// What is unstable, if something is.
    pub unstable: Option<Unstable>,
}

/// Where a search over the zone begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ZoneMesh<'a> {
    /// Wave vectors along each periodic direction.
    pub count: usize,
    /// Which directions are periodic.
    pub periodic: &'a [bool],
}

impl<'a> ZoneMesh<'a> {
    /// So fine that a search finds the valleys of few springs.
    pub fn usual(periodic: &'a [bool]) -> Self {
        let count = if periodic.iter().filter(|periodic| **periodic).count() < 3 { 24 } else { 12 };
        Self { count, periodic }
    }

    fn axes(&self) -> Vec<usize> {
        (0..self.periodic.len()).filter(|a| self.periodic[*a]).collect()
    }
}

impl LatticeWaves {
    /// How stable the lattice is.
    ///
    /// # Errors
    /// [`NoBands`].
    pub fn stability(&self, zone: ZoneMesh<'_>) -> Result<Stability, NoBands> {
        let (axes, mesh) = (zone.axes(), zone.count.max(2));
        let least_at = |kappa: &[f64; 3]| Ok::<f64, NoBands>(self.least_at(kappa)?.square);
        let mut least = self.least_at(&[0.0; 3])?;
        for number in 1..mesh.pow(axes.len() as u32) {
            let mut kappa = [0.0; 3];
            axes.iter().enumerate().for_each(|(place, a)| {
                kappa[*a] = folded((number / mesh.pow(place as u32) % mesh) as f64 / mesh as f64);
            });
            let there = self.least_at(&kappa)?;
            if there.square < least.square {
                least = there;
            }
        }
        let step = 0.5 / mesh as f64;
        let level = |_| LEVEL * self.system.stiffest;
        let found = lowest(least.kappa, (&axes, step), level, least_at)?.map(folded);
        let there = self.least_at(&found)?;
        let is_long = found.iter().all(|part| part.abs() < step);
        // A stable lattice has its least ω² beside κ = 0, where it is trivial.
        let tolerance = ROUNDING * self.system.stiffest;
        if there.square < least.square && (!is_long || there.square < -tolerance) {
            least = there;
        }
        let size = self.lattice.vectors().iter().map(Vec3::norm).fold(0.0, f64::max);
        let (slowest, direction) = self.slowest(&axes)?;
        // Long waves count as if ω² went on like this to the edge of the zone: of all that yields at once they come
        // first.
        let edge = std::f64::consts::PI / size;
        let macroscopic = slowest * edge * edge < -tolerance;
        let unstable = if macroscopic {
            let most = direction.iter().fold(0.0, |most: f64, part| most.max(part.abs()));
            Some(Unstable { kappa: direction.map(|part| SHORT * part / most), branch: 0, macroscopic })
        } else {
            let LeastSquare { square, kappa, branch } = least;
            (square < -tolerance).then_some(Unstable { kappa, branch, macroscopic })
        };
        Ok(Stability { least, unstable })
    }

    /// The least ω² at κ, translations of everything aside.
    fn least_at(&self, kappa: &[f64; 3]) -> Result<LeastSquare, NoBands> {
        if Interruption::due().is_some() {
            return Err(NoBands::Interrupted);
        }
        let stiffness = hermitian(self.system.wave(kappa).stiffness);
        let eigen = hermitian_eigen(stiffness).ok_or(NoBands::Roots(*kappa))?;
        let mut order: Vec<usize> = (0..eigen.eigenvalues.len()).collect();
        order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
        let square = |branch: usize| eigen.eigenvalues[order[branch]];
        let rounding = ROUNDING * self.system.stiffest;
        let is_zero = |branch: &usize| square(*branch).abs() <= rounding;
        let zeros = (0..order.len()).filter(is_zero).count().min(self.translations());
        let trivial = if kappa == &[0.0; 3] { zeros } else { 0 };
        // What is unstable comes before the zeros.
        let branch = if square(0) < -rounding { 0 } else { trivial };
        match branch < order.len() {
            true => Ok(LeastSquare { square: square(branch), kappa: *kappa, branch }),
            false => Ok(LeastSquare { square: f64::INFINITY, kappa: *kappa, branch: 0 }),
        }
    }

    /// How many translations of everything there are.
    fn translations(&self) -> usize {
        self.coordinates.translations(&self.frozen).iter().filter(|column| column.norm() > 0.0).count()
    }

    /// The least ω²/k² of long waves over all directions [m²/s²], and its direction in κ.
    fn slowest(&self, axes: &[usize]) -> Result<(f64, [f64; 3]), NoBands> {
        let of = |direction: &[f64; 3]| {
            let along = self.wave_vector(direction).try_normalize(0.0);
            let Some(along) = along else { return Ok(f64::INFINITY) };
            Ok::<f64, NoBands>(self.long_waves(&along)?.first().copied().unwrap_or(f64::INFINITY))
        };
        let directions: Vec<[f64; 3]> = match *axes {
            [] => Vec::new(),
            [a] => vec![unit(&[(a, 1.0)])],
            [a, b] => (0..DIRECTIONS[0])
                .map(|k| libm::sincos(std::f64::consts::PI * k as f64 / DIRECTIONS[0] as f64))
                .map(|(sine, cosine)| unit(&[(a, cosine), (b, sine)]))
                .collect(),
            _ => (0..DIRECTIONS[1]).map(spread).collect(),
        };
        let mut slowest = (f64::INFINITY, [0.0; 3]);
        for direction in directions {
            let there = of(&direction)?;
            if there < slowest.0 {
                slowest = (there, direction);
            }
        }
        if axes.len() > 1 && slowest.0.is_finite() {
            let level = |here: f64| LEVEL * here.abs();
            let found = lowest(slowest.1, (axes, 0.05), level, of)?;
            slowest = (of(&found)?, found);
        }
        Ok(slowest)
    }
}

/// Half a sphere evenly: a spiral whose turns are the golden section apart.
fn spread(k: usize) -> [f64; 3] {
    let height = (k as f64 + 0.5) / DIRECTIONS[1] as f64;
    let radius = libm::sqrt(1.0 - height * height);
    let (sine, cosine) = libm::sincos(std::f64::consts::PI * (3.0 - libm::sqrt(5.0)) * k as f64);
    [radius * cosine, radius * sine, height]
}

fn unit(parts: &[(usize, f64)]) -> [f64; 3] {
    let mut direction = [0.0; 3];
    parts.iter().for_each(|(a, part)| direction[*a] = *part);
    direction
}

/// κ in the first zone, −½ < κ ≤ ½.
fn folded(kappa: f64) -> f64 {
    let within = kappa - kappa.round();
    // Zero has no sign.
    if within <= -0.5 { within + 1.0 } else { within + 0.0 }
}

/// Goes down in steps along the axes, and on along what these add up to for as long as that falls: valleys may run
/// across the axes. Steps are halved where no neighbour is lower; what falls by less than `level` is as high.
///
/// Source: R. Hooke, T. A. Jeeves, *"Direct search" solution of numerical and statistical problems*, J. ACM 8 (1961).
fn lowest(
    from: [f64; 3],
    (axes, first): (&[usize], f64),
    level: impl Fn(f64) -> f64,
    of: impl Fn(&[f64; 3]) -> Result<f64, NoBands>,
) -> Result<[f64; 3], NoBands> {
    let explore = |from: [f64; 3], step: f64| {
        let (mut here, mut at) = (of(&from)?, from);
        for axis in axes {
            for side in [-step, step] {
                let mut beside = at;
                beside[*axis] += side;
                let there = of(&beside)?;
                if there < here - level(here) {
                    (here, at) = (there, beside);
                    break;
                }
            }
        }
        Ok::<_, NoBands>((here, at))
    };
    let (mut at, mut step) = (from, first);
    while step > SHORTEST {
        let (mut lower, mut ahead) = explore(at, step)?;
        if ahead == at {
            step *= 0.5;
            continue;
        }
        loop {
            let beyond = std::array::from_fn(|a| 2.0 * ahead[a] - at[a]);
            at = ahead;
            let (there, found) = explore(beyond, step)?;
            if there >= lower - level(lower) {
                break;
            }
            (lower, ahead) = (there, found);
        }
    }
    Ok(at)
}
