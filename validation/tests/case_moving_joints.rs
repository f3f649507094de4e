//! Joints to supports that move.
//!
//!   I θ̈ = −ml (g + z̈) sin θ   of a rod on a hinge that swings by z = A sin Ωt
//!
//! upside down it stands where A²Ω² > 2gI/(ml). A rod on a hinge that is carried round at w stands off by cos θ =
//! mgl/(w² (I − I_a)), I about the hinge across the rod, I_a along it. What is welded to a support goes as it does: it
//! is pulled by m p̈. Whoever moves the support does the work.

use crate::independent::{Equations, integrate};
use gyration_validation::{Case, Experiment, largest};
use std::f64::consts::TAU;

const GRAVITY: f64 = 9.81;
const TIGHT: &str = "solver = { rtol = 1e-12, atol = 1e-14 }\n";

/// A rod on a hinge that swings: θ and its rate, t, and the work of who moves the hinge.
struct ShakenRod {
    mass: f64,
    arm: f64,
    inertia: f64,
    amplitude: f64,
    rate: f64,
}

impl Equations<4> for ShakenRod {
    fn rates(&self, &[angle, speed, time, _]: &[f64; 4]) -> Option<[f64; 4]> {
        let (sin, cos) = (self.rate * time).sin_cos();
        let (lift, bend) = (self.amplitude * self.rate * cos, -self.amplitude * self.rate.powi(2) * sin);
        let turn = -self.mass * self.arm * (GRAVITY + bend) * angle.sin() / self.inertia;
        // The centre is at z − l cos θ.
        let lifted = bend + self.arm * (angle.sin() * turn + angle.cos() * speed * speed);
        Some([speed, turn, 1.0, self.mass * (GRAVITY + lifted) * lift])
    }

    fn scale(&self, _: usize) -> f64 {
        1.0
    }
}

#[test]
fn a_rod_stands_upside_down_on_a_hinge_that_swings() {
    let (mass, length, amplitude, rate) = (0.4, 0.3, 0.02, 200.0);
    let arm = 0.5 * length;
    let across = 1e-3 + mass * length * length / 12.0;
    let rod = ShakenRod { mass, arm, inertia: across + mass * arm * arm, amplitude, rate };
    assert!((amplitude * rate).powi(2) > 2.0 * GRAVITY * rod.inertia / (mass * arm));
    let tilt = 3.0_f64;
    let ends: Vec<f64> = (0..=10).map(|k| 0.05 * f64::from(k)).collect();
    let reference = integrate(&rod, &[tilt, 0.0, 0.0, 0.0], &ends, 1e-13);
    // The support starts at A Ω: so does the rod with it.
    let scene = format!(
        "time = {{ end = 0.5, sample = 0.05 }}\n{TIGHT}[[support]]\nname = \"shaker\"\n\
         shape = {{ box = {{ size = [0.1, 0.1, 0.02] }} }}\nposition = [0, 0, -0.3]\n\
         motion = {{ oscillate = {{ direction = [0, 0, 1], amplitude = {amplitude:?}, frequency = {:?} }} }}\n\
         [[body]]\nname = \"rod\"\nmass_properties = {{ mass = {mass:?}, euler_tensor = \
         [[1e-3, 0, 0], [0, 1e-3, 0], [0, 0, {:e}]] }}\nposition = [{:?}, 0, {:?}]\n\
         orientation = {{ axis_angle = {{ axis = [0, -1, 0], angle = {tilt:?} }} }}\nvelocity = [0, 0, {:?}]\n\
         [[joint]]\nname = \"pivot\"\nbetween = [\"shaker\", \"rod\"]\nkind = \"hinge\"\naxis = [0, -1, 0]\n\
         points = [[0, 0, 0.3], [0, 0, {arm:?}]]\n",
        rate / TAU,
        mass * length * length / 12.0,
        arm * tilt.sin(),
        -arm * tilt.cos(),
        amplitude * rate
    );
    let run = Experiment::of_scene(&scene).run();
    let (angle, work) = (run.column("joint.pivot.angle"), run.column("work.support"));
    let turns = (angle.iter().zip(&reference)).map(|(angle, [other, ..])| (angle.sin() - other.sin()).abs());
    let case = Case {
        row: None,
        name: "a rod upside down on a hinge that swings",
        source: "I θ̈ = −ml (g + z̈) sin θ, by extrapolation",
    };
    case.check("largest error of sin θ over 16 swings", 0.0, largest(turns), 1e-8);
    let off = work.iter().zip(&reference).map(|(work, [.., other])| (work - other).abs());
    case.check("largest error of the work of the support [J]", 0.0, largest(off), 1e-8);
    assert!(angle.iter().all(|angle| angle.abs() > 2.0), "{angle:?}");
    assert!(run.relative_residual() < 1e-9, "{}", run.relative_residual());
}

