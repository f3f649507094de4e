//! Defaults that are asked for in more than one place.

/// g [m/s²].
pub(crate) const GRAVITY: [f64; 3] = [0.0, 0.0, -9.81];
