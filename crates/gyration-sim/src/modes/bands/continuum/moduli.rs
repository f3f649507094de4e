//! The tensors of elasticity of a lattice, from how it carries long waves.
//!
//!   B_ijab = −½ D₂ᵃᵇ_ij − ½ (D₁ᵃ D₀⁻¹ D₁ᵇᵀ + D₁ᵇ D₀⁻¹ D₁ᵃᵀ)_ij,   C_iajb = B_ijab + B_ajib − B_bjia
//!
//! Waves tell ½ (C_iajb + C_ibja) = B_ijab; C is the one solution with C_iajb = C_aijb = C_jbia where the rest is free
//! of stress (Born, Huang). It is taken in the space that the cell vectors span; of displacements out of it C = B.
//!
//! Strains ε that no α follows meet C_e. With A = W, u = W R nothing is done, so that the resistance to rotations alone
//! is D₁ α_W, which is taken out before. Where α follows, its stress is L α,
//!
//!   ½ ε·C_e ε − ε·L α + ½ α·D₀ α = ½ (ε − π)·C_e (ε − π) + ½ π·C_micro π,   C_e π = L α,
//!
//! once α has its least energy at given π: α = D₀⁻¹ Lᵀ X⁻¹ C_e π, X = L D₀⁻¹ Lᵀ = C_e − C, C_micro⁻¹ = C⁻¹ − C_e⁻¹.
//! Under a stress C_iajb and C_jbia differ, and so the long waves of this continuum from those of the lattice: it has
//! the energy of the half of both.

use super::super::bloch::C64;
use super::condensed::Condensed;
use gyration::lattice::Lattice;
use gyration::tensor::{Mat3, Vec3};
use nalgebra::{DMatrix, DVector};

/// C_iajb, by i, a, j, b.
pub type Tensor = [[[[f64; 3]; 3]; 3]; 3];

/// A part of a modulus below this is its rounding.
const ROUNDING: f64 = 1e-12;
/// Strains of which C is nearer to C_e than this are not followed by any α.
const FOLLOWED: f64 = 1e-9;

/// The space that the cell vectors span.
pub(super) struct Span {
    projector: Mat3,
    /// Unit tensors of the symmetric ones in it.
    strains: Vec<Mat3>,
    /// Axes of the rotations in it, of length one.
    spins: Vec<Vec3>,
}

impl Span {
    pub fn of(lattice: &Lattice) -> Self {
        let projector = lattice.projector();
        // Orthonormal vectors, the first along the first of the lattice.
        let mut axes: Vec<Vec3> = Vec::new();
        for vector in lattice.vectors() {
            let across = axes.iter().fold(*vector, |rest, axis| rest - axis.dot(&rest) * axis);
            axes.push(across.normalize());
        }
        let pairs = || (0..axes.len()).flat_map(|i| (0..i).map(move |j| (j, i)));
        let product = |i: usize, j: usize| axes[i] * axes[j].transpose();
        let shear = |(i, j): (usize, usize)| (product(i, j) + product(j, i)) * std::f64::consts::FRAC_1_SQRT_2;
        let strains = (0..axes.len()).map(|i| product(i, i)).chain(pairs().map(shear)).collect();
        let spins = pairs().map(|(i, j)| axes[i].cross(&axes[j])).collect();
        Self { projector, strains, spins }
    }
}

/// A tensor from its entries.
pub(super) fn tensor(entry: impl Fn(usize, usize, usize, usize) -> f64) -> Tensor {
    let axes = [0, 1, 2];
    axes.map(|i| axes.map(|a| axes.map(|j| axes.map(|b| entry(i, a, j, b)))))
}

/// B_ijab by i, a, j, b.
pub(super) fn long_waves(condensed: &Condensed, first: &[DMatrix<f64>; 3], second: &[[DMatrix<f64>; 3]; 3]) -> Tensor {
    let couplings = [0, 1, 2].map(|a| condensed.coupling(&first[a]));
    let eased = couplings
        .each_ref()
        .map(|coupling| DMatrix::from_fn(3, coupling.ncols(), |i, s| coupling[(i, s)] / condensed.squares()[s]));
    let followed = [0, 1, 2].map(|a| [0, 1, 2].map(|b| &eased[a] * couplings[b].transpose()));
    tensor(|i, a, j, b| -0.5 * second[a][b][(i, j)] - 0.5 * (followed[a][b][(i, j)] + followed[b][a][(i, j)]))
}

/// C_iajb of B_ijab.
pub(super) fn of_waves(waves: &Tensor, span: &Span) -> Tensor {
    let inside = within(waves, span);
    let part = |i: usize, j: usize, a: usize, b: usize| inside[i][a][j][b];
    let largest = largest(waves);
    tensor(|i, a, j, b| {
        let modulus = part(i, j, a, b) + part(a, j, i, b) - part(b, j, i, a) + (waves[i][a][j][b] - inside[i][a][j][b]);
        if modulus.abs() <= ROUNDING * largest { 0.0 } else { modulus }
    })
}

