//! What keeps bodies apart on their way to rest: no step takes one through another.
//!
//!   w = n·(p_A − p_B) − h_A(−P_Aᵀn) − h_B(P_Bᵀn),   h the support functions of the two parts
//!
//! is the width along n of the slab between them. Along straight ways w is concave: where it is positive at both ends
//! of a step, with the n of its start, the two have not met in between. Of bodies out of reach n is along the line of
//! centres, and h are the radii of spheres about them. Distances keep a part of their values.

use super::frozen::FrozenSystem;
use gyration::load::Party;
use gyration::neighbours::{Pair, PairKey};
use gyration::pair::PairGap;
use gyration::surface::{GapField, Surface};
use gyration::tensor::{Mat3, Vec3};
use std::collections::{HashMap, HashSet};

/// The part of a distance, and of det P, that a step must leave.
pub(super) const LEAST_KEPT: f64 = 0.1;

/// The planes between all that meet, at one configuration.
pub(super) struct Barriers(Vec<Barrier>);

/// What stands between two that meet.
struct Barrier {
    pair: Pair,
    /// n, from B to A.
    normal: Vec3,
    /// How far they are apart at the start of the step.
    apart: Apart,
}

/// How far two are apart [m].
enum Apart {
    /// Within reach: the width of the slab between them.
    Slab(f64),
    /// The distance of the spheres about them.
    Spheres(f64),
}

/// One of two that meet: p and P, and its part.
struct End<'a> {
    place: Vec3,
    gradient: Mat3,
    surface: &'a Surface,
    radius: f64,
}

impl Barriers {
    /// Those at a configuration whose gaps were found last.
    pub fn at(frozen: &FrozenSystem, numbers: &[f64]) -> Self {
        let model = frozen.model();
        if model.rules().is_empty() {
            return Self(Vec::new());
        }
        let found = frozen.found_gaps();
        let mut barriers: Vec<Barrier> =
            found.iter().filter_map(|(pair, slab)| Barrier::between(frozen, numbers, pair.clone(), slab)).collect();
        if !found.is_whole() {
            let listed: HashSet<_> = found.iter().map(|(pair, _)| pair.key()).collect();
            let all = model.pairs().chain(model.pairs_with_supports().iter().cloned());
            let others = all.filter(|pair| !listed.contains(&pair.key()));
            barriers.extend(others.filter_map(|pair| Barrier::between(frozen, numbers, pair, &PairGap::FAR)));
        }
        Self(barriers)
    }

    /// Whether all are still on their sides, at a configuration whose gaps were found last.
    pub fn hold(&self, frozen: &FrozenSystem, numbers: &[f64]) -> bool {
        let found: HashMap<PairKey, f64> = match self.0.is_empty() {
            true => HashMap::new(),
            false => frozen.found_gaps().iter().map(|(pair, slab)| (pair.key(), slab.gap)).collect(),
        };
        self.0.iter().all(|Barrier { pair, normal, apart }| {
            let ends = ends(frozen, numbers, pair);
            match apart {
                Apart::Spheres(before) => width_of_spheres(&ends, normal) > LEAST_KEPT * before,
                Apart::Slab(before) => {
                    let gap = found.get(&pair.key()).copied().unwrap_or(f64::INFINITY);
                    gap > LEAST_KEPT * before && width(&ends, normal) > 0.0
                }
            }
        })
    }
}

impl Barrier {
    /// None where neither slab nor spheres part the two.
    fn between(frozen: &FrozenSystem, numbers: &[f64], pair: Pair, slab: &PairGap) -> Option<Self> {
        if slab.gap < f64::INFINITY {
            return Some(Self { pair, normal: slab.normal, apart: Apart::Slab(slab.gap) });
        }
        let ends = ends(frozen, numbers, &pair);
        let normal = (ends[0].place - ends[1].place).try_normalize(0.0)?;
        let apart = width_of_spheres(&ends, &normal);
        (apart > 0.0).then_some(Self { pair, normal, apart: Apart::Spheres(apart) })
    }
}

/// The two of a pair, in one frame.
fn ends<'a>(frozen: &'a FrozenSystem, numbers: &[f64], pair: &Pair) -> [End<'a>; 2] {
    let model = frozen.model();
    let is_among_bodies = pair.parties.iter().all(|party| matches!(party, Party::Body(_)));
    let end = |k: usize| {
        let (solid, placement) = match pair.parties[k] {
            Party::Body(body) => {
                let mut placement = frozen.motion(numbers, body).placement;
                if !is_among_bodies {
                    placement.position = frozen.in_space(body, &placement.position);
                } else if k == 1 {
                    placement.position += model.lattice.place(pair.cell);
                }
                (&*model.bodies[body].solid, placement)
            }
            Party::SolidSupport(support) => {
                let support = &model.solid_supports[support];
                (&*support.solid, support.at(frozen.time()).placement)
            }
            Party::Support(_) | Party::Space => unreachable!("a pair is between solids"),
        };
        let part = pair.parts[k];
        End {
            place: placement.position,
            gradient: placement.gradient,
            surface: solid.part(part),
            radius: solid.part_radius(part) * placement.gradient.singular_values().max(),
        }
    };
    [end(0), end(1)]
}

/// w.
fn width([one, other]: &[End; 2], normal: &Vec3) -> f64 {
    let extent = |end: &End, along: Vec3| -end.surface.smallest_gap(&GapField::new(0.0, end.gradient.tr_mul(&along))).0;
    normal.dot(&(one.place - other.place)) - extent(one, *normal) - extent(other, -normal)
}

fn width_of_spheres([one, other]: &[End; 2], normal: &Vec3) -> f64 {
    normal.dot(&(one.place - other.place)) - one.radius - other.radius
}
