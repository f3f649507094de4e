//! Row 23: a thrown cube is fair, and a die that starts nearly flat favours the face that is lowest.
//!
//!   isotropic orientation and spin:  each face 1/6, exactly, by the symmetry of the cube;  χ² = Σ (n_i − N/6)²/(N/6)
//!   nearly flat, without much spin:  the lowest face is favoured, the more so the stronger the damping
//!                                    (Kapitaniak, Strzalko, Grabski, Kapitaniak, *Chaos* 22 (2012) 047504)
//!
//! The die is that of the peers' table: side L = 2 cm, 10 g, from 0.1 to 0.3 m, spin up to 40 rad/s, ν = 6, rest gap
//! 0.03 L, ν_d = ν_f = 3, β = 5e-4 in units of L, density and g. A throw is decided as soon as its energy is below
//! mgL/√2: for another face to be the lowest, two must be equally low, and then the centre is at L/√2 at least, the
//! potential of the field is positive, and nothing on a table that stands still gives energy.
//!
//! Some hundred throws compare the die with chance; what takes thousands is shown with the ready study `dice-fairness`
//! (`studies_dice`): that the faces of a cube are equally likely, and that the throws have converged.

use gyration::balance;
use gyration::dynamics::Workspace;
use gyration::kinematics::Quaternion;
use gyration::state::{RigidStart, State};
use gyration::tensor::Vec3;
use gyration_sim::{MemorySink, Monitor, Outcome, Progress, Reason, Simulation};
use gyration_threads::in_order;
use gyration_validation::{Answer, Experiment, TWO};
use std::f64::consts::{FRAC_1_SQRT_2, TAU};

const ROW: Option<u32> = Some(23);
const SIDE: f64 = 0.02;
const MASS: f64 = 0.01;
const GRAVITY: f64 = 9.81;
/// χ² of five degrees of freedom is above this with the probability 0.001.
const CHI_SQUARE_LIMIT: f64 = 20.515;
/// Statistics do not need converged throws.
const COARSE: f64 = 1e-4;
/// A deviation of as many standard deviations has the probability 0.001.
const DEVIATIONS: f64 = 3.29;

/// Ten steps, after which the energy is looked at.
struct SomeSteps(usize);

impl Monitor for SomeSteps {
    fn after_step(&mut self, _: &Progress) -> Option<Reason> {
        self.0 -= 1;
        (self.0 == 0).then_some(Reason::Interrupted)
    }
}

/// The peers' die, its damping multiplied by a factor, at a relative tolerance.
fn die(damping: f64, rtol: f64) -> Experiment {
    let density = MASS / SIDE.powi(3);
    let alpha = 0.03_f64.powi(6) * density * GRAVITY * SIDE;
    let beta = 5e-4 * density * (GRAVITY * SIDE).sqrt();
    Experiment::of_scene(&format!(
        r#"
        time = {{ end = 60.0, sample = 60.0, stop_at_rest = {{ speed = 1e-4, hold = 0.1 }} }}
        solver = {{ rtol = {rtol:e}, atol = {:e} }}
        [[support]]
        name = "table"
        plane = {{ normal = [0, 0, 1] }}
        [[contact]]
        support = "table"
        repulsion = {{ alpha = {alpha:e}, nu = 6, d0 = {SIDE} }}
        damping = {{ beta = {:e}, nu = 3, d0 = {SIDE} }}
        friction = {{ beta = {beta:e}, nu = 3, d0 = {SIDE} }}
        [[body]]
        name = "die"
        shape = {{ box = {{ size = [{SIDE}, {SIDE}, {SIDE}] }} }}
        mass = {MASS}
        position = [0, 0, 0.2]
        "#,
        0.01 * rtol,
        damping * beta,
    ))
}

/// The lowest of the six faces.
fn lowest_face(die: &Experiment, state: &State) -> usize {
    let down = -state.motion(&die.model, 0).placement.gradient.tr_mul(&Vec3::z());
    let axis = down.iamax();
    2 * axis + usize::from(down[axis] > 0.0)
}

