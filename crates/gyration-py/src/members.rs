//! Members of a batch: which are meant, and work on them on many threads.

use crate::convert::shown;
use crate::errors;
use crate::many::Together;
use crate::monitor::PythonMonitor;
use gyration_sim::SteppedRun;
use gyration_threads::{Interruption, share};
use pyo3::prelude::*;
use std::num::NonZeroUsize;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// The members, of so many, that numbers or a mask mean; all if there is neither.
pub fn chosen(members: Option<&Bound<'_, PyAny>>, count: usize) -> PyResult<Vec<usize>> {
    let Some(members) = members else { return Ok((0..count).collect()) };
    let read = || -> PyResult<Vec<usize>> {
        let array = members.py().import("numpy")?.call_method1("asarray", (members,))?.call_method0("tolist")?;
        match array.extract::<Vec<bool>>() {
            Ok(mask) if mask.len() == count => Ok((0..count).filter(|member| mask[*member]).collect()),
            // A mask of another length is none, though booleans are numbers too.
            Ok(mask) if !mask.is_empty() => Ok(vec![count]),
            _ => array.extract(),
        }
    };
    let mut is_new = vec![true; count];
    let fits = |found: &Vec<usize>| found.iter().all(|member| is_new.get_mut(*member).is_some_and(std::mem::take));
    read().ok().filter(fits).ok_or_else(|| {
        let problem = format!("`members` is {}", shown(members));
        errors::arguments(format!(
            "{problem}\n  fix: give numbers from 0 to {}, each once, or {count} booleans",
            count - 1
        ))
    })
}

/// Does work on these members on so many threads, while this one looks at signals: what comes of each, in their order.
/// An interruption of Python ends what is under way at the end of a step.
pub fn on_threads<T: Send>(
    members: &mut [SteppedRun],
    which: &[usize],
    threads: NonZeroUsize,
    monitor: &mut PythonMonitor,
    work: impl Fn(usize, &mut SteppedRun, &mut Together<'_>) -> T + Sync,
) -> Vec<T> {
    let stop = Arc::new(AtomicBool::new(false));
    let interruption = Interruption::in_force().raised_by(stop.clone());
    let mut places = vec![None; members.len()];
    which.iter().enumerate().for_each(|(place, member)| places[*member] = Some(place));
    let jobs = members.iter_mut().zip(places).filter_map(|(run, place)| Some((place?, run)));
    let mut done: Vec<Option<T>> = which.iter().map(|_| None).collect();
    let count = which.len() as f64;
    // Each is begun, even if all are to stop: one that has not is at the end of a step too.
    let never = AtomicBool::new(false);
    let one = |(place, run): (usize, &mut SteppedRun)| {
        Some((place, interruption.within(|| work(place, run, &mut Together(&stop)))))
    };
    share(jobs, threads, &never, one, |ended| {
        for (place, came) in ended {
            done[place] = Some(came);
        }
        if !monitor.ask(0.0, count) {
            stop.store(true, Ordering::Relaxed);
        }
    });
    done.into_iter().flatten().collect()
}
