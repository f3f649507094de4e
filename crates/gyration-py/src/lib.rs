//! The Python package `gyration`: the engine for NumPy, notebooks and control loops.
//!
//! ```text
//! Scene ─→ run → Recording → arrays, xarray, pandas, fields, spectrum, Picture, report
//!      ├─→ Simulation: step, look, apply, step
//!      ├─→ Batch: many simulations at once
//!      ├─→ run_many → Runs: arrays of endings
//!      ├─→ study → Table: rows of thousands of runs
//!      └─→ modes, bands, continuum, orbit, resistance, sensitivities
//! measurements ─→ calibrate → Fit: numbers of a scene, their errors
//! ```
//!
//! A binding and nothing else: what is computed, said or drawn comes from the crates of the workspace, in the words and
//! bytes of the program. The interpreter's lock is released while the engine computes. The documentation that a user
//! reads stands in `python/gyration/_gyration.pyi` and `__init__.py`.

mod arrays;
mod bands;
mod batch;
mod calibration;
mod control_loop;
mod convert;
mod errors;
mod load;
mod many;
mod medium;
mod members;
mod modes;
mod monitor;
mod parcel;
mod picture;
mod recording;
mod resistance;
mod run;
mod saved;
mod scene;
mod sensitivities;
mod simulation;
mod start;
mod study;
mod table;
mod worker;

use pyo3::prelude::*;
use std::ffi::OsString;

/// The extension module.
#[pymodule]
mod _gyration {
    #[pymodule_export]
    use super::bands::bands;
    #[pymodule_export]
    use super::batch::Batch;
    #[pymodule_export]
    use super::calibration::{Fit, calibrate};
    #[pymodule_export]
    use super::control_loop::simulate;
    #[pymodule_export]
    use super::convert::says_stop;
    #[pymodule_export]
    use super::many::{Runs, run_many};
    #[pymodule_export]
    use super::medium::{continuum, fields, orbit, spectrum};
    #[pymodule_export]
    use super::modes::modes;
    #[pymodule_export]
    use super::picture::Picture;
    #[pymodule_export]
    use super::program;
    #[pymodule_export]
    use super::recording::Recording;
    #[pymodule_export]
    use super::resistance::resistance;
    #[pymodule_export]
    use super::scene::{Scene, scene_again, scenes};
    #[pymodule_export]
    use super::sensitivities::sensitivities;
    #[pymodule_export]
    use super::simulation::{Simulation, simulation_again};
    #[pymodule_export]
    use super::study::{Lock, StudyWork};
    #[pymodule_export]
    use super::table::{Table, studies};
    #[pymodule_export]
    use super::worker::study_rows;

    #[pymodule_export]
    #[expect(non_upper_case_globals, reason = "the name that Python knows")]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}

/// The program `gyration` with these arguments; its exit code.
#[pyfunction]
#[pyo3(name = "_main")]
fn program(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| gyration_cli::run(arguments))
}
