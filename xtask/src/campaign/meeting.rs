//! Random bodies that meet: a cluster that falls together, free or above a table, with contacts between bodies and
//! groups, springs between bodies, and the same scene once more with its bodies in another order or under other names.

use super::bodies::Member;
use super::contacts::{contact, meeting};
use super::draft::Draft;
use super::toml::{Vector, list, scaled};
use std::fmt::Write as _;

/// The group of all bodies.
const ALL: &str = "all";
/// A group of some of them.
const SOME: &str = "some";
/// The most places that are tried for a body.
const MOST_PLACES: usize = 200;

/// Bodies that meet, as the tables of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Meeting {
    /// Title, time, solver, world, supports.
    pub head: String,
    /// Contacts and springs.
    pub joints: Vec<String>,
    /// A table for each body.
    pub bodies: Vec<String>,
    /// Bodies alone in space: nothing changes their momenta.
    pub is_isolated: bool,
    /// Whether springs between bodies are the only loads.
    pub has_springs_alone: bool,
}

impl Meeting {
    /// Bodies that meet, after the head of a scene.
    pub fn of(draft: &mut Draft, head: String, has_table: bool) -> Self {
        draft.meets = true;
        let is_crowd = draft.stream.chance(0.12);
        let count = if is_crowd { 8 + draft.stream.index(5) } else { draft.stream.pick(&[2, 2, 2, 2, 2, 2, 3, 3, 4]) };
        let rest_gap = draft.size * draft.stream.decade(-3.0, -1.0);
        let members: Vec<Member> = (0..count).map(|_| Member::of(draft, count > 3)).collect();
        let places = places(draft, &members, rest_gap, has_table);
        let middle = [0, 1, 2].map(|axis| places.iter().map(|place| place[axis]).sum::<f64>() / count as f64);
        let is_some: Vec<bool> = (0..count).map(|_| draft.stream.chance(0.5)).collect();
        let mut bodies = Vec::new();
        for (k, (member, place)) in members.iter().zip(&places).enumerate() {
            let velocity = towards(draft, place, &middle);
            let groups = if is_some[k] { &[ALL, SOME][..] } else { &[ALL] };
            bodies.push(member.body(draft, &name(k), groups, *place, velocity));
        }
        let mut joints = contacts(draft, &is_some, rest_gap, is_crowd);
        if has_table {
            joints.push(contact(draft, 0, None, rest_gap));
        }
        if draft.stream.chance(0.3) {
            joints.push(spring(draft, count));
        }
        let loads = ["couple =", "linear_friction ="];
        let has_loads = bodies.iter().any(|body| loads.iter().any(|load| body.contains(load)));
        Self { head, joints, bodies, is_isolated: !has_table && !has_loads, has_springs_alone: !has_loads }
    }

    /// The text of the scene.
    pub fn text(&self) -> String {
        [&self.head, &self.joints.concat(), &self.bodies.concat()].map(String::as_str).concat()
    }

    /// The same scene with bodies, contacts and springs written in the opposite order.
    pub fn exchanged(&self) -> String {
        let reversed = |tables: &[String]| tables.iter().rev().map(String::as_str).collect::<String>();
        [self.head.clone(), reversed(&self.joints), reversed(&self.bodies)].concat()
    }

    /// The same scene with other names of bodies and groups, which sort otherwise.
    pub fn renamed(&self) -> String {
        let mut text = self.text();
        for k in 0..self.bodies.len() {
            text = text.replace(&quoted(&name(k)), &quoted(&format!("z{}", 99 - k)));
        }
        text.replace(&quoted(ALL), &quoted("whole")).replace(&quoted(SOME), &quoted("a-few"))
    }
}

fn name(k: usize) -> String {
    format!("b{k}")
}

fn quoted(word: &str) -> String {
    format!("\"{word}\"")
}

/// Places clear of one another, each beside an earlier one; above a table, clear of it.
fn places(draft: &mut Draft, members: &[Member], rest_gap: f64, has_table: bool) -> Vec<Vector> {
    let mut places: Vec<Vector> = Vec::new();
    for member in members {
        for attempt in 0.. {
            let Some(beside) = (!places.is_empty()).then(|| draft.stream.index(places.len())) else {
                places.push([0.0; 3]);
                break;
            };
            // A cluster that leaves no room is left wider and wider.
            let width = 1.0 + (attempt / MOST_PLACES) as f64;
            let gap = draft.size * draft.stream.decade(-2.0, 0.0) * width + rest_gap;
            let away = member.radius + members[beside].radius + gap;
            let way = scaled(draft.stream.direction(), away);
            let place = [0, 1, 2].map(|axis| places[beside][axis] + way[axis]);
            let is_clear =
                |(at, other): (&Vector, &Member)| distance(at, &place) > 1.001 * (member.radius + other.radius);
            if places.iter().zip(members).all(is_clear) {
                places.push(place);
                break;
            }
        }
    }
    if has_table {
        let lowest = places.iter().zip(members).map(|(at, member)| at[2] - member.radius).fold(0.0, f64::min);
        let lift = rest_gap * draft.stream.decade(0.0, 1.0) - lowest;
        places.iter_mut().for_each(|place| place[2] += lift);
    }
    places
}

