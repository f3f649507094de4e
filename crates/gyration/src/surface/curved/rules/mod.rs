//! Quadrature for smooth primitives: where the nodes are, and what is summed over them.
//!
//! A kernel is evaluated by `integrand`, a group of nodes at a time. `graded` has Gauss's rules, graded to a
//! singularity; `ring` and `own_ring` go around a circle, which `closed_circle` does without nodes; `features`, `polar`
//! and `parallels` over the parallels of an ellipsoid, `rulings` and `weighted_rulings` along the lines of a wall, and
//! `points` over any points. `weight` is what a deformed element counts with.

pub(super) mod closed_circle;
pub(super) mod features;
pub(super) mod graded;
pub(super) mod integrand;
pub(super) mod own_ring;
pub(super) mod parallels;
pub(super) mod points;
pub(super) mod polar;
pub(super) mod ring;
pub(super) mod rulings;
pub(super) mod weight;
pub(super) mod weighted_rulings;
