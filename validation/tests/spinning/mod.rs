//! What the tests of spinning bodies read off a run: the axis of a body and its angular velocity.
//!
//! The axis is the image P e_z of the shape's axis; ω is the axial vector of Ṗ Pᵀ.

#![allow(dead_code, reason = "each test uses a part of this")]

use gyration::tensor::{Mat3, Vec3};
use gyration_validation::Run;
use std::f64::consts::{PI, TAU};

/// The motion of one body of a run, sample by sample.
pub struct Spinning {
    /// P.
    pub gradients: Vec<Mat3>,
    /// ω in spatial axes [rad/s].
    pub angular_velocities: Vec<Vec3>,
}

impl Spinning {
    /// The body of this name.
    pub fn of(run: &Run, body: &str) -> Self {
        let gradients = matrices(run, &format!("{body}.P"));
        let rates = matrices(run, &format!("{body}.Pdot"));
        let angular_velocity = |(p, rate): (&Mat3, &Mat3)| {
            let skew = rate * p.transpose();
            Vec3::new(skew[(2, 1)], skew[(0, 2)], skew[(1, 0)])
        };
        let angular_velocities = gradients.iter().zip(&rates).map(angular_velocity).collect();
        Self { gradients, angular_velocities }
    }

    /// The axis at each sample.
    pub fn axes(&self) -> Vec<Vec3> {
        self.gradients.iter().map(|p| p.column(2).into()).collect()
    }

    /// Angles of the axis with the vertical [rad].
    pub fn inclinations(&self) -> Vec<f64> {
        self.axes().iter().map(|axis| axis.x.hypot(axis.y).atan2(axis.z)).collect()
    }

    /// Azimuths of the axis, continuous from sample to sample [rad].
    pub fn azimuths(&self) -> Vec<f64> {
        let mut azimuth = 0.0;
        let follow = |axis: &Vec3| {
            let turn = (axis.y.atan2(axis.x) - azimuth + PI).rem_euclid(TAU) - PI;
            azimuth += turn;
            azimuth
        };
        self.axes().iter().map(follow).collect()
    }

    /// Angular velocities about the axis [rad/s].
    pub fn axial_spins(&self) -> Vec<f64> {
        self.axes().iter().zip(&self.angular_velocities).map(|(axis, omega)| axis.dot(omega)).collect()
    }

    /// Angular velocities about the vertical [rad/s].
    pub fn vertical_spins(&self) -> Vec<f64> {
        self.angular_velocities.iter().map(|omega| omega.z).collect()
    }
}

/// The samples of the nine columns `PREFIX_xx` … `PREFIX_zz`.
fn matrices(run: &Run, prefix: &str) -> Vec<Mat3> {
    let entries = ["xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"];
    let columns = entries.map(|entry| run.column(&format!("{prefix}_{entry}")));
    (0..run.times.len()).map(|k| Mat3::from_row_iterator(columns.iter().map(|column| column[k]))).collect()
}

/// The mean of some numbers.
pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// The time at which samples fall to a value for the first time, on a straight line between samples; none if never.
pub fn falls_to(times: &[f64], values: &[f64], value: f64) -> Option<f64> {
    let k = (1..values.len()).find(|&k| values[k] <= value)?;
    let share = (values[k - 1] - value) / (values[k - 1] - values[k]);
    Some(times[k - 1] + share * (times[k] - times[k - 1]))
}
