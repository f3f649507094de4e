//! The continuum of a lattice: its matrices expanded about k = 0, and the models that keep a part of the series.
//!
//!   D(k) = Σ_R Φ_R e^{ik·R} = D₀ + i k_a D₁ᵃ − ½ k_a k_b D₂ᵃᵇ + …,   D₁ᵃ = Σ R_a Φ_R,   D₂ᵃᵇ = Σ R_a R_b Φ_R
//!
//! per volume Ω of the cell, in the coordinates (u, α) of `coordinates`: translation of everything; what granules do in
//! a cell that stays. `condensed` eliminates α, `moduli` has the tensors of elasticity, `reach` says where a model
//! ends. Source: Mindlin, *Micro-structure in linear elasticity*, 1964; Born, Huang, *Dynamical theory of crystal
//! lattices*, §26 … 29 (elimination, tensor of elasticity).

mod condensed;
mod coordinates;
mod moduli;
mod reach;
#[cfg(test)]
mod tests;

pub use moduli::Tensor;
pub use reach::{Reach, frequency_error};

use super::bloch::C64;
use super::eigenspaces::{hermitian, hermitian_eigen};
use super::waves::NEUTRAL;
use super::{LatticeWaves, NoBands};
use condensed::Condensed;
use coordinates::Motion;
use gyration::lattice::opposite;
use gyration::tensor::Vec3;
use moduli::RelaxedModuli;
use nalgebra::DMatrix;

/// A sum below this part of the sum of the sizes of its terms is their rounding.
const ROUNDING: f64 = 1e-13;

/// What of D(k) a model keeps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ContinuumModel {
    /// Of uu what goes with k², of uα what goes with k, D₀ of αα.
    First,
    /// As the first, of αα what goes with k²: the double stress.
    Mindlin,
    /// Moduli C_e between ∇u and a symmetric micro-distortion, and C_micro of it.
    Relaxed,
    /// That of Mindlin whose granules turn and do not deform.
    Cosserat,
    /// α eliminated, to k².
    Cauchy,
    /// α eliminated, to k⁴, with the inertia that follows.
    Gradient,
}

impl ContinuumModel {
    /// All of them.
    pub const ALL: [Self; 6] =
        [Self::First, Self::Mindlin, Self::Relaxed, Self::Cosserat, Self::Cauchy, Self::Gradient];

    /// The word by which it is asked for.
    pub fn name(self) -> &'static str {
        match self {
            Self::First => "first",
            Self::Mindlin => "mindlin",
            Self::Relaxed => "relaxed",
            Self::Cosserat => "cosserat",
            Self::Cauchy => "cauchy",
            Self::Gradient => "gradient",
        }
    }
}

/// A lattice as a continuum about its rest.
#[derive(Debug, Clone)]
pub struct Continuum {
    motions: Vec<Motion>,
    /// Ω [m³, m² or m].
    volume: f64,
    /// M per Ω.
    mass: DMatrix<f64>,
    zeroth: DMatrix<f64>,
    first: [DMatrix<f64>; 3],
    second: [[DMatrix<f64>; 3]; 3],
    condensed: Condensed,
    /// C_iajb.
    macroscopic: Tensor,
    /// How much its minor symmetry fails.
    asymmetry: f64,
    /// The largest |K| that there may be [1/s²].
    stiffest: f64,
    relaxed: RelaxedModuli,
}

/// Why a lattice is no continuum here.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NoContinuum {
    /// A body is held, or led.
    #[error(
        "\"{0}\" is pinned or kept to a line or a plane, so that it cannot follow a displacement of everything: leave \
         out `pin` and `keep`"
    )]
    Held(String),
    /// Joints join bodies.
    #[error("joints leave no coordinates of its own to each body: write stiff bonds or springs in their place")]
    Joints,
    /// The cell does not rest.
    #[error(
        "a continuum is made of cells at rest, and this one as it is written does not rest: accelerations of {0:.2e} \
         in units of the bodies' sizes are left; relax = [\"granules\"] seeks its rest"
    )]
    Unrest(f64),
    /// There is more than inertia and stiffness.
    #[error(
        "a continuum is made of lattices that lose nothing: leave out damping, friction, fluid, gyroscopic loads, \
         contractions that move, and forces without a potential, as contacts of bodies that deform have them unless \
         measure = \"deformed_area_potential\" (`gyration bands` has their waves)"
    )]
    Losses,
    /// The roots were not found.
    #[error(transparent)]
    Bands(#[from] NoBands),
}

