//! The fields at a point, and the balances there.
//!
//!   k = Σ K_i w_i,   ∂k/∂t = −div ΣK⊗v w + Σ(Ṗ J Ṗᵀ − V (S Pᵀ)ᵀ)w + Σ(N_ij + N_ji)W + div m + ΣN_ext w
//!   j = Σ m v w,     ∂j/∂t = −div Σm v⊗v w + div σ + Σ f_ext w
//!   m = Σ(N_ij⊗l I₁ − N_ji⊗l I₀),   σ = Σ f_ij⊗l W

use super::granules::Granules;
use super::weight::Weight;
use gyration::lattice::Lattice;
use gyration::tensor::{Mat3, Vec3};
use nalgebra::SMatrix;
use std::f64::consts::TAU;

/// A third-order tensor: a matrix for each value of its last index.
pub type Third = [Mat3; 3];

/// The fields at a point at a time.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LocalFields {
    /// ρ = Σ m w \[kg/m³\].
    pub density: f64,
    /// j = Σ m v w \[kg/(m² s)\].
    pub momentum: Vec3,
    /// k = Σ K w \[kg/(m s)\].
    pub affine_momentum: Mat3,
    /// Σ K⊗v w \[Pa m/s\].
    pub flux: Third,
    /// Σ Ṗ J Ṗᵀ w \[Pa\].
    pub kinetic: Mat3,
    /// Σ V (S Pᵀ)ᵀ w \[Pa\].
    pub micro_stress: Mat3,
    /// Σ (N_ij + N_ji) W \[Pa\].
    pub contact_stress: Mat3,
    /// m, the hyperstress; its last index is that of the divergence \[N/m\].
    pub hyperstress: Third,
    /// Σ N_ext w \[Pa\].
    pub external: Mat3,
    /// What ∂k/∂t must be \[Pa\].
    pub rate: Mat3,
    /// σ \[Pa\].
    pub stress: Mat3,
    /// What ∂j/∂t must be \[N/m³\].
    pub momentum_rate: Vec3,
    /// What is between two does to both, with W \[W/m³\].
    pub power: f64,
    /// The largest entry of `rate` less ∂k/∂t from the accelerations \[Pa\].
    pub residual: f64,
    /// The largest entry of `momentum_rate` less ∂j/∂t from the accelerations \[N/m³\].
    pub momentum_residual: f64,
    /// The largest entry of the terms of both balances, which their residuals are to be compared with.
    pub scales: [f64; 2],
}

impl LocalFields {
    /// |j|/ρ \[m/s\]; zero where nothing is.
    pub fn speed(&self) -> f64 {
        if self.density > 0.0 { self.momentum.norm() / self.density } else { 0.0 }
    }
}

impl Granules {
    /// The fields at a point \[m\].
    pub fn fields(&self, at: &Vec3, weight: &Weight) -> LocalFields {
        let images = Images::of(&self.periods);
        let mut fields = LocalFields::default();
        let mut affine = Sums::<3>::none();
        let mut linear = Sums::<1>::none();
        for grain in &self.grains {
            images.each(at, &grain.place, weight.reach(), |r| {
                let (own, v) = (&grain.balance, &grain.velocity);
                let (w, along) = (weight.at(r), weight.along(r, v));
                fields.density += own.mass * w;
                fields.momentum += own.mass * w * v;
                fields.affine_momentum += own.affine_momentum * w;
                add_last(&mut fields.flux, &own.affine_momentum, &(w * v));
                fields.kinetic += own.kinetic_tensor * w;
                fields.micro_stress += own.tension * w;
                fields.external += own.moment * w;
                linear.add(own.force * w);
                affine.add(-(own.affine_momentum * along));
                linear.add(-(own.mass * along * v));
                // ∂w/∂t = −v·∇w at a point that stays.
                affine.change += (own.kinetic_tensor + own.accelerated) * w - own.affine_momentum * along;
                linear.change += own.mass * (w * own.acceleration - along * v);
            });
        }
        for link in &self.links {
            let [first, second] = &link.moments;
            let middle = link.place + 0.5 * link.arm;
            images.each(at, &middle, weight.reach() + 0.5 * link.arm.norm(), |from_middle| {
                let Some(line) = weight.line(&(from_middle + 0.5 * link.arm), &link.arm) else { return };
                fields.contact_stress += (first + second) * line.whole;
                fields.stress += link.force * link.arm.transpose() * line.whole;
                fields.power += link.power * line.whole;
                add_last(&mut fields.hyperstress, &(first * line.first - second * line.second), &link.arm);
                affine.add(first * line.first_along - second * line.second_along);
                linear.add(link.force * line.whole_along);
            });
        }
        for term in [fields.kinetic, -fields.micro_stress, fields.contact_stress, fields.external] {
            affine.add(term);
        }
        fields.rate = affine.rate;
        fields.momentum_rate = linear.rate;
        fields.residual = (affine.rate - affine.change).amax();
        fields.momentum_residual = (linear.rate - linear.change).amax();
        fields.scales = [affine.scale, linear.scale];
        fields
    }
}

/// What follows itself without end.
struct Images<'a> {
    vectors: &'a [Vec3],
    reciprocal: Vec<Vec3>,
}

impl<'a> Images<'a> {
    fn of(periods: &'a Lattice) -> Self {
        Self { vectors: periods.vectors(), reciprocal: periods.reciprocal() }
    }

    /// Hands over where a point is as seen from each image of a place within a distance of it.
    fn each(&self, at: &Vec3, place: &Vec3, within: f64, mut each: impl FnMut(&Vec3)) {
        // Far from the bodies there are more periods than i32 counts.
        let mut bounds = [(0_i64, 0_i64); 3];
        for (bound, reciprocal) in bounds.iter_mut().zip(&self.reciprocal) {
            let (middle, wide) = (reciprocal.dot(&(at - place)) / TAU, within * reciprocal.norm() / TAU);
            *bound = ((middle - wide).ceil() as i64, (middle + wide).floor() as i64);
        }
        let whole = |axis: usize| bounds[axis].0..=bounds[axis].1;
        for z in whole(2) {
            for y in whole(1) {
                for x in whole(0) {
                    let image: Vec3 = self.vectors.iter().zip([x, y, z]).map(|(vector, n)| n as f64 * vector).sum();
                    let from = at - place - image;
                    if from.norm() <= within {
                        each(&from);
                    }
                }
            }
        }
    }
}

/// The terms of a balance, and the change that they must be.
struct Sums<const C: usize> {
    rate: SMatrix<f64, 3, C>,
    change: SMatrix<f64, 3, C>,
    scale: f64,
}

impl<const C: usize> Sums<C> {
    fn none() -> Self {
        Self { rate: SMatrix::zeros(), change: SMatrix::zeros(), scale: 0.0 }
    }

    fn add(&mut self, term: SMatrix<f64, 3, C>) {
        self.scale = self.scale.max(term.amax());
        self.rate += term;
    }
}

/// Adds A ⊗ v.
fn add_last(third: &mut Third, matrix: &Mat3, vector: &Vec3) {
    for (part, component) in third.iter_mut().zip(vector.iter()) {
        *part += matrix * *component;
    }
}
