//! `Picture`: a drawing that shows itself in a notebook and can be saved.

use crate::errors;
use gyration_cli::library::{self, CliError, Format, StudyPicture};
use gyration_record::Recording;
use gyration_scene::Scene;
use gyration_study::Frame;
use gyration_study::calibration::{Calibration, Fitted};
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::Arc;
use tempfile::TempDir;

/// A drawing; in a notebook it shows itself.
#[pyclass(frozen, module = "gyration", name = "Picture")]
pub struct Picture {
    source: Source,
    svg: String,
}

/// What is drawn.
pub enum Source {
    /// A recording, what keeps its folder, the quantities, and the measures of `stroke`.
    Recording(Recording, Option<Arc<TempDir>>, [Vec<String>; 2]),
    /// The laws of a scene.
    Laws(Arc<Scene>),
    /// A fit to measurements.
    Fit(Arc<Calibration>, Arc<Fitted>),
    /// Columns of the table of a study, which lies at this path.
    Study(Arc<Frame>, PathBuf, StudyPicture),
}

impl Source {
    fn render(&self, format: Format) -> Result<Vec<u8>, CliError> {
        match self {
            Self::Recording(recording, _, [what, measures]) => library::picture(recording, what, measures, format),
            Self::Laws(scene) => library::laws(scene, format),
            Self::Fit(calibration, fitted) => Ok(library::fit_picture(calibration, fitted, format)),
            Self::Study(frame, path, asked) => library::study_picture(frame, path, asked, format),
        }
    }
}

impl Picture {
    /// Draws.
    pub fn new(source: Source) -> PyResult<Self> {
        let bytes = source.render(Format::Svg).map_err(errors::program)?;
        Ok(Self { source, svg: String::from_utf8_lossy(&bytes).into_owned() })
    }

    /// As a text.
    pub fn svg(&self) -> &str {
        &self.svg
    }

    /// The laws of a scene.
    pub fn of_laws(scene: Arc<Scene>) -> PyResult<Self> {
        Self::new(Source::Laws(scene))
    }
}

#[pymethods]
impl Picture {
    /// The picture as SVG.
    #[getter(svg)]
    fn text(&self) -> &str {
        &self.svg
    }

    /// Writes it; the ending of the path says how.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        let format = library::format(&path).map_err(errors::program)?;
        let written = py.detach(|| library::write_picture(&path, &self.source.render(format)?));
        written.map_err(errors::program)
    }

    fn _repr_svg_(&self) -> &str {
        &self.svg
    }

    fn __repr__(&self) -> String {
        let what = match &self.source {
            Source::Recording(recording, _, [what, _]) if what.is_empty() => {
                format!("overview of {}", recording.path().display())
            }
            Source::Recording(recording, _, [what, _]) => {
                format!("{} of {}", what.join(", "), recording.path().display())
            }
            Source::Laws(scene) => format!("laws of {}", scene.name()),
            Source::Fit(calibration, _) => format!("fit of {}", calibration.title()),
            Source::Study(_, path, _) => format!("table of {}", path.display()),
        };
        format!("<gyration.Picture: {what}>")
    }
}
