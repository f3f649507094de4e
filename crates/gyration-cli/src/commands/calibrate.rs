//! `gyration calibrate`: numbers of a scene from measurements, with their errors, and a drawing of the fit.

use super::picture::{format, write};
use crate::arguments::Calibrate;
use crate::error::CliError;
use crate::input::stem;
use crate::output;
use crate::waiting::waiting;
use gyration_plot::calibration;
use gyration_study::calibration::Calibration;
use std::path::{Path, PathBuf};

/// Fits, prints and draws.
pub fn execute(arguments: &Calibrate) -> Result<u8, CliError> {
    let path = &arguments.data;
    let format = format(arguments.output.as_deref())?;
    let shown = path.display();
    let calibration = waiting(format!("opening {shown}"), true, || Calibration::load(path))?;
    if let Some(folder) =
        arguments.output.as_deref().and_then(Path::parent).filter(|folder| !folder.as_os_str().is_empty())
        && !folder.is_dir()
    {
        return Err(CliError::arguments(
            format!("there is no folder {}", folder.display()),
            "make it, or write elsewhere",
        ));
    }
    let fitted = waiting(format!("fitting {shown}"), true, || calibration.fit())?;
    if arguments.json {
        let mut json = serde_json::to_value(&fitted).unwrap_or_default();
        json["set"] = fitted.overrides().into();
        output::offer(&format!("{json:#}\n"))?;
    } else {
        output::offer(&fitted.text(&calibration))?;
    }
    let figure = calibration::figure(&calibration, &fitted);
    write(&figure, arguments.output.as_deref(), format, || PathBuf::from(format!("{}-fit.svg", stem(path))))
}
