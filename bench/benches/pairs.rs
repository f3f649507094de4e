//! Two bodies that meet: the plane between them and what they do to each other, with and without derivatives.
#![allow(clippy::expect_used, reason = "a benchmark that cannot go on has failed")]

use divan::Bencher;
use gyration::contact::{AreaMeasure, ContactLaw, Damping, Friction, Repulsion};
use gyration::kinematics::{Placement, Quaternion, Velocity};
use gyration::pair::{PairForm, PairLaws, PairLoads, PairScratch, PairSlopes, Side};
use gyration::surface::Surface;
use gyration::tensor::{Mat3, Vec3, cross_matrix};
use std::sync::Arc;

fn main() {
    divan::main();
}

const NAMES: [&str; 4] = ["box", "sphere", "ellipsoid", "cylinder"];

/// Two bodies of one shape, a hundredth of their size apart, in general position.
struct Meeting {
    surface: Surface,
    placements: [Placement; 2],
    velocities: [Velocity; 2],
    pair: PairForm,
}

impl Meeting {
    fn new(name: &str, viscous: bool) -> Self {
        let surface = match name {
            "box" => Surface::cuboid(&Vec3::new(1.0, 1.2, 0.8)),
            "sphere" => Surface::sphere(0.5),
            "ellipsoid" => Surface::ellipsoid(&Vec3::new(0.5, 0.6, 0.4)),
            _ => Surface::cylinder(0.5, 1.0),
        };
        let mut laws = vec![ContactLaw::Repulsion(Repulsion { alpha: 100.0, exponent: 6.0, reference_gap: 0.01 })];
        if viscous {
            laws.push(ContactLaw::Damping(Damping { beta: 100.0, exponent: 6.0, reference_gap: 0.01, release: None }));
            laws.push(ContactLaw::Friction(Friction { beta: 100.0, exponent: 6.0, reference_gap: 0.01, mu: None }));
        }
        let laws = Arc::new(PairLaws::new(AreaMeasure::DeformedArea, laws).expect("the laws place a plane"));
        let pair = PairForm::new(laws, None, [&surface, &surface]);
        let spin = cross_matrix(&Vec3::new(1.0, -2.0, 0.5));
        let turned = |angle: f64| Quaternion::from_axis_angle(&Vec3::new(1.0, 2.0, 3.0), angle).rotation();
        let velocity = |speed: f64, rotation: Mat3| Velocity {
            velocity: Vec3::new(speed, 0.1, 0.0),
            gradient_rate: spin * rotation,
        };
        let rotations = [turned(0.4), turned(1.9)];
        let velocities = [velocity(-1.0, rotations[0]), velocity(1.0, rotations[1])];
        let at = |distance: f64| {
            let place = |x: f64, gradient: Mat3| Placement { position: Vec3::new(x, 0.1 * x, 0.0), gradient };
            [place(0.5 * distance, rotations[0]), place(-0.5 * distance, rotations[1])]
        };
        let mut this = Self { surface, placements: at(3.0), velocities, pair };
        let (mut near, mut far) = (0.0, 3.0);
        for _ in 0..40 {
            let middle = 0.5 * (near + far);
            this.placements = at(middle);
            if this.loads().is_some_and(|loads| loads.gap > 0.01) { far = middle } else { near = middle }
        }
        this.placements = at(far);
        this
    }

    /// The same a time later [s], in a straight line.
    fn moved(&self, time: f64) -> Self {
        let placements = [0, 1].map(|i| {
            let (Placement { position, gradient }, velocity) = (&self.placements[i], &self.velocities[i]);
            let gradient = gradient + time * velocity.gradient_rate;
            Placement { position: position + time * velocity.velocity, gradient }
        });
        Self { placements, surface: self.surface.clone(), pair: self.pair.clone(), velocities: self.velocities }
    }

    fn sides(&self) -> [Side<'_>; 2] {
        [0, 1].map(|i| Side {
            surface: &self.surface,
            placement: &self.placements[i],
            from_first: self.placements[i].position - self.placements[0].position,
            velocity: &self.velocities[i],
            inverse: self.placements[i].gradient.transpose(),
            deformation: None,
            least_gap: 1e-14,
        })
    }

    fn loads(&self) -> Option<PairLoads> {
        let [one, other] = self.sides();
        PairLoads::integrate(&self.pair, [&one, &other], None, &mut PairScratch::default()).ok()
    }
}

#[divan::bench(args = NAMES)]
fn forces(bencher: Bencher, name: &str) {
    bench(bencher, name, false);
}

/// The same from where the plane was a fiftieth of the time to contact before.
#[divan::bench(args = NAMES)]
fn forces_from_the_plane_before(bencher: Bencher, name: &str) {
    let meeting = Meeting::new(name, false);
    let before = meeting.moved(-1e-4);
    let mut scratch = PairScratch::default();
    let [one, other] = before.sides();
    let slab = meeting.pair.gap([&one, &other], None, &mut scratch).expect("the bodies are apart");
    let guess = slab.guess(1e-4);
    let [one, other] = meeting.sides();
    let sides = [&one, &other];
    bencher.bench_local(|| PairLoads::integrate(&meeting.pair, divan::black_box(sides), guess.as_ref(), &mut scratch));
}

#[divan::bench(args = NAMES)]
fn with_damping_and_friction(bencher: Bencher, name: &str) {
    bench(bencher, name, true);
}

fn bench(bencher: Bencher, name: &str, viscous: bool) {
    let meeting = Meeting::new(name, viscous);
    let ([one, other], mut scratch) = (meeting.sides(), PairScratch::default());
    bencher.bench_local(|| PairLoads::integrate(&meeting.pair, divan::black_box([&one, &other]), None, &mut scratch));
}

#[divan::bench(args = NAMES)]
fn with_derivatives(bencher: Bencher, name: &str) {
    let meeting = Meeting::new(name, true);
    let ([one, other], mut scratch) = (meeting.sides(), PairScratch::default());
    bencher.bench_local(|| PairSlopes::integrate(&meeting.pair, divan::black_box([&one, &other]), None, &mut scratch));
}
