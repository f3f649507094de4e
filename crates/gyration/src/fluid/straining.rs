//! The history of the strain and the growth of a sphere in a fluid with inertia, as a symmetric moment and state.
//!
//!   C = −5ηV Σ C_k (D − Z_k) + a_E dev sym L̇∞ + m_f R² (⅕ sym A + ⅒ tr(A) I),     A = L̇∞ + L∞²
//!   Z_k′ = S_k (D − Z_k),   D = dev sym (L − L∞),   a_E = m_f R² 2/15 + 5ηV rest
//!
//! beside the steady moment. C_k, S_k and `rest` are those of the rotation; Z_k are in the axes of space. The last term
//! is what the pressure of the undisturbed flow does, zero at the centre. The sphere's own acceleration meets a_E, and
//! m_f R² where it grows: they stand on the left of the balance. Source: `docs/fluid-memory.md`.

use super::unsteady::Exponentials;
use crate::affine::AddedInertia;
use crate::extended::{Extended, ExtendedVec3, Numbers};
use crate::tensor::{Mat3, Vec3};
use std::f64::consts::PI;

/// How many numbers a mode has: Z_xx, Z_yy, Z_zz, then Z_yz, Z_zx, Z_xy.
pub(crate) const STRAIN_NUMBERS: usize = 6;

/// What a sphere brings for the history of its strain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrainHistory {
    /// 5ηV \[N m s\].
    drag: f64,
    /// m_f R² \[kg m²\].
    displaced: f64,
    /// What the accelerations of a sphere that deforms meet.
    pub added: AddedInertia,
}

/// The moment of that history at one instant, without the part that is proportional to the acceleration of the sphere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrainLoads {
    /// C \[N m\].
    pub couple: Mat3,
    /// ∂C/∂D, a multiple of one \[N m s\].
    pub by_strain: f64,
    /// D: the diagonal, then the other entries.
    slip: [ExtendedVec3; 2],
}

impl StrainHistory {
    /// Of a sphere of a radius \[m\] in a fluid of viscosity \[Pa s\] and density \[kg/m³\], with the history of its
    /// rotation and I_a \[kg m²\].
    pub(super) fn of_sphere(
        radius: f64,
        [viscosity, density]: [f64; 2],
        rotation: &Exponentials,
        added_inertia: f64,
    ) -> Self {
        let volume = 4.0 / 3.0 * PI * radius.powi(3);
        let (drag, displaced) = (5.0 * viscosity * volume, density * volume * radius * radius);
        let strain = 2.0 / 15.0 * displaced + drag * rotation.rest;
        Self { drag, displaced, added: AddedInertia { spin: 0.5 * added_inertia, strain, growth: displaced } }
    }

    /// The moment, of a sphere with the gradient L in a flow of L∞ and its rate; `modes` are Z_k.
    pub(super) fn loads(
        &self,
        rotation: &Exponentials,
        [flow, spreading]: [&Mat3; 2],
        gradient: &Mat3,
        modes: (Numbers, usize),
    ) -> StrainLoads {
        let slip =
            strain_numbers(&deviator(&(gradient - flow))).map(|triple| [0, 1, 2].map(|i| Extended::from(triple[i])));
        let weights = rotation.weights.iter();
        let behind = |part: usize| -> Vec3 {
            let (numbers, from) = modes;
            let each = weights.clone().enumerate();
            each.map(|(mode, weight)| *weight * numbers.behind(&slip[part], from + STRAIN_NUMBERS * mode + 3 * part))
                .sum()
        };
        let accelerating = spreading + flow * flow;
        let pressed = 0.2 * symmetric(&accelerating) + Mat3::from_diagonal_element(0.1 * accelerating.trace());
        let trailing = self.drag * strain_of(&[behind(0), behind(1)]);
        let couple = self.displaced * pressed + self.added.strain * deviator(spreading) - trailing;
        StrainLoads { couple, by_strain: -self.drag * weights.sum::<f64>(), slip }
    }

