//! The arguments of `gyration resistance`.

use super::completion::{completer, scenes};
use super::number::positive;
use clap::builder::TypedValueParser;
use clap::{Args, ValueHint};
use gyration_sim::resistance::TRIANGLES_ALLOWED;

/// `gyration resistance`
#[derive(Debug, Args)]
pub struct ResistanceArguments {
    /// Path of a scene, or its name in the gallery; behind a colon one body of it
    #[arg(value_name = "SCENE[:BODY]", value_hint = ValueHint::FilePath, add = completer(scenes))]
    pub scene: String,
    /// Change a value of the scene
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub overrides: Vec<String>,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
    /// By boundary elements also where there is a closed form
    #[arg(long)]
    pub elements: bool,
    /// About how many triangles boundary elements take [default: 1280]
    #[arg(long, value_name = "N", value_parser = triangles())]
    pub triangles: Option<u32>,
    /// Near a wall without slip: the plane of this support
    #[arg(long, value_name = "SUPPORT")]
    pub wall: Option<String>,
    /// Small vibrations of this frequency [Hz], of spheres in a fluid with a density
    #[arg(
        long,
        value_name = "HZ",
        value_parser = positive,
        allow_negative_numbers = true,
        conflicts_with_all = ["elements", "triangles", "wall"]
    )]
    pub frequency: Option<f64>,
}

/// Reads how many triangles boundary elements take.
fn triangles() -> impl TypedValueParser<Value = u32> {
    clap::value_parser!(u32).range(i64::from(*TRIANGLES_ALLOWED.start())..=i64::from(*TRIANGLES_ALLOWED.end()))
}