/// The largest |C_iajb − C_jbia| in the span as a part of the largest modulus: what a stress leaves. C_iajb = C_aijb
/// holds by the formula.
pub(super) fn asymmetry(waves: &Tensor, span: &Span) -> f64 {
    let inside = of_waves(&within(waves, span), span);
    let uneven = tensor(|i, a, j, b| inside[i][a][j][b] - inside[j][b][i][a]);
    let most = largest(&inside);
    if most > 0.0 { largest(&uneven) / most } else { 0.0 }
}

/// The part of B of displacements in the span.
fn within(waves: &Tensor, span: &Span) -> Tensor {
    let p = &span.projector;
    let pairs = || (0..3).flat_map(|k| (0..3).map(move |l| (k, l)));
    tensor(|i, a, j, b| pairs().map(|(k, l)| p[(i, k)] * p[(j, l)] * waves[k][a][l][b]).sum())
}

/// The largest entry.
pub(super) fn largest(tensor: &Tensor) -> f64 {
    tensor.as_flattened().as_flattened().as_flattened().iter().fold(0.0, |most: f64, entry| most.max(entry.abs()))
}

/// What of the series of D the moduli are made of.
pub(super) struct Series<'a> {
    pub condensed: &'a Condensed,
    pub first: &'a [DMatrix<f64>; 3],
    pub second: &'a [[DMatrix<f64>; 3]; 3],
}

/// The relaxed micromorphic continuum: u and π, strains that α can follow.
#[derive(Debug, Clone)]
pub(super) struct RelaxedModuli {
    /// Unit tensors of the strains.
    strains: Vec<Mat3>,
    /// C_e along them.
    held: DMatrix<f64>,
    /// The strains π, column by column along the others, of which π·C_e π is one.
    followed: DMatrix<f64>,
    /// C of each of these.
    parts: Vec<f64>,
    /// Their inertia.
    inertia: DMatrix<f64>,
    /// The density [kg/m³; of a sheet kg/m², of a chain kg/m].
    density: DMatrix<f64>,
    /// B of displacements out of the span.
    outside: Tensor,
}

impl RelaxedModuli {
    /// From the series of D, B, C and the coordinates in a rotation about an axis.
    pub fn of(
        series: &Series,
        span: &Span,
        waves: &Tensor,
        macroscopic: &Tensor,
        rotation: &impl Fn(&Vec3) -> DVector<f64>,
    ) -> Self {
        let Series { condensed, first, second } = *series;
        // Under a stress C_iajb and C_jbia differ: an energy has the half of both.
        let along = |tensor: &Tensor| {
            let along = along_strains(tensor, &span.strains);
            0.5 * (&along + along.transpose())
        };
        let held = along(&of_waves(&held_waves(first, second, span, rotation), span));
        let within = along(macroscopic);
        // C y = λ C_e y.
        let eigen = held.clone().symmetric_eigen();
        let most = eigen.eigenvalues.amax();
        let stiff: Vec<usize> = (0..held.nrows()).filter(|k| eigen.eigenvalues[*k] > ROUNDING * most).collect();
        let mut root = eigen.eigenvectors.select_columns(&stiff);
        for (mut column, k) in root.column_iter_mut().zip(&stiff) {
            column /= libm::sqrt(eigen.eigenvalues[*k]);
        }
        let pencil = (root.tr_mul(&(&within * &root))).symmetric_eigen();
        let is_followed = |k: &usize| pencil.eigenvalues[*k] < 1.0 - FOLLOWED;
        let chosen: Vec<usize> = (0..stiff.len()).filter(is_followed).collect();
        let followed = &root * pencil.eigenvectors.select_columns(&chosen);
        let rounded = |part: f64| if part.abs() <= FOLLOWED { 0.0 } else { part };
        let parts: Vec<f64> = chosen.iter().map(|k| rounded(pencil.eigenvalues[*k])).collect();
        // D₀⁻¹ Lᵀ X⁻¹ C_e π.
        let couplings = [0, 1, 2].map(|a| condensed.coupling(&first[a]));
        let stresses = DMatrix::from_fn(span.strains.len(), condensed.squares().len(), |e, s| {
            let axes = (0..3).flat_map(|i| (0..3).map(move |a| (i, a)));
            axes.map(|(i, a)| span.strains[e][(i, a)] * couplings[a][(i, s)]).sum::<f64>()
        });
        let mut moved = stresses.tr_mul(&followed);
        for (s, square) in condensed.squares().iter().enumerate() {
            moved.row_mut(s).iter_mut().zip(&parts).for_each(|(entry, part)| *entry /= square * (1.0 - part));
        }
        let inertia = moved.tr_mul(&moved);
        let inside = self::within(waves, span);
        let outside = tensor(|i, a, j, b| waves[i][a][j][b] - inside[i][a][j][b]);
        let density = condensed.density();
        Self { strains: span.strains.clone(), held, followed, parts, inertia, density, outside }
    }

    /// C_e.
    pub fn held(&self) -> Tensor {
        self.tensor(&self.held)
    }

