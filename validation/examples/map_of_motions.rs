//! The map of motions of a neo-Hookean spheroid in simple shear, over G = ηγ̇/μ_s and the aspect ratio r, as a picture.
//!
//!   cargo run --release -p gyration-validation --example map_of_motions > docs/pictures/motions.svg
//!
//! A body without inertia, its axis of revolution in the plane of the shear, tumbles or trembles; each point of the
//! boundary is a root of the passage between the two (`gyration_validation::passage`). The broken line is the boundary
//! of small strains, 5G/4 = |r − 1|/(r + 1).

use gyration_validation::{passage, threshold};
use std::fmt::Write as _;

/// The boundary at an aspect ratio.
fn boundary(ratio: f64) -> f64 {
    let small = small_strains(ratio);
    let (mut low, mut high) = (0.9 * small, 1.1 * small);
    while passage(ratio, low) < 0.0 {
        low *= 0.9;
    }
    while passage(ratio, high) > 0.0 {
        high *= 1.15;
    }
    threshold(|capillary| passage(ratio, capillary), low, high)
}

fn small_strains(ratio: f64) -> f64 {
    0.8 * ((ratio - 1.0) / (ratio + 1.0)).abs()
}

/// The picture, in its own units.
struct Map {
    svg: String,
}

const WIDTH: f64 = 640.0;
const HEIGHT: f64 = 420.0;
const LEFT: f64 = 60.0;
const BOTTOM: f64 = 370.0;
const TOP: f64 = 24.0;
const RIGHT: f64 = 620.0;
/// Axes: ln r from 1/5 to 5, G from 0 to 1.
const WIDEST: f64 = 5.0;
const HIGHEST: f64 = 1.0;

fn x(ratio: f64) -> f64 {
    LEFT + (RIGHT - LEFT) * (0.5 + 0.5 * ratio.ln() / WIDEST.ln())
}

fn y(capillary: f64) -> f64 {
    BOTTOM - (BOTTOM - TOP) * capillary / HIGHEST
}

impl Map {
    fn line(&mut self, points: &[(f64, f64)], style: &str) {
        let mut path = String::new();
        for (ratio, capillary) in points {
            let _ = write!(path, "{}{:.1} {:.1} ", if path.is_empty() { 'M' } else { 'L' }, x(*ratio), y(*capillary));
        }
        let _ = writeln!(self.svg, r#"<path d="{}" {style}/>"#, path.trim_end());
    }

    fn word(&mut self, (across, down): (f64, f64), words: &str, style: &str) {
        let _ = writeln!(self.svg, r#"<text x="{across:.1}" y="{down:.1}" {style}>{words}</text>"#);
    }
}

fn main() {
    let steps = 8;
    let ratio = |k: i32| WIDEST.powf(f64::from(k) / f64::from(steps));
    let mut points: Vec<(f64, f64)> = Vec::new();
    for k in (-steps..=steps).filter(|k| *k != 0) {
        points.push((ratio(k), boundary(ratio(k))));
        eprintln!(
            "r = {:.4}: G = {:.5}, small strains {:.5}",
            points[points.len() - 1].0,
            points[points.len() - 1].1,
            small_strains(ratio(k))
        );
    }
    points.insert(steps as usize, (1.0, 0.0));
    print!("{}", picture(&points));
}

fn picture(points: &[(f64, f64)]) -> String {
    let mut map = Map {
        svg: format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" font-family=\"sans-serif\" font-size=\"13\" fill=\"#333\">\n\
         <rect width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"#ffffff\"/>\n\
         <clipPath id=\"frame\"><rect x=\"{LEFT}\" y=\"{TOP}\" width=\"{}\" height=\"{}\"/></clipPath>\n<g clip-path=\"url(#frame)\">\n",
            RIGHT - LEFT,
            BOTTOM - TOP
        ),
    };
    // Below the boundary bodies tumble.
    let below = [&[(1.0 / WIDEST, 0.0)], points, &[(WIDEST, 0.0)]].concat();
    let above = [&[(1.0 / WIDEST, HIGHEST)], points, &[(WIDEST, HIGHEST)]].concat();
    map.line(&above, r##"fill="#e3eefa" stroke="none""##);
    map.line(&below, r##"fill="#fbe7d3" stroke="none""##);
    map.line(points, r##"fill="none" stroke="#b4561a" stroke-width="2""##);
    let fine: Vec<(f64, f64)> =
        (-100..=100).map(|k| WIDEST.powf(f64::from(k) / 100.0)).map(|r| (r, small_strains(r))).collect();
    map.line(&fine, r##"fill="none" stroke="#333" stroke-width="1" stroke-dasharray="5 4""##);
    map.line(&[(1.0, 0.0), (1.0, HIGHEST)], r##"fill="none" stroke="#1f5fa8" stroke-width="2""##);
    map.svg += "</g>\n";
    frame(&mut map);
    map.svg + "</svg>\n"
}

fn frame(map: &mut Map) {
    let (across, down) = (RIGHT - LEFT, BOTTOM - TOP);
    let _ = writeln!(
        map.svg,
        r##"<rect x="{LEFT}" y="{TOP}" width="{across}" height="{down}" fill="none" stroke="#333"/>"##
    );
    for (ratio, word) in
        [(0.2, "1/5"), (1.0 / 3.0, "1/3"), (0.5, "1/2"), (1.0, "1"), (2.0, "2"), (3.0, "3"), (5.0, "5")]
    {
        map.line(&[(ratio, 0.0), (ratio, 0.015)], r##"stroke="#333""##);
        map.word((x(ratio), BOTTOM + 18.0), word, r#"text-anchor="middle""#);
    }
    for k in 0..=5 {
        let capillary = 0.2 * f64::from(k);
        map.word((LEFT - 8.0, y(capillary) + 4.5), &format!("{capillary:.1}"), r#"text-anchor="end""#);
    }
    map.word(
        (0.5 * (LEFT + RIGHT), HEIGHT - 10.0),
        "aspect ratio r of the body at rest (oblate | prolate)",
        r#"text-anchor="middle""#,
    );
    map.word((18.0, TOP - 10.0), "G = ηγ̇/μ", "");
    map.word((x(2.9), y(0.12)), "tumbles", r##"text-anchor="middle" font-size="15" fill="#8a3f10""##);
    map.word((x(0.35), y(0.12)), "tumbles", r##"text-anchor="middle" font-size="15" fill="#8a3f10""##);
    map.word((x(1.8), y(0.8)), "trembles", r##"text-anchor="middle" font-size="15" fill="#1f4f88""##);
    map.word((x(0.55), y(0.8)), "trembles", r##"text-anchor="middle" font-size="15" fill="#1f4f88""##);
    map.word((x(1.0) + 6.0, y(0.93)), "treads (r = 1)", r##"fill="#1f5fa8""##);
    map.word((x(4.9), y(0.27)), "5G/4 = |r − 1|/(r + 1)", r#"text-anchor="end" font-size="12""#);
}
