//! Masses without inertia on links that are fixed to others: they are lumped into what they are fixed to.

use super::groups::{Host, Hosts, firsts};
use crate::report::Report;
use crate::robot::Robot;
use gyration::mass::MassProperties;

/// The masses that are taken, each with the link that it was taken from.
pub(super) type Points = Vec<(usize, MassProperties)>;

/// Takes the masses without inertia of links that are fixed to one with inertia; of several without, all but the first.
pub(super) fn take(robot: &mut Robot) -> Points {
    let first = firsts(robot);
    let is_point = |mass: &MassProperties| mass.euler_tensor.trace() == 0.0;
    // The link of each group that keeps its mass if it is a point.
    let mut kept: Vec<Option<usize>> = vec![None; robot.links.len()];
    for (index, link) in robot.links.iter().enumerate() {
        if let Some(mass) = &link.mass {
            let keeper = &mut kept[first[index]];
            if keeper.is_none_or(|other| robot.links[other].mass.is_some_and(|it| is_point(&it)) && !is_point(mass)) {
                *keeper = Some(index);
            }
        }
    }
    let mut points = Points::new();
    for (index, link) in robot.links.iter_mut().enumerate() {
        let Some(mass) = link.mass.filter(|mass| is_point(mass) && kept[first[index]] != Some(index)) else { continue };
        link.mass = None;
        points.push((index, mass));
    }
    points
}

/// Adds the masses that were taken to the bodies that their links are part of; tells so.
pub(super) fn lump(robot: &mut Robot, hosts: &Hosts, points: &Points, report: &mut Report) {
    for (index, point) in points {
        let Host::Link(host) = hosts.of[*index] else { continue };
        let link = &robot.links[*index];
        let what = format!("\"{}\" has a mass and no inertia", link.name);
        report.choose(Some(link.line), what, format!("it is part of \"{}\"", robot.links[host].name));
        let pose = link.pose.within(&robot.links[host].pose);
        let placed = point.transformed(&pose.rotation.rotation(), &pose.position);
        let mass = &mut robot.links[host].mass;
        *mass = mass.iter().copied().chain([placed]).reduce(|sum, own| sum.combined(&own));
    }
}
