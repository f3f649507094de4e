//! A drawing as SVG: paths with two decimals, labels as text in the reader's own fonts.

use super::color::Color;
use super::geometry::{Point, Rect};
use super::label::{Label, Script};
use super::marks::{Anchor, Mark, Moment, Page, Path, Stroke, Text};
use std::fmt::Write as _;

/// Families in the order of preference; the last is generic.
const FONT_FAMILY: &str = "'Noto Sans', 'Helvetica Neue', Helvetica, Arial, sans-serif";

/// The text of the SVG file.
pub fn render(drawing: &Page) -> String {
    let (width, height) = (number(drawing.width), number(drawing.height));
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}pt\" height=\"{height}pt\" \
         viewBox=\"0 0 {width} {height}\" font-family=\"{FONT_FAMILY}\">\n\
         <title>{}</title>\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n",
        escape(&drawing.title)
    );
    let clips = clips(drawing);
    for (index, clip) in clips.iter().enumerate() {
        let [x, y, width, height] = [clip.x, clip.y, clip.width, clip.height].map(number);
        svg += &format!(
            "<clipPath id=\"c{index}\"><rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"/></clipPath>\n"
        );
    }
    write_marks(&mut svg, &drawing.marks, &clips);
    drawing.moments.iter().for_each(|moment| write_moment(&mut svg, moment, &clips));
    svg += "</svg>\n";
    svg
}

fn write_marks(svg: &mut String, marks: &[Mark], clips: &[Rect]) {
    for mark in marks {
        match mark {
            Mark::Path(path) => write_path(svg, path, clips),
            Mark::Text(text) => write_text(svg, text),
        }
    }
}

/// A group that is seen for a while, by SMIL: it moves in an image too, where no script runs.
fn write_moment(svg: &mut String, moment: &Moment, clips: &[Rect]) {
    let Moment { marks, begin, end, lasts, is_still } = moment;
    let mut steps = vec![(*begin, "visible")];
    if *begin > 0.0 {
        steps.insert(0, (0.0, "hidden"));
    }
    if *end < 1.0 {
        steps.push((*end, "hidden"));
    }
    let values = steps.iter().map(|(_, value)| *value).collect::<Vec<_>>().join(";");
    let times = steps.iter().map(|(time, _)| format!("{time:.5}")).collect::<Vec<_>>().join(";");
    let visibility = if *is_still { "visible" } else { "hidden" };
    let lasts = number(*lasts);
    // Writing to a string does not fail.
    let _ = writeln!(
        svg,
        "<g visibility=\"{visibility}\"><animate attributeName=\"visibility\" calcMode=\"discrete\" dur=\"{lasts}s\" \
         repeatCount=\"indefinite\" values=\"{values}\" keyTimes=\"{times}\"/>"
    );
    write_marks(svg, marks, clips);
    *svg += "</g>\n";
}

/// The different clips, in the order of their first use.
fn clips(drawing: &Page) -> Vec<Rect> {
    let mut clips: Vec<Rect> = Vec::new();
    for mark in drawing.marks.iter().chain(drawing.moments.iter().flat_map(|moment| &moment.marks)) {
        if let Mark::Path(Path { clip: Some(clip), .. }) = mark
            && !clips.contains(clip)
        {
            clips.push(*clip);
        }
    }
    clips
}

fn write_path(svg: &mut String, path: &Path, clips: &[Rect]) {
    *svg += "<path d=\"";
    for line in path.lines.iter().filter(|line| line.len() > 1) {
        write_line(svg, line);
        if path.closed {
            *svg += "Z";
        }
    }
    *svg += "\"";
    match &path.fill {
        Some(fill) => write_color(svg, "fill", fill),
        None => *svg += " fill=\"none\"",
    }
    if let Some(stroke) = &path.stroke {
        write_stroke(svg, stroke);
    }
    if let Some(index) = path.clip.and_then(|clip| clips.iter().position(|other| *other == clip)) {
        *svg += &format!(" clip-path=\"url(#c{index})\"");
    }
    *svg += "/>\n";
}

