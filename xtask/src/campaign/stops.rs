//! Stops of a run on its way, of both kinds: killed, and interrupted as by ^C.

use super::stream::Stream;
use std::time::Duration;

/// The most stops of a run.
const MOST_STOPS: usize = 4;
/// The most threads of what is resumed.
const MOST_THREADS: usize = 7;

/// How a run is stopped.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stopped {
    /// At once: it can do nothing about it.
    Killed,
    /// It is asked to end, and says what there is.
    Interrupted,
}

/// When a run was stopped.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Moment {
    /// Before there was a recording.
    BeforeItBegan,
    /// On its way.
    OnItsWay,
    /// It had ended.
    TooLate,
}

/// A stop that is planned.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlannedStop {
    /// How.
    pub how: Stopped,
    /// So long after the program was started.
    pub after: Duration,
    /// Threads of the part of the run that it ends.
    pub threads: usize,
}

/// Some stops of a run that takes so long without one: at any time the first, the others sooner and sooner.
pub fn planned(stream: &mut Stream, wall: Duration) -> Vec<PlannedStop> {
    let count = 1 + stream.index(MOST_STOPS);
    let stop = |k: usize| PlannedStop {
        how: stream.pick(&[Stopped::Killed, Stopped::Interrupted]),
        after: wall.mul_f64(stream.unit() / (k + 1) as f64),
        threads: threads(stream),
    };
    (0..count).map(stop).collect()
}

/// A number of threads.
pub fn threads(stream: &mut Stream) -> usize {
    1 + stream.index(MOST_THREADS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stops_of_both_kinds_come_within_the_run() {
        let mut stream = Stream::of(1, 1);
        let wall = Duration::from_secs(1);
        let stops: Vec<PlannedStop> = (0..50).flat_map(|_| planned(&mut stream, wall)).collect();
        assert!(stops.iter().all(|stop| stop.after <= wall && (1..=MOST_THREADS).contains(&stop.threads)));
        for how in [Stopped::Killed, Stopped::Interrupted] {
            assert!(stops.iter().filter(|stop| stop.how == how).count() > stops.len() / 4);
        }
    }
}
