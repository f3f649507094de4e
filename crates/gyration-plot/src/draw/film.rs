//! What moves on a page as pictures that follow one another, and these as GIF.
//!
//! Of each frame of a GIF only the rectangle is written in which it differs from the one before. Delays are whole
//! hundredths of a second; what rounding leaves goes on to the next frame, so that the film takes as long as it should.

use super::marks::{Mark, Page};
use super::png::pixels;
use gif::{Encoder, Frame, Repeat};

/// Pixels a point.
const SCALE: f32 = 1.5;
/// How coarsely the colours of a frame are chosen, 1 to 30: there are few.
const COARSENESS: i32 = 10;
/// How long a picture that does not move stays [s].
const STAYS: f64 = 1.0;

/// Pictures that follow one another.
#[derive(Debug, Clone, PartialEq)]
pub struct Film {
    /// Width and height in pixels, even.
    size: [u32; 2],
    frames: Vec<Vec<Mark>>,
    /// How long each stays [s].
    stays: Vec<f64>,
}

/// One picture of a film.
#[derive(Debug, Clone, PartialEq)]
pub struct FilmFrame {
    /// Red, green, blue and opacity of each pixel, row by row.
    pub rgba: Vec<u8>,
    /// How long it stays [s].
    pub stays: f64,
}

impl Film {
    /// Of a page.
    pub fn of(page: &Page) -> Self {
        // Encoders of films halve the resolution of colours.
        let even = |length: f64| ((length as f32 * SCALE / 2.0).ceil() as u32).max(1) * 2;
        let above = |marks: &[Mark]| page.marks.iter().chain(marks).cloned().collect();
        let (mut frames, mut stays): (Vec<Vec<Mark>>, Vec<f64>) = (Vec::new(), Vec::new());
        for moment in &page.moments {
            frames.push(above(&moment.marks));
            stays.push((moment.end - moment.begin) * moment.lasts);
        }
        if frames.is_empty() {
            (frames, stays) = (vec![above(&[])], vec![STAYS]);
        }
        Self { size: [even(page.width), even(page.height)], frames, stays }
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// How long it takes [s].
    pub fn lasts(&self) -> f64 {
        self.stays.iter().sum()
    }

    /// The pictures, one after the other.
    pub fn frames(&self) -> impl Iterator<Item = FilmFrame> + '_ {
        self.frames.iter().zip(&self.stays).map(|(marks, stays)| {
            let rgba = pixels(self.size, SCALE, marks.iter()).map(|pixels| pixels.data().to_vec());
            FilmFrame { rgba: rgba.unwrap_or_default(), stays: *stays }
        })
    }

    /// The bytes of the GIF file.
    pub fn gif(&self) -> Vec<u8> {
        // Writing into memory does not fail, nor do sizes of a page.
        self.try_gif().unwrap_or_default()
    }

    fn try_gif(&self) -> Option<Vec<u8>> {
        let [width, height] = [u16::try_from(self.size[0]).ok()?, u16::try_from(self.size[1]).ok()?];
        let mut bytes = Vec::new();
        let mut encoder = Encoder::new(&mut bytes, width, height, &[]).ok()?;
        encoder.set_repeat(Repeat::Infinite).ok()?;
        let (mut before, mut begun, mut written): (Option<Vec<u8>>, f64, u64) = (None, 0.0, 0);
        for FilmFrame { rgba, stays } in self.frames() {
            begun += stays;
            let until = (100.0 * begun).round() as u64;
            let [left, top, right, bottom] = changed(before.as_deref(), &rgba, self.size);
            let row = |y: usize| &rgba[4 * (y * usize::from(width) + left)..4 * (y * usize::from(width) + right)];
            let mut part: Vec<u8> = (top..bottom).flat_map(row).copied().collect();
            let size = [right - left, bottom - top].map(|side| side as u16);
            let mut frame = Frame::from_rgba_speed(size[0], size[1], &mut part, COARSENESS);
            (frame.left, frame.top) = (left as u16, top as u16);
            frame.delay = (until - written).min(u64::from(u16::MAX)) as u16;
            encoder.write_frame(&frame).ok()?;
            (before, written) = (Some(rgba), until);
        }
        drop(encoder);
        Some(bytes)
    }
}

/// Left, top, right and bottom of the least rectangle that holds all pixels that differ; of equal pictures one pixel.
fn changed(before: Option<&[u8]>, now: &[u8], [width, height]: [u32; 2]) -> [usize; 4] {
    let [width, height] = [width as usize, height as usize];
    let Some(before) = before else { return [0, 0, width, height] };
    let mut found: Option<[usize; 4]> = None;
    for (index, _) in before.chunks_exact(4).zip(now.chunks_exact(4)).enumerate().filter(|(_, (a, b))| a != b) {
        let (x, y) = (index % width, index / width);
        let [left, top, right, bottom] = found.unwrap_or([x, y, x + 1, y + 1]);
        found = Some([left.min(x), top.min(y), right.max(x + 1), bottom.max(y + 1)]);
    }
    found.unwrap_or([0, 0, 1, 1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_changes_is_written() {
        let size = [4, 3];
        let mut picture = vec![255; 4 * 4 * 3];
        assert_eq!(changed(None, &picture, size), [0, 0, 4, 3]);
        let before = picture.clone();
        assert_eq!(changed(Some(&before), &picture, size), [0, 0, 1, 1]);
        // Pixels (1, 1) and (2, 2).
        (picture[4 * 5], picture[4 * 10 + 2]) = (0, 0);
        assert_eq!(changed(Some(&before), &picture, size), [1, 1, 3, 3]);
    }
}
