//! The ellipsoid against the books, against differences, and against what any resistance has to be.

use super::*;
use crate::tensor::{Mat3, Vec3, cross_matrix};
use std::f64::consts::PI;

const ETA: f64 = 0.7;

fn close(a: f64, b: f64) {
    assert!((a - b).abs() < 1e-13 * b.abs().max(1.0), "{a} {b}");
}

fn total(body: &FluidEllipsoid, gradient: &Mat3, flow: &Mat3) -> Mat3 {
    body.shown(&body.stress(&body.seen(gradient), &body.seen(flow)).total)
}

#[test]
fn sphere_has_the_resistances_of_the_books() {
    let radius = 1.7;
    let ball = FluidEllipsoid::new([radius; 3], ETA);
    close(ball.force(&Vec3::new(0.0, 2.0, 0.0))[1], -6.0 * PI * ETA * radius * 2.0);
    let volume = 4.0 / 3.0 * PI * radius.powi(3);
    // Moment about z: ∫ (x t_y − y t_x) = V (σ_yx − σ_xy).
    let stress = total(&ball, &cross_matrix(&Vec3::z()), &Mat3::zeros());
    close(volume * (stress[(1, 0)] - stress[(0, 1)]), -8.0 * PI * ETA * radius.powi(3));
    let strain = Mat3::new(0.3, 0.2, 0.0, 0.2, -0.1, 0.5, 0.0, 0.5, -0.2);
    let held = total(&ball, &Mat3::zeros(), &strain);
    assert!((held - strain * 5.0 * ETA).norm() < 1e-13);
    let growing = total(&ball, &(Mat3::identity() * 0.4), &Mat3::zeros());
    assert!((growing + Mat3::identity() * (4.0 * ETA * 0.4)).norm() < 1e-13);
}

/// F = 16πηa e³/((1 + e²) ln((1 + e)/(1 − e)) − 2e) along the axis of a prolate spheroid. Happel, Brenner, §5-11.
#[test]
fn prolate_spheroid_has_its_closed_drag() {
    for ratio in [1.5_f64, 4.0, 1000.0] {
        let e = (1.0 - ratio.powi(-2)).sqrt();
        let log = ((1.0 + e) / (1.0 - e)).ln();
        let along = 16.0 * PI * ETA * ratio * e.powi(3) / ((1.0 + e * e) * log - 2.0 * e);
        let across = 32.0 * PI * ETA * ratio * e.powi(3) / (2.0 * e + (3.0 * e * e - 1.0) * log);
        let force = FluidEllipsoid::new([ratio, 1.0, 1.0], ETA).force(&Vec3::new(1.0, 1.0, 0.0));
        // 1 − e loses digits in the closed form: of 1000, six.
        assert!((force[0] / -along - 1.0).abs() < 1e-10, "{ratio}");
        assert!((force[1] / -across - 1.0).abs() < 1e-10, "{ratio}");
    }
}

