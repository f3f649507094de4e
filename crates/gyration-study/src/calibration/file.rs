//! The types of a file of measurements: what can be written in it, section by section.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value as Json;
use std::collections::BTreeMap;

/// Measurements from which numbers of a scene are found.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CalibrationFile {
    /// What was measured, in a line.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub title: Option<String>,
    /// The scene: a path relative to this file, or a name of the gallery.
    pub scene: String,
    /// Changes to the scene that all measurements share, by dotted key.
    #[serde(default)]
    pub set: BTreeMap<String, Json>,
    /// The numbers to find, by a name of one's own.
    pub fit: BTreeMap<String, Fit>,
    /// Drop heights and rebound heights.
    #[serde(default)]
    pub drop: Vec<Drop>,
    /// Gaps at rest.
    #[serde(default)]
    pub gap: Vec<Gap>,
    /// Slopes, and the speed with which a body slides down them.
    #[serde(default)]
    pub slope: Vec<Slope>,
    /// Forces that tear a body off its support.
    #[serde(default)]
    pub pull_off: Vec<PullOff>,
    /// Frequencies of waves through a lattice.
    #[serde(default)]
    pub dispersion: Vec<Dispersion>,
}

/// A number to find.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Fit {
    /// The dotted key of a number of the scene.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub key: Option<String>,
    /// Several dotted keys that share the number.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub keys: Option<Vec<String>>,
    /// Where the search starts; the scene's own number if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start: Option<Json>,
    /// The least that it may be; needs `to`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub from: Option<Json>,
    /// The most that it may be; needs `from`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub to: Option<Json>,
    /// Whether steps are factors or differences: factors of a positive number, if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scale: Option<Scale>,
}

/// What counts as a step of a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Scale {
    /// A factor.
    Log,
    /// A difference.
    Linear,
}

/// A table of measurements; each list may be a single number.
macro_rules! measurements {
    ($(#[$about:meta])* $name:ident { $($(#[$doc:meta])* $column:ident),* $(; $(#[$told:meta])* $flag:ident)? }) => {
        $(#[$about])*
        #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
        #[serde(deny_unknown_fields)]
        pub struct $name {
            /// The body, by name; the only one if absent.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            pub body: Option<String>,
            /// Changes to the scene for these measurements, by dotted key.
            #[serde(default)]
            pub set: BTreeMap<String, Json>,
            /// A CSV file with columns of the names below, in SI units, relative to this file.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            pub table: Option<String>,
            /// Standard deviation of what was measured: a number, or one a row.
            #[serde(default, skip_serializing_if = "Option::is_none")]
            pub deviation: Option<Json>,
            $($(#[$doc])*
            #[serde(default, skip_serializing_if = "Option::is_none")]
            pub $column: Option<Json>,)*
            $($(#[$told])*
            #[serde(default, skip_serializing_if = "Option::is_none")]
            pub $flag: Option<bool>,)?
        }
    };
}

measurements!(
    /// Released at rest, it falls on a support and rebounds.
    Drop {
        /// Heights of the lowest point above the support at the release (m).
        height,
        /// Heights of the lowest point at the first apex (m).
        rebound
    }
);
measurements!(
    /// At rest on a support.
    Gap {
        /// The number of the scene that differs from row to row; none if absent.
        key,
        /// What it is in each row.
        at,
        /// Smallest distances between body and support (m).
        gap
    }
);
measurements!(
    /// Sliding steadily down a slope without turning, or beginning to.
    Slope {
        /// Inclinations of the support (rad).
        angle,
        /// Speeds (m/s); none where it begins to slide.
        speed;
        /// Whether the angles are those at which it begins to slide, and are what was measured.
        begins
    }
);
measurements!(
    /// Torn off along the normal, slowly and without turning.
    PullOff {
        /// The number of the scene that differs from row to row; none if absent.
        key,
        /// What it is in each row.
        at,
        /// The largest forces (N).
        force
    }
);

/// Waves through the lattice of the scene: their frequencies.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Dispersion {
    /// Changes to the scene for these measurements, by dotted key.
    #[serde(default)]
    pub set: BTreeMap<String, Json>,
    /// A CSV file with columns of the names below, in SI units, relative to this file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub table: Option<String>,
    /// κ along the first reciprocal vector.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub kappa_1: Option<Json>,
    /// κ along the second; 0 if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub kappa_2: Option<Json>,
    /// κ along the third; 0 if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub kappa_3: Option<Json>,
    /// Branches, counted from 0 by ascending frequency, as `gyration bands` does.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub branch: Option<Json>,
    /// Frequencies ω (rad/s).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub omega: Option<Json>,
    /// Standard deviation of each (rad/s): a number, or one a row.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<Json>,
}
