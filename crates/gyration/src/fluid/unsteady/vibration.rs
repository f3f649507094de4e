//! Resistance of a sphere to small monochromatic vibrations against the fluid.
//!
//! Every velocity is ∝ e^(iωt). With ℓ = R√(iωρ/η), Re ℓ ≥ 0, the fluid obeys η(∇² − ℓ²/R²)u = ∇q, div u = 0, and on
//! the sphere u = U + Lx. The load is f = ∫ t dA, N_ij = ∫ t_i x_j dA, with power f·U + N·L; V = 4πR³/3:
//!
//!   translation   f = −6πηR (1 + ℓ + ℓ²/9) U
//!   rotation      ∫ x × t dA = −8πηR³ (1 + ⅓ ℓ²/(1 + ℓ)) Ω
//!   strain        N = −3ηV (1 + (2/45) ℓ² + (5/9) ℓ²/(1 + ℓ)) E           E symmetric, tr E = 0
//!   expansion     N = −4ηV (1 + ℓ²/4) e I                                u = e x on the sphere
//!
//! On skw L the moment is N = −½ (8πηR³)(…) skw L: without inertia spin and strain meet the same 3ηV.
//!
//! *Derivation of the strain.* With H = 1/r and G = e^(−αr)/r, α = ℓ/R,
//!
//!   u = a ∇(E·∇∇H) + b [∇(E·∇∇G) − α² E∇G],     q = −ηα² a E·∇∇H
//!   b = (5/3) R⁵ e^ℓ/(ℓ²(1 + ℓ)),     a = −(R⁵/9)(15 + 15ℓ + 6ℓ² + ℓ³)/(ℓ²(1 + ℓ))
//!
//! makes u = Ex at r = R, and t = −qn + η(∇u + ∇uᵀ)n gives N. An expansion is the potential flow u = e R³x/r³, q = iωρ
//! e R³/r.
//!
//! As ω → ∞ the terms in ℓ² are the added masses of potential flow: ½ρV on U, (2/15)ρVR² on E, ρVR² on e I. What
//! remains, ℓ²/(1 + ℓ), is one history for spin and strain: `HistoryKernel::Rotation`, times 5/3 for the strain.
//! Translation and rotation are in Landau and Lifshitz, *Fluid Mechanics*, §24. Amplitudes must be small against R.

use nalgebra::Complex;
use std::f64::consts::PI;

/// Complex resistances of a sphere at one frequency: load = −resistance × velocity.
///
/// The real part dissipates; the imaginary part over ω is the added mass at this frequency.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vibration {
    /// Of the velocity: f = −translation U [N s/m].
    pub translation: Complex<f64>,
    /// Of the angular velocity: torque = −rotation Ω [N m s]; N = −½ rotation skw L.
    pub rotation: Complex<f64>,
    /// Of a strain rate, symmetric and traceless: N = −strain E [Pa s m³].
    pub strain: Complex<f64>,
    /// Of an expansion: N = −expansion e I at u = e x [Pa s m³].
    pub expansion: Complex<f64>,
}

/// The resistances of a sphere of `radius` [m] to e^(iωt) in a fluid of `viscosity` [Pa s] and `density` [kg/m³], at ω
/// = `omega` [rad/s].
///
/// Formulae in the module. At ω = 0, or without density, these are the values of Stokes: 6πηR, 8πηR³, 3ηV, 4ηV. The
/// domain is radius > 0, viscosity > 0, density ≥ 0, ω ≥ 0: outside, the result is not a number or means nothing.
pub fn vibration(radius: f64, viscosity: f64, density: f64, omega: f64) -> Vibration {
    // ℓ² = iωτ; of √i = (1 + i)/√2 the real part is positive.
    let square = omega * density * radius * radius / viscosity;
    let thickness = (0.5 * square).sqrt();
    let (ell, square) = (Complex::new(thickness, thickness), Complex::new(0.0, square));
    let history = square / (ell + 1.0);
    let volume = 4.0 / 3.0 * PI * radius.powi(3);
    Vibration {
        translation: (square / 9.0 + ell + 1.0) * (6.0 * PI * viscosity * radius),
        rotation: (history / 3.0 + 1.0) * (8.0 * PI * viscosity * radius.powi(3)),
        strain: (square * (2.0 / 45.0) + history * (5.0 / 9.0) + 1.0) * (3.0 * viscosity * volume),
        expansion: (square / 4.0 + 1.0) * (4.0 * viscosity * volume),
    }
}

