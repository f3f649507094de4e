//! Work on a scene that may take no longer than a run of it.

use gyration_scene::Scene;
use gyration_threads::Interruption;

/// Does some work, which is given up after the `solver.max_wall_time` of a scene.
pub fn within_wall_time<T>(scene: &Scene, work: impl FnOnce() -> T) -> T {
    Interruption::in_force().after(scene.built().plan.wall_time()).within(work)
}
