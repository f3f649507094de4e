//! The closed forms that the tests of LAMMPS's granular package use.
//!
//! In the symbols of this program c = β/α of damping or friction with the exponent of the repulsion, N = m g, and the
//! hard ball is the limit d/R → 0. The tolerance is 1e-6 in the limit, 1e-3 for transients.

use super::Published::{Number, Words};
use super::Row;
use super::Verdict::{Agrees, Disagrees, Outside};

const BASE: Row = Row {
    key: "",
    source: "",
    quantity: "",
    published: Number(0.0),
    reading: 0.0,
    tolerance: 1e-6,
    expected: Agrees,
    completed: "",
    reason: "",
};

const RESTITUTION: Row = Row {
    source: "LAMMPS, unittest/granular (2026), restitution: −e v, momentum 0",
    published: Number(-0.6),
    completed: "R = 10 mm, 2500 kg/m³, e = 0.6, balls of ±1 m/s or one of 1 m/s against a plane, no gravity; α = 1 \
                MPa, d₀ = 0.1 mm, ν = 6, c of the damping from c v(1 + e) = ln((1 + c v)/(1 − c v e)) with the \
                relative speed v. From a gap of 20 mm.",
    ..BASE
};

const ELLIPSOIDS: Row = Row {
    source: "LAMMPS, unittest/granular (2026), momenta of superellipsoids that collide off centre: P = m v, L = r × P",
    completed: "Ellipsoids of semi-axes 20, 15, 10 mm and 10, 20, 15 mm, 50 g and 80 g, oblique to one another; the \
                first comes with 1 m/s, 8 mm and 4 mm off the centre of the other; repulsion, damping and friction \
                with μ = 0.3. L about the origin, spins included. Superellipsoids of flatter faces do not exist \
                here.",
    ..BASE
};

const LEDGER: Row = Row {
    completed: "R = 10 mm, 2500 kg/m³, α = 1 MPa, d₀ = 0.1 mm, ν = 6, g = 9.81 m/s². The change is over the energy at \
                the start, heights counted from the floor.",
    ..BASE
};

const DRAG: Row = Row {
    source: "LAMMPS, unittest/granular (2026), linear drag: m g/(6πηR)",
    quantity: "",
    published: Number(0.545),
    completed: "R = 10 mm, 2500 kg/m³, η = 1 Pa s, a fluid without density; g = 9.81 m/s².",
    ..BASE
};

const THROWN: Row = Row {
    source: "LAMMPS, unittest/granular (2026), slip that ceases: 5u₀/7, ω = u/R",
    published: Number(0.714_285_714_285_7),
    completed: "R = 10 mm, 2500 kg/m³, thrown flat with u₀ = 1 m/s from the gap at which it rests, 1e-3 R with the \
                first d₀; ν = 6, friction with c = 100 s/m and without bound, after 6 ms, when e^(−7cgt/2) is 1e-9.",
    ..BASE
};

const SLIDING: Row = Row {
    source: "LAMMPS, unittest/granular (2026), slip: u₀ − μgt, ω = 5μgt/(2R)",
    completed: "The ball thrown flat, with μ = 0.3 and c = 1e6 s/m (theirs is c → ∞), after 50 ms; it would roll after \
                97 ms.",
    tolerance: 1e-3,
    ..THROWN
};

const BOUNDED: Row = Row {
    source: "the same slip under the smooth bound of this program, derived: Q(y) = Q(y₀) − (7/2)cgt, Q = √(1 + y²) − \
             arsinh(1/y), y = cw/μ, u = u₀ − (2/7)(w₀ − w)",
    completed: "The ball thrown flat, with μ = 0.3 and c = 100 s/m.",
    ..THROWN
};

const IMPACT: Row = Row {
    source: "LAMMPS, unittest/granular (2026), impact that slides throughout: J = μ(1 + e)v_n, v_t − J, ω = 5J/(2R)",
    completed: "R = 10 mm, 2500 kg/m³, v_n = 1 m/s, e = 0.8, μ = 0.1, c = 1e6 s/m of the friction (theirs is c → ∞), \
                no gravity; α = 1 GPa, ν = 6, d₀ = 10 µm at first: the closest gap is 5e-4 R. From a gap of 2 mm. \
                Oblique: v_t = 2 m/s without spin.",
    ..BASE
};

