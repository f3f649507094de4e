//! Benchmarks of Gyration: `benches/`; the bodies that they move are those of `gyration-benchmark`.

#![forbid(unsafe_code)]
