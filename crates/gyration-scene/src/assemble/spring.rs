//! Springs between bodies.

use super::body::{AssembledBody, lever};
use super::lattice::{Cells, check_cell};
use super::start::placement;
use crate::check::{PartialScene, Placed, Reporter};
use crate::file;
use crate::quantity::si;
use gyration::lattice::HERE;
use gyration::load::{Spring, SpringLaw};
use gyration::tensor::Vec3;
use std::collections::HashMap;

/// The springs between bodies; notes those that start without a direction.
pub(super) fn springs(
    partial: &PartialScene,
    assembled: &[Option<AssembledBody>],
    cells: Option<&Cells>,
    reporter: &mut Reporter<'_>,
) -> Vec<Spring> {
    let name = |(index, body): (usize, &Option<AssembledBody>)| Some((body.as_ref()?.name.clone(), index));
    let named: HashMap<String, usize> = assembled.iter().enumerate().filter_map(name).collect();
    let spring = |Placed { key, value, .. }: &Placed<file::SpringBetween>| {
        let [Some(&one), Some(&other)] = value.between.each_ref().map(|name| named.get(name)) else { return None };
        let bodies = [one, other];
        let cell = value.cell.map_or(HERE, |cell| cell.map(|n| n.0 as i32));
        if (one == other && cell == HERE) || (cell != HERE && !check_cell(cell, cells, &key.key("cell"), reporter)) {
            return None;
        }
        let away = cells.map_or_else(Vec3::zeros, |cells| cells.lattice.place(cell));
        let law = SpringLaw {
            stiffness: value.stiffness.value(),
            rest_length: value.rest_length.value(),
            damping: value.damping.value(),
        };
        let [Some(one), Some(other)] = bodies.map(|body| assembled[body].as_ref()) else { return None };
        let points: [Vec3; 2] = value.points.each_ref().map(si);
        for (end, _) in [one, other].into_iter().enumerate().filter(|(_, body)| body.body.is_point()) {
            lever(&points[end], &key.key("points").index(end), reporter);
        }
        let [here, there] =
            [(one, points[0]), (other, points[1])].map(|(end, point)| placement(&end.start).place(&point));
        if law.is_directed() && here == there + away {
            let [x, y, z] = here.into();
            let (first, second) = (&one.name, &other.name);
            let message = format!(
                "the spring starts with no length and has no direction: both points, of \"{first}\" and of \
                 \"{second}\", are at [{x}, {y}, {z}]"
            );
            let help = "move a body or a point, or leave out `rest_length` and `damping`";
            reporter.note(&key.key("points"), message, help);
        }
        Some(Spring::between(bodies, points, law).across(cell))
    };
    partial.springs.iter().filter_map(spring).collect()
}
