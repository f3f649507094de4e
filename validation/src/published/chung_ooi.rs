//! Chung & Ooi's benchmark of elementary impacts, with the materials and speeds of their paper.

use super::Published::{Number, Words};
use super::Row;
use super::Verdict::{Agrees, Outside};

const EXCHANGE: Row = Row {
    key: "",
    source: "Chung & Ooi, Granular Matter 13 (2011) 643, test 1: elastic spheres head-on exchange their velocities",
    quantity: "",
    published: Number(-10.0),
    reading: 0.0,
    tolerance: 1e-9,
    expected: Agrees,
    completed: "R = 10 mm, ±10 m/s, densities 2800 kg/m³ (glass) and 2500 kg/m³ (limestone), no gravity; repulsion α = \
                1 MPa, d₀ = 0.1 mm, ν = 6, from a gap of 20 mm. Moduli of elasticity play no part.",
    reason: "",
};

/// Momentum over the sum of its sizes.
const BALANCE: Row = Row { published: Number(0.0), tolerance: 1e-14, ..EXCHANGE };

const HERTZ: Row = Row {
    source: "Chung & Ooi, Granular Matter 13 (2011) 643, test 1: α_max = (5 m_r v²/(4K))^(2/5), F = K α_max^(3/2), T = \
             2.943275 α_max/v, K = (4/3)E*√(R/2)",
    tolerance: 1e-6,
    completed: "As a bond between the centres with the law V = (2/5)K max(2R − l, 0)^(5/2), E* = E/(2(1 − ν²)), v = 20 \
                m/s the relative speed, m_r half of the mass; glass E = 48 GPa, ν = 0.2, limestone 20 GPa, 0.25. The \
                bond acts from centre to centre alone.",
    ..EXCHANGE
};

const PLANE: Row = Row {
    source: "Chung & Ooi, Granular Matter 13 (2011) 643, test 3: the restitution of normal impact is the one put in",
    tolerance: 1e-6,
    completed: "R = 2.5 mm, 3.9 m/s, 4000 kg/m³ (aluminium oxide) and 7000 kg/m³ (cast iron), no gravity; repulsion α \
                = 1 MPa, d₀ = 10 µm, ν = 6 and damping with the same exponent, whose c = β/α follows from c v(1 + e) = \
                ln((1 + c v)/(1 − c v e)); none for e = 1. From a gap of 2.5 mm.",
    ..EXCHANGE
};

pub(super) const ROWS: &[Row] = &[
    Row {
        key: "chung-ooi-1-glass-velocity",
        quantity: "velocity after the impact of the ball that came with 10 m/s, glass [m/s]",
        ..EXCHANGE
    },
    Row {
        key: "chung-ooi-1-limestone-velocity",
        quantity: "velocity after the impact of the ball that came with 10 m/s, limestone [m/s]",
        ..EXCHANGE
    },
    Row {
        key: "chung-ooi-1-glass-momentum",
        quantity: "momentum after the impact over the sum of its sizes, glass",
        ..BALANCE
    },
    Row {
        key: "chung-ooi-1-limestone-momentum",
        quantity: "momentum after the impact over the sum of its sizes, limestone",
        ..BALANCE
    },
    Row {
        key: "chung-ooi-1-contact",
        quantity: "force against overlap, as a contact",
        published: Words("Hertz: K α^(3/2)"),
        tolerance: 0.0,
        expected: Outside,
        completed: "",
        reason: "Bodies of this program keep a gap: a contact is a power of the gap, and there is no overlap whose \
                 force Hertz's law would give. The law itself can be had as that of a bond, below.",
        ..HERTZ
    },
    Row {
        key: "chung-ooi-1-glass-overlap",
        quantity: "largest overlap as a bond, glass [mm]",
        published: Number(2.741_127_020_893e-1),
        ..HERTZ
    },
    Row {
        key: "chung-ooi-1-glass-force",
        quantity: "largest force as a bond, glass [N]",
        published: Number(1.069_688_898_399e4),
        ..HERTZ
    },
    Row {
        key: "chung-ooi-1-glass-duration",
        quantity: "duration of the contact as a bond, glass [µs]",
        published: Number(4.033_945_316_209e1),
        ..HERTZ
    },
    Row {
        key: "chung-ooi-1-limestone-overlap",
        quantity: "largest overlap as a bond, limestone [mm]",
        published: Number(3.683_040_255_532e-1),
        ..HERTZ
    },
    Row {
        key: "chung-ooi-1-limestone-force",
        quantity: "largest force as a bond, limestone [N]",
        published: Number(7.108_241_279_902e3),
        ..HERTZ
    },
    Row {
        key: "chung-ooi-1-limestone-duration",
        quantity: "duration of the contact as a bond, limestone [µs]",
        published: Number(5.420_100_154_050e1),
        ..HERTZ
    },
    Row { key: "chung-ooi-3-oxide-0.2", quantity: "restitution, aluminium oxide", published: Number(0.2), ..PLANE },
    Row { key: "chung-ooi-3-oxide-0.4", quantity: "restitution, aluminium oxide", published: Number(0.4), ..PLANE },
    Row { key: "chung-ooi-3-oxide-0.6", quantity: "restitution, aluminium oxide", published: Number(0.6), ..PLANE },
    Row { key: "chung-ooi-3-oxide-0.8", quantity: "restitution, aluminium oxide", published: Number(0.8), ..PLANE },
    Row { key: "chung-ooi-3-oxide-0.9", quantity: "restitution, aluminium oxide", published: Number(0.9), ..PLANE },
    Row { key: "chung-ooi-3-oxide-1", quantity: "restitution, aluminium oxide", published: Number(1.0), ..PLANE },
    Row { key: "chung-ooi-3-iron-0.2", quantity: "restitution, cast iron", published: Number(0.2), ..PLANE },
    Row { key: "chung-ooi-3-iron-0.4", quantity: "restitution, cast iron", published: Number(0.4), ..PLANE },
    Row { key: "chung-ooi-3-iron-0.6", quantity: "restitution, cast iron", published: Number(0.6), ..PLANE },
    Row { key: "chung-ooi-3-iron-0.8", quantity: "restitution, cast iron", published: Number(0.8), ..PLANE },
    Row { key: "chung-ooi-3-iron-0.9", quantity: "restitution, cast iron", published: Number(0.9), ..PLANE },
    Row { key: "chung-ooi-3-iron-1", quantity: "restitution, cast iron", published: Number(1.0), ..PLANE },
];
