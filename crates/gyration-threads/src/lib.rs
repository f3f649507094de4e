//! Threads: the one way to do many jobs, and work whose parts are shared out by rayon.
//!
//! [`share`] hands out jobs one by one and their results to the thread that asked, which looks around in between: at
//! signals, at a disk that is full. [`in_order`] is the same for results that are wanted all together.
//! [`each_on_threads`] is for jobs that take some microseconds, [`with_threads_at_hand`] for work that has many of
//! them. [`on_own_threads`] is for rayon in a process that may have been forked. Which thread does what leaves no trace
//! in any result. An [`Interruption`] says when to give up what takes long.

mod count;
mod interruption;
mod own;
mod share;
mod team;

pub use count::{Threads, processors};
pub use interruption::{Interrupted, Interruption};
pub use own::on_own_threads;
pub use share::{in_order, share};
pub use team::{each_on_threads, with_threads_at_hand};
