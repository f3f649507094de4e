//! Links that are fixed to one another, and which body each is part of.

use crate::report::Report;
use crate::robot::{Connection, ConnectionKind, Link, Robot};

/// The name of the root that stands still by custom.
const WORLD: &str = "world";

/// What a link is part of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Host {
    /// It stands still.
    Space,
    /// The body of a link, its own or that of the one to which it is fixed.
    Link(usize),
    /// It has no mass, nor has what moves with it.
    Nothing,
}

/// The host of each link, and the groups of links that are fixed to one another.
#[derive(Debug)]
pub(super) struct Hosts {
    pub of: Vec<Host>,
    /// The first link of the group of each.
    first: Vec<usize>,
}

impl Hosts {
    /// What joins a body to another or to space: that of its link, or of its whole group.
    pub fn connection<'r>(&self, robot: &'r Robot, index: usize) -> &'r Connection {
        &robot.links[self.bearer(index)].connection
    }

    /// What that joins it to.
    pub fn parent(&self, robot: &Robot, index: usize) -> Host {
        let bearer = self.bearer(index);
        match robot.links[bearer].connection.parent {
            Some(parent) => self.of[parent],
            None => Host::Space,
        }
    }

    /// The links that have a body of their own, each behind that to which it is joined.
    pub fn bodies(&self, robot: &Robot) -> Vec<usize> {
        let mut depths: Vec<Option<usize>> = vec![None; robot.links.len()];
        let mut bodies: Vec<usize> =
            (0..robot.links.len()).filter(|index| self.of[*index] == Host::Link(*index)).collect();
        for index in &bodies {
            let mut way = Vec::new();
            let mut at = Some(*index);
            while let Some(index) = at.filter(|index| depths[*index].is_none()) {
                way.push(index);
                at = match self.parent(robot, index) {
                    Host::Link(parent) => Some(parent),
                    Host::Space | Host::Nothing => None,
                };
            }
            let above = at.and_then(|index| depths[index]);
            for (steps, index) in way.into_iter().rev().enumerate() {
                depths[index] = Some(above.map_or(0, |depth| depth + 1) + steps);
            }
        }
        bodies.sort_by_key(|index| depths[*index]);
        bodies
    }

    /// The link by whose connection the body of a link hangs: it stands for its group if all before it are lumped into
    /// it.
    fn bearer(&self, index: usize) -> usize {
        let first = self.first[index];
        if self.of[first] == Host::Link(index) { first } else { index }
    }
}

/// The first link of the group of each.
pub(super) fn firsts(robot: &Robot) -> Vec<usize> {
    let mut first: Vec<usize> = Vec::new();
    for (index, link) in robot.links.iter().enumerate() {
        first.push(parent_if_fixed(link).map_or(index, |parent| first[parent]));
    }
    first
}

/// The link to which one is fixed.
fn parent_if_fixed(link: &Link) -> Option<usize> {
    link.connection.parent.filter(|_| link.connection.kind == ConnectionKind::Fixed)
}

/// Which body each link is part of; notes links that move other ones and have no mass.
pub(super) fn hosts(robot: &Robot, is_base_fixed: bool, report: &mut Report) -> Hosts {
    let links = &robot.links;
    let first = firsts(robot);
    // The link with mass that each group has first, and whether anything beyond a group has mass.
    let mut head: Vec<Option<usize>> = vec![None; links.len()];
    let mut carries = vec![false; links.len()];
    for index in (0..links.len()).rev() {
        let group = first[index];
        if links[index].mass.is_some() {
            head[group] = Some(index);
        }
        if let Some(parent) = links[group].connection.parent.filter(|_| group == index) {
            carries[first[parent]] |= head[index].is_some() || carries[index];
        }
    }
    let mut of: Vec<Host> = Vec::new();
    for (index, link) in links.iter().enumerate() {
        let group = first[index];
        let is_held = group != index && of[group] == Host::Space;
        let host = if is_held || (group == index && stands_still(robot, index, head[index], is_base_fixed, report)) {
            Host::Space
        } else if link.mass.is_some() {
            Host::Link(index)
        } else if let Some(parent) = parent_if_fixed(link) {
            of[parent]
        } else if let Some(head) = head[index] {
            Host::Link(head)
        } else {
            let what = format!("\"{}\"", link.name);
            if carries[index] {
                let message = format!("{what} moves, carries others, and has no mass");
                report.fault_at(link.line, message, "give it a mass and an inertia, or fix it to one that has");
            } else {
                report.leave_out_at(link.line, what, "it moves, and neither it nor what is fixed to it has a mass");
            }
            Host::Nothing
        };
        of.push(host);
    }
    Hosts { of, first }
}

/// Whether the first link of a group stands still.
fn stands_still(robot: &Robot, index: usize, head: Option<usize>, is_base_fixed: bool, report: &mut Report) -> bool {
    let link = &robot.links[index];
    let (line, what) = (Some(link.line), format!("\"{}\"", link.name));
    if link.connection.kind != ConnectionKind::Root {
        return link.connection.kind == ConnectionKind::Fixed && link.connection.parent.is_none();
    }
    let why = if is_base_fixed {
        "it stands still, with all that is fixed to it, as asked by --fixed-base"
    } else if link.name == WORLD {
        "it stands still, with all that is fixed to it, by its name"
    } else if head.is_none() {
        "it stands still: neither it nor what is fixed to it has a mass"
    } else {
        report.choose(line, what, "no joint holds it, so it moves freely; --fixed-base holds it");
        return false;
    };
    report.choose(line, what, why);
    true
}