impl LatticeWaves {
    /// The continuum of the lattice about its rest.
    ///
    /// # Errors
    /// [`NoContinuum`].
    pub fn continuum(&self, names: &[&str]) -> Result<Continuum, NoContinuum> {
        if let Some(left) = self.rest.unrest {
            return Err(NoContinuum::Unrest(left));
        }
        if !self.system.is_conservative || self.contracts() || !self.system.inertial.weightless.is_empty() {
            return Err(NoContinuum::Losses);
        }
        let bodies = self.frozen.bodies();
        if let Some(held) = bodies.iter().position(|body| body.pin.is_some() || body.guide.is_some()) {
            return Err(NoContinuum::Held(names[held].to_owned()));
        }
        let motions = coordinates::motions(self, names);
        let columns = coordinates::columns(self, &motions);
        if columns.nrows() != self.coordinates.counts()[0] || !columns.is_square() {
            return Err(NoContinuum::Joints);
        }
        let volume = self.lattice.volume();
        let carried = |matrix: &DMatrix<f64>| columns.tr_mul(&(matrix * &columns)) / volume;
        let size = motions.len();
        let mut cells = Vec::new();
        for (cell, place, stiffness) in self.system.stiffnesses() {
            let back = self.system.stiffnesses().find(|(other, ..)| *other == opposite(cell));
            // Equal to the transposed but for the rounding of the Jacobian.
            let transposed = back.map_or_else(|| DMatrix::zeros(size, size), |(.., back)| back.transpose());
            cells.push((place, carried(&(0.5 * (stiffness + transposed)))));
        }
        let sum = |factor: &dyn Fn(&Vec3) -> f64| {
            let (mut sum, mut sizes) = (DMatrix::zeros(size, size), DMatrix::<f64>::zeros(size, size));
            for (place, stiffness) in &cells {
                let term = stiffness * factor(place);
                sizes += term.abs();
                sum += term;
            }
            sum.zip_map(&sizes, |sum: f64, size| if sum.abs() <= ROUNDING * size { 0.0 } else { sum })
        };
        let zeroth = sum(&|_| 1.0);
        let first = [0, 1, 2].map(|a| sum(&|place| place[a]));
        let second = [0, 1, 2].map(|a| [0, 1, 2].map(|b| sum(&|place| place[a] * place[b])));
        let mass = columns.tr_mul(&columns) / volume;
        let mass = mass.map(|entry| if entry.abs() <= ROUNDING * mass.amax() { 0.0 } else { entry });
        let condensed = Condensed::new(&zeroth, &mass, &cells).ok_or(NoBands::Roots([0.0; 3]))?;
        let span = moduli::Span::of(&self.lattice);
        let waves = moduli::long_waves(&condensed, &first, &second);
        let macroscopic = moduli::of_waves(&waves, &span);
        let rotation = |spin: &Vec3| coordinates::rotation(self, &motions, spin);
        let series = moduli::Series { condensed: &condensed, first: &first, second: &second };
        let relaxed = RelaxedModuli::of(&series, &span, &waves, &macroscopic, &rotation);
        let asymmetry = moduli::asymmetry(&waves, &span);
        let stiffest = self.system.stiffest;
        Ok(Continuum {
            motions,
            volume,
            mass,
            zeroth,
            first,
            second,
            condensed,
            macroscopic,
            asymmetry,
            stiffest,
            relaxed,
        })
    }
}

impl Continuum {
    /// The names of its coordinates.
    pub fn coordinates(&self) -> impl Iterator<Item = &str> {
        self.motions.iter().map(|motion| &*motion.name)
    }

    /// Ω of the cell [m³; of a sheet m², of a chain m].
    pub fn volume(&self) -> f64 {
        self.volume
    }

    /// M per Ω.
    pub fn mass(&self) -> &DMatrix<f64> {
        &self.mass
    }

    /// D₀ per Ω.
    pub fn zeroth(&self) -> &DMatrix<f64> {
        &self.zeroth
    }

    /// D₁ᵃ per Ω.
    pub fn first(&self) -> &[DMatrix<f64>; 3] {
        &self.first
    }

    /// D₂ᵃᵇ per Ω.
    pub fn second(&self) -> &[[DMatrix<f64>; 3]; 3] {
        &self.second
    }

    /// C_iajb, α eliminated [Pa; of a sheet N/m, of a chain N].
    pub fn macroscopic(&self) -> &Tensor {
        &self.macroscopic
    }

    /// The largest of C_e and C [Pa; of a sheet N/m, of a chain N].
    pub fn stiffness(&self) -> f64 {
        moduli::largest(&self.held()).max(moduli::largest(&self.macroscopic))
    }

    /// The largest |C_iajb − C_jbia| in the space of the cell vectors, as a part of the largest modulus.
    pub fn asymmetry(&self) -> f64 {
        self.asymmetry
    }

    /// C_e, of strains that no α follows.
    pub fn held(&self) -> Tensor {
        self.relaxed.held()
    }

    /// C_micro, C_micro⁻¹ = C⁻¹ − C_e⁻¹; none where no α follows one of the strains.
    pub fn microscopic(&self) -> Option<Tensor> {
        self.relaxed.microscopic()
    }

