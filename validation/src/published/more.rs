//! Stacks of balls, the cradle, dominoes, and what is outside.

use super::Published::{Number, Words};
use super::Row;
use super::Verdict::{Agrees, Disagrees, NotRun, Outside};

const STACK: Row = Row {
    key: "",
    source: "a ball on a ball that falls, impacts one after another: (3m₁ − m₂)v/(m₁ + m₂) above, (m₁ − 3m₂)v/(m₁ + \
             m₂) below; laboratories find the same sign (arXiv 1009.6153)",
    quantity: "",
    published: Number(2.555_555_555_556),
    reading: 0.0,
    tolerance: 1e-6,
    expected: Agrees,
    completed: "R = 20 and 10 mm of 2500 kg/m³, both with 1 m/s, no gravity, e = 1; α = 1 MPa, d₀ = 0.1 mm, ν = 6, the \
                lower one 1 mm above the floor. The gap between the balls is the same with every d₀.",
    reason: "",
};

const CLOSE: Row = Row {
    tolerance: 1e-3,
    expected: Disagrees,
    completed: "As above, with d₀ = 0.1 mm alone: with a smaller one at the same gap the impacts come apart.",
    reason: "Within the law's own range the upper ball is turned back before the lower one has left the floor: the \
             impacts overlap, as those of balls that touch do in the laboratory. Besides, the field drives the balls \
             apart on their way to the floor, at 0.03 mm with an eighteenth of their energy.",
    ..STACK
};

const CRADLE: Row = Row {
    source: "Hutzler, Delaney, Weaire & MacLeod, Am. J. Phys. 72 (2004) 1508",
    tolerance: 1e-9,
    completed: "The cradle of the gallery: five balls of 20 mm on pins, 0.2 mm apart, the first one lifted by 40°. \
                The authors say in words that the line breaks up; it is read as a count.",
    ..STACK
};

pub(super) const ROWS: &[Row] = &[
    Row { key: "stack-10-mm-upper", quantity: "velocity of the upper ball, 10 mm between them [m/s]", ..STACK },
    Row {
        key: "stack-10-mm-lower",
        quantity: "velocity of the lower ball, 10 mm between them [m/s]",
        published: Number(0.555_555_555_556),
        ..STACK
    },
    Row { key: "stack-1-mm-upper", quantity: "velocity of the upper ball, 1 mm between them [m/s]", ..STACK },
    Row { key: "stack-0.1-mm-upper", quantity: "velocity of the upper ball, 0.1 mm between them [m/s]", ..CLOSE },
    Row { key: "stack-0.03-mm-upper", quantity: "velocity of the upper ball, 0.03 mm between them [m/s]", ..CLOSE },
    Row {
        key: "cradle-breaks",
        quantity: "neighbours that part with more than 1e-3 of the speed at the first knock, of 4",
        published: Number(4.0),
        expected: Disagrees,
        reason: "Declared to agree before the first run. Balls that hang side by side push one another to some 0.3 mm \
                 apart, and an impact turns back at less than a tenth of that: the impacts follow one another, and \
                 only the last ball leaves, as the textbook has it. It does so, too, where the balls start from their \
                 rest state: the others then keep 1e-4 of the speed. Those of the authors touch.",
        ..CRADLE
    },
    Row {
        key: "cradle-in-phase",
        quantity: "largest difference of the velocities of two balls over the largest one, in the last second of 60 s",
        published: Number(0.0),
        tolerance: 0.05,
        completed: "The cradle of the gallery with damping of c = 5 s/m between the balls. The authors say in words \
                    that all balls end in phase; it is read as within 5 %, of velocities. Angles after 20 s were \
                    declared first; they have 0.006 rad in them by which the balls lean apart at rest.",
        ..CRADLE
    },
    Row {
        key: "dominoes",
        source: "van Leeuwen, arXiv physics/0401018: dominoes that rest on one another without friction, no slip at \
                 the foot",
        quantity: "speed of the wave over √(gH), d/H = 0.15, s/H = 0.4",
        published: Number(1.759_737),
        tolerance: 2e-2,
        completed: "The last step of fifteen boxes of 7.5 × 25 × 50 mm and 700 kg/m³: twelve were declared first, \
                    where the wave still grows and is at 1.724. α = 1 kPa, d₀ = 0.1 mm, ν = 6, damping c = 50 s/m, \
                    friction c = 300 s/m at the foot and none between them; reach 5 mm. One run: the tolerance is that \
                    of a row which is not long.",
        ..STACK
    },
    Row {
        key: "dominoes-friction",
        source: "Larham (2007), dominoes with friction: v = √(gH) G(s/H)",
        quantity: "measured speed of the wave with friction",
        published: Words("a figure of G"),
        tolerance: 0.0,
        expected: NotRun,
        completed: "",
        reason: "The figure's numbers and the friction of the dominoes measured are not at hand.",
        ..STACK
    },
    Row {
        key: "rocking-prisms",
        source: "Lipscombe & Pellegrino, J. Eng. Mech. 119 (1993) 1387",
        quantity: "number of impacts and time to rest of steel prisms of aspect 1 to 4",
        published: Words("figures"),
        tolerance: 0.0,
        expected: NotRun,
        completed: "",
        reason: "The numbers stand in the authors' figures alone, and have not been read off. Short prisms that leave \
                 the ground and slender ones that do not exist here.",
        ..STACK
    },
    Row {
        key: "foam-balls",
        source: "arXiv 2411.05891: balls of foam and hydrogel",
        quantity: "restitution against the speed of impact",
        published: Words("grows"),
        tolerance: 0.0,
        expected: Outside,
        completed: "",
        reason: "The restitution of a viscous affine body falls with the speed, and so does that of a contact with \
                 damping.",
        ..STACK
    },
];
