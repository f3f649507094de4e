//! Row 24: the measure of area, and the work of repulsion along closed loops.
//!
//! A face of area A at the gap d, stretched in its plane to the ratio k: with U(d) = α d^(1−ν)/(ν−1) the work is
//!
//!   deformed_area:           −∮ A k U′ dd                  not exact: no potential
//!   reference_area:          −∮ A U′ dd                    U A
//!   deformed_area_potential: −∮ A k U′ dd − ∮ A U dk       U k A
//!
//! Along gap 0.5 → 1, ratio 1 → 1.5 and back, with α = A = 1 and ν = 6: −3.1 J, 0, 0; the other way round 3.1 J, 0, 0.
//! Around any loop of (p₀, P) the two with a potential do nothing.

use gyration::contact::{
    AreaMeasure, ContactLaw, ContactLoads, ContactScratch, Deformation, LawSet, Meeting, RelativeMotion, Repulsion,
};
use gyration::kinematics::Quaternion;
use gyration::surface::{GapField, Surface};
use gyration::tensor::{Mat3, Vec3};
use gyration_validation::Case;
use std::f64::consts::TAU;

const MEASURES: [(AreaMeasure, &str); 3] = [
    (AreaMeasure::DeformedArea, "work in deformed_area [J]"),
    (AreaMeasure::ReferenceArea, "work in reference_area [J]"),
    (AreaMeasure::DeformedAreaPotential, "work in deformed_area_potential [J]"),
];

/// Nodes and weights of Gauss's rule with five points on [0, 1].
const GAUSS: [(f64, f64); 5] = [
    (0.046910077030668, 0.118463442528095),
    (0.230765344947158, 0.239314335249683),
    (0.5, 0.284444444444444),
    (0.769234655052842, 0.239314335249683),
    (0.953089922969332, 0.118463442528095),
];

/// A body above the plane z = 0, with repulsion of α = 1 Pa, ν = 6, d₀ = 1 m in one measure.
struct Pushed {
    surface: Surface,
    laws: LawSet,
}

/// Place and gradient, and their rates along a path.
struct Passing {
    place: Vec3,
    gradient: Mat3,
    velocity: Vec3,
    rate: Mat3,
}

impl Pushed {
    fn new(surface: Surface, measure: AreaMeasure) -> Self {
        let law = ContactLaw::Repulsion(Repulsion { alpha: 1.0, exponent: 6.0, reference_gap: 1.0 });
        Self { surface, laws: LawSet::new(measure, vec![law]) }
    }

    /// f·ṗ₀ + M·Ṗ.
    fn power(&self, at: &Passing) -> f64 {
        let normal = Vec3::z();
        let field = GapField::new(at.place.z, at.gradient.tr_mul(&normal));
        let motion = RelativeMotion { normal, velocity: at.velocity, gradient_rate: at.rate };
        let deformation = Deformation::of(&at.gradient);
        let meeting = Meeting { surface: &self.surface, field, motion, deformation };
        let loads = ContactLoads::integrate(&self.laws, &meeting, &mut ContactScratch::default());
        loads.unwrap_or_else(|error| panic!("{error}")).total().power(&at.velocity, &at.rate)
    }
}

/// A square of 1 m² that faces the plane.
fn face() -> Surface {
    let corners = [(-0.5, -0.5), (-0.5, 0.5), (0.5, 0.5), (0.5, -0.5)].map(|(x, y)| Vec3::new(x, y, 0.0));
    Surface::from_triangles(&corners, &[[0, 1, 2], [0, 2, 3]]).unwrap_or_else(|error| panic!("{error}"))
}

/// Work along a straight line of (gap, ratio), by Gauss's rule on 64 parts; the ratio along x alone.
fn along(pushed: &Pushed, from: (f64, f64), to: (f64, f64)) -> f64 {
    const PARTS: u32 = 64;
    let (by_gap, by_ratio) = (to.0 - from.0, to.1 - from.1);
    let at = |s: f64| Passing {
        place: Vec3::new(0.0, 0.0, from.0 + s * by_gap),
        gradient: Mat3::from_diagonal(&Vec3::new(from.1 + s * by_ratio, 1.0, 1.0)),
        velocity: Vec3::new(0.0, 0.0, by_gap),
        rate: Mat3::from_diagonal(&Vec3::new(by_ratio, 0.0, 0.0)),
    };
    let part = |k: u32| {
        let node = |(s, weight): &(f64, f64)| weight * pushed.power(&at((f64::from(k) + s) / f64::from(PARTS)));
        GAUSS.iter().map(node).sum::<f64>() / f64::from(PARTS)
    };
    (0..PARTS).map(part).sum()
}

