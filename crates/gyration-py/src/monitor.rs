//! Monitors a run from Python: Ctrl-C, and whoever wants to know how far it is.
//!
//! The run computes without the interpreter's lock; ten times a second it is taken for a moment, to look at signals and
//! to tell of progress. An exception of the callback, and KeyboardInterrupt, stop the run at the end of a step, or
//! within one that computes a matrix for long, and are raised when the recording has been closed.

use crate::convert::{says_stop, shown};
use gyration_sim::{Monitor, Progress, Reason};
use gyration_study::{StudyMonitor, StudyProgress};
use gyration_threads::Interruption;
use pyo3::prelude::*;
use pyo3::types::PyBool;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::{Duration, Instant};

/// How often Python is asked.
const EVERY: Duration = Duration::from_millis(100);
/// How often signals are looked at while another thread works.
const GLANCE: Duration = Duration::from_millis(50);

/// The monitor of a run, or of many.
pub struct PythonMonitor {
    listener: Listener,
    asked: Instant,
    /// Of what it tells the end, if not of the part that is under way [s].
    end: Option<f64>,
    /// Whether what it tells are numbers of runs, not times.
    counts: bool,
    /// Whether somebody wanted no more.
    is_over: bool,
    /// What Python raised.
    raised: Option<PyErr>,
}

/// Does work that knows nothing of Python, without the lock and on a thread of its own, while this one looks at
/// signals. An interruption gives the work up, and what Python raised is raised when it has ended.
pub fn interruptibly<T: Send>(py: Python<'_>, work: impl FnOnce() -> T + Send) -> PyResult<T> {
    let flag = Arc::new(AtomicBool::new(false));
    let interruption = Interruption::in_force().raised_by(flag.clone());
    let mut raised = None;
    let done = py.detach(|| {
        thread::scope(|scope| {
            // Nothing is sent: the end of the work ends the channel.
            let (working, over) = channel::<()>();
            let worker = scope.spawn(move || {
                let _working = working;
                interruption.within(work)
            });
            while over.recv_timeout(GLANCE) == Err(RecvTimeoutError::Timeout) {
                if let Err(error) = Python::attach(|py| py.check_signals()) {
                    flag.store(true, Ordering::Relaxed);
                    raised.get_or_insert(error);
                }
            }
            worker.join()
        })
    });
    match (raised, done) {
        (Some(error), _) => Err(error),
        (None, Ok(done)) => Ok(done),
        (None, Err(panic)) => std::panic::resume_unwind(panic),
    }
}

/// Lets a run go on a thread of its own, while this one, without the lock, answers for it and looks at signals. An
/// interruption gives up also what a step computes for long.
pub fn watched<T: Send>(monitor: &mut PythonMonitor, run: impl FnOnce(&mut Asker) -> T + Send) -> T {
    let flag = Arc::new(AtomicBool::new(false));
    let interruption = Interruption::in_force().raised_by(flag.clone());
    let ended = thread::scope(|scope| {
        let (questions, asked) = channel();
        let (answers, answered) = channel();
        let runner = scope.spawn(move || {
            let mut asker = Asker { questions, answered, asked: Instant::now() };
            interruption.within(|| run(&mut asker))
        });
        loop {
            let goes_on = match asked.recv_timeout(GLANCE) {
                Ok((time, end)) => {
                    let goes_on = monitor.answer(time, end);
                    // Whoever asked waits for it.
                    let _ = answers.send(goes_on);
                    goes_on
                }
                Err(RecvTimeoutError::Timeout) => monitor.glance(),
                Err(RecvTimeoutError::Disconnected) => break,
            };
            if !goes_on {
                flag.store(true, Ordering::Relaxed);
            }
        }
        runner.join()
    });
    ended.unwrap_or_else(|panic| std::panic::resume_unwind(panic))
}

/// Asks the thread that watches.
pub struct Asker {
    questions: Sender<(f64, f64)>,
    answered: Receiver<bool>,
    asked: Instant,
}

impl Monitor for Asker {
    fn after_step(&mut self, progress: &Progress) -> Option<Reason> {
        if self.asked.elapsed() < EVERY {
            return None;
        }
        let asked = self.questions.send((progress.time, progress.end));
        let goes_on = asked.is_ok() && self.answered.recv() == Ok(true);
        self.asked = Instant::now();
        (!goes_on).then_some(Reason::Interrupted)
    }
}

