//! Giving up what takes long: whoever begins it says when, whoever computes asks now and then.
//!
//! The interruption in force belongs to the thread, so that nothing between the two need know of it: a model, a rate
//! and a matrix are the same whether anybody waits for them or not. Work that is shared out takes it along
//! ([`Interruption::in_force`]).

use crate::count::THERE_ARE_THREADS;
use std::cell::RefCell;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// When to give up: once a flag is raised, or after a time.
#[derive(Debug, Clone, Default)]
pub struct Interruption {
    flags: Vec<Arc<AtomicBool>>,
    deadline: Option<Instant>,
}

/// Why to give up.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Interrupted {
    /// Somebody asked for it.
    Raised,
    /// It has taken too long.
    Overdue,
}

thread_local! {
    static IN_FORCE: RefCell<Interruption> = RefCell::default();
}

impl Interruption {
    /// The one in force on this thread.
    pub fn in_force() -> Self {
        IN_FORCE.with_borrow(Self::clone)
    }

    /// Whether to give up by the one in force on this thread, and why.
    pub fn due() -> Option<Interrupted> {
        IN_FORCE.with_borrow(Self::is_due)
    }

    /// Besides, once this flag is raised.
    #[must_use]
    pub fn raised_by(mut self, flag: Arc<AtomicBool>) -> Self {
        self.flags.push(flag);
        self
    }

    /// Besides, after so long from now, if that is given.
    #[must_use]
    pub fn after(mut self, most: Option<Duration>) -> Self {
        // What no clock can tell never comes.
        let most = most.filter(|_| THERE_ARE_THREADS);
        let deadline = most.and_then(|most| Instant::now().checked_add(most));
        self.deadline = self.deadline.into_iter().chain(deadline).min();
        self
    }

    /// The same, however long it takes.
    #[must_use]
    pub fn however_long(mut self) -> Self {
        self.deadline = None;
        self
    }

    /// Whether to give up, and why.
    pub fn is_due(&self) -> Option<Interrupted> {
        if self.flags.iter().any(|flag| flag.load(Ordering::Relaxed)) {
            return Some(Interrupted::Raised);
        }
        let is_over = self.deadline.is_some_and(|deadline| Instant::now() >= deadline);
        is_over.then_some(Interrupted::Overdue)
    }

    /// Does some work while this one is in force.
    pub fn within<T>(&self, work: impl FnOnce() -> T) -> T {
        let _before = Before(IN_FORCE.replace(self.clone()));
        work()
    }
}

/// What was in force before, and is again when this goes.
struct Before(Interruption);

impl Drop for Before {
    fn drop(&mut self) {
        IN_FORCE.set(std::mem::take(&mut self.0));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::panic::{AssertUnwindSafe, catch_unwind};

    #[test]
    fn flag_and_time_interrupt_what_is_done_within_and_nothing_else() {
        let flag = Arc::new(AtomicBool::new(false));
        let flagged = Interruption::in_force().raised_by(flag.clone());
        flagged.within(|| {
            assert_eq!(Interruption::due(), None);
            flag.store(true, Ordering::Relaxed);
            assert_eq!(Interruption::due(), Some(Interrupted::Raised));
            assert_eq!(std::thread::spawn(Interruption::due).join().unwrap(), None);
        });
        assert_eq!(Interruption::due(), None);
        let late = Interruption::in_force().after(Some(Duration::ZERO));
        assert_eq!(late.within(Interruption::due), Some(Interrupted::Overdue));
        assert_eq!(late.however_long().within(Interruption::due), None);
    }

    #[test]
    fn the_earlier_of_two_times_counts() {
        let outer = Interruption::default().after(Some(Duration::ZERO));
        let inner = outer.within(|| Interruption::in_force().after(Some(Duration::from_secs(3600))));
        assert_eq!(inner.is_due(), Some(Interrupted::Overdue));
    }

    #[test]
    fn what_was_in_force_before_is_so_again_even_after_a_panic() {
        let late = Interruption::default().after(Some(Duration::ZERO));
        let caught = catch_unwind(AssertUnwindSafe(|| late.within(|| panic!("within"))));
        assert!(caught.is_err());
        assert_eq!(Interruption::due(), None);
    }
}