fn distance(a: &Vector, b: &Vector) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

/// A velocity to the middle of the cluster and a little beside it.
fn towards(draft: &mut Draft, place: &Vector, middle: &Vector) -> Vector {
    let far = distance(place, middle).max(draft.size);
    let (speed, beside) = (draft.speed() * draft.stream.decade(-1.0, 0.3), draft.stream.direction());
    [0, 1, 2].map(|axis| speed * ((middle[axis] - place[axis]) / far + 0.3 * beside[axis]))
}

/// A contact of all with all or of two bodies, and now and then one more.
fn contacts(draft: &mut Draft, is_some: &[bool], rest_gap: f64, is_crowd: bool) -> Vec<String> {
    let (first, last) = (name(0), name(is_some.len() - 1));
    let mut list = match !is_crowd && draft.stream.chance(0.2) {
        true => vec![meeting(draft, [&first, &last], rest_gap)],
        false => vec![meeting(draft, [ALL, ALL], rest_gap)],
    };
    if draft.stream.chance(0.25) {
        // Whoever is named there, somebody else is in the other group.
        let has_two = is_some.iter().filter(|is_some| **is_some).count() > 1;
        let between = match draft.stream.index(3) {
            0 if has_two => [SOME, SOME],
            1 if has_two => [first.as_str(), SOME],
            _ => [last.as_str(), ALL],
        };
        list.push(meeting(draft, between, rest_gap));
    }
    list
}

/// A spring between two bodies, or a chain of two.
fn spring(draft: &mut Draft, count: usize) -> String {
    let (size, mass) = (draft.size, draft.mass);
    let mut text = String::new();
    for k in 1..count.min(2 + draft.stream.index(2)) {
        let stiffness = mass * draft.pull / size * draft.stream.decade(-1.0, 2.0);
        let points = [0, 1].map(|_| list(&scaled(draft.stream.direction(), 0.5 * size)));
        let _ = writeln!(
            text,
            "[[spring]]\nbetween = [\"{}\", \"{}\"]\npoints = [{}]\nstiffness = {stiffness:?}\nrest_length = {:?}",
            name(k),
            name(k - 1),
            points.join(", "),
            size * draft.stream.between(0.5, 3.0)
        );
        if draft.stream.chance(0.5) {
            let damping = (stiffness * mass).sqrt() * draft.stream.decade(-2.0, 0.0);
            let _ = writeln!(text, "damping = {damping:?}");
        }
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::super::scene::RandomScene;
    use super::*;

    fn meetings() -> impl Iterator<Item = Meeting> {
        (0..400).filter_map(|case| RandomScene::of(1, case).meeting)
    }

    #[test]
    fn every_kind_of_meeting_is_drawn() {
        let all: String = meetings().map(|meeting| meeting.text()).collect();
        let words = [
            "between = [\"all\", \"all\"]",
            "between = [\"b0\", \"b1\"]",
            "\"some\"]",
            "reach",
            "[[spring]]",
            "[[support]]",
            "union",
            "mesh",
            "affine",
            "contractile",
            "name = \"b11\"",
        ];
        for word in words {
            assert!(all.contains(word), "no scene has `{word}`");
        }
        let isolated = meetings().filter(|meeting| meeting.is_isolated).count();
        assert!(isolated > 50 && isolated < meetings().count() - 50, "{isolated}");
    }

    #[test]
    fn another_order_and_other_names_tell_of_the_same_bodies() {
        for meeting in meetings().take(50) {
            let sorted = |text: &str| {
                let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
                lines.sort();
                lines
            };
            assert_eq!(sorted(&meeting.exchanged()), sorted(&meeting.text()));
            let renamed = meeting.renamed();
            assert!(!renamed.contains("\"b0\"") && !renamed.contains("\"all\""), "{renamed}");
            assert_eq!(renamed.lines().count(), meeting.text().lines().count());
        }
    }
}
