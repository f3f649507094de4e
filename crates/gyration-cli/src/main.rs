//! The program `gyration`.
fn main() {}
