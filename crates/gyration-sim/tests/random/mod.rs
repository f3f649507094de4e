//! Random admissible scenes, and what each owes.

pub mod laws;
pub mod meetings;
pub mod scene;
pub mod shapes;
pub mod stream;
pub mod verdict;
