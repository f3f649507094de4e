//! Bodies that pass one another: where their force is largest there is a look at it.
//!
//!   g₁ = g₀ − (|Δp(0)| − |Δp(t₁)|),   t₁ = −Δp·Δṗ/|Δṗ|²
//!
//! A free body that does not turn goes straight, and a stepper that looks at the force nowhere but far from another is
//! in no doubt. So a step ends at the time t₁ at which the centres are nearest, if what the two do to each other at the
//! gap g₁ there matters: the last look of a step is at its end. A pair that is already about as near as it comes is
//! seen as it is. Of long bodies, whose gap is least elsewhere, this sees less.

use super::approach::Approach;
use super::step_end::StepEnd;
use gyration::model::Model;
use gyration::neighbours::Pair;

/// What two do to each other where they are nearest matters if its work over the gap may be more than this part of the
/// energy of their motion past each other.
const MATTERS: f64 = 1e-9;
/// A pair this many times as far apart as where it is nearest is not seen as it is there.
const FARTHER: f64 = 1.5;

/// The time [s] at which two bodies are nearest to each other, at most `longest`, where a step ought to end.
pub(super) fn until_nearest(model: &Model, pair: &Pair, ends: [&StepEnd; 2], gap: f64, longest: f64) -> f64 {
    let approach = Approach::of(ends[0], ends[1]);
    let time = approach.nearest(longest);
    if time <= 0.0 || time >= longest {
        return longest;
    }
    // Faces that slide along one another keep their gap, or lose less of it.
    let least = gap - (approach.straight(0.0) - approach.straight(time));
    if gap <= FARTHER * least {
        return longest;
    }
    let solids = pair.parties.map(|party| model.solid_of(party));
    let [Some(one), Some(other)] = solids else { return longest };
    let surfaces = [one.part(pair.parts[0]), other.part(pair.parts[1])];
    let masses =
        pair.parties.map(|party| party.body().map_or(f64::INFINITY, |body| model.bodies[body].solid.mass.mass));
    let reduced = (masses[0].recip() + masses[1].recip()).recip();
    let speed = approach.speed();
    let kinetic = 0.5 * reduced * speed * speed;
    let matters = least <= 0.0 || pair.form.most_work(least, speed, surfaces) > MATTERS * kinetic;
    if matters { time } else { longest }
}