const SPINNING: Row = Row {
    source: "LAMMPS, unittest/granular (2026), impact that slides throughout: J = μ(1 + e)v_n, v_t = J, ω₀ − 5J/(2R)",
    completed: "As the oblique impact, with ω₀ = 200 rad/s in the place of v_t.",
    ..IMPACT
};

const SLOPE: Row = Row {
    source: "LAMMPS, unittest/granular (2026), incline: (5/7)g sinθ t while tanθ ≤ 7μ/2",
    completed: "R = 10 mm, 2500 kg/m³, μ = 0.2, tanθ = 0.5, c = 40 s/m, from rest at the gap that carries it, 1e-3 R \
                at first; the acceleration from 50 ms to 150 ms, when the slip is steady.",
    ..BASE
};

pub(super) const ROWS: &[Row] = &[
    Row {
        key: "granular-restitution-head-on",
        quantity: "velocity of the first of two balls after the impact [m/s]",
        ..RESTITUTION
    },
    Row {
        key: "granular-restitution-momentum",
        quantity: "momentum of both over the sum of its sizes",
        published: Number(0.0),
        tolerance: 1e-14,
        ..RESTITUTION
    },
    Row { key: "granular-restitution-wall", quantity: "velocity after the impact on a plane [m/s]", ..RESTITUTION },
    Row {
        key: "granular-ellipsoids-momentum",
        quantity: "momentum along x after the impact [kg m/s]",
        published: Number(0.05),
        tolerance: 1e-13,
        ..ELLIPSOIDS
    },
    Row {
        key: "granular-ellipsoids-angular-momentum",
        quantity: "angular momentum about z after the impact [kg m²/s]",
        published: Number(-4e-4),
        ..ELLIPSOIDS
    },
    Row {
        key: "granular-free-fall",
        source: "LAMMPS, unittest/granular (2026), free fall: z₀ − gt²/2",
        quantity: "height after 0.4 s [m]",
        published: Number(0.2152),
        completed: "From 1 m, g = 9.81 m/s².",
        ..BASE
    },
    Row {
        key: "granular-stack-energy",
        source: "LAMMPS, unittest/granular (2026), stack of two spheres between floor and ceiling: energy constant",
        quantity: "largest change of the energy in 1 s",
        ..LEDGER
    },
    Row {
        key: "granular-friction-energy",
        source: "LAMMPS, unittest/granular (2026), impact with friction: energy never grows",
        quantity: "largest rise of the energy above its least value so far",
        ..LEDGER
    },
    Row {
        key: "granular-terminal-velocity",
        quantity: "velocity of sinking of a ball without inertia [m/s]",
        tolerance: 1e-12,
        ..DRAG
    },
    Row {
        key: "granular-terminal-velocity-inertia",
        quantity: "velocity after 2 s, 36 relaxation times, from rest [m/s]",
        ..DRAG
    },
    Row {
        key: "granular-schiller-naumann",
        source: "LAMMPS, unittest/granular (2026), drag of Schiller and Naumann",
        quantity: "terminal velocity at a Reynolds number above 1",
        published: Words("24/Re (1 + 0.15 Re^0.687)"),
        tolerance: 0.0,
        expected: Outside,
        reason: "Fluids here are slow flows, linear in the velocity: no drag that grows with the Reynolds number.",
        ..BASE
    },
    Row { key: "granular-slip-ceases-speed", quantity: "speed [m/s]", ..THROWN },
    Row { key: "granular-slip-ceases-spin", quantity: "R ω [m/s]", ..THROWN },
    Row {
        key: "granular-slip-speed-bound",
        quantity: "speed after 50 ms [m/s]",
        published: Number(0.852_851_365_346),
        ..BOUNDED
    },
    Row {
        key: "granular-slip-speed-bound-late",
        quantity: "speed after 90 ms [m/s]",
        published: Number(0.735_146_321_410),
        ..BOUNDED
    },
    Row { key: "granular-slip-speed", quantity: "speed [m/s]", published: Number(0.85285), ..SLIDING },
    Row { key: "granular-slip-spin", quantity: "spin [rad/s]", published: Number(36.7875), ..SLIDING },
    Row { key: "granular-impact-speed", quantity: "speed along, oblique [m/s]", published: Number(1.82), ..IMPACT },
    Row { key: "granular-impact-spin", quantity: "spin, oblique [rad/s]", published: Number(45.0), ..IMPACT },
    Row {
        key: "granular-spinning-impact-speed",
        quantity: "speed along, with spin alone [m/s]",
        published: Number(0.18),
        ..SPINNING
    },
    Row {
        key: "granular-spinning-impact-spin",
        quantity: "spin, with spin alone [rad/s]",
        published: Number(155.0),
        ..SPINNING
    },
    Row {
        key: "granular-incline-rolls",
        quantity: "acceleration, tanθ = 0.5 [m/s²]",
        published: Number(3.133_689_551_325),
        ..SLOPE
    },
    Row {
        key: "granular-incline-slides",
        source: "LAMMPS, unittest/granular (2026), incline: g(sinθ − μ cosθ)t beyond tanθ = 7μ/2",
        quantity: "acceleration, tanθ = 0.8 [m/s²]",
        published: Number(4.596_193_812_382),
        completed: "As the ball that rolls, tanθ = 0.8, c = 1e6 s/m.",
        ..SLOPE
    },
    Row {
        key: "granular-rolling-decay",
        source: "LAMMPS, unittest/granular (2026), rolling friction: ω₀ − 5μ_r g t/(2R), the torque capped at μ_r R N",
        quantity: "spin of a ball that rolls after 0.1 s, ω₀ = 100 rad/s [rad/s]",
        published: Number(97.5475),
        tolerance: 1e-3,
        expected: Disagrees,
        completed: "R = 10 mm, 2500 kg/m³, μ_r = 0.01; here damping c = 1 s/m and friction c = 40 s/m, ν = 6, from the \
                    gap that carries it, 1e-3 R at first. Theirs is held against sliding, ours rolls.",
        reason: "No law here has a rolling torque of its own. Damping resists rolling, as the field before the ball is \
                 pressed and that behind it released: the spin decays at the rate (5/7)c g d/((ν − 2)R), and friction \
                 adds 0.075 c g(d/R)². Both vanish with the gap.",
        ..BASE
    },
    Row {
        key: "granular-twist-decay",
        source: "LAMMPS, unittest/granular (2026), twisting friction: ω₀ − 5μ_t g t/(2R²), the torque capped at μ_t N",
        quantity: "spin about the normal that is lost in 0.5 s, over 5μ_t g t/(2R²)",
        published: Number(1.0),
        completed: "R = 10 mm, 2500 kg/m³, ω₀ = 100 rad/s, μ = 0.3, c = 1e6 s/m, ν = 6, from the gap d that carries \
                    it, 1e-3 R at first. The bound of the friction makes the torque: μ_t = μ√(2Rd/(ν − 2)).",
        ..BASE
    },
    Row {
        key: "granular-pull-off-dmt",
        source: "LAMMPS, unittest/granular (2026), pull-off of DMT: 4πγR*",
        quantity: "largest pull of two balls [N]",
        published: Number(3.141_592_653_590e-3),
        completed: "Equal balls of R = 10 mm, γ = 0.05 J/m²; adhesion with ν = 3 and 9, d₀ = 1e-3 R at first, and 2γ = \
                    β d₀(1/2 − 1/8).",
        ..BASE
    },
    Row {
        key: "granular-pull-off-jkr",
        source: "LAMMPS, unittest/granular (2026), pull-off of JKR: 3πγR*",
        quantity: "largest pull of two balls",
        published: Words("3πγR*"),
        tolerance: 0.0,
        expected: Outside,
        reason: "JKR's balls flatten where they touch. Balls here keep their shape, or deform as a whole, and adhere \
                 over a gap: that is DMT's limit.",
        ..BASE
    },
    Row {
        key: "granular-hertz-peak",
        source: "LAMMPS, unittest/granular (2026), peak of the force of an impact by Hertz",
        quantity: "largest force, as a contact",
        published: Words("K α_max^(3/2)"),
        tolerance: 0.0,
        expected: Outside,
        reason: "A contact here is a power of the gap, without overlap; Hertz's law can be had as a bond, and is run \
                 as one above.",
        ..BASE
    },
    Row {
        key: "granular-heat",
        source: "LAMMPS, unittest/granular (2026), conduction of heat between grains",
        quantity: "temperature of the grains",
        published: Words("exponential approach"),
        tolerance: 0.0,
        expected: Outside,
        reason: "There is no temperature: what damping and friction take leaves the ledger as work.",
        ..BASE
    },
];
