//! What a picture of a study shows: asked for by the arguments, else by the study's `[plot]`, else by the columns.
//!
//! ```toml
//! [plot]
//! kind = "curve"                      # histogram | curve | map | scatter
//! x = "damping"                       # a column
//! y = "face=first"                    # a column, or the share of the runs in which it has one of some values
//! colour = "speed"                    # a column
//! logarithmic = ["x", "colour"]       # axes, beside those that the grid makes so
//! title = "…"
//! reference = [{ name = "measured", points = [[0.1, 0.2], [0.3, 0.4]], line = false }]
//! ```

use crate::error::PlotError;
use gyration_study::Study;
use serde::Deserialize;

/// A kind of picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PlotKind {
    /// How often each word or number came.
    Histogram,
    /// Means or shares over a parameter, with their intervals.
    Curve,
    /// Cells over two parameters of the grid, coloured.
    Map,
    /// A dot a run, or as many as its list is long.
    Scatter,
}

impl PlotKind {
    /// The words of the kinds.
    pub const WORDS: [&str; 4] = ["histogram", "curve", "map", "scatter"];

    /// The kind of a word.
    ///
    /// # Errors
    /// [`PlotError::Arguments`] if there is none.
    pub fn of_word(word: &str) -> Result<Self, PlotError> {
        let kinds = [Self::Histogram, Self::Curve, Self::Map, Self::Scatter];
        Self::WORDS.iter().position(|known| *known == word).map(|index| kinds[index]).ok_or_else(|| {
            let fix = format!("choose one of {}", Self::WORDS.join(", "));
            PlotError::arguments(format!("there is no kind of picture `{word}`"), fix)
        })
    }
}

/// The keys of a [`PlotRequest`]; the last is another word for `colour`.
const KEYS: [&str; 8] = ["kind", "x", "y", "colour", "logarithmic", "title", "reference", "color"];

/// What is asked for.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PlotRequest {
    /// The kind of picture.
    pub kind: Option<PlotKind>,
    /// The column of the axis to the right.
    pub x: Option<String>,
    /// The column of the axis upwards; `NAME=VALUE,VALUE` is a share.
    pub y: Option<String>,
    /// The column that colours tell.
    #[serde(alias = "color")]
    pub colour: Option<String>,
    /// What is to be logarithmic: "x", "y", "colour".
    pub logarithmic: Vec<String>,
    /// What stands above.
    pub title: Option<String>,
    /// What is known from elsewhere.
    pub reference: Vec<Reference>,
}

/// Values from elsewhere.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Reference {
    /// Their name in the legend.
    pub name: String,
    /// The values (x, y).
    pub points: Vec<[f64; 2]>,
    /// Whether they are joined by a line.
    #[serde(default)]
    pub line: bool,
}

impl PlotRequest {
    /// The request of a `[plot]` table.
    ///
    /// # Errors
    /// [`PlotError::Arguments`] where a key is unknown or a value of another kind.
    pub fn of_json(table: &serde_json::Value) -> Result<Self, PlotError> {
        Self::deserialize(table).map_err(|_| {
            let unknown = table.as_object().and_then(|table| table.keys().find(|key| !KEYS.contains(&key.as_str())));
            let reason = match unknown {
                Some(key) => format!("[plot] of the study has no key `{key}`"),
                None => "a value of [plot] of the study is of another kind than its key takes".to_owned(),
            };
            PlotError::arguments(reason, format!("its keys are {}", KEYS[..KEYS.len() - 1].join(", ")))
        })
    }

    /// What a study says of its picture, with its title.
    ///
    /// # Errors
    /// [`PlotError::Arguments`] where its `[plot]` says what cannot be drawn from its columns.
    pub fn of_study(study: &Study) -> Result<Self, PlotError> {
        let request = match study.plot() {
            plot if plot.is_null() => Self::default(),
            plot => Self::of_json(plot)?,
        };
        let columns: Vec<&str> = study.columns().iter().map(|column| column.name.as_str()).collect();
        let asked = [&request.x, &request.y, &request.colour].into_iter().flatten();
        for name in asked.map(|name| name.split('=').next().unwrap_or(name).trim()) {
            if !columns.contains(&name) {
                let problem = format!("[plot] of {} names a column `{name}`, which it will not have", study.name());
                return Err(PlotError::arguments(problem, format!("its columns are {}", columns.join(", "))));
            }
        }
        if let Some(axis) = request.logarithmic.iter().find(|axis| !Self::AXES.contains(&axis.as_str())) {
            let problem = format!("[plot] of {} has a logarithmic axis `{axis}`", study.name());
            return Err(PlotError::arguments(problem, "write some of \"x\", \"y\", \"colour\""));
        }
        Ok(request)
    }

    /// This request, and where it says nothing the other one; what depends on the columns of the other is dropped if
    /// this one names columns of its own.
    #[must_use]
    pub fn or(self, other: Self) -> Self {
        let own = self.x.is_some() || self.y.is_some() || self.kind.is_some();
        Self {
            kind: self.kind.or(if own { None } else { other.kind }),
            x: self.x.or(if own { None } else { other.x }),
            y: self.y.or(if own { None } else { other.y }),
            colour: self.colour.or(if own { None } else { other.colour }),
            logarithmic: if own { self.logarithmic } else { other.logarithmic },
            title: self.title.or(if own { None } else { other.title }),
            reference: if own { self.reference } else { other.reference },
        }
    }

    /// The words under `logarithmic`.
    const AXES: [&str; 4] = ["x", "y", "colour", "color"];

    /// Whether an axis is asked to be logarithmic.
    pub fn is_logarithmic(&self, axis: &str) -> bool {
        self.logarithmic.iter().any(|name| name == axis)
    }
}

/// What goes upwards: a column, or the share of the runs in which a column has one of these values.
#[derive(Debug, Clone, PartialEq)]
pub struct Ordinate {
    /// The column.
    pub column: String,
    /// The values, or columns with which it is to agree; empty: the column itself.
    pub values: Vec<String>,
}

impl Ordinate {
    /// Reads `face`, `face=+z,-z`, `face=first`.
    pub fn read(text: &str) -> Self {
        match text.split_once('=') {
            None => Self { column: text.to_owned(), values: Vec::new() },
            Some((column, values)) => Self {
                column: column.trim().to_owned(),
                values: values.split(',').map(|value| value.trim().to_owned()).collect(),
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_study_says_what_the_arguments_do_not() {
        let study = serde_json::json!({ "kind": "map", "x": "a", "y": "b", "color": "c" });
        let study = PlotRequest::of_json(&study).unwrap();
        assert_eq!(PlotRequest::default().or(study.clone()), study);
        let own = PlotRequest { colour: Some("d".into()), ..PlotRequest::default() }.or(study.clone());
        assert_eq!((own.x.as_deref(), own.colour.as_deref()), (Some("a"), Some("d")));
        let other = PlotRequest { y: Some("e".into()), ..PlotRequest::default() }.or(study);
        assert_eq!((other.kind, other.x, other.colour), (None, None, None));
    }

    #[test]
    fn an_unknown_key_is_told() {
        let error = PlotRequest::of_json(&serde_json::json!({ "colors": "c" })).unwrap_err();
        assert!(error.to_string().contains("no key `colors`"), "{error}");
        let error = PlotRequest::of_json(&serde_json::json!({ "x": 1 })).unwrap_err();
        assert!(error.to_string().contains("of another kind"), "{error}");
    }
}