#[test]
fn closed_loop_of_gap_and_area_works_in_the_measure_without_potential_only() {
    const SOURCE: &str = "α(1 − k)A(d₁^(1−ν) − d₂^(1−ν))/(ν−1)";
    let there = Case { row: Some(24), name: "gap 0.5 → 1, area ratio 1 → 1.5, and back", source: SOURCE };
    let back = Case { name: "the same loop the other way round", ..there };
    let corners = [(0.5, 1.0), (1.0, 1.0), (1.0, 1.5), (0.5, 1.5)];
    for ((measure, quantity), expected) in MEASURES.into_iter().zip([-3.1, 0.0, 0.0]) {
        let pushed = Pushed::new(face(), measure);
        let leg = |k: usize, l: usize| along(&pushed, corners[k % 4], corners[l % 4]);
        let forward: f64 = (0..4).map(|k| leg(k, k + 1)).sum();
        let backward: f64 = (0..4).rev().map(|k| leg(k + 1, k)).sum();
        // Gauss's rule and nodes of 15 digits leave less than 1e-12 of 6 J a leg.
        there.check(quantity, expected, forward, 1e-11);
        back.check(quantity, -expected, backward, 1e-11);
    }
}

/// A loop that turns, lifts, stretches and shears; period 1.
fn loop_at(s: f64) -> (Vec3, Mat3) {
    let (sin, cos) = (TAU * s).sin_cos();
    let turn = Quaternion::from_axis_angle(&Vec3::new(1.0, 2.0, 0.5), 0.7 + 0.5 * sin).rotation();
    let stretch = Mat3::new(1.0 + 0.3 * cos, 0.2 * sin, 0.1, 0.0, 1.0 - 0.2 * sin, 0.1 * cos, 0.2 * cos, 0.0, 1.1);
    (Vec3::new(0.2 * sin, 0.0, 1.0 + 0.2 * cos), turn * stretch)
}

/// Work around it, by the trapezoid rule, with rates by differences of eighth order.
fn around(pushed: &Pushed) -> f64 {
    const POINTS: u32 = 200;
    const STEP: f64 = 2e-3;
    const WEIGHTS: [f64; 4] = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
    let power = |k: u32| {
        let s = f64::from(k) / f64::from(POINTS);
        let (place, gradient) = loop_at(s);
        let (mut velocity, mut rate) = (Vec3::zeros(), Mat3::zeros());
        for (weight, steps) in WEIGHTS.iter().zip([1.0, 2.0, 3.0, 4.0]) {
            let (ahead, behind) = (loop_at(s + steps * STEP), loop_at(s - steps * STEP));
            velocity += (ahead.0 - behind.0) * (weight / STEP);
            rate += (ahead.1 - behind.1) * (weight / STEP);
        }
        pushed.power(&Passing { place, gradient, velocity, rate })
    };
    (0..POINTS).map(power).sum::<f64>() / f64::from(POINTS)
}

#[test]
fn potential_measures_do_no_work_around_any_loop() {
    const SOURCE: &str = "a potential of (p₀, P)";
    let cases = [
        ("box on a loop of place and gradient", Surface::cuboid(&Vec3::new(0.6, 0.5, 0.4))),
        ("ellipsoid on a loop of place and gradient", Surface::ellipsoid(&Vec3::new(0.3, 0.25, 0.4))),
        ("cylinder on a loop of place and gradient", Surface::cylinder(0.25, 0.5)),
    ];
    for (name, surface) in cases {
        let case = Case { row: Some(24), name, source: SOURCE };
        let [without, reference, deformed] =
            MEASURES.map(|(measure, quantity)| (quantity, around(&Pushed::new(surface.clone(), measure))));
        println!("{name}: {without:?}");
        // The measure without potential tells the scale.
        assert!(without.1.abs() > 1e-2, "{without:?}");
        for (quantity, work) in [reference, deformed] {
            case.check(quantity, 0.0, work, 1e-9 * without.1.abs().max(1.0));
        }
    }
}