/// Throws the die until its face is decided.
fn throw(die: &Experiment, start: &State) -> usize {
    let mut sink = MemorySink::default();
    let mut simulation = Simulation::new(&die.model, start, die.plan).unwrap_or_else(|error| panic!("{error}"));
    simulation.begin(&mut sink).unwrap_or_else(|error| panic!("{error}"));
    let mut energies = vec![0.0; die.model.energies().len()];
    loop {
        let outcome = simulation.run(&mut sink, &mut SomeSteps(10)).unwrap_or_else(|error| panic!("{error}"));
        let state = simulation.state();
        match outcome {
            Outcome::Stopped(stop) if stop.reason != Reason::Interrupted => panic!("{}", stop.what),
            Outcome::AtRest { .. } => return lowest_face(die, &state),
            Outcome::Completed => panic!("not decided after {} s", state.time),
            Outcome::Stopped(_) => {}
        }
        balance::energies(&die.model, &mut Workspace::default(), &state, &mut energies)
            .unwrap_or_else(|error| panic!("{error:?}"));
        if energies.iter().sum::<f64>() < MASS * GRAVITY * SIDE * FRAC_1_SQRT_2 {
            return lowest_face(die, &state);
        }
    }
}

/// SplitMix64 from a key: throw k is the same whatever else is thrown, and on whichever thread.
struct Random(u64);

impl Random {
    fn of(stream: u64, throw: u64) -> Self {
        Self((stream << 32 | throw).wrapping_mul(0xD1B5_4A32_D192_ED03))
    }

