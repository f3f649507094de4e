//! How long two bodies that meet stay apart by a bound on the motion of both: each stays on its side of a plane.
//!
//! Any plane will do at any time, so that its normal may turn: n(t) with a constant ω. In axes that turn with it about
//! A's centre, with r = p_B − p_A, a velocity w, a rate W and the accelerations are
//!
//!   w' = w − ω × (p − p_A),   W' = W − [ω]× P,   P̈' = P̈ − 2 [ω]× W' − [ω]×² P,
//!   −r̈' = p̈_A − p̈_B + 2 ω × ṙ' + ω × (ω × r)
//!
//! and the axis of what the spin ω_i differs from ω is carried round, by which a point comes nearer with no more than
//! r_i |n × (ω_i × ω)|. The rest of second order draws points to the axis, as it does before a plane that stands still.
//!
//! A face along which an edge slides takes its plane along: with a plane that stands still its far end would soon be on
//! the other side. So planes are tried that stand still, turn with A, and turn with B; the longest of these times
//! holds.

use crate::island::approach::Approach;
use crate::island::plane_approach::{PART, PlaneApproach, TURN, first_root};
use crate::island::step_end::StepEnd;
use gyration::kinematics::Placement;
use gyration::model::Model;
use gyration::neighbours::Pair;
use gyration::surface::{GapField, Surface};
use gyration::tensor::{Vec3, cross_matrix};

