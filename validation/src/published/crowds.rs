//! Crowds: dice packed, a column that falls apart, a gas of rods, soft balls pressed together.
//!
//! Their sources have hundreds of grains and more. What fewer do was measured once, by the commands in the reasons;
//! tolerances were written down before.

use super::Published::Words;
use super::Row;
use super::Verdict::NotRun;

const CROWD: Row = Row {
    key: "",
    source: "",
    quantity: "",
    published: Words(""),
    reading: 0.0,
    tolerance: 0.0,
    expected: NotRun,
    completed: "",
    reason: "",
};

const TETRAHEDRA: Row = Row { source: "Phys. Rev. Lett. 104 (2010) 185501: tetrahedral dice, packed", ..CROWD };

const COLUMN: Row = Row {
    source: "Balmforth & Kerswell, J. Fluid Mech. 538 (2005) 399: columns of grains that collapse in a wide slot, a = \
             H/L of height and width",
    completed: "Disks, which are balls kept in a plane, on a rough floor and beside a smooth wall, \
                docs/examples/column/scene.py; L of 4 to 12 cm.",
    ..CROWD
};

const RODS: Row = Row {
    source: "arXiv 1706.07472: a gas of rods in free fall",
    completed: "Capsules of radius 0.5 m and 4 m long fill 0.12 of a box of six planes; they start side by side. No \
                damping: friction alone takes energy, with μ = 0.5 and c = 1000 s/m, at planes too; ν = 6, and two \
                turn back at a gap of 5 mm at first.",
    ..CROWD
};

pub(super) const ROWS: &[Row] = &[
    Row {
        key: "tetrahedra",
        quantity: "part of the volume that they fill",
        published: Words("0.76 ± 0.02"),
        reason: "Within 0.03 was to be, with 500 dice that are shaken. Forty smooth ones of 2 cm in a bin of 5 cm, \
                 poured and not shaken (docs/examples/tetrahedra, to 1 s in some minutes of processor time), fill 0.64 \
                 to 0.66 of what lies 2 to 6 mm within the planes, half of the gaps counted to the dice, and 0.57 with \
                 the edges. They still move, at 2 cm/s, and how much shaking would add is not known.",
        ..TETRAHEDRA
    },
    Row {
        key: "column-height",
        quantity: "n of H over the height at the end, as a^n",
        published: Words("0.6"),
        reason: "Within 0.1 was to be, with 2,000 grains and a of 1 to 8. Sixty of them with a of 0.6 to 6.7 have 0.51 \
                 ± 0.05 (docs/crowds.md, half a minute to a minute and a half of processor time each): at its limit, \
                 but a heap is four to six grains high.",
        ..COLUMN
    },
    Row {
        key: "column-run-out",
        quantity: "n of the run-out over L, as a^n",
        published: Words("0.9 ± 0.1"),
        reason: "Within 0.1 was to be, with 2,000 grains. The sixty have 0.85 ± 0.06, within it, l being the place of \
                 the farthest grain.",
        ..COLUMN
    },
    Row {
        key: "rods-cooling",
        quantity: "s of the kinetic energy E₀(1 + t/τ)^s",
        published: Words("-2"),
        reason: "Within 0.15 was to be; a run takes minutes. By docs/examples/rods, scene.py and measure.py: 32 rods \
                 to t = 60 s, whose energy falls 334-fold, -2.06, in six and a half minutes of processor time; 16 rods \
                 of half the height of the box to 100 s, 1288-fold, -2.12, in a minute and a half. Both are within it; \
                 but to 39 s the 32 have -2.23.",
        ..RODS
    },
    Row {
        key: "rods-surplus",
        quantity: "energy of a freedom of translation over that of one of turning about the short axes",
        published: Words("slightly above 1"),
        reason: "In the last half of these runs 1.33 with 32 rods, 1.27 with 16: the sign is that of the authors.",
        ..RODS
    },
    Row {
        key: "rods-along",
        quantity: "mean of cos² of the angle from the axis of a rod to its velocity",
        published: Words("above 1/3"),
        reason: "In the last half of these runs 0.33 with 32 rods, 0.26 with 16: none of it. Planes hold the rods of a \
                 box that is two of them wide, or one high.",
        ..RODS
    },
    Row {
        key: "compaction",
        source: "arXiv 2012.10399: soft grains that are pressed together",
        quantity: "n of the contacts of a grain as they grow, Z − Z₀ ~ (φ − φ₀)^n",
        published: Words("1/2"),
        reason: "Within 0.05 was to be, up to φ = 0.8, with affine balls in a box whose planes close in. Eight smooth \
                 ones (docs/examples/compaction) take half a minute of processor time until they fill 0.52 of the box; \
                 contacts that tell an exponent take hundreds of balls.",
        ..CROWD
    },
];
