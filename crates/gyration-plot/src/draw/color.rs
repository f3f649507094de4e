//! Colours that readers who do not see all colours can tell apart: the palette of Okabe and Ito.
//!
//! Source: M. Okabe and K. Ito, *Color Universal Design* (2008). Its yellow is left out: it is not legible on white; so
//! is its black, in whose place stands a brown: the viewer's page, which has the same palette
//! (`viewer/src/math/colors.ts`), is dark at times.

/// A colour with an opacity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Color {
    /// Red, green, blue.
    pub rgb: [u8; 3],
    /// 0 (nothing) to 1 (opaque).
    pub opacity: f64,
}

impl Color {
    /// An opaque colour.
    pub const fn new(red: u8, green: u8, blue: u8) -> Self {
        Self { rgb: [red, green, blue], opacity: 1.0 }
    }

    /// The same colour with this opacity.
    pub const fn faded(self, opacity: f64) -> Self {
        Self { opacity, ..self }
    }

    /// The opaque colour that this one has on white, `share` of it and the rest white.
    pub fn tint(self, share: f64) -> Self {
        Self { rgb: self.rgb.map(|c| (255.0 - share * (255.0 - f64::from(c))).round() as u8), opacity: 1.0 }
    }
}

/// Labels and frames.
pub const INK: Color = Color::new(0x22, 0x22, 0x22);
/// Grid, hatching, what stands behind.
pub const FAINT: Color = Color::new(0xDD, 0xDD, 0xDD);
/// Secondary labels and lines.
pub const GREY: Color = Color::new(0x77, 0x77, 0x77);

/// The page.
pub const WHITE: Color = Color::new(0xFF, 0xFF, 0xFF);

/// The colours of series, in order.
pub const SERIES: [Color; 7] = [
    Color::new(0x00, 0x72, 0xB2),
    Color::new(0xD5, 0x5E, 0x00),
    Color::new(0x00, 0x9E, 0x73),
    Color::new(0xCC, 0x79, 0xA7),
    Color::new(0xE6, 0x9F, 0x00),
    Color::new(0x56, 0xB4, 0xE9),
    Color::new(0x8C, 0x62, 0x39),
];

/// The colour of the series of this index: after seven the palette comes again in pale colours, then in dark ones.
pub fn series(index: usize) -> Color {
    let color = SERIES[index % SERIES.len()];
    match index / SERIES.len() % 3 {
        0 => color,
        1 => color.tint(0.55),
        _ => Color { rgb: color.rgb.map(|part| (0.6 * f64::from(part)).round() as u8), ..color },
    }
}