/// The motion of two bodies towards each other.
pub(crate) struct PairApproach<'a> {
    ends: [&'a StepEnd; 2],
    surfaces: [&'a Surface; 2],
    radii: [f64; 2],
    /// ω_A and ω_B [rad/s].
    spins: [Vec3; 2],
    /// Whether P̈ is known along each direction: of a body that deforms, as seen from a support that turns, its size
    /// is.
    may_turn: bool,
    /// From B to A.
    normal: Vec3,
    /// How much more B may accelerate towards A [m/s²].
    bend: f64,
    centers: Approach,
}

impl<'a> PairApproach<'a> {
    /// The second may accelerate towards the first by `bend` besides [m/s²].
    pub fn of(
        model: &'a Model,
        pair: &Pair,
        (ends, bend): ([&'a StepEnd; 2], f64),
        radii: &[f64],
        normal: &Vec3,
    ) -> Self {
        let solids =
            pair.parties.map(|party| model.solid_of(party).unwrap_or_else(|| unreachable!("a pair is between solids")));
        let radius = |side: usize| match pair.parties[side].body() {
            Some(body) => radii[body],
            None => solids[side].radius().unwrap_or(0.0),
        };
        Self {
            ends,
            surfaces: [0, 1].map(|side| solids[side].part(pair.parts[side])),
            radii: [0, 1].map(radius),
            spins: ends.map(|end| end.motion.angular_velocity()),
            may_turn: bend == 0.0 || ends.iter().all(|end| end.stretching.is_none()),
            normal: *normal,
            bend,
            centers: Approach::of(ends[0], ends[1]).bent_more(bend),
        }
    }

    /// The longest step [s] that this approach allows, at most `longest`, or one that allows the `usual` one.
    pub fn time(&self, usual: f64, longest: f64) -> f64 {
        let standing = self.halves(&Vec3::zeros());
        let clear = PART * self.clear(&standing, longest);
        if clear >= longest {
            return longest;
        }
        let turning = TURN / standing[0].spin.max(standing[1].spin);
        let straight = |[one, other]: &[PlaneApproach; 2]| {
            let apart = PART * first_root(longest / PART, |t| one.smallest_gap(t) + other.smallest_gap(t));
            // As seen from a plane that turns they turn otherwise.
            apart.min(turning).min(TURN / one.spin.max(other.spin)).min(longest)
        };
        let mut step = clear.max(straight(&standing));
        for spin in self.spins.iter().filter(|_| self.may_turn) {
            if usual > 0.0 && step >= usual.min(longest) {
                break;
            }
            step = step.max(straight(&self.halves(spin)));
        }
        step
    }

    /// Towards a plane whose normal turns with a velocity ω [rad/s].
    fn halves(&self, turning: &Vec3) -> [PlaneApproach<'a>; 2] {
        let [one, other] = self.ends;
        let across = cross_matrix(turning);
        let place = other.motion.placement.position - one.motion.placement.position;
        let velocity = other.motion.velocity.velocity - one.motion.velocity.velocity - across * place;
        // A sees all of the acceleration, as if B had none.
        let relative = one.acceleration - other.acceleration + across * (2.0 * velocity + across * place);
        let accelerations = [relative, Vec3::zeros()];
        let mut swerves = [0.0; 2];
        let mut halves = [0, 1].map(|side| {
            let normal = if side == 0 { self.normal } else { -self.normal };
            let mut end = *self.ends[side];
            let Placement { position, gradient } = end.motion.placement;
            end.motion.velocity.velocity -= across * (position - one.motion.placement.position);
            end.motion.velocity.gradient_rate -= across * gradient;
            let rate = end.motion.velocity.gradient_rate;
            swerves[side] = normal.cross(&self.spins[side].cross(turning)).norm() * self.radii[side];
            end.stretching = end.stretching.map(|bent| bent - across * (2.0 * rate + across * gradient));
            // The gaps of both count in sum: the plane may pass anywhere.
            let field = GapField::new(position.dot(&normal), gradient.tr_mul(&normal));
            PlaneApproach::along(
                &normal,
                (&end, &accelerations[side]),
                (self.surfaces[side], self.radii[side]),
                (field, end.motion.velocity.velocity),
            )
        });
        halves[0].acceleration += self.bend;
        for (half, swerve) in halves.iter_mut().zip(swerves) {
            half.acceleration += swerve;
        }
        halves
    }

    /// The time for which the spheres around the two stay apart [s], at most a part more than `longest`.
    ///
    /// Behind the time at which they are nearest it is doubled while they are apart, whatever `longest` is.
    fn clear(&self, halves: &[PlaneApproach; 2], longest: f64) -> f64 {
        let within = longest / PART;
        let radii = |t: f64| halves.iter().map(|half| half.radius + t * half.growth).sum::<f64>();
        let apart = |t: f64| self.centers.distance(t) - radii(t);
        let nearest = self.centers.nearest(within);
        if apart(nearest) <= 0.0 {
            return first_root(nearest, apart);
        }
        let bent = first_root(within, |t| self.centers.bound(nearest, t) - radii(t));
        let mut clear = bent.max(nearest);
        while clear < within && clear > 0.0 && apart(2.0 * clear) > 0.0 {
            clear *= 2.0;
        }
        clear.min(within)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::island::step_end;
    use gyration::dynamics::{Workspace, rates};
    use gyration_scene::Scene;
    use nalgebra::{Quaternion, UnitQuaternion};
    use proptest::prelude::*;

    /// Two cubes, whose spin stays what it is, with a force between them that they hardly feel.
    fn cubes(place: Vec3, velocities: [Vec3; 2], spins: [Vec3; 2]) -> Scene {
        let body = |name: &str, place: Vec3, velocity: Vec3, spin: Vec3| {
            let list = |v: Vec3| format!("[{}, {}, {}]", v.x, v.y, v.z);
            format!(
                "[[body]]\nname = \"{name}\"\nshape = {{ box = {{ size = [0.1, 0.1, 0.1] }} }}\nmass = 1.0\n\
                 position = {}\nvelocity = {}\nangular_velocity = {}\n",
                list(place),
                list(velocity),
                list(spin)
            )
        };
        let text = format!(
            "world = {{ gravity = [0, 0, 0] }}\ntime = {{ end = 1, sample = 1 }}\n\
             [[contact]]\nbetween = [\"one\", \"other\"]\nrepulsion = {{ alpha = 1e-9, nu = 6, d0 = 1e-6 }}\n{}{}",
            body("one", Vec3::zeros(), velocities[0], spins[0]),
            body("other", place, velocities[1], spins[1])
        );
        Scene::parse("cubes.toml", &text, std::path::Path::new(""), &[]).unwrap()
    }

    /// The bound of the two cubes at the start, and that with a plane that stands still.
    fn bounds(scene: &Scene, longest: f64) -> (f64, f64) {
        let (model, start) = (&scene.built().model, &scene.built().state);
        let (mut slopes, mut powers) = (vec![0.0; model.dimension()], vec![0.0; model.works().len()]);
        let mut workspace = Workspace::default();
        rates(model, &mut workspace, 0.0, start.numbers(), &mut slopes, &mut powers).unwrap();
        let mut ends = Vec::new();
        step_end::read(&mut ends, model, &start.bodies, &slopes);
        let gaps = workspace.pair_gaps(model, 0.0, start.numbers()).unwrap();
        let (pair, slab) = gaps.iter().next().unwrap();
        let radii = [0.1 * 0.75f64.sqrt(); 2];
        let approach = PairApproach::of(model, pair, ([&ends[0], &ends[1]], 0.0), &radii, &slab.normal);
        // A usual step that is short is allowed by the first plane, or by none.
        (approach.time(0.0, longest), approach.time(f64::MIN_POSITIVE, longest))
    }

    /// Whether the cubes are apart a time after the start.
    fn are_apart(scene: &Scene, time: f64) -> bool {
        let model = &scene.built().model;
        let mut state = scene.built().state.clone();
        for body in 0..2 {
            let slots = model.slots(body);
            let motion = gyration::state::Turn::read(slots, &state.bodies);
            let turn = UnitQuaternion::from_scaled_axis(motion.spin * time).into_inner();
            let q: Vec<f64> = state.bodies[slots.attitude()].to_vec();
            let turned = Quaternion::new(q[0], q[1], q[2], q[3]) * turn;
            state.bodies[slots.attitude()].copy_from_slice(&[turned.w, turned.i, turned.j, turned.k]);
            let (places, velocity) = (slots.position(), slots.velocity());
            for (place, velocity) in places.zip(velocity) {
                state.bodies[place] += time * state.bodies[velocity];
            }
        }
        Workspace::default().pair_gaps(model, time, state.numbers()).is_ok()
    }

    #[test]
    fn a_plane_that_turns_with_a_face_allows_two_that_turn_together_what_one_that_stands_does_not() {
        let spin = Vec3::new(0.0, 10.0, 0.0);
        let place = Vec3::new(0.1001, 0.0, 0.02);
        let scene = cubes(place, [Vec3::zeros(), spin.cross(&place)], [spin; 2]);
        let (turning, standing) = bounds(&scene, 1.0);
        // The face that stands still is crossed by a corner after 1e-4 m/(10/s · 0.06 m).
        assert!(standing < 2e-4 && turning > 20.0 * standing, "{turning} {standing}");
    }

    fn vector(size: f64) -> impl Strategy<Value = Vec3> {
        prop::array::uniform3(-size..size).prop_map(Vec3::from)
    }

    proptest! {
        #[test]
        fn cubes_that_fly_as_they_like_are_apart_for_as_long_as_is_promised(
            direction in vector(1.0).prop_filter("no direction", |it| it.amax() > 0.1),
            velocities in [vector(0.5), vector(0.5)],
            spins in [vector(10.0), vector(10.0)],
        ) {
            let scene = cubes(direction * (0.102 / direction.amax()), velocities, spins);
            let (time, _) = bounds(&scene, 1.0);
            for part in 1..=8 {
                prop_assert!(are_apart(&scene, time * f64::from(part) / 8.0), "{time}, {part}/8 of it");
            }
        }
    }
}
