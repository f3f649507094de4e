//! A drawing as PDF 1.4: one page, one compressed stream, letters as outlines so that no font is needed.
//!
//! Source: ISO 32000-1, §7 (objects, file structure), §8 (graphics). Opacity comes from graphics states, one for each
//! value. There is neither a date nor an identifier in the file.

use super::color::Color;
use super::font::OutlineSegment;
use super::geometry::{Point, Rect};
use super::marks::{Mark, Page, Path, Stroke, Text};

/// Strength of the compression of streams, 0 to 10.
const COMPRESSION: u8 = 6;

/// The bytes of the PDF file.
pub fn render(drawing: &Page) -> Vec<u8> {
    let mut page = PdfPage { content: String::new(), height: drawing.height, opacities: Vec::new() };
    for mark in drawing.still() {
        match mark {
            Mark::Path(path) => page.path(path),
            Mark::Text(text) => page.text(text),
        }
    }
    let stream = miniz_oxide::deflate::compress_to_vec_zlib(page.content.as_bytes(), COMPRESSION);
    let mut file = File::new();
    file.object(b"<< /Type /Catalog /Pages 2 0 R >>");
    file.object(b"<< /Type /Pages /Kids [3 0 R] /Count 1 >>");
    let states: Vec<String> = page
        .opacities
        .iter()
        .enumerate()
        .map(|(index, opacity)| format!("/A{index} << /ca {0} /CA {0} >>", number(*opacity)))
        .collect();
    let dictionary = format!(
        "<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {} {}] /Contents 4 0 R /Resources << /ExtGState << {} >> >> >>",
        number(drawing.width),
        number(drawing.height),
        states.join(" ")
    );
    file.object(dictionary.as_bytes());
    let head = format!("<< /Length {} /Filter /FlateDecode >>\nstream\n", stream.len());
    file.object(&[head.as_bytes(), &stream, b"\nendstream"].concat());
    let title = format!("<< /Title {} >>", text_string(&drawing.title));
    file.object(title.as_bytes());
    file.finish()
}

/// The body of a PDF file, with the place of every object.
struct File {
    bytes: Vec<u8>,
    places: Vec<usize>,
}

impl File {
    fn new() -> Self {
        // The four high bytes tell transfer programs that the file is binary.
        Self { bytes: b"%PDF-1.4\n%\xE2\xE3\xCF\xD3\n".to_vec(), places: Vec::new() }
    }

    fn object(&mut self, body: &[u8]) {
        self.places.push(self.bytes.len());
        self.bytes.extend(format!("{} 0 obj\n", self.places.len()).as_bytes());
        self.bytes.extend(body);
        self.bytes.extend(b"\nendobj\n");
    }

    /// The last object is the one with the title.
    fn finish(mut self) -> Vec<u8> {
        let (start, count) = (self.bytes.len(), self.places.len());
        let mut tail = format!("xref\n0 {}\n0000000000 65535 f \n", count + 1);
        for place in &self.places {
            tail += &format!("{place:010} 00000 n \n");
        }
        let size = count + 1;
        tail += &format!("trailer\n<< /Size {size} /Root 1 0 R /Info {count} 0 R >>\nstartxref\n{start}\n%%EOF\n");
        self.bytes.extend(tail.as_bytes());
        self.bytes
    }
}

/// The content of the page; PDF counts y upwards.
struct PdfPage {
    content: String,
    height: f64,
    opacities: Vec<f64>,
}

impl PdfPage {
    fn point(&self, point: Point) -> String {
        format!("{} {}", number(point[0]), number(self.height - point[1]))
    }

    fn path(&mut self, path: &Path) {
        self.content += "q\n";
        if let Some(Rect { x, y, width, height }) = path.clip {
            let corner = self.point([x, y + height]);
            self.content += &format!("{corner} {} {} re W n\n", number(width), number(height));
        }
        let outline = self.outline(path);
        // Filled and stroked apart, since each may have its own opacity.
        if let Some(fill) = &path.fill {
            self.set_color(fill, "rg");
            self.content += &outline;
            self.content += "f\n";
        }
        if let Some(stroke) = &path.stroke {
            self.set_stroke(stroke);
            self.content += &outline;
            self.content += "S\n";
        }
        self.content += "Q\n";
    }

    fn outline(&self, path: &Path) -> String {
        let mut outline = String::new();
        for line in path.lines.iter().filter(|line| line.len() > 1) {
            for (index, point) in line.iter().enumerate() {
                let operator = if index == 0 { "m" } else { "l" };
                outline += &format!("{} {operator}\n", self.point(*point));
            }
            if path.closed {
                outline += "h\n";
            }
        }
        outline
    }

    fn set_color(&mut self, color: &Color, operator: &str) {
        let [red, green, blue] = color.rgb.map(|c| number(f64::from(c) / 255.0));
        self.content += &format!("{red} {green} {blue} {operator}\n");
        let known = self.opacities.iter().position(|opacity| *opacity == color.opacity);
        let index = known.unwrap_or_else(|| {
            self.opacities.push(color.opacity);
            self.opacities.len() - 1
        });
        self.content += &format!("/A{index} gs\n");
    }

    fn set_stroke(&mut self, stroke: &Stroke) {
        self.set_color(&stroke.color, "RG");
        let dash: Vec<String> = stroke.dash.iter().map(|length| number(*length)).collect();
        let cap = if dash.is_empty() { 1 } else { 0 };
        self.content += &format!("{} w {cap} J 1 j [{}] 0 d\n", number(stroke.width), dash.join(" "));
    }

    fn text(&mut self, text: &Text) {
        let mut outline = String::new();
        let mut pen = text.at;
        text.trace(&mut |segment| match segment {
            OutlineSegment::Move(to) => {
                outline += &format!("{} m\n", self.point(to));
                pen = to;
            }
            OutlineSegment::Line(to) => {
                outline += &format!("{} l\n", self.point(to));
                pen = to;
            }
            OutlineSegment::Curve(control, to) => {
                // The cubic with the same course: its control points stand at two thirds of the way.
                let toward = |end: Point| [0, 1].map(|k| end[k] + 2.0 / 3.0 * (control[k] - end[k]));
                let (first, second) = (self.point(toward(pen)), self.point(toward(to)));
                outline += &format!("{first} {second} {} c\n", self.point(to));
                pen = to;
            }
            OutlineSegment::Close => outline += "h\n",
        });
        self.content += "q\n";
        self.set_color(&text.color, "rg");
        self.content += &outline;
        self.content += "f\nQ\n";
    }
}

/// Three decimals at most; PDF knows no exponents.
fn number(value: f64) -> String {
    let text = format!("{value:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// A text string in UTF-16 with its byte order mark, in hexadecimal digits.
fn text_string(text: &str) -> String {
    let digits: String = text.encode_utf16().map(|unit| format!("{unit:04X}")).collect();
    format!("<FEFF{digits}>")
}