    /// Uniform in (0, 1).
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut bits = self.0;
        bits = (bits ^ bits >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        bits = (bits ^ bits >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
        bits ^= bits >> 31;
        ((bits >> 11) as f64 + 0.5) * 2.0_f64.powi(-53)
    }

    /// Standard normal (Box and Muller).
    fn normal(&mut self) -> f64 {
        (-2.0 * self.uniform().ln()).sqrt() * (TAU * self.uniform()).cos()
    }

    fn direction(&mut self) -> Vec3 {
        Vec3::from_fn(|_, _| self.normal()).normalize()
    }
}

fn start(die: &Experiment, random: &mut Random, orientation: Quaternion, fastest: f64) -> State {
    let start = RigidStart {
        position: Vec3::new(0.0, 0.0, 0.1 + 0.2 * random.uniform()),
        orientation,
        velocity: Vec3::zeros(),
        angular_velocity: fastest * random.uniform() * random.direction(),
    };
    State::start(&die.model, &[start.into()])
}

/// Any orientation, and any spin up to 40 rad/s.
fn isotropic(die: &Experiment, throw: u64) -> State {
    let mut random = Random::of(1, throw);
    let orientation = Quaternion(std::array::from_fn(|_| random.normal()));
    start(die, &mut random, orientation, 40.0)
}

/// Face 4 lowest, tilted by up to 0.2 rad about any level axis, with a spin up to 1 rad/s.
fn nearly_flat(die: &Experiment, throw: u64) -> State {
    let mut random = Random::of(2, throw);
    let (sin, cos) = (TAU * random.uniform()).sin_cos();
    let orientation = Quaternion::from_axis_angle(&Vec3::new(cos, sin, 0.0), 0.2 * random.uniform());
    start(die, &mut random, orientation, 1.0)
}

/// How many of so many throws end on each face.
fn count(die: &Experiment, start: impl Fn(&Experiment, u64) -> State + Sync, throws: u64) -> [u64; 6] {
    let mut counts = [0; 6];
    for face in in_order(0..throws, TWO, |number| throw(die, &start(die, number))) {
        counts[face] += 1;
    }
    counts
}

/// χ² of the counts against six equal chances.
fn chi_square(counts: &[u64; 6]) -> f64 {
    let expected = counts.iter().sum::<u64>() as f64 / 6.0;
    counts.iter().map(|count| (*count as f64 - expected).powi(2) / expected).sum()
}

fn check_uniform(case: &'static str, counts: &[u64; 6]) {
    println!("{case}: {counts:?}");
    Answer {
        row: ROW,
        case,
        quantity: "χ² of the faces, five degrees of freedom",
        reference: 5.0,
        measured: chi_square(counts),
        // Above 20.5 with the probability 0.001 if the faces are equally likely.
        tolerance: CHI_SQUARE_LIMIT / 5.0 - 1.0,
        source: "symmetry of the cube: the expectation of χ² is 5",
    }
    .check();
}

#[test]
fn thrown_cube_is_fair() {
    // Fifty expected of each face: enough for the distribution of χ² to be that of its five degrees of freedom.
    check_uniform("cube thrown 300 times, isotropic, rtol = 1e-4", &count(&die(1.0, COARSE), isotropic, 300));
}

/// A share of throws, and its standard error.
#[derive(Debug, Clone, Copy)]
struct Share {
    value: f64,
    error: f64,
}

/// Share of the nearly flat throws that end on the face that was lowest.
fn favour(damping: f64, rtol: f64, throws: u64) -> Share {
    let counts = count(&die(damping, rtol), nearly_flat, throws);
    let value = counts[4] as f64 / throws as f64;
    let error = (value * (1.0 - value) / throws as f64).sqrt();
    println!(
        "damping × {damping}, rtol = {rtol:e}: {counts:?}, the lowest face {value:.3} ± {:.3} (95 %)",
        1.96 * error
    );
    Share { value, error }
}

/// By how many standard deviations the second share is larger.
fn deviations(first: Share, second: Share) -> f64 {
    (second.value - first.value) / first.error.hypot(second.error)
}

#[test]
fn nearly_flat_die_favours_its_lowest_face_the_more_the_stronger_the_damping() {
    // The smallest step, from 0.92 to 1, is 3.29 standard deviations with 130 throws.
    const THROWS: u64 = 200;
    let shares = [1.0, 2.0, 4.0, 16.0].map(|damping| favour(damping, COARSE, THROWS));
    for pair in shares.windows(2) {
        assert!(deviations(pair[0], pair[1]) > DEVIATIONS, "{pair:?}");
    }
    let [own, .., stronger] = shares;
    let weak = favour(0.25, COARSE, THROWS);
    let answer = |case, reference, measured, tolerance, source| {
        let quantity = "share of the face that was lowest, 200 throws";
        Answer { row: ROW, case, quantity, reference, measured, tolerance, source }.check();
    };
    let sixth = 1.0 / 6.0;
    let spread = DEVIATIONS * (sixth * (1.0 - sixth) / THROWS as f64).sqrt() / sixth;
    answer("die nearly flat, a quarter of the damping", sixth, weak.value, spread, "many bounces forget the start");
    // If all come down as they were, less than 3/200 of all that could be thrown do not, with the probability 0.95.
    let rare = 3.0 / THROWS as f64;
    answer("die nearly flat, sixteen times the damping", 1.0, stronger.value, rare, "it does not bounce");
    let excess = deviations(Share { value: sixth, error: 0.0 }, own);
    assert!(excess > DEVIATIONS, "the peers' die favours its lowest face by {excess:.1} standard deviations only");
}

#[test]
fn faces_of_the_die_do_not_depend_on_the_tolerance_as_a_distribution() {
    // With twice the damping two thirds of the throws end on the face that was lowest: there a shift shows best.
    let [coarse, fine] = [COARSE, 1e-7].map(|rtol| favour(2.0, rtol, 150));
    Answer {
        row: ROW,
        case: "die nearly flat, twice the damping, 150 throws at rtol = 1e-4 and at 1e-7",
        quantity: "difference of the shares of the lowest face, in standard deviations",
        reference: 0.0,
        measured: deviations(coarse, fine),
        tolerance: DEVIATIONS,
        source: "statistics do not need converged throws",
    }
    .check();
}
