//! The formats of pictures.

use super::marks::Page;
use super::{pdf, png, svg};
use crate::error::PlotError;
use std::path::Path;

/// The format of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Scalable vector graphics.
    Svg,
    /// Portable network graphics, three pixels a point.
    Png,
    /// Portable document format.
    Pdf,
}

impl Format {
    /// The format that the ending of a file asks for.
    ///
    /// # Errors
    /// [`PlotError::Arguments`] where it is none of svg, png, pdf.
    pub fn of_path(path: &Path) -> Result<Self, PlotError> {
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
        match ending.as_deref() {
            Some("svg") => Ok(Self::Svg),
            Some("png") => Ok(Self::Png),
            Some("pdf") => Ok(Self::Pdf),
            _ => Err(PlotError::arguments(
                format!("the ending of {} names no format of pictures", path.display()),
                "let the file end in .svg, .png or .pdf",
            )),
        }
    }
}

impl Page {
    /// The bytes of the picture.
    pub fn render(&self, format: Format) -> Vec<u8> {
        match format {
            Format::Svg => svg::render(self).into_bytes(),
            Format::Png => png::render(self),
            Format::Pdf => pdf::render(self),
        }
    }
}
