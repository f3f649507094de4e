//! The formats of pictures.

use super::marks::Page;
use super::{Film, pdf, png, svg};
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
    /// Graphics interchange format: what moves, without a program to play it.
    Gif,
}

impl Format {
    /// The format that the ending of a file asks for.
    ///
    /// # Errors
    /// [`PlotError::Arguments`] where it is none of svg, png, pdf, gif.
    pub fn of_path(path: &Path) -> Result<Self, PlotError> {
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
        match ending.as_deref() {
            Some("svg") => Ok(Self::Svg),
            Some("png") => Ok(Self::Png),
            Some("pdf") => Ok(Self::Pdf),
            Some("gif") => Ok(Self::Gif),
            _ => Err(PlotError::arguments(
                format!("the ending of {} names no format of pictures", path.display()),
                "let the file end in .svg, .png, .pdf or .gif",
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
            Format::Gif => Film::of(self).gif(),
        }
    }
}