impl Vibration {
    /// The stresslet's resistance to a strain rate: the moment of the tractions less that of the shape's own motion, S
    /// = N − η∫(u⊗n + n⊗u)dA = −(strain + 2ηV) E; at ω = 0 the 5ηV of a rigid sphere held in a strain.
    pub fn stresslet(&self, radius: f64, viscosity: f64) -> Complex<f64> {
        self.strain + 8.0 / 3.0 * PI * viscosity * radius.powi(3)
    }
}

#[cfg(test)]
mod fields;

#[cfg(test)]
mod tests {
    use super::super::kernel::HistoryKernel;
    use super::*;

    fn close(measured: Complex<f64>, expected: Complex<f64>, tolerance: f64) -> bool {
        (measured - expected).norm() <= tolerance * expected.norm()
    }

    #[test]
    fn slow_vibrations_meet_the_resistance_of_stokes() {
        let (radius, viscosity) = (0.3_f64, 2.0);
        let volume = 4.0 / 3.0 * PI * radius.powi(3);
        for (density, omega, tolerance) in [(0.0, 5.0, 1e-15), (1000.0, 0.0, 1e-15), (1000.0, 1e-10, 1e-4)] {
            let slow = vibration(radius, viscosity, density, omega);
            let real = |value: f64| Complex::new(value, 0.0);
            assert!(close(slow.translation, real(6.0 * PI * viscosity * radius), tolerance));
            assert!(close(slow.rotation, real(8.0 * PI * viscosity * radius.powi(3)), tolerance));
            assert!(close(slow.strain, real(3.0 * viscosity * volume), tolerance));
            assert!(close(slow.expansion, real(4.0 * viscosity * volume), tolerance));
            assert!(close(slow.stresslet(radius, viscosity), real(5.0 * viscosity * volume), tolerance));
        }
    }

    #[test]
    fn fast_vibrations_meet_the_added_masses_of_potential_flow() {
        let (radius, viscosity, density, omega) = (0.3_f64, 1e-3, 1000.0, 1e12);
        let mass = 4.0 / 3.0 * PI * radius.powi(3) * density;
        let fast = vibration(radius, viscosity, density, omega);
        // The next term is of relative size 9/ℓ, ℓ ~ 3e8.
        let inertia = |value: f64| Complex::new(0.0, omega * value);
        assert!(close(fast.translation, inertia(mass / 2.0), 1e-7));
        assert!(close(fast.strain, inertia(mass * radius * radius * 2.0 / 15.0), 1e-7));
        assert!(close(fast.expansion, inertia(mass * radius * radius), 1e-7));
        // A turning sphere moves a layer only: 8πηR³ℓ/3.
        assert!(close(fast.rotation, Complex::new(1.0, 1.0) * (fast.rotation.norm() / 2f64.sqrt()), 1e-7));
    }

    #[test]
    fn every_mode_dissipates_at_every_frequency() {
        for omega in [1e-6, 0.1, 1.0, 30.0, 1e7] {
            let at = vibration(1.0, 1.0, 1.0, omega);
            for resistance in [at.translation, at.rotation, at.strain, at.expansion] {
                assert!(resistance.re > 0.0 && resistance.im > 0.0);
            }
        }
    }

    #[test]
    fn history_in_time_is_the_resistance_in_frequency() {
        // iω ∫ κ(t) e^(−iωt) dt with κ = ∫ density(s) e^(−st) ds is ∫ density iω/(s + iω) ds; trapezoid in ln s.
        for omega in [0.01, 1.0, 50.0] {
            let frequency = Complex::new(0.0, omega);
            let transform = |kernel: HistoryKernel| {
                let rates = (-1600..1600).map(|index| (f64::from(index) * 0.05).exp());
                rates
                    .map(|rate| frequency / (frequency + rate) * (kernel.density(rate) * rate * 0.05))
                    .sum::<Complex<f64>>()
            };
            let at = vibration(1.0, 1.0, 1.0, omega);
            let (translation, rotation) = (transform(HistoryKernel::Translation), transform(HistoryKernel::Rotation));
            assert!(close(at.translation / (6.0 * PI), translation + frequency / 9.0 + 1.0, 1e-12));
            assert!(close(at.rotation / (8.0 * PI), rotation + 1.0, 1e-12));
            assert!(close(at.strain / (4.0 * PI), rotation * (5.0 / 3.0) + frequency * (2.0 / 45.0) + 1.0, 1e-12));
        }
    }
}