/// `M` and the rest; a point that rounds to the one before is left out.
fn write_line(svg: &mut String, line: &[Point]) {
    let mut previous = None;
    for (index, point) in line.iter().enumerate() {
        let place = (number(point[0]), number(point[1]));
        if previous.as_ref() == Some(&place) && index + 1 < line.len() {
            continue;
        }
        let letter = if previous.is_none() { "M" } else { "L" };
        // Writing to a string does not fail.
        let _ = write!(svg, "{letter}{} {}", place.0, place.1);
        previous = Some(place);
    }
}

fn write_stroke(svg: &mut String, stroke: &Stroke) {
    write_color(svg, "stroke", &stroke.color);
    *svg += &format!(" stroke-width=\"{}\" stroke-linejoin=\"round\"", number(stroke.width));
    if stroke.dash.is_empty() {
        *svg += " stroke-linecap=\"round\"";
    } else {
        let dash: Vec<String> = stroke.dash.iter().map(|length| number(*length)).collect();
        *svg += &format!(" stroke-dasharray=\"{}\"", dash.join(" "));
    }
}

fn write_color(svg: &mut String, attribute: &str, color: &Color) {
    let [red, green, blue] = color.rgb;
    *svg += &format!(" {attribute}=\"#{red:02x}{green:02x}{blue:02x}\"");
    if color.opacity < 1.0 {
        *svg += &format!(" {attribute}-opacity=\"{}\"", number(color.opacity));
    }
}

fn write_text(svg: &mut String, text: &Text) {
    let [x, y] = text.at.map(number);
    let anchor = match text.anchor {
        Anchor::Start => "start",
        Anchor::Middle => "middle",
        Anchor::End => "end",
    };
    *svg += &format!("<text x=\"{x}\" y=\"{y}\" font-size=\"{}\" text-anchor=\"{anchor}\"", number(text.size));
    write_color(svg, "fill", &text.color);
    if text.bold {
        *svg += " font-weight=\"bold\"";
    }
    if text.upright {
        *svg += &format!(" transform=\"rotate(-90 {x} {y})\"");
    }
    *svg += ">";
    write_label(svg, &text.label, text.size);
    *svg += "</text>\n";
}

/// Raised parts are shifted by `dy`, and what follows is shifted back.
fn write_label(svg: &mut String, label: &Label, size: f64) {
    let mut height = 0.0;
    for (level, words) in &label.parts {
        let (scale, shift) = level.size_and_shift();
        if *level == Script::Base && height == 0.0 {
            *svg += &escape(words);
            continue;
        }
        let dy = number((height - shift) * size);
        let small = number(scale * size);
        *svg += &format!("<tspan dy=\"{dy}\" font-size=\"{small}\">{}</tspan>", escape(words));
        height = shift;
    }
}

/// Two decimals at most, without trailing zeros.
fn number(value: f64) -> String {
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// Characters with a meaning in XML, and those that it forbids.
fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => escaped += "&amp;",
            '<' => escaped += "&lt;",
            '>' => escaped += "&gt;",
            '"' => escaped += "&quot;",
            '\t' | '\n' => escaped.push(' '),
            // No characters of XML.
            letter if letter.is_control() || matches!(letter, '\u{fffe}' | '\u{ffff}') => {}
            letter => escaped.push(letter),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_have_no_negative_zero() {
        let numbers = [1.0, 1.25, -0.001, 0.5, 100.0, 1.0 / 3.0].map(number);
        assert_eq!(numbers, ["1", "1.25", "0", "0.5", "100", "0.33"]);
    }

    #[test]
    fn titles_cannot_break_the_markup() {
        let drawing = Page::new(10.0, 10.0, "a <b> & \"c\"\u{1}\u{ffff}");
        let svg = render(&drawing);
        assert!(svg.contains("<title>a &lt;b&gt; &amp; &quot;c&quot;</title>"));
    }
}
