//! The types of the study file: what can be written in it, section by section.
//!
//! The JSON Schema comes from them, and so does the check of a study's structure; what the values mean is decided in
//! `read`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value as Json;
use std::collections::BTreeMap;

/// A study of Gyration: a scene, what is varied in it, and what is kept of each run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StudyFile {
    /// What the study asks, in a line.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub title: Option<String>,
    /// The scene: a path relative to the study's file, or a name of the gallery.
    pub scene: String,
    /// Another seed gives other random numbers; a whole number.
    #[serde(default)]
    #[schemars(range(min = 0))]
    pub seed: f64,
    /// Runs of each point of the grid.
    #[serde(default = "one")]
    #[schemars(range(min = 1))]
    pub repetitions: f64,
    /// How the random parameters are spread over the repetitions.
    #[serde(default)]
    pub sampling: Sampling,
    /// Which runs leave a whole recording.
    #[serde(default)]
    pub recordings: Recordings,
    /// The most steps of a run: one that takes more is ended, with the outcome `step_limit`; no limit if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 1))]
    pub max_steps: Option<f64>,
    /// Changes to the scene that all runs share, by dotted key.
    #[serde(default)]
    pub set: BTreeMap<String, Json>,
    /// What is varied, by the name of its column.
    #[serde(default)]
    pub parameter: BTreeMap<String, Parameter>,
    /// What is kept of each run, by the name of its column.
    #[serde(default)]
    pub keep: BTreeMap<String, Keep>,
    /// How the table is drawn; read by `gyration study STUDY plot`.
    #[serde(default)]
    pub plot: Json,
}

fn one() -> f64 {
    1.0
}

/// How the random parameters are spread over the repetitions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Sampling {
    /// Each for itself.
    #[default]
    Random,
    /// Each parameter once in each of as many equal parts as there are repetitions.
    LatinHypercube,
    /// The points of Sobol, scrambled.
    Sobol,
}

/// Which runs leave a whole recording.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Recordings {
    /// None.
    #[default]
    None,
    /// Those that ended early.
    Failures,
    /// All.
    All,
}

/// Something that is varied: one or several keys, and exactly one of the ways in which they vary.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Parameter {
    /// The dotted key that is set.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub key: Option<String>,
    /// Several dotted keys, all set to the same value.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub keys: Option<Vec<String>>,
    /// An axis of the grid: these values.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub values: Option<Vec<Json>>,
    /// An axis of the grid: so many numbers between two.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub grid: Option<Grid>,
    /// Varied together with another axis of the same length, instead of crossed with it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub with: Option<String>,
    /// A random number, each as likely as any other.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub uniform: Option<Range>,
    /// A random number, each order of magnitude as likely as any other.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub log_uniform: Option<Range>,
    /// A random number of the normal distribution.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub normal: Option<Normal>,
    /// A random attitude; its key is an `orientation`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rotation: Option<Rotation>,
    /// A vector of random direction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub direction: Option<Direction>,
}

/// A number in SI units, or a string with a unit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(transparent)]
pub struct Measured(pub Json);

/// From one number to another.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Range {
    /// The least.
    pub from: Measured,
    /// The greatest.
    pub to: Measured,
}

/// Numbers between two.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Grid {
    /// The first.
    pub from: Measured,
    /// The last.
    pub to: Measured,
    /// How many, both ends included.
    #[schemars(range(min = 1))]
    pub count: f64,
    /// Whether differences or ratios are equal.
    #[serde(default)]
    pub spacing: Spacing,
}

/// What is equal from one number of a grid to the next.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Spacing {
    /// The difference.
    #[default]
    Linear,
    /// The ratio.
    Log,
}

/// The normal distribution.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Normal {
    /// Its mean.
    pub mean: Measured,
    /// Its standard deviation.
    pub deviation: Measured,
}

/// A distribution of attitudes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Rotation {
    /// Each attitude as likely as any other.
    Uniform,
}

/// A vector of random direction, each as likely as any other.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Direction {
    /// Its length: one, or `{ from, to }` with each as likely as any other.
    pub magnitude: Measured,
}

/// What is kept of each run: one of the ways, with what belongs to it.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Keep {
    /// The material axis of this body that points nearest to straight down, `+x` to `-z`, at the end or, with `at =
    /// "start"`, at the start.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub face: Option<String>,
    /// A column at the start; a number: so many of the first events or samples.
    #[serde(skip_serializing_if = "Json::is_null")]
    pub first: Json,
    /// A column at the end; a number: so many of the last events or samples.
    #[serde(skip_serializing_if = "Json::is_null")]
    pub last: Json,
    /// A column at the end less the same at the start.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub change: Option<String>,
    /// The smallest value of a column over the samples.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub minimum: Option<String>,
    /// The greatest value of a column over the samples.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub maximum: Option<String>,
    /// The mean of a column over time, by the samples.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mean: Option<String>,
    /// How many events of a kind: apex, closest_approach, lift_off; of all bodies, or of `body`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub count: Option<String>,
    /// `column` at the events of a kind, of all bodies or of `body`: a list, `first` or `last` so many. Of `face`:
    /// start or end.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at: Option<String>,
    /// `first` or `last` so many samples of a column: a list.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub samples: Option<String>,
    /// The body of the events.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub body: Option<String>,
    /// The column of `at`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub column: Option<String>,
    /// The largest angle (rad), over the samples, between the vertical and the material line of this body that was
    /// upright at the start.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tilt: Option<String>,
    /// How often the matter of this body turned about `axis`: by R of P = R U, in turns, signed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub turns: Option<String>,
    /// How often the form of this body turned about `axis`: by the longest axis of its form, seen along `axis`, in
    /// turns, signed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shape_turns: Option<String>,
    /// The axis of `turns` and `shape_turns`, z if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axis: Option<[f64; 3]>,
    /// The level distance (m) of the centre of mass of this body from its start; with `along`, signed, in that
    /// direction.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub distance: Option<String>,
    /// The direction of `distance`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub along: Option<[f64; 3]>,
    /// The time (s) to which `distance` is reduced: a period, or 1 for a mean speed; the whole run if absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub per: Option<Measured>,
}