    /// What a mode does to C along each of its numbers, per unit of it, and its rate: 5ηV C_k and S_k.
    pub(crate) fn modes<'a>(&self, rotation: &'a Exponentials) -> impl Iterator<Item = (f64, f64)> + use<'a> {
        let drag = self.drag;
        rotation.weights.iter().zip(&rotation.rates).map(move |(weight, rate)| (drag * weight, *rate))
    }
}

impl StrainLoads {
    /// The rates of the modes, which begin at a place.
    pub(super) fn rates(&self, rotation: &Exponentials, (modes, from): (Numbers, usize), rates: &mut [f64]) {
        for ((mode, rate), out) in rotation.rates.iter().enumerate().zip(rates.chunks_exact_mut(STRAIN_NUMBERS)) {
            for (part, out) in out.chunks_exact_mut(3).enumerate() {
                out.copy_from_slice(
                    (*rate * modes.behind(&self.slip[part], from + STRAIN_NUMBERS * mode + 3 * part)).as_slice(),
                );
            }
        }
    }
}

fn symmetric(tensor: &Mat3) -> Mat3 {
    0.5 * (tensor + tensor.transpose())
}

/// dev sym X.
pub(crate) fn deviator(tensor: &Mat3) -> Mat3 {
    symmetric(tensor) - Mat3::from_diagonal_element(tensor.trace() / 3.0)
}

/// The numbers of a symmetric tensor: the diagonal, then yz, zx, xy.
pub(crate) fn strain_numbers(tensor: &Mat3) -> [Vec3; 2] {
    [tensor.diagonal(), Vec3::new(tensor[(1, 2)], tensor[(2, 0)], tensor[(0, 1)])]
}

/// The symmetric tensor of these numbers.
pub(crate) fn strain_of([diagonal, across]: &[Vec3; 2]) -> Mat3 {
    Mat3::new(diagonal.x, across.z, across.y, across.z, diagonal.y, across.x, across.y, across.x, diagonal.z)
}

#[cfg(test)]
mod tests {
    use super::super::History;
    use super::super::unsteady::vibration::vibration;
    use super::*;
    use nalgebra::Complex;

    #[test]
    fn strain_and_growth_meet_the_resistance_to_vibrations() {
        let (radius, fluid, span) = (0.3, [0.8, 40.0], 20.0);
        let history = History::of_straining_sphere(radius, fluid, span, 1e-8).unwrap();
        let strain = history.strain.unwrap();
        let volume = 4.0 / 3.0 * PI * radius.powi(3);
        for omega in [0.5, 3.0, 40.0] {
            let frequency = Complex::new(0.0, omega);
            let pairs = strain.modes(&history.rotation);
            let trailing: Complex<f64> = pairs.map(|(drag, rate)| frequency / (frequency + rate) * drag).sum();
            let found = trailing + frequency * strain.added.strain + 3.0 * fluid[0] * volume;
            let growing = frequency * strain.added.growth + 4.0 * fluid[0] * volume;
            let exact = vibration(radius, fluid[0], fluid[1], omega);
            let errors = [(found, exact.strain), (growing, exact.expansion)].map(|(a, b)| (a - b).norm() / b.norm());
            println!("ω = {omega} 1/s: {errors:?}");
            // The error of the kernel, a part of which is that of its transform.
            assert!(errors.iter().all(|error| *error < 1e-7), "{errors:?}");
        }
    }

    #[test]
    fn a_symmetric_tensor_is_its_numbers() {
        let tensor = Mat3::new(1.0, 2.0, 3.0, 2.0, -4.0, 5.0, 3.0, 5.0, 6.0);
        assert_eq!(strain_of(&strain_numbers(&tensor)), tensor);
        assert!(deviator(&tensor).trace().abs() < 1e-15);
    }
}
