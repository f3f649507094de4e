//! `[keep]`: one thing each, with what belongs to it.

use crate::file;
use crate::keep::{Keep, Pick, Statistic};
use crate::written::measured;
use gyration::tensor::Vec3;
use gyration_scene::input::InputFile;
use gyration_sim::events::EVENT_KINDS;
use serde_json::Value as Json;

/// The ways to keep something, each with what may stand beside it.
const WAYS: [(&str, &[&str]); 14] = [
    ("face", &["at"]),
    ("first", &[]),
    ("last", &[]),
    ("change", &[]),
    ("minimum", &[]),
    ("maximum", &[]),
    ("mean", &[]),
    ("count", &["body"]),
    ("at", &["body", "column", "first", "last"]),
    ("samples", &["first", "last"]),
    ("tilt", &[]),
    ("turns", &["axis"]),
    ("shape_turns", &["axis"]),
    ("distance", &["along", "per"]),
];

/// The most values of a list.
const MOST_LISTED: f64 = 1e6;

/// Notes what is wrong with one thing that is kept.
struct KeepReader<'a> {
    input: &'a mut InputFile,
    name: &'a str,
}

/// What is kept, in its order.
pub(super) fn keeps(input: &mut InputFile) -> Vec<(String, Keep)> {
    let mut keeps = Vec::new();
    for name in input.keys(&["keep"]) {
        let Some(written) = input.take::<file::Keep>(&["keep", &name]) else { continue };
        if let Some(keep) = (KeepReader { input, name: &name }).keep(&written) {
            keeps.push((name, keep));
        }
    }
    keeps
}

impl KeepReader<'_> {
    fn note(&mut self, keys: &[&str], message: impl Into<String>, help: impl Into<String>) {
        self.input.note(&[&["keep", self.name][..], keys].concat(), message, help);
    }

    fn keep(&mut self, written: &file::Keep) -> Option<Keep> {
        let way = self.way(written)?;
        let column = |column: &Option<String>, measure| Some(Keep::Column { column: column.clone()?, measure });
        let text = |value: &Json| value.as_str().map(str::to_owned);
        match way {
            "face" => {
                let at_start = match written.at.as_deref() {
                    None | Some("end") => false,
                    Some("start") => true,
                    Some(other) => {
                        self.note(&["at"], format!("\"{other}\" is not known here"), "write \"start\" or \"end\"");
                        return None;
                    }
                };
                Some(Keep::Face { body: written.face.clone()?, at_start })
            }
            "first" => column(&text(&written.first), Statistic::First),
            "last" => column(&text(&written.last), Statistic::Last),
            "change" => column(&written.change, Statistic::Change),
            "minimum" => column(&written.minimum, Statistic::Minimum),
            "maximum" => column(&written.maximum, Statistic::Maximum),
            "mean" => column(&written.mean, Statistic::Mean),
            "count" => {
                let event = self.event("count", written.count.as_deref()?)?;
                Some(Keep::Count { event, body: written.body.clone() })
            }
            "at" => self.at(written),
            "samples" => Some(Keep::Samples { column: written.samples.clone()?, pick: self.pick(written)? }),
            "tilt" => Some(Keep::Tilt { body: written.tilt.clone()? }),
            "turns" => self.turns(written.turns.as_ref(), written.axis, false),
            "shape_turns" => self.turns(written.shape_turns.as_ref(), written.axis, true),
            _ => self.distance(written),
        }
    }

    /// The one way that is written; what does not belong to it is noted.
    fn way(&mut self, written: &file::Keep) -> Option<&'static str> {
        let keys = self.input.keys(&["keep", self.name]);
        let is_way = |way: &str| match way {
            "first" => written.first.is_string(),
            "last" => written.last.is_string(),
            "at" => written.face.is_none(),
            _ => true,
        };
        let ways: Vec<_> = WAYS.iter().filter(|(way, _)| is_way(way) && keys.iter().any(|key| key == way)).collect();
        let [(way, beside)] = ways[..] else {
            let found: Vec<&str> = ways.iter().map(|(way, _)| *way).collect();
            let found = if found.is_empty() { "none".to_owned() } else { found.join(" and ") };
            let help = format!("write one of {}", WAYS.map(|(way, _)| way).join(", "));
            self.note(&[], format!("expected exactly one thing to keep, found {found}"), help);
            return None;
        };
        let mut fits = true;
        for key in keys.iter().filter(|key| key != way && !beside.contains(&key.as_str())) {
            let help = match beside[..] {
                [] => "leave it out".to_owned(),
                _ => format!("beside `{way}` may stand {}", beside.join(", ")),
            };
            self.note(&[key], format!("`{key}` does not belong to `{way}`"), help);
            fits = false;
        }
        fits.then_some(way)
    }

    fn event(&mut self, key: &str, kind: &str) -> Option<usize> {
        let found = EVENT_KINDS.iter().position(|known| *known == kind);
        if found.is_none() {
            let help = super::known(kind, EVENT_KINDS.iter().copied(), "kinds of events");
            self.note(&[key], format!("there is no event \"{kind}\""), help);
        }
        found
    }

    fn at(&mut self, written: &file::Keep) -> Option<Keep> {
        let event = self.event("at", written.at.as_deref()?)?;
        let pick = self.pick(written)?;
        let Some(column) = written.column.clone() else {
            self.note(&[], "the key \"column\" is missing", "add the column that is kept, column = \"ball.z\"");
            return None;
        };
        Some(Keep::At { event, body: written.body.clone(), column, pick })
    }

    fn pick(&mut self, written: &file::Keep) -> Option<Pick> {
        let (key, number, pick): (_, _, fn(usize) -> Pick) = match (&written.first, &written.last) {
            (Json::Null, Json::Number(last)) => ("last", last, Pick::Last),
            (Json::Number(first), Json::Null) => ("first", first, Pick::First),
            _ => {
                self.note(&[], "expected exactly one of `first` and `last`", "write how many are kept, last = 32");
                return None;
            }
        };
        let number = number.as_f64().unwrap_or(f64::NAN);
        if !(1.0..=MOST_LISTED).contains(&number) || number.fract() != 0.0 {
            self.note(&[key], format!("{number:?} is no count of values"), "write a whole number, 1 to 1000000");
            return None;
        }
        Some(pick(number as usize))
    }

    fn turns(&mut self, body: Option<&String>, axis: Option<[f64; 3]>, of_form: bool) -> Option<Keep> {
        let axis = match axis {
            Some(axis) => self.direction("axis", axis)?,
            None => Vec3::z(),
        };
        Some(Keep::Turns { body: body?.clone(), axis, of_form })
    }

    fn distance(&mut self, written: &file::Keep) -> Option<Keep> {
        let along = match written.along {
            Some(along) => Some(self.direction("along", along)?),
            None => None,
        };
        let per = match &written.per {
            Some(per) => match measured(&per.0, "time.end") {
                Ok(per) if per > 0.0 => Some(per),
                Ok(per) => {
                    self.note(&["per"], format!("{per:?} s is no duration"), "write a time greater than 0");
                    return None;
                }
                Err((message, help)) => {
                    self.note(&["per"], message, help);
                    return None;
                }
            },
            None => None,
        };
        Some(Keep::Distance { body: written.distance.clone()?, along, per })
    }

    fn direction(&mut self, key: &str, vector: [f64; 3]) -> Option<Vec3> {
        let direction = Vec3::from(vector).try_normalize(0.0);
        if direction.is_none() {
            self.note(&[key], "the direction is zero", "write a direction, [0, 0, 1]");
        }
        direction
    }
}
