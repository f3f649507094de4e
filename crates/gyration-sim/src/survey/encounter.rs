//! Two bodies that approach each other along the normal of the plane between them, in the orientations of the start.
//!
//! F(s) is the force of the repulsion along the normal n [N] at a slab of width s between them, without velocity: F =
//! −dU/ds as long as the plane keeps its normal, as between balls and between faces that lie opposite.

use super::reach_change::solids;
use gyration::Party;
use gyration::contact::Deformation;
use gyration::kinematics::{Placement, Velocity};
use gyration::model::Model;
use gyration::neighbours::Pair;
use gyration::pair::{PairForm, PairLoads, PairScratch, Side};
use gyration::state::State;
use gyration::surface::Surface;
use gyration::tensor::{Mat3, Vec3};
use std::sync::Arc;

/// A gap that cannot be told from zero, in sizes.
const LEAST: f64 = 1e-15;

/// Two bodies that approach each other.
#[derive(Debug, Clone)]
pub struct Encounter<'a> {
    form: Arc<PairForm>,
    ends: [End<'a>; 2],
    /// n, from the second to the first.
    normal: Vec3,
    /// The width of the slab at the start \[m\].
    pub initial_gap: f64,
    /// The larger of their sizes \[m\].
    pub size: f64,
}

#[derive(Debug, Clone)]
struct End<'a> {
    surface: &'a Surface,
    placement: Placement,
    deformation: Option<Deformation>,
    inverse: Mat3,
}

impl<'a> Encounter<'a> {
    /// Of the two of a pair; none where no plane is found between them at the start.
    pub fn new(model: &'a Model, start: &State, pair: &Pair) -> Option<Self> {
        let solids = solids(model, pair);
        let end = |k: usize| {
            let (placement, deforms) = match pair.parties[k] {
                Party::Body(body) => {
                    (start.motion_in_space(model, body).placement, model.bodies[body].affine().is_some())
                }
                Party::SolidSupport(support) => (model.solid_supports[support].at(start.time).placement, false),
                Party::Support(_) | Party::Space => unreachable!("a pair is between solids"),
            };
            let deformation = deforms.then(|| Deformation::of(&placement.gradient)).flatten();
            // P of a rigid body is a rotation.
            let inverse = deformation.map_or_else(|| placement.gradient.transpose(), |deformation| deformation.inverse);
            End { surface: solids[k].part(pair.parts[k]), placement, deformation, inverse }
        };
        let ends = [end(0), end(1)];
        let size = pair.parties.into_iter().filter_map(|party| model.size_of(party)).fold(0.0, f64::max);
        // Out of reach there is a plane all the same.
        let surfaces = ends.each_ref().map(|end| end.surface);
        let felt_everywhere = PairForm::new(Arc::clone(&pair.form.laws), None, surfaces);
        let loads = loads(&felt_everywhere, &ends, size)?;
        Some(Self { form: Arc::clone(&pair.form), ends, normal: loads.normal, initial_gap: loads.gap, size })
    }

    /// The slab \[m\] and the force \[N\] where the slab is as wide as this if the plane keeps its normal; none where
    /// they are not known.
    pub fn at(&self, slab: f64) -> Option<[f64; 2]> {
        let loads = self.loads_at(slab)?;
        let force = loads.on[0].force.dot(&loads.normal);
        Some([loads.gap, force]).filter(|point| point.iter().all(|number| number.is_finite()))
    }

    /// The normal of the plane from the second to the first at the same place.
    pub fn normal_at(&self, slab: f64) -> Option<Vec3> {
        self.loads_at(slab).map(|loads| loads.normal)
    }

    fn loads_at(&self, slab: f64) -> Option<PairLoads> {
        let mut ends = self.ends.clone();
        ends[0].placement.position += (slab - self.initial_gap) * self.normal;
        loads(&self.form, &ends, self.size)
    }
}

fn loads(form: &PairForm, ends: &[End; 2], size: f64) -> Option<PairLoads> {
    let still = Velocity { velocity: Vec3::zeros(), gradient_rate: Mat3::zeros() };
    let [one, other] = ends.each_ref().map(|end| Side {
        surface: end.surface,
        placement: &end.placement,
        from_first: end.placement.position - ends[0].placement.position,
        velocity: &still,
        inverse: end.inverse,
        deformation: end.deformation,
        least_gap: LEAST * size,
    });
    PairLoads::integrate(form, [&one, &other], None, &mut PairScratch::default()).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use gyration_scene::Scene;
    use std::path::Path;

    fn scene(shape: &str) -> Scene {
        let body = |name: &str, x: f64| {
            format!("[[body]]\nname = \"{name}\"\nshape = {{ {shape} }}\nmass = 1\nposition = [{x}, 0, 0]\n")
        };
        let text = format!(
            "time = {{ end = 1, sample = 1 }}\nworld = {{ gravity = [0, 0, 0] }}\n\
             contact = [{{ between = [\"a\", \"b\"], repulsion = {{ alpha = 100, nu = 6, d0 = 0.001 }} }}]\n{}{}",
            body("a", 0.0),
            body("b", 0.11)
        );
        Scene::parse("scene.toml", &text, Path::new(""), &[]).unwrap_or_else(|errors| panic!("{errors}"))
    }

    fn pair(scene: &Scene) -> Pair {
        scene.built().model.pairs().next().unwrap()
    }

    /// Faces of side a at a slab s are as one face at that gap: F = α (d₀/s)^ν a², edges aside.
    #[test]
    fn the_force_between_faces_is_the_traction_at_the_slab_times_the_face() {
        let scene = scene("box = { size = [0.1, 0.1, 0.1] }");
        let encounter = Encounter::new(&scene.built().model, &scene.built().state, &pair(&scene)).unwrap();
        assert!((encounter.initial_gap - 0.01).abs() < 1e-15);
        for slab in [1e-3, 1e-4, 1e-5] {
            let [found, force] = encounter.at(slab).unwrap();
            let traction = 100.0 * (0.001_f64 / slab).powi(6);
            // The sides of the boxes add some slab over side.
            let off = force / (traction * 0.01) - 1.0;
            assert!((found / slab - 1.0).abs() < 1e-9 && off.abs() < slab / 0.1, "{slab}: {off:e}");
        }
    }

    #[test]
    fn the_force_between_balls_falls_with_the_slab() {
        let scene = scene("sphere = { radius = 0.05 }");
        let encounter = Encounter::new(&scene.built().model, &scene.built().state, &pair(&scene)).unwrap();
        let force = |slab: f64| encounter.at(slab).unwrap()[1];
        // d^−ν over a paraboloid: F ∝ s^(1−ν) where the slab is small.
        let slope = (force(2e-6) / force(1e-6)).ln() / 2.0_f64.ln();
        assert!((slope + 5.0).abs() < 1e-4, "{slope}");
    }
}