/// A rigid spheroid without couple turns at φ̇ = −γ̇/(r² + 1) when its axis is along the flow. Jeffery (1922).
#[test]
fn spheroid_without_couple_turns_as_jeffery_says() {
    for ratio in [0.01_f64, 0.5, 3.0, 200.0] {
        let grain = FluidEllipsoid::new([ratio, 1.0, 1.0], ETA);
        let flow = Mat3::new(0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
        let turn = -1.0 / (ratio * ratio + 1.0);
        let stress = total(&grain, &cross_matrix(&(turn * Vec3::z())), &flow);
        assert!((stress[(0, 1)] - stress[(1, 0)]).abs() < 1e-12 * stress.norm(), "{ratio}: {stress}");
    }
}

fn basis(k: usize) -> Mat3 {
    Mat3::from_fn(|i, j| f64::from(u8::from(3 * i + j == k)))
}

#[test]
fn resistance_is_symmetric_and_takes_energy() {
    let carried = Mat3::new(1.0, 0.3, -0.2, 0.1, 0.4, 0.7, -0.5, 0.2, 2.5);
    let grain = FluidEllipsoid::of(&carried, ETA);
    let still = Mat3::zeros();
    for k in 0..9 {
        for l in 0..9 {
            let (one, other) = (total(&grain, &basis(k), &still), total(&grain, &basis(l), &still));
            let (kl, lk) = (one.dot(&basis(l)), other.dot(&basis(k)));
            assert!((kl - lk).abs() < 1e-12, "{k} {l}: {kl} {lk}");
        }
        assert!(total(&grain, &basis(k), &still).dot(&basis(k)) < 0.0);
    }
}

#[test]
fn turning_everything_turns_the_answer() {
    let carried = Mat3::new(1.0, 0.3, -0.2, 0.1, 0.4, 0.7, -0.5, 0.2, 2.5);
    let turn = crate::kinematics::Quaternion::from_axis_angle(&Vec3::new(1.0, -2.0, 0.4), 0.8).rotation();
    let (one, other) = (FluidEllipsoid::of(&carried, ETA), FluidEllipsoid::of(&(turn * carried), ETA));
    let gradient = Mat3::new(0.2, -0.7, 0.1, 0.9, 0.3, -0.4, 0.5, 0.6, -0.8);
    let turned = |tensor: &Mat3| turn * tensor * turn.transpose();
    let flow = Mat3::new(0.1, 1.0, 0.0, 0.3, -0.3, 0.0, 0.2, 0.0, 0.2);
    let difference = total(&other, &turned(&gradient), &turned(&flow)) - turned(&total(&one, &gradient, &flow));
    // Some roundings of a stress of order ten.
    assert!(difference.norm() < 1e-12, "{difference}");
}

/// Also at equal axes, where principal axes have no derivative.
#[test]
fn form_slopes_agree_with_differences() {
    let gradient = Mat3::new(0.2, -0.7, 0.1, 0.9, 0.3, -0.4, 0.5, 0.6, -0.8);
    let flow = Mat3::new(0.1, 1.0, 0.0, 0.3, -0.3, 0.0, 0.2, 0.0, 0.2);
    let velocity = Vec3::new(0.4, -1.1, 0.3);
    let general = Mat3::new(1.0, 0.3, -0.2, 0.1, 0.4, 0.7, -0.5, 0.2, 2.5);
    for carried in [general, Mat3::identity(), Mat3::from_diagonal(&Vec3::new(2.0, 1.0, 1.0))] {
        let at = FluidEllipsoid::of(&carried, ETA);
        let stress = at.stress(&at.seen(&gradient), &at.seen(&flow));
        for k in 0..9 {
            let step = 1e-5;
            let change = basis(k) * carried.transpose() + carried * basis(k).transpose();
            let slope = at.along_form(&at.seen(&change));
            let exact = at.shown(&at.stress_along(&slope, &stress, &at.seen(&gradient)));
            let exact_force = at.axes * at.force_along(&slope, &at.axes.tr_mul(&velocity));
            let shifted = |by: f64| FluidEllipsoid::of(&(carried + by * basis(k)), ETA);
            let force = |body: &FluidEllipsoid| body.axes * body.force(&body.axes.tr_mul(&velocity));
            let (ahead, behind) = (shifted(step), shifted(-step));
            let difference = (total(&ahead, &gradient, &flow) - total(&behind, &gradient, &flow)) / (2.0 * step);
            let force_difference = (force(&ahead) - force(&behind)) / (2.0 * step);
            // Central differences: step² and eps/step, relative to quantities of order ten and more.
            assert!((difference - exact).norm() < 1e-8 * exact.norm().max(1.0), "{k}: {difference} {exact}");
            assert!(
                (force_difference - exact_force).norm() < 1e-8 * exact_force.norm().max(1.0),
                "{k}: {force_difference} {exact_force}"
            );
        }
    }
}