/// Who wants to know how far a run is.
enum Listener {
    Nobody,
    /// A line on Python's stderr.
    Line,
    Callback(Py<PyAny>),
}

impl PythonMonitor {
    /// From what a user gives for `progress`: None, True, or a callable of (time, end), or of (runs done, runs in all).
    pub fn new(progress: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let listener = match progress {
            None => Listener::Nobody,
            Some(flag) if flag.is_instance_of::<PyBool>() => match flag.extract()? {
                true => Listener::Line,
                false => Listener::Nobody,
            },
            Some(callback) if callback.is_callable() => Listener::Callback(callback.clone().unbind()),
            Some(other) => {
                let problem =
                    format!("`progress` is {}\n  fix: give True, or a function of time and end", shown(other));
                return Err(crate::errors::arguments(problem));
            }
        };
        Ok(Self { listener, asked: Instant::now(), end: None, counts: false, is_over: false, raised: None })
    }

    /// One that watches the parts of something that ends then [s].
    pub fn until(self, end: f64) -> Self {
        Self { end: Some(end), ..self }
    }

    /// One that watches how many runs are done.
    pub fn of_runs(self) -> Self {
        Self { counts: true, ..self }
    }

    /// Looks at signals, and tells that it is at `time` of `end`; whether to go on. Who wanted no more is not asked
    /// again.
    pub fn ask(&mut self, time: f64, end: f64) -> bool {
        if self.is_over {
            return false;
        }
        self.asked.elapsed() < EVERY || self.answer(time, end)
    }

    /// The same at once.
    fn answer(&mut self, time: f64, end: f64) -> bool {
        self.over_unless(|py, monitor| {
            py.check_signals()?;
            monitor.tell(py, time, end)
        })
    }

    /// Looks at signals; whether to go on.
    fn glance(&mut self) -> bool {
        self.over_unless(|py, _| py.check_signals().map(|()| true))
    }

    /// Whether to go on: nobody has wanted no more, and Python, which is asked with the lock held, says so.
    fn over_unless(&mut self, ask: impl FnOnce(Python<'_>, &Self) -> PyResult<bool>) -> bool {
        if self.is_over {
            return false;
        }
        let answer = Python::attach(|py| ask(py, self));
        self.asked = Instant::now();
        let goes_on = answer.unwrap_or_else(|error| {
            self.raised = Some(error);
            false
        });
        self.is_over |= !goes_on;
        goes_on
    }

    /// Whether somebody wanted no more, though it may have been at the end of the last step.
    pub fn is_over(&self) -> bool {
        self.is_over
    }

    fn tell(&self, py: Python<'_>, time: f64, end: f64) -> PyResult<bool> {
        match &self.listener {
            Listener::Nobody => Ok(true),
            Listener::Line => {
                let done = 100.0 * time / end;
                let line = match self.counts {
                    true => format!("\r{done:3.0} %  {time} of {end} runs "),
                    false => format!("\r{done:3.0} %  t = {time:.4} of {end} s "),
                };
                py.import("sys")?.getattr("stderr")?.call_method1("write", (line,))?;
                Ok(true)
            }
            Listener::Callback(callback) => Ok(!says_stop(&callback.bind(py).call1((time, end))?)?),
        }
    }

    /// Ends the line; raises what Python raised meanwhile.
    pub fn finish(self, py: Python<'_>) -> PyResult<()> {
        if matches!(self.listener, Listener::Line) {
            py.import("sys")?.getattr("stderr")?.call_method1("write", ("\r\x1b[K",))?;
        }
        self.raised.map_or(Ok(()), Err)
    }
}

impl StudyMonitor for PythonMonitor {
    fn after_rows(&mut self, progress: &StudyProgress) -> bool {
        !self.ask(progress.done as f64, progress.total as f64)
    }
}

impl Monitor for PythonMonitor {
    fn after_step(&mut self, progress: &Progress) -> Option<Reason> {
        (!self.ask(progress.time, self.end.unwrap_or(progress.end))).then_some(Reason::Interrupted)
    }
}
