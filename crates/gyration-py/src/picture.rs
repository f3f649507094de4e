//! `Picture`: a drawing that shows itself in a notebook and can be saved.

use crate::errors;
use gyration_plot::study::{PlotRequest, of_table};
use gyration_plot::{Asked, Figure, Format, PlotError, PlotQuantity, calibration};
use gyration_record::{Recording, write_file};
use gyration_scene::Scene;
use gyration_study::DataFrame;
use gyration_study::calibration::{Calibration, Fitted};
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::Arc;
use tempfile::TempDir;

/// A drawing; in a notebook it shows itself.
#[pyclass(frozen, module = "gyration", name = "Picture")]
pub struct Picture {
    source: PictureSource,
    svg: String,
}

/// What is drawn.
pub enum PictureSource {
    /// A recording.
    Recording {
        /// The recording.
        recording: Recording,
        /// What keeps its folder.
        kept: Option<Arc<TempDir>>,
        /// What is drawn; the overview if there is nothing.
        quantities: Vec<String>,
        /// The measures of `stroke`.
        measures: Vec<String>,
    },
    /// The laws of a scene.
    Laws(Arc<Scene>),
    /// A fit to measurements.
    Fit(Arc<Calibration>, Arc<Fitted>),
    /// Columns of the table of a study, which lies at this path.
    Study(Arc<DataFrame>, PathBuf, PlotRequest),
}

impl PictureSource {
    fn figure(&self) -> Result<Figure, PlotError> {
        match self {
            Self::Recording { recording, quantities, measures, .. } => {
                let named = quantities.iter().map(|name| PlotQuantity::of_name(name));
                let mut quantities = named.collect::<Result<Vec<_>, _>>()?;
                if quantities.is_empty() {
                    quantities.push(PlotQuantity::Overview);
                }
                let asked = Asked { quantities: &quantities, measures, ..Asked::default() };
                gyration_plot::of_recording(recording, asked)
            }
            Self::Laws(scene) => gyration_plot::laws(scene),
            Self::Fit(calibration, fitted) => Ok(calibration::figure(calibration, fitted)),
            Self::Study(frame, path, request) => {
                let stem = path.file_stem().map_or("study".into(), |stem| stem.to_string_lossy());
                of_table(frame, &stem, request.clone(), None)
            }
        }
    }
}

impl Picture {
    /// Draws.
    pub fn new(source: PictureSource) -> PyResult<Self> {
        let bytes = source.figure().map_err(errors::plot)?.render(Format::Svg);
        Ok(Self { source, svg: String::from_utf8_lossy(&bytes).into_owned() })
    }

    /// As a text.
    pub fn svg(&self) -> &str {
        &self.svg
    }

    /// The laws of a scene.
    pub fn of_laws(scene: Arc<Scene>) -> PyResult<Self> {
        Self::new(PictureSource::Laws(scene))
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
        let format = Format::of_path(&path).map_err(errors::plot)?;
        let bytes = py.detach(|| Ok(self.source.figure()?.render(format))).map_err(errors::plot)?;
        write_file(&path, &bytes).map_err(errors::record)
    }

    fn _repr_svg_(&self) -> &str {
        &self.svg
    }

    fn __repr__(&self) -> String {
        let what = match &self.source {
            PictureSource::Recording { recording, quantities, .. } => {
                let what = if quantities.is_empty() { "overview".to_owned() } else { quantities.join(", ") };
                format!("{what} of {}", recording.path().display())
            }
            PictureSource::Laws(scene) => format!("laws of {}", scene.name()),
            PictureSource::Fit(calibration, _) => format!("fit of {}", calibration.title()),
            PictureSource::Study(_, path, _) => format!("table of {}", path.display()),
        };
        format!("<gyration.Picture: {what}>")
    }
}
