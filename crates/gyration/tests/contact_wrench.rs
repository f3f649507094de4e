//! The wrench of a contact on a rigid body is that of the general resultant, and so are its derivatives.

use gyration::contact::{
    Adhesion, AreaMeasure, ContactLaw, ContactLoads, ContactScratch, ContactSlopes, ContactWrench, Damping, Friction,
    LawKind, LawSet, Meeting, RelativeMotion, Repulsion, RigidLoads, RigidMotion,
};
use gyration::load::{LoadSlopes, Loads, Wrench, WrenchSlope};
use gyration::surface::{GapField, Surface};
use gyration::tensor::{Mat3, Vec3, cross_matrix};
use proptest::prelude::*;

/// A body of rotation R near the plane with normal n.
#[derive(Debug)]
struct Scene {
    laws: LawSet,
    surface: Surface,
    rotation: Mat3,
    normal: Vec3,
    height: f64,
    /// w₀ and Ω.
    velocity: Vec3,
    spin: Vec3,
}

impl Scene {
    fn field(&self) -> GapField {
        GapField::new(self.height, self.rotation.tr_mul(&self.normal))
    }

    fn relative(&self) -> RelativeMotion {
        let gradient_rate = self.rotation * cross_matrix(&self.spin);
        RelativeMotion { normal: self.normal, velocity: self.velocity, gradient_rate }
    }

    fn meeting(&self) -> Meeting<'_> {
        Meeting { surface: &self.surface, field: self.field(), motion: self.relative(), deformation: None }
    }

    fn motion(&self) -> RigidMotion {
        RigidMotion::new(&self.relative(), &self.rotation, self.spin)
    }

    fn rigid_loads(&self) -> RigidLoads {
        let mut scratch = ContactScratch::default();
        RigidLoads::integrate(&self.laws, &self.surface, &self.field(), &self.motion(), &mut scratch).unwrap()
    }

    fn wrench(&self) -> ContactWrench {
        let mut scratch = ContactScratch::default();
        ContactWrench::integrate(&self.laws, &self.surface, &self.field(), &self.motion(), &mut scratch).unwrap()
    }

    fn slopes(&self) -> LoadSlopes {
        let mut slopes = LoadSlopes::default();
        let mut scratch = ContactScratch::default();
        ContactSlopes::integrate(&self.laws, &self.meeting(), &mut scratch).unwrap().add_to(&mut slopes);
        slopes
    }

    /// f and the torque of RᵀM.
    fn seen(&self, loads: &Loads) -> Wrench {
        Wrench { force: loads.force, torque: loads.body_torque(&self.rotation) }
    }
}

fn law_set(exponents: [f64; 3], mu: Option<f64>) -> LawSet {
    let [repulsion, damping, friction] = exponents;
    let laws = vec![
        ContactLaw::Repulsion(Repulsion { alpha: 2.0, exponent: repulsion, reference_gap: 0.3 }),
        ContactLaw::Damping(Damping { beta: 0.7, exponent: damping, reference_gap: 0.4, release: mu }),
        ContactLaw::Friction(Friction { beta: 0.9, exponent: friction, reference_gap: 0.2, mu }),
        ContactLaw::Adhesion(Adhesion {
            beta: 1.3,
            attractive_exponent: 2.0,
            repulsive_exponent: 4.5,
            reference_gap: 0.25,
        }),
    ];
    LawSet::new(AreaMeasure::default(), laws)
}

fn vector() -> impl Strategy<Value = Vec3> {
    prop::array::uniform3(-1.0..1.0).prop_map(|x: [f64; 3]| Vec3::from(x))
}

fn scene() -> impl Strategy<Value = Scene> {
    let exponents = prop::array::uniform3(prop_oneof![1.0..7.0, (1..7).prop_map(f64::from)]);
    (exponents, prop::array::uniform4(vector()), any::<bool>(), prop::option::of(0.01..1.0)).prop_map(
        |(exponents, [turn, n, velocity, spin], ball, mu)| {
            let surface = if ball { Surface::sphere(0.5) } else { Surface::cuboid(&Vec3::new(0.6, 0.8, 0.4)) };
            let normal = (n + Vec3::new(0.0, 0.0, 2.0)).normalize();
            let rotation = *nalgebra::Rotation3::new(3.0 * turn).matrix();
            Scene { laws: law_set(exponents, mu), surface, rotation, normal, height: 0.75, velocity, spin }
        },
    )
}

