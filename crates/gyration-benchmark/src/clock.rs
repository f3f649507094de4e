//! The time that work takes on a processor.

use std::sync::OnceLock;
use std::time::Instant;

/// The time that this thread has spent on a processor [s]; wall time where the system does not tell.
///
/// On a machine shared with others, wall time says little.
pub fn processor_seconds() -> f64 {
    static BEGIN: OnceLock<Instant> = OnceLock::new();
    let begin = BEGIN.get_or_init(Instant::now);
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = told.and_then(|text| text.split_whitespace().next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(|| begin.elapsed().as_secs_f64(), |count| 1e-9 * count)
}

/// The processor time of one call \[s\]: the fastest of five batches, each long enough for the clock, which may tick
/// only every few milliseconds.
pub fn seconds_each(work: impl FnMut()) -> f64 {
    seconds_in_batches(0.2, work)
}

/// The same in batches of so many seconds.
pub(crate) fn seconds_in_batches(batch: f64, mut work: impl FnMut()) -> f64 {
    let mut time = |count: u32| {
        let begin = processor_seconds();
        (0..count).for_each(|_| work());
        (processor_seconds() - begin) / f64::from(count)
    };
    let mut count = 1;
    while time(count) * f64::from(count) < batch {
        count *= 2;
    }
    (0..5).map(|_| time(count)).fold(f64::INFINITY, f64::min)
}