#[test]
fn a_rod_stands_off_from_the_axis_about_which_its_hinge_goes() {
    let (mass, length, rate) = (0.5, 0.4, 9.0);
    let arm = 0.5 * length;
    let (along, thin) = (mass * length * length / 12.0, 1e-3);
    // About the hinge across the rod and along it.
    let (across, about) = (thin + along + mass * arm * arm, 2.0 * thin);
    let cosine: f64 = mass * GRAVITY * arm / (rate * rate * (across - about));
    let angle = cosine.acos();
    let (sin, end) = (angle.sin(), 3.0);
    let scene = format!(
        "time = {{ end = {end:?}, sample = 0.5 }}\n{TIGHT}[[support]]\nname = \"spindle\"\nplane = {{}}\n\
         motion = {{ rotate = {{ axis = [0, 0, 1], rate = {rate:?} }} }}\n[[body]]\nname = \"rod\"\n\
         mass_properties = {{ mass = {mass:?}, euler_tensor = [[{thin:?}, 0, 0], [0, {thin:?}, 0], [0, 0, {along:e}]] }}\n\
         position = [{:?}, 0, {:?}]\norientation = {{ axis_angle = {{ axis = [0, -1, 0], angle = {angle:?} }} }}\n\
         velocity = [0, {:?}, 0]\nangular_velocity = [0, 0, {rate:?}]\n[[joint]]\nname = \"pivot\"\n\
         between = [\"rod\", \"spindle\"]\nkind = \"hinge\"\naxis = [0, 1, 0]\n\
         points = [[0, 0, {arm:?}], [0, 0, 1]]\n",
        arm * sin,
        1.0 - arm * cosine,
        arm * sin * rate
    );
    let run = Experiment::of_scene(&scene).run();
    let off = run.times.iter().zip(run.column("rod.x")).map(|(t, x)| x - arm * sin * (rate * t).cos());
    let case = Case { row: None, name: "a rod on a hinge that goes round", source: "cos θ = mgl/(w² (I − I_a))" };
    case.check("largest error of its place [m]", 0.0, largest(off.map(f64::abs)), 1e-10);
    case.check("work of the support [J]", 0.0, *run.column("work.support").last().unwrap(), 1e-10);
}

#[test]
fn what_is_welded_to_a_support_goes_as_it_does() {
    let (mass, reach, rate, amplitude, swing) = (2.0, 0.6, 3.0, 0.05, 8.0);
    let scene = format!(
        "time = {{ end = 2, sample = 0.1 }}\nworld = {{ gravity = [0, 0, 0] }}\n{TIGHT}[[support]]\nname = \"arm\"\n\
         shape = {{ sphere = {{ radius = 0.1 }} }}\n\
         motion = [{{ rotate = {{ axis = [0, 0, 1], rate = {rate:?} }} }}, \
         {{ oscillate = {{ direction = [0, 0, 1], amplitude = {amplitude:?}, frequency = {:?} }} }}]\n\
         [[body]]\nname = \"box\"\nshape = {{ box = {{ size = [0.1, 0.2, 0.3] }} }}\nmass = {mass:?}\n\
         position = [{reach:?}, 0, 0]\nvelocity = [0, {:?}, {:?}]\nangular_velocity = [0, 0, {rate:?}]\n\
         [[joint]]\nname = \"weld\"\nbetween = [\"box\", \"arm\"]\nkind = \"weld\"\n\
         points = [[0, 0, 0], [{reach:?}, 0, 0]]\n",
        swing / TAU,
        reach * rate,
        amplitude * swing
    );
    let run = Experiment::of_scene(&scene).run();
    let case = Case { row: None, name: "a box welded to a support that turns and swings", source: "p = R p₀ + b" };
    let [x, y, z] = ["x", "y", "z"].map(|axis| run.column(&format!("box.{axis}")));
    let [fx, fz, mz] = ["fx", "fz", "mz"].map(|what| run.column(&format!("joint.weld.{what}")));
    let at = |k: usize| {
        let t = run.times[k];
        ((rate * t).sin_cos(), amplitude * (swing * t).sin(), run.column("work.support")[k])
    };
    let all = 0..run.times.len();
    let place = |k: usize| {
        let ((sin, cos), lift, _) = at(k);
        (x[k] - reach * cos).hypot(y[k] - reach * sin).hypot(z[k] - lift)
    };
    case.check("largest error of its place [m]", 0.0, largest(all.clone().map(place)), 1e-13);
    let force = |k: usize| {
        let ((_, cos), lift, _) = at(k);
        let pulled = (fx[k] + mass * reach * rate * rate * cos).hypot(fz[k] + mass * swing * swing * lift);
        pulled.hypot(mz[k])
    };
    let case = case.by("m p̈");
    case.check("largest error of the force [N]", 0.0, largest(all.clone().map(force)), 1e-10);
    let work = |k: usize| {
        let speed = amplitude * swing * (swing * run.times[k]).cos();
        (at(k).2 - 0.5 * mass * (speed * speed - (amplitude * swing).powi(2))).abs()
    };
    case.by("½m ż²").check("largest error of the work of the support [J]", 0.0, largest(all.map(work)), 1e-9);
}