/// The difference as a fraction of the sizes that enter: rounding of a few dozen operations.
fn differ(a: &Wrench, b: &Wrench, scale: f64) -> f64 {
    ((a.force - b.force).norm() + (a.torque - b.torque).norm()) / scale
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn wrench_is_that_of_the_resultant(scene in scene()) {
        let mut scratch = ContactScratch::default();
        let loads = ContactLoads::integrate(&scene.laws, &scene.meeting(), &mut scratch).unwrap();
        let seen = scene.seen(&loads.total());
        let (rigid, wrench) = (scene.rigid_loads(), scene.wrench().wrench);
        let scale = seen.force.norm() + seen.torque.norm() + 1.0;
        prop_assert!(differ(&rigid.wrench, &seen, scale) < 1e-13);
        prop_assert!(differ(&wrench, &seen, scale) < 1e-13);
        let powers = [(rigid.damping_power, LawKind::Damping), (rigid.friction_power, LawKind::Friction)];
        for (power, law) in powers {
            let expected = loads.relative_power(law);
            prop_assert!((power - expected).abs() < 1e-13 * (expected.abs() + scale), "{power} against {expected}");
        }
        prop_assert!(differ(&wrench, &scene.seen(&scene.slopes().loads), scale) < 1e-13);
    }

    #[test]
    fn slopes_of_the_wrench_are_those_of_the_resultant(scene in scene()) {
        let (wrench, slopes) = (scene.wrench(), scene.slopes());
        let scale = wrench.by_height.force.norm() + wrench.by_turn.force.norm() + 1.0;
        let by_height = scene.seen(&slopes.along_place(&scene.normal, &Mat3::zeros()));
        prop_assert!(differ(&wrench.by_height, &by_height, scale) < 1e-13);
        for axis in 0..3 {
            let unit = Vec3::ith(axis, 1.0);
            let column = |slope: &WrenchSlope| Wrench {
                force: slope.force.column(axis).into(),
                torque: slope.torque.column(axis).into(),
            };
            let by_velocity = scene.seen(&slopes.along_rate(&unit, &Mat3::zeros()));
            prop_assert!(differ(&column(&wrench.by_velocity), &by_velocity, scale) < 1e-13);
            let spinning = scene.rotation * cross_matrix(&unit);
            let by_spin = scene.seen(&slopes.along_rate(&Vec3::zeros(), &spinning));
            prop_assert!(differ(&column(&wrench.by_spin), &by_spin, scale) < 1e-13);
        }
    }

    #[test]
    fn friction_of_any_strength_leaves_the_damping_alone(scene in scene(), strength in 1e15..1e25_f64) {
        // Next to a support the steeper law exceeds the other by more than the digits of a number.
        let damping = ContactLaw::Damping(Damping { beta: 1.0, exponent: 3.0, reference_gap: 1.0, release: None });
        let friction = ContactLaw::Friction(Friction { beta: strength, exponent: 3.0, reference_gap: 1.0, mu: None });
        let with = |laws: Vec<ContactLaw>| {
            let laws = LawSet::new(AreaMeasure::default(), laws);
            let level = Scene { laws, surface: Surface::sphere(0.5), normal: Vec3::z(), rotation: Mat3::identity(), ..scene };
            (level.rigid_loads().wrench.force.z, level.wrench().by_velocity.force.m33, level.wrench().by_turn.force.m32)
        };
        prop_assert_eq!(with(vec![damping, friction]), with(vec![damping]));
    }

    #[test]
    fn resistance_of_a_contact_is_symmetric_and_dissipates(scene in scene()) {
        let wrench = scene.wrench();
        let (velocity, spin) = (wrench.by_velocity, wrench.by_spin);
        let scale = velocity.force.norm() + spin.torque.norm() + spin.force.norm();
        prop_assert!((velocity.force - velocity.force.transpose()).norm() < 1e-14 * scale);
        prop_assert!((velocity.torque - spin.force.transpose()).norm() < 1e-14 * scale);
        prop_assert!((spin.torque - spin.torque.transpose()).norm() < 1e-13 * scale);
        let (v, w) = (scene.velocity, scene.spin);
        let power = v.dot(&(velocity.force * v + spin.force * w)) + w.dot(&(velocity.torque * v + spin.torque * w));
        prop_assert!(power <= 0.0, "{power} W");
    }
}
