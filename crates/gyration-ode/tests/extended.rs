//! Small differences of large numbers: an oscillation of 10⁻¹⁵ about 1, of which a number alone knows four steps.

use crate::common::with;
use gyration_ode::{BlockMatrix, Extended, ExtendedMut, Integrator, Method, System};
use std::convert::Infallible;
use std::ops::Range;

const AMPLITUDE: f64 = 1e-15;

/// ẍ = −(x − 1).
struct Offset;

impl System for Offset {
    type Inadmissible = Infallible;

    fn dimension(&self) -> usize {
        2
    }

    fn quadratures(&self) -> usize {
        0
    }

    fn blocks(&self) -> &[Range<usize>] {
        const BLOCK: Range<usize> = 0..2;
        std::slice::from_ref(&BLOCK)
    }

    fn rates(&mut self, _: f64, y: &[f64], dy: &mut [f64], _: &mut [f64]) -> Result<(), Infallible> {
        dy.copy_from_slice(&[y[1], 1.0 - y[0]]);
        Ok(())
    }

    fn extended_rates(&mut self, _: f64, y: Extended, dy: &mut [f64], _: &mut [f64]) -> Result<(), Infallible> {
        dy.copy_from_slice(&[y.high[1], -deviation(y)]);
        Ok(())
    }

    fn jacobian(&mut self, _: f64, _: &[f64], jacobian: &mut BlockMatrix) -> Result<(), Infallible> {
        jacobian.diagonal_mut()[0].copy_from_slice(&[0.0, -1.0, 1.0, 0.0]);
        Ok(())
    }

    fn error_scales(&mut self, _: f64, _: &[f64], _: &[f64], y_scale: &mut [f64], _: &mut [f64]) {
        y_scale.fill(1e-10 * AMPLITUDE);
    }

    fn project(&mut self, _: f64, _: &mut [f64], _: &mut [f64]) -> f64 {
        0.0
    }

    /// Nothing is to be projected: no digit may be lost by that.
    fn extended_project(&mut self, _: f64, _: ExtendedMut, _: &mut [f64]) -> f64 {
        0.0
    }
}

/// x − 1 to all digits.
fn deviation(y: Extended) -> f64 {
    (y.high[0] - 1.0) + y.low[0]
}

#[test]
fn an_oscillation_far_below_the_digits_of_its_offset_is_followed() {
    for method in [Method::Auto, Method::Explicit, Method::Implicit] {
        let mut integrator = Integrator::new(0.0, &[1.0, AMPLITUDE], &[], with(method));
        let mut worst: f64 = 0.0;
        while integrator.time() < 20.0 {
            integrator.step(&mut Offset, 20.0).unwrap();
            let (start, end) = integrator.last_step().unwrap();
            let (mut high, mut low) = ([0.0; 2], [0.0; 2]);
            for t in [start + 0.3 * (end - start), end] {
                integrator.interpolate_extended(t, &mut high, &mut [], Some(&mut low));
                let error = deviation(Extended { high: &high, low: &low }) - AMPLITUDE * t.sin();
                worst = worst.max(error.abs() / AMPLITUDE);
            }
            assert_eq!((integrator.state()[0], integrator.state_low()[0]), (high[0], low[0]));
        }
        println!("{method:?}: worst error {worst:.1e} of the amplitude, {:?}", integrator.statistics());
        // Some hundred steps of at most 1e-10 each; the interpolant of the implicit method is of order 3.
        assert!(worst < if method == Method::Implicit { 1e-6 } else { 1e-8 }, "{method:?}: {worst:e}");
    }
}

#[test]
fn what_the_numbers_lack_is_part_of_a_checkpoint() {
    let mut whole = Integrator::new(0.0, &[1.0, AMPLITUDE], &[], with(Method::Auto));
    let mut parts = whole.clone();
    while whole.time() < 5.0 {
        whole.step(&mut Offset, 5.0).unwrap();
        parts = Integrator::resume(&parts.memory(), with(Method::Auto)).unwrap();
        parts.step(&mut Offset, 5.0).unwrap();
    }
    assert_eq!((whole.state(), whole.state_low()), (parts.state(), parts.state_low()));
    assert!(whole.state_low()[0] != 0.0);
}
