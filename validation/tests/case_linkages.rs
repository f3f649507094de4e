//! Linkages: a four-bar against its reduced equation, chains against statics, and how exactly joints are kept.

use gyration::tensor::Vec3;
use gyration_validation::{Case, Experiment, largest};
use std::f64::consts::TAU;

const GRAVITY: f64 = 9.81;

/// Crank, coupler and rocker between A = (0, 0) and D = (d, 0) in the plane x, z; masses in their middles.
struct FourBar {
    lengths: [f64; 3],
    base: f64,
    masses: [f64; 3],
    /// About each centre, across the plane \[kg m²\].
    inertias: [f64; 3],
}

/// The links at an angle φ of the crank: where they end, and how they turn with φ.
struct Links {
    ends: [[f64; 2]; 4],
    turns: [f64; 3],
}

fn less(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// By a right angle, from x to z.
fn turned(a: [f64; 2]) -> [f64; 2] {
    [-a[1], a[0]]
}

impl FourBar {
    fn links(&self, angle: f64) -> Links {
        let [crank, coupler, rocker] = self.lengths;
        let (sin, cos) = angle.sin_cos();
        let (b, d) = ([crank * cos, crank * sin], [self.base, 0.0]);
        let way = less(d, b);
        let square = dot(way, way);
        // C is where the circles about B and D meet, above BD.
        let along = 0.5 * (coupler * coupler - rocker * rocker + square) / square;
        let across = (coupler * coupler / square - along * along).sqrt();
        let up = turned(way);
        let c = [b[0] + along * way[0] + across * up[0], b[1] + along * way[1] + across * up[1]];
        // C′ = B′ + χ′ (C − B)⊥ = ψ′ (C − D)⊥.
        let (moved, on_b, on_d) = (turned(b), less(c, b), less(c, d));
        let coupler_turn = -dot(moved, on_d) / dot(turned(on_b), on_d);
        let rocker_turn = dot(moved, on_b) / dot(turned(on_d), on_b);
        Links { ends: [[0.0; 2], b, c, d], turns: [1.0, coupler_turn, rocker_turn] }
    }

    fn centers(links: &Links) -> [[f64; 2]; 3] {
        [0, 1, 2].map(|k| [0, 1].map(|i| 0.5 * (links.ends[k][i] + links.ends[k + 1][i])))
    }

    /// I(φ) of T = ½ I φ̇², and V.
    fn inertia_and_potential(&self, angle: f64) -> [f64; 2] {
        let links = self.links(angle);
        let centers = Self::centers(&links);
        let (b, c, d) = (links.ends[1], links.ends[2], links.ends[3]);
        let coupler = less(c, b);
        let half = [0.5 * coupler[0], 0.5 * coupler[1]];
        let (own, turn) = (turned(b), turned(half));
        let moved = [own[0] + links.turns[1] * turn[0], own[1] + links.turns[1] * turn[1]];
        let on_d = less(centers[2], d);
        let squares = [dot(centers[0], centers[0]), dot(moved, moved), links.turns[2].powi(2) * dot(on_d, on_d)];
        let inertia = (0..3).map(|k| self.masses[k] * squares[k] + self.inertias[k] * links.turns[k].powi(2)).sum();
        [inertia, (0..3).map(|k| self.masses[k] * GRAVITY * centers[k][1]).sum()]
    }

    /// The time of a turn that starts at φ = `from` with the rate `rate`: the trapezoidal rule of a periodic function.
    fn period(&self, from: f64, rate: f64) -> f64 {
        const NODES: u32 = 2000;
        let [inertia, potential] = self.inertia_and_potential(from);
        let energy = 0.5 * inertia * rate * rate + potential;
        let slowness = |k: u32| {
            let [inertia, potential] = self.inertia_and_potential(from + TAU * f64::from(k) / f64::from(NODES));
            (0.5 * inertia / (energy - potential)).sqrt()
        };
        TAU / f64::from(NODES) * (0..NODES).map(slowness).sum::<f64>()
    }
}

#[test]
fn a_four_bar_turns_in_the_time_of_its_reduced_equation() {
    let case = Case {
        row: None,
        name: "four-bar of two hinges and two balls, crank at 8 rad/s",
        source: "T = ∮ √(I(φ)/(2(E − V(φ)))) dφ",
    };
    let bar = FourBar { lengths: [0.2, 0.5, 0.4], base: 0.45, masses: [1.0, 0.8, 0.6], inertias: [4e-3, 1.7e-2, 9e-3] };
    let (start, rate) = (0.7, 8.0);
    let links = bar.links(start);
    let centers = FourBar::centers(&links);
    let mut scene = "time = { end = 1, sample = 1 }\nsolver = { rtol = 1e-12, atol = 1e-14 }\n".to_owned();
    for (k, center) in centers.into_iter().enumerate() {
        let way = less(links.ends[k + 1], links.ends[k]);
        let turn = links.turns[k] * rate;
        let arm = less(center, if k == 2 { links.ends[3] } else { links.ends[k] });
        let base = if k == 1 { turned(links.ends[1]).map(|c| c * rate) } else { [0.0; 2] };
        let own = turned(arm);
        // From x to z is about −y.
        let (angle, inertia) = (way[1].atan2(way[0]), bar.inertias[k] - 1e-4);
        scene += &format!(
            "[[body]]\nname = \"{k}\"\nposition = [{:?}, 0, {:?}]\nvelocity = [{:?}, 0, {:?}]\n\
             orientation = {{ axis_angle = {{ axis = [0, -1, 0], angle = {angle:?} }} }}\n\
             angular_velocity = [0, {:?}, 0]\n\
             mass_properties = {{ mass = {}, euler_tensor = [[{inertia:e}, 0, 0], [0, 1e-4, 0], [0, 0, 1e-4]] }}\n",
            center[0],
            center[1],
            base[0] + turn * own[0],
            base[1] + turn * own[1],
            -turn,
            bar.masses[k],
        );
    }
    let half = bar.lengths.map(|length| 0.5 * length);
    scene += &format!(
        "[[joint]]\nname = \"A\"\nbetween = [\"space\", \"0\"]\nkind = \"hinge\"\naxis = [0, 1, 0]\n\
         points = [[0, 0, 0], [{:?}, 0, 0]]\n\
         [[joint]]\nname = \"B\"\nbetween = [\"0\", \"1\"]\nkind = \"ball\"\npoints = [[{:?}, 0, 0], [{:?}, 0, 0]]\n\
         [[joint]]\nname = \"C\"\nbetween = [\"1\", \"2\"]\nkind = \"ball\"\npoints = [[{:?}, 0, 0], [{:?}, 0, 0]]\n\
         [[joint]]\nname = \"D\"\nbetween = [\"2\", \"space\"]\nkind = \"hinge\"\naxis = [0, 1, 0]\n\
         points = [[{:?}, 0, 0], [{:?}, 0, 0]]\n",
        -half[0], half[0], -half[1], half[1], -half[2], half[2], bar.base
    );
    let experiment = Experiment::of_scene(&scene);
    let reference = bar.period(start, rate);
    let run = experiment.until(reference).run();
    let motion = run.end.motion(&experiment.model, 0);
    let along: Vec3 = motion.placement.gradient.column(0).into();
    let off = (along.z.atan2(along.x) - start + 0.5 * TAU).rem_euclid(TAU) - 0.5 * TAU;
    case.check("time of a turn of the crank [s]", reference, reference - off / rate, 1e-9);
    let long = experiment.until(20.0 * reference).sampled(0.01).run();
    case.by("the ledger").check("residual over the energy in play", 0.0, long.relative_residual(), 1e-9);
    let apart = joint_errors(&long, [("0", half[0]), ("1", -half[1])]);
    case.by("the joint").check("largest error of the joint B over twenty turns [m]", 0.0, apart, 1e-15);
}

/// The largest distance of two points on the x axes of two bodies.
fn joint_errors(run: &gyration_validation::Run, ends: [(&str, f64); 2]) -> f64 {
    let place = |(name, point): (&str, f64)| {
        ["x", "y", "z"].map(|axis| {
            let (center, along) = (run.column(&format!("{name}.{axis}")), run.column(&format!("{name}.P_{axis}x")));
            center.iter().zip(&along).map(|(center, along)| center + point * along).collect::<Vec<_>>()
        })
    };
    let [one, other] = ends.map(place);
    largest((0..one[0].len()).map(|k| (0..3).map(|i| (one[i][k] - other[i][k]).powi(2)).sum::<f64>().sqrt()))
}

/// So many rods of 0.1 m and 0.1 kg, each hung from the one before by a ball, inclined by an angle \[rad\].
fn chain(count: usize, inclination: f64, end: f64) -> Experiment {
    let (length, mass) = (0.1, 0.1);
    let (sin, cos) = inclination.sin_cos();
    let solver = "solver = { method = \"explicit\", rtol = 1e-3 }";
    let mut scene = format!("time = {{ end = {end}, sample = 0.1 }}\n{solver}\n");
    for k in 0..count {
        let middle = length * (k as f64 + 0.5);
        scene += &format!(
            "[[body]]\nname = \"l{k}\"\nposition = [{:?}, 0, {:?}]\n\
             orientation = {{ axis_angle = {{ axis = [0, -1, 0], angle = {inclination:?} }} }}\n\
             mass_properties = {{ mass = {mass}, euler_tensor = [[1e-6, 0, 0], [0, 1e-6, 0], [0, 0, 8e-5]] }}\n",
            middle * sin,
            -middle * cos,
        );
        let half = 0.5 * length;
        let (upper, point) = if k == 0 { ("space".to_owned(), 0.0) } else { (format!("l{}", k - 1), -half) };
        scene += &format!(
            "[[joint]]\nname = \"j{k}\"\nbetween = [\"{upper}\", \"l{k}\"]\nkind = \"ball\"\n\
             points = [[0, 0, {point:?}], [0, 0, {half:?}]]\n",
        );
    }
    Experiment::of_scene(&scene)
}

#[test]
fn joints_of_a_chain_of_a_hundred_links_stay_together_for_two_seconds() {
    let case = Case { row: None, name: "chain of 100 links that swings from 0.5 rad for 2 s", source: "C = 0" };
    let experiment = chain(100, 0.5, 2.0);
    let run = experiment.run();
    let mut workspace = gyration::dynamics::Workspace::default();
    let misfits = workspace.joint_misfits(&experiment.model, &run.end).unwrap();
    let largest_end = largest(misfits.iter().map(|misfit| misfit.place)) / 0.1;
    case.check("largest error of a joint at the end, of a link", 0.0, largest_end, 1e-14);
    let apart = |k: usize| {
        let of = |name: String, point: f64| {
            ["x", "y", "z"].map(|axis| {
                let (center, along) = (run.column(&format!("{name}.{axis}")), run.column(&format!("{name}.P_{axis}z")));
                center.iter().zip(&along).map(|(center, along)| center + point * along).collect::<Vec<_>>()
            })
        };
        let (one, other) = (of(format!("l{}", k - 1), -0.05), of(format!("l{k}"), 0.05));
        largest((0..one[0].len()).flat_map(|row| [0, 1, 2].map(|i| one[i][row] - other[i][row])))
    };
    // Recorded places at 10 m have the digits of one number: 2 × 0.9e-15 m.
    case.check("largest error in the recorded numbers, of a link", 0.0, largest((1..100).map(apart)) / 0.1, 4e-14);
    case.by("the ledger").check("residual over the energy in play", 0.0, run.relative_residual(), 1e-7);
}

#[test]
fn joints_of_a_hanging_chain_carry_what_hangs_below() {
    let case = Case { row: None, name: "chain of 100 links at rest", source: "F_k = (100 − k) m g" };
    let run = chain(100, 0.0, 0.1).run();
    let error = (0..100).map(|k| {
        let pull = run.column(&format!("joint.j{k}.fz"));
        // On the upper one, downwards.
        let weight = 0.1 * GRAVITY * f64::from(100 - k);
        largest(pull.iter().map(|pull| (pull + weight) / weight))
    });
    case.check("largest error of a force, relative", 0.0, largest(error), 1e-11);
}