    /// How many motions of α nothing holds.
    pub fn floppy(&self) -> usize {
        self.condensed.floppy()
    }

    /// The largest |D₀| of a displacement of everything, which supports and anchors alone oppose.
    pub fn foundation(&self) -> f64 {
        self.zeroth.view((0, 0), (3, 3)).amax()
    }

    /// The frequencies of a model at k, ascending [rad/s]: 0 of what decays or grows, and of what has no inertia.
    ///
    /// # Errors
    /// [`NoBands`] if the roots are not found.
    pub fn frequencies(&self, model: ContinuumModel, k: &Vec3) -> Result<Vec<f64>, NoBands> {
        Ok(self.squares(model, k)?.into_iter().map(|square| libm::sqrt(square.max(0.0))).collect())
    }

    /// ω² of a model at k, ascending [1/s²]; of rounding none is left.
    ///
    /// # Errors
    /// [`NoBands`] if the roots are not found.
    pub fn squares(&self, model: ContinuumModel, k: &Vec3) -> Result<Vec<f64>, NoBands> {
        let mut squares = ModelWaves::of(self.matrices(model, k)).ok_or(NoBands::Roots([0.0; 3]))?.squares;
        squares.extend(std::iter::repeat_n(0.0, self.loose(model)));
        squares.sort_by(f64::total_cmp);
        Ok(self.told(squares))
    }

    /// D and M of a model at k.
    fn matrices(&self, model: ContinuumModel, k: &Vec3) -> (DMatrix<C64>, DMatrix<C64>) {
        let real = |matrix: &DMatrix<f64>| matrix.map(|entry| C64::new(entry, 0.0));
        match model {
            ContinuumModel::First => (self.truncated(k, false), real(&self.mass)),
            ContinuumModel::Mindlin => (self.truncated(k, true), real(&self.mass)),
            ContinuumModel::Cosserat => {
                let turning = coordinates::turning(&self.motions);
                let mass = turning.tr_mul(&(&self.mass * &turning));
                let turning = real(&turning);
                (turning.tr_mul(&(self.truncated(k, true) * &turning)), real(&mass))
            }
            ContinuumModel::Cauchy => self.condensed.at(k, 2),
            ContinuumModel::Gradient => self.condensed.at(k, 4),
            ContinuumModel::Relaxed => self.relaxed.at(k),
        }
    }

    /// How many motions a model leaves out that nothing holds: no strain of the relaxed one, they stay where they are.
    fn loose(&self, model: ContinuumModel) -> usize {
        if model == ContinuumModel::Relaxed { self.floppy() } else { 0 }
    }

    /// ω² without those that are rounding.
    fn told(&self, squares: Vec<f64>) -> Vec<f64> {
        let largest = squares.iter().fold(self.stiffest, |most: f64, square| most.max(square.abs()));
        squares.into_iter().map(|square| if square.abs() <= NEUTRAL * largest { 0.0 } else { square }).collect()
    }

    /// D(k) to k² of uu, to k of uα, to 1 or k² of αα.
    fn truncated(&self, k: &Vec3, doubled: bool) -> DMatrix<C64> {
        let size = self.motions.len();
        DMatrix::from_fn(size, size, |i, j| {
            let kept = match (i < 3, j < 3) {
                (true, true) => 2,
                (false, false) if doubled => 2,
                (false, false) => 0,
                _ => 1,
            };
            let slope = |a: usize| k[a] * self.first[a][(i, j)];
            let curvature = |a: usize, b: usize| k[a] * k[b] * self.second[a][b][(i, j)];
            let once = if kept >= 1 { (0..3).map(slope).sum() } else { 0.0 };
            let axes = (0..3).flat_map(|a| (0..3).map(move |b| (a, b)));
            let twice: f64 = if kept >= 2 { axes.map(|(a, b)| curvature(a, b)).sum() } else { 0.0 };
            C64::new(self.zeroth[(i, j)] - 0.5 * twice, once)
        })
    }
}

/// The waves K x = ω² M x.
struct ModelWaves {
    squares: Vec<f64>,
    /// Lᴴx of each, M = L Lᴴ, column by column, of length one.
    vectors: DMatrix<C64>,
}

impl ModelWaves {
    /// Zeros where M is not positive, none if the iteration does not end.
    fn of((stiffness, mass): (DMatrix<C64>, DMatrix<C64>)) -> Option<Self> {
        let size = mass.nrows();
        let Some(factor) = hermitian(mass).cholesky() else {
            return Some(Self { squares: vec![0.0; size], vectors: DMatrix::identity(size, size) });
        };
        let lower = factor.l();
        let half = lower.solve_lower_triangular(&hermitian(stiffness))?;
        let within = lower.solve_lower_triangular(&half.adjoint())?;
        let found = hermitian_eigen(hermitian(within))?;
        Some(Self { squares: found.eigenvalues.iter().copied().collect(), vectors: found.eigenvectors })
    }
}