    /// C_micro; none where no α follows one of the strains.
    pub fn microscopic(&self) -> Option<Tensor> {
        if self.parts.len() < self.strains.len() {
            return None;
        }
        let weighed = &self.held * &self.followed;
        let diagonal = DVector::from_iterator(self.parts.len(), self.parts.iter().map(|part| part / (1.0 - part)));
        Some(self.tensor(&(&weighed * DMatrix::from_diagonal(&diagonal) * weighed.transpose())))
    }

    fn tensor(&self, along: &DMatrix<f64>) -> Tensor {
        let pairs = || (0..along.nrows()).flat_map(|e| (0..along.ncols()).map(move |f| (e, f)));
        let strains = &self.strains;
        tensor(|i, a, j, b| pairs().map(|(e, f)| along[(e, f)] * strains[e][(i, a)] * strains[f][(j, b)]).sum::<f64>())
    }

    /// D and M of (u, π) at k.
    pub fn at(&self, k: &Vec3) -> (DMatrix<C64>, DMatrix<C64>) {
        // ε of u without its factor i, along the strains.
        let strain = DMatrix::from_fn(self.strains.len(), 3, |e, j| (self.strains[e] * k)[j]);
        let own = strain.tr_mul(&(&self.held * &strain));
        let across = strain.tr_mul(&(&self.held * &self.followed));
        let size = 3 + self.parts.len();
        let stiffness = DMatrix::from_fn(size, size, |i, j| match (i < 3, j < 3) {
            (true, true) => {
                let axes = (0..3).flat_map(|a| (0..3).map(move |b| (a, b)));
                let outside: f64 = axes.map(|(a, b)| k[a] * k[b] * self.outside[i][a][j][b]).sum();
                C64::new(own[(i, j)] + outside, 0.0)
            }
            // −(i ε)ᴴ C_e π.
            (true, false) => C64::new(0.0, across[(i, j - 3)]),
            (false, true) => C64::new(0.0, -across[(j, i - 3)]),
            (false, false) => C64::new(if i == j { 1.0 / (1.0 - self.parts[i - 3]) } else { 0.0 }, 0.0),
        });
        let mut mass = DMatrix::zeros(size, size);
        mass.view_mut((0, 0), (3, 3)).copy_from(&self.density.map(|entry| C64::new(entry, 0.0)));
        let inertia = self.inertia.map(|entry| C64::new(entry, 0.0));
        mass.view_mut((3, 3), inertia.shape()).copy_from(&inertia);
        (stiffness, mass)
    }
}

/// A tensor along unit tensors of strains.
fn along_strains(tensor: &Tensor, strains: &[Mat3]) -> DMatrix<f64> {
    let axes = || (0..3).flat_map(|i| (0..3).map(move |a| (i, a)));
    DMatrix::from_fn(strains.len(), strains.len(), |e, f| {
        let term = |(i, a): (usize, usize)| {
            let row = |(j, b): (usize, usize)| tensor[i][a][j][b] * strains[f][(j, b)];
            strains[e][(i, a)] * axes().map(row).sum::<f64>()
        };
        axes().map(term).sum::<f64>()
    })
}

/// A tensor along unit tensors of all strains.
#[cfg(test)]
pub(super) fn along_all_strains(tensor: &Tensor) -> DMatrix<f64> {
    let space = Lattice::new(vec![Vec3::x(), Vec3::y(), Vec3::z()]).unwrap_or_default();
    along_strains(tensor, &Span::of(&space).strains)
}

/// B of strains at α held: −½ D₂, without the resistance to rotations.
fn held_waves(
    first: &[DMatrix<f64>; 3],
    second: &[[DMatrix<f64>; 3]; 3],
    span: &Span,
    rotation: &impl Fn(&Vec3) -> DVector<f64>,
) -> Tensor {
    // What a rotation W meets, along (i, a), and W itself, both of W of length one.
    let met = |spin: &Vec3| {
        let turned = gyration::tensor::cross_matrix(spin) * std::f64::consts::FRAC_1_SQRT_2;
        let alpha = rotation(&(*spin * std::f64::consts::FRAC_1_SQRT_2));
        let stress = Mat3::from_fn(|i, a| (first[a].row(i) * &alpha)[0]);
        (turned, span.projector * stress)
    };
    let met: Vec<(Mat3, Mat3)> = span.spins.iter().map(met).collect();
    let resistance = tensor(|i, a, j, b| {
        let one = met.iter().map(|(turned, stress)| stress[(i, a)] * turned[(j, b)] + turned[(i, a)] * stress[(j, b)]);
        let both = met.iter().flat_map(|(turned, _)| {
            met.iter().map(move |(other, stress)| turned.dot(stress) * turned[(i, a)] * other[(j, b)])
        });
        one.sum::<f64>() - both.sum::<f64>()
    });
    tensor(|i, a, j, b| -0.5 * second[a][b][(i, j)] - 0.5 * (resistance[i][a][j][b] + resistance[i][b][j][a]))
}
