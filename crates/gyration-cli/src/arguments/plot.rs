//! The arguments of `gyration plot`.

use super::completion::{completer, scenes};
use super::number::finite;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueHint};
use gyration_plot::{PlotQuantity, TimeSpan};
use std::path::PathBuf;

/// `gyration plot`
#[derive(Debug, Args)]
pub struct Plot {
    /// Directory of a recording, a scene, or the table of a study
    #[arg(value_name = "DIR|SCENE", value_hint = ValueHint::AnyPath, add = completer(scenes))]
    pub source: String,
    /// What to draw, below each other [default: overview of a recording, laws of a scene]
    #[arg(value_name = "WHAT", value_parser = quantity())]
    pub what: Vec<PlotQuantity>,
    /// File to write: .svg, .png, .pdf or .gif; - writes SVG to stdout [default: STEM-WHAT.svg in the current folder]
    #[arg(short, long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub output: Option<PathBuf>,
    /// The two measures of `stroke`, to the right and upwards, as columns of the CSV without the body, V_xx and Q_xx
    /// besides: G_xz,G_zz or G_zz,P_zz [default: entries of G that enclose most]
    #[arg(long, value_name = "A,B", value_delimiter = ',')]
    pub measures: Vec<String>,
    /// Columns of the CSV over time: die.vx,*.gap or joint.*.angle; * stands for any letters
    #[arg(long, value_name = "A,B", value_delimiter = ',')]
    pub columns: Vec<String>,
    /// Show it from this time on [s]
    #[arg(long, value_name = "TIME", value_parser = finite, allow_hyphen_values = true)]
    pub from: Option<f64>,
    /// Show it up to this time [s]
    #[arg(long, value_name = "TIME", value_parser = finite, allow_hyphen_values = true)]
    pub to: Option<f64>,
    /// Change a value of the scene before its laws are drawn
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub overrides: Vec<String>,
}

impl Plot {
    /// From when to when it is shown.
    pub fn span(&self) -> TimeSpan {
        TimeSpan { from: self.from, to: self.to }
    }
}

/// Reads the name of a quantity; help lists all of them.
fn quantity() -> impl TypedValueParser<Value = PlotQuantity> {
    let named = |quantity: PlotQuantity| PossibleValue::new(quantity.name()).help(quantity.description());
    PossibleValuesParser::new(PlotQuantity::ALL.map(named)).try_map(|name| PlotQuantity::of_name(&name))
}
