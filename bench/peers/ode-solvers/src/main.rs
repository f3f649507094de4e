//! The cube by Dop853 of the crate `ode_solvers`, which takes the compiled right-hand side of `cube.c`.
//!
//!     peer-ode-solvers REFERENCE
//!
//! Input and output as of `sundials.c`.

use ode_solvers::dop_shared::OutputType;
use ode_solvers::{Dop853, SVector, System};
use std::ffi::{CStr, c_char, c_int, c_long};

const RULES: usize = 3;
/// With the feature `affine` the soft cube, else the rigid one.
const SIZE: usize = if cfg!(feature = "affine") { 24 } else { 13 };
type State = SVector<f64, SIZE>;

unsafe extern "C" {
    static cube_rule_names: [*const c_char; RULES];
    fn cube_choose(rule: c_int);
    fn cube_start(y: *mut f64);
    fn cube_rates(t: f64, y: *const f64, dy: *mut f64) -> c_int;
    fn cube_calls() -> c_long;
    fn cube_seconds() -> f64;
}

struct Cube;

impl System<f64, State> for Cube {
    fn system(&self, t: f64, y: &State, dy: &mut State) {
        // SAFETY: both hold the SIZE numbers that the function reads and writes.
        unsafe { cube_rates(t, y.as_ptr(), dy.as_mut_ptr()) };
    }
}

/// The state at t = 10; `None` where the solver gives up.
fn solve(rtol: f64) -> Option<State> {
    let mut start = State::zeros();
    // SAFETY: it writes SIZE numbers.
    unsafe { cube_start(start.as_mut_ptr()) };
    let mut solver = Dop853::new(Cube, 0.0, 10.0, 10.0, start, rtol, rtol);
    solver.set_output(OutputType::Sparse);
    solver.integrate().ok()?;
    solver.y_out().last().copied()
}

fn measure(rule: &str, rtol: f64, reference: &State) {
    let (mut fastest, mut spent, mut calls, mut error) = (f64::INFINITY, 0.0, 0, f64::NAN);
    let mut runs = 0;
    while runs < 3 || (runs < 25 && spent < 1.0) {
        // SAFETY: the one resets a counter, the other reads a clock.
        let start = unsafe {
            cube_calls();
            cube_seconds()
        };
        let end = solve(rtol);
        let took = unsafe { cube_seconds() } - start;
        calls = unsafe { cube_calls() };
        error = end.map_or(f64::NAN, |end| (end - reference).amax());
        (fastest, spent, runs) = (took.min(fastest), spent + took, runs + 1);
    }
    println!("ode_solvers-Dop853 {rule} {rtol:.0e} {error:.3e} {:.4} {calls}", 1e3 * fastest);
}

fn main() {
    let path = std::env::args().nth(1).expect("usage: peer-ode-solvers REFERENCE");
    let text = std::fs::read_to_string(path).expect("the reference");
    for (rule, line) in text.lines().enumerate() {
        let reference = State::from_iterator(line.split_whitespace().map(|word| word.parse().expect("a number")));
        // SAFETY: the library holds RULES names, each ended by 0.
        let name = unsafe {
            cube_choose(rule as c_int);
            CStr::from_ptr(cube_rule_names[rule])
        };
        for exponent in 4..=13 {
            measure(&name.to_string_lossy(), 10_f64.powi(-exponent), &reference);
        }
    }
}
